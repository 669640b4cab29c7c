"""Problem of a search for gear stages with a given ratio: ratio, constraints, feasible pairings, and orders of
solutions.

The orders are total orders, and do not depend on the sequence in which solutions are found.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import combinations, permutations, product
from math import prod
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Result
from geartrain.search.ratio.product_windows import ProductWindows, multisets, products_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools

    Ints = NDArray[Any]


Set = tuple[int, ...]
Pairs = tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True)
class StageConstraints(Result):
    """Constraints on the tooth counts of a train of stages. At least one pairing of the tooth counts must satisfy all
    constraints.

    Examples
    --------
    >>> StageConstraints(reverted=True, internal=1).sense(stages=2)
    -1
    """

    hunting: bool = False
    """True to require that the two tooth counts of every stage are coprime, so that every tooth meets every tooth of
    the mating wheel.
    """
    reverted: bool = False
    """True to require that all stages have equal centre distances if they have the same module. This requires that the
    sum of the tooth counts of each external stage, and their difference in each internal stage, have one common value.
    """
    different: bool = False
    """True to require that all tooth counts are distinct."""
    internal: int = 0
    """Number of internal meshes, 0 to the number of stages. An internal mesh preserves the sense of rotation; an
    external mesh reverses it. A ring has more teeth than its pinion.
    """
    maximum_total: int | None = None
    """Maximum sum of all tooth counts; None if the sum is not limited."""

    def sense(self, stages: int) -> int:
        """Return 1 if the output and the input turn in the same sense, or -1 if they turn in opposite senses.

        Parameters
        ----------
        stages : int
            Number of gear pairs in series.
        """
        return -1 if (stages - self.internal) % 2 else 1

    @property
    def pairs_matter(self) -> bool:
        """True if a constraint depends on which numerator count is paired with which denominator count."""
        return self.hunting or self.reverted or self.internal > 0

    @property
    def free(self) -> bool:
        """True if there are no constraints, so that every pair of multisets of tooth counts is accepted."""
        return not (self.pairs_matter or self.different or self.maximum_total is not None)

    def check(self, stages: int) -> None:
        """Raise `QuestionError` if `internal` exceeds the number of stages.

        Parameters
        ----------
        stages : int
            Number of gear pairs in series.
        """
        if not 0 <= self.internal <= stages:
            raise QuestionError(
                Problem(
                    f"the number of internal meshes is {self.internal}",
                    f"a train of {stages} stages has 0 to {stages} internal meshes",
                    f"give a number from 0 to {stages}",
                )
            )


@dataclass(frozen=True)
class StageProblem:
    """Search problem: find quotients of two products of `stages` tooth counts each that are within a tolerance of a
    value.
    """

    value: Fraction
    """Requested positive ratio: numerator product divided by denominator product."""
    stages: int
    """Number of stages, 1 to 5."""
    top: Set
    """Admissible tooth counts in the numerator, in ascending order."""
    beneath: Set
    """Admissible tooth counts in the denominator, in ascending order."""
    fit: StageConstraints
    """Constraints on the tooth counts."""
    by: str
    """Name of the order of the solutions, a `StageOrder`."""
    best: int
    """Number of solutions to keep."""
    tolerance: Fraction
    """Maximum absolute relative error of the ratio."""

    @cached_property
    def over(self) -> ProductWindows:
        """Products of all multisets of tooth counts in the numerator."""
        return products_of(self.top, self.stages)

    @cached_property
    def under(self) -> ProductWindows:
        """Products of all multisets of tooth counts in the denominator."""
        return products_of(self.beneath, self.stages)

    @property
    def reach(self) -> tuple[Fraction, Fraction]:
        """Minimum and maximum ratio of a numerator product to a denominator product."""
        low, high = Fraction(self.top[0], self.beneath[-1]), Fraction(self.top[-1], self.beneath[0])
        return low**self.stages, high**self.stages

    @cached_property
    def ratio_bounds(self) -> tuple[Fraction, Fraction]:
        """Minimum and maximum ratio in the intersection of two intervals: the ratios within the tolerance, and the
        ratios within `reach`.
        """
        minimum, most = self.reach
        return max(self.value * (1 - self.tolerance), minimum), min(self.value * (1 + self.tolerance), most)

    @property
    def reachable(self) -> bool:
        """True if a ratio of products may be within the tolerance."""
        low, high = self.ratio_bounds
        return low <= high

    @property
    def considered(self) -> int:
        """Number of pairs of a multiset of numerator counts and a multiset of denominator counts."""
        return multisets(len(self.top), self.stages) * multisets(len(self.beneath), self.stages)

    @property
    def of_equal_sums(self) -> bool:
        """True if all stages must have the same sum of tooth counts."""
        return self.fit.reverted and not self.fit.internal

    @property
    def candidates(self) -> int:
        """Number of candidates: pairs of multisets of tooth counts, or multisets of stages if all stages must have
        equal sums of tooth counts.
        """
        if not self.of_equal_sums:
            return self.considered
        sums = Counter(a + b for a in self.top for b in self.beneath)
        return sum(multisets(stages, self.stages) for stages in sums.values())

    @property
    def accepts_all(self) -> bool:
        """True if the constraints reject no pair of multisets whose ratio is within the tolerance."""
        low, high = self.ratio_bounds
        # one internal mesh is always possible unless all counts are equal, and then the ratio is 1
        ring_alone = self.fit.internal == 1 and not low <= 1 <= high
        return self.fit.free or (ring_alone and replace(self.fit, internal=0).free)


# ------------------------------------------------------------ pairings of the counts of two multisets to stages


def pairings(tops: Ints, beneaths: Ints, fit: StageConstraints) -> tuple[Bools, Ints, Ints]:
    """Evaluate, for n pairs of multisets, all pairings of the k numerator counts in a row of `tops` with the k
    denominator counts in the same row of `beneaths`. Each permutation is combined with each choice of `fit.internal`
    internal meshes.

    Return three arrays of shape (n, number of pairings): whether the pairing satisfies the constraints, the number of
    stages with coprime tooth counts, and the number of distinct centre distances. Column i is the pairing in row i of
    the arrays that `_arrangements` returns.
    """
    orders, rings = _arrangements(tops.shape[1], fit.internal)
    tall, short = tops[:, None, :], beneaths[:, orders]
    # one table of k x k divisors serves all k! pairings
    coprime = (np.gcd(tops[:, :, None], beneaths[:, None, :]) == 1)[:, np.arange(tops.shape[1]), orders].sum(axis=2)
    # twice the centre distance in modules; 0 for a ring and a pinion with equal counts
    distances = np.sort(np.where(rings, np.abs(tall - short), tall + short), axis=2)
    centres = 1 + (distances[:, :, 1:] != distances[:, :, :-1]).sum(axis=2)
    possible = distances[:, :, 0] > 0
    if fit.hunting:
        possible &= coprime == tops.shape[1]
    if fit.reverted:
        possible &= centres == 1
    return np.asarray(possible), np.asarray(coprime), np.asarray(centres)


@lru_cache(maxsize=32)
def _arrangements(size: int, internal: int) -> tuple[Ints, Bools]:
    """Return all combinations of an order of the denominator tooth counts and a choice of the internal stages.

    The first array contains the orders as permutations of indices, the second is True for internal stages. Both have
    the shape (combinations, size).
    """
    choices = [[stage in chosen for stage in range(size)] for chosen in combinations(range(size), internal)]
    both = list(product(permutations(range(size)), choices))
    return np.array([order for order, _ in both], dtype=np.int64), np.array([rings for _, rings in both], dtype=bool)


def best_pairing(top: Set, beneath: Set, fit: StageConstraints, centres: bool) -> Pairs | None:
    """Return the best pairing of numerator and denominator counts that satisfies the constraints, or None if no pairing
    satisfies them.

    The criteria are, in this order: the minimum number of distinct centre distances (only if `centres` is True), the
    maximum number of stages with coprime tooth counts, and the minimum quotient of the largest and the smallest stage
    ratio. The last `fit.internal` pairs are internal. The external pairs and the internal pairs are each in ascending
    order.

    >>> best_pairing((39, 73, 91), (15, 34, 38), StageConstraints(), centres=False)  # 39 and 15 have a common divisor
    ((39, 34), (73, 15), (91, 38))
    """
    orders, rings = _arrangements(len(top), fit.internal)
    possible, coprime, kinds = (each[0] for each in pairings(np.array([top]), np.array([beneath]), fit))
    # one integer for a lexicographic order, because `coprime` is at most len(top)
    merits = (len(top) + 1) * kinds * centres - coprime
    # a set, because repeated counts give equal pairings
    best: set[Pairs] = set()
    for at in np.flatnonzero(possible & (merits == merits[possible].min(initial=np.iinfo(np.int64).max))).tolist():
        stages = zip(rings[at].tolist(), top, (beneath[own] for own in orders[at]), strict=True)
        best.add(tuple((a, b) for _, a, b in sorted(stages)))
    return min(best, key=lambda pairs: (_spread(pairs), pairs), default=None)


def _spread(pairs: Pairs) -> Fraction:
    """Return the largest stage ratio divided by the smallest stage ratio."""
    # over a common denominator, integers instead of fractions
    scale = prod(b for _, b in pairs)
    ratios = [a * (scale // b) for a, b in pairs]
    return Fraction(max(ratios), min(ratios))


# ----------------------------------------------------------------------------------------------------- total orders


StageOrder = Literal["error", "total", "largest", "distinct", "hunting", "centres"]
"""Primary criterion of the order of solutions: minimum absolute error, minimum sum of tooth counts, minimum largest
tooth count, minimum number of distinct tooth counts, maximum number of stages with coprime tooth counts, or minimum
number of centre distances.

Ties are broken by absolute error, sum of tooth counts, largest tooth count, and the tooth counts.
"""

StageRank = tuple[int, Fraction, int, int, Set, Set]
"""Sort key of a solution: primary criterion, absolute error, sum of tooth counts, largest tooth count, tooth counts of
the numerator and tooth counts of the denominator.
"""


def first_of(by: str, tops: Ints, beneaths: Ints, fit: StageConstraints) -> Ints:
    """Return the number by which n solutions are primarily sorted in the order `by`, shape (n,); smaller numbers come
    first. All numbers are 0 if the order is "error".

    `tops` and `beneaths` contain the tooth counts of numerators and denominators, shape (n, k) each, where k is the
    number of stages.
    """
    if by in ("hunting", "centres"):
        possible, coprime, centres = pairings(tops, beneaths, fit)
        if by == "hunting":
            return np.asarray(-np.where(possible, coprime, 0).max(axis=1))
        # infeasible pairings rank behind all feasible ones
        return np.asarray(np.where(possible, centres, 2 * tops.shape[1]).min(axis=1))
    if by == "total":
        return np.asarray(tops.sum(axis=1) + beneaths.sum(axis=1))
    if by == "largest":
        return np.maximum(tops[:, -1], beneaths[:, -1])
    if by == "distinct":
        both = np.sort(np.concatenate([tops, beneaths], axis=1), axis=1)
        return np.asarray(1 + (both[:, 1:] != both[:, :-1]).sum(axis=1))
    return np.zeros(len(tops), dtype=np.int64)


def key_of(first: int, top: Sequence[int], beneath: Sequence[int], value: Fraction) -> StageRank:
    """Return the sort key of a solution: the primary criterion `first`, absolute error, sum of tooth counts, largest
    tooth count, and tooth counts. `value` is the requested ratio.
    """
    miss = abs(Fraction(prod(top), prod(beneath)) / value - 1)
    return first, miss, sum(top) + sum(beneath), max(*top, *beneath), tuple(top), tuple(beneath)
