"""Where teeth of two wheels can touch: the driver's sides cut so that no end of the driven sides is met within."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.contact.bracketing import roots
from geartrain.contact.columns import joined, some
from geartrain.contact.polynomials import value
from geartrain.contact.sight import View

if TYPE_CHECKING:
    from geartrain.contact.polynomials import Floats, Indices
    from geartrain.contact.sight import Sight
    from geartrain.contact.table import Table


class Couples(NamedTuple):
    """Pairs of teeth to look at: driver's angle, its tooth's shape, driven tooth's shape, its place, position."""

    x: Floats
    tooth1: Indices
    tooth2: Indices
    place: Floats
    position: Indices


class Segments(NamedTuple):
    """Parts of the driver's side on which G is smooth; n of them.

    couple, piece1, piece2   where
    u      (2, n): from, to, on piece1
    seen   (4, 2, n): radius and azimuth about the second axle at both ends, and their slopes by u
    v      (2, n): the end of piece2 that is met at either end, -1 or 1; NaN where it is not an end
    """

    couple: Indices
    piece1: Indices
    piece2: Indices
    u: Floats
    seen: Floats
    v: Floats


@dataclass(frozen=True)
class Cutter:
    """Two wheels, one side each, and the place of their axles."""

    first: Table
    second: Table
    sight: Sight

    def segments(self, couples: Couples) -> Segments:
        """All segments at which the couples can touch."""
        cells = self._unturned(couples, self._cells(couples))
        low, high = cells.seen[0].min(axis=0), cells.seen[0].max(axis=0)
        tooth = couples.tooth2[cells.couple]
        start, end = self.second.first[tooth], self.second.first[tooth + 1]
        found = []
        for local in range(int(np.diff(self.second.first).max())):
            piece2 = np.minimum(start + local, end - 1)
            within = (low <= self.second.ends[1, piece2]) & (high >= self.second.ends[0, piece2])
            which = np.flatnonzero(within & (start + local < end) & ~self.second.flat[piece2])
            found.append(self._clipped(couples, some(cells, which)._replace(piece2=piece2[which])))
        return joined(found)

    def _cells(self, couples: Couples) -> Segments:
        """Stretches between nodes that may be seen at radii of the driven side, which piece of it being open."""
        nodes = self.first.nodes
        pieces, us, begins = nodes[0][couples.tooth1], nodes[1][couples.tooth1], nodes[2][couples.tooth1, :-1]
        r, dr, a, da = (each[couples.tooth1] for each in self.first.node_values)
        view = self.sight.look(r, a + couples.x[:, None])
        change, swing = view.moved(dr, da)
        turning = np.sign(change[:, :-1]) * np.sign(change[:, 1:]) < 0
        slack = np.where(turning, (np.abs(change[:, :-1]) + np.abs(change[:, 1:])) * np.diff(us, axis=1), 0.0)
        least, most = (each[couples.tooth2][:, None] for each in self.second.span)
        here, there = view.radius[:, :-1], view.radius[:, 1:]
        low, high = np.minimum(here, there), np.maximum(here, there)
        couple, at = np.nonzero(begins & (low - slack <= most) & (high + slack >= least))
        ends = couple, np.stack([at, at + 1])
        seen = np.stack([each[ends] for each in (view.radius, view.azimuth, change, swing)])
        piece = pieces[couple, at]
        return Segments(couple, piece, np.zeros_like(piece), us[ends], seen, np.full(seen.shape[1:], np.nan))

    def _unturned(self, couples: Couples, cells: Segments) -> Segments:
        """Cells, those in which the distance from the second axle turns cut in two."""
        which = np.flatnonzero(np.sign(cells.seen[2, 0]) * np.sign(cells.seen[2, 1]) < 0)
        if not len(which):
            return cells
        turning = some(cells, which)
        x = couples.x[turning.couple]

        def slope(u: Floats, these: Indices) -> Floats:
            found: Floats = self._seen(x[these], turning.piece1[these], u)[2]
            return found

        middle = roots(slope, *turning.u, *turning.seen[2])
        seen = self._seen(x, turning.piece1, middle)
        cells.u[1, which], cells.seen[:, 1, which] = middle, seen
        turning.u[0], turning.seen[:, 0] = middle, seen
        return joined([cells, turning])

    def _clipped(self, couples: Couples, cells: Segments) -> Segments:
        """Cells cut to the radii of their driven piece."""
        low, high = self.second.ends[:, cells.piece2]
        u, seen = cells.u.copy(), cells.seen.copy()
        for side in (0, 1):
            which = np.flatnonzero((cells.seen[0, side] < low) | (cells.seen[0, side] > high))
            above = cells.seen[0, side, which] > high[which]
            goal = np.where(above, high[which], low[which])
            x, piece = couples.x[cells.couple[which]], cells.piece1[which]

            def off(at: Floats, these: Indices, x: Floats = x, piece: Indices = piece, goal: Floats = goal) -> Floats:
                r, _ = value(self.first.radius, piece[these], at)
                a, _ = value(self.first.azimuth, piece[these], at)
                return self.sight.look(r, a + x[these]).radius - goal[these]

            u[side, which] = roots(off, *cells.u[:, which], *(cells.seen[0][:, which] - goal))
            seen[:, side, which] = self._seen(x, piece, u[side, which])
            cells.v[side, which] = np.where(above, 1.0, -1.0)
        return cells._replace(u=u, seen=seen)

    def _seen(self, x: Floats, piece: Indices, u: Floats) -> Floats:
        """Points of the driver's pieces seen from the second axle: radius, azimuth, their slopes by u; (4, n)."""
        view, dr, da = self.view(x, piece, u)
        return np.stack([view.radius, view.azimuth, *view.moved(dr, da)])

    def view(self, x: Floats, piece: Indices, u: Floats) -> tuple[View, Floats, Floats]:
        """The same points as a view; slopes of their radius and azimuth about the first axle by u."""
        r, dr = value(self.first.radius, piece, u)
        a, da = value(self.first.azimuth, piece, u)
        return self.sight.look(r, a + x), dr, da
