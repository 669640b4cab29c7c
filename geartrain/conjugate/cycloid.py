"""Cycloids: sides whose path of contact is the rolling circle itself, in the plane and on the sphere."""

from __future__ import annotations

from math import asin, atan, cos, pi, sin, sqrt, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.conjugate.pieces import Circle, Piece, circle_end
from geartrain.conjugate.side import Side
from geartrain.errors import Problem, RangeError

if TYPE_CHECKING:
    from geartrain.conjugate.pitch import Floats, Pitch


class Cone(Piece):
    """A small circle through the pitch point, centred over it: the path of a rolling cone of half-angle `rho` (rad).

    In the triangle of its pole, the pitch point and the contact tan(d/2) = tan(rho) sin(psi), and the cone has turned
    by X / sin(rho) where sin(d/2) = sin(rho) sin(X / (2 sin rho)).
    """

    def __init__(self, rho: float, end: float) -> None:
        self.rho, self.start, self.end = rho, 0.0, end

    def sin_psi(self, d: Floats) -> Floats:
        """tan(d/2) / tan(rho)."""
        return np.tan(np.asarray(d) / 2) / tan(self.rho)

    def slope(self, d: Floats) -> Floats:
        """1 / (2 tan(rho) cos^2(d/2))."""
        return 1 / (2 * tan(self.rho) * np.cos(np.asarray(d) / 2) ** 2)

    def travel(self, d: Floats) -> Floats:
        """2 sin(rho) arcsin(sin(d/2) / sin(rho))."""
        return 2 * sin(self.rho) * np.arcsin(np.sin(np.asarray(d) / 2) / sin(self.rho))


def cycloid(pitch: Pitch, X: float, rho: float) -> Side:
    """The side of a rolling circle (modules) or cone (rad) over an arc X.

    Raises `RangeError` where the arc is longer than half the rolling circle.
    """
    longest = pi * sin(rho) if pitch.bevel else pi * rho
    if longest * (1 - 1e-9) <= X:
        raise RangeError(
            Problem(
                f"an arc of {X / pitch.p:.6g} pitches is longer than half the rolling circle",
                f"half of it is {longest / pitch.p:.6g} pitches, where the pressure angle is a right angle",
                "ask for a shorter arc or a larger rolling circle",
            )
        )
    return Side((Cone(rho, cone_end(rho, X)) if pitch.bevel else Circle(rho, circle_end(rho, X)),))


def cone_end(rho: float, X: float) -> float:
    """Distance d at which a small circle has travelled X."""
    return 2 * asin(sin(rho) * sin(X / (2 * sin(rho))))


def circle_reach(R: float, rho: float, tip: float) -> float:
    """Distance d at which the addendum of a gear of pitch radius R ends at its `tip` radius; a ring's R is negative.

    On the circle |P - O|^2 = R^2 + d^2 (1 + R / rho).
    """
    return sqrt((tip * tip - R * R) / (1 + R / rho))


def cone_reach(R: float, rho: float, tip: float) -> float:
    """The same on the sphere, in polar angles: cos tip = cos d cos R - sin d sin psi sin R, sin psi = tan(d/2)/tan rho.

    With 2 sin^2(d/2) = v it is linear: cos tip = cos R - v (cos R + sin R / tan rho).
    """
    v = (cos(R) - cos(tip)) / (cos(R) + sin(R) / tan(rho))
    return 2 * atan(sqrt(v / 2) / sqrt(1 - v / 2))
