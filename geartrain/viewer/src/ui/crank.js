// The crank: a wheel to drag, with buttons, speed and position.
import { Epoch, inWords } from "../calendar.js";
import { Fraction } from "../fraction.js";
import { today, turnsOn } from "../setting.js";
import { el, field, icon, svg } from "./element.js";
import { turns, typed } from "./number.js";

const TODAY = "Set the pointers to the sky at this moment";
const WORDS = 100; // ms between two dates of a moving crank
export const PLAY = "M7 4.5v15l12.5-7.5z";
export const PAUSE = "M7 5h3.6v14H7zM13.4 5H17v14h-3.6z";

/** Turns of the hand for one turn of the driving link: those of the declared crank if a hand can turn it. */
export function gearing(scene) {
  const speed = scene.crank === null ? null : Fraction.parse(scene.bodies[scene.crank].speed);
  const size = speed ? Math.abs(Number(speed)) : 1;
  return size >= 0.05 && size <= 20 ? size : 1;
}

export class Crank {
  /** `beside`: text about a second train that turns with it; `set(day)` sets the pointers to the sky on a Julian day */
  constructor(scene, drive, { beside = "", set = null } = {}) {
    this.scene = scene;
    this.drive = drive;
    this.gearing = gearing(scene);
    this.lead = scene.driving_link === null ? "the input" : scene.bodies[scene.driving_link].id;
    this.onSet = set;
    this.epoch = scene.epoch ? new Epoch(scene.epoch) : null;
    this.date = this.epoch && el("output", { class: "date", "aria-live": "off" });
    this.wheel = this.#wheel();
    this.playing = el("button", { type: "button", class: "round", onclick: () => drive.play() });
    this.turns = el("output", { class: "turns", "aria-live": "off" });
    this.fault = el("p", { class: "bad", role: "alert", id: "go-fault", hidden: true });
    this.node = el(
      "section",
      { class: "crank", "aria-label": "crank" },
      this.wheel,
      el("div", { class: "where" }, this.turns, el("span", { class: "quiet" }, `turns of ${this.lead}`), this.date, beside && el("span", { class: "quiet beside-it" }, beside)),
      el(
        "div",
        { class: "buttons" },
        el(
          "button",
          { type: "button", onclick: () => drive.unit(-1), "aria-label": "one unit of the input back" },
          icon("M6 5v14M19 5l-9 7 9 7z"),
        ),
        this.playing,
        el(
          "button",
          { type: "button", onclick: () => drive.unit(1), "aria-label": "one unit of the input forward" },
          icon("M18 5v14M5 5l9 7-9 7z"),
        ),
        this.#back(),
      ),
      this.#speed(),
      this.#goTo(),
      this.epoch?.known && this.#goToDate(),
      this.fault,
    );
    if (!drive.movable) for (const each of this.node.querySelectorAll("button, input")) each.disabled = true;
  }

  #wheel() {
    const spokes = [0, 60, 120, 180, 240, 300].map((turn) =>
      svg("path", { d: "M0-7V-33", transform: `rotate(${turn})` }),
    );
    this.hand = svg(
      "g",
      {},
      svg("circle", { class: "felloe", r: 36 }),
      ...spokes,
      svg("circle", { class: "hub", r: 7 }),
      svg("circle", { class: "knob", cy: -36, r: 8 }),
    );
    const node = svg(
      "svg",
      {
        viewBox: "-50 -50 100 100",
        class: "handle",
        tabindex: this.drive.movable ? 0 : -1,
        role: "slider",
        "aria-label": `crank, turns of ${this.lead}`,
        "aria-valuenow": 0,
        "aria-disabled": this.drive.movable ? null : "true",
      },
      this.hand,
    );
    node.addEventListener("pointerdown", (event) => this.#grab(event));
    return node;
  }

  #grab(event) {
    if (!this.drive.movable) return;
    const box = this.wheel.getBoundingClientRect();
    const angle = (each) =>
      Math.atan2(each.clientY - box.top - box.height / 2, each.clientX - box.left - box.width / 2);
    let before = angle(event);
    this.wheel.setPointerCapture(event.pointerId);
    const move = (each) => {
      const now = angle(each);
      const part = (now - before) / (2 * Math.PI);
      before = now;
      this.drive.advance((part - Math.round(part)) / this.gearing);
    };
    const end = () => {
      this.wheel.removeEventListener("pointermove", move);
      this.drive.advance(0, true);
    };
    this.wheel.addEventListener("pointermove", move);
    this.wheel.addEventListener("lostpointercapture", end, { once: true });
    event.preventDefault();
    this.wheel.focus({ preventScroll: true });
  }

  /** Speed of playback: in days a second if the turns have dates, otherwise in turns a second. */
  #speed() {
    const { drive } = this;
    const [unit, size] = this.epoch ? ["days", Math.abs(Number(this.epoch.days))] : ["turns", 1];
    const slider = el("input", { type: "range", min: -3, max: 2, step: 0.1 });
    const pace = el("input", { type: "number", class: "pace", min: 0, step: "any", "aria-label": `${unit} a second` });
    const show = (rate, typed = false) => {
      drive.rate = rate;
      const text = Number((rate * size).toPrecision(2));
      if (!typed) pace.value = text;
      slider.value = Math.log10(rate);
      slider.setAttribute("aria-valuetext", `${text} ${unit} a second`);
    };
    slider.addEventListener("input", () => show(10 ** Number(slider.value)));
    pace.addEventListener("input", () => Number(pace.value) > 0 && show(Number(pace.value) / size, true));
    show(drive.rate);
    return field("Speed", el("span", { class: "with" }, slider, pace, `${unit}/s`), { class: "field speed" });
  }

  #goTo() {
    this.place = el("input", {
      type: "text",
      inputmode: "text",
      placeholder: "235/19",
      autocomplete: "off",
      spellcheck: "false",
      "aria-describedby": "go-fault",
    });
    return el(
      "form",
      { class: "go", onsubmit: (event) => this.#go(event) },
      field("Go to turn", this.place),
      el("button", { type: "submit" }, "Go"),
    );
  }

  #go(event) {
    event.preventDefault();
    const wanted = typed(this.place.value);
    this.#tell(this.place, wanted, "This is not a number of turns; write 12, 2.5, 235/19 or 1e6.");
    if (wanted) this.drive.play(false);
    if (wanted) this.drive.goTo(wanted);
  }

  /** Shows an error message for the input, or removes it. */
  #tell(input, wanted, fault) {
    this.fault.hidden = Boolean(wanted);
    input.setAttribute("aria-invalid", String(!wanted));
    this.fault.textContent = wanted ? "" : fault;
  }

  /** Reverses the direction of playback. */
  turnBack() {
    this.drive.sense *= -1;
    this.back.setAttribute("aria-pressed", String(this.drive.sense < 0));
  }

  #back() {
    this.back = el(
      "button",
      {
        type: "button",
        "aria-pressed": String(this.drive.sense < 0),
        "aria-label": "play backwards",
        title: "Play backwards",
        onclick: () => this.turnBack(),
      },
      icon("M4 5v5h5M4.5 10a8 8 0 1 1-.5 5"),
    );
    this.back.firstChild.classList.add("line");
    return this.back;
  }

  #goToDate() {
    const day = el("input", {
      type: "text",
      placeholder: "-204-05-12",
      autocomplete: "off",
      spellcheck: "false",
      maxlength: 40,
      "aria-describedby": "go-fault",
    });
    const turnsOf = () => {
      const date = this.epoch.read(day.value);
      this.#tell(day, date, "This is not a date; write -204-05-12 or 12 May 205 BC, optionally followed by 18:30.");
      return date && this.epoch.turnsAt(date);
    };
    const go = (event) => {
      event.preventDefault();
      const wanted = turnsOf();
      if (wanted) this.drive.play(false);
      if (wanted) this.drive.goTo(wanted);
    };
    const run = () => {
      const wanted = turnsOf();
      if (wanted) this.drive.runTo(wanted);
    };
    return el(
      "form",
      { class: "go day", onsubmit: go },
      field("Go to date", day),
      el("button", { type: "submit" }, "Go"),
      el("button", { type: "button", onclick: run, title: "Run to this date in eight seconds" }, "Run"),
      el("button", { type: "button", onclick: () => this.#today(), title: TODAY }, "Today"),
    );
  }

  /** Sets the pointers to the sky at this moment. */
  #today() {
    const day = today();
    this.drive.play(false);
    if (this.scene.epoch.settings.length) this.onSet?.(day);
    this.drive.goTo(turnsOn(this.scene, day));
  }

  #tellDate(at) {
    this.date.title = this.epoch.known ? "" : `Without a position in the sky: ${this.scene.epoch.unset.join(", ")}`;
    this.date.textContent = "not set to the sky";
    if (!this.epoch.known) return;
    const date = this.epoch.dateAt(at);
    this.dated = performance.now();
    this.date.textContent = inWords(date);
    this.date.title = `${date.calendar === "julian" ? "Julian" : "Gregorian"} calendar`;
  }

  /** Focuses the field for the number of turns. */
  find() {
    this.place.focus();
    this.place.select();
  }

  /** Connects the crank with a train whose counts have changed. */
  use(scene) {
    this.scene = scene;
    this.gearing = gearing(scene);
    for (const each of this.node.querySelectorAll("button, input")) each.disabled = !this.drive.movable;
  }

  set(drive, settled) {
    const { part } = drive.at;
    const made = Number(drive.at.floor % 1000000n); // the drawn wheel needs no exact angle
    this.hand.setAttribute("transform", `rotate(${(((made + part) * this.gearing * 360) % 360).toFixed(3)})`);
    this.turns.textContent = turns(drive.at);
    if (this.date && (settled || performance.now() - (this.dated ?? 0) > WORDS)) this.#tellDate(drive.at);
    if (settled || !drive.playing) {
      this.wheel.setAttribute("aria-valuenow", String(Number(drive.at)));
      this.wheel.setAttribute("aria-valuetext", `${turns(drive.at)} turns`);
    }
    if (this.shown === drive.playing) return;
    this.shown = drive.playing;
    this.playing.replaceChildren(icon(drive.playing ? PAUSE : PLAY));
    this.playing.setAttribute("aria-label", drive.playing ? "pause" : "play");
  }
}
