"""Backtracking search for one path to every dial, such that all of them are paths of one train.

A hash join on quotients finds pairs of paths, bit masks represent shared arbors and wheels, and the length of the
shortest tour of the dials is the lower bound that prunes branches.

The distance between two dials is the number of added wheels on exactly one of their paths; the distance of a dial from
the input is the number on its path. A tour around the tree passes each added wheel twice, so not all distances can be
large. The search therefore begins with a short path, or with two paths at a small distance, whose quotients are looked
up in a table. Then only paths of the other dials remain that are compatible with all chosen ones, and the dial with the
fewest paths is next. The search is complete, because every choice begins in one of these ways.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, lru_cache, reduce
from itertools import combinations, pairwise, permutations, product
from operator import or_
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from geartrain.search.reconstruct.path_lists import PathList, Rows, seen_clusters
from geartrain.search.reconstruct.quotient_keys import QuotientKeys
from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem
from geartrain.search.reconstruct.train_topology import ADDED, ArborPass

# Tours of the ends of a train, from the input past the dials and back: each added wheel is passed twice.


EndPair = tuple[str, str]
"""Names of two ends of paths, sorted. An end is a dial or the input."""


def end_pair(one: str, other: str) -> EndPair:
    """Return two ends as a sorted pair."""
    return (one, other) if one < other else (other, one)


def distances(ends: Sequence[str], far: Mapping[EndPair, int]) -> tuple[int, ...]:
    """Return the distance matrix of the ends, row by row, with 0 for unknown distances."""
    return tuple(far.get(end_pair(one, two), 0) for one in ends for two in ends)


@lru_cache(maxsize=1 << 16)
def shortest_tour(number: int, far: tuple[int, ...]) -> int:
    """Return the minimum length of a closed tour through all ends, from their distance matrix."""
    return min(far[one * number + two] + rest for one, two, rest in tours_with_one_more(number, far))


@lru_cache(maxsize=1 << 16)
def tours_with_one_more(number: int, far: tuple[int, ...]) -> tuple[tuple[int, int, int], ...]:
    """Return pairs of ends between which one more end is inserted, each with the minimum length of the rest of the
    tour.
    """
    orders, first, pairs = _orders(number)
    lengths = np.array(far, dtype=np.int64)[orders].sum(axis=1)
    minimum = np.minimum.reduceat(lengths, first)
    return tuple((one, two, rest) for (one, two), rest in zip(pairs, minimum.tolist(), strict=True))


@lru_cache(maxsize=16)
def _orders(number: int) -> tuple[NDArray[np.int64], NDArray[np.int64], tuple[tuple[int, int], ...]]:
    """Return all orders of ends up to reversal, grouped by their first and last end.

    The result has the steps of each order as indices into a distance matrix, the start of each group, and the first and
    last end of each group.
    """
    orders = [order for order in permutations(range(number)) if order[0] <= order[-1]]
    orders.sort(key=lambda order: (order[0], order[-1]))
    ends = np.array([(order[0], order[-1]) for order in orders])
    first = np.flatnonzero((np.diff(ends, axis=0, prepend=-1) != 0).any(axis=1))
    whole = np.array(orders)
    pairs = tuple((int(one), int(two)) for one, two in ends[first])
    return whole[:, :-1] * number + whole[:, 1:], first, pairs


# Columns of a path list that are compared with a path to another dial, as arrays for speed.


_NEVER = 100
"""Distance between two paths that differ by a prime larger than every tooth count, so that they are incompatible."""


class PathColumns:
    """Columns of a path list for fast comparison of many paths with a path to another dial.

    powers         large prime -> its power in the quotient of the added wheels, for each row
    codes          code of the pass, 0 if the arbor is avoided, shape (arbors, rows)
    driven         number of the driven wheel with its count, 0 if absent, shape (arbors, rows)
    driver         number of the driving wheel by name, 0 if absent, shape (arbors, rows)
    ends           bit of the surviving arbor that shows the dial, for each row
    passes_added   True if the path has an added idler
    used           bit mask of the used surviving arbors, then wheels, for each row
    """

    def __init__(self, paths: PathList, problem: ReconstructionProblem) -> None:
        self.paths = paths
        self._clusters = [sum(1 << at - 1 for at in each) for each in seen_clusters(problem) if 0 not in each]
        names = [wheel.name for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels]
        number = {name: at for at, name in enumerate(names, 1)}  # 0 means no surviving wheel
        # one row per arbor, because an arbor is compared for many paths at once
        self.codes = np.ascontiguousarray(paths.codes.T)
        self.powers = {prime: np.ascontiguousarray(paths.powers[:, at]) for at, prime in enumerate(paths.primes)}
        self.driven = np.zeros(self.codes.shape, dtype=np.int16)
        self.driver = np.zeros(self.codes.shape, dtype=np.int16)
        self.used = paths.arbors.copy()
        self.ends = np.zeros(len(paths), dtype=np.int64)
        self.passes_added = paths.idlers > 0
        for at, passes in enumerate(paths.passes):
            taken = self.codes[at]
            # the numbers of driven wheels are the same in the lists of all dials
            driven = sorted({each.driven for each in passes}, key=repr)
            self.driven[at] = np.array([0, *(1 + driven.index(each.driven) for each in passes)], dtype=np.int16)[taken]
            drivers = [0, *(number.get((each.driver and each.driver.name) or "", 0) for each in passes)]
            self.driver[at] = np.array(drivers, dtype=np.int16)[taken]
            wheels = [0, *(_bits(each, number) << len(problem.arbors) for each in passes)]
            self.used |= np.array(wheels, dtype=np.int64)[taken]
            self.passes_added |= np.array([False, *(each.idler and each.driven == ADDED for each in passes)])[taken]
            if at:
                last = np.array([False, *(each.driver is None for each in passes)])
                self.ends |= np.where(last[taken], np.int64(1) << (at - 1), 0)

    def fit(self, rows: Rows, other: PathColumns, row: int | Rows) -> NDArray[np.bool_]:
        """Return whether each path can be in one tree with a path to another dial, or with one of several paths.

        Two paths may leave only the arbor at which they separate by different wheels, and must enter every shared arbor
        by the same wheel. A wheel has one count. Paths that separate at the input share no other arbor.
        """
        both: Rows = np.asarray(self.paths.arbors[rows] & other.paths.arbors[row])
        good = self._end_in(rows, both, other, row)
        mine, theirs = self.paths.arbors[rows], other.paths.arbors[row]
        for cluster in self._clusters:  # all paths to a component pass through its topmost arbor
            good &= (both & cluster != 0) | (mine & cluster == 0) | (theirs & cluster == 0)
        parted = np.zeros(len(rows), dtype=np.int8)
        one = isinstance(row, int)
        for at in np.flatnonzero(other.codes[:, row]).tolist() if one else range(len(self.codes)):
            codes, others = self.codes[at][rows], other.codes[at, row]
            shared = codes > 0 if one else (codes > 0) & (others > 0)
            left = shared & (codes != others)
            parted += left
            good &= ~(shared & (self.driven[at][rows] != other.driven[at, row]))
            driver = other.driver[at, row]
            if not one or driver:
                good &= ~(left & (self.driver[at][rows] == driver) & (driver > 0))
            if not at:
                good &= ~left | (both == 0)
        return good & (parted <= 1)

    def differing_primes(self, rows: Rows, other: PathColumns, row: int) -> NDArray[np.int8]:
        """Return a lower bound of the number of wheels with a large prime that only one of two paths has."""
        found = np.zeros(len(rows), dtype=np.int16)
        for prime in self.powers.keys() | other.powers.keys():
            own = self.powers[prime][rows] if prime in self.powers else np.int8(0)
            theirs = other.powers[prime][row] if prime in other.powers else np.int8(0)
            differ = np.abs(own - theirs)
            found += differ if prime <= self.paths.problem.additions.maximum else differ * np.int16(_NEVER)
        return np.minimum(found, _NEVER).astype(np.int8)

    def _end_in(self, rows: Rows, both: Rows, other: PathColumns, row: int | Rows) -> NDArray[np.bool_]:
        """Return for each path whether the path that ends at an arbor of the other path, if any, is a part of the
        other path.
        """
        mine, theirs = self.paths, other.paths
        ends, their_end = (self.ends[rows] & both) != 0, (other.ends[row] & both) != 0
        compounds = mine.compounds[rows] - theirs.compounds[row]
        idlers = mine.idlers[rows] - theirs.idlers[row]
        good = ~ends | ((both == mine.arbors[rows]) & (compounds <= 0) & (idlers <= 0))
        good &= ~their_end | ((both == theirs.arbors[row]) & (compounds >= 0) & (idlers >= 0))
        return np.asarray(good)


def all_to_use(problem: ReconstructionProblem) -> int:
    """Return the bit mask of surviving arbors and wheels that must be used, as in `PathColumns.used`."""
    if problem.use == "some":
        return 0
    arbors = (1 << len(problem.arbors)) - 1
    if problem.use == "arbors":
        return arbors
    wheels = sum(len(each.wheels) for each in (problem.input, *problem.arbors))
    return arbors | ((1 << wheels) - 1) << len(problem.arbors)


def _bits(each: ArborPass, number: dict[str, int]) -> int:
    found = 0
    for wheel in (each.driven, each.driver):
        if wheel is not None and wheel.name in number:
            found |= 1 << (number[wheel.name] - 1)
    return found


Choice = dict[str, int]
"""Row of the path list of each dial."""

_INPUT = ""
"""Name of the input as an end of all paths."""
_NEAR = 2
"""Maximum number of added wheels whose quotients are all tabulated."""
_SHORT = 2
"""Difference between the number of added wheels of the train and of a short path, with which few other paths
are compatible.
"""
_MOST_ENDS = 6
"""Maximum number of dials in tours, which are tried in all orders. Further dials are ignored."""
_PIECE = 1 << 21
"""Number of keys that are looked up at once."""
_MOST_PAIRS = 1 << 22
"""Maximum number of pairs of paths to two dials that are all compared in advance."""
_EVEN_SHARES = 50
"""Minimum number of paths that are distributed in turn over the parts of a search."""


class PathChoice:
    """Enumeration of all compatible choices of one path per dial.

    lists   list of the paths to each dial
    """

    def __init__(self, problem: ReconstructionProblem, lists: Mapping[str, PathList], keys: QuotientKeys) -> None:
        self.problem, self.lists, self.keys = problem, lists, keys
        self._idlers = int(problem.idlers)
        self._must = all_to_use(problem)
        self._columns = {dial: PathColumns(paths, problem) for dial, paths in lists.items()}

    def choices(self, added: int, part: int = 0, parts: int = 1) -> Iterator[Choice]:
        """Yield all choices for trains with exactly `added` added wheels that belong to part number `part` of
        `parts`.
        """
        self._added = added
        whole = {
            dial: _Compatible(rows, {_INPUT: self.lists[dial].wheels[rows].astype(np.int8)})
            for dial, rows in self._with_partners(added).items()
        }
        share = _RoundRobin(part, parts)
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
        """Return the paths of each dial whose quotient is compatible with some path of each other dial."""
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
        some, more = ([np.zeros(len(rows), dtype=bool) for rows in each] for each in (groups, others))
        for own, another in product(range(added + 1), repeat=2):
            # s shared wheels give own + another - s <= added, and own + another - 2 s wheels on one path only
            far = 2 * added - own - another + self._idlers
            keys = self.lists[one].wanted[groups[own]], self.lists[other].wanted[others[another]]
            first, second = self.keys.agreeing(*keys, far)
            some[own] |= first
            more[another] |= second
        return (
            [rows[good] for rows, good in zip(groups, some, strict=True)],
            [rows[good] for rows, good in zip(others, more, strict=True)],
        )

    # first choices

    def _from_short(self, most: int, lists: dict[str, _Compatible], share: _RoundRobin) -> Iterator[Choice]:
        """Yield all choices that include a path of at most `most` added wheels, beginning with its shortest path."""
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
                        yield from self._extended(dial, row, _Chosen(), others, {}, None if own else share)

    def _from_near(self, most: int, lists: dict[str, _Compatible], share: _RoundRobin) -> Iterator[Choice]:
        """Yield all choices without a short path, beginning with two paths at a small distance if there are any."""
        pairs = list(combinations(lists, 2))
        ends = (_INPUT, *lists)
        for far in range(2):
            for at, (one, other) in enumerate(pairs):
                minimum = {pair: far + (number < at) for number, pair in enumerate(pairs)}
                if (
                    self._may_close(ends, {**{(_INPUT, dial): most + 1 for dial in lists}, **minimum})
                    and share.is_own()
                ):
                    yield from self._from_pair(one, other, far, lists, minimum)
        minimum = dict.fromkeys(pairs, 2)
        if self._may_close(ends, {**{(_INPUT, dial): most + 1 for dial in lists}, **minimum}):
            dial = min(lists, key=lambda each: len(lists[each].rows))
            others = {other: near for other, near in lists.items() if other != dial}
            for row in lists[dial].rows.tolist():
                if share.is_own():
                    yield from self._extended(dial, row, _Chosen(), others, minimum, None)

    def _from_pair(
        self, one: str, other: str, far: int, lists: dict[str, _Compatible], minimum: Mapping[EndPair, int]
    ) -> Iterator[Choice]:
        rest = {dial: near for dial, near in lists.items() if dial not in (one, other)}
        for row, partners in self._join(one, lists[one].rows, other, lists[other].rows, far):
            near = _Compatible(partners, {_INPUT: self.lists[other].wheels[partners].astype(np.int8)})
            near = self._fitting(one, row, other, near, _Chosen(), {})
            near = near.kept(near.far[one] == far)
            if len(near.rows):
                yield from self._extended(one, row, _Chosen(), {other: near, **rest}, minimum, None, {other: near})

    # further choices

    def _extended(
        self,
        dial: str,
        row: int,
        chosen: _Chosen,
        lists: Mapping[str, _Compatible],
        minimum: Mapping[EndPair, int],
        share: _RoundRobin | None,
        known: Mapping[str, _Compatible] = MappingProxyType({}),
    ) -> Iterator[Choice]:
        """Yield all choices that extend the chosen paths by one more path.

        minimum   minimum distance of each pair of dials; smaller distances were searched before
        known     lists of dials that are already restricted to paths compatible with the new path
        """
        paths = {**chosen.paths, dial: row}
        kept: dict[str, _Compatible] = dict(known)
        for other in sorted(lists, key=lambda each: len(lists[each].rows)):
            if other not in kept:
                kept[other] = self._fitting(dial, row, other, lists[other], chosen, minimum)
            if not len(kept[other].rows):
                return
        missing = self._missing(paths)
        # a part that must be used is on no remaining path
        if missing & ~reduce(or_, (self._reach(each, near) for each, near in kept.items()), 0):
            return
        following = min(kept, key=lambda each: len(kept[each].rows))  # most constrained dial first
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
                yield from self._extended(following, next_row, after, kept, minimum, None)

    def _fitting(
        self, dial: str, row: int, other: str, near: _Compatible, chosen: _Chosen, minimum: Mapping[EndPair, int]
    ) -> _Compatible:
        """Return the paths to another dial that are compatible with one more chosen path."""
        known = self._compared(dial, row, other) if self._are_few(dial, other) else None
        fits = self._columns[other].fit(near.rows, self._columns[dial], row) if known is None else known[0][near.rows]
        near = near.kept(fits)
        for path in chosen.paths.items():
            near = near.kept(self._fork(path, (dial, row), other, near.rows))
        near = near.also(dial, self._apart(dial, row, other, near.rows) if known is None else known[1][near.rows])
        ends = (_INPUT, *[*chosen.paths, dial][-_MOST_ENDS:])
        wheels = int(self.lists[dial].wheels[row])
        good = self._closes(ends, {**chosen.far, (_INPUT, dial): wheels}, near)
        requested = minimum.get(end_pair(dial, other), 0)
        return near.kept(good & (near.far[dial] >= requested) if requested else good)

    def _are_few(self, dial: str, other: str) -> bool:
        """Return whether all pairs of paths to two dials may be compared in advance."""
        return len(self.lists[dial]) * len(self.lists[other]) <= _MOST_PAIRS

    @cache  # noqa: B019 -- lives as long as the lists
    def _compared(self, dial: str, row: int, other: str) -> tuple[NDArray[np.bool_], NDArray[np.int8]]:
        """Return the compatibility and the minimum distance of all paths to another dial with a chosen path."""
        every = np.arange(len(self.lists[other]))
        return self._columns[other].fit(every, self._columns[dial], row), self._apart(dial, row, other, every)

    def _join(self, one: str, rows: Rows, other: str, others: Rows, far: int) -> Iterator[tuple[int, Rows]]:
        """Yield each row of one dial with the compatible rows of another within a distance, by a hash join."""
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
            at, to = _equal_pairs(keys, np.add.outer(first.wanted[own], table).ravel())
            at, to = own[at // len(table)], others[order[to]]
            fits = self._columns[other].fit(to, self._columns[one], at)
            at, to = at[fits], to[fits]
            bounds = np.flatnonzero(np.diff(at, prepend=-1, append=-1))
            yield from ((int(at[low]), to[low:high]) for low, high in pairwise(bounds.tolist()))

    # compatibility of ends

    def _fork(self, one: tuple[str, int], other: tuple[str, int], dial: str, rows: Rows) -> NDArray[np.bool_]:
        """Return whether each path forms a tree with two chosen paths: of the three, two must separate from the third
        together.
        """
        first, second = (np.int64(self.lists[end].arbors[row]) for end, row in (one, other))
        third = self.lists[dial].arbors[rows]
        in_all = first & second & third
        on_first, on_second, apart = (first & third) == in_all, (second & third) == in_all, (first & second) == in_all
        return np.asarray((on_first & on_second) | (on_first & apart) | (on_second & apart))

    def _apart(self, end: str, row: int, dial: str, rows: Rows) -> NDArray[np.int8]:
        """Return a lower bound of the distance of each path from a chosen path."""
        first, second = self.lists[end], self.lists[dial]
        own, wheels = int(first.wheels[row]), second.wheels[rows]
        if first.dial.is_exact and second.dial.is_exact:
            fewest = self._columns[dial].differing_primes(rows, self._columns[end], row)
            near = fewest <= _NEAR
            by_number = self.keys.fewest(second.wanted[rows[near]] - first.wanted[row], _NEAR)
            fewest[near] = np.maximum(fewest[near], by_number)
        else:
            (low, high), (minimum, maximum) = first.bounds, second.bounds
            with np.errstate(divide="ignore"):
                fewest = second.ranges.fewest((minimum[rows] / high[row], maximum[rows] / low[row]))
        # shared wheels are on both paths, so the distance has the parity of the sum
        far = fewest + (wheels + own - fewest) % 2
        if self._idlers:  # the count of an added idler at which paths separate affects only one of them
            passed = self._columns[dial].passes_added[rows] | self._columns[end].passes_added[row]
            far = np.where(passed, np.maximum(fewest - 1, 0), far)
        return np.asarray(far, dtype=np.int8)

    def _closes(self, ends: Sequence[str], far: Mapping[EndPair, int], near: _Compatible) -> NDArray[np.bool_]:
        """Return for each path whether a tour of some ends and its own end is short enough."""
        good = np.zeros(len(near.rows), dtype=bool)
        for one, two, rest in tours_with_one_more(len(ends), distances(ends, far)):
            good |= near.far[ends[one]].astype(np.int16) + near.far[ends[two]] + rest <= 2 * self._added
        return good

    def _may_close(self, ends: Sequence[str], far: Mapping[EndPair, int]) -> bool:
        ends = ends[: _MOST_ENDS + 1]
        return shortest_tour(len(ends), distances(ends, far)) <= 2 * self._added

    # surviving wheels that must be used

    def _missing(self, paths: Mapping[str, int]) -> int:
        """Return the bit mask of the arbors and wheels that must be used and are on none of the paths."""
        used = (int(self._columns[dial].used[row]) for dial, row in paths.items())
        return self._must & ~reduce(or_, used, 0)

    def _reach(self, dial: str, near: _Compatible) -> int:
        return int(np.bitwise_or.reduce(self._columns[dial].used[near.rows]))


@dataclass(frozen=True)
class _Chosen:
    """Chosen path of each dial, and lower bounds of the distance of each pair of ends."""

    paths: Mapping[str, int] = field(default_factory=dict)
    far: Mapping[EndPair, int] = field(default_factory=dict)


@dataclass(frozen=True)
class _Compatible:
    """Paths to a dial that are compatible with all chosen paths, with lower bounds of their distances from each
    end.
    """

    rows: Rows
    far: Mapping[str, NDArray[np.int8]]

    def kept(self, good: NDArray[np.bool_]) -> _Compatible:
        return _Compatible(self.rows[good], {end: each[good] for end, each in self.far.items()})

    def also(self, end: str, far: NDArray[np.int8]) -> _Compatible:
        """Return the paths with their distances from one more end."""
        return _Compatible(self.rows, {**self.far, end: far})

    def beyond(self, minimum: Mapping[str, int]) -> _Compatible:
        """Return the paths that have at least the given distances from some ends."""
        return self.kept(reduce(np.logical_and, (self.far[end] >= number for end, number in minimum.items())))


def _equal_pairs(keys: NDArray[np.uint64], wanted: NDArray[np.uint64]) -> tuple[Rows, Rows]:
    """Return all pairs of indices of equal entries of `wanted` and of the sorted `keys`, ordered by the first index."""
    start, end = np.searchsorted(keys, wanted), np.searchsorted(keys, wanted, side="right")
    number = end - start
    at = np.repeat(np.arange(len(wanted)), number)
    first = np.repeat(start - np.append(0, np.cumsum(number)[:-1]), number)
    return at, first + np.arange(len(at))


class _RoundRobin:
    """Round-robin distribution of numbered items over the parts of a search."""

    def __init__(self, part: int, parts: int) -> None:
        self.part, self.parts = part, parts
        self._number = -1

    def is_own(self) -> bool:
        self._number += 1
        return self._number % self.parts == self.part
