// A wheel as drawn: its body, its teeth as copies of one tooth, and a plain rim that replaces the teeth.

import { armsShape, coneShape, lanternShape, plainRimShape, webOf, wormShape } from "./blanks.js";
import { ringRim } from "./extent.js";
import { flatShape } from "./parts.js";
import { frameAt, vector } from "./space.js";
import { arcOf, blankOf, pinShape, toothShape } from "./tooth.js";

const MOST_TEETH = 2000; // maximum for one wheel: more teeth cannot be distinguished
const MANY_TEETH = 12000; // number of teeth of a train above which all teeth are simplified
const SEEN = 0.0005; // relative to the train's size: smaller deviations of a tooth's outline are not drawn
const GLOSS = 0.75;
const BROKEN_EDGE = 0.1; // chamfer of the outside of a ring, relative to its thickness

export class WheelPart {
  /** index   index of the wheel in the scene; `hub`: radius of its arbor (mm); `size`: size of the train (mm) */
  constructor(scene, index, hub, size, palette) {
    const wheel = scene.wheels[index];
    Object.assign(this, { scene, index, wheel, size, palette });
    this.at = vector(wheel.centre);
    this.matrix = frameAt(wheel.centre, wheel.direction, wheel.reference, wheel.turn);
    [this.own, this.toothed, this.smooth] = [0, 1, 2].map(() => palette.slot("#ffffff", GLOSS, wheel.kind === "ring"));
    this.profile = scene.profiles[wheel.profile];
    this.apex = -wheel.facing || 1;
    this.surface = blankOf(alongThread(scene, index), this.apex);
    const radii = this.profile.points.map(([radius]) => radius);
    const ring = wheel.kind === "ring";
    this.wave = scene.waves.find((wave) => wave.wheel === index);
    this.root = ring ? Math.max(...radii) : Math.min(...radii);
    this.crest = Math.max(...radii);
    this.depth = (Math.max(...radii) - Math.min(...radii)) * wheel.radius;
    this.hub = Math.min(hub, 0.4 * Math.abs(this.root) * wheel.radius);
  }

  get slots() {
    return [this.own, this.toothed, this.smooth];
  }

  /** Radius at which the sectors with the teeth begin: inside of the rim, outside of a ring, or the edge of a disc with holes. */
  get seat() {
    const { wheel, root, hub, depth, wave } = this;
    const radius = root * wheel.radius;
    if (wheel.kind === "ring") return ringRim(wheel);
    if (wave) return radius - wave.wall;
    return wheel.holes.length ? (1 - Math.min(0.03, 0.1 * root)) * radius : webOf(radius, hub, depth).rim;
  }

  /** Adds the body within the teeth, and the plain rim. */
  castBody(add) {
    const { wheel, root, hub, size, depth, seat } = this;
    const { kind, radius, thickness, cone, holes } = wheel;
    if (kind === "worm") return add(this.worm(), this.matrix, this.own);
    if (this.profile.hole) return add(lanternShape(this.crest * 1.08 * radius, thickness, hub), this.matrix, this.own);
    if (cone) {
      add(coneShape(this.surface, root - 0.01, this.apex, thickness, hub), this.matrix, this.toothed);
      return add(coneShape(this.surface, 1, this.apex, thickness, hub), this.matrix, this.smooth);
    }
    if (holes.length) add(flatShape({ outlines: [this.edge(), ...holes], height: thickness }, 1), this.matrix, this.own);
    else if (kind !== "ring" && !this.wave) add(armsShape(root * radius, thickness, webOf(root * radius, hub, depth)), this.matrix, this.own);
    add(plainRimShape(Math.min(seat, radius), Math.max(seat, radius), 0.96 * thickness, size), this.matrix, this.smooth);
  }

  /** Adds the teeth; `many` is the number of teeth of the train. */
  castTeeth(add, many) {
    const { wheel, profile, surface, root, apex, seat } = this;
    if (wheel.kind === "worm") return;
    const fine = many > MANY_TEETH ? 0.3 : Math.min(0.3, Math.max(0.02, (SEEN * this.size) / this.depth));
    const base = wheel.cone ? root - Math.min(0.03, 0.1 * root) : seat / wheel.radius;
    const walled = wheel.cone || wheel.holes.length ? null : wheel.kind === "ring" ? BROKEN_EDGE : 0;
    const shape = profile.hole ? pinShape(profile.points, surface) : toothShape(profile.points, base, surface, fine, { hand: wheel.cone ? apex : 1, walled });
    add(shape, this.matrix, profile.hole ? this.own : this.toothed, Math.min(wheel.teeth, MOST_TEETH));
  }

  /** The edge of a disc below its teeth, which shares its vertices with them. */
  edge() {
    const half = Math.PI / this.wheel.teeth;
    const angles = Array.from({ length: this.wheel.teeth }, (_, n) => arcOf((2 * n - 1) * half, (2 * n + 1) * half).slice(1)).flat();
    return angles.flatMap((angle) => [this.seat * Math.cos(angle), this.seat * Math.sin(angle)]);
  }

  worm() {
    const { lead, length } = threadOf(this.scene, this.index);
    return wormShape(this.wheel, lead, length);
  }

  paint(look) {
    for (const slot of this.slots) this.palette.paint(slot, look);
  }

  /** shown   true if the wheel is visible; `toothed`: with its teeth */
  show(shown, toothed) {
    this.palette.paint(this.own, { shown });
    this.palette.paint(this.toothed, { shown: shown && toothed });
    this.palette.paint(this.smooth, { shown: shown && !toothed });
  }
}

const mates = (scene, index) =>
  scene.pairs.filter(({ wheels }) => wheels.includes(index)).map(({ wheels: [one, other] }) => (one === index ? other : one));

/** The wheel, with teeth along the thread if it meshes with a worm. */
function alongThread(scene, index) {
  const worm = mates(scene, index).find((at) => scene.wheels[at].kind === "worm");
  if (worm === undefined) return scene.wheels[index];
  return { ...scene.wheels[index], helix: Math.atan(threadOf(scene, worm).lead / (2 * Math.PI * scene.wheels[worm].radius)) };
}

/** Lead of a worm's thread (mm per turn, negative for a left hand), with the hand that agrees with the speeds. */
function threadOf(scene, index) {
  const worm = scene.wheels[index];
  const mate = mates(scene, index).map((at) => scene.wheels[at])[0];
  if (!mate) return { lead: worm.radius, length: worm.thickness };
  const lead = (worm.teeth * 2 * Math.PI * mate.radius) / mate.teeth;
  const [own, other] = [worm, mate].map(({ body }) => Math.sign(Number.parseFloat(scene.bodies[body].speed ?? "0")) * scene.bodies[body].sense);
  const contact = vector(worm.centre).sub(vector(mate.centre));
  const push = vector(mate.direction).cross(contact).dot(vector(worm.direction)) * other;
  const hand = push * own > 0 ? -1 : 1; // a right-handed thread that turns in the positive sense moves backwards
  return { lead: hand * lead, length: Math.max(worm.thickness, Math.min(3 * Math.abs(lead), mate.radius)) };
}
