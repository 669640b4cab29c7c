"""The torque of a train over turns of its input, with the ratio and the friction of every position.

A friction study runs one train with other frictions each time; its motion, corners, tables and order of solution are
found once. Friction moves nothing: at a position all links turn as the flanks that touch there say. It changes which
flanks touch, and what passes. Who drives each pair may change with it, where torques of opposite senses meet; then
nothing is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.motion_problem import find_motion_problem
from geartrain.dynamics.torques.torque_results import TorqueVerdict
from geartrain.dynamics.turn.torque_cycle import TorqueCycle
from geartrain.dynamics.turn.train_contacts import PinFriction, ToothFriction
from geartrain.dynamics.turn.turn_analysis import find_figures, find_torque_cycle, find_turn_balance
from geartrain.dynamics.turn.turn_run import TurnRun
from geartrain.errors import check_choice, check_numbers, check_whole_numbers

if TYPE_CHECKING:
    from fractions import Fraction

    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.torques.torque_balance import LoadedPair
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.dynamics.turn.torque_cycle import CycleFigures
    from geartrain.dynamics.turn.train_contacts import PairContact
    from geartrain.dynamics.turn.turn_balance import TurnBalance
    from geartrain.train.declaration import FrictionInForce


@dataclass
class FrictionStudy:
    """A run to be told with other coefficients of friction."""

    run: TurnRun
    of: str | None = None
    certain: bool = False
    """True where who drives each pair is the same with any friction that does not lock."""

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


SAMPLES = 20_000
"""Positions of a run unless a number is given."""


def solve(
    train: TrainMechanics,
    state: str | None,
    turns: float,
    samples: int = SAMPLES,
    of: str | None = None,
    on_done: Callable[[int], object] | None = None,
) -> TorqueCycle:
    """The torque at every position of some turns: see `GearTrain.torques`."""
    check_numbers(turns=turns)
    check_whole_numbers(samples=samples)
    train = train.unfolded
    found = train.load_case(state)
    if of is not None:
        check_choice("link", of, tuple(train.declaration.links))
    if found is None:
        return TorqueCycle(state, TorqueVerdict("still", "the speeds of this state are not determined"), of or "")
    return find_torque_cycle(found, find_motion_problem(train, state), turns, samples, of, on_done)


def study_friction(
    train: TrainMechanics, turns: float, samples: int = SAMPLES, state: str | None = None, of: str | None = None
) -> FrictionStudy | None:
    """A run that can be repeated with other coefficients of friction, in a part of the time of a new train.

    None where friction is counted by its mean, or follows a law of speed: then each needs a train of its own.
    """
    train = train.unfolded
    found = train.load_case(state)
    return None if found is None else find_friction_study(found, find_motion_problem(train, state), turns, samples, of)


def find_torque_period(train: TrainMechanics, state: str | None = None, of: str | None = None) -> Fraction | None:
    """Turns of the input after which the torque over a turn repeats, exactly.

    Parameters
    ----------
    train : TrainMechanics
        `GearTrain.mechanics`.
    state : str, optional
        A declared state; None only of a train that has none.
    of : str, optional
        The link whose torque is requested, by default the crank or input.

    Returns
    -------
    Fraction or None
        None where no pair that carries torque is uneven, so that the torque is one at all positions, or where torques
        are not known.

    Examples
    --------
    A clock of even teeth, whose friction depends on the place of the tooth: all repeats after a quarter of an hour.

    >>> import geartrain
    >>> train = geartrain.load('''
    ... extends: longcase-clock-cycloidal
    ... friction: 0.2
    ... loads: {escape: -1 N mm}
    ... ''')
    >>> find_torque_period(train.mechanics)
    Fraction(1, 4)
    """
    train = train.unfolded
    loads = train.load_case(state)
    if loads is None:
        return None
    found = find_turn_balance(loads, find_motion_problem(train, state), of)
    return None if isinstance(found, TorqueVerdict) else found.motion.period
