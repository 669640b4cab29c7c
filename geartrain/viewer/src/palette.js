// Palette of the materials: one slot for each part whose appearance can change.

import { Color, DataTexture, NearestFilter, RGBAFormat, UnsignedByteType } from "three";

const WIDTH = 256; // texels, two for each slot

export class Palette {
  constructor() {
    this.looks = [];
  }

  /** Adds a slot. colour: text; gloss: 0 (matt) to 1 (polished); opened: true for parts that are cut open */
  slot(colour, gloss, opened = false) {
    this.looks.push({ colour: new Color(colour), gloss, opened, opacity: 1, shown: true });
    this.dispose();
    return this.looks.length - 1;
  }

  /** look   any of colour (`Color`), gloss, opacity, shown */
  paint(slot, look) {
    Object.assign(this.looks[slot], look);
    this.stale = true;
  }

  /** Writes two texels for each slot: colour and opacity, then gloss and whether it is cut open. */
  refresh() {
    const height = Math.max(1, Math.ceil((2 * this.looks.length) / WIDTH));
    if (!this.texture) {
      this.texture = new DataTexture(new Uint8Array(4 * WIDTH * height), WIDTH, height, RGBAFormat, UnsignedByteType);
      this.texture.minFilter = this.texture.magFilter = NearestFilter;
    } else if (!this.stale) return this.texture;
    const { data } = this.texture.image;
    this.looks.forEach(({ colour, gloss, opened, opacity }, slot) => {
      // square roots of linear values, which distinguish dark colours in eight bits
      const [r, g, b] = [colour.r, colour.g, colour.b].map((part) => 255 * Math.sqrt(part));
      data.set([r, g, b, 255 * opacity, 255 * gloss, 255 * opened], 8 * slot);
    });
    this.texture.needsUpdate = true;
    this.stale = false;
    return this.texture;
  }

  dispose() {
    this.texture?.dispose();
    this.texture = undefined;
  }
}
