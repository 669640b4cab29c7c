// The verdict on a train; a loop that holds it still is named in red, and a click shows it.
import { el } from "./element.js";

/** Pairs of a loop by name and its wheels by index; where it has no pairs, its bodies. */
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

/** Brakes and clutches: what each holds or joins, the closed ones filled; a click shows it. */
function elements({ scene }, onElement) {
  if (!scene.elements?.length) return null;
  const names = (bodies) => bodies.map((index) => scene.bodies[index].id).join(" and ");
  return el(
    "ul",
    { class: "elements", "aria-label": "brakes and clutches" },
    scene.elements.map((each) => {
      const does = `${each.kind === "brake" ? "brakes" : "joins"} ${names(each.bodies)}`;
      return el(
        "li",
        {},
        el(
          "button",
          {
            type: "button",
            class: each.closed ? "element closed" : "element",
            title: does,
            "aria-label": `${each.id} ${does}, ${each.closed ? "closed" : "open"}`,
            onclick: () => onElement(each),
          },
          each.id,
        ),
      );
    }),
  );
}

export function verdict(side, many, onLoop, onElement) {
  const { kind, text, loops = [] } = side.scene.verdict;
  const bad = kind !== "determined";
  return el(
    "div",
    { class: bad ? "verdict bad" : "verdict", "data-verdict": kind },
    el("p", {}, many && el("span", {}, `${side.label}: `), el("strong", {}, kind), text && text !== kind && ` ${text}`),
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
