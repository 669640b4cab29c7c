// Keyboard shortcuts, and the dialog that lists them.
import { el } from "./element.js";
import { Fraction } from "../fraction.js";

const TURNED = [
  ["Left, Right", "turn back or forward by five degrees; with Shift by one unit of the input"],
  ["Page Up, Page Down", "one unit of the input forward or back"],
  ["G", "go to a number of turns"],
  ["B", "play backwards, or forwards again"],
];
const REST = [
  ["Home", "back to the start"],
  ["Space", "play or pause"],
  ["/", "find a wheel"],
  ["1, 2, 3, 4", "view from the front, the back, the side, or freely"],
  ["C", "next colours"],
  ["E", "take apart, put together"],
  ["H", "hide or show the front"],
  ["N", "names of the parts on or off"],
  ["T", "teeth on or off"],
  ["?", "this list"],
  ["Escape", "close, or clear the selection"],
];
const TIMED = [
  ["Left, Right", "step by 1/25 s of playback; with Shift to the previous or next impact"],
  ["Page Up, Page Down", "to the next or previous impact"],
  ["G", "go to the time slider"],
];
export const BY_HAND =
  "Drag the crank, or the handle in the picture. Drag elsewhere in the picture to rotate the view, pinch or scroll to zoom, click a wheel for details.";
const TEXT = "input:not([type=checkbox]):not([type=range]), textarea, select";
const LOOKS = { 1: "front", 2: "back", 3: "side", 4: "free" };

export class Keys {
  /** `actions`: drive, tools, goTo(), find(), escape(); `timed` where a simulated run is played */
  constructor(actions) {
    this.actions = actions;
    this.letters = el("input", { type: "checkbox" });
    this.letters.checked = true;
    const close = el("button", { type: "button", onclick: () => this.dialog.close() }, "Close");
    this.dialog = el(
      "dialog",
      { "aria-labelledby": "keys-title" },
      el("h2", { id: "keys-title" }, "Keys"),
      el(
        "dl",
        { class: "keys" },
        [...(actions.timed ? TIMED : TURNED), ...REST].map(([key, does]) => [el("dt", {}, el("kbd", {}, key)), el("dd", {}, does)]),
      ),
      el("p", {}, BY_HAND),
      el("label", { class: "field tick" }, el("span", {}, "Single-letter shortcuts"), this.letters),
      close,
    );
    this.node = this.dialog;
    document.addEventListener("keydown", (event) => this.#press(event));
  }

  open() {
    this.dialog.showModal();
  }

  #press(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || this.dialog.open) return;
    const at = event.target instanceof Element ? event.target : document.body;
    if (event.key === "Escape") {
      if (at.matches(TEXT)) at.blur();
      this.actions.escape();
      return;
    }
    if (at.closest(TEXT)) return;
    const done = this.#turn(event, at) || (this.letters.checked && this.#letter(event.key));
    if (done) event.preventDefault();
  }

  #turn({ key, shiftKey }, at) {
    const { drive } = this.actions;
    if (key === " " && !at.closest("button, a, input, summary")) return (drive.play(), true);
    if (at.closest("[role=tablist], input, .scroll") || (at.closest(".pages") && key.startsWith("Page"))) return false;
    const sign = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[key];
    const vertical = key === "ArrowUp" || key === "ArrowDown";
    if (sign && !(vertical && !at.closest(".handle, canvas")))
      return (shiftKey ? drive.unit(sign) : drive.nudge(sign), true);
    if (key === "PageUp" || key === "PageDown") return (drive.unit(key === "PageUp" ? 1 : -1), true);
    if (key === "Home") return (drive.goTo(Fraction.of(0)), true);
    return false;
  }

  #letter(key) {
    const { tools, goTo, find, back } = this.actions;
    if (LOOKS[key]) return (tools.look(LOOKS[key]), true);
    const act = {
      g: goTo,
      "/": find,
      b: back,
      c: () => tools.next(),
      e: () => tools.takeApart(),
      h: () => tools.toggle(tools.front),
      n: () => tools.toggle(tools.names),
      t: () => tools.toggle(tools.teeth),
      "?": () => this.open(),
    }[key.toLowerCase()];
    act?.();
    return Boolean(act);
  }
}
