// The picture with a few buttons: for a frame in another page, and for a screen in a museum.
import { Epoch, inWords } from "../calendar.js";
import { Fraction } from "../fraction.js";
import { NEEDLES } from "../colours.js";
import { Machine } from "../motion.js";
import { momentOf, pace, purposeOf } from "../opening.js";
import { setTo, today, turnsOn } from "../setting.js";
import { Callouts } from "./callouts.js";
import { PAUSE, PLAY } from "./crank.js";
import { legend } from "./colours.js";
import { Drive } from "./drive.js";
import { el, icon } from "./element.js";
import { decimal } from "./number.js";
import { paceOf } from "./playhead.js";
import { Reading, textOf } from "./reading.js";
import { Theme } from "./theme.js";
import { Tour } from "./tour.js";

const LOOKS = ["free", "front", "side", "back"];
const EYE = "M2 12c3-5 6.5-7 10-7s7 2 10 7c-3 5-6.5 7-10 7s-7-2-10-7zM12 9.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5z";
const LABEL = "M3 5h9l8 7-8 7H3zM8 12h.01";
const PAINT = "M12 3a9 9 0 1 0 0 18c2 0 2-3 0-4s0-3 3-3h4c1-6-3-11-7-11zM8 9h.01M14 7h.01";
const LAYERS = "M12 3l9 4.5-9 4.5-9-4.5zM3 12l9 4.5 9-4.5M3 16.5l9 4.5 9-4.5";
const IDLE = 45; // seconds without input after which a kiosk continues by itself
const MOST = 6; // maximum number of outputs that a kiosk lists
const ROUND = 90; // [s] period of the camera of an idle kiosk

export class Showcase {
  /** Options from the address: null, or {kiosk, idle}. `#embed`, `#kiosk`, `#kiosk=20` (seconds without input) */
  static asked(hash, shown) {
    const [, name, idle] = /^#(embed|kiosk)(?:=(\d{1,5}))?$/.exec(hash) ?? [null, shown];
    if (name !== "embed" && name !== "kiosk") return null;
    return { kiosk: name === "kiosk", idle: 1000 * Math.max(1, Number(idle ?? IDLE)) };
  }

  constructor(app, { kiosk, idle }) {
    Object.assign(this, { app, kiosk, idle });
    this.index = Math.max(0, app.machines.findIndex((machine) => machine.moves)); // moving trains take precedence
    this.scene = app.scenes[this.index];
    if (kiosk && this.scene.epoch?.settings.length) this.#setToday();
    const { run } = app.machines[this.index];
    this.drive = new Drive(app, Fraction.of(this.scene.step));
    this.drive.run = run ?? null;
    this.drive.rate = run ? paceOf(run) / run.period : pace(this.scene);
    this.drive.movable = app.machines[this.index].moves;
    if (this.drive.movable) this.drive.at = this.moment ?? momentOf(this.scene);
    this.look = 0;
    this.theme = new Theme((background) => this.stage?.theme({ background }));
    this.theme.apply();
    this.#lay();
    this.drive.listen(() => this.#moved());
    this.drive.goTo(this.drive.at);
    if (kiosk) this.#attend();
  }

  /** Sets the pointers to the sky at this moment, from which the train turns. */
  #setToday() {
    const day = today();
    this.moment = turnsOn(this.scene, day);
    this.scene = this.app.scenes[this.index] = setTo(this.scene, day);
    this.app.machines[this.index] = new Machine(this.scene);
  }

  #lay() {
    const button = (act, name, path) =>
      el("button", { type: "button", onclick: act, "aria-label": name, title: name }, icon(path), el("span", {}, name));
    this.playing = button(() => this.#play(), "Turn", PLAY);
    this.playing.disabled = !this.drive.movable;
    const look = button(() => this.#nextLook(), "Other side", EYE);
    this.apart = button(() => this.#pull(), "Take apart", LAYERS);
    this.turns = el("output", { class: "quiet" });
    this.place = el("div", { class: "place" });
    const { title, name, state, verdict, wheels } = this.scene;
    const said = this.drive.movable ? [this.turns, this.kiosk && this.#outputs()] : el("p", { class: "bad" }, verdict.text);
    const more = this.kiosk && [
      button(() => this.callouts?.show(!this.callouts.shown), "Names", LABEL),
      wheels.some(({ status }) => status) && button(() => this.#paint(this.mode === "status" ? "plain" : "status"), "Status", PAINT),
    ];
    this.tour = new Tour(this.kiosk ? this.scene.tour : [], (step) => this.#visit(step));
    this.legend = el("div", {});
    document.body.classList.add("showcase");
    document.body.classList.toggle("kiosk", this.kiosk);
    document.body.prepend(
      el(
        "main",
        {},
        this.place,
        el("header", {}, el("h1", {}, title || name, state && ` (${state})`), this.kiosk && el("p", {}, purposeOf(this.scene)), said, this.legend),
        this.tour.node,
        el("div", { class: "buttons", role: "group", "aria-label": "the train" }, this.playing, look, this.apart, more),
      ),
    );
  }

  /** Readings shown in a kiosk: the date, if there is one, and outputs, those with dials first. */
  #outputs() {
    const { scene, index, app } = this;
    if (scene.epoch && !scene.epoch.unset.length) this.epoch = new Epoch(scene.epoch);
    this.date = this.epoch && el("output", { class: "date" });
    const asked = scene.asks ? scene.pointers.map((_, at) => at) : [];
    const order = asked.sort((one, other) => (scene.pointers[one].dial === null) - (scene.pointers[other].dial === null));
    this.read = order.slice(0, MOST).map((at) => ({ hand: new Reading(scene, app.machines[index], at), value: el("dd") }));
    const rows = this.read.map(({ hand, value }) => el("div", { class: hand.dial && `hand-${hand.order % NEEDLES.length}` }, el("dt", {}, hand.pointer.output), value));
    return [this.date, el("dl", { class: "read" }, rows)];
  }

  /** Opens the picture; called after the text is visible. */
  openStages() {
    this.stage = this.app.open(this.index);
    const { canvas } = this.stage;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${this.scene.title || this.scene.name}, turning`);
    this.place.append(canvas);
    if (this.kiosk && this.stage.renderer) this.place.append((this.callouts = new Callouts(this.stage)).node);
    this.stage.theme({ background: this.theme.background });
    this.stage.onCrank = (made) => this.drive.advance(made, true);
    this.stage.resize();
    if (this.kiosk) this.#leave();
    else this.#beginWhenSeen();
  }

  /** Starts when the frame is visible, and not by itself for users who prefer reduced motion. */
  #beginWhenSeen() {
    if (this.drive.calm.matches) return;
    new IntersectionObserver((seen) => {
      const inSight = seen.at(-1).isIntersecting;
      if (inSight && !this.stopped) this.drive.play(true);
      else if (!inSight) this.drive.play(false);
    }).observe(this.place);
  }

  #play() {
    this.drive.play();
    this.stopped = !this.drive.playing;
  }

  #nextLook() {
    this.look = (this.look + 1) % LOOKS.length;
    this.stage?.look(LOOKS[this.look]);
  }

  #paint(mode) {
    this.mode = mode;
    this.stage?.paint(mode);
    this.legend.replaceChildren(legend(this.scene, mode));
  }

  #visit(step) {
    this.#pull(false);
    const colour = getComputedStyle(document.documentElement).getPropertyValue("--way").trim();
    this.stage?.visit?.(step, colour, this.drive.calm.matches);
  }

  #pull(apart = !this.pulled) {
    this.pulled = apart;
    this.#name(this.apart, apart ? "Together" : "Take apart");
    this.stage?.explode(apart ? 1 : 0);
    this.stage?.look(LOOKS[this.look]);
  }

  #name(button, name) {
    button.setAttribute("aria-label", name);
    button.title = name;
    button.querySelector("span").textContent = name;
  }

  #moved() {
    const { drive, scene } = this;
    const lead = scene.bodies[scene.driving_link]?.id ?? "the input";
    this.turns.textContent = drive.run ? `${drive.time.toFixed(2)} s` : `${decimal(drive.at, 2)} turns of ${lead}`;
    if (this.epoch) this.date.textContent = inWords(this.epoch.dateAt(Fraction.of(drive.at)));
    this.read?.forEach(({ hand, value }) => (value.textContent = textOf(hand.now)));
    if (this.shown === drive.playing) return;
    this.shown = drive.playing;
    this.#name(this.playing, drive.playing ? "Stop" : "Turn");
    this.playing.querySelector("svg").replaceWith(icon(drive.playing ? PAUSE : PLAY));
  }

  /** Listens for input: the first makes a kiosk full-screen, and after a time without input the kiosk continues by itself. */
  #attend() {
    document.addEventListener("contextmenu", (event) => event.preventDefault());
    document.addEventListener("click", () => {
      if (!document.fullscreenElement) document.documentElement.requestFullscreen?.().catch(() => {});
    });
    for (const kind of ["pointerdown", "pointermove", "wheel", "keydown"]) {
      document.addEventListener(kind, () => this.#touched(), { passive: true, capture: true });
    }
  }

  #touched() {
    this.alone = false;
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => this.#leave(), this.idle);
  }

  /** Resets the picture to the best view and plays it, with a camera that slowly moves around it. */
  #leave() {
    this.alone = true;
    this.look = 0;
    this.tour.go(-1);
    this.#paint("plain");
    this.callouts?.show(true);
    this.#pull(false);
    this.drive.play(true);
    if (!this.drive.calm.matches) this.#goRound(performance.now());
  }

  #goRound(before) {
    requestAnimationFrame((now) => {
      const { controls } = this.stage;
      if (!this.alone || !controls) return; // a plan has no camera
      controls.autoRotate = true;
      controls.autoRotateSpeed = 60 / ROUND;
      controls.update(Math.min(now - before, 100) / 1000);
      controls.autoRotate = false;
      this.#goRound(now);
    });
  }
}
