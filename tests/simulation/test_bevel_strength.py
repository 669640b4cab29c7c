"""Strength of bevels: the spur wheels that stand for them, closed forms at the pitch point, and paths on the sphere."""

from __future__ import annotations

from math import atan2, cos, pi, radians, sin, sqrt, tan

import numpy as np
import pytest

import geartrain
from geartrain.simulation import PairStrength, TrainStrength

ANGLE = radians(20)


def found(
    z1: int, z2: int, width: float = 20, module: float = 3, axis: str = "[0, 1, 0]", more: str = ""
) -> TrainStrength:
    return geartrain.load(f"""
name: bevel pair
material: steel
face_width: {width} mm
links:
  frame: {{}}
  a: {{wheels: {{p: {{teeth: {z1}, module: 3 mm, kind: bevel}}}}}}
  b: {{wheels: {{w: {{teeth: {z2}, kind: bevel}}}}}}
axes: {{A: {{direction: [1, 0, 0]}}, B: {{direction: {axis}}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
gears: [{{pair: [p, w], tooth_form: involute}}]
inputs: {{a: 1}}
loads: {{a: 50 N m}}
solve_for: b
""").strength(turns=100)


def spur(z1: int, z2: int, module: float, torque: float, width: float = 20) -> PairStrength:
    return (
        geartrain.load(f"""
name: spur pair
material: steel
face_width: {width} mm
links:
  frame: {{}}
  a: {{wheels: {{p: {{teeth: {z1}, module: {module!r} mm}}}}}}
  b: {{wheels: {{w: {z2}}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
gears: [{{pair: [p, w], tooth_form: involute}}]
inputs: {{a: 1}}
loads: {{a: {torque!r} N m}}
solve_for: b
""")
        .strength()
        .pairs["p~w"]
    )


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


@pytest.mark.parametrize(
    ("z1", "z2", "width", "crossing"), [(36, 48, 20, 90), (17, 23, 12, 90), (24, 30, 15, 60), (20, 45, 18, 110)]
)
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
    assert place.pressure * sqrt(place.couples) == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize(("z1", "z2", "off"), [(36, 48, 0.004), (17, 23, 0.02), (16, 64, 0.01)])
def test_curvatures_are_those_of_the_path_on_the_sphere_within_two_percent(z1: int, z2: int, off: float) -> None:
    """Flanks are cones of rays through the apex: what they are curved across these is the geodesic curvature there."""
    train = geartrain.load(f"""
links:
  frame: {{}}
  a: {{wheels: {{p: {{teeth: {z1}, kind: bevel}}}}}}
  b: {{wheels: {{w: {{teeth: {z2}, kind: bevel}}}}}}
axes: {{A: {{direction: [1, 0, 0]}}, B: {{direction: [0, 1, 0]}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
gears: [{{pair: [p, w], tooth_form: involute}}]
inputs: {{a: 1}}
""")
    sphere = train.meshes[0].path
    assert sphere is not None
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
    assert short.left_out[0].why == "its teeth are wider than its cones are long"
    flat = found(30, 60, axis="[-0.5, 0.8660254037844386, 0]")  # the cone of the second is a plane
    assert "is flat or hollow" in flat.left_out[0].why


def test_forces_and_stresses_are_of_one_radius() -> None:
    answer = found(20, 45)
    for force in answer.forces:
        assert abs(force.tangential) == pytest.approx(answer.pairs["p~w"].tangential)


def test_wear_goes_on_as_the_pair_loses_on_its_sphere() -> None:
    wheels = found(36, 48).pairs["p~w"].wheels
    volumes = [wheel.wear.volume.greatest for wheel in wheels if wheel.wear is not None]
    like = spur(45, 80, 1, 1)
    assert like.wheels[0].wear is None
    # Ohlendorf's loss of the spur pair, over the energy through 100 turns
    energy = 50e3 * 2 * pi * 100
    arcs = [place.position for place in like.contact if place.where in ("start of contact", "end of contact")]
    first, second = -arcs[0], arcs[1]
    loss = pi * (1 / 45 + 1 / 80) * (1 - first - second + first**2 + second**2)
    hardness = 190 * 9.80665
    assert volumes == pytest.approx([1e-3 * energy * loss / hardness] * 2, rel=0.03)
