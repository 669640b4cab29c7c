// Pointer input in the picture: a tap selects a wheel, a drag of the handle turns the crank.

import { Plane, Raycaster, Vector2 } from "three";

import { vector } from "./space.js";

const STILL = 6; // maximum movement of a finger in a tap, in pixels

export class Hands {
  constructor(stage) {
    this.stage = stage;
    this.ray = new Raycaster();
    this.plane = new Plane();
    this.listeners = {
      pointerdown: (event) => this.down(event),
      pointermove: (event) => this.move(event),
      pointerup: (event) => this.up(event),
      pointercancel: () => this.release(),
    };
    // before the listeners of the camera controls
    for (const [name, listener] of Object.entries(this.listeners)) stage.canvas.addEventListener(name, listener, true);
  }

  aim(event) {
    const box = this.stage.canvas.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * 2 - 1;
    const y = 1 - ((event.clientY - box.top) / box.height) * 2;
    this.ray.setFromCamera(new Vector2(x, y), this.stage.camera);
  }

  down(event) {
    this.aim(event);
    this.from = [event.clientX, event.clientY];
    if (!this.stage.machine.moves || !this.onKnob()) return;
    this.dragged = this.crankAngle();
    this.stage.controls.enabled = false;
    this.stage.canvas.setPointerCapture(event.pointerId);
  }

  move(event) {
    if (this.dragged === undefined) return;
    this.aim(event);
    const angle = this.crankAngle();
    if (angle === null) return;
    const raw = this.dragged === null ? 0 : angle - this.dragged;
    this.dragged = angle;
    const swept = raw - 2 * Math.PI * Math.round(raw / (2 * Math.PI));
    const delta = this.stage.leadOf(swept);
    if (delta) this.stage.onCrank(delta);
  }

  up(event) {
    const slipped = Math.hypot(event.clientX - this.from[0], event.clientY - this.from[1]);
    if (this.dragged === undefined && slipped <= STILL) this.pick(event);
    this.release();
  }

  release() {
    this.dragged = undefined;
    this.stage.controls.enabled = true;
  }

  pick(event) {
    this.aim(event);
    this.stage.onPick(this.stage.world.pick(this.ray.ray));
  }

  /** True where the ray passes near the crank's knob. */
  onKnob() {
    const { world } = this.stage;
    const { crank } = world;
    return crank !== null && this.ray.ray.distanceToPoint(world.ofCrank(crank.knob)) < crank.touch;
  }

  /** The angle (rad) at which the ray meets the plane of the crank, about its axis in the frame of its parent. */
  crankAngle() {
    const { world, machine } = this.stage;
    const body = machine.scene.bodies[machine.scene.crank];
    const bearer = world.nodes[body.parent].matrixWorld;
    const middle = world.ofCrank(world.crank.at);
    const normal = vector(body.direction).transformDirection(bearer);
    this.plane.setFromNormalAndCoplanarPoint(normal, middle);
    const met = this.ray.ray.intersectPlane(this.plane, vector([0, 0, 0]));
    if (!met) return null;
    const [x, y] = [vector([1, 0, 0]), vector([0, 1, 0])];
    const one = Math.abs(normal.x) < 0.9 ? x : y;
    one.addScaledVector(normal, -one.dot(normal)).normalize();
    met.sub(middle);
    return Math.atan2(met.dot(normal.clone().cross(one)), met.dot(one));
  }

  dispose() {
    for (const [name, listener] of Object.entries(this.listeners)) this.stage.canvas.removeEventListener(name, listener, true);
  }
}
