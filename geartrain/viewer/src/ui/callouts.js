// Names of parts beside the picture, with lines to the parts; names of hands have the colours of the hands.
import { NEEDLES } from "../colours.js";
import { labelsOf } from "../aim.js";
import { svg } from "./element.js";

const [EDGE, LINE] = [10, 19]; // distance from the edge, and between two names [px]

export class Callouts {
  constructor(stage) {
    this.stage = stage;
    this.node = svg("svg", { class: "callouts", "aria-hidden": "true" });
    stage.onDraw = () => this.#draw();
  }

  show(shown) {
    this.shown = shown;
    this.node.toggleAttribute("hidden", !shown);
    if (shown) this.stage.request();
  }

  /** Creates the names of a train; again after its counts have changed. */
  #write(world) {
    this.world = world;
    this.labels = labelsOf(world.scene).map((label) => {
      const name = svg("text", {}, label.name);
      const way = svg("path", {});
      const group = svg("g", { class: label.order === null ? "" : `hand-${label.order % NEEDLES.length}` }, way, name);
      return { ...label, text: name, way, group };
    });
    this.node.replaceChildren(...this.labels.map(({ group }) => group));
  }

  #draw() {
    const { world, camera, width, height } = this.stage;
    if (!this.shown || !this.node.isConnected) return;
    if (this.world !== world) this.#write(world);
    const seen = this.labels.map((label) => {
      const at = label.faces(camera.position) ? label.at(world).project(camera) : null;
      const inside = at && Math.abs(at.x) < 1 && Math.abs(at.y) < 1;
      return inside ? { label, x: ((at.x + 1) / 2) * width, y: ((1 - at.y) / 2) * height } : null;
    });
    this.labels.forEach(({ group }, n) => group.toggleAttribute("hidden", !seen[n]));
    const found = seen.filter(Boolean).sort((one, other) => one.x - other.x);
    const middle = Math.ceil(found.length / 2); // as many names on the left as on the right
    this.#column(found.slice(0, middle), false);
    this.#column(found.slice(middle), true);
  }

  /** Places names at one edge in the order of their parts, so that they do not overlap. */
  #column(found, right) {
    const { width, height } = this.stage;
    found.sort((one, other) => one.y - other.y);
    let next = LINE;
    for (const each of found) next = (each.place = Math.max(each.y, next)) + LINE;
    let last = height - LINE / 2;
    for (const each of found.toReversed()) last = (each.place = Math.min(each.place, last)) - LINE;
    for (const { label, x, y, place } of found) {
      label.long ||= label.text.getComputedTextLength();
      const [edge, end] = right ? [width - EDGE, width - EDGE - label.long - 5] : [EDGE, EDGE + label.long + 5];
      label.text.setAttribute("x", edge);
      label.text.setAttribute("y", place.toFixed(1));
      label.text.setAttribute("text-anchor", right ? "end" : "start");
      label.way.setAttribute("d", `M${end.toFixed(1)} ${(place - 4).toFixed(1)}L${x.toFixed(1)} ${y.toFixed(1)}`);
    }
  }
}
