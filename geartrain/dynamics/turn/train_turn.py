"""Torque of a train over revolutions of its input, with the speed ratio and the friction at every position.

A friction study repeats one run with other coefficients of friction. Motion, kinks, tables and the order of solution
are computed once, because friction does not change the motion for given flanks in contact. Friction changes only the
flanks in contact and the transmitted power. If torques of opposite senses are combined, friction may also change the
driver of a pair, and then the run is computed anew.
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
    """Run that can be repeated with other coefficients of friction without a new analysis of the motion."""

    run: TurnRun
    of: str | None = None
    certain: bool = False
    """True if the driver of each pair is the same for any friction at which the train does not lock."""

    def figures(self, friction: Mapping[str, FrictionInForce]) -> CycleFigures:
        """Return the figures of the run with other coefficients of friction in some pairs and couplings."""
        own = self.run.train
        contacts = {name: _rubbed(each, friction.get(name)) for name, each in own.contacts.items()}
        train = replace(own, contacts=contacts, complete=True)
        return find_figures(replace(self.run, train=train), self.of)


def find_friction_study(
    setting: LoadCase, problem: MotionProblem, turns: float, samples: int, of: str | None
) -> FrictionStudy | None:
    """Return the study of one run; None if some friction is a mean value or depends on speed."""
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
    """Return the contact with other coefficients of friction; unchanged if it has no friction of teeth or pins."""
    losses = contact.losses
    if friction is None or friction.sliding is None or not isinstance(losses, ToothFriction | PinFriction):
        return contact
    return replace(contact, losses=replace(losses, sliding=friction.sliding, static=friction.static))


def drivers_are_certain(train: TurnBalance) -> bool:
    """Return whether the direction of power through every pair is the same for any friction at which the train does
    not lock.

    This is certain if each torque follows from one equation in which all known torques have the same sense: the sense
    of the result then does not depend on their magnitudes. The torque on a moving carrier is a difference, so it is not
    certain.
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
        # friction in a moving bearing acts on two links
        if carrier != frame:
            return False
        add(rows[link], -float(setting.speeds[link]))
    for block in balance.parts:
        # in coupled pairs a torque may be a difference of known ones
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
    """Return the senses of the torques on the three links of a pair for a positive multiplier."""
    return int(np.sign(mesh.a)) * mesh.senses[0], int(np.sign(mesh.b or -1)) * mesh.senses[1], 0


SAMPLES = 20_000
"""Default number of positions of a run."""


def solve(
    train: TrainMechanics,
    state: str | None,
    turns: float,
    samples: int = SAMPLES,
    of: str | None = None,
    on_done: Callable[[int], object] | None = None,
) -> TorqueCycle:
    """Compute the torque at every position over some revolutions of the input. See `GearTrain.torques`."""
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
    """Return a run that can be repeated quickly with other coefficients of friction.

    The result is None if some friction is a mean value or depends on speed: each set of coefficients then needs a new
    train.
    """
    train = train.unfolded
    found = train.load_case(state)
    return None if found is None else find_friction_study(found, find_motion_problem(train, state), turns, samples, of)


def find_torque_period(train: TrainMechanics, state: str | None = None, of: str | None = None) -> Fraction | None:
    """Return the exact number of revolutions of the input after which the torque repeats.

    Parameters
    ----------
    train : TrainMechanics
        Train to analyse, `GearTrain.mechanics`.
    state : str, optional
        Name of a declared state. None is allowed only for a train without states.
    of : str, optional
        Link whose torque is requested, by default the crank or input.

    Returns
    -------
    Fraction or None
        Period [revolutions of the input]. None if torques are unknown, or if the torque is constant because no pair
        that transmits it has a variable ratio or variable friction losses.

    Examples
    --------
    Friction of teeth depends on the position of the contact. The torque in this clock repeats after a quarter of a
    revolution of the input, a quarter of an hour:

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
