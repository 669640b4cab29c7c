"""Least sets of meshes by branch and bound, good sets by a greedy forest, and loops that prove a lower bound."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from geartrain.kinematics.gridlock.gain_graph import (
    Gain,
    GainGraph,
    GainLoop,
    GainWalk,
    inverse,
    shortest_loop,
    walk_gain_graph,
)


def disjoint_loops(
    network: GainGraph, without: Collection[int] = (), firm: Collection[int] = ()
) -> list[GainLoop] | None:
    """Loops that do not close and share no mesh but firm ones: each costs a mesh of its own.

    Shortest first. None where a loop consists of firm meshes alone, so that nothing frees it.
    """
    used = set(without)
    loops: list[GainLoop] = []
    while (loop := shortest_loop(network, used)) is not None:
        loose = [mesh for _, mesh in loop if mesh not in firm and mesh not in network.firm]
        if not loose:
            return None
        used.update(loose)
        loops.append(loop)
    return loops


def minimal_removal(network: GainGraph, most: int, budget: int) -> list[int] | None:
    """A least set of meshes that frees the network, of fewer than `most`; None if there is none, `most` being least.

    Branches on the meshes of a shortest loop that does not close: one of them has to go. A bound on what is left
    comes from loops without a common mesh. Raises `OverBudgetError` after `budget` branches.
    """
    return _Search(network, most, budget).run()


class OverBudgetError(Exception):
    """The search took more branches than allowed."""


class _Search:
    """One branch and bound: `best` is the least set so far, `most` its size."""

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
        # each of these loops costs a mesh of its own, so nothing below this branch is smaller than the best
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
            # all sets with this mesh are tried: in what follows it stays, so that no set is tried twice
            kept.add(mesh)
            passed.append(mesh)
        kept.difference_update(passed)


def greedy_removal(network: GainGraph, found: GainWalk) -> tuple[list[int], list[GainLoop]]:
    """Meshes that free the network, none of which could stay, and short loops without a common mesh.

    A forest of gains grows mesh by mesh and keeps what agrees: meshes on no short loop that fails first, those on
    most such loops last. Nodes then move to the speed that most of their meshes ask for.
    """
    suspects, loops = _suspects(network, found)
    tree = [mesh for mesh in found.entry if mesh >= 0]
    last = sorted(suspects, key=lambda mesh: suspects[mesh])
    calm = [mesh for mesh in (*tree, *found.chords, *found.breaking) if mesh not in suspects]
    best: list[int] | None = None
    for order in ([*calm, *last], [*tree, *found.chords, *found.breaking]):
        first = _refused(network, order)
        better = _improved(network, first)
        least = better if len(better) < len(first) else first
        if best is None or len(least) < len(best):
            best = least
    return best or [], loops


def _suspects(network: GainGraph, found: GainWalk, most: int = 64) -> tuple[dict[int, int], list[GainLoop]]:
    """How many loops of two to four meshes that fail each mesh lies on; and such loops without a common mesh.

    A loop that fails contains a mesh with a gain once the walk's speeds are taken as units, so only the
    surroundings of those are looked at; nodes of very many meshes are passed over.
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
    # short loops first, for more of them fit beside each other; then by number, the same on every run
    for meshes_of in sorted(seen, key=lambda some: (len(some), sorted(some))):
        if taken.isdisjoint(meshes_of - network.firm):
            taken |= meshes_of - network.firm
            loops.append(_in_order(network, meshes_of))
    return times, loops


def _short_loops(network: GainGraph, mesh: int, most: int) -> list[GainLoop]:
    """All loops of two, three and four meshes through one mesh."""
    start, end = network.ends[mesh]
    loops: list[GainLoop] = []
    if max(len(network.at[start]), len(network.at[end])) > most:
        return loops
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
        if len(network.at[middle]) > most:
            continue
        for third in network.at[middle]:
            far = network.other(third, middle)
            if far in near and far not in (start, end) and third != second:
                loops.append([(start, mesh), (end, second), (middle, third), (far, near[far])])
    return loops


def _in_order(network: GainGraph, meshes: Collection[int]) -> GainLoop:
    """A loop from the set of its meshes."""
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


def _refused(network: GainGraph, order: Sequence[int]) -> list[int]:
    """Kruskal's forest with gains: the meshes that contradict those before them; firm ones come first."""
    up = list(range(network.size))
    gain: list[Gain] = [1] * network.size  # speed over that of the node above
    refused = []
    for mesh in (*network.firm, *(mesh for mesh in order if mesh not in network.firm)):
        first, second = network.ends[mesh]
        (top, one), (other, two) = _top(up, gain, first), _top(up, gain, second)
        asked = one * network.gains[mesh] if mesh in network.gains else one
        if top != other:
            up[other], gain[other] = top, asked if two == 1 else asked * inverse(two)
        elif asked != two:
            refused.append(mesh)
    return refused


def _top(up: list[int], gain: list[Gain], node: int) -> tuple[int, Gain]:
    """Union-find with path compression: the root above a node, and the node's speed over the root's."""
    chain = []
    while up[node] != node:
        chain.append(node)
        node = up[node]
    total: Gain = 1
    for below in reversed(chain):
        total = total * gain[below]
        up[below], gain[below] = node, total
    return node, total


def _improved(network: GainGraph, refused: Sequence[int]) -> list[int]:
    """Let nodes near refused meshes take the speed most of their meshes ask for, as long as that helps."""
    speed = list(walk_gain_graph(network, refused).speed)
    queue = [node for mesh in refused for node in network.ends[mesh]]
    for here in queue:
        asked: dict[Gain, int] = {}
        for mesh in network.at[here]:
            there = network.other(mesh, here)
            # a firm mesh outvotes all others together
            value = speed[there] * network.gain(mesh, there)
            asked[value] = asked.get(value, 0) + (len(network.ends) if mesh in network.firm else 1)
        best = max(asked, key=lambda value: asked[value])
        # only strictly more votes move a node: the sum of votes that are met grows each time, and the loop ends
        if asked[best] > asked.get(speed[here], 0):
            speed[here] = best
            queue += [network.other(mesh, here) for mesh in network.at[here]]
    held = [mesh for mesh, (i, _) in enumerate(network.ends) if _agrees(network, speed, mesh, i)]
    agreeing = set(held)
    return _refused(network, [*held, *(mesh for mesh in range(len(network.ends)) if mesh not in agreeing)])


def _agrees(network: GainGraph, speed: Sequence[Gain], mesh: int, start: int) -> bool:
    return speed[start] * network.gains.get(mesh, 1) == speed[network.other(mesh, start)]
