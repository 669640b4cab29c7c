// One tooth as a solid: its profile between two faces, cylindrical, tapered to an apex, or standing on a crown wheel.

import { Shape } from "./shape.js";

const FINE = 0.02; // of a tooth's depth: bends of the outline that are too slight to be drawn

/**
 * The surface a wheel's teeth are cut on: `at(rho, angle, end)`, in the wheel's frame (x, y across, z along its axis).
 *
 * rho    radius over the pitch radius; `end` 0 and 1 are its two faces, for a tapered wheel the wide and the narrow
 * apex   1 or -1: on which side of the wheel, along z, its cone runs together (or its crown's teeth stand)
 */
export function blankOf(wheel, apex) {
  const { radius, thickness, cone, helix } = wheel;
  if (!cone) {
    const twist = (thickness * Math.tan(helix)) / radius;
    return (rho, angle, end) => {
      const turned = angle + (end - 0.5) * twist;
      return [rho * radius * Math.cos(turned), rho * radius * Math.sin(turned), (end - 0.5) * thickness];
    };
  }
  const height = cone > Math.PI / 2 - 1e-6 ? 0 : (apex * radius) / Math.tan(cone);
  const slant = radius / Math.sin(cone);
  const taper = 1 - Math.min(0.45, thickness / slant);
  return (rho, angle, end) => {
    const depth = (rho - 1) * radius;
    const scale = end ? taper : 1;
    const r = (radius + depth * Math.cos(cone)) * scale;
    const z = height + (apex * depth * Math.sin(cone) - height) * scale;
    return [r * Math.cos(angle), r * Math.sin(angle), z];
  };
}

/** The tooth between its profile and `base` (over the pitch radius), on a blank. */
export function toothShape(points, base, at, fine = FINE) {
  const edge = simplify(points, fine);
  const shape = flanks(new Shape(), edge, at);
  for (const end of [0, 1]) {
    for (let n = 1; n < edge.length; n += 1) {
      const [[r0, t0], [r1, t1]] = [edge[n - 1], edge[n]];
      const corners = [at(base, t0, end), at(base, t1, end), at(r1, t1, end), at(r0, t0, end)];
      shape.face(corners, facing(corners), [t0, t1, t1, t0].map((t) => [-Math.sin(t), Math.cos(t), 0]));
    }
  }
  return shape;
}

/** A pin, or another closed curve, between two faces. */
export const pinShape = (points, at) => flanks(new Shape(), simplify([...points, points[0]]), at);

/** What lies between the two faces; edges slighter than a third of a right angle are rounded. */
function flanks(shape, edge, at) {
  const sides = edge.slice(1).map(([r1, t1], n) => {
    const [r0, t0] = edge[n];
    const corners = [at(r0, t0, 0), at(r1, t1, 0), at(r1, t1, 1), at(r0, t0, 1)];
    return { corners, normal: facing(corners) };
  });
  const joined = (a, b) => (b && dot(a, b) > 0.87 ? unit([0, 1, 2].map((k) => a[k] + b[k])) : a);
  sides.forEach(({ corners, normal }, n) => {
    const [before, after] = [joined(normal, sides[n - 1]?.normal), joined(normal, sides[n + 1]?.normal)];
    const first = shape.corners;
    const grain = unit([0, 1, 2].map((k) => corners[3][k] - corners[0][k]));
    corners.forEach((corner, k) => shape.corner(corner, k === 0 || k === 3 ? before : after, grain));
    shape.indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
  });
  return shape;
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => {
  const size = Math.hypot(...a) || 1;
  return a.map((value) => value / size);
};

/** The way four corners face. */
function facing([a, b, c, d]) {
  const [p, q] = [[0, 1, 2].map((k) => c[k] - a[k]), [0, 1, 2].map((k) => d[k] - b[k])];
  return unit([p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]);
}

/** Points kept so that no dropped one lies further off than a small part of the tooth's depth. */
export function simplify(points, fine = FINE) {
  const radii = points.map(([radius]) => radius);
  const depth = Math.max(...radii) - Math.min(...radii);
  const plane = points.map(([radius, angle]) => [radius * Math.cos(angle), radius * Math.sin(angle)]);
  const keep = new Set([0, points.length - 1]);
  const work = [[0, points.length - 1]];
  while (work.length) {
    const [first, last] = work.pop();
    let worst = fine * depth;
    let at = -1;
    for (let n = first + 1; n < last; n += 1) {
      const off = offLine(plane[n], plane[first], plane[last]);
      if (off > worst) [worst, at] = [off, n];
    }
    if (at < 0) continue;
    keep.add(at);
    work.push([first, at], [at, last]);
  }
  return points.filter((_, n) => keep.has(n));
}

function offLine([x, y], [x0, y0], [x1, y1]) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const size = Math.hypot(dx, dy);
  return size < 1e-12 ? Math.hypot(x - x0, y - y0) : Math.abs(dx * (y - y0) - dy * (x - x0)) / size;
}
