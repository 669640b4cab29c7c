"""The places for gears on a polyhedron: axes, which of them mesh, and how its symmetries exchange them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from geartrain.errors import GearTrainError, Problem, QuestionError
from geartrain.spherical.moving import Movement
from geartrain.spherical.polyhedra import Polyhedron
from geartrain.train import suggest

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

Gears = Literal["faces", "vertices", "faces+vertices", "faces+edges", "faces+vertices+edges"]


@dataclass(frozen=True, eq=False)
class Layout:
    """All gears a solid gives a place to, before any is left out.

    axes      unit vectors, (gears, 3)
    letters   of each gear: the number of sides of its face, v for a vertex, e for an edge
    meshes    pairs of gears by index
    movement  the symmetries of the solid, acting on the gears
    """

    axes: Floats
    letters: tuple[str, ...]
    meshes: tuple[tuple[int, int], ...]
    movement: Movement


def layout(base: Polyhedron, gears: str) -> Layout:
    """The places of an arrangement of gears on a solid. Raises `GearTrainError`."""
    if gears not in get_args(Gears):
        raise QuestionError(
            Problem(
                f"there is no arrangement '{gears}'", "gears stand on parts of a solid", suggest(gears, get_args(Gears))
            )
        )
    faces = (base.normals, [str(len(face)) for face in base.faces])
    corners = base.vertices / np.linalg.norm(base.vertices, axis=1)[:, None]
    vertices = (corners, ["v"] * len(corners))
    flags = [(at, vertex) for at, face in enumerate(base.faces) for vertex in face]
    count = len(base.faces)
    if gears == "faces":
        return _joined(base, [faces], base.borders)
    if gears == "vertices":
        return _joined(base, [vertices], base.edges)
    if gears == "faces+vertices":
        return _joined(base, [faces, vertices], [(at, count + vertex) for at, vertex in flags])
    if gears == "faces+edges":
        middle = (_between(base.normals, base.borders), ["e"] * len(base.edges))
        idlers = [(face, count + at) for at, border in enumerate(base.borders) for face in border]
        return _joined(base, [faces, middle], idlers)
    return _two_an_edge(base, faces, vertices)


def _two_an_edge(base: Polyhedron, faces: tuple[Floats, list[str]], vertices: tuple[Floats, list[str]]) -> Layout:
    """Vertices, faces, and two gears on each edge, one near each end."""
    middles = _between(vertices[0], base.edges)
    if any(base.orbits(points).any() for points in (faces[0], vertices[0], middles)):
        raise GearTrainError(
            Problem(
                f"the {base.name or 'solid'} takes no two gears on each edge",
                "that arrangement needs faces, vertices and edges that are each all alike",
                "take one of the five Platonic solids, or gears='faces+edges'",
            )
        )
    count, total = len(base.faces), len(base.faces) + len(base.vertices)
    ends: list[Floats] = []
    meshes: list[tuple[int, int]] = []
    for at, (edge, border) in enumerate(zip(base.edges, base.borders, strict=True)):
        for vertex in edge:
            meshes += [(count + vertex, total + len(ends)), *((face, total + len(ends)) for face in border)]
            ends.append(vertices[0][vertex] + middles[at])
    quarters = np.array(ends) / np.linalg.norm(ends, axis=1)[:, None]
    return _joined(base, [faces, vertices, (quarters, ["e"] * len(ends))], meshes)


def _between(points: Floats, pairs: Sequence[tuple[int, int]]) -> Floats:
    """The middles of arcs."""
    sums = points[np.array(pairs)].sum(axis=1)
    middles: Floats = sums / np.linalg.norm(sums, axis=1)[:, None]
    return middles


def _joined(base: Polyhedron, blocks: list[tuple[Floats, list[str]]], meshes: Iterable[tuple[int, int]]) -> Layout:
    images, start = [], 0
    for points, _ in blocks:
        images.append(start + base.permutations(points))
        start += len(points)
    return Layout(
        axes=np.concatenate([points for points, _ in blocks]),
        letters=tuple(letter for _, letters in blocks for letter in letters),
        meshes=tuple(meshes),
        movement=Movement(base.symmetries, np.concatenate(images, axis=1)),
    )
