"""First touch of the teeth of two wheels: the maximum driven angle that any point of the driver's side requires.

A point P of the driver's side has radius r and azimuth a about the second axle (`DrivenFrame`, on parallel axes and on
the sphere). A driven tooth whose own azimuth at that radius is A(r) must be at the angle G(P) = a - A(r) or beyond, so
its angle is the maximum of G. The side is divided where a piece of either outline begins and where its distance from
the second axle is stationary, so that G is smooth on each segment. Its maximum is at an end of a segment, or at a sign
change of its slope.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from geartrain.numerics.arrays import joined, some
from geartrain.numerics.polynomial_pieces import value
from geartrain.numerics.roots import roots_by_false_position

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices
    from geartrain.teeth.contact.gear_outline import FlankTable

_ASIDE = 1e-5  # fraction of a segment: offset at which a slope is evaluated if it is undefined at the end
_FINE = 1e-14  # of u: at a maximum of G only the speed depends on u to first order
_WIDE = 2.0  # safety factor of bounds from tangents
_LEFT = 1e-8  # of u: error of an inversion where a curve is stationary, the square root of rounding


@dataclass(frozen=True, slots=True)
class AxlePlacement:
    """Relative position of the axles of two wheels.

    distance   centre distance; for bevel wheels, the shaft angle (rad)
    ring       number of the wheel that is a ring gear; 0 without a ring gear

    Azimuths are 0 on the line of centres, on the side where the wheels meet, and increase when both wheels turn
    forward.
    """

    distance: float
    bevel: bool = False
    ring: Literal[0, 1, 2] = 0

    def bounds(self, lowest: float, highest: float, minimum: float, most: float) -> float:
        """Return the maximum absolute azimuth [rad] about the first axle of points that may be in contact.

        Such a point has a radius from `lowest` to `highest` about the first axle, and from `minimum` to `most` about
        the second axle. The result is computed from samples and widened, so that it is never too small except for
        rounding. It is -1 if no such point exists.
        """
        r = np.linspace(lowest, highest, 129)[:, None]
        b = np.linspace(0, np.pi, 721)[None, :]
        radii = DrivenFrame(self, *np.broadcast_arrays(r, b)).radius
        # allowance for extremes between two samples, and for rounding
        slack = 2 * (highest - lowest) / 128 + 1e-9 * highest
        inside = ((radii <= most + slack) & (radii >= minimum - slack)).any(axis=0)
        if not inside.any():
            return -1.0
        # one grid step beyond the last sample in range
        return float(b[0, inside].max() + np.pi / 720)


class DrivenFrame:
    """Points of the driver, given by `radius` and `azimuth` about the second axle instead of the first one."""

    __slots__ = ("across", "along", "axles", "bevel", "cos_b", "height", "radius", "side", "sin_b", "tilt", "up")

    def __init__(self, axles: AxlePlacement, r: Floats, b: Floats) -> None:
        self.axles, self.bevel = axles, axles.bevel
        self.sin_b, self.cos_b = np.sin(b), np.cos(b)
        reach = np.sin(r) if axles.bevel else r
        self.height: Floats | float = np.cos(r) if axles.bevel else 1.0
        self.side, self.across = reach * self.sin_b, reach * self.cos_b
        far, self.tilt = (sin(axles.distance), cos(axles.distance)) if axles.bevel else (axles.distance, 1.0)
        e, s = self._signs()
        self.along = e * far * self.height + s * self.tilt * self.across
        if axles.bevel:
            self.up = self.tilt * self.height - s * e * far * self.across
            # arctan2, because arccos of `up` loses half the digits near the axle
            self.radius = np.arctan2(np.hypot(self.side, self.along), self.up)
        else:
            self.radius = np.hypot(self.side, self.along)

    def _signs(self) -> tuple[float, float]:
        """Return the signs e and s in the coordinate of a point along the line of centres about the second axle: e
        times the centre distance, plus s times the coordinate about the first axle.
        """
        return {0: (1.0, -1.0), 1: (-1.0, 1.0), 2: (1.0, 1.0)}[self.axles.ring]

    @property
    def azimuth(self) -> Floats:
        """Azimuths of the points about the second axle [rad], 0 on the line of centres."""
        found: Floats = np.arctan2(self.side, self.along)
        return found

    def moved(self, dr: Floats | float, db: Floats | float) -> tuple[Floats, Floats]:
        """Return the changes of radius and azimuth about the second axle if the radius about the first axle changes by
        `dr` and the azimuth by `db`.
        """
        e, s = self._signs()
        stretch = self.height * dr
        side, across = stretch * self.sin_b + self.across * db, stretch * self.cos_b - self.side * db
        along = s * self.tilt * across
        if not self.bevel:
            # polar coordinates: derivatives of the radius and of the azimuth
            h = self.radius
            radius = (self.side * side + self.along * along) / h
            return radius, (self.along * side - self.side * along) / (h * h)
        # on the sphere, both differentials also change the height along the inclined second axle
        far = sin(self.axles.distance)
        fall = -np.hypot(self.side, self.across) * dr
        along = along + e * far * fall
        up = self.tilt * fall - s * e * far * across
        h = np.hypot(self.side, self.along)
        radius = self.up * (self.side * side + self.along * along) / h - h * up
        return radius, (self.along * side - self.side * along) / (h * h)


# ----------------------------------------------------------------------------------------- segments of the driving side


class CandidatePairs(NamedTuple):
    """Tooth pairs that may touch: driver angle x [rad], numbers of the two tooth shapes, angle `place` of the driven
    tooth [rad], and number of the driver position.
    """

    x: Floats
    tooth1: Indices
    tooth2: Indices
    place: Floats
    position: Indices


class FlankSegments(NamedTuple):
    """Segments of the driver's flanks, on each of which the contact with the driven flank varies smoothly."""

    tooth_pair: Indices
    """Index of the tooth pair of each segment, shape (n,)."""
    piece1: Indices
    """Index of the polynomial piece of the driver's flank for each segment, shape (n,)."""
    piece2: Indices
    """Index of the polynomial piece of the driven flank for each segment, shape (n,)."""
    u: Floats
    """Parameters of `piece1` at the two ends of each segment, shape (2, n)."""
    polar2: Floats
    """Radius and azimuth about the second axle at the two ends of each segment, and the derivatives of both with
    respect to the parameter u of `piece1`, shape (4, 2, n).
    """
    v: Floats
    """Parameter of `piece2`, -1 or 1, if the segment ends at an end of `piece2`; NaN if it ends at an interior point of
    `piece2`. The shape is (2, n).
    """


class FirstTouches(NamedTuple):
    """Contacts, one for each point: driven angle [rad], speed ratio, and piece, parameter and radius on each wheel."""

    angle: Floats
    speed: Floats
    piece1: Indices
    u: Floats
    piece2: Indices
    v: Floats
    radius1: Floats
    radius2: Floats
    tooth_pair: Indices


@dataclass(frozen=True)
class FirstTouchSearch:
    """Search for the contacts of two wheels whose axles are in the position `axles`."""

    first: FlankTable
    second: FlankTable
    axles: AxlePlacement

    def segments(self, tooth_pairs: CandidatePairs) -> FlankSegments:
        """Return all segments of the driver's flanks on which the tooth pairs can touch."""
        cells = self._divided_at_extremes(tooth_pairs, self._cells(tooth_pairs))
        low, high = cells.polar2[0].min(axis=0), cells.polar2[0].max(axis=0)
        tooth = tooth_pairs.tooth2[cells.tooth_pair]
        start, end = self.second.first[tooth], self.second.first[tooth + 1]
        found = []
        for local in range(int(np.diff(self.second.first).max())):
            # all teeth at once; a tooth with fewer pieces repeats its last one, which `start + local < end` excludes
            piece2 = np.minimum(start + local, end - 1)
            within = (low <= self.second.ends[1, piece2]) & (high >= self.second.ends[0, piece2])
            which = np.flatnonzero(within & (start + local < end) & ~self.second.flat[piece2])
            found.append(some(cells, which)._replace(piece2=piece2[which]))
        return self._clipped_to_pieces(tooth_pairs, joined(found))

    def _cells(self, tooth_pairs: CandidatePairs) -> FlankSegments:
        """Return the segments between adjacent nodes of the driver's flank whose distances from the second axle overlap
        with the radii of the driven flank. The piece of the driven flank is 0 for all of them.
        """
        tooth1, (piece, u, begins) = tooth_pairs.tooth1, self.first.nodes
        pieces, us, begins = piece[tooth1], u[tooth1], begins[tooth1, :-1]
        r, dr, a, da = (each[tooth1] for each in self.first.node_values)
        view = DrivenFrame(self.axles, r, a + tooth_pairs.x[:, None])
        change, swing = view.moved(dr, da)
        turning = np.sign(change[:, :-1]) * np.sign(change[:, 1:]) < 0
        # an extreme of the distance inside a cell exceeds the ends by less than the slopes there would give
        slack = np.where(turning, (np.abs(change[:, :-1]) + np.abs(change[:, 1:])) * np.diff(us, axis=1), 0.0)
        minimum, most = (each[tooth_pairs.tooth2][:, None] for each in self.second.span)
        here, there = view.radius[:, :-1], view.radius[:, 1:]
        low, high = np.minimum(here, there), np.maximum(here, there)
        tooth_pair, at = np.nonzero(begins & (low - slack <= most) & (high + slack >= minimum))
        ends = tooth_pair, np.stack([at, at + 1])
        polar2 = np.stack([each[ends] for each in (view.radius, view.azimuth, change, swing)])
        piece = pieces[tooth_pair, at]
        return FlankSegments(
            tooth_pair, piece, np.zeros_like(piece), us[ends], polar2, np.full(polar2.shape[1:], np.nan)
        )

    def _divided_at_extremes(self, tooth_pairs: CandidatePairs, cells: FlankSegments) -> FlankSegments:
        """Return the segments `cells`, divided at extrema of the driver's distance from the second axle."""
        # where the derivative of the radius changes its sign within a cell, the radius has an extreme
        which = np.flatnonzero(np.sign(cells.polar2[2, 0]) * np.sign(cells.polar2[2, 1]) < 0)
        if not len(which):
            return cells
        turning = some(cells, which)
        x = tooth_pairs.x[turning.tooth_pair]

        def slope(u: Floats, these: Indices) -> Floats:
            found: Floats = self._driven_polar(x[these], turning.piece1[these], u)[2]
            return found

        middle = roots_by_false_position(slope, *turning.u, *turning.polar2[2])
        polar2 = self._driven_polar(x, turning.piece1, middle)
        # the old cell ends at the extreme, and a new one begins there
        cells.u[1, which], cells.polar2[:, 1, which] = middle, polar2
        turning.u[0], turning.polar2[:, 0] = middle, polar2
        return joined([cells, turning])

    def _clipped_to_pieces(self, tooth_pairs: CandidatePairs, cells: FlankSegments) -> FlankSegments:
        """Return the segments `cells`, shortened so that their distances from the second axle are within the radii of a
        single piece of the driven flank. The ends are found by false position.
        """
        low, high = self.second.ends[:, cells.piece2]
        u, polar2 = cells.u.copy(), cells.polar2.copy()
        for side in (0, 1):
            # the ends of a cell whose radius is outside the piece are moved to the limit of the piece
            which = np.flatnonzero((cells.polar2[0, side] < low) | (cells.polar2[0, side] > high))
            above = cells.polar2[0, side, which] > high[which]
            goal = np.where(above, high[which], low[which])
            x, piece = tooth_pairs.x[cells.tooth_pair[which]], cells.piece1[which]

            def off(at: Floats, these: Indices, x: Floats = x, piece: Indices = piece, goal: Floats = goal) -> Floats:
                r, a = (value(each, piece[these], at)[0] for each in (self.first.radius, self.first.azimuth))
                return DrivenFrame(self.axles, r, a + x[these]).radius - goal[these]

            u[side, which] = roots_by_false_position(off, *cells.u[:, which], *(cells.polar2[0][:, which] - goal))
            polar2[:, side, which] = self._driven_polar(x, piece, u[side, which])
            cells.v[side, which] = np.where(above, 1.0, -1.0)
        return cells._replace(u=u, polar2=polar2)

    def _driven_polar(self, x: Floats, piece: Indices, u: Floats) -> Floats:
        """Return radius and azimuth of points of the driver about the second axle, and their derivatives with respect
        to the parameter u of the flank, as an array (4, n).
        """
        view, dr, da = self.view(x, piece, u)
        return np.stack([view.radius, view.azimuth, *view.moved(dr, da)])

    def view(self, x: Floats, piece: Indices, u: Floats) -> tuple[DrivenFrame, Floats, Floats]:
        """Return points of the driver in polar coordinates about the second axle, and the derivatives of their radius
        and azimuth about the first axle with respect to the parameter u of the flank.
        """
        r, dr = value(self.first.radius, piece, u)
        a, da = value(self.first.azimuth, piece, u)
        return DrivenFrame(self.axles, r, a + x), dr, da

    # ------------------------------------------------------------------------------------------------ exact contact

    def touch(self, tooth_pairs: CandidatePairs, segments: FlankSegments) -> FirstTouches:
        """Return the contacts at both ends of each of the `segments`, and at maxima of the driven angle inside them."""
        x = tooth_pairs.x[segments.tooth_pair]
        low, high = self.second.ends[:, segments.piece2]

        def rising(u: Floats, which: Indices) -> Floats:
            """Return the derivative of the required driven angle G with respect to u, multiplied by the derivative (0
            or more) of the driven piece's radius with respect to v.
            """
            view, dr, da = self.view(x[which], segments.piece1[which], u)
            piece = segments.piece2[which]
            # clipped, because rounding may move a radius beyond the ends of the piece
            v = self.second.inverse(piece, np.clip(view.radius, low[which], high[which]))
            change, swing = view.moved(dr, da)
            return swing * value(self.second.radius, piece, v)[1] - value(self.second.azimuth, piece, v)[1] * change

        everything = np.arange(len(x))
        ends_u, slopes = segments.u.copy(), np.stack([rising(u, everything) for u in segments.u])
        step = _ASIDE * (ends_u[1] - ends_u[0])
        first, second = self.first.stalls[:, segments.piece1], self.second.stalls[:, segments.piece2]
        stalled = (segments.u == np.array([[-1.0], [1.0]])) & first
        stalled |= ((segments.v == -1) & second[0]) | ((segments.v == 1) & second[1])
        for side, way in ((0, 1), (1, -1)):
            # where a curve is stationary at its end the slope there is 0 up to rounding error
            which = np.flatnonzero(stalled[side] | ~(way * slopes[side] > 0))
            ends_u[side, which] += way * step[which]
            slopes[side, which] = rising(ends_u[side, which], which)
        inner = np.flatnonzero((slopes[0] > 0) & (slopes[1] < 0))
        (low_u, high_u), (at_low, at_high) = ends_u[:, inner], slopes[:, inner]
        middle = roots_by_false_position(
            lambda u, these: rising(u, inner[these]), low_u, high_u, at_low, at_high, _FINE
        )
        ends = [self._touch_at(tooth_pairs, segments, segments.u[side], segments.v[side]) for side in (0, 1)]
        within = self._touch_at(tooth_pairs, some(segments, inner), middle, np.full(len(inner), np.nan))
        return joined([*ends, within])

    def _touch_at(self, tooth_pairs: CandidatePairs, segments: FlankSegments, u: Floats, v: Floats) -> FirstTouches:
        """Return the contacts on the `segments` at the parameters `u` of the driver's flank. `v` is the known parameter
        of the driven flank at the ends of its pieces, and NaN elsewhere.
        """
        piece1, piece2 = segments.piece1, segments.piece2
        view, dr, da = self.view(tooth_pairs.x[segments.tooth_pair], piece1, u)
        at_end = ~np.isnan(v)
        low, high = self.second.ends[:, piece2]
        v = np.where(at_end, v, self.second.inverse(piece2, np.clip(view.radius, low, high)))
        r, rise = value(self.second.radius, piece2, v)
        a, turn = value(self.second.azimuth, piece2, v)
        change, swing = view.moved(dr, da)
        # differentials for a rotation of the driver, at a fixed point of its tooth
        drift, ahead = view.moved(0.0, 1.0)
        with np.errstate(invalid="ignore", divide="ignore"):
            slant = np.where(at_end, swing / change, turn / rise)  # d azimuth / d radius on the smooth side
            off = view.radius - r
            # a larger correction occurs only where the smooth side is stationary and `slant` is noise
            trusted = np.abs(off / np.where(at_end, change, rise)) <= _LEFT
            correction = np.where(trusted, slant * off, 0.0)
            speed = ahead - slant * drift
        # `correction` removes the residual radius of the inversion, so that the angle is accurate to rounding error
        angle = view.azimuth - a - correction - tooth_pairs.place[segments.tooth_pair]
        radius1, _ = value(self.first.radius, piece1, u)
        return FirstTouches(angle, speed, piece1, u, piece2, v, radius1, r, segments.tooth_pair)
