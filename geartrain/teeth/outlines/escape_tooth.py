"""The tooth of an escape wheel: pointed, and leaning forward, so that a pallet of the anchor touches its tip alone."""

from __future__ import annotations

from collections.abc import Iterator
from math import atan2, cos, hypot, pi, radians, sin, tan

from geartrain.teeth.outlines.tooth_outline import Vertex
from geartrain.teeth.outlines.wheel_requirement import FixedTooth

ESCAPEMENT = "escapement"
WORDS = "of a dead-beat escapement, pointed, faces undercut by 6 degrees"
UNDERCUT = radians(6.0)
"""How far the leading face of a tooth lies behind the radius through its tip (rad): so much for a dead-beat anchor."""
_DEPTH = 0.7  # of a pitch
_DEEPEST = 0.5  # of the radius
_BASE = 0.45  # of a pitch: thickness of a tooth at its root
_LAND = 0.03  # of a pitch: width of a tip


def escape_tooth(z: int, sense: int) -> FixedTooth:
    """Of a wheel of z teeth, 3 or more, whose tips are on its pitch circle; the middle of its root on the x axis.

    Proportions of clockmakers, after G. Graham's anchor of about 1715: faces undercut by 6 degrees, backs straight.

    sense   1 if it turns counter-clockwise, -1 clockwise: it leans that way
    """
    radius, pitch = z / 2, 2 * pi / z
    depth = min(_DEPTH * pitch, _DEEPEST) * radius
    root = hypot(radius - depth, depth * tan(UNDERCUT))
    face = atan2(depth * tan(UNDERCUT), radius - depth)  # how far the tip is ahead of the foot of its face
    tooth = tuple(_vertices(pitch, radius, root, face))
    if sense < 0:  # in a mirror, and the other way round: an edge's bulge stands at its other end
        tooth = tuple((x, -y, tooth[at - 1][2]) for at, (x, y, _) in reversed([*enumerate(tooth)]))
    return FixedTooth(radius, root, tooth)


def _vertices(pitch: float, radius: float, root: float, face: float) -> Iterator[Vertex]:
    """Counter-clockwise: foot of the back, both ends of the tip, foot of the face; then along the root circle."""
    half = _BASE * pitch / 2
    for distance, angle, bulge in (
        (root, -half, 0.0),
        (radius, half + face - _LAND * pitch, tan(_LAND * pitch / 4)),
        (radius, half + face, 0.0),
        (root, half, tan((1 - _BASE) * pitch / 4)),
    ):
        yield distance * cos(angle), distance * sin(angle), bulge
