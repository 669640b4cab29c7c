"""Lanterns and their mates: the closed form against a printed table, envelopes of drawn pins, and a balance of arcs."""

from __future__ import annotations

import re
from dataclasses import replace
from math import acos, asin, cos, hypot, log, pi, sin, tan
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from geartrain.teeth import Lantern
from geartrain.teeth.conjugate import ConjugatePair, measure

# X, d, psi (deg), point of the mate; R1 = 12, R2 = A = 18, B = 0.8, X counted from the pin on the line of centres
TABLE = """
0.800065858258 0.000000000000 1.27334436141 -0.799473251029 -0.026661179066
1.585464021655 0.784951548874 2.52334436141 -0.808052141988 0.032979990511
2.370862185053 1.569148746650 3.77334436141 -0.840450564573 0.175148260367
3.156260348450 2.352218357937 5.02334436141 -0.910945963113 0.395412293084
3.941658511847 3.133787684008 6.27334436141 -1.033145996983 0.687461193154
"""
FIRST = 0.800065858258
COUNTS = st.integers(8, 80)


def lantern(**given: Any) -> Lantern:
    return Lantern(form="lantern", **given)


def test_the_mate_of_the_table_has_the_points_of_the_table() -> None:
    path = lantern(pin_diameter="1.6", arcs=[0, 1]).path(24, 36)
    for row in TABLE.split("\n")[1:-1]:
        X, d, psi, x, y = map(float, row.split())
        at = np.array([max(min(X - FIRST, path.arcs[1]), 0.0)])
        c = path.at(at)
        assert float(c.d[0]) == pytest.approx(d, abs=2e-12)
        assert float(np.degrees(c.psi[0])) == pytest.approx(psi, abs=2e-11)
        # the table turns the mate from the pin on the line of centres, the path from the pitch point
        turned = np.exp(1j * FIRST / 12) * (path.flank(1, at)[0] @ np.array([1, 1j]) + 12j)
        assert (turned.real, turned.imag - 12) == (pytest.approx(x, abs=3e-12), pytest.approx(y, abs=3e-12))


def test_the_loss_over_one_pitch_is_that_of_the_table_and_of_the_closed_form() -> None:
    path = replace(lantern(pin_diameter="1.6", arcs=[0, 1]).path(24, 36), real=None)  # as if no pin cut its mate
    R2, B = 18.0, 0.8

    def below(u: float) -> float:
        return -4 * R2**2 * log(cos(u)) - 2 * R2 * B * log(tan(pi / 4 + u / 2))

    first = asin(B / (2 * R2))
    J = below(first + pi / (2 * R2)) - below(first)
    assert measure(path).one_pair.loss == pytest.approx(0.21858548634509, abs=6e-15)
    assert measure(path).one_pair.loss == pytest.approx((1 / 12 + 1 / 18) * J / pi, rel=1e-12)


@given(COUNTS, COUNTS, st.floats(1, 1.8), st.floats(-0.3, 0.3), st.integers(1, 2), st.booleans())
@example(64, 60, 1.0, 0.0, 1, True)
@settings(max_examples=40, deadline=None)
def test_the_mate_is_the_envelope_of_pins(z1: int, z2: int, diameter: float, off: float, pins: int, ring: bool) -> None:
    """No pin ever comes nearer to a point of the flank than its radius, and one comes so near."""
    if ring:
        pins, z2 = 1, z1 + z2 + 4
    zp, B = (z1 if pins == 1 else z2), diameter / 2
    R, A = zp / 2, zp / 2 + off
    assume(1.9 * A * sin(pi / zp) > diameter)
    form = lantern(pins=pins, pin_diameter=repr(diameter), pin_radius=repr(A))
    transmission = form.transmission(z1, z2, internal=ring)
    path, lost = transmission.path, max(-transmission.pair.arcs[0 if pins == 2 else 1], 0.0)
    arc = path.arcs[0 if pins == 1 else 1]
    X = lost + np.linspace(1e-6, 1, 6) * (arc - lost)
    points = path.flank(2, -X) if pins == 1 else path.flank(1, X)
    c = path.at(-X if pins == 1 else X)
    assume(min(c.U1.min(), c.U2.min()) > 0)  # pins outside their pitch circle undercut the mate at once
    # centre of the pin in the mate's frame as the pair turns; the mate's centre below, the pins' above, or mirrored
    Rm = (z2 if pins == 1 else z1) / 2
    flank = points[:, 0] + 1j * points[:, 1]
    if pins == 1:
        flank = -flank  # half a turn of the picture puts the lantern above
    sense = -1 if ring else 1
    beta0 = acos((A * A + R * R - B * B) / (2 * A * R))
    t = np.linspace(-0.3 * arc / R, 1.3 * arc / R, 4001) + beta0  # turned from the line of centres
    centre = 1j * R - 1j * A * np.exp(1j * t)
    body = (centre + 1j * sense * Rm) * np.exp(1j * sense * R * (t - beta0) / Rm) - 1j * sense * Rm
    nearest = np.abs(flank[:, None] - body[None, :]).min(axis=1)
    assert np.all(nearest >= B * (1 - 1e-9))
    np.testing.assert_allclose(nearest, B, rtol=5e-4)  # the samples of t are that coarse


def test_pins_are_round_and_their_mate_bends_as_the_closed_form_says() -> None:
    path = lantern(pin_diameter="1.6", arcs=["0.01", 1]).path(24, 36)
    R1, R2, B = 12.0, 18.0, 0.8
    X = np.concatenate([np.linspace(-0.9, -0.2, 4) * path.arcs[0], np.linspace(0.05, 1, 5) * path.arcs[1]])
    c = path.at(X)
    np.testing.assert_allclose(c.k2, -1 / B, rtol=1e-9)
    c1 = 4 * R2 * (R1 + R2) / (R1 + 2 * R2) * c.sin_psi - B
    np.testing.assert_allclose(c.k1, 1 / c1, rtol=1e-9)
    x, y = path.flank(2, X).T
    start = asin(B / (2 * R2)) * 2
    centre = 18 * np.sin(start), 18 * (1 - np.cos(start))
    np.testing.assert_allclose(np.hypot(x - centre[0], y - centre[1]), B, rtol=1e-12)


@pytest.mark.parametrize(("z1", "z2", "diameter"), [(24, 36, 1.6), (60, 8, 1.2), (10, 40, 1.5)])
def test_undercut_begins_in_approach_where_the_closed_form_says(z1: int, z2: int, diameter: float) -> None:
    R1, R2, B = z1 / 2, z2 / 2, diameter / 2
    first = asin(B / (2 * R2))
    limit = asin(B * (R1 + 2 * R2) / (4 * R2 * (R1 + R2)))
    arc = 2 * R2 * (first - limit) / pi
    for part, cut in ((0.999, False), (1.001, True)):
        path = lantern(pin_diameter=repr(diameter), arcs=[repr(arc * part), 1]).path(z1, z2)
        whole = ConjugatePair(replace(path, real=None), (0.1, 0.1))  # as if no pin cut its mate
        found = [fault for fault in whole.faults if fault.kind == "undercut"]
        assert bool(found) == cut
    assert found[0].gear == 1
    assert found[0].X / pi == pytest.approx(-arc, rel=1e-8)


@pytest.mark.parametrize(
    ("z1", "z2", "diameter"), [(24, 36, 1.6), (8, 35, 1.5), (12, 60, 1.2), (60, 8, 1.5), (20, 20, 1.5)]
)
def test_pins_on_their_way_in_cut_the_foot_of_the_flank_away(z1: int, z2: int, diameter: float) -> None:
    """Drawn pins of all earlier positions against the flank's points; the flank begins where none goes through it."""
    R, B, Rm = z2 / 2, diameter / 2, z1 / 2
    first = 2 * asin(B / (2 * R))
    beta = first * np.linspace(0.3, 2, 1701)

    def centre(t: Any) -> Any:
        return 1j * (R + Rm) - 1j * R * np.exp(1j * t)

    G = centre(beta) - 1j * Rm
    flank = (G * (1 - B / np.abs(G)) + 1j * Rm) * np.exp(1j * R * beta / Rm)
    still = asin(B * (Rm + 2 * R) / (4 * R * (Rm + R))) * 2
    t = np.linspace(-first, still, 1501)
    pins = centre(t) * np.exp(1j * R * t / Rm)
    cut = np.abs(flank[:, None] - pins[None, :]).min(axis=1) < B * (1 - 1e-12)
    begins = R * (beta[cut & (beta > still)].max() - first)
    verdict = lantern(pin_diameter=repr(diameter), arcs=[0, 1]).transmission(z1, z2).verdict
    assert verdict or verdict.kind == "undercut"
    left = 1.0 if verdict else float(re.search(r"([\d.]+) pitches of contact", verdict.faults[0].why)[1])  # type: ignore[index]
    assert (1 - left) * pi == pytest.approx(max(begins, 0.0), abs=R * first * 2e-3 + 1e-6 * pi)
    whole = lantern(pin_diameter=repr(diameter)).transmission(z1, z2, 0.1)
    assert whole.verdict
    assert sum(whole.pair.arcs) == pytest.approx(pi, rel=1e-9)
    assert not np.isnan(whole.efficiency(np.linspace(0, whole.period, 1000))).any()


def test_a_lantern_that_drives_works_in_approach_and_one_that_is_driven_in_recess() -> None:
    driven = lantern(pins=2).transmission(60, 8, 0.2)
    drives = lantern(pins=1).transmission(8, 60, 0.2)
    assert driven.verdict
    assert driven.pair.arcs == (0, pytest.approx(pi, rel=1e-12))
    assert drives.pair.arcs == (pytest.approx(pi, rel=1e-12), 0)
    assert drives.efficiency_mean() < driven.efficiency_mean() < 1
    # the same two wheels, whichever is named first
    other = lantern(pins=2).transmission(60, 8, 0.2, driver=2)
    assert drives.ratio == other.ratio
    assert drives.efficiency_mean() == pytest.approx(other.efficiency_mean(), abs=1e-12)
    S = np.linspace(0, 2, 50)
    np.testing.assert_allclose(drives.efficiency(S), other.efficiency(S), atol=1e-9)


def test_at_zero_a_pin_that_drives_points_at_the_other_axis() -> None:
    transmission = lantern(pins=1, pin_diameter="1.6").transmission(36, 300, 0.1)
    # from there the pin's flank has still to come back by its half-width to the pitch point
    assert transmission.contacts(np.array([-FIRST / 18 - 1e-9]))[0] == pytest.approx(-18e-9, abs=1e-12)


def test_the_mates_addendum_ends_its_flank() -> None:
    for z1, z2, pins, internal, tip in ((24, 36, 2, False, 13.1), (10, 60, 1, False, 31.1), (10, 60, 1, True, 28.9)):
        path = lantern(pins=pins, addendum="1.1").path(z1, z2, internal=internal)
        X = np.array([path.arcs[1] if pins == 2 else -path.arcs[0]])
        x, y = path.flank(3 - pins, X)[0]
        assert hypot(x, y - (-12 if pins == 2 else path.pitch.R2)) == pytest.approx(tip, rel=1e-12)


def test_teeth_of_the_mate_have_what_the_pins_leave_of_the_pitch() -> None:
    transmission = lantern(pin_diameter="1.6", backlash="0.1").transmission(24, 36)
    tooth, pin = transmission.pair.halves
    assert pin == pytest.approx(FIRST, abs=1e-12)
    assert 2 * (tooth + pin) == pytest.approx(pi - 0.1, rel=1e-12)
    assert transmission.verdict.backlash == pytest.approx(0.1 / 18, rel=1e-12)
    thick = lantern(pin_diameter="2.9").transmission(24, 36)
    (fault,) = thick.verdict.faults
    assert (fault.kind, fault.gear) == ("pointed", 1)
