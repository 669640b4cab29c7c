// Dials of outputs, their pointers turned by exact speeds as the crank turns.
import { html, svg } from "./svg.js";

const TICKS = 12;

export function drawDials(place, state, clockwise) {
  const hands = [];
  place.replaceChildren(...state.dials.map((dial) => drawDial(dial, hands)));
  return (turns) => {
    for (const { hand, rate } of hands) {
      // an angle counts against the clock, and SVG turns with it
      const angle = (clockwise ? 360 : -360) * ((turns * rate) % 1);
      hand.setAttribute("transform", `rotate(${angle})`);
    }
  };
}

function drawDial(dial, hands) {
  const hand = svg("path", { class: "hand", d: "M-2.5 8 L0 -40 L2.5 8 Z" });
  hands.push({ hand, rate: dial.turns });
  const ticks = Array.from({ length: TICKS }, (_, at) =>
    svg("line", { x1: 0, y1: -46, x2: 0, y2: -41, transform: `rotate(${(360 / TICKS) * at})` }),
  );
  const face = svg(
    "svg",
    { viewBox: "-50 -50 100 100", role: "img", "aria-label": `dial of ${dial.name}` },
    svg("circle", { class: "face", r: 47 }),
    ...ticks,
    hand,
    svg("circle", { class: "boss", r: 3.5 }),
  );
  const mark = dial.holds === false ? html("span", { class: "bad" }, " fails") : "";
  const targets = dial.targets.map((each) => html("div", { class: "target" }, each));
  const speed = html("code", { title: dial.exact }, dial.exact.length > 18 ? `${dial.exact.slice(0, 17)}…` : dial.exact);
  return html("figure", { class: "dial" }, face, html("figcaption", {}, html("b", {}, dial.name), html("div", {}, speed, mark), ...targets));
}
