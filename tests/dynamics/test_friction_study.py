"""A run told with other coefficients of friction is that of a train that declares them."""

from __future__ import annotations

import numpy as np
import pytest
from turning_chains import random_chain

from geartrain import GearTrain, load
from geartrain.dynamics import TorqueCycle
from geartrain.train import Train
from geartrain.workshop import FrictionPlan, find_friction_plan, try_frictions
from geartrain.workshop.monte_carlo.friction_trials import draw_friction

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
links:
  frame: {}
  a: {wheels: {p: {teeth: 24, module: 1 mm}}}
  b: {wheels: {w: {teeth: 36, module: 1 mm}}}
  c: {wheels: {v: {teeth: 30, module: 1 mm}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
gears: [{pair: [p, w]}, {pair: [w, v], friction: {sliding: 0.2, deviation: 0.1}}]
tooth_form: {form: involute}
friction: FRICTION
inputs: {a: 1}
rate: 2 turn/s
loads: {c: -1 N m}
"""
PLANETS = """
extends: price-1974
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
friction: {sliding: 0.2, deviation: 0.05}
links: {turntable: {bearing: 1 N mm}}
"""


def figures(found: TorqueCycle) -> tuple[float | None, ...]:
    return found.mean, found.maximum_torque, found.starting_torque, found.efficiency


def is_certain(plan: FrictionPlan) -> bool:
    assert plan.study is not None
    return plan.study.certain


@pytest.mark.parametrize("sliding", [0.0, 0.05, 0.35])
def test_a_pin_and_four_pairs_with_other_coefficients(sliding: float) -> None:
    pin = PIN.replace("INPUT", "a: 1").replace("LOAD", "b: -10 N m")
    other = f"sliding: {sliding}, static: {1.5 * sliding}"
    for text, changed in (
        (ROW, ROW.replace("sliding: 0.2, static: 0.3, deviation: 0.1", other)),
        (pin.replace("FRICTION", "{sliding: 0.3, static: 0.45, deviation: 0.1}"),
         pin.replace("FRICTION", f"{{{other}}}")),
    ):  # fmt: skip
        plan, train = find_friction_plan(load(text), 0.3, 50), load(changed)
        assert is_certain(plan)
        expected = figures(train.torques(turns=0.3, samples=50))
        assert plan.follow(train.declaration) == pytest.approx(expected, rel=1e-13)


def test_trials_are_those_of_a_train_each() -> None:
    pin = PIN.replace("INPUT", "a: 1").replace("LOAD", "b: -10 N m")
    for text in (ROW, pin.replace("FRICTION", "{sliding: 0.3, deviation: 0.1}")):
        plan = find_friction_plan(load(text), 0.2, 40)
        found = try_frictions(plan, 3, seed=3)
        trains = [GearTrain(draw_friction(plan.declared, 3, trial)) for trial in range(3)]
        expected = [figures(train.torques(turns=0.2, samples=40)) for train in trains]
        rows = zip(found.mean.values, found.maximum.values, found.starting.values, found.efficiency.values, strict=True)
        assert list(rows) == expected


def test_where_carriers_turn_every_trial_asks_who_drives() -> None:
    plan = find_friction_plan(load(PLANETS), 0.01, 10)
    assert not is_certain(plan)
    drawn = draw_friction(plan.declared, 1, 0)
    assert plan.follow(drawn) == figures(GearTrain(drawn).torques(turns=0.01, samples=10))


def test_a_trial_that_locks_is_requested_of_a_train_of_its_own() -> None:
    text = (
        PIN.replace("FRICTION", "{sliding: 0.3, deviation: 0.4}").replace("INPUT", "b: 1").replace("LOAD", "a: -1 N m")
    )
    plan = find_friction_plan(load(text), 1, 60)
    drawn = [draw_friction(plan.declared, 1, trial) for trial in range(8)]
    rows = [plan.follow(train) for train in drawn]
    assert any(row[0] is None for row in rows)
    assert any(row[0] is not None for row in rows)
    assert rows == [figures(GearTrain(train).torques(turns=1, samples=60)) for train in drawn]


@pytest.mark.parametrize("seed", range(24))
def test_sides_that_are_certain_stay_the_same_with_any_friction(seed: int) -> None:
    data = random_chain(seed).data

    def with_friction(sliding: float) -> GearTrain:
        parts = {key: [_rubbed(each, sliding) for each in data.get(key, [])] for key in ("gears", "couplings")}
        return GearTrain.declare({**data, **parts})

    train = with_friction(0.2)
    if not any("friction" in each for key in ("gears", "couplings") for each in data.get(key, [])):
        return
    plan = find_friction_plan(train, 1, 20)
    if plan.study is None or not plan.study.certain:
        return
    sides = {name: each.wheel for name, each in train.mechanics.drivers().items()}
    for sliding in (0.01, 0.4):
        assert {name: each.wheel for name, each in with_friction(sliding).mechanics.drivers().items()} == sides


def _rubbed(part: dict[str, object], sliding: float) -> dict[str, object]:
    return {**part, "friction": {"sliding": sliding, "deviation": 0.1}} if "friction" in part else part


def test_friction_that_goes_by_a_law_of_speed_has_no_study() -> None:
    assert find_friction_plan(load(SPEED.replace("FRICTION", "0.2")), 1, 20).study is not None
    assert find_friction_plan(load(SPEED.replace("FRICTION", STRIBECK)), 1, 20).study is None


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
