"""The source's own shape of least friction, an extremal that keeps off the pitch point.

Of all paths between two given contacts it rubs least: S dX/dd = D. In the plane it is a circle of diameter D centred on
the pitch line. Its flanks are regular for pressure angles above 45 degrees only, and it never reaches the pitch point.
"""

from __future__ import annotations

from math import asin, cos, inf, log, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.conjugate.pieces import Piece
from geartrain.conjugate.side import Side
from geartrain.roots import root

if TYPE_CHECKING:
    from geartrain.conjugate.pitch import Floats, Pitch


class Extremal(Piece):
    """S = D cos psi; X = D ln d, or D ln tan(d/2), from the first contact."""

    def __init__(self, pitch: Pitch, D: float, start: float, end: float) -> None:
        self.pitch, self.D, self.start, self.end = pitch, D, start, end

    def sin_psi(self, d: Floats) -> Floats:
        """sqrt(1 - (S / D)^2)."""
        S = self.pitch.S(d) / self.D
        return np.sqrt((1 - S) * (1 + S))

    def slope(self, d: Floats) -> Floats:
        """-S S' / (D^2 sin psi)."""
        found: Floats = -self.pitch.S(d) * self.pitch.S_slope(d) / (self.D**2 * self.sin_psi(d))
        return found

    def travel(self, d: Floats) -> Floats:
        """D ln(d / start), or D ln(tan(d/2) / tan(start/2))."""
        d = np.asarray(d, dtype=float)
        if self.pitch.bevel:
            return self.D * np.log(np.tan(d / 2) / tan(self.start / 2))
        return self.D * np.log(d / self.start)


def extremal(pitch: Pitch, X: float, first: float, last: float) -> Side:
    """The side of arc X whose pressure angle falls from `first` to `last` (rad)."""
    if not pitch.bevel:
        D = X / log(cos(last) / cos(first))
        return Side((Extremal(pitch, D, D * cos(first), D * cos(last)),))

    def ends(D: float) -> tuple[float, float]:
        return asin(D * cos(first)), asin(D * cos(last))

    def off(D: float) -> float:
        start, end = ends(D)
        return D * log(tan(end / 2) / tan(start / 2)) - X

    high = (1 - 1e-12) / cos(last)
    D = root(off, 1e-9 * X, high, -inf, off(high))
    return Side((Extremal(pitch, D, *ends(D)),))
