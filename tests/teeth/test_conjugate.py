"""Conjugate teeth from their path of contact: tables worked out by other ways to twelve digits, and identities."""

from __future__ import annotations

import json
import re
from functools import cache
from math import asin, cos, degrees, inf, log, pi, radians, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from places import DATA

from geartrain.numerics.roots import root
from geartrain.teeth.conjugate import optimal_sides as forms
from geartrain.teeth.conjugate.closed_form_sides import cycloid
from geartrain.teeth.conjugate.path_costs import PathCosts, height, measure, sliding_integral
from geartrain.teeth.conjugate.path_of_contact import PathOfContact, PathSide
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

TABLES = json.loads((DATA / "tooth_shapes.json").read_text(encoding="utf-8"))
PERFORMANCE = {(row[0], row[1]): row[2:] for row in TABLES["performance"]}


def pitch_of(name: str) -> PitchSurfaces:
    """`spur(24,36)`, `bevel(24,36)` at right angles."""
    kind, z1, z2 = re.fullmatch(r"(\w+)\((\d+),(\d+)\)", name).groups()  # type: ignore[union-attr]
    return PitchSurfaces.spur(int(z1), int(z2)) if kind == "spur" else PitchSurfaces.cones(int(z1), int(z2))


def involute(pitch: PitchSurfaces) -> PathOfContact:
    side = forms.involute(pitch.p / 2, radians(20))
    return PathOfContact(pitch, side, side)


@cache
def involute_costs(pair: str) -> PathCosts:
    return measure(involute(pitch_of(pair))).one_pair


@cache
def heated(pair: str, reading: str) -> tuple[float, PathOfContact]:
    """Uniform heat with the working depth of the involute: its Q*, by solving for the depth, and its path."""
    pitch = pitch_of(pair)
    A, B, X = pitch.A, pitch.B, pitch.p / 2
    depth = measure(involute(pitch)).depth

    def path(Q: float) -> PathOfContact:
        gamma = (A + B) / Q
        first, second = (A, -A) if reading == "a" else (A, B)
        return PathOfContact(
            pitch, forms.uniform_heat(pitch, first, gamma, X), forms.uniform_heat(pitch, second, gamma, X)
        )

    def off(Q: float) -> float:
        found = path(Q)
        return height(pitch, found.approach) + height(pitch, found.recess) - depth

    Q = root(off, 0.2, 0.9, off(0.2), off(0.9))
    return Q, path(Q)


@cache
def path_of(pair: str, shape: str) -> PathOfContact:
    """The path of one row of the tables."""
    pitch = pitch_of(pair)
    A, B, X = pitch.A, pitch.B, pitch.p / 2
    numbers = [float(text) for text in re.findall(r"=([\d.]+)", shape)]
    if shape.startswith("involute"):
        return involute(pitch)
    if shape.startswith("UHS"):
        psi = radians(numbers[0])
        sides = (forms.uniform_stress(pitch, a, b, X, psi) for a, b in ((B, A), (A, B)))
        return PathOfContact(pitch, *sides)
    if shape.startswith(("UT-a", "UT-b")):
        return heated(pair, shape[3])[1]
    if shape.startswith("UT-c"):
        gamma = (A + B) / (1.25 * heated(pair, "b")[0])
        return PathOfContact(pitch, *(forms.bounded_heat(pitch, b, gamma, X, radians(12)) for b in (A, B)))
    psi, u = radians(numbers[0]), numbers[1]
    return PathOfContact(pitch, *(forms.least_friction(pitch, b, X, psi, u) for b in (A, B)))


def tilt(side: PathSide) -> float:
    return degrees(asin(float(side.sin_psi(np.array(side.end)))))


def close(value: float, printed: str, units: float = 1.0) -> bool:
    """Within `units` of the last digit printed, and a part in 10^12."""
    if printed == "inf":
        return value == inf
    digits = len(printed.partition(".")[2])
    return abs(value - float(printed)) <= units * 10.0**-digits + 1e-12 * abs(value)


@pytest.mark.parametrize("row", TABLES["geometry"], ids=lambda row: f"{row[0]} {row[1]}")
def test_the_ends_of_a_path_are_those_of_the_table(row: list[str]) -> None:
    path = path_of(row[0], row[1])
    sides = (path.approach, path.recess)
    found = [*(side.end for side in sides), *map(tilt, sides), *(height(path.pitch, side) for side in sides)]
    assert all(close(value, printed, 2) for value, printed in zip(found, row[2:], strict=True)), (found, row)


@pytest.mark.parametrize("row", TABLES["performance"], ids=lambda row: f"{row[0]} {row[1]}")
def test_loss_stress_heat_and_flash_are_those_of_the_table(row: list[str]) -> None:
    path = path_of(row[0], row[1])
    found = measure(path)
    over = found.one_pair.over(involute_costs(row[0]))
    costs = (over[name] for name in ("loss", "stress", "off_pitch", "heat", "flash"))
    values = (found.one_pair.loss, *costs, found.slowest)
    assert all(close(value, printed, 3) for value, printed in zip(values, row[2:], strict=True)), (values, row)


@pytest.mark.parametrize("pair", dict.fromkeys(row[0] for row in TABLES["geometry"]))
@pytest.mark.parametrize("reading", ["a", "b"])
def test_uniform_heat_at_the_depth_of_the_involute_has_the_heat_of_the_table(pair: str, reading: str) -> None:
    shape = next(row[1] for row in TABLES["geometry"] if row[0] == pair and row[1].startswith(f"UT-{reading}"))
    assert close(heated(pair, reading)[0], shape.partition("=")[2], 1)


@pytest.mark.parametrize("row", TABLES["bounds"], ids=lambda row: row[0])
def test_the_involute_has_the_loss_stress_and_heat_of_the_table(row: list[str]) -> None:
    found = involute_costs(row[0])
    for value, printed in zip((found.loss, found.stress**2, found.heat), row[3:], strict=True):
        assert close(value, printed, 1)


SHAPES = {"UHS20": "UHS psi0=20", "UT-b": "UT-b", "MF25": "MF psi_hi=25 u=0.15"}


@pytest.mark.parametrize("row", TABLES["profiles"], ids=lambda row: f"{row[0]} {row[1]}")
def test_points_of_the_profiles_are_those_of_the_table(row: list[str]) -> None:
    name, pair = row[0].rsplit(" ", 1)
    pitch = pitch_of(pair)
    if name.startswith("UT"):
        gamma = (pitch.A + pitch.B) / 0.4
        path = PathOfContact(pitch, *(forms.uniform_heat(pitch, b, gamma, pitch.p / 2) for b in (pitch.A, pitch.B)))
    else:
        path = path_of(pair, next(shape for key, shape in SHAPES.items() if name.startswith(key)))
    X = np.array([float(row[1]) * pitch.p])
    contact = path.at(X)
    assert close(float(contact.d[0]), row[2], 2)
    assert close(float(np.degrees(contact.psi[0])), row[3], 2)
    for points, printed in ((path.flank1(X), row[4]), (path.flank2(X), row[5])):
        for value, text in zip(points[0], printed.split(","), strict=False):
            assert close(float(value), text.strip(), 2)
    for value, text in ((contact.k1[0], row[6]), (contact.k2[0], row[7])):
        assert text == "-" or close(float(value), text, 2)


# what no table is needed for -----------------------------------------------------------------------------------------


@given(
    st.integers(8, 200),
    st.integers(8, 200),
    st.floats(12, 35),
    st.booleans(),
    st.sampled_from(["stress", "heat", "friction", "involute"]),
)
@settings(max_examples=40, deadline=None)
def test_every_path_obeys_the_fundamental_law_and_euler_savary(
    z1: int, z2: int, tilted: float, bevel: bool, shape: str
) -> None:
    pitch = PitchSurfaces.cones(z1, z2) if bevel else PitchSurfaces.spur(z1, z2)
    # with few teeth a path of uniform heat comes to a right angle before it has travelled 0.4 pitches
    part = 0.3 if shape == "heat" and min(z1, z2) < 12 else 0.4
    A, B, X, psi = pitch.A, pitch.B, pitch.p * part, radians(tilted)
    make = {
        "stress": lambda a, b: forms.uniform_stress(pitch, a, b, X, psi),
        "heat": lambda a, b: forms.uniform_heat(pitch, b, 3 * (A + B), X),
        "friction": lambda a, b: forms.least_friction(pitch, b, X, psi, 0.12),
        "involute": lambda a, b: forms.involute(X, psi),
    }[shape]
    path = PathOfContact(pitch, make(B, A), make(A, B))
    at = np.array([-0.9, -0.6, -0.3, 0.3, 0.6, 0.9]) * X
    c = path.at(at)
    step = 1e-5 * X
    before, after = path.at(at - step), path.at(at + step)
    np.testing.assert_allclose((after.d - before.d) / (2 * step), c.cos_psi, rtol=1e-6)
    np.testing.assert_allclose(c.U1 - c.U2, (A + B) * pitch.S(c.d), rtol=1e-9, atol=1e-12 * X)
    np.testing.assert_allclose(c.k1 - c.k2, c.kr, rtol=1e-7)
    c1, c2 = (np.arctan2(1, c.k1), np.arctan2(1, -c.k2)) if bevel else (1 / c.k1, -1 / c.k2)
    savary = 1 / np.tan(c1 - c.d) + 1 / np.tan(c2 + c.d) if bevel else 1 / (c1 - c.d) + 1 / (c2 + c.d)
    np.testing.assert_allclose(savary, (A + B) / c.sin_psi, rtol=1e-6)
    for flank, speed in ((path.flank1, c.U1), (path.flank2, c.U2)):
        moved = np.linalg.norm(flank(at + step) - flank(at - step), axis=-1) / (2 * step)
        np.testing.assert_allclose(moved, np.abs(speed), rtol=1e-5)


@given(st.integers(6, 300), st.integers(6, 300), st.floats(5, 40), st.floats(0.1, 0.6))
@settings(max_examples=40, deadline=None)
def test_the_loss_of_an_involute_has_its_closed_form(z1: int, z2: int, psi: float, arc: float) -> None:
    pitch = PitchSurfaces.spur(z1, z2)
    side = forms.involute(arc * pitch.p, radians(psi))
    assert sliding_integral(pitch, side) == pytest.approx((arc * pitch.p) ** 2 / 2, rel=1e-13)
    bevel = PitchSurfaces.cones(z1, z2)
    side, X = forms.involute(arc * bevel.p, radians(psi)), arc * bevel.p
    assert sliding_integral(bevel, side) == pytest.approx(
        2 * sin(X * cos(radians(psi)) / 2) ** 2 / cos(radians(psi)) ** 2, rel=1e-12
    )


@pytest.mark.parametrize(("low", "high", "bound"), [(0, 20, 0.969836881841), (14.5, 20, 0.985303326879)])
def test_no_friction_shape_beats_the_bound_of_its_window(low: float, high: float, bound: float) -> None:
    pitch = PitchSurfaces.spur(24, 36)
    X = pitch.p / 2
    assert 1 / (1 + log(cos(radians(low)) / cos(radians(high))) / 2) == pytest.approx(bound, abs=5e-13)
    for u in (0.02, 0.05, 0.1, 0.2):
        side = forms.least_friction(pitch, pitch.B, X, radians(high), u)
        if tilt(side) >= low:
            assert sliding_integral(pitch, side) > bound * X**2 / 2


def test_the_least_friction_side_is_that_of_the_table_and_least_among_its_neighbours() -> None:
    pitch = PitchSurfaces.spur(24, 36)
    X = pi / 2
    for psi, u, first, end, last, ratio in (
        (25, 0.15, 0.3563150801726, 1.4803921288308, 14.73543682791, 0.9725332410128),
        (20, 0.10, 0.3672796542913, 1.5142793004044, 11.43694602833, 0.9820097357278),
    ):
        side = forms.least_friction(pitch, pitch.B, X, radians(psi), u)
        assert side.joints == (pytest.approx(first, abs=2e-13), pytest.approx(end, abs=2e-13))
        assert tilt(side) == pytest.approx(last, abs=2e-11)
        assert sliding_integral(pitch, side) / (X**2 / 2) == pytest.approx(ratio, abs=2e-13)


def test_a_cycloid_loses_more_than_the_involute_by_the_closed_form() -> None:
    pitch = PitchSurfaces.spur(24, 36)
    X, rho = pi / 2, 4.5
    closed = -4 * rho**2 * log(cos(X / (2 * rho)))
    assert sliding_integral(pitch, cycloid(pitch, X, rho)) == pytest.approx(closed, rel=1e-13)
    assert closed / (X**2 / 2) == pytest.approx(1.005118582955953, abs=1e-13)


def test_bevel_tends_to_spur_with_the_square_of_the_cone_angle() -> None:
    def off(size: float) -> float:
        cones = PitchSurfaces(24, 36, 24 / 36 * size, size, True)
        scale = cones.R1 / 12
        flat, psi, X = PitchSurfaces.spur(24, 36), radians(20), cones.p / 2
        side = forms.uniform_stress(cones, cones.A, cones.B, X, psi)
        plain = forms.uniform_stress(flat, flat.A, flat.B, X / scale, psi)
        return abs(side.end / scale - plain.end) / plain.end

    assert off(0.018) / off(0.009) == pytest.approx(4, abs=0.02)
    assert off(0.009) / off(0.0045) == pytest.approx(4, abs=0.02)


def test_uniform_stress_is_uniform_and_never_undercuts_from_five_teeth_to_a_hundred_thousand() -> None:
    for z1, z2, tilted in ((5, 5, 20), (5, 1000, 20), (12, 100_000, 1), (40, 40, 44), (100_000, 100_000, 20)):
        pitch, psi = PitchSurfaces.spur(z1, z2), radians(tilted)
        A, B, X = pitch.A, pitch.B, 0.3 * pitch.p
        sides = (forms.uniform_stress(pitch, a, b, X, psi) for a, b in ((B, A), (A, B)))
        path = PathOfContact(pitch, *sides)
        c = path.at(np.linspace(-0.3, 0.3, 61) * pitch.p)
        assert np.ptp(c.H) <= 2e-12 * c.H.max()
        assert min(c.U1.min(), c.U2.min()) > 0
        assert c.H[30] == pytest.approx(2 * (pitch.A + pitch.B) / sin(2 * psi), rel=1e-12)
