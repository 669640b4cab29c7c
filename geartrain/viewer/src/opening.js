// What a page shows first: a sentence on the purpose of the train, a position in which its pointers are apart, and a pace.

import { Fraction } from "./fraction.js";

const [TRIED, PART] = [400, new Fraction(1n, 8n)]; // positions that are compared, in parts of a unit of the input
const LISTED = 8; // maximum number of outputs in a sentence
const [SLOWEST, FASTEST] = [0.001, 0.1]; // turns of the driving link per second
const POINTER = 0.15; // turns of the fastest pointer per second

/** Turns of a pointer for one turn of the driving link, clockwise as read. */
const speedOf = ({ speed, sense }) => sense * Number(Fraction.parse(speed) ?? 0);

/** Turns of the driving link per second at which the eye can follow the fastest pointer. */
export function pace(scene) {
  return Math.min(FASTEST, Math.max(SLOWEST, POINTER / Math.max(1, ...scene.pointers.map((each) => Math.abs(speedOf(each))))));
}

/** The smallest part of a turn between hands [speed, start in turns], or between a hand and the zero mark, over that of hands at equal distances. */
function apart(hands, turns) {
  const places = [0, 1, ...hands.map(([speed, start]) => (((speed * turns + start) % 1) + 1) % 1)].sort((one, other) => one - other);
  return Math.min(...places.slice(1).map((place, n) => place - places[n])) * (hands.length + 1);
}

/** Turns of the driving link at which the hands of each dial are apart from one another; all outputs if there are no dials. */
export function momentOf(scene) {
  if (scene.run || scene.driving_link === null) return Fraction.of(0);
  const groups = scene.dials.length ? scene.dials.map((_, at) => scene.pointers.filter(({ dial }) => dial === at)) : [scene.pointers];
  const startOf = ({ body, base, sense }) => (sense * (scene.bodies[body].start - scene.bodies[base].start)) / (2 * Math.PI);
  const handsOf = (group) => [...new Map(group.filter(speedOf).map((each) => [speedOf(each), [speedOf(each), startOf(each)]])).values()];
  const hands = groups.map(handsOf).filter(({ length }) => length);
  const step = Fraction.of(scene.step).times(PART);
  const size = Math.abs(Number(step));
  const score = (n) => hands.reduce((sum, group) => sum + apart(group, n * size), 0);
  let [best, most] = [0, 0];
  for (let n = 1; n <= TRIED; n += 1) if (score(n) > most + 1e-9) [best, most] = [n, score(n)];
  return step.times(best);
}

/** The first sentence of the train's note; without a note, what drives which outputs. */
export function purposeOf({ note, bodies, driving_link: lead, pointers, dials, asks }) {
  if (note) return /^.+?\.(?=\s+[A-Z0-9(]|\s*$)/s.exec(note)?.[0] ?? note;
  if (lead === null || !asks) return "";
  const read = pointers.filter(({ dial }) => !dials.length || dial !== null).map(({ output }) => output);
  const more = read.length > LISTED ? ` and ${read.length - LISTED} more` : "";
  const names = `${read.slice(0, LISTED).join(", ")}${more}`;
  return dials.length ? `${bodies[lead].id} moves the hands of ${names}.` : `${bodies[lead].id} drives ${names}.`;
}
