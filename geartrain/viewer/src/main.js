// Start of the page: scenes from its compressed JSON, a machine for each, the interface, and then the pictures.

import { strFromU8, unzlibSync } from "three/examples/jsm/libs/fflate.module.js";
import { Fraction } from "./fraction.js";
import { Machine } from "./motion.js";
import { Plan } from "./plan.js";
import { buildInterface } from "./ui/interface.js";
import { Showcase } from "./ui/showcase.js";
import { Stage } from "./view.js";

const held = document.getElementById("scenes");
const packed = Uint8Array.from(atob(held.textContent), (each) => each.charCodeAt(0));
const { scenes: given, options } = JSON.parse(strFromU8(unzlibSync(packed)));
// a page around this one can choose the first scene
given.unshift(...given.splice(Number(held.dataset.first ?? 0), 1));
// the same train with all drive flanks in contact can be shown next to a simulated run
const scenes = given.flatMap((scene) => (scene.run ? [scene, { ...scene, touching: true }] : [scene]));
const machines = scenes.map((scene) => new Machine(scene));

const app = {
  scenes,
  machines,
  options,
  /** The stages of the displayed scenes, or plans if the browser has no WebGL; null for the others. */
  stages: scenes.map(() => null),
  /** Turns of each scene's driving link for one turn of the crank's driving link. */
  gears: scenes.map(() => Fraction.of(1)),
  /** Turns of the crank's driving link, as last set. */
  turns: 0,
  /** Called with the turns after every change. */
  onTurns: null,
  setTurns(turns) {
    const exact = Fraction.of(turns);
    app.turns = turns;
    machines.forEach((machine, index) => (machine.turns = exact.times(app.gears[index])));
    app.stages.forEach((stage, index) => stage?.setTurns(machines[index].turns));
    app.onTurns?.(turns);
  },
  /** Opens a stage for a scene on its own canvas, or a plan if the browser has no WebGL. */
  open(index) {
    try {
      app.stages[index] = new Stage(document.createElement("canvas"), machines[index], options);
    } catch (error) {
      console.warn(`3D graphics are not available: ${error.message}`);
      app.stages[index] = new Plan(machines[index]);
    }
    return app.stages[index];
  },
  /** Browsers limit the number of drawing contexts, so hidden stages have none. */
  close(index) {
    app.stages[index]?.dispose();
    app.stages[index] = null;
  },
};

function named(list, key, name) {
  const index = list.findIndex((each) => each[key] === name);
  if (index < 0) throw new RangeError(`unknown name "${name}"`);
  return index;
}

globalThis.geartrain = {
  scenes,
  machines,
  stages: app.stages,
  setTurns: app.setTurns,
  get turns() {
    return app.turns;
  },
  /** Angle of a body about its direction, modulo one turn (rad). */
  angle: (scene, body) => machines[scene].angle(named(scenes[scene].bodies, "id", body)),
  /** An output: angle (rad, in [0, 2 pi)) and text. */
  pointer: (scene, output) => machines[scene].pointer(named(scenes[scene].pointers, "output", output)),
  ready: false,
};

/** Resolves after the browser has painted the current page; in a hidden tab, after a short time. */
const painted = () =>
  new Promise((done) => {
    requestAnimationFrame(() => setTimeout(done));
    setTimeout(done, 400);
  });

/** Shows text and dials first, then the wheels as discs, then their teeth. */
async function begin(build) {
  build(app);
  await painted();
  app.interface.openStages();
  await painted();
  for (const stage of app.stages) stage?.cut();
  app.interface.begin?.();
  globalThis.geartrain.ready = true;
}

const way = Showcase.asked(location.hash, options.shown);
begin(way ? () => (app.interface = new Showcase(app, way)) : buildInterface);
