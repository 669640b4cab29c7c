// Common parts of the diagrams: picture, instructions, choices, and a table of the numbers shown.

import { el, fresh, svg } from "../ui/element.js";
import { shown } from "../ui/number.js";

export const WIDE = 480; // units of the picture; its letters are 16 high, and still legible on a phone

export class Sheet {
  /** host   what the page is to hold it in; `label` names the picture, `hint` says what to drag */
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

  /** A part of the picture in a plane of its own: x to the right, y up, one unit of it as many of the picture's as `across` and `up` say. */
  plane([across, up], [x, y], within = this.picture) {
    const group = svg("g", { transform: `translate(${x} ${y}) scale(${across} ${-up})`, class: "gd-plane" });
    within.append(group);
    return group;
  }

  /** A part of the picture beyond which nothing in it is seen. */
  pane([x, y, width, height]) {
    const pane = svg("svg", { x, y, width, height, overflow: "hidden" });
    this.picture.append(pane);
    return pane;
  }

  /** A field for a curve: `to` gives the place of a point; the curve and what is marked on it are drawn in it. */
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

  /** Words in the picture. */
  write(text, [x, y], attributes = {}) {
    const words = svg("text", { x, y, "text-anchor": "middle", class: "gd-text", ...attributes }, text);
    this.picture.append(words);
    return words;
  }

  /** One of several: `options` are [value, text], `first` the value at the start; `chosen` is called with the new one. */
  choice(label, options, chosen, first = options[0][0]) {
    const name = fresh("gd");
    const buttons = options.map(([value, text]) =>
      el("label", {}, el("input", { type: "radio", name, value, checked: value === first, onchange: () => chosen(value) }), el("span", {}, text)),
    );
    this.bar.append(el("fieldset", {}, el("legend", {}, label), buttons));
  }

  /** Rows of [name, number, ...] under heads; a number is found by the name of its row and the head of its column. */
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

/** Moves something from 0 to 1 in a short while; at once for readers who want nothing to move by itself. */
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
