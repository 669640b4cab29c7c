// Pointers of the sky and outputs with targets: reading of each pointer, the sky or a target, and the error.
import { Epoch, dateOf, inWords } from "../calendar.js";
import { Fraction } from "../fraction.js";
import { longitude, turnsWhenSet } from "../setting.js";
import { copy } from "./copying.js";
import { el } from "./element.js";
import { shown } from "./number.js";
import { Reading, degrees, within } from "./reading.js";

const CENTURY = 36525; // days

/** True if a pointer of a scene has a target, or shows the sky. */
export const hasTargets = ({ pointers, epoch }) => pointers.some(({ targets }) => targets.length) || Boolean(epoch && (epoch.settings.length || epoch.unset.length));

/** What a pointer should read, turns from the start of its scale, had it turned at a target's speed since it was set. */
export function skyOf(reading, target, turns) {
  const since = turnsWhenSet(reading.machine.scene);
  const made = Fraction.of(target.speed).times(turns.minus(since)).plus(Fraction.of(reading.pointer.speed).times(since));
  return within(reading.sense * (Number(made.floor % BigInt(reading.turns)) + made.part) + reading.start, reading.turns);
}

/** Body of the sky whose longitude a pointer shows; undefined if it shows none or is not set. */
export const bodyOf = ({ epoch }, index) => epoch?.settings.find(({ pointer }) => pointer === index)?.body || undefined;

/** True longitude of the body of a pointer at the current turns, turns from the start of its scale. */
function heavenOf({ machine, index }) {
  const { epoch } = machine.scene;
  return within(longitude(epoch.elements, bodyOf(machine.scene, index), new Epoch(epoch).dayAt(machine.made())) / 360, 1);
}

/** Mark of a pointer on its dial, turns from the start of the scale: the sky if it shows a body, otherwise its first target. */
export const markOf = (reading) =>
  bodyOf(reading.machine.scene, reading.index) ? heavenOf(reading) : skyOf(reading, reading.pointer.targets[0], reading.machine.made());

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
  /** `say(text)`; `onSet(day)` sets the pointers to the sky on a Julian day */
  constructor(sides, { say, onSet }) {
    Object.assign(this, { say, onSet, rows: [], heavens: [] });
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
      scene.epoch?.settings.length > 0 && this.#set(side),
      el(
        "p",
        { class: "tells quiet" },
        "The sky is the true geocentric longitude from the equinox of the date (of the Moon's node, the mean longitude). Targets are mean motions without anomalies, which agree with the pointers when these are set. Errors of targets are exact; click one to copy it in turns.",
      ),
      el(
        "div",
        { class: "scroll", tabindex: 0, role: "region", "aria-label": "targets" },
        el(
          "table",
          { class: "sky" },
          el("thead", {}, el("tr", {}, heads.map((head) => el("th", { scope: "col" }, head)))),
          el("tbody", {}, scene.pointers.flatMap((pointer, index) => [this.#heaven(side, index), ...pointer.targets.map((target) => this.#row(side, index, target))])),
        ),
      ),
    ];
  }

  /** Button that sets the pointers to the sky at the displayed date. */
  #set({ scene, machine }) {
    const epoch = new Epoch(scene.epoch);
    const day = Fraction.of(scene.epoch.day ?? scene.epoch.julian_day);
    const set = el("button", { type: "button", class: "small" }, "Set at the displayed date");
    set.addEventListener("click", () => this.onSet(epoch.dayAt(machine.made())));
    return el("p", { class: "set" }, `Pointers set to the sky: ${inWords(dateOf(day, epoch.calendar))} `, set);
  }

  /** Row of a pointer of the sky, if it is one. */
  #heaven(side, index) {
    const { scene, machine } = side;
    const { output } = scene.pointers[index];
    const body = bodyOf(scene, index);
    const unset = scene.epoch?.unset.includes(output);
    if (!body && !unset) return null;
    const cells = [0, 1, 2].map(() => el("td", { class: "angle" }));
    if (unset) cells[1].textContent = "not set to the sky";
    else this.heavens.push({ reading: new Reading(scene, machine, index), cells });
    const label = body === "moon_node" ? "the sky, mean node" : "the sky";
    return el("tr", { "data-heaven": output }, el("th", { scope: "row" }, output, el("div", { class: "quiet" }, label)), cells, el("td", { class: "angle" }, "\u2013"));
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
    for (const { reading, cells } of this.heavens) {
      const angles = [reading.now.degrees, heavenOf(reading) * 360];
      const ahead = within(angles[0] - angles[1] + 180, 360) - 180;
      cells.forEach((cell, at) => (cell.textContent = at < 2 ? degrees(angles[at]) : signed(ahead / 360)));
    }
    for (const { reading, target, own, sky, error, machine } of this.rows) {
      const turns = machine.made();
      const ahead = aheadOf(reading.pointer, target, turns.minus(turnsWhenSet(machine.scene)));
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
  const made = epoch.turns.numerator === 0n ? `${lead} had made no turns` : `${lead} had made ${epoch.turns} turns`;
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
