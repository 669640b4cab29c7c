"""Random coefficients of friction: how they are drawn, and the torques of the trials."""

from __future__ import annotations

import numpy as np
import pytest
from test_uncounted_losses import PIN

from geartrain import GearTrain, load
from geartrain.train import Train
from geartrain.workshop import FrictionPlan, try_frictions
from geartrain.workshop.monte_carlo.friction_trials import draw_friction

TRAIN = """
extends: moon-triangular
name: spread
loads: {moon: -1 N mm}
friction: {sliding: 0.2, static: 0.25, deviation: 0.1}
"""


def coefficients(train: Train) -> list[float]:
    return [found.sliding for gear in train.gears if (found := train.friction_of(gear)) and found.sliding is not None]


def test_what_the_train_declares_is_one_coefficient_in_each_trial() -> None:
    declared = load(TRAIN).declaration
    drawn = [coefficients(draw_friction(declared, 1, trial)) for trial in range(400)]
    assert all(len(set(each)) == 1 for each in drawn)
    values = np.array(drawn)[:, 0]
    assert values.min() >= 0
    assert values.mean() == pytest.approx(0.2, abs=4 * 0.1 / 20)
    assert values.std() == pytest.approx(0.1, rel=0.15)


def test_what_a_pair_declares_is_its_own_and_static_keeps_its_ratio() -> None:
    data = load(TRAIN).declaration.model_dump(mode="json", exclude_defaults=True)
    data["gears"][0]["friction"] = {"sliding": 0.1, "static": 0.2, "deviation": 0.01}
    declared = GearTrain.declare(data).declaration
    for trial in (0, 1, 300):
        drawn = draw_friction(declared, 7, trial)
        first, second = (drawn.friction_of(gear) for gear in drawn.gears[:2])
        assert first is not None
        assert second is not None
        assert first.sliding != second.sliding
        assert first.static == pytest.approx(2 * (first.sliding or 0), rel=1e-12)
        assert draw_friction(declared, 7, trial) == drawn
    assert draw_friction(declared, 8, 0) != draw_friction(declared, 7, 0)


def test_more_friction_takes_more_torque() -> None:
    plan = FrictionPlan(load(TRAIN).declaration, turns=0.2, samples=50)
    found = try_frictions(plan, 6, seed=2)
    drawn = [coefficients(draw_friction(plan.declared, 2, trial))[0] for trial in range(6)]
    order = np.argsort(drawn)
    for figure in (found.mean, found.maximum, found.starting):
        assert (np.diff(figure.values[order]) > 0).all()
    assert (np.diff(found.efficiency.values[order]) < 0).all()


def test_trials_are_those_of_a_train_each_and_some_lock() -> None:
    text = PIN.replace("friction: 0.3", "friction: {sliding: 0.3, deviation: 0.4}")
    train = load(text.replace("inputs: {a", "inputs: {b").replace("loads: {b: -10", "loads: {a: -1"))
    found = try_frictions(FrictionPlan(train.declaration, 1, 60), 8, seed=1)
    trains = [GearTrain(draw_friction(train.declaration, 1, trial)) for trial in range(8)]
    cycles = [train.torques(turns=1, samples=60) for train in trains]
    turning = [cycle for cycle in cycles if cycle.mean is not None]
    assert 0 < len(turning) < 8
    assert found.mean.values.tolist() == [cycle.mean for cycle in turning]
    assert found.efficiency.values.tolist() == [cycle.efficiency for cycle in turning]
