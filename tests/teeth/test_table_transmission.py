"""Transmission functions by tables and harmonics: figures of two tables, mirrored functions, kinks and jumps."""

from __future__ import annotations

from fractions import Fraction
from math import pi, radians
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from geartrain.numerics.periodic_function import HarmonicSeries, PeriodicTable
from geartrain.teeth.couplings.table_transmission import TableTransmission

TURN = 2 * pi
TWELVE = [-3.2, -13.6, -12.5, -4, 2.9, 2.2, -3.6, -6.3, -0.1, 10.2, 16.4, 11.1]
tables = st.lists(st.floats(-10, 10), min_size=4, max_size=13).filter(lambda each: max(each) - min(each) > 0.1)


def tabled(values: list[float], period: float, between: Any = "cubic", ratio: int = 0, **keys: Any) -> Any:
    """A transmission by values at equal angles."""
    steps = [at * period / len(values) for at in range(len(values))]
    return TableTransmission(Fraction(ratio), PeriodicTable(steps, values, period, between), **keys)


def test_the_table_of_case_l10_has_its_figures() -> None:
    found = tabled(TWELVE, TURN)
    assert round(float(found.error(0.04 * TURN)), 10) == -9.3791744
    assert round(float(found.error(0.87 * TURN)), 9) == 15.605221366
    assert round(float(found.speed(0.87 * TURN)) * TURN, 9) == -55.586296615
    assert [round(each, 9) for each in found.error_range()] == [-14.508061186, 16.443871908]
    # the second derivative is linear between the points
    spline = CubicSpline(np.linspace(0, TURN, 13), [*TWELVE, TWELVE[0]], bc_type="periodic")
    assert found.steepest_fall() == pytest.approx(-spline(spline.x, 2).min(), rel=1e-9)
    assert found.mirrored().steepest_fall() == pytest.approx(spline(spline.x, 2).max(), rel=1e-9)


@given(tables, st.sampled_from(["cubic", "linear", "steps"]), st.floats(-3, 3))
def test_a_mirrored_table_has_minus_the_deviation_at_minus_the_angle(
    values: list[float], between: str, phase: float
) -> None:
    found = tabled(values, 3.0, between, 1, phase=phase)
    S = np.linspace(-4, 4, 97) + 0.00123
    behind = found.mirrored()
    assert np.allclose(behind.error(-S), -found.error(S), atol=1e-9)
    assert np.allclose(behind.speed(-S), found.speed(S), atol=1e-8)
    assert behind.error_range() == pytest.approx(tuple(-each for each in found.error_range()[::-1]), abs=1e-9)
    assert behind.error_moments() == pytest.approx((-found.error_moments()[0], found.error_moments()[1]), abs=1e-12)
    # a kink at S is a kink of the mirrored function at -S
    assert np.allclose(np.sort(behind.kinks()), np.sort(-np.array(found.kinks())))
    falls = [(leap.before, leap.after) for leap in behind.speed_leaps()]
    rises = [(leap.before, leap.after) for leap in found.speed_leaps()]
    assert len(falls) + len(rises) <= len(values)


def test_straight_lines_have_corners_and_steps_jump() -> None:
    lines = tabled([0.0, 1.0, 0.0, -1.0], 4.0, "linear", 1)
    assert np.allclose(lines.error([0.25, 1.5, 3.75, -0.25]), [0.25, 0.5, -0.25, -0.25])
    assert lines.speed_range() == (0.0, 2.0)
    assert lines.kinks() == [0.0, 1.0, 2.0, 3.0]
    assert [(leap.before, leap.after) for leap in lines.speed_leaps()] == [(0.0, 2.0)]
    assert [(leap.before, leap.after) for leap in lines.mirrored().speed_leaps()] == [(0.0, 2.0)]
    assert lines.steepest_fall() is None
    assert not lines.at_once
    steps = tabled([0.0, 1.0, 0.0, -1.0], 4.0, "steps", phase=0.5)
    assert np.allclose(steps.error([0.4, 0.6, 2.6, -0.6]), [0, 1, -1, -1])
    assert steps.at_once
    assert steps.speed_range() == (0.0, 0.0)
    assert steps.error_moments() == pytest.approx((0.0, 0.5**0.5), abs=1e-12)


def test_the_equation_of_time_has_the_figures_of_case_l7() -> None:
    """In minutes; the daily change follows from the slope over a year of 365.2422 d."""
    found = TableTransmission(Fraction(0), HarmonicSeries([(1, -7.659, 0.0), (2, 9.863, 3.5932)], TURN))
    assert [round(each, 9) for each in found.error_range()] == [-14.412527194, 16.533625081]
    assert round(found.error_moments()[1], 10) == 8.8300353906
    a_day = TURN / 365.2422 * 60
    assert [round(each * a_day, 9) for each in found.speed_range()] == [-28.082794405, 22.487142756]
    assert found.waves == 2
    assert found.kinks() == []
    assert not found.at_once


def test_the_phase_of_a_table_is_where_its_driver_starts() -> None:
    assert float(tabled(TWELVE, TURN, phase=radians(30)).error(0.0)) == pytest.approx(-13.6)
