"""Convex polyhedra about the origin: faces from vertices, what meets what, and the symmetries that keep them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Ints


NEAR = 1e-6
"""What counts as equal, as a part of the solid's size: points, planes and symmetries alike."""


@dataclass(frozen=True, eq=False)
class Polyhedron:
    """A convex polyhedron with the origin inside.

    Attributes
    ----------
    vertices : array of float, (vertices, 3)
        As they were given, in any unit.
    faces : tuple of tuple of int
        Vertices of each face by index, counterclockwise seen from outside; faces from the top (z) down, and
        counterclockwise from x where they are equally high.
    normals : array of float, (faces, 3)
        Outward unit normals.
    heights : array of float, (faces,)
        Distance of each face's plane from the origin, in the unit of the vertices.
    name : str
        For a reader.

    See Also
    --------
    polyhedron, solid : what gives these.
    """

    vertices: Floats
    faces: tuple[tuple[int, ...], ...]
    normals: Floats = field(repr=False)
    heights: Floats = field(repr=False)
    name: str = ""

    @cached_property
    def _left(self) -> dict[tuple[int, int], int]:
        """The face to the left of each directed edge."""
        return {side: at for at, face in enumerate(self.faces) for side in _sides(face)}

    @cached_property
    def edges(self) -> tuple[tuple[int, int], ...]:
        """Every edge once, as two vertices."""
        return tuple(sorted(side for side in self._left if side[0] < side[1]))

    @cached_property
    def borders(self) -> tuple[tuple[int, int], ...]:
        """The two faces at each edge."""
        return tuple((self._left[a, b], self._left[b, a]) for a, b in self.edges)

    @cached_property
    def degrees(self) -> tuple[int, ...]:
        """Number of edges at each vertex."""
        count = Counter(vertex for edge in self.edges for vertex in edge)
        return tuple(count[vertex] for vertex in range(len(self.vertices)))

    @cached_property
    def symmetries(self) -> Floats:
        """All rotations and reflections about the origin that keep the solid, (order, 3, 3), errors about 1e-15.

        A symmetry is known by the image of one corner (three vertices in a row on one face), so trying all corners
        that are congruent to the first finds them all.
        """
        corners = self.vertices[[corner for face in self.faces for corner in _corners(face)]]
        gram = corners @ corners.transpose(0, 2, 1)
        alike = np.abs(gram - gram[0]).max(axis=(1, 2)) < NEAR * gram[0].max()
        guesses = np.linalg.inv(corners[0]) @ corners[alike]  # rows: v -> v @ guess
        distance, image = self._nearest(self.vertices, self.vertices @ guesses)
        image = image[distance.max(axis=1) < NEAR * self.size]
        # orthogonal Procrustes
        left, _, right = np.linalg.svd(self.vertices[image].transpose(0, 2, 1) @ self.vertices)
        found: Floats = left @ right  # of all matrices the best one for all vertices, not for the first corner only
        return found

    def permutations(self, points: Floats) -> Ints:
        """Where each symmetry takes each point of a set that it keeps.

        Parameters
        ----------
        points : array of float, (points, 3)
            A set that all symmetries keep.

        Returns
        -------
        array of int, (symmetries, points)
            Indices of the images.
        """
        return self._nearest(points, points @ self.symmetries.transpose(0, 2, 1))[1]

    def orbits(self, points: Floats) -> Ints:
        """For each point of a set that the symmetries keep, the first point that they take to it.

        Parameters
        ----------
        points : array of float, (points, 3)
            A set that all symmetries keep.

        Returns
        -------
        array of int, (points,)
            Indices; equal for points of one orbit.
        """
        first: Ints = self.permutations(points).min(axis=0)
        return first

    @property
    def size(self) -> float:
        """Distance of the farthest vertex from the origin."""
        return float(np.linalg.norm(self.vertices, axis=1).max())

    def dual(self, name: str = "") -> Polyhedron:
        """The polar solid: its vertices stand on the normals of these faces, and its normals at these vertices.

        Parameters
        ----------
        name : str
            Of the polar solid, for a reader.

        Returns
        -------
        Polyhedron
            Vertices at the reciprocal heights.
        """
        return polyhedron(self.normals / self.heights[:, None], name=name)

    @staticmethod
    def _nearest(points: Floats, images: Floats) -> tuple[Floats, Ints]:
        from scipy.spatial import cKDTree

        distance, at = cKDTree(points).query(images)
        return np.asarray(distance), np.asarray(at, dtype=np.int64)


def polyhedron(points: ArrayLike, *, recentre: bool = False, name: str = "") -> Polyhedron:
    """The convex polyhedron with these vertices: convex hull (Qhull), flat facets joined, Euler's formula checked.

    Vertices count as one, and a face as flat, within a millionth of the size.

    Parameters
    ----------
    points : sequence of points, (vertices, 3)
        The vertices, in any unit.
    recentre : bool
        Puts the mean of the vertices at the origin; else the origin must lie inside.
    name : str
        For a reader.

    Returns
    -------
    Polyhedron
        With faces, normals and heights.

    Raises
    ------
    GearTrainError
        If a point is no corner of the hull, the points are degenerate, or the origin is not inside.

    Examples
    --------
    >>> found = polyhedron([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)])
    >>> len(found.faces), len(found.symmetries), float(round(found.heights[0] * 3**0.5, 12))
    (4, 24, 1.0)
    """
    vertices = _checked(points)
    if recentre:
        vertices = vertices - vertices.mean(axis=0)
    scale = float(np.linalg.norm(vertices - vertices.mean(axis=0), axis=1).max())
    found = [_face(vertices, face, scale) for face in _flats(vertices, scale)]
    normals = np.array([normal for _, normal, _ in found])
    heights = np.array([height for _, _, height in found])
    _check_origin(heights, scale)
    order = from_the_top(normals)
    arrays = vertices, normals[order], heights[order]
    for array in arrays:
        array.flags.writeable = False  # solids by name are shared
    solid = Polyhedron(vertices, tuple(found[at][0] for at in order), *arrays[1:], name)
    _check_closed(solid)
    return solid


def from_the_top(points: Floats) -> Ints:
    """The order of points from the top (z) down, counterclockwise from x where they are equally high."""
    size = np.linalg.norm(points, axis=1).max()
    turn = np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi) % 1
    # millionths: noise neither parts equals nor puts the one at x last
    return np.lexsort((np.round(turn, 6) % 1, -np.round(points[:, 2] / size, 6))).astype(np.int64)


def _sides(face: tuple[int, ...]) -> Iterator[tuple[int, int]]:
    return zip(face, face[1:] + face[:1], strict=True)


def _corners(face: tuple[int, ...]) -> Iterator[tuple[int, int, int]]:
    """Three vertices in a row, from every vertex and both ways round."""
    for way in (face, face[::-1]):
        yield from zip(way, way[1:] + way[:1], way[2:] + way[:2], strict=True)


def _checked(points: ArrayLike) -> Floats:
    """The points as an array, if they can be vertices of a solid at all."""
    try:
        vertices = np.array(points, dtype=np.float64)
    except (TypeError, ValueError):
        vertices = np.empty(0)
    if vertices.ndim != 2 or vertices.shape[1] != 3 or not np.isfinite(vertices).all():
        raise _refused("the vertices are no list of points", "a point is three finite numbers x, y, z")
    if len(vertices) < 4:
        raise _refused(f"{len(vertices)} points make no solid", "a polyhedron has at least four vertices")
    spread = np.linalg.svd(vertices - vertices.mean(axis=0), compute_uv=False)
    if spread[2] <= NEAR * spread[0]:
        raise _refused("the points lie in one plane", "a polyhedron has a volume")
    _check_apart(vertices, NEAR * float(spread[0]) / len(vertices) ** 0.5)
    return vertices


def _check_apart(vertices: Floats, near: float) -> None:
    from scipy.spatial import cKDTree

    for first, second in sorted(cKDTree(vertices).query_pairs(near)):
        raise _refused(
            f"vertices[{second}] repeats vertices[{first}] {_at(vertices[first])}",
            "the corners of a polyhedron are distinct",
            "leave one of them out",
        )


def _flats(vertices: Floats, scale: float) -> list[frozenset[int]]:
    """The vertices of each face: of each plane of the hull, all that lie on it."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(vertices / scale)
    except QhullError:
        raise _refused("the points are nearly flat", "a polyhedron has a volume") from None
    inside = sorted(set(range(len(vertices))) - set(hull.vertices.tolist()))
    if inside:
        raise _not_a_corner(vertices, inside[0])
    off = np.abs(hull.equations[:, :3] @ (vertices / scale).T + hull.equations[:, 3:])
    sets = {frozenset(np.flatnonzero(row < NEAR).tolist()) for row in off}
    return [one for one in sets if not any(one < other for other in sets)]


def _face(vertices: Floats, members: frozenset[int], scale: float) -> tuple[tuple[int, ...], Floats, float]:
    """A face as a cycle, counterclockwise from outside, with its outward normal and its height."""
    index = np.array(sorted(members))
    centre = vertices[index].mean(axis=0)
    arms = vertices[index] - centre
    # the plane of least squares: the right singular vector of the least singular value is its normal
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
        raise _refused(f"face {index.tolist()} has no area", "its vertices lie on one line")
    lengths = np.linalg.norm(ways, axis=1)
    turns = np.cross(np.roll(ways, 1, axis=0), ways) @ normal / (np.roll(lengths, 1) * lengths)
    if turns.min() < NEAR:
        raise _not_a_corner(vertices, int(index[turns.argmin()]))
    return tuple(np.roll(index, -int(index.argmin())).tolist()), normal, float(centre @ normal)


def _check_origin(heights: Floats, scale: float) -> None:
    if heights.min() <= NEAR * scale:
        raise _refused(
            "the origin does not lie inside the solid",
            "the sphere's centre is the origin: all axes of gears go through it",
            "move the vertices so that it does, or pass recentre=True to put it at their mean",
        )


def _check_closed(solid: Polyhedron) -> None:
    """Every edge has a face on both sides, and Euler's formula holds."""
    left = solid._left
    closed = all((b, a) in left for a, b in left) and len(left) == sum(len(face) for face in solid.faces)
    if not closed or len(solid.vertices) - len(left) // 2 + len(solid.faces) != 2:
        raise _refused(
            "the faces do not close",
            "some points are neither clearly on a common plane nor clearly off it",
            "give the coordinates to nine digits or more",
        )


def _not_a_corner(vertices: Floats, at: int) -> GearTrainError:
    return _refused(
        f"vertices[{at}] {_at(vertices[at])} is no corner: it lies inside the hull of the others, or on its surface",
        "gears stand on the faces and vertices of a convex solid",
        "leave the point out, or move it outwards",
    )


def _at(point: Floats) -> str:
    return "(" + ", ".join(f"{x:.6g}" for x in point) + ")"


def _refused(what: str, why: str, fix: str = "correct the vertices") -> GearTrainError:
    return GearTrainError(Problem(what, why, fix))
