"""Gears on a polyhedron: on its faces, its vertices, both, or with idlers on its edges."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
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
