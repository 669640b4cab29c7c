"""How near axes come to each other while carriers turn, and how much their wheels crowd each other in plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.layout.declared_geometry import AxisLine

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices

    Plane = Mapping[str, tuple[float, float]]

_HARD = 100.0  # cost of wheels that collide in one level, by how far (mm over mm)
_OVER = 1.0  # of discs one above the other: levels part them, but flat is better
_COVER = 2.0  # of a disc over another axis, whose arbor it may meet
_MOST = 1500  # axes up to which wheels of one level are told from others


@dataclass(frozen=True, slots=True)
class Disc:
    """A wheel in plan: out to `outer` (mm), of a ring from `inner` on; wheels of one cluster share a level."""

    wheel: str
    cluster: int
    inner: float
    outer: float


class PlanClearance:
    """Crowding of axes that keep their distance, on one bearer or about it; what carriers sweep is left to levels."""

    def __init__(
        self,
        labels: Sequence[str],
        bearers: Mapping[str, str],
        pivots: Mapping[str, str],
        discs: Mapping[str, Sequence[Disc]],
        mates: frozenset[frozenset[str]],
    ) -> None:
        bearer = np.array([bearers[label] for label in labels])
        self.still = bearer[:, None] == bearer[None, :]
        number = {label: at for at, label in enumerate(labels)}
        for label, pivot in pivots.items():
            if pivot in number:
                ends = number[label], number[pivot]
                self.still[ends] = self.still[ends[::-1]] = True
        plain = {label: [disc for disc in discs.get(label, ()) if not disc.inner] for label in labels}
        self.radius = np.array([max((disc.outer for disc in plain[label]), default=0.0) for label in labels])
        of: dict[str, list[str]] = {}
        for pair in mates:
            for wheel in pair:
                of.setdefault(wheel, []).extend(pair - {wheel})
        self.need = self._need(labels, plain, of)
        self.meet = np.zeros((len(labels), len(labels)), bool)
        index = {disc.wheel: at for at, label in enumerate(labels) for disc in discs.get(label, ())}
        for pair in mates:
            both = [index[wheel] for wheel in pair if wheel in index]
            if len(both) == 2:
                self.meet[both[0], both[1]] = self.meet[both[1], both[0]] = True

    def _need(
        self, labels: Sequence[str], plain: Mapping[str, Sequence[Disc]], mates: Mapping[str, Sequence[str]]
    ) -> Floats:
        """Least distances of axes whose wheels share a level and do not mesh."""
        need = np.zeros((len(labels), len(labels)))
        clusters: dict[int, list[tuple[int, Disc]]] = {}
        for at, label in enumerate(labels):
            for disc in plain[label]:
                clusters.setdefault(disc.cluster, []).append((at, disc))
        for members in clusters.values() if len(labels) <= _MOST else ():
            outer = np.array([disc.outer for _, disc in members])
            apart = outer[:, None] + outer[None, :]
            nth = {disc.wheel: number for number, (_, disc) in enumerate(members)}
            for _, disc in members:
                for mate in mates.get(disc.wheel, ()):
                    if mate in nth:
                        apart[nth[disc.wheel], nth[mate]] = 0.0
            ends = np.array([at for at, _ in members])
            np.maximum.at(need, np.ix_(ends, ends), apart)
        np.fill_diagonal(need, 0.0)
        return need

    def cost(self, at: int, placed: Indices, candidates: Floats, points: Floats) -> Floats:
        """Cost of each candidate place of an axis among those that stand."""
        near = self._within_reach(at, placed[self.still[at, placed]], candidates, points)
        apart = candidates[:, None, :] - points[near][None, :, :]
        far = np.hypot(apart[:, :, 0], apart[:, :, 1])
        own, other = self.radius[at], self.radius[near]
        free = ~self.meet[at, near]
        cost = _HARD * np.maximum(self.need[at, near] - far, 0).sum(axis=1)
        cost += _OVER * (np.maximum(own + other - far, 0) * free).sum(axis=1)
        cost += _COVER * (np.maximum(np.maximum(own, other) - far, 0) * free).sum(axis=1)
        return np.asarray(cost, float)

    def _within_reach(self, at: int, near: Indices, candidates: Floats, points: Floats) -> Indices:
        """Those of some axes that a candidate may come too near to."""
        low, high = candidates.min(axis=0), candidates.max(axis=0)
        spots = points[near]
        away = np.maximum(np.maximum(low - spots, spots - high), 0)
        reach = np.maximum(self.radius[at] + self.radius[near], self.need[at, near])
        return np.asarray(near[np.hypot(away[:, 0], away[:, 1]) < reach])


def swept_ranges(lines: Sequence[AxisLine], places: Plane) -> tuple[Floats, Floats]:
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
