// A simulated motion: angles of bodies, states of contacts and impacts at any time of the run.
// Nothing is simulated here: samples are part of the scene, and angles are interpolated linearly between them.

const GLOW = 0.35; // [s of real time]: how long an impact is shown

export class Run {
  /** run   as `SceneRun.to_dict()` gives it */
  constructor(run) {
    Object.assign(this, { period: run.period, duration: run.duration, step: run.step });
    this.links = run.links.map(({ rate, samples, angles }) => ({ rate, samples: uints(samples), angles: floats(angles) }));
    this.contacts = run.contacts.map((contact) => ({
      ...contact,
      changes: uints(contact.changes),
      impact_times: doubles(contact.impact_times),
      impact_speeds: floats(contact.impact_speeds),
    }));
    this.hardest = Math.max(0, ...this.contacts.map(({ hardest }) => hardest));
    this.blows = Float64Array.from(this.contacts.flatMap(({ impact_times }) => [...impact_times])).sort();
    this.glow = GLOW; // [s of simulated time]
    this.slip = 1e-12 * Math.max(this.duration, this.period); // [s]: rounding error of the time of an impact, from rounded turns
  }

  /** Rotation of a body since the start (rad) about its declared axis, at a time (s). */
  turned(body, time) {
    const { rate, samples, angles } = this.links[body];
    const now = Math.min(Math.max(time, 0), this.duration);
    const sample = now / this.step;
    const at = Math.min(before(samples, sample), samples.length - 2);
    const share = (sample - samples[at]) / (samples[at + 1] - samples[at]);
    return rate * now + angles[at] + share * (angles[at + 1] - angles[at]);
  }

  /** State of a contact at a time (s): d on the drive flank, c on the coast flank, a without contact; "" if unknown. */
  state(contact, time) {
    const { changes, states } = this.contacts[contact];
    return states ? states[Math.max(0, before(changes, time / this.step + 1e-6))] : "";
  }

  /** [state, from, to] of a contact between two times (s). */
  *stretches(contact, from, to) {
    const { changes, states } = this.contacts[contact];
    for (let at = Math.max(0, before(changes, from / this.step)); at < changes.length; at += 1) {
      const begins = changes[at] * this.step;
      if (begins > to) return;
      const ends = at + 1 < changes.length ? changes[at + 1] * this.step : this.duration;
      yield [states[at], Math.max(begins, from), Math.min(ends, to)];
    }
  }

  /** [time, strength from 0 to 1] of a contact's impacts between two times (s). */
  *blowsOf(contact, from, to) {
    const { impact_times: times, impact_speeds: speeds } = this.contacts[contact];
    for (let at = before(times, from) + 1; at < times.length && times[at] <= to; at += 1) yield [times[at], this.strength(speeds[at])];
  }

  /** Brightness of an impact with a closing speed, relative to the strongest: 0 to 1. */
  strength(speed) {
    return 0.4 + 0.6 * Math.sqrt(speed / this.hardest);
  }

  /** Brightness of the last impacts of a contact: 0 to 1. */
  flash(contact, time) {
    const { impact_times: times, impact_speeds: speeds } = this.contacts[contact];
    let found = 0;
    for (let at = before(times, time + this.slip); at >= 0 && time - times[at] < 3 * this.glow; at -= 1) {
      found = Math.max(found, this.strength(speeds[at]) * Math.exp((times[at] - time) / this.glow));
      if (found > 0.99) break;
    }
    return found;
  }

  /** Playback speed (simulated seconds per second); an impact is shown equally long at all speeds. */
  set pace(value) {
    this.glow = GLOW * value;
  }

  /** The time of the next impact in a direction of time (1 or -1), or the end of the run. */
  blowFrom(time, sense) {
    const at = sense > 0 ? before(this.blows, time + this.slip) + 1 : before(this.blows, time - this.slip);
    return this.blows[at] ?? (sense > 0 ? this.duration : 0);
  }
}

/** Index of the last of ascending numbers that is not above a value; -1 if all are. */
function before(numbers, value) {
  let [low, high] = [0, numbers.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (numbers[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
const uints = (text) => new Uint32Array(bytes(text));
const floats = (text) => new Float32Array(bytes(text));
const doubles = (text) => new Float64Array(bytes(text));
