// Exact rational numbers. A float is also rational: an integer of 53 bits divided by a power of two.

const SHORT = 1n << 900n; // longer numbers are shortened before conversion to floats

export class Fraction {
  /** numerator over denominator (BigInt, denominator not 0), in lowest terms. */
  constructor(numerator, denominator = 1n) {
    const sign = denominator < 0n ? -1n : 1n;
    const shared = gcd(numerator < 0n ? -numerator : numerator, sign * denominator);
    this.numerator = (sign * numerator) / shared;
    this.denominator = (sign * denominator) / shared;
  }

  /** From a Fraction, a float (exactly), or text such as `-254/19`, `2.5`, `1e6`. */
  static of(value) {
    if (value instanceof Fraction) return value;
    if (typeof value === "bigint") return new Fraction(value);
    return typeof value === "number" ? fromFloat(value) : fromText(String(value));
  }

  /** The same; null if the text is not a number or is missing. */
  static parse(text) {
    try {
      return text === null || text === undefined ? null : Fraction.of(text);
    } catch {
      return null;
    }
  }

  /** The float rounded to `digits` decimals. */
  static near(value, decimals = 9) {
    return new Fraction(BigInt(Math.round(value * 10 ** decimals)), 10n ** BigInt(decimals));
  }

  plus(other) {
    const { numerator, denominator } = Fraction.of(other);
    return new Fraction(
      this.numerator * denominator + numerator * this.denominator,
      this.denominator * denominator,
    );
  }

  minus(other) {
    const { numerator, denominator } = Fraction.of(other);
    return this.plus(new Fraction(-numerator, denominator));
  }

  times(other) {
    const { numerator, denominator } = Fraction.of(other);
    return new Fraction(this.numerator * numerator, this.denominator * denominator);
  }

  over(other) {
    const { numerator, denominator } = Fraction.of(other);
    return new Fraction(this.numerator * denominator, this.denominator * numerator);
  }

  equals(other) {
    const { numerator, denominator } = Fraction.of(other);
    return this.numerator === numerator && this.denominator === denominator;
  }

  /** The largest integer that is not greater. */
  get floor() {
    const whole = this.numerator / this.denominator;
    return whole * this.denominator > this.numerator ? whole - 1n : whole;
  }

  /** The fractional part, as a float in [0, 1]. */
  get part() {
    return quotient(this.numerator - this.floor * this.denominator, this.denominator);
  }

  valueOf() {
    return quotient(this.numerator, this.denominator);
  }

  toString() {
    return this.denominator === 1n ? `${this.numerator}` : `${this.numerator}/${this.denominator}`;
  }
}

/** The product of speed and turns minus the nearest integer, in [-1/2, 1/2), without a Fraction of the product. */
export function partOfProduct(speed, turns) {
  const denominator = speed.denominator * turns.denominator;
  let rest = (speed.numerator * turns.numerator) % denominator;
  if (2n * rest >= denominator) rest -= denominator;
  else if (2n * rest < -denominator) rest += denominator;
  return quotient(rest, denominator);
}

function quotient(numerator, denominator) {
  if (denominator < SHORT && numerator < SHORT && numerator > -SHORT) return Number(numerator) / Number(denominator);
  const size = (number) => (number < 0n ? -number : number).toString(16).length * 4;
  const most = (number) => BigInt(Math.max(0, size(number) - 200));
  const [above, below] = [most(numerator), most(denominator)];
  const scale = Number(above - below);
  return (Number(numerator >> above) / Number(denominator >> below)) * 2 ** scale;
}

function fromFloat(value) {
  if (!Number.isFinite(value)) throw new RangeError(`${value} is not a number of turns`);
  let exponent = 0;
  while (!Number.isInteger(value)) {
    value *= 2;
    exponent += 1;
  }
  return new Fraction(BigInt(value), 1n << BigInt(exponent));
}

function fromText(text) {
  const found = /^\s*([+-]?)(\d*)(?:\.(\d*))?(?:e([+-]?\d{1,4}))?(?:\s*\/\s*(\d+))?\s*$/i.exec(text.replace("−", "-"));
  if (!found || !(found[2] || found[3])) throw new RangeError(`"${text}" is not a number`);
  const [, sign, whole, decimals = "", power = "0", below = "1"] = found;
  if (BigInt(below) === 0n) throw new RangeError(`"${text}" divides by zero`);
  const exponent = BigInt(power) - BigInt(decimals.length);
  const digits = BigInt(`${whole}${decimals}`) * (sign === "-" ? -1n : 1n);
  const [up, down] = exponent < 0n ? [1n, 10n ** -exponent] : [10n ** exponent, 1n];
  return new Fraction(digits * up, down * BigInt(below));
}

function gcd(a, b) {
  while (b) [a, b] = [b, a % b];
  return a || 1n;
}
