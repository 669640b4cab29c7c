// Changes of tooth counts: meshes that no longer fit their axes, outputs compared with those declared, the train as YAML.
import { Fraction } from "../fraction.js";
import { MEAN, countOf } from "../formulas.js";
import { copy } from "./copying.js";
import { el } from "./element.js";
import { shown } from "./number.js";
import { difference, relative } from "./readings.js";

const PLAIN_NAME = /^[A-Za-z_][A-Za-z0-9_-]*$/;
const WORDS = new Set(["null", "true", "false", "yes", "no", "on", "off", "y", "n"]);

const NOTHING = "All tooth counts are as declared. They can be changed under Wheels: all speeds are then recomputed exactly, and the changes are listed here.";

/** A name as a YAML scalar: plain if that is safe, else in quotes. */
const scalar = (name) => (PLAIN_NAME.test(name) && !WORDS.has(name.toLowerCase()) ? name : JSON.stringify(name));

/** The changed train as a declaration that extends the displayed train, with the changes `Side.steps`. */
export function asYaml(side) {
  const { scene, steps } = side;
  const { parent } = scene.formulas;
  const links = new Map();
  for (const { wheel, link, count } of steps) links.set(link, [...(links.get(link) ?? []), `${scalar(wheel)}: {teeth: ${count}}`]);
  return [
    `name: ${scalar(`${scene.name}-changed`)}`,
    `title: ${JSON.stringify(`${scene.title || scene.name}, with other counts`)}`,
    `extends: ${scalar(parent).startsWith('"') && !/[:#{}[\],&*?|<>=!%@\\"' ]/.test(parent) ? parent : scalar(parent)}`,
    "links:",
    ...[...links].map(([link, wheels]) => `  ${scalar(link)}: {wheels: {${wheels.join(", ")}}}`),
    "",
  ].join("\n");
}

const wayOf = (further) => (further ? "further apart" : "closer together");

/** Text about the misfit of a pair with its axes; empty if it fits. */
export function misfit({ pair, off, apart, module }) {
  if (off === null && apart === null) return `${pair.id}: its axes intersect, so its wheels must be redesigned and repositioned`;
  if (off === null && !apart) return "";
  if (off === null) return `${pair.id}: needs axes ${Math.abs(apart).toPrecision(3)} mm ${wayOf(apart > 0)} (as drawn)`;
  if (off.numerator === 0n) return "";
  const size = off.numerator < 0n ? Fraction.of(0).minus(off) : off;
  const modules = `${size} ${size.equals(1) ? "module" : size.denominator === 1n ? "modules" : "of a module"}`;
  return `${pair.id}: needs axes ${modules} ${wayOf(off.numerator > 0n)} (${(Number(size) * module).toPrecision(3)} mm as drawn)`;
}

export class Change {
  /** `onCounts(side, counts by declared wheel)`; `say(text)` */
  constructor(sides, { onCounts, say }) {
    Object.assign(this, { onCounts, say });
    const changed = sides.filter(({ steps }) => steps.length);
    this.node = el("div", {}, changed.length ? changed.map((side) => this.#part(side, sides.length > 1)) : el("p", { class: "quiet" }, NOTHING));
  }

  #part(side, many) {
    const reset = el("button", { type: "button", class: "small", onclick: () => this.onCounts(side, side.formulas.declared), "data-key": "reset" }, "All as declared");
    const broken = side.meshes.map(misfit).filter(Boolean);
    return el(
      "section",
      { class: "change", "aria-label": "changes" },
      el("div", { class: "row" }, el("h3", {}, many ? `${side.label}, changed` : "Changed"), reset),
      el(
        "ul",
        { class: "counts" },
        side.steps.map(({ wheel, declared, count }) => el("li", { "data-changed": wheel }, `${wheel}: ${declared} \u2192 ${count} teeth`)),
      ),
      el("h4", {}, "Meshes"),
      broken.length
        ? el("ul", { class: "misfits" }, broken.map((text) => el("li", { class: "bad" }, text)))
        : el("p", {}, "All meshes still fit their axes."),
      side.declared.movement.kind === "real" && el("p", { class: "quiet" }, MEAN),
      el("h4", {}, "Outputs"),
      this.#outputs(side),
      this.#save(side),
    );
  }

  #outputs({ scene, declared }) {
    const rows = scene.pointers.flatMap((pointer, at) => {
      const before = declared.pointers[at].shown;
      if (before === pointer.shown) return [];
      const gap = difference(before, pointer.shown);
      const cells = [before, pointer.shown].map((text) => el("td", { class: "number" }, text === null ? "not determined" : shown(text)));
      return [el("tr", { "data-turned": pointer.output }, el("th", { scope: "row" }, pointer.output), cells, el("td", {}, gap ? relative(gap.part) : ""))];
    });
    if (!rows.length) return el("p", {}, "No output speed has changed.");
    const heads = ["output", "declared", "now", "change"];
    return el(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": "changed outputs" },
      el("table", {}, el("thead", {}, el("tr", {}, heads.map((head) => el("th", { scope: "col" }, head)))), el("tbody", {}, rows)),
    );
  }

  #save(side) {
    const text = asYaml(side);
    const file = `${side.scene.name}-changed.yaml`.replace(/[^\w.-]+/g, "-");
    const save = () => {
      const address = URL.createObjectURL(new Blob([text], { type: "application/yaml" }));
      el("a", { href: address, download: file }).click();
      setTimeout(() => URL.revokeObjectURL(address), 1000);
      this.say(`${file} saved`);
    };
    const take = async () => this.say((await copy(text)) ? "declaration copied" : "the browser does not permit copying");
    return [
      el("h4", {}, "Declaration"),
      el("pre", { class: "yaml", tabindex: 0 }, text),
      el(
        "div",
        { class: "buttons" },
        el("button", { type: "button", onclick: save, "data-key": "save" }, "Save YAML"),
        el("button", { type: "button", onclick: take, "data-key": "copy" }, "Copy"),
      ),
    ];
  }
}

/** Buttons and a field for the count of a wheel; null if it cannot be changed. `key` identifies them. */
export function stepper(side, index, onCounts, key, typed = false) {
  const at = side.formulas?.at(index) ?? null;
  if (at === null) return null;
  const { id } = side.scene.wheels[index];
  const now = side.counts[at];
  const set = (count) => onCounts(side, side.counts.map((each, k) => (k === at ? count : each)));
  const button = (step, sign, word) =>
    el(
      "button",
      {
        type: "button",
        class: "step",
        "aria-label": `one tooth ${word} on ${id}`,
        "data-key": `${key} ${side.index} ${id} ${step}`,
        disabled: now + step < 1n,
        onclick: () => set(now + step),
      },
      sign,
    );
  const field =
    typed &&
    el("input", {
      type: "text",
      inputmode: "numeric",
      maxlength: 13,
      value: now,
      "aria-label": `teeth of ${id}`,
      "data-key": `${key} ${side.index} ${id}`,
      onchange: (event) => {
        const count = countOf(event.target.value);
        if (count === null) event.target.value = now;
        else if (count !== now) set(count);
      },
    });
  return el("span", { class: "stepper" }, button(-1n, "\u2212", "less"), field, button(1n, "+", "more"));
}
