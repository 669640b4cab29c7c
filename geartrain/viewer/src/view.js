// A stage: a train in space on a canvas, with a camera. It draws only when something has changed.

import { AmbientLight, Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { Fraction } from "./fraction.js";
import { Hands } from "./picking.js";
import { vector } from "./space.js";
import { World } from "./world.js";

const FIELD = 30; // degrees
const LOOKS = { front: [0, 0, 1], back: [0, 0, -1], side: [1, 0, 0], free: [0.42, 0.36, 0.83] };

export class Stage {
  /** Throws where there is no WebGL. options: {background, teeth} */
  constructor(canvas, machine, options = {}) {
    this.canvas = canvas;
    this.machine = machine;
    this.onPick = () => {};
    this.onCrank = () => {};
    this.frameMilliseconds = 0;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: false });
    this.renderer.debug.checkShaderErrors = false; // asking would wait for the GPU
    this.world = new World(machine);
    this.setting = new Scene();
    this.setting.matrixAutoUpdate = false;
    this.setting.add(this.world.root);
    this.light();
    this.camera = new PerspectiveCamera(FIELD, 1, 0.01 * this.world.size, 40 * this.world.size);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.request());
    this.hands = new Hands(this);
    this.theme({ background: options.background ?? "#f4f1ea" });
    if (options.teeth === false) this.showTeeth(false);
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(canvas);
    this.look("free");
    this.resize();
  }

  light() {
    const lamp = new DirectionalLight(0xfff6e8, 1.9);
    lamp.position.set(0.5, 1, 0.7);
    this.headlamp = new DirectionalLight(0xffffff, 1.5);
    this.setting.add(new AmbientLight(0xffffff, 0.7), new HemisphereLight(0xffffff, 0x8d8578, 0.9), lamp, this.headlamp);
  }

  /** turns   of the lead: a number, or exact text such as `235/19` */
  setTurns(turns) {
    this.machine.turns = Fraction.of(turns);
    this.turned = true;
    this.request();
  }

  paint(mode, data) {
    this.change(() => this.world.paint(mode, data));
  }

  highlight(chosen, colour) {
    this.change(() => this.world.highlight(chosen, colour));
  }

  select(wheel) {
    this.change(() => this.world.select(wheel));
  }

  explode(share) {
    this.change(() => this.world.explode(Math.min(1, Math.max(0, share))));
  }

  hideFront(hidden) {
    this.change(() => this.world.hideFront(hidden));
  }

  showTeeth(shown) {
    this.change(() => this.world.showTeeth(shown));
  }

  theme({ background }) {
    this.change(() => this.renderer.setClearColor(new Color(background)));
  }

  change(make) {
    make();
    this.request();
  }

  /** The camera to the front, the back, a side, or slantwise; the whole train in the picture. */
  look(from) {
    const { ball } = this.world;
    const [x, y, z] = LOOKS[from] ?? LOOKS.free;
    const front = this.machine.scene.front || 1;
    this.from = from;
    const towards = vector([x * front, y, z * front]).normalize();
    this.controls.target.copy(ball.center);
    this.camera.position.copy(towards).add(ball.center); // `distance` looks along it
    const away = this.distance();
    this.camera.position.copy(towards).multiplyScalar(away).add(ball.center);
    this.controls.update();
    this.request();
  }

  /** How far the camera stands off, in its present direction, for the whole train to be in the picture. */
  distance() {
    const { box, ball } = this.world;
    const high = Math.tan((FIELD * Math.PI) / 360);
    const towards = this.camera.position.clone().sub(this.controls.target).normalize();
    const right = vector([0, 1, 0]).cross(towards).normalize();
    const up = towards.clone().cross(right);
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((n) => vector([n & 1, n & 2, n & 4].map((bit, at) => (bit ? box.max : box.min).getComponent(at))));
    const needed = corners.map((corner) => {
      const off = corner.sub(ball.center);
      const across = Math.abs(off.dot(right)) / (high * this.camera.aspect);
      return off.dot(towards) + Math.max(across, Math.abs(off.dot(up)) / high);
    });
    return 1.1 * Math.max(...needed);
  }

  /** To the size the page gives the canvas; nothing happens while it is hidden. */
  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    const density = Math.min(globalThis.devicePixelRatio || 1, 2);
    if (this.width === width && this.height === height && this.density === density) return;
    const first = this.width === undefined;
    const before = this.camera.position.distanceTo(this.controls.target) / this.distance();
    Object.assign(this, { width, height, density });
    this.renderer.setPixelRatio(density);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const off = this.camera.position.clone().sub(this.controls.target);
    this.camera.position.copy(off.setLength(this.distance() * (first ? 1 : before)).add(this.controls.target));
    this.controls.update();
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
    this.headlamp.position.copy(this.camera.position).sub(this.controls.target);
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

  dispose() {
    this.disposed = true;
    cancelAnimationFrame(this.waiting);
    this.observer.disconnect();
    this.hands.dispose();
    this.controls.dispose();
    this.world.dispose();
    this.renderer.dispose();
  }
}
