"""The compiled balance of torques over a turn is that of arrays to 1e-12, with every contact, block and pattern."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from turning_chains import random_chain

from geartrain import GearTrain, load
from geartrain.dynamics.motion.motion_problem import find_motion_problem
from geartrain.dynamics.turn.compiled_turn import CompiledTurn, compiled_turn
from geartrain.dynamics.turn.position_torques import PositionTorques
from geartrain.dynamics.turn.turn_analysis import find_turn_balance
from geartrain.dynamics.turn.turn_balance import TurnBalance
from geartrain.errors import MissingExtraError
from geartrain.numerics.named_arrays import some

TEETH = "tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}\nfriction: {sliding: 0.2, static: 0.25}\n"
PIN = """
links: {frame: {}, a: {}, b: {}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
couplings: [{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm, friction: FRICTION}]
inputs: {INPUT}
outputs: {b: {}}
loads: {LOAD}
"""
TRAINS = {
    "four pairs in a row": "extends: moon-triangular\nloads: {moon: -1 N mm}\nfriction: {sliding: 0.2, static: 0.3}\n",
    "bearings of planets, and rest in the play": f"""
extends: freeth-2021
{TEETH}links:
  moon: {{bearing: 1 N mm}}
  mars: {{bearing: 1 N mm}}
  saturn: {{bearing: {{sliding: 1 N mm, static: 2 N mm}}}}
""",
    "three pairs that depend on each other": f"extends: price-1974\n{TEETH}links: {{moon: {{bearing: 1 N mm}}}}\n",
    "a pair that moves its own driver": f"extends: prague-orloj\n{TEETH}links: {{zodiac: {{bearing: 1 N mm}}}}\n",
    "a pin": PIN.replace("FRICTION", "{sliding: 0.3, static: 0.4}")
    .replace("INPUT", "a: 1")
    .replace("LOAD", "b: -10 N m"),
    "equal planets on opposite axes": """
extends: bevel-differential
remove: {states: [straight, turn, one wheel held, crown held]}
axes: {far: {direction: [1, 0, 0]}}
links: {crown: {bearing: 1 N mm}, right: {bearing: 1 N mm}, spider: {bearing: 1 N mm}, hand: {}}
revolutes: {far: [case, hand]}
couplings: [{kind: pin_and_slot, pin: right, slot: hand, pin_radius: 10 mm, offset: 2 mm}]
inputs: {shaft: 41}
fixed: [left]
outputs: {hand: {}}
loads: {hand: -1 N m}
""",
}


def balance(train: GearTrain) -> TurnBalance:
    train = train.unfolded
    setting = train.mechanics.load_case(None)
    assert setting is not None
    found = find_turn_balance(setting, find_motion_problem(train.mechanics), None)
    assert isinstance(found, TurnBalance)
    return found


def compiled(train: TurnBalance) -> CompiledTurn:
    found = compiled_turn(train)
    assert found is not None
    return found


def differences(found: PositionTorques, expected: PositionTorques) -> dict[str, float]:
    """By figure, over its greatest."""
    return {
        name: float(np.max(np.abs(one - other), initial=0.0) / max(np.max(np.abs(other), initial=0.0), 1e-300))
        for name, one, other in zip(found._fields, found, expected, strict=True)
        if one.dtype == float
    }


@pytest.mark.parametrize("name", TRAINS)
@pytest.mark.parametrize("static", [False, True])
def test_every_figure_of_the_kernel_in_plain_python_is_that_of_arrays(name: str, static: bool) -> None:
    train = balance(load(TRAINS[name]))
    turns = np.random.default_rng(18).random(8) * 2
    settled, found = replace(compiled(train), fast=False).at(turns, static)
    assert settled.all()
    expected = train.at(turns, static)
    assert np.array_equal(found.adrift, expected.adrift)
    assert max(differences(found, expected).values()) < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("name", TRAINS)
@pytest.mark.parametrize("static", [False, True])
def test_every_figure_of_the_compiled_kernel_is_that_of_arrays(name: str, static: bool) -> None:
    train = balance(load(TRAINS[name]))
    turns = np.random.default_rng(18).random(600) * 2
    settled, found = compiled(train).at(turns, static)
    assert settled.all()
    expected = train.at(turns, static)
    assert np.array_equal(found.adrift, expected.adrift)
    assert max(differences(found, expected).values()) < 1e-12


@pytest.mark.parametrize("seed", range(0, 24, 4))
def test_random_chains_of_every_kind_balance_as_by_arrays(seed: int) -> None:
    train = balance(GearTrain.declare(random_chain(seed).data))
    kernel = compiled_turn(train)
    if kernel is not None:
        turns = np.random.default_rng(seed).random(5)
        settled, found = replace(kernel, fast=False).at(turns, False)
        expected = some(train.at(turns), settled)
        assert max(differences(some(found, settled), expected).values()) < 1e-12


def test_where_a_train_locks_or_has_several_patterns_arrays_answer() -> None:
    """A slot that drives its pin with a friction of 0.8 locks over 0.1395052083 of a turn (docs/torques.md, 18)."""
    train = load(PIN.replace("FRICTION", "0.8").replace("INPUT", "b: 1").replace("LOAD", "a: -10 N m"))
    settled, _ = replace(compiled(balance(train)), fast=False).at(np.linspace(0, 1, 101), False)
    assert 0.12 < 1 - settled.mean() < 0.16


@pytest.mark.slow
def test_a_run_that_locks_is_the_same_with_kernels() -> None:
    train = load(PIN.replace("FRICTION", "0.8").replace("INPUT", "b: 1").replace("LOAD", "a: -10 N m"))
    found = train.torques(turns=1, samples=1000, fast=True)
    assert found.locked_share == pytest.approx(0.1395052083, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four pairs in a row", "a pin"])
def test_a_run_is_the_same_with_kernels_and_without(name: str) -> None:
    train = load(TRAINS[name])
    slow, fast = (train.torques(turns=1, samples=200, fast=each) for each in (False, True))
    assert fast.mean == pytest.approx(slow.mean, rel=1e-10)
    for figure in ("greatest_torque", "least_torque", "starting_torque", "efficiency"):
        assert getattr(fast, figure) == pytest.approx(getattr(slow, figure), rel=1e-11)
    assert fast.flank_changes == slow.flank_changes


def test_friction_by_a_law_of_speed_is_followed_by_arrays_alone() -> None:
    train = load("""
links: {frame: {}, a: {wheels: {p: {teeth: 24, module: 1 mm}}}, b: {wheels: {w: {teeth: 36, module: 1 mm}}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, w]}]
tooth_form: {form: involute}
friction: {law: stribeck, static: 0.2, kinetic: 0.05, speed: 20 mm/s}
inputs: {a: 1}
rate: 2 turn/s
loads: {b: -1 N m}
""")
    assert compiled_turn(balance(train)) is None
    assert train.torques(turns=0.1, samples=50, fast=True).mean == train.torques(turns=0.1, samples=50, fast=False).mean


def test_kernels_that_are_asked_for_and_missing_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "numba", None)
    train = load(TRAINS["a pin"])
    assert train.torques(turns=1, samples=20).mean is not None
    with pytest.raises(MissingExtraError, match="fast"):
        train.torques(turns=1, samples=20, fast=True)
