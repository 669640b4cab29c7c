"""Periods and magnitudes as sources print them, and the rates of clocks: s a day, s a year, a day off."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import yaml
from commands import call

from geartrain import load
from geartrain.errors import DeclarationError, QuestionError
from geartrain.search import search_train
from geartrain.train import declare

PAIR = """
name: printed
unit: {{per: {unit}}}
links: {{frame: {{}}, a: {{wheels: {{a: {driver}}}}}, b: {{wheels: {{b: {driven}}}}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
gears: [a ~ b]
inputs: {{a: {speed}}}
outputs: {{b: {output}}}
"""


def pair(unit: str, driver: int, driven: int, output: str, speed: str = "-1") -> str:
    return PAIR.format(unit=unit, driver=driver, driven=driven, output=output, speed=speed)


def published(value: str) -> str:
    return f"{{published: {{{value}, as: period}}}}"


def result_of(text: str) -> Any:
    return load(text).solve().outputs["b"]


@pytest.mark.parametrize(
    ("unit", "driver", "driven", "printed", "holds", "found"),
    [
        # P1: 2451/2368 d, and 59/57 of 12 h
        ("1 d", 2368, 2451, "24 h 50 min 28.4 s", True, "24 h 50 min 28.378 s"),
        ("1 d", 2368, 2451, "24 h 50 min 28.3 s", False, "24 h 50 min 28.378 s"),
        ("12 h", 57, 59, "12 h 25.3 min", True, "12 h 25.263 min"),
        ("12 h", 57, 59, "12 h 25.263 min", True, "12 h 25.26316 min"),
        ("12 h", 57, 59, "12 h 25.2 min", False, "12 h 25.263 min"),
        # P2: 206/7 years of 365.25 d
        ("365.25 d", 7, 206, "29 y 157 d", True, "29 y 156.536 d"),
        ("365.25 d", 7, 206, "29 y 155 d", False, "29 y 156.536 d"),
        ("365.25 d", 7, 206, "29.4 years", True, "29.429 y"),
        ("365.25 d", 7, 206, "30 y", False, "29.429 y"),
        # half a unit of the last digit, which is a day of 27 d
        ("1 d", 2, 53, "27 d", True, "26.5 d"),
        ("1 d", 2, 53, "27.0 d", False, "26.5 d"),
        # 59.9996 s is a minute
        ("1 d", 216000, 359999, "1 d 15 h 59 min 59 s", False, "1 d 15 h 59 min 59.6 s"),
    ],
)
def test_a_printed_period_holds_to_half_a_unit_of_its_last_digit(
    unit: str, driver: int, driven: int, printed: str, holds: bool, found: str
) -> None:
    result = result_of(pair(unit, driver, driven, published(f"value: {printed}")))
    assert (result.published_holds, result.found_text) == (holds, found)


def test_no_part_of_a_computed_period_reaches_the_unit_above_it() -> None:
    # 86399.99999 s
    text = pair("1 s", 10**5, 8639999999, published("value: 23 h 59 min 59 s"))
    assert result_of(text).found_text == "24 h 0 min 0 s"


def test_a_period_is_a_magnitude_unless_a_sense_signs_it() -> None:
    for extra, holds in (("", True), (", sense: direct", True), (", sense: retrograde", False)):
        assert result_of(pair("1 d", 19, 235, published(f"value: 12.37 d{extra}"))).published_holds is holds
    backwards = result_of(pair("1 d", 19, 235, published("value: 12.37 d, sense: direct"), speed="1"))
    assert backwards.differs_in_sign
    assert backwards.found_text == "12.3684 d in the opposite sense"


def test_a_period_may_be_that_of_several_turns_or_have_a_tolerance() -> None:
    assert result_of(pair("1 d", 19, 235, published("value: 24.737 d, turns: 2"))).published_holds
    # 235/19 - 12 d is 8.8 h
    assert result_of(pair("1 d", 19, 235, published("value: 12 d, tolerance: 9 h"))).published_holds
    assert not result_of(pair("1 d", 19, 235, published("value: 12 d, tolerance: 8 h"))).published_holds


def test_speeds_in_rpm_have_periods_too() -> None:
    text = pair("1 d", 1, 30, published("value: 1.20 s"), speed="1500 rpm").replace("unit: {per: 1 d}\n", "")
    assert result_of(text).published_holds


def test_a_link_at_rest_has_no_period() -> None:
    result = result_of(pair("1 d", 19, 235, published("value: 12.37 d"), speed="0"))
    assert (result.period, result.found, result.published_holds) == (None, None, False)


@pytest.mark.parametrize(
    ("output", "said"),
    [
        (published("value: 29 y 157 d"), "the length of the years of '29 y 157 d' is not known"),
        (published("value: 12.37"), "'12.37' is not a period"),
        (published("value: 28 s 50 min"), "'28 s 50 min' is not a period"),
        (published("value: 1.5 h 20 min"), "'1.5 h 20 min' is not a period"),
        (published("value: 0 d"), "a period of 0 d is not above 0"),
        (published("value: 12 d, magnitude: true"), "a period is a magnitude"),
        ("{published: {value: 12.37 d}}", "'12.37 d' is a time, not a number"),
        ("{published: {value: 12, sense: direct}}", "`sense` and `turns` belong to a period"),
        ("{published: {value: -12, magnitude: true}}", "-12 with `magnitude: true` is negative"),
    ],
)
def test_a_published_value_that_cannot_be_compared_is_refused(output: str, said: str) -> None:
    with pytest.raises(DeclarationError, match=said.replace("(", r"\(")):
        load(pair("1 d", 19, 235, output))


@pytest.mark.parametrize("unit", ["unit: {per: 18 ft}\n", ""])
def test_a_period_needs_a_unit_of_time(unit: str) -> None:
    text = pair("1 d", 19, 235, published("value: 12.37 d")).replace("unit: {per: 1 d}\n", unit)
    with pytest.raises(DeclarationError, match=r"the printed period '12.37 d' needs `unit: {per: ...}`"):
        load(text)


@pytest.mark.parametrize(
    "value", ["12.368421, as: input/output", "0.0808511, as: output/input", "0.0808511, as: speed", "0.08, as: speed"]
)
def test_a_magnitude_ignores_the_sign(value: str) -> None:
    text = pair("1 d", 19, 235, f"{{published: {{value: {value}}}}}", speed="1")
    signed = result_of(text)
    assert not signed.published_holds
    assert signed.differs_in_sign
    assert result_of(text.replace(value, f"{value}, magnitude: true")).published_holds


def test_a_failure_by_the_sign_only_names_the_remedy(tmp_path: Path) -> None:
    path = tmp_path / "printed.yaml"
    text = pair("1 d", 1, 25000, "{published: {value: 25000, as: input/output}}", speed="1")
    path.write_text(text)
    said = " ".join(call("check", path).output.split())
    assert "found -25000; only the sign differs (`magnitude: true` ignores it)" in said


@pytest.mark.parametrize(
    ("value", "holds"),
    [
        ("297 h, as: period", lambda a, b: abs(24 * b - 297 * a) * 2 <= a),
        ("297 h, as: period, sense: retrograde", lambda a, b: abs(24 * b - 297 * a) * 2 <= a),
        ("297 h, as: period, sense: direct", lambda a, b: False),
        ("0.081, as: speed, magnitude: true", lambda a, b: abs(1000 * a - 81 * b) * 2 <= b),
        ("12.37, as: input/output, magnitude: true", lambda a, b: abs(100 * b - 1237 * a) * 2 <= a),
        ("12.37, as: input/output", lambda a, b: False),
    ],
)
def test_a_search_satisfies_what_is_printed(value: str, holds: Callable[[int, int], bool]) -> None:
    text = pair("1 d", 19, 235, f"{{published: {{value: {value}}}}}", speed="1")
    text = text.replace("a: 19", "a: {teeth: {search: [18, 22]}}").replace("b: 235", "b: {teeth: {search: [230, 240]}}")
    found = search_train(declare(yaml.safe_load(text)), best=1000)
    # by enumeration
    counts = [(a, b) for a in range(18, 23) for b in range(230, 241) if holds(a, b)]
    assert sorted((each.teeth["a"], each.teeth["b"]) for each in found.solutions) == counts
    assert bool(counts) == ("direct" not in value and value != "12.37, as: input/output")


def test_a_ratio_to_several_inputs_is_refused_with_its_reason() -> None:
    text = pair("1 d", 19, 235, "{published: {value: 12, as: input/output}}")
    text = text.replace("a: 19", "a: {teeth: {search: [18, 22]}}").replace("links: {", "links: {c: {}, ")
    text = text.replace("A: [frame, a]", "A: [frame, a], C: [frame, c]").replace("inputs: {", "inputs: {c: 2, ")
    with pytest.raises(QuestionError) as refused:
        search_train(declare(yaml.safe_load(text)))
    (problem,) = refused.value.problems
    assert problem.why == "a ratio needs exactly one input that turns, and 2 turn"


def test_a_wrong_kind_of_published_value_is_reported_once() -> None:
    with pytest.raises(DeclarationError) as refused:
        load(pair("1 d", 19, 235, "{published: {value: 12.37 d, as: Period}}"))
    assert len(refused.value.problems) == 1


def target_of(text: str) -> Any:
    (target,) = result_of(text).targets
    return target


def test_a_sidereal_clock_gains_or_loses_seconds_a_year() -> None:
    # P3: 15/47 49/97 82/31 87/37
    driver, driven = 15 * 49 * 82 * 87, 47 * 97 * 31 * 37
    train = pair("1 d", driver, driven, "{targets: [{speed: 1.00273790935}]}")
    assert result_of(train).speed == Fraction(5243490, 5229173)
    target = target_of(train)
    assert target.ppm == pytest.approx(-0.00031457437, rel=1e-7)
    assert target.seconds_per_year == pytest.approx(-0.0099270082, rel=1e-7)


def test_a_tidal_hand_loses_seconds_a_day() -> None:
    # P4
    target = target_of(pair("1 d", 2368, 2451, "{targets: [{period: 24.8412024 h}]}"))
    assert target.ppm == pytest.approx(-0.55618115, rel=1e-7)
    assert target.seconds_per_day == pytest.approx(-0.048054051, rel=1e-7)
    assert target.seconds_per_year == pytest.approx(-17.551382, rel=1e-7)


def test_a_moon_dial_of_59_teeth_is_a_day_off_in_964_days() -> None:
    # S1: 29.5 d against 29.530588853 d
    target = target_of(pair("1 d", 2, 59, "{targets: [{period: 29.530588853 d}]}"))
    assert target.ppm == pytest.approx(1036.9102712, rel=1e-9)
    assert target.seconds_per_day == pytest.approx(89.58904743, rel=1e-9)
    assert target.days_to_one_day == pytest.approx(964.40360, rel=1e-8)


def test_an_exact_hand_is_never_a_day_off(tmp_path: Path) -> None:
    path = tmp_path / "week.yaml"
    path.write_text(pair("1 d", 1, 7, "{targets: [{period: 7 d}]}"))
    assert target_of(path.read_text()).days_to_one_day is None
    assert "never" in call("report", path, "--section", "Against the targets").output


@pytest.mark.parametrize(
    ("hand", "target", "heads"),
    [
        ("needle", "29.530588853 d", {"days to a day off"}),
        ("needle", "29.5 h", set()),
        ("hour", "29.5 h", {"s a day", "s a year"}),
        ("needle", "24.84 h", {"s a day", "s a year"}),
        ("seconds", "29.530588853 d", {"s a day", "s a year", "days to a day off"}),
    ],
)
def test_rates_are_printed_for_hands_of_clocks_and_days(
    hand: str, target: str, heads: set[str], tmp_path: Path
) -> None:
    path = tmp_path / "rates.yaml"
    path.write_text(pair("1 d", 2, 59, f"{{hand: {hand}, targets: [{{period: {target}}}]}}"))
    call("report", path, "--section", "Against the targets", "-o", tmp_path / "rates.md")
    lines = (tmp_path / "rates.md").read_text()
    assert {head for head in ("s a day", "s a year", "days to a day off") if f"| {head} " in lines} == heads


@pytest.mark.parametrize(
    ("tolerance", "met"),
    [("90 s/d", True), ("89 s/d", False), ("32722 s/year", True), ("32721 s/year", False), ("90 s/day", True)],
)
def test_a_tolerance_may_be_the_rate_of_a_clock(tolerance: str, met: bool) -> None:
    # 89.58904743 s/d and 365.2425 times as much a year
    assert (
        target_of(pair("1 d", 2, 59, f"{{targets: [{{period: 29.530588853 d, tolerance: {tolerance}}}]}}")).met is met
    )


@pytest.mark.parametrize(
    ("period", "name"),
    [("19 years", "year_tropical_J2000, turns: 1/19"), ("12 months", "month_synodic_J2000, turns: 1/12")],
)
def test_a_target_in_years_or_months_names_what_to_write(period: str, name: str) -> None:
    with pytest.raises(DeclarationError) as refused:
        load(pair("1 d", 2, 59, f"{{targets: [{{period: {period}}}]}}"))
    (problem,) = refused.value.problems
    assert f"write `{{name: {name}}}`" in problem.fix
    assert load(pair("1 d", 2, 59, f"{{targets: [{{name: {name}}}]}}")).solve()


def test_every_output_with_a_unit_of_time_has_a_period(tmp_path: Path) -> None:
    path = tmp_path / "week.yaml"
    path.write_text(pair("1 d", 1, 7, "{}"))
    assert "a turn in 7 d" in call("solve", path).output
    assert result_of(path.read_text()).to_dict()["period_s"] == 604800
    report = call("report", path, "--section", "All outputs").output
    assert "period" in report
    assert "7 d" in report
