"""The fewest wheels on the arbors of a tree of gear pairs: which multiples of the ratios let pairs share a wheel."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from geartrain.synthesis.orrery.table import PairRatios

Edge = tuple[int, int, int, int]
"""One gear pair: driving arbor, driven arbor, and the ratio driven over driver in lowest terms."""
Meshes = tuple[tuple[int, int], ...]
"""Teeth (driver, driven) of each edge."""

_MOST_STEPS = 4000


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
