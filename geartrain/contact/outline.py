"""A wheel as its outline: curves, the teeth they make, and the teeth about the axle."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import cos, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.contact.pieces import table
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.contact.polynomials import Floats
    from geartrain.contact.table import Table

_MEETS = 1e-9  # of the radius: curves whose ends are nearer than this follow each other


@dataclass(frozen=True)
class Curve:
    """A smooth curve of a tooth, from parameter `start` to `end`.

    points   parameters of shape (n,) -> (n, 2): x forward, y outward along the middle of the tooth, the axle at 0;
             or (n, 3), bevel, on the unit sphere, the axis along z
    """

    points: Callable[[Floats], Floats]
    start: float = 0.0
    end: float = 1.0

    def at(self, t: ArrayLike) -> Floats:
        """Points at parameters t, shape (n,)."""
        return np.asarray(self.points(np.asarray(t, dtype=float)), dtype=float)

    def polar(self, t: ArrayLike) -> Floats:
        """Radius (bevel: polar angle, rad) and azimuth (rad, forward from y) at parameters t, shape (2, n)."""
        points = self.at(t)
        x, y = points[:, 0], points[:, 1]
        radius = np.hypot(x, y)
        return np.stack([np.arctan2(radius, points[:, 2]) if points.shape[1] == 3 else radius, np.arctan2(x, y)])

    def mapped(self, change: Callable[[Floats], Floats]) -> Curve:
        """The curve whose points are those of this one, changed."""
        return Curve(lambda t: change(self.points(t)), self.start, self.end)


def polyline(points: ArrayLike) -> tuple[Curve, ...]:
    """Straight curves (bevel: arcs of great circles) through points of shape (n, 2) or (n, 3), n at least 2."""
    return tuple(_straight(a, b) for a, b in pairwise(np.asarray(points, dtype=float)))


def _straight(a: Floats, b: Floats) -> Curve:
    def points(t: Floats) -> Floats:
        found: Floats = a + t[:, None] * (b - a)
        return found if len(a) == 2 else found / np.linalg.norm(found, axis=1, keepdims=True)

    return Curve(points)


def _turn(angle: float) -> Callable[[Floats], Floats]:
    def turned(points: Floats) -> Floats:
        x, y = points[:, 0], points[:, 1]
        along, across = y * cos(angle) - x * sin(angle), x * cos(angle) + y * sin(angle)
        return np.stack([across, along, *points.T[2:]], axis=1)

    return turned


@dataclass(frozen=True)
class Tooth:
    """The two sides of a tooth, each a chain of curves from root to tip or from tip to root.

    ahead    the side that leads when the wheel turns forward: larger azimuths
    behind   the other side
    Tip lands and bottoms need not be given: no arc about the axle touches before its ends do.
    """

    ahead: tuple[Curve, ...]
    behind: tuple[Curve, ...]

    @classmethod
    def symmetric(cls, ahead: Sequence[Curve], middle: float = 0.0) -> Tooth:
        """A tooth whose `behind` is the mirror image of `ahead` about azimuth `middle` (rad)."""
        turned = _turn(2 * middle)
        behind = tuple(curve.mapped(lambda p: turned(p * np.array([-1.0, 1.0, 1.0])[: p.shape[1]])) for curve in ahead)
        return cls(tuple(ahead), behind)

    def mapped(self, change: Callable[[Floats], Floats]) -> Tooth:
        """The tooth with every point changed."""
        return Tooth(*(tuple(curve.mapped(change) for curve in side) for side in (self.ahead, self.behind)))

    def turned(self, angle: float) -> Tooth:
        """The tooth turned forward by `angle` (rad)."""
        return self.mapped(_turn(angle))


@dataclass(frozen=True)
class Outline:
    """A wheel: z teeth about its axle, tooth k turned forward by k pitches.

    teeth    one tooth for all, or one for each of z
    turns    what tooth k is ahead of its place (rad), z numbers; none where pitches are equal
    ring     the teeth point inwards
    Raises `QuestionError` where counts do not fit or curves do not meet.
    """

    teeth: tuple[Tooth, ...]
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
    def ahead(self) -> Table:
        """The sides ahead as polynomials."""
        return table([tooth.ahead for tooth in self.teeth])

    @cached_property
    def behind(self) -> Table:
        """The sides behind as polynomials."""
        return table([tooth.behind for tooth in self.teeth])

    def displaced(self, x: float, y: float) -> Outline:
        """The same wheel on an axle that misses its middle: its points moved by (x, y), spur only; no tooth is equal.

        Raises `QuestionError` for bevel wheels.
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
        return Outline(tuple(self._moved(k, offsets[k], x, y) for k in range(self.z)), self.z, (), self.ring)

    def _moved(self, k: int, offset: float, x: float, y: float) -> Tooth:
        place = k * self.pitch
        by = np.array([x, y])
        tooth = self.teeth[k % len(self.teeth)]
        return tooth.turned(place + offset).mapped(lambda points: points + by).turned(-place)


def _check(side: tuple[Curve, ...]) -> None:
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
