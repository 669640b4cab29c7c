// Arbors and carrier arms.

import { PARTS } from "./colours.js";
import { rodsOf } from "./parts.js";
import { bar, plate, roundEnded, Shape, swept, band } from "./shape.js";
import { across, along, foot, frameAt, isParallel, offAxis, onAxis, sharesAxis, vector } from "./space.js";

/** A straight round bar between two points: {shape, matrix}. */
export function barBetween(from, to, radius) {
  const direction = to.clone().sub(from);
  const length = direction.length();
  if (length < 1e-9) return { shape: new Shape(), matrix: frameAt(from.toArray(), [0, 0, 1], [1, 0, 0]) };
  const way = direction.divideScalar(length).toArray();
  return { shape: bar(radius, 0, length), matrix: frameAt(from.toArray(), way, across(way).toArray()) };
}

/** A flat arm with round ends between two points, across a direction; radii of its ends: {shape, matrix}. */
export function armBetween(from, to, direction, ends, thickness) {
  const between = to.clone().sub(from);
  const length = between.length();
  const half = thickness / 2;
  const shape = plate(new Shape(), roundEnded(length, ...ends, 0.62 * Math.min(...ends)), -half, half);
  const bosses = new Shape();
  swept(bosses, band(0, 0.72 * ends[1], -0.9 * thickness, 0.9 * thickness), 16);
  return { shape, matrix: frameAt(from.toArray(), direction, between.toArray()), boss: { shape: bosses, matrix: frameAt(to.toArray(), direction, between.toArray()) } };
}

/** Extent of each body along its axis (mm), including all bodies that it carries. */
export function spans(scene) {
  const places = scene.bodies.map(() => []);
  for (const wheel of scene.wheels) {
    const at = along(scene.bodies[wheel.body], wheel.centre);
    places[wheel.body].push(at - 0.9 * wheel.thickness, at + 0.9 * wheel.thickness);
  }
  for (const { pin, slot, pin_at, slot_at } of scene.couplings) {
    places[pin].push(along(scene.bodies[pin], pin_at));
    places[slot].push(along(scene.bodies[slot], slot_at));
  }
  for (const { body, place, height, direction, bands } of scene.shapes) {
    const ends = bands.length ? [bands[0][0], bands.at(-1)[1]] : [-height, height];
    if (isParallel(scene.bodies[body].direction, direction)) places[body].push(...ends.map((end) => along(scene.bodies[body], vector(place).addScaledVector(vector(direction), end))));
  }
  for (const { body, dial } of scene.pointers) {
    if (dial !== null && !scene.dials[dial].plate && scene.dials[dial].look !== "ball") places[body].push(along(scene.bodies[body], scene.dials[dial].centre));
  }
  scene.bodies.forEach((_, index) => rodsOf(scene, index).forEach(([low, high]) => places[index].push(low, high)));
  return places.map((list) => (list.length ? [Math.min(...list), Math.max(...list)] : null));
}

/** Radii of arbors: bodies on one axis are coaxial tubes, the longest innermost. */
export function hubs(scene, reach, size) {
  const radii = scene.bodies.map(() => 0.012 * size);
  const done = new Set();
  scene.bodies.forEach((_, index) => {
    if (done.has(index)) return;
    const coaxial = scene.bodies
      .map((_, other) => other)
      .filter((other) => sharesAxis(scene, index, other, size));
    const length = (other) => (reach[other] ? reach[other][1] - reach[other][0] : 0);
    coaxial.sort((one, other) => length(other) - length(one));
    const least = Math.min(...scene.wheels.filter((w) => coaxial.includes(w.body) && w.kind !== "ring").map((w) => 0.55 * w.root), 0.012 * size);
    coaxial.forEach((other, order) => {
      done.add(other);
      radii[other] = least * (1 + (0.7 * order) / Math.max(4, coaxial.length));
    });
  });
  return radii;
}

/** Arbors and arms of a train without structural parts: {body, colour, shape, matrix, at}; `at` is null for bars, which the exploded view stretches; arms are plates. */
export function supports(scene, reach, radii, size) {
  const parts = [];
  const thick = typical(scene.wheels.map(({ thickness }) => thickness)) || 0.01 * size;
  scene.bodies.forEach((body, index) => {
    if (body.parent === null || !reach[index]) return;
    const [low, high] = reach[index];
    const parent = scene.bodies[body.parent];
    const carried = parent.parent !== null;
    const parallel = isParallel(parent.direction, body.direction);
    let [from, to] = [low, high];
    if (carried && parallel && offAxis(parent, body.point) > 1e-6 * size) {
      const at = heightOf(scene, body.parent, body, reach[index], thick);
      [from, to] = [Math.min(low, at), Math.max(high, at)];
      const own = onAxis(body, at);
      const hub = onAxis(parent, along(parent, own));
      const arm = armBetween(hub, own, body.direction, [2.6 * radii[body.parent], 2.1 * radii[index]], 0.6 * thick);
      parts.push({ body: body.parent, colour: PARTS.arm, ...arm, at: own, plate: true }, { body: body.parent, colour: PARTS.arm, ...arm.boss, at: own, plate: true });
      reach[body.parent] ??= [along(parent, own), along(parent, own)];
    } else if (carried && !parallel) {
      const at = along(body, foot(body.point, body.direction, parent.point, parent.direction));
      const bar = barBetween(onAxis(body, at), onAxis(body, (low + high) / 2), 0.8 * radii[index]);
      parts.push({ body: body.parent, colour: PARTS.arm, ...bar, at: null, plate: true });
    }
    parts.push({ body: index, colour: PARTS.arbor, ...barBetween(onAxis(body, from), onAxis(body, to), radii[index]), at: null });
  });
  return parts;
}

const typical = (values) => [...values].sort((one, other) => one - other)[values.length >> 1];

/** Position of a carrier's arm along its child's axis: at the carrier's own wheel, else below the child's wheels. */
function heightOf(scene, carrier, child, [low, high], thick) {
  const wheels = scene.wheels.filter((wheel) => wheel.body === carrier && wheel.kind !== "ring");
  const places = wheels.map((wheel) => along(child, wheel.centre));
  const middle = (low + high) / 2;
  const near = places.sort((one, other) => Math.abs(one - middle) - Math.abs(other - middle))[0];
  return near ?? low - 0.4 * thick;
}
