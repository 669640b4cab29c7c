// Pins and slots, and the handle of the crank.

import { Matrix4 } from "three";

import { armBetween } from "./arbors.js";
import { HANDLE, PARTS } from "./colours.js";
import { colourOf, ROUND, turnedShape } from "./parts.js";
import { ball, band, bar, plate, roundEnded, Shape, swept } from "./shape.js";
import { along, across, frameAt, isParallel, onAxis, vector } from "./space.js";

/** Parts of a pin and its slot: {body, colour, shape, matrix, at}. */
export function couplingParts(scene, coupling, size) {
  const [pinBody, slotBody] = [scene.bodies[coupling.pin], scene.bodies[coupling.slot]];
  const [pinAt, slotAt] = [vector(coupling.pin_at), vector(coupling.slot_at)];
  const radius = Math.max(0.005 * size, Math.min(0.012 * size, 0.12 * coupling.pin_radius));
  const height = 4 * radius;
  if (coupling.hole) return holesParts(coupling, pinBody, slotBody, height);
  const pin = bar(radius, -height / 2, height / 2, 16);
  const standing = frameAt(coupling.pin_at, pinBody.direction, across(pinBody.direction).toArray());
  const parts = [
    { body: coupling.pin, colour: PARTS.pin, shape: pin, matrix: standing, at: pinAt },
    { body: coupling.slot, colour: PARTS.slot, ...slot(coupling, slotBody, slotAt, pinAt, radius), at: slotAt },
  ];
  const hub = onAxis(pinBody, along(pinBody, pinAt));
  if (hub.distanceTo(pinAt) > 1e-6 * size) {
    const beneath = vector(pinBody.direction).multiplyScalar(-height / 2);
    const { shape, matrix } = armBetween(hub.add(beneath), pinAt.clone().add(beneath), pinBody.direction, [1.8 * radius, 1.6 * radius], 0.5 * radius);
    parts.push({ body: coupling.pin, colour: PARTS.slot, shape, matrix, at: pinAt });
  }
  return parts;
}

/** Pins around an axis, and rings for the holes in which they move. */
function holesParts(coupling, pinBody, slotBody, height) {
  const pin = bar(coupling.pin_diameter / 2, -height, height, 24);
  const wide = coupling.hole / 2;
  const ring = swept(new Shape(), band(wide, 1.12 * wide + 0.1, -0.6 * height, 0.6 * height), 48);
  const across_ = (body) => across(body.direction).toArray();
  const part = (index, body, colour, shape) => (place) => ({ body: index, colour, shape, matrix: frameAt(place, body.direction, across_(body)), at: vector(place) });
  return [
    ...coupling.holes_at.map(part(coupling.slot, slotBody, PARTS.slot, ring)),
    ...coupling.pins_at.map(part(coupling.pin, pinBody, PARTS.pin, pin)),
  ];
}

/** Two rails between which the pin slides, and the arm that connects them with their axis. */
function slot(coupling, body, slotAt, pinAt, radius) {
  const { pin_radius: reach, offset } = coupling;
  const [near, far] = [Math.max(0, Math.abs(reach - offset) - 2 * radius), reach + offset + 2 * radius];
  const shape = new Shape();
  const half = radius / 2;
  const box = (from, to, y, width) => plate(shape, [[from, width / 2], [to, width / 2]], -half, half, ([x, w, z]) => [x, w + y, z]);
  for (const side of [1, -1]) box(near, far, side * 1.35 * radius, 0.6 * radius);
  box(far, far + 0.7 * radius, 0, 3.3 * radius);
  if (near > 0) box(0, near, 0, 3.3 * radius);
  swept(shape, band(0, 2.4 * radius, -half, half), 24);
  const towards = pinAt.clone().sub(slotAt).toArray();
  return { shape, matrix: frameAt(slotAt.toArray(), body.direction, towards, coupling.slot_turn ?? 0) };
}

/**
 * The crank at one end of its arbor, on side 1 or -1: positions of its foot (`at`), its knob and the centre of the circle
 * of its far end in the zero pose, the radius around the knob in which a finger grips it, and its parts.
 */
export function crankOf(scene, index, end, side, reach, size) {
  const body = scene.bodies[index];
  const at = onAxis(body, end);
  const frame = frameAt(at.toArray(), body.direction, across(body.direction).toArray());
  const standing = (x, z) => frame.clone().multiply(new Matrix4().makeTranslation(x, 0, z));
  const thick = 0.013 * size;
  const out = 0.045 * size * side;
  const lever = plate(new Shape(), roundEnded(reach, 0.022 * size, 0.018 * size, 0.013 * size), -thick / 2, thick / 2);
  const grip = swept(new Shape(), [[0, -out], [0.011 * size, -out], [0.019 * size, 0.5 * out], [0.016 * size, out], [0, out]], 24);
  const parts = [
    { colour: PARTS.arbor, shape: lever, matrix: frame },
    { colour: PARTS.arbor, shape: bar(0.016 * size, -thick, thick), matrix: frame },
    { colour: HANDLE, shape: grip, matrix: standing(reach, out) },
    { colour: HANDLE, shape: ball(0.0165 * size), matrix: standing(reach, 2 * out) },
  ].map((part) => ({ body: index, at, ...part }));
  const knob = vector([reach, 0, out]).applyMatrix4(frame);
  return { body: index, at, end: onAxis(body, end + 2 * out), knob, touch: 0.06 * size, reach, parts };
}

const STEEL = { gloss: 0.5, colour: PARTS.slot };

/** A motor, a spring in its barrel, or a fusee at one end of the driven arbor, as in `crankOf`; it is turned at its axis. */
export function machineOf(scene, index, end, side, size) {
  const { direction, parent } = scene.bodies[index];
  const at = onAxis(scene.bodies[index], end);
  const matrix = frameAt(at.toArray(), vector(direction).multiplyScalar(side).toArray(), across(direction).toArray());
  const [made, reach, length] = scene.drive === "motor" ? motor(parent, 0.075 * size) : scene.fusee.length ? fusee(scene.fusee) : mainspring(0.09 * size);
  const parts = made.map((part) => ({ body: index, at, matrix, ...part }));
  return { body: index, at, end: at.clone().addScaledVector(vector(direction), side * length), knob: at, touch: 0.6 * reach, reach, parts };
}

/** A coupling on the shaft, and the motor on the frame: its ribbed body between two shields, and its terminal box. */
function motor(frame, radius) {
  const [low, high] = [0.5 * radius, 2.5 * radius];
  const ribs = Array.from({ length: 11 }, (_, n) => [n % 2 ? 0.9 : 1, low + 0.2 * radius + (n / 10) * (high - low - 0.4 * radius)]).flatMap(([r, z], n, all) => [[(n ? all[n - 1][0] : r) * radius, z], [r * radius, z]]);
  const body = swept(new Shape(), [[0, low], [0.8 * radius, low], ...ribs, [0.8 * radius, high], [0, high]], 48);
  const box = plate(new Shape(), [[0.8 * radius, 0.4 * radius], [1.25 * radius, 0.4 * radius]], 1.1 * radius, 1.9 * radius);
  return [[{ ...STEEL, shape: bar(0.4 * radius, 0, 0.35 * radius, 32) }, { colour: PARTS.arbor, shape: bar(0.15 * radius, -0.1 * radius, low) }, { ...STEEL, body: frame, shape: body }, { ...STEEL, colour: PARTS.pin, body: frame, shape: box }], 1.25 * radius, high];
}

/** An open barrel with its coiled spring. */
function mainspring(radius) {
  const high = 0.5 * radius;
  const drum = swept(swept(new Shape(), band(0.93 * radius, radius, 0, high), 64), band(0, radius, 0, 0.08 * high), 64);
  const [coil, turns] = [new Shape(), 6];
  const place = (n) => [(0.2 + (0.7 * n) / (48 * turns)) * radius, (2 * Math.PI * n) / 48];
  for (let n = 0; n < 48 * turns; n += 1) {
    const [[r0, t0], [r1, t1]] = [place(n), place(n + 1)];
    const corner = (r, t, z) => [r * Math.cos(t), r * Math.sin(t), z];
    const [inner, outer] = [0, 0.035 * radius].map((thick) => [[r0 + thick, t0], [r1 + thick, t1]]);
    const up = 0.92 * high;
    coil.face([...inner, ...outer.toReversed()].map(([r, t]) => corner(r, t, up)), [0, 0, 1], [-Math.sin(t0), Math.cos(t0), 0]);
    for (const [line, sign] of [[inner, -1], [outer, 1]]) {
      const [[ra, ta], [rb, tb]] = line;
      coil.face([corner(ra, ta, 0), corner(rb, tb, 0), corner(rb, tb, up), corner(ra, ta, up)], [sign * Math.cos(t0), sign * Math.sin(t0), 0], [-Math.sin(t0), Math.cos(t0), 0]);
    }
  }
  return [[{ colour: PARTS.pipe, shape: drum }, { colour: PARTS.arbor, shape: coil }, { colour: PARTS.arbor, shape: bar(0.2 * radius, 0, 1.2 * high) }], radius, 1.2 * high];
}

/** A fusee in true size, with a groove for each of its radii. */
function fusee(radii) {
  const [most, step] = [Math.max(...radii), (1.4 * Math.max(...radii)) / radii.length];
  const grooved = radii.flatMap((r, n) => [[r + 0.2 * step, n * step], [r - 0.3 * step, (n + 0.5) * step]]);
  const top = radii.length * step;
  const shape = swept(new Shape(), [[0, 0], ...grooved, [radii.at(-1), top], [0, top]], 64);
  return [[{ colour: PARTS.pipe, shape }, { colour: PARTS.pipe, shape: bar(1.1 * most, -0.8 * step, 0, 64) }], 1.1 * most, top];
}

const GAP = 0.02; // in the rod of a shortened pendulum, relative to its length

/** The turned parts of a hanging part; a pendulum longer than `most` (mm) is shortened, with a gap in its rod. */
export function partsOfHanger({ kind, length, down, parts }, most) {
  const less = length - most;
  if (kind !== "pendulum" || less <= 0) return parts;
  const broken = ([low, high, ...radii]) => [[low, most * (0.6 - GAP), ...radii], [most * (0.6 + GAP), high - less, ...radii]];
  return parts.map((part) => {
    if (isParallel(part.direction, down)) return { ...part, bands: part.bands.flatMap(broken) };
    return { ...part, place: vector(part.place).addScaledVector(vector(down), -less).toArray() };
  });
}

/** The turned parts of a hanging part, or its line: {colour, shape, matrix, at}. */
export function hangerParts({ point, direction, down, length, wide, parts }) {
  const at = vector(point);
  if (!parts.length) return [{ colour: PARTS.pin, shape: bar(wide, 0, length), matrix: frameAt(point, down, direction), at }];
  return parts.map((part) => ({ colour: colourOf(part), shape: turnedShape(part.bands, ROUND), matrix: frameAt(part.place, part.direction, part.across), at }));
}
