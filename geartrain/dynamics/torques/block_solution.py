"""The torques of one block of the balance, exactly, as linear forms of what is known: numbers, or loads as symbols."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from geartrain.dynamics.torques.torque_balance import TorqueUnknown
from geartrain.numerics.block_triangular import Block
from geartrain.numerics.elimination import Echelon, LinearForm, eliminate

Sides = Mapping[int, int]
"""Column -> the side that drives in it: see `TorqueUnknown`."""

KnownTorques = Mapping[int, LinearForm]
"""Row -> the torques known there, as a form of symbols: columns below 0."""


def eliminate_block(columns: Sequence[TorqueUnknown], block: Block, sides: Sides, known: KnownTorques) -> Echelon:
    """The rows of a block, eliminated over the rationals: equation (3) under one pattern."""
    rows = {row: dict(form) for row, form in known.items()}
    for column in block.columns:
        for row, value in columns[column].pieces[sides[column]].items():
            if row in rows:
                rows[row][column] = value
    return eliminate(rows.values())


def solve_block(
    columns: Sequence[TorqueUnknown], block: Block, sides: Sides, known: KnownTorques
) -> dict[int, LinearForm | None] | None:
    """Every unknown of a block as a form of symbols, None where it stays open; None for all where nothing balances."""
    if len(block.rows) == len(block.columns) == 1:
        # an ordinary train has thousands of such blocks: one division each
        (row,), (column,) = block.rows, block.columns
        if coefficient := columns[column].pieces[sides[column]].get(row):
            return {column: {symbol: -value / coefficient for symbol, value in known[row].items()}}
    echelon = eliminate_block(columns, block, sides, known)
    if echelon.conditions:
        return None
    closed = {column: form for column, form in echelon.forms().items() if all(other < 0 for other in form)}
    return {column: closed.get(column) for column in block.columns}
