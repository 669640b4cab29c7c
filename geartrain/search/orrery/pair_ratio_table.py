"""What one gear pair can do: the distinct ratios of two admissible wheels, and which of them lead to a period."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.search.orrery.period_targets import ROUNDING, PeriodTargets, members

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


_MOST_PAIRS = 2 * 10**7  # of counts


@dataclass(frozen=True)
class PairRatios:
    """The distinct ratios driven over driver of two wheels, in ascending order.

    counts  admissible tooth counts, ascending
    driven, driver  (n,) the ratio in lowest terms
    logs    (n,) its natural logarithm
    """

    counts: tuple[int, ...]
    driven: Ints
    driver: Ints
    logs: Floats
    _choices: dict[tuple[int, int], tuple[tuple[int, int], ...]] = field(default_factory=dict, repr=False)

    def __len__(self) -> int:
        return len(self.logs)

    def terms(self, at: int) -> tuple[int, int]:
        """Driven and driver of one ratio, in lowest terms."""
        return int(self.driven[at]), int(self.driver[at])

    def choices(self, driven: int, driver: int) -> tuple[tuple[int, int], ...]:
        """All admissible (driven, driver) wheels of a ratio given in lowest terms, fewest teeth first."""
        found = self._choices.get((driven, driver))
        if found is None:
            most = self.counts[-1] // max(driven, driver)
            admissible = set(self.counts)
            wheels = ((driven * times, driver * times) for times in range(1, most + 1))
            found = tuple(pair for pair in wheels if admissible.issuperset(pair))
            self._choices[driven, driver] = found
        return found

    def between(self, low: Fraction, high: Fraction) -> list[int]:
        """Indices of the ratios from `low` to `high`, decided exactly."""
        first = int(np.searchsorted(self.logs, math.log(low) - ROUNDING))
        last = int(np.searchsorted(self.logs, math.log(high) + ROUNDING))
        return [at for at in range(first, last) if low <= Fraction(*self.terms(at)) <= high]


def pair_ratios(counts: Sequence[int]) -> PairRatios:
    """The table for admissible tooth counts. Source: plain enumeration; time and memory grow with their square."""
    admissible = tuple(sorted(set(counts)))
    if not admissible or admissible[0] < 1:
        raise QuestionError(
            Problem(
                "no admissible tooth counts", "a wheel has a positive number of teeth", "give counts such as 12:400"
            )
        )
    # terms below 2^31, for both of a ratio are put into one integer below
    if len(admissible) ** 2 > _MOST_PAIRS or admissible[-1] >= 2**31:
        raise RangeError(
            Problem(
                f"{len(admissible)} tooth counts up to {admissible[-1]}",
                f"the search holds all ratios of two of them; it has room for {_MOST_PAIRS:.0e}",
                "narrow the range of teeth",
            )
        )
    teeth = np.array(admissible, dtype=np.int64)
    over, under = (part.ravel() for part in np.meshgrid(teeth, teeth))
    common = np.gcd(over, under)
    # a ratio in lowest terms as one integer, below 2^62, so that np.unique takes pairs
    shift = admissible[-1] + 1
    keys = np.unique(over // common * shift + under // common)
    over, under = keys // shift, keys % shift
    logs = np.log(over / under)
    # ratios whose logarithms round alike are told apart by their terms: the order is always the same
    order = np.lexsort((under, logs))
    return PairRatios(admissible, over[order], under[order], logs[order])


@dataclass(frozen=True)
class ReachablePeriods:
    """From one arbor, the second arbors that have aims one pair further.

    asked  the aims looked for, as bits
    first  (m,) index of the ratio to the second arbor
    next   (m, aims) index of the ratio from there to each aim, -1 where there is none
    sets   (m,) the aims reached, as bits
    """

    asked: int
    first: Ints
    next: Ints
    sets: Ints


def reach(table: PairRatios, aims: PeriodTargets, log_period: float, asked: int) -> ReachablePeriods:
    """All second arbors with at least one of the aims asked in reach; one ratio is kept where several lead to one aim.

    Floats choose with a margin; indices are checked exactly where they are used. Both lists of a search are sorted, so
    one aim costs a walk along the table.
    """
    logs, size = table.logs, len(table)
    found = np.full((len(aims.periods), size), -1, dtype=np.int32)
    falling = -logs[::-1]
    for aim in members(asked):
        low, high = aims.logs[aim][0] - log_period - ROUNDING, aims.logs[aim][1] - log_period + ROUNDING
        # ratios so far from the aim that no pair bridges the rest need not be asked
        begin, end = np.searchsorted(falling, [logs[0] - high, logs[-1] - low + ROUNDING])
        start = np.searchsorted(logs, falling[begin:end] + low)
        good = np.append(logs, np.inf)[start] <= falling[begin:end] + high
        found[aim, size - 1 - begin - np.flatnonzero(good)] = start[good]
    first = np.flatnonzero((found >= 0).any(axis=0))
    further = found[:, first].T.astype(np.int64)
    sets = ((further >= 0) << np.arange(len(aims.periods))).sum(axis=1)
    return ReachablePeriods(asked, first, further, sets)


def reached_sets(table: PairRatios, aims: PeriodTargets, log_period: float, asked: int) -> Ints:
    """(n,) for every ratio of the table, the aims one pair beyond the arbor it leads to, as bits."""
    sets = np.zeros(len(table), dtype=np.int64)
    found = reach(table, aims, log_period, asked)
    sets[found.first] = found.sets
    return sets
