"""The orders in which solutions are listed: total orders, independent of where and when solutions are found."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.search.ratio.product_windows import ROUNDING, error_places
from geartrain.search.ratio.stage_pairs import suited
from geartrain.search.ratio.stage_problem import StageConstraints

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats
    from geartrain.search.ratio.stage_pairs import FeasiblePairings

    Ints = NDArray[Any]

StageOrder = Literal["error", "total", "largest", "distinct", "hunting", "centres"]
"""What comes first: least |error|, least sum of counts, least largest count, fewest different counts, most stages with
coprime counts, fewest centre distances. Ties: least |error|, then sum, then largest, then the counts in order."""

Set = tuple[int, ...]
Key = tuple[int, Fraction, int, int, Set, Set]
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
    """Candidates as columns of equal length.

    top, beneath  counts, ascending in each row, (n, k)
    over, under   their products, (n,)
    first         what the order asks for, least first, (n,)
    error         |error|, near enough to prune by, (n,)
    """

    top: Ints
    beneath: Ints
    over: Ints
    under: Ints
    first: Ints
    error: Floats

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


def key_of(first: int, top: Sequence[int], beneath: Sequence[int], value: Fraction) -> Key:
    """The key of one solution."""
    miss = abs(Fraction(prod(top), prod(beneath)) / value - 1)
    return first, miss, sum(top) + sum(beneath), max(*top, *beneath), tuple(top), tuple(beneath)


def merged(keys: Iterable[Key], best: int) -> list[Key]:
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
