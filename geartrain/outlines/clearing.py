"""Whether a mate's teeth pass through a wheel's spaces: its teeth set against the outline in every position."""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, pi
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.outlines.contour import Floats
    from geartrain.outlines.tooth import Tooth

_STEPS = 120  # positions in a pitch


@dataclass(frozen=True, slots=True)
class Mate:
    """One tooth or pin of the other wheel.

    span       radius and signed angle of its points (2, n), where one of its flanks touches: half the play turned on
    z, R       its tooth number and pitch radius
    internal   one of the two wheels is a ring
    """

    span: Floats
    z: int
    R: float
    internal: bool


def bite(tooth: Tooth, mate: Mate) -> float:
    """How deep (modules) the mate's tooth cuts into the wheel's while it passes through the space; negative: play.

    Along the circle where it cuts flank or round, along the radius where it cuts the root circle.
    """
    R, s = tooth.flank.R, tooth.flank.outward
    distance = R - mate.R if mate.internal else R + mate.R
    turn = _positions(tooth, mate, distance)[:, None]
    r, angle = mate.span
    place = distance + r * np.exp(1j * (angle + turn + (0 if mate.internal else pi)))
    radius = np.abs(place)
    own = turn * mate.z / tooth.z * (1 if mate.internal else -1)
    pitch = 2 * pi / tooth.z
    from_axis = np.abs((np.angle(place) - own) % pitch - pitch / 2)  # a space of the wheel meets the mate's tooth
    deep = (_half_at(tooth, radius) - from_axis) * radius
    deep = np.where((radius - tooth.tip) * s > 0, -np.inf, deep)
    below = (tooth.root - radius) * s
    return float(np.where(below > 0, below, deep).max())


def _half_at(tooth: Tooth, radius: Floats) -> Floats:
    r, half = tooth.profile()
    if r[0] > r[-1]:
        r, half = r[::-1], half[::-1]
    return np.asarray(np.interp(radius, r, half))


def _positions(tooth: Tooth, mate: Mate, distance: float) -> Floats:
    """Angles of the mate at which its tooth may be within the wheel's tip circle."""
    far = float(mate.span[0].min() if mate.internal and mate.R > tooth.flank.R else mate.span[0].max())
    if not distance:
        reach = pi
    else:
        cosine = (tooth.tip**2 - distance**2 - far**2) / (2 * distance * far)
        cosine = cosine if tooth.flank.outward < 0 else -cosine
        if mate.internal and tooth.flank.outward > 0:
            cosine = (distance**2 + far**2 - tooth.tip**2) / (2 * abs(distance) * far)
        reach = acos(min(max(cosine, -1.0), 1.0))
    reach = min(reach + 1.5 * pi / mate.z, pi)
    return np.linspace(-reach, reach, 2 * int(reach * mate.z * _STEPS / (2 * pi)) + 1)
