"""The places for gears on a polyhedron: axes, meshes, how symmetries exchange them, and the names a caller may give
them.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from string import ascii_lowercase
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from geartrain.errors import GearTrainError, Problem, QuestionError, suggest
from geartrain.spherical.polyhedra import Polyhedron, from_the_top
from geartrain.spherical.symmetric_displacement import SymmetricFreedom

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


Gears = Literal["faces", "vertices", "faces+vertices", "faces+edges", "faces+vertices+edges"]


@dataclass(frozen=True, eq=False)
class PolyhedronPlaces:
    """All gears a solid gives a place to, before any is left out.

    axes      unit vectors, (gears, 3)
    letters   of each gear: the number of sides of its face, v for a vertex, e for an edge
    meshes    pairs of gears by index
    movement  the symmetries of the solid, acting on the gears
    """

    axes: Floats
    letters: tuple[str, ...]
    meshes: tuple[tuple[int, int], ...]
    movement: SymmetricFreedom


def places_on_polyhedron(base: Polyhedron, gears: str) -> PolyhedronPlaces:
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


def _two_an_edge(
    base: Polyhedron, faces: tuple[Floats, list[str]], vertices: tuple[Floats, list[str]]
) -> PolyhedronPlaces:
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
_AFTER_FACES = ("v", "e")


def kinds_of(layout: PolyhedronPlaces) -> list[str]:
    """The kind of each gear: its orbit, named by its letter, and by a second one where orbits share the first."""
    orbits = layout.movement.orbits().tolist()
    size = {orbit: orbits.count(orbit) for orbit in set(orbits)}
    rank = np.argsort(from_the_top(layout.axes))
    smallest = min(size, key=lambda orbit: (size[orbit], rank[orbit]))
    steps = _steps(layout, [at for at, orbit in enumerate(orbits) if orbit == smallest])
    alike = defaultdict(list)
    for orbit in sorted(size, key=lambda orbit: (size[orbit], steps[orbit], rank[orbit])):
        alike[layout.letters[orbit]].append(orbit)
    names = {}
    for letter, group in alike.items():
        for at, orbit in enumerate(group):
            names[orbit] = letter + (_lettered(at) if len(group) > 1 else "")
    return [names[orbit] for orbit in orbits]


def _lettered(at: int) -> str:
    """a to z, then aa to zz."""
    ahead, last = divmod(at, 26)
    return (_lettered(ahead - 1) if ahead else "") + ascii_lowercase[last]


def _steps(layout: PolyhedronPlaces, start: Iterable[int]) -> dict[int, int]:
    """Least number of meshes from the nearest gear of `start` to each gear."""
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
    """The gears in the order of the configuration: larger faces first, then vertices, then edges."""
    rank = np.argsort(from_the_top(layout.axes))

    def key(at: int) -> tuple[int, int, int, str, int]:
        letter = layout.letters[at]
        sides = -int(letter) if letter.isdigit() else _AFTER_FACES.index(letter)
        return (sides >= 0, sides, len(kinds[at]), kinds[at], int(rank[at]))

    return sorted(range(len(kinds)), key=key)


def names_of(layout: PolyhedronPlaces, kinds: Sequence[str]) -> list[str]:
    """Each gear's kind with its number in it."""
    names, count = [""] * len(kinds), dict.fromkeys(kinds, 0)
    for at in in_order(layout, kinds):
        count[kinds[at]] += 1
        names[at] = f"{kinds[at]}-{count[kinds[at]]}"
    return names


def teeth_of(teeth: TeethByKind | None, kinds: Sequence[str]) -> dict[str, int]:
    """Tooth number of each kind; a number of sides stands for all kinds that share it."""
    known = list(dict.fromkeys(kinds))
    given = {str(kind): count for kind, count in teeth.items()} if isinstance(teeth, Mapping) else {}
    if teeth is not None and not isinstance(teeth, Mapping):
        given = dict.fromkeys(known, teeth)
    for kind, count in given.items():
        if not _meant(kind, known):
            raise _unknown("kind of gear", kind, known)
        if isinstance(count, bool) or not isinstance(count, int | np.integer) or count < 1:
            raise QuestionError(
                Problem(f"{count} is no tooth number of kind '{kind}'", "it is a whole number from 1", "correct it")
            )
    wide = {kind: int(given[name]) for name in given for kind in _meant(name, known)}
    return wide | {kind: int(given[kind]) for kind in known if kind in given}


def _meant(word: str, kinds: Iterable[str]) -> list[str]:
    """The kinds a word stands for: the one of that name, else all that only add letters to it."""
    known = list(dict.fromkeys(kinds))
    return [word] if word in known else [kind for kind in known if letter_of(kind) == word]


def letter_of(kind: str) -> str:
    """A kind without the letter that tells it from others of its sort: 4 of 4b, e of ea."""
    return kind.rstrip(ascii_lowercase) or kind[0]


def without_gears(
    names: Sequence[str], kinds: Sequence[str], meshes: Iterable[tuple[int, int]], drop: Iterable[str]
) -> tuple[set[int], list[tuple[int, int]]]:
    """The gears and meshes that stay."""
    gone: set[int] = set()
    left = list(meshes)
    for word in map(str, drop):
        first, mesh, second = word.partition("~")
        sets = [_found(side, names, kinds) for side in ((first, second) if mesh else (first,))]
        if not mesh:
            gone |= sets[0]
            continue
        a, b = sets
        rest = [(i, j) for i, j in left if not ((i in a and j in b) or (j in a and i in b))]
        if len(rest) == len(left):
            raise QuestionError(
                Problem(f"no mesh '{word}' to drop", f"{first} and {second} do not mesh", "name two that mesh")
            )
        left = rest
    kept = set(range(len(names))) - gone
    return kept, [(i, j) for i, j in left if i in kept and j in kept]


def _found(word: str, names: Sequence[str], kinds: Sequence[str]) -> set[int]:
    """The gears that a name of a gear or kind stands for."""
    meant = _meant(word, kinds)
    found = {at for at, (name, kind) in enumerate(zip(names, kinds, strict=True)) if name == word or kind in meant}
    if not found:
        raise _unknown("gear or kind", word, [*dict.fromkeys(kinds), *names])
    return found


def _unknown(what: str, word: str, known: Iterable[str]) -> GearTrainError:
    return QuestionError(Problem(f"there is no {what} '{word}'", "it is not part of this set", suggest(word, known)))
