"""Strength of helical pairs: lines of contact counted, Hertz in space, and the factors of the standard."""

from __future__ import annotations

from math import asin, atan, atan2, cos, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import geartrain
from geartrain.simulation import PairStrength, TrainStrength
from geartrain.simulation.strength import HelixData, RackWheel, minimum_tooth_pairs, root_stress

Z1, Z2, NORMAL, TORQUE, ANGLE = 20, 43, 2.0, 50.0, radians(20)


def pair_of(
    first: str, second: str, width: float, torque: float, form: str = "involute", axis: str = ""
) -> geartrain.GearTrain:
    """A pair of steel wheels, on parallel axes or with the second axis in another direction."""
    axes = f"axes: {{A: {{direction: [1, 0, 0]}}, B: {{direction: {axis}}}}}" if axis else ""
    return geartrain.load(f"""
material: steel
face_width: {width} mm
links: {{frame: {{}}, a: {{wheels: {{p: {{{first}}}}}}}, b: {{wheels: {{w: {{{second}}}}}}}}}
{axes}
revolutes: {{A: [frame, a], B: [frame, b]}}
gears: [{{pair: [p, w], tooth_form: {form}}}]
inputs: {{a: 1}}
loads: {{a: {torque!r} N m}}
solve_for: b
""")


def strength(helix: float, width: float, form: str = "involute") -> PairStrength:
    lean = [f", helix_angle: {helix} deg, hand: {hand}" if helix else "" for hand in ("right", "left")]
    first, second = (f"teeth: {z}, module: {NORMAL} mm{own}" for z, own in zip((Z1, Z2), lean, strict=True))
    return pair_of(first, second, width, TORQUE, form).strength().pairs["p~w"]


def section(helix: float) -> tuple[float, float, float, float]:
    """Pressure angle, pitch radii and contact ratio in the transverse section, by hand."""
    lean = cos(radians(helix))
    transverse = atan(tan(ANGLE) / lean)
    r1, r2 = (z * NORMAL / lean / 2 for z in (Z1, Z2))
    ends = sum(sqrt((r + NORMAL) ** 2 - (r * cos(transverse)) ** 2) for r in (r1, r2))
    return transverse, r1, r2, (ends - (r1 + r2) * sin(transverse)) / (pi * NORMAL / lean * cos(transverse))


def counted(contact_ratio: float, overlap: float) -> float:
    """Fewest tooth pairs: a pair touches from 0 to the contact ratio, and slices lag by up to the overlap."""
    slices = np.linspace(0, overlap, 2001)
    phases = [phase - slices for phase in np.linspace(0, 1, 301)]
    return min(float((np.floor(at) - np.ceil(at - contact_ratio) + 1).mean()) for at in phases)


@given(st.floats(1.05, 2.6), st.floats(0.01, 3.5))
def test_the_minimum_number_of_tooth_pairs_is_that_of_many_slices(contact_ratio: float, overlap: float) -> None:
    expected = minimum_tooth_pairs(contact_ratio, overlap)
    assert counted(contact_ratio, overlap) == pytest.approx(expected, abs=0.02 + 0.004 / overlap)


def test_straight_teeth_have_as_many_tooth_pairs_as_touch_at_minimum() -> None:
    assert minimum_tooth_pairs(1.64, 0.0) == 1
    assert minimum_tooth_pairs(2.3, 0.0) == 2
    assert minimum_tooth_pairs(1.64, 1.0) == minimum_tooth_pairs(1.64, 2.0) == pytest.approx(1.64)


def test_teeth_that_hardly_lean_are_as_strong_as_straight_ones() -> None:
    straight, leaning = strength(0, 20), strength(0.01, 20)
    assert leaning.iso.stress == pytest.approx(straight.iso.stress, rel=1e-3)
    for one, other in zip(leaning.wheels, straight.wheels, strict=True):
        assert one.tip_stress == pytest.approx(other.tip_stress, rel=1e-3)
        assert one.iso.stress == pytest.approx(other.iso.stress, rel=1e-3)


@pytest.mark.parametrize("helix", [8.0, 15.0, 30.0])
def test_pressure_at_the_pitch_point_is_hertz_in_space_and_that_of_the_standard(helix: float) -> None:
    """An overlap of 1: all phases alike. Two cylinders of the flanks' curvatures along lines of a known length."""
    width = pi * NORMAL / sin(radians(helix))
    found = strength(helix, width)
    transverse, r1, r2, ratio = section(helix)
    base = asin(sin(radians(helix)) * cos(ANGLE))
    lines = width / cos(base) * ratio
    normal = TORQUE * 1e3 / r1 / cos(transverse) / cos(base)
    curvature = sum(1 / (r * sin(transverse) / cos(base)) for r in (r1, r2))
    pressure = 189.8 * sqrt(normal / lines * curvature)
    (pitch,) = (each for each in found.contact if each.where == "pitch point")
    assert pitch.pressure == pytest.approx(pressure * found.elasticity / 189.8, rel=1e-9)
    assert found.iso.Zeps == pytest.approx(1 / sqrt(ratio))
    assert found.iso.nominal == pytest.approx(pitch.pressure * found.iso.Zbeta, rel=1e-9)
    assert found.iso.stress == (found.iso.nominal, found.iso.nominal), "single contact there is none"


@pytest.mark.parametrize(("helix", "width"), [(8.0, 12.0), (15.0, 20.0), (30.0, 40.0)])
def test_the_tooth_pairs_told_are_those_that_share_the_force(helix: float, width: float) -> None:
    """Force across the axes times its part along the pitch circle times tooth pairs: the whole; counted by slices."""
    transverse, r1, _, ratio = section(helix)
    minimum = counted(ratio, width * sin(radians(helix)) / (pi * NORMAL))
    found = strength(helix, width)
    for place in found.contact:
        assert place.tooth_pairs == pytest.approx(minimum, abs=0.005)
        assert place.tooth_pairs * place.force * cos(transverse) == pytest.approx(TORQUE * 1e3 / r1, rel=1e-9)


def test_factors_are_those_of_the_standard() -> None:
    """Ybeta 1 - 15/120 and Zbeta 1/sqrt(cos 15) with an overlap of 1; half as much lean counts half as much overlap."""
    lean = HelixData(radians(15), 0.24, 1.3)
    assert lean.Ybeta == pytest.approx(0.875)
    assert lean.Zbeta == pytest.approx(1 / sqrt(cos(radians(15))))
    assert HelixData(radians(45), 0.6, 2.0).Ybeta == 0.75
    half = HelixData(radians(15), 0.24, 0.5)
    assert half.Ybeta == pytest.approx(0.9375)
    assert half.Zeps(1.6) ** 2 == pytest.approx(((4 - 1.6) / 3 + 1 / 1.6) / 2)
    assert half.single(1.2) == pytest.approx(1.1)
    assert half.single(0.9) == 1.0


def test_roots_are_those_of_the_spur_wheel_with_the_teeth_across() -> None:
    """By hand: 20 teeth at 15 degrees stand for 22.1, nearly z over the cube of the cosine."""
    found = strength(15, 40).wheels[0]
    base = asin(sin(radians(15)) * cos(radians(20)))
    z = Z1 / (cos(base) ** 2 * cos(radians(15)))
    assert z == pytest.approx(Z1 / cos(radians(15)) ** 3, rel=0.02)
    contact_ratio = strength(15, 40).contact
    assert contact_ratio
    wheel = RackWheel(z, 0.0, z / 2 + 1)
    force = TORQUE * 1e3 / (Z1 * NORMAL / cos(radians(15)) / 2)
    low, high = (root_stress(wheel, radians(20), force, 40, NORMAL, radius) for radius in (z / 2, z / 2 + 1))
    assert low.stress < found.iso.stress / found.iso.Ybeta < high.stress
    assert (found.iso.chord, found.iso.radius) == pytest.approx((high.chord, high.radius))
    assert found.iso.Ybeta == pytest.approx(1 - min(40 * sin(radians(15)) / (pi * NORMAL), 1) * 15 / 120)


def test_leaning_teeth_bear_more() -> None:
    """With the same normal module and width: more lines of contact, larger wheels."""
    straight, leaning = strength(0, 40), strength(20, 40)
    worst = [max(each.pressure for each in pair.contact) for pair in (straight, leaning)]
    assert worst[1] < worst[0]
    assert leaning.wheels[0].tip_stress < straight.wheels[0].tip_stress
    assert any("helical" in note for note in leaning.notes)


def test_other_forms_that_lean_are_left_out_by_name() -> None:
    with pytest.raises((KeyError, geartrain.GearTrainError)):
        strength(15, 40, "cycloidal")


# --------------------------------------------------------------------------------------------------- strength of bevels


def found(z1: int, z2: int, width: float = 20, axis: str = "[0, 1, 0]") -> TrainStrength:
    first, second = f"teeth: {z1}, module: 3 mm, kind: bevel", f"teeth: {z2}, kind: bevel"
    return pair_of(first, second, width, 50.0, axis=axis).strength(turns=100)


def spur(z1: int, z2: int, module: float, torque: float) -> PairStrength:
    return pair_of(f"teeth: {z1}, module: {module!r} mm", f"teeth: {z2}", 20, torque).strength().pairs["p~w"]


def test_bevels_of_three_to_four_are_spur_wheels_of_whole_counts_in_the_middle() -> None:
    """36 and 48 teeth: cones of 3, 4 and 5, so that 45 and 80 teeth stand for them; 90 mm long, 80 in the middle."""
    bevel = found(36, 48).pairs["p~w"]
    force = 50e3 / (3 * 36 / 2 * 80 / 90)
    assert bevel.tangential == pytest.approx(force)
    assert bevel.module == pytest.approx(3 * 80 / 90)
    like = spur(45, 80, 3 * 80 / 90, force * 45 * 3 * 80 / 90 / 2 / 1e3)
    for each, other in zip(bevel.wheels, like.wheels, strict=True):
        assert each.lewis == pytest.approx(other.lewis, rel=1e-6)
        assert each.tip_stress == pytest.approx(other.tip_stress, rel=1e-6)
        assert each.shared_stress == pytest.approx(other.shared_stress, rel=1e-6)
        assert each.pressure == pytest.approx(other.pressure, rel=1e-9)
        assert each.thickness == pytest.approx(other.thickness, rel=1e-6)
    # from the bevels' own axles
    sections = [wheel.section for wheel in like.wheels]
    assert [wheel.section for wheel in bevel.wheels] == pytest.approx([sections[0] * 0.8, sections[1] * 0.6], rel=1e-6)
    assert bevel.iso is None
    assert "45 and 80 teeth" in bevel.notes[0]


@pytest.mark.parametrize(("z1", "z2", "width", "crossing"), [(36, 48, 20, 90), (20, 45, 18, 110)])
def test_pressure_at_the_pitch_point_is_that_of_two_cones(z1: int, z2: int, width: float, crossing: float) -> None:
    angle = radians(crossing)
    pair = found(z1, z2, width, axis=f"[{cos(angle)!r}, {sin(angle)!r}, 0]").pairs["p~w"]
    first = atan2(sin(angle), z2 / z1 + cos(angle))
    middle = 3 * z1 / 2 / sin(first) - width / 2
    force = 50e3 / (middle * sin(first))
    curvature = (1 / tan(first) + 1 / tan(angle - first)) / (middle * sin(ANGLE))
    elasticity = sqrt(206_000 / (2 * pi * (1 - 0.3**2)))
    wanted = elasticity * sqrt(force / cos(ANGLE) / width * curvature)
    place = next(each for each in pair.contact if each.where == "pitch point")
    assert place.pressure * sqrt(place.tooth_pairs) == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize(("z1", "z2", "off"), [(36, 48, 0.004), (17, 23, 0.02), (16, 64, 0.01)])
def test_curvatures_are_those_of_the_path_on_the_sphere_within_two_percent(z1: int, z2: int, off: float) -> None:
    """Flanks are cones of rays through the apex: what they are curved across these is the geodesic curvature there."""
    bevels = f"teeth: {z1}, module: 3 mm, kind: bevel", f"teeth: {z2}, kind: bevel"
    sphere = pair_of(*bevels, 20, 1.0, axis="[0, 1, 0]").meshes[0].path
    cone = sphere.pitch.R1
    counts = z1 / cos(cone), z2 / sin(cone)
    base = [z / 2 * cos(ANGLE) for z in counts]
    line = sum(counts) / 2 * sin(ANGLE)
    X = np.linspace(-0.6, 0.6, 7) * sphere.pitch.p
    on_sphere = sphere.at(X).kr * 2 * sin(cone) / z1  # per module
    along = X * z1 / (2 * sin(cone)) * cos(ANGLE)
    first, second = (base[0] * tan(ANGLE) + along, base[1] * tan(ANGLE) - along)
    assert on_sphere == pytest.approx(line / (first * second), rel=off)


def test_wide_teeth_and_flat_cones_are_told() -> None:
    assert "wider than a third" in found(36, 48, 40).pairs["p~w"].notes[1]
    short = found(36, 48, 95)
    assert short.neglected[0].why == "the width of its teeth exceeds the cone distance"
    flat = found(30, 60, axis="[-0.5, 0.8660254037844386, 0]")  # the cone of the second is a plane
    assert "is flat or internal" in flat.neglected[0].why


def test_forces_and_stresses_are_of_one_radius() -> None:
    answer = found(20, 45)
    for force in answer.forces:
        assert abs(force.tangential) == pytest.approx(answer.pairs["p~w"].tangential)


def test_wear_goes_on_as_the_pair_loses_on_its_sphere() -> None:
    wheels = found(36, 48).pairs["p~w"].wheels
    volumes = [wheel.wear.volume.maximum for wheel in wheels if wheel.wear is not None]
    like = spur(45, 80, 1, 1)
    assert like.wheels[0].wear is None
    # Ohlendorf's loss of the spur pair, over the energy through 100 turns
    energy = 50e3 * 2 * pi * 100
    arcs = [place.position for place in like.contact if place.where in ("start of contact", "end of contact")]
    first, second = -arcs[0], arcs[1]
    loss = pi * (1 / 45 + 1 / 80) * (1 - first - second + first**2 + second**2)
    hardness = 190 * 9.80665
    assert volumes == pytest.approx([1e-3 * energy * loss / hardness] * 2, rel=0.03)
