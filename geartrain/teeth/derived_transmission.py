"""Laws made from another law, whose motion over a whole period is the other's own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.teeth.transmission import TransmissionFunction

if TYPE_CHECKING:
    from geartrain.teeth.transmission import SpeedLeap


class DerivedTransmission(TransmissionFunction):
    """A law that moves as `law` does, and differs in how it is worked out or in what it loses."""

    def __init__(self, law: TransmissionFunction) -> None:
        self.law, self.ratio, self.period = law, law.ratio, law.period

    def speed_range(self) -> tuple[float, float]:
        """The law's own."""
        return self.law.speed_range()

    def error_range(self) -> tuple[float, float]:
        """The law's own."""
        return self.law.error_range()

    def error_moments(self) -> tuple[float, float]:
        """The law's own."""
        return self.law.error_moments()

    def corners(self) -> list[float]:
        """The law's own."""
        return self.law.corners()

    def speed_leaps(self) -> tuple[SpeedLeap, ...] | None:
        """The law's own."""
        return self.law.speed_leaps()

    def steepest_fall(self) -> float | None:
        """The law's own."""
        return self.law.steepest_fall()

    @property
    def locking_friction(self) -> float:
        """The law's own."""
        return self.law.locking_friction
