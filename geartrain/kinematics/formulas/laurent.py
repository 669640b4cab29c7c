"""Laurent polynomials in tooth counts (sums of monomials with integer exponents of either sign), and their divisors.

Tooth counts are positive, so every monomial is a unit: it never vanishes, and division by it is exact. Common divisors
are computed from pseudo-remainders in one variable after another. The formulas of trains are short if wheels are
grouped.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import NamedTuple

Exponents = tuple[int, ...]

MOST_PRODUCTS = 200_000
"""Maximum number of products of terms in one operation, which takes seconds."""


class Term(NamedTuple):
    """Term of a polynomial: an integer coefficient times a product of powers of the variables."""

    coefficient: int
    exponents: Exponents


class TooLongError(Exception):
    """Error that is raised if an operation on polynomials requires more than `MOST_PRODUCTS` products of terms."""


@dataclass(frozen=True, slots=True)
class Laurent:
    """Laurent polynomial in `width` variables with rational coefficients. Equal polynomials compare equal."""

    width: int
    terms: Mapping[Exponents, Fraction]
    """Non-zero coefficient of each term, by the tuple of its exponents."""

    @classmethod
    def constant(cls, value: Fraction | int, width: int) -> Laurent:
        """Return a constant as a Laurent polynomial in `width` variables."""
        return cls(width, {(0,) * width: Fraction(value)} if value else {})

    @classmethod
    def variable(cls, at: int, width: int) -> Laurent:
        """Return the variable with index `at` as a polynomial in `width` variables."""
        return cls(width, {tuple(int(other == at) for other in range(width)): Fraction(1)})

    @classmethod
    def of(cls, terms: Iterable[Term], width: int) -> Laurent:
        """Return the polynomial that is the sum of the given terms; several terms may have the same exponents."""
        total: dict[Exponents, Fraction] = {}
        for coefficient, exponents in terms:
            total[exponents] = total.get(exponents, Fraction(0)) + coefficient
        return cls(width, {exponents: value for exponents, value in total.items() if value})

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __len__(self) -> int:
        return len(self.terms)

    def __neg__(self) -> Laurent:
        return Laurent(self.width, {exponents: -value for exponents, value in self.terms.items()})

    def __add__(self, other: Laurent) -> Laurent:
        return Laurent(self.width, _sum(dict(self.terms), other.terms.items(), 1))

    def __sub__(self, other: Laurent) -> Laurent:
        return Laurent(self.width, _sum(dict(self.terms), other.terms.items(), -1))

    def __mul__(self, other: Laurent) -> Laurent:
        if len(self) * len(other) > MOST_PRODUCTS:
            raise TooLongError
        total: dict[Exponents, Fraction] = {}
        for left, factor in self.terms.items():
            moved = ((tuple(map(int.__add__, left, right)), value) for right, value in other.terms.items())
            _sum(total, moved, factor)
        return Laurent(self.width, total)

    @property
    def is_unit(self) -> bool:
        """True if the polynomial has exactly one term, so that division by it is exact."""
        return len(self.terms) == 1

    @property
    def is_constant(self) -> bool:
        """True if no variable occurs with a non-zero exponent."""
        return not any(any(exponents) for exponents in self.terms)

    @property
    def is_definite(self) -> bool:
        """True if all coefficients have the same sign, so that the polynomial has no zero at positive tooth counts."""
        return len({value > 0 for value in self.terms.values()}) == 1

    def inverse(self) -> Laurent:
        """Return the inverse of a unit, which is a polynomial with one term."""
        ((exponents, value),) = self.terms.items()
        return Laurent(self.width, {tuple(-power for power in exponents): 1 / value})

    def modulo(self, point: Sequence[int], prime: int) -> int:
        """Return the value at `point` modulo a prime; the elements of `point` are residues other than 0."""
        total = 0
        for exponents, value in self.terms.items():
            product = value.numerator * pow(value.denominator, -1, prime)
            for base, power in zip(point, exponents, strict=True):
                if power:
                    product = product * pow(base, power, prime) % prime
            total += product
        return total % prime

    def lowest(self) -> Exponents:
        """Return the minimum exponent of each variable, as in the largest monomial that divides all terms."""
        return tuple(map(min, zip(*self.terms, strict=True))) if self.terms else (0,) * self.width

    def shifted(self, by: Exponents) -> Laurent:
        """Return the product of the polynomial and the monomial with the exponents `by`."""
        return Laurent(
            self.width, {tuple(map(int.__add__, exponents, by)): value for exponents, value in self.terms.items()}
        )

    def scaled(self, factor: Fraction) -> Laurent:
        """Return the product of the polynomial and a non-zero number."""
        return Laurent(self.width, {exponents: value * factor for exponents, value in self.terms.items()})

    def content(self, *others: Laurent) -> Fraction:
        """Return the content: the positive rational number by which all coefficients of this polynomial and of `others`
        are divided to become coprime integers.
        """
        values = [value for each in (self, *others) for value in each.terms.values()]
        return Fraction(math.gcd(*(v.numerator for v in values)), math.lcm(*(v.denominator for v in values)))

    def lowered(self) -> Laurent:
        """Return this polynomial times the monomial for which the minimum exponent of each variable is 0."""
        return self.shifted(tuple(-power for power in self.lowest()))

    def primitive(self) -> Laurent:
        """Return the primitive part: this polynomial multiplied by a number and a monomial for which the minimum
        exponents become 0 and the coefficients become coprime integers.
        """
        return self.lowered().scaled(1 / self.content()) if self.terms else self

    def sorted_terms(self) -> tuple[Term, ...]:
        """Return the terms of this polynomial, which has integer coefficients, sorted by descending exponents."""
        return tuple(Term(int(self.terms[exponents]), exponents) for exponents in sorted(self.terms, reverse=True))


def _sum(
    total: dict[Exponents, Fraction], terms: Iterable[tuple[Exponents, Fraction]], factor: Fraction | int
) -> dict[Exponents, Fraction]:
    """Add `factor` times the terms to `total` in place, and return `total`. Terms that cancel are removed."""
    for exponents, value in terms:
        known = total.get(exponents)
        new = factor * value if known is None else known + factor * value
        if new:
            total[exponents] = new
        else:
            total.pop(exponents, None)
    return total


def product(factors: Iterable[Laurent], width: int) -> Laurent:
    """Return the product of polynomials in `width` variables; the product of no polynomials is 1."""
    return reduce(Laurent.__mul__, factors, Laurent.constant(1, width))


def minors(rows: Sequence[Mapping[int, Laurent]], width: int) -> list[Laurent]:
    """Return the n + 1 determinants that are obtained from n rows with n + 1 columns by omitting one column at a time.

    The method is dynamic programming over the rows, with one partial sum for each set of used columns (a bit mask). No
    division is required, and sparse rows reach few of the 2^n sets. Raises `TooLongError` if `MOST_PRODUCTS` is
    exceeded.
    """
    partial = {0: Laurent.constant(1, width)}
    work = 0
    for row in rows:
        found: dict[int, Laurent] = {}
        for used, value in partial.items():
            for column, entry in row.items():
                if used >> column & 1 or not entry:
                    continue
                work += len(value) * len(entry)
                if work > MOST_PRODUCTS:
                    raise TooLongError
                # sign of the permutation: number of used columns to the right
                step = -(value * entry) if (used >> (column + 1)).bit_count() & 1 else value * entry
                mask = used | 1 << column
                found[mask] = found[mask] + step if mask in found else step
        partial = {mask: value for mask, value in found.items() if value}
    everything = (2 << len(rows)) - 1
    zero = Laurent.constant(0, width)
    return [partial.get(everything ^ 1 << column, zero) for column in range(len(rows) + 1)]


def divide(p: Laurent, q: Laurent) -> Laurent | None:
    """Return p / q if the non-zero polynomial q divides p exactly; None if it does not."""
    if q.is_unit:
        return p * q.inverse()
    rest, divisor = dict(p.lowered().terms), q.lowered().terms
    # tuples compare lexicographically: a monomial order that multiplication preserves
    lead = max(divisor)
    found: dict[Exponents, Fraction] = {}
    while rest:
        top = max(rest)
        step = tuple(map(int.__sub__, top, lead))
        if min(step, default=0) < 0:
            return None
        if len(found) * len(divisor) > MOST_PRODUCTS:
            raise TooLongError
        factor = found[step] = rest[top] / divisor[lead]
        for exponents, value in divisor.items():
            at = tuple(map(int.__add__, exponents, step))
            new = rest.pop(at, Fraction(0)) - factor * value
            if new:
                rest[at] = new
    return Laurent(p.width, found).shifted(tuple(map(int.__sub__, p.lowest(), q.lowest())))


def divide_exactly(p: Laurent, q: Laurent) -> Laurent:
    """Return p / q for a polynomial q that divides p."""
    found = divide(p, q)
    assert found is not None, "the divisor divides the polynomial"
    return found


def common_divisor(p: Laurent, q: Laurent) -> Laurent:
    """Return the primitive greatest common divisor of two Laurent polynomials; 1 if they are coprime. It is found by
    Euclid's algorithm with primitive remainders over the rationals, in one variable after another.
    """
    p, q = p.primitive(), q.primitive()
    if not p or not q:
        return p if p else q
    shared = [at for at in range(p.width) if _degree(p, at) and _degree(q, at)]
    if not shared:
        return Laurent.constant(1, p.width)
    # tried first, because one polynomial often divides the other
    for whole, other in ((p, q), (q, p)):
        if len(whole) <= len(other) and divide(other, whole) is not None:
            return whole
    # Euclid's algorithm needs the fewest steps in the variable of lowest degree
    return _remainders(p, q, min(shared, key=lambda at: min(_degree(p, at), _degree(q, at))))


def _remainders(p: Laurent, q: Laurent, at: int) -> Laurent:
    """Return the product of the greatest common divisors of the contents and of the primitive parts in `at`."""
    content_p, content_q = _content(p, at), _content(q, at)
    content = common_divisor(content_p, content_q)
    p, q = divide_exactly(p, content_p), divide_exactly(q, content_q)
    if _degree(p, at) < _degree(q, at):
        p, q = q, p
    while True:
        rest = _pseudo_remainder(p, q, at)
        if not rest:
            return (content * q).primitive()
        # a non-zero remainder without the variable: only the contents have a common divisor
        if not _degree(rest, at):
            return content
        p, q = q, divide_exactly(rest, _content(rest, at)).primitive()


def _pseudo_remainder(p: Laurent, q: Laurent, at: int) -> Laurent:
    """Return the pseudo-remainder of p divided by q, both regarded as polynomials in the variable `at`."""
    degree = _degree(q, at)
    lead = _coefficient(q, at, degree)
    while p and _degree(p, at) >= degree:
        high = _degree(p, at)
        step = tuple((high - degree) * (other == at) for other in range(p.width))
        p = p * lead - (q * _coefficient(p, at, high)).shifted(step)
    return p


def _content(p: Laurent, at: int) -> Laurent:
    """Return the content of p as a polynomial in the variable `at`: the common divisor of its coefficients."""
    found = Laurent.constant(0, p.width)
    for power in {exponents[at] for exponents in p.terms}:
        found = common_divisor(found, _coefficient(p, at, power))
        # a common divisor only gets smaller, so further coefficients cannot change it
        if found.is_constant:
            break
    return found


def _coefficient(p: Laurent, at: int, power: int) -> Laurent:
    chosen = {exponents: value for exponents, value in p.terms.items() if exponents[at] == power}
    return Laurent(p.width, chosen).shifted(tuple(-power * (other == at) for other in range(p.width)))


def _degree(p: Laurent, at: int) -> int:
    return max(exponents[at] for exponents in p.terms) if p else 0
