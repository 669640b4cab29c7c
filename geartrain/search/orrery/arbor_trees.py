"""The fewest wheels on the arbors of a tree of gear pairs: which multiples of the ratios let pairs share a wheel.

Trees of arbors that show all periods, every one of them up to a number of extra arbors.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.exact import times
from geartrain.search.orrery.pair_ratio_table import PairRatios, reached_sets
from geartrain.search.orrery.period_targets import ROUNDING, PeriodTargets, members

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


Edge = tuple[int, int, int, int]
"""One gear pair: driving arbor, driven arbor, and the ratio driven over driver in lowest terms."""
Meshes = tuple[tuple[int, int], ...]
"""Teeth (driver, driven) of each edge."""

_MOST_STEPS = 4000  # of one tree; a first complete choice is always found


def fewest_wheels(table: PairRatios, edges: Sequence[Edge]) -> tuple[int, Meshes, bool]:
    """(wheels, teeth of each pair, proved): pairs on one arbor with equal counts share one wheel there.

    A wheel may mesh with any number of others. Branch and bound over the multiples that can coincide; where its
    bound of work ends the search, the count is only an upper bound and `proved` is False.
    """
    choices = [[(driver, driven) for driven, driver in table.choices(*edge[2:])] for edge in edges]
    users: dict[tuple[int, int], int] = {}
    for edge, pairs in zip(edges, choices, strict=True):
        for pair in pairs:
            for wheel in zip(edge[:2], pair, strict=True):
                users[wheel] = users.get(wheel, 0) + 1
    options, hopes = [], []
    for (parent, child, *_), pairs in zip(edges, choices, strict=True):
        # a choice that coincides with no other pair's is as good as any other such choice
        fresh = [(users[parent, driver] == 1) + (users[child, driven] == 1) for driver, driven in pairs]
        shared = [pair for pair, new in zip(pairs, fresh, strict=True) if new < 2]
        options.append(shared or pairs[:1])
        hopes.append(min(fresh))
    rest = [sum(hopes[at:]) for at in range(len(edges) + 1)]
    return _Search(edges, options, rest).run()


class _Search:
    """Branch and bound: pairs in the order of the tree, wheels in use on each arbor."""

    def __init__(self, edges: Sequence[Edge], options: list[list[tuple[int, int]]], rest: list[int]) -> None:
        self.edges, self.options, self.rest = edges, options, rest
        self.used: Counter[tuple[int, int]] = Counter()
        self.taken: list[tuple[int, int]] = []
        self.best: tuple[int, Meshes] = (2 * len(edges) + 1, ())
        self.steps = 0

    def run(self) -> tuple[int, Meshes, bool]:
        self._descend(0, 0)
        return *self.best, self.steps <= _MOST_STEPS

    def _descend(self, at: int, wheels: int) -> None:
        if at == len(self.edges):
            if wheels < self.best[0]:
                self.best = (wheels, tuple(self.taken))
            return
        parent, child = self.edges[at][:2]
        ranked = sorted(
            (int(not self.used[parent, driver]) + int(not self.used[child, driven]), driver + driven, driver, driven)
            for driver, driven in self.options[at]
        )
        for fresh, _, driver, driven in ranked:
            self.steps += 1
            if self.steps > _MOST_STEPS and self.best[1]:
                return
            if wheels + fresh + self.rest[at + 1] >= self.best[0]:
                continue
            for wheel in ((parent, driver), (child, driven)):
                self.used[wheel] += 1
            self.taken.append((driver, driven))
            self._descend(at + 1, wheels + fresh)
            self.taken.pop()
            for wheel in ((parent, driver), (child, driven)):
                self.used[wheel] -= 1


@dataclass(frozen=True, slots=True)
class TreeArbor:
    """One arbor of a tree.

    aim             the period it shows, by number; -1: none
    parent          the arbor that drives it, by place in the tree; -1 for the first
    driven, driver  ratio of its pair in lowest terms
    n, d            its period in turns of the first arbor, in lowest terms
    """

    aim: int
    parent: int
    driven: int
    driver: int
    n: int
    d: int

    @property
    def period(self) -> Fraction:
        """Turns of the first arbor in one of this."""
        return Fraction(self.n, self.d)

    @property
    def log(self) -> float:
        """Natural logarithm of the period."""
        return math.log(self.n) - math.log(self.d)


ArborTree = tuple[TreeArbor, ...]

FIRST = TreeArbor(-1, -1, 1, 1, 1, 1)


def grown(tree: ArborTree, aim: int, parent: int, driven: int, driver: int) -> TreeArbor:
    """The arbor that a pair with this ratio drives from an arbor of the tree."""
    n, d = times(tree[parent].n, tree[parent].d, driven, driver)
    return TreeArbor(aim, parent, driven, driver, n, d)


def edges(tree: ArborTree) -> list[Edge]:
    """The gear pairs of a tree."""
    return [(arbor.parent, at, arbor.driven, arbor.driver) for at, arbor in enumerate(tree) if at]


class TreeEnumeration:
    """Every tree with exactly `extra` arbors that show nothing.

    A tree grows from the first arbor. Whenever aims come into reach of an arbor, each of them is either driven from
    there or left for later arbors, and all the ways are walked. When that is settled the tree gets one more extra
    arbor. Extra arbors that have no aim in reach are tried too, as long as a further one can follow. So each tree is
    met, once for each order in which its extra arbors can be added.
    """

    def __init__(
        self, table: PairRatios, aims: PeriodTargets, extra: int, tell: Callable[[int, int], None] | None = None
    ) -> None:
        self.table, self.aims, self.extra, self.tell = table, aims, extra, tell
        self.closures = _closures(table, aims)

    def trees(self) -> Iterator[ArborTree]:
        """All trees."""
        yield from self._settled((FIRST,), self.aims.everything, self.extra, 0)

    def _settled(self, tree: ArborTree, left: int, extra: int, asked: int, blank: bool = True) -> Iterator[ArborTree]:
        """Ways to drive aims from the arbors from place `asked` on; earlier arbors have been asked already.

        Unless `blank`, the first arbor asked drives at least one.
        """
        if asked == len(tree):
            if left:
                yield from self._extended(tree, left, extra)
            elif not extra and _useful(tree):
                yield tree
            return
        from_here = []
        for aim in members(left):
            low, high = self.aims.bounds[aim]
            period = tree[asked].period
            found = self.table.between(low / period, high / period)
            if found:
                from_here.append([None, *(grown(tree, aim, asked, *self.table.terms(at)) for at in found)])
        for taken in product(*from_here):
            arbors = tuple(arbor for arbor in taken if arbor is not None)
            if not arbors and not blank:
                continue
            rest = left & ~sum(1 << arbor.aim for arbor in arbors)
            yield from self._settled(tree + arbors, rest, extra, asked + 1)

    def _extended(self, tree: ArborTree, left: int, extra: int) -> Iterator[ArborTree]:
        """One more extra arbor on any arbor of the tree."""
        if not extra:
            return
        for parent, arbor in enumerate(tree):
            ways: Sequence[int] = range(len(self.table))
            if extra <= 2:
                sets = reached_sets(self.table, self.aims, arbor.log, left)
                good = self.closures[sets] & left == left if extra == 1 else sets > 0
                ways = np.flatnonzero(good).tolist()
            for done, at in enumerate(ways):
                if self.tell and extra == self.extra:
                    self.tell(parent * len(ways) + done, len(tree) * len(ways))
                new = grown(tree, -1, parent, *self.table.terms(at))
                yield from self._settled((*tree, new), left, extra - 1, len(tree), blank=extra > 2)
            if extra == 2:
                yield from self._chained(tree, left, parent)

    def _chained(self, tree: ArborTree, left: int, parent: int) -> Iterator[ArborTree]:
        """The last two extra arbors in a chain, the first of them driving the second and nothing else.

        The second is looked for from the aims: it drives one of them, and whatever it does not drive can be reached
        from those it does.
        """
        low, high = self._ends(left)
        logs, start = self.table.logs, tree[parent].log
        seen: set[tuple[int, int]] = set()
        for least, most in zip(low - start, high - start, strict=True):
            first = np.searchsorted(logs, least - logs - ROUNDING)
            last = np.searchsorted(logs, most - logs + ROUNDING)
            for one in np.flatnonzero(last > first).tolist():
                seen.update((one, two) for two in range(first[one], last[one]))
        for one, two in sorted(seen):
            inner = (*tree, grown(tree, -1, parent, *self.table.terms(one)))
            outer = (*inner, grown(inner, -1, len(tree), *self.table.terms(two)))
            yield from self._settled(outer, left, 0, len(inner))

    def _ends(self, left: int) -> tuple[Floats, Floats]:
        """Logarithms between which the period of an arbor lies from which all aims left can be reached, with excess."""
        logs, ranges = self.table.logs, []
        for aim in members(left):
            low, high = self.aims.logs[aim][0] - logs, self.aims.logs[aim][1] - logs
            sets = np.full(len(logs), 1 << aim)
            for other in members(left & ~(1 << aim)):
                least, most = self.aims.logs[other][0] - high, self.aims.logs[other][1] - low
                found = np.searchsorted(logs, most + ROUNDING) > np.searchsorted(logs, least - ROUNDING)
                sets |= found.astype(np.int64) << other
            good = self.closures[sets] & left == left
            ranges.append((low[good], high[good]))
        lows, highs = (np.concatenate(part) for part in zip(*ranges, strict=True))
        return lows, highs


def _useful(tree: ArborTree) -> bool:
    """True if every arbor shows or drives something."""
    driving = {arbor.parent for arbor in tree}
    return all(arbor.aim >= 0 or at in driving for at, arbor in enumerate(tree))


def _closures(table: PairRatios, aims: PeriodTargets) -> Ints:
    """For each set of aims, those that single pairs can reach from them, and from these, and so on; the set included.

    An aim's arbor lies anywhere within its tolerance, so this is never too few.
    """
    beside = []
    for low, high in aims.bounds:
        near = (bool(table.between(other_low / high, other_high / low)) for other_low, other_high in aims.bounds)
        beside.append(sum(yes << at for at, yes in enumerate(near)))
    found = np.zeros(aims.everything + 1, dtype=np.int64)
    for start in range(1, aims.everything + 1):
        bits, before = start, 0
        while bits != before:
            before = bits
            for aim in members(before):
                bits |= beside[aim]
        found[start] = bits
    return found
