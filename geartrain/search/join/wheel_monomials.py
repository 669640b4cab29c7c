"""Conversion of wheels to variables: wheels that occur in a common monomial in all outputs, and constraints in terms of
variables.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.formulas.rational_functions import proportional_classes
from geartrain.numerics.bounded_polynomials import Monomial, WholeTerm
from geartrain.search.join.polynomial_constraints import (
    PolynomialConstraint,
    PolynomialInequality,
    SignPolynomial,
)
from geartrain.search.join.product_lists import Domains, Factors, PartialAssignments, forecast

Interval = tuple[Fraction | None, Fraction | None]
"""Closed interval (minimum, maximum). None denotes an infinite bound."""
_MOST_VALUES = 10**7
"""Maximum number of values of one variable. All arrays of a variable of this size need half a gigabyte."""
_MOST_WORK = 2 * 10**8  # maximum number of products formed to list one variable
_LARGEST = 1 << 62  # products below this are exact in int64
_NOTHING = Fraction(1), Fraction(0)


class Function(Protocol):
    """Rational function of tooth counts, such as a `Formula`. A term contains an integer coefficient and the
    non-negative power of each wheel, in the order of `wheels`.
    """

    @property
    def wheels(self) -> tuple[str, ...]:
        """Names of the wheels on which the function depends."""

    @property
    def numerator(self) -> Sequence[WholeTerm]:
        """Terms of the numerator of the function."""

    @property
    def denominator(self) -> Sequence[WholeTerm]:
        """Terms of the denominator of the function."""

    def value(self, counts: Mapping[str, int], /) -> Fraction | None:
        """Return the exact value for given tooth counts; None if the train is locked or the speed is undetermined."""


@dataclass(frozen=True, slots=True)
class IntervalConstraint:
    """Constraint that the value of a function is in one of several disjoint intervals."""

    name: str
    """Name of the constraint in reports."""
    function: Function
    intervals: tuple[Interval, ...]
    strict: bool = False
    """True if the end points are excluded from the intervals."""
    graded: bool = False
    """True if the value of the function is also needed, so that all wheels of the function must be assigned."""


WheelMonomial = Mapping[str, int]
"""Monomial through which all functions depend on some wheels, given as the non-zero power of each wheel."""


def find_wheel_monomials(
    wheels: Sequence[str], requested: Sequence[IntervalConstraint], alone: frozenset[str]
) -> list[WheelMonomial]:
    """Return groups of wheels on which all functions in `requested` depend only through one monomial of the group, such
    as a c / b, with the power of each wheel. The groups are as large as possible, except that each wheel in `alone` is
    a group by itself with power 1.

    Wheels are in one group if their powers, relative to the first term of each function and listed over all terms of
    all functions, are proportional.
    """
    lists: dict[str, list[int]] = {wheel: [] for wheel in wheels}
    for one in requested:
        names, terms = one.function.wheels, [*one.function.numerator, *one.function.denominator]
        at = {wheel: names.index(wheel) for wheel in wheels if wheel in names}
        for wheel, steps in lists.items():
            powers = [term[1][at[wheel]] if wheel in at else 0 for term in terms]
            steps.extend(power - powers[0] for power in powers)
    classes = proportional_classes((wheel, steps) for wheel, steps in lists.items() if wheel not in alone)
    single = ({wheel: 1} for wheel, steps in lists.items() if wheel in alone or not any(steps))
    found = sorted((*classes.values(), *single), key=lambda powers: wheels.index(next(iter(powers))))
    # the first power is positive
    signs = [1 if next(iter(powers.values())) > 0 else -1 for powers in found]
    return [{w: sign * power for w, power in powers.items()} for sign, powers in zip(signs, found, strict=True)]


def find_recipes(monomials: Sequence[WheelMonomial], domains: Domains) -> tuple[Factors, ...]:
    """Return the definition of each variable of a join: the wheels whose tooth counts are multiplied, each with its
    power. The numerator and the denominator of each monomial are separate variables.
    """
    # a list of quotients would be longer, and `PartialAssignments.distinct` merges rows with equal quotients anyway
    return tuple(
        group
        for monomial in monomials
        for sign in (1, -1)
        for group in _listable_groups(
            tuple((wheel, abs(power)) for wheel, power in monomial.items() if power * sign > 0), domains
        )
    )


def _listable_groups(wheels: Factors, domains: Domains) -> Iterator[Factors]:
    """Yield `wheels` as one group if all products of their tooth counts can be listed in memory. If there are too many
    products, divide the wheels into two halves and yield the groups of each half.
    """
    if not wheels:
        return
    short = math.prod(domains[wheel][-1] ** power for wheel, power in wheels) < _LARGEST
    values, cost = forecast(wheels, domains) if short else (0, 0)
    if short and values <= _MOST_VALUES and cost <= _MOST_WORK:
        yield wheels
    elif len(wheels) == 1:
        wheel, power = wheels[0]
        what = f"the counts of '{wheel}' cannot be listed"
        why = (
            f"{len(domains[wheel])} counts up to {domains[wheel][-1]}, to the power {power}, are too many or too large"
        )
        raise RangeError(Problem(what, why, f"narrow the range to {_MOST_VALUES} counts, none above 10^{18 // power}"))
    else:
        middle = len(wheels) // 2
        yield from _listable_groups(wheels[:middle], domains)
        yield from _listable_groups(wheels[middle:], domains)


def find_polynomial_constraints(
    requested: Sequence[IntervalConstraint], recipes: Sequence[Factors], domains: Domains
) -> list[PolynomialConstraint]:
    """Convert interval constraints on functions of tooth counts to polynomial constraints in variables."""
    minima, maxima = (
        [float(math.prod(domains[wheel][end] ** power for wheel, power in recipe)) for recipe in recipes]
        for end in (0, -1)
    )
    extents = list(zip(minima, maxima, strict=True))
    nothing = PartialAssignments((), {}, 1)
    constraints = []
    for one in requested:
        function = one.function
        terms = [*function.numerator, *function.denominator]
        monomials = _monomials(function.wheels, terms, recipes)
        polynomials = [(term[0], monomial) for term, monomial in zip(terms, monomials, strict=True)]
        N = SignPolynomial.of(polynomials[: len(function.numerator)])
        D = SignPolynomial.of(polynomials[len(function.numerator) :])
        cases = list(_cases(N, D, one))
        feasible = [case for case in cases if PolynomialConstraint("", (case,)).possible(nothing, extents)[0]]
        # one impossible case is kept, so that the constraint still depends on its variables
        kept = tuple(feasible or cases[:1])
        constraints.append(PolynomialConstraint(one.name, kept, (N, D) if one.graded else None))
    return constraints


def is_within(value: Fraction, intervals: Iterable[Interval]) -> bool:
    """Return True if a value lies in any of the given closed intervals."""
    return any((low is None or value >= low) and (high is None or value <= high) for low, high in intervals)


def _monomials(wheels: Sequence[str], terms: Sequence[WholeTerm], recipes: Sequence[Factors]) -> list[Monomial]:
    """Return each term of a function as a monomial in the variables of a join. A factor common to all terms is divided
    out.
    """
    rows: list[list[tuple[int, int]]] = [[] for _ in terms]
    for item, recipe in enumerate(recipes):
        wheel, power = recipe[0]
        if wheel not in wheels:
            continue
        at = wheels.index(wheel)
        steps = [(term[1][at] - terms[0][1][at]) // power for term in terms]
        # a common factor of numerator and denominator cancels
        minimum = min(steps)
        for row, step in zip(rows, steps, strict=True):
            if step > minimum:
                row.append((item, step - minimum))
    return [tuple(row) for row in rows]


def _cases(
    N: SignPolynomial, D: SignPolynomial, requested: IntervalConstraint
) -> Iterator[tuple[PolynomialInequality, ...]]:
    # multiplication by D reverses the inequalities if D < 0
    for sense in (D.definite,) if D.definite else (1, -1):
        for low, high in requested.intervals or (_NOTHING,):
            inequalities = [] if D.definite else [PolynomialInequality(D, sense, strict=True)]
            if low is not None:
                inequalities.append(PolynomialInequality(N.plus(D, -low), sense, requested.strict))
            if high is not None:
                inequalities.append(PolynomialInequality(N.plus(D, -high), -sense, requested.strict))
            yield tuple(inequalities)
