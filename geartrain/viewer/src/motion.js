// The exact motion of a train: mean angles by rational arithmetic, errors by composing the tables of its pairs.
// Nothing is derived here: speeds, laws and the order of their composition come with the scene.

import { Fraction, partOfProduct } from "./fraction.js";
import { Law, settle } from "./laws.js";
import { Run } from "./run.js";

const TURN = 2 * Math.PI;

export class Machine {
  /** scene   as `Scene.to_dict()` gives it */
  constructor(scene) {
    this.scene = scene;
    this.lead = scene.driving_link;
    this.moves = scene.movement.kind !== "still" && scene.driving_link !== null;
    this.step = Fraction.of(scene.step || "1");
    this.period = scene.movement.period === null ? null : Fraction.of(scene.movement.period);
    this.speeds = scene.bodies.map((body) => (body.speed === null ? null : Fraction.of(body.speed)));
    const names = scene.bodies.map(({ id }) => id);
    this.ahead = new Composition(scene.movement, names);
    this.back = scene.back ? new Composition(scene.back, names) : this.ahead; // the other flanks drive
    this.turns = Fraction.of(0);
    if (scene.run) {
      this.run = new Run(scene.run);
      this.simulated = !scene.touching; // else the run gives only the position of the driving link
      this.initial = this.ahead.at(this.turns); // a run counts from the pose in which all drive flanks touch
    }
  }

  /** Time in a simulated run (s), from the turns of the driving link at its mean speed. */
  time(turns = this.turns) {
    return Number(Fraction.of(turns)) * this.run.period;
  }

  /** Turns that the lead has made, which in a simulated run need not be those of its mean speed. */
  made(turns = this.turns) {
    return this.run ? Fraction.near(this.run.turned(this.scene.driving_link, this.time(turns)) / TURN, 14) : Fraction.of(turns);
  }

  /** Declared angle of a body about its declared axis (rad), whole turns taken off; `turns` of the lead. */
  declared(body, turns = this.turns) {
    if (this.simulated) return this.scene.bodies[body].start + this.initial[body] + this.run.turned(body, this.time(turns));
    const speed = this.speeds[body];
    const made = this.made(turns);
    const mean = speed ? TURN * partOfProduct(speed, made) : 0;
    return this.scene.bodies[body].start + mean + this.errors(made)[body];
  }

  /** Angle of a body about its direction (rad), whole turns taken off. */
  angle(body, turns = this.turns) {
    return this.scene.bodies[body].sense * this.declared(body, turns);
  }

  /** Angle of a body as its parent sees it (rad), whole turns taken off. */
  joint(body, turns = this.turns) {
    const { parent } = this.scene.bodies[body];
    return this.angle(body, turns) - (parent === null ? 0 : this.angle(parent, turns));
  }

  /** Errors of all bodies (rad) over their mean angles. */
  errors(turns = this.turns) {
    const exact = Fraction.of(turns);
    if (!this.latest || !this.latestTurns.equals(exact)) {
      this.latest = (exact.numerator * this.step.numerator < 0n ? this.back : this.ahead).at(exact);
      this.latestTurns = exact;
    }
    return this.latest;
  }

  /**
   * An output: angle (rad, in [0, 2 pi)), and the same as text in degrees; its exact mean turns, whole turns made,
   * error (rad), and where it stands along its dial's spiral, in turns from the middle.
   */
  pointer(index, turns = this.turns) {
    const { body, base, dial } = this.scene.pointers[index];
    const { mean, error } = this.simulated ? this.played(index, turns) : this.followed(index, this.made(turns));
    const bodies = this.scene.bodies;
    const raw = mean.part * TURN + bodies[body].start - bodies[base].start + error;
    const whole = Math.floor(raw / TURN);
    const angle = Math.min(Math.max(raw - whole * TURN, 0), TURN);
    const made = mean.floor + BigInt(whole);
    const coils = BigInt((dial === null ? 1 : this.scene.dials[dial].scale.turns) || 1);
    const along = Number(((made % coils) + coils) % coils) + angle / TURN;
    return { angle, text: degrees(angle), error, mean, whole: made, along };
  }

  /** Exact mean turns of an output, and its error (rad). */
  followed(index, turns) {
    const { body, base, speed } = this.scene.pointers[index];
    const exact = Fraction.of(turns);
    const errors = this.errors(exact);
    return {
      mean: speed === null ? Fraction.of(0) : Fraction.of(speed).times(exact),
      error: errors[body] - errors[base],
    };
  }

  /** The same in a simulated run, where the whole angle is the error. */
  played(index, turns) {
    const { body, base } = this.scene.pointers[index];
    const time = this.time(turns);
    const error = this.run.turned(body, time) - this.run.turned(base, time) + this.initial[body] - this.initial[base];
    return { mean: Fraction.of(0), error };
  }

  /** By how much an output of a simulated run is ahead (rad, the way it turns) of where its lead would have it. */
  aheadBy(index, turns = this.turns) {
    const { speed } = this.scene.pointers[index];
    const { mean, error } = this.followed(index, this.made(turns));
    const way = Number(Fraction.of(speed ?? "0")) * this.run.links[this.scene.driving_link].rate < 0 ? -1 : 1;
    return way * (this.played(index, turns).error - TURN * Number(mean) - error);
  }
}

const degrees = (angle) => `${((angle * 180) / Math.PI).toFixed(3)}°`;

/** The errors of all bodies, from steps in their solved order. */
class Composition {
  constructor({ transmissions, sources, steps, offsets }, names) {
    this.count = names.length;
    this.transmissions = transmissions.map((law) => new Law(law));
    this.sources = sources.map((source) => ({ ...source, cycles: Fraction.of(source.cycles) }));
    this.steps = steps.map((step) => ({ ...step, gain: step.coupled ? this.gain(step) : null }));
    this.offsets = Object.entries(offsets).map(([name, offset]) => [names.indexOf(name), offset]);
  }

  at(turns) {
    const error = new Float64Array(this.count);
    for (const step of this.steps) this.take(step, turns, error);
    for (const [body, offset] of this.offsets) error[body] += offset;
    return error;
  }

  take(step, turns, error) {
    step.bodies.forEach((body, m) => {
      error[body] = step.known.reduce((sum, known, n) => sum + step.from_known[m][n] * error[known], 0);
    });
    if (!step.sources.length) return;
    const sources = step.sources.map((at) => this.sources[at]);
    const angles = sources.map((source) => this.driver(source, turns, error));
    const laws = sources.map((source) => this.transmissions[source.transmission]);
    const delta = step.coupled
      ? settle(laws, sources.map((source) => source.sense), angles, step.gain)
      : sources.map((source, n) => source.sense * laws[n].at(angles[n])[0]);
    step.bodies.forEach((body, m) => {
      delta.forEach((value, n) => (error[body] += step.from_sources[m][n] * value));
    });
  }

  /** Forward angle of a source's driver (rad); bodies of its own step count as they stand. */
  driver(source, turns, error) {
    const mean = partOfProduct(source.cycles, turns) * this.transmissions[source.transmission].period;
    const shift = source.driver_sense * error[source.driver] - source.carrier_sense * error[source.carrier];
    return source.start + mean + source.forward * shift;
  }

  /** Radians of each driver's forward angle per radian of each pair's error, within a coupled step. */
  gain(step) {
    const inside = new Map(step.bodies.map((body, at) => [body, at]));
    const reach = (body, n) => (inside.has(body) ? step.from_sources[inside.get(body)][n] : 0);
    return step.sources.map((at) => {
      const { driver, carrier, driver_sense, carrier_sense, forward } = this.sources[at];
      return step.sources.map(
        (_, n) => forward * (driver_sense * reach(driver, n) - carrier_sense * reach(carrier, n)),
      );
    });
  }
}
