// Dials: their scales, spirals included, and the needles that move over them.

import { NEEDLES, PARTS } from "./colours.js";
import { figure } from "./figures.js";
import { band, halfBall, plate, Shape, swept } from "./shape.js";
import { frameAt, vector } from "./space.js";

const MOST_MARKS = 1200;
const UP = [0, 0, 1];
const ALONG = [0, 0, 0]; // ink is not brushed

/** A dial's plate and what is engraved on it: [{body, colour, shape, matrix, at, dial}]. */
export function dialParts(scene, index) {
  const dial = scene.dials[index];
  if (dial.look === "ball") return [socket(scene, index)];
  const { inner, pitch } = scaleOf(dial);
  const thick = 0.012 * dial.radius;
  const centre = vector(dial.centre).addScaledVector(vector(dial.normal), dial.plate ? 0.5 * thick : 0).toArray();
  const matrix = frameAt(centre, dial.normal, dial.zero);
  const hole = Math.max(0.05 * dial.radius, inner - pitch - 0.02 * dial.radius);
  const face = swept(new Shape(), band(hole, dial.radius * 1.03, -thick, 0), 72);
  const bezel = swept(new Shape(), band(dial.radius * 1.03, dial.radius * 1.075, -thick, 1.2 * thick), 72);
  const common = { body: dial.body, matrix, at: vector(dial.centre), dial: index, plate: true };
  return [
    { ...common, colour: PARTS.face, gloss: 0.05, shape: face },
    { ...common, colour: PARTS.bezel, gloss: 0.8, shape: bezel },
    { ...common, colour: PARTS.mark, gloss: 0, shape: marks(scene, index) },
  ];
}

const scaleOf = (dial) => {
  const inner = dial.turns > 1 ? dial.inner : Math.max(dial.inner, 0.8 * dial.radius);
  return { inner, pitch: dial.turns > 1 ? (dial.radius - inner) / dial.turns : 0.14 * dial.radius };
};

/** Marks between cells, the rims and the numbers, as thin strips just over the plate. */
function marks(scene, index) {
  const dial = scene.dials[index];
  const { inner, pitch } = scaleOf(dial);
  const shape = new Shape();
  const sense = turningSense(scene, index);
  const height = 0.004 * dial.radius;
  const at = (turn, radius) => [radius * Math.cos(2 * Math.PI * turn), sense * radius * Math.sin(2 * Math.PI * turn)];
  const line = (from, to, width) => stroke(shape, from, to, width * dial.radius, height);
  const out = (turn) => (dial.turns > 1 ? inner + pitch * turn : dial.radius);
  const cells = Math.min(dial.divisions > 1 ? dial.divisions : 12, MOST_MARKS);
  const bold = boldOf(cells);
  const { elements } = frameAt(dial.centre, dial.normal, dial.zero);
  const upright = [elements[1], elements[5]]; // as the dial's own axes have it
  for (let cell = 0; cell < cells + (dial.turns > 1 ? 1 : 0); cell += 1) {
    const turn = (cell * dial.turns) / cells;
    const main = cell % bold === 0;
    const depth = dial.turns > 1 ? 1 : main ? 0.62 : cell % 5 === 0 && bold % 5 === 0 ? 0.45 : 0.3;
    line(at(turn, out(turn)), at(turn, out(turn) - depth * pitch), main ? 0.009 : 0.0035);
    if (main && dial.turns === 1 && dial.divisions > 1) number(shape, cell, at(turn, out(turn) - 1.02 * pitch), 0.3 * pitch, height, upright);
  }
  const steps = 72 * dial.turns;
  for (let step = 0; step < steps; step += 1) {
    const [from, to] = [step / 72, (step + 1) / 72];
    line(at(from, out(from)), at(to, out(to)), 0.005);
    if (dial.turns === 1) line(at(from, out(from) - 0.3 * pitch), at(to, out(to) - 0.3 * pitch), 0.003);
    else if (step < 72) line(at(from, inner - pitch + pitch * from), at(to, inner - pitch + pitch * to), 0.005);
  }
  return shape;
}

const boldOf = (cells) => (cells === 360 ? 30 : cells > 60 ? 10 : cells > 12 ? 5 : 1);

/** A thin flat strip. */
function stroke(shape, [x0, y0], [x1, y1], width, z) {
  const length = Math.hypot(x1 - x0, y1 - y0) || 1;
  const [a, b] = [((y0 - y1) * width) / 2 / length, ((x1 - x0) * width) / 2 / length];
  shape.face([[x0 - a, y0 - b, z], [x1 - a, y1 - b, z], [x1 + a, y1 + b, z], [x0 + a, y0 + b, z]], UP, ALONG);
}

/** A number along the radius, its head up, for one who faces the plate. */
function number(shape, value, [x, y], size, z, upright) {
  const length = (x * upright[0] + y * upright[1] < -1e-6 ? -1 : 1) * Math.hypot(x, y);
  const [up, right] = [[x / length, y / length], [y / length, -x / length]];
  for (const [from, to] of figure(String(value))) {
    const place = ([u, v]) => [x + size * (u * right[0] + v * up[0]), y + size * (u * right[1] + v * up[1])];
    stroke(shape, place(from), place(to), 0.16 * size, z);
  }
}

/** 1 where the dial's pointer moves counter-clockwise about the dial's normal while its output grows. */
function turningSense(scene, index) {
  const pointer = scene.pointers.find(({ dial }) => dial === index);
  return pointer ? -pointer.sense : -1;
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
