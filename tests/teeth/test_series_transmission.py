"""The series function against its power series, the vectors of a Cardan joint and the rolling of ellipses."""

from __future__ import annotations

from fractions import Fraction
from math import asin, atan, cos, degrees, pi, radians, sin, sqrt, tan

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geartrain.errors import RangeError
from geartrain.teeth import PinToSlotTransmission
from geartrain.teeth.couplings.series_transmission import SeriesTransmission

TURN = np.linspace(-pi, pi, 1441)


def joint(angle: float) -> SeriesTransmission:
    """A universal joint of which the driver's fork starts in the plane of both shafts."""
    return SeriesTransmission(Fraction(1), 1.0, 2, tan(angle / 2) ** 2)


def cardan(angle: float, S: float) -> float:
    """The driven angle of a joint by its vectors: both arms of the cross stay perpendicular."""
    arm = np.array([0.0, cos(S), sin(S)])
    # the driven shaft lies in the plane of x and y; its arm at q is normal to the shaft, and starts along z
    sideways, along = np.array([-sin(angle), cos(angle), 0.0]), np.array([0.0, 0.0, 1.0])
    # cos q z - sin q s is normal to the driver's arm
    return float(np.arctan2(arm @ along, arm @ sideways))


@pytest.mark.parametrize("angle", [0.01, radians(30), radians(80)])
def test_a_universal_joint_keeps_the_arms_of_its_cross_perpendicular(angle: float) -> None:
    seen = np.unwrap([cardan(angle, S) for S in TURN])
    assert np.allclose(joint(angle).angle(TURN), seen - seen[len(seen) // 2], atol=1e-12)


def test_a_joint_of_30_degrees_has_the_figures_of_case_l1() -> None:
    found = joint(radians(30))
    low, high = found.error_range()
    assert round(degrees(high - low), 10) == 8.2343885405
    assert round(degrees(found.error_moments()[1]), 10) == 2.9106691165
    assert [round(each, 8) for each in found.speed_range()] == [0.86602540, 1.15470054]
    assert round(degrees(found.angle(0.3)), 9) == 19.656256851
    assert round(found.steepest_fall(), 10) == 0.2945710986


def test_the_pin_of_case_l1_has_the_deviation_of_the_joint() -> None:
    pin, found = PinToSlotTransmission(1.0, tan(radians(15)) ** 2), joint(radians(30))
    assert pin.rho == pytest.approx(0.0717967697, abs=5e-11)
    assert pin.error_range() == pytest.approx(found.error_range(), rel=1e-14)
    assert pin.error_moments() == pytest.approx(found.error_moments(), rel=1e-14)


@pytest.mark.parametrize(
    ("second", "phase", "peak_to_peak", "at_1"),
    [
        (30, 90, 0.0, 1.0),
        (30, 0, 16.426421404, 1.1220015623),
        (20, 90, 4.6762476469, 1.0364608246),
        (20, 0, 11.784594991, 1.0892848637),
    ],
)
def test_two_joints_in_line_have_the_figures_of_case_l2(
    second: float, phase: float, peak_to_peak: float, at_1: float
) -> None:
    first, beta = joint(radians(30)), radians(second)
    last = SeriesTransmission(Fraction(1), 1.0, 2, tan(beta / 2) ** 2, phase=radians(phase))
    S = np.linspace(0, pi, 200_001)
    middle = first.angle(S)
    error = first.error(S) + last.error(middle)
    assert degrees(error.max() - error.min()) == pytest.approx(peak_to_peak, abs=1e-8)
    one = first.angle(1.0)
    assert float(last.angle(one)) == pytest.approx(at_1, abs=1e-10)
    # equation of two joints in one plane
    tangent = tan(1) * (cos(beta) if phase else 1 / cos(beta)) / cos(radians(30))
    assert atan(tangent) == pytest.approx(at_1, abs=1e-10)


def test_ellipses_about_their_foci_roll_with_the_figures_of_case_l3() -> None:
    """From the short radius: tan(q/2) = (1 - e)/(1 + e) tan(S/2)."""
    found = SeriesTransmission(Fraction(1), 2.0, 1, 0.3, phase=pi)
    low, high = found.error_range()
    assert degrees(high - low) == pytest.approx(69.830412495, abs=1e-9)
    assert found.speed_range() == pytest.approx((7 / 13, 13 / 7), rel=1e-15)
    for S, q in ((pi / 2, 0.98788273784), (1.0, 0.57218614403)):
        assert float(found.angle(S)) == pytest.approx(q, abs=1e-11)
        assert 2 * atan(7 / 13 * tan(S / 2)) == pytest.approx(q, abs=1e-11)


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


def test_a_mirrored_function_is_the_function_of_a_driver_seen_from_behind() -> None:
    found = SeriesTransmission(Fraction(1), 1.0, 2, 0.4, phase=0.3)
    behind = found.mirrored()
    assert np.allclose(behind.error(-TURN), -found.error(TURN), atol=1e-14)
    assert np.allclose(behind.speed(-TURN), found.speed(TURN), atol=1e-14)
    straight = joint(1.0)
    assert straight.mirrored() is straight


@pytest.mark.parametrize("rho", [-0.1, 1.0, float("nan")])
def test_a_series_that_does_not_converge_is_refused(rho: float) -> None:
    with pytest.raises(RangeError, match="out of range"):
        SeriesTransmission(Fraction(1), 1.0, 1, rho)
