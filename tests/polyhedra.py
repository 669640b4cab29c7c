"""Polyhedra as maps, by Conway's operators: faces as vertex cycles, all turned the same way round. No coordinates."""

from __future__ import annotations

from collections.abc import Callable, Hashable

Face = tuple[Hashable, ...]
Map = list[Face]


def steps(face: Face) -> list[tuple[Hashable, Hashable]]:
    """The directed edges round a face."""
    return list(zip(face, (*face[1:], face[0]), strict=True))


def sides(solid: Map) -> dict[tuple[Hashable, Hashable], int]:
    """The face on the left of each directed edge."""
    return {step: at for at, face in enumerate(solid) for step in steps(face)}


def neighbours(solid: Map) -> list[tuple[int, int]]:
    """Pairs of faces that share an edge: the meshes of gears on all faces."""
    left = sides(solid)
    return sorted((at, left[b, a]) for (a, b), at in left.items() if at < left[b, a])


def dual(solid: Map) -> Map:
    """Faces for vertices."""
    left = sides(solid)
    found: Map = []
    for vertex in dict.fromkeys(vertex for face in solid for vertex in face):
        start = next(step for step in left if step[0] == vertex)
        ring, step = [], start
        while not ring or step != start:
            face = left[step]
            ring.append(face)
            before = next(a for a, b in steps(solid[face]) if b == vertex)
            step = (vertex, before)
        found.append(tuple(ring))
    return found


def ambo(solid: Map) -> Map:
    """Cut to the middles of the edges."""
    return [tuple(frozenset(step) for step in steps(face)) for face in solid] + [
        _ring(solid, vertex) for vertex in dict.fromkeys(vertex for face in solid for vertex in face)
    ]


def _ring(solid: Map, vertex: Hashable) -> Face:
    """The edges round a vertex, turned as faces are."""
    left = sides(solid)
    start = next(step for step in left if step[0] == vertex)
    ring, step = [], start
    while not ring or step != start:
        ring.append(frozenset(step))
        step = (vertex, next(a for a, b in steps(solid[left[step]]) if b == vertex))
    return tuple(ring)


def kis(solid: Map) -> Map:
    """A pyramid on every face."""
    return [(a, b, ("top", at)) for at, face in enumerate(solid) for a, b in steps(face)]


def gyro(solid: Map) -> Map:
    """Every face cut into pentagons, one a corner."""
    found: Map = []
    for at, face in enumerate(solid):
        ring = steps(face)
        for (a, b), (_, c) in zip(ring, [*ring[1:], ring[0]], strict=True):
            found.append((("top", at), (a, b, 1), (b, a, 1), ("was", b), (b, c, 1)))
    return found


def truncated(solid: Map) -> Map:
    """Every vertex cut off."""
    return dual(kis(dual(solid)))


def snub(solid: Map) -> Map:
    """Faces and vertices twisted apart by triangles."""
    return dual(gyro(dual(solid)))


def prism(n: int) -> Map:
    """Two faces of n sides, and n squares."""
    sides_ = [((0, at), (0, (at + 1) % n), (1, (at + 1) % n), (1, at)) for at in range(n)]
    return [tuple((0, at) for at in reversed(range(n))), tuple((1, at) for at in range(n)), *sides_]


def antiprism(n: int) -> Map:
    """Two faces of n sides, and 2n triangles."""
    up = [((0, at), (0, (at + 1) % n), (1, at)) for at in range(n)]
    down = [((1, at), (0, (at + 1) % n), (1, (at + 1) % n)) for at in range(n)]
    return [tuple((0, at) for at in reversed(range(n))), tuple((1, at) for at in range(n)), *up, *down]


TETRAHEDRON: Map = [(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)]
CUBE = prism(4)
OCTAHEDRON = antiprism(3)
ICOSAHEDRON: Map = [
    *[("n", ("u", at), ("u", (at + 1) % 5)) for at in range(5)],
    *[("s", ("d", (at + 1) % 5), ("d", at)) for at in range(5)],
    *[(("u", (at + 1) % 5), ("u", at), ("d", at)) for at in range(5)],
    *[(("d", at), ("d", (at + 1) % 5), ("u", (at + 1) % 5)) for at in range(5)],
]
DODECAHEDRON = dual(ICOSAHEDRON)

ARCHIMEDEAN: dict[str, Callable[[], Map]] = {
    "truncated tetrahedron": lambda: truncated(TETRAHEDRON),
    "cuboctahedron": lambda: ambo(CUBE),
    "truncated cube": lambda: truncated(CUBE),
    "truncated octahedron": lambda: truncated(OCTAHEDRON),
    "rhombicuboctahedron": lambda: ambo(ambo(CUBE)),
    "truncated cuboctahedron": lambda: truncated(ambo(CUBE)),
    "snub cube": lambda: snub(CUBE),
    "icosidodecahedron": lambda: ambo(ICOSAHEDRON),
    "truncated dodecahedron": lambda: truncated(DODECAHEDRON),
    "truncated icosahedron": lambda: truncated(ICOSAHEDRON),
    "rhombicosidodecahedron": lambda: ambo(ambo(ICOSAHEDRON)),
    "truncated icosidodecahedron": lambda: truncated(ambo(ICOSAHEDRON)),
    "snub dodecahedron": lambda: snub(DODECAHEDRON),
}
