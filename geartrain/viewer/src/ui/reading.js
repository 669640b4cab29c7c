// What a pointer reads: its angle from the zero mark, clockwise as read, on a scale of one or several turns.

export const within = (value, size) => ((value % size) + size) % size;

export class Reading {
  constructor(scene, machine, index) {
    this.machine = machine;
    this.index = index;
    this.pointer = scene.pointers[index];
    this.dial = this.pointer.dial === null ? null : scene.dials[this.pointer.dial];
    this.turns = this.dial?.turns || 1;
    // turns from the start of the scale at which it starts
    this.start = (this.pointer.sense * (scene.bodies[this.pointer.body].start - scene.bodies[this.pointer.base].start)) / (2 * Math.PI);
    this.known = this.pointer.speed !== null && Boolean(machine);
  }

  /** Where it stands now, {turns, degrees, cell, divisions}: turns from the start of the scale (0 to its number of turns); null where nothing turns. */
  get now() {
    if (!this.known) return null;
    const turns = within(this.pointer.sense * this.machine.pointer(this.index).along, this.turns);
    const divisions = this.dial?.divisions ?? 0;
    return {
      turns,
      degrees: within(turns, 1) * 360,
      divisions,
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
const cellOf = ({ cell, divisions }) => (Math.floor(cell + 1e-9) % divisions) + 1;

/** The reading in words. */
export function told(reading) {
  if (!reading) return "not determined";
  if (reading.cell === null) return degrees(reading.degrees);
  return `${degrees(reading.degrees)}, cell ${cellOf(reading)}`;
}
