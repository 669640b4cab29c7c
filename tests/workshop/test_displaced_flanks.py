"""Conjugate teeth cut by hand: displaced flanks along the path of contact, against outlines drawn and turned."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial
from math import cos, pi, radians, sin
from typing import Any

import numpy as np
import pytest

import geartrain
from geartrain import GearTrainError
from geartrain.dynamics import MotionRun
from geartrain.teeth import CircularArc, Cycloidal, Involute, Lantern
from geartrain.teeth.conjugate.displaced_contact import displaced_contact
from geartrain.teeth.conjugate.off_design_transmission import pair_outlines
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.contact import GearOutline, OutlineCurve, ToothFlanks, TwoFlankContact, solve
from geartrain.teeth.contact.displaced_outlines import displaced_outlines
from geartrain.workshop import find_trial_plan, read_error_overrides, run_trials
from geartrain.workshop.cutting import DisplacedPair, DisplacedWheel, file_to_fit

INVOLUTE = Involute(form="involute", backlash="0.2")
PAIRS = {
    "involute": INVOLUTE.pair(WheelPair(24, 36)),
    "involute ring": INVOLUTE.pair(WheelPair(30, 75, True)),
    "cycloidal": Cycloidal(form="cycloidal", backlash="0.1").pair(WheelPair(8, 24)),
    "lantern": Lantern(form="lantern", backlash="0.1").pair(WheelPair(24, 8)),
}
ARC = CircularArc(form="circular_arc")
ARCS = {f"arcs {z1}/{z2}": (z1, z2) for z1, z2 in ((60, 8), (48, 12))}
BOTH = pytest.mark.parametrize(("name", "driver"), [(name, driver) for name in PAIRS for driver in (1, 2)])
DRAWN = pytest.mark.parametrize(
    ("name", "driver"),
    [("involute", 1), ("involute ring", 2), ("cycloidal", 2), ("lantern", 1)]
    + [(name, 1 + at % 2) for at, name in enumerate(ARCS)],
)
RNG = np.random.default_rng(20)


def even(contact: Any) -> tuple[DisplacedWheel, DisplacedWheel]:
    first, second = (DisplacedWheel.even(wheel.z) for wheel in contact.wheels)
    return first, second


def as_drawn(outline: GearOutline, wheel: DisplacedWheel) -> GearOutline:
    """The wheel as an outline: its teeth are numbered the way it turns, and angles are ahead."""
    order = (-np.arange(outline.z)) % outline.z
    drawn = replace(outline, turns=tuple((-wheel.place[order]).tolist()))
    e, towards = float(wheel.e), float(wheel.towards)
    return drawn.displaced(-e * sin(towards), e * cos(towards)) if e else drawn


@cache
def contact_of(name: str, driver: int) -> tuple[Any, tuple[GearOutline, GearOutline], float]:
    """The contact of a pair, its outlines with the driver first, and the centre distance."""
    if name in ARCS:
        gears = ARC.transmission(*ARCS[name], driver=driver).gears
        return displaced_outlines(gears, driver), gears.of(driver), gears.distance
    design = PAIRS[name]
    first, second = pair_outlines(design) if driver == 1 else pair_outlines(design)[::-1]
    distance = abs(design.path.pitch.R1 + design.path.pitch.R2)
    return displaced_contact(design, driver), (first, second), distance


def drawn_contact(name: str, driver: int, pair: DisplacedPair, S: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Lag and backlash of the drawn outlines, in driven pitches."""
    _, (one, two), distance = contact_of(name, driver)
    found = solve(as_drawn(one, pair.first), as_drawn(two, pair.second), distance + pair.shift, S)
    return off_ratio(pair.contact, found, S)


def off_ratio(at: Any, found: TwoFlankContact, S: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    pitch = at.pitches[1]
    return (float(at.ratio) * S + at.tooth_phase - found.front.angle) / pitch, found.backlash / pitch


def by_transmission(pair: DisplacedPair, S: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    rows = np.zeros(len(S), int)
    lag, lead = pair.minimum_lag(rows, S)[0], pair.minimum_lag(rows, S, back=True)[0]
    return lag / pair.contact.pitches[1], (lag + lead + pair.contact.backlash) / pair.contact.pitches[1]


def angles(pair: DisplacedPair, number: int = 60) -> np.ndarray:
    return RNG.uniform(0, pair.count * pair.contact.pitches[0], number)


@BOTH
def test_wheels_without_errors_keep_their_ratio_and_their_backlash(name: str, driver: int) -> None:
    at = displaced_contact(PAIRS[name], driver)
    pair = DisplacedPair(at, *even(at))
    lag, backlash = by_transmission(pair, angles(pair))
    assert lag == pytest.approx(0.0, abs=1e-13)
    assert backlash == pytest.approx(at.backlash / at.pitches[1], abs=1e-13)
    assert pair.backlash() == pytest.approx(at.backlash, abs=1e-13)


@pytest.mark.parametrize(("name", "driver"), [(name, driver) for name in (*PAIRS, *ARCS) for driver in (1, 2)])
def test_teeth_out_of_place_turn_the_driven_wheel_as_their_outlines_do(name: str, driver: int) -> None:
    # exact at any size: a tooth turned about the axis is the same tooth, and corners obey the law of cosines
    at = contact_of(name, driver)[0]
    wheels = (replace(each, place=RNG.normal(0, 0.005 * 2 * pi / each.z, each.z)) for each in even(at))
    pair = DisplacedPair(at, *wheels)
    S = angles(pair)
    for found, drawn in zip(by_transmission(pair, S), drawn_contact(name, driver, pair, S), strict=True):
        assert np.ptp(drawn) > 0.005
        assert found == pytest.approx(drawn, abs=3e-6 if name in ARCS else 2e-5)


@DRAWN
@pytest.mark.parametrize("which", [0, 1, "axles"])
def test_an_eccentric_wheel_and_axles_apart_are_right_to_first_order(name: str, driver: int, which: int | str) -> None:
    at = contact_of(name, driver)[0]
    off = []
    for e in (0.02, 0.005):
        wheels = list(even(at))
        if isinstance(which, int):
            wheels[which] = replace(wheels[which], e=np.array(e), towards=np.array(0.7))
        pair = DisplacedPair(at, *wheels, 0.0 if isinstance(which, int) else e)
        S = np.random.default_rng(3).uniform(0, pair.count * at.pitches[0], 24)
        (lag, backlash), (drawn, drawn_backlash) = by_transmission(pair, S), drawn_contact(name, driver, pair, S)
        off.append((np.median(np.abs(lag - drawn)), np.median(np.abs(backlash - drawn_backlash))))
        # of an error of some 0.02/6 pitches
        assert np.abs(lag - drawn).max() < 0.002 * e / 0.02
    for large, small in zip(*off, strict=True):
        # four times less, sixteen times nearer; the ends of the path make it less even
        assert small < large / 6 + (1e-6 if name in ARCS else 1e-12)


def test_axles_farther_apart_give_an_external_pair_backlash_and_take_it_from_a_ring() -> None:
    for name, sign in (("involute", 1), ("involute ring", -1)):
        at = displaced_contact(PAIRS[name], 1)
        driven = at.wheels[1].z / 2
        pair = DisplacedPair(at, *even(at), 0.01)
        # 2 tan psi of the distance, over the pitch radius
        assert pair.backlash() - at.backlash == pytest.approx(sign * 2 * 0.01 * np.tan(radians(20)) / driven, rel=1e-9)


@pytest.mark.parametrize(("name", "driver"), [(name, driver) for name in ("involute", *ARCS) for driver in (1, 2)])
@pytest.mark.parametrize("gear", [0, 1])
def test_flanks_that_lean_touch_as_their_outlines_do(name: str, driver: int, gear: int) -> None:
    at, drawn, distance = contact_of(name, driver)
    off = []
    for lean in (0.01, 0.0025):
        wheels, turned = list(even(at)), list(drawn)
        flank = np.full(wheels[gear].z, lean)
        wheels[gear] = replace(wheels[gear], leading=flank, trailing=flank)
        tooth, R = drawn[gear].teeth[0], drawn[gear].z / 2
        sides = [tilted(side, R, lean, way) for side, way in ((tooth.ahead, 1), (tooth.behind, -1))]
        turned[gear] = replace(drawn[gear], teeth=(ToothFlanks(*sides),))
        S = np.random.default_rng(3).uniform(0, at.pitches[0], 40)
        found, true = by_transmission(DisplacedPair(at, *wheels), S), off_ratio(at, solve(*turned, distance, S), S)
        assert np.ptp(true[0]) > lean / 10 or name in ARCS
        off.append([np.median(np.abs(one - other)) for one, other in zip(found, true, strict=True)])
    assert all(small < large / 6 + 2e-7 for large, small in zip(*off, strict=True))


def tilted(side: tuple[OutlineCurve, ...], R: float, lean: float, way: int) -> tuple[OutlineCurve, ...]:
    """A side of a tooth turned about its point on the pitch circle: above it material goes."""
    points = np.concatenate([curve.at(np.linspace(curve.start, curve.end, 4001)) for curve in side])
    pivot = points[np.abs(np.hypot(*points.T) - R).argmin()]
    turn = np.array([[cos(lean * way), sin(lean * way)], [-sin(lean * way), cos(lean * way)]])
    return tuple(curve.mapped(lambda p: (p - pivot) @ turn + pivot) for curve in side)


# ------------------------------------------------------------------------------------------------------------- bevels


def on_sphere(pair: object, gear: int, moved: np.ndarray) -> GearOutline:
    """A bevel wheel on the unit sphere, tooth by tooth, its teeth turned as one by a small rotation off its axis."""
    path = pair.path  # type: ignore[attr-defined]
    pitch, (approach, recess) = path.pitch, path.arcs
    R = -pitch.R1 if gear == 1 else pitch.R2
    axis, out = np.array([0.0, sin(R), cos(R)]), np.sign(R) * np.array([0.0, -cos(R), sin(R)])
    flank = partial(path.flank, gear)
    half = pair.halves[gear - 1] / (pitch.reach if gear == 1 else pitch.reach2)  # type: ignore[attr-defined]
    z = pitch.z1 if gear == 1 else pitch.z2

    def body(X: np.ndarray) -> np.ndarray:
        p = flank(X)
        return np.stack([p[:, 0], p @ out, p @ axis], axis=1)

    way = 1 if gear == 1 else -1
    side = tuple(OutlineCurve(body, *ends) for ends in ((-approach, -1e-300), (0.0, recess)))
    tooth = ToothFlanks.symmetric(side, -way * half)
    tooth = tooth if gear == 1 else ToothFlanks(tooth.behind, tooth.ahead)
    tooth = tooth.turned(way * half)
    teeth = tuple(tooth.turned(k * 2 * pi / z).mapped(lambda p: p @ moved.T).turned(-k * 2 * pi / z) for k in range(z))
    return GearOutline(teeth, z)


def tipped(e: float, towards: float) -> np.ndarray:
    """The rotation that moves a cone's axis by e towards an angle ahead of the first tooth."""
    to = np.array([-sin(towards), cos(towards), 0.0])
    axis = np.cross([0.0, 0.0, 1.0], to)
    K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    found: np.ndarray = np.eye(3) + sin(e) * K + (1 - cos(e)) * K @ K
    return found


@pytest.mark.parametrize("gear", [1, 2])
def test_bevel_wheels_off_their_axles_err_as_spheres_have_it(gear: int) -> None:
    design = INVOLUTE.pair(WheelPair(14, 23, shaft_angle=pi / 2))
    at = displaced_contact(design, 1)
    off = []
    for e in (2e-3, 5e-4):
        wheels = list(even(at))
        wheels[gear - 1] = replace(wheels[gear - 1], e=np.array(e), towards=np.array(0.7))
        pair = DisplacedPair(at, *wheels)
        S = np.random.default_rng(3).uniform(0, 7 * at.pitches[0], 30)
        outline = [on_sphere(design, each, tipped(e if each == gear else 0.0, 0.7)) for each in (1, 2)]
        lag, _ = off_ratio(at, solve(*outline, pi / 2, S), S)
        off.append(np.median(np.abs(by_transmission(pair, S)[0] - lag)))
        assert np.ptp(lag) > 0.2 * e
    assert off[1] < off[0] / 6


# -------------------------------------------------------------------------------------------------- batches and filing


def spread(at: Any, trials: int, sigma: float = 0.01) -> DisplacedPair:
    wheels = [
        replace(
            wheel,
            place=RNG.normal(0, sigma * 2 * pi / wheel.z, (trials, wheel.z)),
            e=np.abs(RNG.normal(0, 0.01, trials)),
            towards=RNG.uniform(0, 2 * pi, trials),
        )
        for wheel in even(at)
    ]
    return DisplacedPair(at, *wheels)


ERRORS = {
    "place": ("place",),
    "tips": ("tip",),
    "leaning": ("leading", "trailing"),
    "lowered": ("leading_low", "trailing_low"),
    "eccentric": ("e", "towards"),
}


@BOTH
@pytest.mark.parametrize("errors", ERRORS.values(), ids=ERRORS)
def test_each_error_is_in_the_minimum_backlash_as_it_is_angle_by_angle(
    name: str, driver: int, errors: tuple[str, ...]
) -> None:
    """Sums of terms of both wheels against sums over tooth pairs, at the angles at which backlash is evaluated."""
    at, rng = displaced_contact(PAIRS[name], driver), np.random.default_rng(8)
    wheels = []
    for wheel in even(at):
        size = {"place": 0.005 * at.pitches[0], "tip": 0.2, "e": 0.03, "towards": 3.0}
        shape = {"e": (2,), "towards": (2,)}
        drawn = {each: rng.normal(0, size.get(each, 0.01), shape.get(each, (2, wheel.z))) for each in errors}
        wheels.append(replace(wheel, **{each: -np.abs(v) if each == "tip" else v for each, v in drawn.items()}))
    pair, pitch = DisplacedPair(at, *wheels), at.pitches[0]
    within = np.mod([0, pitch / 4, pitch / 2, 3 * pitch / 4, at.start, at.end, -at.start, -at.end], pitch)
    S = (np.arange(pair.count)[:, None] * pitch + within).ravel()
    for trial, backlash in enumerate(pair.backlash()):
        rows = np.full(len(S), trial)
        apart = pair.minimum_lag(rows, S)[0] + pair.minimum_lag(rows, S, back=True)[0] + at.backlash
        assert backlash == pytest.approx(apart.min(), abs=1e-12)
    assert pair.tight_place().backlash == pytest.approx(pair.backlash(), abs=1e-14)


@BOTH
def test_a_pair_that_jams_is_filed_until_it_passes(name: str, driver: int) -> None:
    at = displaced_contact(PAIRS[name], driver)
    pair = spread(at, 12, 0.015)
    jams = pair.backlash() < 0
    assert jams.any()
    work = file_to_fit(pair, DisplacedPair.tight_place, 0.01, 0.4)
    assert ((work.strokes > 0) == jams).all()
    assert (work.pair.backlash() >= 0).all()
    assert (work.teeth[jams] >= 1).all()
    assert (work.strokes >= work.teeth).all()


def test_strokes_are_those_of_a_plain_loop_that_files_one_at_a_time() -> None:
    at = displaced_contact(PAIRS["involute"], 1)
    first, second = even(at)
    late = first.place.copy()
    late[5] = -0.1 * at.pitches[0]  # one tooth of the driver is a tenth of a pitch ahead
    pair = DisplacedPair(at, replace(first, place=late[None]), second)
    stroke, strokes, low = 0.01, 0, np.zeros((1, 24))
    while pair.backlash()[0] < 0:
        strokes += 1
        low[0, 5] += stroke
        pair = replace(pair, first=replace(pair.first, leading_low=low))
    jammed = DisplacedPair(at, replace(first, place=late[None]), second)
    found = file_to_fit(jammed, DisplacedPair.tight_place, stroke, 1.0)
    assert (found.strokes[0], found.teeth[0]) == (strokes, 1)
    # the protrusion minus the backlash, times the base radius of the driver
    assert strokes == np.ceil((0.1 * at.pitches[0] - 1.5 * at.backlash) * 12 * cos(radians(20)) / stroke)


def test_a_wheel_seen_from_behind_turns_the_other_way() -> None:
    """Tooth by tooth, and in mesh: what the driven wheel leads by on its back is what it lags by in the mirror."""
    at = displaced_contact(PAIRS["involute"], 1)
    names = ("place", "leading", "trailing", "leading_low", "trailing_low")
    off = {"e": np.array(0.05), "towards": np.array(RNG.uniform(0, 6))}
    first, second = (
        replace(each, **{name: RNG.normal(0, 0.002, each.z) for name in names}, **off) for each in even(at)
    )
    assert first.mirrored(5).tips == pytest.approx(first.tips[(5 - np.arange(first.z)) % first.z], abs=1e-15)
    pair, mirror = DisplacedPair(at, first, second), DisplacedPair(at, first.mirrored(), second.mirrored(1))
    S, rows = angles(pair), np.zeros(60, int)
    assert mirror.minimum_lag(rows, -S)[0] == pytest.approx(pair.minimum_lag(rows, S, back=True)[0], abs=1e-15)


@BOTH
def test_tips_meet_tips_where_the_lags_of_neighbours_say_so_tooth_pair_by_tooth_pair(name: str, driver: int) -> None:
    at, trials, random = displaced_contact(PAIRS[name], driver), 60, np.random.default_rng(1)
    for spread in (0.02, 0.05):
        wheels = (
            replace(each, place=random.normal(0, spread * 2 * pi / each.z, (trials, each.z))) for each in even(at)
        )
        pair = DisplacedPair(at, *wheels)
        found, rows = pair.verdicts(), np.arange(trials)
        for verdict, x, step in ((found.clash, at.start - at.entering.most, 1),
                                 (found.dwell, at.end + at.leaving.most, -1)):  # fmt: skip
            over = np.zeros(trials, bool)
            for n in range(pair.count):
                # the driver where the tips of tooth pair n meet, just within their reach
                S = n * at.pitches[0] + pair.first.place[:, n % pair.first.z] + x + step * 1e-9 * at.pitches[0]
                own, mate = (pair.lag(rows, S, np.full(trials, k)) for k in (n, n - step))
                over |= mate > own
            assert verdict.tolist() == over.tolist()


# --------------------------------------------------------------------------------------- circular-arc teeth cut by hand


ARC_PAIRS = pytest.mark.parametrize(("name", "driver"), [(name, driver) for name in ARCS for driver in (1, 2)])


@ARC_PAIRS
def test_arcs_without_errors_turn_as_their_transmission_says(name: str, driver: int) -> None:
    at, transmission = contact_of(name, driver)[0], ARC.transmission(*ARCS[name], driver=driver)
    pair = DisplacedPair(at, *even(at))
    S = angles(pair, 40)
    lag, backlash = by_transmission(pair, S)
    assert lag * at.pitches[1] == pytest.approx(-transmission.error(S), abs=1e-6 * at.pitches[1])
    back = transmission.reversed_motion().error(S)
    assert backlash * at.pitches[1] == pytest.approx(back - transmission.error(S), abs=1e-6 * at.pitches[1])
    assert pair.backlash() == pytest.approx(transmission.verdict.backlash, rel=1e-3)
    verdicts = pair.verdicts()
    assert not (verdicts.clash | verdicts.dwell | verdicts.disengaged).any()


@ARC_PAIRS
def test_contact_does_not_jump_where_round_tips_stand_still(name: str, driver: int) -> None:
    """The radius of a round tip has no slope at its end; what a slope of rounding says there must not count."""
    at, (one, two), distance = contact_of(name, driver)
    S = np.linspace(0, two.z * one.pitch, 2001)
    turned = solve(one, two.displaced(-0.02 * np.sin(0.7), 0.02 * np.cos(0.7)), distance, S).front.angle
    assert np.diff(turned) == pytest.approx(float(at.ratio) * np.diff(S), rel=1.0)


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
    at, wheels_drawn, distance = contact_of("arcs 60/8", 1)
    low = 0.003
    wheels, turned = list(even(at)), list(wheels_drawn)
    wheels[gear] = wheels[gear].filed(np.full(wheels[gear].z, low), np.full(wheels[gear].z, low))
    tooth = wheels_drawn[gear].teeth[0]
    filed = ToothFlanks(lowered(tooth.ahead, low, 1), lowered(tooth.behind, low, -1))
    turned[gear] = replace(wheels_drawn[gear], teeth=(filed,))
    S = np.linspace(0, at.pitches[0], 37)
    nominal, found = (by_transmission(DisplacedPair(at, *each), S) for each in (even(at), wheels))
    true = off_ratio(at, solve(turned[0], turned[1], distance, S), S)
    for one, other, before in zip(found, true, nominal, strict=True):
        assert np.median(np.abs(other - before)) > 5e-4
        assert np.median(np.abs(one - other)) < 0.02 * np.median(np.abs(other - before))


@pytest.mark.parametrize("counts", [(48, 12), (40, 40)])
def test_the_minimum_backlash_is_that_of_all_angles_and_below_nothing_the_outlines_overlap(
    counts: tuple[int, int],
) -> None:
    gears = ARC.transmission(*counts).gears
    at = displaced_outlines(gears, 1)
    random = np.random.default_rng(5)
    jams = 0
    for size in (0.005, 0.02, 0.02):
        wheels = [replace(each, place=random.normal(0, size * 2 * pi / each.z, each.z)) for each in even(at)]
        wheels[0] = replace(wheels[0], e=np.array(0.02), towards=np.array(1.0))
        pair = DisplacedPair(at, *wheels)
        S = np.linspace(0, pair.count * at.pitches[0], 60 * pair.count, endpoint=False)
        backlash = by_transmission(pair, S)[1] * at.pitches[1]
        assert float(pair.backlash()) == pytest.approx(backlash.min(), abs=5e-4 * at.pitches[1])
        tight = S[np.argsort(backlash)[:5]]
        one, two = as_drawn(gears.first, pair.first), as_drawn(gears.second, pair.second)
        true = solve(one, two, gears.distance, tight).backlash
        assert true == pytest.approx(np.sort(backlash)[:5], abs=5e-4 * at.pitches[1])
        jams += bool(pair.backlash() < 0)
    assert counts == (48, 12) or jams


def test_a_clock_with_circular_arc_teeth_is_cut_by_hand() -> None:
    train = geartrain.load("longcase-clock-bs978")
    errors = [["pitch_deviation=0.5 %", "eccentricity=2 %"], ["pitch_deviation=0.001 %"]]
    rough, fine = (find_trial_plan(train, read_error_overrides(each)) for each in errors)
    # with negligible errors, pointers deviate only by the ripple of perfect teeth
    found, sure = run_trials(rough, 128, 1), run_trials(fine, 512, 1)
    assert found.train.events["stops"].value == 0
    run = MotionRun(train.motion(), 0.5, 20_001)
    run.run()
    for one, other, ripple in zip(found.pointers, sure.pointers, run.statistics, strict=True):
        assert one.name == other.name == ripple.name
        assert other.errors.std() == pytest.approx(ripple.rms, rel=0.15)
        assert one.errors.std() > 2 * ripple.rms or not ripple.rms
    with pytest.raises(GearTrainError, match="declares no manufacturing errors"):
        find_trial_plan(train)
