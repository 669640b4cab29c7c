"""The join behind the search in trains and the posterior: signs, windows, sums and order, against plain loops."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, product
from math import exp, prod
from operator import le, lt
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from sampling import few_or_many

import geartrain.search.join.exact_join as joining
import geartrain.search.join.product_lists as lists
from geartrain.search.constraints import CountEquation
from geartrain.search.join import AssignmentSums, BestFirst, IntervalConstraint, find_join_problem, record_join

Row = tuple[int, ...]
Domains = dict[str, Row]
Terms = tuple[tuple[int, Row], ...]
Asked = tuple[Domains, list[IntervalConstraint], list[CountEquation]]
LONG = 10**30


@dataclass(frozen=True)
class Quotient:
    """A rational function of counts, as the search takes it."""

    wheels: tuple[str, ...]
    numerator: Terms
    denominator: Terms

    def value(self, teeth: Mapping[str, int], /) -> Fraction | None:
        above, below = (
            value(terms, [teeth[wheel] for wheel in self.wheels]) for terms in (self.numerator, self.denominator)
        )
        return Fraction(above, below) if below else None


def value(terms: Terms, point: Sequence[int]) -> int:
    return sum(
        coefficient * prod(count**power for count, power in zip(point, powers, strict=True))
        for coefficient, powers in terms
    )


@st.composite
def joins(draw: st.DrawFn) -> Asked:
    """Functions of any shape that share wheels, asked for values they have; and rules."""
    names = tuple("abcdef"[: draw(st.integers(2, 6))])
    domains = {name: tuple(sorted(draw(st.sets(st.integers(1, 9), min_size=1, max_size=3)))) for name in names}
    requested = []
    for number in range(draw(st.integers(1, 3))):
        wheels = tuple(sorted(draw(st.sets(st.sampled_from(names), min_size=1, max_size=4))))
        powers = st.tuples(*[st.integers(0, 2)] * len(wheels))
        terms = st.lists(st.tuples(st.integers(-4, 4).filter(bool), powers), min_size=1, max_size=3).map(merge)
        function = Quotient(wheels, draw(terms.filter(bool)), draw(terms.filter(bool)))
        if not any(any(powers) for _, powers in (*function.numerator, *function.denominator)):
            continue
        teeth = {wheel: draw(st.sampled_from(domains[wheel])) for wheel in wheels}
        middle = function.value(teeth) or Fraction(draw(st.integers(-3, 3)))
        width = draw(st.sampled_from([Fraction(0), abs(middle) / 10, Fraction(1)]))
        low, high = middle - width, middle + width
        intervals = draw(
            st.sampled_from([((low, high),), ((low, high), (high + 1, None)), ((None, low),), ((low, None),)])
        )
        requested.append(IntervalConstraint(f"demand {number}", used(function), intervals, draw(st.booleans())))
    rules: list[CountEquation] = []
    if draw(st.booleans()):
        pair = draw(st.lists(st.sampled_from(names), min_size=2, max_size=3, unique=True))
        start = sum(factor * domains[wheel][0] for factor, wheel in zip((1, -1, 2), pair, strict=False))
        rules.append(CountEquation("sum", dict(zip(pair, (1, -1, 2), strict=False)), -start))
    return domains, requested, rules


def merge(terms: list[tuple[int, Row]]) -> Terms:
    total: Counter[Row] = Counter()
    for coefficient, powers in terms:
        total[powers] += coefficient
    return tuple((coefficient, powers) for powers, coefficient in total.items() if coefficient)


def used(function: Quotient) -> Quotient:
    """Without wheels that are in no term."""
    every = (*function.numerator, *function.denominator)
    kept = [at for at in range(len(function.wheels)) if any(powers[at] for _, powers in every)]

    def cut(terms: Terms) -> Terms:
        return tuple((coefficient, tuple(powers[at] for at in kept)) for coefficient, powers in terms)

    return Quotient(tuple(function.wheels[at] for at in kept), cut(function.numerator), cut(function.denominator))


def solutions(domains: Domains, requested: list[IntervalConstraint], rules: list[CountEquation]) -> list[Row]:
    found = []
    for counts in product(*domains.values()):
        teeth = dict(zip(domains, counts, strict=True))
        if all(fits(one, teeth) for one in requested) and all(keeps(rule, teeth) for rule in rules):
            found.append(counts)
    return found


def fits(requested: IntervalConstraint, teeth: dict[str, int]) -> bool:
    speed = requested.function.value(teeth)
    if speed is None:
        return False
    below = lt if requested.strict else le
    return any(
        (low is None or below(low, speed)) and (high is None or below(speed, high)) for low, high in requested.intervals
    )


def keeps(rule: CountEquation, teeth: dict[str, int]) -> bool:
    return sum(factor * teeth[wheel] for wheel, factor in rule.coefficients.items()) + rule.constant == 0


@st.composite
def weighed(draw: st.DrawFn, largest: int) -> tuple[Asked, Domains]:
    """A question, and whole weights of the counts of some wheels."""
    requested = draw(joins())
    some = draw(st.sets(st.sampled_from(sorted(requested[0]))))
    number = st.integers(0, 5) if largest < 10 else st.integers(1, largest)
    weights = {wheel: tuple(draw(number) for _ in requested[0][wheel]) for wheel in sorted(some)}
    assume(all(map(any, weights.values())))
    return requested, weights


def weight_of(counts: Row, domains: Domains, weights: Domains) -> int:
    places = {wheel: at for at, wheel in enumerate(domains)}
    return prod(own[domains[wheel].index(counts[places[wheel]])] for wheel, own in weights.items())


@pytest.mark.parametrize("largest", [5, LONG])
@pytest.mark.parametrize("block", [1 << 18, 3])
def test_sums_over_a_recorded_join_are_those_of_loops(largest: int, block: int) -> None:
    @settings(deadline=None, max_examples=few_or_many(20, 60))
    @given(case=weighed(largest), guess=st.sampled_from([1.0, 1e-6]))
    def holds(case: tuple[Asked, Any], guess: float) -> None:
        (domains, requested, rules), some = case
        guesses = dict.fromkeys([one.name for one in (*requested, *rules)], guess)
        problem = find_join_problem(domains, requested, rules, probabilities=guesses)
        assume(not problem.late)
        truth = solutions(domains, requested, rules)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(joining, "BLOCK", block)
            patch.setattr(lists, "BLOCK", block)
            patch.setattr(lists, "_LONGEST", block)
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


def _check_covariances(sums: AssignmentSums, domains: Domains, truth: list[Row]) -> None:
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
    problem = find_join_problem(domains, graded, rules, probabilities={})
    assume(not problem.late)
    truth = solutions(domains, requested, rules)
    ends = [float(one) for one in wanted]
    root, _ = record_join(
        problem, np.inf, {at: lambda values, end=end: (values - end) ** 2 for at, end in enumerate(ends)}
    )  # type: ignore[misc]

    def misfit(row: Row) -> float:
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


sizes = st.one_of(st.integers(1, 12), st.integers(10**8, 10**9))
coefficients = st.one_of(st.integers(-50, 50), st.integers(-(10**40), 10**40)).filter(bool)


@st.composite
def long_joins(draw: st.DrawFn) -> tuple[Domains, list[IntervalConstraint]]:
    """Polynomials whose terms cancel at one assignment, up to what floats cannot see, or nothing."""
    names = "abc"[: draw(st.integers(1, 3))]
    domains = {name: tuple(sorted(draw(st.sets(sizes, min_size=1, max_size=4)))) for name in names}
    powers = st.tuples(*[st.integers(0, 2)] * len(names))
    requested = []
    for number in range(draw(st.integers(1, 2))):
        terms = draw(st.lists(st.tuples(coefficients, powers), min_size=1, max_size=4).map(merge).filter(bool))
        whole = Quotient(tuple(names), terms, ((1, (0,) * len(names)),))
        teeth = {name: draw(st.sampled_from(counts)) for name, counts in domains.items()}
        root = whole.value(teeth) or Fraction(0)
        low, high = root - draw(st.integers(0, 1)), root + draw(st.integers(0, 1))
        intervals = draw(
            st.sampled_from([((low, high),), ((None, low),), ((high, None),), ((None, low), (high, None))])
        )
        if low == high:
            intervals = intervals[:1]
        function = used(whole)
        if function.wheels:
            requested.append(IntervalConstraint(f"demand {number}", function, intervals, draw(st.booleans())))
    return domains, requested


# 10^16 and 10^16 + 1 are one float: the windows of both intervals hold the same count
COUNTS_BY_A_GAP = {"a": (1, 2, 10**8)}
BESIDE_THE_GAP = IntervalConstraint(
    "beside a gap",
    Quotient(("a",), ((1, (2,)),), ((1, (0,)),)),
    ((None, Fraction(10**16)), (Fraction(10**16 + 1), None)),
)


@settings(deadline=None, max_examples=few_or_many(70, 150))
@given(long_joins(), st.sampled_from([1.0, 1e-6]))
@example((COUNTS_BY_A_GAP, [BESIDE_THE_GAP]), 1.0)
def test_joins_are_exact_however_large_the_numbers_and_near_the_ends(
    question: tuple[Domains, list[IntervalConstraint]], guess: float
) -> None:
    domains, requested = question
    problem = find_join_problem(domains, requested, [], probabilities={one.name: guess for one in requested})
    root, _ = record_join(problem, np.inf, {})
    found = sorted(tuple(one.teeth[wheel] for wheel in domains) for one in BestFirst(root, domains))
    assert found == solutions(domains, requested, [])
