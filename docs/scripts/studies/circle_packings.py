"""Circle packings by Newton and by the fixed point, each judged in 40 digits; and axes moved to fit."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from math import degrees, pi
from statistics import median
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.spherical import GraphSet, from_graph
from geartrain.spherical.circle_packing import PlanarPacking, SpherePacking, angle_excess, pack_circles
from geartrain.spherical.graph_set import Aim, checked_graph, regions_of, with_region_circles
from studies.measurement import timed
from studies.planar_graphs import graph
from studies.reference_solutions import numbers
from studies.sphere_records import TARGET, FitRecord, PackRecord

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]
_PATIENCE = 60.0  # seconds of one fixed point


def packed(family: str, given: int, rounds: int) -> list[PackRecord]:
    """One circle packing by both ways, its time the median of some rounds."""
    named = checked_graph(graph(family, given))
    gears, regions = with_region_circles(len(named), regions_of(named), list(named))
    radii = [_timed_steps(PlanarPacking(gears, regions)) for _ in range(3 * rounds)]
    whole = [timed(lambda: pack_circles(gears, regions)) for _ in range(rounds)]
    sweeps = FixedPoint(PlanarPacking(gears, regions))
    sweeps.run(TARGET)
    packing: SpherePacking = whole[0][1]
    record = PackRecord(
        family=family,
        gears=gears,
        meshes=len(packing.meshes),
        steps=_middle(radii),
        seconds=median(seconds for seconds, _ in whole),
        residual=packing.residual,
        judged=judged(packing),
        overlaps=overlaps(packing),
        sweeps=sweeps.sweeps,
        swept=sweeps.seconds,
        left=sweeps.trace[-1][1],
        trace=sweeps.trace,
    )
    return [record]


def _timed_steps(plane: PlanarPacking) -> list[tuple[float, float]]:
    """Seconds and residual of each Newton step; what is prepared for all of them counts to the first."""
    marks = [time.perf_counter()]
    _, residuals = plane.radii(lambda: marks.append(time.perf_counter()))
    return list(zip(np.diff(marks).tolist(), residuals, strict=True))


def _middle(rounds: Sequence[Sequence[tuple[float, float]]]) -> list[tuple[float, float]]:
    """Each step's median time over the rounds, and its residual, which is the same in all."""
    return [(median(seconds for seconds, _ in each), each[0][1]) for each in zip(*rounds, strict=True)]


def fitted(family: str, given: int, aim: Aim, minimum: int) -> list[FitRecord]:
    """One set of gears fitted to its graph."""
    edges = graph(family, given)
    found: GraphSet = from_graph(edges, minimum, aim)
    return [
        FitRecord(
            family=family,
            gears=len(found.configuration.names),
            aim=aim,
            minimum=minimum,
            most=max(found.configuration.teeth.values()),
            steps=len(found.residuals),
            residual=found.sizing.mismatch if aim == "pitch" else found.residue,
            exact=aim in found.exact,
            moved=degrees(float(found.moved.max())),
        )
    ]


class FixedPoint:
    """Radii by repeated correction, without derivatives: each as if all neighbours of a circle had one radius.

    A circle about which k circles subtend theta, where it should be Theta, gets r tan(theta / 2k) / tan(Theta / 2k).
    Gears and regions are corrected in turn; that is one sweep. No gear touches a gear here, so all of one sort are
    corrected at once, and each sort sees the latest radii of the other.

    sweeps, seconds   so far
    trace             sweeps and largest residuals (rad): every 10th sweep up to 100, then with steps of a tenth
    """

    def __init__(self, plane: PlanarPacking) -> None:
        near = np.ones(plane.count, dtype=bool)
        near[list(plane.far)] = False
        place = np.cumsum(near) - 1
        ends = np.array([(i, j) for i in range(plane.count) if near[i] for j in plane.around[i]])
        inner = ends[near[ends[:, 1]]]
        outer = ends[~near[ends[:, 1]], 0]
        self.i, self.j = place[inner].T
        self.target = np.asarray(2 * pi - pi * np.bincount(outer, minlength=plane.count), dtype=float)[near]
        self.u = np.zeros(int(near.sum()))
        gear = (np.arange(plane.count) < plane.gears)[near]
        self.parts = [self._part(gear), self._part(~gear)]
        self.sweeps, self.seconds = 0, 0.0
        self.trace: list[tuple[int, float]] = []

    def _part(self, chosen: NDArray[np.bool_]) -> tuple[Whole, ...]:
        """Circles of one sort; of each of their neighbours, the number within the sort, and both ends."""
        pairs = chosen[self.i]
        return np.flatnonzero(chosen), (np.cumsum(chosen) - 1)[self.i[pairs]], self.i[pairs], self.j[pairs]

    @property
    def residual(self) -> float:
        """Largest residual of an angle (rad)."""
        return float(np.abs(angle_excess(self.u, self.i, self.j, self.target)).max())

    def sweep(self) -> None:
        """Correct all gears, then all regions."""
        for at, own, i, j in self.parts:
            theta = np.bincount(own, 2 * np.arctan(np.exp(self.u[j] - self.u[i])), len(at))
            k = 2 * np.bincount(own, minlength=len(at))
            self.u[at] += np.log(np.tan(theta / k) / np.tan(self.target[at] / k))

    def run(self, target: float, patience: float = _PATIENCE) -> None:
        """Sweep until the residual is below the target (rad), or so many seconds have passed."""
        start = time.perf_counter()
        while not self.trace or (self.trace[-1][1] >= target and self.seconds < patience):
            for _ in range(max(10, self.sweeps // 10) if self.sweeps < 1000 else 100):
                self.sweep()
                self.sweeps += 1
            self.trace.append((self.sweeps, self.residual))
            self.seconds = time.perf_counter() - start
        self.trace = _thinned(self.trace)


def _thinned(trace: list[tuple[int, float]]) -> list[tuple[int, float]]:
    """Points of a trace whose sweeps grow by a tenth or more, and the last."""
    kept = trace[:1]
    for point in trace[1:-1]:
        if point[0] > 1.1 * kept[-1][0]:
            kept.append(point)
    return [*kept, trace[-1]] if len(trace) > 1 else kept


def judged(packing: SpherePacking) -> float:
    """Largest error of a tangency or right angle (rad): floats taken as they are, angles between them in 40 digits."""
    return max(float(abs(each)) for each in _misses(packing, numbers()))


def _misses(packing: SpherePacking, m: Any) -> Iterator[Any]:
    gears = [_circle(m, *each) for each in zip(packing.axes, packing.cones, strict=True)]
    regions = [_circle(m, *each) for each in zip(packing.region_axes, packing.region_cones, strict=True)]
    left = {(walk[k - 1], gear): at for at, walk in enumerate(packing.regions) for k, gear in enumerate(walk)}
    for i, j in packing.meshes:
        yield _angle(m, gears[i], gears[j]) - gears[i][1] - gears[j][1]
        one, other = regions[left[i, j]], regions[left[j, i]]
        yield _angle(m, one, other) - one[1] - other[1]
    for (_, gear), region in left.items():
        a, b = gears[gear], regions[region]
        yield _angle(m, a, b) - m.acos(m.sin(m.pi / 2 - a[1]) * m.sin(m.pi / 2 - b[1]))


def _circle(m: Any, axis: Floats, cone: float) -> tuple[list[Any], Any]:
    return [m.number(float(x)) for x in axis], m.number(float(cone))


def _angle(m: Any, one: tuple[list[Any], Any], other: tuple[list[Any], Any]) -> Any:
    """Angle between two directions of any length (rad), by sine and cosine."""
    a, b = one[0], other[0]
    across = [a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2] for k in range(3)]
    return m.atan2(m.sqrt(sum(x * x for x in across)), sum(x * y for x, y in zip(a, b, strict=True)))


def overlaps(packing: SpherePacking) -> int:
    """Pairs of gears whose circles overlap by more than 1e-9 rad, every pair measured in space."""
    count = 0
    for at, axis in enumerate(packing.axes[:-1], 1):
        rest = packing.axes[at:]
        apart = 2 * np.arctan2(np.linalg.norm(axis - rest, axis=1), np.linalg.norm(axis + rest, axis=1))
        count += int((apart < packing.cones[at - 1] + packing.cones[at:] - 1e-9).sum())
    return count
