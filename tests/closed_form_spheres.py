"""Sets on a sphere that share one pitch exactly, from roots of one equation each: an oracle for `from_polyhedron`.

Moved antiprisms, idlers on the edges of solids whose meshes are all alike, and the icosahedral set of 92; axes from
permuted coordinates, no symmetry group and no Newton's method in many unknowns.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import product
from math import acos, asin, atan, atan2, cos, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from geartrain.spherical import Configuration

Floats = NDArray[np.float64]
PHI = (1 + sqrt(5)) / 2


def root(value: Callable[[float], float], low: float, high: float) -> float:
    return float(brentq(value, low, high, xtol=1e-16, rtol=1e-15))


def separations(axes: Floats) -> Floats:
    """Angles between all axes (rad)."""
    across = np.linalg.norm(np.cross(axes[:, None], axes[None]), axis=2)
    return np.arctan2(across, axes @ axes.T)


def zigzag_angle(latitude: float, n: int) -> float:
    """Angle between neighbouring side axes of an n-antiprism (rad): acos(cos^2 lat cos(pi/n) - sin^2 lat)."""
    return acos(cos(latitude) ** 2 * cos(pi / n) - sin(latitude) ** 2)


def antiprism_latitude(n: int, cap: int, side: int) -> float:
    """Latitude of the side axes (rad) at which caps and sides of an n-antiprism share one pitch.

    rho_cap + rho_side = pi/2 - lat with sin rho proportional to the teeth, and 2 rho_side = `zigzag_angle`.
    Equal teeth: sin lat = k/(1 + k), k = cos(pi/n).
    """
    if cap == side:
        k = cos(pi / n)
        return asin(k / (1 + k))

    def gap(latitude: float) -> float:
        between = pi / 2 - latitude
        return 2 * atan2(sin(between), cos(between) + cap / side) - zigzag_angle(latitude, n)

    return root(gap, 0.0, pi / 2 - 1e-9)


def idler_pitch(S: float, z_a: int, z_b: int, z_e: int) -> float:
    """Pitch lambda at which one idler fits between gears S apart (rad): asin(l z_a) + asin(l z_b) + 2 asin(l z_e) = S.

    In radii of the sphere.
    """

    def excess(pitch: float) -> float:
        return sum(asin(min(pitch * z, 1)) for z in (z_a, z_b, z_e, z_e)) - S

    return root(excess, 0.0, 1 / max(z_a, z_b, z_e))


def icosahedral_pitch(z_1: int, z_2: int, z_3: int) -> tuple[float, float]:
    """Pitch lambda (radii of the sphere) and place t (rad) of the edge gears of the icosahedral set of 92.

    t = asin(l z1) + asin(l z3) from a vertex along an edge; the face axis is then d away,
    cos d = cos P cos t + sin P sin t cos 36 deg with P the angle from vertex to face, and asin(l z2) + asin(l z3) = d.
    """
    P = atan(3 - sqrt(5))

    def place(pitch: float) -> float:
        return asin(min(pitch * z_1, 1)) + asin(min(pitch * z_3, 1))

    def excess(pitch: float) -> float:
        t = place(pitch)
        d = acos(cos(P) * cos(t) + sin(P) * sin(t) * cos(pi / 5))
        return asin(min(pitch * z_2, 1)) + asin(min(pitch * z_3, 1)) - d

    # the largest gear is at most a crown gear, and past the middle of the edge its two gears would change places
    middle = root(lambda pitch: place(pitch) - atan(2) / 2, 0.0, 1 / max(z_1, z_3))
    pitch = root(excess, 0.0, min(middle, 1 / z_2))
    return pitch, place(pitch)


def icosahedron_vertices() -> Floats:
    """Directions to the twelve vertices, (12, 3)."""
    points = [np.roll((0, a, b * PHI), turn) for turn in range(3) for a, b in product((1, -1), repeat=2)]
    return np.array(points) / sqrt(1 + PHI**2)


def icosahedron_faces() -> Floats:
    """Directions to the twenty faces, (20, 3)."""
    cube = [np.array(signs, dtype=float) for signs in product((1, -1), repeat=3)]
    rest = [np.roll((0, a * PHI, b / PHI), turn) for turn in range(3) for a, b in product((1, -1), repeat=2)]
    return np.array([*cube, *rest]) / sqrt(3)


def cube_faces() -> Floats:
    """Directions to the six faces, (6, 3)."""
    return np.concatenate([np.eye(3), -np.eye(3)])


def cube_vertices() -> Floats:
    """Directions to the eight vertices, (8, 3)."""
    return np.array(list(product((1, -1), repeat=3))) / sqrt(3)


def _between(first: Floats, second: Floats, S: float) -> list[tuple[int, int]]:
    """Pairs of a first and a second axis that stand S apart (1e-9 rad)."""
    apart = separations(np.concatenate([first, second]))
    rows, columns = np.nonzero(np.abs(apart[: len(first), len(first) :] - S) < 1e-9)
    return [(int(i), int(j) + len(first)) for i, j in zip(rows, columns, strict=True)]


def quasiregular(solid: str, teeth: Mapping[str, int] | None = None) -> Configuration:
    """Gears on the faces of a solid whose meshes are all alike; the kinds are the numbers of the faces' edges."""
    if solid == "octahedron":
        axes = cube_vertices()
        apart = separations(axes)
        meshes = [(i, j) for i in range(8) for j in range(i) if abs(apart[i, j] - acos(1 / 3)) < 1e-9]
        return _named(solid, axes, meshes, ("3",) * 8, (3,) * 8, teeth or {})
    if solid == "cuboctahedron":
        large, small, S, n = cube_faces(), cube_vertices(), atan(sqrt(2)), 4
    else:
        large, small, S, n = icosahedron_vertices(), icosahedron_faces(), atan(3 - sqrt(5)), 5
    sides = (n,) * len(large) + (3,) * len(small)
    axes = np.concatenate([large, small])
    return _named(solid, axes, _between(large, small, S), tuple(map(str, sides)), sides, teeth or {})


def _named(
    title: str,
    axes: Floats,
    meshes: list[tuple[int, int]],
    kinds: tuple[str, ...],
    regular: tuple[int, ...],
    teeth: Mapping[str, int],
) -> Configuration:
    count: dict[str, int] = {}
    names = []
    for kind in kinds:
        count[kind] = count.get(kind, 0) + 1
        names.append(f"{kind}.{count[kind]}")
    return Configuration(tuple(names), axes, tuple(meshes), kinds, regular, dict(teeth), title)


def moved_antiprism(n: int, cap: int, side: int) -> Configuration:
    """2 caps and 2n sides whose latitude makes one pitch of any tooth numbers, n >= 3.

    Loops close exactly only with equal teeth and n dividing 3z, or where the moved antiprism is the uniform one
    (6: 18/6); else ask for their residue. Kinds "cap" and "side".
    """
    latitude = antiprism_latitude(n, cap, side)
    longitudes = np.arange(2 * n) * pi / n
    heights = np.where(np.arange(2 * n) % 2, -latitude, latitude)
    ring = np.stack(
        [np.cos(heights) * np.cos(longitudes), np.cos(heights) * np.sin(longitudes), np.sin(heights)], axis=1
    )
    axes = np.concatenate([[[0, 0, 1], [0, 0, -1]], ring])
    meshes = [(k % 2, 2 + k) for k in range(2 * n)] + [(2 + k, 2 + (k + 1) % (2 * n)) for k in range(2 * n)]
    # equal gears: the angle at a side from the cap to the next side is pi - pi/n exactly
    sides = 2 * n if cap == side else 3 if (n, cap) == (6, 3 * side) else 0
    kinds = ("cap",) * 2 + ("side",) * 2 * n
    teeth = {"cap": cap, "side": side}
    return _named(f"{n}-antiprism {cap}/{side}, moved", axes, meshes, kinds, (n,) * 2 + (sides,) * 2 * n, teeth)


def with_idlers(configuration: Configuration, idler: int) -> Configuration:
    """One idler of `idler` teeth on the arc of every mesh of a set that has one kind of mesh, and teeth.

    The idlers take a pitch of their own making (`idler_pitch`); their two contacts stand half a turn apart.
    """
    i, j = configuration.meshes[0]
    a, b = configuration.kinds[i], configuration.kinds[j]
    apart = float(separations(configuration.axes)[i, j])
    teeth = configuration.teeth
    pitch = idler_pitch(apart, teeth[a], teeth[b], idler)
    lead = {kind: asin(pitch * teeth[kind]) + asin(pitch * idler) for kind in (a, b)}
    axes, gears = list(configuration.axes), len(configuration.axes)
    meshes: list[tuple[int, int]] = []
    for at, (i, j) in enumerate(configuration.meshes):
        axes.append(_along(configuration.axes[i], configuration.axes[j], lead[configuration.kinds[i]]))
        meshes += [(i, gears + at), (j, gears + at)]
    edges = len(configuration.meshes)
    names = configuration.names + tuple(
        f"{configuration.names[i]}~{configuration.names[j]}" for i, j in configuration.meshes
    )
    return Configuration(
        names,
        np.array(axes),
        tuple(meshes),
        configuration.kinds + ("idler",) * edges,
        configuration.regular + (2,) * edges,
        {**teeth, "idler": idler},
        f"{configuration.title} with idlers",
    )


def _along(a: Floats, b: Floats, angle: float) -> Floats:
    """The direction `angle` (rad) from a towards b."""
    across = b - a * (a @ b)
    return np.asarray(cos(angle) * a + sin(angle) * across / np.linalg.norm(across), dtype=float)


def idler_sphere(solid: str, teeth: Mapping[str, int], idler: int) -> Configuration:
    """Faces and edge idlers: 38 gears on the cuboctahedron, 92 on the icosidodecahedron; one pitch for any teeth.

    teeth   of the faces, by their number of edges: {"5": 20, "3": 12}. Loops close exactly where 2 divides z4 and 3
            divides z3, or 5 divides z5 and 3 divides z3; the idlers are free
    """
    return with_idlers(quasiregular(solid, teeth), idler)


def icosahedral(z_1: int, z_2: int, z_3: int) -> Configuration:
    """12 vertices (z_1), 20 faces (z_2) and two gears on each edge (z_3) of the icosahedron: one pitch for any teeth.

    92 gears, 180 meshes. Loops close where 5 divides z_1, 3 divides z_2 and one transcendental residue vanishes.
    """
    _, t = icosahedral_pitch(z_1, z_2, z_3)
    vertices, faces = icosahedron_vertices(), icosahedron_faces()
    apart = separations(vertices)
    ends = [(i, int(j)) for i in range(12) for j in np.flatnonzero(np.abs(apart[i] - atan(2)) < 1e-9)]
    edges = np.array([_along(vertices[i], vertices[j], t) for i, j in ends])
    axes = np.concatenate([vertices, faces, edges])
    meshes = [(i, 32 + at) for at, (i, _) in enumerate(ends)]
    near = np.argsort(separations(np.concatenate([edges, faces]))[:60, 60:], axis=1)[:, :2]
    meshes += [(12 + int(face), 32 + at) for at, pair in enumerate(near) for face in pair]
    kinds = ("vertex",) * 12 + ("face",) * 20 + ("edge",) * 60
    teeth = {"vertex": z_1, "face": z_2, "edge": z_3}
    return _named(f"icosahedral {z_1}/{z_2}/{z_3}", axes, meshes, kinds, (5,) * 12 + (0,) * 80, teeth)
