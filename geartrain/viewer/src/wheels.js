// A wheel as drawn: its body, its teeth as instances of one tooth, and a plain disc for when teeth are not wanted.

import { Group } from "three";

import { coneGeometry, discGeometry, lanternGeometry, ringGeometry, wormGeometries } from "./blanks.js";
import { paint, solid } from "./solids.js";
import { frameAt, isParallel, placed, vector } from "./space.js";
import { blankOf, pinGeometry, toothGeometry } from "./tooth.js";

const MOST_TEETH = 2000; // more cannot be told apart

/** Outer radius of a ring wheel (mm), which nothing declares. */
export const ringRim = ({ root, radius, module }) => Math.max(root, radius) + 2 * Math.max(module, 0.02 * radius);

export class WheelPart {
  /** index   of the wheel in the scene; `hub`, radius of its arbor (mm); `size`, of the train (mm) */
  constructor(scene, index, hub, size, teeth) {
    const wheel = scene.wheels[index];
    this.index = index;
    this.wheel = wheel;
    this.meshes = [];
    this.toothed = new Group();
    this.smooth = new Group();
    this.node = placed(frameAt(wheel.centre, wheel.direction, wheel.reference, wheel.turn), this.toothed, this.smooth);
    if (wheel.kind === "worm") this.worm(scene);
    else this.cut(scene, hub, size, teeth);
    this.showTeeth(true);
  }

  cut(scene, hub, size, teeth) {
    const { wheel } = this;
    const profile = scene.profiles[wheel.profile];
    const apex = apexSide(scene, this.index);
    const at = blankOf(wheel, apex);
    const radii = profile.points.map(([radius]) => radius);
    const ring = wheel.kind === "ring";
    const root = ring ? Math.max(...radii) : Math.min(...radii);
    const base = ring ? root + 0.02 : root - Math.min(0.03, 0.1 * root);
    const own = Math.min(hub, 0.4 * root * wheel.radius);
    const body = (to) => this.body(to * wheel.radius, to, at, apex, own, size, profile.hole);
    this.add(this.toothed, body(profile.hole ? Math.max(...radii) * 1.08 : root));
    const geometry = teeth.of(wheel, apex, profile, () =>
      profile.hole ? pinGeometry(profile.points, at) : toothGeometry(profile.points, base, at));
    this.add(this.toothed, geometry, wheel.teeth);
    this.add(this.smooth, body(1));
  }

  body(radius, share, at, apex, hub, size, lantern) {
    const { kind, thickness, cone } = this.wheel;
    if (lantern) return lanternGeometry(radius, thickness, hub);
    if (kind === "ring") return ringGeometry(radius, ringRim(this.wheel), thickness, size);
    if (cone) return coneGeometry(at, share - 0.01, apex, thickness, hub);
    return discGeometry(radius, thickness, hub, size);
  }

  add(group, geometry, count = 1) {
    const mesh = solid(geometry, "#ffffff", Math.min(count, MOST_TEETH));
    mesh.userData.wheel = this.index;
    this.meshes.push(mesh);
    group.add(mesh);
  }

  paint(colour) {
    for (const mesh of this.meshes) paint(mesh, colour);
  }

  worm(scene) {
    const { lead, length } = threadOf(scene, this.index);
    for (const geometry of wormGeometries(this.wheel, lead, length)) this.add(this.toothed, geometry);
    this.add(this.smooth, wormGeometries({ ...this.wheel, teeth: 0 }, lead, length)[0]);
  }

  showTeeth(shown) {
    this.toothed.visible = shown;
    this.smooth.visible = !shown;
  }
}

/** Teeth that are alike are one geometry. */
export class Teeth {
  constructor() {
    this.known = new Map();
  }

  of(wheel, apex, profile, make) {
    const key = [wheel.profile, wheel.radius, wheel.thickness, wheel.cone, apex].join(" ");
    if (!this.known.has(key)) this.known.set(key, make());
    return this.known.get(key);
  }
}

const mates = (scene, index) =>
  scene.pairs.filter(({ wheels }) => wheels.includes(index)).map(({ wheels: [one, other] }) => (one === index ? other : one));

/** On which side of a tapered wheel, along its direction, its apex lies, or a crown's teeth stand: where its mate is. */
function apexSide(scene, index) {
  const wheel = scene.wheels[index];
  if (!wheel.cone) return 1;
  const mate = mates(scene, index).map((at) => scene.wheels[at]).find((other) => !isParallel(other.direction, wheel.direction));
  if (!mate) return wheel.facing || 1;
  const height = wheel.radius / Math.tan(Math.min(wheel.cone, Math.PI / 2 - 1e-9));
  const gap = (side) => {
    const apex = vector(wheel.centre).addScaledVector(vector(wheel.direction), side * height);
    const line = vector(mate.direction);
    const off = apex.sub(vector(mate.centre));
    return off.addScaledVector(line, -off.dot(line)).length();
  };
  const [up, down] = [gap(1), gap(-1)];
  if (Math.abs(up - down) > 1e-6 * wheel.radius) return up < down ? 1 : -1;
  return vector(mate.centre).sub(vector(wheel.centre)).dot(vector(wheel.direction)) >= 0 ? 1 : -1;
}

/** Lead of a worm's thread (mm a turn, negative for a left hand), so that it drives its wheel as the speeds say. */
function threadOf(scene, index) {
  const worm = scene.wheels[index];
  const mate = mates(scene, index).map((at) => scene.wheels[at])[0];
  if (!mate) return { lead: worm.radius, length: worm.thickness };
  const lead = (worm.teeth * 2 * Math.PI * mate.radius) / mate.teeth;
  const [own, other] = [worm, mate].map(({ body }) => Math.sign(Number.parseFloat(scene.bodies[body].speed ?? "0")) * scene.bodies[body].sense);
  const contact = vector(worm.centre).sub(vector(mate.centre));
  const push = vector(mate.direction).cross(contact).dot(vector(worm.direction)) * other;
  const hand = push * own > 0 ? -1 : 1; // a right-handed thread that turns forward runs backward
  return { lead: hand * lead, length: Math.max(worm.thickness, Math.min(3 * Math.abs(lead), mate.radius)) };
}
