// Outputs with targets: reading of each pointer, reading at the speed of its target, and the error.
import { Epoch, inWords } from "../calendar.js";
import { Fraction } from "../fraction.js";
import { copy } from "./copying.js";
import { el } from "./element.js";
import { shown } from "./number.js";
import { Reading, degrees, within } from "./reading.js";

const CENTURY = 36525; // days

/** True if a pointer of a scene has a target. */
export const hasTargets = (scene) => scene.pointers.some(({ targets }) => targets.length);

/** What a pointer should read, turns from the start of its scale, had it turned at a target's speed since the start. */
export function skyOf(reading, target, turns) {
  const made = Fraction.of(target.speed).times(turns);
  return within(reading.sense * (Number(made.floor % BigInt(reading.turns)) + made.part) + reading.start, reading.turns);
}

/** Turns by which a pointer is ahead of a target in mean motion, exactly; both in their declared sense. */
export const aheadOf = (pointer, target, turns) => Fraction.of(pointer.speed).minus(target.speed).times(turns);

/** Text of turns in degrees with a sign. */
export function signed(turns) {
  const value = Number(turns) * 360;
  if (!value) return "0\u00b0";
  const size = Math.abs(value);
  const text = size < 5e-5 || size >= 1e6 ? size.toExponential(1) : size < 5e-4 ? size.toFixed(4) : size < 100 ? size.toFixed(3) : size < 1000 ? size.toFixed(2) : size.toFixed(0);
  return `${value < 0 ? "\u2212" : "+"}${text}\u00b0`;
}

export class Sky {
  constructor(sides, say) {
    this.say = say;
    this.rows = [];
    this.node = el("div", {}, sides.map((side) => this.#part(side, sides.length > 1)));
  }

  #part(side, many) {
    const { scene } = side;
    if (!hasTargets(scene)) return many && el("p", { class: "quiet" }, `${side.label} has no targets.`);
    const growth = scene.unit_days === null ? "per unit" : "per century";
    const heads = ["output, target", "pointer", "target", "pointer ahead", growth];
    return [
      many && el("h3", {}, side.label),
      scene.epoch && epochInWords(scene),
      el(
        "p",
        { class: "tells quiet" },
        "Mean motion without anomalies: pointers and targets agree at 0 turns, and each target has a constant speed. Errors are exact; click one to copy it in turns.",
      ),
      el(
        "div",
        { class: "scroll", tabindex: 0, role: "region", "aria-label": "targets" },
        el(
          "table",
          { class: "sky" },
          el("thead", {}, el("tr", {}, heads.map((head) => el("th", { scope: "col" }, head)))),
          el("tbody", {}, scene.pointers.flatMap((pointer, index) => pointer.targets.map((target) => this.#row(side, index, target)))),
        ),
      ),
    ];
  }

  #row(side, index, target) {
    const { scene, machine } = side;
    const pointer = scene.pointers[index];
    const [own, sky] = [el("td", { class: "angle" }), el("td", { class: "angle" })];
    const error = el("button", { type: "button", class: "copy" });
    error.addEventListener("click", async () => {
      const text = error.dataset.exact;
      this.say((await copy(text)) ? `${text} turns copied` : "the browser does not permit copying");
    });
    const span = scene.unit_days === null ? Fraction.of(scene.step) : Fraction.of(scene.step).times(CENTURY).over(scene.unit_days);
    this.rows.push({ reading: new Reading(scene, machine, index), target, own, sky, error, machine });
    return el(
      "tr",
      { "data-pointer": pointer.output, "data-target": target.label },
      el("th", { scope: "row" }, pointer.output, el("div", { class: "quiet" }, breakable(target.label))),
      own,
      sky,
      el("td", { class: "angle" }, error),
      el("td", { class: "angle" }, signed(aheadOf(pointer, target, span))),
    );
  }

  set(words) {
    if (!words || !this.node.offsetParent) return;
    for (const { reading, target, own, sky, error, machine } of this.rows) {
      const turns = machine.made();
      const ahead = aheadOf(reading.pointer, target, turns);
      own.textContent = degrees(reading.now.degrees);
      sky.textContent = degrees(within(skyOf(reading, target, turns), 1) * 360);
      error.textContent = signed(ahead);
      error.dataset.exact = ahead.toString();
      error.title = `${shown(ahead.toString())} turns`;
      error.setAttribute("aria-label", `${signed(ahead)} ahead, copy the exact turns`);
    }
  }
}

/** A name with possible line breaks after its underscores. */
const breakable = (name) => name.split(/(?<=_)/).flatMap((part) => [part, el("wbr")]);

/** Epoch of the pointers, with its source and calendar. */
function epochInWords(scene) {
  const epoch = new Epoch(scene.epoch);
  const lead = scene.bodies[scene.driving_link].id;
  const made = epoch.turns.numerator === 0n ? "All pointers were at the start of their scales" : `${lead} had made ${epoch.turns} turns`;
  const date = epoch.dateAt(epoch.turns);
  const cite = scene.sources[epoch.source]?.cite;
  const calendar = date.calendar === "julian" ? "Julian" : "Gregorian";
  return el(
    "p",
    { class: "epoch" },
    `${made} on ${inWords(date)} (${calendar} calendar).`,
    epoch.note && ` ${epoch.note}`,
    epoch.source && el("span", { class: "quiet" }, ` ${epoch.source}${cite ? `: ${cite}` : ""}`),
  );
}
