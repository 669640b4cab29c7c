// The differential from the side: the user drags both axle shafts, and the crown turns by half their sum.

import { BRASS, PARTS } from "../colours.js";
import { Fraction, partOfProduct } from "../fraction.js";
import { blankOf } from "../tooth.js";
import { svg } from "../ui/element.js";
import { shown } from "../ui/number.js";
import { handle } from "./handle.js";
import { path } from "./outline.js";
import { Sheet, WIDE } from "./sheet.js";

const TURN = 2 * Math.PI;
const MADE = "turns";
const SCALE = 10.5;
const CREST = 1.08; // relative radius at which teeth are drawn
const ONE = Fraction.of(1);

/** data   `scene`; `shares`, the turns of every link for a turn of each side; names of the crown and the spider */
export function differential(host, { scene, shares, crown, spider }) {
  const sheet = new Sheet(host, {
    height: 480,
    label: "A differential seen from the side",
    hint: "Drag the left or the right wheel up and down, or turn the focused wheel with the arrow keys.",
  });
  const sides = Object.keys(shares);
  const made = Object.fromEntries(sides.map((side) => [side, Fraction.of(0)]));
  const middle = scene.bodies.find(({ id }) => id === spider).point[0];
  const view = sheet.plane([-SCALE, SCALE], [WIDE / 2 + SCALE * middle * 0.7, 240]); // seen from behind, so that left is left
  const solids = new Solids(scene, crown, spider);
  const turns = (link) => sides.reduce((sum, side) => sum.plus(made[side].times(shares[side][link])), Fraction.of(0));

  const shafts = sides.map((side) => {
    const { centre, facing } = scene.wheels[solids.of(side)];
    return svg("line", { x1: centre[0] - facing, x2: centre[0] + 12 * facing, class: "gd-shaft" });
  });
  const groups = solids.parts.map(({ wheel, colour, body }) => {
    const nodes = { body: svg("path", { class: "gd-wheel" }), teeth: svg("path", { class: "gd-teeth" }), mark: svg("path", { class: "gd-first" }) };
    return { ...nodes, wheel, group: svg("g", { style: `color: ${colour}`, "data-link": scene.bodies[body].id }, Object.values(nodes)) };
  });
  view.append(...shafts, ...groups.map(({ group }) => group));
  sides.forEach((side, n) => {
    const { centre, facing } = scene.wheels[solids.of(side)];
    const at = [WIDE / 2 + SCALE * (middle * 0.7 - centre[0] - 10.5 * facing), 225];
    sheet.write(side, at, { "data-side": n });
  });

  sheet.write(crown, [WIDE / 2 + SCALE * middle * 0.7, 18]);

  function show() {
    const joints = solids.joints(turns);
    const drawn = groups.map((nodes, n) => ({ nodes, ...solids.drawn(n, joints) }));
    for (const { nodes, hull, lines, first } of drawn) {
      nodes.body.setAttribute("d", hull);
      nodes.teeth.setAttribute("d", lines);
      nodes.mark.setAttribute("d", first);
    }
    const order = [...drawn].sort((one, other) => other.depth - one.depth).map(({ nodes }) => nodes.group);
    stack(view, order);
    const planet = turns(spider).minus(turns(crown));
    sheet.tell([...sides, crown].map((link) => [link, `${turns(link)}`]).concat([["spider on the crown", `${planet}`]]), [MADE]);
    const [left, right] = sides.map((side) => shown(made[side]));
    sheet.say(`The ${crown} turns by half the sum of both sides: (${left} + ${right.startsWith("\u2212") ? `(${right})` : right}) / 2 = ${shown(turns(crown))} turns.`);
  }

  for (const side of sides) {
    const wheel = scene.wheels[solids.of(side)];
    handle(sheet, groups.find((each) => each.wheel === wheel).group, {
      plane: view,
      label: `Turn the ${side} wheel`,
      value: () => made[side],
      set: (turned) => ((made[side] = turned), show()),
      moved: ([, y], [, v]) => (v - y) / (TURN * wheel.radius), // direction of the side that faces the reader
      text: () => `${made[side]} turns`,
      key: 5,
    });
  }
  made[sides[0]] = Fraction.of("1/8");
  show();
}

/** Orders groups, the last on top; the focused group is not moved, because it would lose the focus. */
function stack(view, order) {
  const still = order.findIndex((group) => group.matches(":focus"));
  order.forEach((group, n) => {
    if (n < still) view.insertBefore(group, order[still]);
    else if (n > still) view.append(group);
  });
}

/** The wheels in space, seen along z from below. */
class Solids {
  constructor(scene, crown, spider) {
    this.scene = scene;
    const on = (link) => scene.bodies.findIndex(({ id }) => id === link);
    const shaft = scene.pairs.flatMap(({ wheels, carrier }) => (carrier === 0 ? wheels : [])).find((at) => scene.wheels[at].body !== on(crown));
    const wheels = scene.wheels.filter((_, at) => at !== shaft); // without the shaft that drives the crown
    this.parts = wheels.map((wheel, n) => ({ wheel, body: wheel.body, colour: wheel.body === on(crown) ? PARTS.arm : BRASS[n % BRASS.length] }));
    const reach = Math.max(...wheels.filter(({ body }) => scene.bodies[body].parent === on(crown)).map(({ centre }) => Math.abs(centre[1]))) + 2;
    const [x] = scene.bodies[on(spider)].point;
    for (const side of [1, -1]) this.parts.push({ cage: [[0, side * reach, 0], [x, side * reach, 0], [x, 0, 0]], body: on(crown), colour: PARTS.arm });
  }

  of(link) {
    return this.scene.wheels.findIndex(({ body }) => this.scene.bodies[body].id === link);
  }

  /** Angle of every body relative to its parent (rad). */
  joints(turns) {
    const angles = this.scene.bodies.map(({ id, sense }) => sense * TURN * partOfProduct(turns(id), ONE));
    return this.scene.bodies.map(({ parent }, body) => (parent === null ? 0 : angles[body] - angles[parent]));
  }

  /** Current position of a point of a body. */
  place(point, body, joints) {
    let at = point;
    for (let now = body; now !== null; now = this.scene.bodies[now].parent) at = turned(at, this.scene.bodies[now], joints[now]);
    return at;
  }

  /** Paths of the outline, the visible teeth and the first tooth, and the depth of a part. */
  drawn(n, joints) {
    const { wheel, body, cage } = this.parts[n];
    const place = (point) => this.place(point, body, joints);
    if (cage) {
      const points = cage.map(place);
      const thick = hull(points.flatMap(([x, y]) => [[x - 0.9, y - 0.9], [x + 0.9, y - 0.9], [x + 0.9, y + 0.9], [x - 0.9, y + 0.9]]).slice(0, 8));
      const pin = hull(points.slice(1).flatMap(([x, y]) => [[x - 0.35, y], [x + 0.35, y]]));
      return { hull: path(thick) + path(pin), lines: "", first: "", depth: points[1][2] * 1.3 };
    }
    const surface = blankOf(wheel, -wheel.facing);
    const across = cross(wheel.direction, wheel.reference);
    const at = (angle, end) => {
      const [x, y, z] = surface(CREST, wheel.turn + angle, end);
      return place([0, 1, 2].map((k) => wheel.centre[k] + x * wheel.reference[k] + y * across[k] + z * wheel.direction[k]));
    };
    const rounds = Array.from({ length: 48 }, (_, k) => (TURN * k) / 48);
    const edge = hull([0, 1].flatMap((end) => rounds.map((angle) => at(angle, end))));
    const teeth = Array.from({ length: wheel.teeth }, (_, k) => (TURN * k) / wheel.teeth);
    const axis = place(wheel.centre);
    const line = (angle) => {
      const [a, b] = [at(angle, 0), at(angle, 1)];
      const normal = facing(a, b, at(angle + 0.01, 0), axis);
      return normal < 0 ? `M${a[0].toFixed(2)} ${a[1].toFixed(2)}L${b[0].toFixed(2)} ${b[1].toFixed(2)}` : "";
    };
    return { hull: path(edge), lines: teeth.map(line).join(""), first: line(0), depth: axis[2] };
  }
}

/** Component along the view of the normal of three points, away from an inner point; negative towards the reader. */
function facing(a, b, c, inside) {
  const minus = (p, q) => [0, 1, 2].map((k) => p[k] - q[k]);
  const normal = cross(minus(b, a), minus(c, a));
  const out = minus(a, inside);
  return normal[2] * Math.sign(normal[0] * out[0] + normal[1] * out[1] + normal[2] * out[2]);
}

const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];

/** A point turned about a body's axis (Rodrigues). */
function turned(at, { point, direction }, angle) {
  const from = at.map((value, k) => value - point[k]);
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const along = from.reduce((sum, value, k) => sum + value * direction[k], 0);
  const side = cross(direction, from);
  return from.map((value, k) => point[k] + value * cos + side[k] * sin + direction[k] * along * (1 - cos));
}

/** The convex hull of points in the plane (Andrew's monotone chain). */
function hull(points) {
  const sorted = points.map(([x, y]) => [x, y]).sort(([a, b], [x, y]) => a - x || b - y);
  const left = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const half = (list) => {
    const chain = [];
    for (const point of list) {
      while (chain.length > 1 && left(chain.at(-2), chain.at(-1), point) <= 0) chain.pop();
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}
