"""Periodic functions through points and of harmonics: values between points, extremes, moments and derivatives."""

from __future__ import annotations

from fractions import Fraction
from math import pi, sqrt
from typing import Any

import numpy as np
import pytest

from geartrain.numerics.periodic_function import (
    HarmonicSeries,
    PeriodicPieces,
    PeriodicSum,
    PeriodicTable,
    periodic_integral,
)

EIGHT = [0, 0.03, 0.05, 0.04, 0.01, -0.03, -0.05, -0.04]
TWELVE = [-3.2, -13.6, -12.5, -4, 2.9, 2.2, -3.6, -6.3, -0.1, 10.2, 16.4, 11.1]


def _spline(values: list[float], at: Fraction) -> tuple[Fraction, Fraction]:
    """Return value and slope of the periodic cubic spline through even points, by exact elimination of its slopes."""
    n, y = len(values), [Fraction(str(value)) for value in values]
    # m(k-1) + 4 m(k) + m(k+1) = 3 (y(k+1) - y(k-1)) / h, solved by Gauss-Jordan elimination
    rows = [[Fraction(0)] * (n + 1) for _ in range(n)]
    for k, row in enumerate(rows):
        row[k] += 4
        row[(k - 1) % n] += 1
        row[(k + 1) % n] += 1
        row[n] = 3 * n * (y[(k + 1) % n] - y[k - 1])
    for k in range(n):
        rows[k] = [each / rows[k][k] for each in rows[k]]
        for other in range(n):
            if other != k:
                rows[other] = [a - rows[other][k] * b for a, b in zip(rows[other], rows[k], strict=True)]
    k = int(at * n)
    t, h, low, high = at * n - k, Fraction(1, n), rows[k][n], rows[(k + 1) % n][n]
    a, b = y[k], y[(k + 1) % n]
    value = (1 + 2 * t) * (1 - t) ** 2 * a + t * (1 - t) ** 2 * h * low + t * t * (3 - 2 * t) * b
    value += t * t * (t - 1) * h * high
    slope = 6 * t * (1 - t) * (b - a) / h + (1 - t) * (1 - 3 * t) * low + t * (3 * t - 2) * high
    return value, slope


@pytest.mark.parametrize("values", [EIGHT, TWELVE])
def test_a_cubic_table_is_the_periodic_spline(values: list[float]) -> None:
    table = PeriodicTable([k / len(values) for k in range(len(values))], values, 1.0, "cubic")
    for at in (Fraction(k, 37) for k in range(37)):
        value, slope = _spline(values, at)
        assert float(table(float(at))) == pytest.approx(float(value), abs=1e-13)
        assert float(table.derivative(float(at) + 5)) == pytest.approx(float(slope), abs=1e-11)


def test_pchip_stays_within_its_points_and_steps_keep_them() -> None:
    places = [0, 0.1, 0.15, 0.4, 0.5, 0.6, 0.8, 0.97]
    for interpolation in ("pchip", "linear", "steps"):
        table = PeriodicTable(places, EIGHT, 1.0, interpolation)
        assert table.extremes() == pytest.approx((-0.05, 0.05), abs=1e-15)
        assert table(places) == pytest.approx(EIGHT, abs=1e-15)
    assert list(table([0.09999, 0.1, 0.99, 1.0, -0.01])) == [0, 0.03, -0.04, 0, -0.04]
    before, after = table.sides(0)
    assert list(after) == EIGHT
    assert list(before) == [EIGHT[-1], *EIGHT[:-1]]


def test_harmonics_have_exact_moments_and_extremes() -> None:
    series = HarmonicSeries([(1, 0.3, 0.2), (7, 0.1, 1.0)], 4.0, 0.05)
    assert series.moments() == pytest.approx((0.05, sqrt((0.3**2 + 0.1**2) / 2)), abs=1e-14)
    one = HarmonicSeries([(3, 0.4, 0.7)], 5.0)
    for order in (0, 1, 2):
        size = 0.4 * (6 * pi / 5) ** order
        assert one.extremes(order) == pytest.approx((-size, size), rel=1e-14)


def _piece(powers: list[float]) -> PeriodicPieces:
    """Return the polynomial of x from -1 to 1, by ascending powers, with the period 2."""
    return PeriodicPieces(np.array([-1.0]), np.array(powers)[::-1, None], 2.0, np.array([0.0]))


def test_an_extreme_at_a_sample_is_found() -> None:
    """1 - x^2 has its maximum in the middle, which is a sample of the search."""
    assert _piece([1.0, 0.0, -1.0]).extremes() == pytest.approx((0.0, 1.0), abs=1e-13)


@pytest.mark.parametrize("at", [0.1234567, -0.9, 0.5, 1 / 256])
def test_extremes_of_pieces_are_exact_to_rounding(at: float) -> None:
    """A quartic with the double stationary point of (x - at)^2 (x - 2)^2 at the value 0."""
    quadratic = np.polynomial.polynomial.polyfromroots([at, 2.0])
    quartic = np.polynomial.polynomial.polymul(quadratic, quadratic)
    assert _piece(quartic.tolist()).extremes()[0] == pytest.approx(0, abs=1e-15)


def test_pieces_without_values_have_no_extremes() -> None:
    pieces = PeriodicPieces(np.array([0.0, 1.0]), np.array([[1.0, np.nan], [0.0, np.nan]]), 2.0)
    assert pieces.extremes() == pytest.approx((0.0, 1.0), abs=1e-13)


def test_the_integral_of_a_slope_has_its_derivatives_and_its_mean() -> None:
    found, mean = periodic_integral(lambda x: 0.3 + np.cos(x) * np.exp(np.sin(x)), 2 * pi, [1.0, 4.0])
    x = np.linspace(-3, 9, 501)
    value, sine, cosine = np.exp(np.sin(x)), np.sin(x), np.cos(x)
    assert mean == pytest.approx(0.3, abs=1e-14)
    assert found(x) == pytest.approx(value - np.exp(np.sin(1.0)), abs=1e-13)
    assert found.derivative(x) == pytest.approx(cosine * value, abs=1e-12)
    assert found.derivative(x, 2) == pytest.approx((cosine**2 - sine) * value, abs=1e-11)
    assert found.derivative(x, 3) == pytest.approx(cosine * (cosine**2 - 3 * sine - 1) * value, abs=1e-8)
    assert found.breakpoints.tolist() == [1.0, 4.0]


def _sum() -> PeriodicSum:
    pitch = 2 * pi / 20
    table = PeriodicTable([pitch * k / 8 for k in range(8)], EIGHT, pitch, "cubic")
    return PeriodicSum([table, HarmonicSeries([(1, 0.3, 0.2), (7, 0.1, 1.0)], 2 * pi, 0.05)], 2 * pi)


@pytest.mark.parametrize("order", [0, 1])
def test_the_extremes_of_a_sum_are_those_of_dense_samples(order: int) -> None:
    whole = _sum()
    values = whole.derivative(np.linspace(0, 2 * pi, 1_000_001), order)
    minimum, maximum = whole.extremes(order)
    assert minimum <= values.min()
    assert maximum >= values.max()
    assert (minimum, maximum) == pytest.approx((values.min(), values.max()), abs=1e-8)


@pytest.mark.parametrize("function", [_sum(), PeriodicTable([0.0, 0.3, 0.5], [1, 2, -1], 1.1)])
@pytest.mark.parametrize("order", [1, 2, 3])
def test_derivatives_are_limits_of_differences(function: Any, order: int) -> None:
    h, x = 1e-5, np.array([0.11, 0.72, 0.9])
    slope = (function.derivative(x + h, order - 1) - function.derivative(x - h, order - 1)) / (2 * h)
    assert function.derivative(x, order) == pytest.approx(slope, rel=1e-5, abs=1e-5)


def test_breakpoints_of_parts_that_coincide_but_for_rounding_are_one() -> None:
    parts = [PeriodicTable([0, 0.1, 0.2], [0, 1, 0], 0.3), PeriodicTable([0, 0.7, 1.4], [0, 1, 0], 2.1)]
    whole = PeriodicSum(parts, 2.1)
    assert len(whole.breakpoints) == 21
    assert whole.extremes()[1] == pytest.approx(2, abs=1e-12)
