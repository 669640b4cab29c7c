"""Closed forms of the source and beside it: pin gear, least friction, bounds, friction without approximation."""

from __future__ import annotations

import json
from math import asin, atan2, cos, degrees, hypot, log, pi, radians, sin, tan
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from places import DATA
from scipy.optimize import brentq, minimize

from geartrain.teeth.conjugate import optimal_sides as forms
from geartrain.teeth.conjugate.path_of_contact import PathOfContact
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

TABLES = json.loads((DATA / "tooth_shapes.json").read_text(encoding="utf-8"))

# pin gear, equations (12) to (16) ------------------------------------------------------------------------------------

PIN = [
    (0.800065858258, 0.0, 1.27334436141, -0.799473251029, -0.026661179066),
    (1.585464021655, 0.784951548874, 2.52334436141, -0.808052141988, 0.032979990511),
    (2.370862185053, 1.569148746650, 3.77334436141, -0.840450564573, 0.175148260367),
    (3.156260348450, 2.352218357937, 5.02334436141, -0.910945963113, 0.395412293084),
    (3.941658511847, 3.133787684008, 6.27334436141, -1.033145996983, 0.687461193154),
]


def pin(X: Any, R1: Any, R2: Any, A: Any, B: Any, lib: Any = mp) -> tuple[Any, Any, Any]:
    """C, and Cartesian coordinates of the contact, equations (12) and (13), mirrored so that X > 0 moves along +x."""
    C = lib.sqrt(A * A + R2 * R2 - 2 * A * R2 * lib.cos(X / R2)) - B
    part = C / (C + B)
    return C, part * A * lib.sin(X / R2), part * (R2 - A * lib.cos(X / R2))


@pytest.mark.parametrize("row", PIN, ids=lambda row: f"X = {row[0]:.3g}")
def test_the_mate_of_a_pin_gear_is_that_of_the_table(row: tuple[float, ...]) -> None:
    R1, R2, B = 12.0, 18.0, 0.8
    X, d, psi, x1, y1 = row
    C, x, y = pin(X, R1, R2, R2, B, mp)
    assert float(C) == pytest.approx(d, abs=2e-12)
    assert degrees(X / R2 / 2) == pytest.approx(psi, abs=2e-11)
    turned = complex(float(x), float(y) + R1) * np.exp(1j * X / R1) - 1j * R1
    assert (turned.real, turned.imag) == (pytest.approx(x1, abs=2e-12), pytest.approx(y1, abs=2e-12))
    # (15) and (16), multiplied by C / (C + B): modulus and argument of the point about its own centre
    part = d / (d + B)
    r2 = (part * R2) ** 2 + (R1 + part * R2) ** 2 - 2 * (R1 + R2 * part) * part * R2 * cos(X / R2)
    assert r2**0.5 == pytest.approx(hypot(x1, y1 + R1), abs=1e-11)
    theta = atan2(part * R2 * sin(X / R2), R1 + part * (R2 - R2 * cos(X / R2))) - X / R1
    assert theta == pytest.approx(atan2(x1, y1 + R1), abs=1e-12)


def test_the_pin_touches_its_mate_at_its_own_radius_and_along_the_normal_through_the_pitch_point() -> None:
    R1, R2, A, B = map(mp.mpf, ("12", "18", "17.3", "0.8"))
    with mp.workdps(30):
        for X in map(mp.mpf, ("1.6", "2.4", "3.9")):
            C, x, y = pin(X, R1, R2, A, B)
            centre = mp.mpc(A * mp.sin(X / R2), R2 - A * mp.cos(X / R2))
            assert abs(abs(mp.mpc(x, y) - centre) - B) < 1e-27
            assert abs(mp.im(mp.mpc(x, y) * mp.conj(centre))) < 1e-27

            def body(t: Any) -> Any:
                _, u, v = pin(t, R1, R2, A, B)
                return (mp.mpc(u, v + R1)) * mp.expj(t / R1)

            along = mp.diff(body, X) * mp.expj(-X / R1)  # tangent of the mate in the fixed frame
            assert abs(mp.re(along * mp.conj(centre))) < 1e-15 * abs(along) * abs(centre)
            bend = mp.diff(body, X, 2) * mp.expj(-X / R1)
            curvature = abs(mp.im(mp.conj(along) * bend)) / abs(along) ** 3
            tilt = mp.im(centre) / abs(centre)
            assert abs(1 / curvature - abs(C + 1 / ((1 / R1 + 1 / R2) / tilt - 1 / (C + B)))) < 1e-9


def test_the_loss_of_a_pin_gear_has_its_closed_form() -> None:
    R1, R2, B, p = 12.0, 18.0, 0.8, pi
    first = 2 * R2 * asin(B / (2 * R2))
    x, weights = np.polynomial.legendre.leggauss(40)
    X = first + p * (x + 1) / 2
    summed = float(weights @ ((2 * R2 * np.sin(X / 2 / R2) - B) / np.cos(X / 2 / R2))) * p / 2

    def closed(u: float) -> float:
        return -4 * R2**2 * log(cos(u)) - 2 * R2 * B * log(tan(pi / 4 + u / 2))

    J = closed((first + p) / (2 * R2)) - closed(first / (2 * R2))
    assert pytest.approx(summed, rel=1e-13) == J
    assert (1 / R1 + 1 / R2) * J / p == pytest.approx(0.21858548634509, abs=5e-14)


def test_a_pin_gear_is_undercut_in_approach_only_where_its_curvature_ends() -> None:
    R1, R2, B = 12.0, 18.0, 0.8

    def c1(tilt: float) -> float:
        return 2 * R2 * sin(tilt) - B + 1 / ((1 / R1 + 1 / R2) / sin(tilt) - 1 / (2 * R2 * sin(tilt)))

    pitch_point = asin(B / (2 * R2))
    ends = brentq(c1, 1e-4, pitch_point)
    assert sin(ends) == pytest.approx(B * (R1 + 2 * R2) / (4 * R2 * (R1 + R2)), rel=1e-9)
    assert ends < pitch_point
    assert c1(0.2) == pytest.approx(4 * R2 * (R1 + R2) / (R1 + 2 * R2) * sin(0.2) - B, rel=1e-12)
    assert all(c1(tilt) > 0 for tilt in np.linspace(pitch_point, 1.2, 50))


# least friction as the source states it ------------------------------------------------------------------------------

EXTREMAL = [
    (0.0, 0.347296355334, 80, (0.060307379214, 0.342020143326), (0.060307379214, 0.342020143326), 0.9831302571,
     0.9348946522),
    (1.355676698188, 0.684040286651, 70, (-1.192793952200, 0.588568478339), (-1.072737046137, 0.674389119142),
     0.8722108263, 0.7772052309),
    (2.115153627150, 1.0, 60, (-1.763824080421, 0.754353543169), (-1.512205979036, 0.925565352237), 0.6606836025,
     0.5217947136),
    (2.617566146592, 1.285575219373, 50, (-2.003204552914, 0.855942642846), (-1.648013640778, 1.044656430021),
     0.3338128652, 0.1552607514),
]  # fmt: skip


@pytest.mark.parametrize("row", EXTREMAL, ids=lambda row: f"{row[2]} deg")
def test_the_extremal_of_friction_is_that_of_the_table(row: Any) -> None:
    X, d, psi, first, second, U1, U2 = row
    D, R1, R2, tilt = 2.0, 12.0, 18.0, radians(psi)
    assert D * cos(tilt) == pytest.approx(d, abs=1e-12)
    assert D * log(d / (D * cos(radians(80)))) == pytest.approx(X, abs=3e-12)
    P = d * np.exp(1j * tilt)
    for found, points in (
        ((P + 1j * R1) * np.exp(1j * X / R1) - 1j * R1, first),
        ((P - 1j * R2) * np.exp(-1j * X / R2) + 1j * R2, second),
    ):
        assert (found.real, found.imag) == tuple(pytest.approx(each, abs=2e-12) for each in points)
    w = -cos(2 * tilt) / sin(tilt)
    assert (w + d / R1, w - d / R2) == (pytest.approx(U1, abs=1e-10), pytest.approx(U2, abs=1e-10))
    x, y = P.real, P.imag
    assert (x - D / 2) ** 2 + y**2 == pytest.approx(D**2 / 4, abs=1e-12), "a circle centred on the pitch tangent"


@given(st.lists(st.floats(-1, 1), min_size=4, max_size=4), st.booleans())
@settings(max_examples=30, deadline=None)
def test_no_other_way_between_its_ends_rubs_less_than_the_extremal(waves: list[float], bevel: bool) -> None:
    D, first, last = (0.9, 0.12, 0.55) if bevel else (2.0, 0.35, 1.3)
    S, primitive = (np.sin, lambda d: np.log(np.tan(d / 2))) if bevel else (lambda d: d, np.log)
    x, weights = np.polynomial.legendre.leggauss(60)
    d = first + (last - first) * (x + 1) / 2
    scale = (last - first) / 2
    slope = D / S(d)
    bump = sum(a * (n + 1) * np.cos((n + 1) * np.pi * (x + 1) / 2) for n, a in enumerate(waves)) / scale
    X = D * (primitive(last) - primitive(first))
    least = float(weights @ (S(d) * slope**2)) * scale
    assert least == pytest.approx(X**2 / (primitive(last) - primitive(first)), rel=1e-12)
    assert float(weights @ (S(d) * (slope + 0.3 * bump) ** 2)) * scale >= least * (1 - 1e-9)


# the bound in a window of pressure angles ----------------------------------------------------------------------------

WINDOWS = [
    (0, 20, 0.969836881841), (14.5, 20, 0.985303326879), (14.5, 30, 0.947207237017), (0, 30, 0.932904989785),
    (0, 45, 0.852306532505), (0, 60, 0.742625584831),
]  # fmt: skip


def bound(pitch: PitchSurfaces, X: float, low: float, high: float) -> float:
    """Least J over that of the 20 degree involute, from the three phases."""
    u0, u1 = cos(high), cos(low)
    if not pitch.bevel:
        return 1 / (1 + log(u1 / u0) / 2)

    def phases(pull: float) -> tuple[float, float, float, float]:
        d1, d2, D = asin(pull / 2 * u0), asin(pull / 2 * u1), asin(min(pull * u1, 1.0))
        return d1, d2, D, log(tan(d2 / 2) / tan(d1 / 2))

    def off(pull: float) -> float:
        d1, d2, D, part = phases(pull)
        return d1 / u0 + pull / 2 * part + (D - d2) / u1 - X

    pull = brentq(off, 1e-3 * X, 2 * X, xtol=1e-16)
    d1, d2, D, part = phases(pull)
    J = (1 - cos(d1)) / u0**2 + pull**2 / 4 * part + (cos(d2) - cos(D)) / u1**2
    return J / ((1 - cos(X * cos(radians(20)))) / cos(radians(20)) ** 2)


def transcribed(pitch: PitchSurfaces, X: float, low: float, high: float, cells: int = 600) -> float:
    """The least J of paths whose pressure angle is constant in each of many equal cells of X, found by descent."""
    h = X / cells
    whole = (lambda d: 1 - np.cos(d)) if pitch.bevel else (lambda d: d * d / 2)
    S = np.sin if pitch.bevel else (lambda d: d)

    def cost(c: Any) -> tuple[float, Any]:
        d = np.concatenate([[0.0], np.cumsum(c * h)])
        part = np.diff(whole(d))
        by_d = np.zeros(cells + 1)
        by_d[1:] += S(d[1:]) / c**2
        by_d[:-1] -= S(d[:-1]) / c**2
        later = np.cumsum(by_d[::-1])[::-1]
        return float((part / c**2).sum()) / X**2, (-2 * part / c**3 + h * later[1:]) / X**2

    start = np.linspace(cos(high), cos(low), cells)
    found = minimize(
        cost, start, jac=True, method="L-BFGS-B", bounds=[(cos(high), cos(low))] * cells,
        options={"maxiter": 3000, "maxfun": 6000, "ftol": 1e-15, "gtol": 1e-10},
    )  # fmt: skip
    return float(found.fun) * X**2


@pytest.mark.parametrize(("low", "high", "printed"), WINDOWS)
def test_the_bound_of_a_window_is_that_of_the_table_and_of_a_direct_search(
    low: float, high: float, printed: float
) -> None:
    pitch, X = PitchSurfaces.spur(24, 36), pi / 2
    least = bound(pitch, X, radians(low), radians(high))
    assert least == pytest.approx(printed, abs=6e-13)
    found = transcribed(pitch, X, radians(low), radians(high)) / (X**2 / 2)
    assert -1e-12 <= found / least - 1 < 1e-5


@pytest.mark.parametrize("row", TABLES["bounds"], ids=lambda row: row[0])
def test_the_bounds_of_all_pairs_are_those_of_the_table(row: list[str]) -> None:
    kind, teeth = row[0][:-1].split("(")
    z1, z2 = map(int, teeth.split(","))
    pitch = PitchSurfaces.spur(z1, z2) if kind == "spur" else PitchSurfaces.cones(z1, z2)
    for high, printed in ((20, row[1]), (25, row[2])):
        least = bound(pitch, pitch.p / 2, 0.0, radians(high))
        assert least == pytest.approx(float(printed), abs=2e-13)
    if row[0] == "bevel(24,36)":
        X = pitch.p / 2
        involute = (1 - cos(X * cos(radians(20)))) / cos(radians(20)) ** 2
        found = transcribed(pitch, X, 0.0, radians(25)) / involute
        assert -1e-12 <= found / least - 1 < 1e-5


# friction without approximation, and how much there is ---------------------------------------------------------------


def balanced(d: float, psi: float, R1: float, R2: float, mu: float) -> float:
    """Share of power lost at one instant: forces and arms as vectors, friction against the sliding."""
    P, n, t = d * np.exp(1j * psi), np.exp(1j * psi), 1j * np.exp(1j * psi)
    O1, O2, w1, w2 = -1j * R1, 1j * R2, -1 / R1, 1 / R2  # the pitch point moves along +x

    def cross(a: complex, b: complex) -> float:
        return (a.conjugate() * b).imag

    slides = (1j * w1 * (P - O1) - 1j * w2 * (P - O2)).conjugate() * t  # velocity of gear 1 over gear 2, along t
    force = n + mu * np.sign(slides.real) * t  # of gear 1 on gear 2
    put_in, taken = cross(P - O1, force) * w1, cross(P - O2, force) * w2
    return float(1 - taken / put_in)


@given(st.floats(0.05, 2.0), st.floats(5, 40), st.integers(10, 60), st.integers(10, 200), st.floats(0.001, 0.3))
@settings(max_examples=80, deadline=None)
def test_the_loss_at_an_instant_is_that_of_the_balance_of_torques(
    d: float, tilt: float, z1: int, z2: int, mu: float
) -> None:
    A, B, psi = 2 / z1, 2 / z2, radians(tilt)
    recess = mu * (A + B) * d / (cos(psi) + mu * (sin(psi) + A * d))
    approach = mu * (A + B) * d / (cos(psi) - mu * (sin(psi) - A * d))
    assert balanced(d, psi, 1 / A, 1 / B, mu) == pytest.approx(recess, rel=1e-11)
    assert balanced(-d, psi, 1 / A, 1 / B, mu) == pytest.approx(approach, rel=1e-11)
    small = mu * (A + B) * d / cos(psi)
    assert abs(recess / small - 1) < mu * (tan(psi) + 2 * d)
    if sin(psi) > A * d:
        assert recess < small < approach


@pytest.mark.parametrize(("mu", "percent"), [(0.0112, 0.122), (0.0385, 0.420), (0.0517, 0.564)])
def test_an_involute_of_24_and_36_teeth_loses_as_told_at_the_measured_coefficients(mu: float, percent: float) -> None:
    made = forms.involute(pi / 2, radians(20))
    X = (np.arange(4000) + 0.5) / 4000 * pi - pi / 2
    contact = PathOfContact(PitchSurfaces.spur(24, 36), made, made).at(X)
    slide = float((np.abs(contact.U1 - contact.U2) / contact.cos_psi).mean())
    assert 100 * mu * slide == pytest.approx(percent, abs=5e-4)
    assert mu * slide == pytest.approx(mu * pi / 2 * (1 / 24 + 1 / 36), rel=1e-6)


def test_tooth_friction_alone_leaves_98_4_percent_at_least_from_twelve_teeth() -> None:
    assert 100 * 0.061 * pi / 2 * (1 / 12 + 1 / 12) == pytest.approx(1.6, abs=0.01)
    assert 100 * 0.0112 * pi / 2 / 24 == pytest.approx(0.07, abs=0.005)


# involutes, equations (4) and (5) ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "pitch", [PitchSurfaces.spur(24, 36), PitchSurfaces.cones(24, 36), PitchSurfaces.cones(15, 45)], ids=str
)
def test_the_flank_of_an_involute_is_the_string_of_equations_4_and_5(pitch: PitchSurfaces) -> None:
    psi = radians(20)
    made = forms.involute(pitch.p / 2, psi)
    X = np.linspace(-0.5, 0.5, 41) * pitch.p
    points = PathOfContact(pitch, made, made).flank1(X)
    R = pitch.R1
    if pitch.bevel:
        high = points[:, 1] * cos(R) + points[:, 2] * sin(R)
        r, theta = np.arccos(-points[:, 1] * sin(R) + points[:, 2] * cos(R)), np.arctan2(points[:, 0], high)
        base = asin(sin(R) * cos(psi))
        string = np.arccos(np.cos(r) / cos(base)) / sin(base) - np.arccos(tan(base) / np.tan(r))
    else:
        r, theta = np.hypot(points[:, 0], points[:, 1] + R), np.arctan2(points[:, 0], points[:, 1] + R)
        base = R * cos(psi)
        string = np.sqrt((r / base) ** 2 - 1) - np.arccos(base / r)
    assert np.ptp(string + theta) < 3e-13
