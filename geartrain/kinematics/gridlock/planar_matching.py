"""The least set of meshes that frees a planar set of gears whose loops fail by sign alone.

Drawn in the plane, a mesh graph parts it into regions. A set of meshes frees the train if and only if, in the dual
graph, it joins the regions with an odd loop round them in pairs: a T-join, and the least is a minimum-weight perfect
matching of the odd regions by their distances (Edmonds and Johnson 1973; for signed graphs Katai and Iwai 1978).
"""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heappop, heappush
from typing import TYPE_CHECKING, NamedTuple

from geartrain.kinematics.gridlock.gain_graph import Gain, GainGraph, GainLoop

if TYPE_CHECKING:
    import networkx as nx

MOST_ODD = 300
"""Odd regions up to which all of them are matched: the matching costs the cube of their number."""


class TJoin(NamedTuple):
    """Meshes to take out; and the loops round the odd regions, where no two meshes join the same nodes."""

    meshes: list[int]
    odd: list[GainLoop]


def planar_removal(network: GainGraph, most_odd: int = MOST_ODD) -> TJoin | None:
    """A least set for one block whose gains are signs; None if it is not planar or has too many odd regions."""
    import networkx as nx

    nodes = _merged(network)
    bundles = _bundles(network, nodes)
    graph: nx.Graph[int] = nx.Graph()
    graph.add_edges_from(bundles)
    planar, drawing = nx.check_planarity(graph)
    if not planar or not isinstance(drawing, nx.PlanarEmbedding):
        return None
    faces = _faces(drawing)
    # each region's boundary multiplies to -1 or 1; a loop fails if it encloses an odd number of those with -1
    odd = [at for at, face in enumerate(faces) if _fails(bundles, face)]
    if len(odd) > most_odd:
        return None
    signs = _signs(bundles, _join(bundles, faces, odd))
    speed = [sign * signs.get(node, 1) for node, sign in nodes]
    gone = [mesh for mesh, (i, j) in enumerate(network.ends) if speed[i] * network.gains.get(mesh, 1) != speed[j]]
    simple = not network.firm and len(bundles) == len(network.ends)
    between = {pair: mesh for mesh, (i, j) in enumerate(network.ends) for pair in ((i, j), (j, i))}
    loops = [[(step[0], between[step]) for step in _steps(faces[at])] for at in odd] if simple else []
    return TJoin(gone, loops)


def _merged(network: GainGraph) -> list[tuple[int, Gain]]:
    """Each node's stand-in and its sign against it: nodes that firm meshes join count as one."""
    merged: list[tuple[int, Gain]] = [(node, 1) for node in range(network.size)]
    done: set[int] = set()
    starts = {end for mesh in network.firm for end in network.ends[mesh]}
    for start in sorted(starts):
        queue = [start] if start not in done else []
        done.add(start)
        for here in queue:
            for mesh in network.at[here]:
                there = network.other(mesh, here)
                if mesh in network.firm and there not in done:
                    done.add(there)
                    merged[there] = (merged[here][0], merged[here][1] * network.gain(mesh, here))
                    queue.append(there)
    return merged


Pair = tuple[int, int]


def _bundles(network: GainGraph, nodes: Sequence[tuple[int, Gain]]) -> dict[Pair, int]:
    """For nodes in mesh: how many more of their meshes keep the sense than turn it; balanced ones are left out.

    Whichever way two nodes turn, the fewer have to go; the difference is what a change of sense costs.
    """
    bundles: dict[Pair, int] = {}
    for mesh, (i, j) in enumerate(network.ends):
        (first, one), (second, two) = nodes[i], nodes[j]
        if first != second:
            pair = (min(first, second), max(first, second))
            bundles[pair] = bundles.get(pair, 0) + (1 if one * network.gains.get(mesh, 1) == two else -1)
    return {pair: surplus for pair, surplus in bundles.items() if surplus}


def _faces(drawing: nx.PlanarEmbedding[int]) -> list[list[int]]:
    """The nodes round each region."""
    seen: set[Pair] = set()
    return [
        drawing.traverse_face(first, second, seen) for first, second in drawing.edges if (first, second) not in seen
    ]


def _steps(face: Sequence[int]) -> list[Pair]:
    return list(zip(face, [*face[1:], face[0]], strict=True))


def _fails(bundles: dict[Pair, int], face: Sequence[int]) -> bool:
    """True if an odd number of bundles round a region turn the sense."""
    return sum(bundles[min(step), max(step)] < 0 for step in _steps(face)) % 2 == 1


def _signs(bundles: dict[Pair, int], join: set[Pair]) -> dict[int, int]:
    """The sense of every node, with the sense of all bundles kept but those of the join."""
    near: dict[int, list[tuple[int, int]]] = {}
    for (one, two), surplus in bundles.items():
        sign = -1 if (surplus < 0) != ((one, two) in join) else 1
        near.setdefault(one, []).append((two, sign))
        near.setdefault(two, []).append((one, sign))
    signs: dict[int, int] = {}
    for root in near:
        queue = [root] if root not in signs else []
        signs.setdefault(root, 1)
        for here in queue:
            for there, sign in near[here]:
                if there not in signs:
                    signs[there] = signs[here] * sign
                    queue.append(there)
    return signs


def _join(bundles: dict[Pair, int], faces: Sequence[Sequence[int]], odd: Sequence[int]) -> set[Pair]:
    """The bundles crossed by a minimum T-join of the odd regions."""
    import networkx as nx

    side = {step: at for at, face in enumerate(faces) for step in _steps(face)}
    dual: list[list[tuple[int, int, Pair]]] = [[] for _ in faces]
    for pair, surplus in bundles.items():
        one, two = side[pair], side[pair[1], pair[0]]
        if one != two:
            dual[one].append((two, abs(surplus), pair))  # crossing a bundle costs the meshes that would go
            dual[two].append((one, abs(surplus), pair))
    ways = {start: _ways(dual, start) for start in odd}
    graph: nx.Graph[int] = nx.Graph()
    graph.add_weighted_edges_from(
        (one, two, ways[one][0][two]) for at, one in enumerate(odd) for two in odd[at + 1 :] if two in ways[one][0]
    )
    join: set[Pair] = set()
    for one, two in nx.min_weight_matching(graph):
        # ways that share a bundle cancel there: the join is their symmetric difference
        came = ways[one][1]
        while two != one:
            two, pair = came[two]
            join ^= {pair}
    return join


def _ways(
    dual: Sequence[Sequence[tuple[int, int, Pair]]], start: int
) -> tuple[dict[int, int], dict[int, tuple[int, Pair]]]:
    """Dijkstra: distances from one region, and the region and bundle each was reached by."""
    done: dict[int, int] = {}
    came: dict[int, tuple[int, Pair]] = {}
    near = {start: 0}
    queue = [(0, start)]
    while queue:
        distance, here = heappop(queue)
        if here in done:
            continue
        done[here] = distance
        for there, weight, pair in dual[here]:
            if there not in done and distance + weight < near.get(there, distance + weight + 1):
                near[there], came[there] = distance + weight, (here, pair)
                heappush(queue, (distance + weight, there))
    return done, came
