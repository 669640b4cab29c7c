// One tooth as a solid: its profile between two faces, cylindrical, tapered to an apex, or standing on a crown wheel.

import { flat, quad } from "./solids.js";

const FINE = 0.012; // of a tooth's depth: bends of the outline that are too slight to be drawn

/**
 * The surface a wheel's teeth are cut on: `at(rho, angle, end)`, in the wheel's frame (x, y across, z along its axis).
 *
 * rho    radius over the pitch radius; `end` 0 and 1 are its two faces, for a tapered wheel the wide and the narrow
 * apex   1 or -1: on which side of the wheel, along z, its cone runs together (or its crown's teeth stand)
 */
export function blankOf(wheel, apex) {
  const { radius, thickness, cone } = wheel;
  if (!cone) {
    return (rho, angle, end) => [rho * radius * Math.cos(angle), rho * radius * Math.sin(angle), (end - 0.5) * thickness];
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
export function toothGeometry(points, base, at) {
  const edge = simplify(points);
  const triangles = [];
  for (let n = 1; n < edge.length; n += 1) {
    const [[r0, t0], [r1, t1]] = [edge[n - 1], edge[n]];
    quad(triangles, at(r0, t0, 0), at(r1, t1, 0), at(r1, t1, 1), at(r0, t0, 1));
    for (const end of [0, 1]) quad(triangles, at(base, t0, end), at(base, t1, end), at(r1, t1, end), at(r0, t0, end));
  }
  return flat(triangles);
}

/** A pin, or another closed curve, between two faces. */
export function pinGeometry(points, at) {
  const edge = simplify([...points, points[0]]);
  const triangles = [];
  for (let n = 1; n < edge.length; n += 1) {
    const [[r0, t0], [r1, t1]] = [edge[n - 1], edge[n]];
    quad(triangles, at(r0, t0, 0), at(r1, t1, 0), at(r1, t1, 1), at(r0, t0, 1));
  }
  return flat(triangles);
}

/** Points kept so that no dropped one lies further off than a small part of the tooth's depth. */
export function simplify(points) {
  const radii = points.map(([radius]) => radius);
  const depth = Math.max(...radii) - Math.min(...radii);
  const plane = points.map(([radius, angle]) => [radius * Math.cos(angle), radius * Math.sin(angle)]);
  const keep = new Set([0, points.length - 1]);
  const work = [[0, points.length - 1]];
  while (work.length) {
    const [first, last] = work.pop();
    let worst = FINE * depth;
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
