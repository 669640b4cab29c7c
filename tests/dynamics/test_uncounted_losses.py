"""What mean torques count of pins, teeth and bearings, and what they name as left out.

Truth is here: forces on one pin integrated by the midpoint rule, closed forms of those integrals, and whole trains
stepped position by position with the law of every pair.
"""

from __future__ import annotations

import json
from cmath import rect
from math import asin, log, pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import call
from hypothesis import given
from hypothesis import strategies as st
from models import torque_figures, torque_page

from geartrain import load
from geartrain.teeth import PinToSlotTransmission, SlotToPinTransmission

PIN = """
links: {frame: {}, a: {}, b: {}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
couplings: [{id: P, kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm, friction: 0.3}]
inputs: {a: 1}
outputs: {b: {}}
loads: {b: -10 N m}
"""
MOON = "extends: moon-triangular\nname: m\nloads: {moon: -1 N mm}\n"


def names(found: Any) -> dict[str, tuple[str, ...]]:
    return {each.what: each.where for each in found.neglected}


def pin_torques(r: float, e: float, f: float, load_torque: float, count: int, backward: bool = False) -> np.ndarray:
    """Driver's torque at equal steps of its angle: forces and arms of one pin in a radial slot, complex plane.

    The normal force turns the slot; friction along the slot has no arm about the slot's axis, and acts on the pin.
    """
    found = np.empty(count)
    for at in range(count):
        angle = 2 * pi * (at + 0.5) / count
        if backward:  # the slot stands at this angle: the pin is where its direction meets the pin's circle
            angle += asin(-e / r * np.sin(angle)) if e else 0.0
        pin = rect(r, angle)
        arm = pin - e
        along = arm / abs(arm)
        across = 1j * along
        velocity = 1j * pin  # of the pin while it turns at 1; the slot takes the part across
        sliding = (velocity.real * along.real + velocity.imag * along.imag) > 0
        lever = (pin.conjugate() * across).imag  # arm of the normal force about the pin's axis
        rub = (pin.conjugate() * along).imag * (-1 if sliding else 1)  # friction on the pin is against its sliding
        if backward:  # torque 1 on the pin from the slot's normal force, less friction
            normal = load_torque / (lever + f * rub)
            found[at] = normal * abs(arm)
        else:
            normal = load_torque / abs(arm)
            found[at] = normal * (lever - f * rub)
    return found


@pytest.mark.parametrize(("r", "e", "f"), [(10, 8, 0.3), (10, 8, 0.7), (9.6, 1.1, 0.2), (10, 9.5, 0.05)])
def test_means_of_a_pin_are_those_of_the_forces_on_it(r: float, e: float, f: float) -> None:
    ahead = pin_torques(r, e, f, 1.0, 100_000)
    assert 1 / PinToSlotTransmission(r, e, f).efficiency_at_constant_load() == pytest.approx(ahead.mean(), rel=1e-7)
    back = SlotToPinTransmission(r, e, f)
    if f < back.locking_friction:
        there = pin_torques(r, e, f, 1.0, 100_000, backward=True)
        assert 1 / back.efficiency_at_constant_load() == pytest.approx(there.mean(), rel=1e-6)


@given(st.floats(0.01, 0.99), st.floats(0.0, 2.0))
def test_means_of_a_pin_are_those_of_its_transmission(share: float, f: float) -> None:
    for transmission in (PinToSlotTransmission(1.0, share, f), SlotToPinTransmission(1.0, share, f)):
        if isinstance(transmission, SlotToPinTransmission) and f >= 0.95 * transmission.locking_friction:
            continue
        S = (np.arange(1 << 15) + 0.5) * (2 * pi / (1 << 15))
        eta, tau = transmission.efficiency(S), transmission.speed(S)
        assert transmission.efficiency_mean() == pytest.approx(eta.mean(), rel=1e-4)
        assert transmission.efficiency_at_constant_load() == pytest.approx(tau.mean() / np.mean(tau / eta), rel=1e-4)


def test_the_pin_of_known_forces_takes_its_mean_at_the_crank() -> None:
    train = load(PIN)
    found = train.torques()
    truth = 10 * (1 + 0.3 / pi * log(18 / 2))
    assert truth == pytest.approx(12.0981949, abs=5e-8)
    assert float(found.external["a"]) == pytest.approx(truth, rel=1e-13)
    assert pin_torques(10, 8, 0.3, 10.0, 100_000).max() == pytest.approx(50.9784589, rel=1e-4)  # which the mean hides
    assert found.verdict.kind == "incomplete"
    assert "mean" in found.verdict.text
    assert names(found) == {"variation within a turn": ("P",)}
    back = load(PIN.replace("inputs: {a: 1}", "inputs: {b: 1}").replace("loads: {b: -10", "loads: {a: -10")).torques()
    assert float(back.external["b"]) == pytest.approx(12.994123, abs=5e-7)


def test_a_given_crank_torque_takes_the_mean_at_constant_torque_of_the_driver() -> None:
    found = load(PIN.replace("loads: {b: -10 N m}", "loads: {a: 10 N m}")).torques()
    assert found.requested == ("b",)
    assert float(found.external["b"]) == pytest.approx(-8.357499, abs=5e-7)


def test_a_pin_that_locks_its_slot_locks_the_train() -> None:
    text = PIN.replace("inputs: {a: 1}", "inputs: {b: 1}").replace("loads: {b: -10", "loads: {a: -10")
    assert load(text.replace("friction: 0.3", "friction: 0.7499")).torques().verdict
    assert load(text.replace("friction: 0.3", "friction: 0.7501")).torques().verdict.kind == "self-locking"


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ((", pin_radius: 10 mm, offset: 8 mm", ""), "pin_radius"),
        (("pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm",
          "pin_follower, pin: a, slot: b, pin_radius: 6 mm, offset: 10 mm"), "follower"),
    ],
)  # fmt: skip
def test_friction_of_a_pin_that_is_not_counted_is_named_wherever_the_result_is_told(
    change: tuple[str, str], what: str, tmp_path: Path
) -> None:
    text = PIN.replace(*change)
    train = load(text)
    found = train.torques()
    assert found.verdict.kind == "incomplete"
    assert "friction of pins (P)" in found.verdict.text
    assert names(found)["friction of pins"] == ("P",)
    (why,) = [each.why for each in found.neglected if each.what == "friction of pins"]
    assert what in why
    page = torque_page(train, found)
    assert "Not included: friction of pins (P): " in page
    assert "Not included: friction of pins (P): " in str(train.report())
    data = torque_figures(train).to_dict()
    assert data["neglected"][0] == {"what": "friction of pins", "where": ["P"], "why": why}
    if found.efficiency is not None:
        assert f"efficiency {float(found.efficiency):.10g} without friction of pins (P)" in page
        assert "efficiency 1;" not in page
    path = tmp_path / "t.yaml"
    path.write_text(text, encoding="utf-8")
    assert json.loads(call("torques", path, "--json").output)["states"][0]["neglected"] == data["neglected"]
    assert f"note {path}: torques do not include friction of pins (P): " in call("check", path).output


def test_nothing_is_left_out_of_what_is_declared_in_full() -> None:
    found = load("extends: planetary-24-18-60\nname: p\nloads: {carrier: -1}\n").torques()
    assert found.verdict.kind == "determined"
    assert found.neglected == ()
    # nor where a pin carries nothing
    text = PIN.replace("loads: {b: -10 N m}", "loads: {a: 1 N m}\nsolve_for: a").replace("friction: 0.3", "friction: 0")
    idle = text.replace("links: {frame: {}, a: {}, b: {}}", "links: {frame: {}, a: {}, b: {}, c: {}}")
    idle = idle.replace("axis: B}]", "axis: B}, {pair: [frame, c], axis: A}]\nlocks: [[a, c]]")
    found = load(idle.replace("solve_for: a", "solve_for: c")).torques()
    assert found.verdict.kind == "determined"
    assert found.neglected == ()


def test_friction_on_teeth_without_a_form_is_named() -> None:
    text = "extends: planetary-24-18-60\nname: p\nfriction: 0.1\nloads: {carrier: -1}\n"
    found = load(text).torques()
    assert names(found) == {"friction of teeth": ("s~p", "p~ring")}
    assert found.efficiency == 1
    assert found.verdict.kind == "incomplete"
    half = load(text + "gears: [{pair: [s, p], efficiency: 0.98}]\n").torques()
    assert names(half) == {"friction of teeth": ("p~ring",)}


def test_a_train_of_real_teeth_asks_the_crank_for_the_mean_of_its_positions() -> None:
    """moon-triangular with 1 N mm on the Moon, four pairs stepped together: no two have teeth in step for long."""
    train = load(MOON)
    transmissions = {mesh.name: mesh.transmission for mesh in train.meshes}
    alone = {"a~b1": 0.9585852, "b2~c1": 0.9413106, "c2~d1": 0.9027585, "d2~e": 0.9232}
    for name, efficiency in alone.items():
        assert transmissions[name].efficiency_at_constant_load() == pytest.approx(efficiency, abs=6e-8)
    count, turns = 400_000, 95  # of the crank: after as many the whole train stands as at first
    x = (np.arange(count) + 0.5) * (2 * pi * turns / count)
    torque = np.ones(count)
    for name in alone:
        transmission = transmissions[name]
        torque *= transmission.speed(x) / transmission.efficiency(x)
        x = transmission.angle(x)
    stepped = float(torque.mean())
    assert stepped == pytest.approx(3.55536, rel=2e-4)
    found = train.torques()
    assert float(found.external["crank"]) * 1000 == pytest.approx(stepped, rel=4e-4)
    assert float(found.external["crank"]) * 1000 == pytest.approx(3.555323, abs=1e-6)
    assert float(found.efficiency or 0) == pytest.approx(0.7520229, abs=1e-7)
    assert names(found) == {"variation within a turn": tuple(alone)}


BOTH = """
links: {frame: {}, a: {wheels: {x: 24}}, b: {wheels: {y: 36}}, c: {bearing: 0.5 N m}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
gears: [{id: G, pair: [x, y], tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}, friction: 0.1}]
couplings: [{id: P, kind: pin_and_slot, pin: b, slot: c, pin_radius: 10 mm, offset: 5 mm, friction: 0.2}]
inputs: {a: 1}
outputs: {c: {}}
loads: {c: 3 N m}
"""


def test_teeth_a_pin_and_a_bearing_in_a_row_cost_the_product_of_their_means() -> None:
    train = load(BOTH)
    found = train.torques()
    teeth = train.meshes[0].transmission.efficiency_at_constant_load()
    truth = 3.5 * (24 / 36) * (1 + 0.2 / pi * log(15 / 5)) / teeth
    assert truth == pytest.approx(2.555516, abs=1e-6)
    assert float(found.external["a"]) == pytest.approx(truth, rel=1e-12)


def test_each_side_of_a_train_with_a_given_crank_has_its_own_mean() -> None:
    """The crank gives 10, one branch resists with 1, the other is asked for: each pair is at constant torque once."""
    text = """
links: {frame: {}, a: {wheels: {p: 20, q: 24}}, b: {wheels: {r: 30}}, c: {wheels: {s: 36}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
gears: [{id: B, pair: [p, r]}, {id: C, pair: [s, q]}]
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
friction: 0.1
inputs: {a: 1}
loads: {a: 10, b: 1}
solve_for: c
"""
    train = load(text)
    found = train.torques()
    one, other = train.meshes
    left = 10 - 20 / 30 / one.transmission.efficiency_at_constant_load()
    transmission = other.transmission if other.driver == "q" else other.reversed
    assert float(found.external["c"]) == pytest.approx(left * transmission.efficiency_mean() * 36 / 24, rel=1e-12)
    assert "mean efficiency" not in names(found)


def test_pairs_of_which_neither_torque_is_constant_are_named() -> None:
    base = "extends: planetary-24-18-60-involute\nname: p\nloads: {{{}}}\n"
    assert names(load(base.format("carrier: -1")).torques())["mean efficiency"] == ("s~p", "p~ring")
    assert "mean efficiency" not in names(load(base.format("sun: 1") + "solve_for: carrier\n").torques())


def test_bearings_of_a_train_with_retrograde_pointers_are_named_and_motion_prints_the_extremes_of_their_speeds() -> (
    None
):
    train = load("extends: freeth-2021\nname: s\nlinks: {saturn: {bearing: 1 N mm}}\n")
    found = train.torques()
    assert found.verdict.kind == "incomplete"
    assert names(found)["friction of bearings that reverse"] == ("saturn",)
    page = torque_page(train, found)
    assert "N m without friction of bearings that reverse (saturn)." in page
    # by hand: w = 1 - 427/442 tau, with the pin's circle of 14.37 and the axes 1.50 apart
    low, high = (1 - 427 / 442 * 14.37 / (14.37 - side * 1.50) for side in (1, -1))
    (saturn,) = train.motion(outputs=["saturn"]).run(turns=float(train.motion(outputs=["saturn"]).period)).statistics
    assert saturn.slow / saturn.mean + 1 == pytest.approx(low / (1 - 427 / 442), rel=1e-6)
    assert saturn.fast / saturn.mean + 1 == pytest.approx(high / (1 - 427 / 442), rel=1e-6)


def test_a_bearing_of_a_follower_takes_something_though_its_mean_speed_is_none() -> None:
    text = PIN.replace("kind: pin_and_slot", "kind: pin_follower").replace("10 mm, offset: 8", "6 mm, offset: 10")
    text = text.replace("b: {}}\n", "b: {bearing: 1 N m}}\n", 1).replace("loads: {b: -10 N m}\n", "")
    found = load(text).torques()
    assert found.bearing_loss == 0
    assert names(found)["friction of bearings that reverse"] == ("b",)
    even = load("extends: planetary-24-18-60\nname: p\nloads: {carrier: -1}\nlinks: {carrier: {bearing: 1/10}}\n")
    assert "friction of bearings that reverse" not in names(even.torques())


def test_efficiencies_there_and_back_name_the_bearings_they_leave_out() -> None:
    train = load("extends: planetary-24-18-60\nname: p\nloads: {carrier: -1}\nlinks: {carrier: {bearing: 1/10}}\n")
    page = torque_page(train, train.torques())
    assert "Efficiency from 'sun' to 'carrier': 1 without friction of bearings (carrier)." in page
    data = torque_figures(train).to_dict()
    assert data["neglected"] == []
    assert data["drives"]["forward"]["neglected"][0]["where"] == ["carrier"]


def test_the_means_of_teeth_are_worked_out_once_whatever_is_loaded(monkeypatch: pytest.MonkeyPatch) -> None:
    requested: list[object] = []
    transmission = type(load(MOON).meshes[0].transmission)
    mean = transmission.efficiency_mean
    monkeypatch.setattr(
        transmission, "efficiency_mean", lambda transmission: requested.append(transmission) or mean(transmission)
    )
    train = load(MOON)
    assert train.driven("moon", "sun").verdict
    once = len(requested)
    assert once == 2 * len(train.declaration.gears), "either wheel driving"
    assert train.driven("d", "crank").verdict
    assert train.torques().verdict
    assert len(requested) == once
