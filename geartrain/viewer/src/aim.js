// Parts of a train that have a name: where labels point to, and at what the camera of a tour looks.

import { circlesOf, discsOf, pointsOf, rimOf } from "./extent.js";
import { orderOf, shownBy } from "./faces.js";
import { vector } from "./space.js";

const HAND = 0.62; // place on a hand, from the axis to its tip
const MOST = 12; // maximum number of labels
const [ABOVE, ASIDE] = [0.24, 0.2]; // of the view of a dial, relative to its normal
const named = (list, name) => list.findIndex(({ id }) => id === name);

/** Labels of a scene: {name, order (of a hand, for its colour), at(world), faces(eye)}; hands of dials, or wheels by their links. */
export function labelsOf(scene) {
  return scene.dials.length ? handLabels(scene) : wheelLabels(scene);
}

function handLabels(scene) {
  return scene.pointers.flatMap(({ output, body, dial, level }, index) => {
    if (dial === null || shownBy(scene, index) !== index) return [];
    const { look, centre, normal, zero, radius, scale } = scene.dials[dial];
    const isBall = look === "ball";
    const out = isBall ? 0 : radius * (scale.turns > 1 ? scale.inner : HAND * scale.outer);
    const point = vector(centre).addScaledVector(vector(zero), out).addScaledVector(vector(normal), isBall ? 0 : level);
    const at = (world) => world.placed(point, isBall ? world.poses.ball(dial) : body, vector(centre));
    const faces = (eye) => isBall || eye.clone().sub(vector(centre)).dot(vector(normal)) > 0;
    return [{ name: output, order: orderOf(scene, index), at, faces }];
  });
}

/** The largest wheel of each link; inputs and outputs take precedence over other links. */
function wheelLabels(scene) {
  const largest = new Map();
  scene.wheels.forEach((wheel) => {
    const before = largest.get(wheel.body);
    if (!before || rimOf(wheel) > rimOf(before)) largest.set(wheel.body, wheel);
  });
  const ends = new Set([scene.driving_link, ...scene.pointers.map(({ body }) => body)]);
  const wheels = [...largest.values()].sort((one, other) => ends.has(other.body) - ends.has(one.body) || rimOf(other) - rimOf(one));
  return wheels.slice(0, MOST).map((wheel) => {
    const { id, parent } = scene.bodies[wheel.body];
    const at = (world) => {
      const axis = vector(wheel.direction).transformDirection(world.nodes[wheel.body].matrixWorld);
      const ring = wheel.kind === "ring"; // where it is not cut open
      const way = ring ? world.quarter.right.clone().negate() : vector([0, 1, 0]).addScaledVector(axis, -axis.y).normalize();
      return world.placed(vector(wheel.centre), wheel.body).addScaledVector(way, ring ? (wheel.radius + rimOf(wheel)) / 2 : 0.9 * wheel.radius);
    };
    return { name: parent === null ? wheel.id : id, order: null, at, faces: () => true };
  });
}

/** A part {kind, name} of a tour as {points to be in the picture, towards (direction of the camera) or null, chosen (what is highlighted) or null}. */
export function aimAt(world, { kind, name }) {
  const { scene } = world;
  const pointer = kind === "output" ? scene.pointers.find(({ output }) => output === name) : null;
  const dial = kind === "dial" ? named(scene.dials, name) : (pointer?.dial ?? -1);
  if (dial >= 0) return atDial(world, dial);
  if (kind === "wheel") {
    const wheel = scene.wheels[named(scene.wheels, name)];
    return { points: discsOf(scene, wheel).flatMap(pointsOf), towards: null, chosen: { wheels: [scene.wheels.indexOf(wheel)] } };
  }
  const coupling = scene.couplings[named(scene.couplings, name)];
  const bodies = kind === "coupling" ? (coupling ? [coupling.pin, coupling.slot] : []) : [pointer?.body ?? named(scene.bodies, name)];
  return { points: ofBodies(world, bodies), towards: null, chosen: { bodies } };
}

function atDial(world, index) {
  const { body, centre, normal, radius } = world.scene.dials[index];
  const at = world.placed(vector(centre), body);
  const towards = vector(normal).addScaledVector(vector([0, 1, 0]), ABOVE).addScaledVector(vector([Math.sign(normal[2]) || 1, 0, 0]), ASIDE);
  return { points: pointsOf({ at, direction: normal, radius: 1.1 * radius }), towards: towards.normalize(), chosen: null };
}

/** Points around the wheels of bodies; of bodies without wheels, around their other parts; else of the whole train. */
function ofBodies(world, bodies) {
  const own = ({ body }) => bodies.includes(body);
  const wheels = circlesOf(world.scene).filter(own).flatMap(pointsOf);
  if (wheels.length) return wheels;
  const parts = world.corners.filter(own).map(({ point, body }) => world.placed(point, body));
  return parts.length ? parts : world.outline();
}
