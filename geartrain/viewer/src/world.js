// A train in space. Every body is a node under the body that bears its axis; a node holds its parts where they stand
// in the zero pose, and is turned about its axis by the angle its parent sees.

import { Box3, Color, Group, Sphere, Vector3 } from "three";

import { hubs, spans, supports } from "./arbors.js";
import { BROKEN, CHOSEN, FADED, colours } from "./colours.js";
import { dialPart, needlePart } from "./faces.js";
import { couplingParts, crankPart } from "./joints.js";
import { along, isParallel, onAxis, sharesAxis, vector } from "./space.js";
import { ringRim, Teeth, WheelPart } from "./wheels.js";

const APART = 3; // how far layers move apart when exploded, over their distance

export class World {
  constructor(machine) {
    this.machine = machine;
    this.scene = machine.scene;
    this.root = new Group();
    this.box = extent(this.scene);
    this.ball = this.box.getBoundingSphere(new Sphere());
    this.size = 2 * this.ball.radius;
    this.main = mainDirection(this.scene);
    this.parts = [];
    this.nodes = this.scene.bodies.map(() => new Group());
    this.nodes.forEach((node) => (node.matrixAutoUpdate = false));
    this.scene.bodies.forEach(({ parent }, index) => (parent === null ? this.root : this.nodes[parent]).add(this.nodes[index]));
    this.build();
    this.shifts = this.scene.bodies.map(() => new Vector3());
    this.explode(0);
    this.paint("plain");
  }

  build() {
    const { scene, size } = this;
    const reach = spans(scene);
    const radii = hubs(scene, reach, size);
    const teeth = new Teeth();
    this.wheels = scene.wheels.map((wheel, index) => {
      const part = new WheelPart(scene, index, radii[wheel.body], size, teeth);
      this.put({ body: wheel.body, mesh: part.node, at: vector(wheel.centre), wheel: index });
      return part;
    });
    for (const part of supports(scene, reach, radii, size)) this.put(part);
    for (const coupling of scene.couplings) couplingParts(scene, coupling, size).forEach((part) => this.put(part));
    scene.dials.forEach((_, index) => this.put(dialPart(scene, index)));
    const orders = scene.dials.map(() => 0);
    scene.pointers.forEach(({ dial }, index) => {
      if (dial !== null) this.put(needlePart(scene, index, orders[dial]++, size));
    });
    this.buildCrank(reach);
  }

  buildCrank(reach) {
    const { scene, size } = this;
    if (scene.crank === null || scene.bodies[scene.crank].parent === null) return;
    const body = scene.bodies[scene.crank];
    const coaxial = scene.bodies.map((_, at) => at).filter((at) => reach[at] && sharesAxis(scene, scene.crank, at, size));
    const ends = coaxial.flatMap((at) => reach[at].map((end) => along(body, onAxis(scene.bodies[at], end))));
    const [low, high] = [Math.min(...ends, 0), Math.max(...ends, 0)];
    const off = (end) => onAxis(body, end).distanceTo(this.ball.center);
    const outward = isParallel(body.direction, this.main.toArray())
      ? vector(body.direction).dot(this.main) * this.scene.front
      : off(high) - off(low);
    const side = outward < 0 ? -1 : 1;
    const end = (side > 0 ? high : low) + side * 0.03 * size;
    this.crank = crankPart(scene, scene.crank, end, side, size, CHOSEN);
    this.put(this.crank);
  }

  put(part) {
    const mesh = part.mesh ?? part.bar.mesh;
    const holder = new Group();
    holder.matrixAutoUpdate = false;
    holder.add(mesh);
    part.holder = holder;
    this.nodes[part.body].add(holder);
    this.parts.push(part);
  }

  /** Every node where its body stands now. */
  turn() {
    this.scene.bodies.forEach((body, index) => {
      if (body.parent === null) return;
      const joint = this.machine.moves ? this.machine.joint(index) : 0;
      const { matrix } = this.nodes[index];
      const point = vector(body.point);
      matrix.makeRotationAxis(vector(body.direction), joint);
      matrix.setPosition(point.clone().applyMatrix4(matrix).negate().add(point).add(this.shifts[index]));
      this.nodes[index].matrixWorldNeedsUpdate = true;
    });
  }

  /** Layers apart: 0 as they stand, 1 fully. */
  explode(share) {
    const { main, ball } = this;
    this.share = share;
    const lift = (point) => main.clone().multiplyScalar(APART * share * point.clone().sub(ball.center).dot(main));
    this.scene.bodies.forEach((body, index) => this.shifts[index].copy(this.skew(index) ? lift(this.anchor(index)) : new Vector3()));
    for (const part of this.parts) {
      const skew = this.isSkew(part.body);
      if (part.bar) part.bar.stretch((point) => (skew ? point : point.add(lift(point))));
      else part.holder.matrix.setPosition(skew ? new Vector3() : lift(part.at));
    }
    this.turn();
  }

  isSkew(index) {
    const { parent, direction } = this.scene.bodies[index];
    return parent !== null && (!isParallel(direction, this.main.toArray()) || this.isSkew(parent));
  }

  /** True where a body's axis leaves the main direction, and its parent's does not. */
  skew(index) {
    const { parent } = this.scene.bodies[index];
    return this.isSkew(index) && !(parent !== null && this.isSkew(parent));
  }

  anchor(index) {
    const own = this.scene.wheels.filter(({ body }) => body === index).map(({ centre }) => vector(centre));
    const sum = own.reduce((total, centre) => total.add(centre), new Vector3());
    return own.length ? sum.divideScalar(own.length) : vector(this.scene.bodies[index].point);
  }

  /** data.wheels   a colour by wheel; else those of the mode */
  paint(mode, data) {
    this.base = data?.wheels ?? colours(this.scene, mode);
    this.recolour();
  }

  highlight(chosen, colour) {
    this.chosen = chosen && { wheels: this.wheelsOf(chosen), colour: colour ?? CHOSEN };
    this.recolour();
  }

  select(wheel) {
    this.selected = wheel;
    this.recolour();
  }

  wheelsOf({ wheels = [], bodies = [], pairs = [] }) {
    const named = (each) => (typeof each === "number" ? this.scene.pairs[each] : this.scene.pairs.find(({ id }) => id === each));
    const found = new Set([...wheels, ...pairs.flatMap((pair) => named(pair)?.wheels ?? [])]);
    this.scene.wheels.forEach(({ body }, index) => bodies.includes(body) && found.add(index));
    return found;
  }

  recolour() {
    const broken = this.wheelsOf({ pairs: this.scene.pairs.map((_, at) => at).filter((at) => this.scene.pairs[at].broken) });
    const colour = new Color();
    this.wheels.forEach((part, index) => {
      colour.set(broken.has(index) ? BROKEN : this.base[index]);
      if (this.chosen?.wheels.has(index)) colour.lerp(new Color(this.chosen.colour), 0.65);
      else if (this.chosen && !broken.has(index)) colour.lerp(new Color(FADED), 0.75);
      if (index === this.selected) colour.set(CHOSEN);
      part.paint(colour);
    });
  }

  /** What stands before the middle, as seen from the front, out of the way: dials first, then wheels. */
  hideFront(hidden) {
    const front = this.main.clone().multiplyScalar(this.scene.front * Math.sign(this.main.z || 1));
    const heights = this.scene.wheels.map(({ centre }) => vector(centre).dot(front));
    const middle = heights.length ? (Math.min(...heights) + Math.max(...heights)) / 2 : 0;
    const flat = heights.length && Math.max(...heights) - Math.min(...heights) < 1e-6;
    for (const part of this.parts) {
      const height = part.at ? part.at.dot(front) : -Infinity;
      const before = part.dial !== undefined || part.wheel !== undefined ? height > middle + 1e-9 && !(flat && part.wheel !== undefined) : false;
      part.holder.visible = !(hidden && before);
    }
  }

  showTeeth(shown) {
    for (const wheel of this.wheels) wheel.showTeeth(shown);
  }

  dispose() {
    this.root.traverse((mesh) => {
      mesh.geometry?.dispose();
    });
  }
}

/** The box that holds all wheels and dials. */
function extent(scene) {
  const box = new Box3();
  const add = (centre, radius) => {
    box.expandByPoint(vector(centre).addScalar(radius));
    box.expandByPoint(vector(centre).subScalar(radius));
  };
  const flat = (centre, radius, direction) => {
    const reach = [0, 1, 2].map((at) => radius * Math.sqrt(Math.max(0, 1 - direction[at] ** 2)));
    box.expandByPoint(vector(centre).add(vector(reach)));
    box.expandByPoint(vector(centre).sub(vector(reach)));
  };
  for (const wheel of scene.wheels) {
    const radius = wheel.kind === "ring" ? ringRim(wheel) : Math.max(wheel.tip, wheel.radius);
    flat(wheel.centre, radius, wheel.direction);
    const bearer = scene.bodies[scene.bodies[wheel.body].parent ?? 0];
    if (bearer.parent === null) continue;
    const middle = onAxis(bearer, along(bearer, wheel.centre)); // it is carried round
    flat(middle.toArray(), middle.distanceTo(vector(wheel.centre)) + radius, bearer.direction);
  }
  for (const dial of scene.dials) flat(dial.centre, dial.radius, dial.normal);
  if (box.isEmpty()) for (const body of scene.bodies) add(body.point, 10);
  return box;
}

/** The direction of most wheels. */
function mainDirection(scene) {
  const counts = new Map();
  for (const { direction } of scene.wheels) {
    const key = direction.map((value) => Math.abs(value).toFixed(4)).join(" ");
    counts.set(key, { direction, count: (counts.get(key)?.count ?? 0) + 1 });
  }
  const most = [...counts.values()].sort((one, other) => other.count - one.count)[0];
  const main = most ? vector(most.direction) : new Vector3(0, 0, 1);
  return main.dot(new Vector3(0, 0, 1)) < 0 ? main.negate() : main;
}
