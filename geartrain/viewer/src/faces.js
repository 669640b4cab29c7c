// Dials with circular or spiral scales, and the hands that move over them.

import { NEEDLES, PARTS } from "./colours.js";
import { ball, band, halfBall, plate, Shape, swept } from "./shape.js";
import { frameAt, vector } from "./space.js";

const WIDER = 1.45; // width factor of lines on metal, which are seen from a distance
const UP = [0, 0, 1];
const ALONG = [0, 0, 0]; // ink has no brushing direction

/** A dial's plate and its engraving: [{body, colour, shape, matrix, at, dial}]. */
export function dialParts(scene, index) {
  const dial = scene.dials[index];
  if (dial.look === "ball") return [socket(scene, index)];
  const levels = scene.pointers.flatMap((each) => (each.dial === index ? [each.level] : []));
  const thick = Math.min(0.012 * dial.radius, dial.seated ? 0.25 * Math.min(...levels) : Infinity); // hands pass over it
  const centre = vector(dial.centre).addScaledVector(vector(dial.normal), dial.plate ? 0.5 * thick : 0).toArray();
  const matrix = frameAt(centre, dial.normal, dial.zero);
  const hole = holeOf(dial);
  const edge = dial.placed ? 1.005 : 1.03; // dials at their declared places are close together, on one plate
  const face = swept(new Shape(), band(hole, dial.radius * edge, -thick, 0), 72);
  const bezel = swept(new Shape(), dial.placed ? [] : band(dial.radius * edge, dial.radius * 1.075, -thick, 1.2 * thick), 72);
  const common = { body: dial.body, matrix, at: vector(dial.centre), dial: index, plate: true };
  return [
    { ...common, colour: PARTS.face, gloss: 0.05, shape: face },
    { ...common, colour: PARTS.bezel, gloss: 0.8, shape: bezel },
    { ...common, colour: PARTS.mark, gloss: 0, shape: marks(dial) },
  ];
}

/** Inner radius of a plate. */
function holeOf({ radius, scale }) {
  const band = scale.turns > 1 ? scale.outer - scale.inner + (scale.outer - scale.inner) / scale.turns + 0.02 : 0.26;
  return Math.max(0.05, scale.outer - band) * radius;
}

/** Points of an engraved line relative to the dial's radius, from differences in 1/4000: to the right, and to the zero mark. */
export function engraved(steps) {
  let [x, y] = [0, 0];
  return Array.from({ length: steps.length / 2 }, (_, n) => [(x += steps[2 * n]) / 4000, (y += steps[2 * n + 1]) / 4000]);
}

/** The engraving as thin strips just above the plate; the y axis of a dial points to the reader's left. */
function marks({ radius, engraving }) {
  const shape = new Shape();
  for (const [kind, own, lines] of engraving) {
    const width = kind === "letters" ? own : WIDER * own;
    for (const line of lines) {
      const points = engraved(line).map(([x, y]) => [radius * y, -radius * x]);
      for (let n = 1; n < points.length; n += 1) stroke(shape, points[n - 1], points[n], width * radius, 0.004 * radius);
    }
  }
  return shape;
}

/** A thin flat strip, slightly longer than its line, so that corners are closed. */
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

/** Parts of a pointer: a hand, or the two halves of a ball, of which the black one faces the reader at zero: [{colour, shape, matrix, at, dial}]. */
export function pointerParts(scene, index, order) {
  const { dial } = scene.pointers[index];
  const { look, centre, normal, radius } = scene.dials[dial];
  if (look !== "ball") return handParts(scene, index, order);
  const matrix = frameAt(centre, normal, [0, 0, scene.front]);
  const common = { gloss: 0.3, matrix, at: vector(centre), dial };
  return [
    { ...common, colour: PARTS.mark, shape: halfBall(radius, -0.25) },
    { ...common, colour: PARTS.silver, shape: halfBall(radius, 0.25) },
  ];
}

const SHORTER = 0.07; // relative difference in length of successive hands of one dial

/** The pointer whose hand represents a pointer on its dial: of several on one end of an arbor, the longest. */
export function shownBy({ pointers, dials }, index) {
  const own = pointers[index];
  const reach = ({ dial }) => dials[dial].radius;
  const isAlike = ({ body, dial, seat }) => seat && own.seat && body === own.body && dial !== null && String(dials[dial].normal) === String(dials[own.dial].normal);
  return pointers.reduce((best, each, at) => (isAlike(each) && reach(each) > reach(pointers[best]) ? at : best), index);
}

/** Number of the hand that represents a pointer on its dial, from 0; it determines the colour. */
export function orderOf(scene, index) {
  const { pointers } = scene;
  if (pointers[index].dial === null) return 0;
  const by = shownBy(scene, index);
  return pointers.slice(0, by).filter(({ dial }) => dial === pointers[by].dial).length;
}

/** Outline of a hand: [x, half width], as long as its scale requires; each hand above others is slightly shorter. */
export function handOf({ outline, reach, ball: round }, size, order) {
  const length = size * reach * (round ? 1 : 1 - SHORTER * (order % 4));
  return outline.map(([x, w]) => [length * x, length * w]);
}

const OBLIQUITY = (23.44 * Math.PI) / 180; // of the ecliptic
const FAR = 0.62; // radius of the ecliptic's outermost point on a dial, relative to its scale
const BROAD = 0.05; // width of the ring of the ecliptic, in the same way

/** Point of the ecliptic at a longitude [rad], in the stereographic projection from the north pole, the summer solstice at 1. */
export function eclipticAt(longitude) {
  const rise = Math.asin(Math.sin(OBLIQUITY) * Math.sin(longitude));
  const ascension = Math.atan2(Math.cos(OBLIQUITY) * Math.sin(longitude), Math.cos(longitude));
  const far = Math.tan((Math.PI / 2 + rise) / 2) / Math.tan((Math.PI / 2 + OBLIQUITY) / 2);
  return [far * Math.cos(ascension), far * Math.sin(ascension)];
}

/** What a hand carries: the sphere at its end, with its ring, or the eccentric ring of the ecliptic, divided into signs. */
function carried({ hand, ball: radius, reach }, dial, common, [low, high]) {
  const size = dial.scale.outer * dial.radius;
  if (hand === "ecliptic") {
    const points = Array.from({ length: 120 }, (_, n) => eclipticAt((Math.PI * n) / 60).map((value) => FAR * size * value));
    const middle = (points[30][1] + points[90][1]) / 2; // the projection of a circle is a circle, here about a point of the y axis
    const wide = points[30][1] - middle;
    const ring = swept(new Shape(), band(wide - BROAD * size, wide, low, high), 96);
    for (let n = 0; n < ring.corners; n += 1) ring.points[3 * n + 1] += middle;
    const signs = new Shape();
    for (let n = 0; n < 120; n += 10) {
      const [x, y] = points[n];
      const inner = 1 - (BROAD * size) / wide;
      stroke(signs, [x, y], [inner * x, middle + inner * (y - middle)], 0.008 * size, high + 0.002 * size);
    }
    return [{ ...common, colour: PARTS.bezel, shape: ring }, { ...common, colour: PARTS.mark, gloss: 0, shape: signs }];
  }
  if (!radius) return [];
  const [orbit, wide] = [reach * size - radius * dial.radius, radius * dial.radius];
  const sphere = ball(wide, 20);
  for (let n = 0; n < sphere.corners; n += 1) {
    sphere.points[3 * n] += orbit;
    sphere.points[3 * n + 2] += high + 0.6 * wide;
  }
  const ring = hand === "bead" ? swept(new Shape(), band(orbit - 0.3 * wide, orbit + 0.3 * wide, low, high), 72) : new Shape();
  return [{ ...common, shape: sphere }, { ...common, colour: PARTS.bezel, shape: ring }];
}

/** A hand from the middle of its dial: {colour, shape, matrix, at, dial}; on a spiral, an arm with a slide whose pin follows the groove. */
function handParts(scene, index, order) {
  const pointer = scene.pointers[index];
  const dial = scene.dials[pointer.dial];
  const { radius, scale } = dial;
  const thick = Math.min(0.012 * radius, pointer.seat ? 0.9 : Infinity);
  const [low, high] = [pointer.level - thick / 2, pointer.level + thick / 2];
  const at = vector(dial.centre);
  const common = { colour: NEEDLES[order % NEEDLES.length], gloss: 0.35, matrix: frameAt(at.toArray(), dial.normal, dial.zero), at, dial: pointer.dial };
  const hub = (shape) => swept(shape, band(0, Math.max(0.05 * radius, Math.min(0.75 * pointer.seat, Math.max(0.55 * pointer.seat, 0.35 * radius))), low, high + 0.004 * radius), 20);
  if (scale.turns === 1) return [{ ...common, shape: hub(plate(new Shape(), handOf(pointer, scale.outer * radius, order), low, high)) }, ...carried(pointer, dial, common, [low, high])];
  const [inner, travel] = [scale.inner * radius, (scale.outer - scale.inner) * radius];
  const arm = [[-0.2, 0.02], [-0.16, 0.035], [-0.1, 0.03], [0, 0.026], [scale.inner - 0.14, 0.026], [scale.inner - 0.12, 0.034], [scale.inner - 0.06, 0.034], [scale.inner - 0.05, 0.026]];
  const shape = hub(plate(new Shape(), arm.map((station) => station.map((each) => each * radius)), low, high));
  const slide = [[inner - travel - 0.1 * radius, 0.012], [inner - 0.03 * radius, 0.012], [inner - 0.02 * radius, 0.02], [inner + 0.01 * radius, 0.02], [inner + 0.03 * radius, 0.004]];
  const slid = plate(new Shape(), slide.map(([x, w]) => [x, w * radius]), high, high + thick);
  const corner = slid.corners;
  swept(slid, band(0, 0.014 * radius, 0.002 * radius, high + 1.8 * thick), 12);
  for (let n = corner; n < slid.corners; n += 1) slid.points[3 * n] += inner; // the pin
  return [{ ...common, shape }, { ...common, colour: PARTS.mark, gloss: 0.5, shape: slid, slides: index }];
}
