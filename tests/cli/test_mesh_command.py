"""`geartrain mesh` as its user meets it: pages, keys, sweeps, pictures, refusals."""

from __future__ import annotations

import csv
import io
import json
from math import degrees, hypot, pi
from pathlib import Path

import pytest
from commands import call
from sampling import first_few

PAIR = ("mesh", 48, 96, "--form", "triangular", "-p", "half_angle=30deg", "--friction", 0.2)
KEYS = {"teeth", "verdict", "clearance_factor", "window", "sizes", "backlash", "speed_ratio", "transmission_error"}
KEYS |= {"efficiency", "intervals", "jumps", "course", "impacts", "outlines"}


def test_every_key_of_the_json_is_the_promised_one() -> None:
    data = json.loads(call(*PAIR, "-p", "clearance_factor=1.01", "--json").output)
    assert set(data) == KEYS
    assert set(data["speed_ratio"]) == {"mean", "exact", "min", "max"}
    assert set(data["transmission_error"]) == {"peak_to_peak", "rms", "mean"}
    assert {"mean", "min"} <= set(data["efficiency"])
    assert [set(interval) for interval in data["intervals"]] == [{"phase", "start", "end"}]
    assert set(data["window"]) == {"jam", "jam_kind", "run", "run_kind", "reach", "works"}
    assert data["verdict"]["kind"] == "runs"


@pytest.mark.parametrize(
    ("arguments", "kind", "said"),
    [
        (["-p", "clearance_factor=1.001"], "jam", "below the window"),
        (["-p", "clearance_factor=1.034"], "dwell", "above the window"),
        (["-p", "clearance_factor=1.05"], "apart", "above the window"),
        (
            ["-p", "clearance_factor=1.01", "-p", "half_angle=89deg"],
            "no valley",
            "use more teeth or a smaller half_angle",
        ),
    ],
)
def test_a_pair_outside_its_window_is_a_verdict_that_names_it(arguments: list[object], kind: str, said: str) -> None:
    result = call("mesh", 48, 96, "--form", "triangular", *arguments)
    assert result.exit_code == 1
    assert f"Verdict: {kind}" in result.output
    assert said in result.output
    data = json.loads(call("mesh", 48, 96, "--form", "triangular", *arguments, "--json").output)
    assert data["verdict"]["kind"] == kind


def test_friction_that_locks_is_a_verdict_with_the_minimum_friction_that_does() -> None:
    base = ("mesh", 96, 72, "--form", "triangular", "-p", "clearance_factor=1.01", "--friction")
    data = json.loads(call(*base, 1.2, "--json").output)
    limit = data["efficiency"]["locks_at"]
    assert (data["efficiency"]["mean"], data["efficiency"]["min"]) == (None, None)
    assert call(*base, 1.2).exit_code == 1
    assert "friction locks" in call(*base, limit * 1.0001).output
    assert call(*base, limit * 0.9999).exit_code == 0


def test_clearances_given_in_five_ways_are_one() -> None:
    sized = ("--module", "0.5mm")
    first = json.loads(call(*PAIR, "-p", "clearance_factor=1.015", *sized, "--json").output)
    # half the module times the teeth is the least centre distance: 36 mm
    assert first["sizes"]["centre_distance"] == pytest.approx(0.036 * 1.015, rel=1e-14)
    window = first["window"]
    fraction = (1.015 - window["jam"]) / (window["run"] - window["jam"])
    arc = first["backlash"] * first["sizes"]["centre_distance"] * 96 / 144
    for name, value in (
        ("-p", "excess=0.015"),
        ("-p", "centre_distance=36.54 mm"),
        ("-p", f"window={fraction:.15f}"),
        ("-p", f"backlash={arc * 1000:.15f} mm"),
    ):
        other = json.loads(call(*PAIR, name, value, *sized, "--json").output)
        assert other["clearance_factor"] == pytest.approx(1.015, rel=1e-12)


def test_the_second_wheel_can_drive_and_the_first_can_turn_back() -> None:
    sized = ("-p", "clearance_factor=1.01", "--json")
    swapped = ("mesh", 96, 48, "--form", "triangular", "--friction", 0.2)
    there, back, reverse, other = (
        json.loads(call(*words, *sized).output)["speed_ratio"]
        for words in (PAIR, (*PAIR, "--driver", 2), (*PAIR, "--backwards"), swapped)
    )
    assert back["mean"] == 2
    for key in ("min", "max"):
        assert back[key] == pytest.approx(other[key], rel=1e-12)
        assert reverse[key] == there[key]


def test_impacts_share_the_drivers_work() -> None:
    operation = ("--inertia", "20 g cm2", "--rate", "1 turn/s", "--load", "2 N mm")
    data = json.loads(call(*PAIR, "-p", "clearance_factor=1.01", *operation, "--json").output)
    impacts, (jump,) = data["impacts"], data["jumps"]
    scale = 20e-7 * (2 * pi) ** 2
    assert impacts["dissipated"] == pytest.approx(scale * (jump["after"] - jump["before"]) ** 2 / 2)
    assert impacts["work"] == pytest.approx(impacts["dissipated"] + impacts["handed"])
    # at the speed named, the load is just what keeps the teeth together
    assert impacts["load_to_stay_in_contact"] * impacts["void_above"] ** 2 == pytest.approx(0.002)


def test_a_sweep_is_a_table_and_says_where_things_change(tmp_path: Path) -> None:
    out = tmp_path / "s.csv"
    requested = ("mesh", 96, 96, "--form", "triangular", "--friction", 0.2)
    result = call(*requested, "--vary", "clearance_factor=1.0005:1.028:24", "-o", out)
    assert result.exit_code == 0
    rows = list(csv.DictReader(io.StringIO(out.read_text(encoding="utf-8"))))
    assert len(rows) == 24
    assert rows[0]["verdict"] == "jam"
    assert rows[-1]["verdict"] == "apart"
    assert rows[-1]["tau_min"] == ""
    runs = [row for row in rows if row["verdict"] == "runs"]
    assert all(0 < float(row["efficiency_mean"]) <= 1 for row in runs)
    said = result.stderr
    assert "clearance_factor 1.000801478: jam (approach+recess) -> runs (approach+recess)" in said
    assert "runs (astride) -> dwell" in said
    assert "clearance_factor 1.01172" in said
    assert "maximum mean efficiency, 0.9944" in said


def test_a_sweep_of_two_has_every_combination() -> None:
    result = call(*PAIR, "--vary", "clearance_factor=1.005:1.025:3", "--vary", "half_angle=20deg:40deg:2", "--json")
    rows = json.loads(result.stdout)
    assert [(row["clearance_factor"], row["half_angle"]) for row in rows] == [
        (a, b) for a in (1.005, 1.015, 1.025) for b in (20.0, 40.0)
    ]


@pytest.mark.parametrize("suffix", first_few(1, [".svg", ".png", ".pdf"]))
def test_pictures_are_written_whole(tmp_path: Path, suffix: str) -> None:
    transmission, teeth = tmp_path / f"law{suffix}", tmp_path / f"teeth{suffix}"
    requested = (*PAIR, "-p", "clearance_factor=1.01", "--plot")
    assert call(*requested, transmission).exit_code == 0
    assert call(*requested, teeth, "--at", "-5deg").exit_code == 0
    starts = {".svg": b"<?xml", ".png": b"\x89PNG", ".pdf": b"%PDF"}
    for path in (transmission, teeth):
        assert path.read_bytes().startswith(starts[suffix])
    assert sorted(tmp_path.iterdir()) == sorted([transmission, teeth])


def test_a_pin_has_a_page() -> None:
    data = json.loads(call("pin", "9.6mm", "1.1mm", "--json").output)
    assert degrees(data["amplitude"]) == pytest.approx(6.5796, abs=5e-5)
    assert data["speed_ratio"]["exact"] == "1"


def test_a_wheel_is_written_as_teeth_and_bore_with_the_sizes_of_its_page(tmp_path: Path) -> None:
    requested = ("mesh", 15, 24, "--form", "triangular", "-p", "window=0.5", "--module", "2mm", "--blank", "bore=3mm")
    file = tmp_path / "w.csv"
    data = json.loads(call(*requested, "--wheel", 2, "--profile", file, "--json").stdout)
    rows = list(csv.DictReader(io.StringIO(file.read_text(encoding="utf-8"))))
    assert {row["contour"] for row in rows} == {"0", "1"}  # teeth, bore
    tip = max(hypot(float(row["x_mm"]), float(row["y_mm"])) for row in rows)
    (outline,) = data["outlines"]
    assert outline["centre_distance"] == pytest.approx(1000 * data["sizes"]["centre_distance"], rel=1e-12)
    assert outline["tip_diameter"] == pytest.approx(2000 * data["sizes"]["radii"][1], rel=1e-12)
    assert 2 * tip == pytest.approx(outline["tip_diameter"], abs=3e-6)  # mm: the file has six places


TRANSMISSION = "stribeck,static=0.2,kinetic=0.08,speed=10 mm/s"


def test_a_pair_under_a_law_of_friction_tells_its_speed_and_its_mean_coefficient(tmp_path: Path) -> None:
    sized = ("mesh", 48, 96, "--form", "triangular", "-p", "clearance_factor=1.01", "--module", "2mm")
    requested = (*sized, "--friction", TRANSMISSION, "--rate")
    said = call(*requested, "1 turn/s").output
    # half the sum of the modules times teeth is the least centre distance: 144 mm
    assert f"at a pitch-line speed of {2 * pi * 0.144 * 1.01 / 3:.6g} m/s" in said
    picture = tmp_path / "l.svg"
    mean = json.loads(call(*requested, "1 turn/s", "--plot", picture, "--json").stdout)["efficiency"]["friction"]
    assert 0.08 < mean < 0.2
    assert f"friction {mean:.6g}" in picture.read_text(encoding="utf-8").replace("<!-- ", "")
    slow, fixed = (
        json.loads(call(*words, "--json").stdout)["efficiency"]["mean"]
        for words in ((*requested, "1 turn/h"), (*sized, "--friction", 0.2))
    )
    assert slow == pytest.approx(fixed, abs=1e-5)


def test_the_second_wheel_drives_at_its_own_speed() -> None:
    requested = ("mesh", 24, 36, "--friction", "buckingham", "--module", "2mm", "--rate", "1 turn/s", "--driver")
    for driver, radius in ((1, 0.024), (2, 0.036)):
        assert f"at a pitch-line speed of {2 * pi * radius:.6g} m/s" in call(*requested, driver).output
