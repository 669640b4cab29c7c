// The table of outputs: speeds exact and decimal, angles now, differences between two trains; a click shows the path.
import { Fraction } from "../fraction.js";
import { copyable } from "./copying.js";
import { el } from "./element.js";
import { shown } from "./number.js";
import { Reading, degrees, told } from "./reading.js";

/** B - A, absolute and relative to A, if both are exact and have the same unit. */
export function difference(a, b) {
  const [from, to] = [Fraction.parse(a), Fraction.parse(b)];
  if (!from || !to) return null;
  const gap = to.minus(from);
  return { gap: gap.toString(), part: from.numerator === 0n ? null : Number(gap.over(from)) };
}

/** A relative value as text, in ppm if small. */
export function relative(part) {
  if (part === null || part === 0) return "";
  const size = Math.abs(part);
  const text = size < 0.001 ? `${(size * 1e6).toPrecision(3)} ppm` : `${(size * 100).toPrecision(3)} %`;
  return `${part < 0 ? "\u2212" : "+"}${text}`;
}

/** Note for a train without declared outputs. */
export function linksInWords({ bodies, pointers }, most = Infinity) {
  const [shown, all] = [Math.min(pointers.length, most), bodies.length - 1];
  return `This train declares no outputs; ${shown < all ? `the first ${shown} of its ${all} links are listed` : "its links are listed"}.`;
}

export class Outputs {
  constructor(sides, { onChoose, say }) {
    this.sides = sides;
    this.onChoose = onChoose;
    this.say = say;
    this.angles = [];
    this.rows = [];
    const names = [...new Set(sides.flatMap((side) => side.scene.pointers.map((each) => each.output)))];
    const one = sides.every((side) => side.scene.unit === sides[0].scene.unit);
    this.body = el(
      "tbody",
      {},
      names.map((name) => this.#row(name, one)),
    );
    this.search = el("input", {
      type: "search",
      placeholder: "Find an output",
      "aria-label": "find an output",
      oninput: () => this.#filter(),
    });
    this.node = el(
      "div",
      {},
      names.length > 12 && this.search,
      !one &&
        el("p", { class: "note" }, "The two trains use different units of speed, so no differences are shown."),
      sides.map(({ scene }) => !scene.asks && el("p", { class: "quiet" }, linksInWords(scene))),
      el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "outputs" }, this.#table()),
    );
  }

  #table() {
    const heads =
      this.sides.length > 1
        ? [...this.sides.flatMap((side) => [`${side.label}: speed`, "angle"]), "difference"]
        : ["speed, exact", "decimal", "angle now"];
    return el(
      "table",
      { class: "outputs" },
      el("caption", { class: "unseen" }, "Outputs; choose one to see its path from the input"),
      el(
        "thead",
        {},
        el(
          "tr",
          {},
          ["output", ...heads].map((head) => el("th", { scope: "col" }, head)),
        ),
      ),
      this.body,
    );
  }

  #row(name, one) {
    const found = this.sides.map((side) => side.scene.pointers.findIndex((each) => each.output === name));
    const pick = el(
      "button",
      { type: "button", class: "plain", "aria-pressed": "false", onclick: () => this.onChoose(name) },
      name,
    );
    const cells = this.sides.flatMap((side, k) => this.#cells(side, found[k]));
    if (this.sides.length > 1) cells.push(this.#difference(found, one));
    const note = found.map((index, k) => this.sides[k].scene.pointers[index]?.note).find(Boolean);
    const row = el("tr", { "data-output": name }, el("th", { scope: "row", title: note }, pick), cells);
    this.rows.push({ name, row, pick });
    return row;
  }

  #cells(side, index) {
    const both = this.sides.length > 1;
    if (index < 0) return Array.from({ length: both ? 2 : 3 }, () => el("td", { class: "quiet" }, "\u2013"));
    const pointer = side.scene.pointers[index];
    const reading = new Reading(side.scene, side.machine, index);
    const angle = el("td", { class: "number angle", "data-angle": pointer.output });
    this.angles.push({ reading, angle });
    const speed =
      pointer.shown === null ? el("span", { class: "quiet" }, "not determined") : copyable(pointer.shown, this.say);
    return both
      ? [el("td", { class: "number" }, speed, el("div", { class: "quiet" }, shown(pointer.decimal))), angle]
      : [el("td", { class: "number" }, speed), el("td", { class: "number decimal" }, shown(pointer.decimal)), angle];
  }

  #difference(found, one) {
    const [a, b] = found.map((index, k) => this.sides[k].scene.pointers[index]?.shown ?? null);
    const gap = one ? difference(a, b) : null;
    if (!gap) return el("td", { class: "quiet" }, "\u2013");
    if (gap.gap === "0") return el("td", { class: "number quiet" }, "none");
    return el(
      "td",
      { class: "number", "data-gap": gap.gap },
      copyable(gap.gap, this.say),
      el("div", { class: "quiet" }, relative(gap.part)),
    );
  }

  #filter() {
    const wanted = this.search.value.trim().toLowerCase();
    for (const { name, row } of this.rows) row.hidden = !name.toLowerCase().includes(wanted);
  }

  /** Marks the selected output; returns the button of the previous one. */
  mark(name) {
    const before = this.rows.find(({ pick }) => pick.getAttribute("aria-pressed") === "true")?.pick;
    for (const each of this.rows) {
      each.row.classList.toggle("chosen", each.name === name);
      each.pick.setAttribute("aria-pressed", String(each.name === name));
    }
    return before;
  }

  set(words) {
    if (!words || !this.node.offsetParent) return;
    for (const { reading, angle } of this.angles) {
      const value = reading.now;
      angle.textContent = value ? (value.travel === undefined ? degrees(value.degrees) : told(value)) : "\u2013";
    }
  }
}
