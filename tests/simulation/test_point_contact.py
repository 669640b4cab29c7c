"""Helical wheels on crossed axes under load: printed ellipses, helicoids put into space, and the balance of forces."""

from __future__ import annotations

from math import acos, atan2, cos, degrees, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import brentq

import geartrain
from geartrain.simulation.strength import CrossedWheels, contact_ellipse

ALPHA = radians(20)
Floats = NDArray[np.float64]

CROSSED = """
name: crossed
axes:
  A: {direction: [0, 0, 1], position: [0 mm, 0 mm, 0 mm]}
  B: {direction: [0, 1, 0], position: [42.426406871 mm, 0 mm, 0 mm]}
links:
  frame: {}
  a: {wheels: {p: {teeth: 20, helix_angle: 45 deg, hand: right, module: 1.5 mm, material: steel}}}
  b: {wheels: {w: {teeth: 20, helix_angle: 45 deg, hand: right, module: 1.5 mm, material: brass}}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [{pair: [p, w], friction: 0.1}]
inputs: {a: 1}
loads: {a: 1 N m}
solve_for: b
"""


@pytest.mark.parametrize(
    ("angle", "longer", "shorter"),
    [(30, 2.731, 0.493), (45, 1.926, 0.604), (60, 1.486, 0.717), (80, 1.128, 0.893), (90, 1.0, 1.0)],
)
def test_ellipses_are_those_of_the_printed_table(angle: float, longer: float, shorter: float) -> None:
    """Timoshenko and Goodier, Theory of Elasticity, article on two bodies in contact: m and n by theta."""
    modulus = 200.0
    found = contact_ellipse(90, sqrt(modulus / pi), (0.5, 0.5), radians(angle))
    unit = (3 * 90 / (4 * modulus * 0.5)) ** (1 / 3)
    assert (found.longer / unit, found.shorter / unit) == pytest.approx((longer, shorter), abs=6e-4)
    assert found.pressure == pytest.approx(1.5 * 90 / (pi * found.longer * found.shorter))


@given(st.floats(1e-3, 1.0), st.floats(0.05, 20), st.floats(0.05, 20))
def test_pressure_goes_to_that_of_spheres_and_grows_with_force_by_its_cube_root(
    w: float, one: float, two: float
) -> None:
    angle = w * pi / 2
    first, second = (contact_ellipse(force, 190.0, (one, two), angle) for force in (10, 80))
    assert second.pressure == pytest.approx(2 * first.pressure)
    assert first.longer >= first.shorter * (1 - 1e-12)


def helicoid(radius: float, helix: float) -> tuple[float, float]:
    """Radius of the base cylinder, and rise (mm per rad, right-handed) of the helix on it."""
    transverse = atan2(tan(ALPHA), cos(helix))
    return radius * cos(transverse), radius / tan(helix)


def surface(wheel: tuple[float, float], angle: float, along: float) -> Floats:
    """A point of an involute helicoid about the z axis: from the helix on the base cylinder along its tangent."""
    rb, rise = wheel
    start = np.array([rb * cos(angle), rb * sin(angle), rise * angle])
    tangent = np.array([-rb * sin(angle), rb * cos(angle), rise]) / np.hypot(rb, rise)
    return np.asarray(start + along * tangent)


def curvature(wheel: tuple[float, float], along: float) -> tuple[Floats, Floats]:
    """Of the helicoid at one of its points: its normal, and its curvature as a tensor in space, by differences."""
    h = 2e-3

    def at(a: int, b: int) -> Floats:
        return surface(wheel, a * h, along + b * h)

    first = np.array([(at(1, 0) - at(-1, 0)) / (2 * h), (at(0, 1) - at(0, -1)) / (2 * h)])
    normal = np.cross(*first)
    normal /= np.linalg.norm(normal)
    mixed = (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / 4
    own = at(1, 0) - 2 * at(0, 0) + at(-1, 0), at(0, 1) - 2 * at(0, 0) + at(0, -1)
    second = np.array([[own[0] @ normal, mixed @ normal], [mixed @ normal, own[1] @ normal]]) / h**2
    dual = np.linalg.pinv(first).T
    return normal, dual.T @ second @ dual


def frame_of(normal: Floats, axis: Floats) -> Floats:
    """A normal, and what stands at right angles to it and to an axis."""
    beside = np.cross(normal, axis)
    beside /= np.linalg.norm(beside)
    return np.stack([normal, beside, np.cross(normal, beside)])


@pytest.mark.parametrize(
    ("radii", "helix"),
    [((20.0, 30.0), (45, 45)), ((12.0, 40.0), (60, 30)), ((11.5, 61.0), (80, 10)), ((25.0, 18.0), (50, -20))],
)
def test_flanks_are_curved_as_helicoids_in_space(radii: tuple[float, float], helix: tuple[float, float]) -> None:
    """Each flank's radius across its lines, and the angle at which both lines cross, from the surfaces themselves."""
    lean = radians(helix[0]), radians(helix[1])
    wheels = CrossedWheels(radii, lean, 2.0, ALPHA)
    normal_there = np.array([cos(ALPHA), 0.0, sin(ALPHA)])
    lines = []
    for at, side in ((0, 1), (1, -1)):
        rb, rise = helicoid(radii[at], lean[at])
        along = sqrt(radii[at] ** 2 - rb**2) * np.hypot(rb, rise) / rb  # out to the pitch cylinder
        normal, tensor = curvature((rb, rise), along)
        values, vectors = np.linalg.eigh(tensor)
        order = np.argsort(np.abs(values))
        assert abs(values[order[2]]) == pytest.approx(1 / wheels.flank_radius(at), rel=1e-4)
        assert abs(values[order[1]]) < 1e-5
        # put where both touch: the same normal, and the wheel's own axis
        axis = np.array([side * sin(lean[at]), cos(lean[at]), 0.0])
        sign = np.sign(normal[2] * (normal_there @ axis))
        here = frame_of(sign * normal, np.array([0.0, 0.0, 1.0]))
        lines.append(frame_of(normal_there, axis).T @ here @ np.cross(normal, vectors[:, order[2]]))
    assert np.linalg.norm(np.cross(*lines)) == pytest.approx(sin(wheels.crossing), rel=1e-3)


def test_contact_ends_where_tips_are_reached() -> None:
    """The end of contact stands as far from the axle as the tip circle."""
    wheels = CrossedWheels((20.0, 30.0), (pi / 4, pi / 4), 2.0, ALPHA)
    low = CrossedWheels((20.0, 30.0), (pi / 4, pi / 4), 2.0, ALPHA, (0.8, 1.0))
    assert low.ends[0] == wheels.ends[0]
    assert low.ends[1] < wheels.ends[1]
    back, front = wheels.ends
    normal = np.array([cos(ALPHA), 0.0, sin(ALPHA)])
    for place, height, radius, side in ((front, -20.0, 20.0, 1), (-back, 30.0, 30.0, -1)):
        axis = np.array([side * sin(pi / 4), cos(pi / 4), 0.0])
        off = place * normal - np.array([0.0, 0.0, height])
        assert np.linalg.norm(off - (off @ axis) * axis) == pytest.approx(radius + 2.0)
    narrow = CrossedWheels((20.0, 30.0), (pi / 4, pi / 4), 2.0, ALPHA, widths=(3.0, 100.0))
    assert narrow.contact_ratio < wheels.contact_ratio
    assert narrow.bounded_by == {"width"}
    assert wheels.bounded_by == {"tip"}


def test_tooth_pairs_are_counted_on_the_way() -> None:
    wheels = CrossedWheels((20.0, 30.0), (pi / 4, pi / 4), 2.0, ALPHA)
    back, front = wheels.ends
    places = np.linspace(-back, front, 2000, endpoint=False)
    mean = np.mean([1 / wheels.tooth_pairs(place) for place in places])
    # each couple is met once by each: the way over the mean number is one pitch
    assert (back + front) * mean == pytest.approx(wheels.pitch, rel=2e-3)


def test_a_declared_pair_presses_as_hard_on_both_wheels() -> None:
    found = geartrain.load(CROSSED).strength()
    (point,) = found.points.values()
    forces = {each.wheel: each for each in found.forces}
    for force in forces.values():
        # all three parts together are the force across the flanks and the friction along them
        whole = force.tangential**2 + force.axial**2 + (force.radial or 0) ** 2
        assert whole == pytest.approx(point.normal_force**2 * (1 + 0.1**2))
    steel, brass = point.wheels
    assert steel.safety == pytest.approx(1.6 * 340 / point.pressure)
    assert brass.safety == pytest.approx(1.6 * 200 / point.pressure)
    assert found.weakest.part == "w"
    assert not found.neglected


def test_what_a_crossed_pair_lacks_is_named() -> None:
    bare = geartrain.load(CROSSED.replace(", material: brass", "")).strength()
    assert bare.neglected[0].why == "'w' has no `material`"
    assert not bare.points


def test_roots_bend_as_spur_wheels_of_the_teeth_across() -> None:
    """Wheels of 20 teeth that have 50 across: a load at the tip of involutes, over the thickness of the spur wheel."""
    lean = brentq(lambda b: 20 / ((1 - (sin(b) * cos(ALPHA)) ** 2) * cos(b)) - 50, 0.5, 1.0)
    radius = 1.5 * 10 / cos(lean)
    text = CROSSED.replace("45 deg", f"{degrees(lean):.12f} deg").replace("42.426406871", f"{2 * radius:.12f}")
    across = pi - 2 * lean  # the axes stand at twice the helix angle, no longer at 90 degrees
    text = text.replace("direction: [0, 1, 0]", f"direction: [0, {sin(across):.15f}, {-cos(across):.15f}]")
    (point,) = geartrain.load(text).strength().points.values()
    spur = geartrain.load("""
links: {frame: {}, a: {wheels: {p: {teeth: 50, module: 1.5 mm}}}, b: {wheels: {w: 50}}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [p ~ w]
tooth_form: {form: involute}
material: steel
face_width: 10 mm
inputs: {a: 1}
loads: {b: 1 N m}
""").strength()
    thick = spur.pairs["p~w"].wheels[0].thickness
    at_tip = acos(25 * cos(ALPHA) / 26)
    half = pi / 100 + (tan(ALPHA) - ALPHA) - (tan(at_tip) - at_tip)
    bent = 3 * point.normal_force * cos(at_tip - half) / thick**2
    assert [wheel.tip_stress for wheel in point.wheels] == pytest.approx([bent, bent], rel=2e-3)
    assert point.wheels[1].root_safety == pytest.approx(200 / bent, rel=2e-3)
    # narrow teeth have no room for the spread
    (narrow,) = (
        geartrain.load(text.replace("mm, material: steel", "mm, thickness: 1 mm, material: steel"))
        .strength()
        .points.values()
    )
    stresses = [wheel.tip_stress for wheel in narrow.wheels]
    assert stresses[1] == pytest.approx(bent, rel=2e-3)
    assert stresses[0] > 2 * bent


def test_a_force_at_a_point_bends_no_less_of_a_tooth_than_twice_its_lever() -> None:
    """Elasticity in space: a tapered tooth on its rim, the moment on a unit of length at its root."""
    fem = pytest.importorskip("skfem")
    elasticity = pytest.importorskip("skfem.models.elasticity")
    height, root, tip, patch, above = 2.0, 2.0, 0.8, 0.35, 0.2
    along = np.linspace(0, 1, 9) ** 1.6 * 8.0
    mesh = fem.MeshHex.init_tensor(along, np.linspace(-0.5, 0.5, 3), np.r_[-2.0, -1.0, np.linspace(0, height, 5)])
    z = mesh.p[2]
    thick = np.where(z >= 0, root + (tip - root) * z / height, np.where(z < -1.5, 3 * root, 2 * root))
    mesh = fem.MeshHex(mesh.p * np.array([np.ones_like(z), thick, np.ones_like(z)]), mesh.t)
    basis = fem.Basis(mesh, fem.ElementVector(fem.ElementHex2()), intorder=4)
    lam, mu = elasticity.lame_parameters(1.0, 0.3)
    stiffness = elasticity.linear_elasticity(lam, mu).assemble(basis)
    top = fem.FacetBasis(
        mesh, basis.elem, facets=mesh.facets_satisfying(lambda x: abs(x[2] - height) < 1e-9), intorder=6
    )
    load = fem.LinearForm(lambda v, w: np.exp(-((w.x[0] / patch) ** 2)) * v[1]).assemble(top)
    force = 2 * fem.Functional(lambda w: np.exp(-((w.x[0] / patch) ** 2))).assemble(top)
    held = basis.get_dofs(lambda x: abs(x[2] + 2.0) < 1e-9).all()
    middle = basis.get_dofs(lambda x: abs(x[0]) < 1e-9).all(["u^1"])
    moved = fem.solve(*fem.condense(stiffness, load, D=np.unique(np.r_[held, middle])))

    def gradient(points: Floats, way: int, step: float) -> Floats:
        shift = step * np.eye(3)[:, [way]]
        first, second = (np.asarray(basis.probes(points + sign * shift) @ moved).reshape(3, -1) for sign in (1, -1))
        return np.asarray((first - second)[way] / (2 * step))

    nodes, weights = np.polynomial.legendre.leggauss(8)
    half = (root + (tip - root) * above / height) / 2
    points = np.array([np.full(8, 0.05), nodes * half, np.full(8, above)])
    strain = [gradient(points, way, 1e-3 if way != 1 else 1e-4) for way in range(3)]
    stress = lam * sum(strain) + 2 * mu * strain[2]
    moment = abs(float((stress * nodes * half**2 * weights).sum())) / force
    spread = 1 / moment  # levers: whatever they are, moment per length over force does not depend on them
    assert 2.0 < spread < 2.4
