// A moving plan of a train for browsers without WebGL. It has the methods of a `Stage`, but draws in SVG: pitch circles
// with a spoke each, and dials with their hands, in orthographic projection.

import { ballOf, circlesOf, mainDirection, outlineOf, partingOf, pointsOf, ringRim } from "./extent.js";
import { Fraction } from "./fraction.js";
import { Looks } from "./looks.js";
import { Poses } from "./poses.js";
import { frameAt, isParallel, vector } from "./space.js";
import { svg } from "./ui/element.js";

const ROUND = 48; // corners of a circle
const MOSTLY = 0.75; // fraction of the wheels in the plane of a flat train
const SLANTED = [0.42, 0.38, 0.82];
const LOOKS = { front: [0, 0, 1], back: [0, 0, -1], side: [1, 0, 0], free: SLANTED };
const LEGIBLE = 0.045; // minimum radius of a wheel with a name, relative to the width of the plan
const NO_LOOK = { slot: () => 0, paint: () => {} }; // `Looks` paints parts in a palette, and a plan has none

export class Plan {
  constructor(machine) {
    Object.assign(this, { onPick: () => {}, onCrank: () => {}, onOrbit: () => {} });
    this.#build(machine);
    this.paint("plain");
    this.look("free");
  }

  /** Replaces the machine by another one of the same train. */
  rebuild(machine) {
    const { share } = this.poses;
    this.#build(machine);
    this.paint("plain");
    this.explode(share);
  }

  #build(machine) {
    const { scene } = machine;
    Object.assign(this, { machine, scene });
    this.main = mainDirection(scene);
    const circles = circlesOf(scene);
    const parting = partingOf(scene, circles.flatMap(pointsOf), this.main);
    this.poses = new Poses(machine, this.main, ballOf(scene, circles).center, parting);
    const along = scene.wheels.filter(({ direction }) => isParallel(direction, this.main.toArray()));
    this.flat = along.length > MOSTLY * scene.wheels.length;
    this.canvas ??= svg("svg", { class: "plan" });
    this.canvas.replaceChildren();
    this.wheels = scene.wheels.map((wheel, index) => new PlanWheel(this, wheel, index));
    this.hands = scene.pointers.filter(({ dial }) => dial !== null).map((pointer) => new PlanHand(this, pointer));
    this.faces = scene.dials.map((dial) => new PlanFace(this, dial));
    this.looks = new Looks(scene, NO_LOOK, this.wheels, []);
  }

  setTurns(turns) {
    this.machine.turns = Fraction.of(turns);
    this.request();
  }

  paint(mode, data) {
    this.looks.paint(mode, data);
  }

  highlight(chosen, colour) {
    this.looks.highlight(chosen, colour);
  }

  select(wheel) {
    this.looks.select(wheel);
  }

  explode(share) {
    this.poses.explode(share);
    this.fit();
  }

  hideFront(hidden) {
    this.looks.hideBefore(hidden ? this.main.clone().multiplyScalar(this.scene.front * Math.sign(this.main.z || 1)) : null);
    for (const { node } of [...this.faces, ...this.hands]) node.style.display = hidden ? "none" : "";
  }

  /** Sets the side from which the train is seen; the free view of a flat train is its front. */
  look(from) {
    const [x, y, z] = LOOKS[from === "free" && this.flat ? "front" : from] ?? SLANTED;
    const front = this.scene.front || 1;
    this.towards = vector([x * front, y, z * front]).normalize();
    this.right = vector([0, 1, 0]).cross(this.towards).normalize();
    this.up = this.towards.clone().cross(this.right);
    this.fit();
  }

  fit() {
    const seen = outlineOf(this.scene, this.poses).map((point) => this.seen(point));
    const range = (at) => [Math.min(...seen.map((point) => point[at])), Math.max(...seen.map((point) => point[at]))];
    const [[left, right], [top, bottom]] = [range(0), range(1)];
    this.width = Math.max(right - left, bottom - top, 1e-6);
    const margin = 0.04 * this.width;
    this.canvas.setAttribute("viewBox", [left - margin, top - margin, right - left + 2 * margin, bottom - top + 2 * margin].join(" "));
    this.render();
  }

  /** Coordinates of a point on the page: to the right, and downwards. */
  seen(point) {
    return [point.dot(this.right), -point.dot(this.up)];
  }

  /** The path through points of a body, given in its zero pose, in the current pose; displaced in an exploded view like `at`. */
  path(body, at, points) {
    const off = this.poses.share * this.poses.lift(body, at);
    const { matrixWorld } = this.poses.nodes[body];
    const now = (point) => this.seen(point.clone().addScaledVector(this.main, off).applyMatrix4(matrixWorld));
    return `M${points.map((point) => now(point).map((part) => part.toFixed(3)).join(" ")).join("L")}`;
  }

  request() {
    this.waiting ||= requestAnimationFrame(() => this.render());
  }

  render() {
    cancelAnimationFrame(this.waiting);
    this.waiting = 0;
    this.poses.turn(new Float32Array(16 * this.poses.nodes.length));
    const parts = [...this.faces, ...this.wheels, ...this.hands];
    for (const part of parts) part.draw();
    const order = parts.sort((one, other) => one.depth - other.depth).map(({ node }) => node);
    if (order.some((node, at) => node !== this.canvas.children[at])) this.canvas.replaceChildren(...order);
  }

  /** Coordinate of a point of a body towards the reader. */
  depth(body, point) {
    return point.clone().applyMatrix4(this.poses.nodes[body].matrixWorld).dot(this.towards);
  }

  // methods that have an effect only in a `Stage`
  cut() {}
  showTeeth() {}
  theme() {}
  resize() {}

  dispose() {
    cancelAnimationFrame(this.waiting);
  }
}

/** A wheel as its pitch circle, with a spoke to its first tooth, and for a ring its rim. */
class PlanWheel {
  constructor(plan, wheel, index) {
    const { id, teeth, kind, body, centre, direction, reference, turn } = wheel;
    Object.assign(this, { plan, wheel, body, at: vector(centre), ring: kind === "ring" });
    this.frame = frameAt(centre, direction, reference, turn);
    this.disc = svg("path", { class: "disc" });
    this.spoke = svg("path", { class: "spoke" });
    this.name = svg("text", {}, id);
    const title = svg("title", {}, `${id}, ${teeth} teeth`);
    this.node = svg("g", { class: "wheel", "data-wheel": id, onclick: () => plan.onPick(index) }, title, this.disc, this.spoke, this.name);
  }

  paint({ colour, opacity }) {
    this.disc.setAttribute("fill", `#${colour.getHexString()}`);
    this.disc.setAttribute("stroke", `#${colour.clone().multiplyScalar(0.35).getHexString()}`);
    this.node.setAttribute("opacity", opacity);
  }

  show(shown) {
    this.node.style.display = shown ? "" : "none";
  }

  draw() {
    const { plan, body, wheel, frame, ring } = this;
    const path = (points) => plan.path(body, this.at, points);
    const [inner, outer] = ring ? [wheel.radius, ringRim(wheel)] : [0, wheel.radius];
    this.disc.setAttribute("d", `${path(round(frame, outer))}Z${ring ? `${path(round(frame, inner))}Z` : ""}`);
    this.spoke.setAttribute("d", path([inner, outer].map((radius) => vector([radius, 0, 0]).applyMatrix4(frame))));
    this.write(path([this.at]).slice(1).split(" ").map(Number));
    this.depth = plan.depth(body, this.at);
  }

  /** Writes the name of the wheel in its middle if there is space. */
  write([x, y]) {
    const { plan, wheel, ring } = this;
    const size = Math.min(0.03 * plan.width, (1.6 * wheel.radius) / Math.max(2, wheel.id.length));
    this.name.textContent = !ring && wheel.radius > LEGIBLE * plan.width ? wheel.id : "";
    for (const [key, value] of Object.entries({ x, y: y + 0.36 * size, "font-size": size })) this.name.setAttribute(key, value.toFixed(3));
  }
}

/** A dial as its circle and its zero mark. */
class PlanFace {
  constructor(plan, dial) {
    Object.assign(this, { plan, dial, at: vector(dial.centre), frame: frameAt(dial.centre, dial.normal, dial.zero) });
    this.rim = svg("path", {});
    this.node = svg("g", { class: "face" }, svg("title", {}, dial.title), this.rim);
  }

  draw() {
    const { plan, dial, at, frame } = this;
    const path = (points) => plan.path(dial.body, at, points);
    const zero = [0.94, 1.06].map((reach) => vector([reach * dial.radius, 0, 0]).applyMatrix4(frame));
    this.rim.setAttribute("d", `${path(round(frame, dial.radius))}Z${path(zero)}`);
    this.depth = plan.depth(dial.body, at);
  }
}

/** A hand: a line from the middle of its dial to its rim. */
class PlanHand {
  constructor(plan, { output, body, dial }) {
    const { centre, normal, zero, radius } = plan.scene.dials[dial];
    const frame = frameAt(centre, normal, zero);
    Object.assign(this, { plan, body, at: vector(centre) });
    this.ends = [0, 0.9 * radius].map((reach) => vector([reach, 0, 0]).applyMatrix4(frame));
    this.line = svg("path", {});
    this.node = svg("g", { class: "pointing", "data-output": output }, svg("title", {}, output), this.line);
  }

  draw() {
    this.line.setAttribute("d", this.plan.path(this.body, this.at, this.ends));
    this.depth = this.plan.depth(this.body, this.at) + 1e-6;
  }
}

/** Points of a circle about the z axis of a frame. */
function round(frame, radius) {
  return Array.from({ length: ROUND }, (_, n) => {
    const angle = (2 * Math.PI * n) / ROUND;
    return vector([radius * Math.cos(angle), radius * Math.sin(angle), 0]).applyMatrix4(frame);
  });
}
