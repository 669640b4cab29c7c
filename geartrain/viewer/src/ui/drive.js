// State of the crank: exact turns of the driving link, and playback.
import { Fraction } from "../fraction.js";

const FINE = 14; // decimals of a turn in a simulated run, because the driving link of a clock turns once in hours
const FRAME = 1 / 25; // step of an arrow key in a simulated run [s of real time]
const NUDGE = new Fraction(1n, 72n); // step of an arrow key: five degrees of the driving link

export class Drive {
  constructor(app, step) {
    this.app = app;
    this.step = step;
    this.at = Fraction.parse(app.turns) ?? Fraction.of(0);
    this.rate = 0.1;
    this.playing = false;
    this.sense = 1; // -1: reversed playback
    this.movable = true;
    this.run = null; // simulated run with a start and an end; units and steps are then times
    this.loop = true;
    this.listeners = [];
    this.calm = matchMedia("(prefers-reduced-motion: reduce)");
    app.onTurns = (turns) => this.#heard(turns);
  }

  /** Calls `listener(drive, settled)` after every move; `settled` is false if further moves follow immediately. */
  listen(listener) {
    this.listeners.push(listener);
  }

  goTo(fraction, settled = true) {
    if (!this.movable) return;
    this.at = this.#within(fraction);
    this.setting = true;
    this.app.setTurns(this.at.toString());
    this.setting = false;
    this.#tell(settled);
  }

  /** Moves by a number of turns of the driving link. */
  advance(turns, settled = false) {
    this.goTo(this.at.plus(Fraction.near(turns, this.run ? FINE : undefined)), settled);
  }

  /** Moves by a number of units of the input. */
  unit(times) {
    if (this.run) this.goToTime(this.run.blowFrom(this.time, times));
    else this.goTo(this.at.plus(this.step.times(times)));
  }

  nudge(times) {
    this.goTo(this.at.plus(this.run ? Fraction.near(times * FRAME * this.rate, FINE) : NUDGE.times(times)));
  }

  /** Moves to a time of a simulated run (s). */
  goToTime(time, settled = true) {
    this.goTo(Fraction.near(time / this.run.period, FINE), settled);
  }

  /** Time in a simulated run (s). */
  get time() {
    return Number(this.at) * this.run.period;
  }

  get #end() {
    return Fraction.near(this.run.duration / this.run.period, FINE);
  }

  #within(fraction) {
    if (!this.run) return fraction;
    if (fraction.numerator < 0n) return Fraction.of(0);
    return fraction.minus(this.#end).numerator > 0n ? this.#end : fraction;
  }

  play(on = !this.playing) {
    if (on && this.movable && this.#ended) this.goTo(Fraction.of(0), false);
    // one step per second for users who prefer reduced motion; no jump after a pause of the tab
    this.#moving(on, (passed) => {
      if (this.calm.matches && passed < 1000) return false;
      // the end of a run is shown before it restarts, even if frames are slow
      if (this.loop && this.#ended) this.goTo(Fraction.of(0), false);
      else this.advance((this.sense * this.rate * Math.min(passed, this.calm.matches ? 2000 : 100)) / 1000);
      if (!this.loop && this.#ended) this.play(false);
      return true;
    });
  }

  /** Moves to a position within some seconds and stops there exactly; immediately for users who prefer reduced motion. */
  runTo(fraction, seconds = 8) {
    if (this.calm.matches) return this.goTo(fraction);
    const from = this.at;
    const gap = fraction.minus(from);
    let share = 0;
    this.#moving(true, (passed) => {
      share += Math.min(passed, 100) / 1000 / seconds;
      if (share >= 1) this.#moving(false);
      this.goTo(share < 1 ? from.plus(gap.times(Fraction.near(share))) : fraction, share >= 1);
      return true;
    });
  }

  /** Moves in steps, called with the milliseconds since the last step, until another action. */
  #moving(on, step) {
    this.playing = on && this.movable;
    this.#tell(!this.playing);
    const own = (this.frames = {});
    let before = performance.now();
    const frame = (now) => {
      if (!this.playing || this.frames !== own) return;
      if (step(now - before)) before = now;
      requestAnimationFrame(frame);
    };
    if (this.playing) requestAnimationFrame(frame);
  }

  get #ended() {
    return Boolean(this.run) && this.at.equals(this.#end);
  }

  #tell(settled) {
    for (const each of this.listeners) each(this, settled);
  }

  #heard(turns) {
    if (this.setting) return;
    this.play(false);
    this.at = Fraction.parse(turns) ?? this.at;
    this.#tell(true);
  }
}
