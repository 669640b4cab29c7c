// A stage: a train in space on a canvas, with a camera. It draws only when something has changed.

import { Color, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { Fraction } from "./fraction.js";
import { frame } from "./framing.js";
import { Hands } from "./picking.js";
import { vector } from "./space.js";
import { World } from "./world.js";

const DEGREE = Math.PI / 180;
const FIELD = 26; // degrees
const LOOKS = { front: [0, 0, 1], back: [0, 0, -1], side: [1, 0, 0], free: [0.36, 0.3, 0.88] };
// other ways to look slantwise, the more usual first: degrees above, and to the right
const OTHERS = [17, 38, 58, 4].flatMap((above) => [25, -25, 0, 55, -55].map((aside) => [above * DEGREE, aside * DEGREE])).map(([above, aside]) => [Math.sin(aside) * Math.cos(above), Math.sin(above), Math.cos(aside) * Math.cos(above)]);
const BETTER = 1.13; // times as well wheels must be seen from another side, to begin there
const NEARLY = 0.95; // of the best
const INTO = [0.62, 0.46, 0.64]; // slantwise into a train that is cut open
const BEHIND = [INTO[0], INTO[1], -INTO[2]]; // the same from behind
const MARGIN = 1.05;
const ASIDE = 0.55; // cosine of the way from which layers are seen when taken apart

export class Stage {
  /** Throws where there is no WebGL. options: {background, teeth} */
  constructor(canvas, machine, options = {}) {
    this.canvas = canvas;
    this.machine = machine;
    this.onPick = () => {};
    this.onCrank = () => {};
    this.onOrbit = () => {};
    this.frameMilliseconds = 0;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: false, stencil: false });
    this.renderer.debug.checkShaderErrors = false; // asking would wait for the GPU
    this.world = new World(machine);
    this.world.cutOpen(options.cutaway ?? Boolean(this.world.quarter?.hides));
    this.toothed = options.teeth !== false;
    this.setting = new Scene();
    this.setting.matrixAutoUpdate = false;
    this.setting.add(this.world.root);
    this.camera = new PerspectiveCamera(FIELD, 1, 0.02 * this.world.size, 60 * this.world.size);
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

  /** turns   of the lead: a number, or exact text such as `235/19` */
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

  /** Layers apart; the camera goes back as far as the whole grows, and looks on where it looked; left free, from aside. */
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

  /** Teeth or plain discs; plain until `cut` has been called. */
  showTeeth(shown) {
    this.toothed = shown;
    if (shown && this.whole && !this.world.cut) this.world.castTeeth();
    this.change(() => this.world.looks.showTeeth(shown && Boolean(this.world.cut)));
  }

  /** Whether there are rings to cut open. */
  get canOpen() {
    return Boolean(this.world.quarter);
  }

  /** With a quarter of rings, drums and plates cut out, or whole; what is looked at slantwise is then looked into. */
  cutOpen(opened) {
    this.change(() => this.world.cutOpen(opened));
    if (this.from === "free") this.look("free");
  }

  /** From now on with teeth, if they are wanted: the most of the work, left until the rest is seen. */
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

  /** Another machine of the same train, in the same picture. */
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

  /** The camera to the front, the back, a side, or slantwise; the whole train in the picture. */
  look(from) {
    const straight = from in LOOKS && from !== "free";
    this.from = from;
    if (straight) this.fit(this.towards(LOOKS[from]));
    else this.fit(this.aside(this.opening()));
  }

  /** A way to look, given as from the front. */
  towards([x, y, z]) {
    const front = this.machine.scene.front || 1;
    return vector([x * front, y, z * front]).normalize();
  }

  /** From where a reader sees a train first: slantwise from the front, or from where wheels are seen better. Found once for a picture of one shape. */
  opening() {
    const { aspect } = this.camera;
    const { opened } = this.world;
    const [others, usual] = opened ? [[BEHIND], INTO] : [OTHERS, LOOKS.free];
    if (this.found?.aspect !== aspect || this.found.opened !== opened) this.found = { aspect, opened, towards: this.bestOf(others.map((way) => this.towards(way)), this.towards(usual)) };
    return this.found.towards;
  }

  /** The usual way to look, unless from another wheels are seen much better. */
  bestOf(others, usual) {
    if (this.machine.scene.dials.length) return usual; // they are read from there
    const seen = (towards) => {
      const { target, distance } = this.framed(towards);
      return this.world.sight.seen(target.addScaledVector(towards, distance));
    };
    const ways = others.map((towards) => ({ towards, share: seen(towards) }));
    const best = Math.max(...ways.map(({ share }) => share));
    return best > BETTER * seen(usual) ? ways.find(({ share }) => share > NEARLY * best).towards : usual;
  }

  /** A way to look, turned from that of the layers as far as these are apart. */
  aside(towards) {
    const { main, poses } = this.world;
    const straight = towards.dot(main);
    const least = Math.min(Math.abs(straight), ASIDE);
    const along = Math.sign(straight) * (Math.abs(straight) + poses.share * (least - Math.abs(straight)));
    const across = towards.clone().addScaledVector(main, -straight).normalize();
    return across.multiplyScalar(Math.sqrt(1 - along * along)).addScaledVector(main, along);
  }

  /** The camera to a side, as near as the whole allows. */
  fit(towards) {
    const { target, distance } = this.framed(towards);
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(towards, distance);
    this.controls.update();
    this.request();
  }

  /** Where the camera would stand, as near as the whole allows, on the side where it is, or on another. */
  framed(towards = this.camera.position.clone().sub(this.controls.target).normalize()) {
    const high = Math.tan((FIELD * DEGREE) / 2) / MARGIN;
    return { towards, ...frame(this.world.outline(), towards, high * this.camera.aspect, high) };
  }

  orbited() {
    if (!this.orbiting || this.from === null) return;
    this.from = null;
    this.onOrbit();
  }

  /** To the size the page gives the canvas; nothing happens while it is hidden. */
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
    const began = performance.now();
    if (this.turned) this.world.turn();
    this.turned = false;
    this.world.glaze(this.camera.position);
    this.world.refresh();
    this.renderer.render(this.setting, this.camera);
    const took = performance.now() - began;
    this.frameMilliseconds = this.drawn ? 0.9 * this.frameMilliseconds + 0.1 * took : took;
    this.drawn = true;
  }

  /** Turns of the lead when the crank is swept by an angle (rad) about its axis, as its bearer sees it. */
  leadOf(swept) {
    const { bodies, crank } = this.machine.scene;
    const own = bodies[crank];
    const bearer = bodies[own.parent];
    const ratio = (body) => body.sense * Number(Fraction.of(body.speed ?? "0"));
    const speed = ratio(own) - ratio(bearer);
    return speed ? swept / (2 * Math.PI * speed) : 0;
  }

  /** Gives all back, the browser's few drawing contexts first. */
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
