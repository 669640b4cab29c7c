"""Trains from public sources, each with the right answer in its comment or in its `expect`."""

from __future__ import annotations

import json
from math import pi, sin, sqrt
from pathlib import Path

import pytest
from commands import call

from geartrain import load

CASES = Path(__file__).parents[1] / "data" / "public_cases"
LOCKED = {"three-crossed-left-locked", "twisted-ring-10-locked"}


@pytest.mark.parametrize("path", sorted((CASES / "right").glob("*.yaml")), ids=lambda path: path.stem)
def test_a_public_train_has_its_published_speeds_or_is_locked_as_published(path: Path) -> None:
    result = call("check", path)
    assert result.exit_code == (1 if path.stem in LOCKED else 0), result.output
    assert ("locked: loop" in result.output) == (path.stem in LOCKED)


def case(number: str) -> Path:
    (path,) = CASES.glob(f"{number}-*.yaml")
    return path


def test_a_missed_tolerance_of_a_target_is_a_failure() -> None:
    """6 h over 6.0874 h is 1 - 0.0143575."""
    result = call("check", case("05"))
    assert result.exit_code == 1
    assert "target period 6 h in either sense missed by -14357.5 ppm (tolerance 1 %)" in result.output
    assert "only the sign differs" not in result.output


def test_a_stage_with_undeclared_profile_shifts_is_a_note() -> None:
    result = call("check", case("03"))
    assert result.exit_code == 0
    assert "the sum of the shifts must be 1.094 [P1]" in result.output


def test_shifts_of_that_sum_bring_the_axes_to_their_distance() -> None:
    text = case("03").read_text(encoding="utf-8") + "tooth_form: {form: involute, shift: [0.5, 0.595]}\n"
    assert [(found.rule, found.level) for found in load(text).build_findings] == [("P1", "note")]


def test_tips_of_planets_end_where_their_declared_teeth_end() -> None:
    """15 sin(36 deg) - 2 r, r^2 = R^2 (1 + 3 sin^2(pi/7)) of the epicycloid that half the pitch radius rolls."""
    room = 15 * sin(pi / 5) - 7 * sqrt(1 + 3 * sin(pi / 7) ** 2)
    result = call("check", case("01"))
    assert result.exit_code == 0
    assert f"the tips of 5 planets 'p7' have a clearance of only {room:.4g} modules" in result.output


def test_tips_of_teeth_that_are_not_declared_are_a_note() -> None:
    result = call("check", case("12"))
    assert result.exit_code == 0
    assert "overlap by 0.1832 modules unless their addenda are at most 0.908" in result.output


@pytest.mark.parametrize(("addendum", "level"), [("0.9", "note"), ("0.92", "error")])
def test_a_declared_addendum_decides_whether_they_fit(addendum: str, level: str) -> None:
    text = case("12").read_text(encoding="utf-8") + f"tooth_form: {{form: involute, addendum: {addendum}}}\n"
    assert [found.level for found in load(text).build_findings if found.rule == "A3"] == [level]


def test_a_wheel_with_two_flanks_is_named_by_check_and_report() -> None:
    sentence = "wheel 'n40' is not cut: its pairs 'n30~n40' and 'n40~n50' require different teeth"
    checked, reported = call("check", case("06")), call("report", case("06"))
    assert checked.exit_code == reported.exit_code == 0
    assert f"{sentence}; they require involute flanks of two shapes" in checked.output
    assert sentence in " ".join(reported.output.split())


def test_a_figure_without_the_sign_of_the_speed_is_said_to_differ_in_sign_only() -> None:
    path = CASES / "08-ratio-in-magnitude.yaml"
    for verb in ("check", "report"):
        result = call(verb, path)
        assert result.exit_code == 1
        assert "found -25000; only the sign differs" in " ".join(result.output.split())


def test_counts_to_search_may_be_a_list() -> None:
    path = CASES / "09-list-of-counts.yaml"
    found = json.loads(call("teeth", "train", path, "--centre-tolerance", "1", "--json").stdout)
    # 1/2 (15/60 + 19/57) = 7/24, and its mirror image
    wanted = [{"a": 15, "b": 19, "c": 60, "d": 57}, {"a": 19, "b": 15, "c": 57, "d": 60}]
    assert [solution["teeth"] for part in found["parts"] for solution in part["solutions"]] == wanted


def test_a_finger_of_one_tooth_is_noted_and_its_mean_ratio_is_right() -> None:
    result = call("check", CASES / "10-finger-and-star.yaml")
    assert result.exit_code == 0
    assert "wheel 'finger' has one tooth, which cannot drive continuously" in result.output


def test_a_set_of_which_only_the_ratio_is_known_has_its_speeds_with_any_planet() -> None:
    result = call("check", case("11"))
    assert result.exit_code == 0
    assert "all 2 expectations hold" in result.output


@pytest.mark.xfail(strict=True, reason="belts cannot be declared")
def test_a_belt_turns_both_pulleys_the_same_way() -> None:
    assert call("check", case("07")).exit_code == 0


@pytest.mark.xfail(strict=True, reason="gear units are written without planetary stages")
def test_a_planetary_set_is_written_as_a_planetary_stage(tmp_path: Path) -> None:
    call("export", case("13"), "-o", tmp_path / "set.rexsj")
    assert "planetary_stage" in (tmp_path / "set.rexsj").read_text(encoding="utf-8")
