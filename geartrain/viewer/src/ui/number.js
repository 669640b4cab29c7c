// Exact numbers as they are typed and shown.
import { Fraction } from "../fraction.js";

const LONGEST = 60; // maximum number of characters of a typed number

/** A number from typed text; null if it is too long or too large. */
export function typed(text) {
  return text.trim().length > LONGEST || /e[+-]?\d{3,}/i.test(text) ? null : Fraction.parse(text);
}

/** Exact text with a typographic minus sign, for display; copied text keeps the hyphen. */
export const shown = (text) => String(text).replace(/^-/, "\u2212");

/** Number rounded to `places` decimals, with separated thousands and without trailing zeros. */
export function decimal({ numerator, denominator }, places = 4) {
  const scale = 10n ** BigInt(places);
  const size = numerator < 0n ? -numerator : numerator;
  const rounded = (2n * size * scale + denominator) / (2n * denominator);
  const part = String(rounded % scale)
    .padStart(places, "0")
    .replace(/0+$/, "");
  const above = String(rounded / scale).replace(/\B(?=(\d{3})+$)/g, "\u202f");
  return (numerator < 0n && rounded ? "\u2212" : "") + above + (part ? `.${part}` : "");
}

/** Text of a number of turns, with the exact fraction if it is short. */
export function turns(at) {
  const short = at.denominator !== 1n && at.denominator < 10000n && at.toString().length <= 14;
  return short ? `${decimal(at)} = ${shown(at)}` : decimal(at);
}
