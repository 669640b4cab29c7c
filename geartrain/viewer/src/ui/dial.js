// One dial as a drawing: scale, spiral, zero mark, hands. Clockwise on the page is clockwise as read.
import { NEEDLES } from "../colours.js";
import { svg } from "./element.js";
import { skyOf } from "./sky.js";

const RIM = 84;
const place = (turn, radius, zero) => {
  const angle = 2 * Math.PI * turn + zero;
  return [radius * Math.sin(angle), -radius * Math.cos(angle)];
};
const at = (point) => `${point[0].toFixed(2)} ${point[1].toFixed(2)}`;

/** Where the zero mark stands as one faces the dial: radians clockwise from the top. */
export function zeroOf(dial) {
  const [nx, , nz] = dial.normal;
  const right = [nz, 0, -nx]; // up x normal
  const size = Math.hypot(...right);
  if (size < 1e-6) return 0;
  const across = (dial.zero[0] * right[0] + dial.zero[2] * right[2]) / size;
  return Math.atan2(across, dial.zero[1]);
}

function every(divisions) {
  if (divisions === 360) return 30;
  if (divisions > 60) return 10;
  return divisions > 12 ? 5 : 1;
}

export class Dial {
  /** `dial` as in the scene, or null for a plain face; `hands` the readings that stand on it. */
  constructor(name, dial, hands) {
    this.turns = dial?.turns || 1;
    this.divisions = dial?.divisions ?? 12;
    this.numbered = dial !== null;
    this.zero = dial ? zeroOf(dial) : 0;
    const inner = dial && dial.radius > 0 ? dial.inner / dial.radius : 1;
    this.inner = this.turns > 1 ? RIM * Math.min(0.75, Math.max(0.4, inner)) : RIM;
    this.hands = hands.map((hand, order) => ({ reading: hand, node: this.#hand(order, hand), sky: this.#sky(order, hand) }));
    this.node = svg(
      "svg",
      { viewBox: "-100 -100 200 200", class: "dial", role: "img", "aria-label": `dial ${name}` },
      svg("circle", { r: 97, class: "face" }),
      ...this.#scale(),
      ...this.hands.flatMap((hand) => hand.sky ?? []),
      ...this.hands.map((hand) => hand.node),
      svg("circle", { r: 3.2, class: "boss" }),
    );
  }

  #radius(turns) {
    return this.inner + ((RIM - this.inner) * turns) / this.turns;
  }

  #scale() {
    const steps = 96 * this.turns;
    const line = Array.from({ length: steps + 1 }, (_, k) => {
      const turns = (k / steps) * this.turns;
      return at(place(turns, this.#radius(turns), this.zero));
    });
    const bold = every(this.divisions);
    const [fine, major, numbers] = [[], [], []];
    for (let k = 0; k < this.divisions && this.divisions > 1; k += 1) {
      const turns = (k / this.divisions) * this.turns;
      const radius = this.#radius(turns);
      const long = k % bold === 0;
      (long ? major : fine).push(
        `M${at(place(turns, radius, this.zero))}L${at(place(turns, radius + (long ? 6 : 3.2), this.zero))}`,
      );
      if (this.numbered && long && this.turns === 1 && this.divisions / bold <= 12)
        numbers.push(this.#number(k, turns));
    }
    const mark = [place(0, RIM + 12.5, this.zero), place(0.012, RIM + 4.5 + 7, this.zero)];
    const tip = place(0, this.#radius(0) + 1, this.zero);
    const sides = [-0.011, 0.011].map((turn) => at(place(turn, RIM + 12.5, this.zero)));
    return [
      svg("path", { class: "rim", d: `M${line.join("L")}` }),
      svg("path", { class: "fine", d: fine.join("") }),
      svg("path", { class: "major", d: major.join("") }),
      ...numbers,
      svg("path", {
        class: "zero",
        d: this.turns > 1 ? `M${at(tip)}L${at(mark[0])}` : `M${sides[0]}L${sides[1]}L${at(tip)}Z`,
      }),
    ];
  }

  #number(k, turns) {
    const [x, y] = place(turns, RIM - 9, this.zero);
    return svg("text", { x: x.toFixed(2), y: (y + 3).toFixed(2), class: "number" }, String(k));
  }

  #hand(order, reading) {
    const tail = 12 + (order % 3) * 3;
    const group = svg("g", { class: `hand hand-${order % NEEDLES.length}`, "data-output": reading.pointer.output });
    this.draw(group, tail, order);
    return group;
  }

  /** Where the first target of a pointer stands: an open circle on its scale. */
  #sky(order, { pointer }) {
    const [target] = pointer.targets;
    if (!target) return null;
    const title = svg("title", {}, `${pointer.output} by ${target.label}, mean motion`);
    return svg("circle", { class: `target hand-${order % NEEDLES.length}`, r: 4, "data-output": pointer.output }, title);
  }

  draw(group, tail, order) {
    const reach = RIM - 4 - (this.turns === 1 ? (order % 4) * 6 : 0);
    group.append(
      svg("path", {
        class: "needle",
        d: `M-1.5 ${tail}L-1.1 ${-reach + 8}L0 ${-reach}L1.1 ${-reach + 8}L1.5 ${tail}Z`,
      }),
    );
    if (this.turns > 1) group.append(svg("circle", { class: "follower", r: 3.4 }));
  }

  #place(mark, turns) {
    const [x, y] = place(turns, this.#radius(turns) + (this.turns > 1 ? 0 : 1), this.zero);
    mark.setAttribute("cx", x.toFixed(3));
    mark.setAttribute("cy", y.toFixed(3));
    mark.setAttribute("data-turns", turns.toFixed(12));
  }

  /** Stands every hand where it is now. */
  set() {
    for (const { reading, node, sky } of this.hands) {
      const value = reading.now;
      if (sky) this.#place(sky, skyOf(reading, reading.pointer.targets[0], reading.machine.made()));
      node.classList.toggle("unknown", !value);
      if (!value) continue;
      const turn = (value.degrees + (this.zero * 180) / Math.PI) % 360;
      node.setAttribute("transform", `rotate(${turn.toFixed(6)})`);
      node.setAttribute("data-turns", value.turns.toFixed(12)); // from the start of the scale
      node.querySelector(".follower")?.setAttribute("cy", (-this.#radius(value.turns)).toFixed(3));
    }
  }
}
