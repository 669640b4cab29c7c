"""The study of trains found again: which are asked, and what is kept of a question that does not end."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import combinations

import pytest
from concrete_trees import exact_dial, sure_arbor
from studies.left_out_records import LeftOutRecords
from studies.left_out_study import fewest_new_arbors, find_trees, left_out
from studies.measurement import gathered

from geartrain import shipped
from geartrain.search.reconstruct import Additions, ReconstructionProblem

pytestmark = pytest.mark.slow  # the script of an accuracy page, no part of the package


EMPTY = LeftOutRecords("", [], [])
QUICK = ("vitruvius-hodometer", "watch-going-train", "isfahan-astrolabe-1221", "four-gear-loop")


@pytest.fixture(scope="module")
def quick() -> LeftOutRecords:
    return left_out(EMPTY, QUICK)


def test_every_shipped_train_is_requested_or_says_why_not() -> None:
    trees, why = find_trees(tuple(shipped()))
    requested = {name for name, _ in trees}
    assert requested | {*why} == set(shipped())
    assert not requested & {*why}
    assert why["longcase-clock-bs978"] == "the same parts as longcase-clock"
    assert why["voulgaris-2022"] == "the same parts as freeth-2006 and freeth-2008"
    assert why["worm"].endswith("it has worm wheels")
    assert "'four-gear-loop' close a loop" in why["four-gear-loop"]


def test_of_a_mechanism_with_pins_and_carriers_each_part_is_taken() -> None:
    """The table of the Moon itself turns in the frame; what it carries is a part, and so is what that drives."""
    trees = find_trees(["freeth-2008"])[0]
    first = trees["freeth-2008", ""]
    assert set(first.driven) == {"c", "d", "e_pipe", "l", "m", "n", "o", "p", "q", "e_table", "f", "g", "h", "i"}
    assert set(first.pointers) == {"e_pipe", "metonic", "games", "callippic", "apsides", "saros", "exeligmos"}
    assert set(trees["freeth-2008", "on e_table, from e_pipe"].driven) == {"k1", "e_inner"}
    assert set(trees["freeth-2008", "from e_inner"].driven) == {"moon"}


def test_the_quick_run_finds_every_train_again(quick: LeftOutRecords) -> None:
    rows = {(row.train, *row.lost): row for row in quick.rows}
    assert len(rows) == len(quick.rows) == len(quick.whole) == 1 + (4 + 6) + (3 + 3)
    assert not quick.lost
    drum = rows["vitruvius-hodometer", "drum"]  # 1 > 400: the counts are the bounds
    assert (drum.added, drum.solutions, drum.rank) == (1, [0, 1], (1, 1))
    pivot = rows["isfahan-astrolabe-1221", "pivot"]  # (8, 13), (16, 26), (24, 39), (32, 52), beside two equal wheels
    assert (pivot.added, pivot.solutions, pivot.rank) == (2, [0, 0, 8], (1, 8))
    assert all(row.rank[0] <= row.rank[1] <= sum(row.solutions) for row in quick.whole if row.rank)


@pytest.mark.slow
def test_of_what_is_not_finished_less_is_requested() -> None:
    full = {tuple(row.lost): row for row in left_out(EMPTY, ["watch-going-train"]).rows}
    found = left_out(EMPTY, ["watch-going-train"], limit=0.0)
    assert not found.whole
    assert {tuple(row.lost) for row in found.rows} == {*full}
    for row in found.rows:
        whole = full[tuple(row.lost)]
        assert row.reached
        assert whole.reached
        assert row.told[0] <= whole.rank[0]  # meshes that are told can but leave out others
        assert row.first == whole.rank[0]
        assert list(row.solutions) == list(whole.solutions[:-1])


def test_a_pointer_of_each_speed_needs_an_arbor() -> None:
    dials = [exact_dial("a", 2, place="new"), exact_dial("b", -2, place="new"), exact_dial("c", 3, place="new")]
    problem = ReconstructionProblem(sure_arbor("x", x1=10), (), (*dials, exact_dial("d", 5)), Additions(1, 5, 6))
    assert fewest_new_arbors(problem) == 2  # magnitudes alone are told apart
    near = replace(dials[2], minimum=Fraction(1), maximum=Fraction(9, 2))
    assert fewest_new_arbors(replace(problem, dials=(dials[0], near))) == 1


@pytest.mark.slow
def test_a_kept_run_is_added_to() -> None:
    kept = left_out(EMPTY, ["watch-going-train"], limit=0.0)
    rows = [replace(row, reached=None, told=None) for row in kept.rows if len(row.lost) == 1]
    less = replace(kept, rows=rows)
    more = left_out(less, ["watch-going-train"], 60, 60, 5)
    own = [row for row in more.rows if row.train == "watch-going-train"]
    assert [row.reached for row in own] == [True] * 6
    assert all(row.told for row in own)
    assert not any(row.is_whole for row in own)  # pairs are asked to the end only where each alone was
    assert left_out(less, ["watch-going-train"], 60, 60, 0).rows == rows


def test_what_came_in_time_is_gathered() -> None:
    def slow() -> Iterator[int]:
        yield 1
        yield 2
        while True:
            pass

    def greedy() -> Iterator[int]:
        yield 1
        yield len(bytearray(8 * 10**9))

    def wrong() -> Iterator[int]:
        yield 1
        raise ValueError("no such thing\nat all")

    assert gathered(lambda: iter("abc"), 60, 4) == (["a", "b", "c"], "")
    assert gathered(slow, 0.5, 4) == ([1, 2], "not within 0.5 s")
    assert gathered(greedy, 60, 4) == ([1], "more than 4 GB")
    assert gathered(wrong, 60, 4) == ([1], "no such thing")


def test_the_kept_run_found_every_train_again() -> None:
    records = LeftOutRecords.read("left-out")
    trees = {(tree.train, tree.part): tree for tree in records.trees}
    requested = {(row.train, row.part, tuple(row.lost)) for row in records.rows}
    assert len(requested) == len(records.rows)
    for part, tree in trees.items():
        for many in (1, 2):
            requested -= {(*part, lost) for lost in combinations(tree.arbors, many)}
    assert not requested
    assert not records.lost
    assert all(row.note for row in records.rows if not row.is_whole)
