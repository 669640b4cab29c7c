"""The law of a pair that stands where another law has it: its ratio, and one error."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.teeth.transmission import ExactRatio, TransmissionFunction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


class ConstantLag(ExactRatio):
    """A law that keeps its ratio, its driven side always by `mean` (rad) ahead of uniform motion."""

    def __init__(self, ratio: Fraction, period: float, mean: float) -> None:
        super().__init__(ratio, period)
        self.mean = mean

    @classmethod
    def at(cls, law: TransmissionFunction, S: float) -> ConstantLag:
        """What another law does where its driver stands at S (rad), whatever S is."""
        return cls(law.ratio, law.period, float(law.error(S)))

    def error(self, S: ArrayLike) -> Floats:
        """The same everywhere."""
        return self._constant(S, self.mean)

    def error_range(self) -> tuple[float, float]:
        """The same twice."""
        return self.mean, self.mean

    def error_moments(self) -> tuple[float, float]:
        """The mean, and 0."""
        return self.mean, 0.0
