"""Errors of hand-cut wheels as a train declares them."""

from __future__ import annotations

from fractions import Fraction

import pytest
from models import refusal

from geartrain import GearTrain, load

PAIR = """
links:
  frame: {{}}
  a: {{wheels: {{p: {{teeth: 4, {wheel}}}}}}}
  b: {{wheels: {{w: 60}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, w]{pair}}}]
inputs: {{a: 1}}
{rest}
"""


def declared(wheel: str = "", pair: str = "", rest: str = "") -> GearTrain:
    return load(PAIR.format(wheel=wheel, pair=pair, rest=rest))


def test_a_bare_value_is_a_fixed_error_and_a_mapping_is_a_distribution() -> None:
    train = declared("cutting: {pitch_deviation: 0.5 deg, tip: {normal: 0.1 mm}}").declaration
    cutting = train.wheels["p"][1].cutting
    assert cutting.pitch_deviation.value.base == Fraction(1, 720)
    assert cutting.tip.normal.base == Fraction(1, 10000)


def test_a_plain_number_and_a_percentage_are_fractions_of_the_nominal() -> None:
    train = declared(rest="cutting: {pitch_deviation: {normal: 4.13 %}, eccentricity: {uniform: 0.02}}").declaration
    assert train.cutting.pitch_deviation.normal.base == Fraction(413, 10000)
    assert train.cutting.eccentricity.uniform.unit is None


def test_errors_of_the_fit_stand_on_the_pair() -> None:
    gear = declared(pair=", fitting: {centre: {normal: 0.1 mm}, bearing: 0.05 mm}").declaration.gears[0]
    assert gear.fitting.bearing is not None
    assert gear.fitting.centre is not None


def test_errors_change_no_mean_speed() -> None:
    assert declared("cutting: {pitch_deviation: 10 deg, eccentricity: 1 mm}").solve()["b"] == Fraction(-1, 15)


@pytest.mark.parametrize(
    ("wheel", "rest", "said"),
    [
        ("cutting: {measured: {tip: [0.1 mm, 0, 0]}}", "", "'tip' has 3 measured values, but wheel"),
        ("cutting: {pitch_deviation: {normal: 1 deg, uniform: 2 deg}}", "", "found: normal and uniform"),
        ("cutting: {pitch_deviation: {}}", "", "found: nothing"),
        ("cutting: {tip: {normal: -0.1 mm}}", "", "is negative"),
        ("cutting: {pitch_deviation: 3 mm}", "", "is a length"),
        ("cutting: {eccentricity: 3 deg}", "", "is an angle"),
        ("cutting: {placment: 1 deg}", "", "pitch_deviation"),
        ("cutting: {tip: 0.1 mm, source: who}", "", "no source 'who'"),
        ("", "fitting: {centre: 0.1 mm, source: who}", "no source 'who'"),
    ],
)
def test_slips_are_named_with_their_place(wheel: str, rest: str, said: str) -> None:
    text = refusal(PAIR.format(wheel=wheel, pair="", rest=rest))
    assert said in text
    assert "fix:" in text
