"""Points moved so that distances they cannot all have are missed as little as can be."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_TOUCH = 1e-10  # of a distance: nearer than this it is kept
_STEPS = 60
_MOST = 400  # points up to which a dense matrix is solved


def fit(points: Floats, edges: Sequence[tuple[int, int, float]], fixed: Sequence[int]) -> Floats:
    """Least squares of the misses by Gauss and Newton, in steps of at most a tenth of a distance; `fixed` stay."""
    free = [at for at in range(len(points)) if at not in set(fixed)]
    edges = [(a, b, far) for a, b, far in edges if not {a, b} <= set(fixed)]
    if not edges or not free or len(points) > _MOST or np.all(np.abs(_misses(points, edges)[0]) <= _tolerance(edges)):
        return points
    column = {at: 2 * nth for nth, at in enumerate(free)}
    points = points.copy()
    for _ in range(_STEPS):
        miss, ways = _misses(points, edges)
        matrix = np.zeros((len(edges), 2 * len(free)))
        for row, (a, b, _) in enumerate(edges):
            for end, sign in ((a, -1.0), (b, 1.0)):
                if end in column:
                    matrix[row, column[end] : column[end] + 2] = sign * ways[row]
        move = np.linalg.lstsq(matrix, -miss, rcond=1e-9)[0].reshape(-1, 2)
        most = 0.1 * max(far for *_, far in edges)
        longest = float(np.abs(move).max())
        points[free] += move * min(1.0, most / longest) if longest else 0.0
        if longest < _TOUCH * most:
            break
    return points


def _misses(points: Floats, edges: Sequence[tuple[int, int, float]]) -> tuple[Floats, Floats]:
    ends = np.array([(a, b) for a, b, _ in edges])
    apart = points[ends[:, 1]] - points[ends[:, 0]]
    far = np.hypot(apart[:, 0], apart[:, 1])
    ways = apart / np.where(far > 0, far, 1.0)[:, None]
    return far - np.array([each[2] for each in edges]), ways


def _tolerance(edges: Sequence[tuple[int, int, float]]) -> Floats:
    return _TOUCH * np.array([max(far, 1e-9) for *_, far in edges])
