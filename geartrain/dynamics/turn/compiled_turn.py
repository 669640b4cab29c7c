"""A train under load that is asked by its compiled kernel: the same torques to 1e-12, some ten times as fast."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.error_composition import PLAIN
from geartrain.dynamics.turn.position_torques import PositionTorques
from geartrain.dynamics.turn.turn_arrays import PIN, contact_losses, make_turn_arrays
from geartrain.dynamics.turn.turn_kernel import TurnAnswers, balance_positions
from geartrain.numerics.error_free import split

if TYPE_CHECKING:
    from geartrain.dynamics.turn.turn_arrays import TurnArrays
    from geartrain.dynamics.turn.turn_balance import TurnBalance
    from geartrain.numerics.arrays import Bools, Floats


@dataclass(frozen=True)
class CompiledTurn:
    """A train whose laws all stand in tables."""

    train: TurnBalance
    arrays: TurnArrays
    fast: bool = True

    def at(self, turns: Floats, static: bool) -> tuple[Bools, PositionTorques]:
        """At which of some positions the kernel finds the one solution, and everything at all of them."""
        turns = np.array(turns, dtype=float)
        found = self._blank(len(turns))
        farthest = float(np.max(np.abs(turns), initial=0.0))
        plain = PLAIN / farthest if farthest else np.inf
        kernel = balance_positions.chosen(self.fast)
        kernel(self.arrays, turns, split(turns), plain, static, found)
        return found.settled, self._told(turns, found)

    def with_losses(self, train: TurnBalance) -> CompiledTurn:
        """The same kernel for the same train with other coefficients of friction."""
        losses = [contact_losses(each) for each in train.contacts.values()]
        sliding, static = (np.array([0.0 if each is None else each[part] for each in losses]) for part in (1, 2))
        contacts = self.arrays.contacts._replace(sliding=sliding, static=static)
        return CompiledTurn(train, self.arrays._replace(contacts=contacts), self.fast)

    def _blank(self, size: int) -> TurnAnswers:
        train = self.train
        counts = len(train.columns), len(train.motion.links), *(len(train.pairs),) * 4, *(len(train.bearings),) * 2
        return TurnAnswers(np.zeros(size, bool), np.zeros(size, bool), *(np.zeros((count, size)) for count in counts))

    def _told(self, turns: Floats, found: TurnAnswers) -> PositionTorques:
        train, contacts = self.train, self.arrays.contacts
        values = found.values
        torque = values[train.asked_columns]
        speeds = train.outside_speeds(found.speed)
        acting = np.zeros_like(speeds)
        acting[: len(train.asked)] = torque
        for link, load in train.loads.items():
            acting[train.outside.index(link)] += load
        slipping = found.slipping
        pins = (contacts.kind == PIN) & ((contacts.sliding != 0) | (contacts.static != 0))
        return PositionTorques(
            turns,
            found.settled,
            found.adrift,
            np.ones(len(turns)),
            torque,
            torque,
            speeds,
            acting * speeds,
            np.concatenate([found.loss, found.rubbed]),
            np.concatenate([found.passed, found.rubbed]),
            values[contacts.column],
            found.turning,
            slipping,
            np.sin(found.S[pins]),
        )


def compiled_turn(train: TurnBalance) -> CompiledTurn | None:
    """A train with its kernel; None where something of it does not stand in tables."""
    arrays = make_turn_arrays(train)
    return None if arrays is None else CompiledTurn(train, arrays)
