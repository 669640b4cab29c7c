"""Kerf, arms, sheets, widths and materials: what a maker says, judged by another library on what is written."""

from __future__ import annotations

import re
from itertools import combinations
from math import pi
from pathlib import Path
from random import Random

import numpy as np
import pytest
from commands import call
from shapely.geometry import Polygon, box
from shipped import train as load
from workpieces import part_rows

import geartrain
from geartrain.errors import GearTrainError, QuestionError
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.scene.solids.bearing_plates import EngravedText, FlatDrawing
from geartrain.teeth.outlines.contour import Contour
from geartrain.workshop import wheel_file
from geartrain.workshop.export.cut_sheets import Sheet, compensated, stock_sheets

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
            area = (np.sqrt(inner.moments()[0]) - np.sqrt(pi) * kerf / 2) ** 2
            assert bore.moments()[0] == pytest.approx(area, rel=1e-9)


def test_only_the_process_that_burns_a_kerf_moves_outlines() -> None:
    sizes = (ManufacturingSizes(2.0, process=process) for process in ("hand", "laser"))
    by_hand, burnt = (wheel_file(SolidModel(load("planetary-24-18-60"), each), "s", ".svg") for each in sizes)
    assert b"kerf" not in by_hand
    assert b"compensated for a kerf of 0.2 mm" in burnt


def test_arms_take_the_windows_out_of_the_solid_and_of_its_mass() -> None:
    whole = SolidModel(load("longcase-clock-cycloidal"), ManufacturingSizes(1.0))
    armed = SolidModel(load("longcase-clock-cycloidal"), ManufacturingSizes(1.0, arms=5))
    masses = [{name: float(row["mass_g"]) for name, row in part_rows(work).items()} for work in (whole, armed)]
    for name in ("g96", "c60", "h72"):
        blank = armed.blanks.wheels[name]
        assert blank.arms == 5
        (part,) = [part for part in armed.parts if part.name == name]
        kinks = part.solid.vertices[part.solid.faces]
        volume = sum(float(a @ np.cross(b, c)) for a, b, c in kinks) / 6
        area = shape(FlatDrawing(name, blank.contours)).area
        assert volume == pytest.approx(area * blank.thickness, rel=5e-3), "but for chords"
        assert masses[1][name] == pytest.approx(volume * 8.47e-3, rel=5e-3)
        assert masses[1][name] < 0.6 * masses[0][name]
    for pinion in ("c8", "t8", "e7"):
        assert armed.blanks.wheels[pinion].arms == 0
        assert masses[0][pinion] == masses[1][pinion]
    with pytest.raises(QuestionError, match="2 spokes"):
        ManufacturingSizes(arms=2)


def test_sheets_hold_every_flat_part_at_its_compensated_size(tmp_path: Path) -> None:
    to = tmp_path / "set"
    requested = ("--as", "svg", "--sheet", "400x300mm", "--process", "laser", "--module", "1mm")
    done = call("export", "watch-going-train", "--to", to, *requested)
    assert done.exit_code == 0, done.output

    def loops(text: str) -> int:
        return len(re.findall("M ", re.search(r'id="CUT".* d="([^"]*)"', text).group(1)))  # type: ignore[union-attr]

    sheets, wheels, plates = (
        [path.read_text(encoding="utf-8") for path in (to / folder).glob("*.svg")]
        for folder in ("sheets", "wheels", "plates")
    )
    single = [(loops(text), int((re.search(r", (\d+) times", text) or [0, 1])[1])) for text in wheels + plates]
    assert sum(map(loops, sheets)) == sum(count * often for count, often in single)


def test_wheels_without_a_thickness_are_of_one_stock() -> None:
    """Two and a half modules of most wheels, as sheets are sold: 21 modules would ask for as many sheets."""
    for name, stock in (("freeth-2008", 1.2), ("longcase-clock-cycloidal", 2.5)):
        wheels = SolidModel(load(name), ManufacturingSizes()).blanks.wheels
        assert {blank.thickness for blank in wheels.values()} == {stock}
    given = geartrain.load("""
links: {frame: {}, a: {wheels: {p: {teeth: 20, thickness: 1.7 mm}}}, b: {wheels: {w: 40}}, c: {wheels: {q: 30}}}
revolutes: {A: [frame, a], B: [frame, b], C: [frame, c]}
gears: [p ~ w, w ~ q]
inputs: {a: 1}
""")
    made = SolidModel(given, ManufacturingSizes(module=0.43))  # 1.075 mm
    assert {name: blank.thickness for name, blank in made.blanks.wheels.items()} == {"p": 1.7, "w": 1.0, "q": 1.0}
    requested = SolidModel(given, ManufacturingSizes(module=0.43, thickness=1.1))
    assert {blank.thickness for blank in requested.blanks.wheels.values()} == {1.1}


def test_declared_widths_materials_and_arbors_are_those_that_are_made() -> None:
    work = SolidModel(load("longcase-clock-loaded"), ManufacturingSizes())
    rows = part_rows(work)
    assert (rows["c8"]["size_mm"], rows["c8"]["material"]) == ("thickness 6", "steel")
    assert (rows["g96"]["size_mm"], rows["g96"]["material"]) == ("thickness 3", "brass")
    assert rows["third arbor"]["size_mm"].startswith("diameter 2.5,")
    assert work.frame is not None
    assert {column.axis: column.pivot for column in work.frame.plan.columns}["great"] == 3.0


# ------------------------------------------------------------------ parts laid out on sheets, judged by another library


def part(name: str, contour: Contour, count: int = 1, thickness: float = 2.0, hole: float = 0.5) -> Sheet:
    middle = contour.points.mean(axis=0)
    at = float(middle[0]), float(middle[1])
    cut = (contour, Contour.circle(hole, at))
    return Sheet(name, FlatDrawing(name, cut, marks=(EngravedText(name, at, 1.0),)), (name,) * count, thickness)


def some_parts(random: Random) -> list[Sheet]:
    found = []
    for at in range(random.randint(1, 12)):
        x, y, w, h = (random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(4, 60), random.uniform(4, 60))
        bar = Contour.of([(x, y, 0), (x + w, y, 0.3), (x + w, y + h, 0), (x, y + h, 0)])
        disc = Contour.circle(random.uniform(3, 30), (x, y))
        found.append(part(f"p{at}", random.choice([bar, disc]), random.randint(1, 4), random.choice([2.0, 3.0])))
    return found


@pytest.mark.parametrize("seed", range(20))
def test_all_parts_lie_apart_on_their_sheets(seed: int) -> None:
    random = Random(seed)
    parts, size, gap = some_parts(random), (150.0, 120.0), random.choice([0.0, 1.0, 2.5])
    sheets = stock_sheets(parts, size, gap)
    laid = [name for sheet in sheets for name in sheet.parts]
    assert sorted(laid) == sorted(name for each in parts for name in each.parts)
    assert len({sheet.file for sheet in sheets}) == len(sheets)
    sizes = {each.file: Polygon(each.drawing.cut[0].flattened(1e-3)).area for each in parts}
    for sheet in sheets:
        assert len({each.thickness for each in parts if each.file in sheet.parts}) == 1
        shapes = [Polygon(contour.flattened(1e-3)) for contour in sheet.drawing.cut[::2]]
        for shape, name, hole, mark in zip(
            shapes, sheet.parts, sheet.drawing.cut[1::2], sheet.drawing.marks, strict=True
        ):
            assert shape.area == pytest.approx(sizes[name], rel=1e-6)
            assert mark.text == name
            assert hole.points.mean(axis=0) == pytest.approx(mark.at, abs=1e-9)
            assert box(gap, gap, size[0] - gap, size[1] - gap).buffer(1e-6).contains(shape)
        for one, other in combinations(shapes, 2):
            assert one.distance(other) >= gap - 1e-6
            assert one.intersection(other).area == 0


def test_a_part_may_be_turned_with_its_letters() -> None:
    bar = part("bar", Contour.of([(0, 0, 0), (10, 0, 0), (10, 90, 0), (0, 90, 0)]))
    (sheet,) = stock_sheets([bar], (100, 20), 1)
    assert np.ptp(sheet.drawing.cut[0].points, axis=0) == pytest.approx([90, 10])
    (mark,) = sheet.drawing.marks
    assert mark.angle == 90
    assert mark.at == pytest.approx((46, 6), abs=0.05)


def test_a_part_larger_than_the_sheet_and_a_hole_narrower_than_the_cut_are_named() -> None:
    with pytest.raises(QuestionError, match="'disc' does not fit on a sheet of 50 x 50 mm"):
        stock_sheets([part("disc", Contour.circle(25))], (50, 50), 1)
    drawing = FlatDrawing("disc: one", (Contour.circle(5.0), Contour.circle(0.05)))
    with pytest.raises(GearTrainError, match="'disc' has a hole or a slot narrower"):
        compensated(drawing, 0.2)


def test_parts_are_in_rows_the_tallest_first_and_none_goes_back_to_a_row_before() -> None:
    """On 111 x 86 mm, 5 mm apart: 100 x 40 and 60 x 30 above; then 80 x 20 on a new sheet and 30 x 20 above."""
    sizes = {"a": (100, 40), "d": (80, 20), "b": (60, 30), "c": (30, 20)}
    parts = [part(name, Contour.of([(0, 0, 0), (w, 0, 0), (w, h, 0), (0, h, 0)])) for name, (w, h) in sizes.items()]
    sheets = stock_sheets(parts, (111, 86), 5)
    assert [sheet.parts for sheet in sheets] == [("a", "b"), ("d", "c")]
    kinks = [[each.points.min(axis=0) for each in sheet.drawing.cut[::2]] for sheet in sheets]
    assert np.array(kinks) == pytest.approx(np.array([[(5, 5), (5, 50)], [(5, 5), (5, 30)]]), abs=0.05)
