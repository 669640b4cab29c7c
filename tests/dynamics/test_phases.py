"""At turn 0 a tooth of every first wheel is at its `phase`: in motion, torque, time steps and Monte Carlo alike.

Angles are those at which flanks of the outlines touch (`outline_touch`), not those of a transmission function.
"""

from __future__ import annotations

from fractions import Fraction
from math import degrees, pi, prod, sin

import numpy as np
import pytest
from outline_touch import Outlines
from sampling import first_few

from geartrain import GearTrain, load
from geartrain.dynamics import MotionRun
from geartrain.workshop import find_trial_plan, read_error_overrides, run_course

CHAIN = """
links:
  frame: {{}}
  a: {{wheels: {{p: 20}}}}
  b: {{wheels: {{q: 31, s: 15}}, inertia: 3 g cm2, bearing: 1 N mm}}
  c: {{wheels: {{r: 40}}, inertia: 5 g cm2, bearing: 1 N mm}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}, {{pair: [frame, c], axis: C}}]
gears: [{{pair: [p, q], phase: {0}}}, {{pair: [s, r], phase: {1}}}]
tooth_form: {{form: triangular, half_angle: 30 deg, clearance_factor: 1.02}}
friction: 0
inputs: {{a: 1}}
loads: {{c: -1 N mm}}
outputs: {{b: , c: }}
"""


def outlines(z1: int, z2: int) -> Outlines:
    """Teeth of equal depth with half angles of 30 degrees, at the clearance factor 1.02."""
    h1, h2 = (1 - 0.5 / sin(pi / 6 + pi / z) for z in (z1, z2))
    return Outlines(z1, z2, 1.0, h1 / h2, pi / 6, pi / 6, 1.02 * (1 + h1 / h2 - h1))


PAIRS = outlines(20, 31), outlines(15, 40)
PHASES = [(0.0, 0.0), (0.3, 0.0), (0.25, 0.8)]


def turned(phases: tuple[float, float], x: np.ndarray) -> np.ndarray:
    """How far the last wheel has turned when the first has by x (rad), each driver from its phase."""
    for wheels, phase in zip(PAIRS, phases, strict=True):
        S = phase * 2 * pi / wheels.z1
        x = wheels.places(S + x).driven - wheels.places(np.array([S])).driven
    return x


def speed(phases: tuple[float, float]) -> float:
    """Speed of the last wheel over that of the first at the start."""
    starts = (np.array([phase * 2 * pi / wheels.z1]) for wheels, phase in zip(PAIRS, phases, strict=True))
    return prod(float(wheels.moments(S, 0.0)[0][0]) for wheels, S in zip(PAIRS, starts, strict=True))


def chain(phases: tuple[float, float]) -> GearTrain:
    return load(CHAIN.format(*phases))


@pytest.mark.parametrize("phases", PHASES)
def test_the_motion_is_that_of_teeth_that_start_at_their_phases(phases: tuple[float, float]) -> None:
    x = np.linspace(0, 3.1, 200)
    motion = chain(phases).motion(outputs=["c"])
    expected = turned(phases, x) - 20 / 31 * 15 / 40 * x
    assert np.abs(motion.at(x / (2 * pi)).error[0] - expected).max() < 1e-12


@pytest.mark.parametrize("phases", first_few(1, reversed(PHASES)))
def test_the_ripple_of_a_train_is_that_of_its_phases(phases: tuple[float, float]) -> None:
    """Over a common period: 31/20 turns of pairs that meet again after 31 pitches of the first, 20 of the second."""
    x = np.linspace(0, 2 * pi * 31 / 20, 8001)
    expected = turned(phases, x) - 20 / 31 * 15 / 40 * x
    motion = chain(phases).motion(outputs=["c"])
    assert motion.period == Fraction(31, 20)
    run = MotionRun(motion, 31 / 20, 2001)
    run.run()
    assert degrees(run.statistics[0].peak_to_peak) == pytest.approx(degrees(np.ptp(expected)), rel=2e-3)


@pytest.mark.parametrize("phases", PHASES)
def test_torque_over_a_turn_starts_at_the_same_teeth(phases: tuple[float, float]) -> None:
    train, expected = load(CHAIN.format(*phases).replace(", bearing: 1 N mm", "")), speed(phases)
    assert 20 / 31 * 15 / 40 + train.motion(outputs=["c"]).at([0.0]).rate[0, 0] == pytest.approx(expected, rel=1e-9)
    cycle = train.torques(turns=1, samples=50)
    # without friction, by virtual work
    assert cycle.torque[0] == pytest.approx(1e-3 * expected, rel=1e-9)


@pytest.mark.parametrize("phases", PHASES)
def test_time_steps_start_at_the_same_teeth(phases: tuple[float, float]) -> None:
    """Turned slowly all drive flanks touch, and the last wheel is where they put it."""
    run = chain(phases).dynamics(rate="0.02 turn/s", turns=0.2, skip=0, steps=2000, fast=False)
    at = slice(1, None, 97)
    x, last = run.angles["a"][at], run.angles["c"][at]
    assert np.abs(last - turned(phases, x)).max() < 1e-6


@pytest.mark.parametrize("phases", PHASES)
def test_trials_of_teeth_without_errors_start_at_the_same_teeth(phases: tuple[float, float]) -> None:
    plan = find_trial_plan(chain(phases), read_error_overrides(["pitch_deviation=1e-9 deg"]), ["c"])
    found = run_course(plan, 0, 80, seed=3, trials=2)
    x = 2 * pi * found.turns
    expected = turned(phases, x) - 20 / 31 * 15 / 40 * x
    assert np.ptp(found.errors - expected, axis=1).max() < 1e-8  # errors count from the average
