"""Whether the tips of a pinion and of its ring clear each other after they have parted."""

from __future__ import annotations

from math import acos, atan2, cos, inf, sin
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.conjugate.path import Path
    from geartrain.conjugate.pitch import Floats


def tip_gap(path: Path) -> float:
    """Angle (rad of the ring) between the tip of a pinion's tooth and that of the ring's it has driven.

    Taken where the pinion's tip, the faster, leaves the ring's tip circle; negative where it would have run into the
    ring's tooth; where it never leaves, on the far side, where the teeth have slipped by half their difference.
    Infinite for any pair but a spur pinion in a ring with parted tip circles.
    """
    pitch = path.pitch
    if pitch.bevel or pitch.R2 > 0:
        return inf
    a = -pitch.R2 - pitch.R1
    (r1, start1), (r2, start2) = (
        _polar(flank(np.array([X]))[0], R)
        for flank, X, R in ((path.flank1, path.arcs[1], -pitch.R1), (path.flank2, -path.arcs[0], pitch.R2))
    )
    cosine = (r2 * r2 - r1 * r1 - a * a) / (2 * a * r1) if a > 0 else 2.0
    if cosine >= 1:
        return inf
    crossing = acos(max(cosine, -1.0))
    X = pitch.R1 * (crossing - start1)
    return start2 - X / pitch.R2 - atan2(r1 * sin(crossing), a + r1 * cos(crossing))


def _polar(point: Floats, height: float) -> tuple[float, float]:
    """Distance from a centre at `height` over the pitch point, and azimuth from straight up, forwards."""
    x, y = float(point[0]), float(point[1]) - height
    return (x * x + y * y) ** 0.5, atan2(x, y)
