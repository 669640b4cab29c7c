// The tour of a train: a text for each step, at whose part the camera looks.
import { el } from "./element.js";

export class Tour {
  /** `steps`: the tour of a scene; `onStep(step)`, null at the end */
  constructor(steps, onStep) {
    Object.assign(this, { steps, onStep, at: -1 });
    const button = (name, by) => el("button", { type: "button", onclick: () => this.go(this.at + by) }, name);
    this.first = button(`Tour in ${steps.length} steps`, 1);
    [this.back, this.next] = [button("Back", -1), button("Next", 1)];
    this.end = el("button", { type: "button", onclick: () => this.go(-1) }, "End");
    this.text = el("p", { "aria-live": "polite" });
    this.buttons = el("div", { class: "buttons" }, this.back, this.next, this.end);
    this.node = el("section", { class: "tour", "aria-label": "tour", hidden: !steps.length }, this.first, this.text, this.buttons);
    this.#write();
  }

  /** Shows a step; -1, and a step after the last one, end the tour. */
  go(at) {
    this.at = at < this.steps.length ? at : -1;
    this.#write();
    this.onStep(this.steps[this.at] ?? null);
  }

  #write() {
    const step = this.steps[this.at];
    this.first.hidden = Boolean(step);
    this.text.hidden = this.buttons.hidden = !step;
    this.back.disabled = this.at === 0;
    this.text.textContent = step ? `${this.at + 1}/${this.steps.length} ${step.text}` : "";
  }
}
