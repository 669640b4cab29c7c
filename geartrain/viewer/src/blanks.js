// Wheels without their teeth: plain discs and wheels with arms, rings, cones, crowns, lanterns and worms.

import { band, plate, Shape, swept } from "./shape.js";

/** Number of vertices of a circle, according to its radius relative to the size of the train. */
const rounds = (radius, size) => Math.round(Math.min(84, Math.max(18, 125 * Math.sqrt(radius / size))));

/** Inner radius of the rim of a disc, and radius of its boss, 0 without space for arms; `depth`, height of its teeth (mm). */
export function webOf(radius, hub, depth) {
  const [rim, boss] = [radius - Math.max(1.3 * depth, 0.09 * radius), Math.max(1.9 * hub, 0.09 * radius)];
  return rim < 2.1 * boss ? { rim: 0.9 * hub, boss: 0 } : { rim, boss };
}

/** The boss and the arms of a disc within its rim. */
export function armsShape(radius, thickness, { rim, boss }) {
  const [shape, half] = [new Shape(), thickness / 2];
  if (!boss) return shape;
  swept(shape, band(0, boss, -1.15 * half, 1.15 * half), 18);
  const arms = rim < 5 * boss ? 4 : rim < 9 * boss ? 5 : 6;
  const width = Math.max(0.42 * boss, 0.03 * radius);
  for (let n = 0; n < arms; n += 1) arm(shape, (2 * Math.PI * n) / arms, 0.9 * boss, 1.005 * rim, width, 0.78 * half);
  return shape;
}

/** An arm of a wheel, from its hub to its rim: narrower outwards, with fillets at both ends. */
function arm(shape, angle, from, to, width, half) {
  const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
  const flare = [[0, 1.75], [0.07, 1.25], [0.18, 1], [0.8, 0.72], [0.93, 0.95], [1, 1.5]];
  const stations = flare.map(([share, wide]) => [from + share * (to - from), wide * width]);
  plate(shape, stations, -half, half, ([x, y, z]) => [x * cosine - y * sine, x * sine + y * cosine, z]);
}

/** A plain rim between two radii, which replaces the teeth. */
export function plainRimShape(inner, outer, thickness, size) {
  const half = thickness / 2;
  return swept(new Shape(), [[inner, -half], [outer, -half], [outer, half], [inner, half]], rounds(outer, size));
}

/** The body of a bevel or crown wheel below its teeth, from the wide end to the narrow end, with a back. */
export function coneShape(at, base, apex, thickness, hub) {
  const [wide, narrow] = [0, 1].map((end) => at(base, 0, end));
  const behind = Math.min(wide[2] * apex, narrow[2] * apex) - 0.35 * thickness;
  const bore = 0.5 * hub;
  return swept(new Shape(), [[bore, apex * behind], [wide[0], apex * behind], [wide[0], wide[2]], [narrow[0], narrow[2]], [bore, narrow[2]]], 72);
}

/** Two discs that hold the pins of a lantern, and the drum between them. */
export function lanternShape(radius, thickness, hub) {
  const [shape, cheek, half] = [new Shape(), 0.16 * thickness, thickness / 2];
  swept(shape, band(0, radius, -half, cheek - half), 48);
  swept(shape, band(0, radius, half - cheek, half), 48);
  return swept(shape, band(0, hub, -half, half), 24);
}

/** A worm: a cylinder and its threads; `lead` (mm a turn) is negative for a left hand. */
export function wormShape(wheel, lead, length) {
  const pitch = Math.abs(lead) / Math.max(1, wheel.teeth);
  const core = wheel.radius - 0.5 * pitch;
  const shape = swept(new Shape(), band(0, Math.max(core, 0.3 * wheel.radius), -length / 2, length / 2), 32);
  for (let n = 0; n < wheel.teeth; n += 1) thread(shape, wheel.radius, pitch, lead, length, (2 * Math.PI * n) / wheel.teeth);
  return shape;
}

/** One thread: a trapezium of a third of the pitch, wound along the worm. */
function thread(shape, radius, pitch, lead, length, turn) {
  const profile = [[-0.55, -0.36], [0.32, -0.13], [0.32, 0.13], [-0.55, 0.36]]; // [radial, axial] coordinates divided by the pitch
  const steps = Math.ceil((length / Math.abs(lead)) * 32) + 4;
  const across = Math.sqrt(0.87 ** 2 + 0.23 ** 2);
  const facing = [[0.23 / across, -0.87 / across], [1, 0], [0.23 / across, 0.87 / across]];
  facing.forEach(([outward, upward], k) => {
    const first = shape.corners;
    for (let n = 0; n <= steps; n += 1) {
      const z = length * (n / steps - 0.5);
      const angle = turn + (2 * Math.PI * z) / lead;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const run = Math.min(1, (length / 2 - Math.abs(z)) / (0.7 * pitch)); // the thread fades out at both ends
      for (const [out, on] of [profile[k], profile[k + 1]]) {
        const r = radius + (run * (out + 0.55) - 0.55) * pitch;
        shape.corner([r * c, r * s, Math.max(-length / 2, Math.min(length / 2, z + on * pitch))], [outward * c, outward * s, upward], [-s, c, 0]);
      }
    }
    for (let n = 0; n < steps; n += 1) shape.indices.push(...[0, 1, 2, 1, 3, 2].map((at) => first + 2 * n + at));
  });
}
