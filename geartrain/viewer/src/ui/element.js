// Elements of the page. Text is inserted as text nodes only, so that texts of a train are never parsed as HTML.

const SVG = "http://www.w3.org/2000/svg";

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : String(value));
  }
  node.append(
    ...children.flat(Infinity).filter((each) => each !== null && each !== undefined && each !== false && each !== ""),
  );
  return node;
}

/** An HTML element: `el('p', {class: 'note'}, 'text', other)`; attributes named `on...` are listeners. */
export function el(tag, attributes, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/** The same in SVG. */
export function svg(tag, attributes, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

/** A link that opens in a new tab; plain text unless the address is http or https. */
export function link(address, text = address) {
  let url = null;
  try {
    url = new URL(address);
  } catch {
    return el("span", {}, text);
  }
  if (!["http:", "https:"].includes(url.protocol)) return el("span", {}, text);
  return el("a", { href: url.href, target: "_blank", rel: "noopener noreferrer" }, text);
}

/** A line drawing for a button: `d` on a field of 24 by 24. */
export function icon(d) {
  return svg(
    "svg",
    { viewBox: "0 0 24 24", class: "icon", "aria-hidden": "true", focusable: "false" },
    svg("path", { d }),
  );
}

/** A labelled control in one line. */
export function field(label, control, attributes = {}) {
  return el("label", { class: "field", ...attributes }, el("span", {}, label), control);
}

/** A part that is folded until it is opened. */
export function more(summary, part, onOpen) {
  return el("details", { class: "more", ontoggle: onOpen }, el("summary", {}, summary), part);
}

let count = 0;

/** An id of its own for labels. */
export const fresh = (stem) => `${stem}-${(count += 1)}`;
