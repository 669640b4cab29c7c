"""How far paths are apart, and the tours by which that is judged, against plain loops."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, pairwise, permutations, product
from math import prod

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from geartrain.search.reconstruct.path_choice import distances, end_pair, shortest_tour, tours_with_one_more
from geartrain.search.reconstruct.quotient_keys import QuotientKeys, QuotientRanges

COUNTS = range(5, 10)
NAMES = ("", "games", "metonic", "moon", "saros", "year")
ratios = st.fractions(Fraction(1, 60), Fraction(60), max_denominator=90)


def made_of(wheels: int) -> set[Fraction]:
    """All quotients of just so many wheels."""
    return {
        Fraction(prod(chosen[:drivers]), prod(chosen[drivers:]))
        for drivers in range(wheels + 1)
        for chosen in product(COUNTS, repeat=wheels)
    }


MADE = [made_of(0), made_of(0) | made_of(1), made_of(0) | made_of(1) | made_of(2)]


def fewest(low: Fraction, high: Fraction) -> int:
    """How few wheels make a quotient within bounds, 3 for more than 2."""
    return next((n for n, made in enumerate(MADE) if any(low <= one <= high for one in made)), 3)


@given(st.lists(ratios, max_size=20))
def test_keys_tell_how_few_wheels_make_a_quotient(quotients: list[Fraction]) -> None:
    keys = QuotientKeys(COUNTS[0], COUNTS[-1])
    found = keys.fewest(np.array([keys.key(one) for one in quotients], dtype=np.uint64), 2)
    assert found.tolist() == [fewest(one, one) for one in quotients]


@given(st.lists(ratios, min_size=1, max_size=12), st.lists(ratios, min_size=1, max_size=12), st.integers(-1, 2))
def test_partners_are_those_that_few_wheels_part(some: list[Fraction], others: list[Fraction], wheels: int) -> None:
    keys = QuotientKeys(COUNTS[0], COUNTS[-1])
    one, other = (np.array([keys.key(each) for each in side], dtype=np.uint64) for side in (some, others))
    pairs = [[fewest(a / b, a / b) <= wheels for b in others] for a in some]
    first, second = keys.agreeing(one, other, wheels)
    assert first.tolist() == [any(row) for row in pairs]
    assert second.tolist() == [any(row[at] for row in pairs) for at in range(len(others))]


@given(st.lists(st.tuples(ratios, ratios), max_size=20))
def test_ranges_tell_how_few_wheels_make_a_quotient_within(bounds: list[tuple[Fraction, Fraction]]) -> None:
    pairs = [(min(pair), max(pair)) for pair in bounds]
    low, high = (np.array([float(pair[at]) for pair in pairs]) for at in (0, 1))
    assert QuotientRanges(COUNTS[0], COUNTS[-1]).fewest((low, high)).tolist() == [fewest(*pair) for pair in pairs]


@given(st.integers(1, 5), st.data())
def test_tours_are_the_shortest(number: int, data: st.DataObject) -> None:
    names = NAMES[: number + 1]
    far = {end_pair(*pair): data.draw(st.integers(0, 9)) for pair in combinations(names, 2)}

    def length(order: tuple[str, ...]) -> int:
        return sum(far[end_pair(*step)] for step in pairwise((*order, order[0])))

    best = min(map(length, permutations(names)))
    assert shortest_tour(len(names), distances(names, far)) == best
    *ends, last = names
    tours = tours_with_one_more(len(ends), distances(ends, far))
    assert best == min(
        far[end_pair(ends[one], last)] + rest + far[end_pair(ends[two], last)] for one, two, rest in tours
    )
