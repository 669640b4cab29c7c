// A quarter cut out of rings, drums and plates, as in cutaway models, for trains whose rings hide their stages. Parts are
// unchanged: only their portion in the quarter is not drawn, and section faces are drawn instead.

import { isParallel, offAxis, vector } from "./space.js";

const OPENED = ["frame", "carrier", "wall", "drum", "post", "pillar", "foot"]; // kinds of parts that are cut; arbors, studs and wheels within rings stay whole
const LEVEL = 1e-3; // relative to the train's size: rings closer than this along their axis are in one stage

/** True if a part of a built train is cut; pins are cut if they are fixed in a ring. */
export const isOpened = (scene, { kind, body }) =>
  OPENED.includes(kind) || (kind === "pin" && scene.wheels.some((wheel) => wheel.body === body && wheel.kind === "ring"));

/**
 * The quarter that is cut out: its edge passes through `at` along the axis of most rings, and its sides extend along `right`
 * and `up`, as seen from the front; null for a train without rings. `hides` is true if rings hide each other.
 */
export function quarterOf(scene, size) {
  const rings = scene.wheels.filter(({ kind }) => kind === "ring");
  const axes = rings.map(({ body }) => scene.bodies[body]);
  const shared = axes.map((axis) => rings.filter((_, n) => isParallel(axis.direction, axes[n].direction) && offAxis(axis, axes[n].point) < LEVEL * size));
  const [most] = shared.toSorted((one, other) => other.length - one.length);
  if (!most) return null;
  const { point, direction } = scene.bodies[most[0].body];
  const towards = vector(direction).multiplyScalar(scene.front * Math.sign(direction[2] || 1));
  const seen = isParallel(direction, [0, 1, 0]) ? vector([0, 0, -1]) : vector([0, 1, 0]);
  const up = seen.addScaledVector(towards, -seen.dot(towards)).normalize();
  const heights = most.map(({ centre }) => vector(centre).dot(towards));
  const hides = Math.max(...heights) - Math.min(...heights) > LEVEL * size;
  return { at: vector(point), up, right: up.clone().cross(towards), hides };
}

/** Whether a point of space lies in a quarter. */
export function holds({ at, right, up }, point) {
  const off = point.clone().sub(at);
  return off.dot(right) > 0 && off.dot(up) > 0;
}
