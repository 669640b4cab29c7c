// Pins and slots, and the handle of the crank.

import { BoxGeometry, CylinderGeometry, Group, SphereGeometry } from "three";

import { arm } from "./arbors.js";
import { PARTS } from "./colours.js";
import { solid, unseen } from "./solids.js";
import { along, across, frameAt, onAxis, placed, vector } from "./space.js";

/** Parts of a pin and its slot: {body, mesh, at}. */
export function couplingParts(scene, coupling, size) {
  const pinBody = scene.bodies[coupling.pin];
  const slotBody = scene.bodies[coupling.slot];
  const [pinAt, slotAt] = [vector(coupling.pin_at), vector(coupling.slot_at)];
  const radius = Math.max(0.005 * size, Math.min(0.012 * size, 0.12 * coupling.pin_radius));
  const [steel, dark] = [PARTS.slot, PARTS.pin];
  const height = 4 * radius;
  const pin = solid(new CylinderGeometry(radius, radius, height, 16).rotateX(Math.PI / 2), dark);
  const hub = onAxis(pinBody, along(pinBody, pinAt));
  const parts = [
    { body: coupling.pin, mesh: placed(frameAt(pinAt, pinBody.direction, across(pinBody.direction).toArray()), pin), at: pinAt },
    { body: coupling.slot, mesh: slotMesh(coupling, slotBody, slotAt, pinAt, radius, steel), at: slotAt },
  ];
  if (hub.distanceTo(pinAt) > 1e-6 * size) {
    const beneath = vector(pinBody.direction).multiplyScalar(-height / 2);
    const bar = arm(hub.add(beneath), pinAt.clone().add(beneath), pinBody.direction, 2.6 * radius, 0.5 * radius, steel);
    parts.push({ body: coupling.pin, mesh: bar, at: pinAt });
  }
  return parts;
}

/** Two rails between which the pin slides, and what ties them to their axis. */
function slotMesh(coupling, body, slotAt, pinAt, radius, colour) {
  const { pin_radius: reach, offset } = coupling;
  const [near, far] = [Math.max(0, Math.abs(reach - offset) - 2 * radius), reach + offset + 2 * radius];
  const group = new Group();
  const box = (from, to, y, width) => {
    const mesh = solid(new BoxGeometry(to - from, width, radius), colour);
    mesh.position.set((from + to) / 2, y, 0);
    group.add(mesh);
  };
  for (const side of [1, -1]) box(near, far, side * 1.35 * radius, 0.6 * radius);
  box(far, far + 0.7 * radius, 0, 3.3 * radius);
  if (near > 0) box(0, near, 0, 3.3 * radius);
  const towards = pinAt.clone().sub(slotAt).toArray();
  return placed(frameAt(slotAt.toArray(), body.direction, towards, coupling.slot_turn ?? 0), group);
}

/** The crank's handle at one end of its arbor, on one of its sides (1 or -1): {body, mesh, at}. */
export function crankPart(scene, index, end, side, size, colour) {
  const body = scene.bodies[index];
  const reach = 0.13 * size;
  const bar = solid(new BoxGeometry(reach, 0.02 * size, 0.012 * size), colour);
  bar.position.x = reach / 2;
  const out = 0.05 * size * side;
  const knob = solid(new CylinderGeometry(0.014 * size, 0.018 * size, 0.08 * size, 20).rotateX(Math.PI / 2), colour);
  knob.position.set(reach, 0, out);
  const cap = solid(new SphereGeometry(0.018 * size, 16, 12), colour);
  cap.position.set(reach, 0, 1.8 * out);
  // an unseen ball, so that a finger finds the knob
  const grip = unseen(new SphereGeometry(0.07 * size, 8, 6));
  grip.position.copy(knob.position);
  for (const mesh of [bar, knob, cap, grip]) mesh.userData.crank = true;
  const at = onAxis(body, end);
  const mesh = placed(frameAt(at, body.direction, across(body.direction).toArray()), bar, knob, cap, grip);
  return { body: index, mesh, at };
}
