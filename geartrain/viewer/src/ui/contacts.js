// The panel of a simulated run: drive, deviations of the outputs, state and statistics of each contact.
import { el } from "./element.js";
import { speedInWords } from "./playhead.js";

const STATES = { d: "drive flank", c: "coast flank", a: "separated", "": "\u2013" };
const KINDS = { pair: "", pin: "pin", escapement: "escapement" };

const SLIGHT = 2e-4; // rad: accuracy of the angles in the page

const percent = (share) => (share ? `${Number((100 * share).toFixed(share < 0.01 ? 3 : share < 0.1 ? 2 : 1))} %` : "0");
const rounded = (value) => String(Number(value.toPrecision(3))).replace("-", "\u2212");
const inDegrees = (angle) => `${rounded((angle * 180) / Math.PI)}\u00b0`;

export class Contacts {
  /** `onChoose(side, contact)`, with the index of a contact */
  constructor(sides, onChoose) {
    this.onChoose = onChoose;
    this.rows = [];
    this.leads = [];
    const played = sides.filter(({ machine }) => machine.simulated);
    this.node = el(
      "div",
      {},
      played.map((side) => this.#side(side, sides.length > 1)),
      played.length ? null : el("p", { class: "quiet" }, "In this motion all drive flanks are in contact, as without inertia."),
    );
  }

  #side(side, many) {
    const { run } = side.scene;
    return el(
      "section",
      {},
      many && el("h3", {}, side.label),
      el("ul", { class: "legend tells" }, key("blow", "impact"), key("apart", "teeth separated"), key("coast", "contact on the coast flank")),
      run.contacts.length
        ? el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "contacts" }, this.#table(side))
        : el("p", { class: "quiet" }, "No pair has real teeth, a pin or a loss, so there are no separations or impacts."),
      this.#outputs(side),
      el("p", {}, words(run)),
      run.complete ? null : el("p", { class: "bad" }, "The simulation was stopped before its end."),
      run.notes.map((note) => el("p", { class: "note" }, note)),
    );
  }

  #table(side) {
    const { scene, machine } = side;
    const head = ["contact", "now", "separated", "coast", "impacts/s", "maximum"];
    const rows = scene.run.contacts.map((contact, index) => {
      const now = el("td", { class: "now" });
      this.rows.push({ now, state: () => machine.run.state(index, machine.time()) });
      const flanks = [contact.apart, contact.coast].map((share) => el("td", { class: "number" }, percent(share)));
      return el(
        "tr",
        { "data-contact": contact.name },
        el(
          "th",
          { scope: "row" },
          el("button", { type: "button", class: "plain", onclick: () => this.onChoose(side, index) }, contact.name),
          KINDS[contact.kind] && el("div", { class: "quiet" }, KINDS[contact.kind]),
        ),
        now,
        flanks,
        el("td", { class: "number" }, rounded(contact.impact_rate)),
        el("td", { class: "number" }, contact.hardest ? `${inDegrees(contact.hardest)}/s` : "\u2013"),
      );
    });
    return el(
      "table",
      { class: "outputs contacts" },
      el("caption", { class: "unseen" }, "Contacts: present state, and shares of the whole run"),
      el("thead", {}, el("tr", {}, head.map((each) => el("th", { scope: "col" }, each)))),
      el("tbody", {}, rows),
    );
  }

  #outputs({ scene, machine }) {
    if (!scene.run.deviations.length) return null;
    if (!scene.run.deviations.some(({ ahead, behind }) => settled(ahead, SLIGHT) || settled(behind, SLIGHT)))
      return el("p", {}, "No output deviates from the motion with all drive flanks in contact.");
    const rows = scene.run.deviations.map((lead) => {
      const index = scene.pointers.findIndex(({ output }) => output === lead.output);
      const now = el("td", { class: "number" });
      if (index < 0 || scene.movement.kind === "mean") now.textContent = "\u2013";
      else this.leads.push({ now, ahead: () => machine.aheadBy(index) });
      return el(
        "tr",
        { "data-lead": lead.output },
        el("th", { scope: "row" }, lead.output),
        now,
        el("td", { class: "number" }, inDegrees(settled(lead.ahead))),
        el("td", { class: "number" }, inDegrees(settled(lead.behind))),
      );
    });
    return el(
      "div",
      { class: "scroll" },
      el("p", {}, "Outputs relative to the motion with all drive flanks in contact:"),
      el(
        "table",
        { class: "outputs" },
        el("thead", {}, el("tr", {}, ["output", "ahead now", "maximum ahead", "maximum behind"].map((each) => el("th", { scope: "col" }, each)))),
        el("tbody", {}, rows),
      ),
    );
  }

  set(fresh) {
    if (!fresh || !this.node.offsetParent) return;
    for (const { now, state } of this.rows) {
      const value = state();
      now.textContent = STATES[value];
      now.dataset.state = value;
    }
    for (const { now, ahead } of this.leads) now.textContent = inDegrees(settled(ahead(), SLIGHT));
  }
}

/** An angle, or 0 if it is below the tolerance `least` (rad). */
const settled = (angle, least = 1e-7) => (Math.abs(angle) < least ? 0 : angle);

const key = (kind, text) => el("li", {}, el("span", { class: `swatch ${kind}` }), text);

function words({ driven, link, torque, rate, skip }) {
  const by = { rate: "kept at constant speed", torque: "driven by a torque or a weight", spring: "driven by a spring", hand: "driven by a hand of finite stiffness" }[driven];
  const before = skip ? ` The first ${rounded(skip)} s are omitted.` : "";
  return `${link} is ${by}: mean speed of the input ${speedInWords(rate)}, torque ${rounded(1000 * torque)} N mm.${before}`;
}
