"""Polynomials and their quotients at many points in float64, each value with a bound on its rounding error.

A sum of n terms with at most r roundings each has an error of at most (r + n) u / (1 - (r + n) u) times the sum of
the absolute terms (Higham, Accuracy and Stability of Numerical Algorithms, 2nd edition, sections 3.1 and 4.2).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from functools import reduce

import numpy as np

from geartrain.numerics.arrays import Floats
from geartrain.numerics.exact import log10
from geartrain.numerics.rounding_bounds import SLACK, UNIT_ROUNDOFF

Monomial = tuple[tuple[int, int], ...]
"""Product of powers of variables, as pairs (variable, power) in ascending order of variables; no power is 0."""

WholeTerm = tuple[int, tuple[int, ...]]
"""Term with an integer coefficient, and the exponents of all variables."""

Product = Callable[[Monomial], Floats]
"""Function that returns the values of a monomial at all points, as an array that can be broadcast."""

_SAFE = 250
"""Limit of the decimal exponents of terms: no product underflows or overflows in float64 between 10^-250 and 10^250."""


def products_of(columns: Sequence[Floats]) -> Product:
    """Return a function that computes monomials with powers of 1 or more from arrays of values of each variable."""

    def product(monomial: Monomial) -> Floats:
        factors = [columns[variable] for variable, power in monomial for _ in range(power)]
        return reduce(np.multiply, factors) if factors else np.ones(())

    return product


def sum_and_size(terms: Iterable[Floats], shape: tuple[int, ...] = ()) -> tuple[Floats, Floats]:
    """Return the sum of arrays in order, and the sum of their absolute values; zeros of shape `shape` for no arrays."""
    each = list(terms)
    if not each:
        return np.zeros(shape), np.zeros(shape)
    return reduce(np.add, each), reduce(np.add, map(np.abs, each))


def in_range(terms: Iterable[tuple[Fraction | int, Iterable[int]]], largest: Sequence[float]) -> bool:
    """Return True if no term can underflow or overflow in float64, whatever the order of multiplication.

    terms     nonzero coefficients, and exponents of all variables
    largest   log10 of the maximum value of each variable; the minimum value is 1
    """
    for coefficient, exponents in terms:
        reach = sum(size * abs(power) for size, power in zip(largest, exponents, strict=True))
        # twice, because a product may be formed in numerator and denominator before the division
        if 2 * reach + abs(log10(Fraction(coefficient))) > _SAFE:
            return False
    return True


def bounded_quotient(
    upper: Sequence[WholeTerm], lower: Sequence[WholeTerm], roundings: Sequence[int], product: Product
) -> tuple[Floats, Floats]:
    """Return the values of a quotient of two polynomials, and bounds on their absolute errors.

    upper, lower   terms of numerator and denominator
    roundings      number of roundings in the value of each variable

    A bound is infinite at poles, and at points at which no digit is certain.
    """
    # divided by the largest coefficient, which may be out of the range of float64
    scale = max((abs(coefficient) for coefficient, _ in (*upper, *lower)), default=1)
    with np.errstate(all="ignore"):
        (top, off), (bottom, beside) = (_bounded_sum(side, scale, roundings, product) for side in (upper, lower))
        value, left = top / bottom, np.abs(bottom) - beside
        error = SLACK * ((off + np.abs(value) * beside) / left + 2 * UNIT_ROUNDOFF * np.abs(value))
    return value, np.where((left > 0) & np.isfinite(error), error, np.inf)


def _bounded_sum(
    terms: Sequence[WholeTerm], scale: int, roundings: Sequence[int], product: Product
) -> tuple[Floats, Floats]:
    """Return the values of a polynomial divided by `scale`, and bounds on their errors; see `bounded_quotient`."""
    monomials = [tuple((at, power) for at, power in enumerate(exponents) if power) for _, exponents in terms]
    # the exact quotient of two integers is rounded once
    factors = [float(Fraction(coefficient, scale)) for coefficient, _ in terms]
    value, size = sum_and_size(one * product(each) for one, each in zip(factors, monomials, strict=True))
    # a power p of a variable with n roundings has p + p n roundings; a coefficient adds two
    each = (sum(abs(power) * (roundings[at] + 1) for at, power in monomial) for monomial in monomials)
    count = max(each, default=0) + len(monomials) + 2
    return value, SLACK * count * UNIT_ROUNDOFF * size
