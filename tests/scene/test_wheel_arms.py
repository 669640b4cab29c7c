"""Openings between arms, checked with another library: rim, hub, arms and corners as requested, none without space."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from shapely.geometry import Polygon

from geartrain.scene.solids.wheel_blanks import spoke_windows

RIM, HUB = 2.25, 1.125  # depth of the rim [module], radius of the hub [diameter of the bore]


@pytest.mark.parametrize(
    ("root", "module", "bore", "arms"), [(30, 1, 3, 5), (30, 1, 3, 3), (12, 1, 2, 4), (100, 1, 5, 6), (90, 2, 4, 7)]
)
def test_windows_leave_rim_hub_and_arms(root: float, module: float, bore: float, arms: int) -> None:
    windows = spoke_windows(root, module, bore, arms)
    assert len(windows) == arms
    shapes = [Polygon(each.flattened(1e-5)) for each in windows]
    for window, shape in zip(windows, shapes, strict=True):
        assert shape.is_valid
        assert window.moments()[0] == pytest.approx(shape.area, rel=1e-4)
        radii = np.hypot(*np.array(shape.exterior.coords).T)
        assert radii.max() == pytest.approx(root - RIM * module)
        assert radii.min() == pytest.approx(
            max(HUB * bore, RIM * module, (RIM + 1) / 2 * module / np.sin(np.pi / arms) - module / 2)
        )
        # a tool with a radius of half a module reaches every corner, a larger one does not
        rounded = (shape.buffer(-r, quad_segs=64).buffer(r, quad_segs=64).area for r in (0.499 * module, module))
        reached, missed = rounded
        assert reached == pytest.approx(shape.area, rel=1e-4)
        assert missed < shape.area - 0.1 * module**2
    for one, other in pairwise([*shapes, shapes[0]]):
        assert one.distance(other) == pytest.approx(RIM * module)


@pytest.mark.parametrize(("root", "arms"), [(30, 0), (30, 2), (5, 4), (6, 4), (30, 90)])
def test_wheels_without_room_stay_whole(root: float, arms: int) -> None:
    assert spoke_windows(root, 1, 2, arms) == ()
