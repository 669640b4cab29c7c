// Dials: their scales, spirals included, and the needles that move over them.

import { NEEDLES, PARTS } from "./colours.js";
import { band, halfBall, plate, Shape, swept } from "./shape.js";
import { frameAt, vector } from "./space.js";

const UP = [0, 0, 1];
const ALONG = [0, 0, 0]; // ink is not brushed

/** A dial's plate and what is engraved on it: [{body, colour, shape, matrix, at, dial}]. */
export function dialParts(scene, index) {
  const dial = scene.dials[index];
  if (dial.look === "ball") return [socket(scene, index)];
  const thick = 0.012 * dial.radius;
  const centre = vector(dial.centre).addScaledVector(vector(dial.normal), dial.plate ? 0.5 * thick : 0).toArray();
  const matrix = frameAt(centre, dial.normal, dial.zero);
  const hole = holeOf(dial);
  const face = swept(new Shape(), band(hole, dial.radius * 1.03, -thick, 0), 72);
  const bezel = swept(new Shape(), band(dial.radius * 1.03, dial.radius * 1.075, -thick, 1.2 * thick), 72);
  const common = { body: dial.body, matrix, at: vector(dial.centre), dial: index, plate: true };
  return [
    { ...common, colour: PARTS.face, gloss: 0.05, shape: face },
    { ...common, colour: PARTS.bezel, gloss: 0.8, shape: bezel },
    { ...common, colour: PARTS.mark, gloss: 0, shape: marks(dial) },
  ];
}

/** How far inwards from the middle of its dial a plate goes. */
function holeOf({ radius, scale }) {
  const band = scale.turns > 1 ? scale.outer - scale.inner + (scale.outer - scale.inner) / scale.turns + 0.02 : 0.26;
  return Math.max(0.05, scale.outer - band) * radius;
}

/** Points of an engraved line over the radius of its dial, from steps in 4,000ths: to the right, and to the zero mark. */
export function engraved(steps) {
  let [x, y] = [0, 0];
  return Array.from({ length: steps.length / 2 }, (_, n) => [(x += steps[2 * n]) / 4000, (y += steps[2 * n + 1]) / 4000]);
}

/** What is engraved, as thin strips just over the plate; a dial's own y looks to the reader's left. */
function marks({ radius, engraving }) {
  const shape = new Shape();
  for (const [, width, lines] of engraving) {
    for (const line of lines) {
      const points = engraved(line).map(([x, y]) => [radius * y, -radius * x]);
      for (let n = 1; n < points.length; n += 1) stroke(shape, points[n - 1], points[n], width * radius, 0.004 * radius);
    }
  }
  return shape;
}

/** A thin flat strip, a little longer than its line, for corners. */
function stroke(shape, [x0, y0], [x1, y1], width, z) {
  const length = Math.hypot(x1 - x0, y1 - y0) || 1;
  const [u, v] = [((x1 - x0) * width) / 2 / length, ((y1 - y0) * width) / 2 / length];
  const [a, b] = [0.7 * u, 0.7 * v];
  shape.face([[x0 - a + v, y0 - b - u, z], [x1 + a + v, y1 + b - u, z], [x1 + a - v, y1 + b + u, z], [x0 - a - v, y0 - b + u, z]], UP, ALONG);
}

/** The ring in which a ball turns. */
function socket(scene, index) {
  const { body, centre, normal, radius } = scene.dials[index];
  const shape = swept(new Shape(), band(1.06 * radius, 1.25 * radius, -0.2 * radius, 0.2 * radius), 40);
  const matrix = frameAt(centre, [0, 0, scene.front], normal);
  return { body, colour: PARTS.bezel, gloss: 0.8, shape, matrix, at: vector(centre), dial: index };
}

/** What shows an output on its dial: a needle, or the two halves of a ball, black towards the reader at zero: [{colour, shape, matrix, at, dial}]. */
export function pointerParts(scene, index, order) {
  const { dial } = scene.pointers[index];
  const { look, centre, normal, radius } = scene.dials[dial];
  if (look !== "ball") return [needlePart(scene, index, order)];
  const matrix = frameAt(centre, normal, [0, 0, scene.front]);
  const common = { gloss: 0.3, matrix, at: vector(centre), dial };
  return [
    { ...common, colour: PARTS.mark, shape: halfBall(radius, -0.25) },
    { ...common, colour: PARTS.silver, shape: halfBall(radius, 0.25) },
  ];
}

/** A needle from the middle of its dial to the rim: {colour, shape, matrix, at, dial}. */
function needlePart(scene, index, order) {
  const pointer = scene.pointers[index];
  const dial = scene.dials[pointer.dial];
  const length = dial.radius * (0.97 - 0.07 * (order % 4));
  const width = 0.016 * dial.radius;
  const thick = Math.min(0.012 * dial.radius, pointer.seat ? 0.9 : Infinity);
  const [low, high] = [pointer.level - thick / 2, pointer.level + thick / 2];
  const blade = [[-0.16, 1.5], [-0.12, 1.7], [0, 1.1], [0.86, 0.75], [0.88, 1.5], [1, 0.06]].map(([x, w]) => [x * length, w * width]);
  const shape = plate(new Shape(), blade, low, high);
  swept(shape, band(0, Math.max(0.05 * dial.radius, 0.75 * pointer.seat), low, high + 0.004 * dial.radius), 20);
  const at = vector(dial.centre);
  return { colour: NEEDLES[order % NEEDLES.length], gloss: 0.35, shape, matrix: frameAt(at.toArray(), dial.normal, dial.zero), at, dial: pointer.dial };
}
