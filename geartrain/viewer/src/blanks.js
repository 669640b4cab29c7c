// Wheels without their teeth: plain and spoked discs, rings, cones, crowns, lanterns and worms.

import { Curve, CylinderGeometry, TubeGeometry, Vector3 } from "three";

import { flat, quad, swept } from "./solids.js";

/** Corners that a circle is drawn with: enough for its part of the picture. */
const rounds = (radius, size) => Math.round(Math.min(144, Math.max(28, 220 * Math.sqrt(radius / size))));

const band = (inner, outer, thickness) => {
  const half = thickness / 2;
  return [[inner, -half], [outer, -half], [outer, half], [inner, half]];
};

/** A disc with a hub; with spokes if it is large beside its hub. */
export function discGeometry(radius, thickness, hub, size) {
  const count = rounds(radius, size);
  if (radius < 5.5 * hub) return flat(swept([], band(0, radius, thickness), count));
  const rim = 0.85 * radius;
  const triangles = swept([], band(rim, radius, thickness), count);
  swept(triangles, band(0, 2 * hub, thickness), 28);
  const spokes = radius > 14 * hub ? 6 : 4;
  const width = Math.max(0.8 * hub, 0.035 * radius);
  for (let n = 0; n < spokes; n += 1) spoke(triangles, (2 * Math.PI * n) / spokes, hub, rim * 1.01, width, 0.8 * thickness);
  return flat(triangles);
}

/** A bar from the hub to the rim, tapered outwards. */
function spoke(triangles, angle, from, to, width, thickness) {
  const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
  const at = (x, y, z) => [x * cosine - y * sine, x * sine + y * cosine, z];
  const ring = (z) => [at(from, -width, z), at(to, -0.7 * width, z), at(to, 0.7 * width, z), at(from, width, z)];
  const [below, above] = [ring(-thickness / 2), ring(thickness / 2)];
  quad(triangles, ...below);
  quad(triangles, ...above);
  quad(triangles, below[0], below[1], above[1], above[0]);
  quad(triangles, below[3], below[2], above[2], above[3]);
}

/** The body of a ring wheel, outside its teeth. */
export function ringGeometry(inner, outer, thickness, size) {
  return flat(swept([], band(inner, outer, thickness), rounds(outer, size)));
}

/** The body of a bevel or crown wheel: under its teeth, from the wide end to the narrow one, with a back. */
export function coneGeometry(at, base, apex, thickness, hub) {
  const [wide, narrow] = [0, 1].map((end) => at(base, 0, end));
  const behind = Math.min(wide[2] * apex, narrow[2] * apex) - 0.35 * thickness;
  const bore = 0.5 * hub;
  const outline = [[bore, apex * behind], [wide[0], apex * behind], [wide[0], wide[2]], [narrow[0], narrow[2]], [bore, narrow[2]]];
  return flat(swept([], outline, 64));
}

/** Two discs that hold the pins of a lantern. */
export function lanternGeometry(radius, thickness, hub) {
  const cheek = 0.16 * thickness;
  const triangles = [];
  for (const side of [-1, 1]) {
    const z = (side * (thickness - cheek)) / 2;
    swept(triangles, band(0, radius, cheek).map(([r, height]) => [r, height + z]), 48);
  }
  return flat(swept(triangles, band(0, hub, thickness), 24));
}

class Helix extends Curve {
  constructor(radius, lead, length, turn) {
    super();
    Object.assign(this, { radius, lead, length, turn });
  }

  getPoint(share, target = new Vector3()) {
    const z = (share - 0.5) * this.length;
    const angle = this.turn + (2 * Math.PI * z) / this.lead;
    return target.set(this.radius * Math.cos(angle), this.radius * Math.sin(angle), z);
  }
}

/** A worm: a cylinder and its threads; `lead` (mm a turn) is negative for a left hand. */
export function wormGeometries(wheel, lead, length) {
  const pitch = Math.abs(lead) / wheel.teeth;
  const core = new CylinderGeometry(wheel.radius - 0.35 * pitch, wheel.radius - 0.35 * pitch, length, 32);
  const count = Math.ceil((length / Math.abs(lead)) * 28) + 8;
  const threads = Array.from({ length: wheel.teeth }, (_, n) => {
    const helix = new Helix(wheel.radius - 0.1 * pitch, lead, length, (2 * Math.PI * n) / wheel.teeth);
    return new TubeGeometry(helix, count, 0.27 * pitch, 6);
  });
  return [core.rotateX(Math.PI / 2), ...threads];
}
