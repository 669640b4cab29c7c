// The list of wheels with a search field, and the data of the selected wheel.
import { stepper } from "./change.js";
import { copyable } from "./copying.js";
import { el, link } from "./element.js";
import { shown } from "./number.js";

const STATUS = { surviving: "surviving", reconstructed: "reconstructed", hypothetical: "hypothetical" };
const percent = (part) => `${(part * 100).toPrecision(3)} % of the input power`;

/** Rows of the data of a wheel: [term, text or an element]. */
export function facts(scene, wheel, say, teeth = null) {
  const body = scene.bodies[wheel.body];
  const source = scene.sources[wheel.source];
  const pairs = scene.pairs.filter((pair) => wheel.circuits.includes(pair.id));
  const speed =
    body.shown === null
      ? [["Speed", "not determined"]]
      : [
          ["Speed, exact", copyable(body.shown, say)],
          ["Speed, decimal", `${shown(body.decimal)}${scene.unit && !body.travels ? ` ${scene.unit}` : ""}`],
        ];
  return [
    ["Teeth", teeth ?? copyable(String(wheel.teeth), say)],
    ["Uncertain", wheel.doubt],
    ["Kind", wheel.kind],
    ["On", `${body.id}${body.role === "arbor" ? "" : ` (${body.role})`}`],
    ["Status", STATUS[wheel.status] ?? "not stated"],
    ...speed,
    ["", body.bookkeeping ? "sum over joints that are not parallel, not a rotation" : ""],
    [
      "Circuits",
      pairs.length
        ? el(
            "ul",
            {},
            pairs.map((pair) =>
              el(
                "li",
                { class: pair.broken && "bad" },
                `${pair.id}, carried by ${scene.bodies[pair.carrier]?.id ?? "nothing"}: ${pair.text}`,
              ),
            ),
          )
        : "no meshes",
    ],
    ["Loss", wheel.loss === null || wheel.loss === undefined ? "" : percent(wheel.loss)],
    ["Note", wheel.note],
    [
      "Source",
      wheel.source &&
        el("span", {}, `${wheel.source}${source?.cite ? `: ${source.cite}` : ""} `, source?.url && link(source.url)),
    ],
  ].filter(([, value]) => value !== "" && value !== null && value !== undefined);
}

export class Wheels {
  /** `onSelect(side, wheel index or null)` */
  constructor(sides, { onSelect, onCounts, say }) {
    this.sides = sides;
    this.onCounts = onCounts;
    this.onSelect = onSelect;
    this.say = say;
    this.items = [];
    this.detail = el("section", { class: "detail", hidden: true, "aria-label": "wheel", tabindex: -1 });
    this.search = el("input", {
      type: "search",
      placeholder: "Find a wheel",
      "aria-label": "find a wheel",
      oninput: () => this.#filter(),
    });
    this.none = el("p", { class: "quiet", hidden: true }, "No wheel has this name.");
    this.node = el(
      "div",
      {},
      this.detail,
      this.search,
      this.none,
      sides.map((side) => this.#list(side)),
    );
  }

  #list(side) {
    const items = side.scene.wheels.map((wheel, index) => {
      const button = el(
        "button",
        { type: "button", "aria-pressed": "false", "data-wheel": wheel.id, onclick: () => this.onSelect(side, index) },
        el("span", {}, wheel.id),
        el("span", { class: "quiet" }, `${wheel.teeth}${wheel.doubt ? " ?" : ""}`),
      );
      const steps = stepper(side, index, this.onCounts, "list");
      const item = el("li", { class: side.steps.some((step) => step.wheel === wheel.id) && "stepped" }, button, steps);
      const text = `${wheel.id} ${wheel.teeth} ${side.scene.bodies[wheel.body].id} ${wheel.status}`.toLowerCase();
      this.items.push({ side, index, item, button, text });
      return item;
    });
    return [this.sides.length > 1 && el("h3", {}, side.label), el("ul", { class: side.formulas ? "wheels stepped" : "wheels" }, items)];
  }

  #filter() {
    const wanted = this.search.value.trim().toLowerCase();
    for (const each of this.items) each.item.hidden = !each.text.includes(wanted);
    this.none.hidden = this.items.some((each) => !each.item.hidden);
  }

  /** Shows one wheel, or none. */
  show(side, index) {
    for (const each of this.items)
      each.button.setAttribute("aria-pressed", String(each.side === side && each.index === index));
    const inside = this.detail.contains(document.activeElement);
    this.detail.hidden = index === null;
    if (inside && index === null) this.before?.focus();
    this.before = this.items.find((each) => each.side === side && each.index === index)?.button;
    this.detail.replaceChildren();
    if (index === null) return;
    const wheel = side.scene.wheels[index];
    this.detail.append(
      el(
        "div",
        { class: "row" },
        el("h3", {}, `Wheel ${wheel.id}`),
        el("button", { type: "button", class: "small", onclick: () => this.onSelect(side, null) }, "Close"),
      ),
      el(
        "dl",
        {},
        facts(side.scene, wheel, this.say, stepper(side, index, this.onCounts, "one", true)).map(([term, value]) => [el("dt", {}, term), el("dd", {}, value)]),
      ),
    );
  }
}
