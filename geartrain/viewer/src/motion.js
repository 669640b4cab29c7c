// The exact motion of a train: mean angles by rational arithmetic, errors by composing the tables of its pairs.
// Nothing is derived here: speeds, error tables and the order of their composition are part of the scene.

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
    this.back = scene.back ? new Composition(scene.back, names) : this.ahead; // the coast flanks drive
    this.turns = Fraction.of(0);
    if (scene.run) {
      this.run = new Run(scene.run);
      this.simulated = !scene.touching; // otherwise, only the position of the driving link is taken from the run
      this.initial = this.ahead.at(this.turns); // angles of a run are relative to the pose in which all drive flanks are in contact
    }
  }

  /** Time in a simulated run (s), from the turns of the driving link at its mean speed. */
  time(turns = this.turns) {
    return Number(Fraction.of(turns)) * this.run.period;
  }

  /** Turns of the driving link, which in a simulated run may differ from those at its mean speed. */
  made(turns = this.turns) {
    return this.run ? Fraction.near(this.run.turned(this.scene.driving_link, this.time(turns)) / TURN, 14) : Fraction.of(turns);
  }

  /** Angle of a body about its declared axis, modulo one turn (rad), after `turns` of the driving link. */
  declared(body, turns = this.turns) {
    if (this.simulated) return this.scene.bodies[body].start + this.initial[body] + this.run.turned(body, this.time(turns));
    const speed = this.speeds[body];
    const made = this.made(turns);
    // the angle of a body that slides is a whole turn for each millimetre
    const kept = this.scene.bodies[body].travels ? (a, b) => Number(a) * Number(b) : partOfProduct;
    const mean = speed ? TURN * kept(speed, made) : 0;
    return this.scene.bodies[body].start + mean + this.errors(made)[body];
  }

  /** Angle of a body about its direction, modulo one turn (rad). */
  angle(body, turns = this.turns) {
    return this.scene.bodies[body].sense * this.declared(body, turns);
  }

  /** Angle of a body relative to its parent, modulo one turn (rad). */
  joint(body, turns = this.turns) {
    const { parent, base } = this.scene.bodies[body];
    const reference = base ?? parent;
    return this.angle(body, turns) - (reference === null ? 0 : this.angle(reference, turns));
  }

  /** Angles of all bodies minus their mean angles (rad). */
  errors(turns = this.turns) {
    const exact = Fraction.of(turns);
    if (!this.latest || !this.latestTurns.equals(exact)) {
      this.latest = (exact.numerator * this.step.numerator < 0n ? this.back : this.ahead).at(exact);
      this.latestTurns = exact;
    }
    return this.latest;
  }

  /**
   * State of an output: angle (rad, in [0, 2 pi)), and the same as text in degrees; exact mean turns, completed turns,
   * error (rad), and position along the spiral of its dial, in turns from the middle.
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

  /** The same in a simulated run, in which the error is the whole angle. */
  played(index, turns) {
    const { body, base } = this.scene.pointers[index];
    const time = this.time(turns);
    const error = this.run.turned(body, time) - this.run.turned(base, time) + this.initial[body] - this.initial[base];
    return { mean: Fraction.of(0), error };
  }

  /** Lead of an output of a simulated run over its ideal position at the angle of the driving link (rad, in its sense). */
  aheadBy(index, turns = this.turns) {
    const { speed } = this.scene.pointers[index];
    const { mean, error } = this.followed(index, this.made(turns));
    const way = Number(Fraction.of(speed ?? "0")) * this.run.links[this.scene.driving_link].rate < 0 ? -1 : 1;
    return way * (this.played(index, turns).error - TURN * Number(mean) - error);
  }
}

const degrees = (angle) => `${((angle * 180) / Math.PI).toFixed(3)}°`;

/** The errors of all bodies, from the errors of pairs in their order of solution. */
class Composition {
  constructor({ transmissions, sources, steps, offsets }, names) {
    this.count = names.length;
    this.transmissions = transmissions.map((law) => new Law(law));
    this.sources = sources.map((source) => ({ ...source, cycles: Fraction.of(source.cycles) }));
    this.steps = steps;
    this.offsets = Object.entries(offsets).map(([name, offset]) => [names.indexOf(name), offset]);
  }

  at(turns) {
    const delta = new Float64Array(this.sources.length);
    for (const step of this.steps) this.take(step, turns, delta);
    const error = new Float64Array(this.count);
    this.sources.forEach(({ bodies, weights }, n) => bodies.forEach((body, m) => (error[body] += weights[m] * delta[n])));
    for (const [body, offset] of this.offsets) error[body] += offset;
    return error;
  }

  /** Computes the errors of the sources of a step (rad), in place. */
  take({ sources: own, known, from_known: gains, own: gain }, turns, delta) {
    const sources = own.map((at) => this.sources[at]);
    const laws = sources.map((source) => this.transmissions[source.transmission]);
    const angles = sources.map(({ start, cycles }, m) =>
      known.reduce((sum, at, n) => sum + gains[m][n] * delta[at], start + partOfProduct(cycles, turns) * laws[m].period),
    );
    const found = gain.length
      ? settle(laws, sources.map(({ sense }) => sense), angles, gain)
      : sources.map(({ sense }, m) => sense * laws[m].at(angles[m])[0]);
    own.forEach((at, m) => (delta[at] = found[m]));
  }
}
