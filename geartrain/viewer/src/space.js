// Lines and frames: geometry that all parts share.

import { Matrix4, Vector3 } from "three";

export const vector = (values) => new Vector3(...values);

/** The matrix of the frame with z axis `direction` and x axis `across`, rotated by `turn` (rad) about z, with origin `centre`. */
export function frameAt(centre, direction, across, turn = 0) {
  const z = vector(direction).normalize();
  const x = vector(across).addScaledVector(z, -z.dot(vector(across))).normalize();
  const y = z.clone().cross(x);
  const matrix = new Matrix4().makeBasis(x, y, z).multiply(new Matrix4().makeRotationZ(turn));
  return matrix.setPosition(vector(centre));
}

/** Ends of the axis of a turned part. */
export const endsOf = ({ place, direction, bands }) => [bands[0][0], bands.at(-1)[1]].map((end) => vector(place).addScaledVector(vector(direction), end));

/** An arbitrary unit vector perpendicular to a direction. */
export function across(direction) {
  const z = vector(direction);
  const helper = Math.abs(z.x) < 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
  return helper.addScaledVector(z, -z.dot(helper)).normalize();
}

/** The point of a line (through `point` along `direction`) that is nearest to another line. */
export function foot(point, direction, otherPoint, otherDirection) {
  const [p, d, q, e] = [point, direction, otherPoint, otherDirection].map(vector);
  const between = q.clone().sub(p);
  const cosine = d.dot(e);
  const sine = 1 - cosine * cosine;
  const along = sine < 1e-9 ? between.dot(d) : (between.dot(d) - cosine * between.dot(e)) / sine;
  return p.addScaledVector(d, along);
}

/** Coordinate of a point along a body's axis. */
export const along = (body, point) => vector(point).sub(vector(body.point)).dot(vector(body.direction));

/** The point of a body's axis at a coordinate along it. */
export const onAxis = (body, at) => vector(body.point).addScaledVector(vector(body.direction), at);

/** Distance of a point from a body's axis. */
export const offAxis = (body, point) => onAxis(body, along(body, point)).distanceTo(vector(point));

export const isParallel = (one, other) => Math.abs(vector(one).dot(vector(other))) > 1 - 1e-6;

/** True if two bodies turn about one line in their current poses. */
export function sharesAxis(scene, one, other, size) {
  const [a, b] = [scene.bodies[one], scene.bodies[other]];
  return isParallel(a.direction, b.direction) && offAxis(a, b.point) < 1e-6 * size;
}
