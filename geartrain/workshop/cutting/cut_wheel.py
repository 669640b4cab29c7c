"""Wheels with triangular teeth cut by hand, and two of them on their axles: CutWheel, CutToothPairs, CutGearPair.

Teeth are numbered in the order in which they pass the line of centres as the wheel turns forward. The tip of tooth i
stands at the angle i p + place[i] behind that of an even wheel's tooth 0 (p the pitch), at radius R + tip[i]; its
flanks make the angles beta + leading[i] and beta + trailing[i] with the radius through the tip. The leading flank looks
forward: it pushes where the wheel drives, and the trailing flank is pushed where it is driven. The radius of a ring is
negative, as in the equations of its pair: a tip that is higher lies farther inwards.

Couple k joins tooth k of the driver to tooth k of the driven wheel, both counted on through all turns; after
lcm(z1, z2) couples the same teeth meet again. Its driver's leading flank pushes the driven trailing flank.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import gcd, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.triangular.tooth_pair import APPROACH, RECESS, ToothPair

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes


ROUNDING = 1e-11  # of a pitch: what is less is none
_CONSTANTS = ("R1", "R2", "D", "delta", "sin1", "cos1", "sin2", "cos2", "entry", "reach", "exit_angle")


# ------------------------------------------------------------------------------------------------------------ one wheel


@dataclass(frozen=True, slots=True)
class CutWheel:
    """A wheel cut by hand: each tooth with its own place, height and flanks, relative to an even wheel.

    All arrays are (..., z) for z teeth, numbered as they pass while the wheel turns forward; leading axes are trials.
    """

    radius: float
    """Tip radius R of the even wheel [any one unit], negative for a ring."""
    half_angle: float
    """Half aperture of its teeth [rad]."""
    place: Floats
    """How far behind its even place a tip is [rad]."""
    tip: Floats
    """How far a tip extends beyond R [as R]."""
    leading: Floats
    """By how much the flanks are flatter than the half angle, about the axle [rad]."""
    trailing: Floats
    """By how much the flanks are flatter than the half angle, about the axle [rad]."""

    @classmethod
    def even(cls, z: int, radius: float, half_angle: float) -> CutWheel:
        """A wheel of z teeth without errors."""
        return cls(radius, half_angle, *(np.zeros(z) for _ in range(4)))

    # ---------------------------------------------------------------------------------------------------------- as is

    @property
    def z(self) -> int:
        """Tooth number."""
        return int(self.place.shape[-1])

    @property
    def trials(self) -> tuple[int, ...]:
        """Shape of the leading axes: () for one wheel."""
        return np.broadcast_shapes(*(each.shape[:-1] for each in (self.place, self.tip, self.leading, self.trailing)))

    @property
    def sign(self) -> int:
        """-1 for a ring, else 1."""
        return -1 if self.radius < 0 else 1

    @property
    def pitch(self) -> float:
        """Even pitch (rad)."""
        return 2 * pi / self.z

    @property
    def theta(self) -> Floats:
        """Polar angle of every tip (rad)."""
        return np.arange(self.z) * self.pitch + self.place

    @property
    def r(self) -> Floats:
        """Radius of every tip, negative in a ring."""
        return self.radius + self.tip

    @property
    def only_placed(self) -> bool:
        """True if teeth differ in nothing but their places."""
        return not any(np.any(each) for each in (self.tip, self.leading, self.trailing))

    def trial(self, at: int) -> CutWheel:
        """One wheel out of many; an array that all share stays."""
        one = (each[at] if each.ndim > 1 else each for each in (self.place, self.tip, self.leading, self.trailing))
        return CutWheel(self.radius, self.half_angle, *one)

    def taken(self, part: slice | NDArray[np.int64]) -> CutWheel:
        """Some wheels out of many."""
        some = (each[part] if each.ndim > 1 else each for each in (self.place, self.tip, self.leading, self.trailing))
        return CutWheel(self.radius, self.half_angle, *some)

    # ------------------------------------------------------------------------------------------------------ with errors

    def placed(self, place: ArrayLike) -> CutWheel:
        """Teeth moved along the rim, late where positive [rad]: flanks turn with them."""
        return replace(self, place=self.place + np.asarray(place)).checked()

    def grown(self, tip: ArrayLike) -> CutWheel:
        """Teeth cut to other heights [as R]: only tips move, radially."""
        return replace(self, tip=self.tip + np.asarray(tip)).checked()

    def widened(self, leading: ArrayLike, trailing: ArrayLike | None = None) -> CutWheel:
        """Teeth with other half angles, flatter where positive [rad]; the first alone gives both flanks."""
        trailing = leading if trailing is None else trailing
        return replace(
            self, leading=self.leading + np.asarray(leading), trailing=self.trailing + np.asarray(trailing)
        ).checked()

    def eccentric(self, e: ArrayLike, towards: ArrayLike = 0.0) -> CutWheel:
        """The same teeth cut about a centre at a distance e from the axle [as R], in a direction [rad]."""
        return self.moved(e, towards).checked()

    def moved(self, e: ArrayLike, towards: ArrayLike) -> CutWheel:
        """The wheel of `eccentric`, whether its teeth can be cut or not."""
        far, direction = (np.asarray(each, dtype=float)[..., None] for each in (e, towards))
        out, turned = displaced(np.abs(self.r), self.theta, far, direction)
        lean = self.sign * turned
        return replace(
            self,
            place=self.place + turned,
            tip=self.tip + self.sign * out,
            leading=self.leading - lean,
            trailing=self.trailing + lean,
        )

    def filed(self, leading: Floats, trailing: Floats) -> CutWheel:
        """The same teeth with flanks lowered along their normals: each tip moves down the other flank.

        leading, trailing   by how much, 0 or more, (..., z) [as R]
        """
        ahead, behind = self.half_angle + self.leading, self.half_angle + self.trailing
        # the other flank meets the lowered one this much farther down
        down, across = 1 / np.sin(ahead + behind), trailing * np.sin(ahead) - leading * np.sin(behind)
        radial = self.r - down * (leading * np.cos(behind) + trailing * np.cos(ahead))
        late = -np.arctan2(down * across, np.abs(radial))
        tip = self.sign * np.hypot(radial, down * across) - self.radius
        lean = self.sign * late
        return replace(
            self, place=self.place + late, tip=tip, leading=self.leading - lean, trailing=self.trailing + lean
        )

    def mirrored(self, first: int = 0) -> CutWheel:
        """The wheel seen from behind, turning the other way; tooth i is tooth `first` - i as it was."""
        order = (first - np.arange(self.z)) % self.z
        return CutWheel(
            self.radius,
            self.half_angle,
            -self.place[..., order],
            self.tip[..., order],
            self.trailing[..., order],
            self.leading[..., order],
        )

    # -------------------------------------------------------------------------------------------------------- refusals

    def checked(self) -> CutWheel:
        """The wheel itself. Raises `RangeError` where its teeth cannot be cut: no tooth, or no space, is left."""
        if not self.cuttable.all():
            bad = int(np.size(self.cuttable) - np.count_nonzero(self.cuttable))
            where = np.unravel_index(int(np.argmin(self.cuttable)), np.shape(self.cuttable))
            raise RangeError(
                Problem(
                    f"{bad} of {np.size(self.cuttable)} teeth cannot be cut, the first of them tooth {where[-1]}",
                    "with such errors a flank and the next tooth's flank leave no tip standing, or meet in no valley",
                    "give errors smaller than the tooth: places within the pitch, half angles above 0 and below those "
                    "at which teeth lose their tips",
                )
            )
        return self

    @property
    def cuttable(self) -> NDArray[np.bool_]:
        """For each tooth, whether it and the next have tips, flanks, and a valley between them (..., z)."""
        gap = self.pitch + np.roll(self.place, -1, -1) - self.place
        near, far = np.broadcast_arrays(self.r, np.roll(self.r, -1, -1))
        # the angle at each tip between its radius and the line to the other tip; the flanks must lie inside both
        at_near = np.arctan2(np.abs(far) * np.sin(gap), near - far * np.cos(gap))
        at_far = np.arctan2(np.abs(near) * np.sin(gap), far - near * np.cos(gap))
        trailing, leading = self.half_angle + self.trailing, self.half_angle + np.roll(self.leading, -1, -1)
        good = (self.sign * near > 0) & (gap > 0) & (gap < pi) & (trailing > 0) & (leading > 0)
        tipped: NDArray[np.bool_] = good & (trailing < at_near) & (leading < at_far)
        return tipped


def of_teeth(each: Floats, rows: Ints, teeth: Ints) -> Any:
    """The value of one tooth of each trial; a plain 0 where all are, which costs no array."""
    if each.ndim == 1:
        return each[teeth] if each.any() else 0.0
    return each[rows, teeth]


def displaced(radius: Floats, angle: Floats, e: Floats, towards: Floats) -> tuple[Floats, Floats]:
    """How far a shift moves points outwards and turns them, seen from a fixed centre; exact at any size.

    radius, angle   of the points, polar (rad)
    e, towards      length and direction (rad) of the shift
    """
    along = e * np.cos(towards - angle)
    across = e * np.sin(towards - angle)
    turned = np.arctan2(across, radius + along)
    far = np.hypot(radius + along, across)
    # (far^2 - radius^2) / (far + radius): far - radius would lose the digits of a small shift
    out: Floats = (2 * radius * along + np.square(e)) / (far + radius)
    return out, turned


# ----------------------------------------------------------------------------------------------------------- two wheels


class CutToothPairs(ToothPair):
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
        """Speed ratio at x in the phase given; infinite where teeth that jam overlap down past the driven flank."""
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


@dataclass(frozen=True)
class CutGearPair:
    """Two cut wheels, the first driving, and their centre distance; `sizes` are those without errors."""

    sizes: TriangularSizes
    first: CutWheel
    second: CutWheel
    shift: Any = 0.0
    """By how much the centre distance is greater (as the radii): one, or one for each trial."""

    @cached_property
    def count(self) -> int:
        """Couples in a full cycle of teeth."""
        return self.sizes.z1 * self.sizes.z2 // gcd(self.sizes.z1, self.sizes.z2)

    @cached_property
    def trials(self) -> tuple[int, ...]:
        """Shape of the trials: () for one pair."""
        return np.broadcast_shapes(self.first.trials, self.second.trials, np.shape(self.shift))

    def tooth_pairs(self, k: Any) -> CutToothPairs:
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
        both = [np.atleast_2d(each.leaning).any(axis=1) for each in (self.tooth_pairs(k), self.mirrored.tooth_pairs(k))]
        found: Bools = np.broadcast_to(both[0] | both[1], self.trials or (1,)).copy()
        return found
