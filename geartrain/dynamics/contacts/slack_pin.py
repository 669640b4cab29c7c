"""A pin that has clearance in its slot: its law with the slot ahead or behind by what the clearance allows."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.transmission import ExactRatio

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.pin_transmission import PinTransmission


class SlackPin(ExactRatio):
    """The law of a pin on one side of its slot, which is wider than the pin by `clearance`, docs/dynamics.md (9).

    The slot stands asin(clearance/(2 rho)) ahead of where a tight pin would have it (`side` 1), or behind (-1), rho the
    pin's distance from the slot's axis.
    """

    def __init__(self, law: PinTransmission, clearance: float, side: int) -> None:
        super().__init__(law.ratio, law.period)
        self.law, self.clearance, self.side, self.friction = law, clearance, side, law.friction

    def error(self, S: ArrayLike) -> Floats:
        """Transmission error (rad of the slot) at pin angles S (rad)."""
        return np.asarray(self.law.error(S) + self.side * np.arcsin(self.clearance / 2 / np.sqrt(self._square(S))))

    def speed(self, S: ArrayLike) -> Floats:
        """Speed ratio at pin angles S (rad)."""
        square, half = self._square(S), self.clearance / 2
        turning = half * self.law.r * self.law.e * np.sin(S) / (square * np.sqrt(square - half**2))
        return np.asarray(self.law.speed(S) - self.side * turning)

    def _square(self, S: ArrayLike) -> Floats:
        half = np.sin(np.asarray(S, dtype=float) / 2)
        return np.asarray((self.law.r - self.law.e) ** 2 + 4 * self.law.r * self.law.e * half**2)
