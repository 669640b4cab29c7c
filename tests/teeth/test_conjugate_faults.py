"""What keeps conjugate teeth from running, against textbook formulas of the involute."""

from __future__ import annotations

from math import acos, cos, hypot, pi, radians, tan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from geartrain.teeth import Involute, UniformStress
from geartrain.teeth.conjugate import ConjugatePair, WheelPair
from geartrain.teeth.conjugate.admissibility import tip_thickness


def involute(wheels: WheelPair, approach: float, recess: float, psi: float) -> ConjugatePair:
    """Arcs in pitches, pressure angle in degrees."""
    return Involute.pair_of_arcs(wheels, (approach, recess), {"pressure_angle": f"{psi!r} deg"})


def inv(angle: float) -> float:
    """The involute function."""
    return tan(angle) - angle


@given(st.integers(8, 150), st.integers(8, 150), st.floats(12, 30), st.floats(0.2, 0.9), st.floats(0.2, 0.9))
@settings(max_examples=60, deadline=None)
def test_an_involute_is_undercut_from_where_its_line_touches_the_base_circle(
    z1: int, z2: int, psi: float, approach: float, recess: float
) -> None:
    pair = involute(WheelPair(z1, z2), approach, recess, psi)
    pitch, found = pair.path.pitch, {fault.gear: fault.X for fault in pair.faults if fault.kind == "undercut"}
    limits = {1: -pitch.R1 * tan(radians(psi)), 2: pitch.R2 * tan(radians(psi))}
    for gear, arc in ((1, approach), (2, recess)):
        if abs(limits[gear]) < arc * pitch.p * (1 - 1e-9):
            assert found[gear] == pytest.approx(limits[gear], rel=1e-10)
        elif abs(limits[gear]) > arc * pitch.p * (1 + 1e-9):
            assert gear not in found


@given(st.integers(8, 150), st.integers(8, 150), st.floats(14, 30), st.floats(0.2, 0.7), st.floats(0.2, 0.7))
@settings(max_examples=60, deadline=None)
def test_the_tip_of_an_involute_is_as_wide_as_the_textbook_says(
    z1: int, z2: int, psi: float, approach: float, recess: float
) -> None:
    pair, alpha = involute(WheelPair(z1, z2), approach, recess, psi), radians(psi)
    pitch = pair.path.pitch
    for gear, z, R, arc in ((1, z1, pitch.R1, recess), (2, z2, pitch.R2, approach)):
        d = arc * pitch.p * cos(alpha)
        radius = hypot(d * cos(alpha), R + d * pitch.S(1.0) * (1 - cos(alpha) ** 2) ** 0.5)
        tip = acos(R * cos(alpha) / radius)
        half = pi / (2 * z) + inv(alpha) - inv(tip)
        assert tip_thickness(pair.path, gear) == pytest.approx(2 * half, abs=1e-12)
        assert any(fault.kind == "pointed" and fault.gear == gear for fault in pair.faults) == (half < 0)


def test_a_bevel_pair_of_small_cones_has_the_tips_of_the_spur_pair() -> None:
    flat, cones = (involute(WheelPair(24, 36, shaft_angle=angle), 0.5, 0.6, 20).path for angle in (None, 3e-3))
    for gear in (1, 2):
        assert tip_thickness(cones, gear) == pytest.approx(tip_thickness(flat, gear), abs=1e-6)


def test_a_contact_ratio_below_one_is_named() -> None:
    (fault,) = involute(WheelPair(30, 30), 0.4, 0.5, 20).faults
    assert fault.kind == "contact ratio"
    assert "0.9" in fault.what


def test_uniform_stress_is_never_undercut_where_the_involute_is() -> None:
    assert any(fault.kind == "undercut" for fault in involute(WheelPair(8, 40), 0.7, 0.5, 20).faults)
    transmission = UniformStress(form="uniform_stress", arcs="0.7").transmission(8, 40)
    assert not any(fault.kind == "undercut" for fault in transmission.verdict.faults)
