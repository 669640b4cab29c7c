// Occlusion of wheels, and their visibility.

import { Ray } from "three";

import { discsOf, rimOf } from "./extent.js";
import { across, endsOf, frameAt, vector } from "./space.js";

const ROUND = 8; // points of each circle
const CIRCLES = [0.25, 0.6, 0.95]; // relative radii from the middle of a wheel, or the inside of a ring, to its rim
const COVERED = 0.04; // fraction of a wheel's points: a pillar that hides more is transparent

/** Points distributed evenly over a disc or a ring. */
function pointsOver({ at, direction, radius, inner = 0 }) {
  const [one, way] = [across(direction), vector(direction)];
  const other = way.clone().cross(one);
  return CIRCLES.flatMap((share) => {
    const reach = inner + share * (radius - inner);
    return Array.from({ length: ROUND }, (_, n) => {
      const angle = (2 * Math.PI * (n + share)) / ROUND;
      return at.clone().addScaledVector(one, reach * Math.cos(angle)).addScaledVector(other, reach * Math.sin(angle));
    });
  });
}

/** Ends of the axis of a turned part, and its radius: {from, to, radius}. */
export function barOf(part) {
  const [from, to] = endsOf(part);
  return { from, to, radius: Math.max(...part.bands.map(([, , radius]) => radius)) };
}

/** A flat part as an obstacle: its edge, as alternating x and y, in its own frame. */
export const paneOf = ({ place, direction, across: x, outlines }) => ({ inverse: frameAt(place, direction, x).invert(), outline: outlines[0] });

/** True if a point is inside an edge of alternating x and y. */
function isInside(outline, x, y) {
  let inside = false;
  for (let n = 0, before = outline.length - 2; n < outline.length; before = n, n += 2) {
    const [x0, y0, x1, y1] = [outline[before], outline[before + 1], outline[n], outline[n + 1]];
    if (y0 > y !== y1 > y && x < x0 + ((y - y0) / (y1 - y0)) * (x1 - x0)) inside = !inside;
  }
  return inside;
}

export class Sight {
  constructor(scene) {
    this.wheels = scene.wheels.map((wheel) => {
      const disc = { at: vector(wheel.centre), direction: wheel.direction, radius: rimOf(wheel), inner: wheel.kind === "ring" ? wheel.radius : 0 };
      return { ...disc, isWorm: wheel.kind === "worm", points: pointsOver(disc) };
    });
    this.walls = scene.parts.filter(({ kind }) => kind === "wall").map(barOf);
    this.points = this.wheels.flatMap(({ points }) => points);
    this.swept = scene.wheels.flatMap((wheel, n) => discsOf(scene, wheel).map((disc) => pointsOver({ ...disc, inner: this.wheels[n].inner })));
  }

  /** True if a bar hides a large part of a wheel in any position of the wheel. */
  isCovering({ from, to, radius }, eye) {
    const ray = new Ray(eye.clone());
    const on = eye.clone();
    const isBehind = (point) => {
      ray.direction.copy(point).sub(eye).normalize();
      return ray.distanceSqToSegment(from, to, on) < radius * radius && on.distanceToSquared(eye) < point.distanceToSquared(eye);
    };
    return this.swept.some((points) => points.filter(isBehind).length > COVERED * points.length);
  }

  /** The fraction of the wheels, in their initial positions, that a flat part hides. */
  hidden({ inverse, outline }, eye) {
    const from = eye.clone().applyMatrix4(inverse);
    const to = eye.clone();
    const isBehind = (point) => {
      to.copy(point).applyMatrix4(inverse);
      const share = from.z / (from.z - to.z);
      return share > 0 && share < 1 && isInside(outline, from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
    };
    return this.points.filter(isBehind).length / this.points.length;
  }

  /**
   * Visibility of the wheels in their initial positions from an eye point, 0 to 1: mean square root of the visible fraction
   * of each wheel, reduced by obliquity and by wheels in front; the root gives weight to wheels that are hardly visible.
   */
  seen(eye) {
    const [way, hit] = [eye.clone(), eye.clone()];
    const before = (point, own) => this.wheels.some((wheel) => wheel !== own && meets(wheel, eye, way.copy(point).sub(eye), hit));
    const parts = this.wheels.map((wheel) => {
      const off = eye.clone().sub(wheel.at);
      const cosine = off.dot(vector(wheel.direction)) / off.length();
      const facing = wheel.isWorm ? Math.sqrt(1 - cosine * cosine) : Math.abs(cosine); // the thread of a worm is seen from the side
      const share = wheel.points.filter((point) => !before(point, wheel) && !this.walls.some((wall) => goesThrough(wall, eye, point))).length / wheel.points.length;
      return Math.sqrt(facing * share);
    });
    return parts.reduce((sum, part) => sum + part, 0) / parts.length;
  }
}

/** True if the line from an eye point to a point passes through the wall of a cup. */
function goesThrough({ from, to, radius }, eye, point) {
  const axis = to.clone().sub(from);
  const long = axis.length();
  axis.divideScalar(long);
  const parted = (vector) => [vector.dot(axis), vector.clone().addScaledVector(axis, -vector.dot(axis))];
  const [[low, off], [rise, way]] = [eye.clone().sub(from), point.clone().sub(eye)].map(parted);
  const [a, b, c] = [way.dot(way), way.dot(off), off.dot(off) - radius * radius];
  const root = Math.sqrt(b * b - a * c);
  return [(-b - root) / a, (-b + root) / a].some((share) => share > 0 && share < 1 && low + share * rise > 0 && low + share * rise < long);
}

/** True if a ray from an eye point meets a disc. */
function meets({ at, direction, radius, inner }, eye, way, hit) {
  const normal = vector(direction);
  const share = normal.dot(hit.copy(at).sub(eye)) / normal.dot(way);
  if (!(share > 0 && share < 1 - 1e-6)) return false;
  const off = hit.copy(eye).addScaledVector(way, share).distanceTo(at);
  return inner < off && off < radius;
}
