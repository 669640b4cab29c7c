"""First touch of teeth of two wheels: the driven angle that the furthest point of the driver's side asks for.

A point P of the driver's side, seen from the second axle at radius r and azimuth a, holds a driven tooth whose own
azimuth at that radius is A(r) at least at the angle G(P) = a - A(r); the tooth stands at the greatest of them. The side
is cut where a piece of either outline begins and where its distance from the second axle turns, so that on each
segment G is smooth; its ends are taken as they are, and within, the slope of G changes its sign.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.contact.bracketing import roots
from geartrain.contact.columns import joined, some
from geartrain.contact.cutting import Couples, Cutter, Segments
from geartrain.contact.polynomials import value

if TYPE_CHECKING:
    from geartrain.contact.polynomials import Flags, Floats, Indices

_ASIDE = 1e-5  # of a segment: where a slope is asked for if the end has none
_FINE = 1e-14
_WIDE = 2.0  # bounds from tangents are doubled


class Found(NamedTuple):
    """Touches, one for each of some segments: driven angle, speed ratio, where, radii about their own axles."""

    angle: Floats
    speed: Floats
    piece1: Indices
    u: Floats
    piece2: Indices
    v: Floats
    radius1: Floats
    radius2: Floats
    couple: Indices


class Judge(Cutter):
    """Which points of the cut sides are the furthest."""

    # -------------------------------------------------------------------------------------------------- which matter

    def furthest(self, couples: Couples, segments: Segments, margin: float) -> Segments:
        """The segments that can hold, within `margin` (rad), the furthest point of their position."""
        ends, slopes = self._rough(segments)
        with np.errstate(invalid="ignore", divide="ignore"):
            width = segments.u[1] - segments.u[0]
            meets = (ends[1] - ends[0] - slopes[1] * width) / (slopes[0] - slopes[1])
            rise = np.where((slopes[0] > 0) & (slopes[1] < 0), ends[0] + slopes[0] * meets - ends.max(axis=0), 0.0)
        unknown = ~np.isfinite(slopes).all(axis=0) | self._stalled(segments).any(axis=0)
        rise = np.where(unknown, np.inf, np.maximum(rise, 0.0))
        place = couples.place[segments.couple]
        position = couples.position[segments.couple]
        best = np.full(int(couples.position.max()) + 1 if len(couples.position) else 0, -np.inf)
        np.maximum.at(best, position, ends.max(axis=0) - place)
        return some(segments, ends.max(axis=0) + _WIDE * rise - place >= best[position] - margin)

    def _stalled(self, segments: Segments) -> Flags:
        """(2, n): ends of segments at which one of the two curves stands still, so that slopes there tell nothing."""
        first, second = self.first.stalls[:, segments.piece1], self.second.stalls[:, segments.piece2]
        at_end = (segments.u == np.array([[-1.0], [1.0]])) & first
        found: Flags = at_end | ((segments.v == -1) & second[0]) | ((segments.v == 1) & second[1])
        return found

    def _rough(self, segments: Segments) -> tuple[Floats, Floats]:
        """G and its slope at both ends, (2, n) each, without the refining steps of the inversion."""
        piece = np.broadcast_to(segments.piece2, segments.u.shape)
        low, high = self.second.ends[:, segments.piece2]
        r = np.clip(segments.seen[0], low, high)
        v = np.where(np.isnan(segments.v), self.second.guess(piece, r)[0], segments.v)
        radius, rise = value(self.second.radius, piece, v)
        azimuth, turn = value(self.second.azimuth, piece, v)
        with np.errstate(invalid="ignore", divide="ignore"):
            slant = turn / rise
            correction = np.nan_to_num(slant * (r - radius), nan=0.0, posinf=0.0, neginf=0.0)
            return segments.seen[1] - azimuth - correction, segments.seen[3] - slant * segments.seen[2]

    # ------------------------------------------------------------------------------------------------------ exactly

    def touch(self, couples: Couples, segments: Segments) -> Found:
        """The furthest point of each segment, to rounding."""
        x = couples.x[segments.couple]
        low, high = self.second.ends[:, segments.piece2]

        def rising(u: Floats, which: Indices) -> Floats:
            """The slope of G times a positive number."""
            view, dr, da = self.view(x[which], segments.piece1[which], u)
            piece = segments.piece2[which]
            v = self.second.inverse(piece, np.clip(view.radius, low[which], high[which]))
            change, swing = view.moved(dr, da)
            return swing * value(self.second.radius, piece, v)[1] - value(self.second.azimuth, piece, v)[1] * change

        everything = np.arange(len(x))
        ends_u, slopes = segments.u.copy(), np.stack([rising(u, everything) for u in segments.u])
        step = _ASIDE * (ends_u[1] - ends_u[0])
        stalled = self._stalled(segments)
        for side, way in ((0, 1), (1, -1)):
            # where a curve stands still at its end the slope there is 0, give or take its rounding
            which = np.flatnonzero(stalled[side] | ~(way * slopes[side] > 0))
            ends_u[side, which] += way * step[which]
            slopes[side, which] = rising(ends_u[side, which], which)
        inner = np.flatnonzero((slopes[0] > 0) & (slopes[1] < 0))
        (low_u, high_u), (at_low, at_high) = ends_u[:, inner], slopes[:, inner]
        middle = roots(lambda u, these: rising(u, inner[these]), low_u, high_u, at_low, at_high, _FINE)
        ends = [self._found(couples, segments, segments.u[side], segments.v[side]) for side in (0, 1)]
        within = self._found(couples, some(segments, inner), middle, np.full(len(inner), np.nan))
        return joined([*ends, within])

    def _found(self, couples: Couples, segments: Segments, u: Floats, v: Floats) -> Found:
        """The touch at u; v where an end of the driven piece is met there."""
        piece1, piece2 = segments.piece1, segments.piece2
        view, dr, da = self.view(couples.x[segments.couple], piece1, u)
        corner = ~np.isnan(v)
        low, high = self.second.ends[:, piece2]
        v = np.where(corner, v, self.second.inverse(piece2, np.clip(view.radius, low, high)))
        r, rise = value(self.second.radius, piece2, v)
        a, turn = value(self.second.azimuth, piece2, v)
        change, swing = view.moved(dr, da)
        drift, ahead = view.moved(0.0, 1.0)
        with np.errstate(invalid="ignore", divide="ignore"):
            slant = np.where(corner, swing / change, turn / rise)  # of azimuth by radius, on the side that is smooth
            correction = np.nan_to_num(slant * (view.radius - r), nan=0.0, posinf=0.0, neginf=0.0)
            speed = ahead - slant * drift
        angle = view.azimuth - a - correction - couples.place[segments.couple]
        radius1, _ = value(self.first.radius, piece1, u)
        return Found(angle, speed, piece1, u, piece2, v, radius1, r, segments.couple)
