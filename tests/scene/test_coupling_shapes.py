"""Belts have the length of their formula, and wheels of variable ratio touch on the line of centres."""

from __future__ import annotations

from fractions import Fraction
from math import dist

import numpy as np
import pytest
import shipped

from geartrain.drawing.projection import part_points
from geartrain.scene import make_scene
from geartrain.scene.coupling_shapes import belt_outlines
from geartrain.scene.pose import scene_pose


@pytest.mark.parametrize(("sense", "length"), [(1, 597.13104546), (-1, 616.04460768)])
def test_the_parts_of_a_belt_have_the_length_of_an_open_or_a_crossed_belt(sense: int, length: float) -> None:
    arcs_and_bars = list(belt_outlines([(0, 0), (200, 0)], [25, 37.5], [1, sense], 2.0))
    total = 0.0
    for outline in arcs_and_bars:
        half = len(outline) // 2
        if len(outline) == 4:
            start, end = (np.mean(outline[at : at + 2], axis=0) for at in (0, 2))
            total += dist(start, end)
        else:
            middle = (np.array(outline[:half]) + np.array(outline[half:])[::-1]) / 2
            total += float(np.hypot(*np.diff(middle, axis=0).T).sum())
    # arcs are drawn by chords of at most 5 degrees, which are shorter by up to 0.03 %
    assert total == pytest.approx(length, rel=5e-4)


@pytest.mark.parametrize("turns", [Fraction(0), Fraction(1, 7), Fraction(2, 5), Fraction(5, 6)])
def test_elliptical_wheels_touch_on_the_line_of_centres(turns: Fraction) -> None:
    scene = make_scene(shipped.train("elliptical-gears"))
    pose = scene_pose(scene, turns)
    coupling = [part for part in scene.shapes if part.kind == "wheel"][:2]
    centres = [np.array(part.place)[:2] for part in coupling]
    between = centres[1] - centres[0]
    reach = 0.0
    for part, centre, way in zip(coupling, centres, (between, -between), strict=True):
        points = pose.point(part.body, part_points(part))[:, :2] - centre
        angle = np.arctan2(points[:, 1], points[:, 0]) - np.arctan2(way[1], way[0])
        order = np.argsort((angle + np.pi) % (2 * np.pi))
        angle = ((angle + np.pi) % (2 * np.pi) - np.pi)[order]
        reach += float(np.interp(0, angle, np.hypot(*points[order].T), period=2 * np.pi))
    assert reach == pytest.approx(float(np.hypot(*between)), rel=2e-4)
