"""Heights of wheels stacked along their common direction, so that none stands in another's way."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geartrain.layout.blocks import Block, Crowd
from geartrain.layout.levels import Levels

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


def stack(crowd: Crowd, gap: float) -> dict[int, float]:
    """Height of each stack (mm), the lowest upright wheel of all at 0."""
    count = 1 + max((block.stack for block in crowd.blocks), default=-1)
    if not count:
        return {}
    return _heights(crowd, Levels(crowd, count).found(), gap)


def _heights(crowd: Crowd, keys: Floats, gap: float) -> dict[int, float]:
    """Heights of levels from below: above all in their way, and above the level before."""
    known = np.unique(keys)
    level = np.searchsorted(known, keys)
    blocks = crowd.blocks
    of = np.array([level[block.stack] for block in blocks])
    bottom = np.array([block.offset - block.low for block in blocks])
    top = np.array([block.offset + block.high for block in blocks])
    upright = np.array([not block.mate for block in blocks])
    heights = np.zeros(len(known))
    for at in range(1, len(known)):
        mine = np.nonzero(of == at)[0]
        below = np.nonzero(of < at)[0]
        need = heights[of[below]][:, None] + top[below][:, None] + gap - bottom[mine][None, :]
        need = np.where(crowd.clash[np.ix_(below, mine)], need, -np.inf)
        last = below[upright[below] & (of[below] == at - 1)]
        flat = heights[at - 1] + gap + _thick(blocks, last) / 2 + _thick(blocks, mine[upright[mine]]) / 2
        heights[at] = max(float(need.max(initial=-np.inf)), flat)
    start = min(
        (float(heights[of[at]]) + block.offset for at, block in enumerate(blocks) if not block.mate), default=0.0
    )
    return {number: float(heights[level[number]]) - start for number in range(len(keys))}


def _thick(blocks: Sequence[Block], which: object) -> float:
    sizes = [blocks[at].low + blocks[at].high for at in np.asarray(which).tolist() if not blocks[at].offset]
    return max(sizes, default=0.0)
