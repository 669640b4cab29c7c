"""Positions of a run: even steps, both sides of every corner, and three positions within every cell between.

What is asked for is smooth within a cell, and Boole's rule integrates it. Where a law has a corner, something turns
back or another flank takes over, a cell ends, and the two limits there are two positions. A cell over which Simpson's
rule changes as it is halved is halved.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Indices, Ints

NODES = 5
"""Positions of a cell: its ends, its middle, and the middles of its halves."""

_BOOLE = np.array([7.0, 32.0, 12.0, 32.0, 7.0]) / 90
_HALVED = np.array([1.0, -4.0, 6.0, -4.0, 1.0]) / 180  # Simpson's rule on both halves less that on the whole, over 15
_ASIDE = 1e-10  # of the narrowest period: how far from a corner its two limits are taken
_ROUNDING = 16  # units in the last place of the run's end: positions nearer than that are one
_PARTS = 16  # of what is left of a cell in which something changes its sign
_MOST_ROUNDS, _FEWEST_ROUNDS = 11, 4
_EFFORT = 20_000  # positions that may be asked for in one search of kinks, unless there are many


@dataclass(frozen=True)
class RunCells:
    """Cells of a run of the input, (cells,): what is asked for is smooth within each.

    aside   how far from the ends of a cell its limits there are taken (turns)
    """

    low: Floats
    high: Floats
    aside: float

    @property
    def turns(self) -> Floats:
        """Positions, where they are told to stand: (cells times `NODES`)."""
        share = np.arange(NODES) / (NODES - 1)
        found = self.low[:, None] + (self.high - self.low)[:, None] * share
        found[:, -1] = self.high
        return found.ravel()

    @property
    def asked(self) -> Floats:
        """Positions, where torques are asked for: a little aside of the ends of cells."""
        return (self.turns.reshape(-1, NODES) + self.aside * np.array([1.0, 0.0, 0.0, 0.0, -1.0])).ravel()

    @property
    def weights(self) -> Floats:
        """Weights of an integral over the input's turns."""
        found: Floats = ((self.high - self.low)[:, None] * _BOOLE).ravel()
        return found

    def roughness(self, values: Floats) -> Floats:
        """What Simpson's rule may be off by on the halves of each cell, (cells,), from values at its positions."""
        found: Floats = np.abs(values.reshape(-1, NODES) @ _HALVED) * (self.high - self.low)
        return found

    @property
    def middles(self) -> Floats:
        """Their middles."""
        return np.asarray((self.low + self.high) / 2)

    def parted(self, cell: Indices, at: Floats) -> RunCells:
        """The parts of some cells, cut at some places within them.

        cell   the number of the cell of each place
        """
        cut = np.unique(cell)
        low, number = np.concatenate([self.low[cut], at]), np.concatenate([cut, cell])
        order = np.lexsort((low, number))
        low, number = low[order], number[order]
        last = np.append(number[1:] != number[:-1], True)
        return RunCells(low, np.where(last, self.high[number], np.append(low[1:], 0.0)), self.aside)

    def some(self, which: Bools) -> RunCells:
        """Some of the cells."""
        return RunCells(self.low[which], self.high[which], self.aside)


def run_cells(span: float, steps: int, breaks: Floats, narrowest: float) -> RunCells:
    """Cells between even steps from 0 to `span` and breaks.

    narrowest   period of the fastest law (turns of the input)
    """
    aside = max(_ASIDE * narrowest, _ROUNDING * float(np.spacing(span)))
    inner = np.unique(breaks[(breaks > 2 * aside) & (breaks < span - 2 * aside)])
    inner = inner[np.diff(inner, prepend=-np.inf) > 4 * aside]
    even = np.linspace(0.0, span, steps + 1)[1:-1]
    near = np.searchsorted(inner, even)
    padded = np.concatenate([[-np.inf], inner, [np.inf]])
    even = even[(even - padded[near] > 4 * aside) & (padded[near + 1] - even > 4 * aside)]
    edges = np.concatenate([[0.0], np.sort(np.concatenate([even, inner])), [span]])
    return RunCells(edges[:-1], edges[1:], aside)


def find_kinks(signs_at: Callable[[Floats], Ints], cells: RunCells, signs: Ints) -> tuple[Indices, Floats]:
    """Where signs change within cells, in all of these places at once: the cell of each, by number, and the place.

    signs_at   of some positions, (signs, n); `signs`, those at the positions of the cells
    """
    turns = cells.asked
    changed = (signs[:, 1:] != signs[:, :-1]).any(axis=0) & (np.diff(turns) > 0)
    # over the break between two cells nothing new is to be found
    changed[NODES - 1 :: NODES] = False
    at = np.flatnonzero(changed)
    if not len(at):
        return at, np.zeros(0)
    low, high, first = turns[at], turns[at + 1], signs[:, at]
    # few calls with many positions: each call asks every law, whatever the number of positions
    rounds = int(np.clip(_EFFORT // (len(at) * _PARTS), _FEWEST_ROUNDS, _MOST_ROUNDS))
    for _ in range(rounds):
        inner = low[:, None] + (high - low)[:, None] * (np.arange(1, _PARTS) / _PARTS)
        same = (signs_at(inner.ravel()).reshape(len(signs), *inner.shape) == first[:, :, None]).all(axis=0)
        # the part in which the first change lies
        part = np.where(same.all(axis=1), _PARTS - 1, np.argmin(same, axis=1))
        width = (high - low) / _PARTS
        low, high = low + part * width, low + (part + 1) * width
    places, cell = (low + high) / 2, at // NODES
    # a hair from an end of the cell, or from another kink, nothing is to be gained
    apart = np.minimum(places - cells.low[cell], cells.high[cell] - places) > 4 * cells.aside
    apart &= np.append(True, (np.diff(places) > 4 * cells.aside) | (np.diff(cell) > 0))
    return cell[apart], places[apart]
