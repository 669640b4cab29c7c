// Saves the present picture to a file.
import { drawingOf, pictureOf } from "../still.js";

/** Saves the pictures of the sides as one PNG, named after their trains; if they are plans, as one SVG. */
export async function savePicture(sides) {
  const drawn = sides.filter(({ stage }) => stage);
  const seen = drawn.filter(({ stage }) => stage.renderer);
  const taken = seen.length ? seen : drawn;
  if (!taken.length) return;
  const stages = taken.map(({ stage }) => stage);
  const names = taken.map(({ scene }) => scene.name);
  saveAs(seen.length ? await pictureOf(stages) : drawingOf(stages), fileName(names, seen.length ? "png" : "svg"));
}

/** A file name from the names of trains. */
export function fileName(names, suffix) {
  const words = [...new Set(names.filter(Boolean))].join("-");
  return `${words.replace(/[^\w.+-]+/g, "-")}.${suffix}`;
}

/** Saves a file in the browser. */
export function saveAs(blob, name) {
  const address = URL.createObjectURL(blob);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
