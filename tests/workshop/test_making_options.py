"""Kerf, arms, sheets, widths and materials: what a maker says, judged by another library on what is written."""

from __future__ import annotations

import re
from math import pi
from pathlib import Path

import numpy as np
import pytest
import yaml
from commands import call
from shipped import train as load

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import GearTrainError, QuestionError
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.scene.solids.bearing_plates import FlatDrawing
from geartrain.teeth.outlines.contour import Contour
from geartrain.workshop import wheel_file
from geartrain.workshop.export.cut_sheets import compensated
from geartrain.workshop.export.parts_list import parts_list

shapely = pytest.importorskip("shapely")


def shape(drawing: FlatDrawing):  # type: ignore[no-untyped-def]
    outer, *holes = (each.flattened(1e-4) for each in drawing.cut)
    return shapely.Polygon(outer, holes)


@pytest.mark.parametrize("kerf", [0.1, 0.2, 0.35])
def test_what_a_laser_leaves_of_a_compensated_outline_is_the_part(kerf: float) -> None:
    work = SolidModel(load("planetary-24-18-60"), ManufacturingSizes(module=2.0))
    for name in ("s", "p", "ring"):
        blank = work.blanks.wheels[name]
        drawing = FlatDrawing(name, blank.contours)
        left = shape(compensated(drawing, kerf)).buffer(-kerf / 2, quad_segs=64)
        true = shape(drawing)
        # corners that look inwards come back round where no cut can reach: what is lost there is a trifle
        assert left.symmetric_difference(true).area < 2e-4 * true.area
        inner = drawing.cut[-1]
        if inner.is_circle:
            bore = compensated(drawing, kerf).cut[-1]
            assert bore.is_circle
            assert bore.moments()[0] == pytest.approx(
                (np.sqrt(inner.moments()[0]) - np.sqrt(pi) * kerf / 2) ** 2, rel=1e-9
            )


def test_a_hole_narrower_than_the_cut_is_refused() -> None:
    drawing = FlatDrawing("disc: one", (Contour.circle(5.0), Contour.circle(0.05)))
    with pytest.raises(GearTrainError, match="'disc' has a hole or a slot narrower"):
        compensated(drawing, 0.2)


def test_only_the_process_that_burns_a_kerf_moves_outlines() -> None:
    files = {
        process: wheel_file(
            SolidModel(load("planetary-24-18-60"), ManufacturingSizes(2.0, process=process)), "s", ".svg"
        )
        for process in ("hand", "laser")
    }
    assert b"kerf" not in files["hand"]
    assert b"compensated for a kerf of 0.2 mm" in files["laser"]


def test_arms_take_the_windows_out_of_the_solid_and_of_its_mass() -> None:
    whole = SolidModel(load("longcase-clock-cycloidal"), ManufacturingSizes(1.0))
    armed = SolidModel(load("longcase-clock-cycloidal"), ManufacturingSizes(1.0, arms=5))
    masses = [{row.names[0]: row.mass for row in parts_list(work)} for work in (whole, armed)]
    for name in ("g96", "c60", "h72"):
        blank = armed.blanks.wheels[name]
        assert blank.arms == 5
        (part,) = [part for part in armed.parts if part.name == name]
        corners = part.solid.vertices[part.solid.faces]
        volume = sum(float(a @ np.cross(b, c)) for a, b, c in corners) / 6
        assert volume == pytest.approx(shape(FlatDrawing(name, blank.contours)).area * blank.thickness, rel=5e-3), (
            "but for chords"
        )
        assert masses[1][name] == pytest.approx(volume * 8.47e-3, rel=5e-3)
        assert masses[1][name] < 0.6 * masses[0][name]
    for pinion in ("c8", "t8", "e7"):
        assert armed.blanks.wheels[pinion].arms == 0
        assert masses[0][pinion] == masses[1][pinion]
    with pytest.raises(QuestionError, match="2 arms"):
        ManufacturingSizes(arms=2)


def test_sheets_hold_every_flat_part_at_its_compensated_size(tmp_path: Path) -> None:
    to = tmp_path / "set"
    asked = ("--as", "svg", "--sheet", "400x300mm", "--process", "laser", "--module", "1mm")
    done = call("export", "watch-going-train", "--to", to, *asked)
    assert done.exit_code == 0, done.output
    texts = [path.read_text(encoding="utf-8") for path in (to / "sheets").glob("*.svg")]
    loops = [len(re.findall("M ", re.search(r'id="CUT".* d="([^"]*)"', text).group(1))) for text in texts]  # type: ignore[union-attr]
    alone = [
        path.read_text(encoding="utf-8") for folder in ("wheels", "plates") for path in (to / folder).glob("*.svg")
    ]
    times = [int((re.search(r", (\d+) times", text) or [0, 1])[1]) for text in alone]
    single = [len(re.findall("M ", re.search(r'id="CUT".* d="([^"]*)"', text).group(1))) for text in alone]  # type: ignore[union-attr]
    assert sum(loops) == sum(count * often for count, often in zip(single, times, strict=True))


@pytest.mark.parametrize("text", ["300", "300x200", "ax2mm", "300x200x1mm"])
def test_a_sheet_that_is_none_is_refused(text: str, tmp_path: Path) -> None:
    done = call("export", "watch-going-train", "--to", tmp_path / "set", "--as", "svg", "--sheet", text)
    assert isinstance(done.exception, GearTrainError)
    assert "--sheet" in str(done.exception)


def test_wheels_without_a_thickness_are_of_one_stock() -> None:
    """Two and a half modules of most wheels, as sheets are sold: 21 modules would ask for as many sheets."""
    for name, stock in (("freeth-2008", 1.2), ("longcase-clock-cycloidal", 2.5)):
        wheels = SolidModel(load(name), ManufacturingSizes()).blanks.wheels
        assert {blank.thickness for blank in wheels.values()} == {stock}
    given = GearTrain.declare(
        yaml.safe_load("""
links: {frame: {}, a: {wheels: {p: {teeth: 20, thickness: 1.7 mm}}}, b: {wheels: {w: 40}}, c: {wheels: {q: 30}}}
revolutes: {A: [frame, a], B: [frame, b], C: [frame, c]}
gears: [p ~ w, w ~ q]
inputs: {a: 1}
""")
    )
    made = SolidModel(given, ManufacturingSizes(module=0.43))  # 1.075 mm
    assert {name: blank.thickness for name, blank in made.blanks.wheels.items()} == {"p": 1.7, "w": 1.0, "q": 1.0}
    asked = SolidModel(given, ManufacturingSizes(module=0.43, thickness=1.1))
    assert {blank.thickness for blank in asked.blanks.wheels.values()} == {1.1}


def test_declared_widths_materials_and_arbors_are_those_that_are_made() -> None:
    work = SolidModel(load("longcase-clock-loaded"), ManufacturingSizes())
    rows = {row.names[0]: row for row in parts_list(work)}
    assert (rows["c8"].size, rows["c8"].material) == ("thickness 6", "steel")
    assert (rows["g96"].size, rows["g96"].material) == ("thickness 3", "brass")
    assert rows["third arbor"].size.startswith("diameter 2.5,")
    assert work.frame is not None
    assert {column.axis: column.pivot for column in work.frame.plan.columns}["great"] == 3.0
