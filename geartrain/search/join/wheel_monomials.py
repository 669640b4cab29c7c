"""From wheels to items: which wheels the outputs see through one monomial only, and the demands written in items."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Protocol

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.formulas.rational_functions import proportional_classes
from geartrain.numerics.bounded_polynomials import Monomial, WholeTerm
from geartrain.search.join.polynomial_constraints import (
    PolynomialConstraint,
    PolynomialInequality,
    SignPolynomial,
    possible,
)
from geartrain.search.join.product_lists import Domains, ItemRecipe, PartialAssignments, forecast, maximum

Factors = tuple[tuple[str, int], ...]
Interval = tuple[Fraction | None, Fraction | None]
"""Closed, least to greatest; None for an infinite end."""
_MOST_VALUES = 10**7
"""Values of one item: half a gigabyte with all that belongs to them."""
_MOST_QUOTIENTS = 1 << 22  # of an item with counts above and below
_MOST_WORK = 2 * 10**8  # products made to list one item
_LARGEST = 1 << 62  # products below this are exact in int64
_NOTHING = Fraction(1), Fraction(0)


class Function(Protocol):
    """A rational function of counts, such as a `Formula`; powers (0 or more) are parallel to the wheels."""

    @property
    def wheels(self) -> tuple[str, ...]:
        """The wheels it depends on."""

    @property
    def numerator(self) -> Sequence[WholeTerm]:
        """Its terms above."""

    @property
    def denominator(self) -> Sequence[WholeTerm]:
        """Its terms below."""

    def value(self, counts: Mapping[str, int], /) -> Fraction | None:
        """Its exact value; None where the train is locked or free."""


@dataclass(frozen=True, slots=True)
class IntervalConstraint:
    """A demand on a function: its value lies in one of the intervals, which do not touch."""

    name: str
    """The demand in words."""
    function: Function
    intervals: tuple[Interval, ...]
    strict: bool = False
    """True: not on their ends either."""
    graded: bool = False
    """True: it matters where within the intervals the value lies, so that all wheels of the function must be known."""


@dataclass(frozen=True, slots=True)
class WheelMonomial:
    """Wheels that all functions see through one monomial, each with its power (never 0)."""

    powers: Mapping[str, int]

    @property
    def top(self) -> tuple[tuple[str, int], ...]:
        """The wheels with positive powers."""
        return tuple((wheel, power) for wheel, power in self.powers.items() if power > 0)

    @property
    def bottom(self) -> tuple[tuple[str, int], ...]:
        """The wheels with negative powers, the sign dropped."""
        return tuple((wheel, -power) for wheel, power in self.powers.items() if power < 0)


def find_wheel_monomials(
    wheels: Sequence[str], requested: Sequence[IntervalConstraint], alone: frozenset[str]
) -> list[WheelMonomial]:
    """The coarsest bundles; wheels in `alone` stand by themselves, to the power 1.

    Wheels belong together if their powers, counted from the first term of each function and listed over all terms of
    all functions, are multiples of one list.
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
    return [WheelMonomial(powers if next(iter(powers.values())) > 0 else _turned(powers)) for powers in found]


def _turned(powers: Mapping[str, int]) -> dict[str, int]:
    return {wheel: -power for wheel, power in powers.items()}


def find_recipes(bundles: Sequence[WheelMonomial], domains: Domains) -> Iterator[tuple[ItemRecipe, ...]]:
    """Ways to cut bundles into items that can be listed: quotients whole, or what is above and below apart."""
    choices = [list(_cuts(bundle, domains)) for bundle in bundles]
    if math.prod(map(len, choices)) > 8:
        yield from dict.fromkeys(tuple(recipe for choice in choices for recipe in choice[kind]) for kind in (0, -1))
    else:
        for chosen in product(*choices):
            yield tuple(recipe for cut in chosen for recipe in cut)


def _cuts(bundle: WheelMonomial, domains: Domains) -> Iterator[tuple[ItemRecipe, ...]]:
    top, bottom = list(_listed(bundle.top, domains)), list(_listed(bundle.bottom, domains))
    yield tuple(ItemRecipe(wheels) for wheels in top) + tuple(ItemRecipe((), wheels) for wheels in bottom)
    if len(top) == len(bottom) == 1 and quotients(top[0], bottom[0], domains) <= _MOST_QUOTIENTS:
        yield (ItemRecipe(top[0], bottom[0]),)


def quotients(top: Factors, bottom: Factors, domains: Domains) -> int:
    """How many values an item has, about."""
    return forecast(top, domains)[0] * forecast(bottom, domains)[0]


def _listed(wheels: Factors, domains: Domains) -> Iterator[Factors]:
    """Some wheels in as few lots as can be listed, of about one size."""
    if not wheels:
        return
    short = maximum([[domains[wheel][-1] ** power] for wheel, power in wheels]) < _LARGEST
    values, cost = forecast(wheels, domains) if short else (0, 0)
    if short and values <= _MOST_VALUES and cost <= _MOST_WORK:
        yield wheels
    elif len(wheels) == 1:
        wheel, power = wheels[0]
        what = f"the counts of '{wheel}' cannot be listed"
        why = f"{len(domains[wheel])} of them up to {domains[wheel][-1]}, to the power {power}"
        raise RangeError(Problem(what, why, f"narrow its range to {_MOST_VALUES} counts below 10^9"))
    else:
        middle = len(wheels) // 2
        yield from _listed(wheels[:middle], domains)
        yield from _listed(wheels[middle:], domains)


def find_polynomial_constraints(
    requested: Sequence[IntervalConstraint], recipes: Sequence[ItemRecipe], domains: Domains
) -> list[PolynomialConstraint]:
    """The demands in items."""
    extremes = {at: extent(recipe, domains) for at, recipe in enumerate(recipes)}
    constraints = []
    for one in requested:
        function = one.function
        terms = [*function.numerator, *function.denominator]
        monomials = _monomials(function.wheels, terms, recipes)
        polynomials = [(term[0], monomial) for term, monomial in zip(terms, monomials, strict=True)]
        N = SignPolynomial.of(polynomials[: len(function.numerator)])
        D = SignPolynomial.of(polynomials[len(function.numerator) :])
        cases = _feasible(list(_cases(N, D, one)), extremes)
        constraints.append(PolynomialConstraint(one.name, cases, (N, D) if one.graded else None))
    return constraints


def is_within(value: Fraction, intervals: Iterable[Interval]) -> bool:
    """True if a value lies in one of some closed intervals."""
    return any((low is None or value >= low) and (high is None or value <= high) for low, high in intervals)


def extent(recipe: ItemRecipe, domains: Domains) -> tuple[float, float]:
    """Least and greatest value of an item, in floats a few roundings off."""
    above, below = ([domains[wheel] for wheel, _ in side] for side in (recipe.top, recipe.bottom))
    ends = []
    for up, down in ((0, -1), (-1, 0)):
        top = math.prod(counts[up] ** power for counts, (_, power) in zip(above, recipe.top, strict=True))
        bottom = math.prod(counts[down] ** power for counts, (_, power) in zip(below, recipe.bottom, strict=True))
        ends.append(float(Fraction(top, bottom)))
    return ends[0], ends[1]


def _monomials(wheels: Sequence[str], terms: Sequence[WholeTerm], recipes: Sequence[ItemRecipe]) -> list[Monomial]:
    """The monomials in items of some terms, up to one common monomial."""
    rows: list[list[tuple[int, int]]] = [[] for _ in terms]
    for item, recipe in enumerate(recipes):
        wheel, power = recipe.top[0] if recipe.top else recipe.bottom[0]
        if wheel not in wheels:
            continue
        at = wheels.index(wheel)
        sign = power if recipe.top else -power
        steps = [(term[1][at] - terms[0][1][at]) // sign for term in terms]
        minimum = min(steps)
        for row, step in zip(rows, steps, strict=True):
            if step > minimum:
                row.append((item, step - minimum))
    return [tuple(row) for row in rows]


def _cases(
    N: SignPolynomial, D: SignPolynomial, requested: IntervalConstraint
) -> Iterator[tuple[PolynomialInequality, ...]]:
    for sense in (D.definite,) if D.definite else (1, -1):
        for low, high in requested.intervals or (_NOTHING,):
            inequalities = [] if D.definite else [PolynomialInequality(D, sense, strict=True)]
            if low is not None:
                inequalities.append(PolynomialInequality(N.plus(D, -low), sense, requested.strict))
            if high is not None:
                inequalities.append(PolynomialInequality(N.plus(D, -high), -sense, requested.strict))
            yield tuple(inequalities)


def _feasible(
    cases: Sequence[tuple[PolynomialInequality, ...]], extremes: Mapping[int, tuple[float, float]]
) -> tuple[tuple[PolynomialInequality, ...], ...]:
    """Without the cases that no counts meet; the first is kept if none is left: the constraint keeps its items."""
    nothing = PartialAssignments((), {}, 1)
    kept = [case for case in cases if possible(PolynomialConstraint("", (case,)).reaches(extremes), nothing)[0]]
    return tuple(kept or cases[:1])
