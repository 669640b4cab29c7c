"""Parts laid out on sheets, judged by another library: all there, apart, and inside."""

from __future__ import annotations

from itertools import combinations
from random import Random

import numpy as np
import pytest
from shapely.geometry import Polygon, box

from geartrain.errors import QuestionError
from geartrain.scene.solids.bearing_plates import EngravedText, FlatDrawing
from geartrain.teeth.outlines.contour import Contour
from geartrain.workshop.export.cut_sheets import FlatPart, stock_sheets


def part(name: str, contour: Contour, count: int = 1, thickness: float = 2.0, hole: float = 0.5) -> FlatPart:
    middle = contour.points.mean(axis=0)
    at = float(middle[0]), float(middle[1])
    cut = (contour, Contour.circle(hole, at))
    return FlatPart(name, FlatDrawing(name, cut, marks=(EngravedText(name, at, 1.0),)), count, thickness)


def some_parts(random: Random) -> list[FlatPart]:
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
    assert sorted(laid) == sorted(each.name for each in parts for _ in range(each.count))
    assert len({sheet.file for sheet in sheets}) == len(sheets)
    sizes = {each.name: Polygon(each.drawing.cut[0].flattened(1e-3)).area for each in parts}
    for sheet in sheets:
        assert len({each.thickness for each in parts if each.name in sheet.parts}) == 1
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


def test_a_part_may_be_turned() -> None:
    (sheet,) = stock_sheets([part("bar", Contour.of([(0, 0, 0), (10, 0, 0), (10, 90, 0), (0, 90, 0)]))], (100, 20), 1)
    low, high = sheet.drawing.cut[0].points.min(axis=0), sheet.drawing.cut[0].points.max(axis=0)
    assert high - low == pytest.approx([90, 10])


def test_a_part_larger_than_the_sheet_is_named() -> None:
    with pytest.raises(QuestionError, match="'disc' does not fit on a sheet of 50 x 50 mm"):
        stock_sheets([part("disc", Contour.circle(25))], (50, 50), 1)


def test_parts_are_in_rows_the_tallest_first_and_none_goes_back_to_a_row_before() -> None:
    """On 111 x 86 mm, 5 mm apart: 100 x 40 and 60 x 30 above; then 80 x 20 on a new sheet and 30 x 20 above."""
    sizes = {"a": (100, 40), "d": (80, 20), "b": (60, 30), "c": (30, 20)}
    parts = [part(name, Contour.of([(0, 0, 0), (w, 0, 0), (w, h, 0), (0, h, 0)])) for name, (w, h) in sizes.items()]
    sheets = stock_sheets(parts, (111, 86), 5)
    assert [sheet.parts for sheet in sheets] == [("a", "b"), ("d", "c")]
    corners = [[each.points.min(axis=0) for each in sheet.drawing.cut[::2]] for sheet in sheets]
    assert np.array(corners) == pytest.approx(np.array([[(5, 5), (5, 50)], [(5, 5), (5, 30)]]), abs=0.05)


def test_letters_turn_with_their_part() -> None:
    bar = part("bar", Contour.of([(0, 0, 0), (10, 0, 0), (10, 90, 0), (0, 90, 0)]))
    (mark,) = stock_sheets([bar], (100, 20), 1)[0].drawing.marks
    assert mark.angle == 90
    assert mark.at == pytest.approx((46, 6), abs=0.05)
