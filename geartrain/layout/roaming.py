"""How near and how far axes come to each other while carriers turn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from geartrain.layout.reading import Line

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Plane = Mapping[str, tuple[float, float]]


def ranges(lines: Sequence[Line], places: Plane) -> tuple[Floats, Floats]:
    """Least and greatest distance of each two of parallel axes, (n, n), at any turns of their carriers.

    Seen from the nearest link that bears both, each stays in a ring about the axis of the carrier that hangs there;
    all of both rings is counted, as if carriers never kept step. Axes borne by a link that turns about another
    direction are far from all that it does not bear.
    """
    seen: dict[tuple[str, ...], list[tuple[int, str, float, float]]] = {}
    for at, line in enumerate(lines):
        centre, low, high = line.label, 0.0, 0.0
        for depth in range(len(line.bearers)):
            seen.setdefault(line.bearers[depth:], []).append((at, centre, low, high))
            pivot = line.pivots[depth] if depth < len(line.pivots) else ""
            if pivot not in places:
                break
            (x, y), (u, v) = places[centre], places[pivot]
            arm = hypot(x - u, y - v)
            low, high = max(0.0, low - arm, arm - high), high + arm
            centre = pivot
    count = len(lines)
    near, far = np.full((count, count), np.inf), np.zeros((count, count))
    for _, members in sorted(seen.items(), key=lambda each: len(each[0])):
        _fill(near, far, members, places)
    return near, far


def _fill(near: Floats, far: Floats, members: Sequence[tuple[int, str, float, float]], places: Plane) -> None:
    index = np.array([at for at, *_ in members])
    points = np.array([places[centre] for _, centre, _, _ in members])
    low, high = np.array([member[2] for member in members]), np.array([member[3] for member in members])
    apart = np.hypot(*(points[:, None, axis] - points[None, :, axis] for axis in (0, 1)))
    block = np.ix_(index, index)
    if not high.any():  # none is carried round
        near[block] = far[block] = apart
        return
    reach = high[:, None] + high[None, :]
    near[block] = np.maximum.reduce(
        [apart - reach, low[:, None] - high[None, :] - apart, low[None, :] - high[:, None] - apart, 0 * apart]
    )
    far[block] = apart + reach
