"""A run over some turns: where torques are asked for, so that integrals are right and no kink is missed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.turn.run_positions import NODES, RunCells, find_kinks, run_cells
from geartrain.numerics.named_arrays import joined, some

if TYPE_CHECKING:
    from geartrain.dynamics.turn.position_torques import PositionTorques
    from geartrain.dynamics.turn.turn_balance import TurnBalance
    from geartrain.numerics.arrays import Bools, Floats, Indices, Ints

_PROBES = 300  # positions at which it is asked which flanks touch
_MOST_SETS = 3  # sets of coast flanks that touch at once, whose corners are looked for
_ROUNDS = 3  # of looking for kinks: those of one cell come one after another
_ACCURACY, _ROUNDING = 1e-8, 1e-13  # of all energy, spread evenly over the run, and what a cell may be off by at least
_DEPTH = 13  # cuts of a cell one after another
_MOST_TIMES = 12  # as many positions as at first: the rest stays as coarse as it is
_NONE = np.zeros(0, np.intp), np.zeros(0)  # no cuts: cells, and places
FAINT = 1e-9
"""Of the greatest torque or power in a run: less has no sign."""


@dataclass
class TurnRun:
    """A run over some turns, in at least `samples` positions."""

    train: TurnBalance
    span: float
    samples: int

    @cached_property
    def corners(self) -> Floats:
        """Positions at which a law has a corner, with the drive flanks touching, and with each usual set of flanks."""
        train = self.train
        even = train.at(np.linspace(0.0, self.span, min(self.samples, _PROBES)))
        sets = {frozenset[str](): 0}
        rows = [train.pairs.index(name) for name in train.flanked]
        coasting = sign_beyond(even.pressed[rows], RunScales.of(even).pressed) < 0
        for column in coasting.T:
            names = frozenset(name for name, coasts in zip(train.flanked, column, strict=True) if coasts)
            sets[names] = sets.get(names, 0) + 1
        usual = sorted(sets, key=lambda names: -sets[names])[:_MOST_SETS]
        return np.concatenate([train.motion.corners(names, self.span) for names in usual])

    @cached_property
    def narrowest(self) -> float:
        """Turns of the input in a period of the fastest law."""
        fastest = max((float(each.cycles) for each in self.train.motion.sources.values()), default=0.0)
        return 1 / max(fastest, 1 / self.span)

    @cached_property
    def _followed(self) -> tuple[RunCells, PositionTorques]:
        """Cells in order, kinks among their ends, as narrow as integrals ask for; and all at their positions."""
        cells = run_cells(self.span, max(1, self.samples // NODES), self.corners, self.narrowest)
        found = self.train.at(cells.asked)
        scales, total = RunScales.of(found), float(cells.weights @ np.nan_to_num(np.abs(found.powers)).sum(axis=0))
        kept: list[tuple[RunCells, PositionTorques]] = []
        count, most = 0, _MOST_TIMES * len(cells.asked)
        for depth in range(_DEPTH + 1):
            cell, at = self._cuts(cells, found, scales, total, depth) if count <= most else _NONE
            whole = np.ones(len(cells.low), bool)
            whole[cell] = False
            kept.append((cells.some(whole), some(found, np.repeat(whole, NODES))))
            if not len(cell):
                break
            count += len(cells.asked)
            cells = cells.parted(cell, at)
            found = self.train.at(cells.asked)
        low, high = (np.concatenate([getattr(each, name) for each, _ in kept]) for name in ("low", "high"))
        order = np.argsort(low)
        nodes = (order[:, None] * NODES + np.arange(NODES)).ravel()
        return RunCells(low[order], high[order], cells.aside), some(joined([each for _, each in kept]), nodes)

    def _cuts(
        self, cells: RunCells, found: PositionTorques, scales: RunScales, total: float, depth: int
    ) -> tuple[Indices, Floats]:
        """Where cells are to be cut: at their kinks, and in the middle where they are too wide; which, and where."""
        if depth == _DEPTH:
            return _NONE
        kinks, places = _NONE
        if depth < _ROUNDS:
            signs = self.signs(found, scales)
            kinks, places = find_kinks(lambda turns: self.signs(self.train.at(turns), scales), cells, signs)
        coarse = self._coarse(cells, found, total)
        coarse[kinks] = False
        wide = np.flatnonzero(coarse)
        return np.concatenate([kinks, wide]), np.concatenate([places, cells.middles[wide]])

    def _coarse(self, cells: RunCells, found: PositionTorques, total: float) -> Bools:
        """The cells too wide for what is put in or for what is lost."""
        integrands = found.powers[: len(self.train.asked)].sum(axis=0), found.losses.sum(axis=0)
        rough = np.max([cells.roughness(np.nan_to_num(each)) for each in integrands], axis=0)
        found_coarse: Bools = rough > total * (_ACCURACY * (cells.high - cells.low) / self.span + _ROUNDING)
        return found_coarse

    @property
    def cells(self) -> RunCells:
        """The cells of the run."""
        return self._followed[0]

    @property
    def found(self) -> PositionTorques:
        """Everything at the positions of the run."""
        return self._followed[1]

    def signs(self, found: PositionTorques, scales: RunScales) -> Ints:
        """Whatever has a kink where its sign changes."""
        outside = found.powers.shape[0]
        asked = len(self.train.asked)
        return np.concatenate(
            [
                sign_beyond(found.pressed, scales.pressed),
                np.sign(found.turning),
                np.sign(found.slipping),
                np.sign(found.kinks),
                found.layers[None],
                sign_beyond(found.powers[:asked], scales.power),
                sign_beyond(found.powers[asked:outside], scales.power),
            ]
        ).astype(np.int64)

    def share(self, where: Bools) -> float:
        """The part of the run taken by some of its positions."""
        return float(self.cells.weights @ where) / self.span

    @cached_property
    def standing(self) -> PositionTorques:
        """With the friction of what is about to move."""
        return self.train.at(self.cells.asked, static=True) if self.train.starts_harder else self.found


@dataclass(frozen=True)
class RunScales:
    """The greatest torque through any pair, and the greatest power: what is a small part of it has no sign."""

    pressed: float
    power: float

    @classmethod
    def of(cls, found: PositionTorques) -> RunScales:
        """At some positions."""
        pressed = np.where(found.valid, np.abs(found.pressed), 0.0)
        return cls(float(np.max(pressed, initial=0.0)), float(np.nanmax(np.abs(found.powers), initial=0.0)))


def sign_beyond(values: Floats, scale: float) -> Floats:
    """Signs, 0 for what is a small part of a scale."""
    with np.errstate(invalid="ignore"):
        return np.where(np.abs(values) > FAINT * scale, np.sign(values), 0.0)
