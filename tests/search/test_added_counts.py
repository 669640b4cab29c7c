"""Counts of added wheels with which every dial turns as it must, against trial of all of them."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import product
from math import prod

import pytest

from geartrain.search.reconstruct.added_counts import AddedCounts, Wanted
from geartrain.search.reconstruct.train_topology import AddedWheels

MINIMUM, MAXIMUM = 5, 9
DIALS = "pqrs"


def random_question(chance: random.Random) -> tuple[AddedWheels, Wanted]:
    """Groups of some dials, four wheels at most; bounds about the quotients of a random choice, some of them exact."""
    kinds: dict[tuple[str, ...], list[int]] = {}
    for _ in range(chance.randint(1, 4)):
        dials = tuple(sorted(chance.sample(DIALS, chance.randint(1, 4))))
        kinds.setdefault(dials, [0, 0])[chance.randint(0, 1)] += 1
    groups = tuple((dials, drivers, driven) for dials, (drivers, driven) in sorted(kinds.items()))
    quotients = quotients_of(groups, [chance.randint(MINIMUM, MAXIMUM) for _ in range(4)])
    widths = {dial: Fraction(chance.choice((0, 0, 1, 5, 30)), 100) for dial in DIALS}
    wanted = tuple((dial, (each * (1 - widths[dial]), each * (1 + widths[dial]))) for dial, each in quotients.items())
    return AddedWheels(groups, chance.choice((0, 0, 1))), wanted


def quotients_of(groups: tuple[tuple[tuple[str, ...], int, int], ...], counts: list[int]) -> dict[str, Fraction]:
    """By dial the quotient of its wheels, drivers of a group before its driven wheels."""
    found = dict.fromkeys(DIALS, Fraction(1))
    for dials, drivers, driven in groups:
        own, counts = counts[: drivers + driven], counts[drivers + driven :]
        for dial in dials:
            found[dial] *= Fraction(prod(own[:drivers]), prod(own[drivers:]))
    return found


def choices(added: AddedWheels, wanted: Wanted) -> set[tuple[int, ...]]:
    """All counts that will do."""
    wheels = sum(drivers + driven for _, drivers, driven in added.groups)
    return {
        counts
        for counts in product(range(MINIMUM, MAXIMUM + 1), repeat=wheels)
        if all(low <= quotients_of(added.groups, [*counts])[dial] <= high for dial, (low, high) in wanted)
    }


@pytest.mark.parametrize("seed", range(60))
def test_counts_are_those_of_trial(seed: int) -> None:
    added, wanted = random_question(random.Random(seed))
    counts, expected = AddedCounts(MINIMUM, MAXIMUM), choices(added, wanted)
    idle = (MAXIMUM - MINIMUM + 1) ** added.idle
    assert counts.count(added, wanted) == len(expected) * idle
    listed = list(counts.assignments(added, wanted))
    flat = [tuple(each for group in added.groups for own in one[group[0]] for each in own) for one, _ in listed]
    assert len(flat) == len(expected) * idle
    assert {*flat} == expected
    assert expected, "the random choice itself will do"


def test_a_quotient_that_no_other_group_changes_is_kept_within_the_bounds_of_all_its_dials() -> None:
    """p and q turn with one wheel each; what both allow of the wheel that they share is far less than its range."""
    groups = ((("p",), 0, 1), (("p", "q", "r"), 1, 1))
    bounds = {"p": ("1/500", "1/5"), "q": ("99/100", "102/100"), "r": ("1", "101/100")}
    wanted = tuple((dial, (Fraction(low), Fraction(high))) for dial, (low, high) in bounds.items())
    counts = AddedCounts(10, 120)
    requested: list[object] = []
    count = counts._count
    counts._count = lambda groups, wanted: requested.append(wanted) or count(groups, wanted)  # type: ignore[assignment,func-returns-value]
    quotients = {
        Fraction(y, x) for y in range(10, 121) for x in range(10, 121) if 0 <= Fraction(y, x) - 1 <= Fraction(1, 100)
    }
    assert counts.count(AddedWheels(groups, 0), wanted) > 0
    assert len(requested) == 1 + 2 * len(quotients)  # then p is asked, and that nothing is left
