"""Backtracking over dials: one path for every dial, so that all of them may be the paths of one train.

A join on hashed quotients finds pairs of paths, bit masks tell what they share, and the length of the shortest tour of
the dials is the lower bound by which branches are pruned.

How far two ends of a train are apart is the number of added wheels on one of the two paths alone; from the input it is
the number on the path. All ends cannot be far from each other, for on a tour around the tree each added wheel is passed
twice. So the search begins with a path that is short, or with two that are near each other, whose quotients are looked
up; then only such paths of the other dials stay as go together with all that are chosen, and the dial that has the
fewest is next. Complete: every choice begins in one of these ways.
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

# Tours of the ends of a train: from the input past the dials and back, each added wheel is passed twice.


EndPair = tuple[str, str]
"""Two ends by name, sorted."""


def end_pair(one: str, other: str) -> EndPair:
    """Two ends as a pair."""
    return (one, other) if one < other else (other, one)


def distances(ends: Sequence[str], far: Mapping[EndPair, int]) -> tuple[int, ...]:
    """How far each end is from each, row by row; 0 where that is not known."""
    return tuple(far.get(end_pair(one, two), 0) for one in ends for two in ends)


@lru_cache(maxsize=1 << 16)
def shortest_tour(number: int, far: tuple[int, ...]) -> int:
    """The least length of a tour from the first end past all others and back."""
    return min(far[one * number + two] + rest for one, two, rest in tours_with_one_more(number, far))


@lru_cache(maxsize=1 << 16)
def tours_with_one_more(number: int, far: tuple[int, ...]) -> tuple[tuple[int, int, int], ...]:
    """By two ends between which one more may stand on a tour: the least length of the rest."""
    orders, first, pairs = _orders(number)
    lengths = np.array(far, dtype=np.int64)[orders].sum(axis=1)
    minimum = np.minimum.reduceat(lengths, first)
    return tuple((one, two, rest) for (one, two), rest in zip(pairs, minimum.tolist(), strict=True))


@lru_cache(maxsize=16)
def _orders(number: int) -> tuple[NDArray[np.int64], NDArray[np.int64], tuple[tuple[int, int], ...]]:
    """Orders of ends, one of each two that are the reverse of each other, those between the same two ends together.

    By order, its steps as places in a table of distances; where those between two ends begin; and these two ends.
    """
    orders = [order for order in permutations(range(number)) if order[0] <= order[-1]]
    orders.sort(key=lambda order: (order[0], order[-1]))
    ends = np.array([(order[0], order[-1]) for order in orders])
    first = np.flatnonzero((np.diff(ends, axis=0, prepend=-1) != 0).any(axis=1))
    whole = np.array(orders)
    pairs = tuple((int(one), int(two)) for one, two in ends[first])
    return whole[:, :-1] * number + whole[:, 1:], first, pairs


# What of the paths in a list is compared with a path to another dial, in columns: fast for many paths at once.


_NEVER = 100
"""Wheels apart, of paths that differ by a prime that no wheel has."""


class PathColumns:
    """The paths of a list, by arbor.

    powers           by large prime and row: its power in what the added wheels must make
    codes            by arbor and row: the way through it, 0 where there is none
    driven, driver   by arbor and row: number of the wheel that is driven with its count, and of the one that drives by
                     its name; 0 where there is none
    ends             by row: bit of the surviving arbor that shows the dial
    passes_added     by row: whether an added wheel is an idler on it
    used             by row: bits of surviving arbors, then of wheels, that are used
    """

    def __init__(self, paths: PathList, problem: ReconstructionProblem) -> None:
        self.paths = paths
        self._clusters = [sum(1 << at - 1 for at in each) for each in seen_clusters(problem) if 0 not in each]
        names = [wheel.name for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels]
        number = {name: at for at, name in enumerate(names, 1)}
        self.codes = np.ascontiguousarray(paths.codes.T)
        self.powers = {prime: np.ascontiguousarray(paths.powers[:, at]) for at, prime in enumerate(paths.primes)}
        self.driven = np.ascontiguousarray(paths.driven_at(np.arange(len(paths))).T.astype(np.int16)) + np.int16(1)
        self.driver = np.zeros(self.codes.shape, dtype=np.int16)
        self.used = paths.arbors.copy()
        self.ends = np.zeros(len(paths), dtype=np.int64)
        self.passes_added = paths.idlers > 0
        for at, passes in enumerate(paths.passes):
            taken = self.codes[at]
            drivers = [0, *(number.get((each.driver and each.driver.name) or "", 0) for each in passes)]
            self.driver[at] = np.array(drivers, dtype=np.int16)[taken]
            wheels = [0, *(_bits(each, number) << len(problem.arbors) for each in passes)]
            self.used |= np.array(wheels, dtype=np.int64)[taken]
            self.passes_added |= np.array([False, *(each.idler and each.driven == ADDED for each in passes)])[taken]
            if at:
                last = np.array([False, *(each.driver is None for each in passes)])
                self.ends |= np.where(last[taken], np.int64(1) << (at - 1), 0)

    def fit(self, rows: Rows, other: PathColumns, row: int | Rows) -> NDArray[np.bool_]:
        """Which paths may stand in one tree with a path to another dial, or each with one of several.

        Only the arbor at which they part may be left by different wheels, and none is reached by different ones. A
        wheel has one count. Where they part at the input they share no arbor.
        """
        both: Rows = np.asarray(self.paths.arbors[rows] & other.paths.arbors[row])
        good = self._end_in(rows, both, other, row)
        mine, theirs = self.paths.arbors[rows], other.paths.arbors[row]
        for cluster in self._clusters:  # all paths to it lead through the arbor that is above all others of it
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
        """How many wheels with a large prime each path and one to another dial have apart from each other, at least."""
        found = np.zeros(len(rows), dtype=np.int16)
        for prime in self.powers.keys() | other.powers.keys():
            own = self.powers[prime][rows] if prime in self.powers else np.int8(0)
            theirs = other.powers[prime][row] if prime in other.powers else np.int8(0)
            differ = np.abs(own - theirs)
            found += differ if prime <= self.paths.problem.additions.maximum else differ * np.int16(_NEVER)
        return np.minimum(found, _NEVER).astype(np.int8)

    def _end_in(self, rows: Rows, both: Rows, other: PathColumns, row: int | Rows) -> NDArray[np.bool_]:
        """Which paths keep to the rule that one which ends at an arbor of the other is a part of it."""
        mine, theirs = self.paths, other.paths
        ends, their_end = (self.ends[rows] & both) != 0, (other.ends[row] & both) != 0
        compounds = mine.compounds[rows] - theirs.compounds[row]
        idlers = mine.idlers[rows] - theirs.idlers[row]
        good = ~ends | ((both == mine.arbors[rows]) & (compounds <= 0) & (idlers <= 0))
        good &= ~their_end | ((both == theirs.arbors[row]) & (compounds >= 0) & (idlers >= 0))
        return np.asarray(good)


def all_to_use(problem: ReconstructionProblem) -> int:
    """Bits of surviving arbors and wheels that must be used, as in `PathColumns.used`."""
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
                    yield from self._with(dial, row, _Chosen(), others, minimum, None)

    def _from_pair(
        self, one: str, other: str, far: int, lists: dict[str, _Near], minimum: Mapping[EndPair, int]
    ) -> Iterator[Choice]:
        rest = {dial: near for dial, near in lists.items() if dial not in (one, other)}
        for row, partners in self._joined(one, lists[one].rows, other, lists[other].rows, far):
            near = _Near(partners, {_INPUT: self.lists[other].wheels[partners].astype(np.int8)})
            near = self._fitting(one, row, other, near, _Chosen(), {})
            near = near.kept(near.far[one] == far)
            if len(near.rows):
                yield from self._with(one, row, _Chosen(), {other: near, **rest}, minimum, None, {other: near})

    # choice after choice

    def _with(
        self,
        dial: str,
        row: int,
        chosen: _Chosen,
        lists: Mapping[str, _Near],
        minimum: Mapping[EndPair, int],
        share: _Share | None,
        known: Mapping[str, _Near] = MappingProxyType({}),
    ) -> Iterator[Choice]:
        """All choices with one path more.

        minimum   by pair of dials, how far they must be apart: what is nearer was tried
        known   lists of dials in which only paths that go with the new one are left already
        """
        paths = {**chosen.paths, dial: row}
        kept: dict[str, _Near] = dict(known)
        for other in sorted(lists, key=lambda each: len(lists[each].rows)):
            if other not in kept:
                kept[other] = self._fitting(dial, row, other, lists[other], chosen, minimum)
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
                yield from self._with(following, next_row, after, kept, minimum, None)

    def _fitting(
        self, dial: str, row: int, other: str, near: _Near, chosen: _Chosen, minimum: Mapping[EndPair, int]
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
        requested = minimum.get(end_pair(dial, other), 0)
        return near.kept(good & (near.far[dial] >= requested) if requested else good)

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
            (low, high), (minimum, maximum) = first.bounds, second.bounds
            with np.errstate(divide="ignore"):
                fewest = second.ranges.fewest((minimum[rows] / high[row], maximum[rows] / low[row]))
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

    def beyond(self, minimum: Mapping[str, int]) -> _Near:
        """Those that are so far from some ends."""
        return self.kept(reduce(np.logical_and, (self.far[end] >= number for end, number in minimum.items())))


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
