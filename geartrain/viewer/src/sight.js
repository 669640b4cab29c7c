// Occlusion of wheels, and their visibility.

import { Ray } from "three";

import { discsOf, rimOf } from "./extent.js";
import { across, endsOf, frameAt, vector } from "./space.js";

const ROUND = 8; // points of each circle
const CIRCLES = [0.25, 0.6, 0.95]; // of a wheel from its middle, or the inside of a ring, to its rim
const COVERED = 0.04; // of a wheel's points: before so many no pillar stands but one of glass

/** Points evenly over a disc, or a ring. */
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

/** The line of a turned part from end to end, and its radius: {from, to, radius}. */
export function barOf(part) {
  const [from, to] = endsOf(part);
  return { from, to, radius: Math.max(...part.bands.map(([, , radius]) => radius)) };
}

/** A flat part as it is seen: its edge, as x and y by turns, in its own frame. */
export const paneOf = ({ place, direction, across: x, outlines }) => ({ inverse: frameAt(place, direction, x).invert(), outline: outlines[0] });

/** Whether an edge of x and y by turns goes round a point. */
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

  /** Whether a bar hides much of a wheel in any position. */
  isCovering({ from, to, radius }, eye) {
    const ray = new Ray(eye.clone());
    const on = eye.clone();
    const isBehind = (point) => {
      ray.direction.copy(point).sub(eye).normalize();
      return ray.distanceSqToSegment(from, to, on) < radius * radius && on.distanceToSquared(eye) < point.distanceToSquared(eye);
    };
    return this.swept.some((points) => points.filter(isBehind).length > COVERED * points.length);
  }

  /** The share of the wheels, in their initial positions, that a flat part hides. */
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
   * How well an eye sees wheels as they stand at the beginning, 0 to 1: the mean root of the share that it sees of each, as
   * each is turned away and stands behind others; a root, so that the worst seen weigh.
   */
  seen(eye) {
    const [way, hit] = [eye.clone(), eye.clone()];
    const before = (point, own) => this.wheels.some((wheel) => wheel !== own && meets(wheel, eye, way.copy(point).sub(eye), hit));
    const parts = this.wheels.map((wheel) => {
      const off = eye.clone().sub(wheel.at);
      const cosine = off.dot(vector(wheel.direction)) / off.length();
      const facing = wheel.isWorm ? Math.sqrt(1 - cosine * cosine) : Math.abs(cosine); // its thread is seen from the side
      const share = wheel.points.filter((point) => !before(point, wheel) && !this.walls.some((wall) => goesThrough(wall, eye, point))).length / wheel.points.length;
      return Math.sqrt(facing * share);
    });
    return parts.reduce((sum, part) => sum + part, 0) / parts.length;
  }
}

/** Whether the way from an eye to a point goes through the wall of a cup. */
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

/** Whether a disc is met on the way from an eye. */
function meets({ at, direction, radius, inner }, eye, way, hit) {
  const normal = vector(direction);
  const share = normal.dot(hit.copy(at).sub(eye)) / normal.dot(way);
  if (!(share > 0 && share < 1 - 1e-6)) return false;
  const off = hit.copy(eye).addScaledVector(way, share).distanceTo(at);
  return inner < off && off < radius;
}
