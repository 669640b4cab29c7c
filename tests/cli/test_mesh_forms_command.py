"""`geartrain mesh` with its forms and `--compare` as their user meets them: ratios, pages, pictures, refusals."""

from __future__ import annotations

import json
import re
from functools import cache
from math import cos, isclose, pi, radians, sin, sqrt, tan
from pathlib import Path as File
from typing import Any

import numpy as np
import pytest
from commands import call, without
from places import DATA

from geartrain import load, teeth

PRINTED = json.loads((DATA / "tooth_shapes.json").read_text(encoding="utf-8"))
ROWS = {(row[0], row[1].split(" Q*")[0]): row[2:] for row in PRINTED["performance"]}
COLUMNS = ("loss", "stress", "off_pitch", "heat", "flash")
ALL = "involute,uniform_stress,uniform_temperature_a,uniform_temperature_b,least_friction"
NAMES = {
    "involute": "involute20",
    "uniform_stress": "UHS psi0=20",
    "uniform_temperature_a": "UT-a",
    "uniform_temperature_b": "UT-b",
    "least_friction": "MF psi_hi=25 u=0.15",
}
PAIR = (24, 36)
KEYS = {"form", "teeth", "verdict", "pitch_radii", "flanks", "thickness", "arcs", "contact_ratio", "pressure_angles"}
KEYS |= {"losses_and_stresses", "efficiency", "outlines"}


def forms(names: str) -> tuple[str, ...]:
    return tuple(word for name in names.split(",") for word in ("--form", name))


@cache
def compared(*arguments: object) -> dict[str, Any]:
    done = call("mesh", *arguments, "--compare", "--json")
    assert done.exit_code in (0, 1), done.output
    found: dict[str, Any] = json.loads(done.output)
    return found


@pytest.mark.parametrize("pair", ["spur(24,36)", "spur(12,60)", "bevel(24,36)", "bevel(15,45)"])
def test_the_ratios_are_those_of_the_printed_tables(pair: str) -> None:
    kind, z1, z2 = re.fullmatch(r"(\w+)\((\d+),(\d+)\)", pair).groups()  # type: ignore[union-attr]
    data = compared(z1, z2, *forms(ALL), *(("--shaft-angle", "90deg") if kind == "bevel" else ()))
    assert {form["form"] for form in data["forms"]} == set(NAMES)
    for form in data["forms"]:
        _, *printed, slowest = ROWS[pair, NAMES[form["form"]]]
        for name, text in zip(COLUMNS, printed, strict=True):
            value = form["ratios"]["one_pair"][name]
            assert value is None if text == "inf" else isclose(value, float(text), rel_tol=2e-9), (form["form"], name)
        involute = float(ROWS[pair, "involute20"][-1])
        assert form["ratios"]["slowest"] * involute == pytest.approx(float(slowest), abs=1e-9)
        assert "temperature" not in form["form"] or form["ratios"]["depth"] == pytest.approx(1, abs=1e-9)


def test_a_form_that_cannot_run_has_its_faults_in_place_of_numbers() -> None:
    done = call("mesh", *PAIR, "--compare", "--shaft-angle", "90deg", *forms("involute,lantern"))
    assert done.exit_code == 1
    assert re.search(r"^lantern +- +refused ", done.output, re.M)
    assert "no mate in closed form" in " ".join(done.output.split())
    (form,) = compared(*PAIR, "-p", "arcs=0.7,0.7", "-p", "pressure_angle=10deg", *forms("involute"))["forms"]
    assert (form["runs"], form["ratios"]) == (False, None)
    # the dedendum of gear 1 ends where the line of action touches its base circle: R1 tan psi, in pitches
    assert f"before {12 * tan(radians(10)) / pi:.6g}" in form["faults"][0]["fix"]


def test_a_table_a_page_and_data_say_the_same(tmp_path: File) -> None:
    for name in ("c.md", "c.html", "c.json"):
        assert call("mesh", *PAIR, "--compare", *forms(ALL), "-o", tmp_path / name).exit_code == 0
    page, table = ((tmp_path / name).read_text(encoding="utf-8") for name in ("c.html", "c.md"))
    data = json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))
    assert data == compared(*PAIR, *forms(ALL))
    for form in data["forms"]:
        assert f"| {form['form']}" in table
        assert f"{form['ratios']['one_pair']['loss']:.4f}" in table
        assert f"{form['ratios']['one_pair']['loss']:.4f}" in page
    assert "Matched: arcs" in table


@pytest.mark.parametrize("form", ["involute", "cycloidal", "lantern", "uniform_stress", "uniform_temperature"])
def test_every_key_of_a_form_is_the_promised_one(form: str) -> None:
    data = json.loads(call("mesh", *PAIR, "--form", form, "--friction", 0.05, "--json").output)
    assert set(data) == KEYS
    assert data["form"] == form
    assert data["verdict"]["kind"] == "runs"
    assert 0.97 < data["efficiency"]["min"] <= data["efficiency"]["mean"] < 1
    assert sum(data["arcs"]) == pytest.approx(data["contact_ratio"])


def test_a_page_names_verdict_contact_ratio_and_driver() -> None:
    text = call("mesh", *PAIR).output
    assert "Verdict: the teeth run" in text
    assert "Contact ratio 1.64717" in text
    done = json.loads(call("mesh", *PAIR, "--form", "uniform_stress", "--friction", 1e-6, "--json").output)
    assert (1 - done["efficiency"]["mean"]) / 1e-6 == pytest.approx(0.109176344569, rel=1e-5)
    assert "wheel of 36 drives the wheel of 24" in call("mesh", *PAIR, "--form", "uniform_stress", "--driver", 2).output


def test_faults_are_told_with_what_would_fit_and_the_exit_code_is_that_of_a_verdict() -> None:
    done = call("mesh", 8, 60, "--form", "involute")
    assert done.exit_code == 1
    fits = float(re.search(r"addendum of at most ([\d.]+) modules", done.output)[1])  # type: ignore[index]
    # the tip circle through the point where the line of action touches the base circle of gear 1
    most = sqrt((30 * cos(radians(20))) ** 2 + (34 * sin(radians(20))) ** 2) - 30
    assert fits == pytest.approx(most, abs=5e-4)
    assert call("mesh", 8, 60, "--form", "involute", "-p", f"addendum=1,{fits - 0.001}").exit_code in (0, 1)


def test_an_outline_as_svg_needs_no_scipy(tmp_path: File) -> None:
    arguments: list[object] = ["mesh", *PAIR, "--module", "2mm", "--profile", tmp_path / "w.svg"]
    done = without("scipy", arguments=arguments)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "w.svg").exists()


# ------------------------------------------------------------------------------------------------------------- pictures


def drawn(figure: Any, panel: int, gid: str) -> Any:
    (line,) = (line for line in figure.axes[panel].lines if line.get_gid() == gid)
    return np.asarray(line.get_xydata())


def form_of(name: str) -> Any:
    """Return the class of a tooth form."""
    return getattr(teeth, teeth.TOOTH_FORMS[name])


@cache
def figure() -> Any:
    pytest.importorskip("matplotlib")
    from geartrain.drawing.transmission_curves import shapes_figure

    forms = ("involute", "uniform_stress", "uniform_temperature", "least_friction", "cycloidal", "lantern")
    return shapes_figure({form: form_of(form).declared({}).path(24, 36) for form in forms})


def test_each_panel_draws_what_it_says() -> None:
    path = drawn(figure(), 2, "involute")
    assert path[:, 1] == pytest.approx(path[:, 0] * tan(radians(20)), abs=1e-12)
    stress = drawn(figure(), 3, "uniform_stress")[:, 1]
    assert stress == pytest.approx(sqrt((1 / 12 + 1 / 18) / (sin(radians(20)) * cos(radians(20)))), rel=1e-10)
    heat = drawn(figure(), 4, "uniform_temperature")[:, 1]
    assert heat == pytest.approx(0.402114570234, rel=1e-6)
    slide = drawn(figure(), 6, "involute")
    assert slide[:, 1] == pytest.approx((1 / 12 + 1 / 18) * np.abs(slide[:, 0]) * pi * cos(radians(20)), rel=1e-9)
    assert drawn(figure(), 7, "involute")[:, 1] == pytest.approx(1, rel=1e-12)
    # a cycloid's path is its rolling circle, of half the pitch radius of the gear whose dedendum works
    x, y = drawn(figure(), 2, "cycloidal").T
    assert x**2 + y**2 == pytest.approx(np.where(x < 0, -12, 18) * y, abs=1e-9)


def test_a_comparison_is_drawn_to_a_file(tmp_path: File) -> None:
    pytest.importorskip("matplotlib")
    file = tmp_path / "c.svg"
    assert call("mesh", *PAIR, "--compare", *forms("involute,uniform_stress"), "--plot", file).exit_code == 0
    text = file.read_text(encoding="utf-8")
    assert all(f'id="{name}"' in text for name in ("involute", "uniform_stress", "pitch point"))


@pytest.mark.parametrize("more", [{"internal": True}, {"shaft_angle": pi / 2}], ids=str)
def test_one_form_of_a_ring_or_a_bevel_is_drawn_too(more: dict[str, Any]) -> None:
    pytest.importorskip("matplotlib")
    from geartrain.drawing.transmission_curves import shapes_figure
    from geartrain.teeth import UniformStress

    path = UniformStress.declared({}).path(24, 60, **more)
    made = shapes_figure({"uniform_stress": path})
    stress = drawn(made, 3, "uniform_stress")[:, 1]
    unit = path.pitch.p / pi
    curvature = (path.pitch.A + path.pitch.B) * unit / (sin(radians(20)) * cos(radians(20)))
    assert stress == pytest.approx(sqrt(curvature), rel=1e-10)


def test_a_friction_that_locks_is_part_of_the_verdict() -> None:
    done = call("mesh", *PAIR, "--friction", 2)
    assert done.exit_code == 1
    assert "but friction locks them" in " ".join(done.output.split())
    assert "the teeth run" not in done.output


@pytest.mark.parametrize("form", [form for form in teeth.TOOTH_FORMS if form != "ideal"])
def test_the_keys_of_a_form_are_those_of_its_declaration(form: str) -> None:
    model = form_of(form)
    declared = {*model.model_json_schema()["properties"]} - {"form", "stiffness", "damping"}
    rows = json_rows(call("mesh", "--form", form, "--keys", "-o", "-").output)
    assert {*rows} == declared - (set() if model.any_distance else {"centre_distance"})
    for key, default in rows.items():
        if default:
            counts = (11, 12) if model.ringed else (24, 36)
            assert call("mesh", *counts, "--form", form, "-p", f"{key}={default}").exit_code in (0, 1)


def json_rows(text: str) -> dict[str, str]:
    """Key and default of each row of a table in Markdown."""
    cells = [[cell.strip() for cell in line.split("|")[1:3]] for line in text.splitlines() if line.startswith("|")]
    return dict(cells[2:])


def test_teeth_without_a_path_are_cut_as_finely_as_is_requested_and_the_page_tells_what_was_cut(tmp_path: File) -> None:
    requested = ("mesh", 60, 8, "--form", "circular_arc", "--module", "2mm", "--wheel", 1)
    points = {}
    for tolerance in ("0.001mm", "0.1mm"):
        file = tmp_path / f"w{tolerance}.csv"
        done = call(*requested, "--profile", file, "--blank", f"tolerance={tolerance}")
        assert re.search(r"\npitch diameter +120\b", done.output)
        assert re.search(r"\ncentre distance +68\b", done.output)
        points[tolerance] = len(file.read_text(encoding="utf-8").splitlines())
    assert points["0.1mm"] < points["0.001mm"] / 2
    data = json.loads(call(*requested, "--profile", tmp_path / "w.svg", "--json").stdout)
    (outline,) = data["outlines"]
    assert (outline["gear"], outline["z"], outline["pitch_diameter"]) == (1, 60, pytest.approx(120))
    assert data["gears"] == ["wheel 1", "wheel 2"]


def test_a_page_on_teeth_off_their_design_distance_does_not_say_that_they_keep_the_ratio() -> None:
    (apart,) = load("""
links: {frame: {}, a: {wheels: {p: 24}}, b: {wheels: {w: 36}}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [p ~ w]
tooth_form: {form: uniform_stress, centre_distance: 30.02}
friction: 0.05
inputs: {a: 1}
""").meshes
    assert "keep the ratio exactly at every instant." not in " ".join(str(apart).split())
    assert np.ptp(apart.transmission.error_range()) > 1e-6
    words = ("mesh", 24, 36, "--form", "uniform_stress", "--friction", 0.05)
    assert "keep the ratio exactly at every instant." in " ".join(call(*words).stdout.split())
    data = json.loads(call(*words, "--json").stdout)
    assert data["losses_and_stresses"]["one_pair"]["loss"] == pytest.approx(0.109176344569, rel=1e-9)


def test_an_option_that_is_no_text_is_read_as_its_form_has_it() -> None:
    done = call("mesh", 24, 36, "--form", "least_friction", "-p", "literal=true", "--json")
    assert json.loads(done.stdout)["form"] == "least_friction"
    plain = call("mesh", 24, 36, "--form", "least_friction", "--json")
    assert json.loads(done.stdout) != json.loads(plain.stdout)
    pins = ("mesh", 12, 45, "--form", "lantern")
    assert call(*pins, "-p", "pins=1").stdout != call(*pins).stdout == call(*pins, "-p", "pins=2").stdout
