// A train in space: its parts, merged into one geometry; the shader reads the pose of each part's body.

import { barBetween, hubs, spans, supports } from "./arbors.js";
import { Bend } from "./bend.js";
import { Casting } from "./casting.js";
import { PARTS } from "./colours.js";
import { holds, quarterOf } from "./cutaway.js";
import { ballOf, circlesOf, mainDirection, outlineOf, partingOf, pointsOf } from "./extent.js";
import { dialParts, orderOf, pointerParts, shownBy } from "./faces.js";
import { Ground } from "./ground.js";
import { couplingParts, crankOf, hangerParts, machineOf, partsOfHanger } from "./joints.js";
import { Looks } from "./looks.js";
import { cutOpen, metals } from "./metal.js";
import { Palette } from "./palette.js";
import { builtParts, cornersOf, rodsOf, shapeParts } from "./parts.js";
import { Poses } from "./poses.js";
import { Sight } from "./sight.js";
import { along, isParallel, offAxis, onAxis, sharesAxis, vector } from "./space.js";
import { Sparks } from "./sparks.js";
import { WheelPart } from "./wheels.js";

const REACH = 0.12; // length of a crank relative to the size of the train
const CASE = ["frame", "dial", "foot"]; // kinds of parts of a case, whose plates have the size of its dials
const LONGEST = 1.1; // maximum length of a pendulum as drawn, in the same way

export class World {
  constructor(machine) {
    this.scene = machine.scene;
    const circles = circlesOf(this.scene);
    this.main = mainDirection(this.scene);
    this.corners = cornersOf([...this.scene.parts, ...this.scene.shapes], this.main);
    const corners = this.corners.map(({ point }) => point);
    this.ball = ballOf(this.scene, circles, corners);
    this.size = 2 * this.ball.radius;
    this.poses = new Poses(machine, this.main, this.ball.center, partingOf(this.scene, [...circles.flatMap(pointsOf), ...corners], this.main));
    this.root = this.poses.root;
    this.nodes = this.poses.nodes;
    this.palette = new Palette();
    this.quarter = quarterOf(this.scene, this.size);
    this.materials = metals(this.nodes.length, this.main, this.ball.center, this.size, this.quarter);
    this.uniforms = this.materials[0].uniforms;
    this.castings = [new Casting(), new Casting(), new Casting()]; // all but teeth; teeth, which are added later; covers
    this.parts = [];
    this.build();
    this.bends = this.scene.waves.map((wave) => this.bendOf(machine, wave));
    this.sight = new Sight(this.scene);
    this.looks = new Looks(this.scene, this.palette, this.wheels, this.parts, this.sight);
    this.looks.showTeeth(false);
    this.looks.paint("plain");
    this.root.add(...this.cast(0), ...this.cast(2));
    this.machine = machine;
    this.ground = new Ground(this.size, this.scene.up);
    this.root.add(this.ground.mesh);
    if (machine.simulated) {
      this.sparks = new Sparks(machine.scene, this.poses, machine.run);
      this.root.add(this.sparks.points);
    }
    this.explode(0);
  }

  build() {
    const { scene, size, palette } = this;
    const reach = spans(scene);
    const radii = hubs(scene, reach, size);
    const built = builtParts(scene, this.main);
    const rods = scene.bodies.map((_, index) => rodsOf(scene, index));
    const hub = (wheel) => {
      const height = along(scene.bodies[wheel.body], wheel.centre);
      const rod = rods[wheel.body].find(([low, high]) => low <= height && height <= high);
      return rod ? rod[2] : radii[wheel.body];
    };
    this.wheels = scene.wheels.map((wheel, index) => new WheelPart(scene, index, hub(wheel), size, palette));
    for (const part of this.wheels) part.castBody(this.adder(this.castings[0], part));
    for (const part of built.length ? built : supports(scene, reach, radii, size)) this.put(part);
    for (const part of shapeParts(scene, this.main)) this.put(part);
    const made = new Set(scene.parts.map(({ name }) => name));
    for (const coupling of scene.couplings) {
      if (!made.has(`${coupling.id} pin`) && !made.has(`${coupling.id} pin 1`)) couplingParts(scene, coupling, size).forEach((part) => this.put(part));
    }
    scene.dials.forEach((_, index) => dialParts(scene, index).forEach((part) => this.put(part)));
    scene.pointers.forEach(({ dial }, index) => {
      if (dial === null || shownBy(scene, index) !== index) return;
      const body = scene.dials[dial].look === "ball" ? this.poses.ball(dial) : scene.pointers[index].body;
      pointerParts(scene, index, orderOf(scene, index)).forEach((part) => this.put({ ...part, body: part.slides === undefined ? body : this.poses.slide(index) }));
    });
    scene.hangers.forEach((hanger, index) => {
      const body = this.poses.hanger(index);
      const parts = partsOfHanger(hanger, LONGEST * size);
      hangerParts({ ...hanger, parts }).forEach((part) => this.put({ ...part, body }));
      this.corners.push(...cornersOf(parts, this.main).map((corner) => ({ ...corner, body })));
    });
    this.crank = this.buildCrank(reach);
    this.crank?.parts.forEach((part) => this.put(part));
  }

  /** A flexible wheel, with the wall that continues its face. */
  bendOf(machine, wave) {
    const part = this.wheels[wave.wheel];
    const { body, thickness } = part.wheel;
    const near = (end) => end.distanceTo(part.at);
    const walls = this.parts
      .filter(({ wall }) => wall && offAxis(this.scene.bodies[body], wall[0]) < 1e-6 * this.size)
      .map(({ slot, wall }) => ({ slot, ends: wall.toSorted((one, other) => near(one) - near(other)) }));
    const joined = walls.filter(({ ends: [end] }) => near(end) < thickness);
    return new Bend(machine, wave, part, joined.map(({ slot, ends }) => ({ slot, bottom: ends[1] })));
  }

  /** True if the train is driven by what is drawn elsewhere: a weight that hangs, or the ground. */
  get isDriven() {
    const { crank, drive, hangers, shapes } = this.scene;
    return (drive === "weight" && hangers.some(({ kind }) => kind === "weight")) || shapes.some(({ kind, body }) => kind === "road" && body === crank);
  }

  /** Adds the crank, or the motor or spring, at the end of its arbor where it is less in the way of other parts; the arbor is lengthened past them. */
  buildCrank(reach) {
    const { scene, size } = this;
    if (scene.crank === null || scene.bodies[scene.crank].parent === null || this.isDriven) return null;
    const body = scene.bodies[scene.crank];
    const coaxial = scene.bodies.map((_, at) => at).filter((at) => reach[at] && sharesAxis(scene, scene.crank, at, size));
    const ends = coaxial.flatMap((at) => reach[at].map((end) => along(body, onAxis(scene.bodies[at], end))));
    const own = reach[scene.crank] ?? [0, 0];
    const [low, high] = [Math.min(...ends, ...own), Math.max(...ends, ...own)];
    const past = [own[0] - low, high - own[1]];
    const off = (end) => onAxis(body, end).distanceTo(this.ball.center);
    const hidden = scene.drive === "motor" && isParallel(body.direction, this.main.toArray()); // a motor would hide its wheel: it is behind
    const outward = hidden
      ? -vector(body.direction).dot(this.main) * scene.front
      : Math.abs(past[0] - past[1]) > 1e-6 * size
        ? past[0] - past[1]
        : isParallel(body.direction, this.main.toArray())
          ? vector(body.direction).dot(this.main) * scene.front
          : off(high) - off(low);
    // in front of a dial the crank would hide its scale
    const isBefore = ({ centre, normal, radius }) => isParallel(body.direction, normal) && offAxis(body, centre) < 1.08 * radius + REACH * size;
    const read = new Set(scene.dials.filter(isBefore).map(({ normal }) => Math.sign(vector(normal).dot(vector(body.direction)))));
    const side = read.size === 1 ? -[...read][0] : outward < 0 ? -1 : 1;
    const last = side > 0 ? high : low;
    const end = last + side * 0.02 * size;
    const foot = own[side > 0 ? 1 : 0];
    const rod = rodsOf(scene, scene.crank).sort((one, other) => side * (other[0] - one[0]))[0];
    const crank = scene.drive === "motor" || scene.drive === "spring" ? machineOf(scene, scene.crank, end, side, size) : crankOf(scene, scene.crank, end, side, REACH * size, size);
    crank.at = onAxis(body, last); // in the exploded view, it moves with its support
    for (const part of crank.parts) part.at = crank.at;
    const bar = (from, to, at) => ({ body: scene.crank, colour: PARTS.arbor, ...barBetween(onAxis(body, from), onAxis(body, to), rod ? rod[2] : 0.009 * size), at });
    crank.parts.push(bar(foot - side * 0.01 * size, last, null), bar(last - side * 0.005 * size, end, crank.at));
    return crank;
  }

  put({ colour, gloss = 0.85, shape, matrix, body, at, dial, plate, cover, pane, bar, wall, opened }) {
    const slot = this.palette.slot(colour, gloss, opened);
    this.castings[cover || bar ? 2 : 0].add(shape, matrix, { body, slot, lift: this.poses.lift(body, at) });
    this.parts.push({ slot, body, at, dial, plate, cover, pane, bar, wall, colour });
  }

  adder(casting, { wheel: { body }, at }) {
    return (shape, matrix, slot, count) => casting.add(shape, matrix, { body, slot, count, lift: this.poses.lift(body, at) });
  }

  cast(at) {
    this.arranged = false;
    return this.castings[at].cast(this.materials);
  }

  /** Adds the teeth, after the other parts are visible. */
  castTeeth() {
    const many = this.scene.wheels.reduce((sum, { teeth }) => sum + teeth, 0);
    for (const part of this.wheels) part.castTeeth(this.adder(this.castings[1], part), many);
    this.root.add(...this.cast(1));
    this.bend();
    this.cut = true;
  }

  /** Updates the pose of every body. */
  turn() {
    const { value } = this.uniforms.poses;
    this.poses.turn(value.image.data);
    value.needsUpdate = true;
    this.bend();
    this.sparks?.set(this.machine.time());
  }

  /** Updates flexible wheels to the current position of their waves. */
  bend() {
    for (const bend of this.bends) bend.turn(this.castings);
  }

  /** Cuts a quarter out of rings, drums and plates, or closes it. */
  cutOpen(opened) {
    this.opened = opened && Boolean(this.quarter);
    this.arranged = false;
    cutOpen(this.materials, this.opened);
  }

  /** Exploded view of the layers, 0 (assembled) to 1. */
  explode(share) {
    this.uniforms.share.value = share;
    this.poses.explode(share);
    this.turn();
    this.ground.fit(this.outline());
  }

  /**
   * Points that a picture of the train must include, in its current exploded view; seen from a direction `towards`, without
   * the plates of a case and the dials on its far side.
   */
  outline(towards = null) {
    const cased = towards && this.scene.dials.some(({ placed }) => placed);
    const { crank, poses } = this;
    const swing = crank ? pointsOf({ at: crank.end, direction: this.scene.bodies[crank.body].direction, radius: 1.17 * crank.reach }) : [];
    const moved = (point, body, at) => {
      const lift = poses.lift(body, at);
      return poses.apart(point, typeof lift === "number" ? lift : lift(point)).add(poses.shifts[body]);
    };
    const hangs = (body) => poses.bodies[body].hangs !== undefined; // now lower than at 0 turns
    const held = this.corners.filter(({ kind }) => !(cased && CASE.includes(kind))).map(({ point, body, at }) => (hangs(body) ? this.placed(point, body, at ?? point) : moved(point, body, at)));
    return [...outlineOf(this.scene, poses, cased && towards), ...swing.map((point) => moved(point, crank.body, crank.at)), ...held];
  }

  /** Current position of a point of the crank (its foot or its knob). */
  ofCrank(point) {
    return this.placed(point, this.crank.body, this.crank.at);
  }

  /** Current position of a point of a body; in the exploded view, it is displaced like the part at `at`. */
  placed(point, body, at = point) {
    return this.poses.apart(point, this.poses.lift(body, at)).applyMatrix4(this.nodes[body].matrixWorld);
  }

  /** The wheel that a ray meets first, or null. */
  pick(ray) {
    const rays = this.nodes.map(() => null);
    const seenBy = (body) => (rays[body] ??= ray.clone().applyMatrix4(this.nodes[body].matrixWorld.clone().invert()));
    const shift = (lift) => this.main.clone().multiplyScalar(this.poses.share * lift);
    const glass = new Set(this.looks.glass?.map((part) => part.slot)); // a tap passes through transparent parts
    const gone = (slot, distance) => this.opened && this.palette.looks[slot].opened && holds(this.quarter, ray.at(distance, vector([0, 0, 0])));
    let [nearest, slot] = [Infinity, null];
    for (const casting of this.castings) {
      for (const [distance, part] of casting.met(seenBy, shift)) {
        if (distance < nearest && this.palette.looks[part.slot].shown && !glass.has(part.slot) && !gone(part.slot, distance)) [nearest, slot] = [distance, part.slot];
      }
    }
    const wheel = this.wheels.findIndex((part) => part.slots.includes(slot));
    return wheel < 0 ? null : wheel;
  }

  /** Makes covers and pillars between a camera and the wheels transparent. */
  glaze(eye) {
    this.looks.glaze(eye, this.ball.center);
  }

  /** Updates the palette that the materials read, and which parts each of them draws. */
  refresh() {
    if (!this.palette.stale && this.arranged) return;
    this.uniforms.palette.value = this.palette.refresh();
    for (const casting of this.castings) if (casting.meshes) casting.distribute((slot) => this.meshOf(this.palette.looks[slot]));
    this.arranged = true;
  }

  /** The mesh of a casting that draws parts of an appearance: opaque, transparent, or cut open; -1 if they are hidden. */
  meshOf({ shown, opacity, opened }) {
    if (!shown) return -1;
    return opacity < 1 ? 1 : opened && this.opened ? 2 : 0;
  }

  dispose() {
    for (const casting of this.castings) casting.dispose();
    this.sparks?.dispose();
    this.ground.dispose();
    this.palette.dispose();
    this.uniforms.poses.value.dispose();
    for (const material of this.materials) material.dispose();
  }
}
