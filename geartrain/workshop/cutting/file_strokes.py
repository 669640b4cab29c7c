"""Filing of pairs to fit, until they turn through their meshing cycle without a jam.

At minimum backlash, four flanks of two tooth pairs are in contact. The flank that protrudes most is filed until the
tooth pairs pass. This is repeated at the next tightest position.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np

from geartrain.workshop.cutting.meshing_cycle import CHUNK, MeshingCycle, TightPlace, chunks

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.workshop.cutting.cut_wheel import CutGearPair, CutWheel
    from geartrain.workshop.cutting.displaced_pair import DisplacedPair

_ROUNDS = 4000  # maximum iterations: enough to file every flank of a pair twice


Pair = TypeVar("Pair", "CutGearPair", "DisplacedPair")


@dataclass(frozen=True)
class FilingWork(Generic[Pair]):
    """Result of filing pairs to fit: filed pairs, and numbers of strokes and of filed teeth."""

    pair: Pair
    """Filed gear pairs of all trials."""
    strokes: Ints
    """Number of strokes of the file in each trial."""
    teeth: Ints
    """Number of filed teeth in each trial."""


def file_to_fit(
    pair: Pair, tight_place: Callable[[Pair], TightPlace], stroke: float, deepest: float
) -> FilingWork[Pair]:
    """Return pairs, one for each trial, filed by strokes of the depth `stroke` until they turn without a jam.

    A pair remains jammed if a depth above `deepest` would have to be removed from a flank.

    tight_place   function that returns the position of minimum backlash of each pair
    """
    count = pair.trials[0]
    low = tuple(np.zeros((count, 2, z)) for z in pair.teeth)
    strokes, active = np.zeros(count, np.int64), np.arange(count)
    for _ in range(_ROUNDS):
        part = pair.taken(active).filed((low[0][active], low[1][active]))
        tight = tight_place(part)
        # pairs that pass are not evaluated again
        jams = tight.backlash < 0
        active, tight = active[jams], TightPlace._make(each[jams] for each in tight)
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
    return FilingWork(pair.filed((low[0], low[1])), strokes, np.asarray(teeth))


def tight_place(pair: CutGearPair) -> TightPlace:
    """Return the minimum backlash of triangular pairs, and the most protruding flank in contact there."""
    parts = [MeshingCycle(part).tightest() for part in chunks(pair, CHUNK // pair.count)]
    backlash, front, apart = (np.concatenate(each) for each in zip(*parts, strict=True))
    rows, (z1, z2), sizes = np.arange(len(backlash)), pair.teeth, pair.sizes
    back = front - apart
    # the back pair joins the driver's tooth to the next driven tooth
    teeth = np.stack([front % z1, back % z1, (back + 1) % z2, front % z2])
    sides = [(pair.first, 0), (pair.first, 1), (pair.second, 0), (pair.second, 1)]
    out = np.stack(
        [
            np.broadcast_to(_flank_height(*each), (len(rows), each[0].z))[rows, own]
            for each, own in zip(sides, teeth, strict=True)
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
    """Return the distance by which each flank is above the flank of a perfect tooth, shape (..., z).

    The distance is measured along the normal of the flank at half of the tooth depth.

    side   0 for leading flanks, 1 for trailing flanks
    """
    lean, ahead = (wheel.leading, -wheel.place) if side == 0 else (wheel.trailing, wheel.place)
    half = abs(wheel.radius) * (1 - cos(np.pi / wheel.z)) / 2
    found: Floats = cos(wheel.half_angle) * np.abs(wheel.r) * ahead + np.sin(wheel.half_angle) * wheel.tip + half * lean
    return found
