"""Fractions near a number by exact traversal of the Stern-Brocot tree.

Sources: M. A. Stern, Ueber eine zahlentheoretische Funktion, J. reine angew. Math. 55 (1858); A. Brocot, Calcul des
rouages par approximation, Revue chronometrique 3 (1861). The tree contains every positive reduced fraction once, as the
mediant (a + c)/(b + d) of two neighbours a/b < c/d with bc - ad = 1. The lengths of the straight runs of the path to a
number are the terms of its continued fraction, so a run is processed in one step.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import ClassVar, Literal

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.exact import coprime
from geartrain.numerics.results import Key, Result, Tabular
from geartrain.search.target_ratio import TargetRatio

ApproximantKind = Literal["convergent", "best", "intermediate"]
IntegerPair = tuple[int, int]
"""Numerator and denominator of a fraction; (1, 0) represents infinity."""

_MOST_LISTED = 10**5  # a single run may have as many fractions as the bound


@dataclass(frozen=True, slots=True)
class Approximant(Result):
    """Fraction that approximates a given number and is on the path to that number in the Stern-Brocot tree."""

    KEYS = ("value", "kind", Key("error", to=float), Key("exact_error", "error"))

    value: Fraction
    """Positive value of the fraction."""
    error: Fraction
    """Exact relative error of the fraction: `value` divided by the approximated number, minus 1."""
    kind: ApproximantKind
    """Type of the approximation. "convergent": a convergent of the continued fraction. "best": another fraction that is
    nearer than every other positive fraction whose denominator is not larger (a best approximation of the first kind).
    "intermediate": any other fraction on the path.
    """


@dataclass(frozen=True, slots=True)
class Approximants(Tabular, Result):
    """Fractions that approximate a ratio, on the path to this ratio in the Stern-Brocot tree."""

    ROWS = "search.tooth_numbers_report:approximant_rows"
    ROW = "Approximant"
    MEANINGS: ClassVar = {
        "error": "Fraction divided by the requested ratio, minus 1 [1].",
        "exact_error": "Error as a fraction [1].",
    }

    PAGE = "search.tooth_numbers_report:describe_approximants"

    wanted: TargetRatio
    """Requested ratio."""
    most: int
    """Maximum value of the numerator and of the denominator of a fraction."""
    solutions: tuple[Approximant, ...]
    """Fractions in the order of the path to the ratio in the Stern-Brocot tree."""

    def _summary(self) -> str:
        label = self.wanted.label or self.wanted.value
        last = f", last {self.solutions[-1].value}" if self.solutions else ""
        return f"{label}: {len(self.solutions)} fractions up to {self.most}{last}"


@dataclass(frozen=True, slots=True)
class SternBrocotRun:
    """Straight run of a path in the Stern-Brocot tree: the fractions (p + k P)/(q + k Q) for k from 1 to `length`,
    which lead from p/q towards P/Q.
    """

    near: IntegerPair
    """Numerator and denominator (p, q) of the last fraction before the straight run. It is on the same side of the
    approximated number as the fractions in the run.
    """
    far: IntegerPair
    """Numerator and denominator (P, Q) of the fraction on the opposite side of the approximated number."""
    whole: int
    """Partial quotient of the continued fraction: the number of fractions in the run without bounds on the numerator
    and the denominator. The fraction with this index k is a convergent.
    """
    length: int
    """Number of fractions in the straight run whose numerator and denominator are within the bounds."""
    best: int
    """Minimum index k from which all fractions in the run are best approximations of the first kind; `length` + 1 if no
    fraction in the run is one.
    """

    def at(self, k: int) -> Fraction:
        """Return the fraction with index k of the straight run of the path: (p + k P)/(q + k Q), where (p, q) is `near`
        and (P, Q) is `far`.
        """
        return coprime(self.near[0] + k * self.far[0], self.near[1] + k * self.far[1])

    def kind(self, k: int) -> ApproximantKind:
        """Return the type of the approximation by the fraction with index k in the straight run."""
        if k == self.whole:
            return "convergent"
        return "best" if k >= self.best else "intermediate"


def runs(value: Fraction, most: IntegerPair) -> Iterator[SternBrocotRun]:
    """Yield the straight runs of the path to `value` > 0 in the Stern-Brocot tree. `most` contains the maximum
    numerator and the maximum denominator of a fraction.
    """
    if value <= 0 or min(most) < 1:
        raise QuestionError(
            Problem(
                f"no fractions exist near {value} up to {most[0]}/{most[1]}",
                "numbers and bounds must be positive",
                "give a positive number and bounds of 1 or more",
            )
        )
    left, right = value.numerator, value.denominator
    near, far = (0, 1), (1, 0)
    while right:
        # Euclidean algorithm: each quotient is a term of the continued fraction, the length of one run
        term, rest = divmod(left, right)
        room = min((bound - p) // step if step else term for p, step, bound in zip(near, far, most, strict=True))
        length = min(term, room)
        if length:
            yield SternBrocotRun(near, far, term, length, _first_best(value, near, far, length))
        # the bounds end the path before the end of the run
        if room < term:
            return
        near, far = far, (near[0] + term * far[0], near[1] + term * far[1])
        left, right = right, rest


def approximants(value: Fraction, most: int, minimum: ApproximantKind = "intermediate") -> tuple[Approximant, ...]:
    """List every fraction on the path to a number in the Stern-Brocot tree, in the order of the path.

    Parameters
    ----------
    value : Fraction
        Number to approximate, above 0.
    most : int
        Maximum numerator and denominator.
    minimum : {"convergent", "best", "intermediate"}
        Kinds of fractions to be listed. "convergent": only the convergents of the continued fraction; "best": also the
        best approximations of the first kind; "intermediate": all fractions on the path.

    Returns
    -------
    tuple of Approximant
        Fractions. The last fraction is `value` if it is within the bound. If it is not, and `minimum` is
        "intermediate", the last fraction below `value` and the last fraction above it are the nearest fractions within
        the bound.

    Raises
    ------
    QuestionError
        If the number or the bound is not positive.
    RangeError
        If there are more than 10^5 fractions, which does not occur with "convergent".

    References
    ----------
    M. A. Stern, J. reine angew. Math. 55 (1858); A. Brocot, Revue chronometrique 3 (1861).

    Examples
    --------
    >>> [str(found.value) for found in approximants(Fraction(191, 23), 100, "best")]
    ['8', '17/2', '25/3', '58/7', '83/10']
    """
    found: list[Approximant] = []
    for run in runs(value, (most, most)):
        first = {"convergent": run.whole, "best": min(run.best, run.whole), "intermediate": 1}[minimum]
        if len(found) + run.length - first >= _MOST_LISTED:
            raise RangeError(
                Problem(
                    f"more than {_MOST_LISTED} fractions approximate this ratio",
                    f"the branch of the Stern-Brocot tree from {run.at(1)} to {run.at(run.length)} has {run.length} "
                    "fractions",
                    "reduce the bound, or list only the convergents",
                )
            )
        for k in range(first, run.length + 1):
            fraction = run.at(k)
            found.append(Approximant(fraction, fraction / value - 1, run.kind(k)))
    return tuple(found)


def farey_neighbours(value: Fraction, most: int) -> tuple[Fraction, Fraction]:
    """Return the largest fraction <= `value` and the smallest fraction >= `value` whose denominators do not exceed
    `most`.

    The argument `value` must be at least 0, and `most` must be at least 1.

    >>> farey_neighbours(Fraction(314159, 100000), 100)
    (Fraction(311, 99), Fraction(22, 7))
    """
    if value.denominator <= most:
        return value, value
    # no numerator of a neighbour exceeds this, so only the denominators are bounded
    # the ends of the last run are the nearest fractions within the bounds, one on each side of `value`
    *_, last = runs(value, ((int(value) + 1) * most, most))
    low, high = sorted((last.at(last.length), Fraction(*last.far)))
    return low, high


def _first_best(value: Fraction, near: IntegerPair, far: IntegerPair, length: int) -> int:
    """Return the minimum index k, from 1 to `length`, for which the fraction (p + k P)/(q + k Q) has a smaller distance
    from `value` than the fraction P/Q has; `length` + 1 if there is none.

    near, far   numerator and denominator of two fractions, (p, q) and (P, Q)
    """
    # the fractions approach `value`, and all fractions between them and `value` have larger denominators, so each is
    # only compared with P/Q on the opposite side; towards infinity, the integers are compared with the next integer
    if not far[1]:
        return length if value - length < Fraction(1, 2) else length + 1
    # the opposite end is 0, which is not a gear ratio
    if not far[0]:
        return 1
    n, d = value.numerator, value.denominator
    p, q, P, Q = *near, *far
    # |d (p + k P) - n (q + k Q)| / (q + k Q) < |d P - n Q| / Q, where the left numerator is a - k b
    a, b = abs(d * p - n * q), abs(d * P - n * Q)
    return min(max((Q * a - b * q) // (2 * b * Q) + 1, 1), length + 1)
