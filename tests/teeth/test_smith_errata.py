"""The equations of W. D. Smith, Optimal shapes for gears (1993): those that hold hold, those that fail fail as told.

Everything is read off points of finished profiles (docs/scripts/sources/smith_profiles.py), or taken at random
arguments in 40 digits.
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sources.smith_profiles import (
    Seen,
    big_M,
    corrected_56,
    corrected_63,
    crawl,
    loss_63,
    printed_56,
    printed_63,
    root_Q,
    seen,
    stress_55,
)
from test_conjugate import path_of

from geartrain.teeth.conjugate import optimal_sides as forms
from geartrain.teeth.conjugate.path_of_contact import PathContact, PathOfContact
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

SHAPES = ("involute20", "UHS psi0=20", "UT-b", "MF psi_hi=25 u=0.15")
SPUR, BEVEL = ("spur(24,36)", "spur(12,60)"), ("bevel(24,36)", "bevel(15,45)")
FIRST, SECOND = 2e-10, 3e-7  # what differentiating points once and twice leaves


@cache
def side(pair: str, shape: str, recess: bool) -> tuple[Seen, PathContact]:
    path = path_of(pair, shape)
    found = seen(path, recess, 0.55 if shape.startswith("MF") else 0.3)
    return found, path.at(found.X)


def each(*pairs: str) -> Any:
    rows = [(pair, shape, recess) for pair in pairs for shape in SHAPES for recess in (False, True)]
    return pytest.mark.parametrize("row", rows, ids=lambda row: f"{row[0]} {row[1]} {'recess' if row[2] else 'app'}")


def same(found: Any, expected: Any, atol: float = 1e-12) -> None:
    np.testing.assert_allclose(found, expected, rtol=0, atol=atol)


def differ(found: Any, expected: Any, least: float) -> None:
    assert np.abs(np.asarray(found) - expected).min() > least


# geometry -----------------------------------------------------------------------------------------------------------


@each(*SPUR, *BEVEL)
def test_both_profiles_are_at_the_same_place_when_they_touch_and_s_is_the_distance_of_the_path(row: Any) -> None:
    v, c = side(*row)
    assert v.apart < 2e-14 * v.R2 + 1e-15
    same(v.s, c.d, 1e-14 * v.R2)
    same(v.sin_phi, c.cos_psi, 1e-12)


@each(*SPUR)
def test_equations_9_10_and_11_of_the_mate_hold_but_for_the_sign_of_the_first_11(row: Any) -> None:
    v, _ = side(*row)
    gamma, s = -v.turned[1], -v.s  # gear 2 is the given one: its own addendum has s > 0
    same(v.r[1] / v.R2, np.cos(gamma) + np.sin(gamma) * np.tan(v.psi(2)), FIRST)  # (9)
    same(s, np.sin(gamma) / np.cos(v.psi(2)) * v.R2, FIRST)  # (10)
    same(v.sin_phi, v.r[1] / v.R2 * np.cos(v.psi(2)), FIRST)
    same(np.tan(v.turned[0]), v.s * v.sin_phi / (v.R1 + v.s * v.cos_phi))  # (11), second
    squared = v.s**2 + v.R1**2
    same(v.r[0] ** 2, squared + 2 * v.R1 * v.s * v.cos_phi, 1e-12 * v.R1**2)
    same(np.abs(v.r[0] ** 2 - squared + 2 * v.R1 * v.s * v.cos_phi), 4 * v.R1 * np.abs(v.s) * v.cos_phi, 1e-11)


def test_the_first_equation_11_misses_by_about_eleven_square_modules_half_way_up_an_involute() -> None:
    v, _ = side("spur(24,36)", "involute20", True)
    at = int(np.argmin(np.abs(v.s - 0.45 * 1.476)))
    printed = v.s**2 + v.R1**2 - 2 * v.R1 * v.s * v.cos_phi
    assert (v.r[0] ** 2 - printed)[at] == pytest.approx(11, abs=1)


@each(*BEVEL)
def test_equations_6_7_and_8_of_the_mate_hold_but_for_the_sign_of_the_first_8(row: Any) -> None:
    v, _ = side(*row)
    gamma, s, R1, R2 = -v.turned[1], -v.s, v.R1, v.R2
    r2, psi2 = v.r[1], v.psi(2)
    same(np.sin(r2) / np.tan(R2), np.cos(r2) * np.cos(gamma) + np.sin(gamma) * np.tan(psi2), FIRST)  # (6)
    same(np.sin(s), np.sin(gamma) / np.cos(psi2) * np.sin(R2), FIRST)  # (7)
    same(v.sin_phi, np.sin(r2) / np.sin(R2) * np.cos(psi2), FIRST)
    plain, tilted = np.cos(R1) * np.cos(v.s), np.sin(R1) * np.sin(v.s) * v.cos_phi
    same(np.cos(v.r[0]), plain - tilted)
    same(np.abs(np.cos(v.r[0]) - plain - tilted), 2 * np.abs(tilted))
    assert 5e-3 < np.abs(np.cos(v.r[0]) - plain - tilted).max() < 3e-2
    around = 1 / np.tan(v.s) * np.sin(R1) + np.cos(R1) * v.cos_phi
    same(np.tan(v.turned[0]), v.sin_phi / around)  # (8), second


@each(*SPUR, *BEVEL)
def test_equations_21_to_23_take_the_lower_sign(row: Any) -> None:
    v, _ = side(*row)
    r, R, psi = v.r[0], v.R1, v.psi(1)
    if not v.bevel:
        root = np.sqrt(R**2 - (r * np.cos(psi)) ** 2)
        same(v.s, r * np.sin(psi) - root, FIRST)
        differ(v.s, r * np.sin(psi) + root, 0.5)
        return
    same(np.cos(R), np.cos(r) * np.cos(v.s) + np.sin(r) * np.sin(v.s) * np.sin(psi), FIRST)  # (21)
    root = np.cos(r) * np.sqrt(np.sin(R) ** 2 - np.cos(psi) ** 2 * np.sin(r) ** 2)
    below = np.sin(psi) ** 2 * np.sin(r) ** 2 + np.cos(r) ** 2
    same(np.sin(v.s), (np.cos(R) * np.sin(psi) * np.sin(r) - root) / below, FIRST)
    differ(np.sin(v.s), (np.cos(R) * np.sin(psi) * np.sin(r) + root) / below, 0.05)


@each(*SPUR, *BEVEL)
def test_33_and_38_want_the_sine_of_phi(row: Any) -> None:
    v, _ = side(*row)
    printed = v.height(1) / v.reach(1) * np.cos(v.psi(1))
    same(v.sin_phi, printed, FIRST)
    assert np.abs(v.cos_phi - printed).max() > 0.45
    if row[1] == "involute20":
        same(printed - v.cos_phi, 0.598, 1e-3)


@each(*BEVEL)
def test_34_holds_35_wants_a_plus_and_36_follows(row: Any) -> None:
    v, _ = side(*row)
    for kappa in (v.curvature(1), v.curvature(2)):
        assert np.isfinite(kappa).all()
    c1, c2, s = v.c(1), v.c(2), v.s
    normal = np.stack([v.P[0] / np.sin(s), v.P[1] / np.sin(s), 0 * s])  # unit tangent at I towards P
    along = lambda a: np.cos(a) * np.array([[0], [0], [1.0]]) + np.sin(a) * normal  # noqa: E731
    cos1 = -np.sin(v.R1) * along(s - c1)[1] + np.cos(v.R1) * along(s - c1)[2]  # from centre 1 to centre of curvature
    cos2 = np.sin(v.R2) * along(s + c2)[1] + np.cos(v.R2) * along(s + c2)[2]
    up, down = v.cos_phi, -v.cos_phi  # phi_2, phi_1
    same(cos2, np.cos(s + c2) * np.cos(v.R2) + np.sin(s + c2) * np.sin(v.R2) * up)  # (34)
    same(cos1, np.cos(s - c1) * np.cos(v.R1) + np.sin(s - c1) * np.sin(v.R1) * down)
    differ(cos1, np.cos(s - c1) * np.cos(v.R1) - np.sin(s - c1) * np.sin(v.R1) * down, 1e-4)
    rolled = up / np.tan(s + c2) + down / np.tan(s - c1)
    np.testing.assert_allclose(rolled, 1 / np.tan(v.R1) + 1 / np.tan(v.R2), rtol=SECOND)  # (36)


@each(*SPUR, *BEVEL)
def test_curvatures_27_and_29_and_euler_savary_32_and_37_hold_with_the_upper_sign(row: Any) -> None:
    v, c = side(*row)
    np.testing.assert_allclose(v.curvature(1), c.k1, rtol=SECOND, atol=SECOND)
    np.testing.assert_allclose(v.curvature(2), -c.k2, rtol=SECOND, atol=SECOND)
    c1, c2 = v.c(1), v.c(2)
    if v.bevel:
        left, right = 1 / np.tan(c1 - v.s) + 1 / np.tan(c2 + v.s), 1 / np.tan(v.R1) + 1 / np.tan(v.R2)
    else:
        left, right = 1 / (c1 - v.s) + 1 / (c2 + v.s), 1 / v.R1 + 1 / v.R2
    np.testing.assert_allclose(left, right / v.cos_phi, rtol=3 * SECOND)


@each(*SPUR)
def test_the_centres_of_curvature_30_and_31_lie_as_told(row: Any) -> None:
    v, _ = side(*row)
    unit = np.array(v.P) / v.s
    x1, y1 = unit * (v.s - v.c(1))
    x2, y2 = unit * (v.s + v.c(2))
    np.testing.assert_allclose((v.R1 + v.R2) * (y1 * y2 + x1 * x2), (y1 - y2) * v.R1 * v.R2, rtol=3 * SECOND)
    z = y1 / ((1 / v.R1 + 1 / v.R2) * (y1**2 + x1**2) + y1)
    np.testing.assert_allclose(z, x2 / x1, rtol=1e-5)


# speeds, force, what is made uniform --------------------------------------------------------------------------------


@each(*SPUR, *BEVEL)
def test_sliding_17_to_20_and_force_47_and_49_hold(row: Any) -> None:
    v, c = side(*row)
    parts = [v.height(gear) * np.sin(v.psi(gear)) / v.reach(gear) for gear in (1, 2)]
    S, rate = (np.sin(v.s), 1 / np.tan(v.R1) + 1 / np.tan(v.R2)) if v.bevel else (v.s, 1 / v.R1 + 1 / v.R2)
    same(parts[0] - parts[1], rate * S, FIRST)
    same(c.U1 - c.U2, rate * S, FIRST)
    force = np.sqrt(1 / v.slope[0] ** 2 + 1 / v.height(1) ** 2)
    np.testing.assert_allclose(force * v.reach(1), 1 / v.sin_phi, rtol=FIRST)


@each(*SPUR, *BEVEL)
def test_42_to_45_want_the_difference_of_radius_of_curvature_and_signed_distance(row: Any) -> None:
    v, c = side(*row)
    np.testing.assert_allclose(v.crawl(1), np.abs(c.U1), rtol=1e-8, atol=1e-9)
    right, printed = crawl(v, v.c(1) - v.s), crawl(v, v.c(1) + np.abs(v.s))
    np.testing.assert_allclose(right, c.U1, rtol=1e-5, atol=1e-5)
    if row[2]:
        assert np.abs(printed / right - 1).max() > 0.03
    else:
        np.testing.assert_allclose(printed, right, rtol=1e-9)


def test_the_sum_gives_0_80_to_0_70_of_the_speed_from_a_fifth_to_two_fifths_of_a_pitch_up_an_involute() -> None:
    v = seen(path_of("spur(24,36)", "involute20"), True, 0.2, 0.999)
    ratio = crawl(v, v.c(1) + v.s) / v.crawl(1)
    np.testing.assert_allclose(np.interp(np.pi * np.array([0.2, 0.4]), v.X, ratio), [0.80, 0.70], atol=0.005)


@each(*SPUR, *BEVEL)
def test_what_53_to_55_and_62_make_uniform_is_the_stress_and_the_heat_of_the_path(row: Any) -> None:
    v, c = side(*row)
    force = np.sqrt(1 / v.slope[0] ** 2 + 1 / v.height(1) ** 2) * v.reach(1)
    np.testing.assert_allclose(force * (v.curvature(1) + v.curvature(2)), c.H, rtol=1e-6)
    S, rate = (np.sin(v.s), 1 / np.tan(v.R1) + 1 / np.tan(v.R2)) if v.bevel else (v.s, 1 / v.R1 + 1 / v.R2)
    relative = np.sqrt(force * (v.curvature(1) + v.curvature(2)))
    made, lasts = relative * rate * np.abs(S), np.sqrt(force / (v.curvature(1) + v.curvature(2))) / v.crawl(1)
    np.testing.assert_allclose(made * lasts, c.Q1, rtol=1e-6)  # (60) times (61) is (62)
    if row[1].startswith("UHS"):
        assert np.ptp(force * (v.curvature(1) + v.curvature(2))) < 1e-6 * c.H[0]
    if row[1] == "UT-b":
        hot = force * rate * np.abs(S) / v.crawl(2 if row[2] else 1)
        assert np.ptp(hot) < 1e-8 * hot[0]


# the long equations -------------------------------------------------------------------------------------------------

jets = st.tuples(st.floats(9, 13.5), st.floats(14, 60), st.floats(-200, 200))


@given(jets, st.floats(15, 80))
@settings(max_examples=40, deadline=None)
def test_56_is_what_the_cosine_of_33_makes_of_55_and_its_correction_what_the_sine_makes(jet: Any, R2: float) -> None:
    with mp.workdps(40):
        R1, wide, at = mp.mpf(12), mp.mpf(R2), tuple(map(mp.mpf, jet))
        H = 1 / (1 / R1 + 1 / wide)
        if abs(big_M(root_Q(R1, *at[:2], mp.sqrt), *at)) < 1:
            return
        true, wrong = (stress_55(R1, wide, *at, mp.sqrt, wrong=wrong) for wrong in (False, True))
        assert abs(corrected_56(R1, H, *at, mp.sqrt) / true - 1) < 1e-28
        assert abs(printed_56(R1, H, *at, mp.sqrt) / wrong - 1) < 1e-28
        assert abs(wrong / true - 1) > 1e-3


@given(jets, st.floats(15, 80))
@settings(max_examples=40, deadline=None)
def test_63_is_what_the_sum_in_45_makes_with_its_sign_turned_and_the_difference_makes_it_linear(
    jet: Any, R2: float
) -> None:
    with mp.workdps(40):
        R1, wide, at = mp.mpf(12), mp.mpf(R2), tuple(map(mp.mpf, jet))
        true, wrong = (loss_63(R1, wide, *at, mp.sqrt, opposite=opposite) for opposite in (False, True))
        assert abs(corrected_63(R1, wide, *at, mp.sqrt) - true) < 1e-28 * abs(true) + 1e-35
        assert abs(printed_63(R1, wide, *at, mp.sqrt) + wrong) < 1e-28 * abs(wrong) + 1e-35
        steps = [corrected_63(R1, wide, at[0], at[1], at[2] + k, mp.sqrt) for k in range(4)]
        assert abs(steps[0] - 2 * steps[1] + steps[2]) < 1e-30 * abs(steps[1]) + 1e-35
        bent = [printed_63(R1, wide, at[0], at[1], at[2] + k, mp.sqrt) for k in range(4)]
        assume(bent[1])  # where nothing is lost there is nothing to bend
        assert abs(bent[0] - 2 * bent[1] + bent[2]) > 1e-12 * abs(bent[1])


@pytest.mark.parametrize("shape", SHAPES[:3])
def test_on_finished_profiles_56_and_63_are_off_by_their_sign_and_more_and_corrected_they_hold(shape: str) -> None:
    v, c = side("spur(24,36)", shape, True)
    R1, R2, H = v.R1, v.R2, 1 / (1 / v.R1 + 1 / v.R2)
    jet = (v.r[0], v.slope[0], v.bend[0], np.sqrt)
    np.testing.assert_allclose(corrected_56(R1, H, *jet) * R1, c.H, rtol=3e-6)
    np.testing.assert_allclose(corrected_63(R1, R2, *jet) * R1 / v.along(1), c.Q1, rtol=1e-4)
    first, second = printed_56(R1, H, *jet) * R1 / c.H, printed_63(R1, R2, *jet) * R1 / v.along(1) / c.Q1
    assert np.all((first < -0.01) & (first > -0.4))
    assert np.all(second < -1.05)
    if shape == "involute20":
        at = np.pi * np.array([0.2, 0.25, 0.4, 0.475])  # in modules; a pitch is pi
        np.testing.assert_allclose(np.interp(at, v.X, first), [-0.267, -0.25, -0.201, -0.18], atol=0.003)
        np.testing.assert_allclose(np.interp(at, v.X, second), [-1.25, -1.30, -1.425, -1.48], atol=0.005)


# the extremal of (64) -----------------------------------------------------------------------------------------------


def lagrange(Z: Any, polynomial: list[Any]) -> Any:
    """The left side of (64) at theta = 0 on the curve r = sum of a_n theta^n."""

    def along(part: tuple[int, int, int]) -> Any:
        def value(theta: Any) -> Any:
            jets = [
                sum(mp.ff(n, order) * a * theta ** (n - order) for n, a in enumerate(polynomial) if n >= order)
                for order in range(3)
            ]
            return mp.diff(Z, tuple(jets), part)

        return value

    return along((1, 0, 0))(0) - mp.diff(along((0, 1, 0)), 0) + mp.diff(along((0, 0, 1)), 0, 2)


def test_64_is_of_the_second_order_with_the_right_z_and_of_the_fourth_with_the_printed_one() -> None:
    with mp.workdps(60):
        R1, R2 = mp.mpf(12), mp.mpf(18)
        right = lambda r, p, q: corrected_63(R1, R2, r, p, q, mp.sqrt)  # noqa: E731
        printed = lambda r, p, q: printed_63(R1, R2, r, p, q, mp.sqrt)  # noqa: E731
        start = [mp.mpf("12.5"), mp.mpf(31), mp.mpf(-14)]
        plain, bent = [*start, 0, 0], [*start, mp.mpf(25), mp.mpf(-40)]
        assert abs(lagrange(right, plain) - lagrange(right, bent)) < 1e-18 * abs(lagrange(right, plain))
        assert abs(lagrange(printed, plain) - lagrange(printed, bent)) > 1e-3 * abs(lagrange(printed, plain))


def test_the_first_integral_solves_64_with_the_right_z_and_not_with_the_printed_one() -> None:
    """R1 (r^2 - Q) = D r r', of which the curve d = D cos psi, X = D ln d is the closed form."""
    with mp.workdps(70):
        R1, R2, D = mp.mpf(12), mp.mpf(18), mp.mpf(2)

        def rises(r: Any) -> Any:
            return mp.findroot(lambda p: R1 * (r * r - root_Q(R1, r, p, mp.sqrt)) - D * r * p, mp.mpf(8))

        r0 = mp.mpf("12.4")
        p0 = rises(r0)
        coefficients = mp.taylor(rises, r0, 3)
        p, f1, f2, f3 = (c * mp.factorial(n) for n, c in enumerate(coefficients))
        second = f1 * p
        third = f2 * p**2 + f1 * second
        fourth = f3 * p**3 + 3 * f2 * p * second + f1 * third
        curve = [r0, p, second / 2, third / 6, fourth / 24]
        assert abs(p - p0) < 1e-40
        scale = abs(lagrange(lambda r, p, q: corrected_63(R1, R2, r, p, q, mp.sqrt), [r0, p, -second / 2, 0, 0]))
        assert abs(lagrange(lambda r, p, q: corrected_63(R1, R2, r, p, q, mp.sqrt), curve)) < 1e-15 * scale
        assert abs(lagrange(lambda r, p, q: printed_63(R1, R2, r, p, q, mp.sqrt), curve)) > 1e-6 * scale


# efficiency of trains, racks ----------------------------------------------------------------------------------------


def loss(pitch: PitchSurfaces, X: float) -> float:
    """Mean loss over mu of a 20 degree involute, from the definition by the midpoint rule over X."""
    made = forms.involute(X, np.radians(20))
    at = (np.arange(2000) + 0.5) / 1000 - 1
    contact = PathOfContact(pitch, made, made).at(at * X)
    slide = np.abs(contact.U1 - contact.U2)
    return float((slide / contact.cos_psi).mean())


def test_51_and_52_lose_by_the_sum_of_curvatures_and_not_by_ratio_and_reciprocal() -> None:
    G = 0.02
    pairs = [(1.0, 1.0), (1.0, 3.0), (2.0, 2.0), (1.0, 10.0)]
    spur = [loss(PitchSurfaces(100, 100, *pair), G) / (1 / pair[0] + 1 / pair[1]) for pair in pairs]
    assert max(spur) / min(spur) == pytest.approx(1, abs=1e-9)
    printed = [loss(PitchSurfaces(100, 100, a, b), G) / (a / b + b / a) for a, b in pairs]
    assert max(printed) / min(printed) > 9
    cones = [(0.3, 0.4), (0.3, 1.2), (0.9, 0.6)]
    bevel = [loss(PitchSurfaces(100, 100, a, b, True), G) / (1 / np.tan(a) + 1 / np.tan(b)) for a, b in cones]
    assert max(bevel) / min(bevel) == pytest.approx(1, abs=1e-9)
    printed = [
        loss(PitchSurfaces(100, 100, a, b, True), G) / (np.sin(a) / np.sin(b) + np.sin(b) / np.sin(a)) for a, b in cones
    ]
    assert max(printed) / min(printed) > 2


def test_the_thresholds_of_section_16_follow_from_51_and_vanish_with_its_correction() -> None:
    assert pytest.approx(33, abs=0.01) == (10**3 + 10**-3) / (3 * (10 + 0.1))  # as printed, 1000 to 1
    X = (2 + 3**0.5) ** 0.5
    assert pytest.approx(3 * (X + 1 / X)) == X**3 + X**-3
    assert pytest.approx(7.21, abs=0.005) == X**3
    two = (1 + 3**0.5 + (2 * 3**0.5) ** 0.5) / 2
    assert two**2 + two**-2 == pytest.approx(2 * (two + 1 / two))
    assert two**2 == pytest.approx(5.27, abs=0.005)
    for ratio in (2.0, 7.21, 1000.0):
        idlers = [1 / 20 + 1 / (20 * ratio) + n * 2 / 100 for n in range(3)]
        stages = [n * (1 + ratio ** (-1 / n)) for n in range(1, 9)]
        assert all(a < b for a, b in pairwise(idlers))
        assert all(a < b for a, b in pairwise(stages))


def test_forty_five_degrees_are_best_at_one_height_and_no_better_at_one_arc() -> None:
    """Footnote 6: a rack's loss is X^2 / 2 over the arc X."""
    tilts = np.radians([14.5, 20.0, 30.0, 45.0, 60.0])
    arcs = 0.5 / (np.sin(tilts) * np.cos(tilts))  # d sin psi = 0.5
    np.testing.assert_allclose(arcs**2 / 2, 0.5 / np.sin(2 * tilts) ** 2, rtol=1e-14)
    assert int(np.argmin(arcs**2 / 2)) == 3
    for tilt in tilts:
        made = forms.involute(1.0, float(tilt))
        d = (np.arange(4000) + 0.5) / 4000 * made.end
        assert float((d / np.cos(tilt) ** 2).mean() * made.end) == pytest.approx(0.5, rel=1e-12)
