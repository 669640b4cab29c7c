// A pair of triangular teeth: the user drags the driver; the apex on the flank and the instantaneous ratio are shown.

import { BRASS } from "../colours.js";
import { Fraction } from "../fraction.js";
import { Law } from "../laws.js";
import { svg } from "../ui/element.js";
import { handle, round } from "./handle.js";
import { Sheet, WIDE } from "./sheet.js";

const TURN = 2 * Math.PI;
const DEGREES = 180 / Math.PI;
const PANE = 320;
const PITCHES = 3.4; // height of the pane, in pitches
const TELLS = "now";
const TOUCHES = {
  approach: "Approach: the driven tooth's apex lies on the driver's flank.",
  recess: "Recess: the driver's apex lies on the driven tooth's flank.",
};

/** data   `pairs`: sizes, transmission function, and contact points at positions within a pitch of the driver */
export function teeth(host, { pairs }) {
  const sheet = new Sheet(host, {
    height: 470,
    label: "Triangular teeth of two wheels in contact",
    hint: "Drag the driver (left) downwards, or use the arrow keys.",
  });
  const pane = sheet.pane([0, 0, WIDE, PANE]);
  const below = svg("g");
  sheet.picture.append(below);
  const state = { passed: Fraction.of("1/12") }; // position of the driver in pitches
  let pair = null;

  function open(name) {
    pair = new Pair(pairs[name], pane, sheet, below);
    pair.grip(sheet, state, show);
    show();
  }

  function show() {
    const { ratio, error, moment } = pair.at(state.passed);
    pair.turn(moment, state.passed, ratio);
    sheet.tell(
      [
        ["driver, in pitches", `${state.passed}`],
        ["speed ratio", ratio.toFixed(6)],
        ["mean ratio", pair.given.ratio],
        ["driven ahead by", `${(DEGREES * error).toFixed(5)}\u00b0`],
      ],
      [TELLS],
    );
    sheet.say(TOUCHES[moment.at(-1)] ?? "No teeth are in contact: the driven wheel is at rest.");
  }

  sheet.choice("Teeth", Object.entries(pairs).map(([name, { title }]) => [name, title]), open);
  open(Object.keys(pairs)[0]);
}

class Pair {
  constructor(given, pane, sheet, below) {
    this.given = given;
    this.law = new Law(given.law);
    this.mean = Number(Fraction.of(given.ratio));
    pane.replaceChildren();
    below.replaceChildren();
    const [z1, z2] = given.teeth;
    const pitchPoint = (given.distance * z1) / (z1 + z2);
    const scale = PANE / (PITCHES * TURN * (pitchPoint / z1));
    this.plane = sheet.plane([scale, scale], [WIDE / 2 - scale * pitchPoint, PANE / 2], pane);
    this.driver = wheel(given, 0);
    this.driven = wheel(given, 1);
    this.wheels = [svg("g", {}, this.driver), svg("g", { transform: `translate(${given.distance} 0) scale(-1 1)` }, this.driven)];
    this.normal = svg("line", { class: "gd-normal" });
    this.contact = svg("circle", { r: 4 / scale, class: "gd-dot" });
    const line = svg("line", { x1: 0, x2: given.distance, class: "gd-centres" });
    this.plane.append(...this.wheels, svg("g", { class: "gd-over" }, line, this.normal, this.contact));
    this.curve(sheet, below);
  }

  /** Draws the ratio over one pitch below the wheels. */
  curve(sheet, below) {
    const points = Array.from({ length: 481 }, (_, n) => [n / 480, this.ratio(((n % 480) / 480) * this.law.period)]);
    const ratios = points.map(([, ratio]) => ratio);
    const [low, high] = [Math.min(...ratios), Math.max(...ratios)];
    const before = sheet.picture.childElementCount;
    const chart = sheet.chart([30, PANE + 34, WIDE - 50, 80], [0, 1], [low - 0.1 * (high - low), high + 0.1 * (high - low)]);
    chart.line(points, { class: "gd-curve gd-one" });
    chart.line([[0, this.mean], [1, this.mean]], { class: "gd-curve gd-mean" });
    sheet.write("speed ratio over a pitch; dashed, its mean", [WIDE / 2, PANE + 24]);
    this.dot = svg("circle", { r: 6, class: "gd-dot" });
    below.append(...[...sheet.picture.children].slice(before), this.dot);
    this.chart = chart;
  }

  ratio(angle) {
    return this.mean + this.law.at(angle)[1];
  }

  /** State after a number of pitches of the driver. */
  at(passed) {
    const angle = this.law.period * passed.part;
    const count = this.given.moments.length;
    return { ratio: this.ratio(angle), error: this.law.at(angle)[0], moment: this.given.moments[Math.round(passed.part * count) % count] };
  }

  turn([alpha1, alpha2, x, y, centre, phase], passed, ratio) {
    this.driver.setAttribute("transform", `rotate(${DEGREES * alpha1})`);
    this.driven.setAttribute("transform", `rotate(${DEGREES * alpha2})`);
    const touches = phase in TOUCHES;
    for (const part of [this.normal, this.contact]) part.classList.toggle("gd-hidden", !touches);
    const [dx, dy] = [centre - x, -y];
    for (const [key, value] of Object.entries({ x1: x - 0.6 * dx, y1: y - 0.6 * dy, x2: x + 1.6 * dx, y2: y + 1.6 * dy })) this.normal.setAttribute(key, value);
    this.contact.setAttribute("cx", x);
    this.contact.setAttribute("cy", y);
    const [left, top] = this.chart.to([passed.part, ratio]);
    this.dot.setAttribute("cx", left);
    this.dot.setAttribute("cy", top);
  }

  grip(sheet, state, show) {
    const [z1] = this.given.teeth;
    const turns = round(() => [0, 0]);
    sheet.handles.length = 0; // handles of the previous pair
    handle(sheet, this.wheels[0], {
      plane: this.plane,
      label: "Turn the driver",
      value: () => state.passed,
      set: (passed) => ((state.passed = passed), show()),
      moved: (from, to) => -z1 * turns(from, to), // forward is downwards
      text: () => `${state.passed} pitches`,
      parts: this.given.moments.length,
    });
  }
}

/** A wheel about the origin, an apex in the direction of x. */
function wheel({ teeth: counts, tips, depths }, which) {
  const [count, tip, depth] = [counts[which], tips[which], depths[which]];
  const corners = Array.from({ length: 2 * count }, (_, n) => {
    const [radius, angle] = [n % 2 ? tip - depth : tip, (Math.PI * n) / count];
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
  return svg("path", { d: fine(corners), class: "gd-wheel", style: `color: ${BRASS[which ? 2 : 1]}` });
}

const fine = (corners) => `M${corners.map(([x, y]) => `${x.toFixed(6)} ${y.toFixed(6)}`).join("L")}Z`;
