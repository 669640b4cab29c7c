"""Quotients of two polynomials in float64, with bounds on the error.

Everything here takes the monomials of the groups (positive floats, arrays that broadcast) and terms with exponents
parallel to them. Error bounds are those of `rounding_bounds`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.rounding_bounds import SLACK, UNIT_ROUNDOFF, sum_error
from geartrain.synthesis.formulas.laurent import Term

Floats = NDArray[np.float64]

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
            bound = SLACK * (up + down + up * down + 2 * UNIT_ROUNDOFF)
            sure = (np.abs(top.value) > top.error) & (np.abs(bottom.value) > bottom.error)
            if not self._upper and self._lower:
                bound, sure = np.zeros_like(bound), np.abs(bottom.value) > bottom.error
        return np.where(sure & np.isfinite(bound), bound, np.inf)

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
        bound = sum_error(max(each, default=0) + len(terms), size)
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
