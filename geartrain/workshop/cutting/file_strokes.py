"""Filing to fit: a pair is turned through its cycle, and a tooth that jams is filed until it passes.

Where the play is least, two couples jam: four flanks. That of them which stands out farthest takes strokes of the file
until the couples pass; then the next tightest place is looked for, until the pair turns through.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos
from typing import TYPE_CHECKING, Generic, Protocol, Self, TypeVar

import numpy as np

from geartrain.workshop.cutting.cut_wheel import CutGearPair
from geartrain.workshop.cutting.meshing_cycle import CHUNK, MeshingCycle, chunks, taken

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.workshop.cutting.cut_wheel import CutWheel

_ROUNDS = 4000  # of looking for the tightest place: more teeth than a pair has flanks to file twice over


@dataclass(frozen=True)
class TightPlace:
    """The tightest place of each of some pairs, and the flank filed there."""

    backlash: Floats
    """Least play over the cycle (rad of the driven wheel); below 0 it jams."""
    wheel: Ints
    """0 the driver, 1 the driven wheel; `tooth` of it, on its `side`: 0 leading, 1 trailing."""
    tooth: Ints
    side: Ints
    gain: Floats
    """The most (rad of the driven wheel) by which the play grows where that flank is lowered by 1."""


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
    """What was filed of many pairs: the pairs after it, and by trial how many strokes on how many teeth, (trials,)."""

    pair: Pair
    strokes: Ints
    teeth: Ints
    low: tuple[Floats, Floats]
    """How far each flank of either wheel is lowered, (trials, 2 sides, z)."""

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
        jams = tight.backlash < 0
        active, tight = active[jams], _some(tight, jams)
        if not len(active):
            break
        # no more strokes than this place needs at the least; where they were too few, it comes again
        wanted = np.maximum(np.ceil(-tight.backlash / (tight.gain * stroke)), 1).astype(np.int64)
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
    return replace(
        tight, **{name: getattr(tight, name)[rows] for name in ("backlash", "wheel", "tooth", "side", "gain")}
    )


@dataclass(frozen=True)
class FileableCutPair:
    """Many pairs of cut triangular wheels, one axis of trials."""

    pair: CutGearPair

    @property
    def trials(self) -> tuple[int, ...]:
        """Shape of the trials."""
        return self.pair.trials

    @property
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers."""
        return self.pair.first.z, self.pair.second.z

    def taken(self, rows: Ints) -> FileableCutPair:
        """Some of the trials."""
        return FileableCutPair(taken(self.pair, rows))

    def filed(self, low: tuple[Floats, Floats]) -> FileableCutPair:
        """With flanks lowered: arrays (trials, 2 sides, z) of either wheel."""
        pair = self.pair
        first, second = pair.first.filed(low[0][:, 0], low[0][:, 1]), pair.second.filed(low[1][:, 0], low[1][:, 1])
        return FileableCutPair(CutGearPair(pair.sizes, first, second, pair.shift))

    def tight_place(self) -> TightPlace:
        """Where each has its least play, and of the four flanks there that which stands out farthest."""
        parts = [MeshingCycle(part).tightest() for part in chunks(self.pair, CHUNK // self.pair.count)]
        backlash, front, apart = (np.concatenate(each) for each in zip(*parts, strict=True))
        rows, (z1, z2), sizes = np.arange(len(backlash)), self.teeth, self.pair.sizes
        back = front - apart
        # the back couple joins the driver's tooth to the driven tooth that follows
        teeth = np.stack([front % z1, back % z1, (back + 1) % z2, front % z2])
        first, second = self.pair.first, self.pair.second
        out = np.stack(
            [
                _stands_out(first, 0)[rows, teeth[0]],
                _stands_out(first, 1)[rows, teeth[1]],
                _stands_out(second, 0)[rows, teeth[2]],
                _stands_out(second, 1)[rows, teeth[3]],
            ]
        )
        flank = out.argmax(axis=0)
        # a flank leans by its half angle and, where it touches, by the reach: the arm is no shorter than this
        lean = max(sizes.beta1, sizes.beta2) + sizes.reach1 + sizes.reach2
        nearest = sizes.R2 if sizes.ring == 2 else sizes.R2 - sizes.depths[1]
        gain = 1 / (nearest * max(cos(min(lean, 1.4)), 0.1))
        return TightPlace(backlash, flank // 2, teeth[flank, rows], flank % 2, np.full(len(backlash), gain))


def _stands_out(wheel: CutWheel, side: int) -> Floats:
    """How far each flank, leading or trailing, stands out along its normal half way down the tooth, (trials, z)."""
    lean, ahead = (wheel.leading, -wheel.place) if side == 0 else (wheel.trailing, wheel.place)
    half = abs(wheel.radius) * (1 - cos(np.pi / wheel.z)) / 2
    found = cos(wheel.half_angle) * np.abs(wheel.r) * ahead + np.sin(wheel.half_angle) * wheel.tip + half * lean
    return np.broadcast_to(found, (*wheel.trials, wheel.z)) if wheel.trials else found[None]
