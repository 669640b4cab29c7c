// Poses of the bodies of a train. Each is a node below the body that carries its axis, rotated about its axis by its
// angle relative to this parent. In an exploded view, layers move along the main direction.

import { Group, Matrix4, Vector3 } from "three";

import { frameAt, isParallel, vector } from "./space.js";
import { Reading } from "./ui/reading.js";

const SWING = 0.035; // amplitude of a pendulum with an anchor escapement [rad]: 2 degrees
const ASIDE = 0.7; // displacement of bodies on other axes, relative to their distance from the middle

/** Balls turn like the bodies `as`, but each about an axis through its own centre. */
const balls = ({ bodies, dials, pointers }) =>
  dials.flatMap(({ look, centre }, ball) => {
    const as = pointers.find(({ dial }) => dial === ball)?.body;
    return look === "ball" && as !== undefined ? [{ ...bodies[as], point: centre, as, ball }] : [];
  });

/** Slides of hands on spirals, which turn with the bodies `as`. */
const slides = ({ bodies, dials, pointers }) =>
  pointers.flatMap(({ body, dial }, slide) => (dial !== null && dials[dial].scale.turns > 1 ? [{ ...bodies[body], as: body, slide }] : []));

/** Pose of a hanging part when the body that moves it has turned by `joint`. */
function hung(matrix, { kind, point, direction, down, length, rate }, joint) {
  const frame = frameAt(point, direction, down);
  const now = length + Math.max(0.1 * length - length, rate * joint); // not above its barrel
  const own = new Matrix4();
  if (kind === "pendulum") own.makeRotationZ(SWING * Math.sin(rate * joint));
  else if (kind === "line") own.makeScale(now / length, 1, 1);
  else own.makeTranslation(now - length, 0, 0);
  matrix.copy(frame).multiply(own).multiply(frame.invert());
}

export class Poses {
  /** main   direction in which layers move; `middle`: fixed point; `parting`: displacement relative to the distance from it */
  constructor(machine, main, middle, parting) {
    Object.assign(this, { machine, main, middle, parting, share: 0 });
    const { scene } = machine;
    const parent = scene.bodies.findIndex((body) => body.parent === null);
    this.bodies = [...scene.bodies, ...balls(scene), ...slides(scene), ...scene.hangers.map((hanger, hangs) => ({ ...hanger, parent, as: hanger.body, hangs }))];
    this.readings = this.bodies.map(({ slide }) => (slide === undefined ? null : new Reading(machine.scene, machine, slide)));
    this.root = new Group();
    this.nodes = this.bodies.map(() => new Group());
    this.nodes.forEach((node) => (node.matrixAutoUpdate = false));
    this.bodies.forEach(({ parent }, index) => (parent === null ? this.root : this.nodes[parent]).add(this.nodes[index]));
    this.shifts = this.bodies.map(() => new Vector3());
    this.skewed = this.bodies.map((_, index) => this.isSkew(index));
  }

  /** True if the axis of a body, or of a body that carries it, is not parallel to the main direction: it moves as a whole. */
  isSkew(index) {
    const { parent, direction } = this.bodies[index];
    return parent !== null && (!isParallel(direction, this.main.toArray()) || this.isSkew(parent));
  }

  /** Updates every node to the current pose of its body, and writes its matrix into `array`. */
  turn(array) {
    this.bodies.forEach((body, index) => {
      if (body.parent === null) return;
      const joint = this.machine.moves ? this.machine.joint(body.as ?? index) : 0;
      const { matrix } = this.nodes[index];
      if (body.to !== undefined && body.to !== null) return; // after all other bodies
      if (body.hangs !== undefined) return hung(matrix, body, this.unwound(body.as, joint));
      const point = vector(body.point);
      if (body.travels) return matrix.makeTranslation(vector(body.direction).multiplyScalar(joint / (2 * Math.PI)).add(this.shifts[index]));
      matrix.makeRotationAxis(vector(body.direction), joint);
      const out = this.slid(index);
      matrix.setPosition(point.clone().sub(out).applyMatrix4(matrix).negate().add(point).add(this.shifts[index]));
    });
    this.root.updateMatrixWorld(true);
    this.bodies.forEach((body, index) => typeof body.to === "number" && this.#stretch(body, this.nodes[index].matrixWorld));
    this.nodes.forEach((node, index) => array.set(node.matrixWorld.elements, 16 * index));
  }

  /** Pose of a rod or a rope between points of two bodies, which it follows. */
  #stretch({ body, to, point, direction, down, length }, matrix) {
    const from = vector(point).applyMatrix4(this.nodes[body].matrixWorld);
    const end = vector(point).addScaledVector(vector(down), length).applyMatrix4(this.nodes[to].matrixWorld);
    const way = end.sub(from);
    const axis = vector(direction).transformDirection(this.nodes[body].matrixWorld);
    matrix.copy(frameAt(from.toArray(), axis.toArray(), way.toArray())).scale(vector([way.length() / length, 1, 1])).multiply(frameAt(point, direction, down).invert());
  }

  /** The angle of a body with its completed turns. */
  unwound(index, joint) {
    const { machine } = this;
    if (!machine.moves || machine.simulated) return joint;
    const mean = 2 * Math.PI * machine.scene.bodies[index].sense * machine.speeds[index] * machine.made();
    return joint + 2 * Math.PI * Math.round((mean - joint) / (2 * Math.PI));
  }

  /** Exploded view of the layers, 0 (assembled) to 1. */
  explode(share) {
    this.share = share;
    this.bodies.forEach(({ parent }, index) => {
      this.shifts[index].set(0, 0, 0);
      if (!this.skewed[index] || this.skewed[parent]) return;
      const dial = this.faced(index);
      const anchor = dial ? vector(dial.centre) : this.anchor(index);
      const off = anchor.clone().sub(this.middle);
      const aside = dial ? 0 : ASIDE; // a hand stays over its dial
      this.shifts[index].addScaledVector(off, share * aside).addScaledVector(this.main, share * (this.height(anchor) - aside * off.dot(this.main)));
    });
  }

  /** The dial of the hand on a body, or of the ball that it is, if the dial is displaced separately. */
  faced(index) {
    const { pointers, dials } = this.machine.scene;
    const { ball } = this.bodies[index];
    if (ball !== undefined) return dials[ball];
    const read = pointers.find(({ body, dial }) => body === index && dial !== null);
    return read && !this.skewed[dials[read.dial].body] ? dials[read.dial] : null;
  }

  /** Displacement of a body that moves as a whole, including that of the bodies that carry it. */
  shift(index) {
    const { parent } = this.bodies[index];
    const own = this.shifts[index].clone();
    return parent === null ? own : own.add(this.shift(parent));
  }

  /** Current distance of a slide from the inner end of its spiral. */
  slid(index) {
    const reading = this.readings[index];
    if (!reading) return new Vector3();
    const { zero, radius, scale } = reading.dial;
    return vector(zero).multiplyScalar((radius * (scale.outer - scale.inner) * (reading.now?.turns ?? 0)) / scale.turns);
  }

  /** The node of the slide of a pointer. */
  slide(pointer) {
    return this.bodies.findIndex((body) => body.slide === pointer);
  }

  /** The node of the ball of a dial. */
  ball(dial) {
    return this.bodies.findIndex((body) => body.ball === dial);
  }

  /** The node of a hanging part. */
  hanger(hanger) {
    return this.bodies.findIndex((body) => body.hangs === hanger);
  }

  anchor(index) {
    const own = this.machine.scene.wheels.filter(({ body }) => body === index).map(({ centre }) => vector(centre));
    const sum = own.reduce((total, centre) => total.add(centre), new Vector3());
    return own.length ? sum.divideScalar(own.length) : vector(this.bodies[index].point);
  }

  /** Displacement of a point in the full exploded view. */
  height(point) {
    return this.parting * (point.dot(this.main) - this.middle.dot(this.main));
  }

  /** The same for a part of a body, in the frame of the body; a bar, whose `at` is null, is stretched. */
  lift(body, at) {
    if (this.skewed[body]) return 0;
    return at ? this.height(at) : (point) => this.height(point);
  }

  /** A point displaced by a lift in the current exploded view. */
  apart(point, lift) {
    return point.clone().addScaledVector(this.main, this.share * lift);
  }
}
