"""Flanks of a wheel as polynomial pieces of increasing radius, with search nodes and the azimuth as a function of
radius.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.polynomial_pieces import COUNT, ends, value, value_alone

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Indices

_CELLS = 8  # minimum number of search cells of a side
_CLOSER, _CLOSE = 0.75, 30  # geometric steps towards a stationary end: an extreme may be at any distance from it
_BINS = 64  # of a piece: initial brackets for the inversion of the radius
_STALLED = 1e-3  # of its mean slope: below it a piece is stationary, as a cycloid is on its pitch circle
_MOST = 80  # maximum number of steps of an inversion
_NEAR = 1e-10  # a Newton step of this length ends at the root, as the next would be about its square


@dataclass(frozen=True)
class FlankTable:
    """Polynomial pieces of the leading or trailing flanks of all teeth, with u from -1 to 1 and increasing radius."""

    radius: Floats
    """Coefficients of the radius by powers of u, shape (COUNT, pieces)."""
    azimuth: Floats
    """Coefficients of the azimuth [rad] by powers of u, shape (COUNT, pieces)."""
    corners: Bools
    """Flags, (2, pieces): True if a piece begins (row 0) or ends (row 1) at a corner of the outline."""
    flat: Bools
    """Flags, (pieces,): True for circular arcs about the axle."""
    first: Indices
    """Index of the first piece of each tooth, (teeth + 1,)."""
    curve: Indices
    """Number of the curve that each piece belongs to, (pieces,), counted through all teeth."""
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
        """Flags, (2, pieces): True if the radius of a piece is stationary in u at its start (row 0) or end (row 1)."""
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
        """Radius, its derivative with respect to u, azimuth [rad] and its derivative with respect to u at the search
        nodes.
        """
        piece, u, _ = self.nodes
        r, dr = value(self.radius, piece, u)
        a, da = value(self.azimuth, piece, u)
        return r, dr, a, da

    # -------------------------------------------------------------------------------------- flanks of a driven wheel

    @cached_property
    def _bins(self) -> tuple[Floats, Floats]:
        """Radii at uniform u, shape (pieces, bins + 1), and the same scaled to one increasing row for a single
        search.
        """
        pieces = np.broadcast_to(np.arange(self.radius.shape[1])[:, None], (self.radius.shape[1], _BINS + 1))
        radii = value_alone(self.radius, pieces, np.broadcast_to(np.linspace(-1, 1, _BINS + 1), pieces.shape))
        low, high = self.ends[:, :, None]
        share = np.maximum.accumulate(np.clip((radii - low) / np.where(high > low, high - low, 1.0), 0, 1), axis=1)
        share[:, -1] = 1.0
        # offset by 2, so that one search in one row serves all pieces; `accumulate` removes decreases by rounding
        return radii, (share + 2.0 * pieces).ravel().astype(np.float64)

    def guess(self, piece: Indices, r: Floats) -> tuple[Floats, Floats, Floats]:
        """Return an estimate of the parameter u at which pieces have radius r, and a bracket of it.

        r must be within the pieces.
        """
        radii, row = self._bins
        low, high = self.ends[0].take(piece), self.ends[1].take(piece)
        key = 2.0 * piece + np.clip((r - low) / (high - low), 0, 1)
        at = np.clip(np.searchsorted(row, key, side="right") - 1 - piece * (_BINS + 1), 0, _BINS - 1)
        below, above = radii[piece, at], radii[piece, at + 1]
        left = at * (2 / _BINS) - 1
        with np.errstate(invalid="ignore", divide="ignore"):
            share = np.where(above > below, np.clip((r - below) / (above - below), 0, 1), 0.5)
        return left + share * (2 / _BINS), left, left + 2 / _BINS

    def near_stall(self, piece: Indices, u: Floats) -> Bools:
        """Return whether u is in the last bin before a stationary end of its piece."""
        edge = 1 - 2 / _BINS
        found: Bools = self.stalls[0][piece] & (u < -edge) | self.stalls[1][piece] & (u > edge)
        return found

    def inverse(self, piece: Indices, r: Floats) -> Floats:
        """Return the parameter u at which pieces have radius r, by bracketed Newton iteration.

        r must be within the pieces.
        """
        u, low, high = self.guess(piece, r)
        return self._newton(piece, r, u, low, high)

    def _newton(self, piece: Indices, r: Floats, u: Floats, low: Floats, high: Floats) -> Floats:
        found = u
        # indices are gathered only after some iterations have ended and others have not
        which: Indices | None = None
        for _ in range(_MOST):
            here, slope = value(self.radius, piece, u)
            off = here - r
            low, high = np.where(off < 0, u, low), np.where(off > 0, u, high)
            with np.errstate(invalid="ignore", divide="ignore"):
                step = u - off / slope
            # NaN, from a slope of 0, also fails the test, and the bracket is bisected
            step = np.where((step >= low) & (step <= high), step, (low + high) / 2)
            left = np.abs(step - u) > _NEAR
            u = step
            if which is None:
                found = u
            else:
                found[which] = u
            if not left.any():
                break
            if which is None:
                which = np.flatnonzero(left)
                found = found.copy()
            else:
                which = which[left]
            piece, r, low, high, u = piece[left], r[left], low[left], high[left], u[left]
        return found
