"""Outputs against the sky, and what one tooth changes."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import Any

import pytest
from models import PLANETARY

from geartrain import GearTrain, GearTrainError, load

LUNAR = """
name: lunar
unit: {{per: {unit}}}
sources: {{P74: Price 1974}}
links:
  frame: {{}}
  year: {{wheels: {{b64: 64, x: 10}}}}
  mid: {{wheels: {{c38: 38, c48: 48}}}}
  low: {{wheels: {{d24: 24, d127: {{teeth: {teeth}}}}}}}
  moon: {{wheels: {{e32: 32}}}}
  apart: {{wheels: {{y: 30}}}}
revolutes: {{year: [frame, year], mid: [frame, mid], low: [frame, low], moon: [frame, moon], apart: [frame, apart]}}
gears: [{{pair: [b64, c38]}}, {{pair: [c48, d24]}}, {{pair: [d127, e32]}}, {{pair: [x, y]}}]
inputs: {{year: 1}}
outputs:
  moon: {{targets: [{target}]}}
  apart: {{}}
"""
# 64/38 x 48/24 x 127/32 = 254/19 sidereal months a year
MONTHS = Fraction(254, 19)


def lunar(target: str, unit: str = "365.25 d", teeth: str = "127") -> GearTrain:
    return load(LUNAR.format(target=target, unit=unit, teeth=teeth))


def against(target: str, unit: str = "365.25 d", teeth: str = "127") -> Any:
    return lunar(target, unit, teeth).solve().outputs["moon"].targets[0]


@pytest.mark.parametrize(
    ("target", "unit", "wanted"),
    [
        ("{period: 27.32 d}", "365.25 d", Fraction("365.25") / Fraction("27.32")),
        ("{period: 109.28 d, turns: 4}", "365.25 d", Fraction("365.25") / Fraction("27.32")),
        ("{period: 12 h}", "1 d", Fraction(2)),
        ("month_sidereal_J2000", "year_sidereal_J2000", Fraction("365.256363004") / Fraction("27.321661547")),
        ("lunar_nodes_per_year_saros", "year_julian", Fraction(12, 223)),  # -12/223 in the table
        ("{name: lunar_nodes_per_year_saros, sense: retrograde}", "year_julian", Fraction(-12, 223)),
        ("{speed: -13}", "365.25 d", Fraction(-13)),
        ("{speed: -14}", "365.25 d", Fraction(-14)),
        ("{speed: -1/1000000}", "365.25 d", Fraction(-1, 10**6)),
    ],
)
def test_the_error_of_a_target_is_positive_if_it_is_fast(target: str, unit: str, wanted: Fraction) -> None:
    result = against(target, unit)
    assert (result.speed, result.error, result.met) == (wanted, MONTHS / abs(wanted) - 1, None)
    assert result.ppm == pytest.approx(float(result.error * 10**6))
    # after a turn of the unit the pointer is this much past the target, after 36525 days so many days' worth
    assert result.degrees_per_unit == pytest.approx(float(MONTHS - abs(wanted)) * 360)
    assert result.days_per_century == pytest.approx(float(result.error) * 36525)


@pytest.mark.parametrize(
    ("target", "speed", "error", "met"),
    [
        ("{period: 27.32 d}", 0, -1, None),
        ("{speed: 0, tolerance: 0}", 0, 0, True),
        ("{period: 27.32 d}", None, 0, None),
    ],
)
def test_a_pointer_at_rest_or_without_a_speed_is_compared_too(
    target: str, speed: int | None, error: int, met: bool | None
) -> None:
    text = LUNAR.format(target=target, unit="365.25 d", teeth="127")
    train = load(text.replace("inputs: {year: 1}", "" if speed is None else f"inputs: {{year: {speed}}}"))
    result = train.solve().outputs["moon"]
    assert result.speed == speed
    assert [(each.error, each.met) for each in result.targets] == ([] if speed is None else [(error, met)])
    json.dumps(result.to_dict(), allow_nan=False)


def test_a_speed_is_compared_with_its_sign() -> None:
    forward, backward = against("{speed: 254/19}"), against("{speed: -254/19}")  # the pointer is at -254/19
    assert (forward.speed, forward.error, forward.compared) == (MONTHS, -2, "speed")
    assert (backward.speed, backward.error, backward.compared) == (-MONTHS, 0, "speed")
    assert against("{speed: 254/19, tolerance: 199 %}").met is False
    assert against("{speed: -254/19, tolerance: 0}").met is True


def test_a_period_or_a_name_is_a_magnitude_unless_a_sense_signs_it() -> None:
    for target in ("period: 27.32 d", "name: month_tropical_J2000"):
        either, back, ahead = (
            against(f"{{{target}{more}}}") for more in ("", ", sense: retrograde", ", sense: direct")
        )
        assert either.compared == "magnitude"
        assert back.compared == ahead.compared == "speed"
        assert either.speed == ahead.speed == -back.speed > 0
        assert back.error == either.error
        assert ahead.error == -2 - either.error
        assert back.degrees_per_unit == either.degrees_per_unit
        assert either.to_dict()["compared"] == "magnitude"


@pytest.mark.parametrize(
    ("tolerance", "met"), [("", None), (", tolerance: 0", False), (", tolerance: 13", False), (", tolerance: 14", True)]
)
def test_a_speed_of_zero_is_compared_by_difference(tolerance: str, met: bool | None) -> None:
    for zero in ("0", "0.0", "0/7", "-0"):
        result = against(f"{{speed: {zero}{tolerance}}}")
        assert (result.speed, result.error, result.compared, result.met) == (0, -MONTHS, "difference", met)
        assert result.ppm is result.days_per_century is None
        assert result.degrees_per_unit == pytest.approx(-360 * 254 / 19)


@pytest.mark.parametrize(
    ("target", "said"),
    [
        ("{period: 0 d}", "a period must be greater than 0, not 0 d"),
        ("{period: 0}", "a period must be greater than 0, not 0"),
        ("{period: -27 d}", "a period must be greater than 0, not -27 d"),
        ("{period: 27 d, turns: 0}", "0 turns is not a number above 0"),
        ("{name: month_synodic_J2000, turns: -4}", "-4 turns is not a number above 0"),
        ("{speed: 3, turns: 0}", "0 turns is not a number above 0"),
        ("{speed: 3, sense: direct}", "the speed 3 and `sense` are both given"),
        ("{period: 27 d, sense: backwards}", "is not one of the allowed values"),
        ("{speed: 0, tolerance: 20 ppm}", "a relative tolerance of 20 ppm is 0 for a speed of 0"),
        ("{speed: 0, tolerance: 1 %}", "a relative tolerance of 1 % is 0 for a speed of 0"),
        ("{period: 27 d, tolerance: -20 ppm}", "a tolerance of -20 ppm is negative"),
    ],
)
def test_targets_that_no_pointer_could_show_are_refused_in_four_parts(target: str, said: str) -> None:
    with pytest.raises(GearTrainError) as caught:
        lunar(target)
    (problem,) = caught.value.problems
    assert said in problem.what
    assert problem.place
    assert problem.fix


@pytest.mark.parametrize(
    ("output", "said"),
    [
        ("published: {value: 0, as: input/output}", "would mean that the input is at rest"),
        ("published: {value: 0/5, as: input/output, tolerance: 0}", "would mean that the input is at rest"),
        ("published: {value: 1, tolerance: -1}", "a tolerance of -1 is negative"),
        ("expect: {value: 1, tolerance: -0.5}", "a tolerance of -0.5 is negative"),
    ],
)
def test_figures_that_nothing_could_meet_are_refused(output: str, said: str) -> None:
    with pytest.raises(GearTrainError, match=said):
        load(LUNAR.format(target="", unit="1 d", teeth="127").replace("apart: {}", f"apart: {{{output}}}"))


def test_a_pointer_that_stands_still_is_published_as_a_ratio_of_zero() -> None:
    output = "{relative_to: apart, published: {value: 0, as: output/input}}"
    text = LUNAR.format(target="", unit="1 d", teeth="127").replace("  apart: {}\n", f"  apart: {output}\n")
    assert load(text).solve().outputs["apart"].published_holds is True


@pytest.mark.parametrize("unit", ["0 d", "0", "-7 d", "0 ft", "-1 h", "0/3 d"])
def test_a_unit_takes_some_time_or_way(unit: str) -> None:
    with pytest.raises(GearTrainError, match=f"a unit must be greater than 0, not '{unit}'"):
        lunar("{speed: 1}", unit=unit)


@pytest.mark.parametrize(
    ("tolerance", "met"),
    [("70 ppm", True), ("60 ppm", False), ("0.007 %", True), ("0.00007", True), ("0.006 %", False)],
)
def test_a_target_is_met_within_its_tolerance(tolerance: str, met: bool) -> None:
    # 27.32 x 254 / (365.25 x 19) = 6939.28 / 6939.75: -67.7 ppm
    result = against(f"{{period: 27.32 d, tolerance: {tolerance}, source: P74}}")
    assert float(result.error) == pytest.approx(-0.47 / 6939.75, rel=1e-9)
    assert result.met is met


def test_one_tooth_less_or_more_is_what_the_changed_train_shows() -> None:
    train = lunar("{period: 27.32 d}", teeth="{value: 127, range: [125, 129]}")
    answer = train.solve()
    (row,) = train.kinematics.sensitivity(answer)
    assert (row.wheel, row.teeth, row.output) == ("d127", 127, "moon")
    assert row.allowed == (125, 126, 127, 128, 129)
    for shift, teeth in ((row.less, "126"), (row.more, "128")):
        other = lunar("{period: 27.32 d}", teeth=teeth).solve()["moon"]
        assert shift == pytest.approx(float(other / answer["moon"] - 1) * 1e6, rel=1e-12)


def test_a_wheel_without_doubt_has_no_sensitivity_and_an_output_it_does_not_drive_no_row() -> None:
    certain, doubtful = lunar("{period: 27.32 d}"), lunar("{period: 27.32 d}", teeth="{value: 127, range: [126, 128]}")
    assert list(certain.kinematics.sensitivity(certain.solve())) == []
    assert {row.output for row in doubtful.kinematics.sensitivity(doubtful.solve())} == {"moon"}


@pytest.mark.parametrize(("wheel", "teeth"), [("s: 24", 24), ("ring: {teeth: 60", 60)])
def test_sensitivity_holds_inside_an_epicyclic_and_for_relative_speeds(wheel: str, teeth: int) -> None:
    rest = "inputs: {sun: 1}\noutputs: {carrier: {}, rel: {of: planet, relative_to: carrier}}"
    text, start = PLANETARY.format(rest=rest), wheel.removesuffix(f"{teeth}")
    value = f"{{value: {teeth}, choices: [{teeth - 1}, {teeth}, {teeth + 1}]}}"
    train = load(text.replace(wheel, start + (f"{{teeth: {value}}}" if teeth == 24 else value)))
    answer = train.solve()
    rows = {row.output: row for row in train.kinematics.sensitivity(answer)}
    assert set(rows) == {"carrier", "rel"}
    for step in (-1, 1):
        other = load(text.replace(wheel, f"{start}{teeth + step}")).solve()
        for name, row in rows.items():
            shift = row.less if step < 0 else row.more
            assert shift == pytest.approx(float(other[name] / answer[name] - 1) * 1e6, rel=1e-12)


def test_one_tooth_in_a_closed_loop_locks_the_train_and_has_no_number() -> None:
    train = load(
        """
        links:
          frame: {}
          a: {wheels: {p: {teeth: {value: 20, range: [19, 21]}}, q: 20}}
          b: {wheels: {w: 40, x: 40}}
        revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
        gears: [{pair: [p, w]}, {pair: [q, x]}]
        inputs: {a: 1}
        outputs: {b: {}}
        """
    )
    assert train.solve()["b"] == Fraction(-1, 2)
    (row,) = train.kinematics.sensitivity(train.solve())
    assert (row.less, row.more) == (None, None)


def test_a_wheel_of_one_tooth_can_lose_none() -> None:
    train = lunar("{period: 27.32 d}", teeth="{value: 1, range: [1, 2]}")
    (row,) = train.kinematics.sensitivity(train.solve())
    assert row.less is None
    assert row.more == pytest.approx(1e6)


# two pairs that share a link which nothing drives; the arm's frame is another train's
LOOSE = """
links: {frame: {}, a: {wheels: {a20: 20}}, b: {wheels: {b20: {teeth: 20, internal: true}}}, arm: {}, c: {}}
revolutes: {main: [frame, arm], A: [arm, a], B: [arm, b], C: [frame, c]}
gears: [{pair: [a20, b20]}]
inputs: {c: 1}
outputs:
  both: {of: a, relative_to: b, expect: 0}
  one: {of: a}
"""


@pytest.mark.parametrize("method", ["exact", "floats"])
def test_a_relative_speed_is_known_where_both_links_are_free(method: Any) -> None:
    train = load(LOOSE)
    full = train.solve(method=method)
    assert full.verdict.kind == "free"
    assert full.outputs["both"].speed == 0
    assert not full.failures
    assert full.outputs["one"].speed is None
    alone = train.solve(output="both", method=method)
    assert (alone.verdict.kind, alone["both"]) == ("determined", 0)
    assert alone.verdict.text == "the speed of a relative to b follows from c"
    assert train.solve(output="one", method=method).verdict.kind == "free"


def test_a_train_that_nothing_drives_and_nothing_could_is_locked_and_stands() -> None:
    train = load({"links": {"frame": {}, "a": {}}, "revolutes": [{"pair": ["frame", "a"], "axis": "A"}],
                  "fixed": ["a"], "outputs": {"a": {"expect": 0}}})  # fmt: skip
    for answer in (train.solve(), train.solve(output="a"), train.solve(method="floats")):
        assert (answer.verdict.kind, answer["a"]) == ("locked", 0)
        assert not answer.failures


OBLIQUE = """
axes: {across: {direction: [1, 0, 0]}, along: {direction: [1, 0, 0]}}
links: {frame: {}, crown: {}, spider: {}, pin: {}}
revolutes: {main: [frame, crown], across: [crown, spider], along: [spider, pin]}
inputs: {crown: 1}
outputs:
  whole: {of: spider}
  on its carrier: {of: spider, relative_to: crown}
  seen: {of: crown, relative_to: spider}
  from afar: {of: crown, relative_to: pin}
  past the spider: {of: pin, relative_to: crown}
  upright: {of: crown}
"""


def test_a_relative_speed_is_a_rotation_where_the_axes_between_are_parallel() -> None:
    outputs = load(OBLIQUE).solve().outputs
    sums = {name for name, result in outputs.items() if result.bookkeeping}
    assert sums == {"whole"}
    from_the_frame = OBLIQUE.replace("crown, relative_to: spider", "frame, relative_to: spider")
    assert load(from_the_frame).solve().outputs["seen"].bookkeeping
