"""Trains at the edge of what floats can do, against 50 digits and fractions; each bound says what float64 can give."""

from __future__ import annotations

import tracemalloc
from fractions import Fraction

import numpy as np
import pytest
from extremes import (
    ARM,
    CASES,
    CIRCULATING,
    EPS,
    SETS,
    Case,
    Exactly,
    Measured,
    Pair,
    Pinned,
    Toothed,
    Train,
    Wheels,
    amplified,
    balanced,
    chain,
    circulating,
    composed,
    declared,
    run,
    suns,
    triangular,
)
from sorge import mp

from geartrain import GearTrainError, load
from geartrain.teeth import PinToSlotTransmission, SlotToPinTransmission


def parameters(case: Case) -> object:
    marks = [pytest.mark.long] if case.slow else []
    return pytest.param(case, id=f"{case.name}: {case.extreme}", marks=marks)


@pytest.mark.parametrize("case", [parameters(case) for case in CASES])
def test_floats_give_what_they_can(case: Case) -> None:
    measured: Measured = case.measure()
    assert measured.error < case.bound


def test_the_solution_of_all_transmissions_is_their_composition_one_in_the_other() -> None:
    train = chain([(60, 48), (50, 75)], 4, triangular())
    exactly = Exactly(train, load(declared(train)))
    angles = exactly.at(3.7, [0.0] * 6)
    error, gain, _ = composed([transmission.transmission for transmission in exactly.transmissions], 3.7)
    assert abs(exactly.errors(3.7, angles)[4] - error) < mp.mpf(10) ** -40
    assert abs(exactly.rates(angles)[4] / exactly.means[4] - gain) < mp.mpf(10) ** -40


def test_the_speed_of_a_transmission_is_the_derivative_of_its_angle() -> None:
    train = chain([(60, 48)], 1, triangular())
    (mesh,) = load(declared(train)).meshes
    for transmission in (Toothed(mesh.transmission.sizes), Pinned(9.6, 1.1)):
        for S in (0.013, 0.031, 0.047):
            assert abs(mp.diff(transmission.angle, S) - transmission.speed(mp.mpf(S))) < mp.mpf(10) ** -20


@pytest.mark.parametrize(
    ("speeds", "more"),
    [({"left": 1.0, ARM: -0.5}, 0), ({"left": 1.0, ARM: 1 / 3}, 3), ({"left": 1.0, "right": 0.0}, 6)],
)
def test_angles_of_planets_that_mesh_solve_all_transmissions(speeds: dict[str, float], more: int) -> None:
    links = SETS | {"other": (ARM, "Q")}
    pairs = (
        Pair("left", "planet", ARM, Wheels(36 + more, 24, triangular())),
        Pair("planet", "other", ARM, Wheels(30, 25 + more, triangular())),
        Pair("other", "right", ARM, Wheels(20, 45, triangular())),
    )
    found = run(Train(links, pairs, speeds), 3.7, 997, 9)
    assert max(found.off.values()) < 1e-13
    assert max(found.speed_off.values()) < 1e-12


@pytest.mark.parametrize(
    ("counts", "inputs", "bound"),
    [((32, 33, 32, 31), {ARM: 1, "left": 0}, 1e-13), ((1000, 1001, 1000, 999), {ARM: 1, "left": 0}, 1e-12)],
)
def test_speeds_near_locking(counts: tuple[int, int, int, int], inputs: dict[str, float], bound: float) -> None:
    """A sun of 1e-3 or 1e-6 of the arm's speed: its ripple is the difference of two speeds of order 1."""
    found = run(suns(counts, inputs), 1000.0, 997, 9)
    assert max(found.speed_off.values()) < bound


def test_speeds_of_a_train_that_makes_them_a_million_million_times_slower() -> None:
    found = run(chain([(30, 300)], 12, triangular()), 1e6, 97, 7)
    assert max(found.speed_off.values()) < 200 * EPS


@pytest.mark.parametrize("teeth", [32, 1000, 31_623])
def test_a_differential_near_locking_cannot_be_driven_from_its_slow_side(teeth: int) -> None:
    """The product of both ratios ripples by more than it differs from 1: past a dead centre the arm turns back."""
    train = suns((teeth, teeth + 1, teeth, teeth - 1), {"right": 1, "left": 0})
    with pytest.raises(GearTrainError, match="coupled pairs"):
        load(declared(train)).motion().transmission_errors(1.0, 101)


@pytest.mark.parametrize("eta", [Fraction(9, 10), Fraction(99, 100), Fraction(999, 1000), 1 - Fraction(1, 10**12)])
def test_the_efficiency_of_circulating_power_is_exact(eta: Fraction) -> None:
    train = circulating(f"efficiency: {eta}")
    (true,) = balanced(CIRCULATING, ({1: eta, -1: eta},) * 2)
    assert train.driven("right", ARM).efficiency == true
    # from the slow sun to the arm: what is lost of a hundred times the power must be less than the power
    back = train.driven(ARM, "right")
    assert back.efficiency == (100 * eta**2 - 99 if 100 * eta**2 > 99 else None)
    assert back.verdict.kind == ("determined" if 100 * eta**2 > 99 else "self-locking")


def test_power_circulates_a_hundredfold_without_loss() -> None:
    torques = circulating("efficiency: 1").driven("right", ARM)
    assert torques.efficiency == 1
    assert torques.circulating == 100


def test_an_error_is_enlarged_as_the_power_circulates() -> None:
    """The arm makes 99 turns for one of the slow sun, and 99 times the error of its wheel, 90 times the planet's."""
    train = suns(CIRCULATING, {"right": 1, "left": 0}, "efficiency: 1")
    (of_arm,) = load(declared(train)).motion(outputs=[ARM]).sensitivity.values()
    assert [abs(each) for each in of_arm.values()] == pytest.approx([90, 99], rel=1e-13)
    assert amplified(1e3).error < 8 * EPS


def test_a_long_run_of_a_long_chain_keeps_few_numbers() -> None:
    """Errors and speeds of 100 pairs at 60 000 positions would be 96 MB."""
    train = chain([(100, 101), (101, 100)], 100, triangular())
    motion = load(declared(train)).motion(outputs=["s100"])
    motion.transmission_errors(1.0, 2)
    tracemalloc.start()
    motion.transmission_errors(50.0, 60_000)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < 60e6


@pytest.mark.parametrize("more", [1e-1, 1e-3, 1e-6, 1e-9])
def test_the_transmission_of_a_pin_near_the_offset(more: float) -> None:
    """The angle the pin is from the fast place is a float of its own, so nothing need be lost."""
    transmission, exactly = PinToSlotTransmission(1 + more, 1.0), Pinned(1 + more, 1.0)
    S = np.geomspace(1e-15, 3, 80)
    for x, error, speed in zip(S.tolist(), transmission.error(S).tolist(), transmission.speed(S).tolist(), strict=True):
        assert abs(error - (exactly.angle(mp.mpf(x)) - mp.mpf(x))) < 8 * EPS
        assert abs(speed / exactly.speed(mp.mpf(x)) - 1) < 8 * EPS
    back = SlotToPinTransmission(1 + more, 1.0)
    for x, error in zip(S.tolist(), back.error(S).tolist(), strict=True):
        assert abs(error + mp.asin(mp.sin(mp.mpf(x)) / mp.mpf(1 + more))) < 16 * EPS
