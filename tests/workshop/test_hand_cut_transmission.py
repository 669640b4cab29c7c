"""Transmission function of one pair of cut wheels, the oracle of trials: without errors, and against outlines."""

from __future__ import annotations

from math import inf, lcm, pi, radians
from typing import Literal

import numpy as np
import pytest
from polygons import Judge, Outline
from studies.cut_pair_transmission import CutPairLaw, leans
from studies.cutting_errors import CuttingErrorModel, ErrorDistribution, with_errors

from geartrain import load
from geartrain.errors import RangeError
from geartrain.teeth.triangular.clearance_window import find_window
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission
from geartrain.workshop.cutting import CutGearPair, CutWheel, batch_verdicts, jamming_bound, nominal_backlash

THIRTY = radians(30)


def equally_deep(z1: int, z2: int, excess: float, beta: float = THIRTY) -> TriangularSizes:
    return TriangularSizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, excess)


def with_ring(z1: int, z2: int, ring: Literal[0, 1, 2], beta: float = THIRTY) -> TriangularSizes:
    """Equal depth outside; with a ring of z1 + z2 teeth pitch-true."""
    if not ring:
        return equally_deep(z1, z2, 0.0, beta)
    counts = (z1 + z2, z2) if ring == 1 else (z1, z1 + z2)
    return TriangularSizes(*counts, 1.0, counts[1] / counts[0], beta, beta, 0.0, ring)


def even(sizes: TriangularSizes) -> tuple[CutWheel, CutWheel]:
    R1, R2 = sizes.signed_radii
    return CutWheel.even(sizes.z1, R1, sizes.beta1), CutWheel.even(sizes.z2, R2, sizes.beta2)


# ------------------------------------------------------------------------------------------------------ without errors


@pytest.mark.parametrize(("z1", "z2", "excess"), [(16, 12, 0.02), (12, 60, 0.025), (24, 12, 0.09), (20, 15, 0.004)])
def test_without_errors_the_events_are_the_verdict_on_even_wheels(z1: int, z2: int, excess: float) -> None:
    sizes = equally_deep(z1, z2, excess)
    transmission, cut = TriangularTransmission(sizes), CutPairLaw.of(sizes, *even(sizes))
    kinds = {event.kind for event in cut.events.all}
    assert (transmission.verdict.kind in kinds) if transmission.verdict.kind != "runs" else not kinds
    assert cut.events.backlash == pytest.approx(transmission.verdict.backlash, abs=1e-12 * sizes.p2)
    assert cut.error_range() == pytest.approx(transmission.error_range(), abs=1e-12 * sizes.p2)
    assert cut.error_moments() == pytest.approx(transmission.error_moments(), abs=1e-12 * sizes.p2)
    assert cut.speed_range() == pytest.approx(transmission.speed_range(), rel=1e-9)
    if transmission.verdict.kind == "dwell":
        stills = cut.events.of("dwell")
        assert len(stills) == lcm(z1, z2)
        assert stills[0].amount == pytest.approx(transmission.contact.lost, rel=1e-9)
        assert sum(e.end - e.start for e in stills) / len(stills) == pytest.approx(transmission.contact.idle, rel=1e-9)


# ------------------------------------------------------------------------------------------------------------ outlines


def drawn(rng: np.random.Generator, ring: Literal[0, 1, 2] = 0) -> tuple[TriangularSizes, CutPairLaw, Judge]:
    """Two wheels with every kind of error, as a transmission function and as outlines."""
    while True:
        z1, z2 = (int(z) for z in rng.integers(10, 40, 2))
        b1, b2 = (float(b) for b in np.radians(rng.uniform(20, 38, 2)))
        if ring:
            z1, z2 = (z1 + z2, z2) if ring == 1 else (z1, z1 + z2)
            sizes = TriangularSizes(z1, z2, 1.0, rng.uniform(0.95, 1.02) ** (3 - 2 * ring) * z2 / z1, b1, b2, 0.0, ring)
        else:
            sizes = TriangularSizes(z1, z2, *equal_depth(z1, z2, b1, b2), b1, b2, 0.0)
        if not (window := find_window(sizes)):
            continue
        sizes = sizes.at(window.at(rng.uniform(-0.1, 1.0)))
        wheels, outlines, big = [], [], rng.uniform(0.2, 1.5)
        for wheel, high in zip(even(sizes), sizes.depths, strict=True):
            z = wheel.z
            place = big * 0.03 * wheel.pitch * rng.standard_normal(z)
            tip = big * 0.05 * high * rng.standard_normal(z)
            less, more = big * 0.05 * wheel.half_angle * rng.standard_normal((2, z))
            e, towards = big * 0.1 * high * rng.uniform(), rng.uniform(0, 2 * pi)
            try:
                wheels.append(with_errors(wheel, e, towards, place=place, tip=tip, leading=less, trailing=more))
            except RangeError:
                break
            theta, r = np.arange(z) * wheel.pitch + place, abs(wheel.radius + tip)
            b = wheel.half_angle
            outlines.append(Outline(theta, r, b + less, b + more, wheel.radius < 0).about(e, towards))
        shift = 0.02 * min(sizes.depths) * rng.standard_normal()
        try:
            transmission = CutPairLaw.of(sizes, *wheels, shift)
        except (RangeError, TypeError):
            continue
        return sizes, transmission, Judge(outlines[0], outlines[1], sizes.D + shift)


@pytest.mark.parametrize("ring", [0, 1, 2])
@pytest.mark.parametrize("number", [pytest.param(20), pytest.param(1000, marks=pytest.mark.long)])
def test_cut_wheels_touch_where_their_outlines_do(number: int, ring: Literal[0, 1, 2]) -> None:
    """First touch, by halving the driven angle, and jams, at ten positions of each of many pairs of wheels.

    Where teeth have only just come in, the search may step across one: then it must be there all the same.
    """
    rng, far, jammed, across = np.random.default_rng(4), 0.0, 0, 0
    for _ in range(number):
        sizes, transmission, judge = drawn(rng, ring)
        S = rng.uniform(0, transmission.period, 10)
        upper = -transmission.error(S) - sizes.ratio * S
        lower = upper - transmission.backlash(S)
        still = transmission.speed(S) == 0
        low, high = judge.free(-S, -sizes.ratio * S - sizes.p2 / 2, 0.75 * sizes.p2, 100)
        both = np.isfinite(upper) & np.isfinite(lower)
        jams = both & (lower > upper)
        jammed += int(jams.sum())
        # within a jam no driven angle is free
        inside = np.linspace(0, 1, 9)[1:-1]
        y = upper[jams, None] + (lower - upper)[jams, None] * inside
        assert judge.overlap(np.repeat(-S[jams], 7), y.ravel()).all()
        # elsewhere all are, between the touches
        free = both & (upper - lower > 1e-9 * sizes.p2)
        y = upper[free, None] + (lower - upper)[free, None] * inside
        assert not judge.overlap(np.repeat(-S[free], 7), y.ravel()).any()
        for found, bound, sign in ((high, upper, 1), (low, lower, -1)):
            # a driven wheel left standing is not in touch, and may be turned back
            some = free & np.isfinite(found) & np.isfinite(bound) & ~(still & (sign > 0))
            off = np.where(some, np.abs(found - bound), 0.0) / sizes.p2
            missed = some & (off > 1e-8)
            assert judge.overlap(-S[missed], bound[missed] + sign * 1e-7 * sizes.p2).all()
            across += int(missed.sum())
            far = max(far, float(off[some & ~missed].max(initial=0)))
    assert far < 1e-9
    assert jammed >= 0.02 * number * 10
    assert across <= 0.03 * number * 10


def out_of_place(sizes: TriangularSizes, places: list[np.ndarray]) -> CutPairLaw:
    return CutPairLaw.of(sizes, *(with_errors(w, place=p) for w, p in zip(even(sizes), places, strict=True)))


def outlines(sizes: TriangularSizes, places: list[np.ndarray]) -> Judge:
    """Two wheels of 30 degrees with teeth out of place."""
    wheels = zip(even(sizes), places, strict=True)
    made = (
        Outline(np.arange(w.z) * w.pitch + p, np.full(w.z, w.radius), *np.full((2, w.z), THIRTY)) for w, p in wheels
    )
    return Judge(*made, sizes.D)


def test_a_driven_wheel_that_is_dragged_follows_the_outlines() -> None:
    """The driven wheel is marched in small steps and never turned back: its dwell, its lag and its next contact."""
    sizes = equally_deep(20, 30, 0.0)
    sizes = sizes.at(find_window(sizes).at(0.85))
    rng = np.random.default_rng(6)
    places = [0.03 * 2 * pi / z * rng.standard_normal(z) for z in (20, 30)]
    transmission, judge = out_of_place(sizes, places), outlines(sizes, places)
    stills = transmission.events.of("dwell")
    assert stills
    still = max(stills, key=lambda event: event.end - event.start)
    S = np.linspace(still.start - 0.2 * sizes.p1, still.end + 0.2 * sizes.p1, 60)
    # the overlap of a leaving tooth pair is thin at the tips, so steps across it must be finer
    S = np.sort(np.append(S, still.start - 0.2 * sizes.p1 * 0.9 ** np.arange(230)))
    y = np.array([-float(transmission.angle(S[0]))]) - 1e-9 * sizes.p2
    for angle, q in zip(S[1:], transmission.angle(S[1:]), strict=True):
        t = np.array([-angle])
        if judge.overlap(t, y)[0]:
            low, high = y - 0.1 * sizes.p2, y
            for _ in range(40):
                middle = (low + high) / 2
                low, high = (low, middle) if judge.overlap(t, middle)[0] else (middle, high)
            y = low
        assert -y[0] == pytest.approx(q, abs=3e-9 * sizes.p2)


@pytest.mark.parametrize("number", [pytest.param(3), pytest.param(60, marks=pytest.mark.long)])
def test_after_a_clash_the_outlines_stick_fast_or_skip_a_tooth(number: int) -> None:
    """The outlines are turned on in small steps, the driven wheel dragging, and no step passes through a tooth.

    Soon the driven wheel is caught between the tooth that came in and the one before, although there is backlash. If it
    lags so far that the tooth that comes in passes its mate altogether, it is not pushed for most of a pitch.
    """
    rng, skipped, steps = np.random.default_rng(5), 0, 400
    for _ in range(number):
        while True:
            sizes = equally_deep(16, 12, 0.0)
            sizes = sizes.at(find_window(sizes).at(rng.uniform(0.3, 0.8)))
            places = [0.05 * 2 * pi / z * rng.standard_normal(z) for z in (16, 12)]
            transmission = out_of_place(sizes, places)
            events = transmission.events
            if events and {event.kind for event in events.all} == {"clash"} and events.backlash >= 0:
                break
        judge = outlines(sizes, places)
        clash = transmission.events.stop
        S = np.arange(clash.start - 0.05 * sizes.p1, clash.start + sizes.p1, sizes.p1 / steps)
        # no pair of teeth of these turns the driven wheel on as fast as 4 times the mean
        y, on = -float(transmission.angle(S[0])) - 1e-9, np.linspace(0, 4 * sizes.p2 / steps, 21)
        for angle in S[1:]:
            hit = judge.overlap(np.full(21, -angle), y - on)
            if hit.all():
                break
            y -= on[np.argmin(hit)]
        if hit.all():
            assert clash.start - 0.01 * sizes.p1 < angle < clash.start + 0.4 * sizes.p1
        else:
            skipped += 1
            assert clash.amount > 0.1 * sizes.p2
            assert float(transmission.angle(angle)) + y > 0.6 * sizes.p2  # behind the pushing flanks
    assert skipped <= 0.05 * number


# -------------------------------------------------------------------------------------------------------------- events


def test_a_tooth_broken_off_lets_the_wheels_lose_each_other() -> None:
    sizes = equally_deep(12, 18, 0.0)
    sizes = sizes.at(find_window(sizes).at(0.6))
    driver, driven = even(sizes)
    short = np.zeros(12)
    short[[4, 5]] = -0.9 * sizes.depths[0]
    events = CutPairLaw.of(sizes, with_errors(driver, tip=short), driven).events
    gaps = events.of("disengaged")
    assert len(gaps) >= lcm(12, 18) // 12
    assert events.of("dwell")
    assert all(event.amount == inf for event in gaps)
    assert batch_verdicts(sizes, with_errors(driver, tip=short[None]), driven).disengaged.all()


# ------------------------------------------------------------------------------------------------------------ refusals


def test_impossible_wheels_are_refused() -> None:
    sizes = equally_deep(16, 12, 0.03)
    driver, driven = even(sizes)
    wide = {"leading": 0.5, "trailing": 0.5}
    for make in (
        lambda: with_errors(driver, place=np.linspace(0, 7, 16)),
        lambda: with_errors(driver, leading=-0.6, trailing=-0.6),
        lambda: with_errors(driver, leading=1.0, trailing=1.0),
        lambda: with_errors(driver, tip=-2.0),
        lambda: load("longcase-clock-cycloidal").meshes[0].cut_sizes,
        lambda: CutPairLaw.of(sizes.at(0.001), with_errors(driver, **wide), with_errors(driven, **wide)),
    ):
        with pytest.raises(RangeError) as caught:
            make()
        assert all(problem.what and problem.fix for problem in caught.value.problems)


# -------------------------------------------------------------------------------------- many wheels cut by hand at once


def cut(
    sizes: TriangularSizes, rng: np.random.Generator, trials: int, cutting: CuttingErrorModel
) -> tuple[CutWheel, CutWheel]:
    driver, driven = (cutting.draw(wheel, rng, trials) for wheel in even(sizes))
    return driver, driven


EVERY = CuttingErrorModel(*map(ErrorDistribution, (0.02, 0.04, 0.03, 0.07)))
HALF = CuttingErrorModel(*map(ErrorDistribution, (0.01, 0.02, 0.015, 0.035)))
PLACES = CuttingErrorModel(ErrorDistribution(0.04))
BATCHES = [
    pytest.param(
        cutting, ring, id=f"{name}-{ring}", marks=pytest.mark.slow if (name, ring) != ("every error", 0) else ()
    )
    for name, cutting in (("every error", EVERY), ("places", PLACES))
    for ring in (0, 1, 2)
]


@pytest.mark.parametrize("number", [pytest.param(5), pytest.param(60, marks=pytest.mark.long)])
@pytest.mark.parametrize(("cutting", "ring"), BATCHES)
def test_a_batch_says_of_each_what_its_own_transmission_says(
    cutting: CuttingErrorModel, ring: Literal[0, 1, 2], number: int
) -> None:
    """Backlash, clash, dwell and loss of contact of random pairs, on both sides of their windows."""
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
            # a ring that jams by more than the depth of a tooth has no transmission function
            driver, driven = cut(sizes, rng, 4, HALF if ring and cutting is EVERY else cutting)
            found = batch_verdicts(sizes, driver, driven, shift)
        except RangeError:
            continue
        if leans(CutGearPair(sizes, driver, driven, shift)):
            continue
        done += 1
        for at in range(4):
            here = shift if np.ndim(shift) == 0 else float(shift[at])
            events = CutPairLaw.of(sizes, driver.taken(at), driven.taken(at), here).events
            if not (ring and found.disengaged[at]):  # without a tooth in reach the backlash is undefined
                near = (1e-6 if cutting is PLACES else 1e-8) * sizes.p2
                assert found.backlash[at] == pytest.approx(events.backlash, abs=near)
            assert found.disengaged[at] == bool(events.of("disengaged"))
            assert found.dwell[at] == bool(events.of("dwell"))
            assert found.stops[at] == (events.stop is not None)
            kinds += [found.jams[at], found.clash[at], found.dwell[at], not found.stops[at]]
    assert kinds.min() >= 1, kinds


def test_trials_do_not_know_each_other() -> None:
    """Results do not depend on chunks, nor on whether wheels are shared or copied."""
    sizes, rng = equally_deep(24, 15, 0.02), np.random.default_rng(2)
    driver, driven = cut(sizes, rng, 12, EVERY)
    whole = batch_verdicts(sizes, driver, driven)
    for parts in (batch_verdicts(sizes, driver, driven, chunk=1), batch_verdicts(sizes, driver, driven, chunk=300)):
        assert np.abs(parts.backlash - whole.backlash).max() < 1e-10 * sizes.p2
        assert (parts.stops == whole.stops).all()
    one = driven.taken(3)
    shared = batch_verdicts(sizes, driver, one)
    copied = batch_verdicts(sizes, driver, driven.taken(np.full(12, 3)))
    assert np.abs(shared.backlash - copied.backlash).max() < 1e-10 * sizes.p2


def test_places_alone_are_reckoned_in_another_way_with_the_same_result() -> None:
    """Negligible tip errors select the general computation for the same wheels."""
    rng = np.random.default_rng(3)
    for z1, z2, excess, sigma in ((64, 38, 0.02, 0.06), (24, 15, 0.02, 0.05), (15, 20, 0.03, 0.07)):
        sizes = equally_deep(z1, z2, excess)
        driver, driven = cut(sizes, rng, 12, CuttingErrorModel(ErrorDistribution(sigma)))
        placed = batch_verdicts(sizes, driver, driven)
        general = batch_verdicts(sizes, with_errors(driver, tip=1e-14), driven)
        assert np.abs(placed.backlash - general.backlash).max() < 1e-5 * sizes.p2
        for name in ("jams", "clash", "dwell", "disengaged"):
            assert (getattr(placed, name) == getattr(general, name)).all(), name


# ----------------------------------------------------------------------------------------------- printed figures


PRINTED = [
    *((64, 38, 0.01, 0.136), (64, 38, 0.03, 0.585), (48, 24, 0.02, 0.207), (127, 32, 0.01, 0.176)),
    *((45, 225, 0.01, 0.394), (64, 38, 0.02, 0.368)),
]


def test_the_nominal_backlash_of_the_table_and_the_ends_of_the_bound() -> None:
    for *counts, backlash in PRINTED:
        assert round(nominal_backlash(equally_deep(*counts)), 3) == backlash
    sizes = equally_deep(64, 38, 0.02)
    assert jamming_bound(sizes, 0.0) == 0.0
    assert jamming_bound(sizes, 1.0) == 1.0
    assert jamming_bound(sizes.at(0.001), 0.01) == 1.0


@pytest.mark.parametrize(
    ("z1", "z2", "excess", "sigma"),
    [(*row[:3], sigma) for row, sigma in zip(PRINTED, (0.015, 0.066, 0.028, 0.019, 0.048), strict=False)],
)
def test_the_bound_of_the_table_is_about_one_in_a_hundred(z1: int, z2: int, excess: float, sigma: float) -> None:
    sizes = equally_deep(z1, z2, excess)
    assert jamming_bound(sizes, sigma) == pytest.approx(0.0125, abs=0.0075)
    wheels = cut(sizes, np.random.default_rng(6), 300, CuttingErrorModel(ErrorDistribution(sigma)))
    assert batch_verdicts(sizes, *wheels).jams.mean() <= 0.02


def test_a_stroke_lowers_a_triangular_flank_by_itself_and_moves_the_tip_down_the_other() -> None:
    rng = np.random.default_rng(20)
    lean, place = rng.uniform(-0.05, 0.05, 16), rng.uniform(-0.02, 0.02, 16)
    wheel = with_errors(CutWheel.even(16, 10.0, 0.5), place=place, leading=lean, trailing=lean)
    leading, trailing = rng.uniform(0, 0.05, (2, 16))
    filed = wheel.filed(leading, trailing)

    def lines(each: CutWheel) -> list[tuple[np.ndarray, np.ndarray]]:
        """Distance of both flanks from the axis, and direction of their normals, positive ahead."""
        tip = each.r * np.exp(-1j * each.theta)
        ways = (each.half_angle + each.leading, 1j), (each.half_angle + each.trailing, -1j)
        normals = [tip / abs(tip) * side * np.exp(-side * lean) for lean, side in ways]
        return [((tip / normal).real, np.angle(normal)) for normal in normals]

    for (far, way), (then, turned), low in zip(lines(wheel), lines(filed), (leading, trailing), strict=True):
        assert turned == pytest.approx(way, abs=1e-14)
        assert far - then == pytest.approx(low, abs=1e-13)


def test_eccentric_wheels_jam_when_their_errors_use_up_the_clearance() -> None:
    """To first order, this is where e1 + e2 exceeds the distance above the minimum of the window."""
    sizes = equally_deep(64, 38, 0.02)
    room = (0.02 - find_window(sizes).jam) * sizes.deepest_distance
    share = np.array([0.6, 0.85, 1.15, 1.4])
    driver, driven = even(sizes)
    found = batch_verdicts(
        sizes, driver.moved(share * room / 2, 0.3), driven.moved(share * room / 2, np.linspace(0, 1, 4))
    )
    assert list(found.jams) == [False, False, True, True]


def test_wheels_whose_tips_do_not_meet_touch_nowhere_and_stop_nothing() -> None:
    """This includes the fast computation of pitch deviations, whose tables assume tooth pairs in contact."""
    sizes = TriangularSizes(45, 225, *equal_depth(45, 225, THIRTY, THIRTY), THIRTY, THIRTY, 0.0225)
    assert sizes.R1 + sizes.R2 < sizes.D
    driver, driven = cut(sizes, np.random.default_rng(5), 3, PLACES)
    found = batch_verdicts(sizes, driver, driven, 0.0)
    assert found.backlash.tolist() == [np.inf] * 3
    assert found.disengaged.all()
    assert not (found.stops | found.dwell).any()
