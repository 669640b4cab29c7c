"""A table of polyhedra with gears on all faces: whether they move, what would free them, and what can be exact."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.plain_data import Result
from geartrain.spherical.configuration import Configuration
from geartrain.spherical.gear_places import places_on_polyhedron
from geartrain.spherical.named_solids import solid
from geartrain.spherical.polyhedra import Polyhedron
from geartrain.spherical.polyhedron_gears import from_polyhedron

if TYPE_CHECKING:
    import networkx as nx

SURVEYED = (
    *("tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"),
    *("truncated tetrahedron", "cuboctahedron", "truncated cube", "truncated octahedron", "rhombicuboctahedron"),
    *("truncated cuboctahedron", "snub cube", "icosidodecahedron", "truncated dodecahedron"),
    *("truncated icosahedron", "rhombicosidodecahedron", "truncated icosidodecahedron", "snub dodecahedron", "J37"),
)
"""The solids of the table: Platonic, Archimedean, and the one that looks Archimedean."""


@dataclass(frozen=True)
class SurveyRow(Result):
    """Gears on all faces of one solid.

    gears, meshes  their numbers
    bipartite      neighbours can turn against each other everywhere: the set moves, with one degree of freedom
    gruebler       gears less meshes, the degrees of freedom that a count gives
    drop           least number of meshes to take out so that it moves
    types          kinds of gear, and `mesh_kinds` of mesh: orbits under the symmetries of the solid
    positions      free parameters of the axes while all symmetries are kept
    angles         of the meshes (deg), those that differ by more than 1e-9, ascending
    """

    KEYS = (
        "solid",
        "gears",
        "meshes",
        "bipartite",
        "gruebler",
        "drop",
        "types",
        "mesh_kinds",
        "positions",
        "angles",
        "exact",
    )

    solid: str
    gears: int
    meshes: int
    bipartite: bool
    gruebler: int
    drop: int
    types: int
    mesh_kinds: int
    positions: int
    angles: tuple[float, ...]

    @property
    def exact(self) -> bool:
        """Equal pitches have as many unknowns, positions and the pitch, as there are kinds of mesh to satisfy."""
        return self.positions + 1 >= self.mesh_kinds


def survey(
    solids: Iterable[str | Polyhedron] = SURVEYED, drop: Callable[[Configuration], int] | None = None
) -> tuple[SurveyRow, ...]:
    """One row for each solid; `drop` counts the meshes to take out, by default by a T-join on the odd vertices."""
    return tuple(_row(solid(shape) if isinstance(shape, str) else shape, drop) for shape in solids)


def _row(base: Polyhedron, drop: Callable[[Configuration], int] | None) -> SurveyRow:
    plan = places_on_polyhedron(base, "faces")
    types = [int(first) for first in np.unique(plan.movement.orbits())]
    configuration = from_polyhedron(base)
    angles = sorted(np.degrees([configuration.angle(i, j) for i, j in configuration.meshes]))
    return SurveyRow(
        solid=base.name,
        gears=len(base.faces),
        meshes=len(base.edges),
        # two colours for the faces of a map, when every vertex has an even number of them
        bipartite=not any(degree % 2 for degree in base.degrees),
        gruebler=len(base.faces) - len(base.edges),
        drop=drop(configuration) if drop else least_drop(base),
        types=len(types),
        mesh_kinds=len(np.unique(plan.movement.mesh_orbits(plan.meshes))),
        positions=sum(len(plan.movement.freedom(gear, plan.axes[gear])) for gear in types),
        angles=tuple(float(a) for at, a in enumerate(angles) if at == 0 or a - angles[at - 1] > 1e-9),
    )


def least_drop(base: Polyhedron) -> int:
    """The least number of meshes to take out of gears on all faces, so that they move.

    An edge of the solid is a mesh. Taking some out makes the faces two-colourable when at every odd vertex an odd
    number goes, and at every even one an even number: a T-join, the shortest paths that pair the odd vertices
    (Edmonds and Johnson 1973).
    """
    import networkx as nx

    graph: nx.Graph[int] = nx.Graph(base.edges)
    odd = [vertex for vertex, degree in enumerate(base.degrees) if degree % 2]
    # one edge for two odd vertices is the least there can be, and needs no weights
    neighbours = nx.max_weight_matching(graph.subgraph(odd), maxcardinality=True)
    if 2 * len(neighbours) == len(odd):
        return len(neighbours)
    paths: nx.Graph[int] = nx.Graph()
    for at, start in enumerate(odd):
        steps = nx.single_source_shortest_path_length(graph, start)
        paths.add_weighted_edges_from((start, end, steps[end]) for end in odd[at + 1 :])
    pairs = nx.min_weight_matching(paths)
    return int(sum(paths[a][b]["weight"] for a, b in pairs))
