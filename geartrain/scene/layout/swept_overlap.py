"""Which wheels of parallel axes stand in whose way in plan, at any turns of the carriers that move them.

Seen from the nearest link that bears both, each of two axes stays in a ring about the axis of the carrier that hangs
there. All of both rings is counted, as if carriers never kept step: that is an interval of distances for each two axes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from geartrain.scene.layout.declared_geometry import AxisLine, Parallels, Point

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Indices

    Flags = NDArray[np.bool_]

_SLACK = 1e-9  # of a radius: discs that touch as placed do not overlap by rounding


class Disc(Protocol):
    """A wheel in plan."""

    @property
    def inner(self) -> float:
        """Of a ring, the radius within which all is free (mm); 0 of other wheels."""

    @property
    def outer(self) -> float:
        """The radius that it needs (mm)."""


def overlap(disc: Disc, other: Disc, near: float, far: float) -> bool:
    """True if two wheels at one height run into each other, their axes being between `near` and `far` (mm) apart."""
    for ring, inside in ((disc, other), (other, disc)):
        if ring.inner and far + inside.outer <= ring.inner * (1 + _SLACK):
            return False
    return near < (disc.outer + other.outer) * (1 - _SLACK)


@dataclass(frozen=True)
class SweptDistances:
    """Least and greatest distance (mm) of each two of n parallel axes, (n, n), while carriers turn."""

    near: Floats
    far: Floats

    def overlap(self, disc: Disc, axis: int, other: Disc, other_axis: int) -> bool:
        """True if wheels of two axes, at one height, run into each other."""
        return overlap(disc, other, float(self.near[axis, other_axis]), float(self.far[axis, other_axis]))


class _Swept(NamedTuple):
    """An axis as a link sees it that bears it: it keeps between `low` and `high` (mm) from the axis `centre`."""

    at: int
    centre: str
    low: float
    high: float


def swept_distances(lines: Sequence[AxisLine], places: Mapping[str, Point]) -> SweptDistances:
    """Distances of parallel axes at any turns of their carriers.

    Axes borne by a link that turns about another direction are far from all that it does not bear.
    """
    seen: dict[tuple[str, ...], list[_Swept]] = {}  # by the link that sees, with all that bear it
    for at, line in enumerate(lines):
        centre, low, high = line.label, 0.0, 0.0
        for depth in range(len(line.bearers)):
            seen.setdefault(line.bearers[depth:], []).append(_Swept(at, centre, low, high))
            pivot = line.pivots[depth] if depth < len(line.pivots) else ""
            if pivot not in places:
                break
            (x, y), (u, v) = places[centre], places[pivot]
            arm = hypot(x - u, y - v)
            low, high = max(0.0, low - arm, arm - high), high + arm
            centre = pivot
    count = len(lines)
    found = SweptDistances(np.full((count, count), np.inf), np.zeros((count, count)))
    # the nearest common bearer counts: it has the most above it, so it comes last and overwrites the others
    for _, members in sorted(seen.items(), key=lambda each: len(each[0])):
        _fill(found, members, places)
    return found


def _fill(found: SweptDistances, members: Sequence[_Swept], places: Mapping[str, Point]) -> None:
    index = np.array([member.at for member in members])
    points = np.array([places[member.centre] for member in members])
    low, high = np.array([member.low for member in members]), np.array([member.high for member in members])
    apart = np.hypot(*(points[:, None, axis] - points[None, :, axis] for axis in (0, 1)))
    block = np.ix_(index, index)
    if not high.any():  # none is carried round: the distance itself, not a difference that rounds
        found.near[block] = found.far[block] = apart
        return
    reach = high[:, None] + high[None, :]
    inside, outside = low[:, None] - high[None, :] - apart, low[None, :] - high[:, None] - apart
    found.near[block] = np.maximum.reduce([apart - reach, inside, outside, 0 * apart])
    found.far[block] = apart + reach


@dataclass(frozen=True, slots=True)
class WheelBlock:
    """A wheel in a stack (mm)."""

    wheel: str
    axis: int
    """Index of its axis; link, that of its arbor."""
    link: str
    stack: int
    """Number of the wheels that keep their heights to each other: those that mesh."""
    offset: float
    """Its height in its stack; low and high, how far it reaches along the direction from there."""
    low: float
    high: float
    inner: float
    """Of a ring, the radius within which all is free."""
    outer: float
    """The radius that it needs."""
    across: bool = False
    """It stands across, and meshes with a wheel of this stack."""
    trace: tuple[Point, Point] | None = None
    """Of a wheel across that keeps its place: the ends of its trace in plan, on both sides of which `outer` is
    taken; None of others."""


@dataclass(frozen=True)
class PlanOverlap:
    """What stands in whose way, in plan."""

    clash: Flags
    """(blocks, blocks): two that must not share a height."""
    pierce: Flags
    """(links and pins, blocks): wheels that an arbor, or a pin, would go through at their height."""


def find_plan_overlap(
    blocks: Sequence[WheelBlock],
    links: Sequence[str],
    parallels: Parallels,
    places: Mapping[str, Point],
    swept: SweptDistances,
    plates: Mapping[str, str],
    pins: Sequence[tuple[str, str]] = (),
) -> PlanOverlap:
    """Which blocks overlap in plan, and through which an arbor at its place would go, or a pin from wheel to wheel.

    plates   arbor -> the wheel that bears its axis, and has a hole for it
    """
    if not blocks:
        return PlanOverlap(np.zeros((0, 0), bool), np.zeros((len(links), 0), bool))
    lines = parallels.lines
    axis = np.array([block.axis for block in blocks])
    outer = np.array([block.outer for block in blocks])
    inner = np.array([block.inner for block in blocks])
    stacks = np.array([block.stack for block in blocks])
    apart = swept.near[np.ix_(axis, axis)]
    off = swept.near[:, axis].copy()  # axes against blocks
    for at, block in enumerate(blocks):
        if block.trace is not None:
            away = np.array([segment_distance(places[line.label], *block.trace) for line in lines])
            off[:, at] = away
            apart[at, :] = apart[:, at] = away[axis]
    clash = (apart < outer[:, None] + outer[None, :]) & (stacks[:, None] != stacks[None, :])
    axis_of = {block.link: block.axis for block in blocks}
    arbor: Indices = np.array([axis_of[link] for link in links], np.intp)
    pierce = off[arbor] < outer[None, :]
    pierce &= (swept.far[np.ix_(arbor, axis)] >= inner[None, :]) | (inner[None, :] == 0)
    pierce &= axis[None, :] != arbor[:, None]
    named = {block.wheel: at for at, block in enumerate(blocks) if not block.across}
    for row, link in enumerate(links):
        if link in plates:
            pierce[row, named[plates[link]]] = False
    rows = [_in_the_way(blocks, off, (named[pin], named[slot])) for pin, slot in pins]
    pierce = np.vstack([pierce, *rows])
    return PlanOverlap(clash, pierce)


def _in_the_way(blocks: Sequence[WheelBlock], off: Floats, ends: tuple[int, int]) -> Flags:
    """Blocks of other links that a pin may meet between its wheel and that of its slot."""
    pin, slot = (blocks[at] for at in ends)
    outer = np.array([block.outer for block in blocks])
    own = np.array([block.link in (pin.link, slot.link) for block in blocks])
    return np.asarray((off[pin.axis] - pin.outer < outer) & ~own)


def segment_distance(point: Point, start: Point, end: Point) -> float:
    """Distance of a point from a segment."""
    u, v = end[0] - start[0], end[1] - start[1]
    x, y = point[0] - start[0], point[1] - start[1]
    square = u * u + v * v
    part = (x * u + y * v) / square if square else 0.0
    part = min(max(part, 0.0), 1.0)
    return hypot(x - part * u, y - part * v)
