"""One couple of triangular teeth against the closure equations at 50 digits, and against forces in the plane."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, pi, radians, tan
from random import Random
from typing import Any

import numpy as np
import pytest
from mechanics import contact, power_ratio
from sorge import APPROACH, RECESS, Pair, drawn, mp

from geartrain.teeth import Triangular
from geartrain.teeth.triangular import TriangularSizes, TriangularTransmission, equal_depth, pitch_true
from geartrain.teeth.triangular.triangular_transmission import contact_course

MANY = [pytest.param(200), pytest.param(4000, marks=pytest.mark.long)]
STEEP = radians(84)


def pairs(seed: int, number: int, most: float, shape: str = "near") -> Iterator[tuple[TriangularSizes, Pair, Random]]:
    """Random pairs whose flanks lean nowhere beyond the perpendicular."""
    random = Random(seed)
    while number:
        sizes = TriangularSizes(*drawn(random, most, shape))
        if max(sizes.beta1, sizes.beta2) + sizes.reach1 + sizes.reach2 < pi / 2:
            number -= 1
            yield sizes, Pair.of(sizes), random


def tooth_pair_of(sizes: TriangularSizes) -> Any:
    return TriangularTransmission(sizes).contact.path.tooth_pair


def positions(pair: Pair, random: Random, number: int = 3) -> Iterator[tuple[float, str]]:
    """Positions within the reach with their phase."""
    for _ in range(number):
        x = float(pair.amax) * random.uniform(-1, 1) * (1 - 1e-15)
        yield x, pair.phase(x)


def relative(got: float, true: Any) -> float:
    return float(abs(mp.mpf(got) / true - 1))


class Worst:
    """The greatest error seen, with what it was seen on."""

    def __init__(self) -> None:
        self.error, self.at = 0.0, ()

    def see(self, error: Any, *at: object) -> None:
        if not float(error) <= self.error:
            self.error, self.at = float(error), at

    def __repr__(self) -> str:
        return f"{self.error:.3g} at {self.at}"


@pytest.mark.parametrize("number", MANY)
@pytest.mark.parametrize("most", [1e3, 1e6])
def test_angle_speed_and_efficiency_at_50_digits(most: float, number: int) -> None:
    angle, speed, efficiency = Worst(), Worst(), Worst()
    for sizes, pair, random in pairs(3, number, most):
        tooth_pair = tooth_pair_of(sizes)
        for x, phase in positions(pair, random):
            f = random.choice([0.05, 0.2, 0.5])
            angle.see(abs(tooth_pair.angle(phase, x) - pair.angle(x, phase)) / pair.p2, sizes, x)
            lean = float(pair.lean(x, phase))
            if lean < STEEP:
                speed.see(relative(tooth_pair.speed(phase, x), pair.speed(x, phase)), sizes, x)
            if 1 - f * tan(lean) > 0.1 and (eta := pair.efficiency(x, f, phase)) > 0.1:
                efficiency.see(relative(tooth_pair.efficiency(phase, x, f), eta), sizes, x, f)
    assert angle.error <= 1e-12, angle
    assert speed.error <= 1e-12, speed
    assert efficiency.error <= 1e-12, efficiency


@pytest.mark.parametrize("number", MANY)
@pytest.mark.parametrize("most", [1e3, 1e6])
def test_arrays_give_the_floats_one_by_one(most: float, number: int) -> None:
    for sizes, pair, random in pairs(4, number // 4, most):
        tooth_pair = tooth_pair_of(sizes)
        for x, phase in positions(pair, random):
            many = np.array([x, x])
            for what in (tooth_pair.angle, tooth_pair.speed):
                assert what(phase, many, np) == pytest.approx(what(phase, x), rel=1e-12, abs=1e-14 * sizes.p2)
            assert tooth_pair.slope(phase, many, np) == pytest.approx(tooth_pair.slope(phase, x), rel=1e-9)
            one = tooth_pair.efficiency(phase, x, 0.1)
            assert tooth_pair.efficiency(phase, many, 0.1, np) == pytest.approx(one, rel=1e-9)


@pytest.mark.parametrize("number", MANY)
@pytest.mark.parametrize("most", [1e3, 1e6])
def test_reach_and_matching_at_50_digits(most: float, number: int) -> None:
    """Both are a root of the tips' overlap, what clearance leaves of the depth: its cancellation is allowed for."""
    reach, matching = Worst(), Worst()
    for sizes, pair, _ in pairs(5, 2 * number, most):
        left = float((pair.R1 + pair.R2 - pair.D) / pair.h)
        reach.see(relative(sizes.reach1, pair.amax) * min(1, 100 * left), sizes, left)
        if sizes.beta1 == sizes.beta2:
            matching.see(relative(sizes.matching, pair.matching) * min(1, 100 * left), sizes, left)
        elif pair.matching < inf:
            error = abs(sizes.matching - pair.matching) / (pair.amax + abs(pair.matching))
            matching.see(error * min(1, 100 * left), sizes, left)
    assert reach.error <= 1e-12, reach
    assert matching.error <= 1e-12, matching


def test_radii_by_rule_are_those_of_the_source() -> None:
    random = Random(6)
    worst = Worst()
    for _ in range(200):
        given = drawn(random, 1e6)
        teeth = (given.z1, given.beta1), (given.z2, given.beta2)
        depths = [1 - mp.sin(beta) / mp.sin(mp.mpf(beta) + mp.pi / z) for z, beta in teeth]
        R1, R2 = equal_depth(given.z1, given.z2, given.beta1, given.beta2)
        upright = pi / 2 - pi / min(given.z1, given.z2) - max(given.beta1, given.beta2)
        steep = 1 / upright if max(given[:2]) < 50 else 0
        worst.see(relative(R2 / R1, depths[0] / depths[1]) / max(1, abs(steep)), given)
        R1, R2 = pitch_true(given.z1, given.z2)
        assert given.z2 / given.z1 == R2 / R1
    assert worst.error <= 1e-12, worst


@pytest.mark.parametrize("phase", [APPROACH, RECESS])
def test_the_speed_ratio_is_the_derivative_of_the_driven_angle(phase: str) -> None:
    speed, slope = Worst(), Worst()
    for sizes, pair, random in pairs(7, 40, 1e4):
        tooth_pair = tooth_pair_of(sizes)
        for x, here in positions(pair, random, 4):
            if here != phase or pair.lean(x, phase) > STEEP:
                continue

            def angle(at: Any, pair: Pair = pair) -> Any:
                return pair.angle(at, phase)

            step = pair.p1 * mp.mpf(10) ** -12
            first = (angle(x + step) - angle(x - step)) / (2 * step)
            second = (angle(x + step) - 2 * angle(mp.mpf(x)) + angle(x - step)) / step**2
            speed.see(relative(tooth_pair.speed(phase, x), first), sizes, x)
            slope.see(abs(tooth_pair.slope(phase, x) - second) / (abs(second) + (1 + first) ** 2), sizes, x)
    assert speed.error <= 1e-9, speed
    assert slope.error <= 1e-9, slope


def test_turned_back_each_wheel_finds_the_other_where_it_was() -> None:
    """f21(-f12(-x)) = x: the front flanks of one direction are the back flanks of the other."""
    worst = Worst()
    for sizes, pair, random in pairs(8, 150, 1e5):
        back = tooth_pair_of(sizes.swapped())
        for x, _ in positions(pair, random):
            y = -tooth_pair_of(sizes).contact(-x)
            tau = float(pair.speed(-x))
            worst.see(abs(back.contact(y) - x) / sizes.p1 * min(1, tau / sizes.ratio), sizes, x)
    assert worst.error <= 1e-11, worst


def near_the_pitch_point(pair: Pair, phase: str, random: Random) -> float:
    """A position just before or after the contact crosses the line of centres, or anywhere."""
    side = random.choice([-1, 1]) * random.choice([1e-3, 0.03, 1]) * random.random()
    sine = pair.R1 * mp.sin(pair.b1) / (pair.D - pair.R2)
    x = mp.mpf(0) if phase == RECESS or sine > 1 else mp.asin(sine) - pair.b1
    return float(x + side * pair.amax)


@pytest.mark.parametrize("wheel", [1, 2])
@pytest.mark.parametrize("phase", [APPROACH, RECESS])
def test_efficiency_is_the_balance_of_forces(phase: str, wheel: int) -> None:
    """Before and after the line of centres, where sliding turns round; either wheel driving."""
    worst = Worst()
    sides = set()
    for given, _, random in pairs(9, 60, 1e3):
        sizes = given if wheel == 1 else given.swapped()
        pair, tooth_pair = Pair.of(sizes), tooth_pair_of(sizes)
        for _ in range(4):
            x = near_the_pitch_point(pair, phase, random)
            f = random.uniform(0.02, 0.6)
            inside = abs(x) < pair.amax and (phase == APPROACH) == (x > pair.matching)
            if not inside or 1 - f * tan(pair.lean(x, phase)) < 0.1:
                continue
            eta, off, tau = power_ratio(pair, mp.mpf(x), phase, mp.mpf(f))
            assert abs(off) < 1e-45, "the contact is on the flank"
            assert abs(tau / pair.speed(x, phase) - 1) < 1e-40
            assert abs(eta / pair.efficiency(x, f, phase) - 1) < 1e-35, "the source's equations and its errata"
            assert eta <= 1
            if eta > 0.1:
                worst.see(relative(tooth_pair.efficiency(phase, x, f), eta), sizes, x, f)
            sides.add((phase == RECESS and x > 0) or (phase == APPROACH and pair.angle(x, phase) > 0))
    assert sides == {True, False}
    assert worst.error <= 1e-12, worst


@pytest.mark.parametrize("phase", [APPROACH, RECESS])
def test_moment_arms_are_distances_of_the_force_and_the_instant_centre_is_on_the_normal(phase: str) -> None:
    """Moments of the vectors over the force; the normal through the contact, where it meets the line of centres."""
    arms, centres, ratios, powers = Worst(), Worst(), Worst(), Worst()
    for sizes, pair, random in pairs(10, 40, 1e3):
        tooth_pair = tooth_pair_of(sizes)
        for _ in range(4):
            x, f = near_the_pitch_point(pair, phase, random), random.uniform(0, 0.6)
            inside = abs(x) < pair.amax and (phase == APPROACH) == (x > pair.matching)
            if not inside or 1 - f * tan(pair.lean(x, phase)) < 0.1:
                continue
            found = contact(pair, mp.mpf(x), phase, mp.mpf(f))
            force = mp.hypot(*found.force)
            got = tooth_pair.moment_arms(phase, x, f)
            for arm, moment in zip(got, found.moments, strict=True):
                arms.see(relative(arm, moment / force), sizes, x, f)
            centre = tooth_pair.instant_centre(phase, x)
            centres.see(relative(centre, found.centre), sizes, x)
            # no sliding there: both wheels carry it along at one speed
            ratios.see(relative(centre / (sizes.D - centre), found.tau), sizes, x)
            power = tooth_pair.speed(phase, x) * got[1] / got[0]
            powers.see(abs(power / tooth_pair.efficiency(phase, x, f) - 1), sizes, x)
    assert arms.error <= 1e-12, arms
    assert centres.error <= 1e-12, centres
    assert ratios.error <= 2e-12, ratios
    assert powers.error <= 1e-14, powers


def test_a_course_tells_both_ends_of_every_interval_and_none_of_a_dwell() -> None:
    near, apart = (
        Triangular.declared({"half_angle": "30 deg", "clearance_factor": factor}).transmission(15, 60, 0.2)
        for factor in ("1.032", "1.2")
    )
    course = contact_course(near, 3)
    assert course.phases == ("recess",) * 3 + ("dwell",) * 3
    assert list(course.alpha1[[0, 2, 3, 5]]) == [end for each in near.intervals for end in (each.start, each.end)]
    turning = slice(0, 3)
    power = course.speed_ratio * course.driven_arm / course.driver_arm
    assert power[turning] == pytest.approx(course.efficiency[turning], rel=1e-14)
    assert np.isnan([course.instant_centre[3:], course.driver_arm[3:], course.efficiency[3:]]).all()
    assert (course.speed_ratio[3:] == 0).all()
    assert course.to_dict()["driver_arm"][3:] == [None] * 3
    assert contact_course(apart).phases == ()
