"""Quotients of two polynomials in float64, with bounds on the error, and their range over boxes.

Everything here takes the monomials of the groups (positive floats, arrays that broadcast) and terms with exponents
parallel to them. Error bounds are a priori ones: n roundings in a term change it by at most n u / (1 - n u) of
itself, u = 2^-53 (Higham, Accuracy and Stability of Numerical Algorithms, section 3.1).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.formulas.laurent import Term

Floats = NDArray[np.float64]

_U = 2.0**-53
_SLACK = 1 + 1e-6
"""Covers the roundings of the bounds themselves, and the squares that first-order bounds leave out."""
_TINY = 1e-280
"""Terms below this are near the end of float64, where relative errors are not bounded."""


class EnclosedSum(NamedTuple):
    """A polynomial's value and a bound on its absolute error; the bound is infinite outside the range of float64."""

    value: Floats
    error: Floats


class EnclosedQuotient:
    """upper / lower in float64.

    upper, lower   terms, exponents parallel to the groups
    roundings      roundings already in each group's monomial
    """

    def __init__(self, upper: Sequence[Term], lower: Sequence[Term], roundings: Sequence[int]) -> None:
        # both are divided by the largest coefficient, which may itself be beyond the range of float64
        self._largest = max((abs(term.coefficient) for term in (*upper, *lower)), default=1)
        self._upper, self._lower, self._roundings = upper, lower, roundings

    def values(self, monomials: Sequence[Floats]) -> Floats:
        """The quotient alone."""
        with np.errstate(all="ignore"):
            value = self._total(self._upper, monomials) / self._total(self._lower, monomials)
        return np.asarray(value, dtype=np.float64)

    def accuracy(self, monomials: Sequence[Floats]) -> Floats:
        """A bound on the relative error of `values`: |computed - exact| <= accuracy |exact|."""
        with np.errstate(all="ignore"):
            top, bottom = self._sum(self._upper, monomials), self._sum(self._lower, monomials)
            up = top.error / (np.abs(top.value) - top.error)
            down = bottom.error / np.abs(bottom.value)
            bound = _SLACK * (up + down + up * down + 2 * _U)
            sure = (np.abs(top.value) > top.error) & (np.abs(bottom.value) > bottom.error)
            if not self._upper and self._lower:
                bound, sure = np.zeros_like(bound), np.abs(bottom.value) > bottom.error
        return np.where(sure & np.isfinite(bound), bound, np.inf)

    def range_at_corners(self, lows: Sequence[Floats], highs: Sequence[Floats]) -> tuple[Floats, Floats]:
        """Range over boxes of monomials, for degree 1 in each: least and greatest value at the corners.

        The denominator is then linear in each monomial, so it has no zero in a box if it has one sign at all
        corners; and a function that is Moebius in each variable, without a pole, is monotone in each.
        """
        low, high = np.full((), np.inf), np.full((), -np.inf)
        above = below = sure = np.ones((), dtype=np.bool_)
        with np.errstate(all="ignore"):
            for corner in product((0, 1), repeat=len(lows)):
                at = [(lows, highs)[side][group] for group, side in enumerate(corner)]
                top, bottom = self._sum(self._upper, at), self._sum(self._lower, at)
                value = top.value / bottom.value
                room = np.abs(bottom.value) - bottom.error
                error = _SLACK * ((top.error + np.abs(value) * bottom.error) / room + 2 * _U * np.abs(value))
                low, high = np.minimum(low, value - error), np.maximum(high, value + error)
                above, below = above & (bottom.value > bottom.error), below & (bottom.value < -bottom.error)
                sure = sure & np.isfinite(value) & np.isfinite(error)
        return _unless((above | below) & sure, low, high)

    def range_by_terms(self, lows: Sequence[Floats], highs: Sequence[Floats]) -> tuple[Floats, Floats]:
        """Range over boxes of monomials by interval arithmetic, term by term: valid for every degree, not tight."""
        with np.errstate(all="ignore"):
            top, bottom = (self._interval(terms, lows, highs) for terms in (self._upper, self._lower))
            ends = [above / below for above in top for below in bottom]
            low, high = np.minimum.reduce(ends), np.maximum.reduce(ends)
            error = 4 * _U * np.maximum(np.abs(low), np.abs(high))
            sure = ((bottom[0] > 0) | (bottom[1] < 0)) & np.isfinite(error)
            return _unless(sure, low - error, high + error)

    def _interval(self, terms: Sequence[Term], lows: Sequence[Floats], highs: Sequence[Floats]) -> list[Floats]:
        """The least and the greatest value of a polynomial, rounded outwards; nan outside float64."""
        positive = [term for term in terms if term.coefficient > 0]
        negative = [term for term in terms if term.coefficient < 0]
        sums = [
            [self._sum(positive, lows), self._sum(negative, highs)],
            [self._sum(positive, highs), self._sum(negative, lows)],
        ]
        found = []
        for sign, (one, other) in zip((-1, 1), sums, strict=True):
            total = one.value + other.value
            found.append(np.asarray(total + sign * _SLACK * (one.error + other.error + _U * np.abs(total))))
        return found

    def _total(self, terms: Sequence[Term], monomials: Sequence[Floats]) -> Floats:
        total = np.zeros(np.broadcast_shapes(*(np.shape(x) for x in monomials)))
        for term in terms:
            total = total + self._term(term, monomials)
        return total

    def _sum(self, terms: Sequence[Term], monomials: Sequence[Floats]) -> EnclosedSum:
        """A polynomial and the bound on its error: roundings times the sum of the terms' magnitudes."""
        total = np.zeros(np.broadcast_shapes(*(np.shape(x) for x in monomials)))
        size, least = total, total + np.inf
        for term in terms:
            value = self._term(term, monomials)
            total, size, least = total + value, size + np.abs(value), np.minimum(least, np.abs(value))
        each = [1 + sum(e * (n + 1) for e, n in zip(t.exponents, self._roundings, strict=True)) for t in terms]
        bound = _SLACK * (max(each, default=0) + len(terms)) * _U * size
        safe = np.isfinite(total) & (least > _TINY)
        if any(abs(term.coefficient) / self._largest < _TINY for term in terms):
            safe = safe & False
        return EnclosedSum(total, np.where(safe, bound, np.inf))

    def _term(self, term: Term, monomials: Sequence[Floats]) -> Floats:
        value = np.full((), term.coefficient / self._largest)
        for x, power in zip(monomials, term.exponents, strict=True):
            for _ in range(power):
                value = value * x
        return value


def _unless(sure: NDArray[np.bool_], low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """The bounds where they are sure, and the whole line elsewhere."""
    return np.where(sure, low, -np.inf), np.where(sure, high, np.inf)
