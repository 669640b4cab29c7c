"""A wheel as its outline: smooth curves, teeth made of them, teeth about the axle; and flanks cut into pieces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import cos, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.polynomial_pieces import COUNT, PolynomialPiece, fitted
from geartrain.numerics.results import Shown
from geartrain.teeth.contact.flank_table import FlankTable

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats

_MEETS = 1e-9  # of the radius: curves whose ends are nearer than this follow each other
_FLAT = 1e-12  # of the radius: a piece that rises less is an arc about the axle
_TURNED = 1e-9  # of the greatest slope: less is no turning point
_SMOOTH = 1e-7  # rad: curves that meet under less have no corner
_STILL = 1e-3  # of its second derivative: a slope that says nothing of the direction


@dataclass(frozen=True)
class OutlineCurve(Shown):
    """A smooth curve of a tooth, from parameter `start` to `end`.

    See Also
    --------
    polyline : straight curves.
    """

    points: Callable[[Floats], Floats]
    """Parameters of shape (n,) -> (n, 2): x forward, y outward along the middle of the tooth, the axle at 0; or (n,
    3), bevel, on the unit sphere, the axis along z."""
    start: float = 0.0
    """Parameter of its beginning."""
    end: float = 1.0
    """Parameter of its end."""

    def at(self, t: ArrayLike) -> Floats:
        """Points of the curve.

        Parameters
        ----------
        t : array_like
            Parameters, shape (n,).

        Returns
        -------
        ndarray
            (n, 2), or (n, 3) on the sphere.
        """
        return np.asarray(self.points(np.asarray(t, dtype=float)), dtype=float)

    def polar(self, t: ArrayLike) -> Floats:
        """Radius and azimuth of points of the curve.

        Parameters
        ----------
        t : array_like
            Parameters, shape (n,).

        Returns
        -------
        ndarray
            (2, n): radius (bevel: polar angle [rad]) and azimuth [rad, forward from y].
        """
        points = self.at(t)
        x, y = points[:, 0], points[:, 1]
        radius = np.hypot(x, y)
        return np.stack([np.arctan2(radius, points[:, 2]) if points.shape[1] == 3 else radius, np.arctan2(x, y)])

    def mapped(self, change: Callable[[Floats], Floats]) -> OutlineCurve:
        """The curve whose points are those of this one, changed.

        Parameters
        ----------
        change : callable
            Points (n, 2) or (n, 3) to points of the same shape.

        Returns
        -------
        OutlineCurve
            With the same parameters.
        """
        return OutlineCurve(lambda t: change(self.points(t)), self.start, self.end)


def polyline(points: ArrayLike) -> tuple[OutlineCurve, ...]:
    """Straight curves through points; on the sphere arcs of great circles.

    Parameters
    ----------
    points : array_like
        (n, 2) or (n, 3), n at least 2.

    Returns
    -------
    tuple of OutlineCurve
        n - 1 of them.

    Examples
    --------
    >>> curve, = polyline([(0, 1), (0, 2)])
    >>> curve.at([0.5]).tolist()
    [[0.0, 1.5]]
    """
    return tuple(_straight(a, b) for a, b in pairwise(np.asarray(points, dtype=float)))


def _straight(a: Floats, b: Floats) -> OutlineCurve:
    def points(t: Floats) -> Floats:
        found: Floats = a + t[:, None] * (b - a)
        return found if len(a) == 2 else found / np.linalg.norm(found, axis=1, keepdims=True)

    return OutlineCurve(points)


def _turn(angle: float) -> Callable[[Floats], Floats]:
    def turned(points: Floats) -> Floats:
        x, y = points[:, 0], points[:, 1]
        along, across = y * cos(angle) - x * sin(angle), x * cos(angle) + y * sin(angle)
        return np.stack([across, along, *points.T[2:]], axis=1)

    return turned


# ----------------------------------------------------------------------------------------------------- teeth and wheels


@dataclass(frozen=True)
class ToothFlanks(Shown):
    """The two sides of a tooth, each a chain of curves from root to tip or from tip to root.

    Tip lands and bottoms need not be given: no arc about the axle touches before its ends do.

    See Also
    --------
    solve : an example with such teeth.
    """

    ahead: tuple[OutlineCurve, ...]
    """The side that leads when the wheel turns forward: larger azimuths."""
    behind: tuple[OutlineCurve, ...]
    """The other side."""

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
class GearOutline(Shown):
    """A wheel: z teeth about its axle, tooth k turned forward by k pitches.

    Raises
    ------
    QuestionError
        Where counts do not fit or curves do not meet.

    See Also
    --------
    solve : an example with such wheels.
    """

    teeth: tuple[ToothFlanks, ...]
    """One tooth for all, or one for each of z."""
    z: int
    """Number of teeth, 1 or more."""
    turns: tuple[float, ...] = ()
    """What tooth k is ahead of its place [rad], z numbers; none where pitches are equal."""
    ring: bool = False
    """The teeth point inwards."""

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
        return _table([tooth.ahead for tooth in self.teeth])

    @cached_property
    def behind(self) -> FlankTable:
        """The sides behind as polynomials."""
        return _table([tooth.behind for tooth in self.teeth])

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


# ------------------------------------------------------------------------------------------- cutting flanks into pieces


def _table(sides: Sequence[tuple[OutlineCurve, ...]]) -> FlankTable:
    """The sides of the teeth of a wheel, each a chain of curves. Raises `RangeError` where a curve is not smooth."""
    pieces: list[tuple[PolynomialPiece, bool, bool]] = []
    first, curves = [0], list[int]()
    for side in sides:
        for chain in _side(side):
            curves += [curves[-1] + 1 if curves else 0] * len(chain)
            pieces += chain
        first.append(len(pieces))
    coefficients = np.stack([piece.coefficients for piece, _, _ in pieces])
    radius, azimuth = np.ascontiguousarray(coefficients[:, :, 0].T), np.ascontiguousarray(coefficients[:, :, 1].T)
    rise = radius[1::2].sum(axis=0)  # half the radius at u = 1 less that at u = -1
    flat = np.abs(rise) < _FLAT * radius[0]
    falls = rise < 0
    kinks = np.array([[begins, ends] for _, begins, ends in pieces]).T
    # u reversed: odd powers change their sign
    for each in (radius, azimuth):
        each[1::2, falls] *= -1
    kinks[:, falls] = kinks[::-1, falls]
    errors = np.stack([piece.error for piece, _, _ in pieces]).max(axis=0)
    return FlankTable(
        radius, azimuth, kinks, flat, np.array(first), np.array(curves), (float(errors[0]), float(errors[1]))
    )


def _side(side: tuple[OutlineCurve, ...]) -> list[list[tuple[PolynomialPiece, bool, bool]]]:
    """The pieces of each curve of a chain, and whether each piece begins, ends, in a corner."""
    found = [
        [each for piece in fitted(curve.polar, curve.start, curve.end) for each in _rising(curve, piece)]
        for curve in side
    ]
    kink = [True, *(_kink(a[-1], b[0]) for a, b in pairwise(found)), True]
    return [
        [(piece, at == 0 and kink[i], at == len(pieces) - 1 and kink[i + 1]) for at, piece in enumerate(pieces)]
        for i, pieces in enumerate(found)
    ]


def _kink(last: PolynomialPiece, new: PolynomialPiece) -> bool:
    """Whether two curves that meet change their direction there."""
    before, after = _direction(last, 1), _direction(new, -1)
    return bool(abs(before[0] * after[1] - before[1] * after[0]) > _SMOOTH or before @ after < 0)


def _direction(piece: PolynomialPiece, end: int) -> Floats:
    """Unit vector along a curve at u = end, -1 or 1; that of its second derivative where the first one is 0."""
    powers = np.arange(COUNT)
    signs = np.where(powers % 2, 1.0, end)
    first = powers * signs @ piece.coefficients
    # just inside the piece the slope is the second derivative times the way from the end, whose sign is -end
    second = -end * (powers * (powers - 1) * signs * end @ piece.coefficients)
    # azimuth times radius is a length too
    round_ = np.array([1.0, float(piece.coefficients[0, 0])])
    chosen = first if np.hypot(*(first * round_)) > _STILL * np.hypot(*(second * round_)) else second
    found: Floats = chosen * round_ / np.hypot(*(chosen * round_))
    return found


def _rising(curve: OutlineCurve, piece: PolynomialPiece) -> list[PolynomialPiece]:
    """A piece cut where its radius turns."""
    slope = np.asarray(np.polynomial.polynomial.polyder(piece.coefficients[:, 0]), dtype=np.float64)
    u = np.linspace(-1, 1, 65)
    values = np.polynomial.polynomial.polyval(u, slope)
    small = max(_TURNED * float(np.abs(values).max()), _FLAT * float(piece.coefficients[0, 0]))
    marked = np.flatnonzero(np.abs(values) > small)
    turns = [(i, j) for i, j in pairwise(marked.tolist()) if (values[i] > 0) != (values[j] > 0)]
    if not turns:
        return [piece]
    half, middle = (piece.end - piece.start) / 2, piece.start + (piece.end - piece.start) / 2
    cuts = [piece.start, *(middle + half * _turning(slope, u[i], u[j]) for i, j in turns), piece.end]
    return [each for start, end in pairwise(cuts) for each in fitted(curve.polar, start, end)]


def _turning(slope: Floats, low: float, high: float) -> float:
    """Where a polynomial changes its sign between low and high."""
    rising = np.polynomial.polynomial.polyval(high, slope) > 0
    # bisection to neighbouring floats: the slope is that of a fit, and noise where the radius hardly turns
    while low < (middle := low + (high - low) / 2) < high:
        if (np.polynomial.polynomial.polyval(middle, slope) > 0) == rising:
            high = middle
        else:
            low = middle
    return low
