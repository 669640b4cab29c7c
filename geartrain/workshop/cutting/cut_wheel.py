"""A wheel cut by hand: every tooth with its own place, height and flanks, all about the axle.

Teeth are numbered in the order in which they pass the line of centres as the wheel turns forward. The tip of tooth i
stands at the angle i p + place[i] behind that of an even wheel's tooth 0 (p the pitch), at radius R + tip[i]; its
flanks make the angles beta + leading[i] and beta + trailing[i] with the radius through the tip. The leading flank looks
forward: it pushes where the wheel drives, and the trailing flank is pushed where it is driven. The radius of a ring is
negative, as in the equations of its pair: a tip that is higher lies farther inwards.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from geartrain.numerics.arrays import Floats, Ints


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


@dataclass(frozen=True, slots=True)
class CutWheel:
    """A wheel cut by hand: each tooth with its own place, height and flanks, relative to an even wheel.

    All arrays are (..., z) for z teeth, numbered as they pass while the wheel turns forward; leading axes are trials.

    radius             tip radius R of the even wheel [any one unit], negative for a ring
    half_angle         half aperture of its teeth [rad]
    place              how far behind its even place a tip is [rad]
    tip                how far a tip extends beyond R [as R]
    leading, trailing  by how much the flanks are flatter than the half angle, about the axle [rad]
    """

    radius: float
    half_angle: float
    place: Floats
    tip: Floats
    leading: Floats
    trailing: Floats

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
