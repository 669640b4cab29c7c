"""Crossings-out: windows that leave a wheel a rim, arms and a hub, all inner corners rounded."""

from __future__ import annotations

from math import asin, cos, pi, sin, sqrt

from geartrain.teeth.outlines.contour import Contour, bulge_about

RIM, HUB = 2.25, 1.125
"""Depth of the rim under the roots in modules, and radius of the hub in diameters of the bore, as clockmakers have
them (rims of 2 to 2.5 modules, hubs of 2 to 2.5 arbors)."""
_ARM = 1.0  # of the rim: width of an arm
_WINDOW = 1.0  # of the rim: the least that a window must reach from hub to rim
_CORNER = 0.5  # of a module: radius of corners, or as a tool needs it

Point = tuple[float, float]


def arm_windows(root: float, module: float, bore: float, arms: int, corner: float | None = None) -> tuple[Contour, ...]:
    """The windows between the arms of a wheel, one hole each; none where there is no room.

    An arm is as wide all along as the rim is deep. A window is bounded by two arms, the rim and the hub.

    Parameters
    ----------
    root : float
        Radius of the root circle (mm).
    module : float
        Of the wheel (mm).
    bore : float
        Diameter of the hole for its arbor (mm).
    arms : int
        How many, 3 or more; fewer leave the wheel whole.
    corner : float, optional
        Radius of inner corners (mm): that of the tool, or more.
    """
    if arms < 3:
        return ()
    depth = RIM * module
    corner = _CORNER * module if corner is None else corner
    # many arms meet in a greater hub
    meet = (_ARM * depth / 2 + corner) / sin(pi / arms) - corner
    outer, inner = root - depth, max(HUB * bore, depth, meet)
    if outer - inner < max(_WINDOW * depth, 2 * corner):
        return ()
    window = _window(outer, inner, _ARM * depth / 2, 2 * pi / arms, corner)
    if window is None:
        return ()
    return tuple(_turned(window, 2 * pi * (at + 0.5) / arms) for at in range(arms))


def _window(outer: float, inner: float, half: float, pitch: float, corner: float) -> Contour | None:
    """The window about the x axis, its arms half as wide as `half` says on either side of +-pitch/2; None if too small.

    Corners are arcs about centres that are `corner` from an arm, and from the rim or the hub.
    """
    ends = []
    for circle, centre in ((outer, outer - corner), (inner, inner + corner)):
        if half + corner >= centre:
            return None
        lean = asin((half + corner) / centre)
        along = sqrt(centre**2 - (half + corner) ** 2)
        ends.append((circle, centre, pitch / 2 - lean, along))
    (rim, rim_centre, rim_turn, far), (hub, hub_centre, hub_turn, near) = ends
    if min(rim_turn, hub_turn) < -1e-9 or far <= near:
        return None
    upper = [
        (_at(rim, rim_turn), _at(rim_centre, rim_turn), _beside(far, half, pitch)),
        (_beside(near, half, pitch), _at(hub_centre, hub_turn), _at(hub, hub_turn)),
    ]
    corners = [*upper, *((_mirrored(c), _mirrored(b), _mirrored(a)) for a, b, c in reversed(upper))]
    vertices = []
    for at, (start, about, end) in enumerate(corners):
        following = corners[(at + 1) % 4][0]
        round_ = at in (1, 3)  # along the hub, and along the rim; between them straight along an arm
        bulge = bulge_about(end, following, (0.0, 0.0)) if round_ else 0.0
        vertices += [(*start, bulge_about(start, end, about)), (*end, bulge)]
    return Contour.of(vertices)


def _at(radius: float, angle: float) -> Point:
    return radius * cos(angle), radius * sin(angle)


def _beside(along: float, half: float, pitch: float) -> Point:
    """A point on the edge of the arm at +pitch/2 that looks at the window."""
    c, s = cos(pitch / 2), sin(pitch / 2)
    return along * c + half * s, along * s - half * c


def _mirrored(point: Point) -> Point:
    return point[0], -point[1]


def _turned(contour: Contour, angle: float) -> Contour:
    """The same, turned about the origin; holes turn left as outlines do."""
    c, s = cos(angle), sin(angle)
    x, y = contour.points.T
    points = contour.points.copy()
    points[:, 0], points[:, 1] = c * x - s * y, s * x + c * y
    return Contour(points, contour.bulges)
