"""Solids by name: Platonic, Archimedean and Catalan, prisms, antiprisms and their duals, and J37.

The uniform solids come from mirrors (Wythoff): a point at distance 0 or 1 from each of three mirrors, and its images.
"""

from __future__ import annotations

import re
from functools import cache
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem, suggest
from geartrain.spherical.polyhedra import Polyhedron, from_the_top, polyhedron

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


PHI = (1 + 5**0.5) / 2
MOST_SIDES = 360
"""Prisms and the like have at most so many sides: their faces must stay apart."""

# the mirrors of [p, 3]: the angle of the first two is pi/p, of the last two pi/3, of the others pi/2
_MIRRORS = {
    3: ([1, -1, 0], [0, 1, -1], [-1, -1, 0]),
    4: ([0, 0, 1], [0, 1, -1], [1, -1, 0]),
    5: ([1, 0, 0], [-PHI, -1, PHI - 1], [0, 1, 0]),
}
# p of the mirrors, and the distances from them
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
# the last two are how model makers name the solids with such faces
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


def solid_names() -> tuple[str, ...]:
    """The names that `solid` knows; n stands for a number of sides.

    Returns
    -------
    tuple of str
        Uniform solids, their duals, J37, and families.

    Examples
    --------
    >>> solid_names()[:3], solid_names()[-1]
    (('tetrahedron', 'cube', 'octahedron'), 'n-trapezohedron')
    """
    return (*_UNIFORM, *_DUALS, "J37", *(f"n-{family}" for family in _FAMILIES))


@cache
def solid(name: str) -> Polyhedron:
    """A solid by name: the uniform ones by Wythoff's construction, their duals, prisms and antiprisms, and J37.

    Coordinates are right to about 1e-15 of the size; uniform solids have edges of length 2.

    Parameters
    ----------
    name : str
        Such as `icosidodecahedron`, `6-antiprism`, `hexagonal prism`, `J37` or `buckyball`.

    Returns
    -------
    Polyhedron
        Shared by all who ask for it; its arrays cannot be written to.

    Raises
    ------
    GearTrainError
        If no solid has this name, or a prism too few or too many sides (3 to 360).

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
        return _of_sides(int(_SIDES.get(family[1], family[1])), family[2])
    if key in _UNIFORM:
        points = _wythoff(*_UNIFORM[key])
    elif key == "j37":
        key, points = "J37", _turned_cupola()
    else:
        raise _unknown(name)
    return polyhedron(points[from_the_top(points)], name=key)


def _unknown(name: str) -> GearTrainError:
    known = [*_UNIFORM, *_DUALS, *_ALIASES, *(f"{n}-{family}" for n in range(3, 13) for family in _FAMILIES)]
    fix = suggest(name.lower(), known)
    if not fix.startswith("did"):
        fix = f"use a name such as 'icosidodecahedron' or '6-antiprism', one of: {', '.join(solid_names())}"
    return GearTrainError(Problem(f"there is no solid '{name}'", "no known polyhedron has this name", fix))


def _wythoff(p: int, distances: tuple[int, ...]) -> Floats:
    """Images of the point at these distances from the mirrors of [p, 3]; of a snub's under rotations only."""
    mirrors = np.array(_MIRRORS[p], dtype=np.float64)
    mirrors /= np.linalg.norm(mirrors, axis=1)[:, None]
    group = _group(p)
    if not distances:
        group = group[np.linalg.det(group) > 0]
    point = np.linalg.solve(mirrors, np.array(distances or _snub(p), dtype=np.float64))
    images = group @ point
    _, first = np.unique(np.round(images, 6) + 0.0, axis=0, return_index=True)
    found: Floats = images[first]
    return found


@cache
def _group(p: int) -> Floats:
    """All products of the mirrors of [p, 3], (24, 48 or 120, 3, 3), each entry right to the last digit."""
    entries = np.array([sign * x for x in (0, 0.5, 1, PHI / 2, (PHI - 1) / 2) for sign in (1, -1)])
    mirrors = np.array(_MIRRORS[p], dtype=np.float64)
    reflections = [np.eye(3) - 2 * np.outer(m, m) / (m @ m) for m in mirrors]
    found, fresh = {}, [np.eye(3)]
    while fresh:
        # products gather rounding, but the possible entries are known; + 0.0 makes 0.0 of -0.0, for bytes to agree
        near = np.abs(fresh.pop()[..., None] - entries).argmin(axis=-1)
        matrix = entries[near] + 0.0
        if matrix.tobytes() not in found:
            found[matrix.tobytes()] = matrix
            fresh += [mirror @ matrix for mirror in reflections]
    return np.array(list(found.values()))


def _snub(p: int) -> Floats:
    """Distances (a, b, c) of a snub's point from the mirrors of [p, 3], for edges of length 2.

    The turn by two mirrors at an angle g moves a point at distances a and b by 2 sqrt(a^2 + b^2 + 2 a b cos g); all
    three turns move it equally far. Newton's method on the two differences, with a^2 + c^2 = 1.
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


def _of_sides(n: int, family: str) -> Polyhedron:
    """The uniform prism or antiprism with n-gons of edge 2 as caps, or its dual."""
    if not 3 <= n <= MOST_SIDES:
        raise GearTrainError(
            Problem(
                f"there is no solid '{n}-{family}' here",
                f"the number of sides is 3 to {MOST_SIDES}",
                f"name a number between, such as '6-{family}'",
            )
        )
    dual = {"bipyramid": "prism", "trapezohedron": "antiprism"}.get(family)
    if dual:
        return _of_sides(n, dual).dual(f"{n}-{family}")
    around, half = 1 / np.sin(np.pi / n), 0.5 * (family == "antiprism")
    # between the caps of an antiprism a side spans 2 along, and half an edge's turn across
    height = 1.0 if not half else np.sqrt(1 - (around * np.sin(np.pi / (2 * n))) ** 2)
    caps = []
    for z, shift in ((height, 0.0), (-height, half)):
        turn = 2 * np.pi * (np.arange(n) + shift) / n
        caps.append(np.stack([around * np.cos(turn), around * np.sin(turn), np.full(n, z)], axis=1))
    return polyhedron(np.concatenate(caps), name=f"{n}-{family}")


def _turned_cupola() -> Floats:
    """The rhombicuboctahedron with its lower third turned by an eighth of a turn: J37, not uniform."""
    long, short = 1 + 2**0.5, 2**0.5
    middle = [[*p, z] for z in (1, -1) for s, t in product((1, -1), repeat=2) for p in ((s * long, t), (s, t * long))]
    top = [[s, t, long] for s, t in product((1, -1), repeat=2)]
    return np.array(top + middle + [[short, 0, -long], [-short, 0, -long], [0, short, -long], [0, -short, -long]])
