// A strip that runs under a mark: for each contact when its teeth are apart or on the coast flank, and its blows.
import { el } from "./element.js";

const WINDOW = 6; // s as the reader sees them
const AHEAD = 1 / 3; // of the strip lies before the mark
const NAMED = 12; // px: lanes as high are named
const NAMES = 84; // px

export class Strip {
  constructor(run) {
    this.run = run;
    this.onSeek = () => {};
    this.pace = 1;
    const lane = Math.min(16, Math.max(4, 110 / Math.max(1, run.contacts.length)));
    Object.assign(this, { lane, named: lane >= NAMED, height: Math.ceil(lane * run.contacts.length) });
    this.node = el("canvas", {
      class: "strip",
      role: "img",
      "aria-label": "contacts around this moment; the table under Contacts tells them in words",
      style: `height: ${this.height}px`,
    });
    this.node.addEventListener("pointerdown", (event) => this.#seek(event));
    new ResizeObserver(() => this.#draw()).observe(this.node);
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

  #seek(event) {
    const box = this.node.getBoundingClientRect();
    const share = (event.clientX - box.left - this.#left) / (box.width - this.#left);
    if (share >= 0) this.onSeek(this.#from + share * this.#span);
  }

  #draw() {
    const { clientWidth: width } = this.node;
    if (!width || this.time === undefined) return;
    const density = Math.min(globalThis.devicePixelRatio || 1, 2);
    const [wide, high] = [Math.round(width * density), Math.round(this.height * density)];
    if (this.node.width !== wide || this.node.height !== high) Object.assign(this.node, { width: wide, height: high });
    const pen = this.node.getContext("2d");
    const style = getComputedStyle(this.node);
    const colour = (name) => style.getPropertyValue(`--${name}`).trim();
    const colours = { line: colour("line"), ink: colour("ink"), a: colour("apart"), c: colour("coast"), blow: colour("blow") };
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

  #lane(pen, contact, index, colours, place, from, width) {
    const [top, size, to] = [index * this.lane, this.lane - 1, from + this.#span];
    pen.fillStyle = colours.line;
    pen.fillRect(this.#left, top + size, width, 1);
    if (this.named) {
      pen.fillStyle = colours.ink;
      pen.fillText(contact.name, 0, top + size / 2, NAMES - 8);
    }
    for (const [state, begins, ends] of this.run.stretches(index, from, to)) {
      if (state === "d") continue;
      pen.fillStyle = colours[state];
      const x = Math.max(place(begins), this.#left);
      pen.fillRect(x, top + 0.15 * size, Math.max(0.7, place(ends) - x), 0.7 * size);
    }
    for (const [time, strength] of this.run.blowsOf(index, from, to)) {
      pen.fillStyle = colours.blow;
      pen.fillRect(place(time) - 0.75, top + size * (1 - strength), 1.5, size * strength);
    }
  }
}
