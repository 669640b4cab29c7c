"""Pressure of pins on lobes and in holes: against a printed formula of curvature, circles through points, statics."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import geartrain
from geartrain.simulation.strength.pin_strength import lobe_load
from geartrain.teeth.cycloidal_disc import CycloidalDisc

lobes = st.integers(3, 60)
shortening = st.floats(0.3, 0.85)


def of(z: int, k: float, part: float = 0.5) -> CycloidalDisc:
    R = (z + 1) / 2 / k
    bare = CycloidalDisc(z, R, 1e-9)
    return CycloidalDisc(z, R, part * min(bare.sharpest, R * sin(pi / (z + 1))))


@given(lobes, shortening, st.floats(0.0, 2 * pi))
@settings(max_examples=60, deadline=None)
def test_the_outline_is_as_round_as_handbooks_of_reducers_have_it(z: int, k: float, angle: float) -> None:
    """r = R (1 + K^2 - 2 K cos t)^(3/2) / (K (1 + zp) cos t - (1 + zp K^2)) + rp, hollow above 0."""
    disc = of(z, k)
    below = k * (z + 2) * cos(angle) - (1 + (z + 1) * k**2)
    printed = disc.circle * (1 + k**2 - 2 * k * cos(angle)) ** 1.5
    curvature = below / (printed + disc.pin * below)
    assert float(disc.curvature(np.array(angle))) == pytest.approx(-curvature, rel=1e-6, abs=1e-9)


@given(lobes, shortening, st.floats(0.1, 6.2), st.floats(0.1, 0.8))
@settings(max_examples=60, deadline=None)
def test_the_outline_is_as_round_as_a_circle_through_three_of_its_points(
    z: int, k: float, angle: float, part: float
) -> None:
    disc, h = of(z, k, part), 1e-3
    a, b, c = disc.outline(np.array([angle - h, angle, angle + h])).tolist()
    area = ((b - a).conjugate() * (c - a)).imag / 2
    round_ = 4 * area / (abs(a - b) * abs(b - c) * abs(c - a))
    assert float(disc.curvature(np.array(angle))) == pytest.approx(round_, rel=2e-3, abs=2e-3)


def test_pressure_by_another_form_of_hertz() -> None:
    """p = sqrt(F E*/(pi b R)), E* of two equal bodies E/(2 (1 - nu^2))."""
    found = geartrain.load("cycloidal-reducer").strength()
    lobe, holes = found.pins["lobes~ring"], found.pins["holes"]
    stiffness = 206_000 / 2 / (1 - 0.3**2)
    for each in (lobe, holes):
        assert each.pressure == pytest.approx(sqrt(each.force * stiffness / (pi * 8 * each.radius)), rel=1e-6)
    assert 1 / holes.radius == pytest.approx(1 / 2 - 1 / 3.5)
    assert holes.force == pytest.approx(4 * 10_000 / (6 * 12), rel=1e-4)
    # bending and shear by von Mises, spread over 8 mm of a pin of 4 mm that is held at one end
    bent, sheared = holes.force * 8 / 2 / (pi * 4**3 / 32), holes.force / (4 * pi)
    assert holes.pin_stress == pytest.approx(sqrt(bent**2 + 3 * sheared**2))


def test_no_pin_at_any_time_is_pressed_more_than_is_told() -> None:
    disc = CycloidalDisc(11, 25 / 3, 1.0)
    load, worst = lobe_load(disc), 0.0
    R, a, k = disc.circle, 6.0, 6.0 / disc.circle
    for turn in np.linspace(0, 2 * pi / 12, 500):
        angles = turn + 2 * pi * np.arange(12) / 12
        # arms by the cross product of pin and pitch point, both seen from the disc's middle half a module aside
        across = -R * np.sin(angles) / np.hypot(a - R * np.cos(angles), R * np.sin(angles))
        arms = np.maximum(-(a - 0.5) * across, 0.0)
        forces = arms * 5.5 / (arms**2).sum()
        below = k * 13 * np.cos(angles) - (1 + 12 * k**2)
        hollow = R * (1 + k**2 - 2 * k * np.cos(angles)) ** 1.5 / below + 1.0
        worst = max(worst, float((forces * (1 - 1 / hollow)).max()))
    assert load.force * load.curvature == pytest.approx(worst, rel=1e-3)
