"""The study of tooth numbers: every way's answer is what it says, and the complete ones are the best there is."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import combinations_with_replacement, product
from math import prod

import pytest
from studies import tooth_number_methods as ways
from studies.tooth_number_methods import RatioCase
from studies.tooth_number_records import (
    CHAIN,
    EVERY,
    METHODS,
    PRINTED,
    PRODUCTS,
    TRAIN,
    TeethGrowth,
    TeethRecords,
)
from studies.tooth_number_study import tooth_numbers

pytestmark = pytest.mark.slow  # the script of an accuracy page, no part of the package


@pytest.fixture(scope="module")
def records() -> TeethRecords:
    return tooth_numbers(quick=True)


def grown(records: TeethRecords, family: str) -> list[TeethGrowth]:
    return [row for row in records.growth if row.family == family]


def span(text: str) -> range:
    first, last = map(int, text.split(":"))
    return range(first, last + 1)


def best_by_hand(value: Fraction, stages: int, top: range, beneath: range) -> Fraction:
    """The least |error| of all sets, by the nearest product on each side: no loop over pairs, only over products."""
    tops = sorted({prod(each) for each in combinations_with_replacement(top, stages)})
    best = Fraction(10**9)
    for q in {prod(each) for each in combinations_with_replacement(beneath, stages)}:
        low, high = 0, len(tops)
        while low < high:
            middle = (low + high) // 2
            low, high = (middle + 1, high) if tops[middle] < value * q else (low, middle)
        for p in tops[max(low - 1, 0) : low + 1]:
            best = min(best, abs(Fraction(p, q) / value - 1))
    return best


# every row -----------------------------------------------------------------------------------------------------------


def test_every_error_is_that_of_its_teeth_and_every_count_is_admissible(records: TeethRecords) -> None:
    assert len(records.rows) > 40
    for row in records.rows:
        if row.error is None:
            assert not row.teeth
            continue
        top, beneath = row.teeth
        assert abs(Fraction(prod(top), prod(beneath)) / Fraction(row.wanted) - 1) == row.miss
        assert len(top) == len(beneath) == row.stages
        assert set(top) <= set(span(row.wheels))
        assert set(beneath) <= set(span(row.pinions))


def test_proved_answers_are_the_best_of_all_sets(records: TeethRecords) -> None:
    for rows in records.questions:
        one = rows[0]
        truth = best_by_hand(Fraction(one.wanted), one.stages, span(one.wheels), span(one.pinions))
        assert all(row.miss == truth for row in rows if row.proved)
        assert all(row.miss is None or row.miss >= truth for row in rows)
        assert {row.method for row in rows if row.proved} >= {PRODUCTS, TRAIN}


def test_brute_force_that_ends_has_looked_at_all_pairs_and_agrees(records: TeethRecords) -> None:
    ended = [row for row in records.rows if row.method == EVERY and row.proved]
    assert ended
    for row in ended:
        assert row.tries == row.considered or not row.miss
        beside = next(one for one in records.rows if one.question == row.question and one.method == PRODUCTS)
        assert row.miss == beside.miss


def test_brute_force_is_told_as_it_gets_better(records: TeethRecords) -> None:
    for rows in records.questions:
        trace = [row for row in rows if row.method == EVERY]
        errors = [row.miss for row in trace]
        assert errors == sorted(errors, reverse=True)
        assert [row.tries for row in trace] == sorted(row.tries for row in trace)
        assert [row.seconds for row in trace] == sorted(row.seconds for row in trace)


def test_every_question_is_requested_of_every_way(records: TeethRecords) -> None:
    for rows in records.questions:
        assert [row.method for row in rows] == sorted((row.method for row in rows), key=METHODS.index)
        assert {row.method for row in rows} == set(METHODS)


# the ways ------------------------------------------------------------------------------------------------------------


def test_brute_force_that_is_given_up_proves_nothing() -> None:
    case = RatioCase("", Fraction("3.14159265"), 3, (12, 40), (12, 40))
    last = ways.every_set(case, 0.0)[-1]
    assert last.tries == 29 * 30 * 31 // 6, "one set beneath"
    assert not last.proved
    assert ways.every_set(RatioCase("", Fraction(9, 4), 2, (12, 30), (12, 20)), 60.0)[-1].error == 0


def test_brute_force_agrees_with_loops_over_ordered_counts() -> None:
    case = RatioCase("", Fraction("1.7320508"), 2, (9, 16), (7, 11))
    truth = min(
        abs(Fraction(a * b, c * d) / case.value - 1)
        for a, b, c, d in product(range(9, 17), range(9, 17), range(7, 12), range(7, 12))
    )
    for found in (ways.every_set(case, 60.0)[-1], ways.by_products(case), ways.in_train(ways.chain(case), case)):
        assert found.proved
        assert found.error == truth


def test_convergents_are_factored_as_by_hand() -> None:
    # 355/113: 113 is a prime, no count of up to 100 brings it; 333/106 = 9*37 / (2*53)
    case = RatioCase("", Fraction("3.14159265358979"), 2, (12, 100), (12, 100))
    found = ways.factored(case, "convergent")
    assert found.error == abs(Fraction(333, 106) / case.value - 1)
    assert Fraction(prod(found.top), prod(found.beneath)) == Fraction(333, 106)
    wide = replace(case, wheels=(12, 113), pinions=(12, 113))
    assert ways.factored(wide, "convergent").error == abs(Fraction(355, 113) / case.value - 1)
    assert ways.factored(case, "intermediate").error <= found.error


def test_a_convergent_that_cannot_be_cut_is_passed_over() -> None:
    case = RatioCase("", Fraction(10007, 10009), 1, (12, 13), (14, 15))
    assert ways.factored(case, "convergent").error is None


def test_one_stage_takes_the_nearest_of_all_pairs() -> None:
    case = RatioCase("", Fraction("2.7182818"), 1, (20, 80), (10, 30))
    truth = min(abs(Fraction(a, b) / case.value - 1) for a in case.top for b in case.beneath)
    assert ways.by_stage(case).error == truth


def test_more_tries_are_never_worse() -> None:
    case = RatioCase("", Fraction("13.368267"), 3, (30, 100), (12, 40))
    found = [ways.by_stage(case, width) for width in (1, 2, 4, 8)]
    errors = [one.error for one in found]
    assert errors == sorted(errors, key=lambda error: error or 0, reverse=True)
    assert [one.tries for one in found] == [1, 4, 16, 64]


def test_pairs_near_a_share_below_one_keep_their_sides() -> None:
    for a, b in ways._nearest_pairs(range(30, 41), range(35, 51), Fraction("0.9"), 3):
        assert a in range(30, 41)
        assert b in range(35, 51)


# growth --------------------------------------------------------------------------------------------------------------


def test_the_printed_question_has_its_85_solutions(records: TeethRecords) -> None:
    (row,) = grown(records, PRINTED)
    assert row.solutions == 85


def test_counted_solutions_are_those_of_loops(records: TeethRecords) -> None:
    rows = {row.stages: row for row in grown(records, CHAIN)}
    counts, wanted, room = range(15, 31), Fraction("2.23607"), Fraction(1, 1000)
    ratios = [Fraction(a, b) for a, b in product(counts, counts)]
    near = [abs(ratio / wanted - 1) <= room for ratio in ratios]
    assert rows[1].solutions == sum(near)
    low, high = float(wanted * (1 - room)), float(wanted * (1 + room))
    floats = [float(ratio) for ratio in ratios]
    # no product of two is within 1e-12 of an end: floats decide
    products = [a * b for a in floats for b in floats]
    assert not any(abs(each / end - 1) < 1e-12 for each in products for end in (low, high))
    assert rows[2].solutions == sum(low <= each <= high for each in products)
