// The head of the page: which train, its purpose, a verdict other than determined, its states, theme and keys.
import { purposeOf } from "../opening.js";
import { misfit } from "./change.js";
import { el, field } from "./element.js";
import { loopParts, verdict } from "./verdict.js";

export class Head {
  constructor(all, { compare, theme, onKeys, onShow, onLoop, onElement, onChanged }) {
    this.all = all;
    this.onShow = onShow;
    this.onLoop = onLoop;
    this.onElement = onElement;
    this.onChanged = onChanged;
    this.title = el("h1", {});
    this.names = el("p", { class: "quiet names" });
    this.verdicts = el("div", { class: "verdicts" });
    this.first = this.#choice(0, false);
    this.second = this.#choice(compare && all.length > 1 ? 1 : "", true);
    const several = all.length > 1;
    const timed = all.some(({ machine }) => machine.run);
    const word = timed ? "Motion" : all.some((side) => side.scene.state) && !compare ? "State" : "Train";
    const beside = several && field("Beside", this.second);
    this.choices = el("div", { class: "choices" }, several && field(word, this.first), compare && beside);
    this.node = el(
      "header",
      { class: "head" },
      el("div", {}, this.title, this.names, this.verdicts),
      this.choices,
    );
    this.rest = [
      several && !compare && beside,
      field("Theme", theme),
      el("button", { type: "button", class: "for-keys", onclick: onKeys, "aria-haspopup": "dialog" }, "Keys"),
    ].filter(Boolean);
    this.write();
  }

  #choice(value, none) {
    const select = el(
      "select",
      { onchange: () => this.#changed() },
      none && el("option", { value: "" }, "nothing"),
      this.all.map((side, index) => el("option", { value: index }, side.label)),
    );
    select.value = String(value);
    return select;
  }

  #changed() {
    this.write();
    this.onShow(this.sides);
  }

  /** The selected sides: one, or two different ones. */
  get sides() {
    const chosen = [this.first.value, this.second.value].filter((value) => value !== "").map(Number);
    return [...new Set(chosen)].map((index) => this.all[index]);
  }

  /** Note on changed counts and meshes that no longer fit; a click shows the details. */
  #told(side) {
    const off = side.meshes.filter(misfit).length;
    const counts = side.steps.map(({ wheel, declared, count }) => `${wheel} ${declared} \u2192 ${count}`);
    const fits = off ? `${off} ${off === 1 ? "mesh no longer fits its axes" : "meshes no longer fit their axes"}` : "all meshes still fit their axes";
    const button = el("button", { type: "button", class: "plain", onclick: () => this.onChanged() }, counts.slice(0, 6).join(", ") + (counts.length > 6 ? ", ..." : ""));
    return el("span", { class: "changed" }, " changed: ", button, `; ${fits}`);
  }

  /** Updates the head to the displayed sides. */
  write() {
    const { sides } = this;
    const many = sides.length > 1;
    const titles = [...new Set(sides.map(({ scene }) => scene.title || scene.name))];
    this.title.textContent = titles.join(" and ");
    const names = [...new Set(sides.map(({ scene }) => scene.name))];
    this.names.replaceChildren(names.length > 1 ? names.join(", ") : purposeOf(sides[0].scene), ...sides.filter(({ steps }) => steps.length).slice(0, 1).map((side) => this.#told(side)));
    this.verdicts.replaceChildren(
      ...sides.map((side) =>
        verdict(side, many, (of, loop) => this.onLoop(of, loopParts(of.scene, loop)), this.onElement),
      ),
    );
  }
}
