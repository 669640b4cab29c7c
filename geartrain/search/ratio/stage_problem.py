"""Problem data of a search for one ratio by stages: ratio, constraints, feasible pairings, orders of solutions.

The orders are total, and do not depend on the sequence in which solutions are found.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import combinations, permutations
from math import gcd, prod
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.results import Result
from geartrain.search.ratio.product_windows import PLAIN, ROUNDING, ProductWindows, error_places, multisets, products_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats

    Ints = NDArray[Any]


Set = tuple[int, ...]
Pairs = tuple[tuple[int, int], ...]
_CHUNK = 1 << 18  # numbers in one vectorised step
_TABLE = 1024  # maximum count of the lookup table of coprime pairs


@dataclass(frozen=True, slots=True)
class StageConstraints(Result):
    """Constraints on the tooth counts of a train of stages. At least one pairing of the counts must satisfy all of
    them.

    Examples
    --------
    >>> StageConstraints(reverted=True, internal=1).sense(stages=2)
    -1
    """

    hunting: bool = False
    """Requirement that the two counts of every stage are coprime, so that every tooth meets every tooth of its mate."""
    reverted: bool = False
    """Requirement that all stages have the same centre distance at the same module: equal sums of their counts, or
    equal differences for a stage with a ring.
    """
    different: bool = False
    """Requirement that all counts are distinct."""
    internal: int = 0
    """Number of internal meshes, 0 to the number of stages. An internal mesh preserves the sense of rotation, an
    external mesh reverses it. A ring has more teeth than its pinion.
    """
    minimum_total: int | None = None
    """Minimum sum of all counts."""
    maximum_total: int | None = None
    """Maximum sum of all counts."""
    largest: int | None = None
    """Maximum tooth count of a wheel."""

    def sense(self, stages: int) -> int:
        """Return 1 if output and input turn in the same sense, -1 if they turn in opposite senses.

        Parameters
        ----------
        stages : int
            Number of gear pairs in series.
        """
        return -1 if (stages - self.internal) % 2 else 1

    @property
    def pairs_matter(self) -> bool:
        """True if a constraint depends on the pairing of the counts."""
        return self.hunting or self.reverted or self.internal > 0

    @property
    def totals(self) -> tuple[int, int]:
        """Minimum and maximum sum of all counts."""
        minimum = 0 if self.minimum_total is None else self.minimum_total
        return minimum, (1 << 62) if self.maximum_total is None else self.maximum_total

    @property
    def totals_matter(self) -> bool:
        """True if the sum of all counts is bounded."""
        return self.minimum_total is not None or self.maximum_total is not None

    @property
    def free(self) -> bool:
        """True if every pair of multisets satisfies all constraints except `largest`."""
        return not (self.pairs_matter or self.different or self.totals_matter)

    def check(self, stages: int) -> None:
        """Raise `QuestionError` if no train with this number of stages can satisfy the constraints.

        Parameters
        ----------
        stages : int
            Number of gear pairs in series.
        """
        if not 0 <= self.internal <= stages:
            raise QuestionError(
                Problem(
                    f"internal is {self.internal}",
                    f"with {stages} meshes, 0 to {stages} can be internal",
                    f"give internal from 0 to {stages}",
                )
            )
        minimum, most = self.totals
        if minimum > most:
            what = f"minimum_total is {minimum}, maximum_total is {most}"
            raise QuestionError(Problem(what, "the minimum exceeds the maximum", "exchange them, or omit one"))


@dataclass(frozen=True)
class StageProblem:
    """Search for quotients of two products of `stages` counts each that are within a tolerance of a value."""

    value: Fraction
    """Requested ratio, positive."""
    stages: int
    """Number of stages, 1 to 5."""
    top: Set
    """Admissible counts of the numerator, ascending."""
    beneath: Set
    """Admissible counts of the denominator, ascending."""
    fit: StageConstraints
    """Constraints on the tooth counts; `largest` is already applied to `top` and `beneath`."""
    by: str
    """Order of the solutions, a `StageOrder`."""
    best: int
    """Number of solutions to keep."""
    tolerance: Fraction
    """Maximum absolute relative error of the ratio."""

    @property
    def plain_integers(self) -> bool:
        """True if int64 and float64 represent all products exactly."""
        return bool(max(self.top[-1:] + self.beneath[-1:], default=1) ** self.stages < PLAIN)

    @cached_property
    def over(self) -> ProductWindows:
        """Products of the numerator counts."""
        return products_of(self.top, self.stages, self.plain_integers)

    @cached_property
    def under(self) -> ProductWindows:
        """Products of the denominator counts."""
        return products_of(self.beneath, self.stages, self.plain_integers)

    @property
    def reach(self) -> tuple[Fraction, Fraction]:
        """Minimum and maximum ratio of the products."""
        low, high = Fraction(self.top[0], self.beneath[-1]), Fraction(self.top[-1], self.beneath[0])
        return low**self.stages, high**self.stages

    @cached_property
    def edges(self) -> tuple[Fraction, Fraction]:
        """Minimum and maximum ratio that are within the tolerance and within the range of the products."""
        minimum, most = self.reach
        return max(self.value * (1 - self.tolerance), minimum), min(self.value * (1 + self.tolerance), most)

    @property
    def reachable(self) -> bool:
        """True if a ratio of the products may be within the tolerance."""
        low, high = self.edges
        return low <= high

    @property
    def considered(self) -> int:
        """Number of pairs of multisets, one for the numerator and one for the denominator."""
        return multisets(len(self.top), self.stages) * multisets(len(self.beneath), self.stages)

    def beneath_within(self, low: int, high: int) -> tuple[int, int]:
        """Return the part of the range [low, high) of denominator products in which a numerator product can match."""
        first, last = self.edges
        minimum, most = self.top[0] ** self.stages, self.top[-1] ** self.stages
        return max(low, -(-minimum * last.denominator // last.numerator)), min(
            high, most * first.denominator // first.numerator + 1
        )

    def tops_for(self, low: int, high: int) -> tuple[int, int]:
        """Return the half-open range of the numerator products that can match denominator products in [low, high)."""
        first, last = self.edges
        minimum, most = self.top[0] ** self.stages, self.top[-1] ** self.stages
        return max(-(-low * first.numerator // first.denominator), minimum), min(
            (high - 1) * last.numerator // last.denominator, most
        ) + 1

    @property
    def loose(self) -> bool:
        """True if every pair of multisets within the tolerance is a solution."""
        low, high = self.edges
        # one internal mesh is always possible unless all counts are equal, and then the ratio is 1
        ring_alone = self.fit.internal == 1 and not low <= 1 <= high
        return self.fit.free or (ring_alone and replace(self.fit, internal=0).free)

    def plain(self) -> dict[str, Any]:
        """Return the problem as plain data for JSON."""
        return {
            "value": fraction_text(self.value),
            "stages": self.stages,
            "top": list(self.top),
            "beneath": list(self.beneath),
            "fit": self.fit.to_dict(),
            "by": self.by,
            "best": self.best,
            "tolerance": str(self.tolerance),
        }


def stage_problem_of(plain: Mapping[str, Any]) -> StageProblem:
    """Build the problem from the plain data of `StageProblem.plain`."""
    return StageProblem(
        Fraction(plain["value"]),
        plain["stages"],
        tuple(plain["top"]),
        tuple(plain["beneath"]),
        StageConstraints(**plain["fit"]),
        plain["by"],
        plain["best"],
        Fraction(plain["tolerance"]),
    )


# ------------------------------------------------------------ pairings of the counts of two multisets to stages


@dataclass(frozen=True, slots=True)
class FeasiblePairings:
    """Best properties of the feasible pairings of numerator and denominator counts, for n pairs of multisets."""

    possible: Bools
    """True if some pairing satisfies the constraints, shape (n,)."""
    coprime: Ints
    """Maximum number of stages with coprime counts over the feasible pairings, shape (n,); 0 if no pairing
    is feasible.
    """
    centres: Ints
    """Minimum number of distinct centre distances over the feasible pairings, shape (n,); 2 k if no pairing is
    feasible.
    """

    def taken(self, at: Ints) -> FeasiblePairings:
        """Return the rows at the given indices."""
        return FeasiblePairings(self.possible[at], self.coprime[at], self.centres[at])


def suited(
    tops: Ints, beneaths: Ints, fit: StageConstraints, *, coprime: bool = True, centres: bool = True
) -> FeasiblePairings:
    """Evaluate all k! pairings of numerator and denominator counts, shape (n, k) each, with all choices of internal
    meshes.

    coprime, centres   False if this property is not needed; it is then not evaluated
    """
    size = tops.shape[1]
    step = max(_CHUNK // (len(_arrangements(size, fit.internal)[0]) * size), 1)
    # at least one chunk, so that an empty result has its columns too
    parts = [
        _evaluate_chunk(tops[at : at + step], beneaths[at : at + step], fit, coprime, centres)
        for at in range(0, max(len(tops), 1), step)
    ]
    return FeasiblePairings(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _evaluate_chunk(
    tops: Ints, beneaths: Ints, fit: StageConstraints, coprime: bool, centres: bool
) -> tuple[Bools, Ints, Ints]:
    """Return the columns of `FeasiblePairings` for some rows of numerator and denominator counts."""
    size = tops.shape[1]
    orders, rings, meshes, ringed = _arrangements(size, fit.internal)
    possible = np.ones((len(tops), len(orders)), dtype=bool)
    alone = kinds = np.zeros(possible.shape, dtype=np.int64)
    if fit.hunting or coprime:
        # pairs as a bit mask: one `and` tests an arrangement
        alone = np.bitwise_count(_code(_coprime(tops, beneaths))[:, None] & meshes).astype(np.int64)
        if fit.hunting:
            possible &= alone == size
    if fit.internal:
        # a ring and its pinion must have different counts
        possible &= (_code(tops[:, :, None] != beneaths[:, None, :])[:, None] & ringed) == ringed
    if fit.reverted or centres:
        tall, short = tops[:, None, :], beneaths[:, orders]
        # twice the centre distance in modules
        distances = np.where(rings, np.abs(tall - short), tall + short)
        if fit.reverted:
            possible &= (distances[:, :, 1:] == distances[:, :, :1]).all(axis=2)
        if centres:
            distances.sort(axis=2)
            kinds = 1 + (distances[:, :, 1:] != distances[:, :, :-1]).sum(axis=2)
    return (
        np.asarray(possible.any(axis=1)),
        np.where(possible, alone, 0).max(axis=1),
        np.where(possible, kinds, 2 * size).min(axis=1),
    )


def _code(table: Bools) -> Ints:
    """Encode a boolean table of size x size as a bit mask, in which bit size i + j is entry (i, j).

    Entry (i, j) belongs to numerator count i and denominator count j.
    """
    size = table.shape[1]
    return table.reshape(len(table), size * size) @ (1 << np.arange(size * size, dtype=np.int64))


def _coprime(tops: Ints, beneaths: Ints) -> Bools:
    """Return whether each numerator count is coprime to each denominator count, shape (n, k, k)."""
    most = int(max(tops.max(initial=1), beneaths.max(initial=1)))
    if most > _TABLE:
        return np.asarray(np.gcd(tops[:, :, None], beneaths[:, None, :]) == 1)
    return np.asarray(_coprime_table()[tops[:, :, None], beneaths[:, None, :]])


@lru_cache(maxsize=1)
def _coprime_table() -> Bools:
    numbers = np.arange(_TABLE + 1)
    return np.asarray(np.gcd(numbers[:, None], numbers) == 1)


@lru_cache(maxsize=32)
def _arrangements(size: int, internal: int) -> tuple[Ints, Bools, Ints, Ints]:
    """Return every permutation of the denominator counts with every choice of the internal stages.

    The arrays are permutations and choices, shape (arrangements, size) each, and the bit masks of all meshes and of the
    internal meshes, shape (arrangements,) each, encoded as by `_code`.
    """
    choices = [[stage in chosen for stage in range(size)] for chosen in combinations(range(size), internal)]
    both = [(order, choice) for order in permutations(range(size)) for choice in choices]
    orders = np.array([order for order, _ in both], dtype=np.int64)
    rings = np.array([choice for _, choice in both], dtype=bool)
    bits = 1 << (size * np.arange(size) + orders)
    return orders, rings, bits.sum(axis=1), (bits * rings).sum(axis=1)


def best_pairing(
    top: tuple[int, ...], beneath: tuple[int, ...], fit: StageConstraints | None = None, *, centres: bool = False
) -> Pairs | None:
    """Return the best pairing that satisfies the constraints, or None if no pairing does.

    The criteria are, in this order, the number of distinct centre distances (only if `centres`), the number of stages
    with coprime counts, and the quotient of the maximum and the minimum ratio of a stage. The last `fit.internal` of
    the pairs are internal; external and internal pairs are ascending.

    >>> best_pairing((39, 73, 91), (15, 34, 38))  # 39 and 15 have a common divisor
    ((39, 34), (73, 15), (91, 38))
    """
    fit = fit or StageConstraints()
    found: dict[Pairs, tuple[int, int]] = {}
    # a set, because repeated counts give equal permutations
    for order in set(permutations(beneath)):
        stages = tuple(zip(top, order, strict=True))
        for chosen in combinations(range(len(stages)), fit.internal):
            pairs = _sorted(stages, chosen)
            merit = _merit(pairs, fit, centres)
            if merit:
                found[pairs] = merit
    if not found:
        return None
    # a common multiple of the denominators, so that ratios are compared as integers
    minimum, scale = min(found.values()), prod(beneath)
    return min((_spread(pairs, scale), pairs) for pairs, merit in found.items() if merit == minimum)[1]


def _sorted(stages: Pairs, chosen: tuple[int, ...]) -> Pairs:
    """Return the external pairs, ascending, followed by the internal pairs, ascending."""
    if not chosen:
        return tuple(sorted(stages))
    plain = sorted(pair for at, pair in enumerate(stages) if at not in chosen)
    return (*plain, *sorted(stages[at] for at in chosen))


def _merit(pairs: Pairs, fit: StageConstraints, centres: bool) -> tuple[int, int] | None:
    """Return the sort key of a pairing: number of centre distances, minus number of coprime stages; None if
    infeasible.
    """
    border = len(pairs) - fit.internal
    coprime = sum(gcd(a, b) == 1 for a, b in pairs)
    if (fit.hunting and coprime < len(pairs)) or any(a == b for a, b in pairs[border:]):
        return None
    distances = 0
    if fit.reverted or centres:
        distances = len({a + b if at < border else abs(a - b) for at, (a, b) in enumerate(pairs)})
        if fit.reverted and distances > 1:
            return None
    return distances if centres else 0, -coprime


def _spread(pairs: Pairs, scale: int) -> Fraction:
    """Return the quotient of the maximum and minimum ratio of a stage; `scale` is a multiple of all denominator
    counts.
    """
    ratios = [a * (scale // b) for a, b in pairs]
    return Fraction(max(ratios), min(ratios))


# ----------------------------------------------------------------------------------------------------- total orders


StageOrder = Literal["error", "total", "largest", "distinct", "hunting", "centres"]
"""Primary criterion of the order of solutions: minimum absolute error, sum of counts, largest count or number of
distinct counts; maximum number of stages with coprime counts; minimum number of centre distances.

Ties are broken by absolute error, sum, largest count, and the counts.
"""

StageRank = tuple[int, Fraction, int, int, Set, Set]
"""Sort key of a solution: primary criterion, absolute error, sum, largest count, counts of numerator and denominator.
"""


def check_order(by: str) -> None:
    """Raise `QuestionError` if the name of an order is unknown."""
    if by not in get_args(StageOrder):
        known = ", ".join(get_args(StageOrder))
        raise QuestionError(
            Problem(
                f"'{by}' is not an order of solutions", "the order is one predefined criterion", f"use one of {known}"
            )
        )


@dataclass(frozen=True, slots=True)
class RankedStages:
    """Candidate solutions as columns of n rows, with k tooth counts on each side."""

    top: Ints
    """Numerator counts, ascending in each row, shape (n, k)."""
    beneath: Ints
    """Denominator counts, ascending in each row, shape (n, k)."""
    over: Ints
    """Products of the numerator counts, shape (n,)."""
    under: Ints
    """Products of the denominator counts, shape (n,)."""
    first: Ints
    """Primary criterion of the order; smaller is better, shape (n,)."""
    error: Floats
    """Approximate absolute relative error, used for pruning, shape (n,)."""

    def __len__(self) -> int:
        return len(self.first)

    def taken(self, at: Ints) -> RankedStages:
        """Return the rows at the given indices."""
        columns = (self.top, self.beneath, self.over, self.under, self.first, self.error)
        return RankedStages(*(column[at] for column in columns))

    @classmethod
    def joined(cls, parts: Sequence[RankedStages]) -> RankedStages:
        """Join the rows of all parts into one set of arrays."""
        names = cls.__slots__
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def first_of(by: str, tops: Ints, beneaths: Ints, fit: StageConstraints, found: FeasiblePairings | None = None) -> Ints:
    """Return the primary sort criterion (smaller is better) for numerator and denominator counts, shape (n, k) each."""
    if by in ("hunting", "centres"):
        found = found or suited(tops, beneaths, fit, coprime=by == "hunting", centres=by == "centres")
        return -found.coprime if by == "hunting" else found.centres
    if by == "total":
        return np.asarray(tops.sum(axis=1) + beneaths.sum(axis=1))
    if by == "largest":
        return np.maximum(tops[:, -1], beneaths[:, -1])
    if by == "distinct":
        both = np.sort(np.concatenate([tops, beneaths], axis=1), axis=1)
        return np.asarray(1 + (both[:, 1:] != both[:, :-1]).sum(axis=1))
    return np.zeros(len(tops), dtype=np.int64)


def margin(error: float) -> float:
    """Return an upper bound of an exact error whose approximation is `error`."""
    # much larger than the relative error of 1e-12 of the approximations
    return error * (1 + 1e-9) + 2 * ROUNDING


def cut(rows: RankedStages, best: int, value: Fraction) -> RankedStages:
    """Return the first `best` rows in their exact order."""
    if len(rows) > best:
        # approximate errors select slightly too many, which are then compared as Fractions
        order = np.lexsort((rows.error, rows.first))
        last = order[best - 1]
        first, error = rows.first[last], margin(float(rows.error[last]))
        rows = rows.taken(np.flatnonzero((rows.first < first) | ((rows.first == first) & (rows.error <= error))))
    sums = rows.top.sum(axis=1) + rows.beneath.sum(axis=1)
    largest = np.maximum(rows.top[:, -1], rows.beneath[:, -1])
    # lexsort takes its last key first
    counts = [np.asarray(each, dtype=np.int64) for each in [*rows.top.T, *rows.beneath.T][::-1]]
    sizes = [np.asarray(each, dtype=np.int64) for each in (largest, sums)]
    _, errors = error_places(rows.over, rows.under, value)
    order = np.lexsort((*counts, *sizes, errors, rows.first))
    return rows.taken(order[:best])


def key_of(first: int, top: Sequence[int], beneath: Sequence[int], value: Fraction) -> StageRank:
    """Return the sort key of one solution."""
    miss = abs(Fraction(prod(top), prod(beneath)) / value - 1)
    return first, miss, sum(top) + sum(beneath), max(*top, *beneath), tuple(top), tuple(beneath)


def merged(keys: Iterable[StageRank], best: int) -> list[StageRank]:
    """Return the first `best` keys, sorted."""
    return sorted(keys)[:best]


class BestStages:
    """List of the n best of all rows that are added, in bounded memory."""

    def __init__(self, best: int, value: Fraction, bound: tuple[int, float] | None = None) -> None:
        self.best, self.value = best, value
        self._bound = bound
        self._parts: list[RankedStages] = []
        self._held = 0

    @property
    def bound(self) -> tuple[int, float] | None:
        """Primary criterion and error beyond which rows cannot be among the n best; None if unknown."""
        return self._bound

    def add(self, rows: RankedStages) -> None:
        """Add candidate rows to the list."""
        self._parts.append(rows)
        self._held += len(rows)
        # several times the list length is stored between two sorts, which amortises their cost
        if self._held > max(4 * self.best, 1 << 17):
            self._settle()

    def rows(self) -> RankedStages | None:
        """Return the n best rows in order; None if no row was added."""
        if not self._parts:
            return None
        self._settle()
        return self._parts[0]

    def _settle(self) -> None:
        rows = cut(RankedStages.joined(self._parts), self.best, self.value)
        self._parts, self._held = [rows], len(rows)
        if len(rows) == self.best:
            reached = int(rows.first[-1]), margin(float(rows.error[rows.first == rows.first[-1]].max()))
            self._bound = min(self._bound, reached) if self._bound else reached
