// Stills: a stage drawn as a picture that can be saved.

import { svg } from "./ui/element.js";

/** A canvas with the pictures of the displayed stages side by side, in the size on the screen. */
export function copyOf(stages) {
  const canvases = stages.map((stage) => stage.canvas);
  const sheet = document.createElement("canvas");
  sheet.width = canvases.reduce((sum, { width }) => sum + width, 0);
  sheet.height = Math.max(...canvases.map(({ height }) => height));
  const pen = sheet.getContext("2d");
  let left = 0;
  stages.forEach((stage, n) => {
    stage.render();
    pen.drawImage(canvases[n], left, 0);
    left += canvases[n].width;
  });
  return sheet;
}

/** The same: a promise of a PNG. */
export const pictureOf = (stages) => new Promise((done) => copyOf(stages).toBlob(done, "image/png"));

const WORN = ["fill", "fill-opacity", "fill-rule", "stroke", "stroke-width", "stroke-linejoin", "vector-effect", "opacity", "display", "text-anchor", "font-family"];

/** One SVG without a style sheet of the plans side by side, in the size on the screen. */
export function drawingOf(plans) {
  let [right, lowest] = [0, 0];
  const copies = plans.map(({ canvas }) => {
    const copy = canvas.cloneNode(true);
    const own = [canvas, ...canvas.querySelectorAll("*")];
    [copy, ...copy.querySelectorAll("*")].forEach((node, n) => {
      const style = getComputedStyle(own[n]);
      for (const name of WORN) node.style.setProperty(name, style.getPropertyValue(name));
    });
    const { width, height } = canvas.getBoundingClientRect();
    for (const [name, value] of Object.entries({ x: right, y: 0, width, height })) copy.setAttribute(name, value);
    [right, lowest] = [right + width, Math.max(lowest, height)];
    return copy;
  });
  const paper = getComputedStyle(plans[0].canvas.parentElement).backgroundColor;
  const sheet = svg("svg", { width: right, height: lowest }, svg("rect", { width: "100%", height: "100%", fill: paper }), ...copies);
  return new Blob([new XMLSerializer().serializeToString(sheet)], { type: "image/svg+xml" });
}
