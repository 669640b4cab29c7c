// Structural parts as manufactured: turned and flat parts from the scene.

import { ShapeUtils, Vector2 } from "three";

import { BRASS, PARTS } from "./colours.js";
import { isOpened } from "./cutaway.js";
import { Shape, swept } from "./shape.js";
import { barOf, paneOf } from "./sight.js";
import { along, endsOf, frameAt, isParallel, offAxis, vector } from "./space.js";

const COLOURS = { plate: PARTS.plate, frame: PARTS.case, carrier: PARTS.plate, dial: PARTS.case, pillar: PARTS.plate, post: PARTS.plate, foot: PARTS.plate, pipe: PARTS.pipe, barrel: PARTS.pipe, weight: PARTS.pipe, bob: PARTS.plate, pin: PARTS.pin, belt: PARTS.mark, cord: PARTS.mark, wheel: BRASS[0], pulley: BRASS[1], star: BRASS[2], cross: BRASS[2], rack: BRASS[3], pinion: BRASS[0], drum: PARTS.case, box: PARTS.slot, lid: PARTS.pin, nut: BRASS[4], guide: PARTS.slot, road: PARTS.arm, nave: PARTS.arm, figure: PARTS.bezel };
const SMOOTH = ["figure"]; // turned parts whose bands are joined by cones
const FLAT_GLOSS = 0.5;
const WALL = "wall"; // wall of a cup, which continues a flexible wheel
export const ROUND = 84; // vertices of a circle as wide as a train
const ENDING = ["post", "pin"]; // parts that end in the face of the part they hold
const PROUD = 0.06; // relative to their radius: they protrude, because coplanar faces flicker
const DRUM = "drum"; // holds a ring at its disc, with which it becomes transparent
const COVERS = ["frame", "carrier", "dial", DRUM];

/** Colour of a part, from its kind. */
export const colourOf = ({ kind }) => COLOURS[kind] ?? PARTS.arbor;

/**
 * All structural parts: {body, colour, gloss, shape, matrix, at, kind, cover, pane, bar}. `cover` is the normal of a part that
 * can hide wheels, else null; `pane` is the obstacle of a frame plate, and `bar` that of a pillar.
 */
export function builtParts(scene, main) {
  return partsOf(scene, scene.parts, main);
}

/** Parts of couplings other than pins, as in `builtParts`. */
export const shapeParts = (scene, main) => partsOf(scene, scene.shapes, main);

function partsOf(scene, parts, main) {
  return parts.map((part) => {
    const { body, kind, place, direction, across } = part;
    const flat = part.outlines.length > 0;
    const upright = isParallel(direction, main.toArray());
    const cover = COVERS.includes(kind) ? vector(direction) : null;
    const shape = flat ? flatShape(part) : SMOOTH.includes(kind) ? smoothShape(part.bands) : turnedShape(ENDING.includes(kind) ? standingOut(part.bands) : part.bands, kind === WALL || kind === DRUM ? ROUND : 40);
    // parts along the direction in which layers move are stretched
    const at = kind === DRUM ? endsOf(part)[0].lerp(endsOf(part)[1], 0.5) : upright && !flat ? null : vector(place);
    return { body, kind, cover, colour: colourOf(part), gloss: flat ? FLAT_GLOSS : 0.8, shape, matrix: frameAt(place, direction, across), at, plate: flat, pane: kind === "frame" ? paneOf(part) : null, bar: kind === "pillar" ? barOf(part) : null, wall: kind === WALL ? endsOf(part) : null, opened: isOpened(scene, part) };
  });
}

function standingOut(bands) {
  const [[low, , first], [, high, last]] = [bands[0], bands.at(-1)];
  return bands.map(([from, to, radius, bore]) => [from === low ? from - PROUD * first : from, to === high ? to + PROUD * last : to, radius, bore]);
}

/** Half the section of a turned part, counter-clockwise; separate bands give several outlines. */
export function turnedShape(bands, most) {
  const shape = new Shape();
  let run = [];
  bands.forEach((band, n) => {
    run.push(band);
    if (n + 1 < bands.length && bands[n + 1][0] - band[1] < 1e-6) return;
    const outside = run.flatMap(([low, high, radius]) => [[radius, low], [radius, high]]);
    const inside = run.toReversed().flatMap(([low, high, , bore]) => [[bore, high], [bore, low]]);
    swept(shape, chamfered([...outside, ...inside]), Math.max(14, Math.min(most, Math.round(10 * Math.max(...run.map(([, , radius]) => radius))))));
    run = [];
  });
  return shape;
}

/** A turned part whose outline passes through the middle of each band. */
export function smoothShape(bands) {
  const outline = bands.map(([low, high, radius]) => [radius, (low + high) / 2]);
  return swept(new Shape(), [[0, bands[0][0]], [bands[0][2], bands[0][0]], ...outline, [0, bands.at(-1)[1]]], 32);
}

/** Chamfers the sharp outer edges of the ends, so that they reflect light. */
function chamfered(outline) {
  const heights = outline.map(([, z]) => z);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  return outline.flatMap(([r, z], n) => {
    const before = outline.at(n - 1);
    const after = outline[(n + 1) % outline.length];
    const edge = Math.min(0.15 * r, 0.1 * (high - low));
    if (z === low && before[1] === low && before[0] < r - 2 * edge && after[1] > low) return [[r - edge, z], [r, z + edge]];
    if (z === high && after[1] === high && after[0] < r - 2 * edge && before[1] < high) return [[r, z - edge], [r - edge, z]];
    return [[r, z]];
  });
}

/** A flat part, with outlines of alternating x and y: first its edge, then its holes; without walls before outline `walled`. */
export function flatShape({ outlines, height }, walled = 0) {
  const shape = new Shape();
  const rings = outlines.map((line) => {
    const points = [];
    for (let n = 0; n < line.length; n += 2) points.push(new Vector2(line[n], line[n + 1]));
    if (points.length > 1 && points[0].distanceTo(points.at(-1)) < 1e-9) points.pop();
    return points;
  });
  rings.forEach((ring, n) => {
    if (ShapeUtils.isClockWise(ring) === (n === 0)) ring.reverse();
  });
  const triangles = ShapeUtils.triangulateShape(rings[0], rings.slice(1));
  const points = rings.flat();
  for (const side of [-1, 1]) {
    const first = shape.corners;
    for (const { x, y } of points) shape.corner([x, y, (side * height) / 2], [0, 0, side], [1, 0, 0]);
    for (const [a, b, c] of triangles) shape.indices.push(first + a, first + b, first + c);
  }
  for (const ring of rings.slice(walled)) wall(shape, ring, height / 2);
  return shape;
}

function wall(shape, ring, half) {
  ring.forEach(({ x, y }, n) => {
    const next = ring[(n + 1) % ring.length];
    const [dx, dy] = [next.x - x, next.y - y];
    const length = Math.hypot(dx, dy) || 1;
    shape.face([[x, y, -half], [next.x, next.y, -half], [next.x, next.y, half], [x, y, half]], [dy / length, -dx / length, 0], [dx / length, dy / length, 0]);
  });
}

/** Turned parts of a body about its own axis: [from, to, radius] along it, one for each band. */
export function rodsOf(scene, index) {
  const body = scene.bodies[index];
  return scene.parts
    .filter(({ body: own, bands, direction, place }) => own === index && bands.length && isParallel(direction, body.direction) && offAxis(body, place) < 1e-6)
    .flatMap(({ bands, direction, place }) => {
      const [middle, way] = [along(body, place), Math.sign(vector(direction).dot(vector(body.direction)))];
      return bands.map(([low, high, radius]) => [...[middle + way * low, middle + way * high].sort((a, b) => a - b), radius]);
    });
}

/** Points whose convex hull contains all parts in the zero pose: {point, body, kind, at}, with `at` of the part. */
export function cornersOf(parts, main) {
  return parts.flatMap(({ body, kind, place, direction, across, bands, outlines, height }) => {
    const matrix = frameAt(place, direction, across);
    const flat = (outlines[0] ?? []).flatMap((x, n, all) => (n % 2 ? [] : [[x, all[n + 1], height / 2], [x, all[n + 1], -height / 2]]));
    const round = bands.flatMap(([low, high, r]) => [low, high].flatMap((z) => [[r, 0, z], [-r, 0, z], [0, r, z], [0, -r, z]]));
    const at = bands.length && isParallel(direction, main.toArray()) ? null : vector(place);
    return [...flat, ...round].map((point) => ({ point: vector(point).applyMatrix4(matrix), body, kind, at }));
  });
}
