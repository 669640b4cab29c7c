"""The anonymous note on spherical configurations of rounded gears: every formula, number and claim."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from math import asin, atan, cos, degrees, radians, sin, sqrt, tan
from typing import Literal

import numpy as np

import geartrain
from geartrain.numerics.arrays import Floats
from geartrain.spherical import Configuration, GearSphere, from_polyhedron, ratio_windows, size_gears, survey
from sources.row import Digits, Exactly, Finding, Row, Source, Statements, outside
from sources.ways import Command

NOTE = "icosidodecahedron"
SIZED = "sphere icosidodecahedron --teeth 5=20,3=12 --radius 5=1.25"
PICTURE = "the copy has no pictures; "


_OWN = Statements(globals())
words, equation, digits, exact = _OWN.words, _OWN.equation, _OWN.digits, _OWN.exact


def number(place: str, claim: str, printed: str, path: str, erratum: str = "", why: str = "") -> Row:
    """A printed number that the command gives."""
    return Row(place, claim, printed, Command(SIZED, path), Digits(), erratum, why)


@lru_cache(maxsize=8)
def gears(five: int = 20, three: int = 12) -> Configuration:
    """The gears of the note, on the faces of its solid."""
    return from_polyhedron(NOTE, "faces", teeth={"5": five, "3": three})


# ------------------------------------------------------------------------------------------- steps 1 and 2: the solid


def closed_loop(count: int) -> Finding:
    """Whether a loop of equal wheels turns, each meshing with the next."""
    wheels = range(count)
    links = ", ".join(f"g{at}: {{wheels: {{w{at}: 20}}}}" for at in wheels)
    joints = ", ".join(f"{{pair: [frame, g{at}], axis: a{at}}}" for at in wheels)
    pairs = ", ".join(f"{{pair: [w{at}, w{(at + 1) % count}]}}" for at in wheels)
    train = geartrain.load(
        f"links: {{frame: {{}}, {links}}}\nrevolutes: [{joints}]\ngears: [{pairs}]\ninputs: {{g0: 1}}\n"
    )
    kind = train.solve().verdict.kind
    return Finding((kind == "determined") is (count % 2 == 0), f"a loop of {count}: {kind}")


def loops() -> Finding:
    """Degrees of freedom, and how the wheels of each loop turn."""
    found = GearSphere(gears())
    solved = found.train.solve()
    halves = set()
    for loop in found.closure.loops if found.closure else ():
        turns = [solved[gear] > 0 for gear in loop.gears]
        halves.add((turns.count(True), turns.count(False)))
    return Finding(
        found.moves and all(one == two for one, two in halves),
        f"it turns; gears of a loop that turn clockwise and counter-clockwise: {_told(halves)}",
    )


def _told(halves: set[tuple[int, int]]) -> str:
    return ", ".join(f"{one} and {two}" for one, two in sorted(halves))


def kinds() -> Finding:
    """Kinds of meshes of the 5-3 and of the 5-4-3."""
    rows = {row.solid: row for row in survey()}
    simple, other = rows[NOTE].mesh_kinds, rows["rhombicosidodecahedron"].mesh_kinds
    return Finding(simple < other, f"{simple} kind of mesh instead of {other}")


@lru_cache(maxsize=2)
def axes(solid: str, of: Literal["faces", "vertices"]) -> Floats:
    """Unit vectors to the faces or vertices of a solid."""
    return np.asarray(from_polyhedron(solid, of).axes)


def same_lines() -> Finding:
    """Pentagons and triangles against faces and corners of the dodecahedron, by the angles within and between."""
    here = np.asarray(gears().axes)
    own = [here[[kind == name for kind in gears().kinds]] for name in ("5", "3")]
    other = [axes("dodecahedron", "faces"), axes("dodecahedron", "vertices")]
    worst = max(
        float(np.abs(np.sort((own[a] @ own[b].T).ravel()) - np.sort((other[a] @ other[b].T).ravel())).max())
        for a, b in ((0, 0), (0, 1), (1, 1))
    )
    return Finding(worst < 1e-12, "all 32 by 32 angles are equal to 1e-12")


# --------------------------------------------------------------------------------------------- step 3: the decagon


@lru_cache(maxsize=1)
def pentagon() -> tuple[float, float, float, float, float]:
    """Of a dodecahedron of circumradius 1: edge S, L between middles of adjacent edges, R_sph, r and D in a face."""
    kinks, faces = axes("dodecahedron", "vertices"), axes("dodecahedron", "faces")
    face = kinks[np.argsort(-(kinks @ faces[0]))[:5]]
    first = face[0]
    one, two = face[np.argsort(-(face @ first))[1:3]]
    middles = (first + one) / 2, (first + two) / 2
    centre = face.mean(axis=0)
    return (
        float(np.linalg.norm(first - one)),
        float(np.linalg.norm(middles[0] - middles[1])),
        float(np.linalg.norm(middles[0])),
        float(np.linalg.norm(middles[0] - centre)),
        float(np.linalg.norm(first - centre)),
    )


def off(one: float, other: float) -> float:
    """Relative difference."""
    return abs(one / other - 1)


S, L, R_SPH, R, D = pentagon()
DEG = radians(1.0)


def height() -> float:
    """H as printed, in terms of S."""
    return S / 2 * sqrt((cos(36 * DEG) / sin(18 * DEG)) ** 2 - (1 / tan(36 * DEG)) ** 2)


def decagon() -> Finding:
    """Middles of edges in a plane through the centre that holds one edge's neighbours on a face: ten, evenly spaced."""
    kinks = axes("dodecahedron", "vertices")
    pairs = np.argwhere(np.triu(kinks @ kinks.T > sqrt(5) / 3 - 1e-9, 1))
    middles = np.array([(kinks[a] + kinks[b]) / 2 for a, b in pairs])
    near = middles[np.argsort(np.linalg.norm(middles - middles[0], axis=1))]
    normal = np.cross(near[0], near[1])
    cut = middles[np.abs(middles @ normal) < 1e-9]
    other = np.cross(normal / np.linalg.norm(normal), cut[0])
    turns = np.degrees(np.arctan2(cut @ other, cut @ cut[0])) / 36
    even = sorted(np.round(turns, 9) % 10) == list(range(10))
    return Finding(len(cut) == 10 and even, f"{len(cut)} middles of edges, 36 degrees apart")


# -------------------------------------------------------------------------------------------------- steps 4 and 5


def wrong_beta() -> float:
    """The first text's formula."""
    return degrees(2 * asin(sin(18 * DEG) / cos(36 * DEG)))


def right_beta() -> float:
    """The least angle between two triangles (deg)."""
    threes = np.asarray(gears().axes)[[kind == "3" for kind in gears().kinds]]
    cosines = threes @ threes.T
    return degrees(float(np.arccos(cosines[~np.eye(len(threes), dtype=bool)].max())))


def triangles_mesh() -> Finding:
    """Meshes between two triangles."""
    pairs = [mesh for mesh in gears().meshes if gears().kinds[mesh[0]] == gears().kinds[mesh[1]] == "3"]
    return Finding(bool(pairs), f"{len(pairs)} of {len(gears().meshes)} meshes join two triangles")


def middle() -> Finding:
    """Where pitch circles of 5 to 3 touch, and where the middle of the edge lies."""
    cone = float(degrees(float(size_gears(gears()).cones[0, 0])))
    edge = degrees(atan(1 / 2))
    return Finding(
        abs(cone - edge) < 1e-6,
        f"they touch {cone:.3f} deg from the pentagon's axis; the middle of the edge is at {edge:.3f}",
    )


def sines(which: int) -> float:
    """R1 = R_sph sin a, R2 = R_sph sin(phi - a), R1/R2 = sin a / sin(phi - a), against the sizes of the library."""
    found = size_gears(gears())
    a, rest = (float(cone) for cone in found.cones[0])
    phi = gears().angle(*gears().meshes[0])
    radius = 20 * float(found.pitch) / sin(a)
    return (
        off(20 * float(found.pitch), radius * sin(a)),
        off(12 * float(found.pitch), radius * sin(phi - a)),
        max(off(20 / 12, sin(a) / sin(phi - a)), off(rest, phi - a)),
    )[which]


def rule() -> Finding:
    """The condition on teeth here, and where it is another than the number of neighbours."""
    here, cube = (GearSphere(from_polyhedron(name, "faces")).rule for name in (NOTE, "cuboctahedron"))
    return Finding(cube == "3 divides z3 and 4 divides z4", f"here {here}; for the cuboctahedron {cube}")


def fits(five: int, three: int) -> Finding:
    """Whether the teeth of a choice meet, and whether its wheels clear each other."""
    sphere, collisions = GearSphere(gears(five, three)), size_gears(gears(five, three)).collisions
    text = "tips collide" if collisions else "tips clear"
    return Finding(
        bool(sphere.closes) and not collisions, f"all loops {'close' if sphere.closes else 'do not close'}; {text}"
    )


def diametral() -> float:
    """The diametral pitch, teeth over diameter, of 10 teeth on a radius of 1.25."""
    return 10 / (2 * 1.25)


def three_types() -> Finding:
    """How near 25/14/12 comes, and idlers that are exact."""
    near = size_gears(from_polyhedron("rhombicosidodecahedron", "faces", teeth={"5": 25, "4": 14, "3": 12}))
    idle = size_gears(from_polyhedron(NOTE, "faces+edges", teeth={"5": 60, "3": 36, "e": 24}))
    text = f"25/14/12 misses one pitch by {100 * abs(near.mismatch):.3f} %; idlers on edges, 60/36/24, are exact"
    return Finding(not idle.exact, text)


def buckyball() -> Finding:
    """Whether the solid of that name turns."""
    ball = GearSphere(from_polyhedron("truncated icosahedron", "faces"))
    return Finding(ball.moves, f"a buckyball (truncated icosahedron) {'turns' if ball.moves else 'is locked'}")


def one_apex() -> Finding:
    """The cones of each pair fill the angle between its axes, so that both have their apex in the centre."""
    found = size_gears(gears())
    angles = np.array([gears().angle(*mesh) for mesh in gears().meshes])
    off = float(np.abs(np.asarray(found.cones, dtype=float).sum(axis=1) - angles).max())
    return Finding(off < 1e-12, f"in all {len(angles)} meshes both pitch cones have their apex in the centre")


def window() -> Finding:
    """45 and 33 teeth within the window of the ratio."""
    (found,) = ratio_windows(gears())
    return Finding(found.low < 45 / 33 < found.high, f"{found.low:.4f} < 45/33 < {found.high:.4f}")


def introduction() -> Iterator[Row]:
    """What such a model is, and the order of work."""
    yield outside(
        "Introduction, 5-4-3",
        "a picture of a 5-4-3 configuration",
        PICTURE + "`geartrain sphere rhombicosidodecahedron --plot sphere.svg` draws it",
    )
    yield words("Introduction, simpler", "5-3 is less complicated than 5-4-3", "kinds()")
    yield Row(
        "Introduction, gears",
        "gears of the 5-3 model",
        "30",
        Command(SIZED, "gears"),
        Exactly(),
        "32: 12 and 20; 30 is the number of vertices",
    )
    yield words(
        "Introduction, name",
        "the solid of the models is a buckyball",
        "buckyball()",
        "the models are the icosidodecahedron and the rhombicosidodecahedron",
    )
    yield outside(
        "How to, steps 1 to 6", "the order of work", f"a method, not a result; all of it is `geartrain {SIZED}`"
    )


def first_steps() -> Iterator[Row]:
    """Steps 1 to 3: which gears turn, where they stand, how large the sphere is."""
    yield words("Step 1, three", "a loop of three is locked", "closed_loop(3)")
    yield words("Step 1, even", "a loop with an even number turns", "closed_loop(4)")
    yield words(
        "Step 1, half",
        "in a loop that turns, half of the gears turn clockwise",
        "loops()",
        why="in the whole set, 12 turn one way and 20 the other",
    )
    yield Row(
        "Step 1, gridlock",
        "the 5-3 configuration does not lock: degrees of freedom",
        "1",
        Command(SIZED, "mobility"),
        Exactly(),
    )
    yield words(
        "Step 1, middles",
        "gears interface at the middles of edges",
        "middle()",
        "true only for the irrational ratio 2.383963",
    )
    yield words(
        "Step 2", "the characteristic pentagons give the directions of the pentagons and triangles", "same_lines()"
    )
    yield words("Step 3, decagon", "the cut through middles of edges is a regular decagon", "decagon()")
    yield equation("Step 3, R_sph of L", "R_sph = L/(2 sin 18)", "off(L / (2 * sin(18 * DEG)), R_SPH)")
    yield equation("Step 3, r of S", "r = S/(2 tan 36)", "off(S / (2 * tan(36 * DEG)), R)")
    yield equation("Step 3, r of L", "r = L/(2 sin 36)", "off(L / (2 * sin(36 * DEG)), R)")
    yield equation("Step 3, L", "L = S cos 36", "off(S * cos(36 * DEG), L)")
    yield equation(
        "Step 3, R_sph", "R_sph = S cos 36/(2 sin 18)", "off(S * cos(36 * DEG) / (2 * sin(18 * DEG)), R_SPH)"
    )


def angles() -> Iterator[Row]:
    """Step 4: the angles between axes."""
    yield equation("Step 4, D", "D = S/(2 sin 36)", "off(S / (2 * sin(36 * DEG)), D)")
    yield equation(
        "Step 4, H",
        "H = sqrt(R_sph^2 - r^2), the distance of a face",
        "off(height(), sqrt(1 - D**2))",
    )
    yield equation(
        "Step 4, phi", "phi = atan(D/H)", "off(atan(D / sqrt(R_SPH**2 - R**2)), gears().angle(*gears().meshes[0]))"
    )
    yield number("Step 4, value of phi", "angle between pentagon and triangle (deg)", "37.37736814", "angles.5-3")
    yield digits(
        "Step 4, first beta",
        "angle between two triangles by an arcsine (deg)",
        "44.9110304",
        "right_beta()",
        "41.8103149 = asin(2/3); the note corrects itself below",
    )
    yield digits("Step 4, its arithmetic", "2 asin(sin 18/cos 36), as a number (deg)", "44.9110304", "wrong_beta()")
    yield equation(
        "Step 4, beta",
        "beta = 2 atan(S/(2 R_sph)) = 2 atan(sin 18/cos 36)",
        "max(off(2 * atan(x), right_beta() * DEG) for x in (S / 2 / R_SPH, sin(18 * DEG) / cos(36 * DEG)))",
    )
    yield digits(
        "Step 4, value of beta",
        "angle between two triangles (deg)",
        "41.8103148828",
        "right_beta()",
        "41.8103148958, from the note's own formula",
    )
    yield words(
        "Step 4, neighbours",
        "beta is an angle between neighbours that mesh",
        "triangles_mesh()",
        "triangles meet only at vertices; the angle limits their cones",
    )


def sizes() -> Iterator[Row]:
    """Steps 5 and 6: radii and teeth."""
    yield equation("Step 5, R1", "R1 = R_sph sin a", "sines(0)")
    yield equation("Step 5, R2", "R2 = R_sph sin(phi - a)", "sines(1)")
    yield equation("Step 5, ratio", "R1/R2 = sin a/sin(phi - a)", "sines(2)")
    yield words(
        "Step 5, multiples",
        "teeth are multiples of the number of neighbours, so that they mesh",
        "rule()",
        "this is not the reason, although multiples of 5 and 3 are correct here",
    )
    yield words("Step 5, 5/3", "the ratio 5/3 is possible with 20 and 12 teeth", "fits(20, 12)")
    yield words("Step 5, 5/6", "the ratio 5/6 could be chosen", "fits(5, 6)", "tips collide")
    yield words("Step 5, 10/3", "the ratio 10/3 could be chosen", "fits(10, 3)", "tips collide")
    yield words("Step 5, 45/33", "the ratio 45/33 could be chosen", "fits(45, 33)")
    yield words("Step 5, overlap", "the gears of a 45/33 pair do not overlap their neighbours", "window()")
    yield number(
        "Step 5, a",
        "angle a for 5/3 (deg)",
        "23.52241845",
        "cones.5",
        why="geartrain uses a closed form, (1) of [Gears on a sphere](sphere.md); the note used a solver",
    )
    yield number("Step 5, radius 1", "R1 (inches)", "1.25", "radii.5")
    yield number("Step 5, radius 2", "R2 (inches)", "0.75", "radii.3")
    yield number("Step 5, Rsph", "radius of the sphere (inches)", "3.13198541", "sphere_radius")
    yield words(
        "How to, more types",
        "more than two types are very difficult or impossible",
        "three_types()",
        "three types are exact with idlers, and nearly exact without",
    )
    yield exact(
        "Step 6, pitch",
        "diametral pitch N/R",
        "8",
        "diametral()",
        "4.0 = N/(2R), teeth over diameter",
    )
    yield exact("Step 6, teeth", "N1/R1 = N2/R2 with 10 and 6 teeth", "8", "round(10 / 1.25 + 6 / 0.75) // 2")
    yield words("Step 6, slope", "teeth should slope radially outwards", "one_apex()")
    yield outside(
        "Step 6, renderings", "two pictures", PICTURE + "`geartrain sphere icosidodecahedron --plot sphere.svg`"
    )


SOURCE = Source(
    "Sphere",
    "Anonymous, Spherical Configuration of Rounded Gears - A Derivation (a web log)",
    "Lengths are measured on a dodecahedron that geartrain constructs."
    " For the note's ratio of 5/3, it uses 20 and 12 teeth.",
    tuple(row for part in (introduction, first_steps, angles, sizes) for row in part()),
)
