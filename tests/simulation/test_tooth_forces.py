"""Forces at pitch points: what one wheel bears the other gives back, in space; and printed examples."""

from __future__ import annotations

from math import atan, cos, hypot, radians, sin, sqrt, tan
from typing import Any

import numpy as np
import pytest
import sorge

import geartrain

SKEW = "A: {direction: [0, 0, 1], position: [0 mm, 0 mm, 0 mm]}, B: {direction: %s, position: [%s mm, 0 mm, 0 mm]}"


def forces(first: str, second: str, axes: str, more: str = "", load: str = "a: -2 N m") -> tuple[Any, ...]:
    train = geartrain.load(f"""
axes: {{{axes}}}
links: {{frame: {{}}, a: {{wheels: {{p: {{{first}}}}}}}, b: {{wheels: {{w: {{{second}}}}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, w]{more}}}]
inputs: {{{"b" if load.startswith("a") else "a"}: 1}}
loads: {{{load}}}
""")
    return train.strength().forces


def in_space(force: Any, axis: Any, out: Any) -> Any:
    """From its three parts; `out` points from the wheel's axis to the place of contact."""
    g, r = np.array(axis, float) / np.linalg.norm(axis), np.array(out, float)
    return force.tangential * np.cross(g, r) + force.axial * g - force.radial * r


def balance(found: tuple[Any, ...], axes: tuple[Any, Any], out: tuple[Any, Any]) -> None:
    """What the second wheel bears is what the first one does, the other way."""
    one, other = (in_space(*each) for each in zip(found, axes, out, strict=True))
    assert np.abs(one).max() > 0
    assert one + other == pytest.approx(0, abs=1e-9 * np.abs(one).max())


UP = (0, 0, 1)


@pytest.mark.parametrize(
    "form", ["", ", tooth_form: {form: involute}", ", tooth_form: {form: involute, shift: [0.4, 0.1]}"]
)
@pytest.mark.parametrize("load", ["a: -2 N m", "a: 3 N m", "b: 1 N m"])
def test_helical_wheels_on_parallel_axes_push_each_other_alike(form: str, load: str) -> None:
    lean = "helix_angle: 25 deg, hand:"
    found = forces(f"teeth: 20, module: 2 mm, {lean} left", f"teeth: 35, {lean} right", "", form, load)
    balance(found, (UP, UP), ((1, 0, 0), (-1, 0, 0)))
    one = found[0]
    assert one.radius / found[1].radius == pytest.approx(20 / 35)
    assert abs(one.axial / one.tangential) == pytest.approx(tan(radians(25)) * one.radius * cos(radians(25)) / 20)
    if "shift" not in form:
        assert one.radius == pytest.approx(20 / cos(radians(25)))
        assert one.radial == pytest.approx(abs(one.tangential) * tan(radians(20)) / cos(radians(25)))


def test_a_helical_ring_is_pushed_outwards() -> None:
    for form in ("", ", tooth_form: {form: involute}"):
        found = forces("teeth: 20, module: 2 mm, helix_angle: 25 deg, hand: left",
                       "teeth: 60, internal: true, helix_angle: 25 deg, hand: left", "", form)  # fmt: skip
        assert found[1].radial < 0
        balance(found, (UP, UP), ((1, 0, 0), (1, 0, 0)))


@pytest.mark.parametrize("friction", ["", ", friction: 0.08"])
@pytest.mark.parametrize("load", ["a: -2 N m", "b: 1 N m"])
@pytest.mark.parametrize(
    ("first", "second", "crossing"),
    [
        ("teeth: 20, helix_angle: 45 deg, hand: right", "teeth: 30, helix_angle: 45 deg, hand: right", 90),
        ("teeth: 20, helix_angle: 50 deg, hand: right", "teeth: 30, helix_angle: 10 deg, hand: left", 40),
        ("teeth: 20, helix_angle: 30 deg, hand: left", "teeth: 40, helix_angle: 60 deg, hand: left", -90),
        ("teeth: 4, kind: worm, helix_angle: 60 deg, hand: right", "teeth: 40, helix_angle: 30 deg, hand: right", 90),
    ],
)
def test_wheels_on_skew_axes_push_each_other_alike(
    first: str, second: str, crossing: float, load: str, friction: str
) -> None:
    """With friction too, which the torques have through an efficiency that was found without forces."""
    # angle from A to B about the way from B to A, which is -x
    axis = (0.0, sin(radians(crossing)), cos(radians(crossing)))
    direction = f"[0, {axis[1]:.15f}, {axis[2]:.15f}]"
    if crossing in (90, -90):
        direction = f"[0, {crossing // 90}, 0]"
    found = forces(f"{first}, module: 1 mm", second, SKEW % (direction, 99), friction, load)
    balance(found, (UP, axis), ((1, 0, 0), (-1, 0, 0)))


def test_bevels_push_each_other_away_from_their_apex() -> None:
    axes = "A: {direction: [1, 0, 0]}, B: {direction: [0, 0, 1]}"
    wheel = "kind: bevel, module: 2 mm, face_width: 8 mm"
    one, other = forces(f"teeth: 20, {wheel}", f"teeth: 40, {wheel}", axes)
    # at right angles what pushes one along its axis pushes the other towards its own
    assert (one.axial, abs(one.radial)) == pytest.approx((other.radial, abs(other.axial)))
    assert abs(one.tangential) == pytest.approx(abs(other.tangential))
    assert one.radius == pytest.approx(20 - 4 * sin(atan(0.5)))
    assert one.axial > 0


def test_the_helical_pinion_of_shigleys_example_13_7() -> None:
    """1 hp at 1800 rpm, 18 teeth, normal pitch 12 per inch, angles of 20 and 30 deg: 40.4, 17.0, 23.3; in all 49.8 lbf.

    Budynas and Nisbett, Shigley's Mechanical Engineering Design, 9th ed. 2011.
    """
    inch, pound = 0.0254, 4.4482216
    torque = 33_000 / (2 * np.pi * 1800) * 12 * inch * pound  # of 33 000 foot-pounds a minute
    wheel = "module: {:.9f} mm, helix_angle: 30 deg, hand: {}"
    found = forces("teeth: 18, " + wheel.format(25.4 / 12, "left"), "teeth: 36, " + wheel.format(25.4 / 12, "right"),
                   "", load=f"a: {torque:.9f} N m")  # fmt: skip
    parts = [abs(each) / pound for each in (found[0].tangential, found[0].radial, found[0].axial)]
    assert parts == pytest.approx([40.4, 17.0, 23.3], abs=0.06)
    assert sqrt(sum(each**2 for each in parts)) == pytest.approx(49.8, rel=5e-3)


@pytest.mark.parametrize("loss", [", tooth_form: {form: involute}, friction: 0.15", ", efficiency: 0.8"])
@pytest.mark.parametrize("load", ["a: 2 N m", "b: 1 N m"])
def test_wheels_push_each_other_alike_whatever_friction_takes(loss: str, load: str) -> None:
    """The force along the pitch circles is between the torques over the radii of both wheels."""
    lean = "module: 2 mm, helix_angle: 25 deg, hand:"
    found = forces(f"teeth: 20, {lean} left", f"teeth: 35, {lean} right", "", loss, load)
    balance(found, (UP, UP), ((1, 0, 0), (-1, 0, 0)))
    given, at = (2e3, 0) if load.startswith("a") else (1e3, 1)
    # the wheel whose torque is given is the driven one: its driver's torque over the radius is greater
    assert abs(found[at].tangential) > 1.005 * given / found[at].radius
    # the moments of one force and its opposite about both axes differ by force times centre distance
    moments = sum(1e3 * abs(each.torque) for each in found)
    assert moments == pytest.approx(abs(found[0].tangential) * sum(each.radius for each in found), rel=1e-12)
    axes = "A: {direction: [1, 0, 0]}, B: {direction: [0, 0, 1]}"
    wheel = "kind: bevel, module: 2 mm"
    one, other = forces(f"teeth: 20, {wheel}", f"teeth: 40, {wheel}", axes, loss, load)
    assert abs(one.tangential) == pytest.approx(abs(other.tangential))
    assert (one.axial, one.radial) == pytest.approx((other.radial, other.axial))
    # axes along x and y, the pitch line of 20:40 between them: the moment of the force about the apex has the torques
    # as components along the axes, and its component across the pitch line is tangential force times distance
    moment = np.array([1e3 * abs(one.torque), -1e3 * abs(other.torque)])
    pitch_line = np.array([40, 20]) / np.hypot(20, 40)
    across = moment[0] * pitch_line[1] - moment[1] * pitch_line[0]
    assert across == pytest.approx(abs(one.tangential) * hypot(one.radius, other.radius), rel=1e-12)


def test_a_ring_and_its_wheel_push_each_other_with_the_difference_of_their_torques() -> None:
    train = geartrain.load(
        """
extends: planetary-24-18-60
links:
  frame: {wheels: {ring: {teeth: 60, internal: true, module: 1 mm}}}
  planet: {wheels: {p: {teeth: 18, module: 1 mm}}}
gears: [{pair: [s, p]}, {pair: [p, ring], efficiency: 0.9}]
loads: {carrier: -1 N m}
"""
    )
    wheel, ring = (each for each in train.strength().forces if each.pair == "p~ring")
    assert 1e3 * (abs(ring.torque) - abs(wheel.torque)) == pytest.approx(21 * abs(wheel.tangential), rel=1e-12)
    assert abs(ring.tangential) == pytest.approx(abs(wheel.tangential), rel=1e-15)


def triangles(angle: str, clearance: float) -> geartrain.GearTrain:
    return geartrain.load(f"""
links: {{frame: {{}}, a: {{wheels: {{p: {{teeth: 20, module: 2 mm}}}}}}, b: {{wheels: {{w: 40}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, w], tooth_form: {{form: triangular, half_angle: {angle}, clearance_factor: {clearance}}}}}]
inputs: {{a: 1}}
loads: {{b: 1 N m}}
""")


@pytest.mark.parametrize(("angle", "clearance"), [("30 deg", 1.02), ("20 deg", 1.01), ("[25 deg, 35 deg]", 1.015)])
def test_triangles_push_apart_along_the_normals_of_their_flanks(angle: str, clearance: float) -> None:
    """Mean over a pitch of F sin(psi), F = T/n2, by the closure equations: a flank leans by beta1 + x or beta2 - y."""
    train = triangles(angle, clearance)
    sizes = train.meshes[0].transmission.sizes
    pair = sorge.Pair.of(sizes)
    total = 0.0
    for part in pair.path:
        assert part.held is None
        nodes, weights = np.polynomial.legendre.leggauss(12)
        middle, half = float(part.start + part.end) / 2, float(part.start - part.end) / 2
        for node, weight in zip(nodes, weights, strict=True):
            x = sorge.mp.mpf(middle + half * node)
            lean = pair.b1 + x if part.phase == sorge.APPROACH else pair.b2 - pair.angle(x, part.phase)
            total += weight * half * float(sorge.mp.sin(lean) / pair.arms(x, 0, part.phase)[1])
    mean = total / float(pair.p1) * float(pair.D) * 2 / 3
    for each in train.strength().forces:
        assert each.radial == pytest.approx(abs(each.tangential) * mean, rel=1e-6)


def test_nothing_is_said_of_contrates() -> None:
    contrate = forces("teeth: 20, module: 2 mm", "teeth: 40, kind: contrate", "A: {direction: [1, 0, 0]}, B: {}")
    assert contrate == ()
