"""Tooth forms that people use, against textbook formulas, brute force and balances written here apart."""

from __future__ import annotations

from math import acos, cos, degrees, hypot, isnan, log, pi, radians, sin, sqrt, tan
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

import geartrain.teeth
from geartrain.errors import GearTrainError
from geartrain.teeth import Involute
from geartrain.teeth.conjugate import (
    ConjugateToothForm,
    ConjugateTransmission,
    OffDesignTransmission,
    PathOfContact,
    WheelPair,
    efficiency,
    measure,
)
from geartrain.teeth.conjugate.admissibility import tip_gap

RIGHT = pi / 2


def shape(form: str, **given: Any) -> ConjugateToothForm:
    model = getattr(geartrain.teeth, form.title().replace("_", ""))  # a form and its class have the same name
    found: ConjugateToothForm = model(form=form, **given)
    return found


EVERY = [shape(form) for form in ("involute", "cycloidal", "uniform_stress", "uniform_temperature", "least_friction")]
EVERY.append(shape("uniform_temperature", reading="c"))


def kinds(transmission: ConjugateTransmission) -> set[tuple[str, int]]:
    return {(fault.kind, fault.gear) for fault in transmission.verdict.faults}


def inv(angle: float) -> float:
    return tan(angle) - angle


def bisected(f: Any, low: float, high: float) -> float:
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if (f(middle) > 0) == (f(low) > 0) else (low, middle)
    return low


TEETH = st.integers(18, 120)


def shifts(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers that a declaration takes: 0, or not below 1e-300."""
    return st.floats(low, high).map(lambda shift: round(shift, 12))


@given(TEETH, TEETH, st.floats(15, 28), shifts(-0.2, 0.4), shifts(-0.2, 0.4), st.floats(0, 0.3))
@settings(max_examples=60, deadline=None)
def test_the_contact_ratio_is_that_of_tip_circles(
    z1: int, z2: int, angle: float, x1: float, x2: float, wider: float
) -> None:
    alpha = radians(angle)
    value = inv(alpha) + 2 * tan(alpha) * (x1 + x2) / (z1 + z2)
    assume(value > 1e-4)
    working = bisected(lambda a: inv(a) - value, 0.0, 1.4)
    distance = (z1 + z2) / 2 * cos(alpha) / cos(working) + wider
    working = acos((z1 + z2) / 2 * cos(alpha) / distance)
    tips = [hypot(z / 2 + x + 1, 0) for z, x in ((z1, x1), (z2, x2))]
    bases = [z / 2 * cos(alpha) for z in (z1, z2)]
    reach = sum(sqrt(max(tip**2 - base**2, 0)) for tip, base in zip(tips, bases, strict=True))
    expected = (reach - distance * sin(working)) / (pi * cos(alpha))
    over = [tip - distance * z / (z1 + z2) for tip, z in zip(tips, (z1, z2), strict=True)]
    assume(min(over) > 0.01)
    form = shape("involute", pressure_angle=f"{angle!r} deg", shift=[x1, x2], centre_distance=repr(distance))
    path = form.path(z1, z2)
    assert path.contact_ratio == pytest.approx(expected, rel=1e-9)
    assert float(path.at(0.1).psi) == pytest.approx(working, rel=1e-9)


def test_a_shifted_pair_is_that_of_a_worked_example() -> None:
    """12 and 24 teeth of 3 mm at 56.5 mm, printed by bolsover.com, "Profile Shifted External Spur Gears"."""
    height = [(44.840 / 2 - 36 / 2) / 3 - 0.6, (79.400 / 2 - 72 / 2) / 3 - 0.36]
    form = Involute(form="involute", shift=[0.6, 0.36], centre_distance=repr(56.5 / 3), addendum=height)
    found = form.involutes(WheelPair(12, 24))
    assert degrees(found.psi) == pytest.approx(26.0888, abs=6e-5)
    working = 2 * 3 * found.pitch.R1
    assert working == pytest.approx(37.667, abs=6e-4)
    assert form.path(12, 24).contact_ratio == pytest.approx(1.202, abs=6e-4)
    assert found.backlash == pytest.approx(0, abs=7e-4)  # 4 tan 20 deg times half a digit of its shifts, 0.960


@given(st.integers(15, 40), st.integers(10, 60), shifts(-0.2, 0.5), shifts(0, 0.5), st.booleans())
@settings(max_examples=40, deadline=None)
def test_shifted_wheels_mesh_without_backlash(z1: int, more: int, x1: float, x2: float, ring: bool) -> None:
    """Pitch-circle thicknesses written from drawn involutes; the ring's tooth is a space of its cutter."""
    z2, alpha = z1 + more, radians(20)
    teeth, shifts = (z2 - z1, x2 - x1) if ring else (z1 + z2, x1 + x2)
    value = inv(alpha) + 2 * tan(alpha) * shifts / teeth
    assume(value > 1e-4)
    working = bisected(lambda a: inv(a) - value, 0.0, 1.5)
    found = Involute(form="involute", shift=[x1, x2]).involutes(WheelPair(z1, z2, ring))
    assert found.distance == pytest.approx(teeth / 2 * cos(alpha) / cos(working), rel=1e-11)
    thick = [2 * ((pi / 2 + 2 * x * tan(alpha)) / z + inv(alpha) - inv(working)) for z, x in ((z1, x1), (z2, x2))]
    second = 2 * pi / z2 - thick[1] if ring else thick[1]
    R1 = found.distance * z1 / teeth
    expected = 2 * pi * R1 / z1 - R1 * thick[0] - R1 * z2 / z1 * second
    assert expected == pytest.approx(0, abs=1e-9)
    assert found.backlash == pytest.approx(0, abs=1e-9)
    assert found.halves[1] == pytest.approx(R1 * z2 / z1 * second / 2, abs=1e-9)


@pytest.mark.parametrize("internal", [False, True])
def test_a_wider_centre_distance_only_adds_backlash_and_changes_no_ratio(internal: bool) -> None:
    z1, z2 = 20, 60
    design = ((z2 - z1) if internal else (z1 + z2)) / 2
    wide = design + (-0.2 if internal else 0.2)
    transmission = shape("involute", centre_distance=str(wide)).transmission(z1, z2, internal=internal)
    working, alpha = acos(design * cos(radians(20)) / wide), radians(20)
    # the textbooks' play on the working pitch circle, 2 a_w (inv a_w - inv a), over its radius
    backlash = 2 * wide * (inv(working) - inv(alpha)) / (wide * z2 / (z2 - z1 if internal else z1 + z2))
    assert transmission.verdict
    assert transmission.verdict.backlash == pytest.approx(abs(backlash), rel=1e-9)
    S = np.linspace(0, 1, 7)
    np.testing.assert_array_equal(transmission.error(S), 0)
    np.testing.assert_allclose(transmission.angle(S), S / 3, rtol=1e-15)


def test_declared_lengths_with_a_unit_are_measured_in_the_module_of_the_wheels() -> None:
    # module 2 mm: pitch distance 60 mm
    plain = shape("involute", centre_distance="30.1", backlash="0.05").transmission(24, 36)
    real = shape("involute", centre_distance="60.2 mm", backlash="0.1 mm").transmission(24, 36, pitch_distance=0.06)
    assert real.verdict.backlash == pytest.approx(plain.verdict.backlash, rel=1e-12)
    assert real.path.contact_ratio == pytest.approx(plain.path.contact_ratio, rel=1e-12)


def test_flanks_of_a_ring_and_its_pinion_are_drawn_involutes() -> None:
    z1, z2, alpha = 20, 55, radians(20)
    path = shape("involute").path(z1, z2, internal=True)
    for gear, z in ((1, z1), (2, z2)):
        x, y = path.flank(gear, np.array([0.4, -0.4])).T
        radius = np.hypot(x, y + z / 2)
        drawn = inv(alpha) - (np.tan(t := np.arccos(z / 2 * cos(alpha) / radius)) - t)
        # azimuths forward from straight up; both flanks pass the pitch point at angle 0
        np.testing.assert_allclose(np.arctan2(x, y + z / 2), drawn, atol=1e-13)


@pytest.mark.parametrize(("z1", "z2"), [(24, 30), (20, 28), (20, 30), (30, 36), (34, 45), (17, 60)])
def test_tips_of_a_ring_clear_those_of_its_pinion_by_the_textbook(z1: int, z2: int) -> None:
    transmission = shape("involute", addendum="0.8").transmission(z1, z2, internal=True)
    a, alpha = (z2 - z1) / 2, radians(20)
    tip1, tip2 = z1 / 2 + 0.8, z2 / 2 - 0.8
    first = acos(z1 / 2 * cos(alpha) / tip1)
    second = acos(z2 / 2 * cos(alpha) / tip2)
    theta1 = acos((tip2**2 - tip1**2 - a**2) / (2 * a * tip1)) + inv(first) - inv(alpha)
    theta2 = acos((a**2 + tip2**2 - tip1**2) / (2 * a * tip2))
    gap = theta1 * z1 / z2 + inv(alpha) - inv(second) - theta2
    assert (("interference", 0) in kinds(transmission)) == (gap < 0)
    assert tip_gap(transmission.path) == pytest.approx(gap, abs=1e-13)


def kink_cuts(z: int, x: float) -> float:
    """Radius up to which the straight rack's corner takes the involute off: its path in the wheel, point by point."""
    r, alpha, u = z / 2, radians(20), 1 - x
    X = np.linspace(-3 * r, 0, 100_001)
    kink = u * tan(alpha) + X + 1j * (r - u)
    body = kink * np.exp(1j * X / r)
    radius, azimuth = np.abs(body), pi / 2 - np.angle(body)
    base = r * cos(alpha)
    far = (radius > base) & (radius < r) & (kink.real < 0)
    t = np.arccos(base / radius[far])
    gone = azimuth[far] < inv(alpha) - (np.tan(t) - t)
    return float(radius[far][gone].max(initial=0.0))


@pytest.mark.parametrize(("z", "x"), [(8, 0.0), (10, 0.1), (12, 0.0), (14, 0.0), (16, 0.0), (17, -0.1), (9, 0.3)])
def test_the_rack_cuts_the_involute_away_as_far_as_its_kink_goes(z: int, x: float) -> None:
    wheel = Involute(form="involute", shift=[x, 0]).involutes(WheelPair(z, 60)).first
    expected = kink_cuts(z, x)
    assert expected > 0
    assert wheel.undercut() == pytest.approx(expected, abs=2e-4)


def test_from_eighteen_teeth_on_no_standard_wheel_is_undercut() -> None:
    cut = {z: Involute(form="involute").involutes(WheelPair(z, 60)).first.undercut() for z in range(6, 30)}
    assert [z for z, radius in cut.items() if radius == 0] == list(range(18, 30))


def test_a_pinion_undercut_by_the_rack_is_named_with_the_shift_that_mends_it() -> None:
    transmission = shape("involute").transmission(11, 100)
    assert ("undercut", 1) in kinds(transmission)
    (fault,) = (fault for fault in transmission.verdict.faults if fault.kind == "undercut")
    # the textbook's shift, 1 - z sin^2 / 2, and the textbook's 17.1 teeth
    assert f"{1 - 11 * sin(radians(20)) ** 2 / 2:.4g} modules" in fault.fix
    assert "18 teeth" in fault.fix
    mended = shape("involute", shift=[0.3566, -0.3566]).transmission(11, 100)
    assert mended.verdict


@given(st.integers(6, 40), st.integers(20, 150), st.floats(0.7, 1.3))
@settings(max_examples=50, deadline=None)
def test_tips_interfere_from_where_the_line_of_action_touches_the_base_circle(z1: int, z2: int, add: float) -> None:
    transmission = shape("involute", addendum=add, dedendum=add + 0.25).transmission(z1, z2)
    base, across = z2 / 2 * cos(radians(20)), (z1 + z2) / 2 * sin(radians(20))
    over = z2 / 2 + add - hypot(base, across)
    assume(abs(over) > 1e-9)
    assert (("interference", 1) in kinds(transmission)) == (over > 0)
    if over > 0:
        fit = shape("involute", addendum=[add, round(add - over, 9) - 1e-9], dedendum=add + 0.25).transmission(z1, z2)
        assert ("interference", 1) not in kinds(fit)


def test_teeth_that_come_to_a_point_say_where_their_arc_would_have_to_end() -> None:
    form = shape("involute", shift=[0.9, 0], addendum=[1.3, 1])
    transmission = form.transmission(9, 40)
    (fault,) = (fault for fault in transmission.verdict.faults if fault.kind == "pointed")
    assert fault.gear == 1
    # the textbook's radius of the point: inv = pi/2z + 2 x tan / z + inv 20
    pointed = bisected(lambda a: inv(a) - (pi / 18 + 2 * 0.9 * tan(radians(20)) / 9 + inv(radians(20))), 0.1, 1.4)
    radius = 4.5 * cos(radians(20)) / cos(pointed)
    pitch = transmission.path.pitch
    psi = float(transmission.path.at(0.0).psi)
    d = sqrt(radius**2 - (pitch.R1 * cos(psi)) ** 2) - pitch.R1 * sin(psi)
    assert f"{d / cos(psi) / pitch.p:.6g} pitches" in fault.fix


@pytest.mark.parametrize(
    ("given", "kind", "words"),
    [
        ({"centre_distance": "29.9"}, "jam", "at least 30 modules"),
        ({"centre_distance": "29.9", "backlash": "0.1"}, "runs", ""),
        ({"dedendum": "0.9"}, "clearance", "deeper dedendum"),
        ({"centre_distance": "31.2"}, "contact ratio", "lengthen"),
    ],
)
def test_a_misfit_of_involute_wheels_has_a_name_and_a_remedy(given: dict[str, str], kind: str, words: str) -> None:
    verdict = shape("involute", **given).transmission(24, 36).verdict
    assert verdict.kind == kind
    assert bool(verdict) == (kind == "runs")
    assert words in " ".join(fault.fix for fault in verdict.faults)
    assert verdict.to_dict()["kind"] == kind


def test_radial_flanks_come_from_rolling_circles_of_half_the_pitch_circle() -> None:
    path = shape("cycloidal").path(8, 60)
    X = np.linspace(0, path.arcs[1], 9)[1:]
    x, y = path.flank(2, X).T
    np.testing.assert_allclose(np.arctan2(x, 30 - y), 0, atol=1e-14)
    x, y = path.flank(1, -X[:4]).T
    np.testing.assert_allclose(np.arctan2(x, 4 + y), 0, atol=1e-14)


def test_the_addendum_of_a_cycloid_is_traced_by_a_point_of_the_rolling_circle() -> None:
    R, rho = 12.0, 3.0
    path = shape("cycloidal", rolling=[2, 3]).path(24, 36)
    X = np.linspace(0, path.arcs[1], 7)
    t = X / R  # the rolling circle's centre has gone back by t while the wheel stands still
    centre = (R + rho) * 1j * np.exp(1j * t)
    traced = centre - rho * 1j * np.exp(1j * (t + X / rho))
    x, y = path.flank(1, X).T
    np.testing.assert_allclose(x, traced.real, atol=1e-13)
    np.testing.assert_allclose(y + R, traced.imag, atol=1e-13)


@pytest.mark.parametrize("angle", [None, RIGHT, 1.1])
def test_an_addendum_ends_the_flank_at_its_height(angle: float | None) -> None:
    for form in (shape("cycloidal", addendum=[0.5, 0.4]), shape("involute", addendum=[0.5, 0.4])):
        path = form.path(24, 36, shaft_angle=angle)
        pitch = path.pitch
        first, second = path.flank(1, np.array([path.arcs[1]]))[0], path.flank(2, np.array([-path.arcs[0]]))[0]
        if angle is None:
            assert hypot(first[0], first[1] + 12) == pytest.approx(12.5, rel=1e-13)
            assert hypot(second[0], second[1] - 18) == pytest.approx(18.4, rel=1e-13)
            continue
        module = 2 * sin(pitch.R1) / 24
        for point, axis, R, add in (
            (first, (0, -sin(pitch.R1), cos(pitch.R1)), pitch.R1, 0.5),
            (second, (0, sin(pitch.R2), cos(pitch.R2)), pitch.R2, 0.4),
        ):
            assert tan(acos(point @ np.array(axis)) - R) == pytest.approx(add * module, rel=1e-9)


def test_the_rolling_cone_of_a_bevel_cycloid_keeps_its_contact_on_one_small_circle() -> None:
    path = shape("cycloidal", rolling_fraction="0.4").path(24, 36, shaft_angle=RIGHT)
    pitch = path.pitch
    rho = 0.4 * pitch.R2
    X = np.linspace(0.01, 0.99, 9) * path.arcs[1]
    c = path.at(X)
    points = pitch.point(c.d, c.sin_psi, c.cos_psi)
    pole = np.array([0, sin(rho), cos(rho)])
    np.testing.assert_allclose(points @ pole, cos(rho), rtol=1e-14)
    step = 1e-6 * path.arcs[1]
    for gear, speed in ((1, c.U1), (2, c.U2)):
        moved = np.linalg.norm(path.flank(gear, X + step) - path.flank(gear, X - step), axis=-1) / (2 * step)
        np.testing.assert_allclose(moved, np.abs(speed), rtol=1e-6)


EXTREMAL = """
0.000000000000 0.347296355334 80 0.060307379214 0.342020143326 0.060307379214 0.342020143326 0.9831302571 0.9348946522
1.355676698188 0.684040286651 70 -1.1927939522 0.588568478339 -1.072737046137 0.674389119142 0.8722108263 0.7772052309
2.115153627150 1.000000000000 60 -1.763824080421 0.754353543169 -1.512205979036 0.925565352237 0.6606836025 0.5217947136
2.617566146592 1.285575219373 50 -2.003204552914 0.855942642846 -1.648013640778 1.04465643002 0.3338128652 0.1552607514
"""


@pytest.mark.parametrize("row", EXTREMAL.split("\n")[1:-1])
def test_the_literal_extremal_is_that_of_the_table(row: str) -> None:
    X, d, psi, x1, y1, x2, y2, U1, U2 = map(float, row.split())
    arc = 2 * log(cos(radians(50)) / cos(radians(80))) / pi
    path = shape("least_friction", literal=True, arcs=[0, repr(arc)]).path(24, 36)
    at = np.array([min(X, path.arcs[1])])
    c = path.at(at)
    assert float(c.d[0]) == pytest.approx(d, abs=2e-12)
    assert degrees(float(c.psi[0])) == pytest.approx(psi, abs=1e-10)
    np.testing.assert_allclose(path.flank(1, at)[0], (x1, y1), atol=2e-12)
    np.testing.assert_allclose(path.flank(2, at)[0], (x2, y2), atol=2e-12)
    assert (float(c.U1[0]), float(c.U2[0])) == (pytest.approx(U1, abs=2e-10), pytest.approx(U2, abs=2e-10))


@pytest.mark.parametrize("angle", [None, RIGHT])
def test_the_literal_extremal_rubs_minimum_and_makes_no_pair(angle: float | None) -> None:
    transmission = shape("least_friction", literal=True).transmission(24, 36, shaft_angle=angle)
    assert ("pointed", 1) in kinds(transmission)
    assert transmission.path.contact_ratio == pytest.approx(1, rel=1e-12)
    c = transmission.path.at(np.linspace(0.1, 0.9, 5) * transmission.path.arcs[1])
    D = transmission.path.pitch.S(c.d) / c.cos_psi
    np.testing.assert_allclose(D, D[0], rtol=1e-12)


@pytest.mark.parametrize("margin", ["0.01", "0.15", "0.3", "0.35", "0.355", "0.362"])
@pytest.mark.parametrize("wheels", [{}, {"internal": True}, {"shaft_angle": RIGHT}])
def test_minimum_friction_keeps_its_maximum_angle_and_its_margin(margin: str, wheels: dict[str, Any]) -> None:
    path = shape("least_friction", margin=margin).path(24, 36, **wheels)
    c = path.at(np.linspace(-path.arcs[0], path.arcs[1], 2001))
    assert degrees(float(c.psi.max())) <= 25 + 1e-9
    assert float(np.minimum(c.U1, c.U2).min()) >= float(margin) - 1e-12


def test_the_margin_that_leaves_minimum_friction_no_path_is_the_one_of_its_lowest_path() -> None:
    # eta = u d + d^2 / 2 R, at the greatest angle where d = 2 R (sin psi - u); 1 / cos psi taken along it
    u, R, most = 0.363, 12, sin(radians(25))
    d = (np.arange(200_000) + 0.5) / 200_000 * 2 * R * (most - u)
    arc = float(np.mean(1 / np.sqrt(1 - (u + d / (2 * R)) ** 2))) * 2 * R * (most - u)

    def path(share: float) -> PathOfContact:
        return shape("least_friction", margin=repr(u), arcs=[repr(share * arc / pi), 0]).path(24, 36)

    assert degrees(float(path(0.99).at(-path(0.99).arcs[0]).psi)) == pytest.approx(25, abs=1e-9)
    with pytest.raises(GearTrainError, match="too long"):
        path(1.01)


def test_teeth_without_backlash_have_no_backlash_left_by_rounding() -> None:
    assert shape("involute", pressure_angle="14.5 deg", addendum="0.8").transmission(24, 36).pair.backlash == 0


def test_teeth_that_backlash_leaves_no_thickness_are_told_to_have_less_of_it() -> None:
    found = shape("involute", backlash="5").transmission(24, 36).verdict.faults
    assert {fault.gear for fault in found} == {1, 2}
    assert all("less backlash" in fault.fix for fault in found)


def test_uniform_temperature_has_the_depth_it_is_requested_for() -> None:
    for reading in "abc":
        for wheels in ({}, {"internal": True}, {"shaft_angle": RIGHT}):
            path = shape("uniform_temperature", reading=reading, depth="0.9").path(20, 50, **wheels)
            assert measure(path).depth / (path.pitch.p / pi) == pytest.approx(0.9, rel=1e-11)


@pytest.mark.parametrize("wheels", [{}, {"internal": True}, {"shaft_angle": RIGHT}])
def test_what_is_to_be_uniform_is(wheels: dict[str, Any]) -> None:
    part = np.array([-0.9, -0.5, -0.1, 0.1, 0.5, 0.9])

    def contact(form: ConjugateToothForm) -> Any:
        path = form.path(20, 50, **wheels)
        return path.at(np.where(part < 0, path.arcs[0], path.arcs[1]) * part)

    stress = contact(shape("uniform_stress"))
    np.testing.assert_allclose(stress.H, stress.H[0], rtol=1e-11)
    first = contact(shape("uniform_temperature", reading="a"))
    np.testing.assert_allclose(first.Q1, first.Q1[0], rtol=1e-10)
    hotter = contact(shape("uniform_temperature", heat="0.5"))
    np.testing.assert_allclose(np.maximum(hotter.Q1, hotter.Q2), 0.5, rtol=1e-10)


def torque_balance(path: PathOfContact, X: float, friction: float, driver: int) -> float:
    """Efficiency by forces on bodies: normal from neighbouring flank points, friction against the bodies' sliding."""
    pitch, step = path.pitch, 1e-5 * path.pitch.p
    ends = np.array([X - step, X, X + step])
    bodies = []
    for flank, reach, R in (
        (path.flank(1, ends), -pitch.reach, -pitch.R1),
        (path.flank(2, ends), pitch.reach2, pitch.R2),
    ):
        three = np.zeros((3, 3))
        if pitch.bevel:
            three[:] = flank
            axis, base = np.array([0, sin(R), cos(R)]), np.zeros(3)
        else:
            three[:, :2] = flank
            axis, base = np.array([0.0, 0, 1]), np.array([0.0, R, 0])
        # the body turns at 1/reach about its axis; a body's own frame stands at X = 0
        angle = X / reach
        cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
        turn = np.eye(3) + sin(angle) * cross + (1 - cos(angle)) * cross @ cross
        bodies.append(((three - base) @ turn.T + base, axis / reach, base))
    (points1, spin1, base1), (_, spin2, base2) = bodies
    P, tangent = points1[1], points1[2] - points1[0]
    tangent /= np.linalg.norm(tangent)
    normal = np.cross(tangent, P if pitch.bevel else np.array([0.0, 0, 1]))
    normal /= np.linalg.norm(normal)
    way = 1 if driver == 1 else -1
    v1, v2 = way * np.cross(spin1, P - base1), way * np.cross(spin2, P - base2)
    normal *= np.sign(normal @ v1) * way  # gear 1's flank pushes the second forwards, or is pushed back by it
    sliding = v1 - v2
    force = normal
    if (size := np.linalg.norm(sliding)) > 1e-12:
        force = normal + friction * sliding / size
    # force on gear 2; the powers are those of its torques on the two turning bodies
    first, second = force @ v1, force @ v2
    return float(second / first if driver == 1 else first / second)


BALANCED = [
    (form, wheels, driver)
    for form in (shape("involute"), shape("cycloidal"), shape("uniform_stress"))
    for wheels in ({}, {"internal": True}, {"shaft_angle": RIGHT}, {"shaft_angle": 2.0})
    for driver in (1, 2)
]


@pytest.mark.parametrize(("form", "wheels", "driver"), BALANCED)
def test_efficiency_is_that_of_forces_on_turning_bodies(form: ConjugateToothForm, wheels: Any, driver: int) -> None:
    path = form.path(20, 45, **wheels)
    for part in (-0.9, -0.4, 0.3, 0.95):
        X = part * path.arcs[1 if part > 0 else 0]
        for friction in (0.05, 0.3):
            found = float(efficiency(path.pitch, path.at(np.array(X)), friction, driver))
            assert found == pytest.approx(torque_balance(path, X, friction, driver), abs=2e-8)


@pytest.mark.parametrize("wheels", [{}, {"internal": True}, {"shaft_angle": RIGHT}])
def test_the_mean_is_that_of_ten_thousand_instants(wheels: dict[str, Any]) -> None:
    for form in EVERY:
        transmission = form.transmission(19, 47, 0.15, **wheels)
        S = (np.arange(10_000) + 0.5) / 10_000 * transmission.period
        each = transmission.efficiency(S)
        assert transmission.efficiency_mean() == pytest.approx(each.mean(), abs=2e-6)
        assert transmission.efficiency_at_constant_load() == pytest.approx(1 / (1 / each).mean(), abs=2e-6)
        assert transmission.efficiency_minimum() == pytest.approx(each.min(), abs=1e-4)
        again = transmission.efficiency(S[:100] + 7 * transmission.period)
        np.testing.assert_allclose(again, each[:100], atol=1e-12)


def test_while_two_pairs_touch_each_takes_half_the_drivers_torque() -> None:
    transmission = shape("involute").transmission(30, 50, 0.1)
    S = np.linspace(0, transmission.period, 400)
    X = transmission.contacts(S)
    both = ~np.isnan(X).any(axis=0)
    assert both.mean() == pytest.approx(transmission.path.contact_ratio - 1, abs=0.01)
    assert not np.isnan(X[0]).any()
    np.testing.assert_allclose(X[1, both] - X[0, both], transmission.path.pitch.p, rtol=1e-12)
    each = efficiency(transmission.path.pitch, transmission.path.at(X[:, both]), 0.1)
    np.testing.assert_allclose(transmission.efficiency(S[both]), each.mean(axis=0), rtol=1e-14)


@pytest.mark.parametrize("form", EVERY)
def test_the_second_wheel_drives_as_the_first_of_the_exchanged_pair_does(form: ConjugateToothForm) -> None:
    for angle in (None, RIGHT):
        transmission = form.transmission(21, 50, 0.1, driver=2, shaft_angle=angle)
        other = form.transmission(50, 21, 0.1, shaft_angle=angle)
        assert transmission.ratio == other.ratio
        assert transmission.efficiency_mean() == pytest.approx(other.efficiency_mean(), abs=1e-10)
        S = np.linspace(0, 1, 20)
        np.testing.assert_allclose(transmission.efficiency(S), other.efficiency(S), atol=1e-9)
        np.testing.assert_allclose(
            transmission.reversed.efficiency(S), form.transmission(21, 50, 0.1, shaft_angle=angle).efficiency(S)
        )


@pytest.mark.parametrize("form", EVERY)
def test_turned_back_the_transmission_is_its_mirror_image_and_ahead_by_the_backlash(form: ConjugateToothForm) -> None:
    loose = form.model_copy(update={"backlash": shape("involute", backlash="0.1").backlash})
    transmission, back = loose.transmission(24, 36, 0.1), loose.transmission(24, 36, 0.1, direction=-1)
    S = np.linspace(-0.3, 0.5, 33)
    np.testing.assert_allclose(back.efficiency(-S), transmission.efficiency(S), atol=1e-12)
    assert back.efficiency_mean() == pytest.approx(transmission.efficiency_mean(), abs=1e-13)
    np.testing.assert_array_equal(transmission.error(S), 0)
    np.testing.assert_allclose(back.error(S), 0.1 / 18, rtol=1e-9)
    assert transmission.reversed_motion().error_range() == back.error_range()
    assert transmission.error_moments() == (0, 0)
    assert transmission.verdict.backlash == pytest.approx(0.1 / 18, rel=1e-9)


def test_at_zero_a_tooth_of_the_driver_stands_on_the_line_of_centres() -> None:
    for driver in (1, 2):
        transmission = shape("uniform_stress").transmission(24, 36, 0.1, driver=driver)
        # its flank, a quarter pitch ahead, passed the pitch point a quarter pitch ago
        S = -transmission.period / 4
        X = transmission.contacts(np.array([S - 1e-9, S + 1e-9]))[0]
        assert X[0] < 0 < X[1]
        assert X[1] < 1e-6


@given(st.sampled_from(EVERY), st.integers(18, 90), st.integers(18, 90), st.floats(0, 0.4), st.sampled_from([1, 2]))
@settings(max_examples=40, deadline=None)
def test_every_form_keeps_the_ratio_and_never_gains(form: Any, z1: int, z2: int, friction: float, driver: int) -> None:
    transmission = form.transmission(z1, z2, friction, driver)
    S = np.linspace(0, 3 * transmission.period, 101)
    assert float(transmission.ratio) == (z1 / z2 if driver == 1 else z2 / z1)
    assert transmission.speed_range() == (float(transmission.ratio), float(transmission.ratio))
    np.testing.assert_array_equal(transmission.error(S), 0)
    found = transmission.efficiency(S)
    assert np.all((found > 0) & (found <= 1))
    assert found.min() - 1e-9 <= transmission.efficiency_mean() <= 1 + 1e-12
    assert transmission.efficiency_minimum() <= transmission.efficiency_mean() + 1e-12


def test_friction_locks_where_the_driver_rubs_the_driven_tooth_inwards() -> None:
    form = shape("involute", pressure_angle="28 deg")
    transmission = form.transmission(24, 36)
    c = transmission.path.at(-transmission.path.arcs[0])
    # at the start of approach: cos psi = mu (sin psi + B |d|)
    expected = float(c.cos_psi / (c.sin_psi + abs(c.d) / 18))
    assert transmission.locking_friction == pytest.approx(expected, rel=1e-9)
    below, above = (form.transmission(24, 36, expected * part) for part in (0.999, 1.001))
    assert 0 < below.efficiency_mean() < 1
    assert isnan(above.efficiency_mean())
    assert np.isnan(above.efficiency(np.linspace(0, 1, 500))).any()


def test_a_pair_that_parts_before_the_next_meets_has_no_efficiency_in_between() -> None:
    transmission = shape("cycloidal", arcs=["0.3", "0.4"]).transmission(24, 36, 0.1)
    assert transmission.verdict.kind == "contact ratio"
    found = transmission.efficiency((np.arange(1000) + 0.5) / 1000 * transmission.period)
    assert np.isnan(found).mean() == pytest.approx(0.3, abs=2e-3)
    assert transmission.efficiency_mean() == pytest.approx(np.nanmean(found), abs=1e-5)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"form": "involute", "pressure_angle": "90 deg"}, "outside 0 to 90"),
        ({"form": "involute", "addendum": "0"}, "must be greater than 0"),
        ({"form": "involute", "backlash": "-1"}, "would jam"),
        ({"form": "uniform_stress", "pressure_angle": "45 deg"}, "outside 0 to 45"),
        ({"form": "uniform_stress", "arcs": [0, 0]}, "are out of range"),
        ({"form": "uniform_temperature", "heat": "0.4", "depth": "1"}, "both given"),
        ({"form": "uniform_temperature", "minimum_angle": "12 deg"}, "only to reading c"),
        ({"form": "least_friction", "margin": "0"}, "would come to rest"),
        ({"form": "least_friction", "margin": "1"}, "not below 0.422618"),
        ({"form": "least_friction", "pressure_angle": "5 deg"}, "not below 0.0871557"),
        ({"form": "involute", "shift": ["1e20", 0]}, "out of range"),
        ({"form": "involute", "addendum": "1e299"}, "out of range"),
        ({"form": "least_friction", "literal": True, "pressure_angles": ["40 deg", "30 deg"]}, "90 and 45"),
        ({"form": "least_friction", "literal": True, "arcs": [0.5, 0.5]}, "one side only"),
        ({"form": "least_friction", "pressure_angles": ["80 deg", "50 deg"]}, "literal shape"),
        ({"form": "cycloidal", "rolling": "2", "rolling_fraction": "0.5"}, "both given"),
        ({"form": "cycloidal", "rolling_fraction": "1"}, "generates no dedendum"),
        ({"form": "cycloidal", "arcs": [0.5, 0.5], "addendum": "1"}, "both given"),
        ({"form": "lantern", "pin_diameter": "0"}, "must be greater than 0"),
    ],
)
def test_parameters_that_make_no_teeth_are_refused_with_a_remedy(given: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError) as caught:
        shape(**given)
    (error,) = caught.value.errors()
    assert words in error["msg"]
    assert error["ctx"]["fix"]


@pytest.mark.parametrize(
    ("given", "teeth", "wheels", "words"),
    [
        ({"form": "involute"}, (2, 30), {}, "2 teeth"),
        ({"form": "involute"}, (30, 30), {"internal": True}, "cannot contain"),
        ({"form": "involute"}, (30, 60), {"internal": True, "shaft_angle": 1.0}, "parallel"),
        ({"form": "involute"}, (30, 60), {"shaft_angle": 4.0}, "shaft angle"),
        ({"form": "involute", "shift": "0.3"}, (30, 60), {"shaft_angle": RIGHT}, "sum to 0"),
        ({"form": "involute", "centre_distance": "45"}, (30, 60), {"shaft_angle": RIGHT}, "no centre distance"),
        ({"form": "involute", "centre_distance": "40"}, (30, 60), {}, "too short"),
        ({"form": "involute", "centre_distance": "45 mm"}, (30, 60), {}, "cannot be converted to modules"),
        ({"form": "involute", "shift": "-3"}, (20, 20), {}, "without backlash"),
        ({"form": "involute", "addendum": "0.2", "shift": [1.6, -1.6]}, (20, 40), {}, "do not reach each other"),
        ({"form": "involute", "shift": [3, -3]}, (20, 40), {"shaft_angle": RIGHT}, "do not reach each other"),
        ({"form": "involute", "shift": [-3, 3]}, (20, 40), {"shaft_angle": RIGHT}, "base cone"),
        ({"form": "uniform_stress", "centre_distance": "45.1"}, (30, 60), {"shaft_angle": RIGHT}, "no centre distance"),
        ({"form": "lantern", "centre_distance": "45.1"}, (30, 60), {}, "off the design distance"),
        ({"form": "cycloidal", "rolling": "2"}, (30, 60), {"shaft_angle": RIGHT}, "are cones"),
        ({"form": "cycloidal", "rolling": "0.1"}, (30, 60), {}, "half the rolling circle"),
        ({"form": "cycloidal", "rolling": "0.5", "addendum": "1.5"}, (30, 60), {}, "exceeds the height"),
        ({"form": "uniform_temperature", "depth": "30"}, (30, 60), {}, "no value of `heat` gives"),
        ({"form": "uniform_temperature", "depth": "0.1"}, (24, 36), {}, "even the maximum `heat` gives deeper teeth"),
        ({"form": "uniform_temperature", "reading": "a", "heat": "2.5"}, (30, 60), {}, "exceeds the maximum"),
        ({"form": "least_friction", "margin": "0.38"}, (24, 36), {}, "margin of 0.38 and a pressure angle of 25 deg"),
        ({"form": "least_friction", "arcs": [3, 0]}, (24, 36), {}, "too long for a contact speed margin"),
        ({"form": "lantern"}, (30, 60), {"internal": True}, "ring of pins"),
        ({"form": "lantern", "pin_radius": "20"}, (24, 36), {}, "do not reach the pitch circle"),
        ({"form": "lantern", "pin_diameter": "3.5"}, (24, 36), {}, "touch each other"),
        ({"form": "lantern", "arcs": [0.6, 1]}, (24, 36), {}, "too long"),
        ({"form": "lantern", "addendum": "60"}, (24, 36), {}, "does not reach the tip radius"),
        ({"form": "lantern"}, (30, 60), {"shaft_angle": RIGHT}, "bevel lantern"),
    ],
)
def test_wheels_that_a_form_does_not_fit_are_refused(given: Any, teeth: Any, wheels: Any, words: str) -> None:
    with pytest.raises(GearTrainError) as caught:
        shape(**given).transmission(*teeth, **wheels)
    (problem,) = caught.value.problems
    assert words in f"{problem.what} {problem.why}"
    assert problem.fix


def test_a_declared_design_distance_is_no_misplacement() -> None:
    assert shape("uniform_stress", centre_distance="45").transmission(30, 60).verdict


@pytest.mark.parametrize(("wheels", "wide"), [({}, "35.05"), ({"internal": True}, "14.96")])
def test_a_misplaced_involute_does_what_its_working_circles_say(wheels: dict[str, Any], wide: str) -> None:
    at_home = shape("involute", addendum="0.8").transmission(20, 50, **wheels).pair
    for driver in (1, 2):
        working = shape("involute", addendum="0.8", centre_distance=wide).transmission(20, 50, 0.2, driver, **wheels)
        found = OffDesignTransmission(at_home, float(wide), 0.2, driver)
        low, high = found.error_range()
        assert high - low < 1e-12
        assert low == pytest.approx(-working.verdict.backlash / 2, rel=1e-8)
        assert found.verdict.backlash == pytest.approx(working.verdict.backlash, rel=1e-8)
        S = np.linspace(0, found.period, 41)
        alone = np.isnan(working.contacts(S)[1:]).all(axis=0)
        assert alone.sum() > 10
        np.testing.assert_allclose(found.efficiency(S)[alone], working.efficiency(S)[alone], rtol=1e-8)
        back = working.reversed_motion()
        assert found.reversed_motion().error_range()[0] == pytest.approx(low + found.verdict.backlash, rel=1e-8)
        np.testing.assert_allclose(found.reversed_motion().efficiency(-S)[alone], back.efficiency(-S)[alone], rtol=1e-8)


def test_at_a_wrong_distance_other_teeth_have_a_transmission_of_their_own() -> None:
    transmission = shape("uniform_stress", arcs="0.6", centre_distance="30.03").transmission(24, 36, 0.1)
    assert isinstance(transmission, OffDesignTransmission)
    low, high = transmission.error_range()
    assert high - low > 1e-6
    slow, fast = transmission.speed_range()
    assert slow < 2 / 3 < fast
    S = np.linspace(0, transmission.period, 50)
    assert np.all((transmission.error(S) >= low - 1e-12) & (transmission.error(S) <= high + 1e-12))
    np.testing.assert_allclose(
        (transmission.angle(S + 1e-6) - transmission.angle(S - 1e-6)) / 2e-6, transmission.speed(S), atol=1e-5
    )
    mean, rms = transmission.error_moments()
    fine = transmission.error((np.arange(4000) + 0.5) / 4000 * transmission.period)
    assert (mean, rms) == (pytest.approx(fine.mean(), abs=1e-8), pytest.approx(fine.std(), rel=1e-3))
    design = shape("uniform_stress", arcs="0.6").transmission(24, 36, 0.1)
    assert transmission.efficiency_minimum() < transmission.efficiency_mean() < 1
    assert transmission.efficiency_mean() == pytest.approx(design.efficiency_mean(), abs=2e-3)
    assert transmission.efficiency_at_constant_load() == pytest.approx(transmission.efficiency_mean(), abs=1e-4)
    for part, locks in ((0.999, False), (1.001, True)):
        rubbed = OffDesignTransmission(transmission.pair, 30.03, part * transmission.locking_friction)
        assert isnan(rubbed.efficiency_mean()) == locks
    assert transmission.verdict.backlash > 0
    assert transmission.verdict
    tight = shape("uniform_stress", arcs="0.6", centre_distance="29.97").transmission(24, 36)
    assert tight.verdict.kind == "jam"


def test_equal_pairs_of_a_long_train_share_one_path() -> None:
    assert shape("least_friction").path(24, 36) is shape("least_friction").path(24, 36)
