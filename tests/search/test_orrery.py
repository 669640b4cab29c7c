"""Orreries, several periods from one arbor: against every tree of small ones, and the clock of 10000 years."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from geartrain import load
from geartrain.analysis import GearTrain
from geartrain.errors import QuestionError, RangeError
from geartrain.search import Orrery, find_orrery

HILLIS = {
    "moon": "29.53058853",
    "mercury": "87.96925718",
    "venus": "224.7007992",
    "earth": "365.2563554",
    "mars": "686.9795859",
    "jupiter": "4332.820129",
    "saturn": "10755.69864",
}
DAYS = {name: Fraction(days) for name, days in HILLIS.items()}


# ---- every tree of a small orrery, written without the library

Link = tuple[int, Fraction]
"""Parent and ratio of one arbor."""


def all_trees(ratios: list[Fraction], pairs: int) -> Iterator[tuple[list[Link], list[Fraction]]]:
    """All trees with so many pairs, an arbor after its parent, and the periods of their arbors."""

    def grow(links: list[Link], periods: list[Fraction]) -> Iterator[tuple[list[Link], list[Fraction]]]:
        if len(links) == pairs:
            yield links, periods
            return
        # arbors in the order of their parents: each tree in few of its orders
        first = links[-1][0] if links else 0
        for parent in range(first, len(periods)):
            for ratio in ratios:
                yield from grow([*links, (parent, ratio)], [*periods, periods[parent] * ratio])

    yield from grow([], [Fraction(1)])


def shown(periods: list[Fraction], aims: list[Fraction], slack: Fraction) -> Iterator[tuple[int, ...]]:
    """The ways to find each aim on an arbor of its own, the first excepted."""
    fits = [[at for at, has in enumerate(periods) if at and abs(aim / has - 1) <= slack] for aim in aims]
    return (places for places in product(*fits) if len(set(places)) == len(places))


def wheels_needed(links: list[Link], counts: list[int]) -> int:
    """Fewest wheels over all choices of teeth: every choice is counted."""
    choices = [[(a, b) for a, b in product(counts, repeat=2) if Fraction(b, a) == ratio] for _, ratio in links]
    fewest = 2 * len(links)
    for teeth in product(*choices):
        used = {(parent, a) for (parent, _), (a, _) in zip(links, teeth, strict=True)}
        used |= {(at, b) for at, (_, b) in enumerate(teeth, start=1)}
        fewest = min(fewest, len(used))
    return fewest


@st.composite
def small(draw: st.DrawFn) -> tuple[list[int], list[Fraction], Fraction]:
    counts = sorted(draw(st.lists(st.integers(4, 12), min_size=2, max_size=3, unique=True)))
    steps = st.tuples(st.sampled_from(counts), st.sampled_from(counts)).map(lambda pair: Fraction(*pair))
    periods = st.lists(steps, min_size=1, max_size=2).map(math.prod).map(Fraction)
    slack = draw(st.sampled_from([Fraction(0), Fraction(1, 100), Fraction(1, 20)]))
    aims = draw(st.lists(periods, min_size=1, max_size=2))
    return counts, aims, slack


@settings(max_examples=25, deadline=None)
@given(small())
def test_a_small_orrery_has_the_fewest_pairs_and_wheels_of_all_trees(
    question: tuple[list[int], list[Fraction], Fraction],
) -> None:
    counts, aims, slack = question
    ratios = sorted({Fraction(b, a) for a, b in product(counts, repeat=2)})
    names = [f"p{at}" for at in range(len(aims))]
    found = find_orrery(dict(zip(names, aims, strict=True)), counts, slack)
    checked(found, dict(zip(names, aims, strict=True)), slack, counts)
    fewest: dict[int, int] = {}
    for pairs in range(len(aims), 4):
        for links, periods in all_trees(ratios, pairs):
            if next(shown(periods, aims, slack), None) is not None:
                fewest[pairs] = min(fewest.get(pairs, 99), wheels_needed(links, counts))
    if fewest:
        assert found.minimum_pairs <= min(fewest) <= len(found.pairs)
        assert found.minimum_wheels <= min(fewest.values())
        assert found.wheels <= min(fewest.values())
    if found.complete:
        assert found.wheels == found.minimum_wheels


def checked(found: Orrery, periods: dict[str, Fraction], slack: Fraction, counts: list[int] | range) -> None:
    """An orrery does what it says: from the teeth alone, and by the ordinary solver."""
    has = {found.arbors[0].name: Fraction(1)}
    senses = {found.arbors[0].name: 1}
    wheels = set()
    for pair in found.pairs:
        assert {pair.driver, pair.driven} <= set(counts)
        has[pair.child] = has[pair.parent] * Fraction(pair.driven, pair.driver)
        senses[pair.child] = -senses[pair.parent]
        wheels |= {(pair.parent, pair.driver), (pair.child, pair.driven)}
    assert found.wheels == len(wheels)
    for name, period in periods.items():
        assert found.errors[name] == period / has[name] - 1
        assert abs(found.errors[name]) <= slack
    assert {arbor.name: arbor.sense for arbor in found.arbors} == senses
    train = GearTrain.declare(found.to_train())
    assert all(name in train.declaration.title for name in periods)
    answer = train.solve()
    assert answer
    for name in periods:
        assert answer[name] == senses[name] / has[name]
        assert all(target.met for target in answer.outputs[name].targets)


# ---- the clock of 10000 years


def test_seven_periods_to_six_places_take_few_wheels() -> None:
    found = find_orrery(DAYS, range(12, 401), Fraction("1e-6"), effort=4)
    checked(found, DAYS, Fraction("1e-6"), range(12, 401))
    assert found.wheels <= 20
    assert found.minimum_pairs >= 9
    assert found.minimum_wheels >= 12
    assert not found.complete


@pytest.mark.parametrize(
    ("name", "wheels", "worst"), [("clock-10000-years", 20, "5e-7"), ("clock-10000-years-exact", 29, "1.11e-9")]
)
def test_the_shipped_clock_has_fewer_wheels_than_the_published(name: str, wheels: int, worst: str) -> None:
    train = load(name)
    assert len(train.declaration.wheels) == wheels
    assert all(12 <= wheel.teeth <= 400 for _, wheel in train.declaration.wheels.values())
    answer = train.solve()
    for planet, days in DAYS.items():
        assert abs(abs(Fraction(answer[planet])) * days - 1) <= Fraction(worst)
        assert all(target.met for target in answer.outputs[planet].targets)


def test_the_published_clock_misses_its_month_alone() -> None:
    train = load("gosper-2005")
    assert len(train.declaration.wheels) == 30
    met = {name: all(target.met for target in result.targets) for name, result in train.solve().outputs.items()}
    assert met == {name: name != "moon" for name in DAYS}


# ---- questions that cannot be answered, and what ends a search


def test_nothing_found_says_what_was_walked() -> None:
    with pytest.raises(QuestionError, match=r"no orrery was found(.|\n)*enumerated(.|\n)*tolerance"):
        find_orrery({"far": Fraction(10**6)}, [6, 7], Fraction(1, 1000))


@pytest.mark.parametrize(
    ("periods", "counts", "tolerance", "kind"),
    [
        ({}, [6], 0, QuestionError),
        ({"a": Fraction(0)}, [6], 0, QuestionError),
        ({"a": Fraction(2)}, [], 0, QuestionError),
        ({"a": Fraction(2)}, [0, 6], 0, QuestionError),
        ({"a": Fraction(2)}, [6, 7], 1, QuestionError),
        ({"a": Fraction(2)}, [6, 7], {"b": 0}, QuestionError),
        ({"day": Fraction(2)}, [6, 7], 0, QuestionError),
        ({"a": Fraction(2)}, range(1, 9000), 0, RangeError),
    ],
)
def test_what_cannot_be_requested_is_refused(
    periods: dict[str, Fraction], counts: list[int], tolerance: float, kind: type[Exception]
) -> None:
    with pytest.raises(kind, match=r"fix:"):
        find_orrery(periods, counts, tolerance)


def test_an_interrupt_keeps_what_was_found() -> None:
    calls = 0

    def stop(done: int, total: int) -> None:
        nonlocal calls
        assert 0 <= done <= total
        calls += 1
        if calls > 400:
            raise KeyboardInterrupt

    days = {name: DAYS[name] for name in ("moon", "mercury", "venus")}
    found = find_orrery(days, range(12, 61), Fraction("1e-4"), effort=10**6, tell=stop)
    assert found.ended == "interrupted"
    checked(found, days, Fraction("1e-4"), range(12, 61))


def test_the_same_question_has_the_same_answer() -> None:
    days = {name: DAYS[name] for name in ("moon", "earth")}
    first, second = (find_orrery(days, range(12, 121), Fraction("1e-5"), effort=4) for _ in range(2))
    assert first == second
    assert first.to_dict() == second.to_dict()
