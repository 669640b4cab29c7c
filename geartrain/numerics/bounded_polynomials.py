"""Polynomials and their quotients at many points in float64, each value with a bound on its rounding error.

A sum of n terms with at most r roundings each has an error of at most (r + n) u / (1 - (r + n) u) times the sum of
the absolute terms (Higham, Accuracy and Stability of Numerical Algorithms, 2nd edition, sections 3.1 and 4.2).
Callers that need more than these bounds recompute the uncertain points exactly.

Points are not stored here. A function `product` returns the values of a monomial at all points, so that products
shared between polynomials are multiplied only once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, reduce

import numpy as np

from geartrain.numerics.arrays import Floats
from geartrain.numerics.exact import log10
from geartrain.numerics.rounding_bounds import SLACK, UNIT_ROUNDOFF, quotient_error, sum_error

Monomial = tuple[tuple[int, int], ...]
"""Product of powers of variables: pairs (variable, power) in ascending order of variables; powers are positive or
negative, never 0.
"""

WholeTerm = tuple[int, tuple[int, ...]]
"""Term with an integer coefficient, and the exponents of all variables."""

Product = Callable[[Monomial], Floats]
"""Function that returns the values of a monomial at all points, as an array that can be broadcast."""

_SAFE = 250
"""Limit of the decimal exponents of terms: between 10^-250 and 10^250 no product underflows or overflows in float64."""


def monomial_of(exponents: Iterable[int]) -> Monomial:
    """Return the monomial with the given exponents of all variables."""
    return tuple((variable, power) for variable, power in enumerate(exponents) if power)


def products_of(columns: Sequence[Floats]) -> Product:
    """Return a `Product` that multiplies columns of values, one for each variable; powers must be 1 or more."""

    def product(monomial: Monomial) -> Floats:
        found: Floats = np.ones(())
        for variable, power in monomial:
            for _ in range(power):
                found = found * columns[variable]
        return found

    return product


def sum_and_size(terms: Iterable[Floats], shape: tuple[int, ...] = ()) -> tuple[Floats, Floats]:
    """Return the sum of arrays in their order, and the sum of their absolute values; zeros of `shape` if there are
    none.
    """
    each = list(terms)
    if not each:
        return np.zeros(shape), np.zeros(shape)
    return reduce(np.add, each), reduce(np.add, map(np.abs, each))


def sum_roundings(monomials: Sequence[Monomial], roundings: Sequence[int]) -> int:
    """Return an upper bound on the number of roundings of a sum of monomials: in one term, and in the summation.

    roundings   number of roundings in the value of each variable
    """
    # a power p of a variable with n roundings has p + p n roundings; a coefficient adds two
    each = (sum(abs(power) * (roundings[variable] + 1) for variable, power in monomial) for monomial in monomials)
    return max(each, default=0) + len(monomials) + 2


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


@dataclass(frozen=True, eq=False)
class BoundedPolynomial:
    """Sum of coefficients times monomials, with a bound on the rounding error of its values."""

    terms: tuple[tuple[float, Monomial], ...]
    """Coefficients in float64, with their monomials."""
    roundings: int
    """Number of roundings in one term and the sum. The absolute error is at most roundings * u * (sum of absolute
    terms).
    """

    @classmethod
    def of(cls, terms: Sequence[tuple[int, Monomial]], scale: int, roundings: Sequence[int]) -> BoundedPolynomial:
        """Return a polynomial with integer coefficients, divided by a scale that keeps them within float64.

        roundings   number of roundings in the value of each variable
        """
        # the exact quotient is rounded once; coefficients may be out of the range of float64
        scaled = tuple((float(Fraction(coefficient, scale)), monomial) for coefficient, monomial in terms)
        return cls(scaled, sum_roundings([monomial for _, monomial in terms], roundings))

    @cached_property
    def relative(self) -> float | None:
        """Bound on the relative error of every value; None if terms can cancel."""
        signs = {coefficient > 0 for coefficient, _ in self.terms}
        return self.roundings * UNIT_ROUNDOFF * SLACK if len(signs) == 1 else None

    def __call__(self, product: Product) -> tuple[Floats, Floats | None]:
        """Return the values and bounds on their absolute errors; None instead of the bounds if `relative` is known."""
        each = (product(monomial) if one == 1 else one * product(monomial) for one, monomial in self.terms)
        if self.relative is not None:
            # terms of one sign: the size is the value, so a relative bound is sufficient
            return reduce(np.add, each), None
        value, size = sum_and_size(each)
        return value, sum_error(self.roundings, size)

    def bounded(self, product: Product) -> tuple[Floats, Floats]:
        """Return the values and bounds on their absolute errors, also if `relative` is known."""
        return _filled_in(*self(product), self.relative)


@dataclass(frozen=True, eq=False)
class BoundedQuotient:
    """Quotient of two bounded polynomials; only the numerator if `lower` is None."""

    upper: BoundedPolynomial
    lower: BoundedPolynomial | None

    @classmethod
    def of(cls, upper: Sequence[WholeTerm], lower: Sequence[WholeTerm], roundings: Sequence[int]) -> BoundedQuotient:
        """Return the quotient of two sums of terms with integer coefficients and exponents of all variables.

        roundings   number of roundings in the value of each variable
        """
        # divided by the largest coefficient, which may be out of the range of float64
        scale = max((abs(coefficient) for coefficient, _ in (*upper, *lower)), default=1)
        above, below = ([(c, monomial_of(exponents)) for c, exponents in side] for side in (upper, lower))
        return cls(BoundedPolynomial.of(above, scale, roundings), BoundedPolynomial.of(below, scale, roundings))

    @property
    def relative(self) -> float | None:
        """Bound on the relative error of every value; None if it depends on the point."""
        return self.upper.relative if self.lower is None else None

    def __call__(self, product: Product) -> tuple[Floats, Floats | None]:
        """Return the values and bounds on their absolute errors; None instead of the bounds if `relative` is known.

        A bound is infinite at poles, and at points where no digit is certain.
        """
        if self.lower is None:
            return self.upper(product)
        (top, off), (bottom, beside) = self.upper.bounded(product), self.lower.bounded(product)
        with np.errstate(all="ignore"):
            value = top / bottom
            left = np.abs(bottom) - beside
            room = quotient_error(value, off, left, beside)
        return value, np.where((left > 0) & np.isfinite(room), room, np.inf)

    def bounded(self, product: Product) -> tuple[Floats, Floats]:
        """Return the values and bounds on their absolute errors, also if `relative` is known."""
        return _filled_in(*self(product), self.relative)


def _filled_in(value: Floats, error: Floats | None, relative: float | None) -> tuple[Floats, Floats]:
    return value, np.asarray((relative or 0.0) * np.abs(value)) if error is None else error
