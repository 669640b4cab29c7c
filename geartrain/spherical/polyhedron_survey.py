"""A table of polyhedra with gears on all faces: whether they move, what would free them, and what can be exact."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.plain_data import Result
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
    """Gears on all faces of one solid: a row of the table in section 2 of docs/sphere.md.

    Attributes
    ----------
    solid : str
        Its name.
    gears, meshes : int
        Faces, and edges.
    bipartite : bool
        Neighbours can turn against each other everywhere: the set moves, with one degree of freedom.
    gruebler : int
        Gears less meshes, the degrees of freedom that a count gives.
    drop : int
        Least number of meshes to take out so that it moves.
    types : int
        Kinds of gear: orbits under the symmetries of the solid.
    mesh_kinds : int
        Kinds of mesh, likewise.
    positions : int
        Free parameters of the axes while all symmetries are kept.
    angles : tuple of float
        Of the meshes [deg], those that differ by more than 1e-9, ascending.

    See Also
    --------
    survey : what gives these.
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


def survey(solids: Iterable[str | Polyhedron] = SURVEYED) -> tuple[SurveyRow, ...]:
    """Gears on all faces of some solids: whether they move, what would free them, and what can be exact.

    Parameters
    ----------
    solids : iterable of str or Polyhedron
        Default the Platonic and Archimedean solids, and J37.

    Returns
    -------
    tuple of SurveyRow
        One a solid.

    Examples
    --------
    >>> row, = survey(["cube"])
    >>> row.gears, row.meshes, row.bipartite, row.drop
    (6, 12, False, 4)
    """
    return tuple(_row(solid(shape) if isinstance(shape, str) else shape) for shape in solids)


def _row(base: Polyhedron) -> SurveyRow:
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
        drop=least_drop(base),
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
