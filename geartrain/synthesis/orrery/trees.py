"""Trees of arbors that show all periods, every one of them up to a number of extra arbors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from geartrain.exact import times
from geartrain.synthesis.orrery.aims import ROUNDING, Aims, members
from geartrain.synthesis.orrery.table import PairRatios, reached_sets
from geartrain.synthesis.orrery.wheels import Edge

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Arbor:
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


Tree = tuple[Arbor, ...]

FIRST = Arbor(-1, -1, 1, 1, 1, 1)


def grown(tree: Tree, aim: int, parent: int, driven: int, driver: int) -> Arbor:
    """The arbor that a pair with this ratio drives from an arbor of the tree."""
    n, d = times(tree[parent].n, tree[parent].d, driven, driver)
    return Arbor(aim, parent, driven, driver, n, d)


def edges(tree: Tree) -> list[Edge]:
    """The gear pairs of a tree."""
    return [(arbor.parent, at, arbor.driven, arbor.driver) for at, arbor in enumerate(tree) if at]


class Enumeration:
    """Every tree with exactly `extra` arbors that show nothing.

    A tree grows from the first arbor. Whenever aims come into reach of an arbor, each of them is either driven from
    there or left for later arbors, and all the ways are walked. When that is settled the tree gets one more extra
    arbor. Extra arbors that have no aim in reach are tried too, as long as a further one can follow. So each tree is
    met, once for each order in which its extra arbors can be added.
    """

    def __init__(
        self, table: PairRatios, aims: Aims, extra: int, tell: Callable[[int, int], None] | None = None
    ) -> None:
        self.table, self.aims, self.extra, self.tell = table, aims, extra, tell
        self.closures = _closures(table, aims)

    def trees(self) -> Iterator[Tree]:
        """All trees."""
        yield from self._settled((FIRST,), self.aims.everything, self.extra, 0)

    def _settled(self, tree: Tree, left: int, extra: int, asked: int, blank: bool = True) -> Iterator[Tree]:
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

    def _extended(self, tree: Tree, left: int, extra: int) -> Iterator[Tree]:
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

    def _chained(self, tree: Tree, left: int, parent: int) -> Iterator[Tree]:
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


def _useful(tree: Tree) -> bool:
    """True if every arbor shows or drives something."""
    driving = {arbor.parent for arbor in tree}
    return all(arbor.aim >= 0 or at in driving for at, arbor in enumerate(tree))


def _closures(table: PairRatios, aims: Aims) -> Ints:
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
