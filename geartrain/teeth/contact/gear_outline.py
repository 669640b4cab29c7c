"""Outline of a wheel: smooth curves, teeth made of them, and conversion of flanks to polynomial pieces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import cos, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.polynomial_pieces import COUNT, PolynomialPiece, ends, fitted, value
from geartrain.numerics.results import Shown

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Bools, Floats, Indices


_MEETS = 1e-9  # fraction of the radius: curves whose ends are closer than this are connected
_FLAT = 1e-12  # fraction of the radius: a piece that rises less counts as an arc about the axle
_TURNED = 1e-9  # fraction of the maximum slope: smaller sign changes are rounding error
_SMOOTH = 1e-7  # rad: curves that meet at a smaller angle form a smooth joint
_STILL = 1e-3  # fraction of its second derivative: a smaller slope does not determine the direction


@dataclass(frozen=True)
class OutlineCurve(Shown):
    """Smooth curve of a tooth outline, as a function of a parameter from `start` to `end`.

    See Also
    --------
    polyline : Function that returns straight curves.
    """

    points: Callable[[Floats], Floats]
    """Function that maps parameters (n,) to points: (n, 2) for spur wheels, (n, 3) on the unit sphere for bevel wheels.

    The x axis points forward, the y axis points outward along the middle of the tooth, and the axle is at the origin.
    The axis of a bevel wheel is the z axis.
    """
    start: float = 0.0
    """Parameter at the beginning of the curve."""
    end: float = 1.0
    """Parameter at the end of the curve."""

    def at(self, t: ArrayLike) -> Floats:
        """Return points of the curve at given parameters.

        Parameters
        ----------
        t : array_like
            Parameters, shape (n,).

        Returns
        -------
        ndarray
            Points, shape (n, 2), or (n, 3) on the sphere.
        """
        return np.asarray(self.points(np.asarray(t, dtype=float)), dtype=float)

    def polar(self, t: ArrayLike) -> Floats:
        """Return the radius and the azimuth of points of the curve.

        Parameters
        ----------
        t : array_like
            Parameters, shape (n,).

        Returns
        -------
        ndarray
            Radius (for bevel wheels the polar angle [rad]) and azimuth [rad, forward from y], shape (2, n).
        """
        points = self.at(t)
        x, y = points[:, 0], points[:, 1]
        radius = np.hypot(x, y)
        return np.stack([np.arctan2(radius, points[:, 2]) if points.shape[1] == 3 else radius, np.arctan2(x, y)])

    def mapped(self, change: Callable[[Floats], Floats]) -> OutlineCurve:
        """Return a curve whose points are the transformed points of this curve.

        Parameters
        ----------
        change : callable
            Function from points (n, 2) or (n, 3) to points of the same shape.

        Returns
        -------
        OutlineCurve
            Transformed curve with the same parameters.
        """
        return OutlineCurve(lambda t: change(self.points(t)), self.start, self.end)


def polyline(points: ArrayLike) -> tuple[OutlineCurve, ...]:
    """Return the straight segments that join the given points in order. On the sphere, the segments are great-circle
    arcs.

    Parameters
    ----------
    points : array_like
        Points, shape (n, 2) or (n, 3), with n at least 2.

    Returns
    -------
    tuple of OutlineCurve
        Segments, n - 1 curves.

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
        # the central projection of a chord onto the sphere is a great-circle arc
        return found if len(a) == 2 else found / np.linalg.norm(found, axis=1, keepdims=True)

    return OutlineCurve(points)


def _rotation(angle: float) -> Callable[[Floats], Floats]:
    def turned(points: Floats) -> Floats:
        x, y = points[:, 0], points[:, 1]
        along, across = y * cos(angle) - x * sin(angle), x * cos(angle) + y * sin(angle)
        return np.stack([across, along, *points.T[2:]], axis=1)

    return turned


# ----------------------------------------------------------------------------------------------------- teeth and wheels


@dataclass(frozen=True)
class ToothFlanks(Shown):
    """Flanks of a tooth. Each flank is a chain of curves from root to tip or from tip to root.

    Tip lands and bottom lands can be omitted, because an arc about the axle never comes into contact before its ends
    do.

    See Also
    --------
    solve : Contact of two wheels, with an example of such teeth.
    """

    ahead: tuple[OutlineCurve, ...]
    """Flank that leads when the wheel turns forward. It has larger azimuths than the other flank."""
    behind: tuple[OutlineCurve, ...]
    """Flank that trails when the wheel turns forward."""

    @classmethod
    def symmetric(cls, ahead: Sequence[OutlineCurve], middle: float = 0.0) -> ToothFlanks:
        """Return a tooth whose trailing flank is the mirror image of its leading flank.

        Parameters
        ----------
        ahead : sequence of OutlineCurve
            Leading flank.
        middle : float
            Azimuth of the mirror axis [rad].

        Returns
        -------
        ToothFlanks
            Tooth with both flanks.
        """
        # reflection at azimuth 0 and rotation by twice `middle` are a reflection at `middle`
        turned = _rotation(2 * middle)
        behind = tuple(curve.mapped(lambda p: turned(p * np.array([-1.0, 1.0, 1.0])[: p.shape[1]])) for curve in ahead)
        return cls(tuple(ahead), behind)

    def mapped(self, change: Callable[[Floats], Floats]) -> ToothFlanks:
        """Return a tooth whose points are the transformed points of this tooth.

        Parameters
        ----------
        change : callable
            Function from points (n, 2) or (n, 3) to points of the same shape.

        Returns
        -------
        ToothFlanks
            Transformed tooth.
        """
        return ToothFlanks(*(tuple(curve.mapped(change) for curve in side) for side in (self.ahead, self.behind)))

    def turned(self, angle: float) -> ToothFlanks:
        """Return the tooth rotated forward about the axle by an angle.

        Parameters
        ----------
        angle : float
            Angle of rotation [rad].

        Returns
        -------
        ToothFlanks
            Rotated tooth.
        """
        return self.mapped(_rotation(angle))


@dataclass(frozen=True)
class GearOutline(Shown):
    """Outline of a wheel with z teeth about its axle. Tooth k is rotated forward by k pitches.

    Raises
    ------
    QuestionError
        If z is below 1, if the number of teeth or pitch deviations is wrong, or if a flank is not a chain of connected
        curves with finite points off the axle.

    See Also
    --------
    solve : Contact of two wheels, with an example of such outlines.
    """

    teeth: tuple[ToothFlanks, ...]
    """Shapes of the teeth: one shape that applies to all teeth, or one shape for each of the z teeth."""
    z: int
    """Number of teeth, 1 or more."""
    turns: tuple[float, ...] = ()
    """Pitch deviations of the z teeth [rad]: the angle by which each tooth is ahead of its nominal position. The tuple
    is empty if all pitches are equal.
    """
    ring: bool = False
    """True for a ring gear, whose teeth point inwards."""

    def __post_init__(self) -> None:
        for name, number, few in (("teeth", len(self.teeth), (1, self.z)), ("turns", len(self.turns), (0, self.z))):
            if self.z < 1 or number not in few:
                what = f"`{name}` has {number} entries for a wheel with z = {self.z}"
                why = f"z must be at least 1, and `{name}` needs {few[0]} or z entries"
                raise QuestionError(Problem(what, why, f"give {few[0]} or {max(self.z, 1)} entries"))
        for tooth in self.teeth:
            for side in (tooth.ahead, tooth.behind):
                _check_side(side)

    @property
    def pitch(self) -> float:
        """Angular pitch of the teeth [rad]."""
        return 2 * pi / self.z

    @property
    def equal(self) -> bool:
        """True if all teeth have the same shape and no pitch deviation."""
        return len(self.teeth) == 1 and not any(self.turns)

    @cached_property
    def bevel(self) -> bool:
        """True if the wheel is a bevel wheel, whose points are on the unit sphere."""
        curve = self.teeth[0].ahead[0]
        return bool(curve.at([curve.start]).shape[1] == 3)

    @cached_property
    def ahead(self) -> FlankTable:
        """Leading flanks of all teeth, as a table of polynomial pieces."""
        return _table([tooth.ahead for tooth in self.teeth])

    @cached_property
    def behind(self) -> FlankTable:
        """Trailing flanks of all teeth, as a table of polynomial pieces."""
        return _table([tooth.behind for tooth in self.teeth])

    def displaced(self, x: float, y: float) -> GearOutline:
        """Return the wheel on an eccentric axle. Each tooth then has its own shape.

        Parameters
        ----------
        x, y : float
            Displacement of the points of the wheel, in the unit of the outline.

        Returns
        -------
        GearOutline
            Wheel with a separate shape for each of the z teeth.

        Raises
        ------
        QuestionError
            If the wheel is a bevel.
        """
        if self.bevel:
            what = "a bevel wheel cannot be displaced in its plane"
            why = "its teeth are on a sphere about the apex, which a displacement leaves"
            raise QuestionError(Problem(what, why, "give every tooth its own curves instead"))
        by, teeth = np.array([x, y]), []
        for k, offset in enumerate(self.turns or (0.0,) * self.z):
            place = k * self.pitch
            tooth = self.teeth[k % len(self.teeth)].turned(place + offset)
            teeth.append(tooth.mapped(lambda points: points + by).turned(-place))
        return GearOutline(tuple(teeth), self.z, (), self.ring)


def _check_side(side: tuple[OutlineCurve, ...]) -> None:
    """Raise `QuestionError` unless `side` is a chain of connected curves with finite points off the axle."""
    if not side:
        what, why = "a tooth has a flank without curves", "each flank can touch a mate and needs a profile"
        raise QuestionError(Problem(what, why, "give at least one curve for each flank"))
    last = None
    for curve in side:
        ends = curve.at(np.array([curve.start, curve.end]))
        if not np.isfinite(ends).all() or curve.start == curve.end or not np.hypot(ends[:, 0], ends[:, 1]).all():
            what = f"a curve from parameter {curve.start:.6g} to {curve.end:.6g} cannot be part of a tooth"
            why = "an end is not finite or is on the axle, or both ends have the same parameter"
            fix = "give two parameters at which the curve has points off the axle"
            raise QuestionError(Problem(what, why, fix))
        # relative to the size of the tooth, because coordinates are rounded
        if last is not None and np.abs(ends[0] - last).max() > _MEETS * np.abs(ends).max():
            why = f"one ends at {last}, the next begins at {ends[0]}"
            fix = "give the curves of a flank in order, each beginning at the end of the previous one"
            raise QuestionError(Problem("two curves of a tooth do not meet", why, fix))
        last = ends[1]


# --------------------------------------------------------------------------------------------------- division of flanks


def _table(sides: Sequence[tuple[OutlineCurve, ...]]) -> FlankTable:
    """Return a table of one flank of every tooth from the curves `sides`. Raises `RangeError` if one is not smooth."""
    pieces: list[tuple[PolynomialPiece, bool, bool]] = []
    first, curves = [0], list[int]()
    for side in sides:
        for chain in _side(side):
            curves += [curves[-1] + 1 if curves else 0] * len(chain)
            pieces += chain
        first.append(len(pieces))
    coefficients = np.stack([piece.coefficients for piece, _, _ in pieces])
    radius, azimuth = np.ascontiguousarray(coefficients[:, :, 0].T), np.ascontiguousarray(coefficients[:, :, 1].T)
    rise = radius[1::2].sum(axis=0)  # half the difference of the radii at u = 1 and u = -1
    flat = np.abs(rise) < _FLAT * radius[0]
    falls = rise < 0
    corners = np.array([[begins, ends] for _, begins, ends in pieces]).T
    # reversing u changes the sign of odd powers
    for each in (radius, azimuth):
        each[1::2, falls] *= -1
    corners[:, falls] = corners[::-1, falls]
    errors = np.stack([piece.error for piece, _, _ in pieces]).max(axis=0)
    return FlankTable(
        radius, azimuth, corners, flat, np.array(first), np.array(curves), (float(errors[0]), float(errors[1]))
    )


def _side(side: tuple[OutlineCurve, ...]) -> list[list[tuple[PolynomialPiece, bool, bool]]]:
    """Return the polynomial pieces of each curve of a flank. Two flags with each piece state whether it begins at a
    corner and whether it ends at a corner.
    """
    found = [
        [each for piece in fitted(curve.polar, curve.start, curve.end) for each in _monotonic_pieces(curve, piece)]
        for curve in side
    ]
    corner = [True]
    for one, following in pairwise(found):
        before, after = _direction(one[-1], 1), _direction(following[0], -1)
        corner.append(bool(abs(before[0] * after[1] - before[1] * after[0]) > _SMOOTH or before @ after < 0))
    corner.append(True)
    return [
        [(piece, at == 0 and corner[i], at == len(pieces) - 1 and corner[i + 1]) for at, piece in enumerate(pieces)]
        for i, pieces in enumerate(found)
    ]


def _direction(piece: PolynomialPiece, end: int) -> Floats:
    """Return the unit tangent of a piece at the start (`end` = -1) or end (`end` = 1) of the range of its parameter. It
    is the direction of the first derivative, or of the second derivative if the first one is 0.
    """
    powers = np.arange(COUNT)
    signs = np.where(powers % 2, 1.0, end)
    first = powers * signs @ piece.coefficients
    # just inside the piece the slope is the second derivative times the distance from the end, of sign -end
    second = -end * (powers * (powers - 1) * signs * end @ piece.coefficients)
    # azimuth times radius is a length, as the radius is
    scale = np.array([1.0, float(piece.coefficients[0, 0])])
    chosen = first if np.hypot(*(first * scale)) > _STILL * np.hypot(*(second * scale)) else second
    found: Floats = chosen * scale / np.hypot(*(chosen * scale))
    return found


def _monotonic_pieces(curve: OutlineCurve, piece: PolynomialPiece) -> list[PolynomialPiece]:
    """Return the parts into which extrema of the radius divide a piece, with new polynomials fitted to `curve`."""
    slope = np.asarray(np.polynomial.polynomial.polyder(piece.coefficients[:, 0]), dtype=np.float64)
    u = np.linspace(-1, 1, 65)
    values = np.polynomial.polynomial.polyval(u, slope)
    # smaller slopes are rounding of the fit, whose sign would divide the piece without reason
    small = max(_TURNED * float(np.abs(values).max()), _FLAT * float(piece.coefficients[0, 0]))
    marked = np.flatnonzero(np.abs(values) > small)
    turns = [(i, j) for i, j in pairwise(marked.tolist()) if (values[i] > 0) != (values[j] > 0)]
    if not turns:
        return [piece]
    half, middle = (piece.end - piece.start) / 2, piece.start + (piece.end - piece.start) / 2
    cuts = [piece.start, *(middle + half * _sign_change(slope, u[i], u[j]) for i, j in turns), piece.end]
    return [each for start, end in pairwise(cuts) for each in fitted(curve.polar, start, end)]


def _sign_change(slope: Floats, low: float, high: float) -> float:
    """Return the zero between `low` and `high` of the polynomial with the coefficients `slope`, found by bisection."""
    rising = np.polynomial.polynomial.polyval(high, slope) > 0
    # bisection to neighbouring floats, because the slope of a fit is noise where the radius hardly changes
    while low < (middle := low + (high - low) / 2) < high:
        if (np.polynomial.polynomial.polyval(middle, slope) > 0) == rising:
            high = middle
        else:
            low = middle
    return low


# Flanks of a wheel as polynomial pieces of increasing radius, with search nodes and the azimuth as a function of
# radius.


_CELLS = 8  # minimum number of search cells of a side
_CLOSER, _CLOSE = 0.75, 30  # geometric steps towards a stationary end: an extreme may be at any distance from it
_MOST = 80  # maximum number of steps of an inversion
_NEAR = 1e-10  # a Newton step of this length ends at the root, as the next would be about its square
_STALLED = 1e-3  # fraction of its mean slope: below it a piece is stationary, as a cycloid is on its pitch circle


@dataclass(frozen=True)
class FlankTable:
    """Polynomial pieces of the leading or trailing flanks of all teeth. The parameter u of a piece is from -1 to 1, and
    the radius increases with u.
    """

    radius: Floats
    """Coefficients of the radius as a polynomial in the parameter u, shape (COUNT, pieces)."""
    azimuth: Floats
    """Coefficients of the azimuth [rad] as a polynomial in the parameter u, shape (COUNT, pieces)."""
    corners: Bools
    """Mask, shape (2, pieces), of the pieces that begin (row 0) or end (row 1) at a corner of the outline."""
    flat: Bools
    """Mask, shape (pieces,), of the pieces that are circular arcs about the axle."""
    first: Indices
    """Index of the first piece of each tooth, shape (teeth + 1,). The last entry is the number of pieces."""
    curve: Indices
    """Number of the curve to which each piece belongs, shape (pieces,), consecutive over all teeth."""
    error: tuple[float, float]
    """Maximum difference between pieces and curves, of the radius [unit of the outline] and of the azimuth [rad]."""

    @cached_property
    def mirrored(self) -> FlankTable:
        """Mirror image of all flanks, in which azimuths have the opposite sign."""
        return replace(self, azimuth=-self.azimuth)

    @cached_property
    def ends(self) -> Floats:
        """Radii at the two ends of each piece, shape (2, pieces)."""
        return ends(self.radius)

    @cached_property
    def stalls(self) -> Bools:
        """Mask, shape (2, pieces): True if the radius is stationary at the start or at the end of a piece."""
        powers = np.arange(COUNT)
        slopes = np.stack([np.where(powers % 2, powers, -powers) @ self.radius, powers @ self.radius])
        found: Bools = slopes < _STALLED * (self.ends[1] - self.ends[0])
        return found

    @cached_property
    def reach(self) -> tuple[float, float, float, float]:
        """Minimum radius, maximum radius, minimum azimuth [rad] and maximum azimuth [rad] over all teeth."""
        u = np.linspace(-1, 1, 33)
        azimuth = np.polynomial.polynomial.polyval(u, self.azimuth)
        # allowance for extremes of the azimuth between two samples
        slack = float(np.ptp(azimuth)) / 64
        return (
            float(self.ends.min()),
            float(self.ends.max()),
            float(azimuth.min()) - slack,
            float(azimuth.max()) + slack,
        )

    @cached_property
    def span(self) -> tuple[Floats, Floats]:
        """Minimum radius and maximum radius of each tooth, two arrays of shape (teeth,)."""
        first, (low, high) = self.first[:-1], self.ends
        return np.minimum.reduceat(low, first), np.maximum.reduceat(high, first)

    # -------------------------------------------------------------------------------------------- flanks of a driver

    @cached_property
    def nodes(self) -> tuple[Indices, Floats, Bools]:
        """Nodes for the search for contacts, three arrays of shape (teeth, nodes): index of the piece, its parameter u,
        and whether a search interval begins at the node.
        """
        # the quotient is rounded up, so that a side with few pieces still has the minimum number of cells
        cells = np.repeat(np.maximum(1, -(-_CELLS // np.diff(self.first))), np.diff(self.first))
        each = []
        for at, number in enumerate(cells.tolist()):
            # geometric refinement at ends where the radius is stationary
            ends = (end for end, stalls in zip((-1, 1), self.stalls[:, at], strict=True) if stalls)
            finer = [end * (1 - 2 * _CLOSER ** np.arange(1, _CLOSE + 1)) for end in ends]
            each.append(np.unique(np.concatenate([np.linspace(-1, 1, number + 1), *finer])))
        piece, u = np.repeat(np.arange(len(each)), [len(marks) for marks in each]), np.concatenate(each)
        begins = np.append(piece[1:] == piece[:-1], False)
        start = np.searchsorted(piece, self.first)
        most = int(np.diff(start).max())
        # teeth with fewer nodes repeat their last node, at which a cell does not begin
        at = np.minimum(start[:-1, None] + np.arange(most), start[1:, None] - 1)
        return piece[at], u[at], begins[at]

    @cached_property
    def node_values(self) -> tuple[Floats, Floats, Floats, Floats]:
        """Radius and azimuth [rad] at the `nodes`, each followed by its derivative with respect to u."""
        piece, u, _ = self.nodes
        r, dr = value(self.radius, piece, u)
        a, da = value(self.azimuth, piece, u)
        return r, dr, a, da

    # -------------------------------------------------------------------------------------- flanks of a driven wheel

    def inverse(self, piece: Indices, r: Floats) -> Floats:
        """Return the parameter u at which each piece has the radius `r`, computed by bracketed Newton iteration.

        The radii must be within the range of their pieces.
        """
        first, last = self.ends[:, piece]
        low, high, which = np.full(len(r), -1.0), np.ones(len(r)), np.arange(len(r))
        with np.errstate(invalid="ignore", divide="ignore"):
            u = np.where(last > first, 2 * (r - first) / (last - first) - 1, 0.0)
            for _ in range(_MOST):
                at = u[which]
                here, slope = value(self.radius, piece[which], at)
                off = here - r[which]
                below = np.where(off < 0, at, low[which])
                above = np.where(off > 0, at, high[which])
                step = at - off / slope
                # NaN, from a slope of 0, also fails the test, and the bracket is bisected
                step = np.where((step >= below) & (step <= above), step, (below + above) / 2)
                low[which], high[which], u[which] = below, above, step
                which = which[np.abs(step - at) > _NEAR]
                if not len(which):
                    break
        return u
