"""A wheel as its outline: the teeth that curves make, and the teeth about the axle."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import cos, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.teeth.contact.flank_pieces import table
from geartrain.teeth.contact.flank_table import FlankTable
from geartrain.teeth.contact.outline_curve import OutlineCurve

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_MEETS = 1e-9  # of the radius: curves whose ends are nearer than this follow each other


def _turn(angle: float) -> Callable[[Floats], Floats]:
    def turned(points: Floats) -> Floats:
        x, y = points[:, 0], points[:, 1]
        along, across = y * cos(angle) - x * sin(angle), x * cos(angle) + y * sin(angle)
        return np.stack([across, along, *points.T[2:]], axis=1)

    return turned


@dataclass(frozen=True)
class ToothFlanks:
    """The two sides of a tooth, each a chain of curves from root to tip or from tip to root.

    Tip lands and bottoms need not be given: no arc about the axle touches before its ends do.

    Attributes
    ----------
    ahead : tuple of OutlineCurve
        The side that leads when the wheel turns forward: larger azimuths.
    behind : tuple of OutlineCurve
        The other side.

    See Also
    --------
    solve : an example with such teeth.
    """

    ahead: tuple[OutlineCurve, ...]
    behind: tuple[OutlineCurve, ...]

    @classmethod
    def symmetric(cls, ahead: Sequence[OutlineCurve], middle: float = 0.0) -> ToothFlanks:
        """A tooth whose `behind` is the mirror image of `ahead`.

        Parameters
        ----------
        ahead : sequence of OutlineCurve
            One side.
        middle : float
            Azimuth of the mirror [rad].

        Returns
        -------
        ToothFlanks
            With both sides.
        """
        turned = _turn(2 * middle)
        behind = tuple(curve.mapped(lambda p: turned(p * np.array([-1.0, 1.0, 1.0])[: p.shape[1]])) for curve in ahead)
        return cls(tuple(ahead), behind)

    def mapped(self, change: Callable[[Floats], Floats]) -> ToothFlanks:
        """The tooth with every point changed.

        Parameters
        ----------
        change : callable
            Points (n, 2) or (n, 3) to points of the same shape.

        Returns
        -------
        ToothFlanks
            Of these points.
        """
        return ToothFlanks(*(tuple(curve.mapped(change) for curve in side) for side in (self.ahead, self.behind)))

    def turned(self, angle: float) -> ToothFlanks:
        """The tooth turned forward.

        Parameters
        ----------
        angle : float
            [rad].

        Returns
        -------
        ToothFlanks
            Turned.
        """
        return self.mapped(_turn(angle))


@dataclass(frozen=True)
class GearOutline:
    """A wheel: z teeth about its axle, tooth k turned forward by k pitches.

    Attributes
    ----------
    teeth : tuple of ToothFlanks
        One tooth for all, or one for each of z.
    z : int
        Number of teeth, 1 or more.
    turns : tuple of float
        What tooth k is ahead of its place [rad], z numbers; none where pitches are equal.
    ring : bool
        The teeth point inwards.

    Raises
    ------
    QuestionError
        Where counts do not fit or curves do not meet.

    See Also
    --------
    solve : an example with such wheels.
    """

    teeth: tuple[ToothFlanks, ...]
    z: int
    turns: tuple[float, ...] = ()
    ring: bool = False

    def __post_init__(self) -> None:
        for name, number, few in (("teeth", len(self.teeth), (1, self.z)), ("turns", len(self.turns), (0, self.z))):
            if self.z < 1 or number not in few:
                raise QuestionError(
                    Problem(
                        f"{number} {name} for a wheel of {self.z}",
                        f"a wheel of z teeth takes {few[0]} or z of them, z at least 1",
                        f"give {few[0]} or {self.z} {name}",
                    )
                )
        for tooth in self.teeth:
            for side in (tooth.ahead, tooth.behind):
                _check(side)

    @property
    def pitch(self) -> float:
        """Angle from tooth to tooth (rad)."""
        return 2 * pi / self.z

    @property
    def equal(self) -> bool:
        """True if every tooth is as any other."""
        return len(self.teeth) == 1 and not any(self.turns)

    @cached_property
    def bevel(self) -> bool:
        """True for points on the sphere."""
        curve = self.teeth[0].ahead[0]
        return bool(curve.at([curve.start]).shape[1] == 3)

    @cached_property
    def ahead(self) -> FlankTable:
        """The sides ahead as polynomials."""
        return table([tooth.ahead for tooth in self.teeth])

    @cached_property
    def behind(self) -> FlankTable:
        """The sides behind as polynomials."""
        return table([tooth.behind for tooth in self.teeth])

    def displaced(self, x: float, y: float) -> GearOutline:
        """The same wheel on an axle that misses its middle; no tooth is as another.

        Parameters
        ----------
        x, y : float
            By how much its points are moved, in the outline's unit.

        Returns
        -------
        GearOutline
            With a tooth of its own for each of z.

        Raises
        ------
        QuestionError
            For bevel wheels.
        """
        if self.bevel:
            raise QuestionError(
                Problem(
                    "a bevel wheel cannot be displaced in its plane",
                    "its teeth lie on a sphere about the apex",
                    "give every tooth its own curves instead",
                )
            )
        offsets = self.turns or (0.0,) * self.z
        return GearOutline(tuple(self._moved(k, offsets[k], x, y) for k in range(self.z)), self.z, (), self.ring)

    def _moved(self, k: int, offset: float, x: float, y: float) -> ToothFlanks:
        place = k * self.pitch
        by = np.array([x, y])
        tooth = self.teeth[k % len(self.teeth)]
        return tooth.turned(place + offset).mapped(lambda points: points + by).turned(-place)


def _check(side: tuple[OutlineCurve, ...]) -> None:
    """A side is a chain of curves that meet, with finite points off the axle."""
    if not side:
        raise QuestionError(Problem("a tooth has a side without curves", "nothing can touch it", "give a curve"))
    last = None
    for curve in side:
        ends = curve.at(np.array([curve.start, curve.end]))
        if not np.isfinite(ends).all() or curve.start == curve.end or not np.hypot(ends[:, 0], ends[:, 1]).all():
            raise QuestionError(
                Problem(
                    f"a curve from {curve.start:.6g} to {curve.end:.6g} has no use as part of a tooth",
                    "its ends are not finite, are on the axle, or are the same parameter",
                    "give two parameters at which the curve has points off the axle",
                )
            )
        if last is not None and np.abs(ends[0] - last).max() > _MEETS * np.abs(ends).max():
            raise QuestionError(
                Problem(
                    "two curves of a tooth do not meet",
                    f"one ends at {last}, the next begins at {ends[0]}",
                    "give the curves of a side in order, each from the end of the last one",
                )
            )
        last = ends[1]
