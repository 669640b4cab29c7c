"""Meshes of one carrier as a gain graph (links as nodes, speed ratios as gains), and its inconsistent loops.

The units of speed of the links are chosen so that as many meshes as possible have the gain 1. A mesh has another gain
only if it closes an inconsistent loop with the spanning tree of a first search. A loop can turn if the product of its
gains is 1.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

from geartrain.numerics.graphs import ways_to_common_ancestor

Gain = Fraction | int
GainLoop = list[tuple[int, int]]
"""Closed walk in the graph, as pairs of the node at which a step begins and the mesh of the step."""


@dataclass(frozen=True)
class GainGraph:
    """Graph with links as nodes 0 to size - 1, and meshes with gains as edges, addressed by index."""

    size: int
    ends: Sequence[tuple[int, int]]
    """Two nodes of each mesh; several meshes may connect the same two nodes."""
    gains: Mapping[int, Gain]
    """Gain of each mesh whose gain is not 1: speed of its second node divided by speed of its first."""
    firm: frozenset[int] = frozenset()
    """Indices of the couplings, which cannot be disengaged."""

    @cached_property
    def at(self) -> list[list[int]]:
        """Indices of the meshes at each node."""
        meshes: list[list[int]] = [[] for _ in range(self.size)]
        for mesh, (first, second) in enumerate(self.ends):
            meshes[first].append(mesh)
            meshes[second].append(mesh)
        return meshes

    def gain(self, mesh: int, start: int) -> Gain:
        """Return the gain of a mesh in the direction away from `start`."""
        gain = self.gains.get(mesh, 1)
        # integers 1 and -1 are faster than Fractions; never a float, because products are compared with 1 exactly
        return gain if start == self.ends[mesh][0] or gain in (1, -1) else 1 / Fraction(gain)

    def other(self, mesh: int, start: int) -> int:
        """Return the node of a mesh that is not `start`."""
        first, second = self.ends[mesh]
        return first + second - start

    def product(self, loop: GainLoop) -> Gain:
        """Return the product of the gains around a loop."""
        total: Gain = 1
        for node, mesh in loop:
            total = total * self.gain(mesh, node)
        return total


class GainWalk(NamedTuple):
    """Result of a search: the speed of each node, consistent with a spanning forest, and the meshes (`breaking`) that
    contradict these speeds.
    """

    speed: list[Gain]
    breaking: list[int]


def walk_gain_graph(network: GainGraph, without: Collection[int] = ()) -> GainWalk:
    """Search all nodes breadth first, using only meshes outside `without`. Meshes in `without` may be listed in
    `breaking` of the result.
    """
    gone = bytearray(len(network.ends))
    for mesh in without:
        gone[mesh] = 1
    at, ends, gains = network.at, network.ends, network.gains
    speeds: list[Gain] = [0] * network.size  # 0 means not reached
    for root in range(network.size):
        if speeds[root]:
            continue
        speeds[root] = 1
        queue = [root]
        for here in queue:
            for mesh in at[here]:
                there = network.other(mesh, here)
                if not speeds[there] and not gone[mesh]:
                    speeds[there] = speeds[here] * network.gain(mesh, here) if mesh in gains else speeds[here]
                    queue.append(there)
    # compared after the search, so that meshes of `without` are tested too
    breaking = [mesh for mesh, (i, j) in enumerate(ends) if speeds[i] * gains.get(mesh, 1) != speeds[j]]
    return GainWalk(speeds, breaking)


def is_balanced(network: GainGraph, without: Collection[int] = ()) -> bool:
    """Return True if every loop has the gain product 1 after the meshes in `without` are removed."""
    return set(without).issuperset(walk_gain_graph(network, without).breaking)


def inconsistent_loops(network: GainGraph, without: Collection[int] = ()) -> list[GainLoop]:
    """Return a short inconsistent loop for each mesh that contradicts a spanning forest, without duplicates.

    A shortest inconsistent loop of the whole network is among them, because every inconsistent loop contains one of
    these meshes.
    """
    breaking = [mesh for mesh in walk_gain_graph(network, without).breaking if mesh not in without]
    starts = dict.fromkeys(network.ends[mesh][0] for mesh in breaking)
    found = (_loop_through(network, without, start, 2 * network.size + 1) for start in starts)
    return list({frozenset(mesh for _, mesh in loop): loop for loop in found if loop}.values())


def shortest_loop(network: GainGraph, starts: Iterable[int]) -> GainLoop:
    """Return a shortest inconsistent loop through one of the nodes `starts`; empty if none exists."""
    best: GainLoop = []
    for start in starts:
        best = _loop_through(network, (), start, len(best) or 2 * network.size + 1) or best
        if len(best) == 2:  # the shortest possible loop
            break
    return best


def _loop_through(network: GainGraph, without: Collection[int], start: int, below: int) -> GainLoop:
    """Return an inconsistent loop with fewer than `below` meshes, found by breadth-first search from `start`; empty if
    there is none.
    """
    speed: dict[int, Gain] = {start: 1}
    came: dict[int, tuple[int, int]] = {}
    depth = {start: 0}
    best: tuple[int, int, int] | None = None
    queue = [start]
    for here in queue:
        if 2 * depth[here] + 1 >= below:  # loops found from here on are not shorter than the best
            break
        for mesh in network.at[here]:
            # compare meshes, not nodes, because two meshes between the same nodes form a loop
            if mesh in without or (here in came and mesh == came[here][1]):
                continue
            there = network.other(mesh, here)
            gained = speed[here] * network.gain(mesh, here)
            if there not in speed:
                speed[there], came[there], depth[there] = gained, (here, mesh), depth[here] + 1
                queue.append(there)
            elif speed[there] != gained and depth[here] + depth[there] + 1 < below:
                best, below = (here, mesh, there), depth[here] + depth[there] + 1
    if best is None:
        return []
    here, mesh, there = best
    up, down = ways_to_common_ancestor(here, there, lambda node: came[node][0] if node in came else None)
    return [*(came[node] for node in up[-2::-1]), (here, mesh), *((node, came[node][1]) for node in down[:-1])]
