"""The law of triangular teeth: printed results, transmission error at 50 digits, its mean, its mirror, its energies."""

from __future__ import annotations

from fractions import Fraction
from math import degrees, pi, radians, tan
from random import Random

import numpy as np
import pytest
from sorge import Pair, drawn, first_of_all, integral, mp

from geartrain.teeth.triangular import TriangularSizes, TriangularTransmission, equal_depth

THIRTY = radians(30)

# tooth numbers and excess; printed jumps; speed ratios, mean efficiency, error peak to peak (deg), intervals (deg)
PRINTED = [
    (48, 96, 0.01, {"recess": 0.1582},
        (0.455344539286, 0.540937364223), 0.964785610186, 0.0805539897393, [(-8.7341, -1.2341)]),
    (48, 96, 0.025, {"recess": 0.1457},
        (0.458937254081, 0.537185882069), 0.971997979288, 0.0736476829901, [(-7.8414, -0.3414)]),
    (96, 72, 0.01, {"approach": 0.1117},
        (1.262105039828, 1.420753017835), 0.973102472457, 0.0739440902710, [(1.3457, 5.0957)]),
    (96, 72, 0.025, {"approach": 0.0682, "matching": 0.0316},  # printed 0.0314, against the source's own Eq. (27)
        (1.288052397699, 1.397465519784), 0.986299615457, 0.0467698561691, [(-0.6671, 3.0829)]),
    (96, 96, 0.01, {"approach": 0.0876, "recess": 0.0095},
        (0.955219161626, 1.046880171769), 0.977175343857, 0.0374126089893, [(-3.1756, -1.2822), (2.4678, 4.3244)]),
    (96, 96, 0.025, {"approach": 0.0696, "matching": 0.0119},
        (0.964572294739, 1.036728926856), 0.991593335125, 0.0276894969907, [(-1.8141, 1.9359)]),
]  # fmt: skip


def equally_deep(z1: int, z2: int, excess: float, beta: float = THIRTY) -> TriangularSizes:
    return TriangularSizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, excess)


def transmissions(seed: int, number: int, most: float, kind: str = "runs", friction: float = 0.2):
    """Random pairs with a verdict, friction below locking."""
    random = Random(seed)
    while number:
        sizes = TriangularSizes(*drawn(random, most, "near"))
        if random.random() < 0.3:
            sizes = sizes.swapped()
        transmission = TriangularTransmission(sizes, friction)
        if transmission.verdict.kind == kind and friction < 0.9 * transmission.locking_friction:
            number -= 1
            yield sizes, transmission, random


@pytest.mark.parametrize(("z1", "z2", "excess", "jumps", "speeds", "efficiency", "peak", "active"), PRINTED)
def test_figures_of_the_source_with_more_digits(z1, z2, excess, jumps, speeds, efficiency, peak, active) -> None:
    transmission = TriangularTransmission(equally_deep(z1, z2, excess), 0.2)
    assert {jump.kind: round(jump.value, 4) for jump in transmission.jumps} == jumps
    assert transmission.verdict
    assert transmission.speed_range() == pytest.approx(speeds, rel=1e-12)
    assert transmission.efficiency_mean() == pytest.approx(efficiency, rel=1e-12)
    low, high = transmission.error_range()
    assert degrees(high - low) == pytest.approx(peak, rel=2e-12)
    ends = sorted((degrees(interval.end), degrees(interval.start)) for interval in transmission.intervals)
    joined = [(ends[0][0], ends[-1][1])] if len(active) == 1 else ends
    assert [tuple(round(end, 4) for end in each) for each in joined] == active


CASES = [
    pytest.param(1e3, 15),
    pytest.param(1e6, 8),
    pytest.param(1e3, 1500, marks=pytest.mark.long),
    pytest.param(1e6, 500, marks=pytest.mark.long),
]


@pytest.mark.parametrize(("most", "number"), CASES)
@pytest.mark.parametrize("kind", ["runs", "dwell"])
def test_transmission_error_at_50_digits(kind: str, most: float, number: int) -> None:
    """Within a pitch, and over a turn, where an angle of many pitches has its own rounding; both directions."""
    for sizes, transmission, random in transmissions(31, number, most, kind, 0.0):
        pair, back = Pair.of(sizes), TriangularTransmission(sizes, direction=-1)
        left = min(1.0, 100 * float((pair.R1 + pair.R2 - pair.D) / pair.h))
        assert back.verdict == transmission.verdict
        for direction, one in ((1, transmission), (-1, back)):
            for S in (random.uniform(0, sizes.p1), random.uniform(-2 * pi, 2 * pi)):
                error = abs(float(one.error(S)) - pair.error(S, direction)) / pair.p2
                assert error * left < 1e-12 + 1e-16 * abs(S) / sizes.p1, (sizes, S, direction)
        low, high = pair.error_range
        assert abs(transmission.error_range()[0] - low) * left < 1e-12 * pair.p2, sizes
        assert abs(transmission.error_range()[1] - high) * left < 1e-12 * pair.p2, sizes


@pytest.mark.parametrize("number", [pytest.param(5), pytest.param(150, marks=pytest.mark.long)])
@pytest.mark.parametrize("kind", ["runs", "dwell"])
def test_mean_efficiencies_are_their_integrals(kind: str, number: int) -> None:
    """Eq. (34) at constant driver torque, and at constant load torque, over the driver's angle in contact."""
    for sizes, transmission, _ in transmissions(32, number, 1e3, kind):
        pair = Pair.of(sizes)
        steepest = max(float(pair.lean(x, s.phase)) for s in pair.path if s.held is None for x in (s.start, s.end))
        if 1 - 0.2 * tan(steepest) < 0.5:
            continue
        at_driver, at_load = pair.mean_efficiency(mp.mpf(0.2))
        assert transmission.efficiency_mean() == pytest.approx(float(at_driver), rel=1e-12), sizes
        assert transmission.efficiency_at_constant_load() == pytest.approx(float(at_load), rel=1e-11), sizes


def moments(pair: Pair) -> tuple[float, float]:
    """Mean and rms of the transmission error of a pair without standstills."""

    def over_the_path(what):
        return sum(
            integral(lambda x, s=s: what(pair.angle(x, s.phase) - pair.ratio * x), [s.end, s.start]) for s in pair.path
        )

    mean = over_the_path(lambda lag: lag) / pair.p1
    return float(-mean), float(mp.sqrt(over_the_path(lambda lag: (lag - mean) ** 2) / pair.p1))


@pytest.mark.parametrize("number", [pytest.param(8), pytest.param(200, marks=pytest.mark.long)])
def test_moments_of_the_error_are_their_integrals(number: int) -> None:
    """Where no flank in contact leans beyond 75 deg."""
    for sizes, transmission, _ in transmissions(33, number, 1e3, friction=0.0):
        pair = Pair.of(sizes)
        if max(pair.lean(x, s.phase) for s in pair.path for x in (s.start, s.end)) < radians(75):
            assert transmission.error_moments() == pytest.approx(moments(pair), abs=1e-12 * sizes.p2), sizes


@pytest.mark.parametrize(
    "sizes",
    [
        TriangularSizes(6, 16, 0.375, 1.0, 0.3742031780826165, 0.3742031780826165, 6.990269009025791e-07),
        TriangularSizes(14, 7, 1.5222261804158816, 1.0, 0.6925654538644792, 0.6925654538644792, 0.028478185844130453),
    ],
)
def test_moments_of_the_error_of_steep_flanks_are_their_integrals(sizes: TriangularSizes) -> None:
    transmission = TriangularTransmission(sizes)
    assert transmission.verdict
    assert transmission.error_moments() == pytest.approx(moments(Pair.of(sizes)), abs=1e-12 * sizes.p2)


def test_the_minimum_efficiency_is_the_minimum_of_a_fine_scan() -> None:
    for sizes, transmission, _ in transmissions(34, 12, 300):
        S = np.linspace(0, transmission.period, 20001)
        minimum = float(transmission.efficiency(S).min())
        assert transmission.efficiency_minimum() == pytest.approx(minimum, abs=1e-4), sizes
        assert transmission.efficiency_minimum() <= minimum + 1e-12, sizes
        assert transmission.efficiency_minimum() > 0


def test_the_mean_of_the_transmission_is_the_ratio_of_teeth() -> None:
    """From any angle, a whole number of pitches turns the driven wheel by as many of its own."""
    for kind in ("runs", "dwell"):
        for sizes, transmission, random in transmissions(35, 10, 1e4, kind, 0.0):
            assert transmission.ratio == Fraction(sizes.z1, sizes.z2)
            assert transmission.period == pytest.approx(2 * pi / sizes.z1, rel=1e-15)
            S, pitches = random.uniform(0, 1) * transmission.period, 10**6
            turn = pitches * transmission.period
            driven = transmission.angle(S + turn) - transmission.angle(S)
            assert driven / turn == pytest.approx(float(transmission.ratio), rel=1e-14), sizes


def test_backwards_the_back_flanks_drive() -> None:
    """angle_back(S) = p2 - angle_forward(-S)."""
    for kind in ("runs", "dwell"):
        for sizes, transmission, random in transmissions(39, 15, 1e3, kind):
            back = TriangularTransmission(sizes, 0.2, -1)
            S = np.array([random.uniform(-2, 2) * transmission.period for _ in range(200)])
            assert np.abs(back.angle(S) - (sizes.p2 - transmission.angle(-S))).max() < 1e-13 * sizes.p2 + 1e-15
            assert np.array_equal(back.speed(S), transmission.speed(-S))
            assert np.array_equal(back.efficiency(S), transmission.efficiency(-S), equal_nan=True)
            backlash = back.angle(S) - transmission.angle(S)
            assert backlash.min() >= transmission.verdict.backlash - 1e-12 * sizes.p2
            low, high = transmission.error_range()
            mirrored = sizes.p2 - high, sizes.p2 - low
            assert back.error_range() == pytest.approx(mirrored, abs=1e-15 + 1e-13 * sizes.p2)


def test_any_shape_of_angles_gives_that_shape() -> None:
    transmission = TriangularTransmission(equally_deep(48, 96, 0.01), 0.2)
    S = np.linspace(-3, 9, 40000).reshape(8, 50, 100)
    for what in (transmission.error, transmission.speed, transmission.efficiency, transmission.alpha1):
        assert what(S).shape == S.shape
        assert what(S)[3, 7, 9] == what(S[3, 7, 9])
    assert transmission.error(0.5).shape == ()


def test_the_steepest_fall_is_the_steepest_of_a_scan() -> None:
    for sizes, transmission, _ in transmissions(42, 15, 300):
        S = np.linspace(0, transmission.period, 20001)
        speed = transmission.speed(S)
        smooth = np.abs(np.diff(transmission.alpha1(S)) + np.diff(S)) < 1e-9 * transmission.period
        fall = (-np.diff(speed) / np.diff(S))[smooth]
        fall = fall[fall < 4 * np.median(np.abs(fall)) + 10 * transmission.steepest_fall()]
        cut = np.sort(fall)[: -8 * len(transmission.intervals)]
        assert transmission.steepest_fall() >= max(0.0, cut.max()) * (1 - 1e-3), sizes


def test_a_driven_wheel_that_stands_never_turns_back_nor_lags() -> None:
    for sizes, transmission, _ in transmissions(43, 15, 300, "dwell", 0.0):
        S = np.linspace(-1.3 * transmission.period, 2.1 * transmission.period, 4001)
        q = transmission.angle(S)
        assert np.diff(q).min() >= -1e-12 * sizes.p2, sizes
        first = first_of_all(Pair.of(sizes, np), -S)
        assert (-q <= first + 1e-10 * sizes.p2).all(), sizes
        still = transmission.speed(S) == 0
        assert still.any() or transmission.contact.idle < 1e-3 * transmission.period
        assert np.isnan(transmission.efficiency(S)[still]).all()
        assert not np.isnan(transmission.efficiency(S)[~still]).any()
        assert transmission.speed_range()[0] == 0.0
        widths = [(interval.width, interval.held) for interval in transmission.intervals]
        assert transmission.contact.idle == pytest.approx(sum(width for width, held in widths if held is not None))
        assert sum(width for width, _ in widths) == pytest.approx(transmission.period, rel=1e-12)
