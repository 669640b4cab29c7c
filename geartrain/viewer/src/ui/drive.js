// Where the crank stands: exact turns of the lead, and the play of time.
import { Fraction } from "../fraction.js";

const FINE = 14; // decimals of a turn in a simulated run: a clock's lead makes one in hours
const FRAME = 1 / 25; // s as the reader sees them: an arrow key in a simulated run
const NUDGE = new Fraction(1n, 72n); // an arrow key: five degrees of the lead

export class Drive {
  constructor(app, step) {
    this.app = app;
    this.step = step;
    this.at = Fraction.parse(app.turns) ?? Fraction.of(0);
    this.rate = 0.1;
    this.playing = false;
    this.movable = true;
    this.run = null; // a simulated run, which begins and ends; units and nudges are then of time
    this.loop = true;
    this.listeners = [];
    this.calm = matchMedia("(prefers-reduced-motion: reduce)");
    app.onTurns = (turns) => this.#heard(turns);
  }

  /** Calls `listener(drive, settled)` after every move; settled unless more follow at once. */
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

  /** By a number of turns of the lead, as a hand or the clock gives them. */
  advance(turns, settled = false) {
    this.goTo(this.at.plus(Fraction.near(turns, this.run ? FINE : undefined)), settled);
  }

  /** By so many units of the input. */
  unit(times) {
    if (this.run) this.goToTime(this.run.blowFrom(this.time, times));
    else this.goTo(this.at.plus(this.step.times(times)));
  }

  nudge(times) {
    this.goTo(this.at.plus(this.run ? Fraction.near(times * FRAME * this.rate, FINE) : NUDGE.times(times)));
  }

  /** To a time of a simulated run (s). */
  goToTime(time, settled = true) {
    this.goTo(Fraction.near(time / this.run.period, FINE), settled);
  }

  /** Where a simulated run stands (s). */
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
    this.playing = on && this.movable;
    if (this.playing && this.run && this.at.equals(this.#end)) this.goTo(Fraction.of(0), false);
    this.#tell(!this.playing);
    let before = performance.now();
    const frame = (now) => {
      if (!this.playing) return;
      // one jump a second where motion is not wanted; a tab that slept does not leap
      if (!this.calm.matches || now - before >= 1000) {
        this.advance((this.rate * Math.min(now - before, this.calm.matches ? 2000 : 100)) / 1000);
        before = now;
        if (this.run && this.at.equals(this.#end)) this.#ended();
      }
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  #ended() {
    if (this.loop) this.goTo(Fraction.of(0), false);
    else this.play(false);
  }

  #tell(settled) {
    for (const each of this.listeners) each(this, settled);
  }

  #heard(turns) {
    if (this.setting) return;
    this.at = Fraction.parse(turns) ?? this.at;
    this.#tell(true);
  }
}
