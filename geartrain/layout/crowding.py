"""Which wheels of parallel axes stand in whose way, in plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from geartrain.layout.blocks import Block
from geartrain.layout.planning import Point
from geartrain.layout.reading import Line

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


def plates(blocks: Sequence[Block], lines: Sequence[Line], frame: str) -> dict[str, str]:
    """The widest wheel of the carrier of each arbor."""
    widest: dict[str, Block] = {}
    for block in blocks:
        if not block.mate and (block.link not in widest or block.outer > widest[block.link].outer):
            widest[block.link] = block
    bearers = {block.link: lines[block.axis].bearers[0] for block in blocks if not block.mate}
    return {
        link: widest[bearer].wheel
        for link, bearer in bearers.items()
        if bearer in widest and frame not in (link, bearer)
    }


def crowding(
    blocks: Sequence[Block],
    links: Sequence[str],
    near: Floats,
    far: Floats,
    lines: Sequence[Line],
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
