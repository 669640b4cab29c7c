// Extent of a train, which the picture must include.

import { Box3, Sphere, Vector3 } from "three";

import { across, along, isParallel, onAxis, vector } from "./space.js";

const ROUND = 16; // points of a circle
const LEAST_DEEP = 0.6; // depth of an exploded view divided by its width
const MOST_DEEP = 1.3;
const LAYER = 0.14; // thickness reserved for each layer
const PARTED = [0.8, 12]; // minimum and maximum displacement of layers divided by their distance

const STILL = () => new Vector3();

/**
 * Circles that contain all wheels, in all positions to which carriers move them, and all dials: {at, direction, radius, body}.
 *
 * shiftOf   displacement of a body as a whole in the exploded view, in its zero pose
 */
export function circlesOf(scene, shiftOf = STILL) {
  const dials = scene.dials.map(({ body, centre, normal, radius }) => ({ at: vector(centre).add(shiftOf(body)), direction: normal, radius: 1.08 * radius, body, faces: normal }));
  const wheels = scene.wheels.flatMap((wheel) => bothFaces(rimOf(wheel), wheel, shiftOf(wheel.body)).flatMap((face) => carriedRound(scene, wheel, face, shiftOf)));
  return [...wheels, ...dials];
}

/** Circles that contain the middle plane of a wheel in all its positions, as in `circlesOf`. */
export const discsOf = (scene, wheel) => carriedRound(scene, wheel, { at: vector(wheel.centre), direction: wheel.direction, radius: rimOf(wheel), body: wheel.body }, STILL);

/** Outer radius of a ring wheel [mm], which is not declared. */
export const ringRim = ({ root, radius, module }) => Math.max(root, radius) + 2 * Math.max(module, 0.02 * radius);

/** Outer radius of a wheel. */
export const rimOf = (wheel) => (wheel.kind === "ring" ? ringRim(wheel) : Math.max(wheel.tip, wheel.radius));

function bothFaces(radius, { body, centre, direction, thickness, cone }, shift) {
  const off = cone ? 1.1 * thickness : 0.6 * thickness;
  return [off, -off].map((height) => ({ at: vector(centre).add(shift).addScaledVector(vector(direction), height), direction, radius, body }));
}

/** Circles that contain a circle of a wheel in all positions of the wheel's axis. */
function carriedRound(scene, wheel, circle, shiftOf) {
  const bears = scene.bodies[wheel.body].parent ?? 0;
  const bearer = { ...scene.bodies[bears], point: vector(scene.bodies[bears].point).add(shiftOf(bears)) };
  if (bearer.parent === null) return [circle];
  const middle = onAxis(bearer, along(bearer, circle.at));
  const tilt = vector(circle.direction).dot(vector(bearer.direction));
  const [flat, upright] = [Math.abs(tilt) * circle.radius, Math.sqrt(Math.max(0, 1 - tilt * tilt)) * circle.radius];
  const radius = middle.distanceTo(circle.at) + flat;
  return [upright, -upright].map((height) => ({ at: middle.clone().addScaledVector(vector(bearer.direction), height), direction: bearer.direction, radius, body: wheel.body }));
}

/** Points round a circle. */
export function pointsOf({ at, direction, radius }) {
  const one = across(direction);
  const other = vector(direction).cross(one);
  return Array.from({ length: ROUND }, (_, n) => {
    const angle = (2 * Math.PI * n) / ROUND;
    return at.clone().addScaledVector(one, radius * Math.cos(angle)).addScaledVector(other, radius * Math.sin(angle));
  });
}

/** The sphere that contains all circles and corners; for a train without wheels, its axes. */
export function ballOf(scene, circles, corners = []) {
  const box = new Box3().setFromPoints([...circles.flatMap(pointsOf), ...corners]);
  if (box.isEmpty()) for (const { point } of scene.bodies) box.expandByPoint(vector(point).addScalar(10)).expandByPoint(vector(point).subScalar(10));
  return box.getBoundingSphere(new Sphere());
}

/** Points that a picture of the whole train must include, in its present exploded state; with `towards`, without dials that face away from it. */
export function outlineOf(scene, poses, towards) {
  const isSeen = ({ faces }) => !(towards && faces && vector(faces).dot(towards) < 0);
  const lifted = (point, body) => (poses.skewed[body] ? point : poses.apart(point, poses.height(point)));
  return circlesOf(scene, (body) => poses.shift(body)).filter(isSeen).flatMap((circle) => pointsOf(circle).map((point) => lifted(point, circle.body)));
}

/**
 * Displacement of layers from the middle in a full exploded view, divided by their distance from it, so that each layer
 * is visible separately.
 *
 * points   points that contain the train; points of its axes for a train without wheels
 */
export function partingOf(scene, points, main) {
  if (!points.length) return PARTED[0];
  const { radius } = new Box3().setFromPoints(points).getBoundingSphere(new Sphere());
  const heights = points.map((point) => point.dot(main));
  const deep = Math.max(...heights) - Math.min(...heights) || 1e-9;
  const wide = Math.sqrt(Math.max(4 * radius * radius - deep * deep, deep * deep));
  const levels = scene.wheels.filter(({ direction }) => isParallel(direction, main.toArray())).map(({ centre, thickness }) => [vector(centre).dot(main), thickness]);
  levels.sort(([one], [other]) => one - other);
  const layers = levels.filter(([level, thickness], n) => n === 0 || level - levels[n - 1][0] > 0.5 * thickness).length;
  const wanted = Math.max(LEAST_DEEP, Math.min(MOST_DEEP, LAYER * (layers + 2))) * wide;
  return Math.max(PARTED[0], Math.min(PARTED[1], wanted / deep - 1));
}

/** The normal of the frame plates; without plates, the axis direction of most wheels, weighted by their size; towards +z. */
export function mainDirection(scene) {
  const plate = scene.parts.find(({ kind }) => kind === "frame");
  const sizes = new Map();
  for (const { direction, radius } of scene.wheels) {
    const key = direction.map((value) => Math.abs(value).toFixed(4)).join(" ");
    sizes.set(key, { direction, size: (sizes.get(key)?.size ?? 0) + radius });
  }
  const most = [...sizes.values()].sort((one, other) => other.size - one.size)[0];
  const main = vector(plate?.direction ?? most?.direction ?? [0, 0, 1]);
  return main.dot(new Vector3(0, 0, 1)) < 0 ? main.negate() : main;
}
