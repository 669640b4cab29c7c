"""Torque of a train over revolutions of its input, with the speed ratio and the friction at every position."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from geartrain.dynamics.motion.motion_problem import find_motion_problem
from geartrain.dynamics.torques.torque_results import TorqueVerdict
from geartrain.dynamics.turn.torque_cycle import TorqueCycle
from geartrain.dynamics.turn.turn_analysis import find_figures, find_torque_cycle, find_turn_balance
from geartrain.dynamics.turn.turn_run import TurnRun
from geartrain.errors import check_choice, check_numbers, check_whole_numbers

if TYPE_CHECKING:
    from fractions import Fraction

    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.dynamics.turn.torque_cycle import CycleFigures

SAMPLES = 20_000
"""Default number of positions of a run."""
_STILL = "the speeds of this state are not determined"


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
        return TorqueCycle(state, TorqueVerdict("still", _STILL), of or "")
    return find_torque_cycle(found, find_motion_problem(train, state), turns, samples, of, on_done)


def run_figures(
    train: TrainMechanics, turns: float, samples: int = SAMPLES, state: str | None = None, of: str | None = None
) -> CycleFigures | TorqueVerdict:
    """Return only the main figures of a run, which are computed faster than all results; a verdict if the torques
    cannot be determined.
    """
    train = train.unfolded
    found = train.load_case(state)
    if found is None:
        return TorqueVerdict("still", _STILL)
    balance = find_turn_balance(found, find_motion_problem(train, state), of)
    return balance if isinstance(balance, TorqueVerdict) else find_figures(TurnRun(balance, turns, samples), of)


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
