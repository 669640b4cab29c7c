// Controls of a simulated run: buttons, playback speed, time, and a strip of the contacts.
import { PAUSE, PLAY } from "./crank.js";
import { el, field, icon } from "./element.js";
import { Strip } from "./strip.js";

const SEEN = 10; // impacts per second that the eye can follow
const [SLOWEST, FASTEST] = [-3, 1]; // powers of ten of real time

/** A time such as `1.250 s`, with decimals according to the duration of the run. */
export function seconds(time, duration) {
  const places = Math.min(6, Math.max(0, 4 - Math.ceil(Math.log10(Math.max(duration, 1e-3)))));
  return `${time.toFixed(places)} s`;
}

/** Playback speed (simulated seconds per second) at which the eye can follow the busiest contact; at most real time. */
export function paceOf(run) {
  const most = Math.max(0, ...run.contacts.map(({ impact_rate }) => impact_rate));
  return Math.min(1, Math.max(0.02, SEEN / Math.max(most, 1e-9)));
}

export class Playhead {
  constructor(side, drive) {
    Object.assign(this, { drive, run: side.machine.run });
    const { run } = this;
    this.time = el("output", { class: "turns", "aria-live": "off" });
    this.playing = el("button", { type: "button", class: "round", onclick: () => drive.play() });
    this.slider = el("input", {
      type: "range",
      class: "moment",
      min: 0,
      max: run.duration,
      step: "any",
      "aria-label": "time",
      oninput: () => drive.goToTime(Number(this.slider.value), false),
      onchange: () => drive.goToTime(Number(this.slider.value)),
    });
    this.loop = el("input", { type: "checkbox", onchange: () => (drive.loop = this.loop.checked) });
    this.loop.checked = drive.loop;
    this.strip = new Strip(run);
    this.strip.onSeek = (time, settled) => drive.goToTime(time, settled);
    const blow = (sense, name, path) =>
      el("button", { type: "button", onclick: () => drive.unit(sense), "aria-label": name, title: name }, icon(path));
    this.node = el(
      "section",
      { class: "crank playhead", "aria-label": "time" },
      el(
        "div",
        { class: "buttons" },
        blow(-1, "previous impact", "M6 5v14M19 5l-9 7 9 7z"),
        this.playing,
        blow(1, "next impact", "M18 5v14M5 5l9 7-9 7z"),
      ),
      el("div", { class: "where" }, this.time, el("span", { class: "quiet" }, `of ${seconds(run.duration, run.duration)}; ${speedInWords(side.scene.run.rate)} of ${side.lead}`)),
      this.#speed(paceOf(run)),
      field("Repeat", this.loop, { class: "field tick" }),
      this.slider,
      this.strip.node,
    );
  }

  #speed(first) {
    const pace = el("span", { class: "pace" });
    const slider = el("input", { type: "range", min: SLOWEST, max: FASTEST, step: 0.05, value: Math.log10(first) });
    const set = () => {
      const value = Math.abs(slider.value) < 0.03 ? 1 : 10 ** Number(slider.value);
      this.drive.rate = value / this.run.period;
      this.run.pace = value;
      this.strip.pace = value;
      const text = Number(value.toPrecision(2));
      pace.textContent = value === 1 ? "real time" : `${text} \u00d7 real time`;
      slider.setAttribute("aria-valuetext", value === 1 ? "real time" : `${text} \u00d7 real time`);
      this.drive.goTo(this.drive.at, !this.drive.playing);
    };
    slider.addEventListener("input", set);
    set();
    return field("Speed", el("span", { class: "with" }, slider, pace), { class: "field speed" });
  }

  /** Focuses the field for the time. */
  find() {
    this.slider.focus();
  }

  set(drive, settled) {
    const time = Math.min(this.run.duration, Math.max(0, Number(drive.at) * this.run.period));
    const text = seconds(time, this.run.duration);
    this.time.textContent = text;
    this.slider.value = String(time);
    if (settled || !drive.playing) this.slider.setAttribute("aria-valuetext", text);
    this.strip.set(time);
    if (this.shown === drive.playing) return;
    this.shown = drive.playing;
    this.playing.replaceChildren(icon(drive.playing ? PAUSE : PLAY));
    this.playing.setAttribute("aria-label", drive.playing ? "pause" : "play");
  }
}

/** Text of a speed (rad/s): `1 turn/s`, or `1.5 turns/h` if slow. */
export function speedInWords(rate) {
  const second = Math.abs(rate) / (2 * Math.PI);
  const [size, unit] = second < 0.001 ? [3600, "h"] : [1, "s"];
  const turns = Number((second * size).toPrecision(4));
  return `${turns} ${turns === 1 ? "turn" : "turns"}/${unit}`;
}
