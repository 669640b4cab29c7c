// Phase closure: the user drags a second planet, which meshes with the ring only where its teeth meet gaps.

import { BRASS } from "../colours.js";
import { Fraction } from "../fraction.js";
import { svg } from "../ui/element.js";
import { shown } from "../ui/number.js";
import { handle, round } from "./handle.js";
import { rimOf, wheelPath } from "./outline.js";
import { Sheet, WIDE } from "./sheet.js";

const PLACE = "at (turn)";
const OFF = "off by (pitch)";
const STEPS = 10; // steps of a handle between two assembly positions of a planet
const MOST = 6; // planets

/** data   `planet`, its teeth; `sets` by the teeth of the sun: wheels, and the planet's turns for one of the arm, sun or ring held */
export function closure(host, { planet: count, sets }) {
  const sheet = new Sheet(host, {
    height: WIDE,
    label: "Planets between a sun and a ring",
    hint: "Drag the second planet around the sun, or use the arrow keys. Blue fits, red does not.",
  });
  const scale = WIDE / 2 / (1.02 * Math.max(...Object.values(sets).map(({ wheels }) => rimOf(wheels.r))));
  const view = sheet.plane([scale, scale], [WIDE / 2, WIDE / 2]);
  const fixed = svg("g");
  const planets = Array.from({ length: MOST }, () => svg("g"));
  view.append(fixed, ...planets);
  const state = { sun: Object.keys(sets)[2], apart: Fraction.of("1/5"), planets: 5 };

  /** Number of assembly positions of a planet in one turn. */
  const places = () => Fraction.of(sets[state.sun].rolled.sun).minus(sets[state.sun].rolled.ring).times(count);
  const off = (turns) => {
    const pitches = places().times(turns);
    const rest = pitches.minus(new Fraction(pitches.floor));
    return 2 * Number(rest) > 1 ? rest.minus(1) : rest;
  };

  function open(sun) {
    state.sun = sun;
    const { s, r, p0 } = sets[sun].wheels;
    fixed.replaceChildren(...[s, r].map((wheel, n) => svg("g", { style: `color: ${BRASS[n + 1]}` }, wheelPath(wheel, wheel.shape))));
    for (const planet of planets) planet.replaceChildren(wheelPath(p0, p0.shape), svg("circle", { r: p0.root, class: "gd-reach-fill" }));
    show();
  }

  function show() {
    const { wheels, rolled } = sets[state.sun];
    const rows = [];
    planets.forEach((node, n) => {
      node.classList.toggle("gd-hidden", n >= state.planets);
      if (n >= state.planets) return;
      const turns = state.apart.times(n);
      const miss = off(turns);
      const angle = 2 * Math.PI * Number(turns);
      const [x, y] = [Math.cos(angle), Math.sin(angle)].map((part) => part * wheels.p0.centre[0]);
      node.setAttribute("transform", `translate(${x.toFixed(4)} ${y.toFixed(4)}) rotate(${(360 * Fraction.of(rolled.sun).times(turns).part).toFixed(4)})`);
      node.setAttribute("class", miss.equals(0) ? "gd-fits" : "gd-misses");
      if (n === 1) node.classList.add("gd-handle");
      rows.push([`planet ${n + 1}`, `${turns}`, `${miss}`]);
    });
    sheet.tell(rows, [PLACE, OFF]);
    sheet.say(`A sun of ${state.sun} and a ring of ${wheels.r.teeth} teeth: planets can be assembled at multiples of 1/${shown(places())} turn.`);
  }

  handle(sheet, planets[1], {
    plane: view,
    label: "Move the second planet",
    value: () => state.apart,
    set(apart) {
      Object.assign(state, { apart, planets: 2 });
      show();
    },
    moved: round(() => [0, 0]),
    text: () => `at ${state.apart} turn, off by ${off(state.apart)} pitch`,
    get parts() {
      return STEPS * Number(places());
    },
    page: STEPS,
    ...ends(sets),
  });
  sheet.choice("Teeth of the sun", Object.keys(sets).map((sun) => [sun, sun]), open, state.sun);
  const numbers = Array.from({ length: MOST - 1 }, (_, n) => [n + 2, n + 2]);
  const spaced = (value) => {
    Object.assign(state, { planets: Number(value), apart: new Fraction(1n, BigInt(value)) });
    show();
  };
  sheet.choice("Equally spaced", numbers, spaced, state.planets);
  open(state.sun);
}

/** Range of positions in which the second planet is clear of the first, for all suns. */
function ends(sets) {
  const least = Math.max(...Object.values(sets).map(({ wheels: { p0 } }) => Math.asin(p0.tip / p0.centre[0]) / Math.PI));
  return { least, most: 1 - least };
}
