// Dials: their scales, spirals included, and the needles that move over them.

import { BoxGeometry, BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, RingGeometry } from "three";

import { NEEDLES, PARTS } from "./colours.js";
import { solid } from "./solids.js";
import { frameAt, placed, vector } from "./space.js";

const MOST_MARKS = 1200;

/** A dial's scale: {body, mesh, at, front}. */
export function dialPart(scene, index) {
  const dial = scene.dials[index];
  const inner = dial.turns > 1 ? dial.inner : Math.max(dial.inner, 0.8 * dial.radius);
  const pitch = dial.turns > 1 ? (dial.radius - inner) / dial.turns : 0.14 * dial.radius;
  const face = solid(new RingGeometry(Math.max(0.05 * dial.radius, inner - pitch), dial.radius * 1.03, 72), PARTS.face);
  const scale = new LineSegments(marks(scene, index, inner, pitch), new LineBasicMaterial({ color: PARTS.mark }));
  scale.position.z = 0.004 * dial.radius;
  const mesh = placed(frameAt(dial.centre, dial.normal, dial.zero), new Group().add(face, scale));
  return { body: dial.body, mesh, at: vector(dial.centre), dial: index };
}

/** Marks between cells and the rims, as segments in the dial's frame. */
function marks(scene, index, inner, pitch) {
  const dial = scene.dials[index];
  const points = [];
  const sense = turningSense(scene, index);
  const at = (turn, radius) => [radius * Math.cos(2 * Math.PI * turn), sense * radius * Math.sin(2 * Math.PI * turn), 0];
  const out = (turn) => (dial.turns > 1 ? inner + pitch * turn : dial.radius);
  const cells = Math.min(dial.divisions || 12, MOST_MARKS);
  for (let cell = 0; cell <= cells; cell += 1) {
    const turn = (cell * dial.turns) / cells;
    const depth = cell === 0 ? 1 : cell % 5 === 0 ? 0.75 : 0.5;
    points.push(...at(turn, out(turn)), ...at(turn, out(turn) - depth * pitch));
  }
  const steps = 96 * dial.turns;
  for (let step = 0; step < steps; step += 1) {
    const [from, to] = [(step * dial.turns) / steps, ((step + 1) * dial.turns) / steps];
    for (const off of dial.turns > 1 ? [0] : [0, pitch]) points.push(...at(from, out(from) - off), ...at(to, out(to) - off));
  }
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(points, 3));
}

/** 1 where the dial's pointer moves counter-clockwise about the dial's normal while its output grows. */
function turningSense(scene, index) {
  const pointer = scene.pointers.find(({ dial }) => dial === index);
  return pointer ? -pointer.sense : -1;
}

/** A needle from the middle of its dial to the rim: {body, mesh, at, dial}. */
export function needlePart(scene, index, order, size) {
  const pointer = scene.pointers[index];
  const dial = scene.dials[pointer.dial];
  const length = dial.radius * (0.97 - 0.05 * (order % 4));
  const width = 0.022 * dial.radius;
  const height = 0.004 * size;
  const needle = solid(new BoxGeometry(length * 1.12, width, height), NEEDLES[index % NEEDLES.length]);
  needle.position.set(length * 0.44, 0, height * (1.6 + 1.4 * order));
  const at = vector(dial.centre);
  return { body: pointer.body, mesh: placed(frameAt(at, dial.normal, dial.zero), needle), at, dial: pointer.dial };
}
