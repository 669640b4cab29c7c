"""The join behind the search in trains: signs, windows, bounds and counts, each against Fractions and plain loops."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from sampling import few_or_many

import geartrain.search.join.exact_join as joining
import geartrain.search.join.product_lists as items
import geartrain.search.join.product_lists as rows
from geartrain.search.constraints.count_conditions import Condition, CountConstraint, CountEquation
from geartrain.search.join.exact_join import ExactJoin
from geartrain.search.join.join_plan import JoinProblem, find_join_problem
from geartrain.search.join.product_lists import Item, ItemRecipe, forecast
from geartrain.search.join.wheel_monomials import IntervalConstraint, find_wheel_monomials
from geartrain.search.train.search_passes import AssignmentOrder, BestAssignments, PassWork, do_task, merged

Terms = tuple[tuple[int, tuple[int, ...]], ...]


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


# ---------------------------------------------------------------------------------------------------------------- lists


@given(st.lists(st.tuples(st.sets(st.integers(1, 40), min_size=1, max_size=6), st.integers(1, 2)), max_size=4))
def test_an_item_lists_every_product_with_all_its_ways(lots: list[tuple[set[int], int]]) -> None:
    domains = {f"w{at}": tuple(sorted(counts)) for at, (counts, _) in enumerate(lots)}
    wheels = tuple((f"w{at}", power) for at, (_, power) in enumerate(lots))
    ways: dict[Fraction, Counter[tuple[int, ...]]] = {}
    for counts in product(*domains.values()):
        tops = [count**power for count, (_, power) in zip(counts[::2], wheels[::2], strict=True)]
        bottoms = [count**power for count, (_, power) in zip(counts[1::2], wheels[1::2], strict=True)]
        ways.setdefault(Fraction(prod(tops), prod(bottoms)), Counter())[counts] += 1
    item = Item(ItemRecipe(wheels[::2], wheels[1::2]), domains, {}, np.int64)
    assert (np.diff(item.x) >= 0).all()
    bottoms = np.ones(len(item), dtype=np.int64) if item.bottoms is None else item.bottoms
    listed = [Fraction(int(top), int(bottom)) for top, bottom in zip(item.tops, bottoms, strict=True)]
    found: dict[Fraction, Counter[tuple[int, ...]]] = {}
    owner, columns = item.ways(np.arange(len(item)))
    for at, row in zip(owner.tolist(), zip(*(columns[wheel].tolist() for wheel in domains), strict=True), strict=False):
        found.setdefault(listed[at], Counter())[tuple(row)] += 1
    if domains:
        assert found == ways
    assert item.sums[-1] == item.times.sum() == sum(counter.total() for counter in ways.values())
    assert np.bincount(owner, minlength=len(item)).tolist() == item.times.tolist()


def test_long_lists_are_made_in_blocks_and_forecast_within_a_factor_of_three(monkeypatch: pytest.MonkeyPatch) -> None:
    domains = {wheel: tuple(range(15, 81)) for wheel in "abcd"}
    wheels = tuple((wheel, 1) for wheel in "abcd")
    ones = [(1,) * 66] * 4
    whole = items.ProductLists([domains[wheel] for wheel in "abcd"], ones, np.int64)
    monkeypatch.setattr(items, "_LONGEST", 5000)
    parts = items.ProductLists([domains[wheel] for wheel in "abcd"], ones, object)
    assert (whole.levels[-1] == parts.levels[-1]).all()
    assert (whole.times == parts.times).all()
    assert whole.times.sum() == 66**4
    items._forecast.cache_clear()
    monkeypatch.setattr(items, "_TRIED", 10_000)
    guessed, _ = forecast(wheels, domains)
    assert 1 / 3 < guessed / len(whole.times) < 3


# ---------------------------------------------------------------------------------------------------------------- joins


@dataclass(frozen=True)
class Even:
    """The sum of some wheels' counts is even."""

    wheels: tuple[str, ...]

    def __call__(self, columns: Any, /) -> Any:
        return sum(columns[wheel] for wheel in self.wheels) % 2 == 0


@st.composite
def joins(draw: st.DrawFn) -> tuple[dict[str, tuple[int, ...]], list[IntervalConstraint], list[CountConstraint]]:
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
    rules: list[CountConstraint] = []
    if draw(st.booleans()):
        pair = draw(st.lists(st.sampled_from(names), min_size=2, max_size=3, unique=True))
        start = sum(factor * domains[wheel][0] for factor, wheel in zip((1, -1, 2), pair, strict=False))
        rules.append(CountEquation("sum", dict(zip(pair, (1, -1, 2), strict=False)), -start))
    if draw(st.booleans()):
        pair = draw(st.lists(st.sampled_from(names), min_size=2, max_size=3, unique=True))
        rules.append(Condition("even", tuple(pair), Even(tuple(pair))))
    return domains, requested, rules


def merge(terms: list[tuple[int, tuple[int, ...]]]) -> Terms:
    total: Counter[tuple[int, ...]] = Counter()
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


def solutions(
    domains: dict[str, tuple[int, ...]], requested: list[IntervalConstraint], rules: list[CountConstraint]
) -> list[tuple[int, ...]]:
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
    if requested.strict:
        return any((low is None or speed > low) and (high is None or speed < high) for low, high in requested.intervals)
    return any((low is None or speed >= low) and (high is None or speed <= high) for low, high in requested.intervals)


def keeps(rule: CountConstraint, teeth: dict[str, int]) -> bool:
    if isinstance(rule, CountEquation):
        return sum(factor * teeth[wheel] for wheel, factor in rule.coefficients.items()) + rule.constant == 0
    return sum(teeth[wheel] for wheel in rule.wheels) % 2 == 0


def answered(question: JoinProblem, tasks: int = 1) -> tuple[int, list[tuple[int, ...]], tuple[int, ...]]:
    """Count, solutions and tallies of a question cut into some tasks."""
    work = PassWork(question, AssignmentOrder("total", 10**6, (), {}), 10**6)
    each = [{"parts": [[question.plan.item, at, tasks]], "budget": 1e12, "pieces": 2} for at in range(tasks)]
    tally = merged(work, (do_task(work.packed(), task) for task in each))
    assert tally.listed
    assert not tally.cut
    return tally.count, sorted(tuple(one.teeth.values()) for one in tally.best), tally.removed


@pytest.mark.parametrize("block", [1 << 18, 7])
@settings(deadline=None, max_examples=few_or_many(25, 35))
@given(question=joins(), guess=st.sampled_from([1.0, 1e-3, 1e-9]), tasks=st.integers(1, 4))
def test_a_join_of_any_functions_and_rules_finds_what_loops_find(
    block: int,
    question: tuple[dict[str, tuple[int, ...]], list[IntervalConstraint], list[CountConstraint]],
    guess: float,
    tasks: int,
) -> None:
    domains, requested, rules = question
    truth = solutions(domains, requested, rules)
    chances = dict.fromkeys([one.name for one in (*requested, *rules)], guess)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rows, "BLOCK", block)
        patch.setattr(joining, "BLOCK", block)
        made = find_join_problem(domains, requested, rules, chances)
        count, found, removed = answered(made, tasks)
    assert found == truth
    assert count == len(truth)
    assert sum(removed) + count == made.total
    assert sorted(made.order) == list(range(len(made.reasons)))


sizes = st.one_of(st.integers(1, 12), st.integers(10**8, 10**9))
coefficients = st.one_of(st.integers(-50, 50), st.integers(-(10**40), 10**40)).filter(bool)


@st.composite
def long_joins(draw: st.DrawFn) -> tuple[dict[str, tuple[int, ...]], list[IntervalConstraint]]:
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
    question: tuple[dict[str, tuple[int, ...]], list[IntervalConstraint]], guess: float
) -> None:
    domains, requested = question
    truth = solutions(domains, requested, [])
    count, found, removed = answered(find_join_problem(domains, requested, [], {one.name: guess for one in requested}))
    assert found == truth
    assert count == len(truth)
    assert sum(removed) + count == prod(map(len, domains.values()))


def test_numbers_of_assignments_beyond_a_machine_word_are_exact() -> None:
    names = [f"w{at}" for at in range(20)]
    domains = {name: tuple(range(11, 20)) for name in names}
    function = Quotient(tuple(names), ((1, (1,) * 10 + (0,) * 10),), ((1, (0,) * 10 + (1,) * 10),))
    requested = [IntervalConstraint("half or more", function, ((Fraction(1), None),))]
    question = find_join_problem(domains, requested, [], {"half or more": 0.5})
    join = ExactJoin(question)
    counts, removed = join.count(question.plan, join.start())
    assert question.total == 9**20 > 2**62
    ways: Counter[int] = Counter({1: 1})
    for _ in range(10):
        grown: Counter[int] = Counter()
        for product_, number in ways.items():
            for count in range(11, 20):
                grown[product_ * count] += number
        ways = grown
    below, truth = 0, 0
    for product_ in sorted(ways):
        below += ways[product_]
        truth += ways[product_] * below
    assert counts[0] == truth
    assert sum(int(numbers[0]) for numbers in removed.values()) + truth == 9**20


def test_wheels_that_all_functions_see_through_one_monomial_are_bundled() -> None:
    wheels = ("a", "b", "c", "d", "e")
    first = Quotient(wheels[:4], ((1, (1, 0, 1, 0)),), ((1, (0, 1, 0, 1)),))
    second = Quotient(("a", "b", "e"), ((1, (1, 0, 0)),), ((1, (0, 1, 1)),))
    requested = [IntervalConstraint("first", first, ()), IntervalConstraint("second", second, ())]
    bundles = [dict(bundle.powers) for bundle in find_wheel_monomials(wheels, requested, frozenset())]
    assert bundles == [{"a": 1, "b": -1}, {"c": 1, "d": -1}, {"e": 1}]
    assert [dict(one.powers) for one in find_wheel_monomials(wheels, requested, frozenset("a"))] == [
        {"a": 1},
        {"b": 1},
        {"c": 1, "d": -1},
        {"e": 1},
    ]


def test_a_pool_keeps_the_best_of_many_in_exact_order() -> None:
    draw = np.random.default_rng(1)
    order = AssignmentOrder("distinct", 7, (), {})
    pool, offered = BestAssignments(order, ("a", "b", "c")), []
    for _ in range(30):
        table = draw.integers(1, 40, (3, 2000))
        pool.add(dict(zip("abc", table, strict=True)))
        offered += table.T.tolist()
    offered.sort(key=lambda counts: (len(set(counts)), sum(counts), max(counts), counts))
    assert pool.best() == offered[:7]
