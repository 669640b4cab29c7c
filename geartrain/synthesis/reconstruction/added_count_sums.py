"""In how many choices of the added wheels' counts a wheel has a count, and choices drawn with equal chances.

Wheels of one kind may be exchanged in any choice, so that each of them has a count equally often.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from math import comb
from random import Random
from typing import NamedTuple

from geartrain.numerics.weighted_alternatives import draw_index
from geartrain.synthesis.reconstruction.added_counts import AddedCounts, Wanted, divided
from geartrain.synthesis.reconstruction.skeletons import AddedWheels, CountLimit, Dials

_FEW = 2000
"""Choices up to which they are listed: it is faster than to count those with each count."""


class AddedKind(NamedTuple):
    """Added wheels of which none is told from another by the speeds of dials.

    dials    whose speed they change; none for a wheel that changes no speed
    drives   whether they drive on the way to them
    most     teeth that a ring allows, None for no limit but that of all
    """

    dials: Dials
    drives: bool
    most: int | None = None


class OpenCounts(NamedTuple):
    """Added wheels whose counts are open, what their quotients must be, and limits that rings set, sorted."""

    added: AddedWheels
    wanted: Wanted
    limits: tuple[CountLimit, ...] = ()

    def kinds(self) -> Iterator[tuple[AddedKind, int]]:
        """Each kind with the number of its wheels."""
        limited = {kind: self.limits.count(kind) for kind in self.limits}
        for kind, number in limited.items():
            yield AddedKind(*kind), number
        groups = [(dials, True, drivers) for dials, drivers, _ in self.added.groups]
        groups += [(dials, False, driven) for dials, _, driven in self.added.groups]
        for dials, drives, number in [*groups, ((), False, self.added.idle)]:
            left = number - sum(n for kind, n in limited.items() if (kind.dials, kind.drives) == (dials, drives))
            if left:
                yield AddedKind(dials, drives), left

    def with_one(self, kind: AddedKind, count: int) -> OpenCounts:
        """What is open once a wheel of a kind has a count, which its limit allows."""
        limits = list(self.limits)
        if kind.most is not None:
            limits.remove(CountLimit(kind.dials, kind.drives, kind.most))
        added = self.added.without(CountLimit(kind.dials, kind.drives, count))
        if not kind.dials:
            return OpenCounts(added, self.wanted, tuple(limits))
        quotient = Fraction(count) if kind.drives else Fraction(1, count)
        return OpenCounts(added, divided(self.wanted, kind.dials, quotient), tuple(limits))


class _FewChoices(NamedTuple):
    """Sums over choices one by one."""

    of_kind: dict[AddedKind, Counter[int]]
    with_any: Counter[int]


class AddedCountSums:
    """Sums over all choices of counts from least to greatest."""

    def __init__(self, counts: AddedCounts) -> None:
        self._counts = counts
        self.of_kind = lru_cache(maxsize=1 << 16)(self._of_kind)
        self._listed = lru_cache(maxsize=1 << 12)(self._list)
        self.with_any = lru_cache(maxsize=1 << 14)(self._with_any)

    def total(self, asked: OpenCounts) -> int:
        """How many choices there are."""
        return self._counts.count_limited(asked.added, asked.wanted, asked.limits)

    def _of_kind(self, asked: OpenCounts, kind: AddedKind) -> dict[int, int]:
        """By count, in how many choices one wheel of a kind has it; counts that it never has are left out."""
        few = self._few(asked)
        if few is not None:
            return few.of_kind[kind]
        least, greatest = self._counts.range
        most = greatest if kind.most is None else min(kind.most, greatest)
        found = ((count, self.total(asked.with_one(kind, count))) for count in range(least, most + 1))
        return {count: number for count, number in found if number}

    def _with_any(self, asked: OpenCounts) -> dict[int, int]:
        """By count, in how many choices any of the wheels has it, by inclusion and exclusion."""
        few = self._few(asked)
        if few is not None:
            return few.with_any
        kinds = tuple(asked.kinds())
        counts = {count for kind, _ in kinds for count in self.of_kind(asked, kind)}
        whole = self.total(asked)
        return {count: whole - self._signed(asked, kinds, count, whole) for count in sorted(counts)}

    def _signed(self, asked: OpenCounts, kinds: tuple[tuple[AddedKind, int], ...], count: int, number: int) -> int:
        """The choices in which no wheel of some kinds has a count, of those that are open: so many."""
        if not kinds or not number:
            return number
        (kind, wheels), others = kinds[0], kinds[1:]
        found, left, total = 0, asked, number
        for chosen in range(wheels + 1):
            found += (-1) ** chosen * comb(wheels, chosen) * self._signed(left, others, count, total)
            if chosen == wheels or (kind.most is not None and count > kind.most):
                break
            left = left.with_one(kind, count)
            total = self.total(left)
            if not total:
                break
        return found

    def _few(self, asked: OpenCounts) -> _FewChoices | None:
        """The sums over choices one by one, where they are so few that this is fast."""
        if asked.limits or self.total(asked) > _FEW:
            return None
        return self._listed(asked)

    def _list(self, asked: OpenCounts) -> _FewChoices:
        found, kinds = _FewChoices(defaultdict(Counter), Counter()), [kind for kind, _ in asked.kinds()]
        for counts, idle in self._counts.assignments(asked.added, asked.wanted):
            wheels = {kind: counts[kind.dials][not kind.drives] if kind.dials else idle for kind in kinds}
            for kind, own in wheels.items():
                found.of_kind[kind][own[0]] += 1  # the first stands for each
            found.with_any.update({count for own in wheels.values() for count in own})
        return found

    def draw(self, asked: OpenCounts, kind: AddedKind, chance: Random) -> tuple[int, OpenCounts]:
        """The count of one wheel of a kind in a choice that is drawn, and what is open then."""
        by_count = self.of_kind(asked, kind)
        count = [*by_count][draw_index([*by_count.values()], chance)]
        return count, asked.with_one(kind, count)
