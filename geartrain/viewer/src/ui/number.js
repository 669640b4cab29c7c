// Exact numbers as they are typed, rounded and shown.
import { Fraction } from "../fraction.js";

export { Fraction };
const LONGEST = 60; // characters of a number that is typed

/** From `235/19`, `1e6`, `-2.5`; null where the text is no number. */
export function parse(text) {
  try {
    return text === null || text === undefined ? null : Fraction.of(text);
  } catch {
    return null;
  }
}

/** What a reader typed, short enough and not too large to be worked with; else null. */
export function typed(text) {
  const number = text.trim().length > LONGEST || /e[+-]?\d{3,}/i.test(text) ? null : parse(text);
  return number;
}

/** The float rounded to a billionth: fine enough for a hand at a crank, and its digits stay few. */
export const near = (number) => new Fraction(BigInt(Math.round(number * 1e9)), 1000000000n);
export const whole = (number) => new Fraction(BigInt(number));
export const minus = (a, b) => a.plus(b.times(whole(-1)));
export const over = (a, b) => new Fraction(a.numerator * b.denominator, a.denominator * b.numerator);

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
