"""Couplings that move by steps: Geneva drives, fingers and stars, count wheels, mutilated wheels.

Expected numbers are from closed forms of the pin's position, from arcs and from counting of teeth by hand.
"""

from __future__ import annotations

from fractions import Fraction
from math import atan2, cos, degrees, pi, radians, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
from commands import call
from models import torque_figures, transmission_of

from geartrain import DeclarationError, GearTrainError, load

PAIR = """
links: {frame: {}, a: {}, w: {}}
revolutes: {A: [frame, a], W: [frame, w]}
couplings: [{DECLARED}]
inputs: {a: 1}
outputs: {w: {}}
"""


def pair(declared: str, more: str = "") -> str:
    return PAIR.replace("{DECLARED}", f"{{pair: [a, w], {declared}}}") + more


def angle_of_slot(slots: int, S: float, internal: bool = False) -> float:
    """Direction in which the driven axis sees the pin [rad]: vectors from both axes, at a distance of 1."""
    r = sin(pi / slots)
    # the driven axis is at (1, 0); an internal pin points away from it at S = 0
    x, y = (-r * cos(S) - 1, r * sin(S)) if internal else (r * cos(S) - 1, r * sin(S))
    return atan2(y, -x)


@pytest.mark.parametrize(
    ("slots", "moves", "peak", "start", "greatest"),
    [
        (3, Fraction(1, 6), 6.4641016151, 1.7320508, 31.392428470),
        (4, Fraction(1, 4), 2.4142135624, 1.0, 5.4069810346),
        (6, Fraction(1, 3), 1.0, 0.57735027, 1.3496372759),
        (8, Fraction(3, 8), 0.61991440442, 0.41421356, 0.69975698413),
    ],
)
def test_g1_a_geneva_drive_moves_for_a_share_of_the_turn_and_with_known_peaks(
    slots: int, moves: Fraction, peak: float, start: float, greatest: float
) -> None:
    transmission = transmission_of(pair(f"kind: geneva, slots: {slots}"))
    assert 1 - transmission.dwell == moves
    assert transmission.speed_range() == (0, pytest.approx(peak, rel=1e-10))
    S = np.linspace(-transmission.alpha, transmission.alpha, 400_001)
    q = np.array([angle_of_slot(slots, each) for each in S])
    speed = np.gradient(q, S)
    np.testing.assert_allclose(transmission.angle(S), q, atol=1e-12)
    assert speed[len(S) // 2] == pytest.approx(peak, rel=1e-7)
    assert np.gradient(speed, S)[2] == pytest.approx(start, rel=1e-3)
    assert transmission.steepest_fall() == pytest.approx(greatest, rel=1e-10)
    assert -np.gradient(speed, S)[5:-5].min() == pytest.approx(greatest, rel=1e-5)


def test_g2_a_cross_of_four_slots_has_these_angles_and_this_deviation() -> None:
    transmission = transmission_of(pair("kind: geneva, slots: 4"))
    since_rest = [degrees(float(transmission.angle(radians(S))) + pi / 4) for S in (-30, 20)]
    assert since_rest == pytest.approx([2.6321948414, 80.782906978], abs=5e-10)
    assert transmission.speed(radians(-30)) == pytest.approx(0.40824829046, rel=1e-10)
    low, high = transmission.error_range()
    assert degrees(high - low) == pytest.approx(70.404096748, abs=5e-10)
    assert transmission.error([radians(-34.4157756), radians(34.4157756)]) == pytest.approx([low, high], abs=1e-12)


def test_g3_an_internal_geneva_drive_moves_for_three_quarters_of_the_turn() -> None:
    transmission = transmission_of(pair("kind: geneva, slots: 4, internal: true"))
    assert 1 - transmission.dwell == Fraction(3, 4)
    assert transmission.speed_range()[1] == pytest.approx(0.41421356237, rel=1e-10)
    assert degrees(float(transmission.angle(1.0)) + pi / 4) == pytest.approx(68.293161518, abs=5e-10)
    S = np.linspace(-2.3, 2.3, 101)
    np.testing.assert_allclose(transmission.angle(S), [angle_of_slot(4, each, True) for each in S], atol=1e-12)
    # it slows down most at the end of the step, where q'' is tan(pi/n)
    assert transmission.steepest_fall() == pytest.approx(1.0)
    ends = np.linspace(0, 3 * pi / 4, 100_001)
    assert -np.gradient(transmission.speed(ends), ends)[:-5].min() == pytest.approx(1.0, rel=1e-3)


def test_g4_a_geneva_drive_adds_to_the_motion_of_its_driver_in_a_differential() -> None:
    train = load("""
links:
  frame: {}
  a: {angle: 180 deg, wheels: {sa: {teeth: 20, kind: bevel}}}
  w: {wheels: {w30: 30}}
  v: {wheels: {v30: 30}}
  b: {wheels: {sb: {teeth: 20, kind: bevel, facing: -1}, b30: 30}}
  out: {}
  spider: {wheels: {p: {teeth: 20, kind: bevel}}}
axes: {A: {direction: [0, 0, 1]}, W: {direction: [0, 0, 1]}, V: {direction: [0, 0, 1]}, P: {direction: [1, 0, 0]}}
revolutes: {A: [frame, a, b, out], W: [frame, w], V: [frame, v], P: [out, spider]}
gears: [w30 ~ v30, v30 ~ b30, sa ~ p, sb ~ p]
couplings: [{kind: geneva, pair: [a, w], slots: 4}]
inputs: {a: 1}
outputs: {out: {expect: 3/8}, w: {expect: -1/4}}
""")
    assert train.solve()["out"] == Fraction(3, 8)
    found = train.motion(outputs=["out"]).at([1.1])
    assert 1.1 * 3 / 8 + found.error[0, 0] / (2 * pi) == pytest.approx(0.425, abs=1e-12)


def test_pins_that_follow_each_other_without_rest_keep_the_cross_moving() -> None:
    transmission = transmission_of(pair("kind: geneva, slots: 4, pins: 4"))
    assert (transmission.ratio, transmission.dwell) == (1, 0)
    S = np.linspace(0, 2 * pi, 20_001)
    error = transmission.error(S)
    assert transmission.error_range() == pytest.approx((error.min(), error.max()), abs=1e-7)
    assert transmission.error_moments()[1] == pytest.approx(float(np.sqrt((error[:-1] ** 2).mean())), rel=1e-7)


def test_s1_a_moon_disc_of_59_teeth_loses_a_day_in_964_days() -> None:
    train = load(pair("kind: step, teeth: 59, times: 2", "unit: {per: 1 d}\n"))
    assert 1 / abs(train.solve()["w"]) == Fraction(59, 2)
    error = Fraction(2, 59) / (1 / Fraction("29.530588853")) - 1
    assert float(error) * 1e6 == pytest.approx(1036.9102712, abs=5e-8)
    assert float(error) * 86400 == pytest.approx(89.58904743, abs=5e-9)
    assert float(1 / error) == pytest.approx(964.40360, abs=5e-6)


def test_s2_a_count_wheel_of_78_teeth_turns_once_in_twelve_hours() -> None:
    declared = pair("kind: step, teeth: 78, moves: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]")
    train = load(declared)
    assert train.solve()["w"] == Fraction(-1, 12)
    run = train.motion().run(turns=12, samples=1201)
    # counted by hand: before the 7th engagement 21 teeth instead of 39, after the 12th 78 instead of 71.5
    assert degrees(run.statistics[0].minimum) == pytest.approx(-30, abs=1e-6)
    assert degrees(run.statistics[0].most) == pytest.approx(83.076923, abs=1e-6)
    low, high = transmission_of(declared).error_range()
    assert (degrees(low), degrees(high)) == pytest.approx((-83.076923, 30), abs=1e-6)


def test_s3_a_mutilated_wheel_drives_for_two_fifths_of_the_turn() -> None:
    declared = "kind: step, teeth: 24, moves: 12, over: 144 deg"
    train = load(pair(declared))
    transmission = transmission_of(pair(declared))
    assert train.solve()["w"] == Fraction(-1, 2)
    assert 1 - transmission.dwell == Fraction(2, 5)
    assert transmission.speed([1.0, 3.0]) == pytest.approx([5 / 4, 0])
    low, high = transmission.error_range()
    assert (high - low) / (2 * pi) == pytest.approx(3 / 10)
    # a triangle between 0 and h has the rms value h/sqrt(12)
    assert transmission.error_moments() == pytest.approx((0.15 * 2 * pi, 0.3 * 2 * pi / sqrt(12)))


FINGER = """
frame: dial
links:
  dial: {wheels: {r109: {teeth: 109, internal: true}}}
  hour: {}
  star: {wheels: {p14: 14}}
  second: {wheels: {w18: 18, q14: 14}}
  disc: {}
revolutes: {main: [dial, hour, disc], S: [disc, star], T: [disc, second]}
gears: [p14 ~ w18, q14 ~ r109]
couplings: [{kind: step, pair: [hour, star], teeth: 12}]
inputs: {hour: 1}
"""


def test_s4_a_finger_turns_a_disc_that_carries_its_star() -> None:
    answer = load(FINGER).solve()
    assert (answer["disc"], answer["star"]) == (Fraction(-49, 5837), Fraction(-83, 898))


def test_s4_as_a_wheel_of_one_tooth_has_the_same_mean_and_a_remark() -> None:
    case = Path(__file__).parents[1] / "data/public_cases/10-finger-and-star.yaml"
    assert load(case).solve()["disc"] == Fraction(-49, 5837)
    assert "a finger drives in steps; declare it as `kind: step`" in call("check", case).stdout


def test_a_driver_that_rests_where_an_engagement_begins_has_begun_it() -> None:
    # a counter of three digits: the tens move with the tenth unit, whatever rounding does to ten tenths of a turn
    train = load("""
links: {frame: {}, a: {}, b: {}, c: {}, d: {}}
revolutes: {A: [frame, a], B: [frame, b], C: [frame, c], D: [frame, d]}
couplings:
  - {kind: step, pair: [a, b], teeth: 10}
  - {kind: step, pair: [b, c], teeth: 10}
  - {kind: step, pair: [c, d], teeth: 10}
inputs: {a: 1}
outputs: {b: {}, c: {}, d: {}}
""")
    turns = np.arange(1000) + 0.5
    motion = train.motion()
    error = motion.at(turns).error / (2 * pi)
    teeth = 10 * np.abs(np.array([[-0.1], [0.01], [-0.001]]) * turns + error)
    expected = [np.arange(1000) // each for each in (1, 10, 100)]
    np.testing.assert_allclose(teeth - teeth[:, :1], expected, atol=1e-9)
    assert not motion.run(turns=100, samples=1001).reversing_drivers


def test_the_torque_of_a_geneva_drive_is_the_load_times_the_speed_ratio() -> None:
    train = load(pair("kind: geneva, slots: 4", "loads: {w: 0.3 N m}\n"))
    assert train.torques().external["a"] == Fraction(3, 40)
    cycle = train.torques(turns=1, samples=2001)
    assert cycle.mean == pytest.approx(0.075, rel=1e-9)
    assert cycle.maximum is not None
    assert cycle.maximum.torque == pytest.approx(0.3 * 2.4142135624, rel=1e-8)
    assert float(cycle.torque.min()) == pytest.approx(0, abs=1e-12)


def test_a_jumper_takes_its_energy_at_every_tooth() -> None:
    train = load(pair("kind: step, teeth: 59, times: 2, loss: 0.3 mJ", "loads: {w: 0.3 N m}\n"))
    assert float(train.torques().external["a"]) == pytest.approx(0.3 * 2 / 59 + 0.3e-3 * 2 / (2 * pi), rel=1e-12)


def test_a_step_at_once_has_no_force() -> None:
    declared = pair("kind: step, teeth: 59, times: 2", "loads: {w: 0.3 N m}\nrate: 1 turn/s\n")
    with pytest.raises(GearTrainError, match="give `over`"):
        load(declared).torques(turns=1)
    heavy = declared.replace("w: {}}\nrev", "w: {inertia: 1e-6 kg m2}}\nrev")
    with pytest.raises(GearTrainError, match="an instantaneous step has no defined force"):
        load(heavy).dynamics(turns=1)


@pytest.mark.parametrize(
    ("declared", "mean", "lost"),
    [
        ("kind: geneva, slots: 4", Fraction(1, 4), 0.0),
        # J v^2 a turn is lost where a step begins and where the lock ends it
        ("kind: step, teeth: 24, moves: 12, over: 144 deg", Fraction(1, 2), 2e-7 * (2.5 * pi) ** 2),
    ],
)
def test_the_driver_does_the_work_of_the_load_in_time(declared: str, mean: Fraction, lost: float) -> None:
    text = pair(declared, "loads: {w: 2 N mm}\nrate: 1 turn/s\n").replace(
        "w: {}}\nrev", "w: {inertia: 2e-7 kg m2}}\nrev"
    )
    run = load(text).dynamics(turns=2, skip=1, fast=False)
    assert run.torque == pytest.approx(2e-3 * float(mean) + lost / (2 * pi), rel=2e-3)


@pytest.mark.parametrize(
    ("declared", "what"),
    [
        ("kind: geneva, slots: 2", "slots"),
        ("kind: geneva, slots: 5, pins: 4", "with 4 pins and 5 slots, two pins would be in slots at the same time"),
        ("kind: geneva, slots: 5, pins: 2, internal: true", "with 2 pins and 5 slots, two pins would be in slots"),
        ("kind: step, teeth: 6, moves: 7", "more than the 6 teeth"),
        ("kind: step, teeth: 6, times: 3, over: 121 deg", "would still be moving when the next engagement begins"),
        ("kind: step, teeth: 6, moves: [0, 0]", "never moves"),
        ("kind: step, teeth: 6, over: -1 deg", "below 0"),
    ],
)
def test_a_coupling_that_cannot_step_is_refused(declared: str, what: str) -> None:
    with pytest.raises(DeclarationError, match=what):
        load(pair(declared))


def test_the_cross_cannot_drive() -> None:
    train = load(pair("kind: geneva, slots: 4").replace("inputs: {a: 1}", "inputs: {w: 1}"))
    assert train.solve()["a"] == -4
    with pytest.raises(GearTrainError, match="past a dead centre"):
        train.motion(outputs=["a"]).run(turns=1, samples=101)
    declared = pair("kind: step, teeth: 6").replace("inputs: {a: 1}", "inputs: {w: 1}")
    with pytest.raises(GearTrainError, match="turns its own driver"):
        load(declared).motion(outputs=["a"]).run(turns=1, samples=101)


def test_solve_and_motion_state_the_share_at_rest(tmp_path: Path) -> None:
    file = tmp_path / "cross.yaml"
    file.write_text(pair("kind: geneva, slots: 4"), encoding="utf-8")
    assert "moves 1/4 of the time" in call("solve", file).stdout
    assert "a~w       3/4               1/4         2.4142136" in call("motion", file, "--turns", "2").stdout
    file.write_text(pair("kind: step, teeth: 59, times: 2"), encoding="utf-8")
    assert "moves at once, 2 times a turn of the driver" in call("report", file).stdout
    assert "at once" in call("motion", file, "--turns", "2").stdout


def test_a_wheel_of_two_teeth_is_a_finger_only_for_a_large_mate(tmp_path: Path) -> None:
    file = tmp_path / "two.yaml"
    text = "links: {frame: {}, a: {wheels: {x: 2}}, w: {wheels: {y: TEETH}}}\n"
    text += "revolutes: {A: [frame, a], W: [frame, w]}\ngears: [x ~ y]\ninputs: {a: 1}\n"
    for teeth, remarked in ((20, False), (21, True)):
        file.write_text(text.replace("TEETH", str(teeth)), encoding="utf-8")
        assert ("'x' has two teeth" in call("check", file).stdout) == remarked


def test_the_lock_keeps_the_driven_link_from_driving() -> None:
    train = load(pair("kind: geneva, slots: 4", "loads: {w: 0.3 N m}\n"))
    drives = torque_figures(train).drives
    assert [each.way.torques.verdict.kind for each in drives] == ["incomplete", "self-locking"]
