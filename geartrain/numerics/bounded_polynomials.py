"""Polynomials and their quotients at many points in float64, each value with a bound on its rounding.

A sum of n terms with at most r roundings each is off by at most (r + n) u / (1 - (r + n) u) times the sum of the terms'
sizes (Higham, Accuracy and Stability of Numerical Algorithms, 2nd edition, sections 3.1 and 4.2). Whoever needs more
than these bounds tell works out the doubtful points exactly.

A point is not held here: a function `product` gives the value of a monomial at all points at once, so that products
that polynomials share need be multiplied once only.
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
"""A product of powers of variables: (variable, power) pairs, variables ascending, powers of either sign, never 0."""

WholeTerm = tuple[int, tuple[int, ...]]
"""A whole coefficient, and exponents parallel to the variables."""

Product = Callable[[Monomial], Floats]
"""The values of a monomial at all points, arrays that broadcast."""

_SAFE = 250
"""Terms between 10^-250 and 10^250 are never near the ends of float64, where relative errors are not bounded."""


def monomial_of(exponents: Iterable[int]) -> Monomial:
    """A monomial from the exponents of all variables."""
    return tuple((variable, power) for variable, power in enumerate(exponents) if power)


def products_of(columns: Sequence[Floats]) -> Product:
    """Monomials by plain multiplication of columns, one for each variable; powers 1 or more."""

    def product(monomial: Monomial) -> Floats:
        found: Floats = np.ones(())
        for variable, power in monomial:
            for _ in range(power):
                found = found * columns[variable]
        return found

    return product


def sum_and_size(terms: Iterable[Floats], shape: tuple[int, ...] = ()) -> tuple[Floats, Floats]:
    """The sum of some terms in their order, and the same sum with all signs plus; zeros of `shape` where none is."""
    each = list(terms)
    if not each:
        return np.zeros(shape), np.zeros(shape)
    return reduce(np.add, each), reduce(np.add, map(np.abs, each))


def sum_roundings(monomials: Sequence[Monomial], roundings: Sequence[int]) -> int:
    """Roundings that reach one term of a sum of monomials with coefficients, and those of the sum itself.

    roundings   already in each variable
    """
    # a power p of a variable with n roundings costs p multiplications and p times n; a coefficient one of each
    each = (sum(abs(power) * (roundings[variable] + 1) for variable, power in monomial) for monomial in monomials)
    return max(each, default=0) + len(monomials) + 2


def in_range(terms: Iterable[tuple[Fraction | int, Iterable[int]]], largest: Sequence[float]) -> bool:
    """True if no term, in whatever order it is multiplied, comes near the ends of float64.

    terms     coefficients, not 0, and exponents parallel to the variables
    largest   log10 of the largest value of each variable; the least is 1
    """
    for coefficient, exponents in terms:
        reach = sum(size * abs(power) for size, power in zip(largest, exponents, strict=True))
        # twice, for a product may be formed above and below before it is divided
        if 2 * reach + abs(log10(Fraction(coefficient))) > _SAFE:
            return False
    return True


@dataclass(frozen=True, eq=False)
class BoundedPolynomial:
    """A sum of coefficients times monomials."""

    terms: tuple[tuple[float, Monomial], ...]
    """Coefficients in float64, and their monomials."""
    roundings: int
    """In one term and in the sum: a value is off by at most roundings u times the sum of the terms' sizes."""

    @classmethod
    def of(cls, terms: Sequence[tuple[int, Monomial]], scale: int, roundings: Sequence[int]) -> BoundedPolynomial:
        """A polynomial with whole coefficients, over a scale that keeps them within float64.

        roundings   already in each variable
        """
        # the quotient is rounded once; the coefficients themselves may be beyond the range of float64
        scaled = tuple((float(Fraction(coefficient, scale)), monomial) for coefficient, monomial in terms)
        return cls(scaled, sum_roundings([monomial for _, monomial in terms], roundings))

    @cached_property
    def relative(self) -> float | None:
        """A bound on the relative error of every value; None where terms may cancel."""
        signs = {coefficient > 0 for coefficient, _ in self.terms}
        return self.roundings * UNIT_ROUNDOFF * SLACK if len(signs) == 1 else None

    def __call__(self, product: Product) -> tuple[Floats, Floats | None]:
        """Values, and bounds on their errors where `relative` is None."""
        each = (product(monomial) if one == 1 else one * product(monomial) for one, monomial in self.terms)
        if self.relative is not None:
            # all of one sign: the size is the value, and the bound need not be worked out point by point
            return reduce(np.add, each), None
        value, size = sum_and_size(each)
        return value, sum_error(self.roundings, size)

    def bounded(self, product: Product) -> tuple[Floats, Floats]:
        """Values, and bounds on their errors in any case."""
        return _filled_in(*self(product), self.relative)


@dataclass(frozen=True, eq=False)
class BoundedQuotient:
    """A quotient of two polynomials; a sum of monomials where `lower` is None."""

    upper: BoundedPolynomial
    lower: BoundedPolynomial | None

    @classmethod
    def of(cls, upper: Sequence[WholeTerm], lower: Sequence[WholeTerm], roundings: Sequence[int]) -> BoundedQuotient:
        """A quotient of two sums of whole coefficients with exponents parallel to the variables.

        roundings   already in each variable
        """
        # over the largest coefficient, which may itself be beyond the range of float64
        scale = max((abs(coefficient) for coefficient, _ in (*upper, *lower)), default=1)
        above, below = ([(c, monomial_of(exponents)) for c, exponents in side] for side in (upper, lower))
        return cls(BoundedPolynomial.of(above, scale, roundings), BoundedPolynomial.of(below, scale, roundings))

    @property
    def relative(self) -> float | None:
        """A bound on the relative error of every value; None where that depends on the point."""
        return self.upper.relative if self.lower is None else None

    def __call__(self, product: Product) -> tuple[Floats, Floats | None]:
        """Values, and bounds on their errors where `relative` is None: infinite where no digit is sure, or at poles."""
        if self.lower is None:
            return self.upper(product)
        (top, off), (bottom, beside) = self.upper.bounded(product), self.lower.bounded(product)
        with np.errstate(all="ignore"):
            value = top / bottom
            left = np.abs(bottom) - beside
            room = quotient_error(value, off, left, beside)
        return value, np.where((left > 0) & np.isfinite(room), room, np.inf)

    def bounded(self, product: Product) -> tuple[Floats, Floats]:
        """Values, and bounds on their errors in any case."""
        return _filled_in(*self(product), self.relative)


def _filled_in(value: Floats, error: Floats | None, relative: float | None) -> tuple[Floats, Floats]:
    return value, np.asarray((relative or 0.0) * np.abs(value)) if error is None else error
