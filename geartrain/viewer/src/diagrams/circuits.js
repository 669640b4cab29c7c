// Fundamental circuits: a gear pair of the graph lights up its circuit, its carrier and its equation.

import { svg } from "../ui/element.js";
import { Sheet, WIDE } from "./sheet.js";

const HIGH = 360;
const ROOM = 56; // margin of the graph, for names
const SHARES = [0.5, 0.42, 0.58, 0.34, 0.66, 0.27, 0.73]; // positions of a label, relative to the length of its edge

/** data   `trains`, each with places of its links, edges with their curves, and circuits by the name of their pair */
export function circuits(host, { trains }) {
  const sheet = new Sheet(host, {
    height: HIGH,
    label: "The graph of a train: links, turning pairs and gear pairs",
    hint: "Point at a gear pair (heavy line), or focus it with the Tab key, to highlight its circuit.",
  });
  const field = svg("g");
  sheet.picture.append(field);
  const open = (train) => field.replaceChildren(...drawn(train, sheet));
  if (trains.length > 1) sheet.choice("Train", trains.map(({ title }, n) => [n, title]), (n) => open(trains[n]));
  open(trains[0]);
}

function drawn(train, sheet) {
  const to = fitted(Object.values(train.links));
  const taken = Object.entries(train.links).map(([link, place]) => ({ at: to(place), half: halfOf(link) }));
  const edges = train.edges.map((edge) => {
    const [a, b, c] = edge.curve.map(to);
    const curve = svg("path", { d: `M${a.join(" ")}Q${b.join(" ")} ${c.join(" ")}`, class: edge.kind === "revolute" ? "gd-turning" : "gd-gearing" });
    const reach = svg("path", { d: curve.getAttribute("d"), class: "gd-reach" });
    const [x, y] = free(a, b, c, edge.label, taken);
    const words = svg("text", { x, y: y + 5, "text-anchor": "middle", class: "gd-text gd-halo" }, edge.label);
    return { ...edge, words, group: svg("g", {}, curve, reach) };
  });
  const nodes = Object.fromEntries(Object.entries(train.links).map(([link, place]) => [link, vertex(link, to(place), link === train.frame)]));

  function light(name) {
    const circuit = train.circuits[name];
    edges.forEach(({ group, label, kind }, at) => {
      const own = kind !== "revolute" && label === name;
      group.classList.toggle("gd-lit", own || circuit.path.includes(at));
      if (kind !== "revolute") group.setAttribute("aria-pressed", String(own));
    });
    for (const [link, node] of Object.entries(nodes)) node.classList.toggle("gd-carrier", link === circuit.carrier);
    const rows = { circuit: along(train, circuit).join(" \u2013 "), carrier: circuit.carrier, "relative ratio": circuit.ratio };
    sheet.tell(Object.entries(rows), [name]);
    sheet.say(circuit.equation.replaceAll(" - ", " \u2212 ").replace(/^-/, "\u2212"));
  }

  for (const { group, words, label, kind } of edges) {
    if (kind === "revolute") continue;
    for (const [key, value] of [["tabindex", 0], ["role", "button"], ["aria-label", `Gear pair ${label}`], ["class", "gd-choice"]]) group.setAttribute(key, value);
    words.classList.add("gd-choice");
    for (const event of ["pointerenter", "click", "focus"]) for (const part of [group, words]) part.addEventListener(event, () => light(label));
  }
  light(Object.keys(train.circuits)[0]);
  return [...edges.map(({ group }) => group), ...Object.values(nodes), ...edges.map(({ words }) => words)];
}

/** Position of a label on its curve, as near the middle as possible without touching vertices and other labels. */
function free(a, b, c, label, taken) {
  const half = 4 + 4.2 * label.length;
  const spots = SHARES.map((t) => [0, 1].map((k) => (1 - t) ** 2 * a[k] + 2 * t * (1 - t) * b[k] + t ** 2 * c[k]));
  const under = ([x, y]) =>
    taken.reduce((sum, { at: [u, v], half: other }) => sum + Math.max(0, half + other - Math.abs(x - u)) * Math.max(0, 24 - Math.abs(y - v)), 0);
  const at = spots.reduce((best, spot) => (under(spot) < under(best) ? spot : best)).map((value) => Number(value.toFixed(2)));
  taken.push({ at, half });
  return at;
}

/** Half the width of a vertex, from its name. */
const halfOf = (link) => [...link].reduce((sum, letter) => sum + (letter === letter.toLowerCase() ? 4.4 : 6.2), 7);

/** The links of a circuit in cyclic order, from the link of one of its wheels. */
function along(train, { ends, path }) {
  const links = [ends[0]];
  const named = ([x, y]) => Object.entries(train.links).find(([, [u, v]]) => Math.hypot(u - x, v - y) < 1e-3)[0];
  for (const at of path) {
    const [from, , to] = train.edges[at].curve.map((point, n) => (n === 1 ? null : named(point)));
    links.push(from === links.at(-1) ? to : from);
  }
  return [...links, ends[0]];
}

function vertex(link, [x, y], framed) {
  const half = halfOf(link);
  const shape = svg("rect", { x: x - half, y: y - 14, width: 2 * half, height: 28, rx: framed ? 0 : 14, class: "gd-link" });
  return svg("g", { "data-link": link }, shape, svg("text", { x, y: y + 5, "text-anchor": "middle", class: "gd-text" }, link));
}

/** Inches to the picture, the y axis up. */
function fitted(places) {
  const [xs, ys] = [0, 1].map((k) => places.map((place) => place[k]));
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const scale = Math.min((WIDE - 2 * ROOM) / (right - left || 1), (HIGH - 2 * ROOM) / (high - low || 1));
  const round = (value) => Number(value.toFixed(2));
  return ([x, y]) => [round(WIDE / 2 + scale * (x - (left + right) / 2)), round(HIGH / 2 - scale * (y - (low + high) / 2))];
}
