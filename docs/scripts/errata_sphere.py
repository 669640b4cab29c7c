"""The errata of the anonymous note on spherical configurations of gears, recomputed: part of docs/errata.md."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from math import asin, atan, atan2, cos, degrees, radians, sin

import numpy as np
from sources.sphere import NOTE, gears

from geartrain.spherical import Configuration, GearSphere, from_polyhedron, ratio_windows, size_gears

PRINTED_BETA = 41.8103148828  # deg
IDLERS = {"5": 60, "3": 36, "e": 24}


def sphere() -> Iterator[str]:
    """The section of the page."""
    yield from ("## The note on spherical configurations of rounded gears", "")
    yield "An anonymous derivation of gears on the faces of the icosidodecahedron. Theory: [Gears on a"
    yield "sphere](sphere.md)."
    yield ""
    yield "| # | the note | what is so |"
    yield "|---|---|---|"
    for number, (printed, right) in enumerate(claims(), 1):
        yield f"| {number} | {printed} | {right} |"
    yield ""


def claims() -> Iterator[tuple[str, str]]:
    """What the note says, and what is so, each computed."""
    yield from positions()
    yield from radii()
    yield from teeth()
    yield from kinds()


def positions() -> Iterator[tuple[str, str]]:
    """How many gears there are, and the angles between them."""
    faces, vertices = gears(), from_polyhedron(NOTE, "vertices")
    fives, threes = (faces.kinds.count(kind) for kind in ("5", "3"))
    yield (
        "30 gears",
        f"{len(faces.kinds)} faces, {fives} and {threes}, with {len(faces.meshes)} meshes; {len(vertices.kinds)} is "
        "the number of vertices, which are the loops of four",
    )
    wrong, right = 2 * asin(sin(radians(18)) / cos(radians(36))), 2 * atan(sin(radians(18)) / cos(radians(36)))
    beta = minimum_angle(faces, "3")
    assert abs(beta - right) < 1e-12 > abs(beta - asin(2 / 3))
    yield (
        f"the angle between triangles by an arcsine of the wrong side, {degrees(wrong):.7f}°",
        f"{degrees(beta):.13f}° = asin(2/3); the note corrects itself, and leaves the first text standing",
    )
    yield (
        f"the corrected angle, {PRINTED_BETA}°",
        f"{degrees(right) - PRINTED_BETA:.1e}° less than its own formula gives: wrong from the eighth decimal",
    )
    (window,) = ratio_windows(faces)
    yield (
        "it is an angle between neighbours",
        "triangles meet in vertices only and do not mesh; it bounds their cone: "
        f"{window.low:.9f} < z5/z3 < {window.high:.9f}",
    )


def minimum_angle(faces: Configuration, kind: str) -> float:
    """The least angle (rad) between two gears of a kind."""
    axes = np.asarray(faces.axes)[[at for at, each in enumerate(faces.kinds) if each == kind]]
    cosines = axes @ axes.T
    return float(np.arccos(cosines[~np.eye(len(axes), dtype=bool)].max()))


def radii() -> Iterator[tuple[str, str]]:
    """Where wheels meet, how they are sized, and their pitch."""
    faces = gears()
    between = faces.angle(*(faces.meshes[0]))
    cone = degrees(float(size_gears(faces).cones[0, 0]))
    edge = middle_of_an_edge(faces)
    meets = sin(edge) / sin(between - edge)
    yield (
        "wheels meet at the middles of edges",
        f"with 5 to 3 the pitch point lies {cone:.3f}° from the pentagon's axis, the middle of the edge "
        f"{degrees(edge):.3f}°; only the irrational ratio {meets:.14f} meets there",
    )
    closed = degrees(atan2(sin(between), 3 / 5 + cos(between)))
    yield "adjust with a solver", f"the closed form (1) of the page on spheres gives {closed:.8f}°, as the solver did"
    number = 8
    yield (
        f"a diametral pitch N/R of {number}",
        f"that is N/R; the diametral pitch N/(2R) is {number / 2:g}, and the tooth numbers it implies, "
        f"{number * 1.25:g} and {number * 0.75:g}, are not stated",
    )


def middle_of_an_edge(faces: Configuration) -> float:
    """Angle (rad) from a pentagon's axis to the middle of the edge that it shares with a triangle."""
    five, three = sorted(faces.meshes[0], key=lambda at: faces.kinds[at], reverse=True)
    kinks = np.asarray(from_polyhedron(NOTE, "vertices").axes)
    ends = np.argsort(-(kinks @ (np.asarray(faces.axes)[five] + np.asarray(faces.axes)[three])))[:2]
    middle = kinks[ends].sum(axis=0)
    return float(np.arccos(middle @ np.asarray(faces.axes)[five] / np.linalg.norm(middle)))


def teeth() -> Iterator[tuple[str, str]]:
    """Which tooth numbers close and fit."""
    rules = {name: GearSphere(from_polyhedron(name, "faces")).rule for name in (NOTE, "cuboctahedron", "octahedron")}
    yield (
        "multiples of 5 and 3, because of the number of neighbours",
        f"the right condition here ({rules[NOTE]}), for another reason: on the cuboctahedron, whose squares have four "
        f"neighbours, it is: {rules['cuboctahedron']}; on the octahedron: {rules['octahedron']}",
    )
    first, second, third = (gears(*numbers) for numbers in ((5, 6), (10, 3), (10, 6)))
    closes = [bool(GearSphere(each).closure) for each in (first, second, third)]
    assert closes == [True] * 3
    undercut = " and ".join(size_gears(third).undercut)
    yield (
        "5/6 and 10/3 teeth as alternatives",
        f"both close, and both collide: tips of equal neighbours overlap by {overlap(first):.1f}° and "
        f"{overlap(second):.1f}°; 10/6 closes and {'fits' if not size_gears(third).collisions else 'collides'}, but "
        f"both kinds, {undercut}, are undercut",
    )
    ways = senses(gears())
    yield "half of the gears turn clockwise", f"in each loop; of the set, {min(ways)} against {max(ways)}"


def overlap(faces: Configuration) -> float:
    """How far tips run into each other (deg of the sphere), the worst."""
    found = size_gears(faces)
    return max(degrees(each.short * found.module) for each in found.collisions)


def senses(faces: Configuration) -> tuple[int, int]:
    """How many gears turn each way: two colours along the meshes."""
    way = {0: 0}
    queue = deque(way)
    while queue:
        at = queue.popleft()
        for mesh in faces.meshes:
            if at in mesh:
                other = mesh[0] + mesh[1] - at
                if other not in way:
                    way[other] = 1 - way[at]
                    queue.append(other)
    return list(way.values()).count(0), list(way.values()).count(1)


def kinds() -> Iterator[tuple[str, str]]:
    """The name of the solid, and more than two kinds of gears."""
    ball = "truncated icosahedron"
    moves = GearSphere(from_polyhedron(ball, "faces")).moves
    yield "it is called a buckyball", f"that is the {ball}, which {'turns' if moves else 'is locked'}"
    three = size_gears(from_polyhedron("rhombicosidodecahedron", "faces", teeth={"5": 25, "4": 14, "3": 12}))
    idle = size_gears(from_polyhedron(NOTE, "faces+edges", teeth=IDLERS))
    assert idle.exact
    yield (
        "more than two types are very difficult or impossible",
        f"impossible with one pitch on fixed axes; easy in practice, 25/14/12 on the rhombicosidodecahedron misses by "
        f"{100 * abs(three.mismatch):.3f} %; and exact with idlers on edges, such as "
        f"{'/'.join(str(each) for each in IDLERS.values())} (kinds {', '.join(IDLERS)})",
    )
