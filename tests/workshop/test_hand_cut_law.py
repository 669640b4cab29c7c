"""The law of one pair of cut wheels, an oracle for trials: even, off centre, to first order, and by outlines."""

from __future__ import annotations

from math import inf, lcm, pi, radians
from typing import Literal

import numpy as np
import pytest
from polygons import Judge, Outline
from studies.cut_pair_law import CutPairLaw

from geartrain import load
from geartrain.errors import RangeError
from geartrain.teeth.triangular.clearance_window import find_window
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission
from geartrain.workshop.cutting.cut_wheel import CutWheel

THIRTY = radians(30)
KINDS = ("place", "tip", "leading", "trailing")


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

EXACT = [(64, 38, 0.02), (48, 24, 0.02), (45, 225, 0.01), (45, 225, 0.0165), (64, 38, 0.046), (17, 19, 0.02)]


@pytest.mark.parametrize(("z1", "z2", "excess"), EXACT)
def test_without_errors_the_law_is_that_of_even_wheels(z1: int, z2: int, excess: float) -> None:
    sizes = equally_deep(z1, z2, excess)
    S = np.random.default_rng(1).uniform(-4 * pi, 4 * pi, 2000)
    for direction in (1, -1):
        law, cut = (
            TriangularTransmission(sizes, 0.0, direction),
            CutPairLaw.of(sizes, *even(sizes), direction=direction),
        )
        assert np.abs(cut.error(S) - law.error(S)).max() < 1e-14 * sizes.p2
        assert np.abs(cut.speed(S) - law.speed(S)).max() < 1e-13 * float(law.ratio)


@pytest.mark.parametrize(("z1", "z2", "excess"), [(16, 12, 0.02), (12, 60, 0.025), (24, 12, 0.09), (20, 15, 0.004)])
def test_without_errors_the_events_are_the_verdict_on_even_wheels(z1: int, z2: int, excess: float) -> None:
    sizes = equally_deep(z1, z2, excess)
    law, cut = TriangularTransmission(sizes), CutPairLaw.of(sizes, *even(sizes))
    kinds = {event.kind for event in cut.events.all}
    assert (law.verdict.kind in kinds) if law.verdict.kind != "runs" else not kinds
    assert cut.events.play == pytest.approx(law.verdict.play, abs=1e-12 * sizes.p2)
    assert cut.error_range() == pytest.approx(law.error_range(), abs=1e-12 * sizes.p2)
    assert cut.error_moments() == pytest.approx(law.error_moments(), abs=1e-12 * sizes.p2)
    assert cut.speed_range() == pytest.approx(law.speed_range(), rel=1e-9)
    if law.verdict.kind == "standstill":
        stills = cut.events.of("standstill")
        assert len(stills) == lcm(z1, z2)
        assert stills[0].amount == pytest.approx(law.contact.lost, rel=1e-9)
        assert sum(e.end - e.start for e in stills) / len(stills) == pytest.approx(law.contact.idle, rel=1e-9)


def test_the_law_is_one_of_a_mesh_of_a_train() -> None:
    mesh = load("sorge-pairs").meshes[0]
    sizes = mesh.cut_sizes
    law = CutPairLaw.of(sizes, *even(sizes))
    S = np.linspace(0, law.period, 500)
    assert law.period == pytest.approx(2 * pi * lcm(sizes.z1, sizes.z2) / sizes.z1, rel=1e-15)
    assert np.abs(law.error(S) - mesh.law.error(S)).max() < 1e-14 * sizes.p2 + 1e-15 * law.period
    shaped = S.reshape(5, 4, 25)
    for what in (law.error, law.speed, law.play):
        assert what(shaped).shape == shaped.shape
        assert what(shaped)[2, 3, 7] == what(float(shaped[2, 3, 7]))


# --------------------------------------------------------------------------------------------------------- off centre


def seen_from_the_centres(sizes: TriangularSizes, t: float, e: tuple[float, float], k: tuple[float, float]) -> float:
    """The driver's lag at t by the law of even wheels, at the distance and on the line of their own centres."""
    y = 0.0
    for _ in range(200):
        one = e[0] * np.exp(1j * (t + k[0]))
        two = sizes.D - e[1] * np.exp(-1j * (y + k[1]))
        line = two - one
        D, turned = abs(line), np.angle(line)
        here = sizes.at(D / sizes.deepest_distance - 1)
        x = t - turned
        # the driven wheel's own angle is counted from the line the other way round
        found = -float(sizes.ratio * -x + TriangularTransmission(here).error(-x))
        after = found - turned
        if abs(after - y) < 1e-15:
            break
        y = after
    return y


@pytest.mark.parametrize("which", [(0.1, 0.0), (0.0, 0.1), (0.07, 0.06)])
def test_eccentric_wheels_are_even_wheels_at_the_distance_of_their_centres(which: tuple[float, float]) -> None:
    sizes = equally_deep(32, 20, 0.03)
    e, k = tuple(share * min(sizes.depths) for share in which), (0.4, 2.1)
    driver, driven = (wheel.eccentric(e[at], k[at]) for at, wheel in enumerate(even(sizes)))
    law = CutPairLaw.of(sizes, driver, driven)
    S = np.random.default_rng(2).uniform(0, law.period, 25)
    far = 0.0
    for angle, q in zip(S, law.angle(S), strict=True):
        far = max(far, abs(-seen_from_the_centres(sizes, -angle, e, k) - q))
    assert far < 1e-12 * sizes.p2
    low, high = law.error_range()
    assert high - low > 1.2 * np.ptp(TriangularTransmission(sizes).error_range())


# ------------------------------------------------------------------------------------------------------ to first order


def touch(x, r, b, s, c, D):
    """f of one couple, for complex numbers too: approach and recess as their closure equations have them."""
    approach = np.arcsin((D * np.sin(x + b) - r * np.sin(b)) / s) - x - b
    seen = np.arctan(r * np.sin(x) / (D - r * np.cos(x)))
    square = D * D + r * r - 2 * D * r * np.cos(x)
    recess = c + seen - np.arcsin(s * np.sin(c) / np.sqrt(square))
    return approach if approach.real < recess.real else recess


def linear(sizes: TriangularSizes, S: float, errors: dict[str, np.ndarray], shift: float) -> float:
    """The first-order change of the driven angle at S: complex steps through the couple that pushes."""
    law = TriangularTransmission(sizes)
    x = float(law.alpha1(S))
    k = round((x + S) / sizes.p1)
    i, j = k % sizes.z1, k % sizes.z2
    step = 1e-30j

    def value(h: complex) -> complex:
        y = touch(
            x + h * errors["place1"][i],
            sizes.R1 + h * errors["tip1"][i],
            sizes.beta1 + h * errors["leading1"][i],
            sizes.R2 + h * errors["tip2"][j],
            sizes.beta2 + h * errors["trailing2"][j],
            sizes.D + h * shift,
        )
        return y - h * errors["place2"][j]

    return -(value(step).imag / 1e-30)


def test_small_errors_act_as_first_order_says_to_second_order() -> None:
    """The rest falls with the square of the errors, in the mean over a pitch and at angles away from switches."""
    sizes = equally_deep(24, 15, 0.03)
    rng, law = np.random.default_rng(3), TriangularTransmission(sizes)
    errors = {f"{kind}{at}": rng.standard_normal(z) for at, z in ((1, 24), (2, 15)) for kind in KINDS}
    for at, R in ((1, sizes.R1), (2, sizes.R2)):
        errors[f"tip{at}"] *= R
    shift = float(rng.standard_normal()) * sizes.R1

    def cut(size: float) -> CutPairLaw:
        one, two = (
            wheel.placed(size * errors[f"place{at}"])
            .grown(size * errors[f"tip{at}"])
            .widened(size * errors[f"leading{at}"], size * errors[f"trailing{at}"])
            for at, wheel in zip((1, 2), even(sizes), strict=True)
        )
        return CutPairLaw.of(sizes, one, two, size * shift)

    corners = np.sort(np.array(law.corners()) % sizes.p1)
    S = rng.uniform(0, 2 * pi, 400)
    S = S[(np.abs((S % sizes.p1)[:, None] - np.append(corners, [0, sizes.p1])).min(axis=1) > 0.05 * sizes.p1)]
    first = np.array([linear(sizes, float(at), errors, shift) for at in S])
    rests = [np.abs(cut(size).error(S) - law.error(S) - size * first) for size in (2e-4, 1e-4)]
    orders = np.log2(rests[0] / rests[1])
    assert len(S) > 100
    assert 1.8 < np.median(orders) < 2.2
    assert np.mean((orders > 1.8) & (orders < 2.2)) > 0.9

    # the mean over the cycle: switches move by the errors, and the error is continuous there
    weights = np.polynomial.legendre.leggauss(6)
    edges = np.sort(np.concatenate([corners + n * sizes.p1 for n in range(lcm(24, 15))]))
    edges = np.append(edges, edges[0] + law.period * lcm(24, 15))
    half = np.diff(edges) / 2
    nodes = (edges[:-1] + half)[:, None] + half[:, None] * weights[0]
    slope = sum(
        float(w * h * linear(sizes, float(node), errors, shift))
        for row, h in zip(nodes, half, strict=True)
        for node, w in zip(row, weights[1], strict=True)
    ) / float(2 * half.sum())
    mean = law.error_moments()[0]
    rest = [abs(cut(size).error_moments()[0] - mean - size * slope) for size in (2e-4, 1e-4)]
    assert 1.8 < np.log2(rest[0] / rest[1]) < 2.2


# ------------------------------------------------------------------------------------------------------------ outlines


def drawn(rng: np.random.Generator, ring: Literal[0, 1, 2] = 0) -> tuple[TriangularSizes, CutPairLaw, Judge]:
    """Two wheels with every kind of error, as the law has them and as outlines."""
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
                wheels.append(wheel.placed(place).grown(tip).widened(less, more).eccentric(e, towards))
            except RangeError:
                break
            theta, r = np.arange(z) * wheel.pitch + place, abs(wheel.radius + tip)
            b = wheel.half_angle
            outlines.append(Outline(theta, r, b + less, b + more, wheel.radius < 0).about(e, towards))
        shift = 0.02 * min(sizes.depths) * rng.standard_normal()
        try:
            law = CutPairLaw.of(sizes, *wheels, shift)
        except (RangeError, TypeError):
            continue
        return sizes, law, Judge(outlines[0], outlines[1], sizes.D + shift)


@pytest.mark.parametrize("ring", [0, 1, 2])
@pytest.mark.parametrize("number", [pytest.param(20), pytest.param(1000, marks=pytest.mark.long)])
def test_cut_wheels_touch_where_their_outlines_do(number: int, ring: Literal[0, 1, 2]) -> None:
    """First touch, by halving the driven angle, and jams, at ten positions of each of many pairs of wheels.

    Where teeth have only just come in, the search may step across one: then it must be there all the same.
    """
    rng, far, jammed, across = np.random.default_rng(4), 0.0, 0, 0
    for _ in range(number):
        sizes, law, judge = drawn(rng, ring)
        S = rng.uniform(0, law.period, 10)
        upper = -law.error(S) - sizes.ratio * S
        lower = upper - law.play(S)
        still = law.speed(S) == 0
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


def test_a_driven_wheel_that_is_dragged_follows_the_outlines() -> None:
    """Marched in small steps, never turned back: where it stands, how far it is left behind, where it is caught."""
    sizes = equally_deep(20, 30, 0.0)
    sizes = sizes.at(find_window(sizes).at(0.85))
    rng = np.random.default_rng(6)
    places = [0.03 * 2 * pi / z * rng.standard_normal(z) for z in (20, 30)]
    law = CutPairLaw.of(sizes, *(w.placed(p) for w, p in zip(even(sizes), places, strict=True)))
    judge = Judge(
        *(
            Outline(np.arange(w.z) * w.pitch + p, np.full(w.z, w.radius), *np.full((2, w.z), THIRTY))
            for w, p in zip(even(sizes), places, strict=True)
        ),
        sizes.D,
    )
    stills = law.events.of("standstill")
    assert stills
    still = max(stills, key=lambda event: event.end - event.start)
    S = np.linspace(still.start - 0.2 * sizes.p1, still.end + 0.2 * sizes.p1, 60)
    # tip at tip the couple that leaves is thin: steps across it must be finer still
    S = np.sort(np.append(S, still.start - 0.2 * sizes.p1 * 0.9 ** np.arange(230)))
    y = np.array([-float(law.angle(S[0]))]) - 1e-9 * sizes.p2
    for angle, q in zip(S[1:], law.angle(S[1:]), strict=True):
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

    Soon the driven wheel is caught between the tooth that came in and the one before, though flanks have play. If it
    lags so far that the tooth that comes in passes its mate altogether, it is not pushed for most of a pitch.
    """
    rng, skipped, steps = np.random.default_rng(5), 0, 400
    for _ in range(number):
        while True:
            sizes = equally_deep(16, 12, 0.0)
            sizes = sizes.at(find_window(sizes).at(rng.uniform(0.3, 0.8)))
            places = [0.05 * 2 * pi / z * rng.standard_normal(z) for z in (16, 12)]
            law = CutPairLaw.of(sizes, *(w.placed(p) for w, p in zip(even(sizes), places, strict=True)))
            if law.events and {event.kind for event in law.events.all} == {"clash"} and law.events.play >= 0:
                break
        judge = Judge(
            *(
                Outline(np.arange(w.z) * w.pitch + p, np.full(w.z, w.radius), *np.full((2, w.z), THIRTY))
                for w, p in zip(even(sizes), places, strict=True)
            ),
            sizes.D,
        )
        clash = law.events.stop
        S = np.arange(clash.start - 0.05 * sizes.p1, clash.start + sizes.p1, sizes.p1 / steps)
        # no pair of teeth of these turns the driven wheel on as fast as 4 times the mean
        y, on = -float(law.angle(S[0])) - 1e-9, np.linspace(0, 4 * sizes.p2 / steps, 21)
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
            assert float(law.angle(angle)) + y > 0.6 * sizes.p2  # behind the law of its pushing flanks
    assert skipped <= 0.05 * number


# -------------------------------------------------------------------------------------------------------------- events


def test_the_one_tooth_that_is_out_of_place_is_named() -> None:
    sizes = equally_deep(16, 12, 0.03)
    late = np.zeros(16)
    late[5] = 0.45 * sizes.p1
    driver, driven = even(sizes)
    events = CutPairLaw.of(sizes, driver.placed(late), driven).events
    assert events.jams
    assert events.play < 0
    teeth = {tooth[0] for event in events.of("jam", "clash") for tooth in (event.pushing, event.stopping) if tooth}
    assert 5 in teeth
    assert teeth <= {3, 4, 5, 6, 7}


def test_a_jam_begins_where_the_play_is_used_up() -> None:
    """Before it there is play, within it none: told by the outlines too."""
    rng, seen = np.random.default_rng(7), 0
    while seen < 4:
        sizes, law, judge = drawn(rng)
        if law.pair.count > 70:
            continue
        for event in law.events.of("jam")[:2]:
            if event.end - event.start < 1e-4 * sizes.p1 or event.start < 0.01:
                continue
            seen += 1
            edge = 1e-6 * sizes.p1
            S = np.array([event.start - edge, event.start + edge])
            play = law.play(S)
            assert play[0] > 0 > play[1]
            upper = -law.error(S) - sizes.ratio * S
            assert list(judge.overlap(-S, upper - play / 2)) == [False, True]
            assert event.amount > 0


def test_a_tooth_broken_off_lets_the_wheels_lose_each_other() -> None:
    sizes = equally_deep(12, 18, 0.0)
    sizes = sizes.at(find_window(sizes).at(0.6))
    driver, driven = even(sizes)
    short = np.zeros(12)
    short[[4, 5]] = -0.9 * sizes.depths[0]
    events = CutPairLaw.of(sizes, driver.grown(short), driven).events
    gaps = events.of("disengaged")
    assert len(gaps) >= lcm(12, 18) // 12
    assert bool(events.of("disengaged"))
    assert events.of("standstill")
    assert all(event.amount == inf for event in gaps)


# ------------------------------------------------------------------------------------------------------------ refusals


def test_impossible_wheels_are_refused() -> None:
    sizes = equally_deep(16, 12, 0.03)
    driver, driven = even(sizes)
    for make in (
        lambda: driver.placed(np.linspace(0, 7, 16)),
        lambda: driver.widened(-0.6),
        lambda: driver.widened(1.0),
        lambda: driver.grown(-2.0),
        lambda: load("longcase-clock-cycloidal").meshes[0].cut_sizes,
        lambda: CutPairLaw.of(sizes.at(0.001), driver.widened(0.5), driven.widened(0.5)),
    ):
        with pytest.raises(RangeError) as caught:
            make()
        assert all(problem.what and problem.fix for problem in caught.value.problems)
