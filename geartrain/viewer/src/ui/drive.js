// Where the crank stands: exact turns of the lead, and the play of time.
import { Fraction } from "../fraction.js";

const NUDGE = new Fraction(1n, 72n); // an arrow key: five degrees of the lead

export class Drive {
  constructor(app, step) {
    this.app = app;
    this.step = step;
    this.at = Fraction.parse(app.turns) ?? Fraction.of(0);
    this.rate = 0.1;
    this.playing = false;
    this.movable = true;
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
    this.at = fraction;
    this.setting = true;
    this.app.setTurns(fraction.toString());
    this.setting = false;
    this.#tell(settled);
  }

  /** By a number of turns of the lead, as a hand or the clock gives them. */
  advance(turns, settled = false) {
    this.goTo(this.at.plus(Fraction.near(turns)), settled);
  }

  /** By so many units of the input. */
  unit(times) {
    this.goTo(this.at.plus(this.step.times(times)));
  }

  nudge(times) {
    this.goTo(this.at.plus(NUDGE.times(times)));
  }

  play(on = !this.playing) {
    this.playing = on && this.movable;
    this.#tell(!this.playing);
    let before = performance.now();
    const frame = (now) => {
      if (!this.playing) return;
      // one jump a second where motion is not wanted; a tab that slept does not leap
      if (!this.calm.matches || now - before >= 1000) {
        this.advance((this.rate * Math.min(now - before, this.calm.matches ? 2000 : 100)) / 1000);
        before = now;
      }
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
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
