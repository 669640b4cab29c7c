// Common parts of the diagrams: picture, instructions, choices, and a table of the numbers shown.

import { el, fresh, svg } from "../ui/element.js";
import { shown } from "../ui/number.js";

export const WIDE = 480; // width in units of the picture; letters are 16 units high, and legible on a phone

export class Sheet {
  /** host   element that contains the sheet; `label`: name of the picture; `hint`: instruction what to drag */
  constructor(host, { height, label, hint }) {
    this.picture = svg("svg", { viewBox: `0 0 ${WIDE} ${height}`, role: "group", "aria-label": label, class: "gd-picture" });
    this.height = height;
    this.bar = el("div", { class: "gd-bar" });
    this.table = el("table", { class: "gd-reading" });
    this.remark = el("p", { class: "gd-remark", "aria-live": "polite" });
    this.handles = [];
    const side = el("div", { class: "gd-side" }, el("p", { class: "gd-hint" }, hint), this.bar, this.table, this.remark);
    host.append(el("div", { class: "gd-live" }, this.picture, side));
  }

  /** A group with its own coordinates: x to the right, y up; one unit is `across` and `up` units of the picture. */
  plane([across, up], [x, y], within = this.picture) {
    const group = svg("g", { transform: `translate(${x} ${y}) scale(${across} ${-up})`, class: "gd-plane" });
    within.append(group);
    return group;
  }

  /** A clipped part of the picture. */
  pane([x, y, width, height]) {
    const pane = svg("svg", { x, y, width, height, overflow: "hidden" });
    this.picture.append(pane);
    return pane;
  }

  /** A chart for a curve; `to` converts a point to its position in the picture. */
  chart([x, y, width, height], [left, right], [low, high]) {
    const to = ([u, v]) => [x + (width * (u - left)) / (right - left), y + height - (height * (v - low)) / (high - low)];
    this.picture.append(svg("path", { d: `M${x} ${y}V${y + height}H${x + width}`, class: "gd-axis" }));
    const line = (points, attributes) => {
      const drawn = svg("path", { d: `M${points.map((point) => to(point).map((each) => each.toFixed(2)).join(" ")).join("L")}`, class: "gd-curve", ...attributes });
      this.picture.append(drawn);
      return drawn;
    };
    return { to, line };
  }

  /** Writes text in the picture. */
  write(text, [x, y], attributes = {}) {
    const words = svg("text", { x, y, "text-anchor": "middle", class: "gd-text", ...attributes }, text);
    this.picture.append(words);
    return words;
  }

  /** A choice: `options` are [value, text], `first` is the initial value; `chosen` is called with a new value. */
  choice(label, options, chosen, first = options[0][0]) {
    const name = fresh("gd");
    const buttons = options.map(([value, text]) =>
      el("label", {}, el("input", { type: "radio", name, value, checked: value === first, onchange: () => chosen(value) }), el("span", {}, text)),
    );
    this.bar.append(el("fieldset", {}, el("legend", {}, label), buttons));
  }

  /** Shows rows of [name, number, ...] below column heads. */
  tell(rows, heads) {
    const head = heads.length > 1 ? el("tr", {}, el("td"), heads.map((each) => el("th", { scope: "col" }, each))) : null;
    const line = ([name, ...values]) =>
      el("tr", {}, el("th", { scope: "row" }, name), values.map((value, n) => el("td", { "data-of": name, "data-as": heads[n] }, shown(value))));
    this.table.replaceChildren(...[head, ...rows.map(line)].filter(Boolean));
    for (const each of this.handles) each.refresh();
  }

  /** A sentence below; read aloud only when it changes. */
  say(text) {
    if (this.remark.textContent !== text) this.remark.textContent = text;
  }
}

/** Calls `step` with values that increase to 1 in a short time; only with 1 for users who prefer reduced motion. */
export function glide(step) {
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) return step(1);
  const begin = performance.now();
  const next = (now) => {
    const share = Math.min(1, Math.max(0, (now - begin) / 450));
    step(share * share * (3 - 2 * share));
    if (share < 1) requestAnimationFrame(next);
  };
  requestAnimationFrame(next);
}
