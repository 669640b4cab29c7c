"""What one pair loses on the mean over a turn, by which of its torques is constant."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

_ONE = Fraction(1)


@dataclass(frozen=True)
class MeanEfficiencies:
    """Efficiencies of one pair with the first link driving, then with the second.

    driver   where the torque of the driver is constant over a turn
    load     where the torque of the driven side is
    exact    as declared; False for means over teeth, which are floats to 15 digits
    """

    driver: tuple[Fraction, Fraction] = (_ONE, _ONE)
    load: tuple[Fraction, Fraction] = (_ONE, _ONE)
    exact: bool = True

    @property
    def differ(self) -> bool:
        """True if it matters which torque is constant."""
        return self.driver != self.load

    def given(self, side: int, driving: bool) -> tuple[Fraction, Fraction]:
        """Forward and backward with the torque of the first link constant (1), of the second (-1), or of neither (0).

        driving   for neither: the loads put power in, so that what drives is nearer to what is given
        """
        if side > 0:
            return self.driver[0], self.load[1]
        if side < 0:
            return self.load[0], self.driver[1]
        return self.driver if driving else self.load
