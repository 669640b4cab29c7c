// The path from the input to an output: its pairs in order, as text.
import { el } from "./element.js";

/** Pairs and couplings of a pointer in order, each with its wheels and its circuit. */
export function stations(scene, pointer) {
  return pointer.pairs.map((id) => {
    const pair = scene.pairs.find((each) => each.id === id);
    if (pair) {
      const wheels = pair.wheels.map((index) => scene.wheels[index]);
      return {
        id,
        words: wheels.map((wheel) => `${wheel.id} (${wheel.teeth})`).join(" with "),
        text: pair.text,
        wheel: pair.wheels[0],
      };
    }
    const coupling = scene.couplings.find((each) => each.id === id);
    return { id, words: coupling ? coupling.kind.replaceAll("_", " ") : id, text: coupling?.text ?? "", wheel: null };
  });
}

export class Path {
  constructor({ onPair, onClose }) {
    this.onPair = onPair;
    this.onClose = onClose;
    this.node = el("section", { class: "path", hidden: true, "aria-label": "path" });
  }

  /** found: [{side, pointer}] for each displayed train with this output */
  show(output, found) {
    const close = el("button", { type: "button", class: "small", onclick: () => this.onClose() }, "Clear path");
    const head = el("div", { class: "row" }, el("h3", {}, `${title(found[0])} to ${output}`), close);
    this.node.replaceChildren(head, ...found.flatMap((each) => this.#way(each, found.length > 1)));
    this.node.hidden = false;
  }

  #way({ side, pointer }, many) {
    const steps = stations(side.scene, pointer);
    const base = side.scene.bodies[pointer.base];
    const said = [pointer.text, base?.parent != null && `relative to ${base.id}`, pointer.note]
      .filter(Boolean)
      .join("; ");
    return [
      el("p", { class: "quiet" }, many && `${side.label}: `, said),
      steps.length
        ? el(
            "ol",
            { class: "steps", "data-side": side.label },
            steps.map((step) => this.#step(side, step)),
          )
        : el("p", { class: "quiet" }, "There are no pairs on the path."),
    ];
  }

  #step(side, { id, words, text, wheel }) {
    const press = () => this.onPair(side, wheel);
    const inner = wheel === null ? words : el("button", { type: "button", class: "plain", onclick: press }, words);
    return el("li", { "data-pair": id, title: text }, inner);
  }

  hide() {
    this.node.hidden = true;
    this.node.replaceChildren();
  }
}

const title = ({ side: { scene } }) => `From ${scene.driving_link === null ? "the input" : scene.bodies[scene.driving_link].id}`;
