"""The kernel that judges cut teeth says what numpy says: play to 1e-12, and the same of every trial."""

from __future__ import annotations

from math import lcm, radians
from typing import Literal

import numpy as np
import pytest
from commands import call, without
from studies.cutting_errors import CuttingErrorModel, ErrorDistribution
from test_hand_cut_law import with_ring

from geartrain import load
from geartrain.errors import RangeError
from geartrain.teeth.triangular.clearance_window import find_window
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.uncertainty import CutWheel, find_trial_plan, read_error_overrides, run_trials
from geartrain.uncertainty.manufacturing_errors.compiled_verdicts import compiled_verdicts
from geartrain.uncertainty.manufacturing_errors.couple_kernel import approach, make_couple, recess
from geartrain.uncertainty.manufacturing_errors.cut_pair import CutGearPair
from geartrain.uncertainty.manufacturing_errors.least_backlash import even_tooth_pair
from geartrain.uncertainty.manufacturing_errors.meshing_cycle import cycle_verdicts
from geartrain.uncertainty.manufacturing_errors.meshing_verdicts import batch_verdicts

EVERY = ["placement=1 %", "tip=3 %", "aperture=2 %", "eccentricity=3 %"]


def sized(z1: int, z2: int, excess: float, beta: float = radians(30)) -> TriangularSizes:
    return TriangularSizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, excess)


def drawn(sizes: TriangularSizes, rng: np.random.Generator, trials: int, scale: float = 1.0) -> CutGearPair:
    errors = CuttingErrorModel(*(ErrorDistribution(scale * each) for each in (0.02, 0.04, 0.03, 0.07)))
    R1, R2 = sizes.signed_radii
    even = CutWheel.even(sizes.z1, R1, sizes.beta1), CutWheel.even(sizes.z2, R2, sizes.beta2)
    first, second = (errors.draw(wheel, rng, trials) for wheel in even)
    return CutGearPair(sizes, first, second, 0.01 * min(sizes.depths) * rng.standard_normal(trials))


@pytest.mark.parametrize("ring", [0, 1, 2])
def test_the_formulas_of_a_couple_are_those_of_the_law_with_their_derivatives(ring: Literal[0, 1, 2]) -> None:
    sizes = with_ring(24, 15, ring)
    sizes = sizes.at(find_window(sizes).at(0.5))
    law = even_tooth_pair(sizes)
    flanks = [(float(np.sin(beta)), float(np.cos(beta))) for beta in sizes.half_angles]
    couple = make_couple(*sizes.signed_radii, sizes.side * sizes.D, sizes.delta, flanks[0], flanks[1])
    assert couple.reach == pytest.approx(float(law.reach), abs=1e-15)
    assert couple.exit_angle == pytest.approx(float(law.exit_angle), abs=1e-15)
    for x in np.linspace(-0.9, 0.9, 7) * couple.reach:
        for formula, name in ((approach, "approach"), (recess, "recess")):
            y, tau, slope = formula(couple, float(x))
            assert y == pytest.approx(float(law.angle(name, x, np)), abs=1e-15)
            assert tau == pytest.approx(float(law.speed(name, x, np)), abs=1e-14)
            assert slope == pytest.approx(float(law.slope(name, x, np)), abs=1e-12)
            step = 1e-5
            low, high = formula(couple, float(x) - step), formula(couple, float(x) + step)
            assert tau == pytest.approx((high[0] - low[0]) / (2 * step), rel=1e-7)
            assert slope == pytest.approx((high[1] - low[1]) / (2 * step), rel=1e-6, abs=1e-8)


@pytest.mark.parametrize("ring", [0, 1, 2])
@pytest.mark.parametrize("pairs", [pytest.param(12), pytest.param(150, marks=pytest.mark.slow)])
def test_every_trial_is_judged_as_without_the_kernel(pairs: int, ring: Literal[0, 1, 2]) -> None:
    """On both sides of the window, at small and at great errors; many of the great are left to numpy."""
    rng, kinds, done = np.random.default_rng(8), np.zeros(4, int), 0
    while done < pairs:
        z1, z2 = (int(z) for z in rng.integers(8, 45, 2))
        sizes = with_ring(z1, z2, ring, radians(rng.uniform(20, 35)))
        if lcm(sizes.z1, sizes.z2) > 400 or not (window := find_window(sizes)):
            continue
        # tips of a ring part soon beyond the window
        sizes = sizes.at(window.at(rng.choice([0.02, 0.3, 0.9, 1.02 if ring else 1.1])))
        try:
            pair = drawn(sizes, rng, 8, rng.choice([0.3, 1.0, 1.0, 2.0 if ring else 4.0]))
        except RangeError:
            continue
        with np.errstate(invalid="ignore"):
            found, true = compiled_verdicts(pair), cycle_verdicts(pair)
        done += 1
        # how deep a ring jams is not compared where its teeth overlap by more than half a pitch
        shallow = (true.play > -sizes.p2 / 2) | (ring == 0)
        assert np.allclose(found.play[shallow], true.play[shallow], rtol=0, atol=1e-12 * sizes.p2, equal_nan=True)
        for name in ("clash", "standstill", "disengaged", "leans"):
            assert np.array_equal(getattr(found, name), getattr(true, name)), name
        kinds += [true.jams.sum(), true.clash.sum(), true.standstill.sum(), (~true.stops).sum()]
    assert kinds.min() >= 1, kinds


def test_the_kernel_in_plain_python_is_the_compiled_one() -> None:
    pair = drawn(sized(12, 9, 0.03), np.random.default_rng(3), 3)
    plain, fast = compiled_verdicts(pair, fast=False), compiled_verdicts(pair)
    assert np.abs(plain.play - fast.play).max() < 1e-14
    assert np.array_equal(plain.stops, fast.stops)


def test_a_batch_asks_the_kernel_where_it_is_told_to_and_places_alone_never_do() -> None:
    pair = drawn(sized(24, 15, 0.02), np.random.default_rng(2), 6)
    slow, fast = (batch_verdicts(pair.sizes, pair.first, pair.second, pair.shift, fast=each) for each in (False, True))
    assert np.abs(slow.play - fast.play).max() < 1e-12
    train = load("moon-triangular")
    assert find_trial_plan(train, read_error_overrides(EVERY)).judged(None, 10**6).fast
    assert not find_trial_plan(train, read_error_overrides(EVERY)).judged(None, 10).fast
    assert not find_trial_plan(train, read_error_overrides(["placement=1 %"])).judged(True, 10**6).fast


def test_trials_of_a_train_are_the_same_with_kernels_and_without() -> None:
    plan = find_trial_plan(load("moon-triangular"), read_error_overrides(EVERY), ["moon"])
    slow, fast = (run_trials(plan, 4, fast=each) for each in (False, True))
    assert np.array_equal(slow.marks, fast.marks)
    assert np.array_equal(slow.errors, fast.errors)


def test_the_command_says_the_same_with_kernels_and_without() -> None:
    words = ["montecarlo", "moon-triangular", "--trials", 3, *(each for error in EVERY for each in ("--set", error))]
    slow, fast = call(*words, "--no-fast"), call(*words, "--fast")
    assert slow.exit_code == fast.exit_code == 0
    assert slow.output == fast.output
    assert without("numba", arguments=words).returncode == 0
