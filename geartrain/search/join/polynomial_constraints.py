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
from fractions import Fraction
from functools import cached_property
from itertools import product
from math import prod

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Bools, Floats, Ints
from geartrain.numerics.bounded_polynomials import Monomial, sum_and_size
from geartrain.numerics.rounding_bounds import UNIT_ROUNDOFF
from geartrain.search.integer_columns import spread
from geartrain.search.join.product_lists import Item, PartialAssignments

# Signs of polynomials at very many points, exact: floats decide where they can, integers where they cannot. Every
# bound on an output is the sign of a polynomial in the items: N/D <= v is N - v D <= 0 where D > 0. A float64 value
# with a bound on its rounding settles nearly all points. Where it does not, the value is small against its terms,
# and arithmetic modulo 2^64 gives it exactly as long as it is surely less than 2^63; beyond, Python's integers.


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
        minimum: Floats = 2 * bounds * float(self.scale) if self.scale < 10**300 else np.full(rows.size, np.inf)
        for item in self.items:
            bottom = rows.bottom(item)
            if bottom is not None:
                for _ in range(self.degree(item)):
                    minimum = minimum * bottom
        found: Signs = np.zeros(rows.size, dtype=np.int8)
        # a factor of two below what int64 holds, for the bound itself is rounded
        short = minimum < 2.0**62
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


# Where a polynomial in one open item keeps its sign: a ray of the item's sorted values, found by binary search.
# Divided by the item's lowest power it is A y + B, with y a power of the item, and changes its sign at -B/A.
# Rounding leaves a doubt about values next to that: a window says which values surely meet its inequalities, and
# which may.


@dataclass(frozen=True)
class PolynomialInequality:
    """sense * polynomial >= 0, or > 0 where it is strict."""

    polynomial: SignPolynomial
    sense: int
    strict: bool = False

    def met(self, signs: Signs) -> Bools:
        """Where it holds, given the polynomial's exact signs."""
        found: Bools = (signs * self.sense > 0) if self.strict else (signs * self.sense >= 0)
        return found


@dataclass(frozen=True)
class SolutionWindow:
    """For each row the run of an item's values that may meet a case, and the run within it that surely does."""

    start: Ints
    """Outer: values before `start` and from `end` on surely fail."""
    end: Ints
    """Outer: values before `start` and from `end` on surely fail."""
    sure_start: Ints
    """Inner; empty where sure_end <= sure_start."""
    sure_end: Ints
    """Inner; empty where sure_end <= sure_start."""

    def clipped(self, first: int, last: int) -> SolutionWindow:
        """Cut to the values from `first` up to `last`, exclusive; ends are never before starts."""
        start, end = np.maximum(self.start, first), np.minimum(self.end, last)
        end = np.maximum(start, end)
        sure_start, sure_end = np.clip(self.sure_start, start, end), np.clip(self.sure_end, start, end)
        return SolutionWindow(start, end, sure_start, np.maximum(sure_start, sure_end))


def find_window(case: Sequence[PolynomialInequality], rows: PartialAssignments, item: int) -> SolutionWindow:
    """The window of a case in the one open item: the common part of its rays."""
    start, end = np.zeros(rows.size, dtype=np.int64), np.full(rows.size, len(rows.items[item]))
    sure_start, sure_end = start.copy(), end.copy()
    for inequality in case:
        ray = _ray(inequality, rows, item)
        start, end = np.maximum(start, ray.start), np.minimum(end, ray.end)
        sure_start, sure_end = np.maximum(sure_start, ray.sure_start), np.minimum(sure_end, ray.sure_end)
    return SolutionWindow(start, end, sure_start, sure_end)


def _ray(inequality: PolynomialInequality, rows: PartialAssignments, item: int) -> SolutionWindow:
    """Where sense * (A y + B) >= 0, y the item's value to some power (after dividing by its lowest power)."""
    parts = inequality.polynomial.split(item)
    most = len(rows.items[item])
    if len(parts) < 2:
        met = inequality.met(next(iter(parts.values()), inequality.polynomial).signs(rows))
        return _all_or_nothing(met, most)
    (low, B), (high, A) = parts.items()
    scale = inequality.polynomial.scale
    a, size = A.values(rows, scale)
    # four times the rounding: then |a| less its error is at least three quarters of |a|, and its sign is sure
    known = np.abs(a) > 4 * A.rounding * size
    if known.all():
        return _bounded(inequality, rows, rows.items[item], high - low, (a, A.rounding * size), B)
    return _in_doubt(inequality, rows, item, known, (A, B))


def _bounded(
    inequality: PolynomialInequality,
    rows: PartialAssignments,
    item: Item,
    power: int,
    slope: tuple[Floats, Floats],
    rest: SignPolynomial,
) -> SolutionWindow:
    """The ray where the sign of A is sure: its end is -B/A, give or take what rounding may do."""
    a, off_a = slope
    b, size = rest.values(rows, inequality.polynomial.scale)
    end = -b / a
    # first-order bound on the error of -b/a, and what rounding does to the item's power itself
    off = (rest.rounding * size + np.abs(end) * off_a) / (np.abs(a) - off_a)
    off += np.abs(end) * (8 * power + 8) * ROUNDING
    minimum, maximum, y = end - off, end + off, item.powers(power)
    rising = (a > 0) == (inequality.sense > 0)
    if rising.all():
        return _rising(y, minimum, maximum)
    if not rising.any():
        return _falling(y, minimum, maximum)
    up, down = _rising(y, minimum, maximum), _falling(y, minimum, maximum)
    return SolutionWindow(
        np.where(rising, up.start, down.start),
        np.where(rising, up.end, down.end),
        np.where(rising, up.sure_start, down.sure_start),
        np.where(rising, up.sure_end, down.sure_end),
    )


def _rising(y: Floats, minimum: Floats, maximum: Floats) -> SolutionWindow:
    """All y from somewhere between `minimum` and `maximum` on."""
    start = np.searchsorted(y, minimum, side="left")
    end = np.full(len(start), len(y))
    sure = start.copy()
    near = np.flatnonzero((start < len(y)) & (y[np.minimum(start, len(y) - 1)] <= maximum))
    sure[near] = np.searchsorted(y, maximum[near], side="right")
    return SolutionWindow(start, end, sure, end)


def _falling(y: Floats, minimum: Floats, maximum: Floats) -> SolutionWindow:
    """All y up to somewhere between `minimum` and `maximum`."""
    end = np.searchsorted(y, maximum, side="right")
    start = np.zeros(len(end), dtype=np.int64)
    sure = end.copy()
    near = np.flatnonzero((end > 0) & (y[np.maximum(end - 1, 0)] >= minimum))
    sure[near] = np.searchsorted(y, minimum[near], side="left")
    return SolutionWindow(start, end, start, sure)


def _all_or_nothing(met: Bools, most: int) -> SolutionWindow:
    start = np.zeros(len(met), dtype=np.int64)
    end = np.where(met, most, 0)
    return SolutionWindow(start, end, start, end)


def _in_doubt(
    inequality: PolynomialInequality,
    rows: PartialAssignments,
    item: int,
    known: Bools,
    parts: tuple[SignPolynomial, SignPolynomial],
) -> SolutionWindow:
    """The ray where rounding hides the sign of A in some rows: where A is 0, B decides; else all stays in doubt."""
    A, B = parts
    found = np.zeros((4, rows.size), dtype=np.int64)
    found[1] = len(rows.items[item])
    sure = np.flatnonzero(known)
    if len(sure):
        ray = _ray(inequality, rows.pick(sure), item)
        found[:, sure] = ray.start, ray.end, ray.sure_start, ray.sure_end
    doubtful = np.flatnonzero(~known)
    flat = doubtful[A.signs(rows.pick(doubtful)) == 0]
    if len(flat):
        ray = _all_or_nothing(inequality.met(B.signs(rows.pick(flat))), len(rows.items[item]))
        found[:, flat] = ray.start, ray.end, ray.sure_start, ray.sure_end
    return SolutionWindow(*found)


Corners = Mapping[int, tuple[float, float]]
"""Open item -> its least and greatest value."""

_MOST_CORNERS = 64  # of a box; beyond, each term is bounded by itself
_SHORT = 4096
"""Rows up to which a product of matrices is faster than one term after the other."""


@dataclass(frozen=True, slots=True)
class RelaxedInequality:
    """An inequality with some items open."""

    sense: int
    """Of the inequality."""
    rest: tuple[SignPolynomial, ...]
    """What the items that are set make of each term."""
    lows: Floats
    """What the open items make of each term at the least and at the greatest, (terms,)."""
    highs: Floats
    """What the open items make of each term at the least and at the greatest, (terms,)."""
    points: Floats | None
    """What they make of each term at each corner, (terms, corners); None where each term is taken by itself."""
    slack: float
    """Rounding of the sum, over the sum with all signs plus."""
    scale: int
    """The polynomial's."""

    def possible(self, rows: PartialAssignments) -> Bools:
        """False where the inequality surely fails for all values of the open items."""
        factors = [self.sense * one.values(rows, self.scale)[0] for one in self.rest]
        minimum = np.zeros(rows.size)
        for factor, high in zip(factors, self.highs, strict=True):
            minimum -= self.slack * high * np.abs(factor)
        if self.points is None:
            best = np.zeros(rows.size)
            for factor, low, high in zip(factors, self.lows, self.highs, strict=True):
                best += np.maximum(low * factor, high * factor)
            return np.asarray(best >= minimum)
        if rows.size <= _SHORT:
            return np.asarray((np.stack(factors, axis=1) @ self.points >= minimum[:, None]).any(axis=1))
        found: Bools = np.zeros(rows.size, dtype=np.bool_)
        for point in self.points.T:
            values = np.zeros(rows.size)
            for factor, size in zip(factors, point, strict=True):
                values += size * factor
            found |= values >= minimum
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
    minimum = {item: polynomial.powers(item)[0] for item in inside}
    factors = []
    for _, monomial in polynomial.terms:
        powers = dict(monomial)
        factors.append(prod(x ** (powers.get(item, 0) - minimum[item]) for item, x in zip(inside, point, strict=True)))
    return np.array(factors, dtype=np.float64)


@dataclass(frozen=True)
class PolynomialConstraint:
    """A demand: at least one case holds, that is, all of its inequalities. No two cases hold at once."""

    name: str
    """What is demanded, in words."""
    cases: tuple[tuple[PolynomialInequality, ...], ...]
    function: tuple[SignPolynomial, SignPolynomial] | None = None
    """Numerator and denominator of what the demand is on, where its value is asked for too."""

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
