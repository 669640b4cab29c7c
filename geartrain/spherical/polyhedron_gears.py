"""Gears on a polyhedron: on its faces, on its vertices, on both, or with idlers on its edges.

The module computes axes, meshes, kinds by symmetry, and names. A survey of polyhedra with gears on all faces lists the
mobility, the number of meshes to remove, and whether equal pitches are possible.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from string import ascii_lowercase
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from geartrain.errors import GearTrainError, Problem, QuestionError, suggest
from geartrain.numerics.results import Result
from geartrain.spherical.axis_adjustment import SymmetricFreedom, equal_pitch
from geartrain.spherical.configuration import Configuration, require_tooth_numbers
from geartrain.spherical.gear_sphere import GearSphere
from geartrain.spherical.polyhedra import Polyhedron, from_the_top, polyhedron, solid

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats

Gears = Literal["faces", "vertices", "faces+vertices", "faces+edges", "faces+vertices+edges"]
_AFTER_FACES = ("v", "e")
_EQUAL = 1e-12  # revolutions: tolerance of the contact angles of one gear
_MOST_PARTS = 60  # parts of a revolution: few enough that no angle is within 1e-12 of a multiple by accident
SURVEYED = (
    *("tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"),
    *("truncated tetrahedron", "cuboctahedron", "truncated cube", "truncated octahedron", "rhombicuboctahedron"),
    *("truncated cuboctahedron", "snub cube", "icosidodecahedron", "truncated dodecahedron"),
    *("truncated icosahedron", "rhombicosidodecahedron", "truncated icosidodecahedron", "snub dodecahedron", "J37"),
)
"""Solids of the survey: the Platonic and Archimedean solids, and J37, which resembles an Archimedean solid."""


def from_polyhedron(
    shape: str | Polyhedron | ArrayLike,
    gears: Gears = "faces",
    *,
    teeth: TeethByKind | None = None,
    drop: Iterable[str] = (),
    exact: bool = False,
    recentre: bool = False,
) -> Configuration:
    """Place gears on the faces or vertices of a polyhedron, on both, or with idlers on its edges.

    Kinds are orbits under all rotations and reflections of the solid. Their names are the number of sides of the face,
    v for a vertex, or e for an edge. Kinds with equal names are distinguished by an additional letter, in ascending
    order of the number of gears, then of the distance from the smallest orbit. Gears of a kind are numbered in
    descending order of height (z), and at equal heights counterclockwise from x. The position of a gear on an edge
    depends on the tooth numbers, so that its two pitches are equal. If tooth numbers are not chosen, a gear is in the
    middle of its edge, or two gears are at one quarter and three quarters of the edge.

    Parameters
    ----------
    shape : str, Polyhedron or sequence of points, (vertices, 3)
        A name in `solid_names()`, a solid, or its vertices.
    gears : str
        Arrangement of the gears:

        - `faces`: one gear on each face, about its normal; gears of faces with a common edge mesh.
        - `vertices`: one gear on each vertex; gears of vertices with a common edge mesh.
        - `faces+vertices`: each gear of a vertex meshes with the gears of the faces around it.
        - `faces+edges`: the gears of faces that share an edge mesh with an idler between them.
        - `faces+vertices+edges`: two gears on each edge, each in mesh with a vertex and both faces (Platonic solids,
          whose edges are all alike).
    teeth : mapping of str to int, or int, optional
        Tooth number of each kind, such as `{"5": 20, "3": 12}`, or one number for all; the key `4` includes 4a and 4b.
    drop : iterable of str
        Kinds (`4b`), gears (`5-1`) and meshes (`5-1~3-2`, or `6~6` for all meshes between two kinds) that are omitted.
    exact : bool
        True to move the axes, keeping all symmetries, until every mesh has the same pitch; requires `teeth`.
    recentre : bool
        True to move the mean of the vertices to the centre of the sphere.

    Returns
    -------
    Configuration
        Axes, meshes, kinds and tooth numbers of the set.

    Raises
    ------
    GearTrainError
        If the solid, a kind, a gear or a mesh does not exist, or if no axes with equal pitches are found near the axes
        of the solid.

    Examples
    --------
    >>> found = from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12})
    >>> len(found.names), len(found.meshes), found.names[0], dict(found.teeth)
    (32, 60, '5-1', {'5': 20, '3': 12})
    """
    if isinstance(shape, str):
        base = solid(shape)
    else:
        base = shape if isinstance(shape, Polyhedron) else polyhedron(shape, recentre=recentre)
    plan = places_on_polyhedron(base, gears)
    kinds = kinds_of(plan)
    counts = teeth_of(teeth, kinds)
    ordered, count = in_order(plan, kinds), dict.fromkeys(kinds, 0)
    names = [""] * len(kinds)
    for at in ordered:
        count[kinds[at]] += 1
        names[at] = f"{kinds[at]}-{count[kinds[at]]}"
    kept, meshes = without_gears(names, kinds, plan.meshes, [drop] if isinstance(drop, str) else drop)
    axes = _placed(plan, kinds, meshes, counts, exact)
    order = [at for at in ordered if at in kept]
    axes = axes[order]
    # configurations are immutable
    axes.flags.writeable = False
    place = {at: new for new, at in enumerate(order)}
    meshes = sorted((min(pair), max(pair)) for a, b in meshes if (pair := (place[a], place[b])))
    # faces with many sides have more contacts than the default limit of parts
    contacts = np.bincount(np.array(plan.meshes).ravel())
    result = Configuration(
        names=tuple(names[at] for at in order),
        axes=axes,
        meshes=tuple(meshes),
        kinds=tuple(kinds[at] for at in order),
        regular=(0,) * len(order),
        teeth={kind: counts[kind] for kind in dict.fromkeys(kinds[at] for at in order) if kind in counts},
        title=f"Gears on the {gears.replace('+', ' and ')} of the {base.name or 'given solid'}: {len(order)}, "
        f"{len(meshes)} meshes",
    )
    return regular(result, max(_MOST_PARTS, 2 * int(contacts.max())))


def regular(configuration: Configuration, most: int) -> Configuration:
    """Return the configuration with its field `regular`: for each gear, the minimum p up to `most` for which its
    contacts are at multiples of 1/p of a revolution, or 0 if there is none.

    Angles within 1e-12 of a revolution of a multiple of 1/p are treated as exact, so coordinates must have this
    accuracy.
    """
    contacts = defaultdict(list)
    for i, j in configuration.meshes:
        contacts[i].append(configuration.azimuth(i, j))
        contacts[j].append(configuration.azimuth(j, i))
    parts = []
    for gear in range(len(configuration.names)):
        azimuths = np.array(contacts[gear])
        turns = (azimuths - azimuths[:1]) / (2 * np.pi)
        off = ((p, np.abs(p * turns - np.round(p * turns)).max(initial=0.0)) for p in range(1, most + 1))
        parts.append(next((p for p, miss in off if miss < p * _EQUAL), 0))
    return replace(configuration, regular=tuple(parts))


def _placed(
    plan: PolyhedronPlaces,
    kinds: Sequence[str],
    meshes: Sequence[tuple[int, int]],
    counts: Mapping[str, int],
    exact: bool,
) -> Floats:
    """Return the axes, moved so that the pitches of their meshes are equal. All axes are moved if `exact` is True,
    otherwise only the axes on edges of which the teeth and the teeth of all mates are known.
    """
    teeth = [counts.get(kind, 0) for kind in kinds]
    if exact:
        require_tooth_numbers(
            sorted({kinds[at] for pair in meshes for at in pair}),
            counts,
            "exact=True requires the tooth number of every kind that meshes",
            "give `teeth` for these kinds",
        )
        return equal_pitch(plan.movement, plan.axes, meshes, teeth, range(len(kinds))) if meshes else plan.axes
    axes = plan.axes
    for kind in dict.fromkeys(kind for kind in kinds if letter_of(kind) == "e"):
        own = [at for at, name in enumerate(kinds) if name == kind]
        touching = [(i, j) for i, j in plan.meshes if kind in (kinds[i], kinds[j])]
        if all(teeth[at] for pair in touching for at in pair):
            # only the idlers move
            axes = equal_pitch(plan.movement, axes, touching, teeth, own)
    return axes


# ----------------------------------------------------------------------------------------------------- places for gears


@dataclass(frozen=True, eq=False)
class PolyhedronPlaces:
    """All gears of an arrangement on a solid, including gears that are omitted later."""

    axes: Floats
    """Unit vectors of the axes, shape (gears, 3)."""
    letters: tuple[str, ...]
    """Class of each gear: the number of sides of its face, v for a vertex, or e for an edge."""
    meshes: tuple[tuple[int, int], ...]
    """Pairs of meshing gears, by index."""
    movement: SymmetricFreedom
    """Symmetries of the solid as permutations of the gears."""


def places_on_polyhedron(base: Polyhedron, gears: str) -> PolyhedronPlaces:
    """Return the positions for an arrangement of gears on a solid; raise `GearTrainError` if it is impossible."""
    if gears not in get_args(Gears):
        why = "an arrangement names the parts of a solid that carry gears"
        raise QuestionError(Problem(f"unknown arrangement '{gears}'", why, suggest(gears, get_args(Gears))))
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
    return _two_per_edge(base, faces, vertices)


def _two_per_edge(
    base: Polyhedron, faces: tuple[Floats, list[str]], vertices: tuple[Floats, list[str]]
) -> PolyhedronPlaces:
    """Return the positions for gears on vertices and faces, and for two gears on each edge, one near each end."""
    middles = _between(vertices[0], base.edges)
    # one orbit each means that the solid is Platonic
    if any(base.orbits(points).any() for points in (faces[0], vertices[0], middles)):
        what = f"the {base.name or 'solid'} cannot have two gears on each edge"
        why = "that arrangement requires that all faces, all vertices and all edges are equivalent by symmetry"
        raise GearTrainError(Problem(what, why, "use one of the five Platonic solids, or gears='faces+edges'"))
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
    """Return the midpoints of the arcs between pairs of points, as unit vectors."""
    sums = points[np.array(pairs)].sum(axis=1)
    middles: Floats = sums / np.linalg.norm(sums, axis=1)[:, None]
    return middles


def _joined(
    base: Polyhedron, blocks: list[tuple[Floats, list[str]]], meshes: Iterable[tuple[int, int]]
) -> PolyhedronPlaces:
    images, start = [], 0
    for points, _ in blocks:
        images.append(start + base.permutations(points))
        start += len(points)
    return PolyhedronPlaces(
        axes=np.concatenate([points for points, _ in blocks]),
        letters=tuple(letter for _, letters in blocks for letter in letters),
        meshes=tuple(meshes),
        movement=SymmetricFreedom(base.symmetries, np.concatenate(images, axis=1)),
    )


TeethByKind = Mapping[str, int] | Mapping[int, int] | int


def kinds_of(layout: PolyhedronPlaces) -> list[str]:
    """Return the kind of each gear: its entry in `layout.letters`, with a letter if several orbits have this entry."""
    orbits = layout.movement.orbits().tolist()
    size = {orbit: orbits.count(orbit) for orbit in set(orbits)}
    rank = np.argsort(from_the_top(layout.axes))
    # names must not depend on the order of the vertices
    smallest = min(size, key=lambda orbit: (size[orbit], rank[orbit]))
    # orbits of equal size are distinguished by their distance from the smallest
    steps = _steps(layout, [at for at, orbit in enumerate(orbits) if orbit == smallest])
    alike = defaultdict(list)
    for orbit in sorted(size, key=lambda orbit: (size[orbit], steps[orbit], rank[orbit])):
        alike[layout.letters[orbit]].append(orbit)
    names = {}
    for letter, group in alike.items():
        for at, orbit in enumerate(group):
            names[orbit] = letter + (_letters(at) if len(group) > 1 else "")
    return [names[orbit] for orbit in orbits]


def _letters(at: int) -> str:
    """Return the letters for an index: a to z, followed by aa to zz."""
    ahead, last = divmod(at, 26)
    return (_letters(ahead - 1) if ahead else "") + ascii_lowercase[last]


def _steps(layout: PolyhedronPlaces, start: Iterable[int]) -> dict[int, int]:
    """Return for each gear the minimum number of meshes from a gear in `start`, by breadth-first search."""
    mates = defaultdict(list)
    for i, j in layout.meshes:
        mates[i].append(j)
        mates[j].append(i)
    steps = dict.fromkeys(start, 0)
    queue = list(steps)
    for gear in queue:
        fresh = [mate for mate in mates[gear] if mate not in steps]
        steps.update(dict.fromkeys(fresh, steps[gear] + 1))
        queue += fresh
    return steps


def in_order(layout: PolyhedronPlaces, kinds: Sequence[str]) -> list[int]:
    """Return the indices of the gears in order: gears on larger faces first, then on vertices, then on edges."""
    rank = np.argsort(from_the_top(layout.axes))

    def key(at: int) -> tuple[int, int, int, str, int]:
        letter = layout.letters[at]
        sides = -int(letter) if letter.isdigit() else _AFTER_FACES.index(letter)
        return (sides >= 0, sides, len(kinds[at]), kinds[at], int(rank[at]))

    return sorted(range(len(kinds)), key=key)


def teeth_of(teeth: TeethByKind | None, kinds: Sequence[str]) -> dict[str, int]:
    """Return the tooth number of each kind. In `teeth`, a key such as 4 refers to all kinds such as 4a and 4b."""
    known = list(dict.fromkeys(kinds))
    given = {str(kind): count for kind, count in teeth.items()} if isinstance(teeth, Mapping) else {}
    if teeth is not None and not isinstance(teeth, Mapping):
        given = dict.fromkeys(known, teeth)
    for kind, count in given.items():
        if not _matching_kinds(kind, known):
            raise _unknown("kind of gear", kind, known)
        if isinstance(count, bool) or not isinstance(count, int | np.integer) or count < 1:
            what = f"{count} is not a valid tooth count for gears of kind '{kind}'"
            raise QuestionError(
                Problem(what, "tooth counts are integers of 1 or more", "give a tooth count such as 20")
            )
    wide = {kind: int(given[name]) for name in given for kind in _matching_kinds(name, known)}
    # a full name such as 4a takes precedence over a number of sides
    return wide | {kind: int(given[kind]) for kind in known if kind in given}


def _matching_kinds(word: str, kinds: Iterable[str]) -> list[str]:
    """Return a list with the kind of the given name. If there is none, return all kinds with this name and a further
    letter, such as 4a and 4b for 4.
    """
    known = list(dict.fromkeys(kinds))
    return [word] if word in known else [kind for kind in known if letter_of(kind) == word]


def letter_of(kind: str) -> str:
    """Return the name of a kind without its additional letter: 4 for 4b, e for ea."""
    return kind.rstrip(ascii_lowercase) or kind[0]


def without_gears(
    names: Sequence[str], kinds: Sequence[str], meshes: Iterable[tuple[int, int]], drop: Iterable[str]
) -> tuple[set[int], list[tuple[int, int]]]:
    """Return the gears and meshes that remain after the gears, kinds and meshes in `drop` are removed."""
    gone: set[int] = set()
    left = list(meshes)
    for word in map(str, drop):
        first, mesh, second = word.partition("~")
        sets = [_matching_gears(side, names, kinds) for side in ((first, second) if mesh else (first,))]
        if not mesh:
            gone |= sets[0]
            continue
        a, b = sets
        rest = [(i, j) for i, j in left if not ((i in a and j in b) or (j in a and i in b))]
        if len(rest) == len(left):
            why = f"{first} and {second} do not mesh"
            fix = "give the names of two gears that mesh"
            fix += f", such as '{names[left[0][0]]}~{names[left[0][1]]}'" if left else ""
            raise QuestionError(Problem(f"unknown mesh '{word}'", why, fix))
        left = rest
    kept = set(range(len(names))) - gone
    return kept, [(i, j) for i, j in left if i in kept and j in kept]


def _matching_gears(word: str, names: Sequence[str], kinds: Sequence[str]) -> set[int]:
    meant = _matching_kinds(word, kinds)
    found = {at for at, (name, kind) in enumerate(zip(names, kinds, strict=True)) if name == word or kind in meant}
    if not found:
        raise _unknown("gear or kind", word, [*dict.fromkeys(kinds), *names])
    return found


def _unknown(what: str, word: str, known: Iterable[str]) -> GearTrainError:
    return QuestionError(
        Problem(f"unknown {what} '{word}'", "only names of this set of gears can be given", suggest(word, known))
    )


# ---------------------------------------------------------------------------------------------------- polyhedron survey


@dataclass(frozen=True)
class SurveyRow(Result):
    """Properties of a solid with gears on all faces, as in a row of the table in section 2 of docs/sphere.md."""

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
    """Name of the solid."""
    gears: int
    """Number of gears, one on each face."""
    meshes: int
    """Number of meshes, one on each edge."""
    bipartite: bool
    """True if the graph of the meshes is bipartite, so that all neighbours turn in opposite senses and the set has one
    degree of freedom.
    """
    gruebler: int
    """Degrees of freedom by Gruebler's count: number of gears minus number of meshes."""
    drop: int
    """Minimum number of meshes that must be removed so that the set can turn."""
    types: int
    """Number of kinds of gear, which are orbits under the symmetries of the solid."""
    mesh_kinds: int
    """Number of kinds of mesh, which are orbits under the symmetries of the solid."""
    positions: int
    """Number of free parameters of the axes if the set keeps all symmetries of the solid."""
    angles: tuple[float, ...]
    """Distinct angles between the axes of meshing gears [deg], in ascending order. Angles that differ by less than 1e-9
    deg are regarded as equal.
    """

    @property
    def exact(self) -> bool:
        """True if equal pitches may be possible, because there are at least as many unknowns (positions and the pitch)
        as kinds of mesh.
        """
        return self.positions + 1 >= self.mesh_kinds


def survey(solids: Iterable[str | Polyhedron] = SURVEYED) -> tuple[SurveyRow, ...]:
    """Return the mobility, the number of meshes to remove, and whether equal pitches are possible, for each solid with
    gears on all faces.

    Parameters
    ----------
    solids : iterable of str or Polyhedron
        Solids of the survey; by default the Platonic and Archimedean solids, and J37.

    Returns
    -------
    tuple of SurveyRow
        One row for each solid.

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
    release = GearSphere(configuration).train.kinematics.gridlock.release
    angles = sorted(np.degrees([configuration.angle(i, j) for i, j in configuration.meshes]))
    return SurveyRow(
        solid=base.name,
        gears=len(base.faces),
        meshes=len(base.edges),
        # the faces of a map are two-colourable if every vertex has an even degree
        bipartite=not any(degree % 2 for degree in base.degrees),
        gruebler=len(base.faces) - len(base.edges),
        drop=0 if release is None else len(release.meshes),
        types=len(types),
        mesh_kinds=len(np.unique(plan.movement.mesh_orbits(plan.meshes))),
        positions=sum(len(plan.movement.freedom(gear, plan.axes[gear])) for gear in types),
        angles=tuple(float(a) for at, a in enumerate(angles) if at == 0 or a - angles[at - 1] > 1e-9),
    )
