// Saves the present picture to a file.
import { drawingOf, pictureOf } from "../still.js";

/** Saves what the sides show as one PNG, called after their trains; where there are plans only, as one SVG. */
export async function savePicture(sides) {
  const drawn = sides.filter(({ stage }) => stage);
  const seen = drawn.filter(({ stage }) => stage.renderer);
  const taken = seen.length ? seen : drawn;
  if (!taken.length) return;
  const stages = taken.map(({ stage }) => stage);
  const names = taken.map(({ scene }) => scene.name);
  saveAs(seen.length ? await pictureOf(stages) : drawingOf(stages), fileName(names, seen.length ? "png" : "svg"));
}

/** The name of a file that shows what has these names. */
export function fileName(names, suffix) {
  const words = [...new Set(names.filter(Boolean))].join("-");
  return `${words.replace(/[^\w.+-]+/g, "-")}.${suffix}`;
}

/** Gives a file to the reader. */
export function saveAs(blob, name) {
  const address = URL.createObjectURL(blob);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
