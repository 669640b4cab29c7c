"""Teeth for wheels that have no flat outline: bevels, crowns, worms, and what nobody could cut, as such wheels look."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import acos, atan2, ceil, cos, pi, sqrt, tan

from geartrain.scene.elements import ToothProfile
from geartrain.teeth.standard_teeth import ADDENDUM, DEDENDUM

Points = tuple[tuple[float, float], ...]
"""Radii over the pitch radius, and angles (rad)."""

FORM = "likeness"
_PRESSURE = pi / 9
_PLAY = 0.02  # of a pitch: what each tooth is thinner
_LEAST_ROOT = 0.2  # of the pitch radius: few teeth leave little
_ROOM = 0.92  # of half a pitch: where at most a flank ends at the root
_POINTS = 10  # on a flank
_PASSING = 0.12  # modules for each tooth that a ring has more than its wheel
_CROWN_PLAY = 0.06  # of a pitch: what a crown's teeth are thinner than a mate's spaces, whose flanks no rack runs with
_STEP = pi / 18  # between points of a thread's section, of which a few go round a worm
_LAND = 0.08  # of a pitch: least half width of a tip


def spur(z: int, room: float = ADDENDUM) -> ToothProfile:
    """A tooth of a wheel, of at most the height `room` (modules) over the pitch circle."""
    return ToothProfile(FORM, _tooth(z, min(ADDENDUM, room)))


def ring(z: int, room: float = ADDENDUM) -> ToothProfile:
    """A tooth of a ring: what a wheel of as many teeth leaves between its own, within the pitch circle by `room`."""
    most = 1 + 2 * DEDENDUM / z
    # the space of the ring is the tooth of a wheel, higher and a little wider
    tip = max(1 - 2 * min(ADDENDUM, room) / z, _LEAST_ROOT)
    half = pi / z
    flank = [(r, half - _half(z, r) - 2 * _PLAY * pi / z) for r in _spread(tip, most)]
    return ToothProfile(
        FORM, _mirrored([(r, min(max(angle, _LAND * half), _ROOM * half)) for r, angle in reversed(flank)], z)
    )


def room(z: int, mate: int, within: bool) -> float:
    """How tall (modules) a tooth may be for a mate: down to the roots of one of few teeth.

    within   one of them is a ring: then so that tips pass each other where the teeth are long out of mesh
    """
    if within:
        return _PASSING * abs(z - mate)
    return mate / 2 * (1 - _root(mate)) - (DEDENDUM - ADDENDUM) / 2


def _root(z: float) -> float:
    return max(1 - 2 * DEDENDUM / z, _LEAST_ROOT)


def bevel(z: int, cone: float) -> ToothProfile:
    """A tooth of a bevel wheel at its wide end: that of the wheel into which its back cone unrolls.

    The radius counts heights over the pitch cone along the back cone; cone is the half angle of the pitch cone (rad).
    """
    # the back cone of a crown wheel never closes: its teeth are nearly those of a rack
    narrow = max(cos(cone), 1e-3)
    virtual = z / narrow
    points = _tooth(virtual)
    return ToothProfile(FORM, tuple((1 + (r - 1) / narrow, angle / narrow) for r, angle in points))


def crown(z: int, mate: int, section: Sequence[tuple[float, float]]) -> ToothProfile:
    """A tooth of a crown wheel whose spaces are a little wider than the teeth of its mate, of which one is given.

    section   of that tooth: radius over its pitch radius, and angle (rad), in order of angle
    """
    import numpy as np

    r, angle = np.array([point for point in section if point[1] >= 0]).T
    heights, halves = (1 - r) * mate / 2, 0.5 - angle * mate / (2 * pi) - _CROWN_PLAY
    # short of the roots of its mate; the tips of that come as far short of its own
    low, high = heights[0] - (DEDENDUM - ADDENDUM), heights[-1] - (DEDENDUM - ADDENDUM)
    at = [low, *heights[heights < high], high]
    widths = np.clip(np.interp(at, heights, halves), _LAND / 2, _ROOM / 2)
    return ToothProfile(FORM, _mirrored([(1 + 2 * h / z, w * 2 * pi / z) for h, w in zip(at, widths, strict=True)], z))


def worm(starts: int, height: float) -> ToothProfile:
    """A thread: its section along the axle, wound round it; height over the pitch radius."""
    half = pi / starts
    low, high = max(1 - DEDENDUM * height, _LEAST_ROOT), 1 + height
    flanks = [(low, -0.75 * half), (high, -0.25 * half), (high, 0.25 * half), (low, 0.75 * half)]
    corners = [(low, -half), *flanks, (low, half)]
    points = [corners[0]]
    for (r, angle), (to, end) in pairwise(corners):
        steps = ceil((end - angle) / _STEP)
        points += [(r + (to - r) * at / steps, angle + (end - angle) * at / steps) for at in range(1, steps + 1)]
    return ToothProfile(FORM, tuple(points))


def _tooth(z: float, addendum: float = ADDENDUM) -> Points:
    root = _root(z)
    tip = 1 + 2 * addendum / z
    # a pointed tooth ends where its flanks are near to meeting
    while _half(z, tip) < _LAND * pi / z and tip > 1:
        tip = 1 + 0.9 * (tip - 1)
    flank = [(r, min(_half(z, r), _ROOM * pi / z)) for r in _spread(root, tip)]
    return _mirrored(flank, z)


def _spread(low: float, high: float) -> list[float]:
    return [low + (high - low) * at / (_POINTS - 1) for at in range(_POINTS)]


def _half(z: float, r: float) -> float:
    """Half the angle (rad) of a tooth of a wheel at radius r: involute, straight towards the axle under its base, and
    undercut as much as a rack does it."""
    base = cos(_PRESSURE)
    inner = 0.0 if r <= base else sqrt((r / base) ** 2 - 1) - acos(base / r)
    involute = (pi / 2 * (1 - 2 * _PLAY)) / z + tan(_PRESSURE) - _PRESSURE - inner
    return min(involute, pi / z - _swept(z, r))


def _swept(z: float, r: float) -> float:
    """Half the angle (rad) of a space that the tips of a rack sweep at radius r, from the middle of their own tooth.

    A corner of the rack, `b` from that middle and at the height `c` over the axle, is u aside when the wheel has turned
    by u - b: it then stands atan(u / c) - (u - b) from the middle of the space.
    """
    c = 1 - 2 * ADDENDUM / z
    b = pi / 2 / z - (1 - c) * tan(_PRESSURE)
    u = sqrt(max(r * r - c * c, 0.0))
    return atan2(u, c) - u + b if c > 0 and r < 1 else 0.0


def _mirrored(flank: list[tuple[float, float]], z: float) -> Points:
    """From the middle of a space to the middle of the next; the flank runs from root to tip."""
    root = flank[0][0]
    before = [(r, -angle) for r, angle in flank]
    return ((root, -pi / z), *before, *reversed(flank), (root, pi / z))
