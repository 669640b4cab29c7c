"""What a written drawing says is cut, read back from its SVG as a material of polygons.

Written apart from what writes it: it knows the file alone, path data as the SVG standard has it, so that what is proved
is what a laser follows.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from math import acos, atan2, ceil, cos, pi, sin, sqrt
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

from geartrain.errors import GearTrainError, MissingExtraError, Problem

if TYPE_CHECKING:
    from shapely import Geometry

TOLERANCE = 2e-4
"""How far (mm) chords of a proof may leave the arcs of a drawing."""
_CUT = "CUT"
_WORDS = re.compile(r"[A-Za-z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_COUNTS = {"M": 2, "L": 2, "A": 7, "Z": 0}

Point = tuple[float, float]


def plane_geometry() -> Any:
    """The library of plane geometry. Raises `MissingExtraError` without it."""
    try:
        import shapely
    except ImportError:
        raise MissingExtraError("shapely", "proof", "a proof that wheels turn") from None
    return shapely


def read_material(svg: str, pins: bool = False, tolerance: float = TOLERANCE) -> Geometry:
    """The material that a drawing leaves when its CUT path is cut, mm, y upwards; of a lantern its pins.

    The largest line is the rim, the others are holes. Raises `GearTrainError` for what cannot be cut: a line that
    crosses itself, a hole that leaves the part.
    """
    shapely = plane_geometry()
    rings = [shapely.Polygon(line) for line in cut_lines(svg, tolerance)]
    crossed = next((ring for ring in rings if not ring.is_valid), None)
    if crossed is not None:
        raise _uncuttable("a line crosses itself", shapely.is_valid_reason(crossed))
    outer = max(rings, key=lambda ring: float(ring.area))
    holes = [ring for ring in rings if ring is not outer]
    if pins:
        axle = shapely.Point(0.0, 0.0)
        return shapely.union_all([hole for hole in holes if not hole.covers(axle)])
    whole = shapely.Polygon(outer.exterior, [hole.exterior for hole in holes])
    if not whole.is_valid:
        raise _uncuttable("its lines run into each other", shapely.is_valid_reason(whole))
    return whole


def cut_lines(svg: str, tolerance: float = TOLERANCE) -> list[list[Point]]:
    """The closed lines of the CUT path as points (mm), y upwards, arcs as chords."""
    path = next(each for each in ElementTree.fromstring(svg).iter() if each.get("id") == _CUT)
    lines: list[list[Point]] = []
    for word, numbers in _commands(path.get("d", "")):
        if word == "M":
            lines.append([(numbers[0], -numbers[1])])
        elif word == "L":
            lines[-1].append((numbers[0], -numbers[1]))
        elif word == "A":
            end = numbers[5], -numbers[6]
            # y upwards a positive sweep turns right
            lines[-1] += _arc(lines[-1][-1], end, numbers[0], (bool(numbers[3]), not numbers[4]), tolerance)
    return lines


def _commands(data: str) -> Iterator[tuple[str, Sequence[float]]]:
    """Each command with its numbers."""
    words = _WORDS.findall(data)
    at = 0
    while at < len(words):
        word = words[at]
        count = _COUNTS[word]
        yield word, [float(each) for each in words[at + 1 : at + 1 + count]]
        at += 1 + count


def _arc(start: Point, end: Point, radius: float, flags: tuple[bool, bool], tolerance: float) -> list[Point]:
    """Points of an arc of a circle after its start; flags: whether it is the larger one, and turns left.

    The centre by appendix B.2.4 of SVG 2, for circles.
    """
    large, left = flags
    (x, y), (u, v) = start, end
    half = sqrt((u - x) ** 2 + (v - y) ** 2) / 2
    if not half:
        return []
    radius = max(radius, half)
    aside = sqrt(radius**2 - half**2) / (2 * half) * (1 if left != large else -1)
    cx, cy = (x + u) / 2 - aside * (v - y), (y + v) / 2 + aside * (u - x)
    first, last = atan2(y - cy, x - cx), atan2(v - cy, u - cx)
    sweep = (last - first) % (2 * pi) if left else -((first - last) % (2 * pi))
    count = max(1, ceil(abs(sweep) / (2 * acos(max(1 - tolerance / radius, -1.0)))))
    turns = (first + sweep * k / count for k in range(1, count))
    return [*((cx + radius * cos(t), cy + radius * sin(t)) for t in turns), end]


def _uncuttable(what: str, why: str) -> GearTrainError:
    return GearTrainError(Problem(f"a drawing cannot be cut: {what}", why, "change its teeth, its bore or its rim"))
