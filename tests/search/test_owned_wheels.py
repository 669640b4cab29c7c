"""Searches among wheels that a maker owns: lists, numbers of each, and construction sets by name."""

from __future__ import annotations

import csv
from fractions import Fraction
from importlib.resources import files
from itertools import product

import pytest
import yaml

from geartrain.errors import DeclarationError, QuestionError
from geartrain.search import read_counts, search_train
from geartrain.train import Train, declare

TWO_STAGES = """
name: owned
links: {{frame: {{}}, a: {{wheels: {{a: {of}}}}}, b: {{wheels: {{b: {of}, c: {of}}}}}, d: {{wheels: {{d: {of}}}}}}}
revolutes: {{A: [frame, a], B: [frame, b], D: [frame, d]}}
gears: [a ~ b, c ~ d]
inputs: {{a: 1}}
outputs: {{d: {{targets: [{{speed: {speed}, tolerance: 0}}]}}}}
"""


def two_stages(of: str, speed: str) -> Train:
    return declare(yaml.safe_load(TWO_STAGES.format(of=f"{{teeth: {{search: {{of: {of}}}}}}}", speed=speed)))


def found(train: Train) -> list[tuple[int, ...]]:
    (part,) = search_train(train, best=1000).parts
    return sorted(tuple(each.teeth[wheel] for wheel in "abcd") for each in part.solutions)


def enumerated(counts: tuple[int, ...], speed: str, numbers: dict[int, int] | None = None) -> list[tuple[int, ...]]:
    return [
        teeth
        for teeth in product(counts, repeat=4)
        if Fraction(teeth[0] * teeth[2], teeth[1] * teeth[3]) == Fraction(speed)
        and (numbers is None or all(teeth.count(each) <= most for each, most in numbers.items()))
    ]


def test_wheels_of_a_list_are_chosen_also_if_it_has_two() -> None:
    assert found(two_stages("[20, 60]", "1/9")) == [(20, 60, 20, 60)]
    assert found(two_stages("[19, 15, 57, 60]", "1/12")) == enumerated((15, 19, 57, 60), "1/12") != []


@pytest.mark.parametrize(
    ("numbers", "speed"), [({20: 2, 60: 2}, "1/9"), ({20: 1, 60: 2}, "1/9"), ({15: 1, 20: 2, 30: 1, 60: 1}, "1/2")]
)
def test_no_more_wheels_are_used_than_are_owned(numbers: dict[int, int], speed: str) -> None:
    of = "{" + ", ".join(f"{count}: {number}" for count, number in numbers.items()) + "}"
    assert found(two_stages(of, speed)) == enumerated(tuple(numbers), speed, numbers)


def test_every_copy_of_a_planet_needs_a_wheel() -> None:
    text = """
name: planets
links:
  frame: {wheels: {r: {teeth: 60, internal: true}}}
  s: {wheels: {s: {teeth: {search: {of: {20: 1, 24: 1}}}}}}
  p: {wheels: {p: {teeth: {search: {of: {18: 4, 20: 3}}}}}, copies: 4}
  c: {}
revolutes: {main: [frame, s, c], P: [c, p]}
gears: [s ~ p, p ~ r]
inputs: {s: 1}
outputs: {c: {targets: [{speed: 2/7, tolerance: 20 %}]}}
"""
    (part,) = search_train(declare(yaml.safe_load(text)), best=10).parts
    assert [dict(each.teeth) for each in part.solutions] == [{"s": 24, "p": 18}]
    # s = 20 and p = 20 also fit, with a fourth wheel of 20 teeth
    (part,) = search_train(declare(yaml.safe_load(text.replace("20: 3", "20: 4"))), best=10).parts
    assert {"s": 20, "p": 20} in [dict(each.teeth) for each in part.solutions]


def test_a_construction_set_is_named_in_a_train_and_in_a_range() -> None:
    meccano = (15, 19, 25, 38, 50, 57, 60, 95, 133)
    assert tuple(read_counts("meccano")) == meccano
    assert found(two_stages("meccano", "1/12")) == enumerated(meccano, "1/12")
    assert tuple(read_counts("lego,10,14:15")) == (8, 10, 12, 14, 15, 16, 20, 24, 28, 36, 40, 56, 60)


def test_every_wheel_of_the_table_names_its_part_and_source() -> None:
    text = files("geartrain.train").joinpath("wheel_sets.csv").read_text(encoding="utf-8")
    rows = list(csv.DictReader(text.splitlines()))
    assert all(row["part"] and row["source"] for row in rows)
    assert len({(row["set"], row["teeth"]) for row in rows}) == len(rows)


def test_an_unknown_set_is_refused_with_a_suggestion() -> None:
    with pytest.raises(DeclarationError) as refused:
        two_stages("mecano", "1/12")
    (problem, *_) = refused.value.problems
    assert problem.fix == "did you mean 'meccano'?"
    with pytest.raises(QuestionError, match="the sets of wheels are lego, meccano"):
        read_counts("mecano")


@pytest.mark.parametrize("of", ["[]", "{}", "{20: 0}", "[0]", "[20, 20.5]"])
def test_owned_wheels_have_tooth_counts_and_numbers(of: str) -> None:
    with pytest.raises(DeclarationError):
        two_stages(of, "1/9")
