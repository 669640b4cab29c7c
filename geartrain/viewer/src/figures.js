// Figures as strokes, for scales: each in a field one wide and one high, its middle at the origin.

// the corners of an eight, and the strokes of each figure between them
const CORNERS = { a: [-0.28, 0.5], b: [0.28, 0.5], c: [0.28, 0], d: [0.28, -0.5], e: [-0.28, -0.5], f: [-0.28, 0], i: [0, 0.5], j: [0, -0.5] };
const FIGURES = ["abdea", "ij", "abcfed", "abcfcde", "afcbd", "bafcde", "bafedcf", "abj", "abdeafc", "cfabde"];
const WIDE = 0.86;

/** The strokes of a number: pairs of points. */
export function figure(text) {
  return [...text].flatMap((letter, n) => {
    const strokes = FIGURES[letter] ?? "";
    const off = WIDE * (n - (text.length - 1) / 2);
    const place = (corner) => [CORNERS[corner][0] + off, CORNERS[corner][1]];
    return [...strokes].slice(1).map((corner, k) => [place(strokes[k]), place(corner)]);
  });
}
