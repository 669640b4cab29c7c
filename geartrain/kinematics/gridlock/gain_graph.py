"""Meshes of one carrier as a gain graph (links as nodes, speed ratios as gains), and its search algorithms.

Speeds are measured in units in which as many meshes as possible have the gain 1. A mesh has another gain only if it
closed an inconsistent loop in a first search. A loop can turn if the product of its gains is 1.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

from geartrain.numerics.graphs import tree_path, ways_to_common_ancestor

Gain = Fraction | int
GainLoop = list[tuple[int, int]]
"""Closed walk in the graph: pairs of the node where a step starts, and the mesh of the step."""


def inverse(gain: Gain) -> Gain:
    """Return 1 / gain; the gains 1 and -1 stay integers, which are faster than Fractions."""
    return (
        gain if gain == 1 or gain == -1 else 1 / Fraction(gain)
    )  # never a float, because products are compared with 1 exactly


@dataclass(frozen=True)
class GainGraph:
    """Graph with links as nodes 0 to size - 1, and meshes with gains as edges, addressed by index."""

    size: int
    ends: Sequence[tuple[int, int]]
    """Two nodes of each mesh; several meshes may connect the same nodes."""
    gains: Mapping[int, Gain]
    """Mesh -> gain, if it is not 1: speed of its second node divided by speed of its first."""
    firm: frozenset[int] = frozenset()
    """Meshes that cannot be disengaged, such as pins in slots."""

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
        return gain if start == self.ends[mesh][0] else inverse(gain)

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

    def part(self, meshes: Sequence[int]) -> tuple[GainGraph, list[int]]:
        """Return the subgraph of the given meshes, in their order, and the list of its nodes."""
        nodes = list(dict.fromkeys(node for mesh in meshes for node in self.ends[mesh]))
        number = {node: at for at, node in enumerate(nodes)}
        ends = [(number[self.ends[mesh][0]], number[self.ends[mesh][1]]) for mesh in meshes]
        gains = {at: self.gains[mesh] for at, mesh in enumerate(meshes) if mesh in self.gains}
        firm = frozenset(at for at, mesh in enumerate(meshes) if mesh in self.firm)
        return GainGraph(len(nodes), ends, gains, firm), nodes


class GainWalk(NamedTuple):
    """Result of a breadth-first search.

    It has the nodes in the order of discovery, the predecessor and entry mesh of each node (-1 for a root), and the
    speeds.
    """

    order: list[int]
    parent: list[int]
    entry: list[int]
    speed: list[Gain]
    breaking: dict[int, Gain]
    """Meshes that are inconsistent with the search tree -> factor of inconsistency, from their first node to the
    second.
    """
    chords: list[int]
    """Meshes outside the search tree that are consistent with it; each closes a loop that can turn."""

    def above(self, node: int) -> int | None:
        """Return the predecessor of a node; None for a root."""
        return self.parent[node] if self.parent[node] >= 0 else None

    def loop(self, mesh: int, ends: tuple[int, int]) -> GainLoop:
        """Return the loop that a mesh outside the search tree closes, starting at the common ancestor of its nodes."""
        up, down = ways_to_common_ancestor(*ends, self.above)
        there = [(self.parent[node], self.entry[node]) for node in up[-2::-1]]
        return [*there, (ends[0], mesh), *((node, self.entry[node]) for node in down[:-1])]


def walk_gain_graph(network: GainGraph, without: Collection[int] = (), roots: Sequence[int] = ()) -> GainWalk:
    """Search all nodes breadth first, starting with `roots`, without the meshes `without`."""
    gone = bytearray(len(network.ends))
    for mesh in without:
        gone[mesh] = 1
    size, at, ends, gains = network.size, network.at, network.ends, network.gains
    parent, entry = [-1] * size, [-1] * size
    speeds: list[Gain] = [0] * size  # 0 means not reached
    order: list[int] = []
    done = 0
    for root in (*roots, *range(size)):
        if speeds[root]:
            continue
        speeds[root] = 1
        order.append(root)
        while done < len(order):
            here = order[done]
            done += 1
            for mesh in at[here]:
                if gone[mesh]:
                    continue
                first, second = ends[mesh]
                there = first + second - here
                if not speeds[there]:
                    speeds[there] = speeds[here] * network.gain(mesh, here) if mesh in gains else speeds[here]
                    parent[there], entry[there] = here, mesh
                    order.append(there)
                    gone[mesh] = 1  # tree edge
    breaking: dict[int, Gain] = {}
    chords = []
    for mesh, (first, second) in enumerate(ends):
        if gone[mesh]:
            continue
        gain = gains.get(mesh, 1)
        if speeds[first] * gain == speeds[second]:
            chords.append(mesh)
        else:
            breaking[mesh] = speeds[first] * gain * inverse(speeds[second])
    return GainWalk(order, parent, entry, speeds, breaking, chords)


def is_balanced(network: GainGraph, without: Collection[int] = ()) -> bool:
    """Return whether every loop has gain product 1 after removal of the meshes `without`."""
    return not walk_gain_graph(network, without).breaking


def single_mesh_removals(network: GainGraph, found: GainWalk) -> list[int]:
    """Return every mesh whose removal, without others, frees a connected locked network, in linear time.

    Such a mesh lies on every inconsistent loop, so one such loop is taken as a tree path plus its chord. The tree path
    of any other chord covers an interval of that path. A mesh of the path frees the network if every inconsistent chord
    covers it, all with the same factor, and no consistent chord covers it.
    """
    if not found.breaking:
        return []
    chord = next(iter(found.breaking))
    path = tree_path(*network.ends[chord], found.above)
    anchors = _anchors(found, path)
    # each chord covers an interval of the path: +1 at its start, -1 at its end; prefix sums count covering chords
    opened, agreed, amounts = [0] * (len(path) + 1), [0] * (len(path) + 1), set()
    for mesh, amount in found.breaking.items():
        low, high = (anchors[end] for end in network.ends[mesh])
        amounts.add(amount if low < high else inverse(amount))
        opened[min(low, high)] += 1
        opened[max(low, high)] -= 1
    for mesh in found.chords:
        low, high = sorted(anchors[end] for end in network.ends[mesh])
        agreed[low] += 1
        agreed[high] -= 1
    singles = [chord] if len(found.breaking) == 1 else []
    open_here = agreed_here = 0
    for at, (first, second) in enumerate(pairwise(path)):
        open_here, agreed_here = open_here + opened[at], agreed_here + agreed[at]
        if open_here == len(found.breaking) and not agreed_here and len(amounts) == 1:
            singles.append(found.entry[first] if found.parent[first] == second else found.entry[second])
    return [mesh for mesh in singles if mesh not in network.firm]


def _anchors(found: GainWalk, path: Sequence[int]) -> list[int]:
    """Return for each node the position on `path` at which its tree path reaches it."""
    anchors = [-1] * len(found.order)
    for at, node in enumerate(path):
        anchors[node] = at
    # the node of the path nearest the root, through which all nodes outside its subtrees are reached
    top = next(at for at, node in enumerate(path) if found.parent[node] not in path[max(0, at - 1) : at + 2])
    for node in found.order:
        if anchors[node] < 0:
            parent = found.parent[node]
            anchors[node] = anchors[parent] if parent >= 0 else top
    return anchors


def biconnected_blocks(network: GainGraph) -> list[list[int]]:
    """Return the meshes of each biconnected component, by the algorithm of Hopcroft and Tarjan (1973) without
    recursion.
    """
    # depth-first number of each node, and the lowest number that its subtree reaches by one back edge
    order, low = [0] * network.size, [0] * network.size
    used = bytearray(len(network.ends))
    found: list[list[int]] = []
    pending: list[int] = []
    count = 0
    for root in range(network.size):
        if order[root]:
            continue
        count += 1
        order[root] = low[root] = count
        stack = [(root, iter(network.at[root]), 0)]
        while stack:
            here, meshes, start = stack[-1]
            for mesh in meshes:
                if used[mesh]:
                    continue
                used[mesh] = 1
                there = network.other(mesh, here)
                # back edge
                if order[there]:
                    pending.append(mesh)
                    low[here] = min(low[here], order[there])
                    continue
                count += 1
                order[there] = low[there] = count
                stack.append((there, iter(network.at[there]), len(pending)))
                pending.append(mesh)
                break
            else:
                stack.pop()
                if stack:
                    above = stack[-1][0]
                    low[above] = min(low[above], low[here])
                    # no back edge leaves the subtree: the node above separates it, and its meshes are a block
                    if low[here] >= order[above]:
                        found.append(pending[start:])
                        del pending[start:]
    return found


def shortest_loop(
    network: GainGraph, without: Collection[int] = (), starts: Sequence[int] | None = None
) -> GainLoop | None:
    """Return a shortest inconsistent loop through one of the nodes `starts`, by default any node; None if there is
    none.
    """
    best: GainLoop | None = None
    for start in range(network.size) if starts is None else starts:
        loop = _loop_through(network, without, start, len(best) if best else 2 * network.size + 1)
        if loop is not None and (best is None or len(loop) < len(best)):
            best = loop
            if len(best) == 2:  # the shortest possible loop
                break
    return best


def _loop_through(network: GainGraph, without: Collection[int], start: int, below: int) -> GainLoop | None:
    """Return an inconsistent loop with fewer than `below` meshes, by breadth-first search from `start`; None if there
    is none.
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
        return None
    here, mesh, there = best
    up, down = ways_to_common_ancestor(here, there, lambda node: came[node][0] if node in came else None)
    return [*(came[node] for node in up[-2::-1]), (here, mesh), *((node, came[node][1]) for node in down[:-1])]
