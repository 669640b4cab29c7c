"""Laurent polynomials in tooth counts: exact sums of monomials whose exponents may be negative.

Tooth counts are positive, so every monomial is a unit: it can be divided by, and it never vanishes.
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
"""Products of terms in one step past which polynomials are too long to be of use; some seconds."""


class Term(NamedTuple):
    """A whole coefficient times a product of powers; exponents stand in parallel to wheels, or to groups."""

    coefficient: int
    exponents: Exponents


class TooLongError(Exception):
    """A polynomial has grown past every use."""


@dataclass(frozen=True, slots=True)
class Laurent:
    """A sum of rational coefficients times monomials in `width` variables. Equal polynomials compare equal.

    terms   exponents -> coefficient, none of them 0
    """

    width: int
    terms: Mapping[Exponents, Fraction]

    @classmethod
    def constant(cls, value: Fraction | int, width: int) -> Laurent:
        """A number."""
        return cls(width, {(0,) * width: Fraction(value)} if value else {})

    @classmethod
    def variable(cls, at: int, width: int) -> Laurent:
        """The variable with index `at`."""
        return cls(width, {tuple(int(other == at) for other in range(width)): Fraction(1)})

    @classmethod
    def of(cls, terms: Iterable[Term], width: int) -> Laurent:
        """The sum of some terms."""
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
        """True for a single monomial, which can be divided by."""
        return len(self.terms) == 1

    @property
    def is_constant(self) -> bool:
        """True for a number."""
        return not any(any(exponents) for exponents in self.terms)

    @property
    def is_definite(self) -> bool:
        """True if it never vanishes for positive counts, because all its terms have one sign."""
        return len({value > 0 for value in self.terms.values()}) == 1

    def inverse(self) -> Laurent:
        """1 over a unit."""
        ((exponents, value),) = self.terms.items()
        return Laurent(self.width, {tuple(-power for power in exponents): 1 / value})

    def modulo(self, point: Sequence[int], prime: int) -> int:
        """The value modulo a prime, at residues other than 0."""
        total = 0
        for exponents, value in self.terms.items():
            product = value.numerator * pow(value.denominator, -1, prime)
            for base, power in zip(point, exponents, strict=True):
                if power:
                    product = product * pow(base, power, prime) % prime
            total += product
        return total % prime

    def lowest(self) -> Exponents:
        """The least power of every variable: of all monomials that divide it, the greatest."""
        return tuple(map(min, zip(*self.terms, strict=True))) if self.terms else (0,) * self.width

    def shifted(self, by: Exponents) -> Laurent:
        """Times the monomial with exponents `by`."""
        return Laurent(
            self.width, {tuple(map(int.__add__, exponents, by)): value for exponents, value in self.terms.items()}
        )

    def scaled(self, factor: Fraction) -> Laurent:
        """Times a number other than 0."""
        return Laurent(self.width, {exponents: value * factor for exponents, value in self.terms.items()})

    def content(self, *others: Laurent) -> Fraction:
        """The positive rational that leaves whole coefficients without a common divisor, here and in `others`."""
        values = [value for each in (self, *others) for value in each.terms.values()]
        return Fraction(math.gcd(*(v.numerator for v in values)), math.lcm(*(v.denominator for v in values)))

    def primitive(self) -> Laurent:
        """The simplest multiple by a unit: powers from 0 up, whole coefficients with no common divisor."""
        if not self.terms:
            return self
        return self.shifted(tuple(-power for power in self.lowest())).scaled(1 / self.content())

    def sorted_terms(self) -> tuple[Term, ...]:
        """The terms of a polynomial with whole coefficients, highest powers first."""
        return tuple(Term(int(self.terms[exponents]), exponents) for exponents in sorted(self.terms, reverse=True))


def _sum(
    total: dict[Exponents, Fraction], terms: Iterable[tuple[Exponents, Fraction]], factor: Fraction | int
) -> dict[Exponents, Fraction]:
    """total += factor * terms in place, dropping what cancels."""
    for exponents, value in terms:
        known = total.get(exponents)
        new = factor * value if known is None else known + factor * value
        if new:
            total[exponents] = new
        else:
            total.pop(exponents, None)
    return total


def product(factors: Iterable[Laurent], width: int) -> Laurent:
    """The product of some polynomials; 1 of none."""
    return reduce(Laurent.__mul__, factors, Laurent.constant(1, width))


def minors(rows: Sequence[Mapping[int, Laurent]], width: int) -> list[Laurent]:
    """The determinants of n rows and n + 1 columns, one for each column left out; the others keep their order.

    Row by row, one partial sum for each set of columns used so far (a set of bits): no division, and sparse rows
    reach few of the 2^n sets. Raises `TooLongError` past `MOST_PRODUCTS`.
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
                # the columns used before that stand right of this one: as many swaps
                step = -(value * entry) if (used >> (column + 1)).bit_count() & 1 else value * entry
                mask = used | 1 << column
                found[mask] = found[mask] + step if mask in found else step
        partial = {mask: value for mask, value in found.items() if value}
    everything = (2 << len(rows)) - 1
    zero = Laurent.constant(0, width)
    return [partial.get(everything ^ 1 << column, zero) for column in range(len(rows) + 1)]
