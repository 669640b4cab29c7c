"""The join behind the search in trains: signs, windows, bounds and counts, each against Fractions and plain loops."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import geartrain.synthesis.join.exact_join as joining
import geartrain.synthesis.join.partial_assignments as rows
import geartrain.synthesis.join.product_lists as items
from geartrain.synthesis.constraints.count_conditions import Condition, CountConstraint, CountEquation
from geartrain.synthesis.join.exact_join import ExactJoin
from geartrain.synthesis.join.join_plan import JoinProblem, find_join_problem
from geartrain.synthesis.join.partial_assignments import PartialAssignments
from geartrain.synthesis.join.polynomial_constraints import PolynomialConstraint, possible
from geartrain.synthesis.join.polynomial_signs import SignPolynomial
from geartrain.synthesis.join.product_lists import Item, ItemRecipe, forecast
from geartrain.synthesis.join.solution_windows import PolynomialInequality
from geartrain.synthesis.join.wheel_monomials import IntervalConstraint, find_wheel_monomials
from geartrain.synthesis.train.best_assignments import AssignmentOrder, BestAssignments
from geartrain.synthesis.train.pass_tasks import PassWork, do_task, merged

Terms = tuple[tuple[int, tuple[int, ...]], ...]


@dataclass(frozen=True)
class Quotient:
    """A rational function of counts, as the search takes it."""

    wheels: tuple[str, ...]
    numerator: Terms
    denominator: Terms

    def at(self, teeth: dict[str, int]) -> Fraction | None:
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


# ---------------------------------------------------------------------------------------------------------------- signs

coefficients = st.one_of(st.integers(-50, 50), st.integers(-(10**40), 10**40)).filter(bool)


@st.composite
def polynomials(draw: st.DrawFn, width: int) -> SignPolynomial:
    powers = st.tuples(*[st.integers(0, 2)] * width)
    terms = draw(st.lists(st.tuples(coefficients, powers), min_size=1, max_size=4))
    return SignPolynomial.of(
        (coefficient, tuple((at, power) for at, power in enumerate(some) if power)) for coefficient, some in terms
    )


def exact(polynomial: SignPolynomial, point: Sequence[Fraction]) -> Fraction:
    return sum(
        (
            coefficient * prod((point[at] ** power for at, power in monomial), start=Fraction(1))
            for coefficient, monomial in polynomial.terms
        ),
        Fraction(0),
    )


def some_items(kinds: Sequence[tuple[list[int], list[int]]]) -> list[Item]:
    """Items of one wheel above and one below."""
    domains = {
        f"{side}{at}": tuple(sorted(set(counts)))
        for at, kind in enumerate(kinds)
        for side, counts in zip("tb", kind, strict=True)
    }
    return [Item(ItemRecipe(((f"t{at}", 1),), ((f"b{at}", 1),)), domains, {}, np.int64) for at in range(len(kinds))]


def points(rows: PartialAssignments) -> list[list[Fraction]]:
    columns = []
    for item in sorted(rows.columns):
        bottom = rows.bottom(item)
        bottoms = [1] * rows.size if bottom is None else bottom.tolist()
        columns.append([Fraction(top, below) for top, below in zip(rows.top(item).tolist(), bottoms, strict=True)])
    return [list(point) for point in zip(*columns, strict=True)]


def all_rows(made: list[Item], count: int) -> PartialAssignments:
    grid = np.meshgrid(*(np.arange(len(item)) for item in made[:count]), indexing="ij")
    return PartialAssignments(made, {at: column.ravel() for at, column in enumerate(grid)}, grid[0].size if grid else 1)


counts = st.lists(st.one_of(st.integers(1, 12), st.integers(10**8, 10**9)), min_size=1, max_size=4)
kinds = st.lists(st.tuples(counts, counts), min_size=2, max_size=2)


@settings(deadline=None)
@given(kinds, polynomials(2), st.data())
def test_signs_are_exact_however_large_the_numbers(
    chosen: list[tuple[list[int], list[int]]], polynomial: SignPolynomial, data: st.DataObject
) -> None:
    rows = all_rows(some_items(chosen), 2)
    at = data.draw(st.integers(0, rows.size - 1))
    root = exact(polynomial, points(rows)[at])
    # the polynomial less its value at one point: 0 there, and near 0 where floats cannot tell
    for tried in (polynomial, polynomial.plus(SignPolynomial.of([(1, ())]), -root)):
        truth = [exact(tried, point) for point in points(rows)]
        assert tried.signs(rows).tolist() == [(number > 0) - (number < 0) for number in truth]


@settings(deadline=None)
@given(kinds, st.lists(st.tuples(polynomials(2), st.sampled_from([1, -1]), st.booleans()), min_size=1, max_size=3))
def test_windows_leave_nothing_out_and_are_sure_of_nothing_wrong(
    chosen: list[tuple[list[int], list[int]]], halves: list[tuple[SignPolynomial, int, bool]]
) -> None:
    made = some_items(chosen)
    case = tuple(PolynomialInequality(*half) for half in halves)
    band = PolynomialConstraint("band", (case,))
    open_item, rows = made[1], all_rows(made, 1)
    everything = all_rows(made, 2)
    truth = [
        all(
            (exact(half.polynomial, point) * half.sense > 0) or (not half.strict and not exact(half.polynomial, point))
            for half in case
        )
        for point in points(everything)
    ]
    assert band.holds(everything).tolist() == truth
    hopeful = possible(band.reaches({1: (float(open_item.x[0]), float(open_item.x[-1]))}), rows)
    for row in range(rows.size):
        own = truth[row * len(open_item) : (row + 1) * len(open_item)]
        assert hopeful[row] or not any(own)
    if not band.opens(1):
        return
    (window,) = band.windows(rows, 1)
    window = window.clipped(0, len(open_item))
    fringe = set(zip(*(column.tolist() for column in band.fringe(0, rows, 1, window)), strict=True))
    for row in range(rows.size):
        own = truth[row * len(open_item) : (row + 1) * len(open_item)]
        sure = range(window.sure_start[row], window.sure_end[row])
        assert all(own[at] for at in sure)
        assert {at for at, good in enumerate(own) if good} == {*sure, *(at for other, at in fringe if other == row)}
        assert all(window.start[row] <= at < window.end[row] for at, good in enumerate(own) if good)


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
    asked = []
    for number in range(draw(st.integers(1, 3))):
        wheels = tuple(sorted(draw(st.sets(st.sampled_from(names), min_size=1, max_size=4))))
        powers = st.tuples(*[st.integers(0, 2)] * len(wheels))
        terms = st.lists(st.tuples(st.integers(-4, 4).filter(bool), powers), min_size=1, max_size=3).map(merge)
        function = Quotient(wheels, draw(terms.filter(bool)), draw(terms.filter(bool)))
        if not any(any(powers) for _, powers in (*function.numerator, *function.denominator)):
            continue
        teeth = {wheel: draw(st.sampled_from(domains[wheel])) for wheel in wheels}
        middle = function.at(teeth) or Fraction(draw(st.integers(-3, 3)))
        width = draw(st.sampled_from([Fraction(0), abs(middle) / 10, Fraction(1)]))
        low, high = middle - width, middle + width
        intervals = draw(
            st.sampled_from([((low, high),), ((low, high), (high + 1, None)), ((None, low),), ((low, None),)])
        )
        asked.append(IntervalConstraint(f"demand {number}", used(function), intervals, draw(st.booleans())))
    rules: list[CountConstraint] = []
    if draw(st.booleans()):
        pair = draw(st.lists(st.sampled_from(names), min_size=2, max_size=3, unique=True))
        start = sum(factor * domains[wheel][0] for factor, wheel in zip((1, -1, 2), pair, strict=False))
        rules.append(CountEquation("sum", dict(zip(pair, (1, -1, 2), strict=False)), -start))
    if draw(st.booleans()):
        pair = draw(st.lists(st.sampled_from(names), min_size=2, max_size=3, unique=True))
        rules.append(Condition("even", tuple(pair), Even(tuple(pair))))
    return domains, asked, rules


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
    domains: dict[str, tuple[int, ...]], asked: list[IntervalConstraint], rules: list[CountConstraint]
) -> list[tuple[int, ...]]:
    found = []
    for counts in product(*domains.values()):
        teeth = dict(zip(domains, counts, strict=True))
        if all(fits(one, teeth) for one in asked) and all(keeps(rule, teeth) for rule in rules):
            found.append(counts)
    return found


def fits(asked: IntervalConstraint, teeth: dict[str, int]) -> bool:
    speed = asked.function.at(teeth)
    if speed is None:
        return False
    if asked.strict:
        return any((low is None or speed > low) and (high is None or speed < high) for low, high in asked.intervals)
    return any((low is None or speed >= low) and (high is None or speed <= high) for low, high in asked.intervals)


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
@settings(deadline=None, max_examples=35)
@given(question=joins(), guess=st.sampled_from([1.0, 1e-3, 1e-9]), tasks=st.integers(1, 4))
def test_a_join_of_any_functions_and_rules_finds_what_loops_find(
    block: int,
    question: tuple[dict[str, tuple[int, ...]], list[IntervalConstraint], list[CountConstraint]],
    guess: float,
    tasks: int,
) -> None:
    domains, asked, rules = question
    truth = solutions(domains, asked, rules)
    chances = dict.fromkeys([one.name for one in (*asked, *rules)], guess)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rows, "BLOCK", block)
        patch.setattr(joining, "BLOCK", block)
        made = find_join_problem(domains, asked, rules, chances)
        count, found, removed = answered(made, tasks)
    assert found == truth
    assert count == len(truth)
    assert sum(removed) + count == made.total
    assert sorted(made.order) == list(range(len(made.reasons)))


def test_numbers_of_assignments_beyond_a_machine_word_are_exact() -> None:
    names = [f"w{at}" for at in range(20)]
    domains = {name: tuple(range(11, 20)) for name in names}
    function = Quotient(tuple(names), ((1, (1,) * 10 + (0,) * 10),), ((1, (0,) * 10 + (1,) * 10),))
    asked = [IntervalConstraint("half or more", function, ((Fraction(1), None),))]
    question = find_join_problem(domains, asked, [], {"half or more": 0.5})
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
    asked = [IntervalConstraint("first", first, ()), IntervalConstraint("second", second, ())]
    bundles = [dict(bundle.powers) for bundle in find_wheel_monomials(wheels, asked, frozenset())]
    assert bundles == [{"a": 1, "b": -1}, {"c": 1, "d": -1}, {"e": 1}]
    assert [dict(one.powers) for one in find_wheel_monomials(wheels, asked, frozenset("a"))] == [
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
