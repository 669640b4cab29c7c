"""Tables and harmonics against scipy's periodic spline, direct sums, and scans of value and slope."""

from __future__ import annotations

from fractions import Fraction
from math import degrees, pi, radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from geartrain.teeth.couplings.table_transmission import (
    TableTransmission,
    harmonic_transmission,
    spline_pieces,
    table_transmission,
)

TURN = 2 * pi
TWELVE = [-3.2, -13.6, -12.5, -4, 2.9, 2.2, -3.6, -6.3, -0.1, 10.2, 16.4, 11.1]
EQUATION = {1: (-7.659, 0.0), 2: (9.863, 3.5932)}
tables = st.lists(st.floats(-10, 10), min_size=4, max_size=13).filter(lambda each: max(each) - min(each) > 0.1)


def periodic(values: list[float]) -> CubicSpline:
    """The spline by another implementation, over a turn."""
    return CubicSpline(np.linspace(0, TURN, len(values) + 1), [*values, values[0]], bc_type="periodic")


def test_the_table_of_case_l10_has_its_figures() -> None:
    found = table_transmission(Fraction(0), TWELVE, TURN)
    assert round(float(found.error(0.04 * TURN)), 10) == -9.3791744
    assert round(float(found.error(0.87 * TURN)), 9) == 15.605221366
    assert round(float(found.speed(0.87 * TURN)) * TURN, 9) == -55.586296615
    assert [round(each, 9) for each in found.error_range()] == [-14.508061186, 16.443871908]


@given(tables, st.floats(-7, 7))
def test_a_smooth_table_is_a_periodic_cubic_spline(values: list[float], phase: float) -> None:
    found, spline = table_transmission(Fraction(1, 3), values, TURN, phase=phase), periodic(values)
    S = np.linspace(-9, 9, 301)
    x = np.mod(S + phase, TURN)
    assert np.allclose(found.error(S), spline(x), atol=1e-10)
    assert np.allclose(found.speed(S), 1 / 3 + spline(x, 1), atol=1e-9)
    assert found.error_range() == pytest.approx(extremes_of(spline, 0), abs=1e-9)
    low, high = extremes_of(spline, 1)
    assert found.speed_range() == pytest.approx((1 / 3 + low, 1 / 3 + high), abs=1e-9)
    # the second derivative is linear between the points
    assert found.steepest_fall() == pytest.approx(max(0.0, -spline(spline.x, 2).min()), abs=1e-9)
    mean = spline.integrate(0, TURN) / TURN
    assert found.error_moments()[0] == pytest.approx(mean, abs=1e-10)
    assert not found.jumps
    assert found.speed_leaps() == ()


def extremes_of(spline: CubicSpline, order: int) -> tuple[float, float]:
    """Extremes of a derivative of a spline, from the exact roots of the next one and the points."""
    roots = spline.derivative(order + 1).roots(extrapolate=False)
    values = spline(np.concatenate([roots[np.isfinite(roots)], spline.x]), order)
    return float(values.min()), float(values.max())


@given(tables, st.sampled_from(["smooth", "straight", "steps"]), st.floats(-3, 3))
def test_a_mirrored_table_has_minus_the_deviation_at_minus_the_angle(
    values: list[float], between: str, phase: float
) -> None:
    found = table_transmission(Fraction(1), values, 3.0, between, phase)  # type: ignore[arg-type]
    S = np.linspace(-4, 4, 97) + 0.00123
    behind = found.mirrored()
    far = np.abs(np.mod((S + phase) * len(values) / 3.0 + 0.5, 1) - 0.5) > 1e-6  # away from the jumps
    assert np.allclose(behind.error(-S)[far], -found.error(S)[far], atol=1e-9)
    assert np.allclose(behind.speed(-S)[far], found.speed(S)[far], atol=1e-8)
    assert behind.error_range() == pytest.approx(tuple(-each for each in found.error_range()[::-1]), abs=1e-9)


def test_straight_lines_have_corners_and_steps_jump() -> None:
    lines = table_transmission(Fraction(1), [0.0, 1.0, 0.0, -1.0], 4.0, "straight")
    assert np.allclose(lines.error([0.25, 1.5, 3.75, -0.25]), [0.25, 0.5, -0.25, -0.25])
    assert lines.speed_range() == (0.0, 2.0)
    assert lines.kinks() == [0.0, 1.0, 2.0, 3.0]
    assert [(leap.before, leap.after) for leap in lines.speed_leaps()] == [(0.0, 2.0)]
    assert lines.steepest_fall() is None
    assert not lines.jumps
    steps = table_transmission(Fraction(0), [0.0, 1.0, 0.0, -1.0], 4.0, "steps", phase=0.5)
    assert np.allclose(steps.error([0.4, 0.6, 2.6, -0.6]), [0, 1, -1, -1])
    assert steps.jumps
    assert steps.speed_range() == (0.0, 0.0)
    assert steps.error_moments() == (0.0, pytest.approx(0.5**0.5))


def test_the_equation_of_time_has_the_figures_of_case_l7() -> None:
    """Minutes of time as radians of the cam's follower; the daily change follows from the slope over a year."""
    found = harmonic_transmission(Fraction(0), EQUATION, TURN)
    assert [round(each, 9) for each in found.error_range()] == [-14.412527194, 16.533625081]
    assert round(found.error_moments()[1], 10) == 8.8300353906
    a_day = TURN / 365.2422 * 60
    assert [round(each * a_day, 9) for each in found.speed_range()] == [-28.082794405, 22.487142756]


@given(
    st.dictionaries(st.integers(1, 12), st.tuples(st.floats(-5, 5), st.floats(-7, 7)), min_size=1, max_size=4),
    st.floats(-3, 3),
)
def test_harmonics_are_their_sum(harmonics: dict[int, tuple[float, float]], phase: float) -> None:
    found = harmonic_transmission(Fraction(2), harmonics, 3.0, phase)
    S = np.linspace(-5, 5, 401)
    x = (S + phase) * TURN / 3.0
    exact = sum(size * np.sin(k * x + angle) for k, (size, angle) in harmonics.items())
    slope = sum(k * size * np.cos(k * x + angle) for k, (size, angle) in harmonics.items()) * TURN / 3.0
    scale = sum(abs(size) for size, _ in harmonics.values()) + 1e-12
    assert np.abs(found.error(S) - exact).max() < 1e-13 * max(scale, 1)  # rounding of k x
    assert np.abs(found.speed(S) - 2 - slope).max() < 1e-10 * max(scale, 1)
    rms = (sum(size**2 for size, _ in harmonics.values()) / 2) ** 0.5
    assert found.error_moments() == (pytest.approx(0, abs=1e-13), pytest.approx(rms, abs=1e-12))
    low, high = found.error_range()
    dense = np.linspace(0, 3.0, 20_001)
    assert found.error(dense).max() == pytest.approx(high, abs=1e-4 * scale)
    assert found.error(dense).min() == pytest.approx(low, abs=1e-4 * scale)
    assert found.kinks() == []


def test_the_phase_of_a_table_is_where_its_driver_starts() -> None:
    found, moved = (table_transmission(Fraction(0), TWELVE, TURN, phase=phase) for phase in (0.0, radians(30)))
    assert float(moved.error(0.0)) == pytest.approx(-13.6)
    assert degrees(float(found.error(radians(30)))) == pytest.approx(degrees(-13.6))
    assert isinstance(moved, TableTransmission)
    assert spline_pieces(np.zeros(5)).shape == (4, 5)
