// The interface around the stages: panels, crank, dials, keys.
//
// It builds its own page inside <body> and moves the canvases there. What it asks of `app`, beside scenes, machines
// and stages (one of each per scene, `null` for a stage where there is no WebGL):
//
//   app.options       {compare: bool, teeth: bool}; with `compare` two scenes stand side by side, else one is shown
//   stage.canvas      the canvas given to the constructor; hidden ones have no size, `resize()` is called when shown
//   app.setTurns(t)   t a number, or exact text such as '235/19'; sets every machine and stage, then calls
//                     app.onTurns(t) if it is there, so that scripts and dials stay together
//   app.turns         what was last given
//   machine.pointer(index, t), machine.angle(body, t)   t likewise a number or exact text
//
// A side is {scene, machine, stage, label, figure, legend}: a train, or a state of it, that can be shown.
import { Drive } from "./drive.js";
import { el } from "./element.js";
import { parse, whole } from "./number.js";
import { Head } from "./head.js";
import { Keys } from "./keys.js";
import { Live } from "./live.js";
import { Panel } from "./panel.js";
import { Theme } from "./theme.js";
import { Tools } from "./tools.js";
import { Crank } from "./crank.js";

const WORDS = 100; // ms between two texts of a moving number

function sideOf(app, scene, index) {
  const stage = app.stages[index];
  const legend = el("div", {});
  const label = app.options?.compare ? scene.name : (scene.state ?? scene.name);
  const figure = el(
    "figure",
    { class: "view", hidden: true },
    stage
      ? stage.canvas
      : el("p", { class: "nothing" }, "This browser shows no 3D picture (WebGL). All else on this page holds."),
    el("figcaption", {}, el("span", { class: "caption" }, label), legend),
  );
  if (stage) {
    stage.canvas.tabIndex = 0;
    stage.canvas.setAttribute("role", "img");
    stage.canvas.setAttribute("aria-label", `${label}, a picture that turns; the wheels are listed under Wheels`);
  }
  return { scene, machine: app.machines[index] ?? null, stage, label, figure, legend };
}

class Interface {
  constructor(app) {
    this.all = app.scenes.map((scene, index) => sideOf(app, scene, index));
    const first = this.all[0].scene;
    this.drive = new Drive(app, parse(first.step) ?? whole(1));
    this.drive.rate = pace(first);
    this.live = new Live();
    this.tools = new Tools(app.options);
    this.theme = new Theme(app.stages);
    this.theme.apply(); // before anything is laid out, so that nothing flashes
    this.crank = new Crank(first, this.drive);
    this.keys = new Keys({
      drive: this.drive,
      tools: this.tools,
      goTo: () => this.#goTo(),
      find: () => this.#find(),
      escape: () => this.letGo(),
    });
    this.head = new Head(this.all, {
      compare: Boolean(app.options?.compare),
      theme: this.theme.select,
      onKeys: () => this.keys.open(),
      onShow: (sides) => this.show(sides),
      onLoop: (side, loop) => this.loop(side, loop),
    });
    this.panel = new Panel(this);
    this.#lay();
    this.#connect();
    this.show(this.head.sides);
  }

  #lay() {
    const views = el(
      "div",
      { class: "views" },
      this.all.map((side) => side.figure),
    );
    document.body.prepend(
      el("a", { class: "skip", href: "#panel" }, "To the panels"),
      el(
        "div",
        { class: "house" },
        this.head.node,
        el("main", { class: "hall" }, this.tools.node, views, this.crank.node),
        this.panel.node,
      ),
      this.live.node,
      this.keys.node,
    );
  }

  #connect() {
    this.drive.listen((drive, settled) => this.#moved(drive, settled));
    for (const side of this.all) {
      if (!side.stage) continue;
      side.stage.onPick = (wheel) => this.select(side, wheel);
      side.stage.onCrank = (turns) => this.drive.advance(turns, true);
    }
  }

  #moved(drive, settled) {
    const now = performance.now();
    const words = settled || now - (this.worded ?? 0) > WORDS;
    if (words) this.worded = now;
    this.crank.set(drive, settled);
    this.panel.set(drive.at, words);
    if (settled) this.live.rest(drive);
  }

  /** Shows one side, or two beside each other. */
  show(sides) {
    this.sides = sides;
    for (const side of this.all) side.figure.hidden = !sides.includes(side);
    document.body.classList.toggle("beside", sides.length > 1);
    this.panel.use(sides);
    this.live.use(sides);
    this.#gear(sides);
    for (const side of sides) side.stage?.resize();
    this.tools.use(sides);
    this.letGo();
    this.drive.goTo(this.drive.at);
    this.crank.set(this.drive, true);
    this.panel.set(this.drive.at, true);
  }

  /** A crank for what is shown: states may have different inputs. */
  #gear(sides) {
    const { scene } = sides[0];
    this.drive.play(false);
    this.drive.step = parse(scene.step) ?? whole(1);
    this.drive.movable = sides.some(({ scene: { movement, lead } }) => movement.kind !== "still" && lead !== null);
    const crank = new Crank(scene, this.drive);
    this.crank.node.replaceWith(crank.node);
    this.crank = crank;
  }

  /** Chooses a wheel, or none. */
  select(side, wheel) {
    for (const each of this.sides) each.stage?.select(each === side ? wheel : null);
    this.panel.wheel(side, wheel);
    if (wheel !== null) this.live.say(`wheel ${side.scene.wheels[wheel].id}, ${side.scene.wheels[wheel].teeth} teeth`);
  }

  /** Highlights what an output hangs on, in every side that has it. */
  choose(output) {
    const found = this.sides
      .map((side) => ({ side, pointer: side.scene.pointers.find((each) => each.output === output) }))
      .filter(({ pointer }) => pointer);
    const parts = new Map(found.map(({ side, pointer }) => [side, { wheels: pointer.wheels }]));
    this.#highlight(parts, "accent");
    this.panel.path(output, found);
    this.live.say(`path to ${output}: ${found.map(({ pointer }) => `${pointer.pairs.length} pairs`).join(", ")}`);
  }

  /** Highlights a loop that holds the train. */
  loop(side, parts) {
    this.#highlight(new Map([[side, parts]]), "bad");
    this.live.say(`the loop ${parts.pairs.join(", ")} is shown in red`);
  }

  /** parts: side -> what is highlighted there */
  #highlight(parts, colour) {
    const value = getComputedStyle(document.documentElement).getPropertyValue(`--${colour}`).trim();
    for (const each of this.sides) each.stage?.highlight(parts.get(each) ?? null, value);
  }

  letGo() {
    this.#highlight(new Map(), "accent");
    this.select(this.sides[0], null);
    this.panel.letGo();
  }

  #goTo() {
    this.crank.place.focus();
    this.crank.place.select();
  }

  #find() {
    this.panel.find();
  }
}

/** Turns of the lead a second at which the fastest pointer still can be followed by eye. */
function pace(scene) {
  const speeds = scene.pointers.map((pointer) => Math.abs(Number(parse(pointer.speed) ?? 0)));
  return Math.min(0.25, Math.max(0.001, 0.5 / Math.max(1, ...speeds)));
}

export function buildInterface(app) {
  app.interface = new Interface(app);
}
