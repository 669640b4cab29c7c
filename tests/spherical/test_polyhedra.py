"""Gears on polyhedra: the solids, their symmetries, where gears stand on them, and the trains they make."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import product
from math import acos, asin, atan, degrees, pi, radians, sqrt

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from geartrain import GearTrain, GearTrainError
from geartrain.spherical import (
    Configuration,
    from_polyhedron,
    polyhedron,
    size_gears,
    solid,
    solid_names,
    survey,
    to_train,
)

NAMES = [name for name in solid_names() if not name.startswith("n-")]
SURVEYED = (*NAMES[:18], "J37")  # Platonic and Archimedean solids
FAMILIES = [
    f"{n}-{family}" for n in (3, 4, 5, 6, 11) for family in ("prism", "antiprism", "bipyramid", "trapezohedron")
]


def angle(configuration: Configuration, *kinds: str) -> float:
    """The angle (deg) of all meshes, or of those between two kinds."""
    found = [
        configuration.angle(i, j)
        for i, j in configuration.meshes
        if not kinds or sorted(kinds) == sorted((configuration.kinds[i], configuration.kinds[j]))
    ]
    assert max(found) - min(found) < 1e-13
    return degrees(found[0])


def refusal(*arguments: object, **options: object) -> str:
    with pytest.raises(GearTrainError) as caught:
        from_polyhedron(*arguments, **options)  # type: ignore[arg-type]
    return str(caught.value)


@pytest.mark.parametrize("name", NAMES + FAMILIES)
def test_a_solid_is_closed_and_its_faces_look_outwards(name: str) -> None:
    shape = solid(name)
    assert len(shape.vertices) - len(shape.edges) + len(shape.faces) == 2
    for face, normal, height in zip(shape.faces, shape.normals, shape.heights, strict=True):
        corners = shape.vertices[list(face)]
        assert corners @ normal == pytest.approx(np.full(len(face), height), abs=3e-15 * shape.size)
        turn = sum(np.cross(a, b) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True))
        assert turn @ normal > 0, "counterclockwise seen from outside"


@pytest.mark.parametrize("name", [*SURVEYED, *(name for name in FAMILIES if "prism" in name)])
def test_all_edges_of_a_uniform_solid_have_length_two(name: str) -> None:
    shape = solid(name)
    ends = np.array(shape.edges)
    lengths = np.linalg.norm(shape.vertices[ends[:, 0]] - shape.vertices[ends[:, 1]], axis=1)
    assert np.abs(lengths - 2).max() < 2e-15 * shape.size
    assert np.ptp(np.linalg.norm(shape.vertices, axis=1)) < 2e-15 * shape.size


@pytest.mark.parametrize(
    ("name", "order"),
    [
        ("tetrahedron", 24),
        ("cube", 48),
        ("snub cube", 24),
        ("icosidodecahedron", 120),
        ("snub dodecahedron", 60),
        ("J37", 16),
        ("6-prism", 24),
        ("4-prism", 48),
        ("3-antiprism", 48),
        ("7-trapezohedron", 28),
    ],
)
def test_a_solid_has_the_symmetries_of_its_group(name: str, order: int) -> None:
    found = solid(name).symmetries
    assert len(found) == order
    assert np.abs(found @ found.transpose(0, 2, 1) - np.eye(3)).max() < 3e-15
    assert len({tuple(np.round(matrix, 6).ravel() + 0.0) for matrix in found}) == order


@pytest.mark.parametrize("name", NAMES)
def test_the_dual_of_the_dual_is_the_solid(name: str) -> None:
    shape = solid(name)
    again = shape.dual().dual()
    assert Counter(map(len, again.faces)) == Counter(map(len, shape.faces))
    nearest = np.linalg.norm(again.vertices[:, None] - shape.vertices[None], axis=2).min(axis=1)
    assert nearest.max() < 1e-14 * shape.size


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("buckyball", "truncated icosahedron"),
        ("5-3", "icosidodecahedron"),
        ("5-4-3", "rhombicosidodecahedron"),
        ("hexagonal antiprism", "6-antiprism"),
        (" Snub  Cube", "snub cube"),
        ("pseudo-rhombicuboctahedron", "J37"),
    ],
)
def test_a_solid_goes_by_several_names(said: str, meant: str) -> None:
    assert solid(said).name == meant


@pytest.mark.parametrize(
    ("said", "answer"),
    [
        ("icosidodecahedrn", "did you mean 'icosidodecahedron'"),
        ("teapot", "use a name such as"),
        ("2-prism", "3 to 360"),
        ("7-antiprisma", "'7-antiprism'"),
        ("999999999-prism", "3 to 360"),
    ],
)
def test_an_unknown_solid_is_refused_with_a_suggestion(said: str, answer: str) -> None:
    assert answer in refusal(said)


BOX = list(product((-1, 1), (-2, 2), (-3, 3)))


def test_vertices_in_any_order_make_the_solid() -> None:
    shape = polyhedron(BOX)
    assert (len(shape.faces), len(shape.edges), len(shape.symmetries)) == (6, 12, 8)
    assert not shape.vertices.flags.writeable
    assert not from_polyhedron(shape).axes.flags.writeable
    assert from_polyhedron(BOX).kinds == ("4a", "4a", "4b", "4b", "4c", "4c")


@pytest.mark.parametrize(
    ("points", "answer"),
    [
        ([*BOX, (0, 0, 0.5)], "vertices[8] (0, 0, 0.5) is not a vertex"),
        ([*BOX, (0, 0, 3)], "vertices[8] (0, 0, 3) is not a vertex"),
        ([*BOX, (0, 2, 3)], "vertices[8] (0, 2, 3) is not a vertex"),
        ([*BOX, (0, 0, 3 + 1e-12)], "vertices[8] (0, 0, 3) is not a vertex"),
        ([*BOX, (1, 2, 3)], "vertices[8] repeats vertices[7] (1, 2, 3)"),
        ([*BOX, (1, 2, 3 + 1e-9)], "vertices[8] repeats vertices[7]"),
        (BOX[:3], "3 points do not make a solid"),
        (BOX[:4], "are in one plane"),
        ([(0, 0, 0)] * 5, "are in one plane"),
        ([(0, 0), (1, 1)], "not a list of points"),
        ([(0, 0, float("inf"))] * 4, "not a list of points"),
        ([(0, 0, 1), (0, 1)], "not a list of points"),
        ([[x + 5, y, z] for x, y, z in BOX], "the origin is the centre of the sphere"),
        ([[x + 1, y, z] for x, y, z in BOX], "recentre=True"),
    ],
)
def test_points_that_are_no_solid_about_the_origin_are_refused(points: object, answer: str) -> None:
    assert answer in refusal(points)


def test_a_solid_beside_the_origin_can_be_moved() -> None:
    moved = from_polyhedron([[x + 5, y, z] for x, y, z in BOX], recentre=True)
    assert moved.axes == pytest.approx(from_polyhedron(BOX).axes, abs=1e-15)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6), st.integers(4, 30))
def test_random_points_on_a_sphere_make_a_triangulation(seed: int, count: int) -> None:
    points = np.random.default_rng(seed).normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    shape = polyhedron(points, recentre=True)
    assert (len(shape.edges), len(shape.faces)) == (3 * count - 6, 2 * count - 4)
    assert len(shape.symmetries) == 1 or count == 4


@settings(max_examples=20, deadline=None)
@given(st.sampled_from([*SURVEYED, "6-antiprism"]), st.integers(0, 10**6))
def test_turning_and_shuffling_a_solid_changes_no_kind_and_no_angle(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    still = from_polyhedron(name)
    turned = from_polyhedron(3.7 * rng.permutation(solid(name).vertices @ turn))
    assert Counter(turned.kinds) == Counter(still.kinds)
    assert Counter(zip(turned.kinds, turned.regular, strict=True)) == Counter(
        zip(still.kinds, still.regular, strict=True)
    )
    for pair in {(still.kinds[i], still.kinds[j]) for i, j in still.meshes}:
        assert angle(turned, *pair) == pytest.approx(angle(still, *pair), abs=1e-11)


@pytest.mark.parametrize(
    ("name", "gears", "count", "meshes"),
    [
        ("icosidodecahedron", "faces", 32, 60),
        ("rhombicosidodecahedron", "faces", 62, 120),
        ("disdyakis triacontahedron", "faces", 120, 180),
        ("truncated octahedron", "vertices", 24, 36),
        ("3-prism", "faces+vertices", 11, 18),
        ("tetrahedron", "faces+edges", 10, 12),
        ("cube", "faces+edges", 18, 24),
        ("octahedron", "faces+edges", 20, 24),
        ("dodecahedron", "faces+edges", 42, 60),
        ("icosahedron", "faces+edges", 50, 60),
        ("cuboctahedron", "faces+edges", 38, 48),
        ("icosidodecahedron", "faces+edges", 92, 120),
        ("icosahedron", "faces+vertices+edges", 92, 180),
    ],
)
def test_an_arrangement_has_its_gears_and_meshes(name: str, gears: str, count: int, meshes: int) -> None:
    found = from_polyhedron(name, gears)  # type: ignore[arg-type]
    assert (len(found.names), len(found.meshes)) == (count, meshes)
    assert len(set(found.names)) == count
    assert all(i < j for i, j in found.meshes)
    assert np.linalg.norm(found.axes, axis=1) == pytest.approx(np.ones(count), abs=1e-15)


def test_gears_on_faces_and_vertices_are_those_on_the_faces_of_the_rectified_solid() -> None:
    incident = from_polyhedron("icosahedron", "faces+vertices")
    assert angle(incident) == pytest.approx(degrees(atan(3 - sqrt(5))), abs=1e-12)
    assert Counter(incident.kinds) == {"3": 20, "v": 12}


@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("rhombicuboctahedron", {"4a": 6, "4b": 12, "3": 8}),
        ("J37", {"4a": 2, "4b": 8, "4c": 8, "3": 8}),
        ("snub cube", {"4": 6, "3a": 8, "3b": 24}),
        ("snub dodecahedron", {"5": 12, "3a": 20, "3b": 60}),
        ("truncated icosidodecahedron", {"10": 12, "6": 20, "4": 30}),
        ("disdyakis triacontahedron", {"3": 120}),
        ("6-prism", {"6": 2, "4": 6}),
        ("4-prism", {"4": 6}),
    ],
)
def test_kinds_are_orbits_and_not_polygons(name: str, kinds: dict[str, int]) -> None:
    assert Counter(from_polyhedron(name).kinds) == kinds


def test_the_squares_of_j37_are_named_from_the_caps_to_the_equator() -> None:
    found = from_polyhedron("J37")
    kinds = {tuple(sorted((found.kinds[i], found.kinds[j]))) for i, j in found.meshes}
    assert kinds == {("4a", "4b"), ("4b", "4c"), ("3", "4b"), ("4c", "4c"), ("3", "4c")}


def test_gears_are_numbered_from_the_top_down() -> None:
    found = from_polyhedron("cube")
    assert found.names == ("4-1", "4-2", "4-3", "4-4", "4-5", "4-6")
    assert found.axes == pytest.approx(np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, -1]]))


@pytest.mark.parametrize(
    ("name", "gears", "parts"),
    [
        ("icosidodecahedron", "faces", {"5": 5, "3": 3}),
        ("rhombicuboctahedron", "faces", {"4a": 4, "4b": 4, "3": 3}),
        ("J37", "faces", {"4a": 4, "4b": 4, "4c": 4, "3": 3}),
        ("6-antiprism", "faces", {"6": 6, "3": 3}),
        ("100-prism", "faces", {"100": 100, "4": 4}),
        ("cuboctahedron", "vertices", {"v": 0}),  # rectangles of neighbours
        ("icosidodecahedron", "faces+edges", {"5": 5, "3": 3, "e": 2}),
        ("octahedron", "faces+vertices", {"3": 3, "v": 4}),
        ("tetrakis hexahedron", "faces", {"3": 0}),
    ],
)
def test_contacts_at_equal_angles_are_known_exactly(name: str, gears: str, parts: dict[str, int]) -> None:
    found = from_polyhedron(name, gears)  # type: ignore[arg-type]
    assert dict(zip(found.kinds, found.regular, strict=True)) == parts


def test_contacts_of_rounded_coordinates_are_not_called_exact() -> None:
    rounded = from_polyhedron(np.round(solid("icosidodecahedron").vertices, 9))
    assert Counter(rounded.kinds) == {"5": 12, "3": 20}
    assert 0 in rounded.regular


def test_a_gear_may_lose_contacts_and_stays_regular() -> None:
    found = from_polyhedron("cube", drop=["4-6", "4-2~4-3"])
    assert found.names == ("4-1", "4-2", "4-3", "4-4", "4-5")
    assert len(found.meshes) == 12 - 4 - 1
    assert found.regular == (4, 4, 4, 4, 4)


def test_without_its_meshes_of_hexagons_a_buckyball_is_an_icosidodecahedron() -> None:
    found = from_polyhedron("buckyball", drop=["6~6"])
    assert len(found.meshes) == 60
    assert angle(found) == pytest.approx(degrees(atan(3 - sqrt(5))), abs=1e-12)


@pytest.mark.parametrize(
    ("options", "answer"),
    [
        ({"gears": "face"}, "did you mean 'faces'"),
        ({"drop": ["4"]}, "unknown gear or kind '4'"),
        ({"drop": ["5-13"]}, "unknown gear or kind '5-13'"),
        ({"drop": ["5~5"]}, "unknown mesh '5~5'"),
        ({"drop": [""]}, "unknown gear or kind ''"),
        ({"teeth": {"4": 12}}, "unknown kind of gear '4'"),
        ({"teeth": {"5": 0}}, "0 is not a valid tooth count"),
        ({"teeth": 12.5}, "12.5 is not a valid tooth count"),
        ({"teeth": {"5": 20}, "exact": True}, "no tooth number is given for 3"),
        ({"gears": "faces+vertices+edges"}, "cannot have two gears on each edge"),
    ],
)
def test_what_a_set_does_not_have_is_refused(options: dict[str, object], answer: str) -> None:
    assert answer in refusal("icosidodecahedron", **options)


def test_a_number_of_sides_stands_for_all_kinds_that_share_it() -> None:
    found = from_polyhedron("rhombicuboctahedron", teeth={4: 52, "3": 30, "4b": 50})
    assert found.teeth == {"4a": 52, "4b": 50, "3": 30}


@pytest.mark.parametrize(
    ("name", "printed", "closed"),
    [
        ("truncated octahedron", 36.8698976458440, acos(4 / 5)),
        ("truncated cuboctahedron", 24.9178203833816, 2 * asin(1 / sqrt(13 + 6 * sqrt(2)))),
        ("truncated icosidodecahedron", 15.1121080923375, 2 * asin(1 / sqrt(31 + 12 * sqrt(5)))),
    ],
)
def test_gears_on_vertices_stand_on_the_axes_of_the_dual_s_faces(name: str, printed: float, closed: float) -> None:
    found = angle(from_polyhedron(name, "vertices"), "v", "v")
    assert found == pytest.approx(printed, abs=6e-14)
    assert found == pytest.approx(degrees(closed), abs=3e-14)
    assert angle(from_polyhedron(solid(name).dual()), "3", "3") == pytest.approx(found, abs=6e-14)


@pytest.mark.parametrize("n", [4, 5, 6, 8, 20])
def test_the_sides_of_an_antiprism_have_the_latitude_of_a_triangle_of_its_height(n: int) -> None:
    # a side is sqrt 3 high, and leans out by a cap's circumradius less its apothem: tan(pi/2n)
    found = from_polyhedron(f"{n}-antiprism")
    sides = [abs(axis[2]) for axis, kind in zip(found.axes, found.kinds, strict=True) if kind == "3"]
    assert sides == pytest.approx([np.tan(pi / (2 * n)) / sqrt(3)] * 2 * n, abs=1e-14)


# gears, meshes, moves, gears less meshes, least drop, kinds of gear and of mesh, free positions, angles (deg)
TABLE = """
tetrahedron | 4 | 6 | no | -2 | 2 | 1 | 1 | 0 | 109.471220634
cube | 6 | 12 | no | -6 | 4 | 1 | 1 | 0 | 90
octahedron | 8 | 12 | yes | -4 | 0 | 1 | 1 | 0 | 70.528779366
dodecahedron | 12 | 30 | no | -18 | 10 | 1 | 1 | 0 | 63.434948823
icosahedron | 20 | 30 | no | -10 | 6 | 1 | 1 | 0 | 41.810314896
truncated tetrahedron | 8 | 18 | no | -10 | 6 | 2 | 2 | 0 | 70.528779366 109.471220634
cuboctahedron | 14 | 24 | yes | -10 | 0 | 2 | 1 | 0 | 54.735610317
truncated cube | 14 | 36 | no | -22 | 12 | 2 | 2 | 0 | 54.735610317 90
truncated octahedron | 14 | 36 | no | -22 | 12 | 2 | 2 | 0 | 54.735610317 70.528779366
rhombicuboctahedron | 26 | 48 | yes | -22 | 0 | 3 | 2 | 0 | 35.264389683 45
truncated cuboctahedron | 26 | 72 | no | -46 | 24 | 3 | 3 | 0 | 35.264389683 45 54.735610317
snub cube | 38 | 60 | no | -22 | 12 | 3 | 3 | 2 | 26.765412287 37.016569926
icosidodecahedron | 32 | 60 | yes | -28 | 0 | 2 | 1 | 0 | 37.377368141
truncated dodecahedron | 32 | 90 | no | -58 | 30 | 2 | 2 | 0 | 37.377368141 63.434948823
truncated icosahedron | 32 | 90 | no | -58 | 30 | 2 | 2 | 0 | 37.377368141 41.810314896
rhombicosidodecahedron | 62 | 120 | yes | -58 | 0 | 3 | 2 | 0 | 20.905157448 31.717474411
truncated icosidodecahedron | 62 | 180 | no | -118 | 60 | 3 | 3 | 0 | 20.905157448 31.717474411 37.377368141
snub dodecahedron | 92 | 150 | no | -58 | 30 | 3 | 3 | 2 | 15.824633944 27.070079724
J37 | 26 | 48 | yes | -22 | 0 | 4 | 5 | 3 | 35.264389683 45
3-prism | 5 | 9 | no | -4 | 3 | 2 | 2 | 0 | 90 120
5-prism | 7 | 15 | no | -8 | 5 | 2 | 2 | 0 | 72 90
6-prism | 8 | 18 | no | -10 | 6 | 2 | 2 | 0 | 60 90
4-antiprism | 10 | 16 | yes | -6 | 0 | 2 | 2 | 1 | 52.448397094 76.163839521
5-antiprism | 12 | 20 | yes | -8 | 0 | 2 | 2 | 1 | 41.810314896 79.187683036
6-antiprism | 14 | 24 | yes | -10 | 0 | 2 | 2 | 1 | 34.778108668 81.100571120
8-antiprism | 18 | 32 | yes | -14 | 0 | 2 | 2 | 1 | 26.037617111 83.405481784
"""
ROWS = [[cell.strip() for cell in line.split("|")] for line in TABLE.split("\n") if line]


@pytest.mark.parametrize("cells", ROWS, ids=lambda cells: cells[0])
def test_the_survey_has_the_numbers_of_its_table(cells: list[str]) -> None:
    (row,) = survey([cells[0]])
    numbers = (row.gears, row.meshes, row.gruebler, row.drop, row.types, row.mesh_kinds, row.positions)
    assert numbers == tuple(int(cells[at]) for at in (1, 2, 4, 5, 6, 7, 8))
    assert row.bipartite == (cells[3] == "yes")
    assert row.angles == pytest.approx([float(text) for text in cells[9].split()], abs=6e-10)
    assert row.exact == (row.positions + 1 >= row.mesh_kinds)
    assert row.to_dict()["solid"] == cells[0]


@pytest.mark.parametrize(
    ("name", "gears", "meshes", "drop"),
    [
        ("triakis tetrahedron", 12, 18, 4),
        ("rhombic dodecahedron", 12, 24, 8),
        ("triakis octahedron", 24, 36, 8),
        ("tetrakis hexahedron", 24, 36, 0),
        ("deltoidal icositetrahedron", 24, 48, 8),
        ("disdyakis dodecahedron", 48, 72, 0),
        ("pentagonal icositetrahedron", 24, 60, 16),
        ("rhombic triacontahedron", 30, 60, 20),
        ("triakis icosahedron", 60, 90, 20),
        ("pentakis dodecahedron", 60, 90, 12),
        ("deltoidal hexecontahedron", 60, 120, 32),
        ("disdyakis triacontahedron", 120, 180, 0),
        ("pentagonal hexecontahedron", 60, 150, 46),
        ("6-bipyramid", 12, 18, 0),
        ("8-bipyramid", 16, 24, 0),
        ("5-bipyramid", 10, 15, 2),
    ],
)
def test_of_the_duals_three_and_the_even_bipyramids_move(name: str, gears: int, meshes: int, drop: int) -> None:
    (row,) = survey([name])
    assert (row.gears, row.meshes, row.drop, row.bipartite) == (gears, meshes, drop, drop == 0)


@pytest.mark.parametrize(
    ("name", "cone"),  # half-angle of all pitch cones, deg
    [
        ("tetrakis hexahedron", 18.434948822922),
        ("disdyakis dodecahedron", 12.458910191691),
        ("disdyakis triacontahedron", 7.556054046169),
        ("6-bipyramid", 26.565051177078),
        ("8-bipyramid", 20.941020472244),
    ],
)
def test_the_movable_duals_have_identical_gears(name: str, cone: float) -> None:
    assert angle(from_polyhedron(name), "3", "3") / 2 == pytest.approx(cone, abs=6e-13)


@pytest.mark.parametrize("name", ["tetrahedron", "cube", "3-prism", "truncated tetrahedron", "3-bipyramid"])
def test_no_smaller_drop_frees_a_small_set(name: str) -> None:
    # by trying all ways to colour the gears: a mesh between two of one colour must go
    found = from_polyhedron(name)
    count = len(found.names)
    minimum = min(sum(colour[i] == colour[j] for i, j in found.meshes) for colour in product((1, -1), repeat=count))
    assert survey([name])[0].drop == minimum


@settings(max_examples=40, deadline=None)
@given(
    st.sampled_from([("cuboctahedron", "4"), ("icosidodecahedron", "5")]),
    st.integers(3, 100),
    st.integers(3, 100),
    st.integers(3, 100),
)
def test_idlers_stand_where_four_cones_fill_the_arc(solid_: tuple[str, str], a: int, b: int, e: int) -> None:
    name, kind = solid_
    arc = radians(angle(from_polyhedron(name), kind, "3"))

    def excess(pitch: float) -> float:
        return asin(pitch * a) + asin(pitch * b) + 2 * asin(pitch * e) - arc

    pitch = brentq(excess, 0, 1 / max(a, b, e), xtol=1e-18, rtol=1e-15)
    found = from_polyhedron(name, "faces+edges", teeth={kind: a, "3": b, "e": e})
    assert radians(angle(found, kind, "e")) == pytest.approx(asin(pitch * a) + asin(pitch * e), abs=1e-12)


def test_idlers_stand_in_the_middle_while_their_teeth_are_not_known() -> None:
    found = from_polyhedron("icosidodecahedron", "faces+edges", teeth={"5": 20, "3": 12})
    half = degrees(atan(3 - sqrt(5))) / 2
    assert angle(found, "5", "e") == pytest.approx(half, abs=1e-13)
    assert angle(found, "3", "e") == pytest.approx(half, abs=1e-13)


def test_a_set_with_one_kind_of_mesh_is_exact_where_it_stands() -> None:
    still = from_polyhedron("icosidodecahedron", teeth={5: 20, 3: 12})
    moved = from_polyhedron("icosidodecahedron", teeth={5: 20, 3: 12}, exact=True)
    assert moved.axes == pytest.approx(still.axes, abs=3e-15)


@pytest.mark.parametrize(
    ("name", "gears", "teeth"),
    [
        ("rhombicuboctahedron", "faces", {"4a": 22, "4b": 25, "3": 12}),
        ("5-4-3", "faces", {"5": 25, "4": 14, "3": 12}),
        ("4-antiprism", "faces", {"4": 42, "3": 5}),  # the caps would reach over the equator
        ("icosahedron", "faces+vertices+edges", {"v": 36, "3": 6, "e": 25}),  # no place within the edge
    ],
)
def test_where_no_place_gives_one_pitch_it_is_refused(name: str, gears: str, teeth: dict[str, int]) -> None:
    answer = refusal(name, gears, teeth=teeth, exact=True)
    assert "no axes with the same pitch for all meshes" in answer
    assert "free parameters of the axes" in answer


def test_exact_places_ask_nothing_of_gears_and_meshes_that_are_left_out() -> None:
    found = from_polyhedron("buckyball", drop=["6~6"], teeth={5: 20, 6: 12}, exact=True)
    assert size_gears(found).exact
    assert from_polyhedron("rhombicuboctahedron", drop=["3"], teeth={4: 12}, exact=True).teeth == {"4a": 12, "4b": 12}


@pytest.mark.parametrize(
    ("name", "gears", "teeth"),
    [
        ("octahedron", "faces", 13),  # every gear has one right behind it, on the same line
        ("icosidodecahedron", "faces", {"5": 20, "3": 12}),
        ("rhombicosidodecahedron", "faces", {"5": 25, "4": 14, "3": 12}),
        ("6-antiprism", "faces", {"6": 18, "3": 6}),
        ("cuboctahedron", "faces+edges", {"4": 16, "3": 12, "e": 8}),
        ("cube", "faces+vertices", {"4": 12, "v": 7}),
    ],
)
def test_speeds_about_outward_axes_alternate_with_the_colour(
    name: str, gears: str, teeth: dict[str, int] | int
) -> None:
    found = from_polyhedron(name, gears, teeth=teeth)  # type: ignore[arg-type]
    answer = GearTrain.declare(to_train(found)).solve()
    assert answer.verdict.kind == "determined"
    colour = nx.bipartite.color(nx.Graph(found.meshes))
    for at, (gear, kind) in enumerate(zip(found.names, found.kinds, strict=True)):
        sense = 1 if colour[at] == colour[0] else -1
        assert answer[gear] == Fraction(sense * found.teeth[found.kinds[0]], found.teeth[kind])


def test_a_train_on_a_solid_counts_its_redundant_meshes() -> None:
    train = GearTrain.declare(to_train(from_polyhedron("icosidodecahedron", teeth={5: 20, 3: 12}), "scorg"))
    assert (train.name, train.mobility.by_rank, train.mobility.redundant) == ("scorg", 1, 29)


def test_a_set_without_teeth_or_gears_is_no_train() -> None:
    with pytest.raises(GearTrainError, match="no tooth number is given for 3"):
        to_train(from_polyhedron("icosidodecahedron", teeth={5: 20}))
    with pytest.raises(GearTrainError, match="without gears"):
        to_train(from_polyhedron("cube", teeth=12, drop=["4"]))
