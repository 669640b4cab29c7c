// The verdict on a train; a loop that locks it is shown in red after a click.
import { el } from "./element.js";

/** Names of the pairs of a loop and indices of its wheels; without pairs, its bodies. */
export function loopParts(scene, loop) {
  const pairs = scene.pairs.filter((pair) => (loop.pairs ?? []).includes(pair.id));
  return {
    pairs: pairs.map((pair) => pair.id),
    wheels: [...new Set(pairs.flatMap((pair) => pair.wheels))],
    bodies: pairs.length
      ? []
      : scene.bodies.flatMap((body, index) => ((loop.links ?? []).includes(body.id) ? [index] : [])),
  };
}

/** Brakes and clutches with the bodies that they hold or connect, engaged ones filled; a click highlights the bodies. */
function elements({ scene }, onElement) {
  if (!scene.elements?.length) return null;
  return el(
    "ul",
    { class: "elements", "aria-label": "brakes and clutches" },
    scene.elements.map((each) =>
      el(
        "li",
        {},
        el(
          "button",
          {
            type: "button",
            class: each.closed ? "element closed" : "element",
            title: each.text,
            "aria-label": `${each.text}, ${each.closed ? "closed" : "open"}`,
            onclick: () => onElement(each),
          },
          each.one_way ? `${each.id} \u21bb` : each.id, // which way it holds is in its title
        ),
      ),
    ),
  );
}

export function verdict(side, many, onLoop, onElement) {
  const { kind, text, loops = [] } = side.scene.verdict;
  const bad = kind !== "determined";
  return el(
    "div",
    { class: bad ? "verdict bad" : "verdict", "data-verdict": kind },
    bad && el("p", {}, many && el("span", {}, `${side.label}: `), el("strong", {}, kind), text && text !== kind && ` ${text}`),
    loops.length
      ? el(
          "ul",
          { class: "loops" },
          loops.map((loop) =>
            el(
              "li",
              {},
              el(
                "button",
                { type: "button", class: "loop", onclick: () => onLoop(side, loop) },
                loop.text || (loop.pairs ?? loop.links ?? []).join(", "),
              ),
            ),
          ),
        )
      : null,
    elements(side, (each) => onElement(side, each)),
  );
}
