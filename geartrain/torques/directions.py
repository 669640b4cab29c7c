"""Who drives whom: the patterns of power flow that balance with losses, found by iteration and checked by trial of all.

The balance is piecewise linear, one piece a pattern. Where all pieces have one orientation there is exactly one
solution; else none (self-locking) or several. Trains with few lossy meshes have all patterns tried, in floats first
and the consistent ones exactly; in longer ones the iteration's answer stands, and says that it was not checked.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from geartrain.torques.balance import Balance, Pattern, Solved, is_consistent, solve_balance

_MOST_TRIED = 12  # lossy meshes whose patterns are all tried
_MOST_ROUNDS = 50
_NEAR = 1e-9  # of the greatest power: a direction this faint may be either


@dataclass(frozen=True)
class Flow:
    """One consistent pattern with its torques."""

    pattern: Pattern
    solved: Solved


def find_flows(balance: Balance, ties: Sequence[Sequence[str]] = ()) -> tuple[tuple[Flow, ...], bool]:
    """All consistent flows, and whether all patterns were tried."""
    lossy = [mesh.id for mesh in balance.meshes if mesh.loses]
    first = _iterate(balance, lossy, ties)
    if len(lossy) > _MOST_TRIED:
        return ((first,) if first else ()), False
    flows = [first] if first else []
    for pattern in _candidates(balance, lossy, ties):
        solved = solve_balance(balance, pattern, ties)
        if solved is not None and is_consistent(balance, pattern, solved):
            flow = Flow(pattern, solved)
            # an idle mesh may be taken either way: the torques are the same
            if all(flow.solved != other.solved for other in flows):
                flows.append(flow)
    return tuple(flows), True


def _iterate(balance: Balance, lossy: Sequence[str], ties: Sequence[Sequence[str]]) -> Flow | None:
    """Begin without losses, and turn round every mesh through which power flows against its direction."""
    pattern: Pattern = {}
    seen: list[Pattern] = []
    for _ in range(_MOST_ROUNDS):
        solved = solve_balance(balance, pattern, ties)
        if solved is None:
            return None
        if pattern and is_consistent(balance, pattern, solved):
            return Flow(pattern, solved)
        power = {mesh.id: mesh.power(solved.multipliers[mesh.id]) for mesh in balance.meshes}
        pattern = {name: -1 if power[name] < 0 else 1 for name in lossy}
        if not lossy:
            return Flow(pattern, solved)
        if pattern in seen:
            return None
        seen.append(pattern)
    return None


def _candidates(balance: Balance, lossy: Sequence[str], ties: Sequence[Sequence[str]]) -> Iterator[Pattern]:
    """Patterns that are consistent in floats, or nearly so."""
    tied = {name: group[0] for group in ties for name in group}
    leaders = [name for name in lossy if tied.get(name, name) == name]
    for sides in product((1, -1), repeat=len(leaders)):
        chosen = dict(zip(leaders, sides, strict=True))
        yield {name: chosen[tied.get(name, name)] for name in lossy}
