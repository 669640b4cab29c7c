"""Filing to fit: a pair is turned through its cycle, and a tooth that jams is filed until it passes.

Where the play is least, two couples jam: four flanks. That of them which stands out farthest takes strokes of the file
until the couples pass; then the next tightest place is looked for, until the pair turns through.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Generic, Protocol, Self, TypeVar

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Ints

_ROUNDS = 4000  # of looking for the tightest place: more teeth than a pair has flanks to file twice over


@dataclass(frozen=True)
class TightPlace:
    """The tightest place of each of some pairs, and the flank filed there.

    play    least play over the cycle (rad of the driven wheel); below 0 it jams
    wheel   0 the driver, 1 the driven wheel; `tooth` of it, on its `side`: 0 leading, 1 trailing
    gain    the most (rad of the driven wheel) by which the play grows where that flank is lowered by 1
    """

    play: Floats
    wheel: Ints
    tooth: Ints
    side: Ints
    gain: Floats


class FileablePair(Protocol):
    """Many pairs of cut wheels whose flanks can be filed."""

    @property
    def trials(self) -> tuple[int, ...]:
        """Shape of the trials."""

    @property
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers."""

    def taken(self, rows: Ints) -> Self:
        """Some of the trials."""

    def tight_place(self) -> TightPlace:
        """Where each jams first."""

    def filed(self, low: tuple[Floats, Floats]) -> Self:
        """With flanks lowered: arrays (trials, 2 sides, z) of either wheel."""


Pair = TypeVar("Pair", bound=FileablePair)


@dataclass(frozen=True)
class FilingWork(Generic[Pair]):
    """What was filed of many pairs: the pairs after it, and by trial how many strokes on how many teeth, (trials,).

    low   how far each flank of either wheel is lowered, (trials, 2 sides, z)
    """

    pair: Pair
    strokes: Ints
    teeth: Ints
    low: tuple[Floats, Floats]

    @property
    def filed(self) -> Bools:
        """Which were filed at all."""
        found: Bools = self.strokes > 0
        return found


def file_to_fit(pair: Pair, stroke: float, deepest: float) -> FilingWork[Pair]:
    """Pairs filed until they pass, a `stroke` at a time; a flank lower by more than `deepest` spoils a pair.

    Those that are spoilt are left as they are, and still jam.
    """
    count = pair.trials[0]
    low = tuple(np.zeros((count, 2, z)) for z in pair.teeth)
    strokes, active = np.zeros(count, np.int64), np.arange(count)
    for _ in range(_ROUNDS):
        part = pair.taken(active).filed((low[0][active], low[1][active]))
        tight = part.tight_place()
        jams = tight.play < 0
        active, tight = active[jams], _some(tight, jams)
        if not len(active):
            break
        # no more strokes than this place needs at the least; where they were too few, it comes again
        wanted = np.maximum(np.ceil(-tight.play / (tight.gain * stroke)), 1).astype(np.int64)
        wanted = np.minimum(wanted, int(np.ceil(deepest / stroke)))
        strokes[active] += wanted
        for wheel in (0, 1):
            at = tight.wheel == wheel
            low[wheel][active[at], tight.side[at], tight.tooth[at]] += wanted[at] * stroke
        lowest = np.maximum(*(each[active].max(axis=(1, 2)) for each in low))
        active = active[lowest <= deepest]
        if not len(active):
            break
    teeth = sum(np.count_nonzero(each.any(axis=1), axis=1) for each in low)
    return FilingWork(pair.filed((low[0], low[1])), strokes, np.asarray(teeth), (low[0], low[1]))


def _some(tight: TightPlace, rows: Bools) -> TightPlace:
    return replace(tight, **{name: getattr(tight, name)[rows] for name in ("play", "wheel", "tooth", "side", "gain")})
