// How far a train reaches: what a camera must have in its picture.

import { Box3, Sphere, Vector3 } from "three";

import { across, along, onAxis, vector } from "./space.js";
import { ringRim } from "./wheels.js";

const ROUND = 16; // points of a circle

/** The circles that hold all wheels, wherever they are carried, and all dials: {at, direction, radius}. */
export function circlesOf(scene) {
  const dials = scene.dials.map(({ centre, normal, radius }) => ({ at: vector(centre), direction: normal, radius: 1.08 * radius }));
  return [...scene.wheels.flatMap((wheel) => bothFaces(rimOf(wheel), wheel).map((face) => carriedRound(scene, wheel, face))).flat(), ...dials];
}

const rimOf = (wheel) => (wheel.kind === "ring" ? ringRim(wheel) : Math.max(wheel.tip, wheel.radius));

function bothFaces(radius, { centre, direction, thickness, cone }) {
  const off = cone ? 1.1 * thickness : 0.6 * thickness;
  return [off, -off].map((height) => ({ at: vector(centre).addScaledVector(vector(direction), height), direction, radius }));
}

/** The circles that hold a circle of a wheel, wherever the wheel's axis is carried to. */
function carriedRound(scene, wheel, circle) {
  const bearer = scene.bodies[scene.bodies[wheel.body].parent ?? 0];
  if (bearer.parent === null) return [circle];
  const middle = onAxis(bearer, along(bearer, circle.at));
  const tilt = vector(circle.direction).dot(vector(bearer.direction));
  const [flat, upright] = [Math.abs(tilt) * circle.radius, Math.sqrt(Math.max(0, 1 - tilt * tilt)) * circle.radius];
  const radius = middle.distanceTo(circle.at) + flat;
  return [upright, -upright].map((height) => ({ at: middle.clone().addScaledVector(vector(bearer.direction), height), direction: bearer.direction, radius }));
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

/** The ball that holds all circles and corners; of a train without wheels, its axes. */
export function ballOf(scene, circles, corners = []) {
  const box = new Box3().setFromPoints([...circles.flatMap(pointsOf), ...corners]);
  if (box.isEmpty()) for (const { point } of scene.bodies) box.expandByPoint(vector(point).addScalar(10)).expandByPoint(vector(point).subScalar(10));
  return box.getBoundingSphere(new Sphere());
}

/** The direction of most wheels, on the side of z. */
export function mainDirection(scene) {
  const counts = new Map();
  for (const { direction } of scene.wheels) {
    const key = direction.map((value) => Math.abs(value).toFixed(4)).join(" ");
    counts.set(key, { direction, count: (counts.get(key)?.count ?? 0) + 1 });
  }
  const most = [...counts.values()].sort((one, other) => other.count - one.count)[0];
  const main = most ? vector(most.direction) : new Vector3(0, 0, 1);
  return main.dot(new Vector3(0, 0, 1)) < 0 ? main.negate() : main;
}
