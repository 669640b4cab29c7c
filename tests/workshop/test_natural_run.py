"""Over how many turns a budget tells the torque: a year, or a period after which everything repeats."""

from __future__ import annotations

from fractions import Fraction

import pytest
from models import load

from geartrain.dynamics import find_torque_period
from geartrain.workshop.budget.crank_load import YEAR, natural_turns

TEETH = """
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
friction: 0.2
"""


def test_a_year_of_a_crank_that_turns_five_times_in_it() -> None:
    train = load(f"extends: pennestri-2002{TEETH}links: {{'5': {{bearing: 1 N mm}}}}\n")
    assert find_torque_period(train.mechanics) == 95
    assert natural_turns(train, None, "2") == pytest.approx(5, rel=1e-9)


def test_a_clock_repeats_long_before_a_year_has_passed() -> None:
    """Between weight and escape wheel 8, 60 and 420 teeth pass in an hour: a quarter of each in a quarter."""
    train = load("extends: longcase-clock-bs978\nloads: {escape: -1 N mm}\n")
    assert find_torque_period(train.mechanics) == Fraction(1, 4)
    assert natural_turns(train, None, "centre") == 0.25


def test_teeth_that_keep_their_ratio_repeat_too_where_their_friction_is_uneven() -> None:
    train = load("extends: longcase-clock-cycloidal\nfriction: 0.2\nloads: {escape: -1 N mm}\n")
    period = find_torque_period(train.mechanics)
    assert period == Fraction(1, 4)
    found = train.torques(turns=1, samples=200)
    assert found.period == 0.25
    for turns in (0.0321, 0.2, 0.61):
        assert found.at(turns) == pytest.approx(found.at(turns + 0.25), rel=1e-6)


def test_where_nothing_is_uneven_an_hour_tells_as_much_as_a_year() -> None:
    train = load("extends: longcase-clock\nloads: {escape: -1 N mm}\n")
    assert find_torque_period(train.mechanics) is None
    assert natural_turns(train, None, "centre") == 1


def test_a_year_counts_days_of_the_unit_of_speeds() -> None:
    """A pin that comes round in a thousand days: a year is so many turns of a wheel that turns once a day."""
    train = load("""
links: {frame: {}, day: {wheels: {a: 10}}, slow: {wheels: {b: 10000}}, slot: {bearing: 1 N mm}}
revolutes: [{pair: [frame, day], axis: A}, {pair: [frame, slow], axis: B}, {pair: [frame, slot], axis: C}]
gears: [{pair: [a, b]}]
couplings: [{kind: pin_and_slot, pin: slow, slot: slot, pin_radius: 10 mm, offset: 2 mm}]
unit: {per: 1 d}
inputs: {day: 1}
""")
    assert find_torque_period(train.mechanics) == 1000
    assert natural_turns(train, None, "day") == pytest.approx(float(YEAR), rel=1e-12)
