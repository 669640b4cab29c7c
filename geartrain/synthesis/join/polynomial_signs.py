"""Signs of polynomials at very many points, exact: floats decide where they can, integers where they cannot.

Every bound on an output is the sign of a polynomial in the items: N/D <= v is N - v D <= 0 where D > 0. A float64 value
with a bound on its rounding settles nearly all points. Where it does not, the value is small against its terms, and
arithmetic modulo 2^64 gives it exactly as long as it is surely less than 2^63; beyond, Python's integers.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Floats, Ints
from geartrain.numerics.bounded_polynomials import Monomial, sum_and_size
from geartrain.numerics.rounding_bounds import UNIT_ROUNDOFF
from geartrain.synthesis.join.partial_assignments import PartialAssignments

Signs = NDArray[np.int8]

ROUNDING = 2 * UNIT_ROUNDOFF  # twice, so that squares of it need no bound of their own
_WRAP = (1 << 64) - 1  # the lowest 64 bits


@dataclass(frozen=True)
class SignPolynomial:
    """A sum of whole coefficients times monomials in the items; all powers 1 or more."""

    terms: tuple[tuple[int, Monomial], ...]

    @classmethod
    def of(cls, terms: Iterable[tuple[int, Monomial]]) -> SignPolynomial:
        """The sum of some terms."""
        total: dict[Monomial, int] = {}
        for coefficient, monomial in terms:
            total[monomial] = total.get(monomial, 0) + coefficient
        return cls(tuple((value, monomial) for monomial, value in total.items() if value))

    @cached_property
    def items(self) -> tuple[int, ...]:
        """The items it depends on, ascending."""
        return tuple(sorted({item for _, monomial in self.terms for item, _ in monomial}))

    @cached_property
    def scale(self) -> int:
        """The largest coefficient in size; 1 for zero."""
        return max((abs(coefficient) for coefficient, _ in self.terms), default=1)

    @cached_property
    def rounding(self) -> float:
        """`values` are off by less than this times their `sizes`."""
        degree = max((sum(power for _, power in monomial) for _, monomial in self.terms), default=0)
        # an item has three roundings at most and each product one; twice the unit covers squares and the bound itself
        return (4 * degree + len(self.terms) + 8) * ROUNDING

    def degree(self, item: int) -> int:
        """Its highest power of an item."""
        return max((dict(monomial).get(item, 0) for _, monomial in self.terms), default=0)

    def powers(self, item: int) -> tuple[int, ...]:
        """The powers of an item that occur, ascending."""
        return tuple(sorted({dict(monomial).get(item, 0) for _, monomial in self.terms}))

    @property
    def definite(self) -> int:
        """1 or -1 if it has that sign everywhere, because its terms have; 0 if that is not plain."""
        signs = {coefficient > 0 for coefficient, _ in self.terms}
        return (1 if signs.pop() else -1) if len(signs) == 1 else 0

    def split(self, item: int) -> Mapping[int, SignPolynomial]:
        """Power of an item -> its factor, a polynomial in the others."""
        parts: dict[int, list[tuple[int, Monomial]]] = {}
        for coefficient, monomial in self.terms:
            power = dict(monomial).get(item, 0)
            rest = tuple(pair for pair in monomial if pair[0] != item)
            parts.setdefault(power, []).append((coefficient, rest))
        return {power: SignPolynomial(tuple(terms)) for power, terms in sorted(parts.items())}

    def plus(self, other: SignPolynomial, factor: Fraction) -> SignPolynomial:
        """A positive multiple of self + factor * other."""
        mine = ((factor.denominator * coefficient, monomial) for coefficient, monomial in self.terms)
        theirs = ((factor.numerator * coefficient, monomial) for coefficient, monomial in other.terms)
        return SignPolynomial.of((*mine, *theirs))

    def values(self, rows: PartialAssignments, scale: int | None = None) -> tuple[Floats, Floats]:
        """Values over `scale` at some rows, and sizes (the same sum with all signs plus)."""
        over = scale or self.scale
        return sum_and_size(
            (_term(float(Fraction(coefficient, over)), monomial, rows) for coefficient, monomial in self.terms),
            (rows.size,),
        )

    def signs(self, rows: PartialAssignments) -> Signs:
        """Exact signs at some rows, (rows,)."""
        value, size = self.values(rows)
        bound = self.rounding * size
        found: Signs = np.sign(value).astype(np.int8)
        doubtful = np.flatnonzero(np.abs(value) <= bound)
        if len(doubtful):
            found[doubtful] = self._exactly(rows.pick(doubtful), bound[doubtful])
        return found

    def _exactly(self, rows: PartialAssignments, bounds: Floats) -> Signs:
        """Exact signs where the value is at most twice `bounds` (over the scale) in size."""
        # times all denominators: a bound on the whole number that is worked out below
        least: Floats = 2 * bounds * float(self.scale) if self.scale < 10**300 else np.full(rows.size, np.inf)
        for item in self.items:
            bottom = rows.bottom(item)
            if bottom is not None:
                for _ in range(self.degree(item)):
                    least = least * bottom
        found: Signs = np.zeros(rows.size, dtype=np.int8)
        # a factor of two below what int64 holds, for the bound itself is rounded
        short = least < 2.0**62
        found[short] = np.sign(self._wrapped(rows.pick(short))).astype(np.int8)
        for at in np.flatnonzero(~short):
            found[at] = self._sign(rows.pick(np.array([at])))
        return found

    def _wrapped(self, rows: PartialAssignments) -> Ints:
        """The value times denominators, modulo 2^64 as a signed number."""
        # numpy's unsigned integers wrap without a warning; the true value is below 2^63 in size, so the sign is right
        total = np.zeros(rows.size, dtype=np.uint64)
        for coefficient, monomial in self.terms:
            term = np.full(rows.size, coefficient & _WRAP, dtype=np.uint64)
            powers = dict(monomial)
            for item in self.items:
                power = powers.get(item, 0)
                top, bottom = rows.top(item).view(np.uint64), rows.bottom(item)
                for _ in range(power):
                    term *= top
                if bottom is not None:
                    for _ in range(self.degree(item) - power):
                        term *= bottom.view(np.uint64)
            total += term
        return total.view(np.int64)

    def _sign(self, row: PartialAssignments) -> int:
        """The sign at one row, in Python's integers."""
        total = 0
        for coefficient, monomial in self.terms:
            powers = dict(monomial)
            for item in self.items:
                power, bottom = powers.get(item, 0), row.bottom(item)
                coefficient *= int(row.top(item)[0]) ** power
                if bottom is not None:
                    coefficient *= int(bottom[0]) ** (self.degree(item) - power)
            total += coefficient
        return (total > 0) - (total < 0)


def _term(coefficient: float, monomial: Monomial, rows: PartialAssignments) -> Floats:
    term = np.full(rows.size, coefficient)
    for item, power in monomial:
        for _ in range(power):
            term *= rows.x(item)
    return term
