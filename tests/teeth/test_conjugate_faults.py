"""What keeps conjugate teeth from running, against textbook formulas of the involute."""

from __future__ import annotations

from math import acos, cos, hypot, pi, radians, tan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from geartrain.teeth.conjugate import optimal_sides as forms
from geartrain.teeth.conjugate.admissibility import faults, tip_thickness
from geartrain.teeth.conjugate.path_of_contact import PathOfContact
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces


def involute(pitch: PitchSurfaces, approach: float, recess: float, psi: float) -> PathOfContact:
    """Arcs in pitches, pressure angle in degrees."""
    sides = (forms.involute(arc * pitch.p, radians(psi)) for arc in (approach, recess))
    return PathOfContact(pitch, *sides)


def inv(angle: float) -> float:
    """The involute function."""
    return tan(angle) - angle


@given(st.integers(8, 150), st.integers(8, 150), st.floats(12, 30), st.floats(0.2, 0.9), st.floats(0.2, 0.9))
@settings(max_examples=60, deadline=None)
def test_an_involute_is_undercut_from_where_its_line_touches_the_base_circle(
    z1: int, z2: int, psi: float, approach: float, recess: float
) -> None:
    pitch = PitchSurfaces.spur(z1, z2)
    found = {
        fault.gear: fault.X for fault in faults(involute(pitch, approach, recess, psi)) if fault.kind == "undercut"
    }
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
    pitch, alpha = PitchSurfaces.spur(z1, z2), radians(psi)
    path = involute(pitch, approach, recess, psi)
    for gear, z, R, arc in ((1, z1, pitch.R1, recess), (2, z2, pitch.R2, approach)):
        d = arc * pitch.p * cos(alpha)
        radius = hypot(d * cos(alpha), R + d * pitch.S(1.0) * (1 - cos(alpha) ** 2) ** 0.5)
        tip = acos(R * cos(alpha) / radius)
        half = pi / (2 * z) + inv(alpha) - inv(tip)
        assert tip_thickness(path, gear) == pytest.approx(2 * half, abs=1e-12)
        assert any(fault.kind == "pointed" and fault.gear == gear for fault in faults(path)) == (half < 0)


def test_a_bevel_pair_of_small_cones_has_the_tips_of_the_spur_pair() -> None:
    size = 1e-4
    flat, cones = PitchSurfaces.spur(24, 36), PitchSurfaces(24, 36, 12 * size, 18 * size, True)
    for gear in (1, 2):
        plane = tip_thickness(involute(flat, 0.5, 0.6, 20), gear)
        assert tip_thickness(involute(cones, 0.5, 0.6, 20), gear) == pytest.approx(plane, abs=1e-6)


def test_a_contact_ratio_below_one_is_named() -> None:
    (fault,) = faults(involute(PitchSurfaces.spur(30, 30), 0.4, 0.5, 20))
    assert fault.kind == "contact ratio"
    assert "0.9" in fault.what


def test_uniform_stress_is_never_undercut_where_the_involute_is() -> None:
    pitch = PitchSurfaces.spur(8, 40)
    X, psi = 0.7 * pitch.p, radians(20)
    assert any(fault.kind == "undercut" for fault in faults(involute(pitch, 0.7, 0.5, 20)))
    sides = (forms.uniform_stress(pitch, a, b, X, psi) for a, b in ((pitch.B, pitch.A), (pitch.A, pitch.B)))
    assert not any(fault.kind == "undercut" for fault in faults(PathOfContact(pitch, *sides)))
