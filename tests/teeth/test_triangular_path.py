"""The real path against every couple at 50 digits, the verdicts against a scan and against overlapping outlines."""

from __future__ import annotations

from math import inf, pi, radians
from random import Random
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest
from polygons import Judge
from sorge import Pair, Segment, drawn, entry_margin, exit_margin, first_of_all, minimum_backlash, mp, verdict

from geartrain.teeth.triangular import TriangularSizes, TriangularTransmission, equal_depth, find_window, pitch_true

THIRTY = radians(30)
TABLE = [
    (45, 225, 1.00269, 1.0153, "dwell", 1.0196),
    (64, 38, 1.00404, 1.0433, "clash", 1.0498),
    (48, 24, 1.00809, 1.0518, "clash", 1.0685),
    (127, 32, 1.00495, 1.0237, "clash", 1.0327),
    (48, 96, 1.00271, 1.0313, "dwell", 1.0360),
    (15, 60, 1.01475, 1.0313, "dwell", 1.0660),
    (57, 15, 1.01494, 1.0329, "clash", 1.0685),
    (20, 60, 1.01031, 1.0390, "dwell", 1.0622),
    (17, 140, 1.00914, 1.0150, "dwell", 1.0331),
    (96, 96, 1.00080, 1.0268, "dwell", 1.0273),
]


def equally_deep(z1: int, z2: int, beta: float = THIRTY, excess: float = 0.0) -> TriangularSizes:
    return TriangularSizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, excess)


def kind_of(sizes: TriangularSizes) -> str:
    """The kind of the verdict."""
    return TriangularTransmission(sizes).verdict.kind


def leans(sizes: TriangularSizes) -> bool:
    """Whether a flank leans beyond the perpendicular where tips meet."""
    return max(sizes.beta1, sizes.beta2) + sizes.reach1 + sizes.reach2 > pi / 2


def few_teeth(random: Random, most: int = 12) -> TriangularSizes:
    """Few teeth, any apertures, and radii up to a third from pitch-true."""
    while True:
        z1, z2 = random.randint(3, most), random.randint(3, most)
        beta1, beta2 = (radians(random.uniform(1, 0.999 * (90 - 180 / z))) for z in (z1, z2))
        rules = [equal_depth(z1, z2, beta1, beta2), pitch_true(z1, z2), (1.0, z2 / z1 * random.uniform(0.7, 1.4))]
        radii = random.choice(rules)
        sizes = TriangularSizes(z1, z2, *radii, beta1, beta2, 0.0)
        return sizes.at(sizes.maximum_excess * random.uniform(0.001, 0.999))


def aligned(path: list[Segment], intervals: tuple[Any, ...]) -> list[Segment]:
    """The reference's segments in the order of the intervals: both begin anywhere in the pitch."""
    assert len(path) == len(intervals), (path, intervals)
    for at in range(len(path)):
        turned = path[at:] + path[:at]
        if all(
            one.phase == other.phase and abs(float(one.end) - other.end) < 1e-3 * abs(float(one.start - one.end)) + 1e-9
            for one, other in zip(turned, intervals, strict=True)
        ):
            return turned
    raise AssertionError((path, intervals))


CASES = [
    pytest.param(1e3, 40, 1e-12),
    pytest.param(1e6, 12, 1e-10),
    pytest.param(1e3, 4000, 1e-12, marks=pytest.mark.long),
    pytest.param(1e6, 1000, 1e-10, marks=pytest.mark.long),
]


@pytest.mark.parametrize(("most", "number", "of_jumps"), CASES)
def test_switches_and_jumps_at_50_digits(most: float, number: int, of_jumps: float) -> None:
    """A switch is conditioned by the couple farther from the line of centres, and by how much the speed changes.

    After a standstill, where one couple is met at rest, twice as much is allowed: 1.3 times as much was seen.
    """
    random = Random(11)
    while number:
        sizes = TriangularSizes(*drawn(random, most, "near"))
        if leans(sizes):
            continue
        number -= 1
        pair, transmission = Pair.of(sizes), TriangularTransmission(sizes)
        path = aligned(pair.path, transmission.intervals)
        jumps = {jump.alpha1: jump.value for jump in transmission.jumps}
        left = float((pair.R1 + pair.R2 - pair.D) / pair.h)
        for at, (true, interval) in enumerate(zip(path, transmission.intervals, strict=True)):
            assert (interval.held is None) == (true.held is None)
            if true.held is not None:
                assert abs(interval.held - true.held) < 1e-12 * pair.p2
                continue
            last = path[at - 1]
            before = mp.mpf(0) if last.held is not None else pair.speed(last.end, last.phase)
            jump = 1 - before / pair.speed(true.start, true.phase)
            far = max(abs(true.start), abs(last.end)) / pair.p1
            share = 1e-15 if last.held is None else 2e-15
            allowed = max(1e-13, share * float(far / abs(jump)) / min(1, 100 * left))
            assert abs(interval.start - true.start) <= allowed * pair.p1, (sizes, float(jump))
            assert abs(jumps[interval.start] - jump) <= of_jumps, (sizes, float(jump))


@pytest.mark.parametrize("number", [pytest.param(90), pytest.param(8000, marks=pytest.mark.long)])
@pytest.mark.parametrize("teeth", ["few", "any"])
def test_the_lowest_tooth_pair_is_the_lowest_of_all(teeth: str, number: int) -> None:
    """Found among the ends and the bottom of each piece; told by a scan of every couple."""
    random = Random(12)
    for _ in range(number):
        sizes = few_teeth(random) if teeth == "few" else TriangularSizes(*drawn(random, 300))
        pair, path = Pair.of(sizes, np), TriangularTransmission(sizes).contact.path
        t = (np.arange(24) + 0.37) / 24 * pair.p1
        true = first_of_all(pair, t)
        lowest = np.array([path.lowest(float(at)) for at in t]) + pair.ratio * t
        envelope = np.full(len(t), inf)
        for interval in path.envelope:
            x = interval.start - np.mod(interval.start - t, pair.p1)
            inside = x >= interval.end
            y = [path.tooth_pair.angle(interval.phase, float(at)) for at in x[inside]]
            envelope[inside] = np.minimum(envelope[inside], y - np.round((x - t) / pair.p1)[inside] * pair.p2)
        for found in (lowest, envelope):
            assert (np.isfinite(found) == np.isfinite(true)).all(), sizes
            there = np.isfinite(true)
            assert np.abs(found[there] - true[there]).max(initial=0) < 1e-10 * pair.p2, sizes


def test_the_work_does_not_grow_with_the_number_of_tooth_pairs() -> None:
    """A law needs about as many angles with a thousand couples in reach as with three."""
    counts, reaches = [], []
    kind = type(TriangularTransmission(equally_deep(50, 150, THIRTY, 0.004)).contact.path.tooth_pair)
    for z in (50, 1000, 10**5, 10**6):
        with patch.object(kind, "angle", autospec=True, side_effect=kind.angle) as angle:
            transmission = TriangularTransmission(equally_deep(z, 3 * z, THIRTY, 0.2 / z), 0.2)
            assert transmission.verdict.kind in ("runs", "jam")
            counts.append(angle.call_count)
        reaches.append(transmission.sizes.reach1 / transmission.sizes.p1)
    assert reaches[-1] > 100 * reaches[0]
    assert max(counts) < 3 * min(counts) < 3000, counts


@pytest.mark.parametrize("number", [pytest.param(60), pytest.param(2000, marks=pytest.mark.long)])
def test_a_pair_that_runs_is_right_where_flanks_lean_too(number: int) -> None:
    """Few deep teeth, whose flanks reach beyond the meeting of the tip circles."""
    random, positions = Random(14), np.random.default_rng(14)
    while number:
        sizes = few_teeth(random, 30)
        if not leans(sizes) or kind_of(sizes) != "runs":
            continue
        number -= 1
        path = TriangularTransmission(sizes).contact.path
        t = positions.uniform(0, sizes.p1, 100)
        upper = np.array([path.lowest(float(at)) for at in t]) + sizes.ratio * t
        lower = -np.array([path.lowest(float(-at)) for at in t]) + sizes.ratio * t - sizes.p2
        y = positions.uniform(lower - 0.1 * sizes.p2, upper + 0.1 * sizes.p2)
        y = np.where(positions.random(100) < 0.5, np.maximum(y, upper - 0.02 * sizes.p2), y)
        shifted = y + np.floor((upper - y) / sizes.p2) * sizes.p2
        sure = np.minimum(np.abs(shifted - lower), upper - shifted) > 1e-9 * sizes.p2
        assert (Judge.of(sizes).overlap(t, y) != (shifted >= lower))[sure].all(), sizes


@pytest.mark.parametrize("number", [pytest.param(90), pytest.param(6000, marks=pytest.mark.long)])
def test_verdicts_are_those_of_a_scan(number: int) -> None:
    random = Random(15)
    kinds: dict[str, int] = {}
    while number:
        sizes = few_teeth(random, 40) if number % 2 else TriangularSizes(*drawn(random, 200, "near"))
        if leans(sizes):
            continue
        number -= 1
        true = verdict(Pair.of(sizes, np))
        if true:
            assert kind_of(sizes) == true, sizes
            kinds[true] = kinds.get(true, 0) + 1
    assert min(kinds.get(kind, 0) for kind in ("runs", "jam", "clash", "dwell")) >= 5, kinds


@pytest.mark.parametrize("number", [pytest.param(40), pytest.param(3000, marks=pytest.mark.long)])
def test_the_backlash_is_that_of_a_scan(number: int) -> None:
    random = Random(16)
    while number:
        sizes = TriangularSizes(*drawn(random, 200, "near"))
        contact = TriangularTransmission(sizes).contact
        if leans(sizes) or contact.verdict.kind not in ("runs", "jam") or contact.dragged.clash:
            continue
        number -= 1
        assert contact.backlash == pytest.approx(minimum_backlash(Pair.of(sizes, np)), abs=1e-9 * sizes.p2), sizes


def test_the_angle_lost_is_the_step_up_of_the_first_tooth_pair() -> None:
    random, number = Random(17), 30
    while number:
        sizes = TriangularSizes(*drawn(random, 200, "near"))
        contact = TriangularTransmission(sizes).contact
        if leans(sizes) or contact.verdict.kind != "dwell" or contact.dragged.arrested:
            continue
        number -= 1
        pair = Pair.of(sizes)
        held = [segment for segment in pair.path if segment.held is not None]
        idle = sum(segment.start - segment.end for segment in held)
        assert contact.idle == pytest.approx(float(idle), rel=1e-9, abs=1e-9 * sizes.p1)
        step = -exit_margin(Pair.of(sizes, np))
        if len(held) == 1 and step < inf:
            assert contact.lost == pytest.approx(step, abs=1e-9 * sizes.p2), sizes


def test_overhang_is_a_path_that_uses_a_leaning_flank_at_its_end() -> None:
    random, number = Random(18), 35
    kinds = set()
    while number:
        sizes = few_teeth(random, 30)
        pair = Pair.of(sizes)
        if not leans(sizes) or pair.R1 * mp.sin(pair.b1) + pair.R2 >= pair.D:
            continue
        number -= 1
        over1, over2 = (beta + pair.tips > mp.pi / 2 for beta in (pair.b1, pair.b2))
        used = [segment for segment in pair.path if segment.held is None]
        true = any(
            (over1 and abs(s.start - pair.entry) < 1e-6 * pair.p1)
            or (over2 and abs(s.end - pair.exit) < 1e-6 * pair.p1)
            for s in used
        )
        kind = kind_of(sizes)
        assert (kind == "overhang") == true, sizes
        kinds.add(kind)
    assert {"overhang", "runs"} <= kinds


@pytest.mark.parametrize("z", [3, 4, 5, 18, 1000])
def test_teeth_without_a_valley_are_refused(z: int) -> None:
    most = pi / 2 - pi / z
    for beta, kind in ((most * (1 + 1e-12), "no valley"), (min(most * 1.1, 1.57), "no valley")):
        assert kind_of(TriangularSizes(z, 3 * z, 1.0, 3.0, beta, 0.5, 1e-6)) == kind
        assert kind_of(TriangularSizes(3 * z, z, 3.0, 1.0, 0.5, beta, 1e-6)) == kind
    assert kind_of(TriangularSizes(z, 3 * z, 1.0, 3.0, most * 0.98, 0.5, 1e-6)) != "no valley"


def test_beyond_the_reach_the_wheels_are_apart() -> None:
    random = Random(19)
    for _ in range(50):
        sizes = TriangularSizes(*drawn(random, 1e4))
        beyond = sizes.at(sizes.maximum_excess * (1 + 1e-9))
        assert not Pair.of(beyond).touches
        assert kind_of(beyond) == "apart"
        assert Pair.of(sizes).touches


def bisected(margin: Any, sizes: TriangularSizes, low: float, high: float) -> float:
    """Where a margin of the scan first changes its sign."""

    def positive(excess: float) -> bool:
        return bool(margin(Pair.of(sizes.at(excess), np)) > 0)

    at_low, step = positive(low), (high - low) / 60
    while positive(low + step) == at_low:
        low += step
        assert low < high
    high = low + step
    for _ in range(28):  # 1e-9 of the first step and less
        middle = (low + high) / 2
        low, high = (middle, high) if positive(middle) == at_low else (low, middle)
    return (low + high) / 2


@pytest.mark.parametrize(("z1", "z2", "jam", "run", "kind", "reach"), TABLE)
def test_windows_of_ancient_pairs(z1: int, z2: int, jam: float, run: float, kind: str, reach: float) -> None:
    sizes = equally_deep(z1, z2)
    window = find_window(sizes)
    assert (round(1 + window.jam, 5), round(1 + window.run, 4), round(1 + window.reach, 4)) == (jam, run, reach)
    assert window.run_kind == kind
    assert window.reach == pytest.approx(float(Pair.of(sizes).h / Pair.of(sizes).minimum), rel=1e-14)
    assert window.jam == pytest.approx(bisected(minimum_backlash, sizes, 1e-6, window.reach / 2), abs=1e-9)
    margin = entry_margin if kind == "clash" else exit_margin
    assert window.run == pytest.approx(bisected(margin, sizes, window.jam, window.reach * 0.9999), abs=1e-9)


def test_no_clearance_works_for_8_and_64() -> None:
    window = find_window(equally_deep(8, 64))
    assert not window
    assert (round(window.jam, 4), round(window.run, 4)) == (0.0278, 0.0009)
    for share in np.linspace(0.001, 0.999, 200):
        assert kind_of(equally_deep(8, 64, THIRTY, window.reach * float(share))) != "runs"


def test_15_to_53_and_45_to_225_share_hardly_any_clearance() -> None:
    one, other = find_window(equally_deep(15, 53)), find_window(equally_deep(45, 225))
    assert round(max(one.jam, other.jam), 5) == 0.01518
    assert round(min(one.run, other.run), 5) == 0.01526


def kinds_over_the_reach(sizes: TriangularSizes, steps: int = 40) -> list[tuple[float, str]]:
    reach = sizes.maximum_excess
    shares = (np.arange(steps) + 0.5) / steps
    return [(float(share * reach), kind_of(sizes.at(float(share * reach)))) for share in shares]


def agree(sizes: TriangularSizes, steps: int = 40) -> bool:
    """Whether a pair runs at just the clearances within its window."""
    window = find_window(sizes)
    found = kinds_over_the_reach(sizes, steps)
    return all((kind == "runs") == (window.jam < excess < window.run) for excess, kind in found)


@pytest.mark.parametrize("number", [pytest.param(15), pytest.param(150, marks=pytest.mark.long)])
def test_equally_deep_teeth_of_ancient_shape_run_just_within_their_window(number: int) -> None:
    random = Random(20)
    for _ in range(number):
        sizes = equally_deep(random.randint(12, 250), random.randint(12, 250), radians(random.uniform(20, 40)))
        assert agree(sizes), sizes


NEVER_JAM = [(12, 22, 60.0), (161, 161, 44.6), (20, 20, 70.0)]
CLASH_OR_OVERHANG = [(26, 7, 18.76), (86, 3, 23.2), (20, 5, 47.9), (9, 8, 5.27)]


@pytest.mark.parametrize(("z1", "z2", "beta"), [*NEVER_JAM, *CLASH_OR_OVERHANG])
def test_odd_teeth_run_just_within_their_window(z1: int, z2: int, beta: float) -> None:
    sizes = equally_deep(z1, z2, radians(beta))
    if (z1, z2, beta) in NEVER_JAM:
        assert minimum_backlash(Pair.of(sizes.at(sizes.maximum_excess * 1e-6), np)) > 0
    assert agree(sizes)


@pytest.mark.parametrize(("z1", "z2", "beta"), [(25, 7, 11.7418), (25, 8, 9.4915)])
def test_some_pairs_run_in_two_stretches_of_clearance(z1: int, z2: int, beta: float) -> None:
    """The window is the first of them."""
    sizes = TriangularSizes(z1, z2, *pitch_true(z1, z2), radians(beta), radians(beta), 0.0)
    window = find_window(sizes)
    seen = []
    for excess, kind in kinds_over_the_reach(sizes, 80):
        assert kind == "runs" or not window.jam < excess < window.run
        if not leans(sizes.at(excess)):
            assert kind == (verdict(Pair.of(sizes.at(excess), np)) or kind)
        if not seen or seen[-1] != kind:
            seen.append(kind)
    assert seen[-5:] == ["jam", "runs", "dwell", "runs", "dwell"]


def test_a_pair_that_clashes_before_it_runs_has_a_window() -> None:
    sizes = TriangularSizes(6, 12, *pitch_true(6, 12), 0.08579023490328726, 0.08579023490328726, 0.0)
    runs = [excess for excess, kind in kinds_over_the_reach(sizes) if kind == "runs"]
    assert runs
    assert find_window(sizes)
