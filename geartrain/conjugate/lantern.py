"""Lantern wheels: round pins on one gear, and the teeth that mate with them, in closed form; spur only.

The path of contact is the pin's centre's own, shortened by the pin's radius towards the pitch point. In letters of the
source, W. D. Smith (1993), equations (12) to (16): pins of radius B at distance A from the axle, R the pitch radius,
L = d + B the distance of the pin's centre from the pitch point.
"""

from __future__ import annotations

from math import asin, degrees, sin, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.conjugate.pieces import Piece
from geartrain.conjugate.side import Side
from geartrain.errors import Problem, RangeError
from geartrain.roots import root

if TYPE_CHECKING:
    from geartrain.conjugate.pitch import Floats


class Pin(Piece):
    """Contact of a round pin: sin psi = (L^2 + R^2 - A^2) / (2 R L), with L = B + d outside and B - d `inside`.

    Outside, beyond the pitch point, the mate's addendum works; inside, its dedendum, up to its undercut.
    """

    def __init__(self, R: float, A: float, B: float, end: float, inside: bool = False) -> None:
        self.R, self.A, self.B, self.start, self.end = R, A, B, 0.0, end
        self.sign = -1.0 if inside else 1.0

    def _length(self, d: Floats) -> Floats:
        return self.B + self.sign * np.asarray(d, dtype=float)

    def sin_psi(self, d: Floats) -> Floats:
        """(L^2 + R^2 - A^2) / (2 R L), which is L / 2R for pins on the pitch circle."""
        L = self._length(d)
        found: Floats = (L + (self.R - self.A) * (self.R + self.A) / L) / (2 * self.R)
        return found

    def slope(self, d: Floats) -> Floats:
        """(1 - (R^2 - A^2) / L^2) / 2R, its sign turned inside."""
        L = self._length(d)
        found: Floats = self.sign * (1 - (self.R - self.A) * (self.R + self.A) / L**2) / (2 * self.R)
        return found

    def travel(self, d: Floats) -> Floats:
        """R (beta - beta at the pitch point), beta the angle of the pin's centre from the line of centres."""
        half = np.sqrt(np.maximum(self._length(d) ** 2 - (self.A - self.R) ** 2, 0) / (4 * self.A * self.R))
        found: Floats = self.sign * self.R * (2 * np.arcsin(half) - pin_angle(self.R, self.A, self.B))
        return found


def pin_angle(R: float, A: float, B: float) -> float:
    """Angle (rad) of a pin's centre from the line of centres while the pin touches the pitch point."""
    return 2 * asin(sqrt((B - A + R) * (B + A - R) / (4 * A * R)))


def lantern(R: float, A: float, B: float, X: float, inside: bool = False) -> Side:
    """One side of a lantern's path over an arc X; `inside` is the side on which the mate's dedendum works.

    Raises `RangeError` where the arc passes the line of centres (inside) or half a turn of the lantern.
    """
    first = pin_angle(R, A, B)
    beta = first - X / R if inside else first + X / R
    most = first if inside else 3.14 - first
    if not 0 <= beta <= 3.14:
        side, fix = ("dedendum", "its undercut") if inside else ("addendum", "half a turn of the lantern")
        raise RangeError(
            Problem(
                f"an arc of {degrees(X / R):.6g} deg of the lantern on the mate's {side} is too long",
                f"it ends at {fix}, before {degrees(most):.6g} deg",
                "ask for a shorter arc",
            )
        )
    L = sqrt((A - R) ** 2 + 4 * A * R * sin(beta / 2) ** 2)
    return Side((Pin(R, A, B, B - L if inside else L - B, inside),))


def pin_reach(R: float, A: float, B: float, mate: float, tip: float) -> float:
    """Distance d at which the mate's addendum ends at its `tip` radius; `mate` its pitch radius, negative for a ring.

    |P - O|^2 = mate^2 + d^2 + 2 mate d sin psi, and d sin psi = d (L^2 + R^2 - A^2) / (2 R L) is monotone in d.
    """

    def off(d: float) -> float:
        L = d + B
        sine = (L * L + (R - A) * (R + A)) / (2 * R * L)
        return d * (d + 2 * mate * sine) - (tip - abs(mate)) * (tip + abs(mate))

    most = A + R - B
    at_pitch, at_most = off(0.0), off(most)
    if (at_pitch > 0) == (at_most > 0):
        raise RangeError(
            Problem(
                f"no contact of these pins reaches the tip radius {tip:.6g}",
                "the pins are past the far side of the lantern before",
                "give the mate a shorter addendum",
            )
        )
    return root(off, 0.0, most, at_pitch, at_most)


def pin_arc(R: float, A: float, B: float, d: float) -> float:
    """Arc (X) from the pitch point to the distance d, on the mate's addendum."""
    return float(Pin(R, A, B, d).travel(np.array(d)))
