"""Convex polyhedra around the origin: faces from vertices, adjacency, symmetries, and a catalogue of named solids.

The vertices of the uniform solids are found by Wythoff's construction. They are the images of a point whose distance
from each of three mirrors is 0 or 1.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem, suggest
from geartrain.numerics.results import Shown

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Ints

NEAR = 1e-6
"""Tolerance for the equality of points, planes and symmetries, relative to the size of the solid."""
PHI = (1 + 5**0.5) / 2
MOST_SIDES = 360
"""Maximum number of sides of prisms and related families; with more sides, the tolerance would merge their faces."""
# normals of the mirrors of [p, 3]: the first two meet at pi/p, the last two at pi/3, the first and last at pi/2
_MIRRORS = {
    3: ([1, -1, 0], [0, 1, -1], [-1, -1, 0]),
    4: ([0, 0, 1], [0, 1, -1], [1, -1, 0]),
    5: ([1, 0, 0], [-PHI, -1, PHI - 1], [0, 1, 0]),
}
# p of the mirrors, and the distances of the point from them
_UNIFORM = {
    "tetrahedron": (3, (1, 0, 0)),
    "cube": (4, (1, 0, 0)),
    "octahedron": (4, (0, 0, 1)),
    "dodecahedron": (5, (1, 0, 0)),
    "icosahedron": (5, (0, 0, 1)),
    "truncated tetrahedron": (3, (1, 1, 0)),
    "cuboctahedron": (4, (0, 1, 0)),
    "truncated cube": (4, (1, 1, 0)),
    "truncated octahedron": (4, (0, 1, 1)),
    "rhombicuboctahedron": (4, (1, 0, 1)),
    "truncated cuboctahedron": (4, (1, 1, 1)),
    "snub cube": (4, ()),
    "icosidodecahedron": (5, (0, 1, 0)),
    "truncated dodecahedron": (5, (1, 1, 0)),
    "truncated icosahedron": (5, (0, 1, 1)),
    "rhombicosidodecahedron": (5, (1, 0, 1)),
    "truncated icosidodecahedron": (5, (1, 1, 1)),
    "snub dodecahedron": (5, ()),
}
_DUALS = {
    "triakis tetrahedron": "truncated tetrahedron",
    "rhombic dodecahedron": "cuboctahedron",
    "triakis octahedron": "truncated cube",
    "tetrakis hexahedron": "truncated octahedron",
    "deltoidal icositetrahedron": "rhombicuboctahedron",
    "disdyakis dodecahedron": "truncated cuboctahedron",
    "pentagonal icositetrahedron": "snub cube",
    "rhombic triacontahedron": "icosidodecahedron",
    "triakis icosahedron": "truncated dodecahedron",
    "pentakis dodecahedron": "truncated icosahedron",
    "deltoidal hexecontahedron": "rhombicosidodecahedron",
    "disdyakis triacontahedron": "truncated icosidodecahedron",
    "pentagonal hexecontahedron": "snub dodecahedron",
}
# the last two are model makers' names, by the sides of the faces
_ALIASES = {
    "hexahedron": "cube",
    "buckyball": "truncated icosahedron",
    "football": "truncated icosahedron",
    "soccer ball": "truncated icosahedron",
    "small rhombicuboctahedron": "rhombicuboctahedron",
    "great rhombicuboctahedron": "truncated cuboctahedron",
    "small rhombicosidodecahedron": "rhombicosidodecahedron",
    "great rhombicosidodecahedron": "truncated icosidodecahedron",
    "pseudo-rhombicuboctahedron": "j37",
    "elongated square gyrobicupola": "j37",
    "5-3": "icosidodecahedron",
    "5-4-3": "rhombicosidodecahedron",
}
_FAMILIES = ("prism", "antiprism", "bipyramid", "trapezohedron")
_SIDES = dict(
    zip(
        ("triangular", "square", "pentagonal", "hexagonal", "heptagonal", "octagonal", "enneagonal", "decagonal"),
        range(3, 11),
        strict=True,
    )
)
_FAMILY = re.compile(rf"(\d{{1,9}}|{'|'.join(_SIDES)})[- ]({'|'.join(_FAMILIES)})")


@dataclass(frozen=True, eq=False)
class Polyhedron(Shown):
    """Convex polyhedron with the origin in its interior, on which gears can be placed."""

    vertices: Floats
    """Coordinates of the vertices as given, in any unit, shape (vertices, 3)."""
    faces: tuple[tuple[int, ...], ...]
    """Indices of the vertices of each face, counterclockwise as seen from outside. Faces are in descending order of
    height (z); faces at equal heights are in counterclockwise order from x.
    """
    normals: Floats = field(repr=False)
    """Outward unit normals of the faces, shape (faces, 3)."""
    heights: Floats = field(repr=False)
    """Distance of each face's plane from the origin, in the unit of the vertices, shape (faces,)."""
    name: str = ""
    """Name of the solid for display."""

    def _summary(self) -> str:
        return f"{self.name or 'polyhedron'}: {len(self.vertices)} vertices, {len(self.faces)} faces"

    @cached_property
    def _left(self) -> dict[tuple[int, int], int]:
        """Face to the left of each directed edge, which is given as a pair of vertices."""
        return {side: at for at, face in enumerate(self.faces) for side in _sides(face)}

    @cached_property
    def edges(self) -> tuple[tuple[int, int], ...]:
        """Edges as pairs of vertices, without duplicates."""
        return tuple(sorted(side for side in self._left if side[0] < side[1]))

    @cached_property
    def borders(self) -> tuple[tuple[int, int], ...]:
        """Indices of the two faces at each edge."""
        return tuple((self._left[a, b], self._left[b, a]) for a, b in self.edges)

    @cached_property
    def degrees(self) -> tuple[int, ...]:
        """Number of edges at each vertex."""
        count = Counter(vertex for edge in self.edges for vertex in edge)
        return tuple(count[vertex] for vertex in range(len(self.vertices)))

    @cached_property
    def symmetries(self) -> Floats:
        """Matrices of all rotations and reflections about the origin that map the solid to itself, shape (order, 3, 3).

        Rounding errors are about 1e-15. A symmetry is determined by the image of one corner (three consecutive vertices
        of a face), so all symmetries are found by examining all corners that are congruent to the first.
        """
        # Gram matrices are invariant under rotation and reflection
        corners = self.vertices[[corner for face in self.faces for corner in _corners(face)]]
        gram = corners @ corners.transpose(0, 2, 1)
        alike = np.abs(gram - gram[0]).max(axis=(1, 2)) < NEAR * gram[0].max()
        guesses = np.linalg.inv(corners[0]) @ corners[alike]  # rows: v -> v @ guess
        distance, image = self._nearest(self.vertices, self.vertices @ guesses)
        image = image[distance.max(axis=1) < NEAR * self.size]
        # orthogonal Procrustes
        left, _, right = np.linalg.svd(self.vertices[image].transpose(0, 2, 1) @ self.vertices)
        found: Floats = left @ right  # the best fit to all vertices, not only to the first corner
        return found

    def permutations(self, points: Floats) -> Ints:
        """Return the index of the image of each point under each symmetry, shape (order, points). All symmetries must
        map the set of points to itself.
        """
        return self._nearest(points, points @ self.symmetries.transpose(0, 2, 1))[1]

    def orbits(self, points: Floats) -> Ints:
        """Return for each point the index of the first point in its orbit under the symmetries, which map the points to
        themselves.
        """
        first: Ints = self.permutations(points).min(axis=0)
        return first

    @property
    def size(self) -> float:
        """Distance of the farthest vertex from the origin, in the unit of the vertices."""
        return float(np.linalg.norm(self.vertices, axis=1).max())

    def dual(self, name: str = "") -> Polyhedron:
        """Return the polar dual, whose vertices are in the directions of the normals of this solid, and whose normals
        are in the directions of its vertices.

        name   name of the dual, for display
        """
        return polyhedron(self.normals / self.heights[:, None], name=name)

    @staticmethod
    def _nearest(points: Floats, images: Floats) -> tuple[Floats, Ints]:
        from scipy.spatial import cKDTree

        distance, at = cKDTree(points).query(images)
        return np.asarray(distance), np.asarray(at, dtype=np.int64)


def polyhedron(points: ArrayLike, *, recentre: bool = False, name: str = "") -> Polyhedron:
    """Return the convex polyhedron with the given vertices. Qhull computes the convex hull, and coplanar facets are
    merged.

    Points are considered equal, and faces plane, within one millionth of the size of the solid. The result is checked
    by Euler's formula.

    Parameters
    ----------
    points : sequence of points, (vertices, 3)
        Vertices, in any unit.
    recentre : bool
        True to move the mean of the vertices to the origin; otherwise the origin must be inside the solid.
    name : str
        Name of the solid for display.

    Returns
    -------
    Polyhedron
        Solid with faces, normals and heights.

    Raises
    ------
    GearTrainError
        If a point is not a vertex of the hull, if the points are degenerate, or if the origin is not inside the hull.

    Examples
    --------
    >>> found = polyhedron([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)])
    >>> len(found.faces), len(found.symmetries), float(round(found.heights[0] * 3**0.5, 12))
    (4, 24, 1.0)
    """
    vertices = _checked(points)
    if recentre:
        vertices = vertices - vertices.mean(axis=0)
    # tolerances are relative to the size of the solid
    scale = float(np.linalg.norm(vertices - vertices.mean(axis=0), axis=1).max())
    found = [_face(vertices, face, scale) for face in _flats(vertices, scale)]
    normals = np.array([normal for _, normal, _ in found])
    heights = np.array([height for _, _, height in found])
    if heights.min() <= NEAR * scale:
        raise _refused(
            "the origin is not inside the solid",
            "the origin is the centre of the sphere, through which all axes of gears pass",
            "move the vertices around the origin, or pass recentre=True to move their mean to the origin",
        )
    order = from_the_top(normals)
    arrays = vertices, normals[order], heights[order]
    for array in arrays:
        array.flags.writeable = False  # solids by name are shared
    solid = Polyhedron(vertices, tuple(found[at][0] for at in order), *arrays[1:], name)
    _check_closed(solid)
    return solid


def from_the_top(points: Floats) -> Ints:
    """Return the order of points by descending height (z), with ties in counterclockwise order from x."""
    size = np.linalg.norm(points, axis=1).max()
    turn = np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi) % 1
    # rounding to millionths: noise neither separates equal points nor puts the one at x last
    return np.lexsort((np.round(turn, 6) % 1, -np.round(points[:, 2] / size, 6))).astype(np.int64)


def _sides(face: tuple[int, ...]) -> Iterator[tuple[int, int]]:
    return zip(face, face[1:] + face[:1], strict=True)


def _corners(face: tuple[int, ...]) -> Iterator[tuple[int, int, int]]:
    """Yield all triples of consecutive vertices of a face, beginning at every vertex and in both senses."""
    for way in (face, face[::-1]):
        yield from zip(way, way[1:] + way[:1], way[2:] + way[:2], strict=True)


def _checked(points: ArrayLike) -> Floats:
    """Return the points as an array; raise `GearTrainError` if they cannot be vertices of a solid."""
    try:
        vertices = np.array(points, dtype=np.float64)
    except (TypeError, ValueError):
        vertices = np.empty(0)
    if vertices.ndim != 2 or vertices.shape[1] != 3 or not np.isfinite(vertices).all():
        why = "a point has three finite coordinates"
        raise _refused("the vertices are not a list of points", why, "give [x, y, z] each")
    if len(vertices) < 4:
        what = f"{len(vertices)} points do not make a solid"
        raise _refused(what, "a polyhedron has at least four vertices", "add vertices")
    spread = np.linalg.svd(vertices - vertices.mean(axis=0), compute_uv=False)
    if spread[2] <= NEAR * spread[0]:
        raise _refused("the points are in one plane", "a polyhedron has a positive volume", "add a vertex outside it")
    from scipy.spatial import cKDTree

    repeated = cKDTree(vertices).query_pairs(NEAR * float(spread[0]) / len(vertices) ** 0.5)
    if repeated:
        first, second = min(repeated)
        what = f"vertices[{second}] repeats vertices[{first}] {_coordinates(vertices[first])}"
        raise _refused(what, "the vertices of a polyhedron must be distinct", "remove one of them")
    return vertices


def _flats(vertices: Floats, scale: float) -> list[frozenset[int]]:
    """Return the vertices of each face, which are all points on a plane of the convex hull."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(vertices / scale)
    except QhullError:
        raise _refused(
            "the points are nearly in one plane", "a polyhedron has a positive volume", "move them apart"
        ) from None
    # a point inside the hull would never carry a face
    inside = sorted(set(range(len(vertices))) - set(hull.vertices.tolist()))
    if inside:
        raise _not_a_corner(vertices, inside[0])
    off = np.abs(hull.equations[:, :3] @ (vertices / scale).T + hull.equations[:, 3:])
    sets = {frozenset(np.flatnonzero(row < NEAR).tolist()) for row in off}
    return [one for one in sets if not any(one < other for other in sets)]


def _face(vertices: Floats, members: frozenset[int], scale: float) -> tuple[tuple[int, ...], Floats, float]:
    """Return a face as a cycle of vertices, counterclockwise from outside, with its outward normal and height."""
    index = np.array(sorted(members))
    centre = vertices[index].mean(axis=0)
    arms = vertices[index] - centre
    # plane fitted by least squares: its normal is the right singular vector of the minimum singular value
    first, second, normal = np.linalg.svd(arms)[2]
    if normal @ (centre - vertices.mean(axis=0)) < 0:
        normal = -normal
    if np.cross(first, second) @ normal < 0:
        second = -second
    cycle = np.argsort(np.arctan2(arms @ second, arms @ first))
    index, arms = index[cycle], arms[cycle]
    ways = np.roll(arms, -1, axis=0) - arms
    area = float(np.cross(arms, ways).sum(axis=0) @ normal / 2)
    if area < NEAR * scale**2:
        raise _refused(f"face {index.tolist()} has no area", "its vertices are on one line", "remove one of them")
    lengths = np.linalg.norm(ways, axis=1)
    # sines of the exterior angles: 0 for a point on an edge
    turns = np.cross(np.roll(ways, 1, axis=0), ways) @ normal / (np.roll(lengths, 1) * lengths)
    if turns.min() < NEAR:
        raise _not_a_corner(vertices, int(index[turns.argmin()]))
    return tuple(np.roll(index, -int(index.argmin())).tolist()), normal, float(centre @ normal)


def _check_closed(solid: Polyhedron) -> None:
    """Raise `GearTrainError` unless every edge has a face on both sides and Euler's formula is satisfied."""
    left = solid._left
    closed = all((b, a) in left for a, b in left) and len(left) == sum(len(face) for face in solid.faces)
    if not closed or len(solid.vertices) - len(left) // 2 + len(solid.faces) != 2:
        raise _refused(
            "the faces do not close",
            "some points are neither clearly on a common plane nor clearly outside it",
            "give the coordinates to nine digits or more",
        )


def _not_a_corner(vertices: Floats, at: int) -> GearTrainError:
    return _refused(
        f"vertices[{at}] {_coordinates(vertices[at])} is not a vertex: it is inside the convex hull of the others",
        "gears are placed on the faces and vertices of a convex solid",
        "remove the point, or move it outwards",
    )


def _coordinates(point: Floats) -> str:
    return "(" + ", ".join(f"{x:.6g}" for x in point) + ")"


def _refused(what: str, why: str, fix: str) -> GearTrainError:
    return GearTrainError(Problem(what, why, fix))


# ------------------------------------------------------------------------------------------------------- solids by name


def solid_names() -> tuple[str, ...]:
    """Return the names that `solid` accepts, in which `n` represents the number of sides.

    Returns
    -------
    tuple of str
        Names of uniform solids, their duals, the Johnson solid J37, and families of solids.

    Examples
    --------
    >>> solid_names()[:3], solid_names()[-1]
    (('tetrahedron', 'cube', 'octahedron'), 'n-trapezohedron')
    """
    return (*_UNIFORM, *_DUALS, "J37", *(f"n-{family}" for family in _FAMILIES))


@cache
def solid(name: str) -> Polyhedron:
    """Return the solid with a given name. Solids are the uniform solids, by Wythoff's construction, their duals, prisms
    and antiprisms, and the Johnson solid J37.

    Coordinates are accurate to about 1e-15 of the size; the edges of uniform solids have the length 2.

    Parameters
    ----------
    name : str
        Name, such as `icosidodecahedron`, `6-antiprism`, `hexagonal prism`, `J37` or `buckyball`.

    Returns
    -------
    Polyhedron
        Solid. All calls with the same name return the same object, whose arrays are read-only.

    Raises
    ------
    GearTrainError
        If no solid has this name, or if the number of sides is not from 3 to 360.

    Examples
    --------
    >>> cube = solid("cube")
    >>> cube.faces[0], len(cube.edges), len(cube.symmetries)
    ((0, 1, 2, 3), 12, 48)
    """
    key = " ".join(name.lower().split())
    key = _ALIASES.get(key, key)
    if key in _DUALS:
        return solid(_DUALS[key]).dual(key)
    family = _FAMILY.fullmatch(key)
    if family:
        return _family_member(int(_SIDES.get(family[1], family[1])), family[2])
    if key in _UNIFORM:
        points = _wythoff(*_UNIFORM[key])
    elif key == "j37":
        key, points = "J37", _j37_vertices()
    else:
        known = [*_UNIFORM, *_DUALS, *_ALIASES, *(f"{n}-{family}" for n in range(3, 13) for family in _FAMILIES)]
        fix = suggest(name.lower(), known)
        if not fix.startswith("did"):
            fix = f"use a name such as 'icosidodecahedron' or '6-antiprism', one of: {', '.join(solid_names())}"
        raise _refused(f"unknown solid '{name}'", "a solid is given by a known name or by its vertices", fix)
    return polyhedron(points[from_the_top(points)], name=key)


def _wythoff(p: int, distances: tuple[int, ...]) -> Floats:
    """Return the images of a point with the given distances from the three mirrors under the reflection group [p, 3].
    If no distances are given, the solid is a snub solid, and only rotations are applied.
    """
    mirrors = np.array(_MIRRORS[p], dtype=np.float64)
    mirrors /= np.linalg.norm(mirrors, axis=1)[:, None]
    group = _group(p)
    if not distances:
        # snubs are chiral: reflections would give both forms
        group = group[np.linalg.det(group) > 0]
    point = np.linalg.solve(mirrors, np.array(distances or _snub(p), dtype=np.float64))
    images = group @ point
    # images of a point on a mirror coincide
    _, first = np.unique(np.round(images, 6) + 0.0, axis=0, return_index=True)
    found: Floats = images[first]
    return found


@cache
def _group(p: int) -> Floats:
    """Return the matrices of the reflection group [p, 3], shape (order, 3, 3), correctly rounded."""
    entries = np.array([sign * x for x in (0, 0.5, 1, PHI / 2, (PHI - 1) / 2) for sign in (1, -1)])
    mirrors = np.array(_MIRRORS[p], dtype=np.float64)
    reflections = [np.eye(3) - 2 * np.outer(m, m) / (m @ m) for m in mirrors]
    found, fresh = {}, [np.eye(3)]
    while fresh:
        # products accumulate rounding, but the possible entries are known; + 0.0 turns -0.0 into 0.0 for equal bytes
        near = np.abs(fresh.pop()[..., None] - entries).argmin(axis=-1)
        matrix = entries[near] + 0.0
        if matrix.tobytes() not in found:
            found[matrix.tobytes()] = matrix
            fresh += [mirror @ matrix for mirror in reflections]
    return np.array(list(found.values()))


def _snub(p: int) -> Floats:
    """Return the distances (a, b, c) of the generating point of a snub solid from the mirrors of [p, 3], for edges of
    length 2. Reflection at two mirrors at an angle g moves it by 2 sqrt(a^2 + b^2 + 2 a b cos g), which is 2 for all
    three pairs of mirrors; the equations are solved by Newton's method.
    """
    s, t = np.cos(np.pi / p), 0.5
    a, b, c = 0.6, 0.5, 0.8
    for _ in range(30):
        wrong = [a * a + b * b + 2 * a * b * s - 1, b * b + c * c + 2 * b * c * t - 1, a * a + c * c - 1]
        slope = [
            [2 * (a + b * s), 2 * (b + a * s), 0],
            [0, 2 * (b + c * t), 2 * (c + b * t)],
            [2 * a, 0, 2 * c],
        ]
        a, b, c = np.array([a, b, c]) - np.linalg.solve(slope, wrong)
    return np.array([a, b, c])


def _family_member(n: int, family: str) -> Polyhedron:
    """Return the uniform prism or antiprism whose caps are regular n-gons with edge length 2, or its dual."""
    if not 3 <= n <= MOST_SIDES:
        what, why = f"the solid '{n}-{family}' is not available", f"the number of sides must be 3 to {MOST_SIDES}"
        raise _refused(what, why, f"choose a number in this range, such as '6-{family}'")
    dual = {"bipyramid": "prism", "trapezohedron": "antiprism"}.get(family)
    if dual:
        return _family_member(n, dual).dual(f"{n}-{family}")
    # circumradius of an n-gon with edge 2, and half a step of rotation
    around, half = 1 / np.sin(np.pi / n), 0.5 * (family == "antiprism")
    # a lateral edge of an antiprism has length 2 and spans half the central angle of a cap's edge
    height = 1.0 if not half else np.sqrt(1 - (around * np.sin(np.pi / (2 * n))) ** 2)
    caps = []
    for z, shift in ((height, 0.0), (-height, half)):
        turn = 2 * np.pi * (np.arange(n) + shift) / n
        caps.append(np.stack([around * np.cos(turn), around * np.sin(turn), np.full(n, z)], axis=1))
    return polyhedron(np.concatenate(caps), name=f"{n}-{family}")


def _j37_vertices() -> Floats:
    """Return the vertices of J37, a rhombicuboctahedron whose lower third is rotated by an eighth of a revolution."""
    long, short = 1 + 2**0.5, 2**0.5
    middle = [[*p, z] for z in (1, -1) for s, t in product((1, -1), repeat=2) for p in ((s * long, t), (s, t * long))]
    top = [[s, t, long] for s, t in product((1, -1), repeat=2)]
    return np.array(top + middle + [[short, 0, -long], [-short, 0, -long], [0, short, -long], [0, -short, -long]])
