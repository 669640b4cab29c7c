"""Filing of pairs to fit: a pair is turned through its cycle, and a tooth that jams is filed until it passes.

At minimum backlash, four flanks of two tooth pairs are in contact. The most protruding of them is filed until the tooth
pairs pass. This is repeated at the next tightest position, until the pair turns through its cycle.
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

_ROUNDS = 4000  # maximum iterations: enough to file every flank of a pair twice


@dataclass(frozen=True)
class TightPlace:
    """Position of minimum backlash of each pair, and the flank to file there."""

    backlash: Floats
    """Minimum backlash over the meshing cycle [rad of the driven wheel]; negative if the pair jams."""
    wheel: Ints
    """Wheel to file: 0 for the driver, 1 for the driven wheel; `tooth` is its tooth, `side` its flank: 0 leading, 1
    trailing.
    """
    tooth: Ints
    side: Ints
    gain: Floats
    """Maximum increase of the backlash per unit depth of filing [rad of the driven wheel per unit of length]."""


class FileablePair(Protocol):
    """Pairs of cut wheels whose flanks can be filed, one pair for each trial."""

    @property
    def trials(self) -> tuple[int, ...]:
        """Shape of the trials."""

    @property
    def teeth(self) -> tuple[int, int]:
        """Numbers of teeth of the driver and of the driven wheel."""

    def taken(self, rows: Ints) -> Self:
        """Return the pairs of selected trials."""

    def tight_place(self) -> TightPlace:
        """Return the position of minimum backlash of each pair."""

    def filed(self, low: tuple[Floats, Floats]) -> Self:
        """Return the pairs with material removed from the flanks by one array (trials, 2 sides, z) for each wheel."""


Pair = TypeVar("Pair", bound=FileablePair)


@dataclass(frozen=True)
class FilingWork(Generic[Pair]):
    """Result of filing many pairs: the filed pairs, numbers of strokes and numbers of filed teeth, shape (trials,)."""

    pair: Pair
    strokes: Ints
    teeth: Ints
    low: tuple[Floats, Floats]
    """Depth of material removed from each flank of each wheel, shape (trials, 2 sides, z)."""

    @property
    def filed(self) -> Bools:
        """Mask of the trials in which the pair was filed, shape (trials,)."""
        found: Bools = self.strokes > 0
        return found


def file_to_fit(pair: Pair, stroke: float, deepest: float) -> FilingWork[Pair]:
    """Return pairs filed until they pass, one `stroke` of depth at a time.

    A pair remains jammed if more than `deepest` would have to be removed from a flank.
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
        # the minimum number of strokes for this position; if it is not enough, the position is found again
        wanted = np.maximum(np.ceil(-tight.backlash / (tight.gain * stroke)), 1).astype(np.int64)
        # limited, so that a pair that cannot pass is not filed far beyond the limit at once
        wanted = np.minimum(wanted, int(np.ceil(deepest / stroke)))
        strokes[active] += wanted
        for wheel in (0, 1):
            at = tight.wheel == wheel
            low[wheel][active[at], tight.side[at], tight.tooth[at]] += wanted[at] * stroke
        lowest = np.maximum(*(each[active].max(axis=(1, 2)) for each in low))
        # pairs with a flank beyond the limit are given up
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
    """Pairs of cut triangular wheels, with one axis of trials."""

    pair: CutGearPair

    @property
    def trials(self) -> tuple[int, ...]:
        """Shape of the trials."""
        return self.pair.trials

    @property
    def teeth(self) -> tuple[int, int]:
        """Numbers of teeth of the driver and of the driven wheel."""
        return self.pair.first.z, self.pair.second.z

    def taken(self, rows: Ints) -> FileableCutPair:
        """Return the pairs of selected trials."""
        return FileableCutPair(taken(self.pair, rows))

    def filed(self, low: tuple[Floats, Floats]) -> FileableCutPair:
        """Return the pairs with material removed from the flanks by one array (trials, 2 sides, z) for each wheel."""
        pair = self.pair
        first, second = pair.first.filed(low[0][:, 0], low[0][:, 1]), pair.second.filed(low[1][:, 0], low[1][:, 1])
        return FileableCutPair(CutGearPair(pair.sizes, first, second, pair.shift))

    def tight_place(self) -> TightPlace:
        """Return the position of minimum backlash of each pair, with the flank that protrudes most among the four in
        contact.
        """
        parts = [MeshingCycle(part).tightest() for part in chunks(self.pair, CHUNK // self.pair.count)]
        backlash, front, apart = (np.concatenate(each) for each in zip(*parts, strict=True))
        rows, (z1, z2), sizes = np.arange(len(backlash)), self.teeth, self.pair.sizes
        back = front - apart
        # the back pair joins the driver's tooth to the next driven tooth
        teeth = np.stack([front % z1, back % z1, (back + 1) % z2, front % z2])
        first, second = self.pair.first, self.pair.second
        out = np.stack(
            [
                _flank_height(first, 0)[rows, teeth[0]],
                _flank_height(first, 1)[rows, teeth[1]],
                _flank_height(second, 0)[rows, teeth[2]],
                _flank_height(second, 1)[rows, teeth[3]],
            ]
        )
        flank = out.argmax(axis=0)
        # a flank is inclined by its half angle plus the reach, which gives a lower bound of the moment arm
        lean = max(sizes.beta1, sizes.beta2) + sizes.reach1 + sizes.reach2
        nearest = sizes.R2 if sizes.ring == 2 else sizes.R2 - sizes.depths[1]
        # the lower limit of 0.1 keeps the gain finite for flanks almost parallel to the motion
        gain = 1 / (nearest * max(cos(min(lean, 1.4)), 0.1))
        return TightPlace(backlash, flank // 2, teeth[flank, rows], flank % 2, np.full(len(backlash), gain))


def _flank_height(wheel: CutWheel, side: int) -> Floats:
    """Return the height of each flank along its normal above nominal, halfway down the tooth, shape (trials, z)."""
    lean, ahead = (wheel.leading, -wheel.place) if side == 0 else (wheel.trailing, wheel.place)
    half = abs(wheel.radius) * (1 - cos(np.pi / wheel.z)) / 2
    found = cos(wheel.half_angle) * np.abs(wheel.r) * ahead + np.sin(wheel.half_angle) * wheel.tip + half * lean
    return np.broadcast_to(found, (*wheel.trials, wheel.z)) if wheel.trials else found[None]
