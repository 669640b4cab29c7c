"""One run of a train with other frictions each time: its motion, corners, tables and order of solution are found once.

Friction moves nothing: at a position all links turn as the flanks that touch there say. It changes which flanks touch,
and what passes. Who drives each pair may change with it, where torques of opposite senses meet; then nothing is kept.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.torques.torque_results import TorqueVerdict
from geartrain.dynamics.turn.pair_contact import PinFriction, ToothFriction
from geartrain.dynamics.turn.turn_analysis import find_figures, find_turn_balance
from geartrain.dynamics.turn.turn_run import TurnRun

if TYPE_CHECKING:
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.torques.torque_balance import LoadedPair
    from geartrain.dynamics.turn.cycle_parts import CycleFigures
    from geartrain.dynamics.turn.pair_contact import PairContact
    from geartrain.dynamics.turn.turn_balance import TurnBalance
    from geartrain.train.declaration import FrictionInForce


@dataclass
class FrictionStudy:
    """A run to be told with other coefficients of friction.

    certain   True where who drives each pair is the same with any friction that does not lock
    """

    run: TurnRun
    of: str | None = None
    certain: bool = False

    def figures(self, friction: Mapping[str, FrictionInForce]) -> CycleFigures:
        """Figures of the run with other frictions of some pairs and couplings."""
        own = self.run.train
        contacts = {name: _rubbed(each, friction.get(name)) for name, each in own.contacts.items()}
        train = replace(own, contacts=contacts, complete=True)
        return find_figures(replace(self.run, train=train), self.of)


def find_friction_study(
    setting: LoadCase, problem: MotionProblem, turns: float, samples: int, of: str | None
) -> FrictionStudy | None:
    """The study of one run; None where friction is counted by its mean, or goes by a law of speed."""
    train = find_turn_balance(setting, problem, of)
    if isinstance(train, TorqueVerdict):
        return None
    declared = setting.train
    rubbing = [part.name for part in (*declared.gears, *declared.couplings) if declared.friction_of(part) is not None]
    counted = all(
        isinstance(contact.losses, ToothFriction | PinFriction) and not callable(contact.losses.sliding)
        for name, contact in train.contacts.items()
        if name in rubbing
    )
    return FrictionStudy(TurnRun(train, turns, samples), of, drivers_are_certain(train)) if counted else None


def _rubbed(contact: PairContact, friction: FrictionInForce | None) -> PairContact:
    """A contact with another friction."""
    losses = contact.losses
    if friction is None or friction.sliding is None or not isinstance(losses, ToothFriction | PinFriction):
        return contact
    return replace(contact, losses=replace(losses, sliding=friction.sliding, static=friction.static))


def drivers_are_certain(train: TurnBalance) -> bool:
    """Whether power flows one way through every pair, whatever friction takes on the way while nothing locks.

    Each torque follows from one row, in which all that is known has one sense: then its own sense does not depend on
    how much each of them is. Carriers that turn take a difference of torques, and are not certain.
    """
    setting, balance = train.setting, train.balance
    frame, rows = setting.train.frame, {link: row for row, link in enumerate(balance.links)}
    senses: dict[int, set[float]] = {}

    def add(row: int, torque: float) -> None:
        if torque:
            senses.setdefault(row, set()).add(float(np.sign(torque)))

    for link, torque in train.loads.items():
        add(rows[link], torque)
    for link in train.bearings:
        carrier = setting.tree.parent[link][0]
        if carrier != frame:
            return False
        add(rows[link], -float(setting.speeds[link]))
    for block in balance.parts:
        if len(block.rows) != 1 or len(block.columns) != 1:
            return False
        known, column = senses.get(block.rows[0], set()), train.columns[block.columns[0]]
        if len(known) > 1 or len(column.meshes) > 1 or any(mesh.links[2] != frame for mesh in column.meshes):
            return False
        for mesh in column.meshes:
            parts = _senses(mesh)
            taken = {row: parts[member] * float(factor) for row, member, factor in balance.places(mesh)}
            for each in known:
                for row, part in taken.items():
                    if row != block.rows[0]:
                        add(row, -each * part * taken[block.rows[0]])
    return True


def _senses(mesh: LoadedPair) -> tuple[int, int, int]:
    """Of the torques on the links of a pair in the frame, for a positive multiplier."""
    return int(np.sign(mesh.a)) * mesh.senses[0], int(np.sign(mesh.b or -1)) * mesh.senses[1], 0
