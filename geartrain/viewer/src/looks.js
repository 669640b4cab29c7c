// Appearance of the parts of a train: colours, highlights, and hidden parts.

import { Color } from "three";

import { BROKEN, CHOSEN, colours, partColours } from "./colours.js";
import { vector } from "./space.js";

const GHOST = 0.26; // opacity of parts that are not highlighted
const GLASS = 0.1; // opacity of a plate or a pillar in front of the wheels
const HIDDEN = 0.05; // fraction of the wheels hidden by a plate, above which the plate is transparent
const GLOSS = 0.75;

export class Looks {
  /** wheels   `WheelPart`s; `parts`, all other parts: {slot, body, at, dial, plate, cover, pane, bar} */
  constructor(scene, palette, wheels, parts, sight) {
    Object.assign(this, { scene, palette, wheels, parts, sight });
    this.chosen = null;
    this.selected = null;
    this.toothed = false;
    this.front = null;
    this.broken = this.wheelsOf({ pairs: scene.pairs.flatMap(({ broken }, at) => (broken ? [at] : [])) });
  }

  /** data.wheels   a colour for each wheel; by default the colours of the mode */
  paint(mode, data) {
    this.mode = mode;
    this.base = data?.wheels ?? colours(this.scene, mode);
    this.part = partColours(this.scene, mode);
    this.recolour();
  }

  highlight(chosen, colour) {
    this.chosen = chosen && { wheels: this.wheelsOf(chosen), bodies: chosen.bodies ?? [], colour: colour ?? CHOSEN };
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
      const plain = this.mode !== "plain" || broken || lit || selected; // reflections must not hide a colour that has a meaning
      part.paint({ colour, gloss: plain ? 0.35 : GLOSS, opacity: chosen && !lit && !selected ? GHOST : 1 });
    });
    const bodies = new Set([...[...(chosen?.wheels ?? [])].map((index) => this.scene.wheels[index].body), ...(chosen?.bodies ?? [])]);
    const kept = ({ body, plate }) => !chosen || (bodies.has(body) && !plate);
    for (const part of this.parts) {
      const opacity = kept(part) ? (this.isGlass(part) ? GLASS : 1) : GHOST;
      this.palette.paint(part.slot, { opacity, ...(part.colour && this.part && { colour: new Color(this.part(part)) }) });
    }
  }

  /** Makes covers on the camera's side transparent, and plates and pillars of the frame that hide wheels. */
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

  /** Hides parts in front of the middle, seen along `front`: dials, then wheels; with null, nothing is hidden. */
  hideBefore(front) {
    this.front = front;
    const heights = this.scene.wheels.map(({ centre }) => (front ? vector(centre).dot(front) : 0));
    const [low, high] = [Math.min(...heights), Math.max(...heights)];
    const before = ({ at }) => front !== null && at !== null && at.dot(front) > (low + high) / 2 + 1e-9;
    const level = high - low < 1e-6; // all wheels in one layer: only dials are hidden
    this.wheels.forEach((part) => part.show(level || !before(part), this.toothed));
    for (const part of this.parts) if (part.dial !== undefined || part.cover) this.palette.paint(part.slot, { shown: !before(part) });
  }

  showTeeth(toothed) {
    this.toothed = toothed;
    this.hideBefore(this.front);
  }
}
