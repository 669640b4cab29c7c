// Self-locking: the user drags the basic efficiency of a set; the power transmitted in both directions is shown.

import { Fraction } from "../fraction.js";
import { svg } from "../ui/element.js";
import { decimal } from "../ui/number.js";
import { handle } from "./handle.js";
import { Sheet, WIDE } from "./sheet.js";

const FIELD = [46, 150, WIDE - 70, 210];
const BARS = { left: 46, wide: WIDE - 70, high: 24, top: 32, apart: 58 };
const NAME = "efficiency";
const COLOURS = ["gd-one", "gd-two"];

/** data   `basic`: efficiencies of each pair; `ways`: transmitted fraction in each direction, null if it locks */
export function locking(host, { basic, ratio, ways }) {
  const sheet = new Sheet(host, {
    height: 420,
    label: "Transmitted power as a function of the efficiency of each mesh",
    hint: "Drag the vertical line to change the efficiency, or use the arrow keys.",
  });
  const values = basic.map((text) => Fraction.of(text));
  const [least, most] = [values[0], values.at(-1)].map(Number);
  const parts = Math.round((values.length - 1) / (most - least));
  const chart = sheet.chart(FIELD, [least, most], [0, 1]);
  Object.values(ways).forEach((found, n) => {
    chart.line(found.flatMap((each, at) => (each === null ? [] : [[Number(values[at]), each]])), { class: `gd-curve ${COLOURS[n]}` });
  });
  const [, bottom] = chart.to([least, 0]);
  for (const at of [least, (least + most) / 2, most]) sheet.write(String(at), [chart.to([at, 0])[0], bottom + 20]);
  for (const at of [0, 1]) sheet.write(String(at), [FIELD[0] - 14, chart.to([least, at])[1] + 5]);
  sheet.write("efficiency of each mesh", [WIDE / 2, bottom + 44]);
  const bars = Object.keys(ways).map((way, n) => bar(sheet, way, n));
  const grip = svg("g", {}, svg("rect", { x: -18, y: FIELD[1] - 6, width: 36, height: FIELD[3] + 12, class: "gd-reach-fill" }), svg("line", { y1: FIELD[1], y2: bottom, class: "gd-cursor" }), svg("circle", { cy: bottom, r: 9, class: "gd-dot" }));
  const dots = Object.keys(ways).map((_, n) => svg("circle", { r: 6, class: `gd-point ${COLOURS[n]}` }));
  sheet.picture.append(grip, ...dots);
  let at = Math.round(values.length * 0.93);

  function show() {
    const [x] = chart.to([Number(values[at]), 0]);
    grip.setAttribute("transform", `translate(${x.toFixed(2)} 0)`);
    const found = Object.entries(ways).map(([way, each]) => [way, each[at]]);
    found.forEach(([, share], n) => {
      bars[n](share);
      dots[n].setAttribute("cx", x.toFixed(2));
      dots[n].setAttribute("cy", chart.to([0, share ?? 0])[1].toFixed(2));
    });
    const rows = found.map(([way, share]) => [way, share === null ? "locks" : share.toFixed(6)]);
    const whole = values[at].times(values[at]);
    const limit = Fraction.of(1).over(ratio);
    sheet.tell([["each mesh", decimal(values[at])], ["e, of both", decimal(whole, 6)], ["limit, 1/i\u2080", `${limit} = ${decimal(limit, 6)}`], ...rows], [NAME]);
    const locked = found.filter(([, share]) => share === null).map(([way]) => way);
    sheet.say(
      locked.length
        ? `Self-locking where ${locked.join(" and ")}: no torque can turn the set in this direction.`
        : "The set turns in both directions.",
    );
  }

  handle(sheet, grip, {
    plane: sheet.picture,
    label: "Efficiency of each mesh",
    value: () => values[at],
    set: (wanted) => ((at = Math.round((Number(wanted) - least) * parts)), show()),
    moved: ([x], [u]) => ((u - x) / FIELD[2]) * (most - least),
    text: () => decimal(values[at]),
    parts,
    page: Math.round(parts / 100),
    least,
    most,
  });
  show();
}

/** A bar of the input power: the transmitted part and the loss. */
function bar(sheet, way, n) {
  const y = BARS.top + n * BARS.apart;
  const words = sheet.write("", [BARS.left, y - 8], { "text-anchor": "start" });
  const lost = svg("rect", { x: BARS.left, y, width: BARS.wide, height: BARS.high, class: "gd-lost" });
  const kept = svg("rect", { x: BARS.left, y, height: BARS.high, class: `gd-kept ${COLOURS[n]}` });
  sheet.picture.append(lost, kept);
  return (share) => {
    kept.setAttribute("width", (BARS.wide * (share ?? 0)).toFixed(2));
    words.textContent = share === null ? `${way}: self-locking` : `${way}: ${(100 * share).toFixed(1)} % transmitted`;
  };
}
