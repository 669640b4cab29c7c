// Positions of the sky at a date, and a scene whose pointers are set to them; mean elements are part of the scene.

import { Fraction } from "./fraction.js";

const TURN = 2 * Math.PI;
const CENTURY = 36525; // days
const rad = (degrees) => (degrees * Math.PI) / 180;

/** Julian centuries of Terrestrial Time since J2000.0 of a Julian day in Universal Time, as in geartrain/train/sky.py. */
export function centuries(day) {
  const t = (Number(day) - 2385800.5) / CENTURY;
  return (Number(day) + (32 * t * t - 20) / 86400 - 2451545) / CENTURY;
}

const valueOf = (polynomial, T) => polynomial.reduceRight((sum, each) => sum * T + each, 0);

/** Current Julian day, exact to a millisecond. */
export const today = () => new Fraction(BigInt(Date.now()), 86400000n).plus(new Fraction(4881175n, 2n));

/** Longitude of a body on a Julian day, in degrees from the mean equinox of the date: true and geocentric, for the Moon's node mean. */
export function longitude(elements, body, day) {
  const T = centuries(day);
  if (body === "moon_node") return valueOf(elements.moon.node, T);
  if (body === "moon") return moon(elements, T);
  const [x, y] = place(elements.earth, T);
  const [u, v] = body === "sun" ? [0, 0] : place(elements[body], T);
  return (Math.atan2(v - y, u - x) * 360) / TURN;
}

/** Heliocentric position in the ecliptic from an orbit without inclination, by Kepler's equation. */
function place(orbit, T) {
  const [L, perihelion, e, a] = ["longitude", "perihelion", "eccentricity", "distance"].map((each) => valueOf(orbit[each], T));
  const M = rad((L - perihelion) % 360);
  let E = M;
  for (let round = 0; round < 20; round += 1) E -= (E - e * Math.sin(E) - M) / (1 - e * Math.cos(E));
  const [x, y] = [a * (Math.cos(E) - e), a * Math.sqrt(1 - e * e) * Math.sin(E)];
  const [c, s] = [Math.cos(rad(perihelion)), Math.sin(rad(perihelion))];
  return [c * x - s * y, s * x + c * y];
}

/** The Moon with the largest six terms of J. Meeus, Astronomical Algorithms, 1998, table 47.A; the rest is below 0.3 degrees. */
function moon({ moon: own, earth }, T) {
  const L = valueOf(own.longitude, T);
  const [M, D, m, F] = [
    L - valueOf(own.perigee, T),
    L - valueOf(earth.longitude, T) - 180,
    valueOf(earth.longitude, T) - valueOf(earth.perihelion, T),
    L - valueOf(own.node, T),
  ];
  const terms = [[6.288774, M], [1.274027, 2 * D - M], [0.658314, 2 * D], [0.213618, 2 * M], [-0.185116, m], [-0.114332, 2 * F]];
  return terms.reduce((sum, [size, angle]) => sum + size * Math.sin(rad(angle)), L);
}

/** Turns of the driving link on a Julian day. */
export const turnsOn = ({ epoch }, day) => Fraction.of(epoch.turns).plus(day.minus(epoch.julian_day).over(epoch.days));

/** Turns of the driving link at which the pointers were last set; at 0 turns all are at the start of their scales. */
export const turnsWhenSet = (scene) => (scene.epoch?.settings.length ? turnsOn(scene, scene.epoch.day ?? Fraction.of(scene.epoch.julian_day)) : Fraction.of(0));

/**
 * The scene with its pointers and pins set to the sky on a Julian day; `epoch.day` is that day. Wheels are turned on their
 * arbors so that their teeth stay in mesh.
 */
export function setTo(scene, day) {
  const start = starts(scene, day);
  const moved = scene.bodies.map((body, at) => body.sense * (start[at] - body.start));
  const about = (body, carrier) => moved[body] - moved[carrier];
  const phased = (movement) => movement && { ...movement, sources: movement.sources.map((source) => phase(scene, source, about)) };
  return {
    ...scene,
    epoch: { ...scene.epoch, day },
    bodies: scene.bodies.map((body, at) => ({ ...body, start: start[at] })),
    wheels: scene.wheels.map((wheel, at) => remounted(scene, wheel, at, about)),
    couplings: scene.couplings.map((each) => ({ ...each, slot_turn: (each.slot_turn ?? 0) + slotTurned(each, about) })),
    movement: phased(scene.movement),
    back: phased(scene.back),
  };
}

/** Angles of the bodies at 0 turns (rad) at which the settings hold on a Julian day. */
function starts(scene, day) {
  const [T, turns] = [centuries(day), turnsOn(scene, day)];
  const start = scene.bodies.map((body) => body.start);
  for (const { pointer, sense, angle } of scene.epoch.settings) {
    const { body, base, speed, dial } = scene.pointers[pointer];
    const made = Fraction.of(speed ?? "0").times(turns);
    const coils = BigInt(dial === null ? 1 : scene.dials[dial].scale.turns);
    const turned = Number(made.floor % coils) + made.part;
    start[body] = TURN * (((sense * valueOf(angle, T)) / 360 - turned) % Number(coils)) + scene.bodies[body].sense * scene.bodies[base].sense * start[base];
  }
  for (const { kind, pin, slot } of scene.couplings) {
    const own = scene.epoch.settings.some(({ pointer }) => scene.pointers[pointer].body === slot);
    if (kind === "pin_and_slot" && !own) start[slot] += scene.bodies[slot].sense * scene.bodies[pin].sense * (start[pin] - scene.bodies[pin].start);
  }
  return start;
}

/** The source of an error with its driver turned; teeth keep their phase, because their wheels are remounted. */
function phase(scene, source, about) {
  const pins = scene.couplings.find(({ id }) => id === source.pair);
  if (!pins) return source;
  const driver = source.bodies.includes(pins.slot) ? pins.pin : pins.slot;
  const [own, base] = [driver, pins.carrier].map((at) => scene.bodies[at].sense * Number(Fraction.of(scene.bodies[at].speed ?? 0)));
  const forward = (own < base ? -1 : 1) * Math.sign(Number(Fraction.of(scene.step)));
  return { ...source, start: source.start + forward * about(driver, pins.carrier) };
}

/** Angle by which a slot is turned on its link, so that it stays at its pin. */
const slotTurned = ({ kind, pin, slot, carrier }, about) => (kind === "pin_follower" ? 0 : about(pin, carrier)) - about(slot, carrier);

/** The wheel turned back on its arbor by the angle by which the arbor was turned; a slot in it stays at its pin. */
function remounted(scene, wheel, index, about) {
  const pair = scene.pairs.find(({ wheels }) => wheels.includes(index));
  const pins = scene.couplings.find(({ slot }) => slot === wheel.body);
  const turned = pair ? -about(wheel.body, pair.carrier) : 0;
  const angle = pins && wheel.holes.length ? slotTurned(pins, about) - turned : 0;
  return { ...wheel, turn: wheel.turn + turned, holes: angle ? wheel.holes.map((outline) => rotated(outline, angle)) : wheel.holes };
}

const rotated = (outline, angle) =>
  outline.map((value, n) => (n % 2 ? Math.sin(angle) * outline[n - 1] + Math.cos(angle) * value : Math.cos(angle) * value - Math.sin(angle) * outline[n + 1]));
