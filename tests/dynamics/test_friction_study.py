"""A run told with other coefficients of friction is that of a train that declares them."""

from __future__ import annotations

import pytest
from turning_chains import random_chain

from geartrain import GearTrain, load
from geartrain.dynamics.turn.train_turn import FrictionStudy, drivers_are_certain, study_friction
from geartrain.train import FrictionInForce
from geartrain.workshop import find_friction_plan
from geartrain.workshop.monte_carlo.friction_trials import draw_friction, work_frictions

ROW = "extends: moon-triangular\nloads: {moon: -1 N mm}\nfriction: {sliding: 0.2, static: 0.3, deviation: 0.1}\n"
PIN = """
links: {frame: {}, a: {}, b: {}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
couplings: [{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm, friction: FRICTION}]
inputs: {INPUT}
outputs: {b: {}}
loads: {LOAD}
"""
STRIBECK = "{law: stribeck, static: 0.2, kinetic: 0.05, speed: 20 mm/s}"
SPEED = """
links: {frame: {}, a: {wheels: {p: {teeth: 24, module: 1 mm}}}, b: {wheels: {w: {teeth: 36, module: 1 mm}}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, w]}]
tooth_form: {form: involute}
friction: FRICTION
inputs: {a: 1}
rate: 2 turn/s
loads: {b: -1 N m}
"""
PLANETS = """
extends: price-1974
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
friction: {sliding: 0.2, deviation: 0.05}
links: {turntable: {bearing: 1 N mm}}
"""


def study(train: GearTrain, turns: float = 0.3) -> FrictionStudy:
    found = study_friction(train.mechanics, turns, samples=50)
    assert found is not None
    return found


@pytest.mark.parametrize("sliding", [0.0, 0.05, 0.35])
def test_a_pin_and_four_pairs_with_other_coefficients(sliding: float) -> None:
    pin = PIN.replace("INPUT", "a: 1").replace("LOAD", "b: -10 N m")
    for text, other in (
        (ROW, ROW.replace("0.2, static: 0.3, deviation: 0.1", f"{sliding}, static: {1.5 * sliding}")),
        (pin.replace("FRICTION", "{sliding: 0.3, static: 0.45}"),
         pin.replace("FRICTION", f"{{sliding: {sliding}, static: {1.5 * sliding}}}")),
    ):  # fmt: skip
        common, expected = study(load(text)), load(other).torques(turns=0.3, samples=50)
        assert common.certain
        friction = FrictionInForce(sliding, 1.5 * sliding)
        found = common.figures(dict.fromkeys(common.run.train.contacts, friction))
        expected_figures = (
            expected.mean, expected.maximum_torque, expected.starting_torque, expected.efficiency
        )  # fmt: skip
        assert found == pytest.approx(expected_figures, rel=1e-13)


def test_trials_are_those_of_a_train_each() -> None:
    pin = PIN.replace("INPUT", "a: 1").replace("LOAD", "b: -10 N m")
    for text in (ROW, pin.replace("FRICTION", "{sliding: 0.3, deviation: 0.1}")):
        plan = find_friction_plan(load(text), 0.2, 40)
        rows = work_frictions(plan, 3, [0, 3])
        for trial, row in enumerate(rows):
            train = GearTrain(draw_friction(plan.declared, 3, trial))
            found = train.torques(turns=0.2, samples=40)
            assert row == [found.mean, found.maximum_torque, found.starting_torque, found.efficiency]


def test_where_carriers_turn_every_trial_asks_who_drives() -> None:
    plan = find_friction_plan(load(PLANETS), 0.01, 10)
    assert not plan.study.certain
    train = GearTrain(draw_friction(plan.declared, 1, 0))
    found = train.torques(turns=0.01, samples=10)
    assert work_frictions(plan, 1, [0, 1]) == [
        [found.mean, found.maximum_torque, found.starting_torque, found.efficiency]
    ]


def test_a_trial_that_locks_is_requested_of_a_train_of_its_own() -> None:
    text = (
        PIN.replace("FRICTION", "{sliding: 0.3, deviation: 0.4}").replace("INPUT", "b: 1").replace("LOAD", "a: -1 N m")
    )
    plan = find_friction_plan(load(text), 1, 60)
    rows = work_frictions(plan, 1, [0, 8])
    assert any(row[0] is None for row in rows)
    assert any(row[0] is not None for row in rows)
    for trial, row in enumerate(rows):
        found = GearTrain(draw_friction(plan.declared, 1, trial)).torques(turns=1, samples=60)
        assert row == [found.mean, found.maximum_torque, found.starting_torque, found.efficiency]


@pytest.mark.parametrize("seed", range(24))
def test_sides_that_are_certain_stay_the_same_with_any_friction(seed: int) -> None:
    data = random_chain(seed).data
    train = GearTrain.declare(data)
    found = study_friction(train.mechanics, 1, samples=20)
    if found is None or not drivers_are_certain(found.run.train):
        return
    sides = {name: each.wheel for name, each in train.mechanics.drivers().items()}
    for friction in (0.01, 0.4):
        other = {**data, "gears": [_rubbed(each, friction) for each in data["gears"]]}
        other["couplings"] = [_rubbed(each, friction) for each in data.get("couplings", [])]
        assert {name: each.wheel for name, each in GearTrain.declare(other).mechanics.drivers().items()} == sides


def _rubbed(part: dict[str, object], friction: float) -> dict[str, object]:
    return {**part, "friction": friction} if "friction" in part else part


def test_friction_that_goes_by_a_law_of_speed_has_no_study() -> None:
    assert study_friction(load(SPEED.replace("FRICTION", "0.2")).mechanics, 1, samples=20) is not None
    assert study_friction(load(SPEED.replace("FRICTION", STRIBECK)).mechanics, 1, samples=20) is None
