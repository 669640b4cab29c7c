"""Flanks of a wheel as polynomial pieces of increasing radius, with search nodes and the azimuth as a function of
radius.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.polynomial_pieces import COUNT, ends, value

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Indices

_CELLS = 8  # minimum number of search cells of a side
_CLOSER, _CLOSE = 0.75, 30  # geometric steps towards a stationary end: an extreme may be at any distance from it
_MOST = 80  # maximum number of steps of an inversion
_NEAR = 1e-10  # a Newton step of this length ends at the root, as the next would be about its square
_STALLED = 1e-3  # fraction of its mean slope: below it a piece is stationary, as a cycloid is on its pitch circle


@dataclass(frozen=True)
class FlankTable:
    """Polynomial pieces of the leading or trailing flanks of all teeth, with u from -1 to 1 and increasing radius."""

    radius: Floats
    """Polynomial coefficients of the radius by powers of the parameter u, shape (COUNT, pieces)."""
    azimuth: Floats
    """Polynomial coefficients of the azimuth [rad] by powers of the parameter u, shape (COUNT, pieces)."""
    corners: Bools
    """Flags, shape (2, pieces): True if a piece begins (row 0) or ends (row 1) at a corner of the outline."""
    flat: Bools
    """Flags, shape (pieces,): True for circular arcs about the axle."""
    first: Indices
    """Index of the first piece of each tooth, shape (teeth + 1,)."""
    curve: Indices
    """Number of the curve to which each piece belongs, shape (pieces,), counted through all teeth."""
    error: tuple[float, float]
    """Maximum differences between pieces and curves: radius [unit of the outline] and azimuth [rad]."""

    @cached_property
    def mirrored(self) -> FlankTable:
        """Mirror image of the table: azimuths have the opposite sign."""
        return replace(self, azimuth=-self.azimuth)

    @cached_property
    def ends(self) -> Floats:
        """Radii at the two ends of each piece, shape (2, pieces)."""
        return ends(self.radius)

    @cached_property
    def stalls(self) -> Bools:
        """Flags, shape (2, pieces): True if the radius of a piece is stationary in u at its start (row 0) or end (row
        1).
        """
        powers = np.arange(COUNT)
        slopes = np.stack([np.where(powers % 2, powers, -powers) @ self.radius, powers @ self.radius])
        found: Bools = slopes < _STALLED * (self.ends[1] - self.ends[0])
        return found

    @cached_property
    def reach(self) -> tuple[float, float, float, float]:
        """Minimum and maximum radius, and minimum and maximum azimuth [rad], over all teeth."""
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
        """Minimum and maximum radius of each tooth, each of shape (teeth,)."""
        low, high = (
            np.minimum.reduceat(self.ends[0], self.first[:-1]),
            np.maximum.reduceat(self.ends[1], self.first[:-1]),
        )
        return low, high

    # -------------------------------------------------------------------------------------------- flanks of a driver

    @cached_property
    def nodes(self) -> tuple[Indices, Floats, Bools]:
        """Search nodes of each tooth, shape (teeth, nodes): piece, u, and whether a search interval begins at the
        node.
        """
        # the quotient is rounded up, so that a side with few pieces still has the minimum number of cells
        cells = np.repeat(np.maximum(1, -(-_CELLS // np.diff(self.first))), np.diff(self.first))
        each = [self._sample_points(piece, int(number)) for piece, number in enumerate(cells)]
        piece, u = np.repeat(np.arange(len(each)), [len(marks) for marks in each]), np.concatenate(each)
        begins = np.append(piece[1:] == piece[:-1], False)
        start = np.searchsorted(piece, self.first)
        most = int(np.diff(start).max())
        # teeth with fewer nodes repeat their last node, at which a cell does not begin
        at = np.minimum(start[:-1, None] + np.arange(most), start[1:, None] - 1)
        return piece[at], u[at], begins[at]

    def _sample_points(self, piece: int, cells: int) -> Floats:
        """Return the values of u at which a piece is sampled: uniform, refined geometrically towards stationary
        ends.
        """
        marks: list[Floats] = [np.linspace(-1, 1, cells + 1)]
        for end, stalls in zip((-1, 1), self.stalls[:, piece], strict=True):
            if stalls:
                marks.append(np.asarray(end * (1 - 2 * _CLOSER ** np.arange(1, _CLOSE + 1)), dtype=np.float64))
        return np.unique(np.concatenate(marks))

    @cached_property
    def node_values(self) -> tuple[Floats, Floats, Floats, Floats]:
        """Values at the search nodes: radius and its derivative with respect to the parameter u, azimuth [rad] and
        its derivative with respect to u.
        """
        piece, u, _ = self.nodes
        r, dr = value(self.radius, piece, u)
        a, da = value(self.azimuth, piece, u)
        return r, dr, a, da

    # -------------------------------------------------------------------------------------- flanks of a driven wheel

    def inverse(self, piece: Indices, r: Floats) -> Floats:
        """Return the parameter u at which pieces have radius r, by bracketed Newton iteration.

        r must be within the pieces.
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
