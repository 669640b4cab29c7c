"""Variable elimination: how many choices of the counts of added wheels turn every dial as it must.

Wheels that change the speeds of the same dials enter by their quotient alone: a group. A dial with one group left fixes
its quotient; else the smallest group is tried with each quotient that it may have (variable elimination). Tallies of
products are faster here than the exact join of counts in doubt (`synthesis.join`): 1 to 4 ms a topology against 5 to 7,
and for seven added wheels 0.6 s against 90 s.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import product
from math import comb, prod
from random import Random
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.search.reconstruct.train_topology import AddedWheels, CountLimit, Dials, Quotients
from geartrain.search.weighted_alternatives import draw_index, sums_by

# How many choices of added wheels' counts have a wanted quotient of products. With drivers y and driven wheels x,
# prod y / prod x = num / den in lowest terms holds exactly where prod y = num m and prod x = den m for a whole m.
# So the number of choices is the sum over m of P(num m) R(den m), where P(n) is the number of choices of drivers
# with the product n, and R that of driven wheels.


Range = tuple[int, int]
"""Least and greatest count of an added wheel."""

_LONGEST = 1 << 24
"""Products in a tally; of more wheels one is tried after the other."""


@lru_cache(maxsize=16)
def product_tally(wheels: int, counts: Range) -> NDArray[np.int64]:
    """Number of choices with the product n at index n."""
    if not wheels:
        return np.array([0, 1], dtype=np.int64)
    before = product_tally(wheels - 1, counts)
    found = np.zeros((len(before) - 1) * counts[1] + 1, dtype=np.int64)
    for count in range(counts[0], counts[1] + 1):
        found[: (len(before) - 1) * count + 1 : count] += before
    return found


@lru_cache(maxsize=1 << 19)
def count_choices(quotient: Fraction, drivers: int, driven: int, counts: Range) -> int:
    """How many choices of counts have prod(drivers) / prod(driven) = quotient; wheels are told apart."""
    minimum, maximum = counts
    num, den = quotient.numerator, quotient.denominator
    last = min(maximum**drivers // num, maximum**driven // den)
    first = max(-(-(minimum**drivers) // num), -(-(minimum**driven) // den))
    if last < first:
        return 0
    if drivers <= 1 and driven <= 1:
        # 1 is the only product of no wheels
        return last - first + 1 if drivers and driven else int(first <= 1 <= last)
    if maximum ** max(drivers, driven) <= _LONGEST:
        above = product_tally(drivers, counts)[first * num : last * num + 1 : num]
        below = product_tally(driven, counts)[first * den : last * den + 1 : den]
        return int(above @ below)
    tried = range(minimum, maximum + 1)
    if drivers >= driven:
        return sum(count_choices(quotient / count, drivers - 1, driven, counts) for count in tried)
    return sum(count_choices(quotient * count, drivers, driven - 1, counts) for count in tried)


def list_choices(
    quotient: Fraction, drivers: int, driven: int, counts: Range
) -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
    """The choices themselves: counts of the drivers, and of the driven wheels."""
    num, den = quotient.numerator, quotient.denominator
    last = min(counts[1] ** drivers // num, counts[1] ** driven // den)
    for common in range(1, last + 1):
        if above := factorings(num * common, drivers, counts):
            yield from product(above, factorings(den * common, driven, counts))


@lru_cache(maxsize=1 << 16)
def quotients_of_parts(
    quotient: Fraction, one: tuple[int, int], other: tuple[int, int], counts: Range
) -> tuple[tuple[Fraction, int], ...]:
    """Quotients of the first of two parts that make a quotient together, each with the number of choices of both.

    A part is its numbers of drivers and of driven wheels.
    """
    found: dict[Fraction, int] = {}
    for drivers, driven in list_choices(quotient, one[0] + other[0], one[1] + other[1], counts):
        part = Fraction(prod(drivers[: one[0]]), prod(driven[: one[1]]))
        found[part] = found.get(part, 0) + 1
    return tuple(found.items())


@lru_cache(maxsize=1 << 16)
def factorings(number: int, wheels: int, counts: Range) -> tuple[tuple[int, ...], ...]:
    """Counts of so many wheels with a given product, in every order."""
    minimum, maximum = counts
    if not minimum**wheels <= number <= maximum**wheels:
        return ()
    if wheels <= 1:
        return ((number,),) if wheels else ((),)
    found = (count for count in range(minimum, maximum + 1) if number % count == 0)
    return tuple((count, *rest) for count in found for rest in factorings(number // count, wheels - 1, counts))


@dataclass(frozen=True)
class QuotientTable:
    """All quotients of products of counts, rising: in lowest terms, with the number of choices of each."""

    tops: NDArray[np.int64]
    bottoms: NDArray[np.int64]
    choices: NDArray[np.int64]
    values: NDArray[np.float64]

    @staticmethod
    def of(tops: NDArray[np.int64], bottoms: NDArray[np.int64], choices: NDArray[np.int64]) -> QuotientTable:
        """The table of quotients that may come several times, not in lowest terms."""
        common = np.gcd(tops, bottoms)
        pairs, at = np.unique(np.stack([tops // common, bottoms // common]), axis=1, return_inverse=True)
        number = sums_by(at.ravel(), choices, pairs.shape[1])
        # two of them differ by more than rounding: their denominators are short
        values = pairs[0] / pairs[1]
        order = np.argsort(values)
        return QuotientTable(pairs[0][order], pairs[1][order], number[order], values[order])

    def within(self, minimum: Fraction, maximum: Fraction) -> slice:
        """Where the quotients within bounds stand."""
        first = int(np.searchsorted(self.values, float(minimum) * (1 - 1e-15)))
        last = int(np.searchsorted(self.values, float(maximum) * (1 + 1e-15), side="right"))
        while first < last and self[first] < minimum:
            first += 1
        while first < last and self[last - 1] > maximum:
            last -= 1
        return slice(first, last)

    def __getitem__(self, at: int) -> Fraction:
        return Fraction(int(self.tops[at]), int(self.bottoms[at]))


@lru_cache(maxsize=32)
def quotient_table(drivers: int, driven: int, counts: Range) -> QuotientTable:
    """The table of so many drivers over so many driven wheels."""
    one = np.ones(1, dtype=np.int64)
    if not drivers and not driven:
        return QuotientTable.of(one, one, one)
    up = drivers > driven
    before = quotient_table(drivers - up, driven - (not up), counts)
    each = np.arange(counts[0], counts[1] + 1)
    tops, bottoms = before.tops[:, None], before.bottoms[:, None]
    tops, bottoms = (tops * each, bottoms + 0 * each) if up else (tops + 0 * each, bottoms * each)
    return QuotientTable.of(tops.ravel(), bottoms.ravel(), np.repeat(before.choices, len(each)))


def quotients(
    minimum: Fraction, maximum: Fraction, drivers: int, driven: int, counts: Range
) -> Iterator[tuple[Fraction, int]]:
    """Quotients within bounds, rising, each with its number of choices."""
    if minimum == maximum:
        if number := count_choices(minimum, drivers, driven, counts):
            yield minimum, number
        return
    table = quotient_table(drivers, driven, counts)
    found = table.within(minimum, maximum)
    for at in range(found.start, found.stop):
        yield table[at], int(table.choices[at])


def count_between(minimum: Fraction, maximum: Fraction, drivers: int, driven: int, counts: Range) -> int:
    """How many choices have a quotient within bounds."""
    if minimum == maximum:
        return count_choices(minimum, drivers, driven, counts)
    if drivers + driven <= 3:
        table = quotient_table(drivers, driven, counts)
        return int(table.choices[table.within(minimum, maximum)].sum())
    some = (
        quotient_table(1, 1, counts) if drivers and driven else quotient_table(min(drivers, 2), min(driven, 2), counts)
    )
    used = (1, 1) if drivers and driven else (min(drivers, 2), min(driven, 2))
    return sum(
        int(own) * count_between(minimum / some[at], maximum / some[at], drivers - used[0], driven - used[1], counts)
        for at, own in enumerate(some.choices)
    )


Group = tuple[Dials, int, int]
Wanted = tuple[tuple[str, Quotients], ...]
Counts = dict[Dials, tuple[tuple[int, ...], tuple[int, ...]]]
"""By group, counts of its drivers and of its driven wheels."""


class AddedCounts:
    """Assignments of counts from least to greatest to added wheels."""

    def __init__(self, minimum: int, maximum: int) -> None:
        self.range = minimum, maximum
        self._count = lru_cache(maxsize=1 << 18)(self._counted)

    @property
    def _choices(self) -> int:
        return self.range[1] - self.range[0] + 1

    def count(self, added: AddedWheels, wanted: Wanted) -> int:
        """How many there are; wheels are told apart."""
        alike = _alike(added.groups, wanted)
        return int(self._count(added.groups, alike) * self._choices**added.idle) if alike is not None else 0

    def count_limited(self, added: AddedWheels, wanted: Wanted, limits: tuple[CountLimit, ...]) -> int:
        """The same where some of the wheels have a limit of their own, below the greatest count of all."""
        if not limits:
            return self.count(added, wanted)
        limit, others = limits[0], limits[1:]
        minimum, maximum = self.range
        left = added.without(limit)
        if not limit.dials:
            return max(0, limit.most - minimum + 1) * self.count_limited(left, wanted, others)

        def among(counts: range) -> int:
            quotients_of = (Fraction(count) if limit.drives else Fraction(1, count) for count in counts)
            return sum(self.count_limited(left, divided(wanted, limit.dials, each), others) for each in quotients_of)

        allowed, ruled_out = range(minimum, limit.most + 1), range(max(minimum, limit.most + 1), maximum + 1)
        if len(allowed) <= len(ruled_out):
            return among(allowed)
        return self.count_limited(added, wanted, others) - among(ruled_out)

    def assignments(self, added: AddedWheels, wanted: Wanted) -> Iterator[tuple[Counts, tuple[int, ...]]]:
        """The assignments themselves, and the counts of wheels that change no speed."""
        alike = _alike(added.groups, wanted)
        for counts in self._listed(added.groups, alike) if alike is not None else ():
            for idle in product(range(self.range[0], self.range[1] + 1), repeat=added.idle):
                yield counts, idle

    def _counted(self, groups: tuple[Group, ...], wanted: Wanted) -> int:
        if not _may_hold(groups, wanted):
            return 0
        step = self._next(groups, wanted)
        if step is None:
            return 1
        at, bounds, private = step
        (dials, drivers, driven), rest = groups[at], groups[:at] + groups[at + 1 :]
        if private:
            own = count_between(*bounds, drivers, driven, self.range)
            return own and own * self._count(rest, _without(wanted, dials))
        if bounds[0] == bounds[1]:
            own = count_choices(bounds[0], drivers, driven, self.range)
            return own and own * self._count(rest, divided(wanted, dials, bounds[0]))
        pair = _pair(groups, wanted)
        if pair is not None:
            return self._counted_pair(groups, wanted, *pair)
        return sum(
            own * self._count(rest, divided(wanted, dials, quotient))
            for quotient, own in quotients(*bounds, drivers, driven, self.range)
        )

    def _counted_pair(self, groups: tuple[Group, ...], wanted: Wanted, one: int, other: int, both: Fraction) -> int:
        """The same, with two groups whose product is known: few of the one leave what the other may have."""
        rest = tuple(group for at, group in enumerate(groups) if at not in (one, other))
        kinds = groups[one][1:], groups[other][1:]
        return sum(
            own * self._count(rest, divided(divided(wanted, groups[one][0], part), groups[other][0], both / part))
            for part, own in quotients_of_parts(both, *kinds, self.range)
        )

    def _listed(self, groups: tuple[Group, ...], wanted: Wanted) -> Iterator[Counts]:
        step = self._next(groups, wanted)
        if step is None:
            if _may_hold(groups, wanted):
                yield {}
            return
        at, bounds, _ = step
        (dials, drivers, driven), rest = groups[at], groups[:at] + groups[at + 1 :]
        for quotient, _ in quotients(*bounds, drivers, driven, self.range):
            left = divided(wanted, dials, quotient)
            if self._count(rest, left):
                own = list(list_choices(quotient, drivers, driven, self.range))
                for others in self._listed(rest, left):
                    yield from ({dials: choice, **others} for choice in own)

    @staticmethod
    def _next(groups: tuple[Group, ...], wanted: Wanted) -> tuple[int, Quotients, bool] | None:
        """The group to be settled next, bounds of its quotient, and whether one dial alone asks for it."""
        if not groups:
            return None
        alone: dict[int, Quotients] = {}
        tried: list[tuple[int, int, int, int]] = []
        for dial, bounds in wanted:
            own = [at for at, group in enumerate(groups) if dial in group[0]]
            if len(own) == 1:
                at = own[0]
                if bounds[0] == bounds[1]:
                    return at, bounds, groups[at][0] == (dial,)
                minimum, maximum = alone.get(at, bounds)
                alone[at] = max(minimum, bounds[0]), min(maximum, bounds[1])
            else:
                tried += [(len(own), groups[at][1] + groups[at][2], -len(groups[at][0]), at) for at in own]
        private = next((at for at in alone if len(groups[at][0]) == 1), None)
        if private is not None:
            return private, alone[private], True
        if alone:  # all that a group may have is what every dial allows that it alone still turns
            at = min(alone, key=lambda each: (groups[each][1] + groups[each][2], each))
            return at, alone[at], False
        # so that soon a dial has one group left; it may be that none is left that asks
        at = min(tried)[-1] if tried else 0
        return at, (Fraction(0), _BOUNDLESS), False


_BOUNDLESS = Fraction(10**40)
_LISTED_TOGETHER = 3
"""Wheels of two groups whose choices are listed for what their product must be."""


def _pair(groups: tuple[Group, ...], wanted: Wanted) -> tuple[int, int, Fraction] | None:
    """Two groups of few wheels that are all that change the speed of an exact dial, and their product."""
    best, fewest = None, _LISTED_TOGETHER + 1
    for dial, (low, high) in wanted:
        own = [at for at, group in enumerate(groups) if dial in group[0]]
        wheels = sum(groups[at][1] + groups[at][2] for at in own)
        if len(own) == 2 and low == high and wheels < fewest:
            best, fewest = (own[0], own[1], low), wheels
    return best


def _may_hold(groups: tuple[Group, ...], wanted: Wanted) -> bool:
    """Whether the dials whose speed no group changes any more turn as they must."""
    open_dials = {dial for dials, _, _ in groups for dial in dials}
    return all(low <= 1 <= high for dial, (low, high) in wanted if dial not in open_dials)


def _alike(groups: tuple[Group, ...], wanted: Wanted) -> Wanted | None:
    """Of dials whose speeds the same groups change, one with what all of them want; None if that cannot be."""
    found: dict[tuple[int, ...], tuple[str, Quotients]] = {}
    for dial, (low, high) in wanted:
        own = tuple(at for at, group in enumerate(groups) if dial in group[0])
        if own in found:
            _, (minimum, maximum) = found[own]
            low, high = max(low, minimum), min(high, maximum)
            if low > high:
                return None
        found[own] = dial, (low, high)
    return tuple(found.values())


def _without(wanted: Wanted, dials: Dials) -> Wanted:
    return tuple(each for each in wanted if each[0] not in dials)


def divided(wanted: Wanted, dials: Dials, quotient: Fraction) -> Wanted:
    """What is left to be reached by the other groups."""
    return tuple(
        (dial, (low / quotient, high / quotient) if dial in dials else (low, high)) for dial, (low, high) in wanted
    )


# In how many choices of the added wheels' counts a wheel has a count, and choices drawn with equal chances. Wheels
# of one kind may be exchanged in any choice, so that each of them has a count equally often.


_FEW = 2000
"""Choices up to which they are listed: it is faster than to count those with each count."""


class AddedKind(NamedTuple):
    """Added wheels of which none is told from another by the speeds of dials."""

    dials: Dials
    """Whose speed they change; none for a wheel that changes no speed."""
    drives: bool
    """Whether they drive on the way to them."""
    most: int | None = None
    """Teeth that a ring allows, None for no limit but that of all."""


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

    def total(self, requested: OpenCounts) -> int:
        """How many choices there are."""
        return self._counts.count_limited(requested.added, requested.wanted, requested.limits)

    def _of_kind(self, requested: OpenCounts, kind: AddedKind) -> dict[int, int]:
        """By count, in how many choices one wheel of a kind has it; counts that it never has are left out."""
        few = self._few(requested)
        if few is not None:
            return few.of_kind[kind]
        minimum, maximum = self._counts.range
        most = maximum if kind.most is None else min(kind.most, maximum)
        found = ((count, self.total(requested.with_one(kind, count))) for count in range(minimum, most + 1))
        return {count: number for count, number in found if number}

    def _with_any(self, requested: OpenCounts) -> dict[int, int]:
        """By count, in how many choices any of the wheels has it, by inclusion and exclusion."""
        few = self._few(requested)
        if few is not None:
            return few.with_any
        kinds = tuple(requested.kinds())
        counts = {count for kind, _ in kinds for count in self.of_kind(requested, kind)}
        whole = self.total(requested)
        return {count: whole - self._signed(requested, kinds, count, whole) for count in sorted(counts)}

    def _signed(self, requested: OpenCounts, kinds: tuple[tuple[AddedKind, int], ...], count: int, number: int) -> int:
        """The choices in which no wheel of some kinds has a count, of those that are open: so many."""
        if not kinds or not number:
            return number
        (kind, wheels), others = kinds[0], kinds[1:]
        found, left, total = 0, requested, number
        for chosen in range(wheels + 1):
            found += (-1) ** chosen * comb(wheels, chosen) * self._signed(left, others, count, total)
            if chosen == wheels or (kind.most is not None and count > kind.most):
                break
            left = left.with_one(kind, count)
            total = self.total(left)
            if not total:
                break
        return found

    def _few(self, requested: OpenCounts) -> _FewChoices | None:
        """The sums over choices one by one, where they are so few that this is fast."""
        if requested.limits or self.total(requested) > _FEW:
            return None
        return self._listed(requested)

    def _list(self, requested: OpenCounts) -> _FewChoices:
        found, kinds = _FewChoices(defaultdict(Counter), Counter()), [kind for kind, _ in requested.kinds()]
        for counts, idle in self._counts.assignments(requested.added, requested.wanted):
            wheels = {kind: counts[kind.dials][not kind.drives] if kind.dials else idle for kind in kinds}
            for kind, own in wheels.items():
                found.of_kind[kind][own[0]] += 1  # the first stands for each
            found.with_any.update({count for own in wheels.values() for count in own})
        return found

    def draw(self, requested: OpenCounts, kind: AddedKind, chance: Random) -> tuple[int, OpenCounts]:
        """The count of one wheel of a kind in a choice that is drawn, and what is open then."""
        by_count = self.of_kind(requested, kind)
        count = [*by_count][draw_index([*by_count.values()], chance)]
        return count, requested.with_one(kind, count)
