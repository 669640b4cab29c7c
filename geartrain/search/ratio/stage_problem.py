"""One ratio by stages as a question in plain data: the ratio, constraints, pairings, and orders of solutions.

The orders are total, and independent of where and when solutions are found.
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
_CHUNK = 1 << 18  # numbers handled at once
_TABLE = 1024  # up to here, a table tells which counts are coprime


@dataclass(frozen=True, slots=True)
class StageConstraints(Result):
    """Conditions on the counts of a train of stages, and on how they can be paired; all in one and the same pairing.

    Examples
    --------
    >>> StageConstraints(reverted=True, internal=1).sense(stages=2)
    -1
    """

    hunting: bool = False
    """The two counts of every stage have no common divisor, so that every tooth meets every tooth of its mate."""
    reverted: bool = False
    """All stages have one centre distance in one module: equal sums of their counts, or differences for a stage with
    a ring."""
    different: bool = False
    """No count is there twice."""
    internal: int = 0
    """How many of the meshes are with a ring, 0 to the number of stages. Such a mesh keeps the sense, the others
    reverse it; its ring has more teeth than its pinion."""
    minimum_total: int | None = None
    """Least sum of all counts."""
    most_total: int | None = None
    """Greatest sum of all counts."""
    largest: int | None = None
    """Greatest count."""

    def sense(self, stages: int) -> int:
        """1 if output and input turn the same way, -1 if not.

        Parameters
        ----------
        stages : int
            Gear pairs one after the other.
        """
        return -1 if (stages - self.internal) % 2 else 1

    @property
    def pairs_matter(self) -> bool:
        """True if a condition is on the pairing, and not on the counts alone."""
        return self.hunting or self.reverted or self.internal > 0

    @property
    def totals(self) -> tuple[int, int]:
        """Least and greatest sum of all counts."""
        minimum = 0 if self.minimum_total is None else self.minimum_total
        return minimum, (1 << 62) if self.most_total is None else self.most_total

    @property
    def totals_matter(self) -> bool:
        """True if the sum of all counts is bounded."""
        return self.minimum_total is not None or self.most_total is not None

    @property
    def free(self) -> bool:
        """True if every unordered pair of sets will do, `largest` aside."""
        return not (self.pairs_matter or self.different or self.totals_matter)

    def check(self, stages: int) -> None:
        """Refuse what no train of so many stages can be asked, by a `QuestionError`.

        Parameters
        ----------
        stages : int
            Gear pairs one after the other.
        """
        if not 0 <= self.internal <= stages:
            raise QuestionError(
                Problem(
                    f"internal is {self.internal}",
                    f"of {stages} meshes, 0 to {stages} can be with a ring",
                    f"give internal from 0 to {stages}",
                )
            )
        minimum, most = self.totals
        if minimum > most:
            what = f"minimum_total is {minimum}, most_total is {most}"
            raise QuestionError(Problem(what, "no sum is between them", "exchange them, or leave one out"))


@dataclass(frozen=True)
class StageProblem:
    """Products of `stages` counts on top over as many beneath, within a tolerance of a value."""

    value: Fraction
    """The wanted ratio, positive."""
    stages: int
    """1 to 5."""
    top: Set
    """Admissible counts on top, ascending."""
    beneath: Set
    """Admissible counts beneath, ascending."""
    fit: StageConstraints
    """Conditions on the counts; `largest` is already applied to `top` and `beneath`."""
    by: str
    """Order of the solutions."""
    best: int
    """How many are kept."""
    tolerance: Fraction
    """Greatest |error|, as a fraction of the value."""

    @property
    def plain_integers(self) -> bool:
        """True if int64 holds all products, and float64 holds them exactly."""
        return bool(max(self.top[-1:] + self.beneath[-1:], default=1) ** self.stages < PLAIN)

    @cached_property
    def over(self) -> ProductWindows:
        """Products of the counts on top."""
        return products_of(self.top, self.stages, self.plain_integers)

    @cached_property
    def under(self) -> ProductWindows:
        """Products of the counts beneath."""
        return products_of(self.beneath, self.stages, self.plain_integers)

    @property
    def reach(self) -> tuple[Fraction, Fraction]:
        """Least and greatest ratio of the products."""
        low, high = Fraction(self.top[0], self.beneath[-1]), Fraction(self.top[-1], self.beneath[0])
        return low**self.stages, high**self.stages

    @cached_property
    def edges(self) -> tuple[Fraction, Fraction]:
        """Least and greatest ratio within the tolerance, and within reach of the products."""
        minimum, most = self.reach
        return max(self.value * (1 - self.tolerance), minimum), min(self.value * (1 + self.tolerance), most)

    @property
    def reachable(self) -> bool:
        """True if some ratio of the products may be within the tolerance."""
        low, high = self.edges
        return low <= high

    @property
    def considered(self) -> int:
        """Number of pairs of unordered sets, one on top and one beneath."""
        return multisets(len(self.top), self.stages) * multisets(len(self.beneath), self.stages)

    def beneath_within(self, low: int, high: int) -> tuple[int, int]:
        """The part of [low, high) of products beneath that some product on top can go with."""
        first, last = self.edges
        minimum, most = self.top[0] ** self.stages, self.top[-1] ** self.stages
        return max(low, -(-minimum * last.denominator // last.numerator)), min(
            high, most * first.denominator // first.numerator + 1
        )

    def tops_for(self, low: int, high: int) -> tuple[int, int]:
        """The half-open range of products on top that products beneath in [low, high) may need."""
        first, last = self.edges
        minimum, most = self.top[0] ** self.stages, self.top[-1] ** self.stages
        return max(-(-low * first.numerator // first.denominator), minimum), min(
            (high - 1) * last.numerator // last.denominator, most
        ) + 1

    @property
    def loose(self) -> bool:
        """True if every pair of sets within the tolerance is a solution."""
        low, high = self.edges
        # one ring is always possible unless all counts are equal, and then the ratio is 1
        ring_alone = self.fit.internal == 1 and not low <= 1 <= high
        return self.fit.free or (ring_alone and replace(self.fit, internal=0).free)

    def plain(self) -> dict[str, Any]:
        """Plain data for JSON."""
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
    """The question that `StageProblem.plain` wrote."""
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


# --------------------------------------------- pairings: the stages that a set of counts over another can be paired to


@dataclass(frozen=True, slots=True)
class FeasiblePairings:
    """What the pairings that satisfy a fit have at best, for many pairs of sets at once."""

    possible: Bools
    """Some pairing satisfies the fit, (n,)."""
    coprime: Ints
    """Most stages with coprime counts among these pairings, (n,); 0 where there are none."""
    centres: Ints
    """Fewest different centre distances among these pairings, (n,); large where there are none."""

    def taken(self, at: Ints) -> FeasiblePairings:
        """Some of them."""
        return FeasiblePairings(self.possible[at], self.coprime[at], self.centres[at])


def suited(
    tops: Ints, beneaths: Ints, fit: StageConstraints, *, coprime: bool = True, centres: bool = True
) -> FeasiblePairings:
    """Judge sets of counts, (n, k) on top and beneath, by all k! pairings and choices of the meshes with a ring.

    coprime, centres   False: not wanted; then left at 0
    """
    size = tops.shape[1]
    step = max(_CHUNK // (len(_arrangements(size, fit.internal)[0]) * size), 1)
    # one chunk at least, so that an empty answer has its columns too
    parts = [
        _judged(tops[at : at + step], beneaths[at : at + step], fit, coprime, centres)
        for at in range(0, max(len(tops), 1), step)
    ]
    return FeasiblePairings(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _judged(
    tops: Ints, beneaths: Ints, fit: StageConstraints, coprime: bool, centres: bool
) -> tuple[Bools, Ints, Ints]:
    """The columns of `FeasiblePairings`."""
    size = tops.shape[1]
    orders, rings, meshes, ringed = _arrangements(size, fit.internal)
    possible = np.ones((len(tops), len(orders)), dtype=bool)
    alone = kinds = np.zeros(possible.shape, dtype=np.int64)
    if fit.hunting or coprime:
        # pairs as bits of one integer: an arrangement is tested by one `and`
        alone = np.bitwise_count(_code(_coprime(tops, beneaths))[:, None] & meshes).astype(np.int64)
        if fit.hunting:
            possible &= alone == size
    if fit.internal:
        possible &= (_code(tops[:, :, None] != beneaths[:, None, :])[:, None] & ringed) == ringed
    if fit.reverted or centres:
        tall, short = tops[:, None, :], beneaths[:, orders]
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
    """A table of size x size truths as one integer: bit size i + j for count i on top with count j beneath."""
    size = table.shape[1]
    return table.reshape(len(table), size * size) @ (1 << np.arange(size * size, dtype=np.int64))


def _coprime(tops: Ints, beneaths: Ints) -> Bools:
    """Whether each count on top is coprime to each beneath, (n, k, k)."""
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
    """Every order of the counts beneath with every choice of the stages that have a ring.

    Orders and choices, (arrangements, size) each; then the meshes and those with a ring, as bits of `_code`.
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
    """The best of the pairings that satisfy the fit, None if none does.

    Best: fewest different centre distances (only if `centres`), then most stages with coprime counts, then the most
    even ratios (least quotient of the greatest and the least). The last `fit.internal` of the pairs have the ring;
    before and behind that border pairs ascend.

    >>> best_pairing((39, 73, 91), (15, 34, 38))  # 39 and 15 have a common divisor
    ((39, 34), (73, 15), (91, 38))
    """
    fit = fit or StageConstraints()
    found: dict[Pairs, tuple[int, int]] = {}
    for order in set(permutations(beneath)):
        stages = tuple(zip(top, order, strict=True))
        for chosen in combinations(range(len(stages)), fit.internal):
            pairs = _sorted(stages, chosen)
            merit = _merit(pairs, fit, centres)
            if merit:
                found[pairs] = merit
    if not found:
        return None
    minimum, scale = min(found.values()), prod(beneath)
    return min((_spread(pairs, scale), pairs) for pairs, merit in found.items() if merit == minimum)[1]


def _sorted(stages: Pairs, chosen: tuple[int, ...]) -> Pairs:
    """External pairs first, then those with a ring, each ascending."""
    if not chosen:
        return tuple(sorted(stages))
    plain = sorted(pair for at, pair in enumerate(stages) if at not in chosen)
    return (*plain, *sorted(stages[at] for at in chosen))


def _merit(pairs: Pairs, fit: StageConstraints, centres: bool) -> tuple[int, int] | None:
    """What is compared first, least first; None if the pairing does not satisfy the fit."""
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
    """Greatest ratio over least; `scale` is a multiple of all counts beneath."""
    ratios = [a * (scale // b) for a, b in pairs]
    return Fraction(max(ratios), min(ratios))


# ----------------------------------------------------------------------------------------------------- total orders


StageOrder = Literal["error", "total", "largest", "distinct", "hunting", "centres"]
"""What comes first: least |error|, least sum of counts, least largest count, fewest different counts, most stages with
coprime counts, fewest centre distances. Ties: least |error|, then sum, then largest, then the counts in order."""

StageRank = tuple[int, Fraction, int, int, Set, Set]
"""What decides between two solutions, least first: what the order asks for, |error|, sum, largest, counts."""


def check_order(by: str) -> None:
    """`QuestionError` for an order that is none."""
    if by not in get_args(StageOrder):
        known = ", ".join(get_args(StageOrder))
        raise QuestionError(
            Problem(f"'{by}' is no order of solutions", "solutions are ranked", f"write one of {known}")
        )


@dataclass(frozen=True, slots=True)
class RankedStages:
    """Candidates as columns of equal length."""

    top: Ints
    """Counts, ascending in each row, (n, k)."""
    beneath: Ints
    """Counts, ascending in each row, (n, k)."""
    over: Ints
    """Their products, (n,)."""
    under: Ints
    """Their products, (n,)."""
    first: Ints
    """What the order asks for, least first, (n,)."""
    error: Floats
    """|error|, near enough to prune by, (n,)."""

    def __len__(self) -> int:
        return len(self.first)

    def taken(self, at: Ints) -> RankedStages:
        """Some of the rows."""
        columns = (self.top, self.beneath, self.over, self.under, self.first, self.error)
        return RankedStages(*(column[at] for column in columns))

    @classmethod
    def joined(cls, parts: Sequence[RankedStages]) -> RankedStages:
        """All rows of all parts."""
        names = cls.__slots__
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def first_of(by: str, tops: Ints, beneaths: Ints, fit: StageConstraints, found: FeasiblePairings | None = None) -> Ints:
    """What the order asks for first, least first, of sets of counts (n, k) over and beneath."""
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
    """An error that is surely not less than an exact one whose approximation is `error`."""
    # far wider than the 1e-12 to which errors are known
    return error * (1 + 1e-9) + 2 * ROUNDING


def cut(rows: RankedStages, best: int, value: Fraction) -> RankedStages:
    """The first `best` of the rows in their order, decided exactly."""
    if len(rows) > best:
        # near errors choose generously, for only these few are compared as Fractions
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
    """The key of one solution."""
    miss = abs(Fraction(prod(top), prod(beneath)) / value - 1)
    return first, miss, sum(top) + sum(beneath), max(*top, *beneath), tuple(top), tuple(beneath)


def merged(keys: Iterable[StageRank], best: int) -> list[StageRank]:
    """The first `best` keys, in order."""
    return sorted(keys)[:best]


class BestStages:
    """The first n of all rows that are added, in bounded memory."""

    def __init__(self, best: int, value: Fraction, bound: tuple[int, float] | None = None) -> None:
        self.best, self.value = best, value
        self._bound = bound
        self._parts: list[RankedStages] = []
        self._held = 0

    @property
    def bound(self) -> tuple[int, float] | None:
        """What the order asks for first, and an error: rows past both cannot be among the first n. None: any may be."""
        return self._bound

    def add(self, rows: RankedStages) -> None:
        """Consider some rows."""
        self._parts.append(rows)
        self._held += len(rows)
        if self._held > max(4 * self.best, 1 << 17):
            self._settle()

    def rows(self) -> RankedStages | None:
        """The first n, in order; None if no row was added."""
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
