"""Which meshes to disengage: one where one is enough, a least set where that can be proved, else a good one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from geartrain.kinematics.gridlock.branch_and_bound import (
    OverBudgetError,
    disjoint_loops,
    greedy_removal,
    minimal_removal,
)
from geartrain.kinematics.gridlock.gain_graph import (
    GainGraph,
    GainLoop,
    GainWalk,
    biconnected_blocks,
    is_balanced,
    shortest_loop,
    single_mesh_removals,
    walk_gain_graph,
)
from geartrain.kinematics.gridlock.planar_matching import planar_removal
from geartrain.kinematics.gridlock.removal import RemovalMethod, weakest_method

SMALL = 20
"""Meshes of a block up to which branch and bound always ends with a least set."""
LARGE = 10_000
"""Meshes of a component past which only one mesh, or a greedy set, is looked for."""
_MEDIUM = 300  # nodes, or meshes, up to which a loop is looked for from everywhere: that costs their square
_SEARCHED = 100  # meshes of a block up to which branch and bound is tried
_BRANCHES = 20_000  # times meshes: a second or two


class LoopPacking(NamedTuple):
    """Loops that do not close, each mesh on at most `sharing` of them: so many over `sharing` meshes must go."""

    loops: list[GainLoop]
    sharing: int

    @property
    def at_least(self) -> int:
        """How many meshes must go at least."""
        return -(-len(self.loops) // self.sharing)


class RemovalChoice(NamedTuple):
    """Meshes that free a network.

    at_least   a proved lower bound; a set of that size is least
    choices    for a single mesh: all that would do
    bounds     what proves the bound, where loops do
    """

    meshes: list[int]
    method: RemovalMethod
    at_least: int
    choices: list[int]
    bounds: list[LoopPacking]


def choose_removal(network: GainGraph, found: GainWalk) -> RemovalChoice:
    """The meshes to disengage in a connected network that does not turn; `found` is a walk through it."""
    singles = single_mesh_removals(network, found)
    if singles:
        loop = LoopPacking([open_loop(network, found)], 1)
        return RemovalChoice(sorted(singles)[:1], "one", 1, sorted(singles), [loop])
    if len(network.ends) > LARGE:
        meshes, loops = greedy_removal(network, found)
        return _greedy(meshes, LoopPacking(loops or [open_loop(network, found)], 1))
    choices = []
    for block in biconnected_blocks(network):
        part, nodes = network.part(block)
        if not is_balanced(part):
            choices.append(_placed(_choose_in_block(part), block, nodes))
    return _joined(choices)


def open_loop(network: GainGraph, found: GainWalk) -> GainLoop:
    """A short loop that does not close: a shortest one in all but large networks."""
    if network.size <= _MEDIUM:
        starts: Sequence[int] = range(network.size)
        best = None
    else:
        # the loop shown is an example: of very many chords the first are enough to find a short one
        chords = list(found.breaking)[:200]
        best = min((found.loop(chord, network.ends[chord]) for chord in chords), key=len)
        starts = [node for node, _ in best[: 1 + 5000 // len(best)]]  # a way round each of them costs its length
    loop = shortest_loop(network, (), starts)
    return loop if loop is not None and (best is None or len(loop) <= len(best)) else best or []


def _choose_in_block(block: GainGraph) -> RemovalChoice:
    """A least set for one block if it is small, or planar with signs only; else the best of what is tried."""
    found = walk_gain_graph(block)
    singles = single_mesh_removals(block, found)
    if singles:
        return RemovalChoice(
            sorted(singles)[:1], "one", 1, sorted(singles), [LoopPacking([open_loop(block, found)], 1)]
        )
    plain = GainGraph(block.size, block.ends, found.breaking, block.firm)  # speeds in units of the walk's
    small = len(block.ends) - len(block.firm) <= SMALL
    if not small and all(gain == -1 for gain in found.breaking.values()):
        join = planar_removal(plain)
        if join is not None:
            return RemovalChoice(
                join.meshes, "matching", len(join.meshes), [], _proofs(plain, join.odd, len(join.meshes))
            )
    meshes, loops = greedy_removal(plain, found)
    bound = _bound(plain, loops)
    if bound.at_least == len(meshes) or len(block.ends) > _SEARCHED:
        return _greedy(meshes, bound)
    try:
        # a small block has at most 2**SMALL sets of meshes, far within 10**9: its search always ends
        better = minimal_removal(plain, len(meshes), 10**9 if small else _BRANCHES // len(block.ends))
    except OverBudgetError:
        return _greedy(meshes, bound)
    least = meshes if better is None else better
    return RemovalChoice(sorted(least), "search", len(least), [], [bound] if bound.at_least == len(least) else [])


def _greedy(meshes: list[int], bound: LoopPacking) -> RemovalChoice:
    method: RemovalMethod = "loops" if bound.at_least == len(meshes) else "greedy"
    return RemovalChoice(sorted(meshes), method, bound.at_least, [], [bound])


def _bound(network: GainGraph, loops: list[GainLoop]) -> LoopPacking:
    """The better of two collections of loops without a common mesh."""
    more = disjoint_loops(network) if len(network.ends) <= _MEDIUM else None
    return LoopPacking(max((loops, more or []), key=len), 1)


def _proofs(network: GainGraph, odd: Sequence[GainLoop], least: int) -> list[LoopPacking]:
    """Loops that prove a matching least, if any are found: the odd regions, or loops without a common mesh."""
    apart: list[GainLoop] = []
    used: set[int] = set()
    for loop in sorted(odd, key=len):
        if used.isdisjoint(mesh for _, mesh in loop):
            used.update(mesh for _, mesh in loop)
            apart.append(loop)
    for bound in (LoopPacking(apart, 1), LoopPacking(list(odd), 2)):
        if bound.at_least == least:
            return [bound]
    bound = _bound(network, apart)
    return [bound] if bound.at_least == least else []


def _placed(choice: RemovalChoice, block: Sequence[int], nodes: Sequence[int]) -> RemovalChoice:
    """A block's choice in the numbers of the whole network."""
    bounds = [
        LoopPacking([[(nodes[node], block[mesh]) for node, mesh in loop] for loop in bound.loops], bound.sharing)
        for bound in choice.bounds
    ]
    meshes, choices = ([block[mesh] for mesh in some] for some in (choice.meshes, choice.choices))
    return RemovalChoice(meshes, choice.method, choice.at_least, choices, bounds)


def _joined(choices: Sequence[RemovalChoice]) -> RemovalChoice:
    """The choices of all blocks as one: no loop runs through two blocks, so bounds add up."""
    if len(choices) == 1:
        return choices[0]
    return RemovalChoice(
        sorted(mesh for choice in choices for mesh in choice.meshes),
        weakest_method(choice.method for choice in choices),
        sum(choice.at_least for choice in choices),
        [],
        _merged([bound for choice in choices for bound in choice.bounds]),
    )


def _merged(bounds: Sequence[LoopPacking]) -> list[LoopPacking]:
    """Bounds of several blocks, those of loops without a common mesh as one."""
    apart = [loop for bound in bounds if bound.sharing == 1 for loop in bound.loops]
    return ([LoopPacking(apart, 1)] if apart else []) + [bound for bound in bounds if bound.sharing > 1]
