"""The greatest or least value of something over a run, between its positions too."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.turn.run_positions import NODES

if TYPE_CHECKING:
    from collections.abc import Callable

    from geartrain.dynamics.turn.run_positions import RunCells
    from geartrain.numerics.arrays import Floats

_CELLS = 12  # cells that are looked at more closely
_PARTS = 16  # of a cell, and then of what is left of it
_ROUNDS = 6


def find_extreme(
    value_at: Callable[[Floats], Floats], cells: RunCells, way: int, values: Floats
) -> tuple[float, float] | None:
    """Where a value is greatest (1) or least (-1), and the value; None where there is none anywhere.

    value_at   at some positions; `values`, those of the run, NaN where there are none
    """
    signed = np.where(np.isfinite(values), way * values, -np.inf)
    if not np.isfinite(signed).any():
        return None
    highest = np.argsort(-signed.reshape(-1, NODES).max(axis=1), kind="stable")[:_CELLS]
    top = int(np.argmax(signed))
    best, at = float(signed[top]), float(cells.turns[top])
    low, high = cells.low[highest] + cells.aside, cells.high[highest] - cells.aside
    for _ in range(_ROUNDS):
        grid = low[:, None] + (high - low)[:, None] * (np.arange(_PARTS + 1) / _PARTS)
        found = way * value_at(grid.ravel()).reshape(grid.shape)
        found = np.where(np.isfinite(found), found, -np.inf)
        which = np.argmax(found, axis=1)
        peak = found[np.arange(len(which)), which]
        if peak.max() > best:
            best = float(peak.max())
            at = float(grid[np.argmax(peak), which[np.argmax(peak)]])
        rows = np.arange(len(which))
        low, high = grid[rows, np.maximum(which - 1, 0)], grid[rows, np.minimum(which + 1, _PARTS)]
    return at, way * best + 0.0  # no negative zero
