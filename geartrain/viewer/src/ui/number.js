// Exact numbers as they are typed and shown.
import { Fraction } from "../fraction.js";

const LONGEST = 60; // characters of a number that is typed

/** What a reader typed, short enough and not too large to be worked with; else null. */
export function typed(text) {
  return text.trim().length > LONGEST || /e[+-]?\d{3,}/i.test(text) ? null : Fraction.parse(text);
}

/** Exact text with a proper minus sign, as it is shown; what is copied keeps the plain one. */
export const shown = (text) => String(text).replace(/^-/, "\u2212");

/** Rounded to `places` decimals, thousands apart, trailing zeros off. */
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

/** Turns in words: with the exact fraction where that is short. */
export function turns(at) {
  const short = at.denominator !== 1n && at.denominator < 10000n && at.toString().length <= 14;
  return short ? `${decimal(at)} = ${shown(at)}` : decimal(at);
}
