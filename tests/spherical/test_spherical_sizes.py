"""Sizes of gears on a sphere: printed numbers, cones in space, involutes, compromises and families with one pitch."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from itertools import product
from math import acos, asin, atan, cos, degrees, inf, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import brentq

from geartrain import GearTrainError
from geartrain.spherical import (
    Configuration,
    SphereSizing,
    from_polyhedron,
    ratio_windows,
    size_gears,
    suggest_tooth_counts,
)
from geartrain.spherical.assembly import loop_rules, residue
from geartrain.spherical.gear_sizes import impossibility_theorem

Floats = NDArray[np.float64]
S53 = atan(3 - sqrt(5))
ratios = st.tuples(st.floats(0.2, 2.8), st.integers(5, 200), st.integers(5, 200))


def line_of_action(n_1: Floats, n_2: Floats, g_1: float, g_2: float) -> Floats:
    """Pole q of the great circle that touches both base cones: q.n_1 = sin g_1, q.n_2 = -sin g_2, |q| = 1.

    A point X on it has the normal speed (n_1 x X).(q x X) = n_1.q = sin g_1 per turn speed of gear 1, wherever X
    is: spherical involutes turn in the ratio of their teeth at every angle between the axes.
    """
    C = float(n_1 @ n_2)
    across = np.cross(n_1, n_2)
    square = float(across @ across)
    s_1, s_2 = sin(g_1), -sin(g_2)
    a, b = (s_1 - C * s_2) / square, (s_2 - C * s_1) / square
    rest = 1 - (a * s_1 + b * s_2)
    return np.asarray(a * n_1 + b * n_2 + sqrt(rest / square) * across, dtype=float)


def cones_of(configuration: Configuration) -> dict[str, float]:
    """The pitch cone of each kind in degrees, where it is the same in all meshes."""
    return {kind: degrees(rho) for kind, rho in zip(configuration.kinds, size_gears(configuration).outer, strict=True)}


def tip_gap(teeth: tuple[int, int], kind: str) -> float:
    """Degrees between the tips of equal neighbours of the icosidodecahedron, measured in space."""
    z = {"5": teeth[0], "3": teeth[1]}
    configuration = from_polyhedron("icosidodecahedron", teeth=z)
    rho = atan(sin(S53) / (cos(S53) + teeth[1] / teeth[0]))
    cone = rho if kind == "5" else S53 - rho
    module = 2 * sin(rho) / teeth[0]
    axes = configuration.axes[[k == kind for k in configuration.kinds]]
    return degrees(acos(max(float(axes[0] @ axis) for axis in axes[1:])) - 2 * cone - 2 * module)


def pair_of(S: float, z_1: int, z_2: int) -> SphereSizing:
    """Sizes of two gears whose axes are an angle S [rad] apart."""
    axes = np.array([[0, 0, 1.0], [sin(S), 0, cos(S)]])
    return size_gears(Configuration(("a", "b"), axes, ((0, 1),), ("a", "b"), (0, 0), {"a": z_1, "b": z_2}))


@given(ratios)
def test_the_two_cones_touch_and_roll_with_one_pitch(pair: tuple[float, int, int]) -> None:
    S, z_i, z_j = pair
    assume(cos(S) + min(z_i, z_j) / max(z_i, z_j) > 0.05)  # both convex
    sizing = pair_of(*pair)
    (rho_i, rho_j), pitch = sizing.cones[0], sizing.pitch
    assert rho_i + rho_j == pytest.approx(S, abs=1e-14)
    assert sin(rho_i) / z_i == pytest.approx(pitch, rel=1e-13)
    assert sin(rho_j) / z_j == pytest.approx(pitch, rel=1e-13)


def test_a_crown_gear_and_an_internal_gear_follow_the_same_formula() -> None:
    crown = pair_of(radians(120), 40, 20)
    assert degrees(crown.cones[0, 0]) == pytest.approx(90)
    assert crown.virtual[0] == inf
    assert pair_of(radians(150), 40, 20).cones[0, 0] > pi / 2


@given(ratios)
def test_the_pressure_angle_is_that_between_the_line_of_action_and_the_pitch_circles(
    pair: tuple[float, int, int],
) -> None:
    S, z_1, z_2 = pair
    sizing = pair_of(*pair)
    assume(max(z_1, z_2) * sizing.pitch < 0.999)
    assume(cos(S) + min(z_1, z_2) / max(z_1, z_2) > 0.05)
    c = sizing.base
    n_1, n_2 = np.array([0, 0, 1.0]), np.array([sin(S), 0, cos(S)])
    q = line_of_action(n_1, n_2, np.arcsin(c * z_1), np.arcsin(c * z_2))
    rho = sizing.cones[0, 0]
    P = np.array([sin(rho), 0, cos(rho)])
    assert float(q @ P) == pytest.approx(0, abs=1e-9)  # the line of action passes the pitch point
    along, tangent = np.cross(q, P), np.array([0, 1.0, 0])
    assert acos(min(abs(float(along @ tangent)), 1)) == pytest.approx(sizing.pressure[0], abs=1e-7)


def test_two_pitches_have_cosines_about_that_of_the_mean() -> None:
    alpha = np.unique(size_gears(from_polyhedron("5-4-3", teeth={"5": 15, "4": 12, "3": 6})).pressure.round(12))
    assert len(alpha) == 2
    assert np.prod(np.cos(alpha)) == pytest.approx(cos(radians(20)) ** 2)


def test_the_icosidodecahedron_has_the_printed_sizes() -> None:
    sizing = size_gears(from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12}))
    assert sizing.exact
    assert degrees(sizing.configuration.angle(*sizing.configuration.meshes[0])) == pytest.approx(37.3773681406497)
    assert np.degrees(sizing.cones[0]) == pytest.approx([23.5224184477318, 13.8549496929179], abs=5e-13)
    assert sizing.module == pytest.approx(0.039910786, abs=5e-10)
    assert sqrt(34 + 30 * cos(S53)) / (4 * sin(S53)) == pytest.approx(3.13198541004301, abs=5e-14)


def test_the_windows_of_the_tooth_ratio_are_the_printed_ones() -> None:
    (ico,) = ratio_windows(from_polyhedron("icosidodecahedron"))
    assert (ico.low, ico.high) == pytest.approx((0.794654472, 5.330704256), abs=5e-10)
    assert (ico.low, ico.high) == pytest.approx((cos(S53), sqrt(3) / tan(pi / 10)))
    (cubo,) = ratio_windows(from_polyhedron("cuboctahedron"))
    assert (cubo.low, cubo.high) == pytest.approx((0.577350269, 4.181540550), abs=5e-10)
    assert (cubo.low, cubo.high) == pytest.approx((1 / sqrt(3), sqrt(3) * (1 + sqrt(2))))
    assert ratio_windows(from_polyhedron("octahedron")) == ()


@pytest.mark.parametrize(
    ("teeth", "kind", "gap"),
    [
        ((5, 6), "3", -12.4),
        ((10, 3), "5", -5.7),
        ((5, 3), "5", -1.9),
        ((5, 3), "3", -4.2),
        ((10, 6), "5", 7.2),
        ((10, 6), "3", 5.0),
        ((45, 33), "5", 18.2),
        ((45, 33), "3", 8.5),
    ],
)
def test_tips_clear_or_collide_by_the_printed_degrees(teeth: tuple[int, int], kind: str, gap: float) -> None:
    assert tip_gap(teeth, kind) == pytest.approx(gap, abs=0.05)
    sizing = size_gears(from_polyhedron("icosidodecahedron", teeth={"5": teeth[0], "3": teeth[1]}))
    kinds = dict(zip(sizing.configuration.names, sizing.configuration.kinds, strict=True))
    own = [found for found in sizing.collisions if {kinds[gear] for gear in found.gears} == {kind}]
    assert bool(own) == (gap < 0)
    for found in own:
        assert -degrees(found.short * sizing.module) == pytest.approx(tip_gap(teeth, kind), abs=1e-9)
    assert len(own) in (0, 30)


def test_a_collision_says_who_and_by_how_many_modules() -> None:
    sizing = size_gears(from_polyhedron("icosidodecahedron", teeth={"5": 10, "3": 3}))
    worst = sizing.collisions[0]
    assert worst.room + worst.short == pytest.approx(2)
    assert "modules apart" in str(worst)
    assert "30 pairs collide" in str(sizing)


def test_few_teeth_are_undercut() -> None:
    few = size_gears(from_polyhedron("icosidodecahedron", teeth={"5": 10, "3": 6})).undercut
    assert few == pytest.approx({"5": 10.9, "3": 6.2}, abs=0.05)
    assert size_gears(from_polyhedron("icosidodecahedron", teeth={"5": 30, "3": 18})).undercut == {}


def test_a_set_without_teeth_is_requested_for_them() -> None:
    with pytest.raises(GearTrainError, match="no tooth number is given for 5, 3"):
        size_gears(from_polyhedron("icosidodecahedron"))


def test_sizes_go_to_json() -> None:
    data = size_gears(from_polyhedron("cuboctahedron", teeth={"4": 16, "3": 12})).to_dict()
    assert json.loads(json.dumps(data))["exact"] is True
    assert len(data["meshes"]) == 24


@pytest.mark.parametrize(
    ("solid", "teeth", "says"),
    [
        ("rhombicosidodecahedron", {"5": 25, "4": 14, "3": 12}, "quartic field"),
        ("rhombicuboctahedron", {"4a": 10, "4b": 9, "3": 6}, "3 (z3/z4b)^2 = 1"),
        ("J37", {"4a": 52, "4b": 52, "4c": 52, "3": 30}, "ring of eight equal squares"),
    ],
)
def test_different_pitches_are_reported_with_the_theorem(solid: str, teeth: dict[str, int], says: str) -> None:
    configuration = from_polyhedron(solid, teeth=teeth)
    assert not size_gears(configuration).exact
    assert says in impossibility_theorem(configuration)


def test_one_pitch_is_given_where_the_teeth_allow_it() -> None:
    found = size_gears(from_polyhedron("6-antiprism", teeth={"6": 18, "3": 6}))
    assert found.exact
    assert found.pitch == pytest.approx(sin(radians(63.711516786140)) / 18, abs=1e-13)
    other = from_polyhedron("6-antiprism", teeth={"6": 18, "3": 7})
    assert not size_gears(other).exact
    assert impossibility_theorem(other) == "", "no theorem is against it"


RID, RCO = "rhombicosidodecahedron", "rhombicuboctahedron"
# teeth, mismatch, cones of the first and of the second kind of mesh, pressure angles: at the digits printed
ROWS = [
    (RID, (15, 12, 6), 5.547851179e-03, (17.666640, 14.050834, 13.971515, 6.933642), (20.4316, 19.5580)),
    (RID, (25, 14, 12), 1.059490553e-03, (20.439767, 11.277708, 11.265609, 9.639549), (20.0832, 19.9164)),
    (RID, (40, 34, 15), -3.342905645e-04, (17.178223, 14.539252, 14.544220, 6.360937), (19.9737, 20.0263)),
    (RID, (45, 52, 12), 1.891346202e-04, (14.684307, 17.033168, 17.029848, 3.875309), (20.0149, 19.9851)),
    (RID, (85, 86, 27), -3.579078071e-05, (15.763553, 15.953922, 15.954508, 4.950650), (19.9972, 20.0028)),
    (RCO, (10, 9, 6), -8.226170709e-04, (23.748891, 21.251109, 21.269447, 13.994942), (19.9351, 20.0646)),
    (RCO, (22, 25, 12), 4.051382824e-04, (20.985500, 24.014500, 24.004160, 11.260230), (20.0319, 19.9681)),
    (RCO, (32, 34, 18), 5.692132749e-05, (21.780865, 23.219135, 23.217736, 12.046654), (20.0045, 19.9955)),
    (RCO, (52, 52, 30), -2.616291184e-04, None, None),
    (RCO, (70, 101, 33), -6.784512228e-06, (18.205642, 26.794358, 26.794554, 8.469836), (19.9995, 20.0005)),
]


@pytest.mark.parametrize(("solid", "teeth", "mismatch", "cones", "pressures"), ROWS, ids=str)
def test_the_printed_compromises_come_out(
    solid: str,
    teeth: tuple[int, ...],
    mismatch: float,
    cones: tuple[float, ...] | None,
    pressures: tuple[float, ...] | None,
) -> None:
    configuration = from_polyhedron(solid)
    fixed = dict(zip(dict.fromkeys(configuration.kinds), teeth, strict=True))
    (found,) = suggest_tooth_counts(configuration, 120, fixed=fixed)
    assert found.mismatch == pytest.approx(mismatch, abs=6e-13 * (1 if abs(mismatch) > 1e-3 else 0.1))
    if cones:
        assert np.degrees(found.cones).ravel() == pytest.approx(cones, abs=6e-7)
        assert np.degrees(found.pressure) == pytest.approx(pressures, abs=6e-5)
    assert found.residue == 0


@pytest.mark.parametrize("solid", [RID, RCO])
def test_the_search_itself_finds_them(solid: str) -> None:
    rows = [teeth for name, teeth, _, cones, _ in ROWS if name == solid and cones]
    found = suggest_tooth_counts(from_polyhedron(solid), 120, order="front")
    front = [tuple(row.teeth.values()) for row in found]
    assert set(rows) <= set(front)
    assert front[0] == rows[0]
    assert [row.total for row in found] == sorted(row.total for row in found)
    misses = [abs(row.mismatch) for row in found]
    assert misses == sorted(misses, reverse=True)
    best = suggest_tooth_counts(from_polyhedron(solid), 120, 1)
    assert tuple(best[0].teeth.values()) == front[-1]


def test_the_best_without_closure_is_useless() -> None:
    """101/66/45 has a mismatch of 4.7e-7, and does not close."""
    rid = from_polyhedron("rhombicosidodecahedron")
    sizing = size_gears(replace(rid, teeth={"5": 101, "4": 66, "3": 45}))
    assert sizing.mismatch == pytest.approx(4.715872e-07, abs=6e-14)
    assert not suggest_tooth_counts(rid, 120, fixed={"5": 101, "4": 66, "3": 45})
    rco = from_polyhedron("rhombicuboctahedron")
    assert size_gears(replace(rco, teeth={"4a": 120, "4b": 71, "3": 81})).mismatch == pytest.approx(
        1.334400e-06, abs=6e-13
    )


@pytest.mark.parametrize(
    ("n", "teeth", "mismatch"),
    [
        (4, (36, 21), 7.3e-3),
        (4, (52, 30), 5.2e-4),
        (5, (50, 21), 1.0e-3),
        (6, (18, 6), 0),
        (6, (36, 12), 0),
        (6, (54, 18), 0),
        (8, (88, 21), 2.0e-3),
        (10, (80, 15), 4.7e-4),
    ],
)
def test_uniform_antiprisms(n: int, teeth: tuple[int, int], mismatch: float) -> None:
    found = suggest_tooth_counts(from_polyhedron(f"{n}-antiprism"), 120, 100)
    (row,) = [row for row in found if tuple(row.teeth.values()) == teeth]
    assert abs(row.mismatch) == pytest.approx(mismatch, abs=max(5e-2 * mismatch, 1e-14))


@pytest.mark.parametrize("minimum", [6, 10])
def test_the_search_agrees_with_one_set_at_a_time(minimum: int) -> None:
    """Closure by the printed rules, room by measuring every pair of gears."""
    rco = from_polyhedron("rhombicuboctahedron")
    found = suggest_tooth_counts(rco, 20, 10**6, minimum=minimum, mismatch=inf)
    good = []
    for a, b, c in product(range(minimum, 21), repeat=3):
        if c % 3 == 0 and (a - 2 * b) % 4 == 0:
            sizing = size_gears(replace(rco, teeth={"4a": a, "4b": b, "3": c}))
            if not sizing.collisions:
                good.append(((a, b, c), sizing.mismatch))
    assert sorted(tuple(row.teeth.values()) for row in found) == [row[0] for row in good]
    expected = dict(good)
    assert all(abs(row.mismatch) == pytest.approx(expected[tuple(row.teeth.values())]) for row in found)  # type: ignore[index]
    assert found.considered == (21 - minimum) ** 3
    assert sum(found.removed.values()) + len(found) == found.considered


def test_an_empty_search_says_what_removed_how_many() -> None:
    found = suggest_tooth_counts(from_polyhedron("icosidodecahedron"), 7, minimum=6)
    assert len(found) == 0
    assert found.removed["loops that do not close"] == found.considered == 4
    assert "No tooth counts meet every condition" in str(found)
    assert "rejected: 4 by loops" in " ".join(str(found).split())


def test_suggestions_give_sets_with_teeth() -> None:
    found = suggest_tooth_counts(from_polyhedron("icosidodecahedron"), 60, 5, order="teeth")
    assert found[0].teeth == {"5": 10, "3": 6}
    assert size_gears(replace(found.configuration, teeth=dict(found[0].teeth))).exact
    assert found.beyond > 0


def test_an_odd_loop_is_named_instead_of_searched() -> None:
    with pytest.raises(GearTrainError, match="has an odd number of gears"):
        suggest_tooth_counts(from_polyhedron("dodecahedron"))


def test_too_many_kinds_are_refused_before_the_search() -> None:
    axes = np.random.default_rng(3).normal(size=(6, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    names = tuple("abcdef")
    chain = tuple((i, i + 1) for i in range(5))
    with pytest.raises(GearTrainError, match="combinations of tooth numbers"):
        suggest_tooth_counts(Configuration(names, axes, chain, names, (0,) * 6), 60)


def test_loops_that_only_nearly_close_pass_with_a_tolerance() -> None:
    """The antiprism moved for 20/13 misses by 0.000226907 of a pitch."""
    moved = moved_antiprism(4, 20, 13)
    fixed = {"4": 20, "3": 13}
    assert not suggest_tooth_counts(moved, fixed=fixed)
    (found,) = suggest_tooth_counts(moved, fixed=fixed, tolerance=1e-3)
    assert found.residue == pytest.approx(0.000226907, abs=5e-10)
    assert found.mismatch == pytest.approx(0, abs=1e-13)


@pytest.mark.parametrize(
    ("solid", "rule"),
    [
        ("cuboctahedron", {"4": Fraction(1, 2), "3": Fraction(1, 3)}),
        ("icosidodecahedron", {"5": Fraction(2, 5), "3": Fraction(1, 3)}),
    ],
)
def test_equal_spacing_gives_exact_rules(solid: str, rule: dict[str, Fraction]) -> None:
    assert loop_rules(from_polyhedron(solid)) == (tuple(rule.values()),)  # type: ignore[arg-type]
    assert loop_rules(from_polyhedron("octahedron")) == ()


def worst_tangency(configuration: Configuration) -> float:
    """Largest | angle between axes - asin(l z_i) - asin(l z_j) | over the meshes, in space."""
    sizing = size_gears(configuration)
    cones = np.arcsin(sizing.pitch * sizing.teeth)
    return float(max(abs(configuration.angle(i, j) - cones[i] - cones[j]) for i, j in configuration.meshes))


def worst_residue(configuration: Configuration) -> float:
    """Largest residue of a region, in pitches."""
    teeth = [configuration.teeth[kind] for kind in dict.fromkeys(configuration.kinds)]
    return max((abs(float(residue(teeth, rule))) for rule in loop_rules(configuration)), default=0.0)


def moved_antiprism(n: int, cap: int, side: int) -> Configuration:
    return from_polyhedron(f"{n}-antiprism", teeth={str(n): cap, "3": side}, exact=True)


def with_idlers(solid: str, teeth: dict[str, int], idler: int) -> Configuration:
    return from_polyhedron(solid, "faces+edges", teeth={**teeth, "e": idler})


def icosahedral(vertex: int, face: int, edge: int) -> Configuration:
    return from_polyhedron("icosahedron", "faces+vertices+edges", teeth={"v": vertex, "3": face, "e": edge})


def antiprism_latitude(n: int, cap: int, side: int) -> float:
    """Latitude of the side axes (rad) at which caps and sides of an n-antiprism share one pitch.

    rho_cap + rho_side = pi/2 - lat with sin rho proportional to the teeth; two sides stand 2 rho_side apart.
    """

    def gap(latitude: float) -> float:
        between = pi / 2 - latitude
        apart = acos(cos(latitude) ** 2 * cos(pi / n) - sin(latitude) ** 2)
        return 2 * float(np.arctan2(sin(between), cos(between) + cap / side)) - apart

    return float(brentq(gap, 0.0, pi / 2 - 1e-9, xtol=1e-16, rtol=1e-15))


def icosahedral_pitch(z_1: int, z_2: int, z_3: int) -> tuple[float, float]:
    """Pitch lambda (radii of the sphere) and place t (rad) of the edge gears of the icosahedral set of 92.

    t = asin(l z1) + asin(l z3) from a vertex along an edge; the face axis is then d away,
    cos d = cos P cos t + sin P sin t cos 36 deg with P the angle from vertex to face, and asin(l z2) + asin(l z3) = d.
    """

    def place(pitch: float) -> float:
        return asin(min(pitch * z_1, 1)) + asin(min(pitch * z_3, 1))

    def excess(pitch: float) -> float:
        t = place(pitch)
        d = acos(cos(S53) * cos(t) + sin(S53) * sin(t) * cos(pi / 5))
        return asin(min(pitch * z_2, 1)) + asin(min(pitch * z_3, 1)) - d

    # the largest gear is at most a crown gear, and past the middle of the edge its two gears would change places
    middle = brentq(lambda pitch: place(pitch) - atan(2) / 2, 0.0, 1 / max(z_1, z_3))
    pitch = float(brentq(excess, 0.0, min(middle, 1 / z_2), xtol=1e-16, rtol=1e-15))
    return pitch, place(pitch)


@pytest.mark.parametrize(
    ("n", "cap", "side", "cones", "latitude", "misses"),
    [
        (4, 16, 16, (32.765099739649, 32.765099739649), 24.469800520702, 0),
        (4, 20, 13, (45.675215687530, 27.710471900205), 16.614312412264, 0.000226907),
        (5, 20, 16, None, None, 0.001251087),
        (6, 18, 6, (63.711516786140, 17.389054334048), 8.899428879811, 0),
        (6, 18, 7, None, None, 0.000701935),
        (8, 66, 27, None, None, 0.000245015),
    ],
)
def test_moved_antiprisms(
    n: int, cap: int, side: int, cones: tuple[float, float] | None, latitude: float | None, misses: float
) -> None:
    configuration = moved_antiprism(n, cap, side)
    assert (len(configuration.axes), len(configuration.meshes)) == (2 * n + 2, 4 * n)
    assert size_gears(configuration).exact
    assert worst_tangency(configuration) < 4e-13
    assert worst_residue(configuration) == pytest.approx(misses, abs=5e-10 if misses else 4e-14)
    if cones:
        assert tuple(cones_of(configuration).values()) == pytest.approx(cones, abs=2.4e-11)
        assert degrees(antiprism_latitude(n, cap, side)) == pytest.approx(latitude, abs=6e-13)


@pytest.mark.parametrize(
    ("solid", "teeth", "gears", "meshes", "cones"),
    [
        ("cuboctahedron", {"4": 16, "3": 12}, 38, 48, (20.066771092874, 14.912063400687, 9.878387911842)),
        ("icosidodecahedron", {"5": 20, "3": 12}, 92, 120, (15.660040467283, 9.320528125152, 6.198399774108)),
    ],
)
def test_idler_spheres(
    solid: str, teeth: dict[str, int], gears: int, meshes: int, cones: tuple[float, float, float]
) -> None:
    configuration = with_idlers(solid, teeth, 8)
    assert (len(configuration.axes), len(configuration.meshes)) == (gears, meshes)
    assert size_gears(configuration).exact
    assert worst_tangency(configuration) < 4e-13
    assert tuple(cones_of(configuration).values()) == pytest.approx(cones, abs=2.4e-11)
    assert worst_residue(configuration) == 0
    assert all(isinstance(share, Fraction) for rule in loop_rules(configuration) for share in rule)


@pytest.mark.parametrize("idler", [7, 8, 11])
def test_idlers_are_free_and_faces_are_not(idler: int) -> None:
    assert worst_residue(with_idlers("icosidodecahedron", {"5": 25, "3": 15}, idler)) == 0
    assert worst_residue(with_idlers("icosidodecahedron", {"5": 20, "3": 13}, idler)) > 0.3


@pytest.mark.parametrize(
    ("teeth", "pitch", "t", "cones", "misses"),
    [
        ((35, 36, 16), 0.007584691983, 22.364852671356, (15.394538607, 15.845775704, 6.970314064), 0.004036570),
        ((25, 36, 11), 0.008972473198, 18.626569299234, (12.962414599, 18.844996535, 5.664154700), 0.007474965),
        ((20, 42, 11), 0.008537056822, 15.219363340421, (9.830913080, 21.011565220, 5.388450260), 0.000464997),
        ((45, 57, 27), 0.004879252123, 20.253704374064, (12.683563666, 16.147875611, 7.570140708), 0.000215207),
        ((15, 18, 12), 0.013497136794, 21.001685174950, (11.680677640, 14.060626578, 9.321007535), 0.475690867),
    ],
)
def test_the_icosahedral_set_of_92(
    teeth: tuple[int, int, int], pitch: float, t: float, cones: tuple[float, ...], misses: float
) -> None:
    found, place = icosahedral_pitch(*teeth)
    assert found == pytest.approx(pitch, abs=6e-13)
    assert degrees(place) == pytest.approx(t, abs=6e-13)
    configuration = icosahedral(*teeth)
    assert (len(configuration.axes), len(configuration.meshes)) == (92, 180)
    assert size_gears(configuration).pitch == pytest.approx(pitch, abs=6e-13)
    assert worst_tangency(configuration) < 4e-13
    assert sorted(cones_of(configuration).values()) == pytest.approx(sorted(cones), abs=6e-10)
    # regions of two kinds: those beside a vertex miss by the printed residue, those across an edge by twice that
    counts = [configuration.teeth[kind] for kind in dict.fromkeys(configuration.kinds)]
    around = {abs(round(float(residue(counts, rule)), 9)) for rule in loop_rules(configuration)}
    twice = abs(2 * misses - round(2 * misses))
    assert sorted(around) == pytest.approx(sorted([misses, twice]), abs=2e-9)


def test_not_all_printed_teeth_of_the_92_leave_room_for_tips() -> None:
    assert size_gears(icosahedral(35, 36, 16)).collisions == ()
    assert size_gears(icosahedral(45, 57, 27)).collisions == ()
    assert len(size_gears(icosahedral(20, 42, 11)).collisions) == 30
