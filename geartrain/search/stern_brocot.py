"""Fractions near a number: the tree of Stern and Brocot, walked exactly and in strides.

Sources: M. A. Stern, Ueber eine zahlentheoretische Funktion, J. reine angew. Math. 55 (1858); A. Brocot, Calcul des
rouages par approximation, Revue chronometrique 3 (1861). Every fraction stands in the tree once, between two
neighbours a/b < c/d with bc - ad = 1, as their mediant (a + c)/(b + d). The walk down to a number turns left and right;
the lengths of its straight runs are the terms of the number's continued fraction, so a run is jumped over at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from heapq import merge
from typing import ClassVar, Literal

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.exact import coprime
from geartrain.numerics.results import Key, Result, Tabular
from geartrain.search.target_ratio import TargetRatio

ApproximantKind = Literal["convergent", "best", "intermediate"]
IntegerPair = tuple[int, int]
"""Numerator and denominator; (1, 0) stands above all fractions."""

_MOST_LISTED = 10**5


@dataclass(frozen=True, slots=True)
class Approximant(Result):
    """A fraction on the walk to a number.

    See Also
    --------
    approximants : lists them.
    """

    KEYS = ("value", "kind", Key("error", to=float), Key("exact_error", "error"))

    value: Fraction
    """The fraction, positive."""
    error: Fraction
    """`value` over the number, less 1; exact."""
    kind: ApproximantKind
    """"convergent": of the continued fraction. "best": no convergent, but nearer than every other positive fraction
    whose denominator is not larger (a best approximation of the first kind). "intermediate": neither."""


@dataclass(frozen=True, slots=True)
class Approximants(Tabular, Result):
    """The fractions on the way to a ratio, each nearer than all smaller ones."""

    ROWS = "search.tooth_numbers_report:approximant_rows"
    ROW = "Approximant"
    MEANINGS: ClassVar = {
        "error": "The fraction over the number, less 1 [1].",
        "exact_error": "The error as a fraction [1].",
    }

    PAGE = "search.tooth_numbers_report:describe_approximants"

    wanted: TargetRatio
    """The ratio."""
    most: int
    """The greatest numerator and denominator."""
    solutions: tuple[Approximant, ...]
    """In the order of the walk."""

    def _summary(self) -> str:
        label = self.wanted.label or self.wanted.value
        last = f", last {self.solutions[-1].value}" if self.solutions else ""
        return f"{label}: {len(self.solutions)} fractions up to {self.most}{last}"


@dataclass(frozen=True, slots=True)
class SternBrocotRun:
    """A straight run of the walk: the fractions (p + k P)/(q + k Q) for k from 1 to `length`, from p/q towards P/Q."""

    near: IntegerPair
    """(p, q), the end on the side of the run's fractions."""
    far: IntegerPair
    """(P, Q), the end beyond the number."""
    whole: int
    """Length the run would have without bounds: a term of the continued fraction; there the convergent stands."""
    length: int
    """Length within the bounds."""
    best: int
    """Least k whose fraction is a best one of the first kind, and all after it are; `length` + 1 if none is."""

    def at(self, k: int) -> Fraction:
        """The fraction of place k."""
        return coprime(self.near[0] + k * self.far[0], self.near[1] + k * self.far[1])

    def kind(self, k: int) -> ApproximantKind:
        """What the fraction of place k is."""
        if k == self.whole:
            return "convergent"
        return "best" if k >= self.best else "intermediate"


def runs(value: Fraction, most: int) -> Iterator[SternBrocotRun]:
    """The walk to `value` > 0 while numerator and denominator stay within `most`; as many runs as terms."""
    _check(value, most, most)
    left, right = value.numerator, value.denominator
    near, far = (0, 1), (1, 0)
    while right:
        term, rest = divmod(left, right)
        room = min((most - p) // step if step else term for p, step in zip(near, far, strict=True))
        length = min(term, room)
        if length:
            yield SternBrocotRun(near, far, term, length, _first_best(value, near, far, length))
        if room < term:
            return
        near, far = far, (near[0] + term * far[0], near[1] + term * far[1])
        left, right = right, rest


def approximants(value: Fraction, most: int, minimum: ApproximantKind = "intermediate") -> tuple[Approximant, ...]:
    """Every fraction on the walk down the Stern-Brocot tree to a number, in the order of the walk.

    Parameters
    ----------
    value : Fraction
        The number, above 0.
    most : int
        The largest numerator and denominator.
    minimum : {"convergent", "best", "intermediate"}
        "convergent" lists convergents of the continued fraction alone, "best" the best ones too, "intermediate" all.

    Returns
    -------
    tuple of Approximant
        The last one is `value` itself where that is within the bound. Where it is not, and everything is listed, the
        last one of either side is the nearest from that side of all fractions within the bound.

    Raises
    ------
    QuestionError
        If the number or the bound is not positive.
    RangeError
        For more than 10^5 fractions; the convergents are always few.

    References
    ----------
    M. A. Stern, J. reine angew. Math. 55 (1858); A. Brocot, Revue chronometrique 3 (1861).

    Examples
    --------
    >>> [str(found.value) for found in approximants(Fraction(191, 23), 100, "best")]
    ['8', '17/2', '25/3', '58/7', '83/10']
    """
    found: list[Approximant] = []
    for run in runs(value, most):
        first = {"convergent": run.whole, "best": min(run.best, run.whole), "intermediate": 1}[minimum]
        if len(found) + run.length - first >= _MOST_LISTED:
            raise RangeError(
                Problem(
                    f"more than {_MOST_LISTED} fractions lie on the way",
                    f"a straight run of the walk, from {run.at(1)} to {run.at(run.length)}, holds {run.length} of them",
                    "lower the bound, or ask for the convergents alone",
                )
            )
        for k in range(first, run.length + 1):
            fraction = run.at(k)
            found.append(Approximant(fraction, fraction / value - 1, run.kind(k)))
    return tuple(found)


def neighbours(value: Fraction, most_numerator: int, most_denominator: int) -> tuple[IntegerPair, IntegerPair]:
    """The greatest fraction below `value` > 0 and the least one not below it, within the bounds.

    (0, 1) where none is below, (1, 0) where none is above. The two are neighbours: bc - ad = 1. Cost grows with the
    logarithm of the bounds.

    >>> neighbours(Fraction(191, 23), 100, 100)
    ((83, 10), (25, 3))
    """
    _check(value, most_numerator, most_denominator)
    n, d = value.numerator, value.denominator
    most = (most_numerator, most_denominator)
    low, high = (0, 1), (1, 0)
    while True:
        below, above = n * low[1] - d * low[0], d * high[0] - n * high[1]
        room = _room(low, high, most)
        step = min(room, (below - 1) // above) if above else room
        low = (low[0] + step * high[0], low[1] + step * high[1])
        back = min(_room(high, low, most), above // (below - step * above))
        high = (high[0] + back * low[0], high[1] + back * low[1])
        if not step and not back:
            return low, high


def farey_neighbours(value: Fraction, most: int) -> tuple[Fraction, Fraction]:
    """The greatest fraction not above `value` >= 0 and the least not below it, denominators up to `most` (>= 1).

    >>> farey_neighbours(Fraction(314159, 100000), 100)
    (Fraction(311, 99), Fraction(22, 7))
    """
    if value.denominator <= most:
        return value, value
    # no numerator of a neighbour is longer than this, so only the denominators are bounded
    low, high = neighbours(value, (int(value) + 1) * most, most)
    return Fraction(*low), Fraction(*high)


def nearest_first(value: Fraction, most_numerator: int, most_denominator: int) -> Iterator[Fraction]:
    """Every positive fraction within the bounds, in the order of its distance from `value` > 0; lazy.

    Of two at one distance the smaller comes first.
    """
    low, high = neighbours(value, most_numerator, most_denominator)
    most = (most_numerator, most_denominator)
    up = (coprime(p, q) for p, q in _onward(low, high, most))
    # turned upside down, the fractions below ascend too
    down = (coprime(p, q) for q, p in _onward(high[::-1], low[::-1], most[::-1]))
    return merge(down, up, key=lambda fraction: abs(fraction - value))


def _first_best(value: Fraction, near: IntegerPair, far: IntegerPair, length: int) -> int:
    """Least k for which (p + k P)/(q + k Q) is nearer to `value` than P/Q, up to `length` + 1.

    The fractions of a run come ever nearer, and what lies between them and the number has larger denominators; so
    only the end beyond the number competes. Zero and infinity, no gear ratios, do not. A whole number competes with the
    next one, whose denominator is the same.
    """
    if not far[1]:
        return length if value - length < Fraction(1, 2) else length + 1
    if not far[0]:
        return 1
    n, d = value.numerator, value.denominator
    p, q, P, Q = *near, *far
    # |d (p + k P) - n (q + k Q)| / (q + k Q) < |d P - n Q| / Q, where the left numerator is a - k b
    a, b = abs(d * p - n * q), abs(d * P - n * Q)
    return min(max((Q * a - b * q) // (2 * b * Q) + 1, 1), length + 1)


def _room(near: IntegerPair, far: IntegerPair, most: IntegerPair) -> int:
    """The most steps from `near` towards `far` within the bounds."""
    return min((bound - p) // step for p, step, bound in zip(near, far, most, strict=True) if step)


def _onward(before: IntegerPair, at: IntegerPair, most: IntegerPair) -> Iterator[IntegerPair]:
    """`at` and all fractions above it within the bounds, ascending; `before` is its lower neighbour."""
    (a, b), (c, d) = before, at
    while d:
        yield c, d
        k = min((most[0] + a) // c, (most[1] + b) // d)
        a, b, c, d = c, d, k * c - a, k * d - b


def _check(value: Fraction, most_numerator: int, most_denominator: int) -> None:
    if value <= 0 or most_numerator < 1 or most_denominator < 1:
        raise QuestionError(
            Problem(
                f"no fractions near {value} up to {most_numerator}/{most_denominator}",
                "numbers and bounds must be positive",
                "give a positive number and bounds of 1 or more",
            )
        )
