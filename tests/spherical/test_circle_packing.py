"""Circle packings on the sphere and gears made from graphs: printed radii, geometry in space, and what is refused."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterable
from math import acos, asin, atan, degrees, sqrt
from typing import Any

import networkx as nx
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from geartrain import GearTrainError
from geartrain.spherical import GraphSet, from_graph, from_polyhedron

Floats = NDArray[np.float64]
Edge = tuple[str, str]

PRISM = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
ASYM = [(0, 1), (0, 2), (0, 3), (0, 4), (1, 3), (1, 4), (2, 3), (2, 4), (2, 6), (3, 4), (3, 5), (4, 5), (4, 6), (5, 6)]
ASYM_CONES = {
    "v0": 26.019062507744,
    "v1": 9.571389060864,
    "v2": 36.926339690056,
    "v3": 51.652029573801,
    "v4": 60.877010626669,
    "v5": 11.468849170456,
    "v6": 10.505713809329,
    "f013": 10.866524975840,
    "f014": 11.363842065737,
    "f023": 20.355579048947,
    "f024": 20.114113063019,
    "f134": 13.835389488897,
    "f246": 14.891384614367,
    "f345": 17.236194453540,
    "f456": 10.236477383742,
    "f2356": 26.463044372986,
}
ASYM_TEETH = {
    **dict(zip((f"v{k}" for k in range(7)), (32, 12, 43, 57, 63, 14, 13), strict=True)),
    **{"f013": 14, "f014": 14, "f023": 25, "f024": 25, "f134": 17, "f246": 19, "f345": 21, "f456": 13, "f2356": 32},
}


def faces_and_vertices(edges: Iterable[tuple[int, int]]) -> list[Edge]:
    """Meshes of gears on all faces and vertices of the polyhedron with these edges."""
    _, drawn = nx.check_planarity(nx.Graph(list(edges)))
    seen: set[tuple[int, int]] = set()
    faces = [drawn.traverse_face(*edge, seen) for edge in drawn.edges() if edge not in seen]
    return [(f"v{vertex}", "f" + "".join(map(str, sorted(face)))) for face in faces for vertex in face]


def faces_and_vertices_of_hull(points: int, seed: int) -> list[Edge]:
    """The same for the hull of random points on the sphere: a map without symmetry."""
    cloud = np.random.default_rng(seed).normal(size=(points, 3))
    hull = ConvexHull(cloud / np.linalg.norm(cloud, axis=1)[:, None])
    return [(f"v{vertex}", f"f{at}") for at, face in enumerate(hull.simplices) for vertex in face]


def packing_of(edges: Iterable[tuple[object, object]]) -> tuple[Any, list[str]]:
    found = from_graph(edges)  # type: ignore[arg-type]
    return found.packing, list(found.configuration.names)


def solid_packing(name: str) -> Any:
    """The packing of the graph of a solid's faces."""
    configuration = from_polyhedron(name)
    return from_graph([(int(i), int(j)) for i, j in configuration.meshes]).packing


def angle(a: Floats, b: Floats) -> float:
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))


def distinct(cones: Floats) -> list[float]:
    """The different half-angles, largest first (deg)."""
    return sorted({round(degrees(cone), 11) for cone in cones}, reverse=True)


def overlaps(axes: Floats, cones: Floats) -> int:
    """How many pairs of circles overlap: each pair measured on its own."""
    i, j = np.tril_indices(len(axes), -1)
    across = np.linalg.norm(np.cross(axes[i], axes[j]), axis=1)
    apart = np.arctan2(across, (axes[i] * axes[j]).sum(axis=1))
    return int((apart < cones[i] + cones[j] - 1e-9).sum())


def check_in_space(packing: Any, digits: float = 1e-14) -> None:
    """Gears touch, regions pass through the points where they do, nothing overlaps, and the centre is right."""
    for i, j in packing.meshes:
        assert angle(packing.axes[i], packing.axes[j]) == pytest.approx(packing.cones[i] + packing.cones[j], abs=digits)
    at = {frozenset(mesh): point for mesh, point in zip(packing.meshes, packing.pitch_points, strict=True)}
    for mesh, point in at.items():
        for gear in mesh:
            assert angle(packing.axes[gear], point) == pytest.approx(packing.cones[gear], abs=10 * digits)
    for number, walk in enumerate(packing.regions):
        for k, gear in enumerate(walk):
            kiss = at[frozenset((gear, walk[k - 1]))]
            found = angle(packing.region_axes[number], kiss)
            assert found == pytest.approx(packing.region_cones[number], abs=10 * digits)
    assert overlaps(packing.axes, packing.cones) == 0
    assert np.abs(packing.pitch_points.sum(axis=0)).max() < 1e-12 * len(packing.meshes)


@pytest.mark.parametrize(
    ("solid", "cones"),
    [
        ("cuboctahedron", [degrees(atan(1 / sqrt(2))), degrees(asin(1 / 3))]),
        ("cuboctahedron", [35.264389682755, 19.471220634491]),
        ("icosidodecahedron", [degrees(atan(1 / 2)), 10.812316963572]),
        ("rhombicosidodecahedron", [18.434948822922, 13.282525588539, 7.622631859350]),
        ("6-antiprism", [63.711516786140, 17.389054334048]),
        ("octahedron", [degrees(acos(1 / 3)) / 2]),
    ],
)
def test_solids_pack_to_their_closed_forms(solid: str, cones: list[float]) -> None:
    packing = solid_packing(solid)
    assert distinct(packing.cones) == pytest.approx(cones, abs=6e-12)
    assert packing.residual < 1e-14
    check_in_space(packing)


def test_the_prism_packs_to_the_printed_cones() -> None:
    packing, names = packing_of(faces_and_vertices(PRISM))
    printed = {"v": 22.903061865822, "f3": 19.836124591160, "f4": 47.260813543019}
    for name, cone in zip(names, np.degrees(packing.cones), strict=True):
        kind = "v" if name[0] == "v" else f"f{len(name) - 1}"
        assert cone == pytest.approx(printed[kind], abs=6e-13)
    assert (len(names), len(packing.meshes)) == (11, 18)
    check_in_space(packing)


def test_a_map_without_symmetry_packs_to_the_printed_cones() -> None:
    packing, names = packing_of(faces_and_vertices(ASYM))
    assert (len(names), len(packing.meshes)) == (16, 28)
    assert dict(zip(names, np.degrees(packing.cones), strict=True)) == pytest.approx(ASYM_CONES, abs=6e-13)
    check_in_space(packing)


@pytest.mark.parametrize("points", [12, 60])
def test_random_maps_pack(points: int) -> None:
    packing, _ = packing_of(faces_and_vertices_of_hull(points, points))
    check_in_space(packing, 3e-14)
    # a sphere's worth of circles: kites of gears and regions cover it once
    assert packing.cones.min() > 0


def test_regions_stay_counterclockwise_from_outside() -> None:
    packing, _ = packing_of(faces_and_vertices(ASYM))
    for axis, walk in zip(packing.region_axes, packing.regions, strict=True):
        rim = packing.axes[list(walk)]
        turned = sum(np.cross(rim[k - 1] - axis, rim[k] - axis) for k in range(len(walk)))
        assert float(turned @ axis) > 0


def test_newton_converges_quadratically_and_keeps_a_record() -> None:
    packing, _ = packing_of(faces_and_vertices_of_hull(60, 1))
    residuals = packing.residuals
    fast = [k for k in range(1, len(residuals)) if residuals[k] > 1e-12 and residuals[k - 1] < 0.5]
    assert fast
    for k in fast:
        assert residuals[k] < 5 * residuals[k - 1] ** 2
    assert len(residuals) <= 10


def test_a_thousand_gears_pack_and_close() -> None:
    found = from_graph(faces_and_vertices_of_hull(334, 1), aim="phases")
    assert len(found.configuration.axes) == 998
    assert found.packing.residual < 3e-14
    assert len(found.packing.residuals) <= 12
    assert found.exact == ("phases",)


def check_pitch(found: GraphSet) -> None:
    """One pitch, measured in space: the angle of every mesh is the sum of cones of one pitch."""
    axes, z = found.configuration.axes, found.sizing.teeth
    for i, j in found.configuration.meshes:
        want = asin(found.sizing.pitch * z[i]) + asin(found.sizing.pitch * z[j])
        assert angle(axes[i], axes[j]) == pytest.approx(want, abs=1e-13)


def check_phases(found: GraphSet) -> None:
    """Closed loops, counted tooth by tooth along a spanning tree: every mesh finds tooth against gap."""
    configuration, z = found.configuration, found.sizing.teeth
    graph = nx.Graph(list(configuration.meshes))
    phase = {0: 0.0}

    def wanted(i: int, j: int) -> float:
        return 0.5 + (z[i] * configuration.azimuth(i, j) + z[j] * configuration.azimuth(j, i)) / (2 * np.pi)

    for i, j in nx.bfs_edges(graph, 0):
        phase[j] = wanted(i, j) - phase[i]
    for i, j in configuration.meshes:
        miss = phase[i] + phase[j] - wanted(i, j)
        assert miss - round(miss) == pytest.approx(0, abs=1e-10)


def test_the_prism_with_one_pitch() -> None:
    found = from_graph(faces_and_vertices(PRISM))
    assert set(found.configuration.teeth.values()) == {14, 12, 26}
    assert found.sizing.pitch == pytest.approx(0.028102419060, abs=6e-13)
    assert degrees(found.moved.max()) == pytest.approx(0.1373, abs=6e-5)
    assert found.exact == ("pitch",)
    assert np.degrees(found.sizing.pressure) == pytest.approx(20)
    check_pitch(found)


def test_the_prism_with_closed_phases() -> None:
    graph = faces_and_vertices(PRISM)
    teeth = {name: 14 if name[0] == "v" else 12 if len(name) == 4 else 26 for edge in graph for name in edge}
    found = from_graph(graph, aim="phases", teeth=teeth)
    assert found.exact == ("phases",)
    assert found.spread == pytest.approx(2.85, abs=0.005)
    check_phases(found)
    # the scan may do better than plain rounding, never worse
    assert from_graph(graph, aim="phases").spread <= found.spread


def test_a_map_without_symmetry_with_one_pitch() -> None:
    found = from_graph(faces_and_vertices(ASYM), teeth=ASYM_TEETH)
    assert found.exact == ("pitch",)
    assert found.sizing.pitch == pytest.approx(0.013852181, abs=1e-11)  # two parameters are free
    assert degrees(found.moved.max()) < 1
    check_pitch(found)


def test_a_map_without_symmetry_with_closed_phases() -> None:
    found = from_graph(faces_and_vertices(ASYM), aim="phases", teeth=ASYM_TEETH)
    assert found.exact == ("phases",)
    assert found.residue < 1e-12
    assert found.spread == pytest.approx(3.30, abs=0.005)
    assert np.ptp(np.degrees(found.sizing.pressure)) / 2 == pytest.approx(2.6, abs=0.1)
    check_phases(found)


@pytest.mark.parametrize("aim", ["pitch", "phases"])
def test_solids_that_close_are_found_again(aim: str) -> None:
    graph = from_polyhedron("icosidodecahedron").meshes
    teeth = {gear: 30 if gear < 12 else 12 for gear in range(32)}
    found = from_graph(graph, aim=aim, teeth=teeth)  # type: ignore[arg-type]
    assert found.exact == ("pitch", "phases")
    assert degrees(found.moved.max()) < 1e-10


@pytest.mark.parametrize(
    ("teeth", "low", "high"), [((45, 52, 12), 0.7, 1.0), ((25, 14, 12), 1.8, 2.3), ((20, 14, 9), 7.0, 10.0)]
)
def test_axes_of_the_5_4_3_can_move_to_one_pitch_on_one_side(
    teeth: tuple[int, int, int], low: float, high: float
) -> None:
    configuration = from_polyhedron("rhombicosidodecahedron")
    z = dict(zip("543", teeth, strict=True))
    found = from_graph(configuration.meshes, teeth={at: z[kind] for at, kind in enumerate(configuration.kinds)})
    assert "pitch" in found.exact
    assert low < degrees(found.moved.max()) < high
    check_pitch(found)


def test_on_the_other_side_none_is_found_and_that_is_said() -> None:
    configuration = from_polyhedron("rhombicosidodecahedron")
    z = {"5": 40, "4": 34, "3": 15}
    found = from_graph(configuration.meshes, teeth={at: z[kind] for at, kind in enumerate(configuration.kinds)})
    assert "pitch" not in found.exact
    assert "no axes near the packing" in str(found)


def test_minimum_teeth_and_range() -> None:
    graph = faces_and_vertices(PRISM)
    assert min(from_graph(graph, 20).configuration.teeth.values()) == 20
    narrow, wide = from_graph(graph), from_graph(graph, upto=30)
    assert 12 <= min(wide.configuration.teeth.values()) <= 30
    # the scan keeps the teeth that are nearest to the circles in proportion
    first, second = (np.std(np.log(found.sizing.teeth / np.sin(found.packing.cones))) for found in (narrow, wide))
    assert second < first


def test_a_networkx_graph_serves_as_well_as_pairs() -> None:
    found = from_graph(nx.cubical_graph())
    assert distinct(found.packing.cones) == pytest.approx([degrees(acos(1 / 3)) / 2])
    assert json.loads(json.dumps(found.to_dict()))["exact"] == ["pitch", "phases"]
    assert "exact pitch and phases" in str(found)


def test_idlers_on_all_edges_of_a_tetrahedron_stand_on_the_cube() -> None:
    """Stand-ins on the faces make it the packing of the cuboctahedron, with six faces for idlers."""
    corners = nx.complete_graph(4)
    graph = [pair for a, b in corners.edges() for pair in ((a, (a, b)), ((a, b), b))]
    found = from_graph(graph)
    assert len(found.configuration.axes) == 10
    check_pitch(found)
    idlers = [k for k, name in enumerate(found.configuration.names) if "," in name]
    for idler in idlers:
        first, second = (a + b - idler for a, b in found.configuration.meshes if idler in (a, b))
        apart = angle(found.configuration.axes[first], found.configuration.axes[second])
        assert apart == pytest.approx(acos(-1 / 3), abs=1e-12)


def test_a_ring_of_idlers_lies_on_a_great_circle() -> None:
    found = from_graph(nx.cycle_graph(6))
    assert distinct(found.packing.cones[:6]) == pytest.approx([30])
    assert np.linalg.matrix_rank(found.configuration.axes, tol=1e-9) == 2


def test_one_idler_across_a_face_is_put_in() -> None:
    cube = list(nx.cubical_graph().edges())
    opposite = next(
        (a, b) for a in range(8) for b in range(a) if len(list(nx.common_neighbors(nx.cubical_graph(), a, b))) == 2
    )
    found = from_graph([*cube, (opposite[0], "idler"), ("idler", opposite[1])], 24)
    assert len(found.configuration.axes) == 9
    assert overlaps(found.packing.axes, found.packing.cones) == 0
    check_pitch(found)


def cube_beside_cube() -> list[tuple[int, int]]:
    """Two cubes that share two gears in mesh."""
    cube = list(nx.cubical_graph().edges())
    return list({*cube, *((a + 20 * (a > 1), b + 20 * (b > 1)) for a, b in cube)})


@pytest.mark.parametrize(
    ("graph", "says"),
    [
        ([(0, 1), (1, 2), (2, 3), (3, 4), (4, 0)], "loop 0 - 1 - 2 - 3 - 4 has an odd number"),
        (list(nx.complete_bipartite_graph(3, 3).edges()), "not planar: 0, 1, 2, 3, 4, 5"),
        ([(1, 1), (1, 2)], "1 meshes with itself"),
        ([("a", "b"), ("b", "a")], "a and b mesh twice"),
        ([(0, 1), (1, 2), (2, 3)], "remove 0, 3"),
        ([(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 6), (6, 3)], "only 3 connects two parts"),
        ([(0, 1)], "2 gears"),
        ([*nx.cubical_graph().edges(), (10, 11), (11, 12), (12, 13), (13, 10)], "10, 11, 12, 13 are not connected"),
        (cube_beside_cube(), "without 0 and 1 it is not connected"),
    ],
)
def test_graphs_that_cannot_be_packed_are_refused_with_the_reason(graph: list[tuple[int, int]], says: str) -> None:
    with pytest.raises(GearTrainError) as refused:
        from_graph(graph)
    assert says in str(refused.value)
    assert "fix:" in str(refused.value)


def test_an_odd_loop_is_given_in_order() -> None:
    graph = [*nx.cubical_graph().edges(), (0, 2)]
    with pytest.raises(GearTrainError, match="has an odd number of gears") as refused:
        from_graph(graph)
    walk = str(refused.value).split("loop ")[1].split(" has an odd")[0].split(" - ")
    steps = {frozenset(map(str, edge)) for edge in graph}
    assert len(walk) % 2 == 1
    assert all(frozenset((walk[k - 1], walk[k])) in steps for k in range(len(walk)))


def test_kuratowski_of_five() -> None:
    """K5 with its meshes cut by idlers is bipartite, and has five corners."""
    graph = [pair for a, b in nx.complete_graph(5).edges() for pair in ((a, f"{a}{b}"), (f"{a}{b}", b))]
    with pytest.raises(GearTrainError, match="not planar: 0, 1, 2, 3, 4"):
        from_graph(graph)


def test_teeth_of_all_gears_must_be_given_and_aims_are_two() -> None:
    with pytest.raises(GearTrainError, match="no tooth number is given for"):
        from_graph(nx.cubical_graph(), teeth={0: 12})
    with pytest.raises(GearTrainError, match="unknown aim"):
        from_graph(nx.cubical_graph(), aim="both")  # type: ignore[arg-type]


def test_the_room_opens_without_scipy_and_networkx() -> None:
    code = "import geartrain.spherical, sys; print(sorted({m.split('.')[0] for m in sys.modules}))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert "scipy" not in loaded
    assert "networkx" not in loaded
