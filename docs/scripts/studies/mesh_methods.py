"""Other ways to the law of triangular teeth: all couples sampled and interpolated, or scanned for who drives."""

from __future__ import annotations

from math import ceil

import numpy as np
from numpy.typing import NDArray

from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.real_path import DriveInterval
from geartrain.teeth.triangular.tooth_pair import APPROACH, RECESS, ToothPair
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

Floats = NDArray[np.float64]
Driver = tuple[int, str] | None

_SCAN = 128  # positions in a pitch at which the scan asks who drives


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
        y = np.fmin(tooth_pair.approach_angle(x[inside], np), tooth_pair.recess_angle(x[inside], np)) - k * sizes.p2
        lowest[inside] = np.minimum(lowest[inside], y)
    return lowest


def scanned(sizes: TriangularSizes) -> TriangularTransmission:
    """The law on switching points found by a scan of all couples."""
    transmission = plain_transmission(sizes)
    vars(transmission.contact.path)["envelope"] = _Scan(sizes).envelope()
    _ = transmission.intervals
    return transmission


class _Scan:
    """Switching points where the lowest of all couples changes, by halving; what is shorter than a scan is missed."""

    def __init__(self, sizes: TriangularSizes) -> None:
        self.sizes, self.tooth_pair = sizes, ToothPair(sizes)
        reach = int(sizes.reach1 // sizes.p1) + 2
        self.numbers = np.arange(-reach, reach + 2)

    def driver(self, t: float) -> Driver:
        """The couple and phase that are lowest at position t."""
        x = t + self.numbers * self.sizes.p1
        inside = np.abs(x) <= self.sizes.reach1
        if not inside.any():
            return None
        k, x = self.numbers[inside], x[inside]
        both = [
            self.tooth_pair.approach_angle(x, np) - k * self.sizes.p2,
            self.tooth_pair.recess_angle(x, np) - k * self.sizes.p2,
        ]
        at = int(np.nanargmin(np.fmin(*both)))
        return int(k[at]), APPROACH if both[0][at] < both[1][at] else RECESS

    def envelope(self) -> list[DriveInterval]:
        """Who drives over one pitch, beginning at a switching point."""
        positions = -self.sizes.p1 * np.arange(_SCAN + 1) / _SCAN
        drivers = [self.driver(float(t)) for t in positions]
        switches: list[tuple[float, Driver]] = []
        for at in range(_SCAN):
            t, here = float(positions[at]), drivers[at]
            while here != drivers[at + 1]:
                t = self._switch(t, float(positions[at + 1]), here)
                here = self.driver(t)
                switches.append((t, here))
        found = []
        ends = [t for t, _ in switches[1:]] + [switches[0][0] - self.sizes.p1]
        for (start, driver), end in zip(switches, ends, strict=True):
            if driver is not None:
                shift = driver[0] * self.sizes.p1
                found.append(DriveInterval(driver[1], start + shift, end + shift, driver[0]))
        return found

    def _switch(self, t: float, end: float, here: Driver) -> float:
        """The first position after t that `here` does not drive."""
        while end < (middle := end + (t - end) / 2) < t:
            t, end = (middle, end) if self.driver(middle) == here else (t, middle)
        return end
