// Arbors, and the arms of carriers: what holds the wheels.

import { BoxGeometry, CylinderGeometry } from "three";

import { PARTS } from "./colours.js";
import { solid } from "./solids.js";
import { along, foot, frameAt, isParallel, offAxis, onAxis, sharesAxis, vector } from "./space.js";

/** A straight round bar between two points, whose ends may be stretched apart. */
export class Bar {
  constructor(from, to, radius, colour) {
    this.from = from;
    this.to = to;
    this.mesh = solid(new CylinderGeometry(radius, radius, 1, 20).rotateX(Math.PI / 2), colour);
    this.mesh.matrixAutoUpdate = false;
    this.stretch((point) => point);
  }

  /** where   moves a point to where the exploded picture has it */
  stretch(where) {
    const [from, to] = [where(this.from.clone()), where(this.to.clone())];
    const direction = to.clone().sub(from);
    const length = direction.length() || 1e-6;
    const side = Math.abs(direction.z) > 0.9 * length ? [1, 0, 0] : [0, 0, 1];
    this.mesh.matrix.copy(frameAt(from.clone().add(to).multiplyScalar(0.5), direction.divideScalar(length).toArray(), side));
    this.mesh.matrix.scale({ x: 1, y: 1, z: length });
    this.mesh.matrixWorldNeedsUpdate = true;
  }
}

/** A flat arm between two points, across a direction. */
export function arm(from, to, direction, width, thickness, colour) {
  const between = to.clone().sub(from);
  const length = between.length();
  const mesh = solid(new BoxGeometry(length + width, width, thickness), colour);
  mesh.applyMatrix4(frameAt(from.clone().add(to).multiplyScalar(0.5), direction, between.toArray()));
  return mesh;
}

/** Spans of bodies along their axes (mm), over all that they bear. */
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
  for (const { body, dial } of scene.pointers) {
    if (dial !== null) places[body].push(along(scene.bodies[body], scene.dials[dial].centre));
  }
  return places.map((list) => (list.length ? [Math.min(...list), Math.max(...list)] : null));
}

/** Radii of arbors: bodies on one axis are tubes round each other, the longest innermost. */
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

/** What holds the wheels: bars and arms by body. */
export function supports(scene, reach, radii, size) {
  const parts = [];
  scene.bodies.forEach((body, index) => {
    if (body.parent === null || !reach[index]) return;
    const [low, high] = reach[index];
    const parent = scene.bodies[body.parent];
    const carried = parent.parent !== null;
    let [from, to] = [low, high];
    if (carried && isParallel(parent.direction, body.direction) && offAxis(parent, body.point) > 1e-6 * size) {
      const at = heightOf(scene, body.parent, body, reach[index]);
      [from, to] = [Math.min(low, at), Math.max(high, at)];
      const own = onAxis(body, at);
      const hub = onAxis(parent, along(parent, own));
      const width = 3 * radii[index];
      parts.push({ body: body.parent, mesh: arm(hub, own, body.direction, width, 0.006 * size, PARTS.arm), at: own });
      reach[body.parent] ??= [along(parent, own), along(parent, own)];
    } else if (carried && !isParallel(parent.direction, body.direction)) {
      const at = along(body, foot(body.point, body.direction, parent.point, parent.direction));
      const bar = new Bar(onAxis(body, at), onAxis(body, (low + high) / 2), 0.8 * radii[index], PARTS.arm);
      parts.push({ body: body.parent, bar });
    }
    parts.push({ body: index, bar: new Bar(onAxis(body, from), onAxis(body, to), radii[index], PARTS.arbor) });
  });
  return parts;
}

/** Where along its child's axis a carrier's arm stands: at the carrier's own wheel, else below the child's wheels. */
function heightOf(scene, carrier, child, [low, high]) {
  const wheels = scene.wheels.filter((wheel) => wheel.body === carrier && wheel.kind !== "ring");
  const places = wheels.map((wheel) => along(child, wheel.centre));
  const middle = (low + high) / 2;
  const near = places.sort((one, other) => Math.abs(one - middle) - Math.abs(other - middle))[0];
  return near ?? low - 0.1 * (high - low);
}
