"""How much wheels crowd each other in plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Indices = NDArray[np.intp]

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


class Room:
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
