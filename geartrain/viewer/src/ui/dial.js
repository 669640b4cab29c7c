// One dial as a drawing: what is engraved, zero mark, hands. Clockwise on the page is clockwise as read.
import { NEEDLES } from "../colours.js";
import { engraved } from "../faces.js";
import { svg } from "./element.js";
import { skyOf } from "./sky.js";

const RIM = 90;
const PLAIN = { turns: 1, divisions: 12, inner: 1, outer: 1, way: 1 }; // of an output without a dial
const place = (turn, radius, zero) => {
  const angle = 2 * Math.PI * turn + zero;
  return [radius * Math.sin(angle), -radius * Math.cos(angle)];
};
const at = (point) => `${point[0].toFixed(2)} ${point[1].toFixed(2)}`;

const pathOf = (line) => `M${engraved(line).map(([x, y]) => at([RIM * x, -RIM * y])).join("L")}`;

/** Where the zero mark stands as one faces the dial: radians clockwise from the top. */
export function zeroOf(dial) {
  const [nx, , nz] = dial.normal;
  const right = [nz, 0, -nx]; // up x normal
  const size = Math.hypot(...right);
  if (size < 1e-6) return 0;
  const across = (dial.zero[0] * right[0] + dial.zero[2] * right[2]) / size;
  return Math.atan2(across, dial.zero[1]);
}

export class Dial {
  /** `dial` as in the scene, or null for a plain face; `hands` the readings that stand on it. */
  constructor(name, dial, hands) {
    this.scale = dial?.scale ?? PLAIN;
    this.engraving = dial?.engraving ?? [];
    this.zero = dial ? zeroOf(dial) : 0;
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
    const { inner, outer, turns: all } = this.scale;
    return RIM * (inner + ((outer - inner) * turns) / all);
  }

  /** What is engraved, as the scene has it; of a plain face, a rim and twelve marks. */
  #scale() {
    const turned = { transform: `rotate(${((this.zero * 180) / Math.PI).toFixed(6)})` };
    const drawn = this.engraving.map(([kind, width, lines]) => svg("path", { class: kind, "stroke-width": (width * RIM).toFixed(3), d: lines.map(pathOf).join("") }));
    const marks = Array.from({ length: 12 }, (_, k) => `M${at(place(k / 12, RIM, 0))}L${at(place(k / 12, RIM - 4, 0))}`).join("");
    const plain = [svg("circle", { class: "rim", r: RIM }), svg("path", { class: "fine", d: marks })];
    const sides = [-0.011, 0.011].map((turn) => at(place(turn, RIM + 8, 0)));
    const zero = svg("path", { class: "zero", d: `M${sides[0]}L${sides[1]}L${at(place(0, RIM + 1.5, 0))}Z` });
    return [svg("g", turned, ...(drawn.length ? drawn : plain), zero)];
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
    const reach = RIM * this.scale.outer - 2 - (this.scale.turns === 1 ? (order % 4) * 6 : 0);
    group.append(
      svg("path", {
        class: "needle",
        d: `M-1.5 ${tail}L-1.1 ${-reach + 8}L0 ${-reach}L1.1 ${-reach + 8}L1.5 ${tail}Z`,
      }),
    );
    if (this.scale.turns > 1) group.append(svg("circle", { class: "follower", r: 3.4 }));
  }

  #place(mark, turns) {
    const [x, y] = place(this.scale.way * turns, this.#radius(turns), this.zero);
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
      const turn = (this.scale.way * value.degrees + (this.zero * 180) / Math.PI) % 360;
      node.setAttribute("transform", `rotate(${turn.toFixed(6)})`);
      node.setAttribute("data-turns", value.turns.toFixed(12)); // from the start of the scale
      node.querySelector(".follower")?.setAttribute("cy", (-this.#radius(value.turns)).toFixed(3));
    }
  }
}
