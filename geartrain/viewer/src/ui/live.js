// Announcements for screen readers: turns, and readings of the pointers once the train is at rest.
import { el } from "./element.js";
import { turns } from "./number.js";
import { Reading, textOf } from "./reading.js";

const MOST = 8;

export class Live {
  constructor() {
    this.node = el("div", { class: "unseen", role: "status", "aria-live": "polite", "aria-atomic": "true" });
    this.readings = [];
  }

  use(sides) {
    this.readings = sides.flatMap((side) => {
      const all = side.scene.pointers.map((_, index) => new Reading(side.scene, side.machine, index));
      const dialled = all.filter((each) => each.dial);
      return (dialled.length ? dialled : all)
        .slice(0, MOST)
        .map((reading) => ({ reading, label: sides.length > 1 ? `${side.label} ` : "" }));
    });
  }

  say(text) {
    clearTimeout(this.waiting);
    this.node.textContent = text;
  }

  /** Announces the turns after half a second without motion. */
  rest(drive) {
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => {
      if (drive.playing) return;
      const pointers = this.readings.map(
        ({ reading, label }) => `${label}${reading.pointer.output} ${textOf(reading.now)}`,
      );
      this.node.textContent = [drive.run ? `${drive.time.toPrecision(4)} seconds` : `${turns(drive.at)} turns`, ...pointers].join("; ");
    }, 500);
  }
}
