"""Speeds kept as short ratios and multiplied out when read: right in any order, and linear in memory."""

from __future__ import annotations

import math
import random
import tracemalloc
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sampling import few_or_many
from studies.train_families import drift

from geartrain import GearTrain
from geartrain.numerics.factored_ratios import FactoredRatios

SAMPLE = few_or_many(20, 60)  # trees of a thousand numbers; `--slow` draws new ones, and more


@settings(max_examples=SAMPLE)
@given(st.integers(0, 10**6), st.sampled_from([1, 3, 40, 100_000]), st.sampled_from([1, 2, 5]), st.booleans())
def test_numbers_read_in_any_order_are_the_products_of_their_ratios(
    seed: int, kinds: int, width: int, long_root: bool
) -> None:
    """Trees of some thousand numbers, as chains or bushes, with few and with many different tooth counts."""
    draw = random.Random(seed)
    count = 1200
    root = Fraction(7**400, 3**500) if long_root else Fraction(-22, 7)
    products, plain = FactoredRatios(count), [root]
    products.set_root(0, root.numerator, root.denominator)
    for at in range(1, count):
        parent = max(0, at - draw.randint(1, width))
        a, b = draw.randint(23, 23 + kinds), draw.randint(20, 20 + kinds) * draw.choice([1, -1])
        products.follow(at, parent, a, b)
        plain.append(plain[parent] * Fraction(a, b))
    for at in draw.sample(range(count), 40):
        found = products.value(at)
        assert (found.numerator, found.denominator) == (plain[at].numerator, plain[at].denominator)
        other = draw.randrange(count)
        c = plain[at] / plain[other]
        if max(abs(c.numerator), c.denominator) < 10**9:
            assert products.vanishes(((at, c.denominator), (other, -c.numerator)))
        assert not products.vanishes(((at, 2), (other, -1))) or plain[other] == 2 * plain[at]


def ratio(data: dict[str, Any], last: int) -> Fraction:
    """Of a chain: all drivers over all driven wheels."""
    links = data["links"]
    driving = math.prod(links[f"g{at - 1}"]["wheels"][f"a{at}"] for at in range(1, last + 1))
    driven = math.prod(links[f"g{at}"]["wheels"][f"b{at}"] for at in range(1, last + 1))
    return Fraction((-1) ** last * driving, driven)


def test_the_last_of_a_chain_that_drifts_is_one_product() -> None:
    data = drift(5000)
    train = GearTrain.declare(data)
    wanted = ratio(data, 4999)
    assert train.solve()["g4999"] == train.solve(output="g4999")["g4999"] == wanted


def peak(task: Callable[[], object]) -> int:
    """Most bytes that a task has at once, beyond what is there before it."""
    tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        kept = task()
        most = tracemalloc.get_traced_memory()[1] - before
        del kept
        return most
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(
    "question",
    [
        lambda train: train.solve(),
        lambda train: train.solve(output="g500"),
        lambda train: train.mobility,
        lambda train: train.solve().outputs,
        lambda train: sum(speed.numerator.bit_length() for speed in train.solve().speeds.values()),
    ],
    ids=["solve", "output", "mobility", "outputs", "all"],
)
def test_memory_grows_with_a_drifting_train_not_with_its_square(question: Callable[[GearTrain], object]) -> None:
    used = []
    for size in (1000, 4000):
        train = GearTrain.declare(drift(size) | {"outputs": {"last": {"of": f"g{size - 1}"}}})
        assert train.circuits
        used.append(peak(lambda train=train: question(train)))  # type: ignore[misc]
    assert used[1] < 5.5 * used[0], used  # four times the links; every number kept would be sixteen times


def ladder(rungs: int, last: int) -> dict[str, Any]:
    """Two chains that drift alike and mesh with each other at every rung, the last one with another count."""
    draw = random.Random(4)
    links: dict[str, Any] = {"frame": {}, "a0": {"wheels": {"r0": 40}}, "b0": {"wheels": {"s0": 40}}}
    gears = [["r0", "s0"]]
    for at in range(1, rungs):
        driver, driven = draw.randint(23, 27), draw.randint(20, 26)
        for rail, rung in (("a", "r"), ("b", "s")):
            links[f"{rail}{at - 1}"]["wheels"][f"{rail}d{at}"] = driver
            links[f"{rail}{at}"] = {"wheels": {f"{rail}f{at}": driven, f"{rung}{at}": 40}}
            gears.append([f"{rail}d{at}", f"{rail}f{at}"])
        gears.append([f"r{at}", f"s{at}"])
    links[f"b{rungs - 1}"]["wheels"][f"s{rungs - 1}"] = last
    joints = [{"pair": ["frame", link], "axis": link} for link in links if link != "frame"]
    return {"links": links, "revolutes": joints, "gears": [{"pair": pair} for pair in gears], "inputs": {"a0": 1}}


def test_loops_far_along_a_drifting_train_close_or_do_not_exactly() -> None:
    sound, jammed = (GearTrain.declare(ladder(700, last)) for last in (40, 41))
    assert sound.solve().verdict
    assert sound.mobility.redundant == 699
    assert not sound.mobility.locked
    (loop,) = jammed.mobility.locked
    assert loop.product in (Fraction(40, 41), Fraction(41, 40))
    assert jammed.solve().verdict.kind == "locked"


def test_a_drifting_train_behind_a_planetary_set_is_read_through_its_components() -> None:
    """The set makes the train coupled: its speeds come from elimination, and the chain behind it from its component."""
    data = drift(900)
    links = data["links"]
    links["frame"] = {"wheels": {"ring": {"teeth": 60, "internal": True}}}
    links |= {"sun": {"wheels": {"s": 24}}, "planet": {"wheels": {"p": 18}}, "carrier": {"wheels": {"c": 30}}}
    links["g0"]["wheels"]["w"] = 50
    data["revolutes"] += [
        {"pair": ["frame", "sun"], "axis": "main"},
        {"pair": ["frame", "carrier"], "axis": "main"},
        {"pair": ["carrier", "planet"], "axis": "P"},
    ]
    data["gears"] += [{"pair": ["s", "p"]}, {"pair": ["p", "ring"]}, {"pair": ["c", "w"]}]
    data["inputs"] = {"sun": 1}
    answer = GearTrain.declare(data).solve()
    assert answer["carrier"] == Fraction(2, 7)
    assert answer["g899"] == Fraction(2, 7) * Fraction(-30, 50) * ratio(data, 899)
    assert answer["g899"] in list(answer.speeds.values())
