"""Meshes that were seen, as what they leave of the ways of a path through arbors.

Arbors that seen meshes hold together are a cluster, a part of the tree: one of them is above all others of it, which is
the input where that is among them. Of two wheels in mesh one drives the other, and its arbor is the parent. A path has
the parents of all its arbors. So the arbors of a cluster that are on it stand in a row, and it leads over their meshes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.arbor_passes import ArborPass
from geartrain.synthesis.reconstruction.reconstruction_problem import PlacedWheel, ReconstructionProblem

_Fits = NDArray[np.bool_]
"""By way through an arbor, from 1 on, and way through another: whether they go together; 0 where there is none."""


def seen_clusters(problem: ReconstructionProblem) -> tuple[tuple[int, ...], ...]:
    """Arbors by number, the input at 0, that seen meshes hold together; each but the first has a mate before it."""
    mates: dict[int, list[int]] = {}
    for first, _, second, _ in _meshes(problem):
        mates.setdefault(first, []).append(second)
        mates.setdefault(second, []).append(first)
    found: list[tuple[int, ...]] = []
    for start in sorted(mates):
        if not any(start in cluster for cluster in found):
            cluster = [start]
            for at in cluster:
                cluster += [mate for mate in dict.fromkeys(mates[at]) if mate not in cluster]
            found.append(tuple(cluster))
    return tuple(found)


def _meshes(problem: ReconstructionProblem) -> Iterator[tuple[int, str, int, str]]:
    """Each mesh that was seen, as two arbors by number with their wheels."""
    owner = {wheel.name: at for at, arbor in enumerate((problem.input, *problem.arbors)) for wheel in arbor.wheels}
    for one, other in sorted(map(sorted, problem.meshes)):
        yield owner[one], one, owner[other], other


class SeenMeshes:
    """Which ways of a path through arbors go together.

    Parameters
    ----------
    passes : sequence
        By arbor the ways through it, the input first.

    Attributes
    ----------
    order : tuple of int
        The arbors, those of one cluster after each other, and those with many ways first.
    """

    def __init__(self, problem: ReconstructionProblem, passes: Sequence[Sequence[ArborPass]]) -> None:
        clusters = seen_clusters(problem)
        held = {at for cluster in clusters for at in cluster}
        groups = [*clusters, *((at,) for at in range(len(passes)) if at not in held)]
        groups.sort(key=lambda group: (0 not in group or len(group) == 1, -max(len(passes[at]) for at in group)))
        self.order = tuple(at for group in groups for at in group)
        place = {at: number for number, at in enumerate(self.order)}
        self._before = {at: cluster[:number] for cluster in clusters for number, at in enumerate(cluster)}
        self._fits: dict[int, list[tuple[int, _Fits]]] = {at: [] for at in range(len(passes))}
        for mesh in _meshes(problem):
            first, one, second, other = mesh if place[mesh[0]] < place[mesh[2]] else (*mesh[2:], *mesh[:2])
            below = next(0 in cluster for cluster in clusters if first in cluster)
            fits = [
                [_go_together(mine, one, theirs, other, problem.idlers, below) for mine in (None, *passes[first])]
                for theirs in (None, *passes[second])
            ]
            self._fits[second].append((first, np.array(fits, dtype=bool)))

    def allowed(self, codes: NDArray[np.uint16], at: int, code: int) -> NDArray[np.bool_] | None:
        """Which of some paths through the arbors before may take a way through one more; None where all may."""
        if not self._fits[at]:
            return None
        found = np.ones(len(codes), dtype=bool)
        for other, fits in self._fits[at]:
            found &= fits[code][codes[:, other]]
            if code:  # in a row: where its mate is not on the path, no other of the cluster is
                found &= (codes[:, other] > 0) | ~(codes[:, list(self._before[at])] > 0).any(axis=1)
        return found


def _go_together(
    mine: ArborPass | None, one: str, theirs: ArborPass | None, other: str, idlers: bool, below: bool
) -> bool:
    """Whether a path may have these ways through two arbors whose wheels `one` and `other` mesh.

    below   whether the second arbor must be driven by the first
    """
    if mine is None or theirs is None:
        there, wheel = (mine, one) if theirs is None else (theirs, other)
        return there is None or (not (below and mine is None) and (idlers or not _is(there.driven, wheel)))
    if _is(mine.driver, one) and _is(theirs.driven, other):
        return True
    return not below and _is(theirs.driver, other) and _is(mine.driven, one)


def _is(wheel: PlacedWheel | None, name: str) -> bool:
    return wheel is not None and wheel.name == name
