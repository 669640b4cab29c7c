"""Heights at which the wheels of parallel axes do not collide, and the collisions that could not be avoided.

The order of levels is found first. It is chosen so that few arbors pass through wheels and all arbors are short. The
method is a local search on keys. Each stack has a key; keys increase upwards, and stacks with equal keys share a level.
Each stack in turn is moved to its position of minimum cost. Then groups of adjacent levels are moved or reversed. This
is repeated until the cost does not decrease. With more than 80 stacks, each stack stays in the first level that fits.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.vectors import Vector
from geartrain.scene.layout.declared_geometry import DialEnds
from geartrain.scene.layout.swept_overlap import SweptDistances, WheelBlock

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Indices
    from geartrain.scene.layout.swept_overlap import Flags

_PIERCED = 1.0  # cost of an arbor that passes through a wheel
# cost of an arbor that interleaves with fixed wheels, in successive passes: a high initial cost gives worse optima
_FIXED_COSTS = (0.0, 4.0, 2.0)
_LONG = 0.02  # cost of a level that an arbor spans
_LEVEL = 0.005  # cost of a level
_PASSES = 8  # maximum number of passes over all stacks
_RUNS = (1, 2, 3, 4, 6, 8, 12, 16)  # lengths of runs of levels that are moved or reversed
_SEARCHED = 80  # maximum number of stacks for the local search


@dataclass(frozen=True)
class StackProblem:
    """Discs of the wheels on a group of parallel axes, with the conditions on their heights."""

    blocks: Sequence[WheelBlock]
    clash: Flags
    """Mask of the pairs of blocks that must not be at the same height, shape (blocks, blocks)."""
    pierce: Flags
    """Mask of the blocks that an arbor or pin would pass through at equal height, shape (links and pins, blocks)."""
    arbors: Sequence[str]
    """Links that carry wheels, in the order of the rows of `pierce`."""
    ends: Mapping[str, DialEnds]
    """Ends of the arbor of each link that extend beyond the stack to a dial, by link."""
    plates: Mapping[str, str]
    """Wheel of the carrier that carries the axis of each arbor, by arbor."""
    pins: Sequence[tuple[str, str]] = ()
    """Pairs of wheels (with the pin, with its slot), in the order of the last rows of `pierce`."""
    still: str = ""
    """Name of the fixed link. If several wheels of this link are on one axis, they form a fixed arbor."""

    @property
    def count(self) -> int:
        """Number of stacks."""
        return 1 + max((block.stack for block in self.blocks), default=-1)


class _OrderSearch:
    """Search for the order of the stacks of one problem.

    clash     for each stack, the stacks that must not share a level with it
    carried   for each arbor, the stacks of its wheels and of the wheel that carries its axis
    bearing   for each stack, the arbors of its wheels
    """

    def __init__(self, problem: StackProblem) -> None:
        self.problem, self.count = problem, problem.count
        self.stacks = np.array([block.stack for block in problem.blocks])
        rows, columns = np.nonzero(problem.clash)
        clash = np.unique(np.stack([self.stacks[rows], self.stacks[columns]]), axis=1)
        ends = np.searchsorted(clash[0], np.arange(self.count + 1))
        self.clash = [clash[1, low:high] for low, high in zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True)]
        self.carried = self._carried()
        self.bearing: list[list[int]] = [[] for _ in range(self.count)]
        for arbor, stacks in enumerate(self.carried):
            for stack in stacks:
                self.bearing[stack].append(arbor)

    def _carried(self) -> list[tuple[int, ...]]:
        problem = self.problem
        carried: dict[str, dict[int, None]] = {arbor: {} for arbor in problem.arbors}  # used as an ordered set
        for block in problem.blocks:
            if block.link in carried:
                carried[block.link][block.stack] = None
        stack_of = {block.wheel: block.stack for block in problem.blocks if not block.across}
        for arbor, plate in problem.plates.items():
            carried[arbor][stack_of[plate]] = None
        pins = [(stack_of[pin], stack_of[slot]) for pin, slot in problem.pins]
        return [*(tuple(stacks) for stacks in carried.values()), *pins]

    @cached_property
    def _fixed_stacks(self) -> dict[int, tuple[int, ...]]:
        """Stacks of the fixed wheels, which form one part, on each axis with several such stacks, by axis."""
        found: dict[int, dict[int, None]] = {}
        for block in self.problem.blocks:
            if block.link and block.link == self.problem.still and not block.across and not block.inner:
                found.setdefault(block.axis, {})[block.stack] = None
        return {axis: tuple(stacks) for axis, stacks in found.items() if len(stacks) > 1}

    def _mates(self, at: int) -> Iterator[int]:
        """Yield the stacks on the arbors of the stack `at`, including itself, once for each common arbor."""
        return (stack for arbor in self.bearing[at] for stack in self.carried[arbor])

    @cached_property
    def order(self) -> list[int]:
        """Order in which stacks are placed: most arbors first, then most arbors shared with stacks already placed."""
        score = np.array([len(arbors) for arbors in self.bearing], float)
        weight = float(score.sum()) + 1  # one shared arbor outweighs any number of others
        order: list[int] = []
        for _ in range(self.count):
            at = int(np.argmax(score))
            order.append(at)
            for mate in self._mates(at):
                score[mate] += weight
            score[at] = -np.inf
        return order

    # ------------------------------------------------------------------------------------------------ every place tried

    def local_search(self) -> Floats:
        """Return the sort key of each stack, after moving stacks and levels until no move lowers the cost."""
        keys = np.full(self.count, np.nan)
        for at in self.order:
            self._place_best(keys, at, 0.0)
        for fixed_cost in _FIXED_COSTS if self._fixed_stacks else (0.0,):
            for _ in range(_PASSES):
                before = keys.copy()
                for at in self.order:
                    self._place_best(keys, at, fixed_cost)
                keys, better = self._best_shift(keys, fixed_cost)
                if not better and np.array_equal(before, keys):
                    break
        return keys

    def _best_shift(self, keys: Floats, fixed_cost: float) -> tuple[Floats, bool]:
        """Return the best order after moving or reversing one group of adjacent levels, and True if it is better.

        fixed_cost   cost of each change between fixed and turning wheels on an axis
        """
        level = np.searchsorted(np.unique(keys), keys)
        ranks = np.concatenate(list(_shifts(int(level.max()) + 1)))[:, level].astype(float)
        costs = self._costs(ranks, fixed_cost)
        # rounded, so that ties are broken alike whatever the order of summation
        best = int(np.argmin(costs.round(9)))
        return ranks[best], bool(costs[best].round(9) < costs[0].round(9))

    def _place_best(self, keys: Floats, at: int, fixed_cost: float) -> None:
        """Move the stack `at` to its position of minimum cost: a level (integer key) or between two levels."""
        keys[at] = np.nan
        known = np.unique(keys[~np.isnan(keys)])
        if not len(known):
            keys[at] = 0.0
            return
        keys[:] = np.searchsorted(known, keys) + np.where(np.isnan(keys), np.nan, 0.0)
        free = np.ones(2 * len(known) + 1, bool)
        blocked = keys[self.clash[at]]
        free[2 * blocked[~np.isnan(blocked)].astype(np.intp) + 1] = False
        tries = (np.nonzero(free)[0] - 1) / 2
        every = np.repeat(keys[None, :], len(tries), axis=0)
        every[:, at] = tries
        # rounded as in `_best_shift`, to break ties
        keys[at] = tries[int(np.argmin(np.round(self._costs(every, fixed_cost), 9)))]

    def _costs(self, every: Floats, fixed_cost: float) -> Floats:
        """Return the costs of several orders of stacks.

        every        keys of the stacks in each order, one order per row; NaN for stacks not placed yet
        fixed_cost   cost of each change between fixed and turning wheels on an axis
        """
        keys = np.ascontiguousarray(every.T, np.float32)  # exact for small half-integers, and fast to compare
        low, high = keys[self._stack_table[0]], keys[self._stack_table[0]]  # two copies, each modified in place below
        for stacks in self._stack_table[1:]:
            low, high = np.fmin(low, keys[stacks]), np.fmax(high, keys[stacks])  # fmin and fmax ignore nan
        out_below, out_above = self._dial_arbors
        low[out_below], high[out_above] = np.nanmin(keys, axis=0), np.nanmax(keys, axis=0)
        span = np.nansum(high - low, axis=0)  # without the part to a dial, which cannot be shortened
        low[out_below] -= np.inf
        high[out_above] += np.inf
        tangled = self._interleaved(keys, low, high) + (fixed_cost * self._split_fixed(keys) if fixed_cost else 0.0)
        for core, *pipes in self._coaxial_arbors:  # the inner arbor carries its pipes, so it is at least as long
            low[core] = np.fmin(low[core], np.fmin.reduce(low[pipes]))
            high[core] = np.fmax(high[core], np.fmax.reduce(high[pipes]))
        arbor, wheel, times = self._pierced
        pierced = tangled + times @ ((keys[wheel] > low[arbor]) & (keys[wheel] < high[arbor]))
        levels = (np.diff(np.sort(keys, axis=0), axis=0) > 0).sum(axis=0)
        return np.asarray(_PIERCED * pierced + _LONG * span.astype(float) + _LEVEL * levels, float)

    def _interleaved(self, keys: NDArray[np.float32], low: NDArray[np.float32], high: NDArray[np.float32]) -> Floats:
        """Return, for each order, how many pairs of coaxial arbors overlap so that neither can be a pipe."""
        arbor, stack, starts = self._coaxial
        if not len(starts):
            return np.zeros(keys.shape[1])
        inside = (keys[stack] > low[arbor]) & (keys[stack] < high[arbor])
        covers = np.logical_or.reduceat(inside, starts, axis=0)
        return np.asarray((covers[::2] & covers[1::2]).sum(axis=0), float)

    def _split_fixed(self, keys: NDArray[np.float32]) -> Floats:
        """Return, for each order, half the number of changes between fixed wheels and the wheels of an arbor on an
        axis.

        One change per axis and arbor is free, because the arbor is then next to the fixed wheels.
        """
        found = np.zeros(keys.shape[1])
        below, above = (frozenset(each.tolist()) for each in self._dial_arbors)
        for axis, still in self._fixed_stacks.items():
            for arbor, turning in self._hubs.get(axis, {}).items():
                rows = [keys[list(still)], keys[list(turning)]]
                rows += [
                    np.full((1, keys.shape[1]), end) for end, out in ((-np.inf, below), (np.inf, above)) if arbor in out
                ]
                heights = np.concatenate(rows)
                order = np.argsort(heights, axis=0)  # nan is sorted last
                is_fixed, put = order < len(still), ~np.isnan(np.take_along_axis(heights, order, axis=0))
                turns = ((is_fixed[1:] != is_fixed[:-1]) & put[1:]).sum(axis=0)
                found += np.maximum(turns - 1, 0) / 2
        return found

    @cached_property
    def _coaxial(self) -> tuple[Indices, Indices, Indices]:
        """Arbors, stacks on other arbors of the same axis, and the first index of each ordered pair of arbors."""
        rows, starts = list[tuple[int, int]](), list[int]()
        for about in self._hubs.values():
            for one, other in combinations(about, 2):
                for arbor, beside in ((one, other), (other, one)):
                    starts.append(len(rows))
                    rows += [(arbor, stack) for stack in about[beside]]
        arbors, stacks = np.array(rows, np.intp).reshape(-1, 2).T
        return arbors, stacks, np.array(starts, np.intp)

    @cached_property
    def _hubs(self) -> dict[int, dict[int, dict[int, None]]]:
        """Stacks of the wheels on each arbor except rings: axis -> arbor -> stacks (as keys, in order)."""
        hubs: dict[int, dict[int, dict[int, None]]] = {}
        for block in self.problem.blocks:
            if block.link in self.problem.arbors and not block.across and not block.inner:
                arbor = self.problem.arbors.index(block.link)
                hubs.setdefault(block.axis, {}).setdefault(arbor, {})[block.stack] = None
        return hubs

    @cached_property
    def _coaxial_arbors(self) -> list[list[int]]:
        return [list(about) for about in self._hubs.values() if len(about) > 1]

    @cached_property
    def _stack_table(self) -> Indices:
        """Stacks of every arbor, shape (maximum number, arbors); arbors with fewer stacks repeat their first stack."""
        most = max(map(len, self.carried), default=1)
        filled = [[*stacks, *stacks[:1] * (most - len(stacks))] for stacks in self.carried]
        return np.array(filled, np.intp).reshape(-1, most).T

    @cached_property
    def _pierced(self) -> tuple[Indices, Indices, NDArray[np.float32]]:
        """Arbors, stacks with wheels that these arbors would pierce at equal height, and the numbers of such wheels."""
        times = np.zeros((len(self.carried), self.count), np.float32)
        rows, blocks = np.nonzero(self.problem.pierce)
        np.add.at(times, (rows, self.stacks[blocks]), 1.0)
        times[np.arange(len(self.carried)), self._stack_table] = 0
        arbor, stack = np.nonzero(times)
        return arbor, stack, times[arbor, stack]

    @cached_property
    def _dial_arbors(self) -> tuple[Indices, Indices]:
        """Indices of the arbors that extend beyond the low end of the stack, and beyond its high end."""
        ends = [self.problem.ends.get(arbor, DialEnds()) for arbor in self.problem.arbors]
        ends += [DialEnds()] * len(self.problem.pins)
        low, high = np.array(ends, bool).reshape(-1, 2).T
        return np.nonzero(low)[0], np.nonzero(high)[0]

    # ------------------------------------------------------------------------------------------------ too many for that

    def first_fit(self) -> Floats:
        """Return the keys of stacks, each put into the free level nearest to its mates, or into a new top level."""
        keys = np.full(self.count, np.nan)
        levels = 0
        for at in self.order:
            mates = keys[sorted(set(self._mates(at)))]
            mates = mates[~np.isnan(mates)]
            middle = float(mates.mean()) if len(mates) else 0.0
            free = np.ones(levels + 1, bool)
            blocked = keys[self.clash[at]]
            free[blocked[~np.isnan(blocked)].astype(np.intp)] = False
            open_ = np.nonzero(free[:levels])[0]
            keys[at] = open_[int(np.argmin(abs(open_ - middle)))] if len(open_) else levels
            levels = max(levels, int(keys[at]) + 1)
        return keys


def _shifts(count: int) -> Iterator[Indices]:
    """Yield new positions of the levels, shape (orders, count): unchanged, then with some levels moved or reversed."""
    rank = np.arange(count)
    yield rank[None, :]
    for length in (each for each in _RUNS if each < count):
        start, at = np.indices((count - length + 1,) * 2)[..., None]
        rest = np.where(rank < start, rank, rank - length)
        run = (rank >= start) & (rank < start + length)
        moved = np.where(run, rank - start + at, np.where(rest < at, rest, rest + length)).reshape(-1, count)
        turned = np.where(run, 2 * start + length - 1 - rank, rank)[:, 0]
        # each reversed run follows the identity of that run
        stay = np.arange(len(turned)) * (count - length + 2) + 1
        yield np.insert(moved, stay, turned, axis=0)


# -------------------------------------------------------------------------------------------------------------- heights


_SLACK = 1e-9  # relative to the radii: touching wheels must not collide due to rounding errors


def stack_heights(problem: StackProblem, gap: float) -> dict[int, float]:
    """Return the height of each stack [mm], with the lowest upright wheel at 0 and `gap` [mm] between the levels."""
    if not problem.count:
        return {}
    search = _OrderSearch(problem)
    keys = search.first_fit() if problem.count > _SEARCHED else search.local_search()
    known = np.unique(keys)
    level = np.searchsorted(known, keys)
    heights = _level_heights(problem, level, len(known), gap)
    blocks = [block for block in problem.blocks if not block.across]
    start = min((float(heights[level[block.stack]]) + block.offset for block in blocks), default=0.0)
    return {stack: float(heights[level[stack]]) - start for stack in range(len(keys))}


def _level_heights(problem: StackProblem, level: Indices, count: int, gap: float) -> Floats:
    """Return the heights of `count` levels [mm], each clear of lower levels; `level` is the level of each stack."""
    blocks = problem.blocks
    level_of = np.array([level[block.stack] for block in blocks])
    bottom = np.array([block.offset - block.low for block in blocks])
    top = np.array([block.offset + block.high for block in blocks])
    upright = np.array([not block.across for block in blocks])
    heights = np.zeros(count)
    for at in range(1, count):
        mine, below = np.nonzero(level_of == at)[0], np.nonzero(level_of < at)[0]
        need = heights[level_of[below]][:, None] + top[below][:, None] + gap - bottom[mine][None, :]
        need = np.where(problem.clash[np.ix_(below, mine)], need, -np.inf)
        last = below[upright[below] & (level_of[below] == at - 1)]
        flat = heights[at - 1] + gap + _thickest(blocks, last) / 2 + _thickest(blocks, mine[upright[mine]]) / 2
        heights[at] = max(float(need.max(initial=-np.inf)), flat)
    return heights


def _thickest(blocks: Sequence[WheelBlock], which: Indices) -> float:
    """Return the maximum thickness [mm] of the selected blocks without offset in their stack; 0 if there are none."""
    sizes = [blocks[at].low + blocks[at].high for at in which.tolist() if not blocks[at].offset]
    return max(sizes, default=0.0)


@dataclass(frozen=True)
class WheelStack:
    """Wheels of a group of parallel axes, with the problem that determines their heights."""

    up: Vector
    problem: StackProblem
    gap: float
    """Gap between levels [mm]."""
    swept: SweptDistances
    given: Mapping[int, float]
    """Height [mm] of each stack whose height is determined by parts that are already placed, by stack index."""

    def heights(self) -> dict[str, float]:
        """Return the height of each upright wheel [mm], by wheel.

        If parts that are placed earlier determine the height of a stack, all other stacks are shifted with it.
        """
        found = stack_heights(self.problem, self.gap)
        shift = next((height - found[stack] for stack, height in self.given.items()), 0.0)
        found = {stack: self.given.get(stack, height + shift) for stack, height in found.items()}
        return {block.wheel: found[block.stack] + block.offset for block in self.upright}

    @property
    def upright(self) -> list[WheelBlock]:
        """Blocks of the wheels that turn about the axes of this group."""
        return [block for block in self.problem.blocks if not block.across]

    def collisions(self, height: Mapping[str, float]) -> Iterator[tuple[str, str]]:
        """Yield pairs of wheels on different axes or arbors that collide at the given heights."""
        blocks = self.upright
        axis = np.array([block.axis for block in blocks], np.intp)
        outer = np.array([block.outer for block in blocks])
        low = np.array([height[block.wheel] - block.low for block in blocks])
        high = np.array([height[block.wheel] + block.high for block in blocks])
        level = np.triu((low[:, None] < high[None, :]) & (low[None, :] < high[:, None]), 1)
        first, second = np.nonzero(level)
        # the exact test only for pairs that are near enough
        near = self.swept.near[axis[first], axis[second]] < (outer[first] + outer[second]) * (1 - _SLACK)
        for at, to in zip(first[near].tolist(), second[near].tolist(), strict=True):
            one, other = blocks[at], blocks[to]
            same = one.axis == other.axis and one.link == other.link
            if not same and self.swept.overlap(one, one.axis, other, other.axis):
                yield one.wheel, other.wheel

    def pierced(self, height: Mapping[str, float]) -> Iterator[tuple[str, str]]:
        """Yield arbors, each with a wheel through which it passes, except the arbors of a pin and its slot."""
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
            for at in np.nonzero(self.problem.pierce[row])[0].tolist():
                block = self.problem.blocks[at]
                if frozenset((ends.get(arbor, ""), block.wheel)) in tied:
                    continue
                if not block.across and block.link != arbor and min(own) < height[block.wheel] < max(own):
                    yield arbor, block.wheel
