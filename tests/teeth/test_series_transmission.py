"""The series function against its power series and against a scan."""

from __future__ import annotations

from fractions import Fraction
from math import asin, pi, sqrt

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geartrain.errors import RangeError
from geartrain.teeth.couplings.series_transmission import SeriesTransmission


@pytest.mark.parametrize(("rho", "order", "factor"), [(0.3, 1, 2.0), (0.9, 2, 1.0), (0.2, 3, -1.0), (0.0, 1, 1.0)])
def test_the_error_is_the_sum_of_its_power_series(rho: float, order: int, factor: float) -> None:
    found = SeriesTransmission(Fraction(1, 2), factor, order, rho, phase=0.4)
    for S in (-2.0, 0.1, 1.7):
        x = mpmath.mpf(order) * (mpmath.mpf(S) + mpmath.mpf(0.4))
        total = mpmath.nsum(lambda k, x=x: mpmath.mpf(rho) ** int(k) / k * mpmath.sin(int(k) * x), [1, 400])
        assert float(found.error(S)) == pytest.approx(factor * float(total), abs=1e-14)


@given(st.floats(0.001, 0.999), st.integers(1, 4), st.sampled_from([-1.0, 1.0, 2.0, 2 / 3]))
def test_extremes_moments_and_slopes_are_those_of_a_scan(rho: float, order: int, factor: float) -> None:
    found = SeriesTransmission(Fraction(2, 3), factor, order, rho)
    # graded, so that the narrow peak at S = 0 is resolved; both ends belong to it, because a speed is extreme there
    u = np.linspace(-pi, pi, 20_001)
    S = 2 * np.arctan((1 - rho) / (1 + rho) * np.tan(u / 2)) / order
    assert found.error(S).max() == pytest.approx(found.error_range()[1], rel=1e-6)
    assert found.error_range()[1] == pytest.approx(abs(factor) * asin(rho), rel=1e-9)
    assert (found.speed(S).min(), found.speed(S).max()) == pytest.approx(found.speed_range(), rel=1e-5, abs=1e-5)
    assert (-found.speed_slope(S)).max() == pytest.approx(found.steepest_fall(), rel=1e-4)
    exact = abs(factor) * sqrt(float(mpmath.polylog(2, rho**2)) / 2)
    assert found.error_moments() == (0.0, pytest.approx(exact, rel=1e-12))
    step = 1e-6 * (1 - rho)
    slope = (found.angle(S + step) - found.angle(S - step)) / (2 * step)
    assert np.allclose(found.speed(S), slope, rtol=1e-4, atol=1e-6)


@pytest.mark.parametrize("rho", [-0.1, 1.0, float("nan")])
def test_a_series_that_does_not_converge_is_refused(rho: float) -> None:
    with pytest.raises(RangeError, match="out of range"):
        SeriesTransmission(Fraction(1), 1.0, 1, rho)
