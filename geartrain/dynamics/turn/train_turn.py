"""The torque of a train over turns of its input, with the ratio and the friction of every position."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from geartrain.dynamics.motion.motion_problem import find_motion_problem
from geartrain.dynamics.torques.torque_results import TorqueVerdict
from geartrain.dynamics.turn.torque_cycle import TorqueCycle
from geartrain.dynamics.turn.turn_analysis import find_torque_cycle, find_turn_balance
from geartrain.errors import check_choice, check_numbers, check_whole_numbers

if TYPE_CHECKING:
    from fractions import Fraction

    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.dynamics.turn.friction_study import FrictionStudy

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
    from geartrain.dynamics.turn.friction_study import find_friction_study

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
