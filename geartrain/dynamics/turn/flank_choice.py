"""The transmission function of a pair whose drive flanks touch at some positions, and its coast flanks at others."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.derived_transmission import DerivedTransmission

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.teeth.transmission import TransmissionFunction


class FlankChoice(DerivedTransmission):
    """At each angle it is asked at, the law of the flanks that touch there; of a period, that of the drive flanks.

    coasting   where the coast flanks touch: one for each angle
    """

    def __init__(self, law: TransmissionFunction, coasting: Bools) -> None:
        super().__init__(law)
        self.coasting, self.friction = coasting, law.friction

    def picked(self, columns: Ints) -> FlankChoice:
        """For some of the angles."""
        return FlankChoice(self.law, self.coasting[columns])

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Of either flank where it touches: the play lies between them."""
        S = np.asarray(S, dtype=float)
        error, speed = np.empty_like(S), np.empty_like(S)
        for law, where in ((self.law, ~self.coasting), (self.law.turned_back(), self.coasting)):
            if where.any():
                error[where], speed[where] = law.error_and_speed(S[where])
        return error, speed

    def error(self, S: ArrayLike) -> Floats:
        """Of either flank where it touches."""
        return self.error_and_speed(S)[0]

    def speed(self, S: ArrayLike) -> Floats:
        """Of either flank where it touches."""
        return self.error_and_speed(S)[1]

    def efficiency(self, S: ArrayLike) -> Floats:
        """Of the drive flanks."""
        return self.law.efficiency(S)

    def efficiency_mean(self) -> float:
        """Of the drive flanks."""
        return self.law.efficiency_mean()

    def efficiency_at_constant_load(self) -> float:
        """Of the drive flanks."""
        return self.law.efficiency_at_constant_load()

    def efficiency_least(self) -> float:
        """Of the drive flanks."""
        return self.law.efficiency_least()
