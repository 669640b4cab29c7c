// Transmission errors of pairs as piecewise polynomials, and pairs that depend on each other.

const SETTLED = 2e-15; // relative to the magnitude of the added angles [rad]
const MOST_STEPS = 120;

/** Transmission error (rad of the driven side) as a function of the driver's forward angle, with period `period`. */
export class Law {
  constructor({ period, breaks, coefficients }) {
    this.period = period;
    this.breaks = floats(breaks);
    const cells = this.breaks.length - 1;
    this.coefficients = floats(coefficients);
    this.terms = this.coefficients.length / cells;
  }

  /** [error, derivative of the error] at an angle (rad). */
  at(angle) {
    const inside = angle - Math.floor(angle / this.period) * this.period;
    const cell = this.cell(inside);
    const x = inside - (this.breaks[cell] + this.breaks[cell + 1]) / 2;
    const first = cell * this.terms;
    let error = 0;
    let slope = 0;
    for (let power = this.terms - 1; power >= 0; power -= 1) {
      slope = slope * x + error;
      error = error * x + this.coefficients[first + power];
    }
    return [error, slope];
  }

  cell(inside) {
    let low = 0;
    let high = this.breaks.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.breaks[middle] <= inside) low = middle;
      else high = middle;
    }
    return low;
  }
}

/**
 * Errors of pairs that move each other's drivers: delta = sense e(base + gain delta), by Newton's method. Error functions
 * have kinks, so a step that does not decrease the residual is halved.
 */
export function settle(laws, senses, base, gain) {
  const evaluate = (delta) => laws.map((law, m) => law.at(base[m] + dot(gain[m], delta)).map((v) => senses[m] * v));
  const scale = 1 + Math.max(...base.map(Math.abs)) + Math.max(...gain.map((row) => dot(row.map(Math.abs), row.map(() => 1))));
  let now = laws.map((law, m) => senses[m] * law.at(base[m])[0]);
  let step = now.map(() => 0);
  let length = 1;
  let size = Infinity;
  for (let count = 0; count < MOST_STEPS; count += 1) {
    const trial = now.map((value, m) => value - length * step[m]);
    const found = evaluate(trial);
    const residual = trial.map((value, m) => value - found[m][0]);
    const left = Math.max(...residual.map(Math.abs));
    if (left >= size) {
      length /= 2;
      if (length < 1e-9) break; // rounding, or a kink
      continue;
    }
    [now, size, length] = [trial, left, 1];
    if (left <= SETTLED * scale) break;
    const jacobian = found.map(([, slope], m) => gain[m].map((g, n) => (m === n ? 1 : 0) - slope * g));
    step = solve(jacobian, residual);
  }
  return now;
}

const dot = (row, column) => row.reduce((sum, value, n) => sum + value * column[n], 0);

/** Solution of a small linear system, by Gaussian elimination with partial pivoting. */
function solve(matrix, right) {
  const rows = matrix.map((row, m) => [...row, right[m]]);
  for (let at = 0; at < rows.length; at += 1) {
    let best = at;
    for (let m = at + 1; m < rows.length; m += 1) if (Math.abs(rows[m][at]) > Math.abs(rows[best][at])) best = m;
    [rows[at], rows[best]] = [rows[best], rows[at]];
    for (let m = at + 1; m < rows.length; m += 1) {
      const factor = rows[m][at] / rows[at][at];
      for (let n = at; n <= rows.length; n += 1) rows[m][n] -= factor * rows[at][n];
    }
  }
  const found = right.map(() => 0);
  for (let m = rows.length - 1; m >= 0; m -= 1) {
    found[m] = (rows[m][rows.length] - dot(rows[m].slice(0, rows.length), found)) / rows[m][m];
  }
  return found;
}

function floats(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Float64Array(bytes.buffer); // little-endian, as on all machines with browsers
}
