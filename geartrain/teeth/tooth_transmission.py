"""Transmission function of a pair of toothed wheels, with the verdict on whether the pair can run."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Self

from geartrain.teeth.transmission import TransmissionFunction

if TYPE_CHECKING:
    from geartrain.teeth.pair_results import PairVerdict


class ToothTransmission(TransmissionFunction):
    """Transmission function of a pair of toothed wheels, in which either wheel can drive, forwards or backwards.

    If the driver turns backwards, the coast flanks are in contact. The sign convention of angles does not change, so
    that angles decrease.
    """

    driver: int
    """Number of the driving wheel, 1 or 2."""
    direction: int
    """Direction of rotation: 1 for forwards, -1 for backwards."""

    @property
    @abstractmethod
    def verdict(self) -> PairVerdict:
        """Verdict on whether the pair can run."""

    @abstractmethod
    def _driven(self, driver: int, direction: int) -> Self:
        """Return the transmission function of the same pair with the given driving wheel and direction of rotation."""

    @property
    def reversed(self) -> Self:
        """Transmission function for the case that the other wheel drives."""
        return self._driven(3 - self.driver, self.direction)

    def reversed_motion(self) -> Self:
        """Return the transmission function of the coast flanks, which applies to the reverse direction of rotation."""
        return self._driven(self.driver, -self.direction)
