// What a pointer reads: its angle from the zero mark, the way its scale is counted, on one turn or several.

import { orderOf } from "../faces.js";

export const within = (value, size) => ((value % size) + size) % size;

export class Reading {
  constructor(scene, machine, index) {
    this.machine = machine;
    this.index = index;
    this.pointer = scene.pointers[index];
    this.order = orderOf(scene, index);
    this.dial = this.pointer.dial === null ? null : scene.dials[this.pointer.dial];
    this.scale = this.dial?.scale ?? { turns: 1, divisions: 0, way: 1, names: [] };
    this.turns = this.scale.turns;
    this.sense = this.pointer.sense * this.scale.way; // 1 where the scale is counted as the output grows
    // turns from the start of the scale at which it starts
    this.start = (this.sense * (scene.bodies[this.pointer.body].start - scene.bodies[this.pointer.base].start)) / (2 * Math.PI);
    this.known = this.pointer.speed !== null && Boolean(machine);
  }

  /** Where it stands now, {turns, degrees, cell, scale}: turns from the start of the scale (0 to its number of turns), the way it is counted; null where nothing turns. */
  get now() {
    if (!this.known) return null;
    const turns = within(this.sense * this.machine.pointer(this.index).along, this.turns);
    const { divisions } = this.scale;
    return {
      turns,
      degrees: within(turns, 1) * 360,
      scale: this.scale,
      cell: divisions > 1 ? (turns / this.turns) * divisions : null,
    };
  }
}

/** `12.34°`, never `360.00°`. */
export function degrees(value, places = 2) {
  const text = value.toFixed(places);
  return `${Number(text) === 360 ? (0).toFixed(places) : text}\u00b0`;
}

/** Number of the cell, from 1; a hand on a line stands in the cell after it, whatever floats make of the line. */
const cellOf = ({ cell, scale }) => Math.floor(cell + 1e-9) % scale.divisions;

/** The turn of a spiral, the name of the division, the cell, what is engraved in it, as `told` of geartrain/scene/dial_scale.py has them. */
function shownAt(reading) {
  const { scale, turns } = reading;
  const done = cellOf(reading);
  const named = scale.names.find(([name, first, span]) => name && done + 1e-9 >= ratio(first) && done + 1e-9 < ratio(first) + ratio(span));
  const parts = scale.turns > 1 ? [`turn ${(Math.floor(turns + 1e-9) % scale.turns) + 1}`] : [];
  if (named) parts.push(named[0]);
  if (!named) parts.push(`${scale.cell} ${numberOf(scale, done)}`);
  else if (scale.names.length < scale.divisions) parts.push(`${scale.cell} ${done - Math.floor(ratio(named[1])) + 1}`);
  parts.push(...scale.glyphs.filter(([cell, glyph]) => glyph && cell === done + 1).map(([, glyph]) => glyph));
  return parts.join(", ");
}

/** As `number` there has it, after some cells. */
const numberOf = ({ counted, radial }, done) => (!counted ? done + 1 : radial ? within(done - 1, counted) + 1 : done % counted);

const ratio = (text) => {
  const [above, below = 1] = text.split("/");
  return above / below;
};

/** The reading in words. */
export function told(reading) {
  if (!reading) return "not determined";
  if (reading.cell === null) return degrees(reading.degrees);
  return `${degrees(reading.degrees)}, ${shownAt(reading)}`;
}
