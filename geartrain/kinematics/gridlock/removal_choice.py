"""Choice of the meshes to disengage: one mesh if it is enough, else a smallest set if it can be proved.

A set of meshes frees a network if it contains a mesh of every inconsistent loop. The smallest such hitting set is an
integer program. Its loops are generated as they are needed: a smallest set for the loops known so far is proved to be
the answer if no inconsistent loop is left, otherwise the remaining short loops are added. The dual program finds loops
that prove the result to a reader: each mesh is in at most one, or in at most two of these loops.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil
from typing import Any, NamedTuple

from geartrain.kinematics.gridlock.gain_graph import (
    GainGraph,
    GainLoop,
    inconsistent_loops,
    is_balanced,
    shortest_loop,
    walk_gain_graph,
)
from geartrain.kinematics.gridlock.removal import RemovalMethod
from geartrain.numerics.graphs import DisjointSets

_ROUNDS = 40  # integer programs, each with more loops than the last
_LIMITED = 3  # of them may exceed a limit
_NODES = 20  # nodes of the branch-and-bound tree of one program
_SECONDS = 1.5  # of one program
_STARTS = 300  # nodes from which the shortest loop is searched; in larger networks only near inconsistent meshes


class RemovalChoice(NamedTuple):
    """Meshes whose removal frees a locked network, with the loops that prove a lower bound on the number of meshes."""

    meshes: list[int]
    method: RemovalMethod
    at_least: int
    """Proved lower bound on the number of meshes; a set with this number of meshes is a smallest set."""
    choices: list[int]
    """Meshes of which the removal of any one is enough, including the mesh in `meshes`; empty if there are none."""
    example: GainLoop
    """Short inconsistent loop, which shows a reader the cause of the lock."""
    proof: list[GainLoop]
    """Loops that prove the lower bound; empty if only the method proves it."""
    sharing: int = 1
    """Maximum number of loops of the proof to which one mesh belongs."""


def choose_removal(network: GainGraph) -> RemovalChoice:
    """Choose the meshes to disengage in a connected locked network."""
    near = (network.ends[mesh][0] for mesh in walk_gain_graph(network).breaking[:_STARTS])
    loop = shortest_loop(network, range(network.size) if network.size <= _STARTS else near)
    # a mesh that is enough belongs to every inconsistent loop
    singles = sorted(mesh for _, mesh in loop if mesh not in network.firm and is_balanced(network, [mesh]))
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
    proof, sharing = next(
        (
            (some, sharing)
            for sharing in (1, 2)
            if ceil(len(some := _packed(network, loops, sharing)) / sharing) == at_least
        ),
        ([], 1),
    )
    method: RemovalMethod = "greedy" if len(meshes) > at_least else "loops" if proof and sharing == 1 else "search"
    return RemovalChoice(meshes, method, at_least, [], loop, proof, sharing)


def _packed(network: GainGraph, loops: Sequence[GainLoop], sharing: int) -> list[GainLoop]:
    """Return as many of the loops as possible such that each mesh belongs to at most `sharing` of them."""
    found = _solve(network, loops, -sharing).x
    return [] if found is None else [loop for loop, part in zip(loops, found, strict=True) if part > 0.5]


def _solve(network: GainGraph, loops: Sequence[GainLoop], sharing: int) -> Any:
    """Solve one of two dual integer programs with variables 0 or 1, whose matrix has a row for each loop.

    sharing   1: the smallest set with a mesh of every loop. -s: the largest set of loops such that every mesh is in at
              most s of them
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
    """Return a minimal set of meshes that frees a connected network, most of them from `gone`: the meshes that
    contradict the speeds of a spanning tree with as few meshes of `gone` and as many firm meshes as possible.
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
