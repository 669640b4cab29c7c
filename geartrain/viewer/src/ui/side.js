// A side: a train in one state that can be displayed, and its picture while it is displayed.
import { CountFormulas } from "../formulas.js";
import { Fraction } from "../fraction.js";
import { Machine } from "../motion.js";
import { setTo } from "../setting.js";
import { copyOf } from "../still.js";
import { Callouts } from "./callouts.js";
import { el } from "./element.js";
import { decimal } from "./number.js";

const NO_PICTURE = "A plan is shown, because this browser has no 3D graphics (WebGL). Everything else works.";

export class Side {
  constructor(app, index) {
    this.app = app;
    this.index = index;
    this.scene = app.scenes[index];
    this.machine = app.machines[index];
    this.declared = this.scene; // the unchanged scene
    this.declaredMachine = this.machine;
    this.formulas = this.scene.formulas ? new CountFormulas(this.scene) : null;
    this.counts = this.formulas?.declared ?? [];
    this.stage = null;
    this.label = app.options?.compare ? this.scene.name : (this.scene.state ?? this.scene.name);
    if (this.machine.run) this.label = [this.scene.state, this.machine.simulated ? "simulated" : "drive flanks in contact"].filter(Boolean).join(", ");
    this.legend = el("div", {});
    this.place = el("div", {});
    this.nothing = el("p", { class: "nothing", hidden: true }, NO_PICTURE);
    const caption = el("figcaption", {}, el("span", { class: "caption" }, this.label), this.nothing, this.legend);
    this.figure = el("figure", { class: "view", hidden: true }, this.place, caption);
  }

  /** Opens the picture; true if there was none. */
  open() {
    if (this.stage) return false;
    this.stage = this.app.open(this.index);
    const { canvas } = this.stage;
    this.nothing.hidden = canvas instanceof HTMLCanvasElement;
    this.callouts = this.stage.renderer ? new Callouts(this.stage) : null;
    this.place.replaceChildren(...[canvas, this.callouts?.node].filter(Boolean));
    this.#name(canvas);
    return true;
  }

  #name(canvas) {
    canvas.setAttribute("tabindex", "0");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${this.label}, animated picture; the wheels are listed under Wheels`);
  }

  /** Copies the picture while the page is printed, because browsers do not print drawing contexts. */
  print(printing) {
    this.copy?.remove();
    this.copy = printing && this.stage?.renderer ? copyOf([this.stage]) : null;
    this.copy?.classList.add("copy");
    if (this.copy) this.place.append(this.copy);
  }

  close() {
    if (!this.stage) return;
    this.app.close(this.index);
    this.stage = null;
    this.place.replaceChildren();
  }

  /** Changes the counts, in the order of the formulas; the numbers change immediately, the picture with `redraw`. */
  change(counts) {
    this.counts = counts;
    const { turns } = this.machine;
    this.scene = this.steps.length ? this.formulas.changed(counts) : this.declared;
    if (this.day) this.scene = setTo(this.scene, this.day);
    this.machine = this.scene === this.declared ? this.declaredMachine : new Machine(this.scene);
    this.machine.turns = turns;
    this.app.scenes[this.index] = this.scene;
    this.app.machines[this.index] = this.machine;
  }

  /** Sets the pointers to the sky on a Julian day. */
  setTo(day) {
    this.day = day;
    this.change(this.counts);
  }

  /** Redraws the picture after a short time, once for several successive changes. */
  redraw(dress) {
    clearTimeout(this.drawing);
    this.drawing = setTimeout(() => {
      if (!this.stage) return;
      this.stage.rebuild(this.machine);
      dress(this.stage);
    }, 150);
  }

  /** Counts that are not those declared: {wheel, link, declared, count}. */
  get steps() {
    if (!this.formulas) return [];
    const { given, declared } = this.formulas;
    return given.wheels.flatMap((wheel, at) => {
      if (this.counts[at] === declared[at]) return [];
      const { body } = this.declared.wheels[given.count.indexOf(at)];
      return [{ wheel, link: this.declared.bodies[body].id, declared: declared[at], count: this.counts[at] }];
    });
  }

  /** Misfits of the meshes with their axes for the current counts. */
  get meshes() {
    return this.formulas.meshes(this.counts);
  }

  get movable() {
    return this.scene.movement.kind !== "still" && this.scene.driving_link !== null;
  }

  /** Duration of one turn of the driving link, and its unit: days, or a named unit; null without a time unit. */
  get #unit() {
    const { step, unit, unit_days: days, run } = this.scene;
    if (run) return { name: "seconds of a run", size: Fraction.of(run.period) };
    const turns = Fraction.parse(step);
    if (!turns || turns.numerator === 0n || !unit) return null;
    return days ? { name: "days", size: Fraction.of(days).over(turns) } : { name: unit, size: Fraction.of(1).over(turns) };
  }

  /** Turns of the driving link for one turn of another side's: in equal times if both have a unit, else equal. */
  gearing(other) {
    const [own, its] = [this.#unit, other.#unit];
    return own && its && own.name === its.name ? its.size.over(own.size) : Fraction.of(1);
  }

  get lead() {
    return this.scene.driving_link === null ? "the input" : this.scene.bodies[this.scene.driving_link].id;
  }

  /** Text of what one turn of another side's driving link is here; empty if they are equal. */
  beside(other) {
    const turns = this.gearing(other);
    if (turns.equals(1) && this.lead === other.lead) return "";
    return `${decimal(turns)} of ${this.lead} beside for each`;
  }
}
