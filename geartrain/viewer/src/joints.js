// Pins and slots, and the handle of the crank.

import { Matrix4 } from "three";

import { armBetween } from "./arbors.js";
import { HANDLE, PARTS } from "./colours.js";
import { colourOf, ROUND, turnedShape } from "./parts.js";
import { ball, band, bar, plate, roundEnded, Shape, swept } from "./shape.js";
import { along, across, frameAt, onAxis, vector } from "./space.js";

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

/** The turned parts of a hanging part, or its line: {colour, shape, matrix, at}. */
export function hangerParts({ point, direction, down, length, wide, parts }) {
  const at = vector(point);
  if (!parts.length) return [{ colour: PARTS.pin, shape: bar(wide, 0, length), matrix: frameAt(point, down, direction), at }];
  return parts.map((part) => ({ colour: colourOf(part), shape: turnedShape(part.bands, ROUND), matrix: frameAt(part.place, part.direction, part.across), at }));
}
