"""Trials of friction: a trial is a run of a train that declares the drawn coefficients."""

from __future__ import annotations

import numpy as np
import pytest

from geartrain import GearTrain, load
from geartrain.train import Train
from geartrain.workshop import find_friction_plan, try_frictions
from geartrain.workshop.monte_carlo.friction_trials import draw_friction

ROW = "extends: moon-triangular\nloads: {moon: -1 N mm}\nfriction: {sliding: 0.2, static: 0.3, deviation: 0.1}\n"
PIN = """
links: {{frame: {{}}, a: {{}}, b: {{}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
couplings: [{{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm, friction: {{sliding: {2}}}}}]
inputs: {{{0}: 1}}
outputs: {{b: {{}}}}
loads: {{{1}: -1 N m}}
"""
PLANETS = """
extends: price-1974
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
friction: {sliding: 0.2, deviation: 0.05}
links: {turntable: {bearing: 1 N mm}}
"""


@pytest.mark.parametrize(
    ("text", "turns", "positions"),
    [
        (ROW, 0.2, 40),
        (PIN.format("a", "b", "0.3, deviation: 0.1"), 0.2, 40),
        (PLANETS, 0.01, 10),
        (PIN.format("b", "a", "0.3, deviation: 0.4"), 1, 60),
    ],
    ids=["row of pairs", "pin and slot", "turning carriers", "some trials lock"],
)
def test_a_trial_is_a_run_of_a_train_with_its_coefficients(text: str, turns: float, positions: int) -> None:
    plan = find_friction_plan(load(text), turns, positions)
    drawn = [draw_friction(plan.declared, 1, trial) for trial in range(8)]
    runs = [GearTrain(train).torques(turns=turns, samples=positions) for train in drawn]
    rows = [(found.mean, found.maximum_torque, found.starting_torque, found.efficiency) for found in runs]
    assert [plan.follow(train) for train in drawn] == rows
    found = try_frictions(plan, 8)
    values = [[value for value in column if value is not None] for column in zip(*rows, strict=True)]
    assert [each.values.tolist() for each in (found.mean, found.maximum, found.starting, found.efficiency)] == values
    assert found.locks.count == sum(row[0] is None for row in rows) == (1 if "deviation: 0.4" in text else 0)


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
    plan = find_friction_plan(load(TRAIN), turns=0.2, samples=50)
    found = try_frictions(plan, 6, seed=2)
    drawn = [coefficients(draw_friction(plan.declared, 2, trial))[0] for trial in range(6)]
    order = np.argsort(drawn)
    for figure in (found.mean, found.maximum, found.starting):
        assert (np.diff(figure.values[order]) > 0).all()
    assert (np.diff(found.efficiency.values[order]) < 0).all()
