"""Many couples of teeth at once: the contact of two teeth with an array for each of its constants.

Two cut wheels on their axles: which tooth meets which, with what sizes.

Couple k joins tooth k of the driver to tooth k of the driven wheel, both counted on through all turns; after
lcm(z1, z2) couples the same teeth meet again. Its driver's leading flank pushes the driven trailing flank.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import gcd
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.teeth.triangular.tooth_couple import APPROACH, RECESS, ToothCouple
from geartrain.workshop.cutting.cut_wheel import CutWheel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes


_CONSTANTS = ("R1", "R2", "D", "delta", "sin1", "cos1", "sin2", "cos2", "entry", "reach", "exit_angle")


class CutToothPairs(ToothCouple):
    """Couples of a driver's and a driven tooth; all arrays broadcast against each other and the angles asked for.

    R1, R2         radii of the tips, that of a ring negative
    beta1, beta2   half angles of the two flanks that meet (rad)
    D, delta       centre distance, negative in an internal pair, and R1 + R2 - D given apart: it must not suffer from
                   cancellation
    """

    __slots__ = ("exit_angle", "reach")

    def __init__(self, R1: Any, R2: Any, beta1: Any, beta2: Any, D: Any, delta: Any) -> None:
        self.R1, self.R2, self.D, self.delta = R1, R2, D, delta
        self.mirror, self.sign2, self.side = (-1 if np.any(np.asarray(each) < 0) else 1 for each in (R1, R2, D))
        self.sin1, self.cos1 = self.mirror * np.sin(beta1), np.cos(beta1)
        self.sin2, self.cos2 = self.mirror * np.sin(beta2), np.cos(beta2)
        self.leans = False
        self.entry = _half_sine(R1, R2, D, delta)
        # tips that pass clear of each other touch nowhere
        self.reach: Floats = np.where(np.asarray(delta) > 0, 2 * np.arcsin(self.entry), -np.inf)
        self.exit_angle: Floats = -2 * np.arcsin(_half_sine(R2, R1, D, delta))

    @classmethod
    def of(cls, sizes: TriangularSizes, tips: tuple[Any, Any], flanks: tuple[Any, Any], shift: Any) -> CutToothPairs:
        """Couples of the teeth of a pair: tips higher and half angles wider by so much, axles so much farther apart."""
        R1, R2 = sizes.signed_radii
        return cls(
            R1 + tips[0],
            R2 + tips[1],
            sizes.beta1 + flanks[0],
            sizes.beta2 + flanks[1],
            sizes.side * (sizes.D + shift),
            sizes.delta + (tips[0] + tips[1]) - sizes.side * shift,
        )

    def contact(self, x: Any) -> Any:
        """f(x) = min(approach, recess): alpha_2 at first contact, where |x| is within the reach."""
        return np.fmin(self.approach_angle(x, np), self.recess_angle(x, np))  # far out of reach one is no number

    def approaches(self, x: Any) -> Any:
        """True where the contact at x is in approach."""
        return self.approach_angle(x, np) < self.recess_angle(x, np)

    def tau(self, x: Any, approaches: Any) -> Any:
        """Speed ratio at x in the phase given."""
        return np.where(approaches, self.speed(APPROACH, x, np), self.speed(RECESS, x, np))

    def picked(self, pick: Callable[[Any], Any]) -> CutToothPairs:
        """Some of the couples, or all in another order: `pick` of every constant."""
        found = CutToothPairs.__new__(CutToothPairs)
        found.leans, found.mirror, found.sign2, found.side = False, self.mirror, self.sign2, self.side
        for name in _CONSTANTS:
            setattr(found, name, pick(getattr(self, name)))
        return found

    def rolled(self, n: int) -> CutToothPairs:
        """In the place of each couple the one n before it, round the cycle."""
        return self if n == 0 else self.picked(lambda each: np.roll(each, n, -1) if np.ndim(each) else each)

    @property
    def leaning(self) -> NDArray[np.bool_]:
        """True where a flank leans beyond the perpendicular where the tips meet."""
        flank = np.arcsin(np.clip(np.maximum(abs(self.sin1), abs(self.sin2)), -1.0, 1.0))
        turned = np.maximum(self.reach, 0.0) - self.side * self.exit_angle
        found: NDArray[np.bool_] = np.asarray(flank + turned >= np.pi / 2)
        return found


def _half_sine(R1: Any, R2: Any, D: Any, delta: Any) -> Any:
    """Sine of half the reach of wheel 1, Eq. (4)."""
    return np.sqrt(np.clip(delta * (2 * R2 - delta) / (4 * D * R1), 0.0, 1.0))


ROUNDING = 1e-11  # of a pitch: what is less is none


@dataclass(frozen=True)
class CutGearPair:
    """Two cut wheels, the first driving, and their centre distance; `sizes` are those without errors.

    shift   by how much the centre distance is greater (as the radii): one, or one for each trial
    """

    sizes: TriangularSizes
    first: CutWheel
    second: CutWheel
    shift: Any = 0.0

    @cached_property
    def count(self) -> int:
        """Couples in a full cycle of teeth."""
        return self.sizes.z1 * self.sizes.z2 // gcd(self.sizes.z1, self.sizes.z2)

    @cached_property
    def trials(self) -> tuple[int, ...]:
        """Shape of the trials: () for one pair."""
        return np.broadcast_shapes(self.first.trials, self.second.trials, np.shape(self.shift))

    def couples(self, k: Any) -> CutToothPairs:
        """Couples k, counted on through all turns."""
        i = k % self.sizes.z1
        j = k % self.sizes.z2
        one, two, sizes = self.first, self.second, self.sizes
        shift = self.shift if np.ndim(self.shift) == 0 else np.asarray(self.shift)[..., None]
        tips = one.tip[..., i], two.tip[..., j]
        return CutToothPairs.of(sizes, tips, (one.leading[..., i], two.trailing[..., j]), shift)

    def places(self, k: Any) -> tuple[Floats, Floats]:
        """How late the two teeth of couples k are (rad, each of its own wheel)."""
        return self.first.place[..., k % self.sizes.z1], self.second.place[..., k % self.sizes.z2]

    @cached_property
    def mirrored(self) -> CutGearPair:
        """The pair that turns the other way: its couple -k is the driver's tooth k ahead of the driven tooth k + 1.

        Where its first contact is U', the back flanks here are met at L(t) = -U'(-t) - p2.
        """
        return CutGearPair(self.sizes, self.first.mirrored(), self.second.mirrored(1), self.shift)

    @cached_property
    def widest(self) -> float:
        """No couple reaches farther (rad of the driver); -inf where none touches."""
        one, two, sizes = self.first, self.second, self.sizes
        shift = float(np.min(self.shift) if sizes.side > 0 else np.max(self.shift))
        R1, R2 = sizes.signed_radii
        low, high = R1 + float(one.tip.min()), R2 + float(two.tip.max())
        delta = sizes.delta + float(one.tip.max()) + float(two.tip.max()) - sizes.side * shift
        return float(CutToothPairs(low, high, sizes.beta1, sizes.beta2, sizes.side * (sizes.D + shift), delta).reach)

    @cached_property
    def leans(self) -> Bools:
        """For each trial, whether a flank leans beyond the perpendicular where the tips of its couple meet."""
        k = np.arange(self.count)
        both = [np.atleast_2d(each.leaning).any(axis=1) for each in (self.couples(k), self.mirrored.couples(k))]
        found: Bools = np.broadcast_to(both[0] | both[1], self.trials or (1,)).copy()
        return found
