"""Pairs of triangular teeth as a maker files them: where they jam, and what strokes take off their flanks."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos
from typing import TYPE_CHECKING

import numpy as np

from geartrain.uncertainty.manufacturing_errors.cut_pair import CutGearPair
from geartrain.uncertainty.manufacturing_errors.file_strokes import TightPlace
from geartrain.uncertainty.manufacturing_errors.meshing_cycle import CHUNK, MeshingCycle, chunks

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.uncertainty.manufacturing_errors.cut_wheel import CutWheel


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
        pair = self.pair
        shift = pair.shift if np.ndim(pair.shift) == 0 else pair.shift[rows]
        return FileableCutPair(CutGearPair(pair.sizes, pair.first.taken(rows), pair.second.taken(rows), shift))

    def filed(self, low: tuple[Floats, Floats]) -> FileableCutPair:
        """With flanks lowered: arrays (trials, 2 sides, z) of either wheel."""
        pair = self.pair
        first, second = pair.first.filed(low[0][:, 0], low[0][:, 1]), pair.second.filed(low[1][:, 0], low[1][:, 1])
        return FileableCutPair(CutGearPair(pair.sizes, first, second, pair.shift))

    def tight_place(self) -> TightPlace:
        """Where each has its least play, and of the four flanks there that which stands out farthest."""
        parts = [MeshingCycle(part).tightest() for part in chunks(self.pair, CHUNK // self.pair.count)]
        play, front, apart = (np.concatenate(each) for each in zip(*parts, strict=True))
        rows, (z1, z2), sizes = np.arange(len(play)), self.teeth, self.pair.sizes
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
        return TightPlace(play, flank // 2, teeth[flank, rows], flank % 2, np.full(len(play), gain))


def _stands_out(wheel: CutWheel, side: int) -> Floats:
    """How far each flank, leading or trailing, stands out along its normal half way down the tooth, (trials, z)."""
    lean, ahead = (wheel.leading, -wheel.place) if side == 0 else (wheel.trailing, wheel.place)
    half = abs(wheel.radius) * (1 - cos(np.pi / wheel.z)) / 2
    found = cos(wheel.half_angle) * np.abs(wheel.r) * ahead + np.sin(wheel.half_angle) * wheel.tip + half * lean
    return np.broadcast_to(found, (*wheel.trials, wheel.z)) if wheel.trials else found[None]
