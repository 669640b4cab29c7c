// A strip that scrolls under a mark: intervals without contact or on the coast flank, and impacts, for each contact.
import { el } from "./element.js";

const WINDOW = 6; // width of the strip [s of real time]
const AHEAD = 1 / 3; // fraction of the strip before the mark
const NAMED = 12; // px: minimum height of lanes with names
const NAMES = 84; // px
const SLIP = 4; // maximum movement of a finger in a tap [px]
const FINE = 0.5; // px: marks closer to a drawn mark are omitted

export class Strip {
  constructor(run) {
    this.run = run;
    this.onSeek = () => {}; // (time, settled)
    this.pace = 1;
    const lane = Math.min(16, Math.max(4, 110 / Math.max(1, run.contacts.length)));
    Object.assign(this, { lane, named: lane >= NAMED, height: Math.ceil(lane * run.contacts.length) });
    this.node = el("canvas", {
      class: "strip",
      role: "img",
      "aria-label": "contacts near this moment; the table under Contacts lists them",
      style: `height: ${this.height}px`,
    });
    this.node.addEventListener("pointerdown", (event) => this.#grab(event));
    this.width = 0; // cached, because a query at every frame would force a layout of the page
    new ResizeObserver(() => {
      this.width = this.node.clientWidth;
      this.#draw();
    }).observe(this.node);
  }

  set(time) {
    this.time = time;
    this.#draw();
  }

  get #left() {
    return this.named ? NAMES : 0;
  }

  get #span() {
    return Math.min(WINDOW * this.pace, this.run.duration);
  }

  /** The time at the left end (s): the strip stays within the run. */
  get #from() {
    return Math.min(Math.max(0, this.time - (1 - AHEAD) * this.#span), this.run.duration - this.#span);
  }

  /** A tap selects a time; a drag moves the strip under its mark. */
  #grab(event) {
    const [from, began] = [event.clientX, this.time];
    const scale = this.#span / (this.width - this.#left); // seconds per pixel
    let moved = false;
    const move = (each) => {
      moved ||= Math.abs(each.clientX - from) > SLIP;
      if (moved) this.onSeek(began - (each.clientX - from) * scale, false);
    };
    const end = () => {
      this.node.removeEventListener("pointermove", move);
      const off = from - this.node.getBoundingClientRect().left - this.#left;
      if (moved) this.onSeek(this.time, true);
      else if (off >= 0) this.onSeek(this.#from + off * scale, true);
    };
    this.node.setPointerCapture(event.pointerId);
    this.node.addEventListener("pointermove", move);
    this.node.addEventListener("lostpointercapture", end, { once: true });
  }

  #draw() {
    const { width } = this;
    if (!width || this.time === undefined) return;
    const density = Math.min(globalThis.devicePixelRatio || 1, 2);
    const [wide, high] = [Math.round(width * density), Math.round(this.height * density)];
    if (this.node.width !== wide || this.node.height !== high) Object.assign(this.node, { width: wide, height: high });
    const pen = this.node.getContext("2d");
    const colours = this.#colours();
    pen.setTransform(density, 0, 0, density, 0, 0);
    pen.clearRect(0, 0, width, this.height);
    pen.font = "11px system-ui, sans-serif";
    pen.textBaseline = "middle";
    const [from, span, left] = [this.#from, this.#span, this.#left];
    const place = (time) => left + ((time - from) / span) * (width - left);
    this.run.contacts.forEach((contact, index) => this.#lane(pen, contact, index, colours, place, from, width));
    pen.fillStyle = colours.ink;
    pen.fillRect(place(this.time) - 0.75, 0, 1.5, this.height);
  }

  /** Colours of the page, read again after a change of theme. */
  #colours() {
    const { theme } = document.documentElement.dataset;
    if (!this.colours || this.theme !== theme) {
      const style = getComputedStyle(this.node);
      const colour = (name) => style.getPropertyValue(`--${name}`).trim();
      this.colours = { line: colour("line"), ink: colour("ink"), a: colour("apart"), c: colour("coast"), blow: colour("blow") };
      this.theme = theme;
    }
    return this.colours;
  }

  #lane(pen, contact, index, colours, place, from, width) {
    const [top, size, to] = [index * this.lane, this.lane - 1, from + this.#span];
    pen.fillStyle = colours.line;
    pen.fillRect(this.#left, top + size, width, 1);
    if (this.named) {
      pen.fillStyle = colours.ink;
      pen.fillText(contact.name, 0, top + size / 2, NAMES - 8);
    }
    let drawn = -Infinity;
    for (const [state, begins, ends] of this.run.stretches(index, from, to)) {
      const [x, end] = [Math.max(place(begins), this.#left), place(ends)];
      if (state === "d" || end < drawn + FINE) continue;
      pen.fillStyle = colours[state];
      pen.fillRect(x, top + 0.15 * size, Math.max(0.7, end - x), 0.7 * size);
      drawn = Math.max(end, x + 0.7);
    }
    let [last, high] = [-Infinity, 0];
    pen.fillStyle = colours.blow;
    for (const [time, strength] of this.run.blowsOf(index, from, to)) {
      const x = place(time);
      if (x < last + FINE && strength <= high) continue;
      pen.fillRect(x - 0.75, top + size * (1 - strength), 1.5, size * strength);
      [last, high] = [x, strength];
    }
  }
}
