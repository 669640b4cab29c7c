// A stage: a three-dimensional picture of a train on a canvas, with a camera. It is drawn only after changes.

import { Color, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { aimAt } from "./aim.js";
import { Fraction } from "./fraction.js";
import { frame } from "./framing.js";
import { Hands } from "./picking.js";
import { vector } from "./space.js";
import { World } from "./world.js";

const DEGREE = Math.PI / 180;
const FIELD = 26; // field of view [deg]
const LOOKS = { front: [0, 0, 1], back: [0, 0, -1], side: [1, 0, 0], free: [0.36, 0.3, 0.88] };
// alternative oblique directions, in order of preference: degrees above, and to the right
const OTHERS = [17, 38, 58, 4].flatMap((above) => [25, -25, 0, 55, -55].map((aside) => [above * DEGREE, aside * DEGREE])).map(([above, aside]) => [Math.sin(aside) * Math.cos(above), Math.sin(above), Math.cos(aside) * Math.cos(above)]);
const BETTER = 1.13; // minimum ratio of visibilities for which the initial view is from another side
const NEARLY = 0.95; // relative to the best visibility
const INTO = [0.62, 0.46, 0.64]; // oblique view into a train that is cut open
const BEHIND = [INTO[0], INTO[1], -INTO[2]]; // the same from behind
const MOUTH = [LOOKS.free[0], LOOKS.free[1], -LOOKS.free[2]]; // towards the teeth of a flexible wheel, if its cup is in front of them
const MARGIN = 1.05;
const NEAR = 1.7; // distance of the camera from a part, relative to that at which the part fills the picture
const BEYOND = 0.02; // distance of a part behind the middle for which it is seen from behind, relative to the size of the train
const FLIGHT = 1200; // [ms] to another part
const ASIDE = 0.55; // cosine of the angle between the view of a full exploded view and the main direction

export class Stage {
  /** Throws an error without WebGL. options: {background, teeth} */
  constructor(canvas, machine, options = {}) {
    this.canvas = canvas;
    this.machine = machine;
    this.onPick = () => {};
    this.onCrank = () => {};
    this.onOrbit = () => {};
    this.onDraw = () => {};
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: false, stencil: false });
    this.renderer.debug.checkShaderErrors = false; // a check would wait for the GPU
    this.world = new World(machine);
    this.world.cutOpen(options.cutaway ?? Boolean(this.world.quarter?.hides));
    this.toothed = options.teeth !== false;
    this.setting = new Scene();
    this.setting.matrixAutoUpdate = false;
    this.setting.add(this.world.root);
    this.camera = new PerspectiveCamera(FIELD, 1, 0.02 * this.world.size, 60 * this.world.size);
    this.camera.up.set(...machine.scene.up);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.minDistance = 0.1 * this.world.size;
    this.controls.maxDistance = 30 * this.world.size;
    this.controls.addEventListener("change", () => this.request());
    this.controls.addEventListener("start", () => (this.orbiting = true));
    this.controls.addEventListener("change", () => this.orbited());
    this.controls.addEventListener("end", () => (this.orbiting = false));
    this.hands = new Hands(this);
    this.theme({ background: options.background ?? "#f4f1ea" });
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(canvas);
    this.look("free");
    this.resize();
  }

  /** turns   turns of the driving link: a number, or exact text such as `235/19` */
  setTurns(turns) {
    this.machine.turns = Fraction.of(turns);
    this.turned = true;
    this.request();
  }

  paint(mode, data) {
    this.change(() => this.world.looks.paint(mode, data));
  }

  highlight(chosen, colour) {
    this.change(() => this.world.looks.highlight(chosen, colour));
  }

  select(wheel) {
    this.change(() => this.world.looks.select(wheel));
  }

  /** Exploded view; the camera moves back as the extent grows, and keeps its direction; in the free view it turns sideways. */
  explode(share) {
    const before = this.framed();
    this.change(() => this.world.explode(Math.min(1, Math.max(0, share))));
    if (!this.width) return;
    if (this.from === "free") {
      this.look("free");
      return;
    }
    const after = this.framed(before.towards);
    const { position } = this.camera;
    const off = position.clone().sub(this.controls.target).multiplyScalar(after.distance / before.distance);
    this.controls.target.add(after.target).sub(before.target);
    position.copy(this.controls.target).add(off);
    this.controls.update();
  }

  hideFront(hidden) {
    const { main } = this.world;
    const front = main.clone().multiplyScalar(this.machine.scene.front * Math.sign(main.z || 1));
    this.change(() => this.world.looks.hideBefore(hidden ? front : null));
  }

  /** Shows teeth or plain discs; discs until `cut` has been called. */
  showTeeth(shown) {
    this.toothed = shown;
    if (shown && this.whole && !this.world.cut) this.world.castTeeth();
    this.change(() => this.world.looks.showTeeth(shown && Boolean(this.world.cut)));
  }

  /** True if there are rings that can be cut open. */
  get canOpen() {
    return Boolean(this.world.quarter);
  }

  /** Cuts a quarter out of rings, drums and plates, or closes it; an oblique view then looks into the cut. */
  cutOpen(opened) {
    this.change(() => this.world.cutOpen(opened));
    if (this.from === "free") this.look("free");
  }

  /** Adds the teeth, if requested: most of the work, done after the other parts are visible. */
  cut() {
    if (this.disposed) return;
    this.whole = true;
    this.showTeeth(this.toothed);
  }

  theme({ background }) {
    this.change(() => this.renderer.setClearColor(new Color(background)));
  }

  change(make) {
    make();
    this.request();
  }

  /** Replaces the machine by another one of the same train. */
  rebuild(machine) {
    if (this.disposed) return;
    const { opened, poses: { share } } = this.world;
    const { chosen, selected } = this.world.looks;
    this.setting.remove(this.world.root);
    this.world.dispose();
    this.machine = machine;
    this.world = new World(machine);
    this.setting.add(this.world.root);
    this.world.explode(share);
    this.world.cutOpen(opened);
    this.showTeeth(this.toothed);
    Object.assign(this.world.looks, { chosen, selected });
    this.turned = true;
    this.request();
  }

  /** Moves the camera to a part of a tour, {kind, name}, and highlights it; with null, to the whole train. */
  visit(part, colour, calm) {
    const { points, towards = null, chosen = null } = part ? aimAt(this.world, part) : { points: this.world.outline() };
    this.highlight(chosen, colour);
    const way = towards ?? this.nearer(points);
    const { target, distance } = frame(points, way, ...this.slopes);
    const whole = this.framed(way).distance;
    this.from = null;
    this.onOrbit();
    this.fly(target, target.clone().addScaledVector(way, part ? Math.min(NEAR * distance, whole) : whole), calm ? 0 : FLIGHT);
  }

  /** The initial viewing direction, reflected if points are on the other side of the train. */
  nearer(points) {
    const { main, ball, size } = this.world;
    const way = this.opening().clone();
    const depth = points.reduce((sum, point) => sum + point.clone().sub(ball.center).dot(main), 0) / points.length;
    const straight = way.dot(main);
    return depth * straight < -BEYOND * size ? way.addScaledVector(main, -2 * straight) : way;
  }

  /** Moves the camera and its target within a time [ms]. */
  fly(target, position, time) {
    const { camera, controls } = this;
    const [from, eye, began, own] = [controls.target.clone(), camera.position.clone(), performance.now(), (this.flight = {})];
    const move = (now) => {
      if (this.flight !== own || this.disposed || this.orbiting) return;
      const part = time ? Math.min(1, Math.max(0, now - began) / time) : 1;
      const share = part * part * (3 - 2 * part);
      controls.target.lerpVectors(from, target, share);
      camera.position.lerpVectors(eye, position, share);
      controls.update();
      this.request();
      if (part < 1) requestAnimationFrame(move);
    };
    move(began);
  }

  /** Moves the camera to the front, the back, a side, or an oblique view, with the whole train in the picture. */
  look(from) {
    const straight = from in LOOKS && from !== "free";
    this.from = from;
    if (straight) this.fit(this.towards(LOOKS[from]));
    else this.fit(this.aside(this.opening()));
  }

  /** A viewing direction, given relative to the front; for an observer above, to the side on which the front is lowest. */
  towards([x, y, z]) {
    const { front = 1, up } = this.machine.scene;
    if (up[2] && (x || y)) return vector([x * front, -z, y * front]).normalize();
    return vector([x * front, y, z * front]).normalize();
  }

  /** The initial viewing direction: obliquely from the front, or a direction with better visible wheels; cached for each aspect ratio. */
  opening() {
    const { aspect } = this.camera;
    const { opened } = this.world;
    const [others, usual] = opened ? [[BEHIND], INTO] : [this.machine.scene.waves.length ? [MOUTH] : OTHERS, LOOKS.free];
    if (this.found?.aspect !== aspect || this.found.opened !== opened) this.found = { aspect, opened, towards: this.bestOf(others.map((way) => this.towards(way)), this.towards(usual)) };
    return this.found.towards;
  }

  /** The usual direction, unless the wheels are much better visible from another one. */
  bestOf(others, usual) {
    if (this.machine.scene.dials.length) return usual; // dials are read from there
    const seen = (towards) => {
      const { target, distance } = this.framed(towards);
      return this.world.sight.seen(target.addScaledVector(towards, distance));
    };
    const ways = others.map((towards) => ({ towards, share: seen(towards) }));
    const best = Math.max(...ways.map(({ share }) => share));
    return best > BETTER * seen(usual) ? ways.find(({ share }) => share > NEARLY * best).towards : usual;
  }

  /** A viewing direction, turned away from the main direction according to the exploded view. */
  aside(towards) {
    const { main, poses } = this.world;
    const straight = towards.dot(main);
    const least = Math.min(Math.abs(straight), ASIDE);
    const along = Math.sign(straight) * (Math.abs(straight) + poses.share * (least - Math.abs(straight)));
    const across = towards.clone().addScaledVector(main, -straight).normalize();
    return across.multiplyScalar(Math.sqrt(1 - along * along)).addScaledVector(main, along);
  }

  /** Moves the camera to a direction, as near as the extent allows. */
  fit(towards) {
    this.flight = null;
    const { target, distance } = this.framed(towards);
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(towards, distance);
    this.controls.update();
    this.request();
  }

  /** The camera position, as near as the extent allows, in the current direction or another one. */
  framed(towards = this.camera.position.clone().sub(this.controls.target).normalize()) {
    return { towards, ...frame(this.world.outline(this.from === "free" ? towards : null), towards, ...this.slopes) };
  }

  /** Upward direction, and tangents of half the field of view, horizontally and vertically, reduced by a margin. */
  get slopes() {
    const high = Math.tan((FIELD * DEGREE) / 2) / MARGIN;
    return [this.machine.scene.up, high * this.camera.aspect, high];
  }

  orbited() {
    if (!this.orbiting || this.from === null) return;
    this.from = null;
    this.onOrbit();
  }

  /** Adapts the picture to the size of the canvas; has no effect while it is hidden. */
  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height || this.disposed) return;
    const density = Math.min(globalThis.devicePixelRatio || 1, 2);
    if (this.width === width && this.height === height && this.density === density) return;
    Object.assign(this, { width, height, density });
    this.renderer.setPixelRatio(density);
    this.renderer.setSize(width, height, false);
    this.world.sparks?.scale(density * Math.min(width, height));
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.from !== null) this.look(this.from);
    this.render(); // at once: a resized canvas is blank
  }

  request() {
    if (this.waiting || this.disposed) return;
    this.waiting = requestAnimationFrame(() => this.render());
  }

  render() {
    cancelAnimationFrame(this.waiting);
    this.waiting = 0;
    if (!this.width || this.disposed) return;
    if (this.turned) this.world.turn();
    this.turned = false;
    this.world.glaze(this.camera.position);
    this.world.refresh();
    this.renderer.render(this.setting, this.camera);
    this.onDraw();
  }

  /** Turns of the driving link for a rotation of the crank (rad) relative to its parent. */
  leadOf(swept) {
    const { bodies, crank } = this.machine.scene;
    const own = bodies[crank];
    const bearer = bodies[own.parent];
    const ratio = (body) => body.sense * Number(Fraction.of(body.speed ?? "0"));
    const speed = ratio(own) - ratio(bearer);
    return speed ? swept / (2 * Math.PI * speed) : 0;
  }

  /** Releases all resources; a browser has few drawing contexts. */
  dispose() {
    this.disposed = true;
    cancelAnimationFrame(this.waiting);
    this.observer.disconnect();
    this.hands.dispose();
    this.controls.dispose();
    this.world.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}
