"""Extremes of errors and speeds between the positions of a run: the highest of them, looked at more closely.

Errors of teeth have sharp peaks, which a sample misses by up to half a step on either side. The greatest sampled values
of a run are kept, and the steps around them are sampled again, twice, ever finer.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.motion.composition import Composition, Passage
    from geartrain.motion.tally import Tally

    Floats = NDArray[np.float64]

_BIN = 1024  # positions of which the greatest is kept
_KEPT = 10  # of them, for each output and each extreme
_FINER = 16  # parts of a step, on either side
_ROUNDS = 2


class Peaks:
    """The greatest and least errors and speeds of each output, with the turns at which they were seen.

    step   turns between two positions of the run
    """

    def __init__(self, outputs: int, step: float) -> None:
        self.step = abs(step)
        # by output and extreme: values, the greater the better, and turns
        self.values = np.full((outputs, 4, 0), -np.inf)
        self.turns = np.zeros((outputs, 4, 0))

    def add(self, passage: Passage) -> None:
        """Keep the best of some more positions."""
        signed = _signed(passage)
        starts = range(0, signed.shape[2], _BIN)
        at = np.stack([start + np.argmax(signed[:, :, start : start + _BIN], axis=2) for start in starts], axis=2)
        values = np.concatenate([self.values, np.take_along_axis(signed, at, axis=2)], axis=2)
        turns = np.concatenate([self.turns, passage.turns[at]], axis=2)
        best = np.argsort(-values, axis=2)[:, :, :_KEPT]
        self.values = np.take_along_axis(values, best, axis=2)
        self.turns = np.take_along_axis(turns, best, axis=2)

    def sharpen(self, composition: Composition, turns: float, tallies: list[Tally]) -> None:
        """Sample again around the extremes, within the run, and tell the tallies what is found there."""
        low, high = sorted((0.0, turns))
        step = self.step
        for _ in range(_ROUNDS):
            fine = np.arange(-_FINER, _FINER + 1) * (step / _FINER)
            for at, tally in enumerate(tallies):
                around = np.clip(np.unique(self.turns[at, :, :, None] + fine), low, high)
                for start in range(0, len(around), composition.chunk):
                    passage = composition.at(around[start : start + composition.chunk])
                    self.add(passage)
                    tally.reach(passage.error[at], passage.rate[at])
            step /= _FINER


def _signed(passage: Passage) -> Floats:
    """Errors, errors reversed, rates, rates reversed: what is sought is the greatest of each, (outputs, 4, n)."""
    return np.stack([passage.error, -passage.error, passage.rate, -passage.rate], axis=1)
