"""`geartrain mesh` as its user meets it: pages, keys, sweeps, pictures, refusals."""

from __future__ import annotations

import csv
import io
import json
from math import degrees, pi
from pathlib import Path

import pytest
import shapely
from commands import call, ended, without
from sampling import first_few
from shapely.affinity import rotate, translate

PAIR = ("mesh", 48, 96, "--form", "triangular", "-p", "half_angle=30deg", "--friction", 0.2)
KEYS = {"teeth", "verdict", "clearance_factor", "window", "sizes", "backlash", "speed_ratio", "transmission_error"}
KEYS |= {"efficiency", "intervals", "jumps", "course", "impacts", "outlines"}


# printed under Figs. 3 to 5 of F. Sorge's note: relative jumps, and the phases of the text
PRINTED = [
    (48, 96, 1.01, {"recess": 0.1582}),
    (48, 96, 1.025, {"recess": 0.1457}),
    (96, 72, 1.01, {"approach": 0.1117}),
    (96, 72, 1.025, {"approach": 0.0682, "matching": 0.0316}),  # 0.0314 is a misprint
    (96, 96, 1.01, {"approach": 0.0876, "recess": 0.0095}),
    (96, 96, 1.025, {"approach": 0.0696, "matching": 0.0119}),
]


@pytest.mark.parametrize(("z1", "z2", "a", "jumps"), PRINTED)
def test_the_jumps_are_those_printed(z1: int, z2: int, a: float, jumps: dict[str, float]) -> None:
    data = json.loads(call("mesh", z1, z2, "--form", "triangular", "-p", f"clearance_factor={a}", "--json").output)
    assert {jump["kind"]: round(jump["value"], 4) for jump in data["jumps"]} == jumps
    assert data["speed_ratio"]["mean"] == z1 / z2


def test_every_key_of_the_json_is_the_promised_one() -> None:
    data = json.loads(call(*PAIR, "-p", "clearance_factor=1.01", "--json").output)
    assert set(data) == KEYS
    assert set(data["speed_ratio"]) == {"mean", "exact", "min", "max"}
    assert set(data["transmission_error"]) == {"peak_to_peak", "rms", "mean"}
    assert {"mean", "min"} <= set(data["efficiency"])
    assert [set(interval) for interval in data["intervals"]] == [{"phase", "start", "end"}]
    assert set(data["window"]) == {"jam", "jam_kind", "run", "run_kind", "reach", "works"}
    assert data["verdict"]["kind"] == "runs"
    # by 40-digit arithmetic with the equations of the source
    assert data["speed_ratio"]["min"] == pytest.approx(0.4553445392855049755, rel=1e-13)
    assert data["speed_ratio"]["max"] == pytest.approx(0.5409373642233032024, rel=1e-13)
    assert degrees(data["intervals"][0]["end"]) == pytest.approx(-8.734097098280917, rel=1e-12)
    assert data["window"]["jam"] == pytest.approx(1.00271, abs=5e-6)
    assert data["window"]["run"] == pytest.approx(1.0314, abs=7e-5)


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


REFUSED = [
    ([2, 96, "-p", "clearance_factor=1.01"], "at least 3 teeth"),
    ([48, 96, "-p", "clearance_factor=1"], "above 1"),
    ([48, 96, "-p", "clearance_factor=nan"], "'nan' is not a number"),
    ([48, 96, "-p", "clearance_factor=inf"], "'inf' is not a number"),
    ([48, 96, "-p", "excess=0"], "above 0"),
    ([48, 96, "-p", "window=1.5"], "between 0"),
    ([48, 96, "-p", "clearance_factor=1.01", "-p", "excess=0.01"], "exactly one of"),
    ([48, 96, "-p", "clearance_factor=1.01", "-p", "half_angle=95deg"], "between 0 and 90 deg"),
    ([48, 96, "-p", "clearance_factor=1.01", "-p", "half_angle=30"], "has no unit"),
    ([48, 96, "-p", "clearance_factor=1.01", "-p", "half_angle=3mm"], "is a length"),
    ([48, 96, "-p", "clearance_factor=1.01", "--friction", -0.1], "0 or more"),
    ([48, 96, "-p", "clearance_factor=1.01", "--rate", "3 furlong"], "unknown unit"),
    ([48, 96, "-p", "centre_distance=40mm"], "cannot be related to the size of these wheels"),
    ([48, 96, "-p", "centre_distance=40", "-p", "radii=10mm,20mm"], "mix numbers without a unit"),
    ([48, 96, "-p", "backlash=9mm", "--module", "0.5mm"], "no clearance gives a backlash"),
    ([8, 64, "-p", "window=0.5"], "no clearance lets wheels of 8 and 64"),
    ([48, 96, "--vary", "clearence_factor=1:2:3"], "cannot be varied"),
    ([48, 96, "--vary", "clearance_factor=1:2"], "FIRST:LAST:COUNT"),
    ([48, 96, "-p", "clearance_factor=1.01", "--plot", "x.bmp"], "'.bmp'"),
    ([48, 96, "-p", "clearance_factor=1.01", "--profile", "w.svg"], "the module is missing"),
    ([48, 96, "--module", "1mm", "-p", "clearance_factor=1.01", "--profile", "w.stl"], "not an output format"),
    ([48, 96, "--profile", "w.svg", "--vary", "clearance_factor=1.01:1.02:3"], "omit --profile or --vary"),
]


@pytest.mark.parametrize(("arguments", "said"), REFUSED, ids=lambda value: str(value)[:40])
def test_what_cannot_be_a_pair_is_refused_kindly(arguments: list[object], said: str) -> None:
    done = ended("mesh", "--form", "triangular", *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert said in " ".join(done.stderr.replace("│", " ").split())
    assert "Traceback" not in done.stderr


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
    there = json.loads(call(*PAIR, "-p", "clearance_factor=1.01", "--json").output)
    back = json.loads(call(*PAIR, "-p", "clearance_factor=1.01", "--driver", 2, "--json").output)
    swapped = json.loads(
        call("mesh", 96, 48, "--form", "triangular", "--friction", 0.2, "-p", "clearance_factor=1.01", "--json").output
    )
    assert back["speed_ratio"]["mean"] == 2
    for key in ("min", "max"):
        assert back["speed_ratio"][key] == pytest.approx(swapped["speed_ratio"][key], rel=1e-12)
    reverse = json.loads(call(*PAIR, "-p", "clearance_factor=1.01", "--backwards", "--json").output)
    for key in ("min", "max"):
        assert reverse["speed_ratio"][key] == there["speed_ratio"][key]


def test_impacts_share_the_drivers_work() -> None:
    data = json.loads(
        call(
            *PAIR,
            "-p",
            "clearance_factor=1.01",
            "--inertia",
            "20 g cm2",
            "--rate",
            "1 turn/s",
            "--load",
            "2 N mm",
            "--json",
        ).output
    )
    impacts, (jump,) = data["impacts"], data["jumps"]
    scale = 20e-7 * 6.283185307179586**2
    assert impacts["dissipated"] == pytest.approx(scale * (jump["after"] - jump["before"]) ** 2 / 2)
    assert impacts["handed"] == pytest.approx(scale * (jump["after"] ** 2 - jump["before"] ** 2) / 2)
    assert impacts["work"] == pytest.approx(scale * jump["after"] * (jump["after"] - jump["before"]))
    # at the speed named, the load is just what keeps the teeth together
    ratio = impacts["void_above"] ** 2
    assert impacts["load_to_stay_in_contact"] * ratio == pytest.approx(0.002)


def test_a_sweep_is_a_table_and_says_where_things_change(tmp_path: Path) -> None:
    out = tmp_path / "s.csv"
    result = call(
        "mesh",
        96,
        96,
        "--form",
        "triangular",
        "--friction",
        0.2,
        "--vary",
        "clearance_factor=1.0005:1.028:24",
        "-o",
        out,
    )
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


def test_a_page_of_a_pair_needs_no_plots() -> None:
    requested: list[object] = [*PAIR, "-p", "clearance_factor=1.01"]
    done = without("matplotlib", "scipy", arguments=requested)
    assert (done.returncode, done.stderr) == (0, "")
    refused = without("matplotlib", "scipy", arguments=[*requested, "--plot", "x.svg"])
    assert refused.returncode == 2
    assert "pip install 'matplotlib>=3.8'" in refused.stderr


def test_a_pin_has_a_page_and_its_limits() -> None:
    data = json.loads(call("pin", "9.6mm", "1.1mm", "--json").output)
    assert degrees(data["amplitude"]) == pytest.approx(6.5796, abs=5e-5)
    assert data["speed_ratio"]["exact"] == "1"
    for arguments, said in (
        (["9mm", "9mm"], "through the slot's axis"),
        (["1mm", "9mm", "--driver", "slot"], "cannot drive"),
        (["--", "9mm", "-1mm"], "an offset of 0 or more"),
        (["9mm", "8mm", "--driver", "slot", "--friction", "2"], "locks"),
    ):
        done = ended("pin", *arguments)
        assert done.returncode == 2
        assert said in done.stderr


def test_wheels_cut_from_their_profiles_touch_wherever_the_path_says_that_they_do(tmp_path: Path) -> None:
    from geartrain.teeth import Triangular

    requested = ("mesh", 15, 24, "--form", "triangular", "-p", "window=0.5", "--module", "2mm", "--blank", "bore=3mm")
    cut = []
    for wheel in (1, 2):
        file = tmp_path / f"w{wheel}.csv"
        done = call(*requested, "--wheel", wheel, "--profile", file, "--json")
        rows = list(csv.DictReader(io.StringIO(file.read_text(encoding="utf-8"))))
        assert {row["contour"] for row in rows} == {"0", "1"}  # teeth, bore
        cut.append(shapely.Polygon([(float(row["x_mm"]), float(row["y_mm"])) for row in rows if row["contour"] == "0"]))
    data = json.loads(done.stdout)
    (outline,) = data["outlines"]
    distance = 1000 * data["sizes"]["centre_distance"]
    assert outline["centre_distance"] == pytest.approx(distance, rel=1e-12)
    assert outline["tip_diameter"] == pytest.approx(2000 * data["sizes"]["radii"][1], rel=1e-12)
    transmission = Triangular.declared({"half_angle": "30 deg", "window": "0.5"}).transmission(15, 24)
    for interval in transmission.intervals:
        for share in (0.01, 0.5, 0.99):
            x = interval.start - share * interval.width
            y = transmission.contact.path.tooth_pair.angle(interval.phase, x)
            driver = rotate(cut[0], x, origin=(0, 0), use_radians=True)
            driven = translate(rotate(cut[1], pi - y, origin=(0, 0), use_radians=True), distance)
            assert driver.distance(driven) < 2e-6  # mm: the file has six places
            assert driver.intersection(driven).area < 1e-4
            off = translate(rotate(cut[1], pi - y - 1e-4, origin=(0, 0), use_radians=True), distance)
            on = translate(rotate(cut[1], pi - y + 1e-4, origin=(0, 0), use_radians=True), distance)
            assert (driver.distance(off) > 1e-4) != (driver.distance(on) > 1e-4)


TRANSMISSION = "stribeck,static=0.2,kinetic=0.08,speed=10 mm/s"
REFUSED_TRANSMISSIONS = [
    (["--friction", "dokos"], "give --rate and --module"),
    (["--friction", "dokos", "--rate", "1 rpm"], "cannot be computed without the module"),
    (["--friction", "dokos", "--module", "1mm"], "cannot be computed without the speed of the driver"),
    (["--friction", "stribek,static=1"], "'stribeck'"),
    (["--friction", "stribeck,static=0.2"], "kinetic: Field required"),
    (["--friction", "dokos", "--vary", "window=0.1:0.9:3"], "needs a coefficient of friction"),
    (["--friction", "dokos", "--objective", "loss"], "needs a coefficient of friction"),
]


@pytest.mark.parametrize(("arguments", "said"), REFUSED_TRANSMISSIONS, ids=lambda value: str(value)[:40])
def test_a_law_of_friction_says_what_it_lacks(arguments: list[object], said: str) -> None:
    done = ended("mesh", 48, 96, "--form", "triangular", "-p", "window=0.5", *arguments)
    assert done.returncode == 2
    assert done.stderr.startswith("error: --friction: ")
    assert said in " ".join(done.stderr.split())


def test_a_pair_under_a_law_of_friction_tells_its_speed_and_what_acts_at_every_angle(tmp_path: Path) -> None:
    requested = (
        "mesh",
        48,
        96,
        "--form",
        "triangular",
        "-p",
        "clearance_factor=1.01",
        "--friction",
        TRANSMISSION,
        "--module",
        "2mm",
    )
    said = call(*requested, "--rate", "1 turn/s").output
    # half the sum of the modules times teeth is the least centre distance: 144 mm
    speed = 2 * pi * 0.144 * 1.01 / 3
    assert f"at a pitch-line speed of {speed:.6g} m/s" in said
    picture = tmp_path / "l.svg"
    data = json.loads(call(*requested, "--rate", "1 turn/s", "--plot", picture, "--json").stdout)
    course, mean = data["course"], data["efficiency"]["friction"]
    assert 0.08 < mean < 0.2
    assert f"friction {mean:.6g}" in picture.read_text(encoding="utf-8").replace("<!-- ", "")
    ratios = zip(course["speed_ratio"], course["driven_arm"], course["driver_arm"], strict=True)
    assert [tau * second / first for tau, second, first in ratios] == pytest.approx(course["efficiency"], rel=1e-13)
    slow = json.loads(call(*requested, "--rate", "1 turn/h", "--json").stdout)
    fixed = json.loads(call(*requested[:7], "--friction", 0.2, "--module", "2mm", "--json").stdout)
    assert slow["efficiency"]["mean"] == pytest.approx(fixed["efficiency"]["mean"], abs=1e-5)


def test_the_second_wheel_drives_at_its_own_speed() -> None:
    requested = (
        "mesh",
        24,
        36,
        "--form",
        "involute",
        "--friction",
        "buckingham",
        "--module",
        "2mm",
        "--rate",
        "1 turn/s",
    )
    for driver, radius in ((1, 0.024), (2, 0.036)):
        said = call(*requested, "--driver", driver).output
        assert f"at a pitch-line speed of {2 * pi * radius:.6g} m/s" in said
