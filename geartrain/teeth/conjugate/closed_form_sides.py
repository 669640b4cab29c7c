"""Sides of a path of contact in closed form: cycloids, round pins, and W. D. Smith's extremal of minimum friction.

Cycloids: the path of contact is the rolling circle itself, in the plane and on the sphere.

Lantern wheels (spur only): the path of contact is the path of the pin's centre, shortened by the pin's radius
towards the pitch point. The symbols are from W. D. Smith (1993), equations (12) to (16): pins of
radius B at distance A from the axle, R the pitch radius, L = d + B the distance of the pin's centre from the pitch
point. Where the contact speed along the mate's flank is 0, the envelope of the pins has a cusp, and the pins cut
away part of the flank on their way in. `flank_start` returns the first contact of the remaining flank.

The extremal does not reach the pitch point. It has the minimum sliding loss of all paths between two given contacts:
S dX/dd is a constant D, where X is the arc of contact and S is d, or sin d on the sphere. In the plane it is a circle
of diameter D centred on the pitch line. Its flanks are regular for pressure angles above 45 degrees only.
"""

from __future__ import annotations

from math import acos, asin, atan, cos, degrees, inf, log, pi, sin, sqrt, tan
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.roots import root
from geartrain.teeth.conjugate.path_losses import peak
from geartrain.teeth.conjugate.path_of_contact import PathPiece, PathSide

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Points = NDArray[np.complex128]
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

_SCAN = 129  # positions of a pin in the search for a cusp
_FARTHEST = 0.6  # fraction of the angle to the far side of the lantern


def cycloid(pitch: PitchSurfaces, X: float, rho: float) -> PathSide:
    """Return the side of a path of contact made by a rolling circle (radius in modules) or cone (half-angle in rad).

    `X` is the length of its arc on the pitch surfaces. Raises `RangeError` if it is longer than half the rolling
    circle.
    """
    longest = pi * sin(rho) if pitch.bevel else pi * rho
    # at exactly half the circle the pressure angle is a right angle, with cosine 0
    if longest * (1 - 1e-9) <= X:
        raise RangeError(
            Problem(
                f"an arc of {X / pitch.p:.6g} pitches is longer than half the rolling circle",
                f"half of that circle is {longest / pitch.p:.6g} pitches, where the pressure angle is a right angle",
                "use a shorter arc or a larger rolling circle",
            )
        )
    if not pitch.bevel:
        piece = PathPiece(
            0.0,
            2 * rho * sin(X / (2 * rho)),
            lambda d: np.asarray(d) / (2 * rho),
            lambda d: np.full(np.shape(d), 1 / (2 * rho)),
            lambda d: 2 * rho * np.arcsin(np.asarray(d) / (2 * rho)),
        )
    else:
        # the path is a small circle, whose pole is above the pitch point; in the triangle of pole, pitch point and
        # contact tan(d/2) = tan(rho) sin(psi), and the cone has turned by X / sin(rho)
        piece = PathPiece(
            0.0,
            2 * asin(sin(rho) * sin(X / (2 * sin(rho)))),
            lambda d: np.tan(np.asarray(d) / 2) / tan(rho),
            lambda d: 1 / (2 * tan(rho) * np.cos(np.asarray(d) / 2) ** 2),
            lambda d: 2 * sin(rho) * np.arcsin(np.sin(np.asarray(d) / 2) / sin(rho)),
        )
    return PathSide((piece,))


def circle_reach(R: float, rho: float, tip: float) -> float:
    """Return the distance d [module] from the pitch point at which the addendum of a cycloidal gear ends.

    `R` is its pitch radius, negative for a ring gear, `rho` the radius of the rolling circle and `tip` the tip
    radius [module]. A contact on the rolling circle is at the distance sqrt(R^2 + d^2 (1 + R / rho)) from the axle.
    """
    return sqrt((tip * tip - R * R) / (1 + R / rho))


def cone_reach(R: float, rho: float, tip: float) -> float:
    """Return the distance d [rad] from the pitch point at which the addendum of a cycloidal bevel gear ends.

    `R`, `rho` and `tip` are the half-angles of its pitch cone, the rolling cone and its tip cone [rad]. The pressure
    angle psi at the distance d follows from sin psi = tan(d/2)/tan rho, and cos tip = cos d cos R - sin d sin psi sin
    R. This is linear in v = 2 sin^2(d/2): cos tip = cos R - v (cos R + sin R / tan rho).
    """
    # d from v by an arc tangent, since an arc cosine of 1 - v would lose half the digits near the pitch point
    v = (cos(R) - cos(tip)) / (cos(R) + sin(R) / tan(rho))
    return 2 * atan(sqrt(v / 2) / sqrt(1 - v / 2))


# ----------------------------------------------------------------------------------------------------------- round pins


def pin_piece(R: float, A: float, B: float, end: float, inside: bool = False) -> PathPiece:
    """Return the path of contact of a round pin, with the pressure angle sin psi = (L^2 + R^2 - A^2) / (2 R L).

    R is the pitch radius of the lantern, A the distance of its pins from the axle, B the radius of a pin, and L the
    distance of the pin's centre from the pitch point: L = B + d, or B - d if `inside`. Outside, beyond the pitch
    point, the mate's addendum works; inside, its dedendum works as far as its undercut. The arc X is R times the
    angle of the pin's centre from the line of centres, less that angle at the pitch point.
    """
    sign = -1.0 if inside else 1.0

    def length(d: Floats) -> Floats:
        return B + sign * np.asarray(d, dtype=float)

    def travel(d: Floats) -> Floats:
        # half-angle form of the cosine rule; on the line of centres rounding may make L smaller than |A - R|
        half = np.sqrt(np.maximum(length(d) ** 2 - (A - R) ** 2, 0) / (4 * A * R))
        found: Floats = sign * R * (2 * np.arcsin(half) - pin_angle(R, A, B))
        return found

    return PathPiece(
        0.0,
        end,
        lambda d: (length(d) + (R - A) * (R + A) / length(d)) / (2 * R),
        lambda d: sign * (1 - (R - A) * (R + A) / length(d) ** 2) / (2 * R),
        travel,
    )


def pin_angle(R: float, A: float, B: float) -> float:
    """Return the angle (rad) of a pin's centre from the line of centres while the pin touches the pitch point."""
    return 2 * asin(sqrt((B - A + R) * (B + A - R) / (4 * A * R)))


def lantern(R: float, A: float, B: float, X: float, inside: bool = False) -> PathSide:
    """Return one side of the path of contact of a lantern wheel with the arc X on the pitch circles [module].

    `R` is the pitch radius of the lantern, `A` the distance of its pins from the axle and `B` their radius. `inside`
    selects the side on which the mate's dedendum works. Raises `RangeError` if the arc passes the line of centres
    (inside) or exceeds half a turn of the lantern.
    """
    first = pin_angle(R, A, B)
    beta = first - X / R if inside else first + X / R
    most = first if inside else 3.14 - first
    # slightly less than half a turn, where the arc sine in `travel` would lose half its digits
    if not 0 <= beta <= 3.14:
        side, limit = ("dedendum", "the undercut") if inside else ("addendum", "half a turn of the lantern")
        raise RangeError(
            Problem(
                f"an arc of {degrees(X / R):.6g} deg of the lantern on the mate's {side} is too long",
                f"it must end before {limit}, at {degrees(most):.6g} deg",
                "use a shorter arc",
            )
        )
    L = sqrt((A - R) ** 2 + 4 * A * R * sin(beta / 2) ** 2)
    return PathSide((pin_piece(R, A, B, B - L if inside else L - B, inside),))


def pin_reach(R: float, A: float, B: float, mate: float, tip: float) -> float:
    """Return the distance d from the pitch point [module] at which the mate's addendum ends.

    `tip` is the mate's tip radius and `mate` its pitch radius, negative for a ring gear; R, A and B are as in
    `lantern`. The squared distance of the contact from the mate's axle is mate^2 + d^2 + 2 mate d sin psi. Here d
    sin psi = d (L^2 + R^2 - A^2) / (2 R L), with L = B + d, is monotonic in d.
    """

    def off(d: float) -> float:
        # factored, because the difference of the squares of both radii would cancel
        return d * (d + 2 * mate * float(sine(np.array(d)))) - (tip - abs(mate)) * (tip + abs(mate))

    most = A + R - B
    sine = pin_piece(R, A, B, most).sin_psi
    at_pitch, at_most = off(0.0), off(most)
    if (at_pitch > 0) == (at_most > 0):
        raise RangeError(
            Problem(
                f"the path of contact does not reach the tip radius of the mate, {tip:.6g} modules",
                "the pins reach the far side of the lantern before they would touch this radius",
                "give the mate a shorter addendum",
            )
        )
    return root(off, 0.0, most, at_pitch, at_most)


def pin_arc(R: float, A: float, B: float, d: float) -> float:
    """Return the arc X from the pitch point to the distance d on the mate's addendum [module]."""
    return float(pin_piece(R, A, B, d).travel(np.array(d)))


# ----------------------------------------------------------------------------------------- extremal of minimum friction


def _extremal_piece(pitch: PitchSurfaces, D: float, start: float, end: float) -> PathPiece:
    """Return the path of contact with minimum friction loss, S = D cos psi, which is an extremal of the loss,
    docs/shapes.md (10).

    S is d on cylinders and sin d on cones, psi is the pressure angle, and D is a constant. The arc X is D ln d, or D ln
    tan(d/2) on cones, counted from the first contact.
    """

    def sine(d: Floats) -> Floats:
        S = pitch.S(d) / D
        # factored, because 1 - S^2 cancels at small pressure angles
        return np.sqrt((1 - S) * (1 + S))

    def slope(d: Floats) -> Floats:
        found: Floats = -pitch.S(d) * pitch.S_slope(d) / (D**2 * sine(d))
        return found

    def travel(d: Floats) -> Floats:
        d = np.asarray(d, dtype=float)
        return D * np.log(np.tan(d / 2) / tan(start / 2) if pitch.bevel else d / start)

    return PathPiece(start, end, sine, slope, travel)


def extremal(pitch: PitchSurfaces, X: float, first: float, last: float) -> PathSide:
    """Return the extremal of minimum friction with the arc X and a pressure angle from `first` down to `last` [rad]."""
    if not pitch.bevel:
        D = X / log(cos(last) / cos(first))
        return PathSide((_extremal_piece(pitch, D, D * cos(first), D * cos(last)),))

    def ends(D: float) -> tuple[float, float]:
        return asin(D * cos(first)), asin(D * cos(last))

    def off(D: float) -> float:
        start, end = ends(D)
        return D * log(tan(end / 2) / tan(start / 2)) - X

    # just below the limit of the arc sine of the end; at D = 0 the arc is 0
    high = (1 - 1e-12) / cos(last)
    # -inf replaces -X, the limit there; `root` bisects while a value is not finite
    D = root(off, 1e-9 * X, high, -inf, off(high))
    return PathSide((_extremal_piece(pitch, D, *ends(D)),))


# ----------------------------------------------------------------------------------------------------- undercut by pins


def flank_start(R: float, A: float, B: float, mate: float) -> float:
    """Return the arc X of the first contact on the part of the mate's flank that the pins do not cut away; -inf if they
    cut nothing away.

    R, A and B are pitch radius, distance from the axle and radius of the pins [module]. `mate` is the pitch radius
    of the mate, negative for a ring gear. X is counted from the pitch point outwards; below 0 the flank extends
    inside the pitch point.
    """
    first = pin_angle(R, A, B)
    far = first + _FARTHEST * (acos(-1.0) - first)
    found = _cusp(R, A, B, mate, far)
    cusp = found or 0.0

    def left(beta: float) -> float:
        point, spans = _flank(R, A, B, mate, beta), ((-far, -beta), (-beta, 0.0), (0.0, cusp))
        return min(_nearest(R, A, mate, point, *span) for span in spans) - B

    # the cut depth decreases outwards: search from the cusp in growing steps for the first uncut contact
    step, low, high = 0.05 * first, cusp, far
    while cusp + step < far:
        if left(cusp + step) > 0:
            high = cusp + step
            break
        low, step = cusp + step, 1.5 * step
    at_high = left(high)
    # the cusp itself is not evaluated: a pin on its pitch circle may be at the pitch point there
    if low == cusp or at_high <= 0 or (at_low := left(low)) >= 0:
        return R * ((cusp if at_high > 0 else far) - first) if found or at_high <= 0 else -inf
    return R * (root(left, low, high, at_low, at_high) - first)


def _cusp(R: float, A: float, B: float, mate: float, far: float) -> float | None:
    """Return the maximum angle of the pin at which the contact has zero speed along the mate's flank [rad]; None if no
    such cusp exists.
    """

    # a negative distance d belongs to contacts inside the pitch point, which the same formulas describe
    piece = pin_piece(R, A, B, inf)

    def speed(beta: Any) -> Any:
        d = np.sqrt((A - R) ** 2 + 4 * A * R * np.sin(beta / 2) ** 2) - B
        return piece.sin_psi(d) + d * (piece.slope(d) + 1 / mate)

    grid = np.linspace(0, far, _SCAN)[1:]
    speeds = speed(grid)
    reversed_speeds = np.flatnonzero(speeds <= 0)
    if reversed_speeds.size == 0:
        # at 0 itself L is |A - R|, which may be 0, and the speed is then undefined
        minimum = 1e-9 * far
        return root(speed, minimum, grid[0], speed(minimum), speeds[0]) if speed(minimum) < 0 else None
    at = int(reversed_speeds[-1])
    return far if at == len(grid) - 1 else root(speed, grid[at], grid[at + 1], speeds[at], speeds[at + 1])


def _flank(R: float, A: float, B: float, mate: float, beta: float) -> complex:
    """Return the point of the mate that the pin at the angle `beta` touches, relative to the mate's axle, as x + iy."""
    G = _centre(R, A, np.array(beta))
    return complex((G * (1 - B / np.abs(G)) + 1j * mate) * np.exp(1j * R / mate * beta))


def _nearest(R: float, A: float, mate: float, point: complex, low: float, high: float) -> float:
    """Return the minimum distance [module] from a point of the mate to the pin's centre at pin angles from `low` to
    `high`.
    """
    # the mate's frame turns by R / mate t while the lantern turns by t
    return -peak(lambda t: -np.abs((_centre(R, A, t) + 1j * mate) * np.exp(1j * R / mate * t) - point), low, high)


def _centre(R: float, A: float, beta: Floats) -> Points:
    """Return the centre of the pin at the angle `beta` from the line of centres, relative to the pitch point, as x
    + iy [module].
    """
    found: Points = 1j * R - 1j * A * np.exp(1j * beta)
    return found
