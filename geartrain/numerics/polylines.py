"""Simplification of polylines in a plane."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


def simplified(points: Floats, tolerance: float) -> list[int]:
    """Return the indices of the points of a polyline, shape (n, 2), that remain after Ramer-Douglas-Peucker
    simplification.

    All other points are within `tolerance` of the simplified line. Both ends are kept; if they coincide, distances are
    measured from this common point. Ramer, Computer Graphics and Image Processing 1 (1972) 244; Douglas and Peucker,
    Cartographica 10 (1973) 112.

    >>> simplified(np.array([[0.0, 0.0], [1.0, 0.1], [2.0, -0.1], [3.0, 5.0], [4.0, 6.0]]), 0.5)
    [0, 2, 3, 4]
    """
    kept = {0, len(points) - 1}
    # a stack, because recursion could be too deep for a flank with thousands of points
    waiting = [(0, len(points) - 1)]
    while waiting:
        first, last = waiting.pop()
        if last - first < 2:
            continue
        along = points[last] - points[first]
        away = points[first + 1 : last] - points[first]
        length = float(np.hypot(*along))
        off = abs(along[0] * away[:, 1] - along[1] * away[:, 0]) / length if length else np.hypot(*away.T)
        if off.max() > tolerance:
            middle = first + 1 + int(off.argmax())
            kept.add(middle)
            waiting += [(first, middle), (middle, last)]
    return sorted(kept)
