"""How much wheels of parallel axes crowd each other in plan: the cost of a place for an axis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.layout.plan_problem import PlanDisc, PlanProblem

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices

_HARD = 100.0  # cost of wheels that collide in one level, by how far (mm over mm)
_OVER = 1.0  # of discs one above the other: levels part them, but flat is better
_COVER = 2.0  # of a disc over another axis, whose arbor it may meet
_MOST = 1500  # axes up to which wheels of one level are told from others


class PlanClearance:
    """Crowding of axes that keep their distance, on one bearer or about it; what carriers sweep is left to levels.

    still    (axes, axes): True where two keep their distance
    radius   of the widest wheel of each axis (mm), rings apart
    need     (axes, axes): least distances of axes whose wheels share a level and do not mesh (mm)
    meet     (axes, axes): True where wheels of two mesh
    """

    def __init__(self, problem: PlanProblem) -> None:
        labels = problem.labels
        number = {label: at for at, label in enumerate(labels)}
        bearer = np.array([problem.bearers[label] for label in labels])
        self.still = bearer[:, None] == bearer[None, :]
        for label, pivot in problem.pivots.items():
            if pivot in number:
                ends = number[label], number[pivot]
                self.still[ends] = self.still[ends[::-1]] = True
        plain = [[disc for disc in problem.discs.get(label, ()) if not disc.inner] for label in labels]
        self.radius = np.array([max((disc.outer for disc in discs), default=0.0) for discs in plain])
        self.need = _least_distances(plain, problem.mates)
        self.meet = np.zeros((len(labels), len(labels)), bool)
        axis = {disc.wheel: at for at, label in enumerate(labels) for disc in problem.discs.get(label, ())}
        for pair in problem.mates:
            both = [axis[wheel] for wheel in pair if wheel in axis]
            if len(both) == 2:
                self.meet[both[0], both[1]] = self.meet[both[1], both[0]] = True

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
        """Those of some axes that a candidate may come too near to: all others cost nothing."""
        low, high = candidates.min(axis=0), candidates.max(axis=0)
        spots = points[near]
        away = np.maximum(np.maximum(low - spots, spots - high), 0)
        reach = np.maximum(self.radius[at] + self.radius[near], self.need[at, near])
        return np.asarray(near[np.hypot(away[:, 0], away[:, 1]) < reach])


def _least_distances(discs: Sequence[Sequence[PlanDisc]], pairs: frozenset[frozenset[str]]) -> Floats:
    """Least distances of axes whose wheels share a level and do not mesh; 0 where nothing asks for any."""
    mates = _mates(pairs)
    need = np.zeros((len(discs), len(discs)))
    clusters: dict[int, list[tuple[int, PlanDisc]]] = {}
    for at, own in enumerate(discs):
        for disc in own:
            clusters.setdefault(disc.cluster, []).append((at, disc))
    for members in clusters.values() if len(discs) <= _MOST else ():
        outer = np.array([disc.outer for _, disc in members])
        apart = outer[:, None] + outer[None, :]
        number = {disc.wheel: nth for nth, (_, disc) in enumerate(members)}
        for _, disc in members:
            for mate in mates.get(disc.wheel, ()):
                if mate in number:
                    apart[number[disc.wheel], number[mate]] = 0.0
        ends = np.array([at for at, _ in members])
        np.maximum.at(need, np.ix_(ends, ends), apart)  # not need[...] = : an axis may have several wheels of a cluster
    np.fill_diagonal(need, 0.0)
    return need


def _mates(pairs: frozenset[frozenset[str]]) -> Mapping[str, Sequence[str]]:
    mates: dict[str, list[str]] = {}
    for pair in pairs:
        for wheel in pair:
            mates.setdefault(wheel, []).extend(pair - {wheel})
    return mates
