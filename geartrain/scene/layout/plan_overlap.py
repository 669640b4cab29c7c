"""Which wheels of parallel axes stand in whose way in plan, and the blocks they are stacked as."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.layout.axis_placement import Point
from geartrain.scene.layout.declared_geometry import AxisLine

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class WheelBlock:
    """A wheel in a stack.

    axis    index of its axis; `link`, that of its arbor
    stack   number of the wheels that keep their heights to each other: those that mesh
    offset  its height in its stack (mm); `low` and `high`, how far it reaches along the direction from there
    inner   of a ring, the radius within which all is free; `outer`, the radius that it needs
    mate    it stands across, and meshes with a wheel of this stack: `beside`, if it keeps its place, has the ends of
            its trace in plan, on both sides of which `outer` is taken
    """

    wheel: str
    axis: int
    link: str
    stack: int
    offset: float
    low: float
    high: float
    inner: float
    outer: float
    beside: tuple[tuple[float, float], tuple[float, float]] | None = None
    mate: bool = False


@dataclass(frozen=True)
class PlanOverlap:
    """What stands in whose way, in plan.

    blocks  wheels
    clash   (blocks, blocks): two that must not share a height
    pierce  (links, blocks): wheels that an arbor would go through at their height
    links   names of arbors; `ends`, whether each runs out of the stack at its low or high end, to a dial
    plates  the wheel on which the axis of an arbor is carried round
    """

    blocks: Sequence[WheelBlock]
    clash: Flags
    pierce: Flags
    links: Sequence[str]
    ends: Mapping[str, tuple[bool, bool]]
    plates: Mapping[str, str]


def plates(blocks: Sequence[WheelBlock], lines: Sequence[AxisLine], frame: str) -> dict[str, str]:
    """The widest wheel of the carrier of each arbor."""
    widest: dict[str, WheelBlock] = {}
    for block in blocks:
        if not block.mate and (block.link not in widest or block.outer > widest[block.link].outer):
            widest[block.link] = block
    bearers = {block.link: lines[block.axis].bearers[0] for block in blocks if not block.mate}
    return {
        link: widest[bearer].wheel
        for link, bearer in bearers.items()
        if bearer in widest and frame not in (link, bearer)
    }


def find_plan_overlap(
    blocks: Sequence[WheelBlock],
    links: Sequence[str],
    near: Floats,
    far: Floats,
    lines: Sequence[AxisLine],
    places: Mapping[str, Point],
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which blocks overlap in plan, and through which an arbor at its place would go."""
    if not blocks:
        return np.zeros((0, 0), bool), np.zeros((len(links), 0), bool)
    axis = np.array([block.axis for block in blocks])
    outer = np.array([block.outer for block in blocks])
    inner = np.array([block.inner for block in blocks])
    stacks = np.array([block.stack for block in blocks])
    apart = near[np.ix_(axis, axis)]
    off = near[:, axis].copy()  # axes against blocks
    for at, block in enumerate(blocks):
        if block.beside is not None:
            away = np.array([_from_strip(places[line.label], block.beside) for line in lines])
            off[:, at] = away
            apart[at, :] = apart[:, at] = away[axis]
    clash = (apart < outer[:, None] + outer[None, :]) & (stacks[:, None] != stacks[None, :])
    of = {block.link: block.axis for block in blocks}
    at_axis = np.array([of[link] for link in links], np.intp)
    pierce = off[at_axis] < outer[None, :]
    pierce &= (far[np.ix_(at_axis, axis)] >= inner[None, :]) | (inner[None, :] == 0)
    pierce &= axis[None, :] != at_axis[:, None]
    own: dict[str, list[int]] = {}
    for at, block in enumerate(blocks):
        if not block.mate:
            own.setdefault(block.link, []).append(at)
    for row, at in enumerate(at_axis.tolist()):  # a plate has holes for the arbors that it bears
        pierce[row, [block for bearer in lines[at].bearers for block in own.get(bearer, ())]] = False
    return clash, pierce


def _from_strip(point: Point, strip: tuple[Point, Point]) -> float:
    (x, y), (u, v) = strip
    along, up = u - x, v - y
    square = along * along + up * up
    part = ((point[0] - x) * along + (point[1] - y) * up) / square if square else 0.0
    part = min(max(part, 0.0), 1.0)
    return hypot(point[0] - x - part * along, point[1] - y - part * up)
