// The interface around the stages: panels, crank, dials, keys.
//
// It builds its page inside <body>. Members of `app` that it uses, besides scenes and machines (one of each per scene):
//
//   app.options       {compare: bool, teeth: bool}; with `compare` two scenes stand side by side, else one is shown
//   app.open(index)   a stage for a scene, with its canvas, or a plan where there is no WebGL; app.close(index) ends it
//   app.gears         turns of each scene's driving link for one turn of the crank's driving link
//   app.setTurns(t)   t a number, or exact text such as '235/19'; sets every machine and stage, then calls
//                     app.onTurns(t) if it is there, so that scripts and dials stay together
//   app.turns         turns that were last set
import { BROKEN } from "../colours.js";
import { Fraction } from "../fraction.js";
import { momentOf, pace } from "../opening.js";
import { Crank } from "./crank.js";
import { Drive } from "./drive.js";
import { el } from "./element.js";
import { Head } from "./head.js";
import { Keys } from "./keys.js";
import { Live } from "./live.js";
import { Panel } from "./panel.js";
import { Playhead } from "./playhead.js";
import { Side } from "./side.js";
import { Theme } from "./theme.js";
import { Tools } from "./tools.js";
import { Tour } from "./tour.js";

const WORDS = 100; // ms between two texts of a moving number

class Interface {
  constructor(app) {
    this.app = app;
    this.all = app.scenes.map((_, index) => new Side(app, index));
    const first = this.all[0].scene;
    this.drive = new Drive(app, Fraction.of(first.step));
    this.drive.rate = pace(first);
    if (app.machines[0].moves) this.drive.at = momentOf(first);
    this.live = new Live();
    this.tools = new Tools(app.options);
    this.theme = new Theme((background) => this.all.forEach(({ stage }) => stage?.theme({ background })));
    this.theme.apply(); // before the layout, so that the page does not flash
    this.crank = new Crank(first, this.drive, { set: (day) => this.setTo(day) });
    this.keys = new Keys({
      timed: this.all.some(({ machine }) => machine.run),
      drive: this.drive,
      tools: this.tools,
      goTo: () => this.crank.find(),
      find: () => this.panel.find(),
      back: () => this.crank.turnBack?.(),
      escape: () => this.letGo(),
    });
    this.head = new Head(this.all, {
      compare: Boolean(app.options?.compare),
      theme: this.theme.select,
      onKeys: () => this.keys.open(),
      onChanged: () => this.panel.showChange(),
      onShow: (sides) => this.show(sides),
      onLoop: (side, loop) => this.loop(side, loop),
      onElement: (side, each) => this.element(side, each),
    });
    this.tools.lodge(this.head.choices, this.head.rest);
    this.panel = new Panel(this);
    this.tour = new Tour([], () => {});
    this.#lay();
    this.drive.listen((drive, settled) => this.#moved(drive, settled));
    this.show(this.head.sides);
  }

  #lay() {
    const views = el(
      "div",
      { class: "views" },
      this.all.map((side) => side.figure),
    );
    document.body.prepend(
      el("a", { class: "skip", href: "#panel" }, "Skip to the panels"),
      el(
        "div",
        { class: "house" },
        this.head.node,
        el("main", { class: "hall" }, this.tools.node, views, this.tour.node, this.crank.node),
        this.panel.node,
      ),
      this.live.node,
      this.keys.node,
    );
  }

  #moved(drive, settled) {
    const now = performance.now();
    const words = settled || now - (this.worded ?? 0) > WORDS;
    if (words) this.worded = now;
    this.crank.set(drive, settled);
    this.panel.set(words);
    if (settled) this.live.rest(drive);
  }

  /** Shows one side, or two beside each other; their pictures come with `openStages` the first time. */
  show(sides) {
    this.sides = sides;
    for (const side of this.all) {
      side.figure.hidden = !sides.includes(side);
      if (side.figure.hidden) side.close();
    }
    document.body.classList.toggle("beside", sides.length > 1);
    this.panel.use(sides);
    this.live.use(sides);
    this.#gear(sides);
    this.#guide(sides[0]);
    if (this.lit) this.openStages();
    this.letGo();
    this.drive.goTo(this.drive.at);
    this.crank.set(this.drive, true);
    this.panel.set(true);
  }

  /** Opens the pictures of all displayed sides; after `cut`, later pictures have teeth immediately. */
  openStages() {
    for (const side of this.sides) {
      if (!side.open()) continue;
      const { stage } = side;
      stage.theme({ background: this.theme.background });
      stage.onPick = (wheel) => this.select(side, wheel);
      stage.onCrank = (turns) => this.drive.advance(turns / Number(this.app.gears[side.index]), true);
      if (this.lit) stage.cut();
    }
    this.tools.use(this.sides);
    for (const { stage } of this.sides) stage?.resize();
    this.lit = true;
  }

  /** Creates the tour of a side. */
  #guide(side) {
    const tour = new Tour(side.scene.tour, (step) => this.#visit(side, step));
    this.tour.node.replaceWith(tour.node);
    this.tour = tour;
  }

  #visit({ stage }, step) {
    this.tools.assemble();
    if (stage?.visit) stage.visit(step, this.#accent, this.drive.calm.matches);
    if (!step) this.tools.look("free");
  }

  /** Starts the motion, unless the user prefers reduced motion. */
  begin() {
    if (!this.drive.calm.matches) this.drive.play(true);
  }

  /** Creates the crank for the displayed sides, because states may have different inputs. */
  #gear(sides) {
    const [first, second] = sides;
    this.drive.play(false);
    this.drive.step = Fraction.of(first.scene.step);
    this.drive.run = first.machine.run ?? null;
    this.drive.movable = sides.some(({ movable }) => movable);
    this.app.gears = this.all.map((side) => (side === second ? side.gearing(first) : Fraction.of(1)));
    const crank = this.drive.run ? new Playhead(first, this.drive) : new Crank(first.scene, this.drive, { beside: second?.beside(first), set: (day) => this.setTo(day) });
    this.crank.node.replaceWith(crank.node);
    this.crank = crank;
  }

  /** Chooses a wheel, or none. */
  select(side, wheel) {
    for (const each of this.sides) each.stage?.select(each === side ? wheel : null);
    this.panel.wheel(side, wheel);
    if (wheel !== null) this.live.say(`wheel ${side.scene.wheels[wheel].id}, ${side.scene.wheels[wheel].teeth} teeth`);
  }

  /** Changes the counts of a train in all its states: first numbers, then pictures. */
  count(side, counts) {
    const { name, formulas } = side.declared;
    const same = (each) => each.formulas && each.declared.name === name && String(each.formulas.given.wheels) === String(formulas.wheels);
    this.#renew(this.all.filter(same), (each) => each.change(counts));
    this.live.say(side.steps.map(({ wheel, count }) => `${wheel} ${count} teeth`).join(", ") || "all as declared");
  }

  /** Sets all trains with an epoch to the sky on a Julian day. */
  setTo(day) {
    this.#renew(this.all.filter(({ scene }) => scene.epoch?.settings.length), (each) => each.setTo(day));
    this.live.say("set to the sky");
  }

  /** Changes sides: first numbers, then pictures. */
  #renew(sides, change) {
    const key = document.activeElement?.dataset?.key;
    const chosen = this.panel.chosen;
    for (const each of sides) {
      change(each);
      each.redraw((stage) => this.tools.dress(each, stage));
    }
    this.drive.movable = this.sides.some(({ movable }) => movable);
    if (!this.drive.movable) this.drive.play(false);
    this.head.write();
    this.panel.use(this.sides);
    this.live.use(this.sides);
    this.crank.use?.(this.sides[0].scene);
    if (chosen) this.panel.wheel(...chosen);
    if (key) document.querySelector(`[data-key="${CSS.escape(key)}"]`)?.focus({ preventScroll: true });
    this.drive.goTo(this.drive.at);
    this.panel.set(true);
  }

  /** Highlights the parts on which an output depends, in every side with this output. */
  choose(output) {
    const found = this.sides
      .map((side) => ({ side, pointer: side.scene.pointers.find((each) => each.output === output) }))
      .filter(({ pointer }) => pointer);
    const parts = new Map(found.map(({ side, pointer }) => [side, { wheels: pointer.wheels }]));
    this.#highlight(parts);
    this.panel.path(output, found);
    this.live.say(`path to ${output}: ${found.map(({ pointer }) => `${pointer.pairs.length} pairs`).join(", ")}`);
  }

  /** Highlights the parts of a contact of a simulated run. */
  contact(side, index) {
    const { name, kind } = side.scene.run.contacts[index];
    const named = (list) => list.findIndex(({ id }) => id === name);
    const coupling = side.scene.couplings[named(side.scene.couplings)];
    const bodies = kind === "pin" ? [coupling.pin, coupling.slot] : [named(side.scene.bodies)];
    this.#highlight(new Map([[side, kind === "pair" ? { pairs: [name] } : { bodies }]]));
    this.live.say(`${name} is shown`);
  }

  /** Highlights the bodies that a brake holds or a clutch connects. */
  element(side, { bodies, closed, text }) {
    this.#highlight(new Map([[side, { bodies }]]));
    this.live.say(`${text}; it is ${closed ? "closed" : "open"}`);
  }

  /** Highlights a loop that locks the train. */
  loop(side, parts) {
    this.#highlight(new Map([[side, parts]]), BROKEN);
    this.live.say(`the loop ${parts.pairs.join(", ")} is shown in red`);
  }

  /** parts: highlighted parts by side */
  #highlight(parts, colour = this.#accent) {
    for (const each of this.sides) each.stage?.highlight(parts.get(each) ?? null, colour);
  }

  get #accent() {
    return getComputedStyle(document.documentElement).getPropertyValue("--way").trim();
  }

  letGo() {
    this.#highlight(new Map());
    this.select(this.sides[0], null);
    this.panel.letGo();
  }
}

export function buildInterface(app) {
  app.interface = new Interface(app);
}
