"""Gears on a polyhedron: on its faces, its vertices, both, or with idlers on its edges.

And a table of polyhedra with gears on all faces: whether they move, what would free them, and what can be exact.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Result
from geartrain.spherical.configuration import Configuration
from geartrain.spherical.gear_places import (
    Gears,
    PolyhedronPlaces,
    TeethByKind,
    in_order,
    kinds_of,
    letter_of,
    names_of,
    places_on_polyhedron,
    teeth_of,
    without_gears,
)
from geartrain.spherical.named_solids import solid
from geartrain.spherical.polyhedra import Polyhedron, polyhedron
from geartrain.spherical.symmetric_displacement import equal_pitch

if TYPE_CHECKING:
    import networkx as nx
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


_EQUAL = 1e-12  # turns: contacts of a gear that stand at equal angles
_MOST_PARTS = 60  # of a turn: so few that no angle is within 1e-12 of a multiple of one by accident


def from_polyhedron(
    shape: str | Polyhedron | ArrayLike,
    gears: Gears = "faces",
    *,
    teeth: TeethByKind | None = None,
    drop: Iterable[str] = (),
    exact: bool = False,
    recentre: bool = False,
) -> Configuration:
    """Gears on a polyhedron: on its faces, its vertices, both, or with idlers on its edges.

    Kinds are orbits under all rotations and reflections of the solid. They are named by the number of sides, v and e;
    where several share that they get letters, fewer gears first, then those nearer to the smallest orbit. Gears are
    numbered within their kind from the top (z) down, counterclockwise from x. Gears on edges stand where both their
    pitches are equal, which depends on the teeth; while these are not chosen, at the middle of the arc (of two, at a
    quarter and three quarters of the edge).

    Parameters
    ----------
    shape : str, Polyhedron or sequence of points, (vertices, 3)
        A name that `solid` knows, a solid, or its vertices.
    gears : str
        Where gears stand:

        - `faces`: one on each face, about its normal; faces with a common edge mesh.
        - `vertices`: one on each vertex; vertices with a common edge mesh.
        - `faces+vertices`: a vertex meshes with the faces round it.
        - `faces+edges`: faces that share an edge mesh with an idler between them.
        - `faces+vertices+edges`: two gears on each edge, each in mesh with a vertex and both faces (Platonic solids,
          whose edges are all alike).
    teeth : mapping of str to int, or int, optional
        Tooth number of each kind, `{"5": 20, "3": 12}`, or one for all; `4` stands for 4a and 4b.
    drop : iterable of str
        Kinds (`4b`), gears (`5-1`) and meshes (`5-1~3-2`, or `6~6` for all between two kinds) to leave out.
    exact : bool
        Moves the axes, keeping all symmetries, to where every mesh has the same pitch; needs teeth.
    recentre : bool
        Puts the mean of the vertices at the sphere's centre.

    Returns
    -------
    Configuration
        The set.

    Raises
    ------
    GearTrainError
        If the solid, a kind, a gear or a mesh is not known, or no place with one pitch is found near the solid's own
        axes.

    Examples
    --------
    >>> found = from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12})
    >>> len(found.names), len(found.meshes), found.names[0], dict(found.teeth)
    (32, 60, '5-1', {'5': 20, '3': 12})
    """
    base = _solid(shape, recentre)
    plan = places_on_polyhedron(base, gears)
    kinds = kinds_of(plan)
    counts = teeth_of(teeth, kinds)
    names = names_of(plan, kinds)
    kept, meshes = without_gears(names, kinds, plan.meshes, [drop] if isinstance(drop, str) else drop)
    axes = _placed(plan, kinds, meshes, counts, exact)
    order = [at for at in in_order(plan, kinds) if at in kept]
    axes = axes[order]
    axes.flags.writeable = False
    place = {at: new for new, at in enumerate(order)}
    meshes = sorted((min(pair), max(pair)) for a, b in meshes if (pair := (place[a], place[b])))
    contacts = np.bincount(np.array(plan.meshes).ravel())
    result = Configuration(
        names=tuple(names[at] for at in order),
        axes=axes,
        meshes=tuple(meshes),
        kinds=tuple(kinds[at] for at in order),
        regular=(0,) * len(order),
        teeth={kind: counts[kind] for kind in dict.fromkeys(kinds[at] for at in order) if kind in counts},
        title=_title(base, gears, len(order), len(meshes)),
    )
    return regular(result, max(_MOST_PARTS, 2 * int(contacts.max())))


def regular(configuration: Configuration, most: int = _MOST_PARTS) -> Configuration:
    """The configuration with `regular` found: the least p up to `most` that parts a turn so that all contacts fit.

    Angles within 1e-12 of a turn of a multiple of 1/p are taken for exact; coordinates must be right to more digits
    than that to be called regular.
    """
    contacts = defaultdict(list)
    for i, j in configuration.meshes:
        contacts[i].append(configuration.azimuth(i, j))
        contacts[j].append(configuration.azimuth(j, i))
    parts = (_parts(np.array(contacts[gear]), most) for gear in range(len(configuration.names)))
    return replace(configuration, regular=tuple(parts))


def _parts(azimuths: Floats, most: int) -> int:
    """The least p of which all differences of these azimuths are multiples of a p-th of a turn, or 0."""
    turns = (azimuths - azimuths[0]) / (2 * np.pi) if len(azimuths) else azimuths
    for p in range(1, most + 1):
        if np.abs(p * turns - np.round(p * turns)).max(initial=0.0) < p * _EQUAL:
            return p
    return 0


def _solid(shape: str | Polyhedron | ArrayLike, recentre: bool) -> Polyhedron:
    if isinstance(shape, str):
        return solid(shape)
    return shape if isinstance(shape, Polyhedron) else polyhedron(shape, recentre=recentre)


def _placed(
    plan: PolyhedronPlaces,
    kinds: Sequence[str],
    meshes: Sequence[tuple[int, int]],
    counts: Mapping[str, int],
    exact: bool,
) -> Floats:
    """The axes, moved to equal pitches where that was asked for; gears on edges as soon as their teeth are known."""
    teeth = [counts.get(kind, 0) for kind in kinds]
    if exact:
        missing = sorted({kinds[at] for pair in meshes for at in pair if not teeth[at]})
        if missing:
            raise QuestionError(
                Problem(
                    f"exact places need the teeth of {', '.join(missing)}", "pitches depend on them", "give `teeth`"
                )
            )
        return equal_pitch(plan.movement, plan.axes, meshes, teeth, range(len(kinds))) if meshes else plan.axes
    axes = plan.axes
    for kind in dict.fromkeys(kind for kind in kinds if letter_of(kind) == "e"):
        own = [at for at, name in enumerate(kinds) if name == kind]
        touching = [(i, j) for i, j in plan.meshes if kind in (kinds[i], kinds[j])]
        if all(teeth[at] for pair in touching for at in pair):
            axes = equal_pitch(plan.movement, axes, touching, teeth, own)
    return axes


def _title(base: Polyhedron, gears: str, count: int, meshes: int) -> str:
    return f"Gears on the {gears.replace('+', ' and ')} of the {base.name or 'given solid'}: {count}, {meshes} meshes"


# ---------------------------------------------------------------------------------------------------- polyhedron survey


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
