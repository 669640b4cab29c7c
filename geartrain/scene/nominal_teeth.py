"""Teeth for wheels that have no flat outline: bevels, crowns, worms, and what nobody could cut, as such wheels look."""

from __future__ import annotations

from math import acos, cos, pi, sqrt, tan

from geartrain.scene.elements import ToothProfile

Points = tuple[tuple[float, float], ...]
"""Radii over the pitch radius, and angles (rad)."""

FORM = "likeness"
_PRESSURE = pi / 9
_ADDENDUM, _DEDENDUM = 1.0, 1.25  # modules
_PLAY = 0.02  # of a pitch: what each tooth is thinner
_LEAST_ROOT = 0.25  # of the pitch radius: few teeth leave little
_ROOM = 0.92  # of half a pitch: where at most a flank ends at the root
_POINTS = 6  # on a flank
_LAND = 0.08  # of a pitch: least half width of a tip


def spur(z: int) -> ToothProfile:
    """A tooth of a wheel."""
    return ToothProfile(FORM, _tooth(z))


def ring(z: int) -> ToothProfile:
    """A tooth of a ring: what a wheel of as many teeth leaves between its own."""
    most = 1 + 2 * _DEDENDUM / z
    # the space of the ring is the tooth of a wheel, higher and a little wider
    tip = max(1 - 2 * _ADDENDUM / z, _LEAST_ROOT)
    half = pi / z
    flank = [(r, half - _half(z, r) - 2 * _PLAY * pi / z) for r in _spread(tip, most)]
    return ToothProfile(
        FORM, _mirrored([(r, min(max(angle, _LAND * half), _ROOM * half)) for r, angle in reversed(flank)], z)
    )


def bevel(z: int, cone: float) -> ToothProfile:
    """A tooth of a bevel wheel at its wide end: that of the wheel into which its back cone unrolls.

    The radius counts heights over the pitch cone along the back cone; cone is the half angle of the pitch cone (rad).
    """
    # the back cone of a crown wheel never closes: its teeth are nearly those of a rack
    narrow = max(cos(cone), 1e-3)
    virtual = z / narrow
    points = _tooth(virtual)
    return ToothProfile(FORM, tuple((1 + (r - 1) / narrow, angle / narrow) for r, angle in points))


def worm(starts: int, height: float) -> ToothProfile:
    """A thread: its section along the axle, wound round it; height over the pitch radius."""
    half = pi / starts
    low, high = max(1 - 1.25 * height, _LEAST_ROOT), 1 + height
    flanks = [(low, -0.75 * half), (high, -0.25 * half), (high, 0.25 * half), (low, 0.75 * half)]
    return ToothProfile(FORM, ((low, -half), *flanks, (low, half)))


def _tooth(z: float) -> Points:
    root = max(1 - 2 * _DEDENDUM / z, _LEAST_ROOT)
    tip = 1 + 2 * _ADDENDUM / z
    # a pointed tooth ends where its flanks are near to meeting
    while _half(z, tip) < _LAND * pi / z and tip > 1:
        tip = 1 + 0.9 * (tip - 1)
    flank = [(r, min(_half(z, r), _ROOM * pi / z)) for r in _spread(root, tip)]
    return _mirrored(flank, z)


def _spread(low: float, high: float) -> list[float]:
    return [low + (high - low) * at / (_POINTS - 1) for at in range(_POINTS)]


def _half(z: float, r: float) -> float:
    """Half the angle (rad) of an involute tooth of a wheel at radius r; straight towards the axle under its base."""
    base = cos(_PRESSURE)
    inner = 0.0 if r <= base else sqrt((r / base) ** 2 - 1) - acos(base / r)
    return (pi / 2 * (1 - 2 * _PLAY)) / z + tan(_PRESSURE) - _PRESSURE - inner


def _mirrored(flank: list[tuple[float, float]], z: float) -> Points:
    """From the middle of a space to the middle of the next; the flank runs from root to tip."""
    root = flank[0][0]
    before = [(r, -angle) for r, angle in flank]
    return ((root, -pi / z), *before, *reversed(flank), (root, pi / z))
