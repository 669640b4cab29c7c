// The list of readings: each dial with the outputs that are read on it, then outputs without a dial; exact speeds, and
// differences between two trains. A click on an output shows its path.
import { NEEDLES } from "../colours.js";
import { Fraction } from "../fraction.js";
import { copyable } from "./copying.js";
import { Dial } from "./dial.js";
import { el, more } from "./element.js";
import { shown } from "./number.js";
import { Reading, textOf } from "./reading.js";
import { Sky, hasTargets } from "./sky.js";

const MANY = 4; // number of names from which a dial is as wide as possible

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
function linksInWords({ bodies, pointers }) {
  const [listed, all] = [pointers.length, bodies.length - 1];
  return `This train declares no outputs; ${listed < all ? `the first ${listed} of its ${all} links are listed` : "its links are listed"}.`;
}

export class Readings {
  /** `sides` as in `side.js`; `onChoose(output)`; `onSet(day)` sets pointers to the sky; `say(text)` for screen readers */
  constructor(sides, { onChoose, onSet, say }) {
    Object.assign(this, { sides, onChoose, say });
    this.dials = [];
    this.angles = [];
    this.rows = [];
    this.names = [...new Set(sides.flatMap((side) => side.scene.pointers.map((each) => each.output)))];
    this.one = sides.every((side) => side.scene.unit === sides[0].scene.unit);
    const aims = sides.some(({ scene }) => scene.epoch?.settings.length) ? "the sky and targets" : "targets";
    this.sky = sides.some(({ scene }) => hasTargets(scene)) && new Sky(sides, { say, onSet });
    this.comparison = this.sky && more(`Comparison with ${aims}`, this.sky.node, () => this.set(true));
    this.search = el("input", {
      type: "search",
      placeholder: "Find an output",
      "aria-label": "find an output",
      oninput: () => this.#filter(),
    });
    this.node = el(
      "div",
      {},
      this.names.length > 12 && this.search,
      !this.one && el("p", { class: "note" }, "The two trains use different units of speed, so no differences are shown."),
      sides.map(({ scene }) => !scene.asks && el("p", { class: "quiet" }, linksInWords(scene))),
      this.#lists(),
      this.comparison,
    );
  }

  /** The table of the outputs on dials; others follow, folded if there are dials. */
  #lists() {
    const titles = [...new Set(this.sides.flatMap(({ scene }) => scene.dials.map(({ title }) => title)))];
    const groups = titles.map((title) => ({ title, names: this.names.filter((name) => this.#titleOf(name) === title) }));
    const rest = this.names.filter((name) => !this.#titleOf(name));
    const tables = [titles.length && this.#table(groups.flatMap(({ title, names }) => [this.#faces(title), ...names.map((name) => this.#row(name))]))];
    if (!rest.length) return tables;
    const others = this.#table(rest.map((name) => this.#row(name)));
    if (!titles.length) return others;
    this.others = more(`${rest.length} outputs without a dial`, others, () => this.set(true));
    return [...tables, this.others];
  }

  /** Title of the dial on which an output is read; empty if it has no dial. */
  #titleOf(name) {
    const dials = this.sides.map(({ scene }) => scene.dials[scene.pointers.find(({ output }) => output === name)?.dial]);
    return dials.find(Boolean)?.title ?? "";
  }

  #table(rows) {
    const several = this.sides.length > 1;
    const heads = [...this.sides.flatMap(({ label }) => (several ? [label, "speed"] : ["reading", "speed, exact"])), several && "difference"];
    return el(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": "outputs" },
      el(
        "table",
        { class: "outputs" },
        el("caption", { class: "unseen" }, "Outputs; choose one to see its path from the input"),
        el("thead", {}, el("tr", {}, ["output", ...heads].filter(Boolean).map((head) => el("th", { scope: "col" }, head)))),
        el("tbody", {}, rows),
      ),
    );
  }

  /** A row with the drawings of a dial. */
  #faces(title) {
    const cards = this.sides.flatMap(({ scene, machine, label }) => {
      const dial = scene.dials.find((each) => each.title === title);
      const hands = scene.pointers.map((_, index) => new Reading(scene, machine, index)).filter((each) => dial && each.dial === dial);
      return hands.length ? [this.#card(dial, hands, this.sides.length > 1 && label)] : [];
    });
    return el("tr", { class: "faces" }, el("td", { colspan: this.sides.length > 1 ? 6 : 3 }, el("div", { class: "cards" }, cards)));
  }

  #card(dial, hands, label) {
    const drawing = new Dial(dial.title, dial, hands);
    this.dials.push(drawing);
    const { divisions, turns, cell, names } = dial.scale;
    const scale = divisions > 1 && `${divisions} ${cell}s${turns > 1 ? ` on ${turns} turns` : ""}`;
    return el(
      "figure",
      { class: names.length > MANY || hands.length > 2 ? "card wide" : "card" },
      drawing.node,
      el(
        "figcaption",
        {},
        el("strong", {}, dial.title),
        [label, scale, dial.look === "scale" && !dial.placed && "layout computed", dial.note].filter(Boolean).map((text) => el("span", { class: "quiet said" }, text)),
      ),
    );
  }

  #row(name) {
    const found = this.sides.map((side) => side.scene.pointers.findIndex((each) => each.output === name));
    const pointers = found.map((index, k) => this.sides[k].scene.pointers[index]);
    const readings = this.sides.map(({ scene, machine }, k) => pointers[k] && new Reading(scene, machine, found[k]));
    const dialled = readings.find((each) => each?.dial);
    const pick = el(
      "button",
      { type: "button", class: "plain", "aria-pressed": "false", onclick: () => this.onChoose(name) },
      dialled && el("span", { class: `key hand-${dialled.order % NEEDLES.length}`, "aria-hidden": "true" }),
      name,
    );
    const cells = readings.flatMap((reading) => this.#cells(reading));
    if (this.sides.length > 1) cells.push(this.#difference(pointers));
    const note = pointers.map((each) => each?.note).find(Boolean);
    const row = el("tr", { "data-output": name }, el("th", { scope: "row", title: note }, pick), cells);
    this.rows.push({ name, row, pick });
    return row;
  }

  #cells(reading) {
    if (!reading) return [0, 1].map(() => el("td", { class: "quiet" }, "\u2013"));
    const { pointer } = reading;
    const angle = el("td", { class: "angle", "data-angle": pointer.output });
    this.angles.push({ reading, angle });
    const known = pointer.shown !== null;
    const speed = known ? copyable(pointer.shown, this.say) : el("span", { class: "quiet" }, "not determined");
    const rounded = known && pointer.decimal !== pointer.shown && el("div", { class: "quiet decimal" }, shown(pointer.decimal));
    return [angle, el("td", { class: "number" }, speed, rounded)];
  }

  #difference(pointers) {
    const [a, b] = pointers.map((each) => each?.shown ?? null);
    const gap = this.one ? difference(a, b) : null;
    if (!gap) return el("td", { class: "quiet" }, "\u2013");
    if (gap.gap === "0") return el("td", { class: "number quiet" }, "none");
    return el(
      "td",
      { class: "number", "data-gap": gap.gap },
      copyable(gap.gap, this.say),
      el("div", { class: "quiet" }, relative(gap.part)),
    );
  }

  /** Hides the drawings and the outputs without the typed text; all are shown without a text. */
  #filter() {
    const wanted = this.search.value.trim().toLowerCase();
    for (const { name, row } of this.rows) row.hidden = !name.toLowerCase().includes(wanted);
    for (const row of this.node.querySelectorAll(".faces")) row.hidden = Boolean(wanted);
    if (wanted && this.others) this.others.open = true;
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
    if (!this.node.offsetParent) return;
    for (const dial of this.dials) dial.set();
    if (words) for (const { reading, angle } of this.angles) angle.textContent = textOf(reading.now);
    if (this.sky) this.sky.set(words);
  }
}
