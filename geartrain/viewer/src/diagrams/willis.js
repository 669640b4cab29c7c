// Willis' inversion: the same motion relative to the frame and to the carrier, where the ratio is fixed.

import { BRASS, PARTS } from "../colours.js";
import { Fraction } from "../fraction.js";
import { Machine } from "../motion.js";
import { svg } from "../ui/element.js";
import { shown } from "../ui/number.js";
import { handle, round } from "./handle.js";
import { rimOf, wheelPath } from "./outline.js";
import { Sheet, WIDE, glide } from "./sheet.js";

const DEGREES = 180 / Math.PI;
const GROUND = "relative to the frame";
const ARM = "relative to the carrier";

/** data   `scene` with links `sun`, `ring`, `carrier`, `planet`; `held`: speeds of all links by the fixed link */
export function willis(host, { scene, held, sun, ring, carrier, planet }) {
  const sheet = new Sheet(host, {
    height: 480,
    label: "A sun, a planet and a ring that can be turned",
    hint: "Drag the carrier, the sun or the ring, or turn the focused member with the arrow keys.",
  });
  const index = (link) => scene.bodies.findIndex(({ id }) => id === link);
  const machines = Object.fromEntries(Object.entries(held).map(([link, speeds]) => [link, new Machine(turningAs(scene, speeds))]));
  const state = { held: ring, share: 0 }; // 0: relative to the ground; 1: relative to the carrier
  const scale = WIDE / 2 / (1.05 * rimOf(scene.wheels.find(({ kind }) => kind === "ring")));
  const view = sheet.plane([scale, scale], [WIDE / 2, 240]);
  const root = svg("g");
  view.append(root);
  const { nodes, arm } = draw(scene, root, index(carrier), index(planet));

  const speed = (link) => machines[state.held].speeds[index(link)];
  const turns = (link) => speed(link).times(machines[state.held].turns);
  const seen = () => (state.share > 0.5 ? carrier : null);
  const relative = (link) => (seen() ? turns(link).minus(turns(carrier)) : turns(link));

  function show() {
    const machine = machines[state.held];
    nodes.forEach((node, body) => {
      const [x, y] = scene.bodies[body].point;
      if (scene.bodies[body].parent !== null) node.setAttribute("transform", `rotate(${DEGREES * machine.joint(body)} ${x} ${y})`);
    });
    const back = DEGREES * machine.angle(index(carrier));
    root.setAttribute("transform", `rotate(${-state.share * back})`);
    const links = [sun, planet, ring, carrier];
    sheet.tell(links.map((link) => [link, `${turns(link)}`, `${turns(link).minus(turns(carrier))}`]), [GROUND, ARM]);
    const [above, below] = [sun, ring].map((link) => turns(link).minus(turns(carrier)));
    sheet.say(
      below.equals(0)
        ? "All numbers are turns."
        : `All numbers are turns. Relative to the carrier, ${sun} : ${ring} = ${shown(above)} : ${shown(below)} = ${shown(above.over(below))}, in every position and with any member fixed.`,
    );
  }

  const parts = { [sun]: nodes[index(sun)], [ring]: nodes[index(ring)], [carrier]: arm };
  for (const [link, part] of Object.entries(parts)) {
    handle(sheet, part, {
      plane: view,
      label: `Turn the ${link}`,
      value: () => relative(link),
      set(wanted) {
        const gain = speed(link).minus(seen() ? speed(carrier) : 0);
        if (!gain.equals(0)) machines[state.held].turns = wanted.over(gain);
        show();
      },
      moved: round(() => [0, 0]),
      text: () => `${relative(link)} turns`,
      key: 5,
    });
  }
  sheet.choice("Seen", [["ground", GROUND], ["carrier", ARM]], (value) => {
    const from = state.share;
    glide((part) => {
      state.share = from + part * ((value === "carrier" ? 1 : 0) - from);
      show();
    });
  });
  sheet.choice("Held", [ring, sun, carrier].map((link) => [link, link]), (link) => {
    state.held = link;
    machines[link].turns = Fraction.of(0);
    show();
  });
  machines[ring].turns = Fraction.of("1/12").over(speed(carrier));
  show();
}

/** The scene with other speeds by link, relative to the driving link. */
const turningAs = (scene, speeds) => ({ ...scene, bodies: scene.bodies.map((body) => ({ ...body, speed: speeds[body.id] })) });

/** Draws each body as a group within the group of its parent. */
function draw(scene, root, carrier, planet) {
  const nodes = scene.bodies.map(() => svg("g"));
  const arm = svg("g", { class: "gd-arm", style: `color: ${PARTS.arm}` });
  scene.bodies.forEach(({ parent }, body) => (parent === null ? root : nodes[parent]).append(nodes[body]));
  scene.wheels.forEach((wheel, n) => {
    const [x, y] = wheel.centre;
    const shape = wheelPath(wheel, scene.profiles[wheel.profile]);
    const mark = wheel.kind === "ring" ? [wheel.root + 0.4 * wheel.module, rimOf(wheel) - 0.2 * wheel.module] : [2.4 * wheel.module, wheel.root];
    const line = svg("line", { x1: mark[0], x2: mark[1], class: "gd-mark", transform: `rotate(${DEGREES * wheel.turn})` });
    nodes[wheel.body].append(svg("g", { transform: `translate(${x} ${y})`, style: `color: ${BRASS[n % BRASS.length]}` }, shape, line));
  });
  const [x, y] = scene.bodies[planet].point;
  arm.append(
    svg("line", { x1: 0, y1: 0, x2: x, y2: y, class: "gd-bar-line" }),
    svg("circle", { r: 2.6, class: "gd-boss" }),
    svg("circle", { cx: x, cy: y, r: 2.6, class: "gd-boss" }),
  );
  nodes[carrier].append(arm);
  root.append(nodes[carrier]); // on top
  return { nodes, arm };
}
