// Handles that the user drags by mouse, finger or arrow keys, in steps that are exact fractions.

import { Fraction } from "../fraction.js";

const TURN = 2 * Math.PI;
const KEYS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 };

/**
 * Makes a part of a picture a slider.
 *
 * plane    group in whose coordinates `moved` receives positions of the pointer
 * label    accessible name
 * value    current value (Fraction); `set` receives a new value, a multiple of 1/`parts`
 * moved    change of the value from one point [x, y] to another
 * text     text of the value
 * page     steps of the page keys; `key`: steps of the arrow keys; `least`, `most`: limits
 */
export function handle(sheet, part, given) {
  const { plane, label, value, set, moved, text, key = 1, page = 15, least = null, most = null } = given;
  part.classList.add("gd-handle");
  for (const [name, said] of [["tabindex", 0], ["role", "slider"], ["aria-label", label]]) part.setAttribute(name, said);
  const to = (units) => {
    const parts = given.parts ?? 360;
    const low = least === null ? -Infinity : Math.ceil(least * parts - 1e-9);
    const high = most === null ? Infinity : Math.floor(most * parts + 1e-9);
    const steps = Math.min(high, Math.max(low, Math.round(units * parts)));
    set(new Fraction(BigInt(steps), BigInt(parts)));
  };
  const own = { refresh };
  sheet.handles.push(own);

  function refresh() {
    part.setAttribute("aria-valuenow", String(Number(value())));
    if (least !== null) part.setAttribute("aria-valuemin", String(least));
    if (most !== null) part.setAttribute("aria-valuemax", String(most));
    part.setAttribute("aria-valuetext", text());
  }

  const at = ({ clientX, clientY }) => {
    const { x, y } = new DOMPoint(clientX, clientY).matrixTransform(plane.getScreenCTM().inverse());
    return [x, y];
  };
  let held = null;
  part.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    part.setPointerCapture(event.pointerId);
    held = { from: at(event), units: Number(value()) };
    part.focus({ preventScroll: true });
    event.preventDefault();
  });
  const follow = (event) => {
    if (!held) return;
    const now = at(event);
    held.units += moved(held.from, now);
    held.from = now;
    to(held.units);
  };
  // Chromium scrolls the page under parts of an SVG picture whatever their touch-action
  part.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });
  part.addEventListener("pointermove", follow);
  part.addEventListener("pointerup", follow); // the position at release counts
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) part.addEventListener(end, () => (held = null));
  part.addEventListener("keydown", (event) => {
    const steps = { PageUp: page, PageDown: -page }[event.key] ?? (KEYS[event.key] ?? 0) * key;
    if (steps) to(Number(value()) + steps / (given.parts ?? 360));
    else if (event.key === "Home") to(0);
    else return;
    event.preventDefault();
  });
}

/** `moved` for rotation about a centre: turns in the shorter direction. */
export const round = (centre) => ([x, y], [u, v]) => {
  const [a, b] = centre();
  const turn = (Math.atan2(v - b, u - a) - Math.atan2(y - b, x - a)) / TURN;
  return turn - Math.round(turn);
};
