"""Short loops of meshing gears that together make all loops, and the weights with which their meshes add up."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.components import Components
from geartrain.numerics.containers import collector_paused
from geartrain.numerics.exact import whole_multiple

Row = Mapping[int, int]
"""Whole weights of meshes."""


class PhaseCycle(NamedTuple):
    """A loop. nodes[k] lies between meshes[k - 1] and meshes[k], nodes[0] after the last mesh.

    weights   whole numbers without a common divisor, with which the equations of the meshes add up to 0 on the left
    """

    nodes: tuple[int, ...]
    meshes: tuple[int, ...]
    weights: tuple[int, ...]

    @property
    def row(self) -> dict[int, int]:
        """The weight of each mesh."""
        return dict(zip(self.meshes, self.weights, strict=True))


_LENGTHS = (4, 6, 8, 12, math.inf)  # meshes of a loop: short ones are looked for first
_PASSES = 8  # over those that wait: a loop taken makes others shorter

_Edges = dict[int, list[tuple[int, int]]]


@collector_paused()
def find_cycle_basis(
    parts: Components, circuits: Sequence[Circuit], ends: Sequence[tuple[int, int]]
) -> list[PhaseCycle]:
    """One loop for each mesh that closes one: the shortest through it and meshes taken before, which ends with it.

    A loop holds its own mesh and none that is taken later, so no loop follows from the others, and they make all.
    """
    groups = {parts.node_group[ends[chord][0]] for chord in parts.closing}
    edges: _Edges = {}
    for node, mesh in enumerate(parts.node_circuit):
        if mesh >= 0 and parts.node_group[node] in groups:
            _join(edges, mesh, node, parts.node_parent[node])
    depth = node_depths(parts)
    # those near the root first: their loops are short, and shorten those of others
    waiting = sorted(parts.closing, key=lambda at: depth[ends[at][0]] + depth[ends[at][1]])
    found: list[PhaseCycle] = []
    for most in _LENGTHS:
        for _ in range(_PASSES):
            later = []
            for chord in waiting:
                i, j = ends[chord]
                way = _shortest(edges, i, j, most - 1)
                if way is None:
                    later.append(chord)
                    continue
                nodes, meshes = way[0], [*way[1], chord]
                found.append(PhaseCycle(tuple(nodes), tuple(meshes), cycle_weights(circuits, ends, nodes, meshes)))
                _join(edges, chord, i, j)
            progress = len(later) < len(waiting)
            waiting = later[::-1]  # what one pass could not reach may follow from the other end
            if not progress or not waiting:
                break
    return found


def node_depths(parts: Components) -> list[int]:
    """Meshes between every node and the root of its component."""
    depth = [-1] * len(parts.node_parent)
    for node in range(len(depth)):
        way = []
        while node >= 0 and depth[node] < 0:
            way.append(node)
            node = parts.node_parent[node]
        level = depth[node] if node >= 0 else -1
        for below, back in enumerate(reversed(way), 1):
            depth[back] = level + below
    return depth


def _join(edges: _Edges, mesh: int, i: int, j: int) -> None:
    edges.setdefault(i, []).append((mesh, j))
    edges.setdefault(j, []).append((mesh, i))


def _shortest(edges: _Edges, start: int, goal: int, most: float) -> tuple[list[int], list[int]] | None:
    """Nodes and meshes of the shortest way, looked for from both ends; None where it has more than `most` meshes."""
    came: tuple[dict[int, tuple[int, int]], ...] = ({start: (-1, -1)}, {goal: (-1, -1)})
    fronts = [[start], [goal]]
    length = 0
    while (length := length + 1) <= most:
        side = 0 if len(fronts[0]) <= len(fronts[1]) else 1  # the smaller front grows: far fewer nodes are looked at
        fresh = []
        own, other = came[side], came[1 - side]
        for node in fronts[side]:
            for mesh, there in edges[node]:
                if there in other:
                    return _way(came, (node, there) if side == 0 else (there, node), mesh)
                if there not in own:
                    own[there] = (mesh, node)
                    fresh.append(there)
        fronts[side] = fresh
    return None


def _way(came: tuple[dict[int, tuple[int, int]], ...], meet: tuple[int, int], mesh: int) -> tuple[list[int], list[int]]:
    halves: list[tuple[list[int], list[int]]] = []
    for at, reached in zip(meet, came, strict=True):
        nodes, meshes = [at], []
        while reached[nodes[-1]][0] >= 0:
            through, before = reached[nodes[-1]]
            meshes.append(through)
            nodes.append(before)
        halves.append((nodes, meshes))
    (left, first), (right, last) = halves
    return left[::-1] + right, [*first[::-1], mesh, *last]


def cycle_weights(
    circuits: Sequence[Circuit], ends: Sequence[tuple[int, int]], nodes: Sequence[int], meshes: Sequence[int]
) -> tuple[int, ...]:
    """Weights that cancel at every node; that of the last mesh is positive."""
    weights: list[Fraction | int] = [1]
    for node, before, mesh in zip(nodes[1:], meshes, meshes[1:], strict=False):
        came, goes = mesh_coefficient(circuits, ends, before, node), mesh_coefficient(circuits, ends, mesh, node)
        # one wheel in both meshes, by far the most: no Fraction is made
        if abs(came) == abs(goes):
            weights.append(-weights[-1] if came == goes else weights[-1])
        else:
            weights.append(Fraction(-came, goes) * weights[-1])
    sign = -1 if weights[-1] < 0 else 1
    return tuple(sign * weight for weight in whole_multiple(weights))


def mesh_coefficient(circuits: Sequence[Circuit], ends: Sequence[tuple[int, int]], mesh: int, node: int) -> int:
    """The coefficient of a node's angle in the equation of a mesh."""
    return circuits[mesh].a if ends[mesh][0] == node else circuits[mesh].b
