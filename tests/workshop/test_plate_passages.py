"""Plates where wheels across go through them: windows within an edge, notches at it."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st
from shipped import train

from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.scene.parts.stack_discs import Passage, clear_passages, with_passages
from geartrain.scene.solids.bearing_plates import around

PLATE = [(0.0, 0.0), (60.0, 0.0), (60.0, 40.0), (0.0, 40.0)]


def rectangle(passage: Passage) -> shapely.Polygon:
    (x, y), (u, v), length, width = passage.middle, passage.way, passage.length, passage.width
    corners = [(-length, -width), (length, -width), (length, width), (-length, width)]
    return shapely.Polygon([(x + a * u - b * v, y + a * v + b * u) for a, b in corners])


@given(st.floats(0, 60), st.floats(0, 40), st.floats(0, 2 * pi), st.floats(1, 60), st.floats(0.5, 4), st.floats(2, 9))
def test_what_is_left_of_a_plate_is_what_a_foreign_library_leaves(
    x: float, y: float, turn: float, length: float, width: float, edge: float
) -> None:
    """A window or one notch; a plate that would be cut in two, or lose a corner, stays whole."""
    passage = Passage((x, y), (cos(turn), sin(turn)), length, width)
    whole = around(PLATE, edge)
    material = shapely.Polygon(whole.flattened(0.005))
    corners = [shapely.Point(corner) for corner in rectangle(passage).exterior.coords[:4]]
    assume(all(material.exterior.distance(corner) > 1.01 for corner in corners))
    outline, windows = with_passages(whole, [passage])
    found = shapely.Polygon(outline.flattened(0.005), [each.flattened(0.005) for each in windows])
    assert found.is_valid
    inside = [material.covers(corner) for corner in corners]
    cut = material.difference(rectangle(passage))
    if all(inside) or inside in ([True, False, False, True], [False, True, True, False]):
        assert found.symmetric_difference(cut).area < 1e-6 * material.area
    else:
        assert not windows
        assert found.equals(material)


def test_a_window_that_would_leave_a_thin_web_is_a_notch() -> None:
    outline, windows = with_passages(around(PLATE, 3.0), [Passage((30.0, 36.0), (0.0, 1.0), 6.5, 2.0)])
    assert not windows
    found = shapely.Polygon(outline.points)
    assert not found.covers(shapely.Point(30.0, 42.9))
    assert found.area == pytest.approx(shapely.Polygon(around(PLATE, 3.0).flattened(0.005)).area - 4 * 13.5, abs=1e-3)


def test_a_passage_into_a_hole_is_left_out() -> None:
    passage = Passage((30.0, 20.0), (1.0, 0.0), 10.0, 2.0)
    assert clear_passages([passage], [((30.0, 23.0), 0.9)]) == [passage]
    assert clear_passages([passage], [((30.0, 23.0), 1.1)]) == []
    assert clear_passages([passage], [((41.0, 22.5), 1.2)]) == []


@pytest.mark.parametrize(
    ("name", "wheel", "plate"),
    [
        ("worm", "w60", "case back plate"),
        ("crossed-helical", "w20", "frame back plate"),
        ("voulgaris-2024-a", "t1", "frame front plate"),
    ],
)
def test_a_wheel_across_goes_through_its_plate_with_air_round_it(name: str, wheel: str, plate: str) -> None:
    """In its own middle plane the wheel is a rectangle in the plate, 0.4 mm away from what is left."""
    model = SolidModel(train(name), ManufacturingSizes())
    parts = {part.name: part for part in model.parts}
    flat = parts[plate]
    own = (parts[wheel].placed.vertices - flat.place) @ flat.turn
    within = own[np.abs(own[:, 2]) < flat.height / 2 + 3]
    assert len(within)
    outer, *holes = (each.flattened(0.005) for each in flat.contours)
    material = shapely.Polygon(outer, holes)
    gaps = [material.distance(shapely.Point(x, y)) for x, y, z in within if abs(z) <= flat.height / 2]
    assert min(gaps) == pytest.approx(0.4, abs=0.02)
