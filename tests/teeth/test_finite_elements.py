"""Plane finite elements: a cantilever, Lewis's parabola, and a tooth computed with another mesher."""

from __future__ import annotations

from math import cos, pi, radians, sqrt

import numpy as np
import pytest
from finite_elements import plane_stress, root_stress_factor, triangles

from geartrain.simulation.strength.iso_6336 import ToothSide
from geartrain.teeth import Involute
from geartrain.teeth.conjugate import WheelPair
from geartrain.teeth.outlines.tooth_requirement import ToothRequirement

TWENTY = radians(20)


def pinion(z: int = 17, mate: int = 51) -> tuple[ToothSide, float]:
    pair = Involute(form="involute").pair(WheelPair(z, mate))
    side = ToothSide.of(ToothRequirement(pair, 1, 1e-4, 0.25).cut().tooth)
    # along the line of action, the outer point of single contact is a base pitch after contact begins
    base, tip = z / 2 * cos(TWENTY), z / 2 + 1
    along = sqrt(tip**2 - base**2) - (pair.path.contact_ratio - 1) * pi * cos(TWENTY)
    return side, sqrt(base**2 + along**2)


def test_triangles_fill_the_polygon_and_no_more() -> None:
    polygon = np.array([[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [0, 3.0]])
    points, cells = triangles(polygon, lambda p: np.full(len(p), 0.15), np.array([[2.0, 1.0]]))
    a, b, c = (points[cells[:, k]] for k in range(3))
    area = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    assert area.sum() == pytest.approx(6.0, rel=1e-9)
    assert np.hypot(*(points - np.array([2.0, 1.0])).T).min() < 1e-12


def test_a_straight_cantilever_is_bent_as_a_beam() -> None:
    pytest.importorskip("skfem")
    # 10 long, 1 high, a force of 1 down at its end: half way, sigma = 6 * 5
    polygon = np.array([[0, 0], [10, 0], [10, 1], [0, 1.0]])
    middle = np.array([[4.99, 1.0], [5.0, 1.0]])
    found = plane_stress(
        polygon, np.array([10.0, 1.0]), np.array([0.0, -1.0]), middle, lambda x: x[0] < 1e-9, 0.3, 0.03
    )
    assert found == pytest.approx(30, rel=0.02)  # the edges looked at reach 0.06 past the middle


def test_along_lewiss_parabola_the_stress_is_one() -> None:
    pytest.importorskip("skfem")
    # half thickness sqrt(c x): sigma = 6 F x/(4 c x) everywhere; slender, so that Lewis holds
    c, force = 0.05, 1.0
    x = np.linspace(0.05, 12, 240)
    top = np.stack([x, np.sqrt(c * x)], axis=1)
    polygon = np.concatenate((top, (top * [1, -1])[::-1]))[::-1]
    for place in (4.0, 6.0, 8.0):
        stretch = np.array([[place, sqrt(c * place)]])
        found = plane_stress(polygon, top[0], np.array([0.0, -force]), stretch, lambda at: at[0] > 12 - 1e-9, 0.3, 0.02)
        assert found == pytest.approx(6 * force / (4 * c), rel=0.05)


@pytest.mark.parametrize("fine", [0.06, 0.03])
def test_a_pinion_agrees_with_another_mesher(fine: float) -> None:
    pytest.importorskip("skfem")
    # the same problem meshed by `triangle`, 17 teeth of module 2, width 20, 20 N m: 111.92 at h 0.06 and 0.03
    side, radius = pinion()
    load = side.load_at(radius, 8.5 * cos(TWENTY))
    found = root_stress_factor(side, 17, load, 0.3, fine) * 20_000 / (20 * 4)
    assert found == pytest.approx(111.92, abs=0.5)
    # Lewis's formula has no stress concentration: 60 MPa by docs/strength.md
    assert side.weakest_section(load).stress(20_000, 20, 2) == pytest.approx(60, abs=0.5)
