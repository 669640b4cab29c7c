"""Sums over what a join leaves, with any weights: against loops over all assignments, exactly."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, product
from math import exp, prod
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sampling import few_or_many
from test_exact_join import Quotient, joins, solutions

import geartrain.search.join.exact_join as joining
from geartrain.search.constraints.count_conditions import CountConstraint
from geartrain.search.join.exact_join import BudgetSpentError, ExactJoin
from geartrain.search.join.inside_outside import AssignmentSums, BestFirst, record_join
from geartrain.search.join.join_plan import find_join_problem
from geartrain.search.join.wheel_monomials import IntervalConstraint

Asked = tuple[dict[str, tuple[int, ...]], list[IntervalConstraint], list[CountConstraint]]
LONG = 10**30


@st.composite
def weighed(draw: st.DrawFn, largest: int) -> tuple[Asked, dict[str, tuple[int, ...]]]:
    """A question, and whole weights of the counts of some wheels."""
    requested = draw(joins())
    some = draw(st.sets(st.sampled_from(sorted(requested[0]))))
    number = st.integers(0, 5) if largest < 10 else st.integers(1, largest)
    weights = {wheel: tuple(draw(number) for _ in requested[0][wheel]) for wheel in sorted(some)}
    assume(all(map(any, weights.values())))
    return requested, weights


def weight_of(counts: tuple[int, ...], domains: dict[str, tuple[int, ...]], weights: dict[str, tuple[int, ...]]) -> int:
    places = {wheel: at for at, wheel in enumerate(domains)}
    return prod(own[domains[wheel].index(counts[places[wheel]])] for wheel, own in weights.items())


@settings(deadline=None, max_examples=few_or_many(40, 60))
@given(case=weighed(5), guess=st.sampled_from([1.0, 1e-6]))
def test_a_count_with_weights_is_the_weight_of_what_fits(case: tuple[Asked, Any], guess: float) -> None:
    (domains, requested, rules), weights = case
    problem = find_join_problem(
        domains, requested, rules, dict.fromkeys([one.name for one in (*requested, *rules)], guess), weights
    )
    assume(not problem.late)
    join = ExactJoin(problem)
    counted, removed = join.count(problem.plan, join.start())
    truth = sum(weight_of(counts, domains, weights) for counts in solutions(domains, requested, rules))
    assert counted[0] == truth
    everything = sum(weight_of(counts, domains, weights) for counts in product(*domains.values()))
    assert problem.total == everything
    assert sum(int(numbers[0]) for numbers in removed.values()) + truth == everything


@pytest.mark.parametrize("largest", [5, LONG])
@pytest.mark.parametrize("block", [1 << 18, 3])
def test_sums_over_a_recorded_join_are_those_of_loops(largest: int, block: int) -> None:
    @settings(deadline=None, max_examples=few_or_many(20, 60))
    @given(case=weighed(largest), guess=st.sampled_from([1.0, 1e-6]))
    def holds(case: tuple[Asked, Any], guess: float) -> None:
        (domains, requested, rules), some = case
        problem = find_join_problem(
            domains, requested, rules, dict.fromkeys([one.name for one in (*requested, *rules)], guess)
        )
        assume(not problem.late)
        truth = solutions(domains, requested, rules)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(joining, "BLOCK", block)
            root, _ = record_join(problem, np.inf, {})
        dtype: Any = np.int64 if largest < 10 else object
        weights = {w: np.array(some.get(w, (1,) * len(counts)), dtype=dtype) for w, counts in domains.items()}
        sums = AssignmentSums(root, graded=False)
        own = [weight_of(counts, domains, some) for counts in truth]
        assert sums.total(weights) == sum(own)
        assert sorted(tuple(one.teeth[wheel] for wheel in domains) for one in BestFirst(root, domains)) == truth
        if not truth:
            return
        marginals = sums.marginals(weights)
        assert marginals.keys() == domains.keys()
        for at, (wheel, counts) in enumerate(domains.items()):
            expected = [
                sum(weight for row, weight in zip(truth, own, strict=True) if row[at] == count) for count in counts
            ]
            assert marginals[wheel].tolist() == expected
        _check_covariances(sums, domains, truth)

    holds()


def _check_covariances(sums: AssignmentSums, domains: dict[str, tuple[int, ...]], truth: list[tuple[int, ...]]) -> None:
    floats = {wheel: np.full(len(counts), 1 / len(counts)) for wheel, counts in domains.items()}
    names = list(domains)
    for (first, second), value in sums.covariances(floats, domains).items():
        x, y = ([row[names.index(wheel)] for row in truth] for wheel in (first, second))
        assert value == pytest.approx(float(np.cov(x, y, bias=True)[0, 1]), abs=1e-9)


@settings(deadline=None, max_examples=few_or_many(40, 60))
@given(case=joins(), wanted=st.lists(st.fractions(-3, 3, max_denominator=4), min_size=3, max_size=3))
def test_grades_multiply_weights_and_order_what_fits(case: Asked, wanted: list[Fraction]) -> None:
    domains, requested, rules = case
    graded = [IntervalConstraint(one.name, one.function, one.intervals, one.strict, graded=True) for one in requested]
    problem = find_join_problem(domains, graded, rules, {})
    assume(not problem.late)
    truth = solutions(domains, requested, rules)
    ends = [float(one) for one in wanted]
    root, _ = record_join(
        problem, np.inf, {at: lambda values, end=end: (values - end) ** 2 for at, end in enumerate(ends)}
    )  # type: ignore[misc]

    def misfit(row: tuple[int, ...]) -> float:
        teeth = dict(zip(domains, row, strict=True))
        speeds = [one.function.value(teeth) for one in requested if isinstance(one.function, Quotient)]
        return sum((float(speed or 0) - end) ** 2 for speed, end in zip(speeds, ends, strict=False))

    ones = {wheel: np.ones(len(counts)) for wheel, counts in domains.items()}
    total = AssignmentSums(root, graded=True).total(ones)
    assert total == pytest.approx(sum(exp(-misfit(row) / 2) for row in truth), rel=1e-9, abs=1e-300)
    found = list(BestFirst(root, domains))
    assert sorted(tuple(one.teeth[wheel] for wheel in domains) for one in found) == truth
    for one in found:
        assert one.misfit == pytest.approx(misfit(tuple(one.teeth[wheel] for wheel in domains)), rel=1e-9, abs=1e-12)
    misfits = [one.misfit for one in found]
    assert all(later >= earlier * (1 - 1e-12) - 1e-12 for earlier, later in pairwise(misfits))


def test_a_record_keeps_to_its_budget() -> None:
    domains = {"a": tuple(range(1, 40)), "b": tuple(range(1, 40))}
    product_ = Quotient(("a", "b"), ((1, (1, 1)), (1, (2, 0))), ((1, (0, 0)),))
    problem = find_join_problem(domains, [IntervalConstraint("any", product_, ((None, Fraction(10**6)),))], [], {})
    with pytest.raises(BudgetSpentError):
        record_join(problem, 1000, {})
    assert (
        AssignmentSums(record_join(problem, 10**5, {})[0], graded=False).total(
            {wheel: np.ones(39, dtype=np.int64) for wheel in "ab"}
        )
        == 39**2
    )
