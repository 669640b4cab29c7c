// Pin and slot: a wheel drives another about a parallel axis by a pin, which moves on a circle eccentric to that axis.

import { BRASS, PARTS } from "../colours.js";
import { Fraction } from "../fraction.js";
import { Law } from "../laws.js";
import { svg } from "../ui/element.js";
import { handle, round } from "./handle.js";
import { wheelPath } from "./outline.js";
import { Sheet, WIDE } from "./sheet.js";

const TURN = 2 * Math.PI;
const DEGREES = 360 / TURN;
const SCALE = 11;
const CENTRE = [WIDE / 2 - 6, 165];
const NOW = "now";

/** data   wheels of pin and slot, `pin_radius`, `offset` (mm) and the transmission error of the pair */
export function pin(host, { wheels, pin_radius: r, offset: e, transmission: table }) {
  const sheet = new Sheet(host, {
    height: 480,
    label: "A wheel whose pin engages the slot of another wheel",
    hint: "Drag the wheel, or use the arrow keys.",
  });
  const law = new Law(table);
  const view = sheet.plane([SCALE, SCALE], CENTRE);
  const parts = draw(view, wheels, r, e);
  const chart = sheet.chart([40, 352, WIDE - 60, 110], [0, 1], [-1.1 * Math.asin(e / r), 1.1 * Math.asin(e / r)]);
  chart.line([[0, 0], [1, 0]], { class: "gd-curve gd-mean" });
  chart.line(Array.from({ length: 241 }, (_, n) => [n / 240, law.at((TURN * n) / 240)[0]]), { class: "gd-curve gd-one" });
  sheet.write("angle by which the slot is ahead, over one turn of the pin", [WIDE / 2, 346]);
  const dot = svg("circle", { r: 6, class: "gd-dot" });
  sheet.picture.append(dot);
  let turned = Fraction.of("1/5");

  function show() {
    const mean = TURN * turned.part;
    const error = law.at(mean)[0];
    parts.turn(mean, error);
    const [x, y] = chart.to([turned.part, error]);
    dot.setAttribute("cx", x);
    dot.setAttribute("cy", y);
    const degrees = turned.times(360);
    sheet.tell(
      [
        ["pin, in degrees", `${degrees}`],
        ["slot, in degrees", (Number(degrees) + DEGREES * error).toFixed(6)],
        ["ahead by", (DEGREES * error).toFixed(6)],
        ["maximum", (DEGREES * Math.asin(e / r)).toFixed(6)],
      ],
      [NOW],
    );
    sheet.say("The pin moves uniformly about its own axis. About the slot's axis it moves on an epicycle: a small circle whose centre moves uniformly.");
  }

  handle(sheet, parts.driver, {
    plane: view,
    label: "Turn the wheel with the pin",
    value: () => turned,
    set: (turns) => ((turned = turns), show()),
    moved: round(() => [0, 0]),
    text: () => `${turned.times(360)} degrees`,
    key: 5,
  });
  show();
}

/** Draws both wheels; the axis of the pin's wheel is the origin, that of the slot is at a distance `e` to the right. */
function draw(view, [first, second], r, e) {
  const at = (tag, attributes) => svg(tag, attributes);
  const driver = svg("g", {}, svg("g", { style: `color: ${BRASS[1]}` }, wheelPath(first, first.shape)), at("circle", { cx: r, r: 0.55, class: "gd-boss", style: `color: ${PARTS.pin}` }));
  const slot = at("line", { x1: r - 1.9 * e, x2: r + 1.9 * e, class: "gd-slot" });
  const outline = svg("g", { class: "gd-ghost" }, wheelPath(second, second.shape));
  const slotted = svg("g", {}, outline, slot);
  const deferent = at("circle", { cx: e, r, class: "gd-circle" });
  const epicycle = at("circle", { r: e, class: "gd-circle gd-two" });
  const [even, small, seen, own] = ["gd-ray", "gd-ray gd-two", "gd-ray gd-one", "gd-ray"].map((name) => at("line", { class: name }));
  const axes = [0, e].map((cx) => at("circle", { cx, r: 0.32, class: "gd-boss", style: `color: ${PARTS.slot}` }));
  const over = svg("g", { class: "gd-over" }, deferent, epicycle, even, small, own, seen, axes);
  view.append(driver, svg("g", { class: "gd-over" }, slotted), over);
  const line = (node, [x1, y1], [x2, y2]) => Object.entries({ x1, y1, x2, y2 }).forEach(([key, value]) => node.setAttribute(key, value.toFixed(3)));
  return {
    driver,
    turn(mean, error) {
      const place = [r * Math.cos(mean), r * Math.sin(mean)];
      const carried = [place[0] + e, place[1]];
      driver.setAttribute("transform", `rotate(${DEGREES * mean})`);
      slotted.setAttribute("transform", `translate(${e} 0) rotate(${DEGREES * (mean + error)})`);
      epicycle.setAttribute("cx", carried[0].toFixed(3));
      epicycle.setAttribute("cy", carried[1].toFixed(3));
      line(even, [e, 0], carried);
      line(small, carried, place);
      line(own, [0, 0], place);
      line(seen, [e, 0], place);
    },
  };
}
