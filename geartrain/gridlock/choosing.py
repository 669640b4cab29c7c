"""Which meshes to disengage: one where one is enough, a least set where that can be proved, else a good one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from geartrain.gridlock.network import Loop, Network, Walk, blocks, shortest_loop, single_releases, turns, walk
from geartrain.gridlock.planar import planar_set
from geartrain.gridlock.result import Method, weakest
from geartrain.gridlock.searching import OverBudgetError, disjoint_loops, greedy_set, least_set

SMALL = 20
"""Meshes of a block up to which branch and bound always ends with a least set."""
LARGE = 10_000
"""Meshes of a component past which only one mesh, or a greedy set, is looked for."""
_MEDIUM = 300
_SEARCHED = 100
_BRANCHES = 20_000  # times meshes: a second or two


class Bound(NamedTuple):
    """Loops that do not close, each mesh on at most `sharing` of them: so many over `sharing` meshes must go."""

    loops: list[Loop]
    sharing: int

    @property
    def at_least(self) -> int:
        """How many meshes must go at least."""
        return -(-len(self.loops) // self.sharing)


class Choice(NamedTuple):
    """Meshes that free a network.

    at_least   a proved lower bound; a set of that size is least
    choices    for a single mesh: all that would do
    bounds     what proves the bound, where loops do
    """

    meshes: list[int]
    method: Method
    at_least: int
    choices: list[int]
    bounds: list[Bound]


def choose(network: Network, found: Walk) -> Choice:
    """The meshes to disengage in a connected network that does not turn; `found` is a walk through it."""
    singles = single_releases(network, found)
    if singles:
        loop = Bound([witness(network, found)], 1)
        return Choice(sorted(singles)[:1], "one", 1, sorted(singles), [loop])
    if len(network.ends) > LARGE:
        meshes, loops = greedy_set(network, found)
        return _greedy(meshes, Bound(loops or [witness(network, found)], 1))
    choices = []
    for block in blocks(network):
        part, nodes = network.part(block)
        if not turns(part):
            choices.append(_placed(_choose_in_block(part), block, nodes))
    return _joined(choices)


def witness(network: Network, found: Walk) -> Loop:
    """A short loop that does not close: a shortest one in all but large networks."""
    if network.size <= _MEDIUM:
        starts: Sequence[int] = range(network.size)
        best = None
    else:
        chords = list(found.breaking)[:200]
        best = min((found.loop(chord, network.ends[chord]) for chord in chords), key=len)
        starts = [node for node, _ in best[: 1 + 5000 // len(best)]]  # a way round each of them costs its length
    loop = shortest_loop(network, (), starts)
    return loop if loop is not None and (best is None or len(loop) <= len(best)) else best or []


def _choose_in_block(block: Network) -> Choice:
    """A least set for one block if it is small, or planar with signs only; else the best of what is tried."""
    found = walk(block)
    singles = single_releases(block, found)
    if singles:
        return Choice(sorted(singles)[:1], "one", 1, sorted(singles), [Bound([witness(block, found)], 1)])
    plain = Network(block.size, block.ends, found.breaking, block.firm)  # speeds in units of the walk's
    small = len(block.ends) - len(block.firm) <= SMALL
    if not small and all(gain == -1 for gain in found.breaking.values()):
        join = planar_set(plain)
        if join is not None:
            return Choice(join.meshes, "matching", len(join.meshes), [], _proofs(plain, join.odd, len(join.meshes)))
    meshes, loops = greedy_set(plain, found)
    bound = _bound(plain, loops)
    if bound.at_least == len(meshes) or len(block.ends) > _SEARCHED:
        return _greedy(meshes, bound)
    try:
        better = least_set(plain, len(meshes), 10**9 if small else _BRANCHES // len(block.ends))
    except OverBudgetError:
        return _greedy(meshes, bound)
    least = meshes if better is None else better
    return Choice(sorted(least), "search", len(least), [], [bound] if bound.at_least == len(least) else [])


def _greedy(meshes: list[int], bound: Bound) -> Choice:
    method: Method = "loops" if bound.at_least == len(meshes) else "greedy"
    return Choice(sorted(meshes), method, bound.at_least, [], [bound])


def _bound(network: Network, loops: list[Loop]) -> Bound:
    """The better of two collections of loops without a common mesh."""
    more = disjoint_loops(network) if len(network.ends) <= _MEDIUM else None
    return Bound(max((loops, more or []), key=len), 1)


def _proofs(network: Network, odd: Sequence[Loop], least: int) -> list[Bound]:
    """Loops that prove a matching least, if any are found: the odd regions, or loops without a common mesh."""
    apart: list[Loop] = []
    used: set[int] = set()
    for loop in sorted(odd, key=len):
        if used.isdisjoint(mesh for _, mesh in loop):
            used.update(mesh for _, mesh in loop)
            apart.append(loop)
    for bound in (Bound(apart, 1), Bound(list(odd), 2)):
        if bound.at_least == least:
            return [bound]
    bound = _bound(network, apart)
    return [bound] if bound.at_least == least else []


def _placed(choice: Choice, block: Sequence[int], nodes: Sequence[int]) -> Choice:
    """A block's choice in the numbers of the whole network."""
    bounds = [
        Bound([[(nodes[node], block[mesh]) for node, mesh in loop] for loop in bound.loops], bound.sharing)
        for bound in choice.bounds
    ]
    meshes, choices = ([block[mesh] for mesh in some] for some in (choice.meshes, choice.choices))
    return Choice(meshes, choice.method, choice.at_least, choices, bounds)


def _joined(choices: Sequence[Choice]) -> Choice:
    """The choices of all blocks as one: no loop runs through two blocks, so bounds add up."""
    if len(choices) == 1:
        return choices[0]
    return Choice(
        sorted(mesh for choice in choices for mesh in choice.meshes),
        weakest(choice.method for choice in choices),
        sum(choice.at_least for choice in choices),
        [],
        _merged([bound for choice in choices for bound in choice.bounds]),
    )


def _merged(bounds: Sequence[Bound]) -> list[Bound]:
    """Bounds of several blocks, those of loops without a common mesh as one."""
    apart = [loop for bound in bounds if bound.sharing == 1 for loop in bound.loops]
    return ([Bound(apart, 1)] if apart else []) + [bound for bound in bounds if bound.sharing > 1]
