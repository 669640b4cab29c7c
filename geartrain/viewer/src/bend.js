// Flexible wheels bent by a strain wave, and the walls of their cups (docs/reducers.md, equation 8). A wall is bent like its
// wheel where they meet, and not at all at the bottom of its cup.

import { Vector3 } from "three";

import { frameAt } from "./space.js";

export class Bend {
  /** wave   strain wave of the scene; `wheel`, its `WheelPart`; `walls`, the cup walls that continue the wheel */
  constructor(machine, wave, wheel, walls) {
    const { body, centre, direction } = wheel.wheel;
    Object.assign(this, { machine, wave, body, slots: wheel.slots, walls: new Map(walls.map((part) => [part.slot, part.bottom])) });
    this.frame = frameAt(centre, direction, wave.towards);
    this.back = this.frame.clone().invert();
    this.cast = new Map(); // for each casting: its undeformed vertices, also in the frame of the wave
  }

  /** Bends the `castings` to the current position of the wave. */
  turn(castings) {
    const { machine, wave, body } = this;
    this.where = machine.moves ? machine.angle(wave.by) - machine.angle(body) : 0;
    for (const casting of castings) if (casting.geometry) this.#move(casting);
  }

  #move(casting) {
    if (!this.cast.has(casting)) this.cast.set(casting, this.#corners(casting));
    const { position } = casting.geometry.attributes;
    const point = new Vector3();
    for (const { first, straight, share } of this.cast.get(casting)) {
      for (let at = 0; at < straight.length; at += 3) {
        const [x, y] = this.bent(straight[at], straight[at + 1], share(straight[at + 2]));
        point.set(x, y, straight[at + 2]).applyMatrix4(this.frame).toArray(position.array, 3 * first + at);
      }
      position.needsUpdate = true;
    }
  }

  /** Undeformed vertices of the wheel and its walls in a casting; `share` is the fraction of the deflection at a height. */
  #corners({ parts, geometry }) {
    const own = parts.filter(({ slot }) => this.slots.includes(slot) || this.walls.has(slot));
    return own.map(({ slot, first, last }) => {
      const straight = geometry.attributes.position.array.slice(3 * first, 3 * last);
      const point = new Vector3();
      for (let at = 0; at < straight.length; at += 3) point.fromArray(straight, at).applyMatrix4(this.back).toArray(straight, at);
      const bottom = this.walls.has(slot) ? this.walls.get(slot).clone().applyMatrix4(this.back).z : null;
      return { first, straight, share: (z) => (bottom === null ? 1 : Math.max(0, 1 - z / bottom)) };
    });
  }

  /** Deflected position of the point (x, y) of the round wheel; x is towards the first lobe in the zero pose. */
  bent(x, y, share = 1) {
    const { middle, lobes } = this.wave;
    const rise = share * this.wave.rise;
    const place = Math.atan2(y, x);
    const off = Math.hypot(x, y) - middle;
    const [cosine, sine] = [Math.cos(lobes * (place - this.where)), Math.sin(lobes * (place - this.where))];
    const along = (-rise / lobes) * sine;
    const at = place + along / middle;
    const leaning = at + (lobes * rise * sine + along) / middle;
    const out = middle + rise * cosine;
    return [out * Math.cos(at) + off * Math.cos(leaning), out * Math.sin(at) + off * Math.sin(leaning)];
  }
}
