"""The wheels of parallel axes one above the other, at heights where none stands in another's way."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.vectors import Vector
from geartrain.scene.layout.plan_overlap import PlanOverlap, WheelBlock
from geartrain.scene.layout.stack_order import StackOrder
from geartrain.scene.layout.wheel_geometry import WheelSize

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


def stack(crowd: PlanOverlap, gap: float) -> dict[int, float]:
    """Height of each stack (mm), the lowest upright wheel of all at 0."""
    count = 1 + max((block.stack for block in crowd.blocks), default=-1)
    if not count:
        return {}
    return _heights(crowd, StackOrder(crowd, count).found(), gap)


def _heights(crowd: PlanOverlap, keys: Floats, gap: float) -> dict[int, float]:
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


def _thick(blocks: Sequence[WheelBlock], which: object) -> float:
    sizes = [blocks[at].low + blocks[at].high for at in np.asarray(which).tolist() if not blocks[at].offset]
    return max(sizes, default=0.0)


Round = WheelBlock | WheelSize
_SLACK = 1e-9  # of a radius


@dataclass(frozen=True, slots=True)
class HeightConstraint:
    """A wheel whose height (mm) is set by what stands already."""

    wheel: str
    height: float


@dataclass(frozen=True)
class WheelStack:
    """Blocks of parallel axes, and heights demanded of stacks (mm).

    up          direction in which heights grow
    near, far   least and greatest distances of axes, in the order of `labels`
    """

    up: Vector
    labels: Sequence[str]
    crowd: PlanOverlap
    gap: float
    near: Floats
    far: Floats
    demands: Mapping[int, float] = field(default_factory=dict)

    def heights(self) -> dict[str, float]:
        """Heights of upright wheels: as demanded, the rest of the tower moved with the first that is."""
        found = stack(self.crowd, self.gap)
        shift = next((height - found[at] for at, height in self.demands.items()), 0.0)
        found = {at: self.demands.get(at, height + shift) for at, height in found.items()}
        return {block.wheel: found[block.stack] + block.offset for block in self.crowd.blocks if not block.mate}

    @property
    def upright(self) -> list[WheelBlock]:
        """Wheels that turn about these axes."""
        return [block for block in self.crowd.blocks if not block.mate]

    def collisions(self, height: Mapping[str, float]) -> Iterator[tuple[str, str]]:
        """Wheels on different axes or arbors that would run into each other at their heights."""
        blocks = self.upright
        axis = np.array([block.axis for block in blocks], np.intp)
        outer = np.array([block.outer for block in blocks])
        low = np.array([height[block.wheel] - block.low for block in blocks])
        high = np.array([height[block.wheel] + block.high for block in blocks])
        level = np.triu((low[:, None] < high[None, :]) & (low[None, :] < high[:, None]), 1)
        first, second = np.nonzero(level)
        near = self.near[axis[first], axis[second]] < (outer[first] + outer[second]) * (1 - _SLACK)
        for at, to in zip(first[near].tolist(), second[near].tolist(), strict=True):
            one, other = blocks[at], blocks[to]
            ends = one.axis, other.axis
            same = one.axis == other.axis and one.link == other.link
            if not same and overlap(one, other, float(self.near[ends]), float(self.far[ends])):
                yield one.wheel, other.wheel

    def pierced(self, height: Mapping[str, float]) -> Iterator[tuple[str, str]]:
        """Arbors with the wheels they go through."""
        spans: dict[str, list[float]] = {}
        for block in self.upright:
            spans.setdefault(block.link, []).append(height[block.wheel])
        for link, plate in self.crowd.plates.items():
            spans[link].append(height[plate])
        for row, link in enumerate(self.crowd.links):
            own = spans.get(link, [])
            for at in np.nonzero(self.crowd.pierce[row])[0].tolist() if len(own) > 1 else ():
                block = self.crowd.blocks[at]
                if not block.mate and block.link != link and min(own) < height[block.wheel] < max(own):
                    yield link, block.wheel


def overlap(disc: Round, other: Round, near: float, far: float) -> bool:
    """True if two wheels at one height run into each other, their axes being between `near` and `far` (mm) apart."""
    for ring, inside in ((disc, other), (other, disc)):
        if ring.inner and far + inside.outer <= ring.inner * (1 + _SLACK):
            return False
    return near < (disc.outer + other.outer) * (1 - _SLACK)
