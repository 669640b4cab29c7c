"""Trains from public sources, each with the right answer in its comment or in its `expect`."""

from __future__ import annotations

import json
from fractions import Fraction
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


# 15 sin(36 deg) - 2 r, r^2 = R^2 (1 + 3 sin^2(pi/7)) of the epicycloid that half the pitch radius rolls
ROOM = 15 * sin(pi / 5) - 7 * sqrt(1 + 3 * sin(pi / 7) ** 2)
CHECKED = {
    "01": (0, f"the tips of 5 planets 'p7' have a clearance of only {ROOM:.4g} modules"),
    "03": (0, "the sum of the shifts must be 1.094 [P1]"),
    "04": (0, "all 2 expectations hold; without findings: 4 planets 'planet'"),
    # 6 h over 6.0874 h is 1 - 0.0143575
    "05": (1, "target period 6 h in either sense missed by -14357.5 ppm (tolerance 1 %)"),
    "06": (0, "wheel 'n40' is not cut: pairs 'n30~n40' and 'n40~n50' require different teeth"),
    "08": (1, "found -25000; only the sign differs (`magnitude: true` ignores it)"),
    "10": (0, "wheel 'finger' has one tooth, which cannot drive continuously"),
    "11": (0, "all 2 expectations hold"),
    "12": (0, "overlap by 0.1832 modules unless their addenda are at most 0.908"),
}


@pytest.mark.parametrize("number", CHECKED)
def test_what_check_says_of_a_public_train(number: str) -> None:
    code, said = CHECKED[number]
    for verb in ("check", "report") if number in ("06", "08") else ("check",):
        result = call(verb, case(number))
        assert result.exit_code == code
        assert said in " ".join(result.output.split())
    assert number == "08" or "only the sign differs" not in result.output


def test_shifts_of_that_sum_bring_the_axes_to_their_distance() -> None:
    text = case("03").read_text(encoding="utf-8") + "tooth_form: {form: involute, shift: [0.5, 0.595]}\n"
    assert [(found.rule, found.level) for found in load(text).build_findings] == [("P1", "note")]


@pytest.mark.parametrize(("addendum", "level"), [("0.9", "note"), ("0.92", "error")])
def test_a_declared_addendum_decides_whether_they_fit(addendum: str, level: str) -> None:
    text = case("12").read_text(encoding="utf-8") + f"tooth_form: {{form: involute, addendum: {addendum}}}\n"
    assert [found.level for found in load(text).build_findings if found.rule == "A3"] == [level]


def test_a_published_ratio_may_be_a_magnitude() -> None:
    text = case("08").read_text(encoding="utf-8").replace("as: output/input", "as: output/input, magnitude: true")
    assert load(text).solve().failures == ()


def test_a_state_with_an_input_at_rest_is_determined_and_its_open_clutch_slips() -> None:
    result = load(case("04")).solve("coast")
    assert {link: result[link] for link in ("axle", "ring", "cage", "sprocket", "shell")} == {
        "axle": 0,
        "ring": 0,
        "cage": 0,
        "sprocket": 0,
        "shell": 1,
    }
    gearbox = json.loads(call("gearbox", case("04"), "--json").stdout)
    (coast,) = (state for state in gearbox["states"] if state["state"] == "coast")
    # the cage seen from the shell
    assert coast["slips"]["pawls"] == "-1"


@pytest.mark.parametrize("of", [None, "{of: [15, 19, 57, 60]}", "{of: {15: 1, 19: 1, 57: 1, 60: 1}}"])
def test_counts_to_search_may_be_a_list_of_owned_wheels(of: str | None, tmp_path: Path) -> None:
    text, path = case("09").read_text(encoding="utf-8"), tmp_path / "owned.yaml"
    path.write_text(text if of is None else text.replace("[15, 19, 57, 60]", of), encoding="utf-8")
    found = json.loads(call("teeth", "train", path, "--centre-tolerance", "1", "--json").stdout)
    # 1/2 (15/60 + 19/57) = 7/24, and its mirror image
    wanted = [{"a": 15, "b": 19, "c": 60, "d": 57}, {"a": 19, "b": 15, "c": 57, "d": 60}]
    assert [solution["teeth"] for part in found["parts"] for solution in part["solutions"]] == wanted


def test_a_belt_turns_both_pulleys_the_same_way() -> None:
    assert call("check", case("07")).exit_code == 0


def test_a_planetary_set_is_written_as_a_planetary_stage(tmp_path: Path) -> None:
    assert call("export", case("13"), "-o", tmp_path / "set.rexsj").exit_code == 0
    model = json.loads((tmp_path / "set.rexsj").read_text(encoding="utf-8"))["model"]
    parts = {part["id"]: part for part in model["components"]}
    relations = [
        (each["type"], {ref["role"]: parts[ref["id"]].get("name") for ref in each["refs"]})
        for each in model["relations"]
    ]
    kinds = ("central_shaft", "planet_carrier_shaft", "planet_shaft")
    assert {kind: [roles["shaft"] for each, roles in relations if each == kind] for kind in kinds} == {
        "central_shaft": ["sun", "ring"],
        "planet_carrier_shaft": ["carrier"],
        "planet_shaft": ["planet", "planet.2", "planet.3"],
    }
    assert ("side", {"assembly": "ring held", "inner_part": "ring", "outer_part": "casing"}) in relations
    spur = [part for part in parts.values() if part["type"] in ("cylindrical_gear", "ring_gear")]
    assert not [each for part in spur for each in part["attributes"] if each["id"] == "normal_pressure_angle"]
    (running,) = (each["components"] for each in model["load_spectrum"]["load_cases"])
    torques = [each["floating_point"] for part in running for each in part["attributes"] if each.get("unit") == "N m"]
    # printed with the torque of 250 kW at 1500 rpm, 1591.5494 N m, of which 1591.549 is declared
    assert torques == pytest.approx([1591.549, -7302.403, 5710.854], rel=5e-7)
    # read again, the carrier turns at 17/78 of the sun
    assert call("init", "--from", tmp_path / "set.rexsj", "-o", tmp_path / "read.yaml").exit_code == 0
    read = load(tmp_path / "read.yaml")
    assert (read.solve()["carrier"], read.declaration.links["planet"].copies) == (Fraction(4250, 13), 3)
