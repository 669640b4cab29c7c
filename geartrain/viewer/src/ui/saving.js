// The picture as it stands, to a file of the reader's.
import { pictureOf } from "../still.js";

/** Saves what the sides show as one PNG, called after their trains; nothing where there are plans only. */
export async function savePicture(sides) {
  const seen = sides.filter(({ stage }) => stage?.renderer);
  if (!seen.length) return;
  const address = URL.createObjectURL(await pictureOf(seen.map(({ stage }) => stage)));
  const link = document.createElement("a");
  link.href = address;
  link.download = `${[...new Set(seen.map(({ scene }) => scene.name))].join("-").replace(/[^\w.+-]+/g, "-")}.png`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
