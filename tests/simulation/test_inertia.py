"""Moments of inertia of links: closed forms, triangles, and where each is from."""

from __future__ import annotations

from math import cos, pi, sin, tau

import numpy as np
import pytest

from geartrain import load
from geartrain.simulation import find_link_inertias, find_separation
from geartrain.teeth.outlines.contour import Contour


def test_a_disc_has_its_closed_form_wherever_it_stands() -> None:
    """pi r^4/2 about its centre, and pi r^2 d^2 more about a point d away."""
    area, polar = Contour.circle(3.0).moments()
    assert area == pytest.approx(9 * pi, rel=1e-15)
    assert polar == pytest.approx(81 * pi / 2, rel=1e-15)
    area, polar = Contour.circle(3.0, (4.0, -5.0)).moments()
    assert polar == pytest.approx(81 * pi / 2 + 9 * pi * 41, rel=1e-14)


@pytest.mark.parametrize("sides", [3, 4, 7, 100])
def test_a_regular_polygon_has_its_closed_form(sides: int) -> None:
    """n/2 r^2 sin(2 pi/n), and that times r^2 (2 + cos(2 pi/n))/6."""
    corners = [(2 * cos(tau * at / sides), 2 * sin(tau * at / sides), 0.0) for at in range(sides)]
    area, polar = Contour.of(corners).moments()
    assert area == pytest.approx(2 * sides * sin(tau / sides), rel=1e-13)
    assert polar == pytest.approx(2 * sides * sin(tau / sides) * 4 * (2 + cos(tau / sides)) / 6, rel=1e-13)


def test_arcs_that_turn_left_and_right_agree_with_fine_triangles() -> None:
    shape = Contour.of([(1, 0, 0.3), (5, 1, -0.4), (4, 4, 0.0), (1, 5, 1.7), (-1, 2, -0.2)])
    area, polar = shape.moments()
    points = shape.flattened(1e-9)
    following = np.roll(points, -1, axis=0)
    cross = points[:, 0] * following[:, 1] - points[:, 1] * following[:, 0]
    thirds = (points**2 + points * following + following**2).sum(axis=1)
    assert area == pytest.approx(cross.sum() / 2, rel=1e-8)
    assert polar == pytest.approx((cross * thirds).sum() / 12, rel=1e-8)
    backwards = Contour(shape.points[::-1], -np.roll(shape.bulges, 1)[::-1])
    assert backwards.moments() == pytest.approx((-area, -polar), rel=1e-12)


WHEELS = """
links:
  frame: {{}}
  a: {{wheels: {{p: 20}}}}
  b: {{wheels: {{w: {{teeth: 60, module: 1 mm}}}}{link}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, w]}}]
density: 8.7 g/cm3
{rest}
inputs: {{a: 1}}
"""


def test_a_wheel_is_a_disc_between_its_root_and_its_tip() -> None:
    (found,) = find_link_inertias(load(WHEELS.format(link="", rest="thickness: 2 mm")).mechanics)
    assert (found.source, found.missing) == ("outlines", ())
    low, high = (8700 * 0.002 * pi / 2 * (radius * 1e-3) ** 4 for radius in (30 - 1.25, 30 + 1))
    assert low < found.value < high
    assert found.value == pytest.approx(8700 * 0.002 * pi / 2 * 0.03**4, rel=0.03)


def test_what_is_declared_stands_before_outlines_and_what_is_not_known_is_said() -> None:
    (declared,) = find_link_inertias(
        load(WHEELS.format(link=", inertia: 2e-5 kg m2", rest="thickness: 2 mm")).mechanics
    )
    assert (declared.source, declared.value) == ("declared", 2e-5)
    (unknown,) = find_link_inertias(load(WHEELS.format(link="", rest="")).mechanics)
    assert (unknown.source, unknown.value) == ("unknown", 0)
    assert unknown.missing == ("wheel 'w' has no thickness",)
    assert (
        find_link_inertias(load("moon-triangular").mechanics)[0].missing[0]
        == "wheel 'b1' has no density, no thickness, no module"
    )


PLANETS = """
extends: planetary-24-18-60
links: {{sun: {{wheels: {{s: {{teeth: 24, module: 2 mm}}}}}}, carrier: {{inertia: 1e-5 kg m2}}, planet: {{{planet}}}}}
{rest}
"""


def test_a_planet_goes_round_with_its_carrier() -> None:
    """Its axis is (24 + 18) modules / 2 from the middle: 42 mm."""
    found = {
        each.link: each for each in find_link_inertias(load(PLANETS.format(planet="mass: 30 g", rest="")).mechanics)
    }
    assert found["carrier"].carried == pytest.approx(0.03 * 0.042**2, rel=1e-14)
    assert found["carrier"].value == pytest.approx(1e-5 + 0.03 * 0.042**2, rel=1e-14)
    plates = find_link_inertias(load(PLANETS.format(planet="", rest="density: 1 g/cm3\nthickness: 5 mm")).mechanics)
    carried = {each.link: each.carried for each in plates}["carrier"]
    assert carried == pytest.approx(1000 * 0.005 * pi * 0.018**2 * 0.042**2, rel=0.05)
    nothing = {each.link: each for each in find_link_inertias(load(PLANETS.format(planet="", rest="")).mechanics)}
    assert nothing["carrier"].missing == ("the mass of 'planet', which it takes round, is not known",)


def test_teeth_part_by_the_inertia_of_their_outlines() -> None:
    rest = "thickness: 2 mm\ntooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}"
    train = load(WHEELS.format(link=", bearing: 1 N mm", rest=rest))
    (found,) = find_link_inertias(train.mechanics)
    assert found.source == "outlines"
    declared = load(WHEELS.format(link=f", bearing: 1 N mm, inertia: {found.value!r} kg m2", rest=rest))
    assert find_separation(train.mechanics).rate == pytest.approx(find_separation(declared.mechanics).rate, rel=1e-12)
