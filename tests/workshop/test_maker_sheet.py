"""Sheets for a maker: holes, wheels and labels, measured on the written files and compared with declared sizes."""

from __future__ import annotations

import csv
import re
import xml.etree.ElementTree as ET
from functools import cache
from io import StringIO
from itertools import combinations
from math import cos, hypot, radians

import numpy as np
import pytest
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath
from workpieces import workpiece

from geartrain.workshop import export_files, wheel_file

SVG = "{http://www.w3.org/2000/svg}"
HELICAL = """
links: {frame: {}, a: {wheels: {a20: {teeth: 20, helix_angle: 25 deg, hand: right, module: 2 mm}}},
  b: {wheels: {b30: {teeth: 30, helix_angle: 25 deg, hand: left, module: 2 mm}}}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [a20 ~ b30]
inputs: {a: 1}
"""


@cache
def files(train: str, module: float | None = None) -> dict[str, str]:
    """Return the drawings and assembly pictures of an export by path."""
    made = export_files(workpiece(train, module=module), ["svg"])
    return {each.path: each.make().decode() for each in made if each.path.startswith(("drawings/", "assembly/"))}


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(StringIO(text)))


def holes(train: str, module: float | None = None) -> dict[str, dict[str, tuple[float, float]]]:
    """Return the position of each hole of an axis by plate [mm]."""
    found: dict[str, dict[str, tuple[float, float]]] = {}
    for row in rows(files(train, module)["drawings/holes.csv"]):
        found.setdefault(row["plate"], {})[row["hole"]] = (float(row["x mm"]), float(row["y mm"]))
    return found


def between(at: dict[str, tuple[float, float]], one: str, other: str) -> float:
    return hypot(at[one][0] - at[other][0], at[one][1] - at[other][1])


def test_holes_of_meshing_arbors_are_half_the_sum_of_pitch_diameters_apart() -> None:
    """All wheels have a module of 1 mm, but the motion work, whose two pairs share a centre distance of 40 mm."""
    for plate in ("plates back plate", "plates front plate"):
        at = holes("longcase-clock")[plate]
        assert at["great"] == (0, 0), "the datum"
        pairs = {("great", "centre"): (96, 8), ("centre", "third"): (60, 8), ("third", "escape"): (56, 7)}
        pairs["centre", "minute"] = (40, 40)
        for (one, other), (first, second) in pairs.items():
            assert between(at, one, other) == pytest.approx((first + second) / 2, abs=2e-4), (one, other)
    carrier = holes("planetary-24-18-60", 1.5)["carrier carrier plate"]
    assert between(carrier, "planet", "hub") == pytest.approx(1.5 * (24 + 18) / 2)


def test_helical_wheels_have_their_transverse_module_and_the_distance_that_follows() -> None:
    text = files(HELICAL)
    table = {row["wheel"]: row for row in rows(text["drawings/wheels.csv"])}
    assert float(table["a20"]["module mm"]) == pytest.approx(2 / cos(radians(25)), rel=1e-5)
    assert float(table["b30"]["pitch diameter mm"]) == pytest.approx(60 / cos(radians(25)), abs=1e-4)
    assert [table[name]["helix deg"] for name in ("a20", "b30")] == ["+25", "-25"]
    (plate, *_) = holes(HELICAL).values()
    assert between(plate, "A", "B") == pytest.approx(2 / cos(radians(25)) * (20 + 30) / 2, abs=2e-4)


@pytest.mark.parametrize("side", ["back", "front"])
def test_the_table_has_the_circles_of_the_drawing_to_cut(side: str) -> None:
    """The process `hand` has no kerf, so that circles are cut with the finished size."""
    made = export_files(workpiece("longcase-clock", module=None), ["svg"])
    (cut,) = (each.make().decode() for each in made if each.path == f"plates/plates-{side}-plate.svg")
    arcs = r"M (\S+) (\S+) A (\S+) \S+ 0 \d \d (\S+) (\S+) A \S+ \S+ 0 \d \d \1 \2 Z"
    circles = [[float(each) for each in found] for found in re.findall(arcs, cut)]
    measured = sorted((2 * r, (x + u) / 2, -(y + v) / 2) for x, y, r, u, v in circles)
    listed = rows(files("longcase-clock")["drawings/holes.csv"])
    shown = sorted(
        tuple(float(row[key]) for key in ("diameter mm", "x mm", "y mm"))
        for row in listed
        if row["plate"] == f"plates {side} plate"
    )
    assert len(measured) == len(shown)
    # the great arbor, the datum, is at (52, 0) in the drawing
    assert np.array(measured) - (0, 52, 0) == pytest.approx(np.array(shown), abs=2e-4)


@pytest.mark.parametrize(("train", "module"), [("longcase-clock", None), ("planetary-24-18-60", 1.5)])
def test_diameters_of_wheels_are_those_of_their_outlines(train: str, module: float | None) -> None:
    for row in rows(files(train, module)["drawings/wheels.csv"]):
        name = row["wheel"].split(", ")[0]
        svg = wheel_file(workpiece(train, module=module), name, ".svg").decode()
        path = re.search(r'<path id="CUT"[^>]* d="([^"]*)"', svg)
        assert path is not None
        parts = [part for part in path[1].split("Z") if part.strip()]
        pieces = [np.array(re.findall(r"(-?\d+\.\d+) (-?\d+\.\d+)(?= [A-Z]|\s*$)", part), float) for part in parts]
        radius = [np.hypot(*points.T) for points in pieces]
        assert float(row["outside diameter mm"]) == pytest.approx(2 * radius[0].max(), abs=2e-4)
        inside = row["inside diameter mm"]
        root = radius[1].max() if inside else radius[0].min()
        assert float(row["root diameter mm"]) == pytest.approx(2 * root, abs=2e-4)
        if inside:
            assert float(inside) == pytest.approx(2 * radius[1].min(), abs=2e-4)
        if row["bore mm"]:
            assert min(2 * each.max() for each in radius[1:]) == pytest.approx(float(row["bore mm"]), abs=2e-4)


def test_a_sheet_has_scale_1_a_datum_a_scale_bar_and_a_title_block() -> None:
    root = ET.fromstring(files("longcase-clock")["drawings/plates-back-plate.svg"])
    _, _, wide, high = (float(each) for each in str(root.get("viewBox")).split())
    assert (root.get("width"), root.get("height")) == (f"{wide:.3f}mm", f"{high:.3f}mm")
    named = {each.get("id"): each for each in root.iter() if each.get("id")}
    assert {"outline", "datum", "scale-bar", "title-block"} <= set(named)
    assert " h 50 " in str(named["scale-bar"].get("d"))
    words = [text.text or "" for text in root.iter(f"{SVG}text")]
    assert "plates back plate; thickness 3 mm, brass, scale 1:1" in words
    assert any(word.startswith("datum: centre of hole 1 (great)") for word in words)


def boxes(text: str) -> list[tuple[str, float, float, float, float]]:
    """Return each text of an SVG with its left, right, lower and upper edge, measured in DejaVu Sans."""
    root, found = ET.fromstring(text), []
    size = float(next(str(each.get("font-size")) for each in root.iter(f"{SVG}g")))
    for each in root.iter(f"{SVG}text"):
        words, x, y = each.text or "", float(str(each.get("x"))), float(str(each.get("y")))
        if not words:
            continue
        wide = TextPath((0, 0), words, size=size, prop=FontProperties("DejaVu Sans")).get_extents().width
        left = x - {"middle": wide / 2, "end": wide}.get(str(each.get("text-anchor")), 0.0)
        found.append((words, left, left + wide, y - size / 2, y + size / 2))
    return found


@pytest.mark.parametrize(
    ("train", "module"), [("longcase-clock", None), ("planetary-24-18-60", 1.5), ("bevel-differential", None)]
)
def test_labels_of_sheets_and_assembly_pictures_do_not_meet(train: str, module: float | None) -> None:
    drawn = {path: text for path, text in files(train, module).items() if path.endswith(".svg")}
    assert any(path.startswith("assembly/") for path in drawn) or train == "bevel-differential"
    for path, text in drawn.items():
        page = float(str(ET.fromstring(text).get("viewBox")).split()[2])
        every = boxes(text)
        assert len(every) > 1, path
        for one, other in combinations(every, 2):
            apart = one[2] <= other[1] or other[2] <= one[1] or one[4] <= other[3] or other[4] <= one[3]
            assert apart, (path, one[0], other[0])
        assert all(left >= 0 and right <= page for _, left, right, _, _ in every), path
