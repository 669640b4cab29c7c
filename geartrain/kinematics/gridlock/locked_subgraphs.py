"""Gridlock of a train: one gain graph for each component that has an inconsistent loop."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from math import ceil, comb
from random import Random
from typing import Any, NamedTuple

from geartrain.kinematics.answer import Loop
from geartrain.kinematics.components import Components, SolvedPart, relevant_circuits
from geartrain.kinematics.gridlock.removal import (
    Gridlock,
    LockedSubgraph,
    MeshRemoval,
    RemovalBound,
    RemovalMethod,
    join_removals,
)
from geartrain.kinematics.speeds import Mobility, find_mobility
from geartrain.numerics.containers import collector_paused
from geartrain.numerics.graphs import DisjointSets, ways_to_common_ancestor

MOST_COUPLED = 2000
"""Maximum number of meshes for which a set of meshes on several carriers is searched; each trial solves the train."""
_ONE_BY_ONE = 200  # maximum number of meshes that are tried one by one
_TRIALS = 3000  # maximum number of sets that are tried


class LockedNetwork(NamedTuple):
    """Gain graph of one component, with its carrier, the link of each node, and the circuit of each mesh (edge)."""

    carrier: str
    links: list[str]
    circuits: list[int]
    network: GainGraph


@collector_paused()
def find_gridlock(part: SolvedPart, mobility: Mobility) -> Gridlock:
    """Find the parts of a train that are locked by its meshes. Brakes, locks, inputs and pin followers are ignored."""
    parts = part.reduced.components
    if not parts.breaking and mobility.by_rank and not mobility.still:
        return Gridlock()
    jams = tuple(_locked_subgraph(parts, jammed) for jammed in find_locked_networks(parts))
    gone = {mesh for jam in jams for mesh in jam.release.meshes}
    ordinary = all(carrier == parts.frame for carrier in parts.node_carrier)  # then components are not coupled
    held = () if ordinary else _locked_links(part, gone)
    if held:
        return Gridlock(jams, held, _coupled_removal(part, gone, sum(jam.release.at_least for jam in jams)))
    return Gridlock(jams, (), join_removals(jam.release for jam in jams) if jams else None)


def find_locked_networks(parts: Components) -> list[LockedNetwork]:
    """Return the gain graph of each component with an inconsistent loop; gains along a spanning tree are 1."""
    size = len(parts.links)
    nodes = zip(parts.node_link, parts.node_carrier, strict=True)
    at = {carrier * size + link: node for node, (link, carrier) in enumerate(nodes)}
    gains: dict[int, Gain] = {}
    for chord in parts.breaking:
        product = parts.closing_product(chord)
        gains[chord] = -1 if product == -1 else product  # integers are faster than Fractions
    groups = dict.fromkeys(parts.group_of(parts.circuits[chord]) for chord in parts.breaking)
    inside: dict[int, tuple[list[int], list[tuple[int, int]], dict[int, int]]] = {
        group: ([], [], {}) for group in groups
    }
    index, group_of = parts.index, parts.node_group
    for circuit, (_, _, i, j, k, _, b, _, _, _, bases) in enumerate(parts.circuits):
        # a follower is not a mesh
        if not b:
            continue
        first, second = bases or (k, k)
        node = at[index[first] * size + index[i]]
        if (here := inside.get(group_of[node])) is not None:
            circuits, ends, number = here
            other = at[index[second] * size + index[j]]
            circuits.append(circuit)
            ends.append((number.setdefault(node, len(number)), number.setdefault(other, len(number))))
    return [
        LockedNetwork(
            parts.links[parts.group_carrier[group]],
            [parts.links[parts.node_link[node]] for node in number],
            circuits,
            GainGraph(
                len(number),
                ends,
                {mesh: gains[circuit] for mesh, circuit in enumerate(circuits) if circuit in gains},
                frozenset(mesh for mesh, circuit in enumerate(circuits) if parts.circuits[circuit].kind != "gear"),
            ),
        )
        for group, (circuits, ends, number) in inside.items()
    ]


def _locked_subgraph(parts: Components, jammed: LockedNetwork) -> LockedSubgraph:
    network = jammed.network
    choice = choose_removal(network)
    meshes, choices = (
        tuple(parts.circuits[jammed.circuits[mesh]].id for mesh in some) for some in (choice.meshes, choice.choices)
    )
    loops = tuple(_loop(parts, jammed, steps) for steps in choice.proof)
    proofs = (RemovalBound(loops, choice.sharing),) if loops else ()
    return LockedSubgraph(
        jammed.carrier,
        _loop(parts, jammed, choice.example),
        tuple(jammed.links),
        len(network.ends) - len(network.firm),
        "sign" if set(network.gains.values()) == {-1} else "ratio",
        MeshRemoval(meshes, choice.method, choice.at_least, choices, proofs),
    )


def _loop(parts: Components, jammed: LockedNetwork, steps: GainLoop) -> Loop:
    return Loop(
        jammed.carrier,
        tuple(jammed.links[node] for node, _ in steps),
        tuple(parts.circuits[jammed.circuits[mesh]].id for _, mesh in steps),
        Fraction(jammed.network.product(steps)),
    )


def _without(part: SolvedPart, gone: Collection[str]) -> SolvedPart:
    circuits = [circuit for circuit in part.circuits if circuit.b and circuit.id not in gone]
    return SolvedPart(part.links, part.frame, circuits, part.first)


def _locked_links(part: SolvedPart, gone: Collection[str]) -> tuple[str, ...]:
    """Return the links at rest without the meshes in `gone`, both with the declared and with random speed ratios."""
    less = _without(part, gone)
    still = _stationary_links(less)
    if not still:
        return ()
    always = set(_stationary_links(_with_random_ratios(less)))
    return tuple(link for link in still if link in always)


def _stationary_links(part: SolvedPart) -> tuple[str, ...]:
    mobility = find_mobility(part.reduced, 0)
    if mobility.by_rank:
        return mobility.still
    return tuple(link for link in part.links if link != part.frame)


def _with_random_ratios(part: SolvedPart) -> SolvedPart:
    """Return the train with random speed ratios for every link and carrier; ratio products of loops are unchanged."""

    def factor(link: str, carrier: str) -> int:
        # large and random, so that no link is at rest by coincidence (Schwartz-Zippel lemma); seeded by name, so that
        # it does not change when meshes are removed
        return Random(f"{link} {carrier}").randrange(10**6, 10**7)

    circuits = [
        circuit._replace(
            # each link's relative speed is multiplied by its own factor, which cancels in the product around a loop
            a=circuit.a * factor(circuit.j, circuit.subtracted[1]),
            b=circuit.b * factor(circuit.i, circuit.subtracted[0]),
        )
        for circuit in part.circuits
    ]
    return SolvedPart(part.links, part.frame, circuits, part.first)


def _frees_train(part: SolvedPart, gone: Collection[str]) -> bool:
    """Return True if every loop is consistent and every link can move after the meshes in `gone` are removed."""
    less = _without(part, gone)
    return not less.reduced.components.breaking and not _locked_links(part, gone)


def _coupled_removal(part: SolvedPart, gone: Collection[str], at_least: int) -> MeshRemoval | None:
    """Return a set of meshes of one or several carriers whose removal frees the train. It is a smallest set if there
    are few meshes; if not, every mesh in it is necessary. Return None if no such set exists, or if there are too many
    meshes to try.
    """
    toothed = _without(part, ())
    bound = {
        circuit.id
        for some in (toothed, _with_random_ratios(toothed))
        for circuit in relevant_circuits(some.circuits, ())
    }
    gears = [circuit.id for circuit in toothed.circuits if circuit.kind == "gear" and circuit.id in bound]
    if len(gears) > MOST_COUPLED or not _frees_train(part, gears):
        return None
    minimum = max(1, at_least)
    if minimum == 1 and len(gears) <= _ONE_BY_ONE:
        singles = [gear for gear in gears if _frees_train(part, {gear})]
        if singles:
            return MeshRemoval((singles[0],), "one", 1, tuple(singles))
        minimum = 2
    needed = _minimal_removal(part, sorted(gears, key=lambda name: name not in gone))
    sizes = range(minimum, len(needed))
    if sum(comb(len(gears), size) for size in sizes) > _TRIALS:
        return MeshRemoval(tuple(needed), "greedy", minimum)
    # exhaustive search for a smaller set, in order of increasing size
    smaller = (some for size in sizes for some in combinations(gears, size) if _frees_train(part, some))
    found = next(smaller, tuple(needed))
    return MeshRemoval(found, "search", len(found))


def _minimal_removal(part: SolvedPart, gears: Sequence[str]) -> list[str]:
    """Return a minimal set of meshes whose removal frees the train; the first meshes in `gears` are preferred."""
    # Removing more meshes never locks a train, so the shortest sufficient prefix of the list is found by bisection. Its
    # last mesh is necessary, and the search continues among the meshes before it.
    needed: list[str] = []
    left = list(gears)
    while not _frees_train(part, needed):
        low, high = 1, len(left)
        while low < high:
            middle = (low + high) // 2
            low, high = (low, middle) if _frees_train(part, [*needed, *left[:middle]]) else (middle + 1, high)
        needed.append(left[low - 1])
        del left[low - 1 :]
    return needed


# Choice of the meshes to disengage: one mesh if it is enough, else a smallest set if it can be proved.
#
# A set of meshes frees a network if it contains a mesh of every inconsistent loop. The smallest such hitting set is an
# integer program. Its loops are generated as they are needed: a smallest set for the loops known so far is proved to be
# the answer if no inconsistent loop is left, otherwise the remaining short loops are added. The dual program finds
# loops that prove the result to a reader: each mesh is in at most one, or in at most two of these loops.


_ROUNDS = 40  # integer programs, each with more loops than the last
_LIMITED = 3  # of them may exceed a limit
_NODES = 20  # nodes of the branch-and-bound tree of one program
_SECONDS = 1.5  # of one program
_STARTS = 300  # nodes from which the shortest loop is searched; in larger networks only near inconsistent meshes


class RemovalChoice(NamedTuple):
    """Meshes whose removal frees a locked network, and the loops that prove a lower bound on their number."""

    meshes: list[int]
    method: RemovalMethod
    at_least: int
    """Proved lower bound on the number of meshes; a set with this number of meshes is a smallest set."""
    choices: list[int]
    """Meshes any one of which can be removed to free the network, including the mesh in `meshes`; empty if several
    meshes must be removed.
    """
    example: GainLoop
    """Short inconsistent loop that is reported as the cause of the lock."""
    proof: list[GainLoop]
    """Loops that prove the lower bound; empty if the bound follows from the search method."""
    sharing: int = 1
    """Maximum number of loops in `proof` to which a single mesh belongs."""


def choose_removal(network: GainGraph) -> RemovalChoice:
    """Return the meshes that are to be disengaged in a connected locked network."""
    near = (network.ends[mesh][0] for mesh in walk_gain_graph(network).breaking[:_STARTS])
    loop = shortest_loop(network, range(network.size) if network.size <= _STARTS else near)
    # a mesh that is enough belongs to every inconsistent loop: without it no other mesh contradicts the speeds
    own = sorted(mesh for _, mesh in loop if mesh not in network.firm)
    singles = [mesh for mesh in own if {mesh}.issuperset(walk_gain_graph(network, [mesh]).breaking)]
    if singles:
        return RemovalChoice(singles[:1], "one", 1, singles, loop, [loop])
    loops: list[GainLoop] = []
    gone: list[int] = []
    at_least, left = 2, _LIMITED
    for _ in range(_ROUNDS):
        more = inconsistent_loops(network, gone)
        if not more:
            break
        loops += more
        found = _solve(network, loops, 1)
        if found.x is None:
            break
        # the solver's bound may exceed an integer by its feasibility tolerance
        at_least = max(at_least, ceil(found.mip_dual_bound - 1e-6))
        gone = [mesh for mesh, part in enumerate(found.x) if part > 0.5]
        # beyond a limit, a smaller set may exist
        left -= found.status != 0
        if left < 0:
            break
    meshes = _completed(network, gone)
    proof: list[GainLoop] = []
    for sharing in (1, 2):
        # a largest subset of the loops in which each mesh belongs to at most `sharing` loops
        chosen = _solve(network, loops, -sharing).x
        packed = [] if chosen is None else [each for each, part in zip(loops, chosen, strict=True) if part > 0.5]
        if ceil(len(packed) / sharing) == at_least:
            proof = packed
            break
    else:
        sharing = 1
    method: RemovalMethod = "greedy" if len(meshes) > at_least else "loops" if proof and sharing == 1 else "search"
    return RemovalChoice(meshes, method, at_least, [], loop, proof, sharing)


def _solve(network: GainGraph, loops: Sequence[GainLoop], sharing: int) -> Any:
    """Return the solution of a binary integer program. If `sharing` is 1, it is the smallest set that contains a mesh
    of every loop. If `sharing` is -1 or -2, it is the largest set of loops in which every mesh belongs to at most one
    or two loops.
    """
    import numpy as np
    from scipy.optimize import Bounds, LinearConstraint, milp
    from scipy.sparse import coo_array

    pairs = [(row, mesh) for row, loop in enumerate(loops) for _, mesh in loop if mesh not in network.firm]
    matrix = coo_array((np.ones(len(pairs)), np.array(pairs).T), shape=(len(loops), len(network.ends))).tocsr()
    rule = LinearConstraint(matrix, 1, np.inf) if sharing > 0 else LinearConstraint(matrix.T, -np.inf, -sharing)
    count = matrix.shape[1 if sharing > 0 else 0]
    limits: Any = {"mip_rel_gap": 0, "node_limit": _NODES, "time_limit": _SECONDS}
    return milp(np.full(count, np.sign(sharing)), integrality=np.ones(count), bounds=Bounds(0, 1), constraints=rule,
                options=limits)  # fmt: skip


def _completed(network: GainGraph, gone: Sequence[int]) -> list[int]:
    """Return a minimal set of meshes whose removal frees a connected network, most of them from `gone`. They are the
    meshes that contradict a spanning tree, which contains meshes that cannot be removed (`firm`) if possible, and
    meshes in `gone` only if necessary.
    """
    tree: DisjointSets[int] = DisjointSets()
    out = set(gone)
    for mesh in sorted(range(len(network.ends)), key=lambda mesh: (mesh not in network.firm, mesh in out)):
        if tree.are_apart(*network.ends[mesh]):
            tree.join(*network.ends[mesh])
            out.discard(mesh)
        elif mesh not in network.firm:
            out.add(mesh)
    return walk_gain_graph(network, out).breaking


Gain = Fraction | int
GainLoop = list[tuple[int, int]]
"""Closed walk in the graph. Each step is given by the node at which it begins and the mesh along which it goes."""


@dataclass(frozen=True)
class GainGraph:
    """Graph with links as nodes 0 to size - 1, and meshes with gains as edges, addressed by index."""

    size: int
    ends: Sequence[tuple[int, int]]
    """Pair of nodes that each mesh connects; several meshes may connect the same two nodes."""
    gains: Mapping[int, Gain]
    """Gain of each mesh whose gain is not 1, by index: speed of its second node over speed of its first node."""
    firm: frozenset[int] = frozenset()
    """Indices of the meshes that are couplings, which cannot be disengaged."""

    @cached_property
    def at(self) -> list[list[int]]:
        """Indices of the meshes at each node."""
        meshes: list[list[int]] = [[] for _ in range(self.size)]
        for mesh, (first, second) in enumerate(self.ends):
            meshes[first].append(mesh)
            meshes[second].append(mesh)
        return meshes

    def gain(self, mesh: int, start: int) -> Gain:
        """Return the gain of a mesh in the direction away from the node `start`."""
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
    """Result of a search in a gain graph: the speed of each node, consistent with a spanning forest, and the meshes
    `breaking` that contradict these speeds.
    """

    speed: list[Gain]
    breaking: list[int]


def walk_gain_graph(network: GainGraph, without: Collection[int] = ()) -> GainWalk:
    """Return the speeds of all nodes along a spanning forest of meshes that are not in `without`, found by
    breadth-first search, and all meshes that contradict these speeds.
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


def inconsistent_loops(network: GainGraph, without: Collection[int]) -> list[GainLoop]:
    """Return a short inconsistent loop for each mesh that contradicts a spanning forest, without duplicates. A shortest
    inconsistent loop of the network is among them, because each inconsistent loop contains one of these meshes.
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
    """Return an inconsistent loop with fewer than `below` meshes by breadth-first search from `start`, or []."""
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
