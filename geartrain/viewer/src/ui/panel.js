// The panels at the side; on a narrow page, a sheet at the bottom.
import { about } from "./about.js";
import { Change } from "./change.js";
import { Contacts } from "./contacts.js";
import { el } from "./element.js";
import { BY_HAND } from "./keys.js";
import { Path } from "./path.js";
import { Readings } from "./readings.js";
import { Tabs } from "./tabs.js";
import { Wheels } from "./wheels.js";

export class Panel {
  constructor(owner) {
    this.owner = owner;
    const changes = owner.all.some(({ formulas }) => formulas);
    const names = ["Readings", "Wheels", changes && "Change", "About"].filter(Boolean);
    if (owner.all.some(({ machine }) => machine.run)) names.unshift("Contacts");
    this.places = Object.fromEntries(names.map((name) => [name, el("div", {})]));
    this.way = new Path({ onPair: (side, wheel) => owner.select(side, wheel), onClose: () => owner.letGo() });
    this.tabs = new Tabs(
      Object.entries(this.places).map(([name, node]) => ({ name, node })),
      "panels",
    );
    this.tabs.onShow = () => this.open(true);
    addEventListener("beforeprint", () => this.#print(true)); // before the pages are counted
    matchMedia("print").addEventListener("change", ({ matches }) => this.#print(matches));
    this.grip = el(
      "button",
      {
        type: "button",
        class: "grip",
        "aria-expanded": "false",
        "aria-controls": "panel",
        onclick: () => this.open(!this.node.classList.contains("open")),
      },
      "Open panels",
    );
    this.node = el(
      "aside",
      { class: "panel", id: "panel", tabindex: -1, "aria-label": "panels" },
      this.grip,
      this.way.node,
      this.tabs.node,
    );
  }

  /** Opens or closes the sheet below the picture; on wide pages the panels are always open. */
  open(on) {
    const opened = on && this.grip.offsetParent && !this.node.classList.contains("open");
    this.node.classList.toggle("open", on);
    if (opened) document.querySelector(".views")?.scrollIntoView();
    this.grip.setAttribute("aria-expanded", String(on));
    this.grip.textContent = on ? "Close panels" : "Open panels";
    if (on && this.readings) this.set(true);
  }

  use(sides) {
    const say = (text) => this.owner.live.say(text);
    const onChoose = (output) => this.owner.choose(output);
    const onSet = (day) => this.owner.setTo(day);
    const unfolded = this.readings?.comparison?.open;
    this.readings = new Readings(sides, { onChoose, onSet, say });
    if (unfolded && this.readings.comparison) this.readings.comparison.open = true;
    const onCounts = (side, counts) => this.owner.count(side, counts);
    this.wheels = new Wheels(sides, { onSelect: (side, index) => this.owner.select(side, index), onCounts, say });
    this.change = new Change(sides, { onCounts, say });
    this.chosen = null;
    this.contacts = new Contacts(sides, (side, contact) => this.owner.contact(side, contact));
    this.places.Contacts?.replaceChildren(this.contacts.node);
    this.places.Readings.replaceChildren(this.readings.node);
    this.places.Wheels.replaceChildren(this.wheels.node);
    this.places.Change?.replaceChildren(this.change.node);
    const byHand = el("p", { class: "quiet for-fingers" }, BY_HAND); // the list of keys is hidden without a keyboard
    this.places.About.replaceChildren(byHand, ...sides.map((side) => about(side, sides.length > 1)));
  }

  set(words) {
    this.readings.set(words);
    this.contacts.set(words);
  }

  /** Prepares the pictures and hidden panels for printing. */
  #print(printing) {
    for (const side of this.owner.sides) side.print(printing);
    if (!printing) return;
    for (const each of this.node.querySelectorAll(".more")) each.open = true;
    this.set(true);
  }

  /** Shows the changes. */
  showChange() {
    this.tabs.show("Change");
  }

  wheel(side, index) {
    this.wheels.show(side, index);
    const again = this.chosen?.[1] === index;
    this.chosen = index === null ? null : [side, index];
    if (again) return;
    if (index !== null) this.tabs.show("Wheels");
    if (index !== null) this.wheels.detail.scrollIntoView({ block: "nearest" });
  }

  path(output, found) {
    this.way.show(output, found);
    this.readings.mark(output);
    this.open(true);
  }

  find() {
    this.tabs.show("Wheels");
    this.wheels.search.focus();
    this.wheels.search.select();
  }

  letGo() {
    const inside = this.way.node.contains(document.activeElement);
    this.way.hide();
    const pick = this.readings.mark(null);
    if (inside) pick?.focus();
  }
}
