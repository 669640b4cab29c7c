"""Conjugate teeth from their path of contact: tables worked out by other ways to twelve digits, and identities."""

from __future__ import annotations

import json
import re
from functools import cache, partial
from math import acos, asin, cos, degrees, hypot, inf, log, pi, radians, sin, tan
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from places import DATA
from scipy.optimize import brentq

from geartrain.teeth import Cycloidal, Involute, LeastFriction, UniformStress, UniformTemperature
from geartrain.teeth.conjugate import ConjugatePair, PathLosses, PathOfContact, WheelPair, measure
from geartrain.teeth.conjugate.admissibility import tooth_thickness

TABLES = json.loads((DATA / "tooth_shapes.json").read_text(encoding="utf-8"))
Wheels = tuple[int, int, float | None]


def wheels_of(name: str) -> Wheels:
    """`spur(24,36)`, `bevel(24,36)` at right angles: teeth of both, and the shaft angle."""
    kind, z1, z2 = re.fullmatch(r"(\w+)\((\d+),(\d+)\)", name).groups()  # type: ignore[union-attr]
    return int(z1), int(z2), pi / 2 if kind == "bevel" else None


def path(form: type, wheels: Wheels, **given: Any) -> PathOfContact:
    """The path of contact of a form, by default with half a pitch of approach and of recess."""
    z1, z2, angle = wheels
    return form.declared(given).path(z1, z2, shaft_angle=angle)


def involute_pair(wheels: Wheels, psi: float, arcs: tuple[float, float]) -> ConjugatePair:
    """Arcs in pitches, pressure angle in degrees."""
    z1, z2, angle = wheels
    given = {"pressure_angle": f"{psi!r} deg"}
    return Involute.pair_of_arcs(WheelPair(z1, z2, shaft_angle=angle), arcs, given)


def involute(wheels: Wheels, psi: float = 20, arcs: tuple[float, float] = (0.5, 0.5)) -> PathOfContact:
    return involute_pair(wheels, psi, arcs).path


@cache
def involute_costs(pair: str) -> PathLosses:
    return measure(involute(wheels_of(pair))).one_pair


@cache
def heat_of(pair: str, reading: str) -> float:
    """Heat per area of teeth of uniform temperature, as deep as the involute: of gear 1 (a), or of the hotter (b)."""
    contact = path(UniformTemperature, wheels_of(pair), reading=reading).at([0.3 * pi / 24])
    return float(contact.Q1[0] if reading == "a" else max(contact.Q1[0], contact.Q2[0]))


@cache
def path_of(pair: str, shape: str) -> PathOfContact:
    """The path of one row of the tables."""
    wheels = wheels_of(pair)
    numbers = re.findall(r"=([\d.]+)", shape)
    if shape.startswith("involute"):
        return involute(wheels)
    if shape.startswith("UHS"):
        return path(UniformStress, wheels, pressure_angle=f"{numbers[0]} deg")
    if shape.startswith("UT-c"):
        return path(UniformTemperature, wheels, reading="c", heat=repr(1.25 * heat_of(pair, "b")))
    if shape.startswith("UT"):
        return path(UniformTemperature, wheels, reading=shape[3])
    return path(LeastFriction, wheels, pressure_angle=f"{numbers[0]} deg", margin=numbers[1])


def loss(found: PathOfContact) -> float:
    """Mean loss over friction while one pair of teeth bears the load."""
    return measure(found).one_pair.loss


def tilt(side: Any) -> float:
    return degrees(asin(float(side.sin_psi(np.array(side.end)))))


def height(found: PathOfContact, side: Any) -> float:
    return float(found.pitch.S(side.end) * side.sin_psi(np.array(side.end)))


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
    found = [*(side.end for side in sides), *map(tilt, sides), *(height(path, side) for side in sides)]
    assert all(close(value, printed, 2) for value, printed in zip(found, row[2:], strict=True)), (found, row)


@pytest.mark.parametrize("row", TABLES["performance"], ids=lambda row: f"{row[0]} {row[1]}")
def test_loss_stress_heat_and_flash_are_those_of_the_table(row: list[str]) -> None:
    found = measure(path_of(row[0], row[1]))
    over = found.one_pair.over(involute_costs(row[0]))
    costs = (over[name] for name in ("loss", "stress", "off_pitch", "heat", "flash"))
    values = (found.one_pair.loss, *costs, found.slowest)
    assert all(close(value, printed, 3) for value, printed in zip(values, row[2:], strict=True)), (values, row)


@pytest.mark.parametrize("pair", dict.fromkeys(row[0] for row in TABLES["geometry"]))
@pytest.mark.parametrize("reading", ["a", "b"])
def test_uniform_heat_at_the_depth_of_the_involute_has_the_heat_of_the_table(pair: str, reading: str) -> None:
    shape = next(row[1] for row in TABLES["geometry"] if row[0] == pair and row[1].startswith(f"UT-{reading}"))
    assert close(heat_of(pair, reading), shape.partition("=")[2], 1)


@pytest.mark.parametrize("row", TABLES["bounds"], ids=lambda row: row[0])
def test_the_involute_has_the_loss_stress_and_heat_of_the_table(row: list[str]) -> None:
    found = involute_costs(row[0])
    for value, printed in zip((found.loss, found.stress**2, found.heat), row[3:], strict=True):
        assert close(value, printed, 1)


SHAPES = {"UHS20": "UHS psi0=20", "UT-b": "UT-b", "MF25": "MF psi_hi=25 u=0.15"}


@pytest.mark.parametrize("row", TABLES["profiles"], ids=lambda row: f"{row[0]} {row[1]}")
def test_points_of_the_profiles_are_those_of_the_table(row: list[str]) -> None:
    name, pair = row[0].rsplit(" ", 1)
    if name.startswith("UT"):
        found = path(UniformTemperature, wheels_of(pair), heat="0.4")
    else:
        found = path_of(pair, next(shape for key, shape in SHAPES.items() if name.startswith(key)))
    X = np.array([float(row[1]) * found.pitch.p])
    contact = found.at(X)
    assert close(float(contact.d[0]), row[2], 2)
    assert close(float(np.degrees(contact.psi[0])), row[3], 2)
    for points, printed in ((found.flank(1, X), row[4]), (found.flank(2, X), row[5])):
        for value, text in zip(points[0], printed.split(","), strict=False):
            assert close(float(value), text.strip(), 2)
    for value, text in ((contact.k1[0], row[6]), (contact.k2[0], row[7])):
        assert text == "-" or close(float(value), text, 2)


@given(
    st.integers(8, 200),
    st.integers(8, 200),
    st.floats(12, 35),
    st.booleans(),
    st.sampled_from(["stress", "heat", "friction", "involute"]),
)
@settings(max_examples=40, deadline=None)
def test_paths_obey_the_law_of_gearing_and_savary(z1: int, z2: int, tilted: float, bevel: bool, shape: str) -> None:
    # with few teeth a path of uniform heat comes to a right angle before it has travelled 0.4 pitches, and one of
    # minimum friction at a small angle to the end of its margin
    part = 0.3 if (shape == "heat" and min(z1, z2) < 12) or (shape == "friction" and tilted < 18) else 0.4
    wheels, arcs, psi = (z1, z2, pi / 2 if bevel else None), (part, part), f"{tilted!r} deg"
    given = {"arcs": [repr(part)] * 2}
    found = {
        "stress": lambda: path(UniformStress, wheels, pressure_angle=psi, **given),
        "heat": lambda: path(UniformTemperature, wheels, heat="1/3", **given),
        "friction": lambda: path(LeastFriction, wheels, pressure_angle=psi, margin="0.12", **given),
        "involute": lambda: involute(wheels, tilted, arcs),
    }[shape]()
    pitch = found.pitch
    A, B, X = pitch.A, pitch.B, pitch.p * part
    at = np.array([-0.9, -0.6, -0.3, 0.3, 0.6, 0.9]) * X
    c = found.at(at)
    step = 1e-5 * X
    before, after = found.at(at - step), found.at(at + step)
    np.testing.assert_allclose((after.d - before.d) / (2 * step), c.cos_psi, rtol=1e-6)
    np.testing.assert_allclose(c.U1 - c.U2, (A + B) * pitch.S(c.d), rtol=1e-9, atol=1e-12 * X)
    np.testing.assert_allclose(c.k1 - c.k2, c.kr, rtol=1e-7)
    c1, c2 = (np.arctan2(1, c.k1), np.arctan2(1, -c.k2)) if bevel else (1 / c.k1, -1 / c.k2)
    savary = 1 / np.tan(c1 - c.d) + 1 / np.tan(c2 + c.d) if bevel else 1 / (c1 - c.d) + 1 / (c2 + c.d)
    np.testing.assert_allclose(savary, (A + B) / c.sin_psi, rtol=1e-6)
    for flank, speed in ((partial(found.flank, 1), c.U1), (partial(found.flank, 2), c.U2)):
        moved = np.linalg.norm(flank(at + step) - flank(at - step), axis=-1) / (2 * step)
        np.testing.assert_allclose(moved, np.abs(speed), rtol=1e-5)


WINDOWS = [
    (0, 20, 0.969836881841), (14.5, 20, 0.985303326879), (14.5, 30, 0.947207237017), (0, 30, 0.932904989785),
    (0, 45, 0.852306532505), (0, 60, 0.742625584831),
]  # fmt: skip


def bound(pitch: Any, X: float, low: float, high: float) -> float:
    """Least loss with pressure angles in a window (rad), over that of the 20 degree involute, from three phases."""
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


@pytest.mark.parametrize(("low", "high", "printed"), WINDOWS)
def test_no_friction_shape_beats_the_bound_of_its_window(low: float, high: float, printed: float) -> None:
    reference = involute((24, 36, None), 20, (0, 0.5))
    assert bound(reference.pitch, pi / 2, radians(low), radians(high)) == pytest.approx(printed, abs=6e-13)
    if high >= 45:
        return
    for u in ("0.02", "0.05", "0.1", "0.2"):
        found = path(LeastFriction, (24, 36, None), pressure_angle=f"{high} deg", margin=u, arcs=[0, "1/2"])
        if tilt(found.recess) >= low:
            assert loss(found) > printed * loss(reference)


@pytest.mark.parametrize("row", TABLES["bounds"], ids=lambda row: row[0])
def test_the_bounds_of_all_pairs_are_those_of_the_table_and_no_shape_beats_them(row: list[str]) -> None:
    wheels = wheels_of(row[0])
    reference = involute(wheels)
    for high, printed in ((20, row[1]), (25, row[2])):
        minimum = bound(reference.pitch, reference.pitch.p / 2, 0.0, radians(high))
        assert minimum == pytest.approx(float(printed), abs=2e-13)
        found = path(LeastFriction, wheels, pressure_angle=f"{high} deg", margin="0.05")
        assert minimum < loss(found) / loss(reference) < 1


def test_the_minimum_friction_side_is_that_of_the_table_and_minimum_among_its_neighbours() -> None:
    reference = loss(involute((24, 36, None), 20, (0, 0.5)))
    for psi, u, first, end, last, ratio in (
        (25, "0.15", 0.3563150801726, 1.4803921288308, 14.73543682791, 0.9725332410128),
        (20, "0.10", 0.3672796542913, 1.5142793004044, 11.43694602833, 0.9820097357278),
    ):
        found = path(LeastFriction, (24, 36, None), pressure_angle=f"{psi} deg", margin=u, arcs=[0, "1/2"])
        side = found.recess
        assert side.joints == (pytest.approx(first, abs=2e-13), pytest.approx(end, abs=2e-13))
        assert tilt(side) == pytest.approx(last, abs=2e-11)
        assert loss(found) / reference == pytest.approx(ratio, abs=3e-13)


def test_a_cycloid_loses_more_than_the_involute_by_the_closed_form() -> None:
    X, rho = pi / 2, 4.5
    J = -4 * rho**2 * log(cos(X / (2 * rho)))
    found = path(Cycloidal, (24, 36, None), rolling=repr(rho), arcs=[0, "1/2"])
    assert loss(found) == pytest.approx((1 / 12 + 1 / 18) * J / X, rel=1e-13)
    assert pytest.approx(1.005118582955953, abs=1e-13) == J / (X**2 / 2)


def test_bevel_tends_to_spur_with_the_square_of_the_cone_angle() -> None:
    def off(angle: float) -> float:
        cones, plain = (path(UniformStress, (24, 36, each)) for each in (angle, None))
        return abs(cones.recess.end / cones.pitch.p / (plain.recess.end / plain.pitch.p) - 1)

    assert off(0.030) / off(0.015) == pytest.approx(4, abs=0.02)
    assert off(0.015) / off(0.0075) == pytest.approx(4, abs=0.02)


def test_uniform_stress_is_uniform_and_never_undercuts_from_five_teeth_to_a_hundred_thousand() -> None:
    for z1, z2, tilted in ((5, 5, 20), (5, 1000, 20), (12, 100_000, 1), (40, 40, 44), (100_000, 100_000, 20)):
        found = path(UniformStress, (z1, z2, None), pressure_angle=f"{tilted} deg", arcs=["0.3", "0.3"])
        c = found.at(np.linspace(-0.3, 0.3, 61) * found.pitch.p)
        assert np.ptp(c.H) <= 2e-12 * c.H.max()
        assert min(c.U1.min(), c.U2.min()) > 0
        expected = 2 * (found.pitch.A + found.pitch.B) / sin(2 * radians(tilted))
        assert c.H[30] == pytest.approx(expected, rel=1e-12)


@given(st.integers(8, 150), st.integers(8, 150), st.floats(12, 30), st.floats(0.2, 0.9), st.floats(0.2, 0.9))
@settings(max_examples=80, deadline=None)
def test_undercut_and_tips_are_those_of_the_textbook(z1: int, z2: int, psi: float, one: float, two: float) -> None:
    """Undercut begins where the line of action touches the base circle; the tip's width follows from its radius."""
    pair, alpha = involute_pair((z1, z2, None), psi, (one, two)), radians(psi)
    pitch, found = pair.path.pitch, {fault.gear: fault.X for fault in pair.faults if fault.kind == "undercut"}
    for gear, z, R, foot, tip in ((1, z1, pitch.R1, one, two), (2, z2, pitch.R2, two, one)):
        limit = R * tan(alpha)
        if limit < foot * pitch.p * (1 - 1e-9):
            assert found[gear] == pytest.approx(limit if gear == 2 else -limit, rel=1e-10)
        elif limit > foot * pitch.p * (1 + 1e-9):
            assert gear not in found
        d = tip * pitch.p * cos(alpha)
        angle = acos(R * cos(alpha) / hypot(d * cos(alpha), R + d * sin(alpha)))
        half = pi / (2 * z) + (tan(alpha) - alpha) - (tan(angle) - angle)
        thick = tooth_thickness(pair.path, gear, pair.halves, pair.path.ends(gear)[1])
        assert thick == pytest.approx(2 * half, abs=1e-12)
        assert any(fault.kind == "pointed" and fault.gear == gear for fault in pair.faults) == (half < 0)
