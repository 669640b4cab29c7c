"""Triangular wheels with cutting errors, and gear pairs of two such wheels: CutWheel, CutToothPairs, CutGearPair.

Teeth are numbered in the order in which they pass the line of centres as the wheel turns forward. The tip of tooth i is
at the angle i p + place[i] behind tooth 0 of a perfect wheel, at the radius R + tip[i]; p is the pitch, R the nominal
tip radius. The flanks of tooth i make the angles beta + leading[i] and beta + trailing[i] with the radius through the
tip, with the nominal half angle beta. The leading flank faces forward. It pushes the mate if the wheel drives. The
trailing flank is pushed by the mate if the wheel is driven. The radius of an internal wheel is negative, as in the
equations of its pair, so a higher tip is nearer the centre.

Tooth pair k joins tooth k of the driver to tooth k of the driven wheel, both counted through all turns. After
lcm(z1, z2) tooth pairs the same teeth meet again. The leading flank of the driver pushes the trailing flank of the
driven tooth.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import gcd, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.teeth.triangular.tooth_pair import APPROACH, RECESS, ToothPair

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes


ROUNDING = 1e-11  # pitches: smaller differences are rounding errors
_CONSTANTS = ("R1", "R2", "D", "delta", "sin1", "cos1", "sin2", "cos2", "entry", "reach", "exit_angle")


# ------------------------------------------------------------------------------------------------------------ one wheel


@dataclass(frozen=True, slots=True)
class CutWheel:
    """Triangular wheel with cutting errors: each tooth has its own pitch deviation, height and flank angles.

    All arrays have shape (..., z) for z teeth, numbered in the order in which they pass the line of centres while the
    wheel turns forward. The leading axes index the trials. An angle behind a position is positive against the forward
    direction of rotation.
    """

    radius: float
    """Tip radius of the perfect wheel [any unit of length]; negative for an internal wheel."""
    half_angle: float
    """Half angle of the teeth of the perfect wheel [rad]."""
    place: Floats
    """Angle of each tip behind its nominal position [rad]."""
    tip: Floats
    """Height of each tip above the nominal tip radius [unit of `radius`]."""
    leading: Floats
    """Half angle of each leading flank minus the nominal half angle [rad]; the flank is rotated about the tip."""
    trailing: Floats
    """Half angle of each trailing flank minus the nominal half angle [rad]; the flank is rotated about the tip."""

    @classmethod
    def even(cls, z: int, radius: float, half_angle: float) -> CutWheel:
        """Return a triangular wheel with z teeth and without errors."""
        return cls(radius, half_angle, *(np.zeros(z) for _ in range(4)))

    # ------------------------------------------------------------------------------------------------------ properties

    @property
    def z(self) -> int:
        """Number of teeth."""
        return int(self.place.shape[-1])

    @property
    def trials(self) -> tuple[int, ...]:
        """Shape of the leading (trial) axes of the arrays; () for a single wheel."""
        return np.broadcast_shapes(*(each.shape[:-1] for each in (self.place, self.tip, self.leading, self.trailing)))

    @property
    def sign(self) -> int:
        """Sign of the radius: -1 for an internal wheel, 1 for an external wheel."""
        return -1 if self.radius < 0 else 1

    @property
    def pitch(self) -> float:
        """Nominal angular pitch [rad]."""
        return 2 * pi / self.z

    @property
    def theta(self) -> Floats:
        """Angle of each tip from the nominal position of tooth 0, positive against the direction of rotation [rad]."""
        return np.arange(self.z) * self.pitch + self.place

    @property
    def r(self) -> Floats:
        """Radius of each tip [unit of `radius`], negative for an internal wheel."""
        return self.radius + self.tip

    @property
    def only_pitch_deviations(self) -> bool:
        """True if all tip heights and flank angles are nominal, so that no errors other than pitch deviations exist."""
        return not any(np.any(each) for each in (self.tip, self.leading, self.trailing))

    def taken(self, part: int | slice | NDArray[np.int64]) -> CutWheel:
        """Return the wheels of some trials. `part` is a slice or an array of indices, or the index of one trial."""
        some = (each[part] if each.ndim > 1 else each for each in (self.place, self.tip, self.leading, self.trailing))
        return CutWheel(self.radius, self.half_angle, *some)

    def moved(self, e: ArrayLike, towards: ArrayLike) -> CutWheel:
        """Return this wheel with an eccentricity `e` [unit of `radius`] in the direction `towards` [rad]."""
        far, direction = (np.asarray(each, dtype=float)[..., None] for each in (e, towards))
        out, turned = displaced(np.abs(self.r), self.theta, far, direction)
        # the flanks keep their directions, but the radius through the tip turns
        lean = self.sign * turned
        return replace(
            self,
            place=self.place + turned,
            tip=self.tip + self.sign * out,
            leading=self.leading - lean,
            trailing=self.trailing + lean,
        )

    def filed(self, leading: Floats, trailing: Floats) -> CutWheel:
        """Return this wheel with flanks filed along their normals by the depths `leading` and `trailing`, (..., z)."""
        ahead, behind = self.half_angle + self.leading, self.half_angle + self.trailing
        # filing a flank moves the tip down along the other flank, to its intersection with the lowered flank
        down, across = 1 / np.sin(ahead + behind), trailing * np.sin(ahead) - leading * np.sin(behind)
        radial = self.r - down * (leading * np.cos(behind) + trailing * np.cos(ahead))
        late = -np.arctan2(down * across, np.abs(radial))
        tip = self.sign * np.hypot(radial, down * across) - self.radius
        lean = self.sign * late
        return replace(
            self, place=self.place + late, tip=tip, leading=self.leading - lean, trailing=self.trailing + lean
        )

    def mirrored(self, first: int = 0) -> CutWheel:
        """Return the mirror image of this wheel; its tooth i is the image of tooth `first` - i."""
        # mirroring reverses the order of the teeth and exchanges their flanks
        order = (first - np.arange(self.z)) % self.z
        place, tip, leading, trailing = (
            each[..., order] for each in (self.place, self.tip, self.leading, self.trailing)
        )
        return CutWheel(self.radius, self.half_angle, -place, tip, trailing, leading)

    @property
    def cuttable(self) -> NDArray[np.bool_]:
        """Mask, (..., z): True for a tooth if a tooth space with two flanks exists between it and the next tooth."""
        gap = self.pitch + np.roll(self.place, -1, -1) - self.place
        near, far = np.broadcast_arrays(self.r, np.roll(self.r, -1, -1))
        # angle at each tip between its radius and the line to the other tip; the flanks must be inside both
        at_near = np.arctan2(np.abs(far) * np.sin(gap), near - far * np.cos(gap))
        at_far = np.arctan2(np.abs(near) * np.sin(gap), far - near * np.cos(gap))
        trailing, leading = self.half_angle + self.trailing, self.half_angle + np.roll(self.leading, -1, -1)
        # the tip angles above are valid only for tips less than half a turn apart
        good = (self.sign * near > 0) & (gap > 0) & (gap < pi) & (trailing > 0) & (leading > 0)
        tipped: NDArray[np.bool_] = good & (trailing < at_near) & (leading < at_far)
        return tipped


def of_teeth(each: Floats, rows: Ints, teeth: Ints) -> Any:
    """Return the values of one tooth in each of several trials.

    each          values of all teeth, shape (trials, z), or (z,) if they are the same in all trials
    rows, teeth   indices of the trials, and index of the tooth in each of these trials
    """
    if each.ndim == 1:
        return each[teeth] if each.any() else 0.0  # a scalar saves memory
    return each[rows, teeth]


def displaced(radius: Floats, angle: Floats, e: Floats, towards: Floats) -> tuple[Floats, Floats]:
    """Return the changes of radius and of angle [rad] of points that are shifted, in polar coordinates.

    radius, angle   polar coordinates of the points before the shift (angle in rad)
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
    """Contact of many pairs of a driving and a driven tooth. All arrays broadcast with the driver angles.

    R1, R2         radii of the tips, negative for an internal wheel
    beta1, beta2   half angles of the two flanks in contact (rad)
    D              centre distance, negative for an internal pair
    delta          R1 + R2 - D, given separately to avoid cancellation
    """

    __slots__ = ("exit_angle", "reach")

    def __init__(self, R1: Any, R2: Any, beta1: Any, beta2: Any, D: Any, delta: Any) -> None:
        self.R1, self.R2, self.D, self.delta = R1, R2, D, delta
        self.mirror, self.sign2, self.side = (-1 if np.any(np.asarray(each) < 0) else 1 for each in (R1, R2, D))
        self.sin1, self.cos1 = self.mirror * np.sin(beta1), np.cos(beta1)
        self.sin2, self.cos2 = self.mirror * np.sin(beta2), np.cos(beta2)
        self.leans = False
        self.entry = _half_sine(R1, R2, D, delta)
        # tips that do not reach each other never touch
        self.reach: Floats = np.where(np.asarray(delta) > 0, 2 * np.arcsin(self.entry), -np.inf)
        self.exit_angle: Floats = -2 * np.arcsin(_half_sine(R2, R1, D, delta))

    @classmethod
    def of(cls, sizes: TriangularSizes, tips: tuple[Any, Any], flanks: tuple[Any, Any], shift: Any) -> CutToothPairs:
        """Return tooth pairs of nominal `sizes` plus errors of both tips, both half angles [rad] and the distance."""
        R1, R2 = sizes.signed_radii
        return cls(
            R1 + tips[0],
            R2 + tips[1],
            sizes.beta1 + flanks[0],
            sizes.beta2 + flanks[1],
            sizes.side * (sizes.D + shift),
            # small terms are added to the nominal overlap, because R1 + R2 - D would lose their digits
            sizes.delta + (tips[0] + tips[1]) - sizes.side * shift,
        )

    def contact(self, x: Any) -> Any:
        """Return the angle of the driven tooth [rad] if the angle of the driving tooth is x, |x| <= `reach` [rad].

        Both are the angles of the tips from the line of centres, positive on the entry side.
        """
        # the phase of contact is the one with the smaller angle; far out of reach one of the angles is NaN
        return np.fmin(self.angle(APPROACH, x, np), self.angle(RECESS, x, np))

    def approaches(self, x: Any) -> Any:
        """Return a mask that is True for tooth pairs in the approach phase at the driver angle x [rad]."""
        return self.angle(APPROACH, x, np) < self.angle(RECESS, x, np)

    def tau(self, x: Any, approaches: Any) -> Any:
        """Return the speed ratio of tooth pairs at the driver angle x [rad]; `approaches` is a mask of their phases."""
        return np.where(approaches, self.speed(APPROACH, x, np), self.speed(RECESS, x, np))

    def picked(self, pick: Callable[[Any], Any]) -> CutToothPairs:
        """Return the tooth pairs that the function `pick` selects or reorders; it is applied to every array."""
        # without __init__, which would recompute every constant
        found = CutToothPairs.__new__(CutToothPairs)
        found.leans, found.mirror, found.sign2, found.side = False, self.mirror, self.sign2, self.side
        for name in _CONSTANTS:
            setattr(found, name, pick(getattr(self, name)))
        return found

    def rolled(self, n: int) -> CutToothPairs:
        """Return the tooth pairs in cyclically shifted order: entry k is the previous entry k - n."""
        return self if n == 0 else self.picked(lambda each: np.roll(each, n, -1) if np.ndim(each) else each)


def _half_sine(R1: Any, R2: Any, D: Any, delta: Any) -> Any:
    """Return the sine of half the maximum contact angle of wheel 1, by equation (4) of Sorge; 0 if no tips meet."""
    # clipped, because delta is negative if the tips do not reach each other
    return np.sqrt(np.clip(delta * (2 * R2 - delta) / (4 * D * R1), 0.0, 1.0))


@dataclass(frozen=True)
class CutGearPair:
    """Pair of cut wheels at a given centre distance. The first wheel drives; `sizes` contains the nominal sizes."""

    sizes: TriangularSizes
    first: CutWheel
    second: CutWheel
    shift: Any = 0.0
    """Increase of the centre distance [unit of the radii]: one value, or one value for each trial."""

    @cached_property
    def count(self) -> int:
        """Number of tooth pairs in a full meshing cycle."""
        return self.sizes.z1 * self.sizes.z2 // gcd(self.sizes.z1, self.sizes.z2)

    @cached_property
    def trials(self) -> tuple[int, ...]:
        """Shape of the leading (trial) axes of both wheels; () for a single pair."""
        return np.broadcast_shapes(self.first.trials, self.second.trials, np.shape(self.shift))

    @property
    def teeth(self) -> tuple[int, int]:
        """Numbers of teeth of the driver and of the driven wheel."""
        return self.sizes.z1, self.sizes.z2

    def taken(self, part: slice | Ints) -> CutGearPair:
        """Return the gear pairs of the selected trials, which are given by a slice or by indices."""
        shift = self.shift if np.ndim(self.shift) == 0 else self.shift[part]
        return CutGearPair(self.sizes, self.first.taken(part), self.second.taken(part), shift)

    def filed(self, depths: tuple[Floats, Floats]) -> CutGearPair:
        """Return this pair with filed flanks.

        depths   depth removed from each flank of each wheel, in the unit of the radii, shape (trials, 2, z); the
                 second index is 0 for leading and 1 for trailing flanks
        """
        wheels = zip((self.first, self.second), depths, strict=True)
        first, second = (wheel.filed(each[:, 0], each[:, 1]) for wheel, each in wheels)
        return CutGearPair(self.sizes, first, second, self.shift)

    def tooth_pairs(self, k: Any) -> CutToothPairs:
        """Return the tooth pairs with the numbers k; pair k joins driving tooth k mod z1 to driven tooth k mod z2."""
        i = k % self.sizes.z1
        j = k % self.sizes.z2
        one, two = self.first, self.second
        shift = self.shift if np.ndim(self.shift) == 0 else np.asarray(self.shift)[..., None]
        tips = one.tip[..., i], two.tip[..., j]
        return CutToothPairs.of(self.sizes, tips, (one.leading[..., i], two.trailing[..., j]), shift)

    def places(self, k: Any) -> tuple[Floats, Floats]:
        """Return the pitch deviations of the driving and the driven teeth in tooth pairs k, as in `CutWheel.place`."""
        return self.first.place[..., k % self.sizes.z1], self.second.place[..., k % self.sizes.z2]

    @cached_property
    def mirrored(self) -> CutGearPair:
        """Mirror image of the pair. Its tooth pair -k consists of driving tooth k and driven tooth k + 1 of this pair.

        If the driven wheel of the image lags by U'(t) at the driver angle t, the coast flanks of this pair meet at the
        lag -U'(-t) - p2, where p2 is the angular pitch of the driven wheel.
        """
        return CutGearPair(self.sizes, self.first.mirrored(), self.second.mirrored(1), self.shift)

    @cached_property
    def widest(self) -> float:
        """Upper bound of the angle at which a driving tooth can touch a driven tooth [rad]; -inf if it never does."""
        one, two, sizes = self.first, self.second, self.sizes
        shift = float(np.min(self.shift) if sizes.side > 0 else np.max(self.shift))
        R1, R2 = sizes.signed_radii
        # extreme tips of either wheel, even if they never meet: an upper bound
        low, high = R1 + float(one.tip.min()), R2 + float(two.tip.max())
        delta = sizes.delta + float(one.tip.max()) + float(two.tip.max()) - sizes.side * shift
        return float(CutToothPairs(low, high, sizes.beta1, sizes.beta2, sizes.side * (sizes.D + shift), delta).reach)
