// The picture as it stands, to a file of the reader's.
import { drawingOf, pictureOf } from "../still.js";

/** Saves what the sides show as one PNG, called after their trains; where there are plans only, as one SVG. */
export async function savePicture(sides) {
  const drawn = sides.filter(({ stage }) => stage);
  const seen = drawn.filter(({ stage }) => stage.renderer);
  const taken = seen.length ? seen : drawn;
  if (!taken.length) return;
  const stages = taken.map(({ stage }) => stage);
  const address = URL.createObjectURL(seen.length ? await pictureOf(stages) : drawingOf(stages));
  const link = document.createElement("a");
  link.href = address;
  link.download = `${[...new Set(taken.map(({ scene }) => scene.name))].join("-").replace(/[^\w.+-]+/g, "-")}.${seen.length ? "png" : "svg"}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
