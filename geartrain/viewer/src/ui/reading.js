// Reading of a pointer: its angle from the zero mark in the counting direction of its scale, on one or several turns.

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
    this.sense = this.pointer.sense * this.scale.way; // 1 if the scale is counted in the positive sense of the output
    // initial position, in turns from the start of the scale
    this.start = (this.sense * (scene.bodies[this.pointer.body].start - scene.bodies[this.pointer.base].start)) / (2 * Math.PI);
    this.travels = scene.bodies[this.pointer.body].travels; // 1 mm for a turn
    this.known = this.pointer.speed !== null && Boolean(machine);
  }

  /** Current reading {turns, degrees, cell, scale}: turns from the start of the scale (0 to its number of turns) in its counting direction; null without motion. */
  get now() {
    if (!this.known) return null;
    if (this.travels) {
      const { whole, angle } = this.machine.pointer(this.index);
      return { travel: Number(whole) + angle / (2 * Math.PI), scale: this.scale, cell: null };
    }
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

/** Number of the cell; a hand on a line is in the cell after it, despite rounding errors. */
const cellOf = ({ cell, scale }) => Math.floor(cell + 1e-9) % scale.divisions;

/** The turn of a spiral, the name of the division, the cell and its glyph, as `reading_text` in geartrain/scene/dial_scale.py. */
function shownAt(reading) {
  const { scale, turns } = reading;
  const done = cellOf(reading);
  const named = scale.names.find(([name, first, span]) => name && done + 1e-9 >= ratio(first) && done + 1e-9 < ratio(first) + ratio(span));
  const parts = scale.turns > 1 ? [`turn ${(Math.floor(turns + 1e-9) % scale.turns) + 1}`] : [];
  if (named) parts.push(named[0]);
  if (scale.cells?.length) parts.push(scale.cells[done]);
  else if (!named) parts.push(`${scale.cell} ${numberOf(scale, done)}`);
  else if (scale.names.length < scale.divisions) parts.push(`${scale.cell} ${done - Math.floor(ratio(named[1])) + 1}`);
  parts.push(...scale.glyphs.filter(([cell, glyph]) => glyph && cell === done + 1).map(([, glyph]) => glyph));
  return parts.join(", ");
}

/** Number of the cell after `done` cells, as `number` there. */
const numberOf = ({ counted, radial }, done) => (!counted ? done + 1 : radial ? within(done - 1, counted) + 1 : done % counted);

const ratio = (text) => {
  const [above, below = 1] = text.split("/");
  return above / below;
};

/** Text of the reading. */
export function textOf(reading) {
  if (!reading) return "not determined";
  if (reading.travel !== undefined) return `${reading.travel.toFixed(2)} mm`;
  if (reading.cell === null) return degrees(reading.degrees);
  return `${degrees(reading.degrees)}, ${shownAt(reading)}`;
}
