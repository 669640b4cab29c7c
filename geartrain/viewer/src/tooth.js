// One tooth as a solid: its profile between two faces, cylindrical, tapered to an apex, or standing on a crown wheel.

import { ShapeUtils, Vector2 } from "three";

import { Shape } from "./shape.js";

const TURN = 2 * Math.PI;
const PROUD = 0.02; // relative to a lantern's thickness: ends of pins protrude, because coplanar faces flicker
const ROUND = 72; // minimum number of vertices of a circle
const FINE = 0.02; // relative to a tooth's height: smaller deviations of the outline are not drawn

/**
 * The surface of a wheel's teeth: `at(rho, angle, end)`, a point in the frame of the wheel (z along its axis).
 *
 * rho    radius divided by the pitch radius; `end`: 0 and 1 for the two faces, the wide and narrow end of a tapered wheel
 * apex   side of the wheel along z, 1 or -1, on which its cone has its apex (or a crown wheel has its teeth)
 */
export function blankOf(wheel, apex) {
  const { radius, thickness, cone, helix, teeth } = wheel;
  if (!cone) {
    const twist = (thickness * Math.tan(helix)) / radius;
    return (rho, angle, end) => {
      const turned = angle + (end - 0.5) * twist;
      return [rho * radius * Math.cos(turned), rho * radius * Math.sin(turned), (end - 0.5) * thickness];
    };
  }
  const crown = cone > Math.PI / 2 - 1e-6;
  const height = crown ? 0 : (apex * radius) / Math.tan(cone);
  const slant = radius / Math.sin(cone);
  const half = Math.PI / teeth;
  const aslant = Math.sqrt(thickness / radius); // angle over which a crown wheel's teeth are near its mate
  const taper = 1 - Math.min(0.45, thickness / slant);
  return (rho, angle, end) => {
    const depth = (rho - 1) * radius;
    const scale = end ? taper : 1;
    // the mate's teeth have constant width and are oblique away from the middle, so the spaces of a crown widen inwards
    const space = half - Math.abs(angle) + aslant - Math.sin(aslant) + ((1 - scale) * aslant) / 2;
    const turned = crown ? Math.sign(angle) * Math.max(0, half - space / scale) : angle;
    const r = (radius + depth * Math.cos(cone)) * scale;
    const z = height + (apex * depth * Math.sin(cone) - height) * scale;
    return [r * Math.cos(turned), r * Math.sin(turned), z];
  };
}

/**
 * A sector of a wheel: a tooth between its profile and a wall at the relative radius `base`. All sectors together are a
 * closed surface, because each shares its vertices with the next.
 *
 * hand    -1 for a mirrored blank
 * walled  the chamfer of the wall, relative to the thickness; null without a wall
 */
export function toothShape(points, base, at, fine = FINE, { hand = 1, walled = null } = {}) {
  const ring = base > Math.max(...points.map(([radius]) => radius));
  const side = ring ? -1 : 1; // the material of a ring is on the other side of its outline
  const edge = simplify(points, fine, side);
  const way = side * hand;
  const shape = flanks(new Shape(), edge, at, way);
  const arc = arcOf(edge[0][1], edge.at(-1)[1]);
  const chamfer = walled && (walled * Math.hypot(...minus(at(1, 0, 1), at(1, 0, 0)))) / Math.hypot(...at(1, 0, 0.5));
  const face = [...arc.map((t) => [base - chamfer, t]).reverse(), ...edge];
  const triangles = ShapeUtils.triangulateShape(face.map(([r, t]) => new Vector2(r * Math.cos(t), r * Math.sin(t))), []);
  for (const end of [0, 1]) {
    const first = shape.corners;
    const normal = facing([face[arc.length - 1], face[0], face.at(-1), face[arc.length]].map(([r, t]) => at(r, t, end)), end ? -way : way);
    for (const [r, t] of face) shape.corner(at(r, t, end), normal, tangent(t));
    for (const [a, b, c] of triangles) shape.indices.push(first + a, first + b, first + c);
  }
  if (walled === null) return shape;
  const profile = chamfer ? [[base - chamfer, 0], [base, walled], [base, 1 - walled], [base - chamfer, 1]] : [[base, 0], [base, 1]];
  for (let n = 1; n < profile.length; n += 1) {
    for (let k = 1; k < arc.length; k += 1) {
      const [turns, [low, high]] = [[arc[k - 1], arc[k]], [profile[n - 1], profile[n]]];
      const corners = [...turns.map((t) => at(low[0], t, low[1])), ...turns.toReversed().map((t) => at(high[0], t, high[1]))];
      shape.face(corners, facing(corners, -way), [...turns, ...turns.toReversed()].map(tangent));
    }
  }
  return shape;
}

/** Angles from one to another, in steps of at most a `ROUND`-th of a turn. */
export function arcOf(from, to) {
  const steps = Math.max(1, Math.ceil((ROUND * (to - from)) / TURN - 1e-6));
  return Array.from({ length: steps + 1 }, (_, n) => from + (n / steps) * (to - from));
}

const tangent = (t) => [-Math.sin(t), Math.cos(t), 0];
const minus = (a, b) => a.map((value, k) => value - b[k]);

/** A pin, or a solid with another closed section, whose ends extend beyond the two faces. */
export function pinShape(points, at) {
  const through = (rho, angle, end) => at(rho, angle, end ? 1 + PROUD : -PROUD);
  const edge = simplify([...points, points[0]]);
  const shape = flanks(new Shape(), edge, through);
  for (const end of [0, 1]) shape.face(edge.slice(1).map(([rho, angle]) => through(rho, angle, end)), [0, 0, end ? 1 : -1], [1, 0, 0]);
  return shape;
}

/** The surface between the two faces; edges of less than 30 degrees are shaded smoothly. */
function flanks(shape, edge, at, side = 1) {
  const sides = edge.slice(1).map(([r1, t1], n) => {
    const [r0, t0] = edge[n];
    const corners = [at(r0, t0, 0), at(r1, t1, 0), at(r1, t1, 1), at(r0, t0, 1)];
    return { corners, normal: facing(corners, side) };
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

/** The unit normal of four vertices, or its opposite. */
function facing([a, b, c, d], way = 1) {
  const [p, q] = [[0, 1, 2].map((k) => c[k] - a[k]), [0, 1, 2].map((k) => d[k] - b[k])];
  return unit([p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]].map((part) => way * part));
}

/**
 * An outline with fewer vertices. It is nowhere outside the tooth: a chord across a concave part is moved inwards until it
 * touches the curve, so that drawn teeth overlap no more than the real teeth do.
 *
 * side   1 if the wheel is to the left of its outline, as for a disc; -1 for a ring
 */
export function simplify(points, fine = FINE, side = 1) {
  const radii = points.map(([radius]) => radius);
  const slight = fine * (Math.max(...radii) - Math.min(...radii));
  const plane = points.map(([radius, angle]) => [radius * Math.cos(angle), radius * Math.sin(angle)]);
  const lines = chords(plane, slight).map(([first, last]) => movedIn(plane, first, last, side));
  const border = (at, angle) => ({ from: at, to: at, way: [Math.cos(angle), Math.sin(angle)], in: [0, 0] });
  const all = [border(plane[0], points[0][1]), ...lines, border(plane.at(-1), points.at(-1)[1])];
  let before = points[0][1];
  return all.slice(1).flatMap((line, n) =>
    meeting(all[n], line, slight).map(([x, y]) => {
      const angle = Math.atan2(y, x);
      before = angle + TURN * Math.round((before - angle) / TURN);
      return [Math.hypot(x, y), before];
    }),
  );
}

/** First and last point of each run of points that deviates from its chord by at most `slight`. */
function chords(plane, slight, first = 0, last = plane.length - 1) {
  let [worst, at] = [slight, -1];
  for (let n = first + 1; n < last; n += 1) {
    const off = offLine(plane[n], plane[first], plane[last]);
    if (off > worst) [worst, at] = [off, n];
  }
  return at < 0 ? [[first, last]] : [...chords(plane, slight, first, at), ...chords(plane, slight, at, last)];
}

/** The chord of a run, and the distance (`in`) by which it must be moved into the tooth so that no point of the run is inside. */
function movedIn(plane, first, last, side) {
  const [from, to] = [plane[first], plane[last]];
  const way = unit([to[0] - from[0], to[1] - from[1]]);
  const inward = [-side * way[1], side * way[0]];
  const off = (point) => (point[0] - from[0]) * inward[0] + (point[1] - from[1]) * inward[1];
  const most = Math.max(0, ...plane.slice(first + 1, last).map(off));
  return { from, to, way, in: inward.map((part) => part * most) };
}

/** Intersection of a line and the next one, both moved inwards; two points if the intersection is far away. */
function meeting(line, next, slight) {
  const [one, other] = [line.to, next.from].map((point, n) => add(point, [line, next][n].in));
  const turn = line.way[0] * next.way[1] - line.way[1] * next.way[0];
  const along = ((other[0] - one[0]) * next.way[1] - (other[1] - one[1]) * next.way[0]) / turn;
  if (Math.abs(along) <= 4 * slight) return [add(one, line.way.map((part) => part * along))];
  return Math.hypot(other[0] - one[0], other[1] - one[1]) > 1e-9 ? [one, other] : [one];
}

const add = (a, b) => a.map((part, k) => part + b[k]);

function offLine([x, y], [x0, y0], [x1, y1]) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const size = Math.hypot(dx, dy);
  return size < 1e-12 ? Math.hypot(x - x0, y - y0) : Math.abs(dx * (y - y0) - dy * (x - x0)) / size;
}
