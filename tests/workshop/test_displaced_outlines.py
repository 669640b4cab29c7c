"""Circular-arc teeth cut by hand: displaced flanks where one couple touches, against outlines drawn and turned."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from workshop.test_displaced_flanks import as_drawn, by_law, even, off_ratio, tilted

import geartrain
from geartrain import GearTrainError
from geartrain.dynamics import MotionRun
from geartrain.teeth import CircularArc
from geartrain.teeth.conjugate.displaced_contact import DisplacedContact
from geartrain.teeth.contact.displaced_outlines import displaced_outlines
from geartrain.teeth.contact.gear_outline import GearOutline, OutlineCurve, ToothFlanks
from geartrain.teeth.contact.outline_contact import solve
from geartrain.workshop import find_trial_plan, read_error_overrides, run_trials
from geartrain.workshop.cutting.displaced_pair import DisplacedPair

FORM = CircularArc(form="circular_arc")
TEETH = {(counts, driver): FORM.law(*counts, driver=driver) for counts in ((60, 8), (48, 12)) for driver in (1, 2)}
PAIRS = pytest.mark.parametrize("which", TEETH)
Which = tuple[tuple[int, int], int]


def contact_of(which: Which) -> tuple[DisplacedContact, tuple[GearOutline, GearOutline], float]:
    gears = TEETH[which].gears
    return displaced_outlines(gears, which[1]), gears.of(which[1]), gears.distance


def drawn(which: Which, pair: DisplacedPair, S: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Lag and play of the drawn outlines, in driven pitches."""
    at, (one, two), distance = contact_of(which)
    return off_ratio(at, solve(as_drawn(one, pair.first), as_drawn(two, pair.second), distance + pair.shift, S), S)


def angles(pair: DisplacedPair, number: int = 40) -> np.ndarray:
    return np.random.default_rng(7).uniform(0, pair.count * pair.contact.pitches[0], number)


@PAIRS
def test_wheels_without_errors_turn_as_their_law_says(which: Which) -> None:
    at, _, _ = contact_of(which)
    pair, law = DisplacedPair(at, *even(at)), TEETH[which]
    S = angles(pair)
    lag, play = by_law(pair, S)
    assert lag * at.pitches[1] == pytest.approx(-law.error(S), abs=1e-6 * at.pitches[1])
    back = law.turned_back().error(S)
    assert play * at.pitches[1] == pytest.approx(back - law.error(S), abs=1e-6 * at.pitches[1])
    assert pair.play() == pytest.approx(law.verdict.play, rel=1e-3)
    verdicts = pair.verdicts()
    assert not (verdicts.clash | verdicts.standstill | verdicts.disengaged).any()


@PAIRS
def test_teeth_out_of_place_are_exact_at_any_size(which: Which) -> None:
    at, _, _ = contact_of(which)
    random = np.random.default_rng(2)
    wheels = (replace(each, place=random.normal(0, 0.01 * 2 * pi / each.z, each.z)) for each in even(at))
    pair = DisplacedPair(at, *wheels)
    S = angles(pair)
    for found, true in zip(by_law(pair, S), drawn(which, pair, S), strict=True):
        assert np.ptp(true) > 0.01
        assert found == pytest.approx(true, abs=3e-6)


@PAIRS
@pytest.mark.parametrize("moved", [0, 1, "axles"])
def test_an_eccentric_wheel_and_axles_apart_are_right_to_first_order(which: Which, moved: int | str) -> None:
    at, _, _ = contact_of(which)
    off = []
    for e in (0.02, 0.005):
        wheels = list(even(at))
        if isinstance(moved, int):
            wheels[moved] = replace(wheels[moved], e=np.array(e), towards=np.array(0.7))
        pair = DisplacedPair(at, *wheels, 0.0 if isinstance(moved, int) else e)
        S = angles(pair)
        found, true = by_law(pair, S), drawn(which, pair, S)
        off.append([np.abs(one - other).max() for one, other in zip(found, true, strict=True)])
    # an error of some 0.02/3 pitches; four times less of it, sixteen times nearer
    assert max(off[0]) < 2e-4
    assert all(small < large / 8 + 1e-6 for large, small in zip(*off, strict=True))


@PAIRS
@pytest.mark.parametrize("moved", [0.02, 0.005])
def test_contact_does_not_jump_where_round_tips_stand_still(which: Which, moved: float) -> None:
    """The radius of a round tip has no slope at its end; what a slope of rounding says there must not count."""
    at, (one, two), distance = contact_of(which)
    S = np.linspace(0, two.z * one.pitch, 4001)
    turned = solve(one, two.displaced(-moved * np.sin(0.7), moved * np.cos(0.7)), distance, S).front.angle
    assert np.diff(turned) == pytest.approx(float(at.ratio) * np.diff(S), rel=1.0)


@PAIRS
@pytest.mark.parametrize("gear", [0, 1])
def test_flanks_that_lean_touch_as_their_outlines_do(which: Which, gear: int) -> None:
    at, wheels_drawn, distance = contact_of(which)
    off = []
    for lean in (0.01, 0.0025):
        wheels, turned = list(even(at)), list(wheels_drawn)
        flank = np.full(wheels[gear].z, lean)
        wheels[gear] = replace(wheels[gear], leading=flank, trailing=flank)
        tooth, R = wheels_drawn[gear].teeth[0], wheels_drawn[gear].z / 2
        sides = [tilted(side, R, lean, way) for side, way in ((tooth.ahead, 1), (tooth.behind, -1))]
        turned[gear] = replace(wheels_drawn[gear], teeth=(ToothFlanks(*sides),))
        S = np.random.default_rng(3).uniform(0, at.pitches[0], 40)
        pair = DisplacedPair(at, *wheels)
        found, true = by_law(pair, S), off_ratio(at, solve(turned[0], turned[1], distance, S), S)
        off.append([np.median(np.abs(one - other)) for one, other in zip(found, true, strict=True)])
    assert all(small < large / 6 + 2e-7 for large, small in zip(*off, strict=True))


def lowered(side: tuple[OutlineCurve, ...], low: float, way: int) -> tuple[OutlineCurve, ...]:
    """A side of a tooth filed down by so much along its normal."""

    def curve_below(curve: OutlineCurve) -> OutlineCurve:
        def below(t: np.ndarray) -> np.ndarray:
            step = 1e-6 * (curve.end - curve.start)
            along = curve.at(t + step) - curve.at(t - step)
            normal = np.stack([along[:, 1], -along[:, 0]], axis=1) / np.hypot(*along.T)[:, None]
            inward = -np.sign(normal[:, :1] * way)
            return curve.at(t) + low * inward * normal

        return OutlineCurve(below, curve.start, curve.end)

    return tuple(curve_below(curve) for curve in side)


@pytest.mark.parametrize("gear", [0, 1])
def test_filed_flanks_fall_behind_by_what_is_taken_over_the_moment_arm(gear: int) -> None:
    which = (60, 8), 1
    at, wheels_drawn, distance = contact_of(which)
    low = 0.003
    wheels, turned = list(even(at)), list(wheels_drawn)
    wheels[gear] = wheels[gear].filed(np.full(wheels[gear].z, low), np.full(wheels[gear].z, low))
    tooth = wheels_drawn[gear].teeth[0]
    turned[gear] = replace(
        wheels_drawn[gear], teeth=(ToothFlanks(lowered(tooth.ahead, low, 1), lowered(tooth.behind, low, -1)),)
    )
    S = np.linspace(0, at.pitches[0], 37)
    pair = DisplacedPair(at, *wheels)
    nominal = by_law(DisplacedPair(at, *even(at)), S)
    found, true = by_law(pair, S), off_ratio(at, solve(turned[0], turned[1], distance, S), S)
    for one, other, before in zip(found, true, nominal, strict=True):
        assert np.median(np.abs(other - before)) > 5e-4
        assert np.median(np.abs(one - other)) < 0.02 * np.median(np.abs(other - before))


@pytest.mark.parametrize("counts", [(48, 12), (40, 40)])
def test_the_least_play_is_that_of_all_angles_and_below_nothing_the_outlines_overlap(counts: tuple[int, int]) -> None:
    gears = FORM.law(*counts).gears
    at = displaced_outlines(gears, 1)
    random = np.random.default_rng(5)
    jams = 0
    for size in (0.005, 0.02, 0.02):
        wheels = [replace(each, place=random.normal(0, size * 2 * pi / each.z, each.z)) for each in even(at)]
        wheels[0] = replace(wheels[0], e=np.array(0.02), towards=np.array(1.0))
        pair = DisplacedPair(at, *wheels)
        S = np.linspace(0, pair.count * at.pitches[0], 60 * pair.count, endpoint=False)
        play = by_law(pair, S)[1] * at.pitches[1]
        assert float(pair.play()) == pytest.approx(play.min(), abs=5e-4 * at.pitches[1])
        tight = S[np.argsort(play)[:5]]
        one, two = as_drawn(gears.first, pair.first), as_drawn(gears.second, pair.second)
        true = solve(one, two, gears.distance, tight).play
        assert true == pytest.approx(np.sort(play)[:5], abs=5e-4 * at.pitches[1])
        jams += bool(pair.play() < 0)
    assert counts == (48, 12) or jams


def test_teeth_all_late_alike_are_a_wheel_turned_on_its_arbor() -> None:
    at, _, _ = contact_of(((60, 8), 1))
    first, second = even(at)
    S = angles(DisplacedPair(at, first, second))
    lag, play = by_law(DisplacedPair(at, first, second), S)
    late = 0.01 * at.pitches[0]
    moved = replace(first, place=np.full(first.z, late)), replace(second, place=np.full(second.z, late * 60 / 8))
    turned, free = by_law(DisplacedPair(at, *moved), S + late)
    assert turned == pytest.approx(lag, abs=1e-9)
    assert free == pytest.approx(play, abs=1e-9)


def test_a_clock_with_circular_arc_teeth_is_cut_by_hand() -> None:
    train = geartrain.load("longcase-clock-bs978")
    found = run_trials(find_trial_plan(train, read_error_overrides(["placement=0.5 %", "eccentricity=2 %"])), 128, 1)
    assert found.train.events["stops"].value == 0
    # cut nearly true, pointers stray by the ripple of even teeth alone
    sure = run_trials(find_trial_plan(train, read_error_overrides(["placement=0.001 %"])), 512, 1)
    run = MotionRun(train.motion(), 0.5, 20_001)
    run.go()
    for one, other, ripple in zip(found.pointers, sure.pointers, run.tallies, strict=True):
        assert one.name == other.name == ripple.name
        assert other.errors.std() == pytest.approx(ripple.rms, rel=0.15)
        assert one.errors.std() > 2 * ripple.rms or not ripple.rms
    with pytest.raises(GearTrainError, match="declares no errors"):
        find_trial_plan(train)
