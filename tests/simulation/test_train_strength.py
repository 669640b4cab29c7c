"""Strength of a train: what is declared reaches the formulas, and what is not is named."""

from __future__ import annotations

import json
from functools import cache
from math import cos, pi, radians, sqrt, tan
from pathlib import Path

import numpy as np
import pytest
from commands import ended
from hypothesis import given, settings
from hypothesis import strategies as st
from sampling import few_or_many

import geartrain
from geartrain.errors import DeclarationError, QuestionError
from geartrain.report import collect_report
from geartrain.simulation import TrainStrength
from geartrain.simulation.strength import maximum_moment

PAIR = """
links:
  frame: {}
  a: {wheels: {p: {teeth: 17, module: 2 mm}}, arbor: {diameter: 12 mm, span: 80 mm, pivot: 8 mm, pivot_length: 10 mm}}
  b: {wheels: {w: 51}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, w]}]
tooth_form: {form: involute}
material: steel
face_width: 20 mm
inputs: {a: 1}
loads: {b: 60 N m}
"""


@cache
def declared() -> TrainStrength:
    """Return the strength of the declared pair."""
    return geartrain.load(PAIR).strength()


def changed(old: str, new: str) -> geartrain.GearTrain:
    assert old in PAIR
    return geartrain.load(PAIR.replace(old, new))


def test_a_declared_pair_has_the_stresses_of_the_example() -> None:
    # case A of docs/strength.md: 1176.47 N, 638.33 and 706.85 MPa, 87.99 and 80.33 MPa
    pair = declared().pairs["p~w"]
    assert pair.tangential == pytest.approx(1176.47, abs=0.01)
    assert (pair.iso.nominal, *pair.iso.stress) == pytest.approx((638.33, 706.85, 638.33), abs=0.01)
    roots = [wheel.iso.stress for wheel in pair.wheels if wheel.iso is not None]
    assert roots == pytest.approx([87.99, 80.33], abs=0.01)
    assert [wheel.pressure for wheel in pair.wheels] == pytest.approx([796.35, 796.35], abs=0.01)


def test_stress_and_lewis_factor_are_one_statement() -> None:
    pair = declared().pairs["p~w"]
    for wheel in pair.wheels:
        assert wheel.tip_stress == pytest.approx(pair.tangential / (20 * 2 * wheel.lewis), rel=1e-9)
        assert wheel.shared_stress < wheel.tip_stress


@settings(max_examples=few_or_many(3, 10))
@given(st.floats(0.01, 50), st.floats(0.2, 10))
def test_scaling(more: float, wider: float) -> None:
    train = PAIR.replace("60 N m", f"{60 * more:.12f} N m").replace("20 mm", f"{20 * wider:.12f} mm")
    other = geartrain.load(train).strength().pairs["p~w"]
    for first, second in zip(declared().pairs["p~w"].wheels, other.wheels, strict=True):
        assert second.tip_stress == pytest.approx(first.tip_stress * more / wider, rel=1e-6)
        assert second.pressure == pytest.approx(first.pressure * sqrt(more / wider), rel=1e-6)


def test_safety_is_strength_over_stress() -> None:
    train = changed(
        "material: steel", "material: mine\nmaterials: {mine: {youngs_modulus: 206 GPa, strength: 400 MPa}}"
    )
    for wheel in train.strength().pairs["p~w"].wheels:
        assert wheel.material == "mine"
        assert wheel.root_safety == pytest.approx(400 / wheel.tip_stress)
        assert wheel.contact_safety == pytest.approx(5 / 3 * 400 / wheel.pressure)


def test_the_weakest_part_has_the_minimum_safety_of_all() -> None:
    found = declared()
    safeties = [s for w in found.pairs["p~w"].wheels for s in (w.root_safety, w.contact_safety) if s is not None]
    safeties += [arbor.safety for arbor in found.arbors if arbor.safety is not None]
    assert found.weakest.safety == min(safeties)


def test_an_arbor_is_a_round_bar_bent_in_its_middle() -> None:
    (arbor,) = declared().arbors
    force = 1176.4706 / cos(radians(20))
    bending, torsion = 32 * force * 20 / (pi * 12**3), 16 * 20_000 / (pi * 12**3)
    assert (arbor.force, arbor.bending, arbor.torsion) == pytest.approx((force, bending, torsion), rel=1e-6)
    assert arbor.stress == pytest.approx(sqrt(bending**2 + 3 * torsion**2), rel=1e-6)
    assert arbor.pivot_pressure == pytest.approx(force / 80, rel=1e-6)


def bent(loads: list[tuple[float, float, float]], span: float) -> float:
    """The greatest moment of a beam on two bearings under (place, force, couple), by equilibrium at each section."""
    right = sum(force * at + tooth_pair for at, force, tooth_pair in loads) / span
    left = sum(force for _, force, _ in loads) - right
    ends = [at + side * 1e-9 for at, _, _ in loads for side in (-1, 1)]
    return max(
        abs(left * x - sum(force * (x - at) - tooth_pair for at, force, tooth_pair in loads if at < x)) for x in ends
    )


@given(st.lists(st.tuples(st.floats(0.02, 0.98), st.floats(-9, 9), st.floats(-200, 200)), min_size=1, max_size=4))
def test_no_place_of_wheels_bends_an_arbor_more_than_its_bound(loads: list[tuple[float, float, float]]) -> None:
    span = 40.0
    placed = [(at * span, force, tooth_pair) for at, force, tooth_pair in loads]
    force, tooth_pair = (sum(abs(each[k]) for each in placed) for k in (1, 2))
    assert bent(placed, span) <= maximum_moment(force, tooth_pair, span) * (1 + 1e-9) + 1e-6


@pytest.mark.parametrize("tooth_pair", [0.0, 100.0, 300.0, 399.0, 500.0])
def test_one_wheel_bends_as_much_as_the_bound_at_its_worst_place(tooth_pair: float) -> None:
    found = max(bent([(at, 10.0, tooth_pair)], 40.0) for at in np.linspace(1e-6, 40 - 1e-6, 4001))
    assert found == pytest.approx(maximum_moment(10.0, tooth_pair, 40.0), rel=1e-3)


CROSSED_ARBOR = """
axes:
  A: {direction: [0, 0, 1], position: [0 mm, 0 mm, 0 mm]}
  B: {direction: [0, 1, 0], position: [42.426406871 mm, 0 mm, 0 mm]}
material: steel
face_width: 12 mm
links:
  frame: {}
  a:
    arbor: {diameter: 8 mm, span: 60 mm, pivot: 5 mm, pivot_length: 6 mm, material: steel}
    wheels: {p: {teeth: 20, helix_angle: 45 deg, hand: right, module: 1.5 mm}}
  b: {wheels: {w: {teeth: 20, helix_angle: 45 deg, hand: right, module: 1.5 mm}}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [{pair: [p, w]}]
inputs: {a: 1}
loads: {a: 1 N m}
solve_for: b
"""


def test_what_pushes_along_an_arbor_bends_it_and_presses_on_its_shoulder() -> None:
    """45 degrees without friction: as much along as round, 1 N m at 21.213 mm; apart, tan 20 over cos 45 of it."""
    (arbor,) = geartrain.load(CROSSED_ARBOR).strength().arbors
    radius = 30 / sqrt(2)
    round_it, across = 1000 / radius, 1000 / radius * sqrt(1 + (tan(radians(20)) * sqrt(2)) ** 2)
    assert (arbor.force, arbor.thrust) == pytest.approx((across, round_it))
    moment = (across * 60 + round_it * radius) ** 2 / (4 * across * 60)
    assert arbor.bending == pytest.approx(32 * moment / (pi * 8**3) + 4 * round_it / (pi * 8**2))
    assert arbor.pivot_pressure == pytest.approx((across + 1000 / 60) / 30)
    assert arbor.shoulder_pressure == pytest.approx(round_it / (pi / 4 * (64 - 25)))


def test_an_arbor_of_which_a_force_is_not_known_is_left_out() -> None:
    found = changed(", module: 2 mm", "").strength()
    assert found.arbors == ()
    assert [each.where for each in found.neglected] == [("p~w",), ("arbor a",)]


SWINGING = """
links:
  frame: {}
  a: {wheels: {p: {teeth: 20, module: 1 mm}}, arbor: {diameter: 6 mm, span: 40 mm, material: steel}}
  b: {wheels: {w: {teeth: 40, module: 1 mm}}}
  c: {}
revolutes: {A: [frame, a], B: [frame, b], C: [frame, c]}
gears: [p ~ w]
couplings: [{id: k, kind: pin_and_slot, pin: b, slot: c, pin_radius: 10 mm, offset: 8 mm}]
tooth_form: {form: involute}
material: steel
face_width: 5 mm
inputs: {a: 1}
loads: {c: 1 N m}
"""


def test_the_maximum_torque_of_a_turn_bends_and_presses_and_the_mean_one_wears() -> None:
    """A pin 10 mm from its axis drives a slot 8 mm off: where it is nearest the slot turns 10/(10 - 8) as fast."""
    train = geartrain.load(SWINGING)
    mean, most = train.strength(turns=10), train.strength(turns=10, over=2)
    assert [each.where for each in mean.neglected] == [("k",)]
    assert (mean.over, most.over, most.neglected) == (None, 2, ())
    for one, other in zip(mean.pairs["p~w"].wheels, most.pairs["p~w"].wheels, strict=True):
        assert other.tip_stress == pytest.approx(5 * one.tip_stress)
        assert other.shared_stress == pytest.approx(5 * one.shared_stress)  # type: ignore[operator]
        assert other.pressure == pytest.approx(sqrt(5) * one.pressure)  # type: ignore[operator]
        assert other.wear.volume == pytest.approx(one.wear.volume)
        assert other.wear.depth == pytest.approx(one.wear.depth)
    assert [each.tangential for each in most.forces] == pytest.approx([5 * each.tangential for each in mean.forces])
    assert most.arbors[0].stress == pytest.approx(5 * mean.arbors[0].stress)
    parts = train.torques(turns=2).parts
    assert parts["p~w"].maximum == pytest.approx(5)


def test_what_turns_evenly_has_no_greater_torque_than_its_mean() -> None:
    train = geartrain.load(PAIR)
    assert train.strength(over=1).pairs["p~w"].wheels[0].tip_stress == pytest.approx(
        train.strength().pairs["p~w"].wheels[0].tip_stress
    )


def test_a_safe_pair_on_crossed_axes_is_no_failure(tmp_path: Path) -> None:
    file = tmp_path / "crossed.yaml"
    for load, code in (("0.01 N m", 0), ("1 N m", 1)):
        file.write_text("name: crossed" + CROSSED_ARBOR.replace("a: 1 N m", f"a: {load}"), encoding="utf-8")
        told = ended("strength", file)
        assert (told.returncode, "no gear pair" in told.stdout) == (code, False)


def test_worn_volume_is_coefficient_times_force_times_way_over_hardness() -> None:
    found = geartrain.load(PAIR).strength(turns=1000, wear=(1e-6, 1e-4))
    # Ohlendorf's loss over friction times the energy through the pair; 190 HV
    transmission = geartrain.load(PAIR).meshes[0].path
    one, two = (arc / transmission.pitch.p for arc in transmission.arcs)
    loss = pi * (1 / 17 + 1 / 51) * (1 - one - two + one**2 + two**2)
    slid = 20_000 * 2 * pi * 1000 * loss
    wear = found.pairs["p~w"].wheels[0].wear
    assert wear.passages == 1000
    assert wear.volume == pytest.approx([1e-6 * slid / (190 * 9.80665), 1e-4 * slid / (190 * 9.80665)], rel=2e-3)


def test_years_are_turns_by_the_unit_of_speeds() -> None:
    train = changed("inputs: {a: 1}", "unit: {per: 1 d}\ninputs: {a: 2}")
    found = train.strength(years=10)
    assert found.turns == pytest.approx(2 * 3652.5)


@pytest.mark.parametrize(
    ("old", "new", "lacking"),
    [
        ("material: steel\n", "", "'p' has no `material`"),
        ("face_width: 20 mm\n", "", "'w' has no `face_width`"),
        (", module: 2 mm", "", "'p' has no `module`"),
        ("tooth_form: {form: involute}\n", "", "it has no tooth form"),
    ],
)
def test_what_is_lacking_is_named(old: str, new: str, lacking: str) -> None:
    found = changed(old, new).strength()
    assert not found.pairs
    assert lacking in found.neglected[0].why


def test_loads_without_units_are_refused() -> None:
    with pytest.raises(QuestionError, match="with a unit"):
        changed("60 N m", "60").strength()


def test_an_unknown_material_is_refused_with_its_line() -> None:
    with pytest.raises(DeclarationError, match="no material 'stel'"):
        changed("material: steel", "material: stel")


@pytest.mark.parametrize(("given", "told"), [((1, 2), "both turns and years"), ((-1, None), "life of -1 turns")])
def test_times_that_mean_nothing_are_refused(given: tuple[float, float | None], told: str) -> None:
    with pytest.raises(QuestionError, match=told):
        geartrain.load(PAIR).strength(turns=given[0], years=given[1])


def test_the_report_tells_strength_where_material_and_loads_are_declared_and_only_there() -> None:
    assert len(collect_report(geartrain.load(PAIR)).strength) == 1
    assert collect_report(changed("material: steel\n", "")).strength == ()
    assert collect_report(changed("60 N m", "60")).strength == ()


def test_pins_of_a_lantern_bend_without_lewis() -> None:
    train = changed("form: involute", "form: lantern, pin_diameter: 1.5")
    pair = train.strength().pairs["p~w"]
    pins, diameter = pair.wheels[1], 3.0
    assert pins.tip_stress == pytest.approx(pair.tangential * 20 / 12 * 32 / (pi * diameter**3), rel=1e-6)


def test_the_command_tells_the_same_as_the_library(tmp_path: Path) -> None:
    file, strength = tmp_path / "pair.yaml", declared()
    file.write_text(PAIR, encoding="utf-8")
    done = ended("strength", file, "--json")
    assert strength.weakest is not None
    assert strength.weakest.safety < 1
    assert (done.returncode, done.stderr) == (1, "")
    (state,) = json.loads(done.stdout)["states"]
    assert state == json.loads(json.dumps(strength.to_dict()))
    for title in ("Strength", "Forces", "Contact pressure", "Teeth", "Arbors"):
        assert f"\n{title}\n{'-' * len(title)}\n" in str(strength)


def test_a_wheel_that_no_teeth_fit_says_why() -> None:
    two = PAIR.replace("  b: {wheels: {w: 51}}", "  b: {wheels: {w: 51}}\n  c: {wheels: {v: 34}}").replace(
        "gears: [{pair: [p, w]}]",
        "gears: [{pair: [p, w], tooth_form: {form: involute, backlash: 0.1}}, {pair: [p, v]}]",
    )
    joints = "{pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]"
    found = geartrain.load(two.replace("{pair: [frame, b], axis: B}]", joints)).strength()
    assert "require different teeth" in found.neglected[0].why


def test_a_load_that_passes_beneath_the_roots_of_a_ring_bends_nothing() -> None:
    ring = PAIR.replace("b: {wheels: {w: 51}}", "b: {wheels: {w: {teeth: 51, internal: true}}}").replace(
        "gears: [{pair: [p, w]}]", "gears: [{pair: [p, w], tooth_form: {form: involute, addendum: [1, 0.8]}}]"
    )
    pair = geartrain.load(ring).strength().pairs["p~w"]
    assert all(0 < wheel.shared_stress < 200 for wheel in pair.wheels)


def test_a_planet_that_interferes_with_its_ring_keeps_its_strength_against_the_sun() -> None:
    """As of the same two wheels on fixed axes under the force that the carrier's torque asks for."""
    text = """
links:
  frame: {wheels: {ring: {teeth: 58, internal: true}}}
  sun: {wheels: {s: {teeth: 24, module: 1 mm}}}
  arm: {}
  planet: {wheels: {p: 17}}
revolutes: [{pair: [frame, sun], axis: A}, {pair: [frame, arm], axis: A}, {pair: [arm, planet], axis: B}]
gears: [{pair: [s, p]}, {pair: [p, ring]}]
tooth_form: {form: involute}
material: steel
face_width: 5 mm
inputs: {sun: 1}
loads: {arm: 1 N m}
"""
    found = geartrain.load(text).strength()
    assert list(found.pairs) == ["s~p"]
    assert [each.where for each in found.neglected] == [("p~ring",)]
    assert any("because the teeth of pair 'p~ring' cannot turn" in note for note in found.pairs["s~p"].notes)
    # the carrier's torque is the sun's times 1 + 58/24
    torque = 1 / (1 + 58 / 24)
    alone = geartrain.load(f"""
links: {{frame: {{}}, a: {{wheels: {{s: {{teeth: 24, module: 1 mm}}}}}}, b: {{wheels: {{p: 17}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [s, p]}}]
tooth_form: {{form: involute}}
material: steel
face_width: 5 mm
inputs: {{a: 1}}
loads: {{b: {torque * 17 / 24!r} N m}}
""").strength()
    assert found.pairs["s~p"].tangential == pytest.approx(torque * 1e3 / 12)
    for one, other in zip(found.pairs["s~p"].wheels, alone.pairs["s~p"].wheels, strict=True):
        assert (one.tip_stress, one.pressure) == pytest.approx((other.tip_stress, other.pressure))
        assert one.iso.stress == pytest.approx(other.iso.stress)


def test_an_arbor_is_twisted_by_its_torque_and_bent_by_the_force_of_its_mesh() -> None:
    """With friction the force of the mesh is more than the driven wheel's torque over its radius."""
    text = PAIR.replace("links:", "friction: 0.15\nlinks:").replace(
        "b: {wheels: {w: 51}}", "b: {wheels: {w: 51}, arbor: {diameter: 12 mm, span: 80 mm}}"
    )
    driver, driven = geartrain.load(text).strength().arbors
    assert driven.torsion == pytest.approx(16 * 60e3 / (pi * 12**3))
    assert driven.force == pytest.approx(driver.force, rel=1e-12)
