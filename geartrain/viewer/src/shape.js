// Shapes: vertices with normals and brushing directions, and triangles.

const TURN = 2 * Math.PI;

/** Flat lists of numbers, three per vertex; `indices`, three per triangle. */
export class Shape {
  constructor() {
    Object.assign(this, { points: [], normals: [], grains: [], indices: [] });
  }

  get corners() {
    return this.points.length / 3;
  }

  corner(point, normal, grain) {
    this.points.push(point[0], point[1], point[2]);
    this.normals.push(normal[0], normal[1], normal[2]);
    this.grains.push(grain[0], grain[1], grain[2]);
  }

  /** Adds a flat convex face; `grain`: a brushing direction, or one for each point. */
  face(points, normal, grain) {
    const first = this.corners;
    points.forEach((point, n) => this.corner(point, normal, Array.isArray(grain[0]) ? grain[n] : grain));
    for (let n = 2; n < points.length; n += 1) this.indices.push(first, first + n - 1, first + n);
    return this;
  }
}

/** A closed outline of [radius, z] points in either sense, swept in `count` steps around the z axis, or a part of a turn. */
export function swept(shape, outline, count, first = 0, turns = 1) {
  const { points, normals, grains, indices } = shape;
  const area = outline.reduce((sum, [r, z], m) => sum + r * outline[(m + 1) % outline.length][1] - outline[(m + 1) % outline.length][0] * z, 0);
  if (area < 0) outline = outline.toReversed(); // so that it faces outwards
  outline.forEach(([r, z], m) => {
    const [r1, z1] = outline[(m + 1) % outline.length];
    const length = Math.hypot(r1 - r, z1 - z);
    if (!length || (r < 1e-12 && r1 < 1e-12)) return;
    const [outward, upward] = [(z1 - z) / length, (r - r1) / length];
    const corner = shape.corners;
    for (let n = 0; n <= count; n += 1) {
      const angle = TURN * (first + (turns * n) / count);
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      points.push(r * c, r * s, z, r1 * c, r1 * s, z1);
      normals.push(outward * c, outward * s, upward, outward * c, outward * s, upward);
      grains.push(-s, c, 0, -s, c, 0);
    }
    for (let at = corner; at < corner + 2 * count; at += 2) {
      if (r >= 1e-12) indices.push(at, at + 1, at + 2); // else its edge on the axis is a point
      if (r1 >= 1e-12) indices.push(at + 1, at + 3, at + 2);
    }
  });
  return shape;
}

/** The outline of a ring with broken edges: [radius, z] points. */
export function band(inner, outer, low, high) {
  const edge = Math.min(0.12 * (high - low), 0.25 * (outer - inner));
  return [[inner, low], [outer - edge, low], [outer, low + edge], [outer, high - edge], [outer - edge, high], [inner, high]];
}

/** A round bar along z. */
export const bar = (radius, low, high, count = 14) => swept(new Shape(), band(0, radius, low, high), count);

/** A ball round the origin. */
export const ball = (radius, count = 16) => swept(new Shape(), meridian(radius, count / 2), count);

/** Half of a ball around the origin: half a turn about z, starting at the fraction `first` of a turn from x. */
export const halfBall = (radius, first, count = 24) => swept(new Shape(), meridian(radius, count), count, first, 0.5);

const meridian = (radius, steps) =>
  Array.from({ length: steps + 1 }, (_, n) => {
    const angle = Math.PI * (n / steps - 0.5);
    return [radius * Math.max(0, Math.cos(angle)), radius * Math.sin(angle)];
  });

/**
 * A plate between two heights: `stations` are [x, half width] in order of x; brushed along x.
 */
export function plate(shape, stations, low, high, frame = (point) => point) {
  const way = (vector) => frame(vector).map((value, k) => value - frame([0, 0, 0])[k]);
  const grain = way([1, 0, 0]);
  const place = (x, y, z) => frame([x, y, z]);
  for (let n = 1; n < stations.length; n += 1) {
    const [[x0, w0], [x1, w1]] = [stations[n - 1], stations[n]];
    for (const [z, up] of [[low, -1], [high, 1]]) {
      shape.face([place(x0, -w0, z), place(x1, -w1, z), place(x1, w1, z), place(x0, w0, z)], way([0, 0, up]), grain);
    }
    for (const side of [-1, 1]) {
      const length = Math.hypot(x1 - x0, w1 - w0);
      const normal = way([(w0 - w1) / length, (side * (x1 - x0)) / length, 0]);
      shape.face([place(x0, side * w0, low), place(x1, side * w1, low), place(x1, side * w1, high), place(x0, side * w0, high)], normal, grain);
    }
  }
  for (const [[x, w], side] of [[stations[0], -1], [stations.at(-1), 1]]) {
    if (w > 1e-9) shape.face([place(x, -w, low), place(x, w, low), place(x, w, high), place(x, -w, high)], way([side, 0, 0]), grain);
  }
  return shape;
}

/** Stations of a bar from 0 to `length` with round ends of their own radii. */
export function roundEnded(length, from, to, waist) {
  const round = (radius, sign, at) => [0, 22, 45, 65, 82].map((degrees) => {
    const angle = (degrees * Math.PI) / 180;
    return [at - sign * radius * Math.cos(angle), radius * Math.sin(angle)];
  });
  const middle = [[0, from], [0.3 * from, from], [1.6 * from, waist], [length - 1.6 * to, waist], [length - 0.3 * to, to], [length, to]];
  return [...round(from, 1, 0), ...middle.filter(([x], n) => n < 2 || n > 3 || (x > 0.9 * from && x < length - 0.9 * to)), ...round(to, -1, length).reverse()];
}
