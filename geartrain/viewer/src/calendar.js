// Exact dates and Julian days, as in geartrain/train/periods.py: years are astronomical (0 is 1 BC), a day begins at
// midnight, and years are counted from March, so that the leap day is the last day of a year.

import { Fraction } from "./fraction.js";

const MONTHS = ["January", "February", "March", "April", "May", "June", "July", "August", "September", "October", "November", "December"];
const REFORM = new Fraction(4598321n, 2n); // 1582-10-15 (Gregorian), the day after 1582-10-04 (Julian)
const MARCH = { julian: new Fraction(3442235n, 2n), gregorian: new Fraction(3442239n, 2n) }; // midnight before 0000-03-01
const MOST_YEARS = 10n ** 9n;
const ISO = /^([+-]?\d{1,10})-(\d{1,2})-(\d{1,2})(?:[T ](\d{1,2}):(\d{2}))?$/;
const WORDS = /^(\d{1,2})\.? +([a-z]{3,9})\.? +(\d{1,10})(?: *(bc|bce|ad|ce))?(?:,? +(\d{1,2}):(\d{2}))?$/i;

const below = (a, b) => (a - (((a % b) + b) % b)) / b; // divided, and rounded down
const least = (a, b) => (a < b ? a : b);

/** The Julian day of {year, month, day (BigInt), part of the day (Fraction), calendar}. */
export function julianDay({ year, month, day, part, calendar }) {
  const shifted = (month + 9n) % 12n;
  const own = year - (month < 3n ? 1n : 0n);
  const days = 365n * own + below(own, 4n) + (153n * shifted + 2n) / 5n + day - 1n;
  const centuries = calendar === "gregorian" ? below(own, 400n) - below(own, 100n) : 0n;
  return MARCH[calendar].plus(days + centuries).plus(part);
}

/** The date of a Julian day; without a given calendar, Julian before the reform and Gregorian from then on. */
export function dateOf(julian, given = null) {
  const calendar = given ?? (julian.minus(REFORM).numerator < 0n ? "julian" : "gregorian");
  const since = julian.minus(MARCH[calendar]);
  const whole = since.floor;
  const [year, rest] = calendar === "gregorian" ? ofGregorian(whole) : ofJulian(whole);
  const month = (5n * rest + 2n) / 153n;
  return {
    year: year + (month > 9n ? 1n : 0n),
    month: ((month + 2n) % 12n) + 1n,
    day: rest - (153n * month + 2n) / 5n + 1n,
    part: since.minus(whole),
    calendar,
  };
}

function ofJulian(days) {
  const fours = below(days, 1461n);
  const rest = days - 1461n * fours;
  const years = least(rest / 365n, 3n);
  return [4n * fours + years, rest - 365n * years];
}

function ofGregorian(days) {
  const rounds = below(days, 146097n);
  const rest = days - 146097n * rounds;
  const hundreds = least(rest / 36524n, 3n);
  const [years, left] = ofJulian(rest - 36524n * hundreds);
  return [400n * rounds + 100n * hundreds + years, left];
}

/** A date from text such as `-204-05-12`, `2000-01-01 18:30` or `12 May 205 BC`, at noon without a time; null for other text. */
export function readDate(text, given = null) {
  const found = parts(text.trim().replace("\u2212", "-"));
  if (!found) return null;
  const [year, month, day, hour, minute] = found;
  if (year > MOST_YEARS || -year > MOST_YEARS || Number(hour ?? 0) > 23 || Number(minute ?? 0) > 59) return null;
  const part = hour === undefined ? new Fraction(1n, 2n) : new Fraction(60n * BigInt(hour) + BigInt(minute), 1440n);
  const early = year < 1582n || (year === 1582n && (month < 10n || (month === 10n && day < 15n)));
  const date = { year, month, day, part, calendar: given ?? (early ? "julian" : "gregorian") };
  const back = dateOf(julianDay(date), given);
  const same = ["year", "month", "day", "calendar"].every((key) => back[key] === date[key]);
  return same ? date : null;
}

function parts(text) {
  const iso = ISO.exec(text);
  if (iso) return [BigInt(iso[1].replace("+", "")), BigInt(iso[2]), BigInt(iso[3]), iso[4], iso[5]];
  const said = WORDS.exec(text);
  if (!said) return null;
  const month = MONTHS.findIndex((name) => name.toLowerCase().startsWith(said[2].toLowerCase())) + 1;
  const year = BigInt(said[3]);
  return [/^b/i.test(said[4] ?? "") ? 1n - year : year, BigInt(month), BigInt(said[1]), said[5], said[6]];
}

/** `12 May 205 BC, 18:30`. */
export function inWords({ year, month, day, part }) {
  const minutes = part.times(1440n).floor;
  const clock = [minutes / 60n, minutes % 60n].map((each) => String(each).padStart(2, "0")).join(":");
  const counted = year > 0n ? (year < 1000n ? `${year} AD` : year) : `${1n - year} BC`;
  return `${day} ${MONTHS[Number(month) - 1]} ${counted}, ${clock}`;
}

/** Conversion between turns of the driving link and dates, for a scene with an epoch. */
export class Epoch {
  constructor({ julian_day: day, turns, days, calendar, source, note, unset }) {
    Object.assign(this, { calendar, source, note, known: !unset.length }); // `known`: all pointers of a zodiac are set
    [this.day, this.turns, this.days] = [day, turns, days].map((each) => Fraction.of(each));
  }

  /** Julian day of a number of turns. */
  dayAt(turns) {
    return this.day.plus(turns.minus(this.turns).times(this.days));
  }

  dateAt(turns) {
    return dateOf(this.dayAt(turns), this.calendar);
  }

  turnsAt(date) {
    return this.turns.plus(julianDay(date).minus(this.day).over(this.days));
  }

  read(text) {
    return readDate(text, this.calendar);
  }
}
