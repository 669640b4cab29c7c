"""Many wheels cut by hand at once: against the law of each, against printed figures, a bound, an exact probability."""

from __future__ import annotations

from math import lcm, pi, radians, sqrt
from typing import Literal

import numpy as np
import pytest
from sorge import Pair, least_play
from studies.cut_pair_law import CutPairLaw
from studies.cutting_errors import CuttingErrorModel, ErrorDistribution
from test_hand_cut_law import equally_deep, even, with_ring

from geartrain.errors import RangeError
from geartrain.teeth.triangular.clearance_window import find_window
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.teeth.triangular.tooth_couple import APPROACH, RECESS
from geartrain.workshop.cutting.cut_wheel import CutWheel
from geartrain.workshop.cutting.least_backlash import even_tooth_pair, jamming_bound, nominal_backlash
from geartrain.workshop.cutting.meshing_cycle import batch_verdicts

THIRTY = radians(30)


def stacked(wheels: list[CutWheel]) -> CutWheel:
    """Wheels of one size as one batch."""
    names = ("place", "tip", "leading", "trailing")
    return CutWheel(wheels[0].radius, wheels[0].half_angle, *(np.stack([getattr(w, n) for w in wheels]) for n in names))


def cut(
    sizes: TriangularSizes, rng: np.random.Generator, trials: int, cutting: CuttingErrorModel
) -> tuple[CutWheel, CutWheel]:
    driver, driven = (cutting.draw(wheel, rng, trials) for wheel in even(sizes))
    return driver, driven


# --------------------------------------------------------------------------------------------------- one by one

EVERY = CuttingErrorModel(
    ErrorDistribution(0.02), ErrorDistribution(0.04), ErrorDistribution(0.03), ErrorDistribution(0.07)
)
HALF = CuttingErrorModel(
    ErrorDistribution(0.01), ErrorDistribution(0.02), ErrorDistribution(0.015), ErrorDistribution(0.035)
)
PLACES = CuttingErrorModel(ErrorDistribution(0.04))


@pytest.mark.parametrize("number", [pytest.param(5), pytest.param(60, marks=pytest.mark.long)])
@pytest.mark.parametrize(
    ("cutting", "ring"),
    [
        pytest.param(EVERY, 0, id="every error-0"),
        pytest.param(EVERY, 1, id="every error-1", marks=pytest.mark.slow),
        pytest.param(EVERY, 2, id="every error-2", marks=pytest.mark.slow),
        pytest.param(PLACES, 0, id="places-0"),
        pytest.param(PLACES, 1, id="places-1"),
        pytest.param(PLACES, 2, id="places-2"),
    ],
)
def test_a_batch_says_of_each_what_its_own_law_says(
    cutting: CuttingErrorModel, ring: Literal[0, 1, 2], number: int
) -> None:
    """Play, clash, standstill and gap of random pairs, on both sides of their windows."""
    rng, kinds, done = np.random.default_rng(1), np.zeros(4, int), 0
    while done < (2 * number if ring else number):
        z1, z2 = (int(z) for z in rng.integers(9, 30, 2))
        sizes = with_ring(z1, z2, ring, radians(rng.uniform(20, 35)))
        if lcm(sizes.z1, sizes.z2) > 90:
            continue
        if not (window := find_window(sizes)):
            continue
        # tips of a ring part soon beyond the window
        sizes = sizes.at(window.at(rng.choice([0.05, 0.3, 0.9, 1.02 if ring else 1.05])))
        shift = 0.0 if cutting is PLACES else 0.01 * min(sizes.depths) * rng.standard_normal(4)
        try:
            # a ring that jams by more than the depth of a tooth has no law
            driver, driven = cut(sizes, rng, 4, HALF if ring and cutting is EVERY else cutting)
            found = batch_verdicts(sizes, driver, driven, shift)
        except RangeError:
            continue
        if found.leans.any():
            continue
        done += 1
        for at in range(4):
            here = shift if np.ndim(shift) == 0 else float(shift[at])
            events = CutPairLaw.of(sizes, driver.trial(at), driven.trial(at), here).events
            if not (ring and found.disengaged[at]):  # where no tooth is in reach the play is that of no position
                near = (1e-6 if cutting is PLACES else 1e-8) * sizes.p2
                assert found.play[at] == pytest.approx(events.play, abs=near)
            assert found.disengaged[at] == bool(events.of("disengaged"))
            assert found.standstill[at] == bool(events.of("standstill"))
            assert found.stops[at] == (events.stop is not None)
            kinds += [found.jams[at], found.clash[at], found.standstill[at], not found.stops[at]]
    assert kinds.min() >= 1, kinds


def test_trials_do_not_know_each_other() -> None:
    """In one chunk or in many, alone or together, with shared wheels or copies of them."""
    sizes, rng = equally_deep(24, 15, 0.02), np.random.default_rng(2)
    driver, driven = cut(sizes, rng, 12, EVERY)
    whole = batch_verdicts(sizes, driver, driven)
    for parts in (batch_verdicts(sizes, driver, driven, chunk=1), batch_verdicts(sizes, driver, driven, chunk=300)):
        assert np.abs(parts.play - whole.play).max() < 1e-10 * sizes.p2
        assert (parts.stops == whole.stops).all()
    one = driven.trial(3)
    shared = batch_verdicts(sizes, driver, one)
    copied = batch_verdicts(sizes, driver, stacked([one] * 12))
    assert np.abs(shared.play - copied.play).max() < 1e-10 * sizes.p2


def test_places_alone_are_reckoned_in_another_way_with_the_same_result() -> None:
    """Tips that grow by nothing to speak of send the same wheels through the general way."""
    rng = np.random.default_rng(3)
    for z1, z2, excess, sigma in ((64, 38, 0.02, 0.06), (24, 15, 0.02, 0.05), (15, 20, 0.03, 0.07)):
        sizes = equally_deep(z1, z2, excess)
        driver, driven = cut(sizes, rng, 12, CuttingErrorModel(ErrorDistribution(sigma)))
        placed = batch_verdicts(sizes, driver, driven)
        general = batch_verdicts(sizes, driver.grown(1e-14 * np.ones(z1)), driven)
        assert np.abs(placed.play - general.play).max() < 1e-5 * sizes.p2
        for name in ("jams", "clash", "standstill", "disengaged"):
            assert (getattr(placed, name) == getattr(general, name)).all(), name


def test_shifted_axles_are_another_centre_distance() -> None:
    sizes, rng = equally_deep(24, 15, 0.02), np.random.default_rng(4)
    driver, driven = cut(sizes, rng, 20, PLACES)
    apart = sizes.at(0.03)
    found = batch_verdicts(sizes, driver, driven, apart.D - sizes.D)
    true = batch_verdicts(apart, driver, driven)
    assert np.abs(found.play - true.play).max() < 1e-10 * sizes.p2
    each = batch_verdicts(sizes, driver, driven, np.full(20, apart.D - sizes.D))
    assert np.abs(each.play - true.play).max() < 1e-5 * sizes.p2


@pytest.mark.parametrize("ring", [0, 1, 2])
@pytest.mark.parametrize("phase", [APPROACH, RECESS])
def test_the_derivatives_of_a_contact_are_those_of_its_angle(phase: str, ring: Literal[0, 1, 2]) -> None:
    """Newton's method finds the least play by them."""
    sizes = with_ring(24, 15, ring)
    couple = even_tooth_pair(sizes.at(find_window(sizes).at(0.5)))
    x, step = np.linspace(-0.9, 0.9, 7) * couple.reach, 1e-5
    for function, derivative in ((couple.angle, couple.speed), (couple.speed, couple.slope)):
        low, high = function(phase, x - step, np), function(phase, x + step, np)
        assert derivative(phase, x, np) == pytest.approx((high - low) / (2 * step), rel=1e-6, abs=1e-8)


# ----------------------------------------------------------------------------------------------- printed figures


def test_the_nominal_play_of_the_table() -> None:
    for z1, z2, excess, play in [
        (64, 38, 0.01, 0.136),
        (64, 38, 0.02, 0.368),
        (64, 38, 0.03, 0.585),
        (48, 24, 0.02, 0.207),
        (127, 32, 0.01, 0.176),
        (45, 225, 0.01, 0.394),
    ]:
        assert round(nominal_backlash(equally_deep(z1, z2, excess)), 3) == play


@pytest.mark.parametrize("trials", [pytest.param(4000), pytest.param(100_000, marks=pytest.mark.long)])
def test_flanks_of_64_and_38_teeth_jam_as_often_as_printed(trials: int) -> None:
    sizes, rng = equally_deep(64, 38, 0.02), np.random.default_rng(5)
    seen = []
    for sigma in (0.0413, 0.0516, 0.0661):
        found = batch_verdicts(sizes, *cut(sizes, rng, trials, CuttingErrorModel(ErrorDistribution(sigma))))
        seen.append(float(found.jams.mean()))
        assert seen[-1] <= jamming_bound(sizes, sigma)
    slack = 3 * sqrt(0.01 / trials)
    assert 0.002 < seen[0] < 0.01 + (slack if trials < 10**5 else 0.0)
    assert seen[1] == pytest.approx(0.16, abs=0.03)
    assert seen[2] == pytest.approx(0.80, abs=0.05)


@pytest.mark.parametrize(
    ("z1", "z2", "excess", "sigma"),
    [
        (64, 38, 0.01, 0.015),
        (64, 38, 0.03, 0.066),
        (48, 24, 0.02, 0.028),
        (127, 32, 0.01, 0.019),
        (45, 225, 0.01, 0.048),
    ],
)
def test_the_bound_of_the_table_is_about_one_in_a_hundred(z1: int, z2: int, excess: float, sigma: float) -> None:
    sizes = equally_deep(z1, z2, excess)
    assert jamming_bound(sizes, sigma) == pytest.approx(0.0125, abs=0.0075)
    found = batch_verdicts(
        sizes, *cut(sizes, np.random.default_rng(6), 300, CuttingErrorModel(ErrorDistribution(sigma)))
    )
    assert found.jams.mean() <= 0.02


# ----------------------------------------------------------------------------------------- an exact probability


def chance_that_none_rises(z: int, most: float, nodes: int) -> float:
    """Chance that, of z independent uniform numbers on 0..1 in a circle, none exceeds the one before by `most`.

    The trace of the z-th power of an integral operator, by the trapezoidal rule; its kernel ends at `most`, which
    falls between two nodes.
    """
    step = 1 / nodes
    x = (np.arange(nodes) + 0.5) * step
    # the share of each node's cell that lies below the edge, averaged over the cell it comes from: a ramp of one cell
    kernel = np.clip((most - (x[None, :] - x[:, None])) / step + 0.5, 0.0, 1.0) * step
    power = np.linalg.matrix_power(kernel, z)
    return float(np.trace(power))


@pytest.mark.parametrize("trials", [pytest.param(20_000), pytest.param(400_000, marks=pytest.mark.long)])
def test_the_probability_of_a_jam_is_its_integral(trials: int) -> None:
    """An even driver of 64 teeth; 38 driven teeth out of place by less than any but neighbours would notice.

    A driven tooth that is late against the one before it by more than the least play jams; no other difference of
    two places can use up its own play. The least play comes from a scan of the source's equations.
    """
    sizes = equally_deep(64, 38, 0.01)
    play = least_play(Pair.of(sizes, np))
    half = 0.1 * sizes.p2
    coarse, fine = (chance_that_none_rises(38, play / (2 * half), nodes) for nodes in (400, 800))
    assert abs(fine - coarse) < 1e-3
    true = 1 - (fine + (fine - coarse) / 3)
    assert 0.5 < true < 0.999
    driver, driven = even(sizes)
    rng = np.random.default_rng(7)
    found = batch_verdicts(
        sizes, driver, CuttingErrorModel(ErrorDistribution(0.1, "uniform")).draw(driven, rng, trials)
    )
    seen = float(found.jams.mean())
    assert abs(seen - true) < 4 * sqrt(true * (1 - true) / trials) + 2e-4


# ---------------------------------------------------------------------------------------------- eccentric wheels


def test_eccentric_wheels_jam_when_their_errors_use_up_the_clearance() -> None:
    """To first order where e1 + e2 exceeds what the distance has above the least one of the window."""
    sizes = equally_deep(64, 38, 0.02)
    room = (0.02 - find_window(sizes).jam) * sizes.deepest_distance
    share = np.array([0.6, 0.85, 1.15, 1.4])
    driver, driven = even(sizes)
    found = batch_verdicts(
        sizes, driver.eccentric(share * room / 2, 0.3), driven.eccentric(share * room / 2, np.linspace(0, 1, 4))
    )
    assert list(found.jams) == [False, False, True, True]


# ---------------------------------------------------------------------------------------------------------- drawing


def test_errors_are_drawn_as_said() -> None:
    sizes, rng = equally_deep(48, 24, 0.02), np.random.default_rng(8)
    driver, _ = even(sizes)
    wheel = CuttingErrorModel(
        ErrorDistribution(0.02), ErrorDistribution(0.05, "uniform"), ErrorDistribution(0.03)
    ).draw(driver, rng, 500)
    assert wheel.place.shape == (500, 48)
    assert wheel.place.std() == pytest.approx(0.02 * 2 * pi / 48, rel=0.03)
    assert np.abs(wheel.tip).max() <= 0.05 * sizes.depths[0]
    assert wheel.tip.std() == pytest.approx(0.05 * sizes.depths[0] / sqrt(3), rel=0.03)
    assert wheel.leading.std() == pytest.approx(0.03 * THIRTY, rel=0.03)
    again = CuttingErrorModel(
        ErrorDistribution(0.02), ErrorDistribution(0.05, "uniform"), ErrorDistribution(0.03)
    ).draw(driver, np.random.default_rng(8), 500)
    assert (again.place == wheel.place).all()


def test_what_cannot_be_drawn_or_judged_is_refused() -> None:
    sizes = equally_deep(48, 24, 0.02)
    driver, driven = even(sizes)
    for make in (
        lambda: ErrorDistribution(-0.1),
        lambda: ErrorDistribution(float("nan")),
        lambda: CuttingErrorModel(ErrorDistribution(0.1)).draw(driver, np.random.default_rng(0), 0),
        lambda: CuttingErrorModel(ErrorDistribution(2.0)).draw(driver, np.random.default_rng(0), 5),
        lambda: batch_verdicts(sizes, driver, driven),
        lambda: batch_verdicts(sizes, driven, driver),
        lambda: jamming_bound(sizes, -1.0),
    ):
        with pytest.raises(RangeError) as caught:
            make()
        assert all(problem.what and problem.fix for problem in caught.value.problems)


def test_a_bound_has_its_ends() -> None:
    sizes = equally_deep(64, 38, 0.02)
    assert jamming_bound(sizes, 0.0) == 0.0
    assert jamming_bound(sizes, 1.0) == 1.0
    assert jamming_bound(sizes.at(0.001), 0.01) == 1.0


def test_wheels_whose_tips_do_not_meet_touch_nowhere_and_stop_nothing() -> None:
    """Of places alone too, for which tables stand in of couples that there are none of."""
    sizes = TriangularSizes(45, 225, *equal_depth(45, 225, THIRTY, THIRTY), THIRTY, THIRTY, 0.0225)
    assert sizes.R1 + sizes.R2 < sizes.D
    driver, driven = cut(sizes, np.random.default_rng(5), 3, PLACES)
    found = batch_verdicts(sizes, driver, driven, 0.0)
    assert found.play.tolist() == [np.inf] * 3
    assert found.disengaged.all()
    assert not (found.stops | found.standstill).any()
