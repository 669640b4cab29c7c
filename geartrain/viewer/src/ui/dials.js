// The dials of a train, each with the readings of its hands.
import { NEEDLES } from "../colours.js";
import { el } from "./element.js";
import { Dial } from "./dial.js";
import { linksInWords } from "./outputs.js";
import { Reading, told } from "./reading.js";

const MANY = 4; // number of names from which a dial is as wide as possible
const PLAIN = 12; // maximum number of plain faces, if the train declares no dials

/** Dials with their hands; outputs without a dial get plain faces where the train declares no dial at all. */
function gathered(scene, machine) {
  const all = scene.pointers.map((_, index) => new Reading(scene, machine, index));
  const declared = scene.dials
    .map((dial) => ({ name: dial.title, dial, hands: all.filter((each) => each.dial === dial) }))
    .filter(({ hands }) => hands.length);
  if (declared.length) return declared;
  // a link that slides has no hand
  return all.filter(({ travels }) => !travels).slice(0, PLAIN).map((each) => ({ name: each.pointer.output, dial: null, hands: [each] }));
}

class Card {
  constructor({ name, dial, hands }, onChoose) {
    this.hands = hands;
    this.dial = new Dial(name, dial, hands);
    this.values = hands.map(() => el("span", { class: "value" }));
    const rows = hands.map((hand, row) =>
      el(
        "li",
        {},
        el(
          "button",
          {
            type: "button",
            class: "plain",
            onclick: () => onChoose(hand.pointer.output),
            "aria-label": `highlight the path to ${hand.pointer.output}`,
          },
          el("span", { class: `key hand-${hand.order % NEEDLES.length}`, "aria-hidden": "true" }),
          hand.pointer.output,
        ),
        this.values[row],
      ),
    );
    const scale =
      dial && dial.scale.divisions > 1 ? `${dial.scale.divisions} ${dial.scale.cell}s${dial.scale.turns > 1 ? ` on ${dial.scale.turns} turns` : ""}` : "";
    this.node = el(
      "figure",
      { class: dial?.scale.names.length > MANY ? "card wide" : "card" },
      this.dial.node,
      el(
        "figcaption",
        {},
        el("strong", {}, name),
        scale && el("span", { class: "quiet" }, ` ${scale}`),
        dial && dial.look === "scale" && !dial.placed && el("span", { class: "quiet" }, `${scale && ","} layout computed`),
        dial?.note && el("span", { class: "quiet said" }, dial.note),
        el("ul", { class: "hands" }, rows),
      ),
    );
  }

  set(words) {
    this.dial.set();
    if (words) this.hands.forEach((hand, order) => (this.values[order].textContent = told(hand.now)));
  }
}

export class Dials {
  /** `sides` as in `side.js`; `onChoose(output)`. */
  constructor(sides, onChoose) {
    this.cards = [];
    this.node = el("div", { class: "dials" });
    for (const side of sides) {
      const cards = gathered(side.scene, side.machine).map((each) => new Card(each, onChoose));
      this.cards.push(...cards);
      if (sides.length > 1) this.node.append(el("h3", {}, side.label));
      if (!side.scene.asks) this.node.append(el("p", { class: "quiet" }, linksInWords(side.scene, PLAIN)));
      this.node.append(
        el(
          "div",
          { class: "cards" },
          cards.map((card) => card.node),
        ),
      );
    }
  }

  set(words) {
    if (this.node.isConnected && this.node.offsetParent) for (const card of this.cards) card.set(words);
  }
}
