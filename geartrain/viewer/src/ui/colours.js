// The legend of the colours of the wheels.
import { STATUS, lossColour, speedColour } from "../colours.js";
import { el } from "./element.js";

export const MODES = { plain: "Brass", speed: "Speed", status: "Status", loss: "Loss" };

function patch(kind, background, words) {
  const node = el("span", { class: kind, "aria-hidden": "true" });
  node.style.background = background; // an attribute would be refused by the page's policy
  return el("li", {}, node, words);
}
const swatch = (colour, words) => patch("swatch", colour, words);
const ramp = (from, to, words) => patch("swatch ramp", `linear-gradient(90deg, ${from}, ${to})`, words);

function speedLegend(scene) {
  const senses = ["clockwise", "counter-clockwise"];
  const [positive, negative] = scene.positive === "clockwise" ? senses : senses.reverse();
  const faster = (sense) => [speedColour(sense * 1e-6, 1), speedColour(sense, 1)];
  return [
    ramp(...faster(1), `${positive}, slow to fast`),
    ramp(...faster(-1), `${negative}, slow to fast`),
    swatch(speedColour(0, 1), "at rest"),
  ];
}

function statusLegend(scene) {
  const count = (status) =>
    scene.wheels.filter((wheel) => (wheel.status in STATUS ? wheel.status : "") === status).length;
  return Object.entries(STATUS)
    .filter(([status]) => count(status))
    .map(([status, colour]) => swatch(colour, `${status || "not stated"} (${count(status)})`));
}

function lossLegend(scene) {
  if (!scene.wheels.some((wheel) => typeof wheel.loss === "number"))
    return [el("li", {}, "No losses, because the train declares no loads or friction.")];
  const most = Math.max(...scene.wheels.map((wheel) => wheel.loss ?? 0));
  const words = `power loss at the meshes: 0 to ${(most * 100).toPrecision(2)} % of the input power`;
  return [ramp(lossColour(0, 1), lossColour(1, 1), words)];
}

/** What the colours mean, as a list; empty where they mean nothing. */
export function legend(scene, mode) {
  const rows = { speed: speedLegend, status: statusLegend, loss: lossLegend }[mode]?.(scene) ?? [];
  return el("ul", { class: "legend", "aria-label": "legend", hidden: !rows.length }, rows);
}
