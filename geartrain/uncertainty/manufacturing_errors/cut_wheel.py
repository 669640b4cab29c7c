"""A wheel cut by hand: every tooth with its own place, height and flanks, all about the axle.

Teeth are numbered in the order in which they pass the line of centres as the wheel turns forward. The tip of tooth i
stands at the angle i p + place[i] behind that of an even wheel's tooth 0 (p the pitch), at radius R + tip[i]; its
flanks make the angles beta + leading[i] and beta + trailing[i] with the radius through the tip. The leading flank looks
forward: it pushes where the wheel drives, and the trailing flank is pushed where it is driven.

Errors of cutting as distributions, and wheels drawn from them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, pi
from typing import TYPE_CHECKING, Literal

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.triangular.pair_geometry import depth

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from geartrain.numerics.arrays import Floats


def displaced(radius: Floats, angle: Floats, e: Floats, towards: Floats) -> tuple[Floats, Floats]:
    """How far a shift moves points outwards and turns them, seen from a fixed centre; exact at any size.

    radius, angle   of the points, polar (rad)
    e, towards      length and direction (rad) of the shift
    """
    along = e * np.cos(towards - angle)
    across = e * np.sin(towards - angle)
    turned = np.arctan2(across, radius + along)
    far = np.hypot(radius + along, across)
    out: Floats = (2 * radius * along + np.square(e)) / (far + radius)
    return out, turned


@dataclass(frozen=True, slots=True)
class CutWheel:
    """Teeth as they are, each array (..., z) and relative to an even wheel: leading axes are trials.

    radius, half_angle   of the even wheel: outer radius R in any one unit, half aperture beta (rad)
    place                how far behind its even place a tip stands (rad)
    tip                  how far a tip stands out beyond R (as R)
    leading, trailing    by how much the flanks are flatter than beta, about the axle (rad)
    """

    radius: float
    half_angle: float
    place: Floats
    tip: Floats
    leading: Floats
    trailing: Floats

    @classmethod
    def even(cls, z: int, radius: float, half_angle: float) -> CutWheel:
        """A wheel without errors."""
        return cls(radius, half_angle, *(np.zeros(z) for _ in range(4)))

    @classmethod
    def measured(
        cls, even: CutWheel, theta: ArrayLike, r: ArrayLike, leading: ArrayLike, trailing: ArrayLike
    ) -> CutWheel:
        """A wheel measured tooth by tooth: polar angle (rad) and radius of each tip, half angle (rad) of each flank."""
        teeth = [np.asarray(each, dtype=float) for each in (theta, r, leading, trailing)]
        if any(each.shape[-1:] != (even.z,) for each in teeth):
            raise RangeError(
                Problem(
                    f"the tables of a wheel of {even.z} teeth have other lengths: {[each.shape for each in teeth]}",
                    "each tooth has one angle, one radius and two half angles",
                    f"give {even.z} values of each, in the order in which teeth pass",
                )
            )
        place, tip = teeth[0] - np.arange(even.z) * even.pitch, teeth[1] - even.radius
        return replace(
            even, place=place, tip=tip, leading=teeth[2] - even.half_angle, trailing=teeth[3] - even.half_angle
        ).checked()

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
    def pitch(self) -> float:
        """Even pitch (rad)."""
        return 2 * pi / self.z

    @property
    def theta(self) -> Floats:
        """Polar angle of every tip (rad)."""
        return np.arange(self.z) * self.pitch + self.place

    @property
    def r(self) -> Floats:
        """Radius of every tip."""
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
        """Teeth moved along the rim, late where positive (rad): flanks turn with them."""
        return replace(self, place=self.place + np.asarray(place)).checked()

    def grown(self, tip: ArrayLike) -> CutWheel:
        """Teeth cut to other heights: only tips move, radially."""
        return replace(self, tip=self.tip + np.asarray(tip)).checked()

    def widened(self, leading: ArrayLike, trailing: ArrayLike | None = None) -> CutWheel:
        """Teeth with other half angles (rad); one value gives both flanks."""
        trailing = leading if trailing is None else trailing
        return replace(
            self, leading=self.leading + np.asarray(leading), trailing=self.trailing + np.asarray(trailing)
        ).checked()

    def eccentric(self, e: ArrayLike, towards: ArrayLike = 0.0) -> CutWheel:
        """The same teeth cut about a centre that lies off the axle: the sinusoidal error.

        e         distance of the two (as R), one or one for each trial
        towards   direction of the centre from the axle (rad, as theta)
        """
        far, direction = (np.asarray(each, dtype=float)[..., None] for each in (e, towards))
        out, turned = displaced(self.r, self.theta, far, direction)
        return CutWheel(
            self.radius,
            self.half_angle,
            self.place + turned,
            self.tip + out,
            self.leading - turned,
            self.trailing + turned,
        ).checked()

    def mirrored(self, first: int = 0) -> CutWheel:
        """The wheel seen from behind, turning the other way: tooth i is tooth `first` - i as it was."""
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
        at_near = np.arctan2(far * np.sin(gap), near - far * np.cos(gap))
        at_far = np.arctan2(near * np.sin(gap), far - near * np.cos(gap))
        trailing, leading = self.half_angle + self.trailing, self.half_angle + np.roll(self.leading, -1, -1)
        good = (near > 0) & (gap > 0) & (gap < pi) & (trailing > 0) & (leading > 0)
        tipped: NDArray[np.bool_] = good & (trailing < at_near) & (leading < at_far)
        return tipped


@dataclass(frozen=True, slots=True)
class ErrorDistribution:
    """An error without bias: `size` is the standard deviation of a normal one, half the width of a uniform one."""

    size: float = 0.0
    kind: Literal["normal", "uniform"] = "normal"

    def __post_init__(self) -> None:
        if not 0 <= self.size < inf:
            raise RangeError(Problem(f"an error of {self.size:g} is no size", "", "give 0 or more, and finite"))

    def draw(self, rng: np.random.Generator, shape: tuple[int, ...]) -> Floats:
        """Independent errors; zeros are drawn too, so that one size does not change what others draw."""
        unit = rng.standard_normal(shape) if self.kind == "normal" else rng.uniform(-1.0, 1.0, shape)
        return self.size * unit


@dataclass(frozen=True, slots=True)
class CuttingErrorModel:
    """How badly a wheel is cut.

    place         of each tooth, in pitches
    tip           height of each tooth, in depths of its tooth
    aperture      half angle of each flank apart, in half angles
    eccentricity  distance of the centre from the axle, in depths of a tooth; any direction is as likely
    """

    place: ErrorDistribution = ErrorDistribution()
    tip: ErrorDistribution = ErrorDistribution()
    aperture: ErrorDistribution = ErrorDistribution()
    eccentricity: ErrorDistribution = ErrorDistribution()

    def draw(self, even: CutWheel, rng: np.random.Generator, trials: int) -> CutWheel:
        """Wheels (trials, z) cut so, from a wheel without errors. Raises `RangeError` if one of them cannot be cut."""
        if trials < 1:
            raise RangeError(Problem(f"{trials} trials tell nothing", "", "ask for at least 1"))
        shape, high = (trials, even.z), even.radius * depth(even.z, even.half_angle)
        place, tip = self.place.draw(rng, shape), self.tip.draw(rng, shape)
        leading, trailing = self.aperture.draw(rng, shape), self.aperture.draw(rng, shape)
        e, towards = self.eccentricity.draw(rng, (trials,)), rng.uniform(0.0, 2 * pi, trials)
        wheel = even.placed(even.pitch * place)
        if self.tip.size:
            wheel = wheel.grown(high * tip)
        if self.aperture.size:
            wheel = wheel.widened(even.half_angle * leading, even.half_angle * trailing)
        return wheel.eccentric(high * np.abs(e), towards) if self.eccentricity.size else wheel
