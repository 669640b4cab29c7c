// Stills: a stage drawn at once, as a picture that can be kept.

import { vector } from "./space.js";
import { svg } from "./ui/element.js";

const VIEWS = 24; // of a turning camera, from all of which the whole must be seen

/** For films: one stage that fills the window and is drawn only when a picture of it is asked for. */
export class Film {
  constructor(app) {
    this.app = app;
    document.body.classList.add("film");
  }

  /** Shows another scene of the page. */
  open(index) {
    if (this.stage) {
      this.stage.canvas.remove();
      this.app.close(this.index);
    }
    this.index = index;
    this.stage = this.app.open(index);
    this.stage.cut?.();
    document.body.prepend(this.stage.canvas);
    this.stage.resize?.();
  }

  /** look, background, apart and cutaway as the page has them, null as it is; with `turntable` the camera stands far enough off for a turn; words: a large line and a small one, or null. */
  set({ look, background, apart, cutaway, turntable, words }) {
    const { stage } = this;
    this.words = words;
    stage.theme({ background: plain(background) });
    stage.explode(apart);
    if (typeof cutaway === "boolean") stage.cutOpen(cutaway);
    stage.look(look);
    this.home = here(stage);
    if (turntable) this.home = allRound(stage, this.home);
  }

  /** A PNG as a data URL. turns: of the lead, exact; orbit: turns of the camera */
  still(turns, orbit = 0) {
    const { stage, home } = this;
    stage.setTurns(turns);
    stage.controls.target.copy(home.target);
    stage.camera.position.copy(home.target).addScaledVector(turned(home.towards, orbit), home.distance);
    stage.controls.update();
    stage.render();
    const picture = this.words ? worded(stage.canvas, this.words) : stage.canvas;
    return picture.toDataURL("image/png"); // in the same task: the next one finds the canvas empty
  }
}

/** A picture with words in its upper left corner, with a halo that keeps them readable on any ground. */
function worded(picture, [large, small]) {
  const sheet = Object.assign(document.createElement("canvas"), { width: picture.width, height: picture.height });
  const pen = sheet.getContext("2d");
  pen.drawImage(picture, 0, 0);
  const unit = Math.min(picture.height / 16, picture.width / 20);
  Object.assign(pen, { textBaseline: "top", lineJoin: "round", strokeStyle: "#fbfaf6", fillStyle: "#211e18", lineWidth: 0.2 * unit });
  const line = (text, size, weight, top) => {
    pen.font = `${weight} ${size}px system-ui, sans-serif`;
    pen.strokeText(text, 0.5 * unit, top, sheet.width - unit);
    pen.fillText(text, 0.5 * unit, top, sheet.width - unit);
  };
  line(large, unit, 600, 0.5 * unit);
  line(small, 0.62 * unit, 400, 1.7 * unit);
  return sheet;
}

/** A colour as three.js reads it, of all that CSS can say. */
function plain(colour) {
  const pen = document.createElement("canvas").getContext("2d");
  pen.fillStyle = colour;
  return pen.fillStyle;
}

/** Where the camera of a stage stands. */
function here({ camera, controls }) {
  const towards = camera.position.clone().sub(controls.target);
  const distance = towards.length();
  return { target: controls.target.clone(), towards: towards.normalize(), distance };
}

/** A direction, turned about the vertical. */
function turned(towards, orbit) {
  return orbit ? towards.clone().applyAxisAngle(vector([0, 1, 0]), 2 * Math.PI * orbit) : towards;
}

/** One point to look at, and a distance, from which all is seen at every turn of the camera. */
function allRound(stage, { towards }) {
  const views = Array.from({ length: VIEWS }, (_, n) => {
    stage.fit(turned(towards, n / VIEWS));
    return here(stage);
  });
  const target = views.reduce((sum, view) => sum.add(view.target), vector([0, 0, 0])).divideScalar(VIEWS);
  const distance = Math.max(...views.map((view) => view.distance + view.target.distanceTo(target)));
  return { target, towards, distance };
}

/** The stages shown, beside each other in one picture as large as they are on the screen: a promise of a PNG. */
export function pictureOf(stages) {
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
  return new Promise((done) => sheet.toBlob(done, "image/png"));
}

const WORN = ["fill", "fill-opacity", "fill-rule", "stroke", "stroke-width", "stroke-linejoin", "vector-effect", "opacity", "display", "text-anchor", "font-family"];

/** Plans beside each other as one SVG that needs no style sheet, as large as they are on the screen. */
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
