// The page comes alive: scenes from its JSON, a machine and a stage for each, the interface round them.

import { Fraction } from "./fraction.js";
import { Machine } from "./motion.js";
import { buildInterface } from "./ui/interface.js";
import { Stage } from "./view.js";

const { scenes, options } = JSON.parse(document.getElementById("scenes").textContent);
const machines = scenes.map((scene) => new Machine(scene));
const stages = machines.map((machine) => stageOf(machine));

/** A stage, or null where the browser has no WebGL. */
function stageOf(machine) {
  const canvas = document.createElement("canvas");
  try {
    return new Stage(canvas, machine, options);
  } catch (error) {
    console.warn(`no picture in three dimensions: ${error.message}`);
    return null;
  }
}

const app = {
  scenes,
  machines,
  stages,
  options,
  /** Turns of the lead, as last given. */
  turns: 0,
  /** Told after every change. */
  onTurns: null,
  setTurns(turns) {
    const exact = Fraction.of(turns);
    app.turns = turns;
    for (const machine of machines) machine.turns = exact;
    for (const stage of stages) stage?.setTurns(exact);
    app.onTurns?.(turns);
  },
};

// a hand cannot tell a billionth of a turn, and short fractions stay short
const nudge = (delta) => app.setTurns(Fraction.of(app.turns).plus(new Fraction(BigInt(Math.round(delta * 1e9)), 10n ** 9n)).toString());
for (const stage of stages) if (stage) stage.onCrank = nudge;

function named(list, key, name) {
  const index = list.findIndex((each) => each[key] === name);
  if (index < 0) throw new RangeError(`there is no "${name}"`);
  return index;
}

globalThis.geartrain = {
  scenes,
  machines,
  stages,
  setTurns: app.setTurns,
  get turns() {
    return app.turns;
  },
  /** Angle of a body about its direction (rad), whole turns taken off. */
  angle: (scene, body) => machines[scene].angle(named(scenes[scene].bodies, "id", body)),
  /** An output: angle (rad, in [0, 2 pi)) and text. */
  pointer: (scene, output) => machines[scene].pointer(named(scenes[scene].pointers, "output", output)),
  ready: false,
};

buildInterface(app);
for (const stage of stages) stage?.resize();
globalThis.geartrain.ready = true;
globalThis.geartrain.firstPicture = performance.now();
