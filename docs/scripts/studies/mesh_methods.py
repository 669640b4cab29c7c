"""Alternative for the transmission function of triangular teeth: the envelope of all pairs, sampled and joined."""

from __future__ import annotations

from math import ceil

import numpy as np
from numpy.typing import NDArray

from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.tooth_pair import ToothPair
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

Floats = NDArray[np.float64]


def plain_transmission(sizes: TriangularSizes) -> TriangularTransmission:
    """The law by the direct formula."""
    return TriangularTransmission(sizes, friction=0.2)


class Sampled:
    """The envelope of all couples at `count` positions of a pitch, the driven wheel dragged, and linear between."""

    def __init__(self, sizes: TriangularSizes, count: int) -> None:
        self.ratio, self.pitch = sizes.ratio, sizes.p1
        self.grid: Floats = np.arange(count + 1.0) * (sizes.p1 / count)
        lowest = lowest_of_all(sizes, -self.grid[:-1])
        dragged = np.minimum.accumulate(np.concatenate((lowest + sizes.p2, lowest)))[count:]
        errors = -dragged - sizes.ratio * self.grid[:-1]
        self.errors = np.append(errors, errors[0])
        around = np.concatenate((errors[-1:], self.errors, errors[1:2]))
        self.speeds = sizes.ratio + (around[2:] - around[:-2]) * (count / (2 * sizes.p1))

    def error(self, S: Floats) -> Floats:
        """Transmission error (rad of the driven wheel)."""
        return np.asarray(np.interp(np.mod(S, self.pitch), self.grid, self.errors), dtype=float)

    def speed(self, S: Floats) -> Floats:
        """Speed ratio, from central differences."""
        return np.asarray(np.interp(np.mod(S, self.pitch), self.grid, self.speeds), dtype=float)


def lowest_of_all(sizes: TriangularSizes, t: Floats) -> Floats:
    """U(t): the least driven angle over all couples in reach at driver positions t (rad); infinite where none is."""
    tooth_pair, reach = ToothPair(sizes), sizes.reach1
    lowest = np.full(t.shape, np.inf)
    for k in range(ceil((-reach - t.max()) / sizes.p1), int((reach - t.min()) // sizes.p1) + 1):
        x = t + k * sizes.p1
        inside = np.flatnonzero(np.abs(x) <= reach)
        y = (
            np.fmin(tooth_pair.angle("approach", x[inside], np), tooth_pair.angle("recess", x[inside], np))
            - k * sizes.p2
        )
        lowest[inside] = np.minimum(lowest[inside], y)
    return lowest
