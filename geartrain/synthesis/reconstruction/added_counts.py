"""In how many ways the added wheels of a skeleton have counts with which every dial turns as it must.

Wheels that change the speeds of the same dials enter by their quotient alone: a group. A dial with one group left fixes
its quotient; else the smallest group is tried with each quotient that it may have (variable elimination). Tallies of
products are faster here than the exact join of counts in doubt (`synthesis.join`): 1 to 4 ms a skeleton against 5 to 7,
and for seven added wheels 0.6 s against 90 s.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from itertools import product

from geartrain.synthesis.reconstruction.count_products import (
    count_between,
    count_choices,
    list_choices,
    quotients,
    quotients_of_parts,
)
from geartrain.synthesis.reconstruction.skeletons import AddedWheels, CountLimit, Dials, Quotients

Group = tuple[Dials, int, int]
Wanted = tuple[tuple[str, Quotients], ...]
Counts = dict[Dials, tuple[tuple[int, ...], tuple[int, ...]]]
"""By group, counts of its drivers and of its driven wheels."""


class AddedCounts:
    """Assignments of counts from least to greatest to added wheels."""

    def __init__(self, least: int, greatest: int) -> None:
        self.range = least, greatest
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
        least, greatest = self.range
        left = added.without(limit)
        if not limit.dials:
            return max(0, limit.most - least + 1) * self.count_limited(left, wanted, others)

        def among(counts: range) -> int:
            quotients_of = (Fraction(count) if limit.drives else Fraction(1, count) for count in counts)
            return sum(self.count_limited(left, divided(wanted, limit.dials, each), others) for each in quotients_of)

        allowed, ruled_out = range(least, limit.most + 1), range(max(least, limit.most + 1), greatest + 1)
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
                least, greatest = alone.get(at, bounds)
                alone[at] = max(least, bounds[0]), min(greatest, bounds[1])
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
            _, (least, greatest) = found[own]
            low, high = max(low, least), min(high, greatest)
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
