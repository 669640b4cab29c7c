"""Stages for one ratio: against all combinations tried one by one, printed numbers, and other ways to the answer."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, combinations_with_replacement, permutations
from math import comb, gcd, prod
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sampling import few_or_many

import geartrain.search.ratio.search_segments as stages_work
from geartrain.errors import QuestionError, RangeError
from geartrain.numerics import Journal, open_executor
from geartrain.search import StageConstraints, StageFindings, TargetRatio, find_stages

Set = tuple[int, ...]
MONTH = Fraction("13.368267")
ORDERS = ["error", "total", "largest", "distinct", "hunting", "centres"]


# all combinations, one by one -----------------------------------------------------------------------------------------


def pairings(top: Set, beneath: Set, fit: StageConstraints) -> list[list[tuple[int, int, bool]]]:
    """Every pairing with every choice of rings that the fit allows: (on top, beneath, with a ring)."""
    found = []
    for order in permutations(beneath):
        for rings in combinations(range(len(top)), fit.internal):
            stages = [(a, b, at in rings) for at, (a, b) in enumerate(zip(top, order, strict=True))]
            if any(ring and a == b for a, b, ring in stages):
                continue
            if fit.hunting and any(gcd(a, b) > 1 for a, b, _ in stages):
                continue
            if fit.reverted and len(distances(stages)) > 1:
                continue
            found.append(stages)
    return found


def distances(stages: Sequence[tuple[int, int, bool]]) -> set[int]:
    return {abs(a - b) if ring else a + b for a, b, ring in stages}


def every_solution(
    value: Fraction, stages: int, top: Set, beneath: Set, tolerance: Fraction | None, fit: StageConstraints, by: str
) -> list[tuple[Any, ...]]:
    """(what the order asks for, |error|, sum, largest, top, beneath) of every solution, in order."""
    found = []
    lowers = [(under, prod(under)) for under in combinations_with_replacement(beneath, stages)]
    for over in combinations_with_replacement(top, stages):
        scaled = prod(over) * value.denominator
        for under, product in lowers:
            off, whole = abs(scaled - product * value.numerator), product * value.numerator  # |error| is off/whole
            if tolerance is not None and off * tolerance.denominator > tolerance.numerator * whole:
                continue
            both = over + under
            if fit.different and len(set(both)) < len(both):
                continue
            if fit.maximum_total is not None and sum(both) > fit.maximum_total:
                continue
            ways = pairings(over, under, fit)
            if not ways:
                continue
            first = {
                "error": 0,
                "total": sum(both),
                "largest": max(both),
                "distinct": len(set(both)),
                "hunting": -max(sum(gcd(a, b) == 1 for a, b, _ in way) for way in ways),
                "centres": min(len(distances(way)) for way in ways),
            }[by]
            found.append((first, Fraction(off, whole), sum(both), max(both), over, under))
    return sorted(found)


def listed(found: StageFindings) -> list[tuple[Set, Set]]:
    return [(solution.top, solution.beneath) for solution in found]


def check_account(found: StageFindings, top: Sequence[int], beneath: Sequence[int]) -> None:
    """Every pair of sets is a solution, or charged to one reason."""
    size = found.stages
    assert found.considered == comb(len(top) + size - 1, size) * comb(len(beneath) + size - 1, size)
    assert found.considered == found.count + sum(found.shortfall.removed.values())


@st.composite
def counts(draw: st.DrawFn, most: int = 5) -> Set:
    return tuple(sorted(draw(st.sets(st.integers(1, 30), min_size=1, max_size=most))))


@st.composite
def fits(draw: st.DrawFn, stages: int) -> StageConstraints:
    return StageConstraints(
        hunting=draw(st.booleans()),
        reverted=draw(st.sampled_from([False, False, True])),
        different=draw(st.sampled_from([False, False, True])),
        internal=draw(st.sampled_from([0, 0, 0, draw(st.integers(0, stages))])),
        maximum_total=draw(st.sampled_from([None, None, draw(st.integers(40, 200))])),
    )


@st.composite
def questions(draw: st.DrawFn) -> tuple[Fraction, int, Set, Set, StageConstraints]:
    stages = draw(st.sampled_from([1, 2, 2, 3, 4]))
    top, beneath = (draw(counts({1: 12, 2: 7, 3: 4, 4: 3}[stages])) for _ in range(2))
    near = Fraction(prod(draw(st.sampled_from(top)) for _ in range(stages)))
    near /= prod(draw(st.sampled_from(beneath)) for _ in range(stages))
    value = near * draw(st.fractions(Fraction(1, 2), 2, max_denominator=10**6))
    return draw(st.sampled_from([near, value])), stages, top, beneath, draw(fits(stages))


def requested(value: Fraction, stages: int, top: Set, beneath: Set, **more: Any) -> StageFindings:
    """A ratio below 1 has its pinions on top."""
    wheels, pinions = (top, beneath) if value >= 1 else (beneath, top)
    return find_stages(TargetRatio(value), stages, wheels, pinions, **more)


@given(questions(), st.fractions(0, Fraction(1, 2)), st.sampled_from(ORDERS), st.integers(1, 12))
@settings(max_examples=few_or_many(70, 150))
def test_all_solutions_within_a_tolerance_are_counted_and_the_best_listed(
    question: tuple[Fraction, int, Set, Set, StageConstraints], tolerance: Fraction, by: str, best: int
) -> None:
    value, stages, top, beneath, fit = question
    found = requested(value, stages, top, beneath, tolerance=tolerance, by=by, best=best, fit=fit)
    expected = every_solution(value, stages, top, beneath, tolerance, fit, by)
    assert found.complete
    assert found.count == len(expected)
    assert listed(found) == [key[4:] for key in expected[:best]]
    assert [abs(solution.error) for solution in found] == [key[1] for key in expected[:best]]
    check_account(found, top, beneath)
    for solution in found:
        ways = [[(a, b) for a, b, _ in way] for way in pairings(solution.top, solution.beneath, fit)]
        assert sorted(solution.pairs) in [sorted(way) for way in ways]


@given(questions(), st.integers(1, 12))
@settings(max_examples=few_or_many(40, 80))
def test_without_a_tolerance_the_best_are_the_best_of_all(
    question: tuple[Fraction, int, Set, Set, StageConstraints], best: int
) -> None:
    value, stages, top, beneath, fit = question
    found = requested(value, stages, top, beneath, best=best, fit=fit)
    expected = every_solution(value, stages, top, beneath, None, fit, "error")
    assert listed(found) == [key[4:] for key in expected[:best]]
    assert found.count == sum(key[1] <= found.tolerance for key in expected)
    assert found.count >= min(best, len(expected))
    check_account(found, top, beneath)


@given(questions(), st.fractions(0, Fraction(1, 2)), st.sampled_from(ORDERS), st.sampled_from([2, 5, 12]))
@settings(max_examples=few_or_many(25, 50))
def test_pieces_and_blocks_of_any_size_give_the_same(
    question: tuple[Fraction, int, Set, Set, StageConstraints], tolerance: Fraction, by: str, block: int
) -> None:
    value, stages, top, beneath, fit = question
    whole = requested(value, stages, top, beneath, tolerance=tolerance, by=by, best=3, fit=fit)
    nearest = requested(value, stages, top, beneath, best=3, fit=fit)
    with pytest.MonkeyPatch.context() as patch:
        cut_into(patch, block)
        cut = requested(value, stages, top, beneath, tolerance=tolerance, by=by, best=3, fit=fit)
        assert cut == whole
        assert listed(requested(value, stages, top, beneath, best=3, fit=fit)) == listed(nearest)


def test_five_stages_agree_with_all_combinations() -> None:
    top, beneath, value = (20, 21, 37), (11, 12, 17, 19), Fraction("12.3456")
    expected = every_solution(value, 5, top, beneath, None, StageConstraints(), "error")
    assert listed(find_stages(TargetRatio(value), 5, top, beneath, best=40)) == [key[4:] for key in expected[:40]]
    near = find_stages(TargetRatio(value), 5, top, beneath, tolerance=Fraction(1, 100), by="centres")
    expected = every_solution(value, 5, top, beneath, Fraction(1, 100), StageConstraints(), "centres")
    assert (near.count, listed(near)) == (len(expected), [key[4:] for key in expected[:20]])


def cut_into(patch: pytest.MonkeyPatch, block: int) -> None:
    """Let only so many products be held at once."""
    patch.setattr(stages_work, "BLOCK", block)
    patch.setattr(stages_work, "PER_ROW", 0)


# printed numbers ------------------------------------------------------------------------------------------------------


def of_the_month(ratio: Fraction = MONTH, sense: Any = 0, internal: int = 0) -> StageFindings:
    """Two stages for the month."""
    fit = StageConstraints(internal=internal)
    return find_stages(
        TargetRatio(ratio, sense), 2, range(30, 131), range(12, 41), tolerance=Fraction(1, 10**5), fit=fit
    )


def test_two_stages_for_the_month_have_nine_solutions_and_its_inverse_has_the_pinions_on_top() -> None:
    fast, slow = of_the_month(), of_the_month(1 / MONTH)
    assert (fast.count, len(fast), fast.complete) == (9, 9, True)
    assert slow.top == tuple(range(12, 41))
    assert {(s.beneath, s.top) for s in slow} == {(s.top, s.beneath) for s in fast}


def test_three_stages_for_the_month_have_eighty_five_solutions() -> None:
    found = find_stages(TargetRatio(MONTH), 3, range(30, 101), range(15, 41), tolerance=Fraction(1, 10**6), best=100)
    assert found.count == len(found) == 85
    best = [solution for solution in found if solution.ratio == Fraction(39 * 73 * 91, 15 * 34 * 38)]
    assert ((39, 73, 91), (15, 34, 38)) in [(solution.top, solution.beneath) for solution in best]
    assert list(found.solutions[: len(best)]) == best
    assert float(best[0].error) == pytest.approx(-5.58e-8, abs=5e-11)


def test_the_best_three_stages_of_all_counts_from_12_to_100_are_the_best() -> None:
    value = Fraction("13.36838")
    products = sorted({a * b * c for a, b, c in combinations_with_replacement(range(12, 101), 3)})
    minimum = Fraction(1)
    for beneath in products:
        at = bisect_left(products, float(beneath * value))
        for over in products[max(at - 1, 0) : at + 1]:
            error = float(over) / float(beneath) / float(value) - 1
            if abs(error) < float(minimum) + 1e-15:
                minimum = min(minimum, abs(Fraction(over, beneath) / value - 1))
    found = find_stages(TargetRatio(value), 3, range(12, 101), range(12, 101))
    assert abs(found[0].error) == minimum
    assert found[0].ratio == Fraction(37 * 59 * 71, 17 * 22 * 31)
    assert found.considered == comb(91, 3) ** 2
    assert found.count >= 20


def test_an_exact_ratio_is_met_exactly_with_the_fewest_teeth_first() -> None:
    value = Fraction(235, 19)
    found = find_stages(TargetRatio(value), 2, range(12, 121), range(12, 121), tolerance=Fraction(0), best=50)
    expected = [
        (sum(top) + sum(beneath), max(*top, *beneath), top, beneath)
        for top in combinations_with_replacement(range(12, 121), 2)
        if 19 * prod(top) % 235 == 0
        for beneath in [(low, 19 * prod(top) // 235 // low) for low in range(12, 121)]
        if beneath[0] <= beneath[1] <= 120 and prod(beneath) * 235 == prod(top) * 19
    ]
    assert found.count == len(expected)
    assert listed(found) == [key[2:] for key in sorted(expected)[:50]]
    assert all(solution.error == 0 for solution in found)


def test_many_solutions_are_listed_as_well_as_few() -> None:
    question = (TargetRatio(MONTH), 3, range(30, 101), range(15, 41))
    all_of_them = find_stages(*question, tolerance=Fraction(1, 20000), best=20000)
    some = find_stages(*question, tolerance=Fraction(1, 20000), best=900)
    assert len(all_of_them) == all_of_them.count == some.count > 8000
    assert all_of_them.solutions[:900] == some.solutions


# exact windows --------------------------------------------------------------------------------------------------------


def test_products_of_fifteen_digits_are_found_exactly() -> None:
    top = tuple(range(6 * 10**7, 6 * 10**7 + 16))
    beneath = tuple(range(6 * 10**7 + 7, 6 * 10**7 + 20))
    value = Fraction(10**15 + 3, 10**15)
    expected = every_solution(value, 2, top, beneath, Fraction(1, 10**8), StageConstraints(), "error")
    found = requested(value, 2, top, beneath, tolerance=Fraction(1, 10**8))
    assert expected
    assert (found.count, listed(found)) == (len(expected), [key[4:] for key in expected[:20]])
    small = find_stages(TargetRatio(Fraction(10**15)), 2, top, (3, 5), best=3)
    expected = every_solution(Fraction(10**15), 2, top, (3, 5), None, StageConstraints(), "error")
    assert listed(small) == [key[4:] for key in expected[:3]]


# what an empty answer says --------------------------------------------------------------------------------------------


def test_a_sense_that_no_counts_can_give_is_named() -> None:
    found = of_the_month(sense=-1)
    assert (found.count, found.complete) == (0, True)
    assert found.shortfall.removed == {"opposite sense of rotation": found.considered}
    for word in ("idler", "stage", "internal=1"):
        assert word in found.shortfall.advice
    assert of_the_month(sense=-1, internal=1).count == of_the_month(sense=1).count == 9


def test_an_empty_answer_names_the_nearest_miss_a_tolerance_that_gives_it_and_one_more_stage() -> None:
    question = (TargetRatio(Fraction("13.36838")), 2, range(12, 101), range(12, 101))
    found = find_stages(*question, tolerance=Fraction(1, 10**7))
    best = find_stages(*question, best=1)[0]
    three = find_stages(question[0], 3, *question[2:], tolerance=Fraction(1, 10**7))
    assert found.count == 0
    assert found.shortfall.removed == {"outside the tolerance": found.considered}
    assert "73 x 89 / 18 x 27" in found.shortfall.nearest
    assert (best.top, best.beneath) == ((73, 89), (18, 27))
    told = Fraction(found.shortfall.advice.split("tolerance of ")[1].split(" gives")[0])
    assert find_stages(*question, tolerance=told).count == 1
    assert f"one more stage gives {three.count} solutions" in found.shortfall.advice


def test_a_condition_that_removes_everything_is_charged() -> None:
    found = find_stages(
        TargetRatio(Fraction(16)), 2, (40, 80), (10, 20), tolerance=Fraction(0), fit=StageConstraints(hunting=True)
    )
    assert found.shortfall.removed["no pairing with coprime counts in every stage"] == 3
    assert "no counts satisfy the constraints" in found.shortfall.nearest
    assert "without constraints" in found.shortfall.nearest


def test_an_order_that_needs_a_tolerance_says_which_was_used() -> None:
    found = find_stages(TargetRatio(MONTH), 3, range(30, 101), range(15, 41), by="total")
    assert found.count == 85
    assert "1e-6" in found.note
    data = found.to_dict()
    assert (data["complete"], data["count"], data["tolerance"], len(data["solutions"])) == (True, 85, 1e-6, 20)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"stages": 6}, "stages is 6"),
        ({"stages": 0}, "stages is 0"),
        ({"best": 0}, "best is 0"),
        ({"by": "beauty"}, "beauty"),
        ({"tolerance": Fraction(-1)}, "tolerance"),
        ({"fit": StageConstraints(internal=3)}, "internal"),
        ({"wheels": ()}, "no tooth counts"),
        ({"wheels": (0, 3)}, "0 teeth"),
    ],
)
def test_questions_without_sense_are_refused(change: dict[str, Any], said: str) -> None:
    question = {"wanted": TargetRatio(MONTH), "stages": 2, "wheels": range(30, 60), "pinions": range(12, 20), **change}
    with pytest.raises(QuestionError) as caught:
        find_stages(**question)
    assert said in str(caught.value)
    assert all(problem.fix for problem in caught.value.problems)


@pytest.mark.parametrize(
    ("stages", "wheels", "pinions", "fit", "said"),
    [
        (5, range(12, 1200), range(12, 1200), StageConstraints(), "too many"),
        (2, range(10**9, 10**9 + 10000), range(12, 2000), StageConstraints(), "too large"),
        (4, range(12, 212), range(12, 212), StageConstraints(hunting=True), "reduce the tolerance"),
    ],
)
def test_what_would_need_too_much_memory_or_time_is_refused(
    stages: int, wheels: range, pinions: range, fit: StageConstraints, said: str
) -> None:
    with pytest.raises(RangeError, match=said):
        find_stages(TargetRatio(MONTH), stages, wheels, pinions, tolerance=Fraction(1, 1000), fit=fit)


def test_a_ratio_beyond_all_counts_is_refused_or_missed_by_the_nearest() -> None:
    with pytest.raises(RangeError, match="cannot be approximated"):
        find_stages(TargetRatio(Fraction(10**29)), 3, range(12, 101), range(12, 101))
    with pytest.raises(QuestionError, match="from 1e-30 to 1e30"):
        TargetRatio(Fraction(10**999))
    question = (TargetRatio(Fraction(10**6)), 3, range(12, 101), range(12, 101))
    found = find_stages(*question, tolerance=Fraction(1, 100))
    assert "100 x 100 x 100 / 12 x 12 x 12" in found.shortfall.nearest
    best = find_stages(*question, best=2)
    assert listed(best) == [((100, 100, 100), (12, 12, 12)), ((99, 100, 100), (12, 12, 12))]


# many workers, and work cut short -------------------------------------------------------------------------------------


QUESTION = (TargetRatio(Fraction("13.36838")), 3, range(12, 61), range(12, 61))


@pytest.mark.parametrize("by", ["error", "total", "hunting"])
def test_processes_give_the_same(monkeypatch: pytest.MonkeyPatch, by: str) -> None:
    alone = find_stages(*QUESTION, tolerance=Fraction(1, 10**5), by=by)
    cut_into(monkeypatch, 500)
    told: list[tuple[int, int]] = []
    with open_executor(2) as executor:
        both = find_stages(
            *QUESTION, tolerance=Fraction(1, 10**5), by=by, executor=executor, tell=lambda *n: told.append(n)
        )
    assert both == alone
    assert told[-1][0] == told[-1][1] > 5


def test_an_interrupt_keeps_what_was_found_and_a_journal_takes_it_up(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    cut_into(monkeypatch, 500)
    whole = find_stages(*QUESTION, tolerance=Fraction(1, 10**5))
    real, calls = stages_work.search_segment, []

    def some(packed: bytes, task: Any) -> Any:
        calls.append(task)
        if len(calls) == 25:
            raise KeyboardInterrupt
        return real(packed, task)

    monkeypatch.setattr("geartrain.search.ratio.search_segments.search_segment", some)
    with Journal(tmp_path / "journal", {"month": 1}) as journal:
        part = find_stages(*QUESTION, tolerance=Fraction(1, 10**5), journal=journal)
        assert 0 < len(journal) < 25
    assert not part.complete
    assert 0 < part.count < whole.count
    done = len(calls)
    with Journal(tmp_path / "journal", {"month": 1}) as journal:
        again = find_stages(*QUESTION, tolerance=Fraction(1, 10**5), journal=journal)
        assert again == whole
        # what the journal has is not done again
        assert len(calls) - done == len(journal) - (done - 1)
