// Appearance of the parts of a train: colours, highlights, hidden parts.

import { Color } from "three";

import { BROKEN, CHOSEN, colours, partColours } from "./colours.js";
import { vector } from "./space.js";

const GHOST = 0.14; // opacity of what is not highlighted
const GLASS = 0.07; // of a plate or a pillar before the wheels
const HIDDEN = 0.05; // of the wheels, behind a plate that then is of glass
const GLOSS = 0.75;

export class Looks {
  /** wheels   `WheelPart`s; `parts`, all else: {slot, body, at, dial, plate, cover, pane, bar} */
  constructor(scene, palette, wheels, parts, sight) {
    Object.assign(this, { scene, palette, wheels, parts, sight });
    this.chosen = null;
    this.selected = null;
    this.toothed = false;
    this.front = null;
    this.broken = this.wheelsOf({ pairs: scene.pairs.flatMap(({ broken }, at) => (broken ? [at] : [])) });
  }

  /** data.wheels   a colour by wheel; else those of the mode */
  paint(mode, data) {
    this.mode = mode;
    this.base = data?.wheels ?? colours(this.scene, mode);
    this.part = partColours(this.scene, mode);
    this.recolour();
  }

  highlight(chosen, colour) {
    this.chosen = chosen && { wheels: this.wheelsOf(chosen), colour: colour ?? CHOSEN };
    this.recolour();
  }

  select(wheel) {
    this.selected = wheel;
    this.recolour();
  }

  wheelsOf({ wheels = [], bodies = [], pairs = [] }) {
    const named = (each) => (typeof each === "number" ? this.scene.pairs[each] : this.scene.pairs.find(({ id }) => id === each));
    const found = new Set([...wheels, ...pairs.flatMap((pair) => named(pair)?.wheels ?? [])]);
    this.scene.wheels.forEach(({ body }, index) => bodies.includes(body) && found.add(index));
    return found;
  }

  recolour() {
    const { chosen } = this;
    this.wheels.forEach((part, index) => {
      const [lit, broken, selected] = [chosen?.wheels.has(index), this.broken.has(index), index === this.selected];
      const colour = new Color(broken ? BROKEN : this.base[index]);
      if (lit) colour.lerp(new Color(chosen.colour), 0.8);
      if (selected) colour.set(CHOSEN);
      const plain = this.mode !== "plain" || broken || lit || selected; // what a colour says is not lost in a glint
      part.paint({ colour, gloss: plain ? 0.35 : GLOSS, opacity: chosen && !lit && !selected ? GHOST : 1 });
    });
    const bodies = new Set([...(chosen?.wheels ?? [])].map((index) => this.scene.wheels[index].body));
    const kept = ({ body, plate }) => !chosen || (bodies.has(body) && !plate);
    for (const part of this.parts) {
      const opacity = kept(part) ? (this.isGlass(part) ? GLASS : 1) : GHOST;
      this.palette.paint(part.slot, { opacity, ...(part.colour && this.part && { colour: new Color(this.part(part)) }) });
    }
  }

  /** Covers on the camera's side are of glass, and plates and pillars of the frame behind which wheels stand. */
  glaze(eye, middle) {
    if (this.eye?.equals(eye)) return;
    this.eye = eye.clone();
    const towards = eye.clone().sub(middle);
    const before = ({ cover, at, pane }) => (pane ? this.sight.hidden(pane, eye) > HIDDEN : towards.dot(cover) * at.clone().sub(middle).dot(cover) > 0);
    const glass = this.parts.filter((part) => (part.cover && before(part)) || (part.bar && this.sight.isCovering(part.bar, eye)));
    if (this.glass?.length === glass.length && glass.every((part, n) => part === this.glass[n])) return;
    this.glass = glass;
    this.recolour();
  }

  isGlass(part) {
    return Boolean(this.glass?.includes(part));
  }

  /** What stands before the middle, as seen along `front`, is out of the way: dials, then wheels; null: nothing is. */
  hideBefore(front) {
    this.front = front;
    const heights = this.scene.wheels.map(({ centre }) => (front ? vector(centre).dot(front) : 0));
    const [low, high] = [Math.min(...heights), Math.max(...heights)];
    const before = ({ at }) => front !== null && at !== null && at.dot(front) > (low + high) / 2 + 1e-9;
    const level = high - low < 1e-6; // all in one layer: only dials go
    this.wheels.forEach((part) => part.show(level || !before(part), this.toothed));
    for (const part of this.parts) if (part.dial !== undefined || part.cover) this.palette.paint(part.slot, { shown: !before(part) });
  }

  showTeeth(toothed) {
    this.toothed = toothed;
    this.hideBefore(this.front);
  }
}
