"""Contact of two outlines: closed forms, printed laws, conjugate teeth from elsewhere, brute force on dense points."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise
from math import acos, atan2, cos, hypot, inf, pi, radians, sin, sqrt, tan
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from geartrain.errors import GearTrainError, QuestionError, RangeError
from geartrain.teeth import Cycloidal, Involute, UniformStress, UniformTemperature
from geartrain.teeth.conjugate import PathOfContact, WheelPair
from geartrain.teeth.contact import GearOutline, OutlineCurve, ToothFlanks, contact, polyline, solve, tabulate
from geartrain.teeth.triangular import TriangularSizes, TriangularTransmission, equal_depth

TWENTY = radians(20)
Z1, Z2 = 24, 36


def inv(angle: float) -> float:
    return tan(angle) - angle


def involute(z: int, low: float, high: float, psi: float = TWENTY) -> OutlineCurve:
    """The side ahead of a tooth of module 1 from radius low to high, at azimuth 0 on the pitch circle."""
    base = z / 2 * cos(psi)

    def points(t):
        r, a = base * np.sqrt(1 + t * t), inv(psi) - (t - np.arctan(t))
        return np.stack([r * np.sin(a), r * np.cos(a)], axis=1)

    return OutlineCurve(points, sqrt(max(0.0, (low / base) ** 2 - 1)), sqrt((high / base) ** 2 - 1))


def wheels(
    addenda: tuple[float, float] = (1.0, 1.0), dedendum: float = 1.25, thin: float = 0.0
) -> tuple[GearOutline, GearOutline]:
    """24 and 36 involute teeth; tooth 0 of the first has its front, of the second its back side on the pitch point."""
    tables = []
    for z, addendum, side in ((Z1, addenda[0], 1), (Z2, addenda[1], -1)):
        curve = involute(z, z / 2 - dedendum, z / 2 + addendum)
        tooth = ToothFlanks.symmetric((curve,), -pi / z / 2 + thin / 2)
        tables.append(GearOutline((tooth if side > 0 else tooth.turned(pi / z - thin),), z))
    return tables[0], tables[1]


def in_body(pitch: Any, gear: int) -> Callable[[np.ndarray], np.ndarray]:
    """Points counted from the pitch point, as an outline counts them: from the axle, x forward, y outward."""
    R = -pitch.R1 if gear == 1 else pitch.R2
    if pitch.bevel:
        axis, out = np.array([0.0, sin(R), cos(R)]), np.sign(R) * np.array([0.0, -cos(R), sin(R)])
        return lambda p: np.stack([p[:, 0], p @ out, p @ axis], axis=1)
    return lambda p: np.stack([p[:, 0], (p[:, 1] - R) * np.sign(-R)], axis=1)


def conjugate(path: PathOfContact) -> tuple[GearOutline, GearOutline, float]:
    """Outlines with the flanks of a path of contact, and the distance."""
    pitch, (approach, recess) = path.pitch, path.arcs

    def side(flank, gear):
        change = in_body(pitch, gear)
        return tuple(OutlineCurve(lambda X: change(flank(X)), *ends) for ends in ((-approach, -1e-300), (0.0, recess)))

    one = ToothFlanks.symmetric(side(partial(path.flank, 1), 1), -pi / pitch.z1 / 2)
    two = ToothFlanks.symmetric(side(partial(path.flank, 2), 2), pi / pitch.z2 / 2)
    second = GearOutline((ToothFlanks(two.behind, two.ahead),), pitch.z2, ring=pitch.R2 < 0)
    return GearOutline((one,), pitch.z1), second, abs(pitch.R1 + pitch.R2)


def dense(curves: tuple[OutlineCurve, ...], number: int = 4001) -> np.ndarray:
    """Many points of a chain of curves, radius and azimuth, (2, n)."""
    parts = [curve.at(np.linspace(curve.start, curve.end, number)) for curve in curves]
    x, y, *z = np.concatenate(parts).T
    r = np.hypot(x, y)
    return np.stack([np.arctan2(r, z[0]) if z else r, np.arctan2(x, y)])


def brute(first: GearOutline, second: GearOutline, distance: float, phi1: float, number: int = 4001) -> float:
    """The driven angle from all couples and many points of the driver; equal teeth, sides with rising radius."""
    (r, a), (r2, a2) = dense(first.teeth[0].ahead, number), dense(second.teeth[0].behind, number)
    order = np.argsort(r2)
    found = -inf
    for j in range(-first.z, first.z + 1):
        b = a + phi1 + j * first.pitch
        side, far = r * np.sin(b), distance - r * np.cos(b)
        seen = np.hypot(side, far)
        inside = (seen >= r2.min()) & (seen <= r2.max()) & (np.abs(b) < pi)
        own = np.interp(seen[inside], r2[order], a2[order])
        off = np.arctan2(side[inside], far[inside]) - own - j * second.pitch
        found = max(found, float(off.max(initial=-inf)))
    return found


@pytest.mark.parametrize("distance", [30.0, 30.02, 30.2, 30.5])
def test_an_involute_has_no_error_at_any_centre_distance_and_the_backlash_of_the_textbook(distance: float) -> None:
    """Lag and play: 1 and 2 times (inv psi' - inv psi)(z1 + z2)/z2, the operating angle from the base circles."""
    first, second = wheels()
    phi1 = np.linspace(-0.7, 0.9, 501)
    found = solve(first, second, distance, phi1)
    lag = (inv(acos(30 * cos(TWENTY) / distance)) - inv(TWENTY)) * (Z1 + Z2) / Z2
    assert np.abs(found.front.angle - (phi1 * Z1 / Z2 - lag)).max() < 2e-15
    assert np.abs(found.backlash - 2 * lag).max() < 3e-15
    assert np.abs(found.front.speed - Z1 / Z2).max() < 1e-12
    assert np.abs(found.back.speed - Z1 / Z2).max() < 1e-12


def test_thick_teeth_jam_by_what_they_are_too_thick() -> None:
    """Each tooth of both wheels 0.001 rad of its own wheel too thick."""
    first, second = wheels(thin=-0.001)
    backlash = solve(first, second, 30.0, np.linspace(0, 0.3, 101)).backlash
    assert np.abs(backlash + 0.001 + 0.001 * Z1 / Z2).max() < 2e-15


def test_as_many_pairs_share_the_load_as_the_contact_ratio_says() -> None:
    first, second = wheels()
    phi1 = (np.arange(1000) + 0.5) / 1000 * 2 * pi / Z1
    front = contact(first, second, 30.0, phi1)
    tips = [sqrt((z / 2 + 1) ** 2 - (z / 2 * cos(TWENTY)) ** 2) for z in (Z1, Z2)]
    ratio = (sum(tips) - 30 * sin(TWENTY)) / (pi * cos(TWENTY))
    assert front.sharing.mean() == pytest.approx(ratio, abs=4e-3)
    assert set(front.sharing) == {1, 2}
    assert not front.kind.any()


def test_the_pair_in_contact_is_counted_without_end() -> None:
    first, second = wheels()
    phi1 = np.array([0.0, 2 * pi / Z1, 2 * pi, -2 * pi, 100 * 2 * pi / Z1])
    front = contact(first, second, 30.1, phi1 + 0.01)
    assert (front.pair - front.pair[0]).tolist() == [0, -1, -Z1, Z1, -100]


def short_transmission(x: float, tip: float) -> float:
    """The driven angle for one couple of short involute teeth at driver's angle x: flank on flank, or a tip on one."""
    base1, base2 = Z1 / 2 * cos(TWENTY), Z2 / 2 * cos(TWENTY)
    tip1, tip2 = Z1 / 2 + tip, Z2 / 2 + tip
    along = x * base1
    last = sqrt(tip1**2 - base1**2) - Z1 / 2 * sin(TWENTY)
    first = -(sqrt(tip2**2 - base2**2) - Z2 / 2 * sin(TWENTY))
    if first <= along <= last:
        return x * Z1 / Z2
    if along > last:  # the driver's tip on the driven side
        azimuth = x + inv(TWENTY) - inv(acos(base1 / tip1))
        side, far = tip1 * sin(azimuth), 30.0 - tip1 * cos(azimuth)
        r = hypot(side, far)
        return atan2(side, far) - (inv(acos(base2 / r)) - inv(TWENTY)) if base2 <= r <= tip2 else -inf
    low, high = x - 0.5, x + 0.5  # the driven tip on the driver's side: its angle by halving
    own = inv(acos(base2 / tip2)) - inv(TWENTY)

    def ahead(angle: float) -> float:
        """How far the driven tip is ahead of the driver's side (rad about O1)."""
        side, far = tip2 * sin(angle + own), 30.0 - tip2 * cos(angle + own)
        r = hypot(side, far)
        return atan2(side, far) - (x + inv(TWENTY) - inv(acos(base1 / max(r, base1))))

    for _ in range(80):
        middle = (low + high) / 2
        low, high = (low, middle) if ahead(middle) > 0 else (middle, high)
    angle = (low + high) / 2
    r = hypot(tip2 * sin(angle + own), 30.0 - tip2 * cos(angle + own))
    return angle if base1 <= r <= tip1 else -inf


def test_short_teeth_touch_with_their_tips_between_one_pair_and_the_next() -> None:
    """Contact ratio 0.86: the transmission error of tips on involutes, by closed form and by halving."""
    tip = 0.45
    first, second = wheels((tip, tip), dedendum=0.7)
    phi1 = np.linspace(-0.13, 0.13, 301)
    front = contact(first, second, 30.0, phi1)
    pitches = 2 * pi / Z1, 2 * pi / Z2
    true = [max(short_transmission(x + j * pitches[0], tip) - j * pitches[1] for j in range(-2, 3)) for x in phi1]
    assert np.abs(front.angle - true).max() < 2e-14
    assert set(front.kind.tolist()) == {0, 1, 2}
    assert (front.angle - phi1 * Z1 / Z2).min() < -1e-4  # it falls behind, by far more than rounding
    kinks = tabulate(first, second, 30.0).kinks
    assert len(kinks) == 3  # flank to driver's tip, to the next driven tip, to its flank


def test_an_eccentric_involute_runs_at_the_distance_of_its_middle() -> None:
    """The involute law holds about the line from the middle of the driver to the driven axle, wherever that is."""
    first, second = wheels()
    e, turned = 0.05, 0.4
    eccentric = first.displaced(e * sin(turned), e * cos(turned))
    phi1 = np.linspace(0, 2 * pi, 211)
    side, far = e * np.sin(phi1 + turned), 30.3 - e * np.cos(phi1 + turned)
    lag = np.array([(inv(acos(30 * cos(TWENTY) / d)) - inv(TWENTY)) * (Z1 + Z2) / Z2 for d in np.hypot(side, far)])
    line = np.arctan2(side, far)
    found = contact(eccentric, second, 30.3, phi1)
    assert np.abs(found.angle - (line + (phi1 + line) * Z1 / Z2 - lag)).max() < 5e-15
    back = contact(eccentric, second, 30.3, phi1, "back")
    assert np.abs(back.angle - (line + (phi1 + line) * Z1 / Z2 + lag)).max() < 5e-15


def test_a_tooth_ahead_of_its_place_leads_while_it_is_in_contact() -> None:
    first, second = wheels()
    late = GearOutline(first.teeth, Z1, (0.0,) * 3 + (2e-4,) + (0.0,) * (Z1 - 4))
    at = -3 * 2 * pi / Z1  # its side on the pitch point
    phi1 = at + np.linspace(-0.15, 0.15, 31)
    found = contact(late, second, 30.0, phi1)
    assert (found.pair == 3).all()
    assert np.abs(found.angle - (phi1 + 2e-4) * Z1 / Z2).max() < 2e-15
    elsewhere = contact(late, second, 30.0, phi1 + pi)
    assert np.abs(elsewhere.angle - (phi1 + pi) * Z1 / Z2).max() < 2e-15
    driven = GearOutline(second.teeth, Z2, (0.0,) * 3 + (-2e-4,) + (0.0,) * (Z2 - 4))
    assert np.abs(contact(first, driven, 30.0, phi1).angle - phi1 * Z1 / Z2 - 2e-4).max() < 2e-15


def test_a_measured_tooth_comes_nearer_with_the_square_of_its_points() -> None:
    first, second = wheels()
    curve = first.teeth[0].ahead[0]
    phi1 = np.linspace(0, 2 * pi / Z1, 31)
    off = []
    for number in (11, 21, 41):
        measured = ToothFlanks.symmetric(polyline(curve.at(np.linspace(curve.start, curve.end, number))), -pi / Z1 / 2)
        worn = GearOutline((measured,), Z1)
        off.append(np.abs(contact(worn, second, 30.0, phi1).angle - phi1 * Z1 / Z2).max())
        assert float(contact(worn, second, 30.0, 0.03).angle) == pytest.approx(
            brute(worn, second, 30.0, 0.03), abs=1e-7
        )
    assert all(3 < a / b < 5 for a, b in pairwise(off)), off


PITCH_POINT = 2 * 18 * float(np.arcsin(0.8 / 36))


def lantern(start: float) -> tuple[GearOutline, GearOutline]:
    """24 teeth and 36 whole pins of radius 0.8 on 18; the mate is the parallel curve of the pin centre's path."""
    R1, R2, B = 12.0, 18.0, 0.8

    def mate(X):
        beta, turn = X / R2, X / R1
        gx, gy = R2 * np.sin(beta), R2 - R2 * np.cos(beta)
        inner = 1 - B / np.hypot(gx, gy)
        x, y = gx * inner, gy * inner + R1
        return np.stack([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)], axis=1)

    circle = OutlineCurve(lambda t: np.stack([B * np.sin(t), R2 + B * np.cos(t)], axis=1), 0.0, 2 * pi)
    first = GearOutline((ToothFlanks.symmetric((OutlineCurve(mate, start, 4.6),), -0.1),), 24)
    return first, GearOutline((ToothFlanks((circle,), (circle,)),), 36)


def test_whole_pins_and_their_mate_have_no_error_whichever_drives() -> None:
    """The radius of a circle turns twice."""
    first, second = lantern(PITCH_POINT + 0.1)
    phi1 = (PITCH_POINT + 0.1 + np.linspace(0, pi, 201)) / 12
    assert np.abs(contact(first, second, 30.0, phi1).angle - phi1 * 2 / 3).max() < 1e-15
    # turned backward, a pin pushes the tooth it was pushed by, which then counts as the one behind
    back = contact(second, first, 30.0, phi1 * 2 / 3, "back")
    assert np.abs(back.angle - phi1 - 2 * pi / 24).max() < 2e-15


def test_a_pin_fouls_the_beginning_of_a_mate_that_starts_at_the_pitch_point() -> None:
    """Against a scan of dense points that knows the pin as a circle in closed form."""
    first, second = lantern(PITCH_POINT)
    r, a = dense(first.teeth[0].ahead, 20001)
    for X in (1.5, 3.13, 3.3):
        found = -inf
        for j in (-1, 0, 1):
            side, far = r * np.sin(a + X / 12 + j * pi / 12), 30 - r * np.cos(a + X / 12 + j * pi / 12)
            seen = np.hypot(side, far)
            near = np.abs(seen - 18) <= 0.8
            behind = -np.arccos((seen[near] ** 2 + 18**2 - 0.8**2) / (36 * seen[near]))
            off = np.arctan2(side[near], far[near]) - behind - j * pi / 18
            found = max(found, float(off.max(initial=-inf)))
        exact = float(contact(first, second, 30.0, X / 12).angle)
        assert found - 1e-12 < exact < found + 1e-10
        assert (exact - X / 18 > 1e-6) == (X > 2)


CASES = [(48, 96, 0.01), (48, 96, 0.025), (96, 72, 0.01), (96, 72, 0.025), (96, 96, 0.01), (96, 96, 0.025)]


Triangles = tuple[TriangularSizes, GearOutline, GearOutline]


def triangles(z1: int, z2: int, excess: float, beta: float = radians(30)) -> Triangles:
    sizes = TriangularSizes(z1, z2, *equal_depth(z1, z2, beta, beta), beta, beta, excess)

    def wheel(z: int, R: float, length: float) -> GearOutline:
        ends = polyline([(0.0, R), (length * sin(beta), R - length * cos(beta))])
        return GearOutline((ToothFlanks.symmetric(ends),), z)

    return sizes, wheel(z1, sizes.R1, sizes.flanks[0]), wheel(z2, sizes.R2, sizes.flanks[1])


@pytest.mark.parametrize(("z1", "z2", "excess"), CASES)
def test_triangular_teeth_and_their_tables_have_their_transmission(z1: int, z2: int, excess: float) -> None:
    sizes, first, second = triangles(z1, z2, excess)
    transmission = TriangularTransmission(sizes)
    phi1 = np.linspace(-0.5, 0.6, 801)
    found = solve(first, second, sizes.D, phi1)
    assert np.abs(found.front.angle - transmission.angle(phi1)).max() < 2e-15
    assert np.abs(found.back.angle - transmission.reversed_motion().angle(phi1)).max() < 2e-15
    assert np.abs(found.front.speed - transmission.speed(phi1)).max() < 1e-12
    assert transmission.verdict.backlash - 1e-14 <= found.backlash.min() < transmission.verdict.backlash + 1e-6
    assert set(found.front.kind.tolist()) <= {1, 2, 3}  # an apex always takes part
    table = tabulate(first, second, sizes.D)
    assert table.uncertainty < 1e-13
    before, after = table.speed(table.kinks - 1e-12), table.speed(table.kinks + 1e-12)
    assert np.sort(1 - before / after) == pytest.approx(sorted(jump.value for jump in transmission.jumps), abs=1e-10)
    at = np.sort(-np.array([jump.alpha1 for jump in transmission.jumps]) % transmission.period)
    assert np.sort(table.kinks % transmission.period) == pytest.approx(at, abs=1e-13)
    assert table.extremes() == pytest.approx(transmission.error_range(), abs=1e-13)
    assert table.speed_range() == pytest.approx(transmission.speed_range(), abs=1e-11)
    assert table.moments() == pytest.approx(transmission.error_moments(), abs=1e-14)
    phi1 = np.random.default_rng(1).uniform(-7, 7, 2000)
    assert np.abs(table.angle(phi1) - transmission.angle(phi1)).max() < 1e-14
    assert np.abs(table.speed(phi1) - transmission.speed(phi1)).max() < 1e-10


@settings(max_examples=15)
@given(st.integers(8, 90), st.integers(8, 90), st.floats(0.1, 0.9), st.floats(12, 50))
def test_any_triangular_teeth_have_their_transmission(z1: int, z2: int, share: float, beta: float) -> None:
    sizes = triangles(z1, z2, 0.0, radians(beta))[0]
    sizes, first, second = triangles(z1, z2, share * sizes.maximum_excess, radians(beta))
    transmission = TriangularTransmission(sizes)
    if not transmission.verdict or any(sizes.lean):
        return
    phi1 = np.linspace(0, 2 * pi / z1, 57)
    assert np.abs(contact(first, second, sizes.D, phi1).angle - transmission.angle(phi1)).max() < 1e-13


def stress(z1: int, z2: int, **wheels: Any) -> PathOfContact:
    return UniformStress(form="uniform_stress").path(z1, z2, **wheels)


def drawn_involute(z1: int, z2: int, psi: float = 20, share: float = 0.5, **wheels: Any) -> PathOfContact:
    """Pressure angle in degrees; equal arcs of approach and recess, in pitches."""
    given = {"pressure_angle": f"{psi!r} deg"}
    return Involute.pair_of_arcs(WheelPair(z1, z2, **wheels), (share, share), given).path


def cycloid(z1: int, z2: int, rolling: float) -> PathOfContact:
    return Cycloidal.declared({"rolling": repr(rolling), "arcs": "1/2"}).path(z1, z2)


SHAPES = {
    "uniform stress": lambda: stress(24, 36),
    "uniform stress, many teeth": lambda: stress(1000, 3000),
    "uniform stress in a ring": lambda: stress(24, 72, internal=True),
    "uniform stress, bevel": lambda: stress(24, 36, shaft_angle=pi / 2),
    "uniform heat": lambda: UniformTemperature.declared({"heat": repr((1 / 12 + 1 / 18) / 0.3)}).path(24, 36),
    "cycloid": lambda: cycloid(24, 36, 4.5),
    "involute in a ring": lambda: drawn_involute(24, 72, internal=True),
    "involute, bevel, two pairs": lambda: drawn_involute(15, 45, share=0.7, shaft_angle=pi / 2),
    "involute, obtuse shaft angle": lambda: drawn_involute(20, 40, shaft_angle=2.1),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_conjugate_teeth_have_no_error_and_no_backlash_at_their_distance(shape: str) -> None:
    path = SHAPES[shape]()
    first, second, distance = conjugate(path)
    ratio = path.pitch.z1 / path.pitch.z2
    phi1 = np.linspace(0.0, 1.0, 151) * 2 * pi / path.pitch.z1 + 1e-3 / path.pitch.z1
    found = solve(first, second, distance, phi1)
    assert np.abs(found.front.angle - ratio * phi1).max() < 2e-15
    assert np.abs(found.backlash).max() < 4e-15
    assert np.abs(found.front.speed - ratio).max() < 1e-6  # where tips take over a contact may be off by its rounding
    assert np.median(np.abs(found.front.speed - ratio)) < 1e-12


def test_cycloids_at_a_wrong_distance_are_what_a_scan_of_dense_points_says() -> None:
    first, second, distance = conjugate(SHAPES["cycloid"]())
    table = tabulate(first, second, distance + 0.1, 1e-11)
    assert table.uncertainty < 1e-11
    for phi1 in np.linspace(0.01, 0.27, 7):
        near = brute(first, second, distance + 0.1, float(phi1))
        assert near - 1e-9 < float(table.angle(phi1)) < near + 3e-6
    low, high = table.extremes()
    assert high - low > 1e-4


def test_an_eccentric_cycloid_repeats_itself_after_the_turns_that_bring_the_same_teeth_together() -> None:
    first, second, distance = conjugate(cycloid(6, 8, 1.2))
    one, two = first.displaced(0.01, 0.0), second.displaced(0.0, 0.02)
    period = 4 * 2 * pi  # 24 pitches
    phi1 = np.linspace(0, 2, 7)
    before, after = (contact(one, two, distance + 0.05, phi1 + at) for at in (0.0, period))
    assert after.angle - before.angle == pytest.approx(period * 6 / 8, abs=1e-13)
    part = contact(one, two, distance + 0.05, phi1 + period / 2).angle - before.angle
    assert np.abs(part - period * 3 / 8).max() > 1e-5
    uneven = tabulate(GearOutline(first.teeth, 6, (0.0, 1e-3, 0.0, 0.0, 2e-3, 0.0)), second, distance, 1e-9)
    assert uneven.period == pytest.approx(2 * pi)
    low, high = uneven.extremes()
    assert high == pytest.approx(2e-3 * 6 / 8, abs=1e-9)
    assert low > -1e-9


def bulging(z: int, width: float, depth: float, bend: float, wave: float) -> GearOutline:
    """A tooth whose side is a cubic in radius, from width at its root to a sixth of it at its tip."""

    def points(t):
        r = z / 2 - depth + 2 * depth * t
        a = width * pi / z * (1 - 0.8 * t + bend * t * (1 - t) + wave * t * (1 - t) * (1 - 2 * t)) / 2
        return np.stack([r * np.sin(a), r * np.cos(a)], axis=1)

    return GearOutline((ToothFlanks.symmetric((OutlineCurve(points),)),), z)


SIDES = st.tuples(st.integers(7, 40), st.floats(0.7, 1.1), st.floats(0.5, 1.1), st.floats(-0.6, 0.9), st.floats(-1, 1))


@settings(max_examples=25)
@given(SIDES, SIDES, st.floats(0.1, 0.9), st.floats(-3, 3))
def test_sides_of_any_shape_touch_first_where_a_scan_of_dense_points_says(one, two, deep, phi1) -> None:
    first, second = bulging(*one), bulging(*two)
    distance = (one[0] + two[0]) / 2 + (one[2] + two[2]) * (1 - deep)
    phi1 = phi1 % first.pitch
    exact, near = float(contact(first, second, distance, phi1).angle), brute(first, second, distance, phi1)
    assert (near == -inf) == np.isnan(exact) or np.isnan(exact)
    if near > -inf:
        assert near - 1e-7 < exact < near + 1e-4


@settings(max_examples=6)
@given(SIDES, SIDES, st.floats(0.3, 0.9), st.sampled_from(["front", "back"]))
def test_tables_are_as_near_to_the_contact_as_they_say(one, two, deep, side) -> None:
    first, second = bulging(*one), bulging(*two)
    distance = (one[0] + two[0]) / 2 + (one[2] + two[2]) * (1 - deep)
    try:
        table = tabulate(first, second, distance, 1e-10, side)
    except RangeError:
        return
    phi1 = np.random.default_rng(2).uniform(0, first.pitch, 200)
    away = np.abs(phi1[:, None] - table.kinks).min(axis=1, initial=1.0) > 1e-6 * first.pitch
    off = np.abs(table.angle(phi1) - contact(first, second, distance, phi1, side).angle)[away]
    assert np.nanmax(off, initial=0.0) <= max(table.uncertainty, 1e-13)
    assert table.period == pytest.approx(first.pitch)


def test_wheels_too_far_apart_touch_nowhere() -> None:
    first, second = wheels()
    found = solve(first, second, 33.0, [0.0, 0.1])
    assert np.isnan(found.front.angle).all()
    assert found.to_dict()["front"]["kind"] == ["none", "none"]
    with pytest.raises(RangeError, match="never touch"):
        tabulate(first, second, 33.0)


def test_what_cannot_be_answered_is_refused_with_what_why_and_what_to_do() -> None:
    first, second = wheels()
    side = first.teeth[0].ahead
    bevel, *_ = conjugate(SHAPES["uniform stress, bevel"]())
    torn = OutlineCurve(lambda t: np.stack([np.sign(t - 0.3), 5 + t], axis=1))
    wrong: list[tuple[type[GearTrainError], Callable[[], object]]] = [
        (QuestionError, lambda: GearOutline((first.teeth[0],) * 3, 24)),
        (QuestionError, lambda: GearOutline(first.teeth, 24, (0.1,))),
        (QuestionError, lambda: GearOutline((ToothFlanks((), side),), 24)),
        (QuestionError, lambda: GearOutline((ToothFlanks((side[0], side[0]), side),), 24)),
        (QuestionError, lambda: GearOutline((ToothFlanks((OutlineCurve(side[0].points, 0.5, 0.5),), side),), 24)),
        (QuestionError, lambda: solve(first, bevel, 1.0, 0.0)),
        (QuestionError, lambda: bevel.displaced(0.1, 0.0)),
        (RangeError, lambda: solve(first, second, -30.0, 0.0)),
        (RangeError, lambda: solve(bevel, bevel, 4.0, 0.0)),
        (RangeError, lambda: solve(first, second, 30.0, [0.0, np.nan])),
        (RangeError, lambda: GearOutline((ToothFlanks((torn,), side),), 24).ahead),
    ]
    for kind, ask in wrong:
        with pytest.raises(kind) as caught:
            ask()
        assert all(problem.what and problem.why and problem.fix for problem in caught.value.problems)


def test_answers_keep_the_shape_of_the_question() -> None:
    first, second = wheels()
    found = solve(first, second, 30.0, np.zeros((2, 3)))
    assert found.front.angle.shape == found.backlash.shape == (2, 3)
    assert found.front.curves.shape == (2, 2, 3)
    assert solve(first, second, 30.0, np.empty(0)).front.angle.shape == (0,)
    assert float(solve(first, second, 30.0, 0.0).front.angle) == pytest.approx(0, abs=1e-15)
    assert contact(first, second, 30.0, 0.0).to_dict()["kind"] == "flank"
