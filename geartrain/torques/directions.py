"""Who drives whom: the patterns of power flow that balance with losses, found by iteration and checked by trial of all.

The balance is piecewise linear, one piece a pattern. Where all pieces have one orientation there is exactly one
solution; else none (self-locking) or several. Trains with few lossy meshes have all patterns tried, in floats first
and the consistent ones exactly; in longer ones the iteration's answer stands, and says that it was not checked.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, product
from typing import TYPE_CHECKING

from geartrain.torques.balance import Balance, Pattern, Solved, is_consistent, solve_balance

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_MOST_TRIED = 14  # lossy meshes whose patterns are all tried
_FEW = 4  # lossy meshes whose patterns are not worth a trial in floats
_CHUNK = 2048  # patterns tried at once
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
    """Patterns that may be consistent: all of them, or, where the balance is square, those that are so in floats."""
    tied = {name: group[0] for group in ties for name in group}
    leaders = [name for name in lossy if tied.get(name, name) == name]
    every = product((1, -1), repeat=len(leaders))
    while chunk := list(islice(every, _CHUNK)):
        patterns: list[Pattern] = []
        for sides in chunk:
            chosen = dict(zip(leaders, sides, strict=True))
            patterns.append({name: chosen[tied.get(name, name)] for name in lossy})
        yield from patterns if len(leaders) < _FEW or ties else _likely(balance, lossy, patterns)


def _likely(balance: Balance, lossy: Sequence[str], patterns: list[Pattern]) -> Iterator[Pattern]:
    """Patterns whose powers in floats do not contradict them; all of them if one cannot be solved so."""
    import numpy as np

    if balance.size != len(balance.links):
        yield from patterns
        return
    columns = [at for at, mesh in enumerate(balance.meshes) if mesh.id in set(lossy)]
    ahead, back = (_matrix(balance, dict.fromkeys(lossy, side)) for side in (1, -1))
    right = -ahead[:, -1]
    sides = np.array([[pattern[name] for name in lossy] for pattern in patterns])
    matrices = np.repeat(ahead[None, :, :-1], len(patterns), axis=0)
    matrices[:, :, columns] = np.where(sides[:, None, :] > 0, ahead[None, :, columns], back[None, :, columns])
    try:
        found = np.linalg.solve(matrices, right[:, None])[:, :, 0]
    except np.linalg.LinAlgError:
        yield from patterns
        return
    rolling = np.array([float(balance.meshes[at].rolling) for at in columns])
    power = -found[:, columns] * rolling
    against = np.min(power * sides, axis=1) < -_NEAR * np.max(np.abs(power), axis=1)
    yield from (pattern for pattern, bad in zip(patterns, against.tolist(), strict=True) if not bad)


def _matrix(balance: Balance, pattern: Pattern) -> Floats:
    """The balance in floats, known torques in the last column."""
    import numpy as np

    matrix = np.zeros((len(balance.links), balance.size + 1))
    for at, row in enumerate(balance.rows(pattern)):
        for column, value in row.items():
            matrix[at, column] = float(value)
    return matrix
