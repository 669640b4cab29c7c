"""Constraints on output speeds, expressed by signs of polynomials, and tests whether they can be satisfied while some
variables are free.

A speed N/D, a quotient of polynomials, is within the relative tolerance t of the requested speed w if |N/D - w| <= t w.
The condition is a disjunction of a few cases, such as D > 0, N - (1-t) w D >= 0, N - (1+t) w D <= 0. Each case is a set
of inequalities sense * polynomial >= 0, where sense is 1 or -1. If only one variable is free, each case admits one
index range of the values of this variable. The ends of the range are determined by exact signs.

If several variables are free, a row (partial assignment) is removed if the sum of the extreme values of all terms,
which bounds the polynomial, violates the constraint.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from math import prod

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Bools, Floats, Ints
from geartrain.numerics.bounded_polynomials import Monomial, sum_and_size
from geartrain.numerics.rounding_bounds import UNIT_ROUNDOFF
from geartrain.search.join.product_lists import PartialAssignments

# A float64 value with a bound of its rounding error decides almost all signs; Python integers decide the rest.

Signs = NDArray[np.int8]

ROUNDING = 2 * UNIT_ROUNDOFF  # doubled, so that second-order terms are covered


@dataclass(frozen=True)
class SignPolynomial:
    """Polynomial in the variables of a join with integer coefficients, whose sign is computed exactly. All powers are
    at least 1.
    """

    terms: tuple[tuple[int, Monomial], ...]

    @classmethod
    def of(cls, terms: Iterable[tuple[int, Monomial]]) -> SignPolynomial:
        """Build a polynomial from terms (coefficient, monomial). Terms with equal monomials are combined."""
        total: dict[Monomial, int] = {}
        for coefficient, monomial in terms:
            total[monomial] = total.get(monomial, 0) + coefficient
        return cls(tuple((value, monomial) for monomial, value in total.items() if value))

    @cached_property
    def items(self) -> tuple[int, ...]:
        """Indices of the variables on which the polynomial depends, in ascending order."""
        return tuple(sorted({item for _, monomial in self.terms for item, _ in monomial}))

    @cached_property
    def scale(self) -> int:
        """Maximum magnitude of the coefficients; 1 for the zero polynomial."""
        return max((abs(coefficient) for coefficient, _ in self.terms), default=1)

    @cached_property
    def rounding(self) -> float:
        """Upper bound of the relative rounding error of `values`: the absolute rounding error of the value of the
        polynomial divided by the sum of the magnitudes of its terms.
        """
        degree = max((sum(power for _, power in monomial) for _, monomial in self.terms), default=0)
        # each variable and each product has one rounding; the remaining terms cover squares and the bound itself
        return (4 * degree + len(self.terms) + 8) * ROUNDING

    def powers(self, item: int) -> tuple[int, ...]:
        """Return the powers of a variable that occur in the polynomial, in ascending order."""
        return tuple(sorted({dict(monomial).get(item, 0) for _, monomial in self.terms}))

    @property
    def definite(self) -> int:
        """Common sign of all terms, which is 1 or -1; 0 if the terms have different signs."""
        signs = {coefficient > 0 for coefficient, _ in self.terms}
        return (1 if signs.pop() else -1) if len(signs) == 1 else 0

    def plus(self, other: SignPolynomial, factor: Fraction) -> SignPolynomial:
        """Return the polynomial `self` + `factor` * `other`, multiplied by the denominator of `factor`, so that its
        coefficients are integers.
        """
        mine = ((factor.denominator * coefficient, monomial) for coefficient, monomial in self.terms)
        theirs = ((factor.numerator * coefficient, monomial) for coefficient, monomial in other.terms)
        return SignPolynomial.of((*mine, *theirs))

    def values(self, rows: PartialAssignments, scale: int | None = None) -> tuple[Floats, Floats]:
        """Return, for each row, the value of the polynomial and the sum of the magnitudes of its terms, both divided by
        `scale`. If `scale` is None, the attribute `scale` is used.
        """
        # scaled, so that large coefficients do not overflow float64
        over = scale or self.scale
        return sum_and_size(
            (_term(float(Fraction(coefficient, over)), monomial, rows) for coefficient, monomial in self.terms),
            (rows.size,),
        )

    def signs(self, rows: PartialAssignments) -> Signs:
        """Return the exact sign of the polynomial for each row, shape (rows,)."""
        value, size = self.values(rows)
        found: Signs = np.sign(value).astype(np.int8)
        doubtful = np.flatnonzero(np.abs(value) <= self.rounding * size)
        if len(doubtful):
            # exact values as Python integers
            few, total = rows.pick(doubtful), np.zeros(len(doubtful), dtype=object)
            for coefficient, monomial in self.terms:
                powers = (few.value(item).astype(object) ** power for item, power in monomial)
                total += prod(powers, start=np.full(len(doubtful), coefficient, dtype=object))
            found[doubtful] = np.sign(total).astype(np.int8)
        return found


def _term(coefficient: float, monomial: Monomial, rows: PartialAssignments) -> Floats:
    term = np.full(rows.size, coefficient)
    for item, power in monomial:
        for _ in range(power):
            term *= rows.x(item)
    return term


# The values of the free variable for which a polynomial keeps its sign are a ray of the sorted values. Divided by
# the lowest power of the variable the polynomial is A y + B, where y is a power of the variable, and changes its sign
# at -B/A, which is found by bisection with exact signs.


Extents = Sequence[tuple[float, float]]
"""Minimum and maximum value of each variable, in the order of their indices."""


@dataclass(frozen=True)
class PolynomialInequality:
    """Inequality sense * polynomial >= 0, or sense * polynomial > 0 if it is strict; `sense` is 1 or -1."""

    polynomial: SignPolynomial
    sense: int
    strict: bool = False

    def met(self, signs: Signs) -> Bools:
        """Return, for each given sign (-1, 0 or 1) of the polynomial, whether the inequality is satisfied."""
        found: Bools = (signs * self.sense > 0) if self.strict else (signs * self.sense >= 0)
        return found

    def possible(self, rows: PartialAssignments, extents: Extents) -> Bools:
        """Return whether each row can satisfy the inequality for some values of its unassigned variables.

        extents   minimum and maximum value of each variable

        Each term is bounded independently, so True may be returned for a row that cannot satisfy the inequality.
        """
        polynomial = self.polynomial
        # a common positive factor keeps the sign, but would widen the bounds
        common = {item: polynomial.powers(item)[0] for item in polynomial.items if item not in rows.columns}
        best, slack = np.zeros(rows.size), 2 * polynomial.rounding
        for coefficient, monomial in polynomial.terms:
            factor, powers = self.sense * float(Fraction(coefficient, polynomial.scale)), dict(monomial)
            # all variables are positive: the largest value of a positive term, the smallest of a negative one
            for item, least in common.items():
                factor *= extents[item][factor > 0] ** (powers.pop(item, 0) - least)
            # rounding errors must not exclude a row
            best += _term(factor + slack * abs(factor), tuple(powers.items()), rows)
        return np.asarray(best >= 0)


def _ray(inequality: PolynomialInequality, rows: PartialAssignments, item: int) -> tuple[Ints, Ints]:
    """Return, for each row, the half-open range of the indices of the values of variable `item` that satisfy one
    inequality. The polynomial changes its sign at most once, so a range that is not empty includes the first or the
    last value.

    The two arrays contain the starts and the ends of the ranges, shape (rows,).
    """
    polynomial, most = inequality.polynomial, len(rows.items[item])

    def met(at: Ints, values: Ints) -> Bools:
        return inequality.met(polynomial.signs(rows.plus(at, item, values)))

    every = np.arange(rows.size)
    before, behind = np.zeros(rows.size, dtype=np.int64), np.full(rows.size, most - 1)
    first, last = met(every, before), met(every, behind)
    # bisection, because the sign changes at most once
    while len(apart := np.flatnonzero((first != last) & (behind - before > 1))):
        middle = (before[apart] + behind[apart]) // 2
        early = met(apart, middle) == first[apart]
        before[apart[early]], behind[apart[~early]] = middle[early], middle[~early]
    return np.where(first, 0, np.where(last, behind, most)), np.where(last, most, np.where(first, behind, most))


@dataclass(frozen=True)
class PolynomialConstraint:
    """Constraint that is a disjunction of mutually exclusive cases. Each case is a conjunction of polynomial
    inequalities.
    """

    name: str
    """Name of the constraint in reports."""
    cases: tuple[tuple[PolynomialInequality, ...], ...]
    function: tuple[SignPolynomial, SignPolynomial] | None = None
    """Numerator and denominator of the constrained function; None if the value of the function is not needed."""

    @cached_property
    def items(self) -> tuple[int, ...]:
        """Indices of the variables on which the constraint depends, in ascending order."""
        polynomials = [*(inequality.polynomial for inequality in self._inequalities), *(self.function or ())]
        return tuple(sorted({item for polynomial in polynomials for item in polynomial.items}))

    @property
    def _inequalities(self) -> Iterable[PolynomialInequality]:
        return (inequality for case in self.cases for inequality in case)

    def has_index_ranges(self, item: int) -> bool:
        """Return whether the method `windows` can be used for variable `item`. This requires that each polynomial
        contains at most two powers of the variable, so that it changes its sign at most once.
        """
        return all(len(inequality.polynomial.powers(item)) <= 2 for inequality in self._inequalities)

    def holds(self, rows: PartialAssignments) -> Bools:
        """Return whether each row satisfies the constraint, by exact arithmetic. All variables of the constraint must
        be assigned.
        """
        # several cases have the same polynomials
        signs = cache(lambda polynomial: polynomial.signs(rows))
        return self._in_any_case(rows, lambda inequality: inequality.met(signs(inequality.polynomial)))

    def possible(self, rows: PartialAssignments, extents: Extents) -> Bools:
        """Return whether each row can satisfy the constraint. False is returned only if the row violates the constraint
        for all values of the unassigned variables.
        """
        return self._in_any_case(rows, lambda inequality: inequality.possible(rows, extents))

    def _in_any_case(self, rows: PartialAssignments, test: Callable[[PolynomialInequality], Bools]) -> Bools:
        found: Bools = np.zeros(rows.size, dtype=np.bool_)
        for case in self.cases:
            met: Bools = np.ones(rows.size, dtype=np.bool_)
            for inequality in case:
                met &= test(inequality)
            found |= met
        return found

    def value(self, rows: PartialAssignments) -> Floats:
        """Return, for each row, the quotient of the two polynomials in `function`, accurate up to rounding errors."""
        assert self.function is not None, "the demand is graded"
        scale = max(side.scale for side in self.function)
        (above, _), (below, _) = (side.values(rows, scale) for side in self.function)
        return np.asarray(above / below)

    def windows(self, rows: PartialAssignments, item: int) -> list[tuple[Ints, Ints]]:
        """Return the ranges of values of variable `item` that satisfy the constraint in each row, as a list with one
        entry for each case in `cases`. The ranges of different cases do not overlap.

        An entry contains two arrays of shape (rows,): the starts and the ends of half-open ranges of indices into
        `rows.items[item]`.
        """
        found = []
        for case in self.cases:
            start, end = np.zeros(rows.size, dtype=np.int64), np.full(rows.size, len(rows.items[item]))
            for inequality in case:
                first, last = _ray(inequality, rows, item)
                start, end = np.maximum(start, first), np.minimum(end, last)
            found.append((start, np.maximum(start, end)))
        return found
