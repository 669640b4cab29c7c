"""Heights of the wheels of parallel axes, at which none stands in another's way; and where that cannot be had."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.vectors import Vector
from geartrain.scene.layout.stack_order import StackProblem, order_stacks
from geartrain.scene.layout.swept_overlap import SweptDistances, WheelBlock

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices

_SLACK = 1e-9  # of the radii: wheels that touch as placed do not collide by rounding


def stack_heights(problem: StackProblem, gap: float) -> dict[int, float]:
    """Height of each stack (mm), the lowest upright wheel of all at 0; `gap` is kept free between levels."""
    if not problem.count:
        return {}
    keys = order_stacks(problem)
    known = np.unique(keys)
    level = np.searchsorted(known, keys)
    heights = _level_heights(problem, level, len(known), gap)
    blocks = [block for block in problem.blocks if not block.across]
    start = min((float(heights[level[block.stack]]) + block.offset for block in blocks), default=0.0)
    return {stack: float(heights[level[stack]]) - start for stack in range(len(keys))}


def _level_heights(problem: StackProblem, level: Indices, count: int, gap: float) -> Floats:
    """Levels from below: each above all that is in its way, and above the level before."""
    blocks = problem.blocks
    level_of = np.array([level[block.stack] for block in blocks])
    bottom = np.array([block.offset - block.low for block in blocks])
    top = np.array([block.offset + block.high for block in blocks])
    upright = np.array([not block.across for block in blocks])
    heights = np.zeros(count)
    for at in range(1, count):
        mine, below = np.nonzero(level_of == at)[0], np.nonzero(level_of < at)[0]
        need = heights[level_of[below]][:, None] + top[below][:, None] + gap - bottom[mine][None, :]
        need = np.where(problem.overlap.clash[np.ix_(below, mine)], need, -np.inf)
        last = below[upright[below] & (level_of[below] == at - 1)]
        flat = heights[at - 1] + gap + _thickest(blocks, last) / 2 + _thickest(blocks, mine[upright[mine]]) / 2
        heights[at] = max(float(need.max(initial=-np.inf)), flat)
    return heights


def _thickest(blocks: Sequence[WheelBlock], which: Indices) -> float:
    """Of some blocks that stand at the height of their stack."""
    sizes = [blocks[at].low + blocks[at].high for at in which.tolist() if not blocks[at].offset]
    return max(sizes, default=0.0)


@dataclass(frozen=True)
class WheelStack:
    """The wheels of some parallel axes, one above the other.

    up      direction in which heights grow
    gap     (mm) that is kept free between levels
    swept   distances of the axes
    given   stack -> height (mm) that is set by what stands already
    """

    up: Vector
    problem: StackProblem
    gap: float
    swept: SweptDistances
    given: Mapping[int, float]

    def heights(self) -> dict[str, float]:
        """Heights of upright wheels: as given, all other stacks moved along with the first that is."""
        found = stack_heights(self.problem, self.gap)
        shift = next((height - found[stack] for stack, height in self.given.items()), 0.0)
        found = {stack: self.given.get(stack, height + shift) for stack, height in found.items()}
        return {block.wheel: found[block.stack] + block.offset for block in self.upright}

    @property
    def upright(self) -> list[WheelBlock]:
        """Wheels that turn about these axes."""
        return [block for block in self.problem.blocks if not block.across]

    def collisions(self, height: Mapping[str, float]) -> Iterator[tuple[str, str]]:
        """Wheels on different axes or arbors that would run into each other at their heights."""
        blocks = self.upright
        axis = np.array([block.axis for block in blocks], np.intp)
        outer = np.array([block.outer for block in blocks])
        low = np.array([height[block.wheel] - block.low for block in blocks])
        high = np.array([height[block.wheel] + block.high for block in blocks])
        level = np.triu((low[:, None] < high[None, :]) & (low[None, :] < high[:, None]), 1)
        first, second = np.nonzero(level)
        # only pairs that are near enough are looked at one by one
        near = self.swept.near[axis[first], axis[second]] < (outer[first] + outer[second]) * (1 - _SLACK)
        for at, to in zip(first[near].tolist(), second[near].tolist(), strict=True):
            one, other = blocks[at], blocks[to]
            same = one.axis == other.axis and one.link == other.link
            if not same and self.swept.overlap(one, one.axis, other, other.axis):
                yield one.wheel, other.wheel

    def pierced(self, height: Mapping[str, float]) -> Iterator[tuple[str, str]]:
        """Arbors with the wheels they go through, but of pins and slots, whose axes share one stud."""
        tied = {frozenset(pair) for pair in self.problem.pins}
        ends = {block.link: block.wheel for block in self.upright if any(block.wheel in pair for pair in tied)}
        spans: dict[str, list[float]] = {}
        for block in self.upright:
            spans.setdefault(block.link, []).append(height[block.wheel])
        for arbor, plate in self.problem.plates.items():
            spans[arbor].append(height[plate])
        for row, arbor in enumerate(self.problem.arbors):
            own = spans.get(arbor, [])
            if len(own) < 2:
                continue
            for at in np.nonzero(self.problem.overlap.pierce[row])[0].tolist():
                block = self.problem.blocks[at]
                if frozenset((ends.get(arbor, ""), block.wheel)) in tied:
                    continue
                if not block.across and block.link != arbor and min(own) < height[block.wheel] < max(own):
                    yield arbor, block.wheel
