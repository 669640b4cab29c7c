"""Levels: wheels stacked along their common direction, so that none stands in another's way."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Flags = NDArray[np.bool_]

_PIERCED = 1.0  # cost of an arbor that goes through a wheel
_LONG = 0.02  # of a level that an arbor spans
_LEVEL = 0.005  # of a level used
_PASSES = 8
_LENGTHS = (1, 2, 3, 4, 6, 8, 12, 16)  # of runs of levels that are moved together
_SEARCHED = 80  # stacks up to which every place is tried


@dataclass(frozen=True, slots=True)
class Block:
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
class Crowd:
    """What stands in whose way, in plan.

    blocks  wheels
    clash   (blocks, blocks): two that must not share a height
    pierce  (links, blocks): wheels that an arbor would go through at their height
    links   names of arbors; `ends`, whether each runs out of the stack at its low or high end, to a dial
    plates  the wheel on which the axis of an arbor is carried round
    """

    blocks: Sequence[Block]
    clash: Flags
    pierce: Flags
    links: Sequence[str]
    ends: Mapping[str, tuple[bool, bool]]
    plates: Mapping[str, str]


def stack(crowd: Crowd, gap: float) -> dict[int, float]:
    """Height of each stack (mm), the lowest upright wheel of all at 0."""
    count = 1 + max((block.stack for block in crowd.blocks), default=-1)
    if not count:
        return {}
    levels = _Levels(crowd, count)
    return _heights(crowd, levels.found(), gap)


class _Levels:
    """Order of stacks. Keys grow upwards; stacks with one key share a level."""

    def __init__(self, crowd: Crowd, count: int) -> None:
        self.crowd, self.count = crowd, count
        self.stacks = np.array([block.stack for block in crowd.blocks])
        self.clash = np.zeros((count, count), bool)
        rows, columns = np.nonzero(crowd.clash)
        self.clash[self.stacks[rows], self.stacks[columns]] = True
        np.fill_diagonal(self.clash, False)
        number = {link: at for at, link in enumerate(crowd.links)}
        self.arbors = np.zeros((len(crowd.links), count), bool)
        for block in crowd.blocks:
            if block.link in number:
                self.arbors[number[block.link], block.stack] = True
        at_wheel = {block.wheel: block.stack for block in crowd.blocks if not block.mate}
        for link, plate in crowd.plates.items():
            self.arbors[number[link], at_wheel[plate]] = True
        self.pierce = np.zeros((len(crowd.links), count))
        for stack_ in range(count):
            self.pierce[:, stack_] = crowd.pierce[:, self.stacks == stack_].sum(axis=1)
        self.pierce[self.arbors] = 0
        self.down, self.up = (
            np.array([crowd.ends.get(link, (False, False))[end] for link in crowd.links], bool) for end in (0, 1)
        )

    def found(self) -> Floats:
        """A key for each stack."""
        keys = np.full(self.count, np.nan)
        order = self._order()
        if self.count > _SEARCHED:
            return self._first_fit(order)
        for at in order:
            self._settle(keys, at)
        for _ in range(_PASSES):
            before = keys.copy()
            for at in order:
                self._settle(keys, at)
            keys, better = self._shifted(keys)
            if not better and np.array_equal(before, keys):
                break
        return keys

    def _shifted(self, keys: Floats) -> tuple[Floats, bool]:
        """Some levels together moved past others, or turned over, where that costs less."""
        level = np.searchsorted(np.unique(keys), keys)
        count = int(level.max()) + 1
        orders = [list(range(count))]
        for length in (each for each in _LENGTHS if each < count):
            for start in range(count - length + 1):
                part = orders[0][start : start + length]
                rest = orders[0][:start] + orders[0][start + length :]
                for at in range(len(rest) + 1):
                    orders += [
                        rest[:at] + some + rest[at:] for some in ((part, part[::-1]) if at == start else (part,))
                    ]
        ranks = np.argsort(np.array(orders), axis=1).astype(float)[:, level]
        costs = np.concatenate([self._costs(ranks[at : at + 500]) for at in range(0, len(ranks), 500)]).round(9)
        best = int(np.argmin(costs))
        return ranks[best], bool(costs[best] < costs[0])

    def _order(self) -> list[int]:
        """From the stack with most arbors on, always one that shares an arbor with those before."""
        floats = self.arbors.astype(np.float32)
        shared = floats.T @ floats
        score = self.arbors.sum(axis=0).astype(float)
        weight = float(score.sum()) + 1
        order: list[int] = []
        for _ in range(self.count):
            at = int(np.argmax(score))
            order.append(at)
            score += weight * shared[at]
            score[at] = -np.inf
        return order

    def _settle(self, keys: Floats, at: int) -> None:
        """Put one stack where it costs least: in a level, or between two."""
        keys[at] = np.nan
        known = np.unique(keys[~np.isnan(keys)])
        if not len(known):
            keys[at] = 0.0
            return
        keys[:] = np.searchsorted(known, keys) + np.where(np.isnan(keys), np.nan, 0.0)
        tries = np.arange(-1, 2 * len(known)) / 2
        blocked = keys[self.clash[at] & ~np.isnan(keys)]
        tries = tries[~np.isin(tries, blocked)]
        every = np.repeat(keys[None, :], len(tries), axis=0)
        every[:, at] = tries
        keys[at] = tries[int(np.argmin(np.round(self._costs(every), 9)))]

    def _costs(self, every: Floats) -> Floats:
        """Costs of several orders of the same stacks, a row each; stacks not yet put in are nan."""
        placed = ~np.isnan(every[0])
        keys, arbors = every[:, placed], self.arbors[:, placed]
        used = (arbors.sum(axis=1) > 1) | (arbors.any(axis=1) & (self.down | self.up))
        arbors = arbors[used]
        low = np.where(arbors, keys[:, None, :], np.inf).min(axis=2)
        high = np.where(arbors, keys[:, None, :], -np.inf).max(axis=2)
        span = (high - low).sum(axis=1)
        low[:, self.down[used]], high[:, self.up[used]] = -np.inf, np.inf
        between = (keys[:, None, :] > low[:, :, None]) & (keys[:, None, :] < high[:, :, None])
        pierced = np.einsum("tls,ls->t", between, self.pierce[np.ix_(used, placed)])
        levels = 1 + (np.diff(np.sort(keys, axis=1), axis=1) > 0).sum(axis=1)
        return np.asarray(_PIERCED * pierced + _LONG * span + _LEVEL * levels, float)

    def _first_fit(self, order: Sequence[int]) -> Floats:
        """Each stack in the level nearest to those it shares arbors with that is free; else in a new one on top."""
        keys = np.full(self.count, np.nan)
        shared = (self.arbors.T.astype(np.float32) @ self.arbors) > 0
        for at in order:
            known = np.unique(keys[~np.isnan(keys)])
            mates = keys[shared[at] & ~np.isnan(keys)]
            middle = float(mates.mean()) if len(mates) else 0.0
            near = sorted(known.tolist(), key=lambda key: (abs(key - middle), key))
            blocked = set(keys[self.clash[at] & ~np.isnan(keys)].tolist())
            keys[at] = next((key for key in near if key not in blocked), len(known))
        return keys


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
