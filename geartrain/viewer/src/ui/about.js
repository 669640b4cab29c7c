// General information on a train: note, simplifications of the picture, sources.
import { el, link } from "./element.js";

function notice(each) {
  return el(
    "li",
    {},
    el("strong", {}, each.what),
    each.why && `: ${each.why}`,
    each.fix && el("span", { class: "quiet" }, ` ${each.fix}`),
    each.place && el("span", { class: "quiet" }, ` (${each.place})`),
  );
}

function source([key, each]) {
  const { cite, url, ...rest } = each;
  return el(
    "li",
    { id: `source-${key}` },
    el("strong", {}, key),
    cite && ` ${cite}`,
    url && [" ", link(url)],
    Object.values(rest).map((more) => el("span", { class: "quiet" }, ` ${more}`)),
  );
}

function movement(scene) {
  if (scene.run && !scene.touching) return el("p", {}, "All angles are those of a simulation with inertia, backlash and friction, to 0.006 degrees.");
  const { kind, why } = scene.movement;
  const words = {
    exact: "All angles are exact: rational multiples of the turns of the crank.",
    real: "Mean speeds are exact; the deviations caused by teeth and pins were computed in advance.",
    mean: "Only mean motion is shown; the motion of teeth and pins could not be computed.",
    still: "The train does not move.",
  };
  return el("p", {}, words[kind] ?? "", why && ` ${why}`);
}

export function about(side, many) {
  const { scene } = side;
  const sources = Object.entries(scene.sources);
  return el(
    "article",
    {},
    el("h3", {}, many ? side.label : scene.name),
    el("p", {}, `${scene.verdict.kind}: ${scene.verdict.text}`),
    scene.note && el("p", {}, scene.note),
    el(
      "p",
      { class: "quiet" },
      `${[[scene.wheels, "wheel"], [scene.pairs, "gear pair"], [scene.couplings, "pin"]].filter(([{ length }]) => length).map(([{ length }, noun]) => `${length} ${noun}${length === 1 ? "" : "s"}`).join(", ")}.`,
      scene.unit && ` Speeds in ${scene.unit}.`,
    ),
    movement(scene),
    scene.notices.length
      ? [el("h4", {}, "Simplifications of the picture"), el("ul", { class: "notices" }, scene.notices.map(notice))]
      : null,
    el("h4", {}, "Sources"),
    sources.length
      ? el("ul", { class: "sources" }, sources.map(source))
      : el("p", { class: "quiet" }, "No sources are given."),
  );
}
