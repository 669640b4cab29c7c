"""One path for every dial, so that all of them may be the paths of one train.

How far two ends of a train are apart is the number of added wheels on one of the two paths alone; from the input it is
the number on the path. All ends cannot be far from each other, for on a tour around the tree each added wheel is passed
twice. So the search begins with a path that is short, or with two that are near each other, whose quotients are looked
up; then only such paths of the other dials stay as go together with all that are chosen, and the dial that has the
fewest is next. Complete: every choice begins in one of these ways.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, reduce
from itertools import combinations, pairwise, product
from operator import or_
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.end_tours import (
    EndPair,
    distances,
    end_pair,
    shortest_tour,
    tours_with_one_more,
)
from geartrain.synthesis.reconstruction.path_columns import PathColumns, all_to_use
from geartrain.synthesis.reconstruction.path_lists import PathList, Rows
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem

Choice = dict[str, int]
"""By dial, the row of its list."""

_INPUT = ""
"""The end from which all paths start."""
_NEAR = 2
"""Added wheels up to which all quotients are listed."""
_SHORT = 2
"""A path with so many added wheels fewer than there are is short; if none is, few paths go together."""
_MOST_ENDS = 6
"""Dials whose tours are tried, in all orders; of more, some."""
_PIECE = 1 << 21
"""Keys that are looked up at once."""
_MOST_PAIRS = 1 << 22
"""Pairs of paths to two dials up to which all are held against each other."""
_EVEN_SHARES = 50
"""Paths from which on a part of the search may take every so manieth."""


class PathChoice:
    """All choices of one path a dial, from the lists of the dials.

    lists   by dial
    """

    def __init__(self, problem: ReconstructionProblem, lists: Mapping[str, PathList], keys: QuotientKeys) -> None:
        self.problem, self.lists, self.keys = problem, lists, keys
        self._idlers = int(problem.idlers)
        self._must = all_to_use(problem)
        self._columns = {dial: PathColumns(paths, problem) for dial, paths in lists.items()}

    def choices(self, added: int, part: int = 0, parts: int = 1) -> Iterator[Choice]:
        """All choices for trains with just so many added wheels; of several parts one."""
        self._added = added
        whole = {
            dial: _Near(rows, {_INPUT: self.lists[dial].wheels[rows].astype(np.int8)})
            for dial, rows in self._with_partners(added).items()
        }
        share = _Share(part, parts)
        if len(whole) == 1:
            ((dial, near),) = whole.items()
            near = near.kept(np.int64(self._must) & ~self._columns[dial].used[near.rows] == 0)
            yield from ({dial: row} for row in near.rows.tolist() if share.is_own())
        else:
            short = max(0, added - _SHORT)
            yield from self._from_short(short, whole, share)
            whole = {dial: near.beyond({_INPUT: short + 1}) for dial, near in whole.items()}
            yield from self._from_near(short, whole, share)

    @cache  # noqa: B019 -- lives as long as the lists
    def _with_partners(self, added: int) -> dict[str, Rows]:
        """The paths that have partners among those to each other dial, by the quotients of two alone."""
        found = {
            dial: [np.flatnonzero(paths.wheels == wheels) for wheels in range(added + 1)]
            for dial, paths in self.lists.items()
        }
        for one, other in combinations(self.lists, 2):
            if self.lists[one].dial.is_exact and self.lists[other].dial.is_exact:
                found[one], found[other] = self._partners(one, found[one], other, found[other], added)
        return {dial: np.sort(np.concatenate(groups)) for dial, groups in found.items()}

    def _partners(
        self, one: str, groups: list[Rows], other: str, others: list[Rows], added: int
    ) -> tuple[list[Rows], list[Rows]]:
        """The same for two dials, by number of added wheels."""
        some, more = ([np.zeros(len(rows), dtype=bool) for rows in each] for each in (groups, others))
        for own, another in product(range(added + 1), repeat=2):
            far = 2 * added - own - another + self._idlers
            keys = self.lists[one].wanted[groups[own]], self.lists[other].wanted[others[another]]
            first, second = self.keys.agreeing(*keys, far)
            some[own] |= first
            more[another] |= second
        return (
            [rows[good] for rows, good in zip(groups, some, strict=True)],
            [rows[good] for rows, good in zip(others, more, strict=True)],
        )

    # with what it begins

    def _from_short(self, most: int, lists: dict[str, _Near], share: _Share) -> Iterator[Choice]:
        """All choices with a path that has so few added wheels, by the one that has the fewest."""
        for wheels in range(most + 1):
            for at, (dial, near) in enumerate(lists.items()):
                others = {
                    other: some.beyond({_INPUT: wheels + (number < at)})
                    for number, (other, some) in enumerate(lists.items())
                    if other != dial
                }
                rows = near.rows[near.far[_INPUT] == wheels].tolist()
                own = share if len(rows) >= _EVEN_SHARES else None
                for row in rows:
                    if own is None or own.is_own():
                        yield from self._with(dial, row, _Chosen(), others, {}, None if own else share)

    def _from_near(self, most: int, lists: dict[str, _Near], share: _Share) -> Iterator[Choice]:
        """All choices whose paths all have more added wheels, by two that are near each other if there are any."""
        pairs = list(combinations(lists, 2))
        ends = (_INPUT, *lists)
        for far in range(2):
            for at, (one, other) in enumerate(pairs):
                least = {pair: far + (number < at) for number, pair in enumerate(pairs)}
                if self._may_close(ends, {**{(_INPUT, dial): most + 1 for dial in lists}, **least}) and share.is_own():
                    yield from self._from_pair(one, other, far, lists, least)
        least = dict.fromkeys(pairs, 2)
        if self._may_close(ends, {**{(_INPUT, dial): most + 1 for dial in lists}, **least}):
            dial = min(lists, key=lambda each: len(lists[each].rows))
            others = {other: near for other, near in lists.items() if other != dial}
            for row in lists[dial].rows.tolist():
                if share.is_own():
                    yield from self._with(dial, row, _Chosen(), others, least, None)

    def _from_pair(
        self, one: str, other: str, far: int, lists: dict[str, _Near], least: Mapping[EndPair, int]
    ) -> Iterator[Choice]:
        rest = {dial: near for dial, near in lists.items() if dial not in (one, other)}
        for row, partners in self._joined(one, lists[one].rows, other, lists[other].rows, far):
            near = _Near(partners, {_INPUT: self.lists[other].wheels[partners].astype(np.int8)})
            near = self._fitting(one, row, other, near, _Chosen(), {})
            near = near.kept(near.far[one] == far)
            if len(near.rows):
                yield from self._with(one, row, _Chosen(), {other: near, **rest}, least, None, {other: near})

    # choice after choice

    def _with(
        self,
        dial: str,
        row: int,
        chosen: _Chosen,
        lists: Mapping[str, _Near],
        least: Mapping[EndPair, int],
        share: _Share | None,
        known: Mapping[str, _Near] = MappingProxyType({}),
    ) -> Iterator[Choice]:
        """All choices with one path more.

        least   by pair of dials, how far they must be apart: what is nearer was tried
        known   lists of dials in which only paths that go with the new one are left already
        """
        paths = {**chosen.paths, dial: row}
        kept: dict[str, _Near] = dict(known)
        for other in sorted(lists, key=lambda each: len(lists[each].rows)):
            if other not in kept:
                kept[other] = self._fitting(dial, row, other, lists[other], chosen, least)
            if not len(kept[other].rows):
                return
        missing = self._missing(paths)
        if missing & ~reduce(or_, (self._reach(each, near) for each, near in kept.items()), 0):
            return
        following = min(kept, key=lambda each: len(kept[each].rows))
        near = kept.pop(following)
        if not kept:
            near = near.kept(np.int64(missing) & ~self._columns[following].used[near.rows] == 0)
        for at, next_row in enumerate(near.rows.tolist()):
            if share is not None and not share.is_own():
                continue
            if not kept:
                yield {**paths, following: next_row}
            else:
                own = {end_pair(end, following): int(each[at]) for end, each in near.far.items()}
                own |= {end_pair(_INPUT, dial): int(self.lists[dial].wheels[row])}
                after = _Chosen(paths, {**chosen.far, **own})
                yield from self._with(following, next_row, after, kept, least, None)

    def _fitting(
        self, dial: str, row: int, other: str, near: _Near, chosen: _Chosen, least: Mapping[EndPair, int]
    ) -> _Near:
        """The paths of another dial that go with one more that is chosen."""
        known = self._with_one(dial, row, other) if self._are_few(dial, other) else None
        fits = self._columns[other].fit(near.rows, self._columns[dial], row) if known is None else known[0][near.rows]
        near = near.kept(fits)
        for path in chosen.paths.items():
            near = near.kept(self._fork(path, (dial, row), other, near.rows))
        near = near.also(dial, self._apart(dial, row, other, near.rows) if known is None else known[1][near.rows])
        ends = (_INPUT, *[*chosen.paths, dial][-_MOST_ENDS:])
        wheels = int(self.lists[dial].wheels[row])
        good = self._closes(ends, {**chosen.far, (_INPUT, dial): wheels}, near)
        asked = least.get(end_pair(dial, other), 0)
        return near.kept(good & (near.far[dial] >= asked) if asked else good)

    def _are_few(self, dial: str, other: str) -> bool:
        """Whether each path to a dial may be held against all paths to another, once and for all."""
        return len(self.lists[dial]) * len(self.lists[other]) <= _MOST_PAIRS

    @cache  # noqa: B019 -- lives as long as the lists
    def _with_one(self, dial: str, row: int, other: str) -> tuple[NDArray[np.bool_], NDArray[np.int8]]:
        """By path to another dial, whether it goes with one that is chosen, and how far it is from that at least."""
        every = np.arange(len(self.lists[other]))
        return self._columns[other].fit(every, self._columns[dial], row), self._apart(dial, row, other, every)

    def _joined(self, one: str, rows: Rows, other: str, others: Rows, far: int) -> Iterator[tuple[int, Rows]]:
        """Each of some rows with those of others that go with it and are no farther from it, if there are any."""
        first, second = self.lists[one], self.lists[other]
        table = self.keys.few(far + self._idlers)
        if table is None or not (first.dial.is_exact and second.dial.is_exact):
            yield from ((row, others) for row in rows.tolist())
            return
        order = np.argsort(second.wanted[others], kind="stable")
        keys = second.wanted[others][order]
        piece = max(1, _PIECE // len(table))
        for start in range(0, len(rows), piece):
            own = rows[start : start + piece]
            at, to = _equal(keys, np.add.outer(first.wanted[own], table).ravel())
            at, to = own[at // len(table)], others[order[to]]
            fits = self._columns[other].fit(to, self._columns[one], at)
            at, to = at[fits], to[fits]
            bounds = np.flatnonzero(np.diff(at, prepend=-1, append=-1))
            yield from ((int(at[low]), to[low:high]) for low, high in pairwise(bounds.tolist()))

    # how ends go together

    def _fork(self, one: tuple[str, int], other: tuple[str, int], dial: str, rows: Rows) -> NDArray[np.bool_]:
        """Which paths part from two others as branches of a tree do: of three, two part first, and together."""
        first, second = (np.int64(self.lists[end].arbors[row]) for end, row in (one, other))
        third = self.lists[dial].arbors[rows]
        in_all = first & second & third
        on_first, on_second, apart = (first & third) == in_all, (second & third) == in_all, (first & second) == in_all
        return np.asarray((on_first & on_second) | (on_first & apart) | (on_second & apart))

    def _apart(self, end: str, row: int, dial: str, rows: Rows) -> NDArray[np.int8]:
        """How far some paths are from a chosen one, at least."""
        first, second = self.lists[end], self.lists[dial]
        own, wheels = int(first.wheels[row]), second.wheels[rows]
        if first.dial.is_exact and second.dial.is_exact:
            fewest = self._columns[dial].differing_primes(rows, self._columns[end], row)
            near = fewest <= _NEAR
            by_number = self.keys.fewest(second.wanted[rows[near]] - first.wanted[row], _NEAR)
            fewest[near] = np.maximum(fewest[near], by_number)
        else:
            (low, high), (least, greatest) = first.bounds, second.bounds
            with np.errstate(divide="ignore"):
                fewest = second.ranges.fewest((least[rows] / high[row], greatest[rows] / low[row]))
        # wheels that are shared are on both
        far = fewest + (wheels + own - fewest) % 2
        if self._idlers:  # where two paths part at an added wheel that one passes, its count matters to the other alone
            passed = self._columns[dial].passes_added[rows] | self._columns[end].passes_added[row]
            far = np.where(passed, np.maximum(fewest - 1, 0), far)
        return np.asarray(far, dtype=np.int8)

    def _closes(self, ends: Sequence[str], far: Mapping[EndPair, int], near: _Near) -> NDArray[np.bool_]:
        """For which paths a tour of some ends and theirs is short enough."""
        good = np.zeros(len(near.rows), dtype=bool)
        for one, two, rest in tours_with_one_more(len(ends), distances(ends, far)):
            good |= near.far[ends[one]].astype(np.int16) + near.far[ends[two]] + rest <= 2 * self._added
        return good

    def _may_close(self, ends: Sequence[str], far: Mapping[EndPair, int]) -> bool:
        """Whether a tour of some ends may be short enough."""
        ends = ends[: _MOST_ENDS + 1]
        return shortest_tour(len(ends), distances(ends, far)) <= 2 * self._added

    # what must be used

    def _missing(self, paths: Mapping[str, int]) -> int:
        """Bits of what must be used and is on none of some paths."""
        used = (int(self._columns[dial].used[row]) for dial, row in paths.items())
        return self._must & ~reduce(or_, used, 0)

    def _reach(self, dial: str, near: _Near) -> int:
        return int(np.bitwise_or.reduce(self._columns[dial].used[near.rows]))


@dataclass(frozen=True)
class _Chosen:
    """Paths that are chosen, by dial, and how far two ends are apart at least."""

    paths: Mapping[str, int] = field(default_factory=dict)
    far: Mapping[EndPair, int] = field(default_factory=dict)


@dataclass(frozen=True)
class _Near:
    """Paths to a dial that go with all that are chosen; by end, how far from it each is at least."""

    rows: Rows
    far: Mapping[str, NDArray[np.int8]]

    def kept(self, good: NDArray[np.bool_]) -> _Near:
        """Some of them."""
        return _Near(self.rows[good], {end: each[good] for end, each in self.far.items()})

    def also(self, end: str, far: NDArray[np.int8]) -> _Near:
        """With one end more."""
        return _Near(self.rows, {**self.far, end: far})

    def beyond(self, least: Mapping[str, int]) -> _Near:
        """Those that are so far from some ends."""
        return self.kept(reduce(np.logical_and, (self.far[end] >= number for end, number in least.items())))


def _equal(keys: NDArray[np.uint64], wanted: NDArray[np.uint64]) -> tuple[Rows, Rows]:
    """Where among wanted ones, and where among sorted keys, equal ones stand; all pairs, by the wanted ones."""
    start, end = np.searchsorted(keys, wanted), np.searchsorted(keys, wanted, side="right")
    number = end - start
    at = np.repeat(np.arange(len(wanted)), number)
    first = np.repeat(start - np.append(0, np.cumsum(number)[:-1]), number)
    return at, first + np.arange(len(at))


class _Share:
    """Deals out what is counted: every so manieth is one's own."""

    def __init__(self, part: int, parts: int) -> None:
        self.part, self.parts = part, parts
        self._number = -1

    def is_own(self) -> bool:
        """Whether the next one is."""
        self._number += 1
        return self._number % self.parts == self.part
