"""Whether a mate's teeth pass through a wheel's spaces: its teeth set against the outline in every position."""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, inf, pi
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.outlines.contour import Floats
    from geartrain.outlines.tooth import Tooth

_STEPS = 120  # positions in a pitch
_MARGIN = 1e-3  # modules: least room at the round, which is more than a tip moves between two positions


@dataclass(frozen=True, slots=True)
class Mate:
    """One tooth or pin of another wheel.

    span       radius and signed angle of its points (2, n), where one of its flanks touches: half the play turned on
    z          its tooth number
    distance   of the two axles, negative for a wheel in a ring
    internal   one of the two wheels is a ring; `ring`: this one
    """

    span: Floats
    z: int
    distance: float
    internal: bool
    ring: bool


@dataclass(frozen=True, slots=True)
class Passage:
    """Where a mate's tooth comes within the tip circle of a wheel, as that wheel sees it.

    radius     about the wheel's axle; aside, angle (rad) from the axis of its nearest tooth
    """

    radius: Floats
    aside: Floats


def passage(z: int, tip: float, outward: int, mate: Mate) -> Passage:
    """The way of a mate's tooth through the spaces of a wheel of z teeth; lengths in modules."""
    turn = _positions(tip, outward, mate)[:, None]
    r, angle = mate.span
    place = mate.distance + r * np.exp(1j * (angle + turn + (0 if mate.internal else pi)))
    radius = np.abs(place)
    inside = (radius - tip) * outward <= 0
    own = turn * mate.z / z * (1 if mate.internal else -1)
    pitch = 2 * pi / z
    aside = np.abs((np.angle(place) - own) % pitch - pitch / 2)  # a space of the wheel meets the mate's tooth
    return Passage(radius[inside], aside[inside])


def bite(tooth: Tooth, mate: Passage) -> float:
    """How deep (modules) the mate's tooth cuts into the wheel's while it passes through the space; negative: play.

    Along the circle where it cuts flank or round, along the radius where it cuts the root circle. A round has to keep
    some room more.
    """
    if not mate.radius.size:
        return -inf
    s = tooth.flank.outward
    deep = (tooth.half_at(mate.radius) - mate.aside) * mate.radius
    below = (tooth.root - mate.radius) * s
    on_round = (mate.radius - np.hypot(*tooth.fillet.start)) * s < 0
    return float(np.where(below > 0, below, deep + np.where(on_round, _MARGIN, 0.0)).max())


def _positions(tip: float, outward: int, mate: Mate) -> Floats:
    """Angles of the mate at which its tooth may be within the wheel's tip circle."""
    distance = mate.distance
    far = float(mate.span[0].min() if mate.ring else mate.span[0].max())
    if not distance:
        reach = pi
    else:
        cosine = (tip**2 - distance**2 - far**2) / (2 * distance * far)
        cosine = cosine if outward < 0 else -cosine
        if mate.ring:
            cosine = (distance**2 + far**2 - tip**2) / (2 * abs(distance) * far)
        reach = acos(min(max(cosine, -1.0), 1.0))
    reach = min(reach + 1.5 * pi / mate.z, pi)
    return np.linspace(-reach, reach, 2 * int(reach * mate.z * _STEPS / (2 * pi)) + 1)
