"""Many couples of teeth at once: the contact of two teeth with an array for each of its constants."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.teeth.triangular.contact import APPROACH, RECESS, Couple

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_CONSTANTS = ("R1", "R2", "D", "delta", "sin1", "cos1", "sin2", "cos2", "entry", "reach", "exit_angle")


class Couples(Couple):
    """Couples of a driver's and a driven tooth; all arrays broadcast against each other and the angles asked for.

    R1, R2         radii of the tips
    beta1, beta2   half angles of the two flanks that meet (rad)
    D, delta       centre distance, and R1 + R2 - D given apart: it must not suffer from cancellation
    """

    __slots__ = ("exit_angle", "reach")

    def __init__(self, R1: Any, R2: Any, beta1: Any, beta2: Any, D: Any, delta: Any) -> None:
        self.R1, self.R2, self.D, self.delta = R1, R2, D, delta
        self.sin1, self.cos1 = np.sin(beta1), np.cos(beta1)
        self.sin2, self.cos2 = np.sin(beta2), np.cos(beta2)
        self.leans = False
        self.entry = _half_sine(R1, R2, D, delta)
        # tips that pass clear of each other touch nowhere
        self.reach: Floats = np.where(np.asarray(delta) > 0, 2 * np.arcsin(self.entry), -np.inf)
        self.exit_angle: Floats = -2 * np.arcsin(_half_sine(R2, R1, D, delta))

    def contact(self, x: Any) -> Any:
        """f(x) = min(approach, recess): alpha_2 at first contact, where |x| is within the reach."""
        return np.minimum(self.approach_angle(x, np), self.recess_angle(x, np))

    def approaches(self, x: Any) -> Any:
        """True where the contact at x is in approach."""
        return self.approach_angle(x, np) < self.recess_angle(x, np)

    def tau(self, x: Any, approaches: Any) -> Any:
        """Speed ratio at x in the phase given."""
        return np.where(approaches, self.speed(APPROACH, x, np), self.speed(RECESS, x, np))

    def picked(self, pick: Callable[[Any], Any]) -> Couples:
        """Some of the couples, or all in another order: `pick` of every constant."""
        found = Couples.__new__(Couples)
        found.leans = False
        for name in _CONSTANTS:
            setattr(found, name, pick(getattr(self, name)))
        return found

    def rolled(self, n: int) -> Couples:
        """In the place of each couple the one n before it, round the cycle."""
        return self if n == 0 else self.picked(lambda each: np.roll(each, n, -1) if np.ndim(each) else each)

    @property
    def leaning(self) -> NDArray[np.bool_]:
        """True where a flank leans beyond the perpendicular where the tips meet."""
        flank = np.arcsin(np.clip(np.maximum(self.sin1, self.sin2), -1.0, 1.0))
        found: NDArray[np.bool_] = np.asarray(flank + np.maximum(self.reach, 0.0) - self.exit_angle >= np.pi / 2)
        return found

    @property
    def matches(self) -> Floats:
        """alpha_1 where flank lies on flank, D sin(x + beta1) = R1 sin(beta1) + R2 sin(beta2); NaN where nowhere."""
        line = (self.R1 * self.sin1 + self.R2 * self.sin2) / self.D
        with np.errstate(invalid="ignore"):
            found: Floats = np.arcsin(line) - np.arctan2(self.sin1, self.cos1)
        return found


def _half_sine(R1: Any, R2: Any, D: Any, delta: Any) -> Any:
    """Sine of half the reach of wheel 1, Eq. (4)."""
    return np.sqrt(np.clip(delta * (2 * R2 - delta) / (4 * D * R1), 0.0, 1.0))
