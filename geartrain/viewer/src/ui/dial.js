// Drawing of one dial: engraving, zero mark and hands. Clockwise on the page is clockwise as read.
import { NEEDLES } from "../colours.js";
import { engraved, handOf } from "../faces.js";
import { svg } from "./element.js";
import { bodyOf, markOf } from "./sky.js";

const RIM = 90;
const PLAIN = { turns: 1, divisions: 12, inner: 1, outer: 1, way: 1 }; // scale of an output without a dial
const NEEDLE = { reach: 0.97, outline: [[-0.15, 0.018], [0, 0.014], [0.9, 0.012], [1, 0]] };
const place = (turn, radius, zero) => {
  const angle = 2 * Math.PI * turn + zero;
  return [radius * Math.sin(angle), -radius * Math.cos(angle)];
};
const at = (point) => `${point[0].toFixed(2)} ${point[1].toFixed(2)}`;

const pathOf = (line) => `M${engraved(line).map(([x, y]) => at([RIM * x, -RIM * y])).join("L")}`;

/** Angle of the zero mark for an observer in front of the dial: radians clockwise from the top. */
export function zeroOf(dial) {
  const [nx, , nz] = dial.normal;
  const right = [nz, 0, -nx]; // up vector x normal
  const size = Math.hypot(...right);
  if (size < 1e-6) return 0;
  const across = (dial.zero[0] * right[0] + dial.zero[2] * right[2]) / size;
  return Math.atan2(across, dial.zero[1]);
}

export class Dial {
  /** `dial`: dial of the scene, or null for a plain face; `hands`: its readings */
  constructor(name, dial, hands) {
    this.scale = dial?.scale ?? PLAIN;
    this.engraving = dial?.engraving ?? [];
    this.zero = dial ? zeroOf(dial) : 0;
    this.hands = hands.map((hand) => ({ reading: hand, node: this.#hand(hand), sky: this.#sky(hand) }));
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
    const { inner, outer, turns: all } = this.scale;
    return RIM * (inner + ((outer - inner) * turns) / all);
  }

  /** Draws the engraving of the scene; for a plain face, a rim and twelve marks. */
  #scale() {
    const turned = { transform: `rotate(${((this.zero * 180) / Math.PI).toFixed(6)})` };
    const drawn = this.engraving.map(([kind, width, lines]) => svg("path", { class: kind, "stroke-width": (width * RIM).toFixed(3), d: lines.map(pathOf).join("") }));
    const marks = Array.from({ length: 12 }, (_, k) => `M${at(place(k / 12, RIM, 0))}L${at(place(k / 12, RIM - 4, 0))}`).join("");
    const plain = [svg("circle", { class: "rim", r: RIM }), svg("path", { class: "fine", d: marks })];
    const sides = [-0.011, 0.011].map((turn) => at(place(turn, RIM + 8, 0)));
    const zero = svg("path", { class: "zero", d: `M${sides[0]}L${sides[1]}L${at(place(0, RIM + 1.5, 0))}Z` });
    return [svg("g", turned, ...(drawn.length ? drawn : plain), zero)];
  }

  #hand(reading) {
    const { order } = reading;
    const group = svg("g", { class: `hand hand-${order % NEEDLES.length}`, "data-output": reading.pointer.output });
    this.draw(group, reading, order);
    return group;
  }

  /** Marker of the sky or of the first target of a pointer: an open circle on its scale. */
  #sky({ order, pointer, machine, index }) {
    const [target] = pointer.targets;
    if (!target) return null;
    const title = svg("title", {}, bodyOf(machine.scene, index) ? `${pointer.output} in the sky` : `${pointer.output} by ${target.label}, mean motion`);
    return svg("circle", { class: `target hand-${order % NEEDLES.length}`, r: 4, "data-output": pointer.output }, title);
  }

  draw(group, { pointer }, order) {
    const spiral = this.scale.turns > 1;
    const sides = handOf(pointer.outline.length ? pointer : NEEDLE, RIM * this.scale.outer, order);
    const left = sides.map(([x, w]) => at([w, -x]));
    const right = sides.map(([x, w]) => at([-w, -x])).reverse();
    group.append(svg("path", { class: "needle", d: spiral ? "" : `M${[...left, ...right].join("L")}Z` }));
    if (spiral) group.append(svg("circle", { class: "follower", r: 3 }));
  }

  #place(mark, turns) {
    const [x, y] = place(this.scale.way * turns, this.#radius(turns), this.zero);
    mark.setAttribute("cx", x.toFixed(3));
    mark.setAttribute("cy", y.toFixed(3));
    mark.setAttribute("data-turns", turns.toFixed(12));
  }

  /** Adapts the length of a hand on a spiral to its current turn. */
  #slide(node, radius) {
    const tip = (2.6 - radius).toFixed(3);
    node.querySelector(".needle").setAttribute("d", `M-1.6 14L-1.1 ${tip}L1.1 ${tip}L1.6 14Z`);
    node.querySelector(".follower").setAttribute("cy", (-radius).toFixed(3));
  }

  /** Moves every hand to its current position. */
  set() {
    for (const { reading, node, sky } of this.hands) {
      const value = reading.now;
      if (sky) this.#place(sky, markOf(reading));
      node.classList.toggle("unknown", !value);
      if (!value) continue;
      const turn = (this.scale.way * value.degrees + (this.zero * 180) / Math.PI) % 360;
      node.setAttribute("transform", `rotate(${turn.toFixed(6)})`);
      node.setAttribute("data-turns", value.turns.toFixed(12)); // turns from the start of the scale
      if (this.scale.turns > 1) this.#slide(node, this.#radius(value.turns));
    }
  }
}
