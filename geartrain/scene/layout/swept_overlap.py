"""Wheels of parallel axes that overlap in plan at some angles of the carriers that move them.

Relative to the nearest link that carries two axes, each axis stays in an annulus about the axis of a carrier. All
points of both annuli are considered possible, as if the angles of the carriers were independent. This gives an interval
of distances for each pair of axes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geartrain.scene.layout.declared_geometry import AxisLine, Parallels, Point

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Indices
    from geartrain.scene.layout.wheel_modules import WheelSize

    Flags = NDArray[np.bool_]
    Disc: TypeAlias = "WheelBlock | WheelSize"

_SLACK = 1e-9  # relative to a radius: touching discs must not overlap due to rounding errors


def overlap(disc: Disc, other: Disc, near: float, far: float) -> bool:
    """Return True if two wheels at the same height collide at an axis distance between `near` and `far` [mm]."""
    for ring, inside in ((disc, other), (other, disc)):
        if ring.inner and far + inside.outer <= ring.inner * (1 + _SLACK):
            return False
    return near < (disc.outer + other.outer) * (1 - _SLACK)


@dataclass(frozen=True)
class SweptDistances:
    """Minimum and maximum distance between each pair of n parallel axes while carriers turn [mm], shape (n, n)."""

    near: Floats
    far: Floats

    def overlap(self, disc: Disc, axis: int, other: Disc, other_axis: int) -> bool:
        """Return True if two wheels at the same height on two axes collide at some angles of the carriers."""
        return overlap(disc, other, float(self.near[axis, other_axis]), float(self.far[axis, other_axis]))


class _Swept(NamedTuple):
    """Minimum and maximum distance of an axis from another axis (`centre`) over all angles of carriers [mm]."""

    at: int
    centre: str
    low: float
    high: float


def swept_distances(lines: Sequence[AxisLine], places: Mapping[str, Point]) -> SweptDistances:
    """Return the minimum and maximum distances between parallel axes over all angles of their carriers.

    If a link turns about a direction that is not parallel to the axes, the axes that it carries have an infinite
    distance from all axes that it does not carry.
    """
    seen: dict[tuple[str, ...], list[_Swept]] = {}  # by link, with all links that carry it
    for at, line in enumerate(lines):
        centre, low, high = line.label, 0.0, 0.0
        for depth in range(len(line.bearers)):
            seen.setdefault(line.bearers[depth:], []).append(_Swept(at, centre, low, high))
            pivot = line.pivots[depth] if depth < len(line.pivots) else ""
            if pivot not in places:
                break
            (x, y), (u, v) = places[centre], places[pivot]
            arm = hypot(x - u, y - v)
            # the annulus of radii low and high, swept as its centre revolves at the distance arm
            low, high = max(0.0, low - arm, arm - high), high + arm
            centre = pivot
    count = len(lines)
    found = SweptDistances(np.full((count, count), np.inf), np.zeros((count, count)))
    # the nearest common carrier has the longest chain to the frame, so it comes last and overwrites the others
    for _, members in sorted(seen.items(), key=lambda each: len(each[0])):
        _fill(found, members, places)
    return found


def _fill(found: SweptDistances, members: Sequence[_Swept], places: Mapping[str, Point]) -> None:
    index = np.array([member.at for member in members])
    points = np.array([places[member.centre] for member in members])
    low, high = np.array([member.low for member in members]), np.array([member.high for member in members])
    apart = np.hypot(*(points[:, None, axis] - points[None, :, axis] for axis in (0, 1)))
    block = np.ix_(index, index)
    if not high.any():  # none is carried: the distance itself, without rounding errors of differences
        found.near[block] = found.far[block] = apart
        return
    reach = high[:, None] + high[None, :]
    # one annulus may be inside the inner circle of the other
    inside, outside = low[:, None] - high[None, :] - apart, low[None, :] - high[:, None] - apart
    found.near[block] = np.maximum.reduce([apart - reach, inside, outside, 0 * apart])
    found.far[block] = apart + reach


@dataclass(frozen=True, slots=True)
class WheelBlock:
    """Wheel as a disc in a stack, with its height and radii [mm]."""

    wheel: str
    axis: int
    """Index of the wheel's axis."""
    link: str
    """Name of the link of which the wheel is a part; empty for a wheel on a crossing axis."""
    stack: int
    """Index of the wheel's stack: a set of wheels with fixed relative heights because they mesh."""
    offset: float
    """Height of the wheel in its stack [mm]."""
    low: float
    """Extent of the wheel below its height [mm]."""
    high: float
    """Extent of the wheel above its height [mm]."""
    inner: float
    """Radius of the free space inside a ring [mm]; 0 for other wheels."""
    outer: float
    """Outer radius of the wheel, including clearance [mm]."""
    across: bool = False
    """True for a wheel on an axis that crosses this group of axes. The wheel meshes with a wheel of this stack."""
    trace: tuple[Point, Point] | None = None
    """Ends of the line in the plan along which a fixed crossing wheel extends; None for other wheels."""


def find_plan_overlap(
    blocks: Sequence[WheelBlock],
    links: Sequence[str],
    parallels: Parallels,
    places: Mapping[str, Point],
    swept: SweptDistances,
    plates: Mapping[str, str],
    pins: Sequence[tuple[str, str]] = (),
) -> tuple[Flags, Flags]:
    """Return which wheels must not be at equal height, and through which an arbor would pass (see `StackProblem`).

    plates   wheel that carries the axis of each arbor, and has a hole for it
    pins     pairs of wheels: the wheel that has the pin, and the wheel that has the slot
    """
    if not blocks:
        return np.zeros((0, 0), bool), np.zeros((len(links), 0), bool)
    lines = parallels.lines
    axis = np.array([block.axis for block in blocks])
    outer = np.array([block.outer for block in blocks])
    inner = np.array([block.inner for block in blocks])
    stacks = np.array([block.stack for block in blocks])
    apart = swept.near[np.ix_(axis, axis)]
    off = swept.near[:, axis].copy()  # shape (axes, blocks)
    for at, block in enumerate(blocks):
        if block.trace is not None:
            away = np.array([segment_distance(places[line.label], *block.trace) for line in lines])
            off[:, at] = away
            apart[at, :] = apart[:, at] = away[axis]
    clash = (apart < outer[:, None] + outer[None, :]) & (stacks[:, None] != stacks[None, :])
    axis_of = {block.link: block.axis for block in blocks}
    arbor: Indices = np.array([axis_of[link] for link in links], np.intp)
    pierce = off[arbor] < outer[None, :]
    # an arbor that is always inside a ring does not pierce the ring
    pierce &= (swept.far[np.ix_(arbor, axis)] >= inner[None, :]) | (inner[None, :] == 0)
    pierce &= axis[None, :] != arbor[:, None]
    named = {block.wheel: at for at, block in enumerate(blocks) if not block.across}
    for row, link in enumerate(links):
        if link in plates:
            pierce[row, named[plates[link]]] = False
    rows = [pierce]
    for pin, slot in ((blocks[named[pin]], blocks[named[slot]]) for pin, slot in pins):
        own = np.array([block.link in (pin.link, slot.link) for block in blocks])
        # the radius of the pin is not known here: it may be anywhere on its wheel
        rows.append((off[pin.axis] - pin.outer < outer) & ~own)
    return clash, np.vstack(rows)


def segment_distance(point: Point, start: Point, end: Point) -> float:
    """Return the distance [mm] between a point and a line segment in the plan."""
    u, v = end[0] - start[0], end[1] - start[1]
    x, y = point[0] - start[0], point[1] - start[1]
    square = u * u + v * v
    part = (x * u + y * v) / square if square else 0.0
    part = min(max(part, 0.0), 1.0)
    return hypot(x - part * u, y - part * v)
