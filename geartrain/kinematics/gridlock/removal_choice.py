"""Choice of the meshes to disengage: one mesh if it is enough, a smallest set if it can be proved, else a minimal set.

Smallest sets are found by branch and bound, good sets by a greedy forest; loops without a common mesh prove a lower
bound. For planar graphs whose gains are signs, the smallest set is found by matching:

A planar graph divides the plane into faces. A set of meshes frees the train if and only if, in the dual
graph, it joins the faces with an odd boundary in pairs, that is, if it is a T-join. The smallest one is a
minimum-weight perfect matching of the odd faces by their distances (Edmonds and Johnson 1973; for signed graphs Katai
and Iwai 1978).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from heapq import heappop, heappush
from typing import TYPE_CHECKING, NamedTuple

from geartrain.kinematics.gridlock.gain_graph import (
    Gain,
    GainGraph,
    GainLoop,
    GainWalk,
    biconnected_blocks,
    inverse,
    is_balanced,
    shortest_loop,
    single_mesh_removals,
    walk_gain_graph,
)
from geartrain.kinematics.gridlock.removal import RemovalMethod, weakest_method

if TYPE_CHECKING:
    import networkx as nx


# ----------------------------------------------------------------------------------------------------- branch and bound


def disjoint_loops(
    network: GainGraph, without: Collection[int] = (), firm: Collection[int] = ()
) -> list[GainLoop] | None:
    """Return inconsistent loops that share only firm meshes; each of them requires the removal of a mesh.

    Shortest loops are chosen first. The result is None if a loop consists of firm meshes only, which cannot be removed.
    """
    used = set(without)
    loops: list[GainLoop] = []
    while (loop := shortest_loop(network, used)) is not None:
        # firm meshes stay in later searches: they can be in several loops
        loose = [mesh for _, mesh in loop if mesh not in firm and mesh not in network.firm]
        if not loose:
            return None
        used.update(loose)
        loops.append(loop)
    return loops


def minimal_removal(network: GainGraph, most: int, budget: int) -> list[int] | None:
    """Return a smallest set of fewer than `most` meshes whose removal frees the network, by branch and bound; else
    None.

    The algorithm branches on the meshes of a shortest inconsistent loop, one of which must be removed. The
    lower bound on the remaining removals is the number of loops without a common mesh. Raises `OverBudgetError` after
    `budget` branches.
    """
    return _BranchAndBound(network, most, budget).run()


class OverBudgetError(Exception):
    """Branch and bound exceeded its maximum number of branches."""


class _BranchAndBound:
    """State of a branch-and-bound search: `best` is the smallest set found so far, `most` its size."""

    def __init__(self, network: GainGraph, most: int, budget: int) -> None:
        self.network, self.most, self.budget = network, most, budget
        self.best: list[int] | None = None

    def run(self) -> list[int] | None:
        self._branch([], set())
        return self.best

    def _branch(self, gone: list[int], kept: set[int]) -> None:
        self.budget -= 1
        if self.budget < 0:
            raise OverBudgetError
        loops = disjoint_loops(self.network, gone, kept)
        # each of these disjoint loops requires one removal, so this branch cannot improve the best set
        if loops is None or len(gone) + len(loops) >= self.most:
            return
        if not loops:
            self.best, self.most = list(gone), len(gone)
            return
        passed = []
        for _, mesh in loops[0]:
            if mesh in kept or mesh in self.network.firm:
                continue
            self._branch([*gone, mesh], kept)
            # all sets with this mesh have been tried; it is kept in what follows, so that no set is tried twice
            kept.add(mesh)
            passed.append(mesh)
        kept.difference_update(passed)


def greedy_removal(network: GainGraph, found: GainWalk) -> tuple[list[int], list[GainLoop]]:
    """Return a minimal set of meshes whose removal frees the network, and short loops without a common mesh.

    Meshes are added to a spanning forest one by one if they are consistent with it: first meshes on no short
    inconsistent
    loop, last the meshes on most such loops. A local search then improves the set.
    """
    suspects, loops = _inconsistent_loop_counts(network, found)
    tree = [mesh for mesh in found.entry if mesh >= 0]
    last = sorted(suspects, key=lambda mesh: suspects[mesh])
    calm = [mesh for mesh in (*tree, *found.chords, *found.breaking) if mesh not in suspects]
    best: list[int] | None = None
    # two orders, because neither is always better
    for order in ([*calm, *last], [*tree, *found.chords, *found.breaking]):
        first = _inconsistent_meshes(network, order)
        better = _local_search(network, first)
        minimum = better if len(better) < len(first) else first
        if best is None or len(minimum) < len(best):
            best = minimum
    return best or [], loops


def _inconsistent_loop_counts(
    network: GainGraph, found: GainWalk, most: int = 64
) -> tuple[dict[int, int], list[GainLoop]]:
    """Return the number of inconsistent loops of two to four meshes that contain each mesh, and disjoint loops among
    them.

    An inconsistent loop contains a mesh with a gain other than 1 if speeds are in the units of the search, so only the
    neighbourhood of such meshes is searched. Nodes with more than `most` meshes are skipped.
    """
    times: dict[int, int] = {}
    loops: list[GainLoop] = []
    taken: set[int] = set()
    seen: set[frozenset[int]] = set()
    for mesh in found.breaking:
        for loop in _short_loops(network, mesh, most):
            meshes = frozenset(step for _, step in loop)
            if meshes in seen or network.product(loop) == 1:
                continue
            seen.add(meshes)
            for step in meshes:
                times[step] = times.get(step, 0) + 1
    # short loops first, because more of them can be disjoint; then by number, for reproducible results
    for meshes_of in sorted(seen, key=lambda some: (len(some), sorted(some))):
        if taken.isdisjoint(meshes_of - network.firm):
            taken |= meshes_of - network.firm
            loops.append(_in_order(network, meshes_of))
    return times, loops


def _short_loops(network: GainGraph, mesh: int, most: int) -> list[GainLoop]:
    """Return all loops of two, three and four meshes through one mesh."""
    start, end = network.ends[mesh]
    loops: list[GainLoop] = []
    if max(len(network.at[start]), len(network.at[end])) > most:
        return loops
    # neighbours of the start, from which the last mesh of a loop returns to it
    near = {network.other(last, start): last for last in network.at[start] if last != mesh}
    for second in network.at[end]:
        middle = network.other(second, end)
        if second == mesh:
            continue
        if middle == start:
            loops.append([(start, mesh), (end, second)])
            continue
        if middle in near:
            loops.append([(start, mesh), (end, second), (middle, near[middle])])
        # loops of four meshes through nodes with many meshes are skipped to bound the cost
        if len(network.at[middle]) > most:
            continue
        for third in network.at[middle]:
            far = network.other(third, middle)
            if far in near and far not in (start, end) and third != second:
                loops.append([(start, mesh), (end, second), (middle, third), (far, near[far])])
    return loops


def _in_order(network: GainGraph, meshes: Collection[int]) -> GainLoop:
    """Return the meshes of a loop in the order in which they follow each other."""
    left = sorted(meshes)
    first = left.pop(0)
    loop: GainLoop = [(network.ends[first][0], first)]
    here = network.ends[first][1]
    while left:
        mesh = next(mesh for mesh in left if here in network.ends[mesh])
        left.remove(mesh)
        loop.append((here, mesh))
        here = network.other(mesh, here)
    return loop


def _inconsistent_meshes(network: GainGraph, order: Sequence[int]) -> list[int]:
    """Return the meshes that are inconsistent with earlier ones in a spanning forest (Kruskal's algorithm); firm meshes
    are first.
    """
    up = list(range(network.size))
    gain: list[Gain] = [1] * network.size  # speed divided by that of the parent node
    refused = []
    for mesh in (*network.firm, *(mesh for mesh in order if mesh not in network.firm)):
        first, second = network.ends[mesh]
        (top, one), (other, two) = _root(up, gain, first), _root(up, gain, second)
        requested = one * network.gains[mesh] if mesh in network.gains else one
        if top != other:
            up[other], gain[other] = top, requested if two == 1 else requested * inverse(two)
        elif requested != two:
            refused.append(mesh)
    return refused


def _root(up: list[int], gain: list[Gain], node: int) -> tuple[int, Gain]:
    """Return the root of a node, and the node's speed over the root's speed (union-find with path compression)."""
    chain = []
    while up[node] != node:
        chain.append(node)
        node = up[node]
    total: Gain = 1
    # path compression from the root downwards
    for below in reversed(chain):
        total = total * gain[below]
        up[below], gain[below] = node, total
    return node, total


def _local_search(network: GainGraph, refused: Sequence[int]) -> list[int]:
    """Return a smaller or equal removal found by local search: nodes take the speed for which most of their meshes are
    consistent.
    """
    speed = list(walk_gain_graph(network, refused).speed)
    queue = [node for mesh in refused for node in network.ends[mesh]]
    for here in queue:
        requested: dict[Gain, int] = {}
        for mesh in network.at[here]:
            there = network.other(mesh, here)
            # a firm mesh has more weight than all others together
            value = speed[there] * network.gain(mesh, there)
            requested[value] = requested.get(value, 0) + (len(network.ends) if mesh in network.firm else 1)
        best = max(requested, key=lambda value: requested[value])
        # only a strict majority moves a node: the number of consistent meshes grows each time, so the loop ends
        if requested[best] > requested.get(speed[here], 0):
            speed[here] = best
            queue += [network.other(mesh, here) for mesh in network.at[here]]
    held = [mesh for mesh, (i, _) in enumerate(network.ends) if _is_consistent(network, speed, mesh, i)]
    agreeing = set(held)
    return _inconsistent_meshes(network, [*held, *(mesh for mesh in range(len(network.ends)) if mesh not in agreeing)])


def _is_consistent(network: GainGraph, speed: Sequence[Gain], mesh: int, start: int) -> bool:
    return speed[start] * network.gains.get(mesh, 1) == speed[network.other(mesh, start)]


# ------------------------------------------------------------------------------------------------------ planar matching


MOST_ODD = 300
"""Maximum number of odd faces for matching; its run time grows with the cube of their number."""


class TJoin(NamedTuple):
    """Meshes to remove, and the boundaries of the odd faces (empty if several meshes connect the same nodes)."""

    meshes: list[int]
    odd: list[GainLoop]


def planar_removal(network: GainGraph, most_odd: int = MOST_ODD) -> TJoin | None:
    """Return a smallest removal for one block with gains 1 and -1; None if it is not planar or has too many odd
    faces.
    """
    import networkx as nx

    nodes = _merged_edges(network)
    bundles = _bundles(network, nodes)
    graph: nx.Graph[int] = nx.Graph()
    graph.add_edges_from(bundles)
    planar, drawing = nx.check_planarity(graph)
    if not planar or not isinstance(drawing, nx.PlanarEmbedding):
        return None
    faces = _faces(drawing)
    # the boundary of each face has the product -1 or 1; a loop is inconsistent if it encloses an odd number of -1
    odd = [at for at, face in enumerate(faces) if _is_odd(bundles, face)]
    if len(odd) > most_odd:
        return None
    signs = _signs(bundles, _minimum_join(bundles, faces, odd))
    speed = [sign * signs.get(node, 1) for node, sign in nodes]
    gone = [mesh for mesh, (i, j) in enumerate(network.ends) if speed[i] * network.gains.get(mesh, 1) != speed[j]]
    simple = not network.firm and len(bundles) == len(network.ends)
    between = {pair: mesh for mesh, (i, j) in enumerate(network.ends) for pair in ((i, j), (j, i))}
    loops = [[(step[0], between[step]) for step in _steps(faces[at])] for at in odd] if simple else []
    return TJoin(gone, loops)


def _merged_edges(network: GainGraph) -> list[tuple[int, Gain]]:
    """Return for each node its representative and relative sign; nodes that firm meshes connect have one
    representative.
    """
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
    """Return for each pair of adjacent nodes the number of meshes with gain 1 minus the number with gain -1, if not 0.

    For a given relative sense of two nodes, the meshes of the other sign must be removed. The difference is the number
    of
    additional removals if the sense is changed.
    """
    bundles: dict[Pair, int] = {}
    for mesh, (i, j) in enumerate(network.ends):
        (first, one), (second, two) = nodes[i], nodes[j]
        if first != second:
            pair = (min(first, second), max(first, second))
            bundles[pair] = bundles.get(pair, 0) + (1 if one * network.gains.get(mesh, 1) == two else -1)
    return {pair: surplus for pair, surplus in bundles.items() if surplus}


def _faces(drawing: nx.PlanarEmbedding[int]) -> list[list[int]]:
    seen: set[Pair] = set()
    return [
        drawing.traverse_face(first, second, seen) for first, second in drawing.edges if (first, second) not in seen
    ]


def _steps(face: Sequence[int]) -> list[Pair]:
    return list(zip(face, [*face[1:], face[0]], strict=True))


def _is_odd(bundles: dict[Pair, int], face: Sequence[int]) -> bool:
    """Return whether the boundary of a face has an odd number of negative entries in `bundles`."""
    return sum(bundles[min(step), max(step)] < 0 for step in _steps(face)) % 2 == 1


def _signs(bundles: dict[Pair, int], join: set[Pair]) -> dict[int, int]:
    """Return the sign of every node for which all bundles outside `join` are consistent."""
    near: dict[int, list[tuple[int, int]]] = {}
    for (one, two), surplus in bundles.items():
        # pairs of nodes in the join have the relative sense of the minority of their meshes
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


def _minimum_join(bundles: dict[Pair, int], faces: Sequence[Sequence[int]], odd: Sequence[int]) -> set[Pair]:
    """Return the node pairs crossed by a minimum T-join of the odd faces in the dual graph."""
    import networkx as nx

    side = {step: at for at, face in enumerate(faces) for step in _steps(face)}
    dual: list[list[tuple[int, int, Pair]]] = [[] for _ in faces]
    for pair, surplus in bundles.items():
        one, two = side[pair], side[pair[1], pair[0]]
        if one != two:
            dual[one].append((two, abs(surplus), pair))  # weight: number of meshes to remove when the bundle is crossed
            dual[two].append((one, abs(surplus), pair))
    ways = {start: _shortest_paths(dual, start) for start in odd}
    graph: nx.Graph[int] = nx.Graph()
    graph.add_weighted_edges_from(
        (one, two, ways[one][0][two]) for at, one in enumerate(odd) for two in odd[at + 1 :] if two in ways[one][0]
    )
    join: set[Pair] = set()
    for one, two in nx.min_weight_matching(graph):
        # paths that share a bundle cancel there: the join is their symmetric difference
        came = ways[one][1]
        while two != one:
            two, pair = came[two]
            join ^= {pair}
    return join


def _shortest_paths(
    dual: Sequence[Sequence[tuple[int, int, Pair]]], start: int
) -> tuple[dict[int, int], dict[int, tuple[int, Pair]]]:
    """Return distances from one face by Dijkstra's algorithm, and the predecessor face and crossed node pair of each
    face.
    """
    done: dict[int, int] = {}
    came: dict[int, tuple[int, Pair]] = {}
    near = {start: 0}
    queue = [(0, start)]
    while queue:
        distance, here = heappop(queue)
        # an outdated entry of the heap
        if here in done:
            continue
        done[here] = distance
        for there, weight, pair in dual[here]:
            if there not in done and distance + weight < near.get(there, distance + weight + 1):
                near[there], came[there] = distance + weight, (here, pair)
                heappush(queue, (distance + weight, there))
    return done, came


# ------------------------------------------------------------------------------------------------------- removal choice


SMALL = 20
"""Maximum number of meshes in a block for which branch and bound always finds a minimum set of meshes to remove."""
LARGE = 10_000
"""Number of meshes of a component above which only a single mesh or a greedy set is searched."""
_MEDIUM = 300  # nodes or meshes up to which loops are searched from every node, at quadratic cost
_SEARCHED = 100  # meshes of a block up to which branch and bound is tried
_BRANCHES = 20_000  # branches times meshes, one or two seconds


class LoopPacking(NamedTuple):
    """Inconsistent loops such that each mesh is in at most `sharing` of them; they prove a lower bound on removals."""

    loops: list[GainLoop]
    sharing: int

    @property
    def at_least(self) -> int:
        """Lower bound on the number of meshes to remove: number of loops over `sharing`, rounded up."""
        return -(-len(self.loops) // self.sharing)


class RemovalChoice(NamedTuple):
    """Choice of meshes whose removal frees a network, with its proof."""

    meshes: list[int]
    method: RemovalMethod
    at_least: int
    """Proved lower bound on the number of meshes; a set of this size is a smallest one."""
    choices: list[int]
    """Alternatives to `meshes`, if a single mesh is enough."""
    bounds: list[LoopPacking]
    """Loops that prove the lower bound; empty if only the method proves it."""


def choose_removal(network: GainGraph, found: GainWalk) -> RemovalChoice:
    """Choose the meshes to disengage in a connected locked network; `found` is the result of a search through it."""
    singles = single_mesh_removals(network, found)
    if singles:
        loop = LoopPacking([open_loop(network, found)], 1)
        return RemovalChoice(sorted(singles)[:1], "one", 1, sorted(singles), [loop])
    # searches for shortest loops would take quadratic time
    if len(network.ends) > LARGE:
        meshes, loops = greedy_removal(network, found)
        return _greedy(meshes, LoopPacking(loops or [open_loop(network, found)], 1))
    choices = []
    # a loop lies in one block, so blocks are solved separately
    for block in biconnected_blocks(network):
        part, nodes = network.part(block)
        if not is_balanced(part):
            choices.append(_with_network_indices(_choose_in_block(part), block, nodes))
    return _combined(choices)


def open_loop(network: GainGraph, found: GainWalk) -> GainLoop:
    """Return a short inconsistent loop; it is a shortest one except in large networks."""
    if network.size <= _MEDIUM:
        starts: Sequence[int] = range(network.size)
        best = None
    else:
        # the loop is only an example, so the first chords are enough to find a short one
        chords = list(found.breaking)[:200]
        best = min((found.loop(chord, network.ends[chord]) for chord in chords), key=len)
        starts = [
            node for node, _ in best[: 1 + 5000 // len(best)]
        ]  # bounds the cost, which is proportional to the length of the loop for each start
    loop = shortest_loop(network, (), starts)
    return loop if loop is not None and (best is None or len(loop) <= len(best)) else best or []


def _choose_in_block(block: GainGraph) -> RemovalChoice:
    """Return a smallest removal for one block if it is small, or planar with gains 1 and -1; else the best removal
    found.
    """
    found = walk_gain_graph(block)
    singles = single_mesh_removals(block, found)
    if singles:
        return RemovalChoice(
            sorted(singles)[:1], "one", 1, sorted(singles), [LoopPacking([open_loop(block, found)], 1)]
        )
    plain = GainGraph(block.size, block.ends, found.breaking, block.firm)  # speeds in the units of the search
    small = len(block.ends) - len(block.firm) <= SMALL
    if not small and all(gain == -1 for gain in found.breaking.values()):
        join = planar_removal(plain)
        if join is not None:
            return RemovalChoice(
                join.meshes, "matching", len(join.meshes), [], _loop_proofs(plain, join.odd, len(join.meshes))
            )
    meshes, loops = greedy_removal(plain, found)
    bound = _better_packing(plain, loops)
    if bound.at_least == len(meshes) or len(block.ends) > _SEARCHED:
        return _greedy(meshes, bound)
    try:
        # a small block has at most 2**SMALL sets of meshes, far below 10**9, so its search always ends
        better = minimal_removal(plain, len(meshes), 10**9 if small else _BRANCHES // len(block.ends))
    except OverBudgetError:
        return _greedy(meshes, bound)
    minimum = meshes if better is None else better
    return RemovalChoice(sorted(minimum), "search", len(minimum), [], [bound] if bound.at_least == len(minimum) else [])


def _greedy(meshes: list[int], bound: LoopPacking) -> RemovalChoice:
    method: RemovalMethod = "loops" if bound.at_least == len(meshes) else "greedy"
    return RemovalChoice(sorted(meshes), method, bound.at_least, [], [bound])


def _better_packing(network: GainGraph, loops: list[GainLoop]) -> LoopPacking:
    """Return the larger of two collections of loops without a common mesh as a lower bound."""
    more = disjoint_loops(network) if len(network.ends) <= _MEDIUM else None
    return LoopPacking(max((loops, more or []), key=len), 1)


def _loop_proofs(network: GainGraph, odd: Sequence[GainLoop], minimum: int) -> list[LoopPacking]:
    """Return loops that prove a matching to be smallest, if any are found: odd faces, or loops without a common
    mesh.
    """
    apart: list[GainLoop] = []
    used: set[int] = set()
    for loop in sorted(odd, key=len):
        if used.isdisjoint(mesh for _, mesh in loop):
            used.update(mesh for _, mesh in loop)
            apart.append(loop)
    # a mesh of a planar graph is on at most two faces
    for bound in (LoopPacking(apart, 1), LoopPacking(list(odd), 2)):
        if bound.at_least == minimum:
            return [bound]
    bound = _better_packing(network, apart)
    return [bound] if bound.at_least == minimum else []


def _with_network_indices(choice: RemovalChoice, block: Sequence[int], nodes: Sequence[int]) -> RemovalChoice:
    """Return the choice of a block with the indices of the whole network."""
    bounds = [
        LoopPacking([[(nodes[node], block[mesh]) for node, mesh in loop] for loop in bound.loops], bound.sharing)
        for bound in choice.bounds
    ]
    meshes, choices = ([block[mesh] for mesh in some] for some in (choice.meshes, choice.choices))
    return RemovalChoice(meshes, choice.method, choice.at_least, choices, bounds)


def _combined(choices: Sequence[RemovalChoice]) -> RemovalChoice:
    """Combine the choices of all blocks. Their lower bounds are added, because no loop is in two blocks."""
    if len(choices) == 1:
        return choices[0]
    return RemovalChoice(
        sorted(mesh for choice in choices for mesh in choice.meshes),
        weakest_method(choice.method for choice in choices),
        sum(choice.at_least for choice in choices),
        [],
        _merged_bounds([bound for choice in choices for bound in choice.bounds]),
    )


def _merged_bounds(bounds: Sequence[LoopPacking]) -> list[LoopPacking]:
    """Merge the lower bounds of several blocks; bounds by loops without a common mesh are added."""
    apart = [loop for bound in bounds if bound.sharing == 1 for loop in bound.loops]
    return ([LoopPacking(apart, 1)] if apart else []) + [bound for bound in bounds if bound.sharing > 1]
