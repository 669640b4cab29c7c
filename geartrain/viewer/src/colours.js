// Default colours.

import { FAULT, LINE, QUIET, SERIES } from "./series.js";

// the hands of one dial in order, as in palette.css
export const NEEDLES = SERIES;
export const BROKEN = FAULT;
export const HANDLE = SERIES[0];
export const CHOSEN = SERIES[6]; // distinct from the colours of high speeds
// metals and other materials
export const BRASS = ["#cfa652", "#d9b56b", "#c49848", "#d2ac62", "#c9a047", "#dcbb78"];
export const PARTS = { arbor: "#9aa1ab", arm: "#b07f52", plate: "#a98a55", case: "#755d38", pipe: "#b98f4e", pin: "#5b636f", slot: "#828a96", face: "#ece5d3", silver: "#dfe2e6", bezel: "#b08d4c", mark: "#2b261d" };

const mix = (one, other, share) =>
  `#${[1, 3, 5].map((at) => {
    const [a, b] = [one, other].map((hex) => parseInt(hex.slice(at, at + 2), 16));
    return Math.round(a + share * (b - a)).toString(16).padStart(2, "0");
  }).join("")}`;

const GREY = mix(LINE, QUIET, 0.5); // for wheels without a value
export const SECTION = mix(FAULT, LINE, 0.35); // of section faces
export const STATUS = { surviving: SERIES[3], reconstructed: SERIES[1], hypothetical: SERIES[2], "": GREY };

/** Colour of a speed: stronger for higher speeds, on a logarithmic scale over six decades; blue if positive, orange if negative. */
export function speedColour(speed, fastest) {
  if (!speed) return GREY;
  const share = 1 + Math.log10(Math.abs(speed) / fastest) / 6;
  return mix(LINE, SERIES[speed > 0 ? 0 : 1], Math.min(1, Math.max(0.15, share)));
}

/** Colour of a loss, relative to the maximum loss. */
export const lossColour = (loss, most) => (loss === null ? GREY : mix(LINE, FAULT, most ? loss / most : 0));

function speedColours({ bodies }) {
  const speeds = bodies.map((body) => (body.speed === null ? 0 : body.sense * ratio(body.speed)));
  const fastest = Math.max(...speeds.map(Math.abs), 1e-300);
  return speeds.map((speed) => speedColour(speed, fastest));
}

const OF_BRASS = [PARTS.arm, PARTS.plate, PARTS.case, PARTS.pipe, PARTS.bezel]; // colours that could be mistaken for values

/** Colours of the structural parts in a mode. */
export function partColours(scene, mode) {
  const bodies = mode === "speed" ? speedColours(scene) : null;
  return ({ colour, body }) => (mode === "plain" || !OF_BRASS.includes(colour) ? colour : (bodies?.[body] ?? GREY));
}

/** A colour by wheel in one of the modes. */
export function colours(scene, mode) {
  const bodies = speedColours(scene);
  const most = Math.max(...scene.wheels.map((wheel) => wheel.loss ?? 0), 0);
  const ways = {
    speed: (wheel) => bodies[wheel.body],
    status: (wheel) => STATUS[wheel.status] ?? STATUS[""],
    loss: (wheel) => lossColour(wheel.loss, most),
  };
  return scene.wheels.map(ways[mode] ?? ((wheel) => BRASS[wheel.body % BRASS.length]));
}

function ratio(text) {
  const [above, below = "1"] = text.split("/");
  return Number(above) / Number(below);
}
