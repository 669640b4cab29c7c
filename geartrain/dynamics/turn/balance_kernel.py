"""The balance of torques block by block as a kernel: what `position_balance` does where one pattern balances."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.torques.flow_patterns import NEAR
from geartrain.dynamics.turn.position_balance import SAME, SINGULAR
from geartrain.dynamics.turn.turn_arrays import BalanceArrays
from geartrain.numerics.gauss_kernel import solve_in_place
from geartrain.numerics.kernels import kernel

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Ints


class BlockScratch(NamedTuple):
    """Of one unknown: coefficient and value by side, (2, 2, n), and where each side holds."""

    sides: Floats
    ahead: Bools
    back: Bools


@kernel
def solve_blocks(
    balance: BalanceArrays,
    force: Floats,
    barred: Bools,
    size: int,
    torque: Floats,
    values: Floats,
    fine: Bools,
    scratch: BlockScratch,
) -> None:
    """The one solution of the balance, (columns, n), block by block; `fine` is made False where none is, or several.

    torque   known, (rows, n); on return what is left
    """
    for block in range(len(balance.block) - 1):
        first, count = balance.block[block], balance.block[block + 1] - balance.block[block]
        if count == 1:
            _divide(balance, force, barred, first, size, torque, values, fine, scratch)
        else:
            pattern, kept = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=np.int64)
            matrix, tried, best = np.zeros((count, count)), np.zeros(count), np.zeros(count)
            for at in range(size):
                if fine[at]:
                    found = _try_all(balance, force, barred, first, at, torque, pattern, kept, matrix, tried, best)
                    fine[at] = found
                    _write(balance, force, first, at, kept, best, torque, values)


@kernel
def _divide(
    balance: BalanceArrays,
    force: Floats,
    barred: Bools,
    first: int,
    size: int,
    torque: Floats,
    values: Floats,
    fine: Bools,
    scratch: BlockScratch,
) -> None:
    """One row, one unknown: at all positions at once."""
    column, row = balance.column[first], balance.row[first]
    lead, sided = balance.lead[column], balance.sided[column]
    start, end = balance.entry[column], balance.entry[column + 1]
    coefficient, found = scratch.sides[0], scratch.sides[1]
    for side in range(1 + sided):
        own, holds = coefficient[side], scratch.back if side else scratch.ahead
        own[:size] = 0.0
        for entry in range(start, end):
            if balance.entry_row[entry] == row:
                part = balance.entry_part[entry]
                for at in range(size):
                    own[at] += part[0]
                    if lead >= 0:
                        own[at] += part[1] * force[lead, side, 0, at] + part[2] * force[lead, side, 1, at]
        for at in range(size):
            value = 0.0 if torque[row, at] == 0 else -torque[row, at] / own[at]
            holds[at] = np.isfinite(value) and not (sided and value * (1 - 2 * side) < 0)
            if lead >= 0 and value != 0:
                holds[at] = holds[at] and not barred[lead, side, at]
            found[side, at] = value
    for at in range(size):
        ahead, back = scratch.ahead[at], sided and scratch.back[at]
        same = abs(found[1, at] - found[0, at]) <= SAME * abs(found[1, at])
        fine[at] = fine[at] and (ahead or back) and not (ahead and back and not same)
        values[column, at] = found[0, at] if ahead else found[1, at]
    for entry in range(start, end):
        into, part = balance.entry_row[entry], balance.entry_part[entry]
        for at in range(size):
            side = 0 if scratch.ahead[at] or not sided else 1
            own_part = part[0]
            if lead >= 0:
                own_part += part[1] * force[lead, side, 0, at] + part[2] * force[lead, side, 1, at]
            torque[into, at] += own_part * values[column, at]


@kernel
def _entry(balance: BalanceArrays, force: Floats, column: int, entry: int, side: int, at: int) -> float:
    """What a unit of a column does to the row of one of its entries."""
    part, lead = balance.entry_part[entry], balance.lead[column]
    if lead < 0:
        return part[0]  # type: ignore[no-any-return]
    return part[0] + part[1] * force[lead, side, 0, at] + part[2] * force[lead, side, 1, at]  # type: ignore[no-any-return]


@kernel
def _write(
    balance: BalanceArrays,
    force: Floats,
    first: int,
    at: int,
    sides: Ints,
    found: Floats,
    torque: Floats,
    values: Floats,
) -> None:
    """The torques of a block, and what they leave of each row."""
    for own in range(len(found)):
        column = balance.column[first + own]
        values[column, at] = found[own]
        for entry in range(balance.entry[column], balance.entry[column + 1]):
            torque[balance.entry_row[entry], at] += _entry(balance, force, column, entry, sides[own], at) * found[own]


@kernel
def _try_all(
    balance: BalanceArrays,
    force: Floats,
    barred: Bools,
    first: int,
    at: int,
    torque: Floats,
    pattern: Ints,
    kept: Ints,
    matrix: Floats,
    tried: Floats,
    best: Floats,
) -> bool:
    """The one solution of a block of several unknowns among all patterns, into `best`, and its pattern into `kept`."""
    count, more = 0, True
    pattern[:] = 0
    while more:
        _fill(balance, force, first, at, torque, pattern, matrix, tried)
        if not _eliminate(matrix, tried):
            return False
        if _agrees(balance, barred, first, at, pattern, tried):
            if count == 0:
                for own in range(len(pattern)):
                    kept[own], best[own] = pattern[own], tried[own]
                count = 1
            elif not _alike(tried, best):
                return False
        more = _next(balance, first, pattern)
    return count > 0


@kernel
def _fill(
    balance: BalanceArrays,
    force: Floats,
    first: int,
    at: int,
    torque: Floats,
    pattern: Ints,
    matrix: Floats,
    right: Floats,
) -> None:
    """The equations of a block under one pattern."""
    count = len(pattern)
    matrix[:] = 0.0
    for own in range(count):
        right[own] = -torque[balance.row[first + own], at]
        column = balance.column[first + own]
        for entry in range(balance.entry[column], balance.entry[column + 1]):
            for row in range(count):
                if balance.row[first + row] == balance.entry_row[entry]:
                    matrix[row, own] += _entry(balance, force, column, entry, pattern[own], at)


@kernel
def _next(balance: BalanceArrays, first: int, pattern: Ints) -> bool:
    """The next pattern of a block, as numbers count; False after the last."""
    for at in range(len(pattern) - 1, -1, -1):
        if balance.sided[balance.column[first + at]] and pattern[at] == 0:
            pattern[at] = 1
            return True
        pattern[at] = 0
    return False


@kernel
def _agrees(balance: BalanceArrays, barred: Bools, first: int, at: int, pattern: Ints, values: Floats) -> bool:
    """Whether torques have the signs of their pattern, rounding forgiven: equation (7)."""
    most = 0.0
    for value in values:
        most = max(most, abs(value))
    for own in range(len(pattern)):
        column, value = balance.column[first + own], values[own]
        if balance.sided[column] and value * (2 * pattern[own] - 1) > NEAR * most:
            return False
        lead = balance.lead[column]
        if lead >= 0 and barred[lead, pattern[own], at] and abs(value) > NEAR * most:
            return False
    return True


@kernel
def _alike(values: Floats, others: Floats) -> bool:
    most = 0.0
    for value in values:
        most = max(most, abs(value))
    same = True
    for at in range(len(values)):
        same = same and abs(values[at] - others[at]) <= SAME * most
    return same


@kernel
def _eliminate(matrix: Floats, values: Floats) -> bool:
    """Solve in place by Gauss with row pivots; False for a matrix that is nearly singular."""
    lengths: float = 1.0
    for row in range(len(values)):
        square = 0.0
        for column in range(len(values)):
            square += matrix[row, column] * matrix[row, column]
        lengths *= np.sqrt(square)
    return abs(solve_in_place(matrix, values)) > SINGULAR * lengths
