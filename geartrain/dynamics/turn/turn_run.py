"""Run over several revolutions: positions at which torques are computed, chosen so that integrals are accurate.

Cells end at equally spaced positions and at every kink, where both one-sided limits are computed. They are bisected
until Simpson's rule no longer changes, and integrated by Boole's rule.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.arrays import joined, some

if TYPE_CHECKING:
    from geartrain.dynamics.turn.turn_balance import PositionTorques, TurnBalance
    from geartrain.numerics.arrays import Bools, Floats, Indices, Ints


NODES = 5
"""Number of positions in each cell: its two ends, its middle, and the middles of its two halves."""

_BOOLE = np.array([7.0, 32.0, 12.0, 32.0, 7.0]) / 90  # Boole's rule over a cell of unit width
# error estimate: Simpson's rule on both halves less that on the whole, over 15 (Richardson extrapolation)
_HALVED = np.array([1.0, -4.0, 6.0, -4.0, 1.0]) / 180
_ASIDE = 1e-10  # [shortest period] distance from a kink at which its one-sided limits are taken
_LAST_PLACES = 16  # units in the last place of the run's end: closer positions are not distinct
_PARTS = 16  # subdivisions per round of the search for a sign change in a cell
_MOST_ROUNDS, _FEWEST_ROUNDS = 11, 4  # rounds of 16 subdivisions: 16^11 resolves a cell to rounding
_EFFORT = 20_000  # target for the positions evaluated in one search for kinks
_PROBES = 300  # positions at which the touching flanks are determined first
_MOST_SETS = 3  # most frequent sets of touching coast flanks, whose kinks are searched
_ROUNDS = 3  # rounds of the search for kinks: each round finds one kink per cell
# tolerance relative to the total energy: distributed evenly over the run, and the rounding error allowed in any cell
_ACCURACY, _ROUNDING = 1e-8, 1e-13
_DEPTH = 13  # maximum depth of bisection
_MOST_TIMES = 12  # refinement stops when this multiple of the initial positions is exceeded
_NONE = np.zeros(0, np.intp), np.zeros(0)  # no cuts: cell indices and places
FAINT = 1e-9
"""Fraction of the maximum torque or power of a run. The sign of a value below this fraction is set to 0."""


@dataclass(frozen=True)
class RunCells:
    """Intervals (cells) from `low` to `high` [revolutions], shape (cells,), into which the evaluated range of the input
    is divided. Torques are smooth within each cell.
    """

    low: Floats
    high: Floats
    aside: float
    """Distance from the ends of a cell at which the one-sided limits are evaluated [revolutions]."""

    @property
    def turns(self) -> Floats:
        """Input positions in all cells, including both ends of a cell [revolutions], shape (cells times `NODES`,)."""
        share = np.arange(NODES) / (NODES - 1)
        found = self.low[:, None] + (self.high - self.low)[:, None] * share
        found[:, -1] = self.high
        return found.ravel()

    @property
    def requested(self) -> Floats:
        """Positions at which torques are computed [revolutions]; cell ends are moved slightly into the cell."""
        return (self.turns.reshape(-1, NODES) + self.aside * np.array([1.0, 0.0, 0.0, 0.0, -1.0])).ravel()

    @property
    def weights(self) -> Floats:
        """Weights of the positions in an integral over the revolutions of the input, shape (cells times `NODES`,)."""
        found: Floats = ((self.high - self.low)[:, None] * _BOOLE).ravel()
        return found

    def divided(self, cell: Indices, at: Floats) -> RunCells:
        """Return the parts that result from dividing cells at the positions `at` [revolutions].

        cell   index of the cell that contains each position in `at`
        """
        cut = np.unique(cell)
        low, number = np.concatenate([self.low[cut], at]), np.concatenate([cut, cell])
        order = np.lexsort((low, number))
        low, number = low[order], number[order]
        last = np.append(number[1:] != number[:-1], True)
        return RunCells(low, np.where(last, self.high[number], np.append(low[1:], 0.0)), self.aside)

    def some(self, which: Bools) -> RunCells:
        """Return the selected cells."""
        return RunCells(self.low[which], self.high[which], self.aside)


def run_cells(span: float, steps: int, breaks: Floats, narrowest: float) -> RunCells:
    """Return cells whose ends are equally spaced positions from 0 to `span` [revolutions] and the positions `breaks`.

    narrowest   period of the fastest transmission function [revolutions of the input]
    """
    aside = max(_ASIDE * narrowest, _LAST_PLACES * float(np.spacing(span)))
    inner = np.unique(breaks[(breaks > 2 * aside) & (breaks < span - 2 * aside)])
    # cells are wider than four times `aside`, so that the one-sided limits at their ends do not overlap
    inner = inner[np.diff(inner, prepend=-np.inf) > 4 * aside]
    even = np.linspace(0.0, span, steps + 1)[1:-1]
    near = np.searchsorted(inner, even)
    padded = np.concatenate([[-np.inf], inner, [np.inf]])
    even = even[(even - padded[near] > 4 * aside) & (padded[near + 1] - even > 4 * aside)]
    edges = np.concatenate([[0.0], np.sort(np.concatenate([even, inner])), [span]])
    return RunCells(edges[:-1], edges[1:], aside)


def find_kinks(signs_at: Callable[[Floats], Ints], cells: RunCells, signs: Ints) -> tuple[Indices, Floats]:
    """Return the cell index and the position [revolutions] of each sign change within a cell, located by repeated
    subdivision.

    signs_at   function that returns the signs of the tracked quantities at given positions, shape (signs, n)
    signs      signs at the positions of the cells
    """
    turns = cells.requested
    changed = (signs[:, 1:] != signs[:, :-1]).any(axis=0) & (np.diff(turns) > 0)
    # a change across the boundary between two cells is already a boundary
    changed[NODES - 1 :: NODES] = False
    at = np.flatnonzero(changed)
    if not len(at):
        return at, np.zeros(0)
    low, high, first = turns[at], turns[at + 1], signs[:, at]
    # few calls with many positions, because each call has the overhead of all transmission functions
    rounds = int(np.clip(_EFFORT // (len(at) * _PARTS), _FEWEST_ROUNDS, _MOST_ROUNDS))
    for _ in range(rounds):
        inner = low[:, None] + (high - low)[:, None] * (np.arange(1, _PARTS) / _PARTS)
        same = (signs_at(inner.ravel()).reshape(len(signs), *inner.shape) == first[:, :, None]).all(axis=0)
        # the subdivision with the first change
        part = np.where(same.all(axis=1), _PARTS - 1, np.argmin(same, axis=1))
        width = (high - low) / _PARTS
        low, high = low + part * width, low + (part + 1) * width
    places, cell = (low + high) / 2, at // NODES
    # a cut this close to an end of the cell or to another kink would give an empty cell
    apart = np.minimum(places - cells.low[cell], cells.high[cell] - places) > 4 * cells.aside
    apart &= np.append(True, (np.diff(places) > 4 * cells.aside) | (np.diff(cell) > 0))
    return cell[apart], places[apart]


@dataclass
class TurnRun:
    """Torques of `train` at no fewer than `samples` positions over `span` revolutions of the input."""

    train: TurnBalance
    span: float
    samples: int

    @cached_property
    def kinks(self) -> Floats:
        """Positions of kinks [revolutions] for the most frequent sets of pairs that touch on their coast flanks."""
        train = self.train
        # flanks in contact at a few positions: their functions' kinks are searched exactly
        even = train.at(np.linspace(0.0, self.span, min(self.samples, _PROBES)))
        sets = {frozenset[str](): 0}
        rows = [train.pairs.index(name) for name in train.flanked]
        coasting = sign_beyond(even.pressed[rows], RunScales.of(even).pressed) < 0
        for column in coasting.T:
            names = frozenset(name for name, coasts in zip(train.flanked, column, strict=True) if coasts)
            sets[names] = sets.get(names, 0) + 1
        # kinks of rarer sets are found later, as sign changes within cells
        usual = sorted(sets, key=lambda names: -sets[names])[:_MOST_SETS]
        return np.concatenate([train.motion.kinks(names, self.span) for names in usual])

    @cached_property
    def narrowest(self) -> float:
        """Period of the fastest transmission function [revolutions of the input]."""
        fastest = max((each.pace for each in self.train.motion.sources.values()), default=0.0)
        # the length of the run if no pair is evaluated at positions
        return 1 / max(fastest, 1 / self.span)

    @cached_property
    def _refined(self) -> tuple[RunCells, PositionTorques]:
        """Refined cells in ascending order, with kinks at their ends, and the torques at their positions."""
        cells = run_cells(self.span, max(1, self.samples // NODES), self.kinks, self.narrowest)
        found = self.train.at(cells.requested)
        # signs and tolerances refer to the scales of the initial cells, so that refinement does not change them
        scales, total = RunScales.of(found), float(cells.weights @ np.nan_to_num(np.abs(found.powers)).sum(axis=0))
        kept: list[tuple[RunCells, PositionTorques]] = []
        count, most = 0, _MOST_TIMES * len(cells.requested)
        for depth in range(_DEPTH + 1):
            cell, at = self._cuts(cells, found, scales, total, depth) if count <= most else _NONE
            whole = np.ones(len(cells.low), bool)
            whole[cell] = False
            kept.append((cells.some(whole), some(found, np.repeat(whole, NODES))))
            if not len(cell):
                break
            count += len(cells.requested)
            cells = cells.divided(cell, at)
            found = self.train.at(cells.requested)
        low, high = (np.concatenate([getattr(each, name) for each, _ in kept]) for name in ("low", "high"))
        order = np.argsort(low)
        nodes = (order[:, None] * NODES + np.arange(NODES)).ravel()
        return RunCells(low[order], high[order], cells.aside), some(joined([each for _, each in kept]), nodes)

    def _cuts(
        self, cells: RunCells, found: PositionTorques, scales: RunScales, total: float, depth: int
    ) -> tuple[Indices, Floats]:
        """Return the indices of the cells to be divided, and the positions at which they are divided: kinks, and the
        middles of cells in which the integrals are inaccurate.

        found   torques at the positions of the cells
        total   energy with which the errors of the integrals are compared
        depth   number of previous divisions
        """
        if depth == _DEPTH:
            return _NONE
        kinks, places = _NONE
        if depth < _ROUNDS:
            signs = self.signs(found, scales)
            kinks, places = find_kinks(lambda turns: self.signs(self.train.at(turns), scales), cells, signs)
        # estimated error of Simpson's rule on the halves of each cell, for input power and losses
        width = cells.high - cells.low
        integrands = np.stack([found.powers[: len(self.train.requested)].sum(axis=0), found.losses.sum(axis=0)])
        rough = np.abs(np.nan_to_num(integrands).reshape(2, -1, NODES) @ _HALVED).max(axis=0) * width
        coarse = rough > total * (_ACCURACY * width / self.span + _ROUNDING)
        # a cell with a kink is divided there first
        coarse[kinks] = False
        wide = np.flatnonzero(coarse)
        middles = (cells.low[wide] + cells.high[wide]) / 2
        return np.concatenate([kinks, wide]), np.concatenate([places, middles])

    @property
    def cells(self) -> RunCells:
        """Cells of the evaluated revolutions after refinement."""
        return self._refined[0]

    @property
    def found(self) -> PositionTorques:
        """Torques and powers at the positions of the refined cells."""
        return self._refined[1]

    def signs(self, found: PositionTorques, scales: RunScales) -> Ints:
        """Return the signs of all quantities whose sign changes indicate kinks, shape (signs, n)."""
        outside = found.powers.shape[0]
        requested = len(self.train.requested)
        return np.concatenate(
            [
                sign_beyond(found.pressed, scales.pressed),
                np.sign(found.turning),
                np.sign(found.slipping),
                np.sign(found.kinks),
                # a change of the number of solutions is a kink too
                found.layers[None],
                sign_beyond(found.powers[:requested], scales.power),
                sign_beyond(found.powers[requested:outside], scales.power),
            ]
        ).astype(np.int64)

    def share(self, where: Bools) -> float:
        """Return the fraction of the evaluated revolutions that the selected positions represent."""
        return float(self.cells.weights @ where) / self.span

    @cached_property
    def standing(self) -> PositionTorques:
        """Torques at the positions of the refined cells if static friction acts."""
        return self.train.at(self.cells.requested, static=True) if self.train.starts_harder else self.found


@dataclass(frozen=True)
class RunScales:
    """Maximum torque of any pair (`pressed`) and maximum external power (`power`), to which rounding errors are
    relative.
    """

    pressed: float
    power: float

    @classmethod
    def of(cls, found: PositionTorques) -> RunScales:
        """Return the maximum torque of a pair and the maximum external power at some positions."""
        pressed = np.where(found.valid, np.abs(found.pressed), 0.0)
        return cls(float(np.max(pressed, initial=0.0)), float(np.nanmax(np.abs(found.powers), initial=0.0)))


def sign_beyond(values: Floats, scale: float) -> Floats:
    """Return the signs of values; the sign is 0 for values whose magnitude is below `FAINT` times the scale."""
    with np.errstate(invalid="ignore"):
        return np.where(np.abs(values) > FAINT * scale, np.sign(values), 0.0)
