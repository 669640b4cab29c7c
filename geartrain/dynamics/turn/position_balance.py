"""The balance of torques at many positions at once, pattern by pattern, block by block (docs/torques.md, section 16).

The order in which torques follow one from another is that of the balance of mean torques (8), and so is the test of a
pattern (7). What differs from position to position are the numbers in it. A block of one pair takes a division; where
several pairs are found together every pattern of theirs is tried at all positions in one array operation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.torques.flow_patterns import NEAR, contradicts

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.numerics.block_triangular import Block

MOST_TRIED = 7  # two-sided torques of a block whose patterns are all tried: 128 small solutions a position
_MOST_ROUNDS = 30  # of the iteration where there are more
_MOST_LAYERS = 16  # solutions kept a position
SINGULAR = 1e-13  # of the product of its rows' lengths: a determinant so small is 0
SAME = 1e-8  # of the greatest torque: solutions so near are one
AT_REST = 1e-12  # of the fastest speed: slower stands still
FAINT = 1e-9  # of the greatest torque through a pair: less presses on no flank
ROUNDS = 6  # of finding flanks and speeds that agree


@dataclass(frozen=True)
class ColumnPieces:
    """What a unit of one unknown torque does to each row, by the sign it has.

    pieces   by side (1 and -1, or 0 where it does not matter), by row: (n,)
    barred   by side, where it must vanish
    """

    pieces: Mapping[int, Mapping[int, Floats]]
    barred: Mapping[int, Bools]

    @property
    def sides(self) -> tuple[int, ...]:
        """The signs that are tried."""
        return tuple(self.pieces)


@dataclass
class BalanceLayer:
    """One solution at each position where there is one.

    values   by column, (columns, n); `rows`, what is left of each row's torque, (rows, n)
    valid    where everything balances
    """

    values: Floats
    rows: Floats
    valid: Bools

    def copy(self) -> BalanceLayer:
        """The same in arrays of its own."""
        return BalanceLayer(self.values.copy(), self.rows.copy(), self.valid.copy())


@dataclass(frozen=True)
class _Trial:
    """The torques of one block under one pattern: (columns, n), where they are consistent, and in which solution."""

    layer: BalanceLayer
    sides: Sequence[int]
    values: Floats
    valid: Bools


def solve_positions(
    columns: Sequence[ColumnPieces], parts: Sequence[Block], known: Floats
) -> tuple[list[BalanceLayer], bool]:
    """Every solution of the balance at every position, and whether all patterns were tried.

    known   torques that are known, by row, (rows, n)
    """
    size = known.shape[1]
    layers = [BalanceLayer(np.zeros((len(columns), size)), known.copy(), np.ones(size, bool))]
    complete = True
    for block in parts:
        trials: list[_Trial] = []
        for layer in layers:
            found, tried = _block_trials(columns, block, layer)
            trials += found
            complete &= tried
        layers = _joined(columns, block, layers, trials)
        complete &= len(layers) <= _MOST_LAYERS
        layers = layers[:_MOST_LAYERS]
    return layers, complete


def _block_trials(columns: Sequence[ColumnPieces], block: Block, layer: BalanceLayer) -> tuple[list[_Trial], bool]:
    """The consistent solutions of one block, no two alike at one position."""
    own = [columns[at] for at in block.columns]
    found: list[_Trial] = []
    two_sided = sum(len(each.sides) > 1 for each in own)
    if two_sided > MOST_TRIED:
        return _iterated(own, block, layer), False
    for sides in product(*(each.sides for each in own)):
        values, valid = _solve(own, block, layer, sides)
        for other in found:
            if (both := valid & other.valid).any():
                near = np.abs(values - other.values) <= SAME * np.max(np.abs(values), axis=0, initial=0.0)
                valid &= ~(both & near.all(axis=0))
        if valid.any():
            found.append(_Trial(layer, sides, values, valid))
    return found, True


def _solve(
    own: Sequence[ColumnPieces], block: Block, layer: BalanceLayer, sides: Sequence[int]
) -> tuple[Floats, Bools]:
    """The torques of a block under one pattern, (columns, n), and where they balance and agree with it."""
    known = layer.rows[list(block.rows)]
    if len(block.rows) == len(block.columns) == 1:
        values, valid = _divided(own[0].pieces[sides[0]].get(block.rows[0]), known)
    else:
        values, valid = _eliminated(own, block, layer, sides)
    valid = valid & layer.valid & ~contradicts(values, np.array(sides)[:, None])
    scale = np.max(np.abs(values), axis=0, initial=0.0)
    for each, side, value in zip(own, sides, values, strict=True):
        if (barred := each.barred.get(side)) is not None:
            valid &= ~(barred & (np.abs(value) > NEAR * scale))
    return values, valid


def _divided(coefficient: Floats | None, known: Floats) -> tuple[Floats, Bools]:
    """One row, one unknown."""
    if coefficient is None:
        return np.zeros_like(known), known[0] == 0
    with np.errstate(divide="ignore", invalid="ignore"):
        values = np.where(known == 0, 0.0, -known / coefficient)
    regular = np.isfinite(values[0])
    return np.where(regular, values, 0.0), regular


def _eliminated(
    own: Sequence[ColumnPieces], block: Block, layer: BalanceLayer, sides: Sequence[int]
) -> tuple[Floats, Bools]:
    """Several rows and unknowns, by LAPACK; where rows are lacking the least torques that balance."""
    known = layer.rows[list(block.rows)]
    scale = np.max(np.abs(layer.values), axis=0, initial=0.0)
    size = known.shape[1]
    matrices = np.zeros((size, len(block.rows), len(block.columns)))
    for column, (each, side) in enumerate(zip(own, sides, strict=True)):
        for row, label in enumerate(block.rows):
            if (piece := each.pieces[side].get(label)) is not None:
                matrices[:, row, column] = piece
    right = -known.T[:, :, None]
    if not block.columns:
        return np.zeros((0, size)), (np.abs(known) <= NEAR * scale).all(axis=0)
    values = np.empty((size, len(block.columns), 1))
    regular = np.zeros(size, bool)
    if len(block.rows) == len(block.columns):
        lengths = np.linalg.norm(matrices, axis=2).prod(axis=1)
        regular = np.abs(np.linalg.det(matrices)) > SINGULAR * lengths
        values[regular] = np.linalg.solve(matrices[regular], right[regular])
    if not regular.all():
        values[~regular] = np.linalg.pinv(matrices[~regular]) @ right[~regular]
    missed = np.abs(matrices @ values - right).max(axis=(1, 2))
    return values[:, :, 0].T, regular | (missed <= NEAR * (np.abs(right).max(axis=(1, 2)) + scale))


def _iterated(own: Sequence[ColumnPieces], block: Block, layer: BalanceLayer) -> list[_Trial]:
    """Begin with all on one side, and turn round every torque that flows against its sign; repeat."""
    patterns = {tuple(each.sides[0] for each in own): None}
    found: list[_Trial] = []
    left = layer.valid.copy()
    for _ in range(_MOST_ROUNDS):
        fresh: dict[tuple[int, ...], None] = {}
        for sides in patterns:
            values, valid = _solve(own, block, layer, sides)
            valid &= left
            if valid.any():
                found.append(_Trial(layer, sides, values, valid))
                left = left & ~valid
            wanted = np.where(values >= 0, 1, -1) * np.array([[len(each.sides) > 1] for each in own])
            fresh |= dict.fromkeys(map(tuple, np.unique(wanted[:, left].T, axis=0).tolist()))
        patterns = {sides: None for sides in fresh if sides not in patterns}
        if not left.any() or not patterns:
            break
    return found


def _joined(
    columns: Sequence[ColumnPieces], block: Block, layers: Sequence[BalanceLayer], trials: Sequence[_Trial]
) -> list[BalanceLayer]:
    """The solutions with those of one block added; as many layers as there are solutions at any position."""
    if len(layers) == 1 and not np.any(sum((trial.valid.astype(int) for trial in trials), np.zeros(1)) > 1):
        (layer,) = layers
        layer.valid = np.zeros_like(layer.valid)
        for trial in trials:
            _take(columns, block, trial, layer, trial.valid)
        return [layer]
    found: list[BalanceLayer] = []
    for trial in trials:
        left = trial.valid
        for layer in found:
            free = left & ~layer.valid
            if free.any():
                layer.values[:, free], layer.rows[:, free] = trial.layer.values[:, free], trial.layer.rows[:, free]
                _take(columns, block, trial, layer, free)
                left = left & ~free
        if left.any():
            layer = trial.layer.copy()
            layer.valid = np.zeros_like(left)
            _take(columns, block, trial, layer, left)
            found.append(layer)
    return found or [BalanceLayer(layers[0].values, layers[0].rows, np.zeros_like(layers[0].valid))]


def _take(columns: Sequence[ColumnPieces], block: Block, trial: _Trial, layer: BalanceLayer, where: Bools) -> None:
    """Write a trial into a layer at some positions."""
    layer.valid |= where
    for column, side, value in zip(block.columns, trial.sides, trial.values, strict=True):
        layer.values[column, where] = value[where]
        for row, piece in columns[column].pieces[side].items():
            layer.rows[row, where] += piece[where] * value[where]
