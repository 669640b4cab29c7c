"""What is required of one output, as signs of polynomials in items; and whether that can be met while items are open.

|N/D - w| <= t w is one of a few cases, such as D > 0, N - (1-t) w D >= 0, N - (1+t) w D <= 0. Each case is a set of
inequalities (sense * polynomial >= 0). Where one item is still open each case leaves one window of its values; entries
that floats cannot place are settled by exact signs.

Where more items are open they lie between bounds, and rows are given up that no values between these can save. Where a
polynomial has at most two powers of each open item it is, divided by the lower ones, monotone in each: its extremes lie
at the corners of the box. Where no open item is in two of its terms, each term has its own extreme. Otherwise, or with
too many corners, the terms' own extremes are bounds all the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import prod

import numpy as np

from geartrain.numerics.arrays import Bools, Floats, Ints
from geartrain.numerics.integer_columns import spread
from geartrain.synthesis.join.partial_assignments import PartialAssignments
from geartrain.synthesis.join.polynomial_signs import SignPolynomial, Signs
from geartrain.synthesis.join.solution_windows import PolynomialInequality, SolutionWindow, find_window

Corners = Mapping[int, tuple[float, float]]
"""Open item -> its least and greatest value."""

_MOST_CORNERS = 64  # of a box; beyond, each term is bounded by itself
_SHORT = 4096
"""Rows up to which a product of matrices is faster than one term after the other."""


@dataclass(frozen=True, slots=True)
class RelaxedInequality:
    """An inequality with some items open.

    sense        of the inequality
    rest         what the items that are set make of each term
    lows, highs  what the open items make of each term at the least and at the greatest, (terms,)
    points       what they make of each term at each corner, (terms, corners); None where each term is taken by itself
    slack        rounding of the sum, over the sum with all signs plus
    scale        the polynomial's
    """

    sense: int
    rest: tuple[SignPolynomial, ...]
    lows: Floats
    highs: Floats
    points: Floats | None
    slack: float
    scale: int

    def possible(self, rows: PartialAssignments) -> Bools:
        """False where the inequality surely fails for all values of the open items."""
        factors = [self.sense * one.values(rows, self.scale)[0] for one in self.rest]
        least = np.zeros(rows.size)
        for factor, high in zip(factors, self.highs, strict=True):
            least -= self.slack * high * np.abs(factor)
        if self.points is None:
            best = np.zeros(rows.size)
            for factor, low, high in zip(factors, self.lows, self.highs, strict=True):
                best += np.maximum(low * factor, high * factor)
            return np.asarray(best >= least)
        if rows.size <= _SHORT:
            return np.asarray((np.stack(factors, axis=1) @ self.points >= least[:, None]).any(axis=1))
        found: Bools = np.zeros(rows.size, dtype=np.bool_)
        for point in self.points.T:
            values = np.zeros(rows.size)
            for factor, size in zip(factors, point, strict=True):
                values += size * factor
            found |= values >= least
        return found


def relax_inequality(inequality: PolynomialInequality, corners: Corners) -> RelaxedInequality:
    """An inequality with the items in `corners` open; others that it depends on are set."""
    polynomial = inequality.polynomial
    inside = [item for item in polynomial.items if item in corners]
    lows, highs = (_factors(polynomial, inside, [corners[item][end] for item in inside]) for end in (0, 1))
    few = all(len(polynomial.powers(item)) <= 2 for item in inside) and 2 ** len(inside) <= _MOST_CORNERS
    points = None
    if few and not all(_alone(polynomial, item) for item in inside):
        ends = product(*(corners[item] for item in inside))
        points = np.stack([_factors(polynomial, inside, point) for point in ends], axis=1)
    rest = tuple(
        SignPolynomial(((coefficient, tuple(pair for pair in monomial if pair[0] not in inside)),))
        for coefficient, monomial in polynomial.terms
    )
    return RelaxedInequality(inequality.sense, rest, lows, highs, points, 2 * polynomial.rounding, polynomial.scale)


def _alone(polynomial: SignPolynomial, item: int) -> bool:
    """True if one term at most has more than the lowest power of an item."""
    powers = [dict(monomial).get(item, 0) for _, monomial in polynomial.terms]
    return sum(power > min(powers) for power in powers) <= 1


def _factors(polynomial: SignPolynomial, inside: Sequence[int], point: Sequence[float]) -> Floats:
    """What the open items make of each term at some values of theirs; their lowest powers are divided out."""
    least = {item: polynomial.powers(item)[0] for item in inside}
    factors = []
    for _, monomial in polynomial.terms:
        powers = dict(monomial)
        factors.append(prod(x ** (powers.get(item, 0) - least[item]) for item, x in zip(inside, point, strict=True)))
    return np.array(factors, dtype=np.float64)


@dataclass(frozen=True)
class PolynomialConstraint:
    """A demand: at least one case holds, that is, all of its inequalities. No two cases hold at once.

    name       what is demanded, in words
    function   numerator and denominator of what the demand is on, where its value is asked for too
    """

    name: str
    cases: tuple[tuple[PolynomialInequality, ...], ...]
    function: tuple[SignPolynomial, SignPolynomial] | None = None

    @cached_property
    def items(self) -> tuple[int, ...]:
        """The items it depends on, ascending."""
        polynomials = [*(inequality.polynomial for inequality in self._inequalities), *(self.function or ())]
        return tuple(sorted({item for polynomial in polynomials for item in polynomial.items}))

    @property
    def _inequalities(self) -> Iterable[PolynomialInequality]:
        return (inequality for case in self.cases for inequality in case)

    def steps(self, item: int) -> Iterator[int]:
        """Powers of an item in the terms of its polynomials, each less that in the polynomial's first term."""
        sums = [inequality.polynomial.terms for inequality in self._inequalities]
        if self.function is not None:
            sums.append(self.function[0].terms + self.function[1].terms)
        for terms in sums:
            powers = [dict(monomial).get(item, 0) for _, monomial in terms]
            yield from (power - powers[0] for power in powers)

    def opens(self, item: int) -> bool:
        """True if `windows` can be found in an item: each polynomial has at most two powers of it."""
        return all(len(inequality.polynomial.powers(item)) <= 2 for inequality in self._inequalities)

    def holds(self, rows: PartialAssignments) -> Bools:
        """Where it is met, exactly; all its items must be set."""
        known: dict[SignPolynomial, Signs] = {}
        found: Bools = np.zeros(rows.size, dtype=np.bool_)
        for case in self.cases:
            found |= _case_holds(case, rows, known)
        return found

    def value(self, rows: PartialAssignments) -> Floats:
        """The value of its function, to rounding."""
        assert self.function is not None, "the demand is graded"
        scale = max(side.scale for side in self.function)
        (above, _), (below, _) = (side.values(rows, scale) for side in self.function)
        return np.asarray(above / below)

    def reaches(self, corners: Corners) -> list[list[RelaxedInequality]]:
        """Its inequalities, case by case, with some items open; for `possible`."""
        return [[relax_inequality(inequality, corners) for inequality in case] for case in self.cases]

    def windows(self, rows: PartialAssignments, item: int) -> list[SolutionWindow]:
        """For each case its window of the values of the one open item."""
        return [find_window(case, rows, item) for case in self.cases]

    def fringe(self, at: int, rows: PartialAssignments, item: int, window: SolutionWindow) -> tuple[Ints, Ints]:
        """Row and value of all that a window of case `at` leaves in doubt and that do meet it."""
        none = window.sure_end <= window.sure_start
        starts = np.concatenate([window.start, np.where(none, window.end, window.sure_end)])
        ends = np.concatenate([np.where(none, window.end, window.sure_start), window.end])
        some = np.flatnonzero(ends > starts)
        owner, indices = spread(starts[some], ends[some])
        parents = some[owner] % rows.size if rows.size else owner
        met = _case_holds(self.cases[at], rows.plus(parents, item, indices), {})
        return parents[met], indices[met]


def _case_holds(
    case: Sequence[PolynomialInequality], rows: PartialAssignments, known: dict[SignPolynomial, Signs]
) -> Bools:
    met: Bools = np.ones(rows.size, dtype=np.bool_)
    for inequality in case:
        if inequality.polynomial not in known:
            known[inequality.polynomial] = inequality.polynomial.signs(rows)
        met &= inequality.met(known[inequality.polynomial])
    return met


def possible(reaches: Sequence[Sequence[RelaxedInequality]], rows: PartialAssignments) -> Bools:
    """False where no values of the open items meet a constraint; `reaches` are its."""
    found: Bools = np.zeros(rows.size, dtype=np.bool_)
    for case in reaches:
        met: Bools = np.ones(rows.size, dtype=np.bool_)
        for reach in case:
            met &= reach.possible(rows)
        found |= met
    return found
