"""The study of trains found again: which are asked, what is kept of a question that does not end, what is told."""

from __future__ import annotations

import json
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path

import pytest
from make_left_out import page
from studies import left_out_study
from studies.left_out_records import LeftOutRecord, LeftOutRecords, NotAskedRecord, TreeRecord
from studies.left_out_study import QUICK, find_trees, forget, left_out
from studies.measurement import gathered
from studies.page import read

from geartrain.train.declaration_files import shipped


@pytest.fixture(scope="module")
def quick() -> LeftOutRecords:
    return left_out(QUICK)


def test_every_shipped_train_is_asked_or_says_why_not() -> None:
    trees, not_asked = find_trees(tuple(shipped()))
    assert {*trees, *(row.train for row in not_asked)} == set(shipped())
    assert len(trees) + len(not_asked) == len(shipped())
    why = {row.train: row.why for row in not_asked}
    assert why["longcase-clock-bs978"] == "the same tree as longcase-clock"
    assert why["freeth-2021"] == "the same tree as freeth-2008"
    assert why["worm"].endswith("it has worm wheels")
    assert "'four-gear-loop' close a loop" in why["four-gear-loop"]


def test_of_a_mechanism_with_pins_and_carriers_the_trains_behind_the_table_are_taken() -> None:
    """The table of the Moon itself turns in the frame; what it carries does not."""
    tree = find_trees(["freeth-2008"])[0]["freeth-2008"]
    assert set(tree.driven) == {"c", "d", "e_pipe", "l", "m", "n", "o", "p", "q", "e_table", "f", "g", "h", "i"}
    assert set(tree.beside) == {"a", "k1", "k2", "e_inner", "moon"}
    assert set(tree.pointers) == {"e_pipe", "metonic", "games", "callippic", "apsides", "saros", "exeligmos"}


def test_the_quick_run_finds_every_train_again(quick: LeftOutRecords) -> None:
    rows = {(row.train, *row.lost): row for row in quick.rows}
    assert len(rows) == len(quick.rows) == len(quick.whole) == 1 + (4 + 6) + (3 + 3)
    assert not quick.lost
    drum = rows["vitruvius-hodometer", "drum"]  # 1 > 400: the counts are the bounds
    assert (drum.added, drum.mechanisms, drum.rank) == (1, [0, 1], [1, 1])
    pivot = rows["isfahan-astrolabe-1221", "pivot"]  # (8, 13), (16, 26), (24, 39), (32, 52), beside two equal wheels
    assert (pivot.added, pivot.mechanisms, pivot.rank) == (2, [0, 0, 8], [1, 8])
    assert all(row.rank[0] <= row.rank[1] <= sum(row.mechanisms) for row in quick.whole if row.rank)


def test_what_is_kept_is_read_again(quick: LeftOutRecords) -> None:
    again = LeftOutRecords.from_dict(json.loads(json.dumps(quick.to_dict())))
    assert again.to_markdown() == quick.to_markdown()


def test_a_stopped_run_is_taken_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    journal = tmp_path / "left-out.journal"
    first = left_out(["watch-going-train"], journal=journal)
    assert len(list(tmp_path.iterdir())) == 2
    monkeypatch.setattr(left_out_study, "gathered", None)  # whoever asks again fails
    assert left_out(["watch-going-train"], journal=journal).to_dict() == json.loads(json.dumps(first.to_dict()))
    forget(journal)
    assert not list(tmp_path.iterdir())


def test_two_arbors_are_not_left_out_where_one_was_too_many() -> None:
    found = left_out(["watch-going-train"], limit=0.0)
    assert [tuple(row.lost) for row in found.rows] == [("third",), ("fourth",), ("escape",)]
    assert found.possible == 6
    assert not found.whole
    assert {row.note for row in found.rows} == {"not within 0 s"}
    assert "not asked, for one of the two alone was not finished: 3." in found.to_markdown()


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
    (records,) = read(LeftOutRecords, "left-out")
    trees = {tree.train: tree for tree in records.trees}
    assert {*trees, *(row.train for row in records.not_asked)} == set(shipped())
    asked = {(row.train, tuple(row.lost)) for row in records.rows}
    whole = {(row.train, tuple(row.lost)) for row in records.whole}
    assert len(asked) == len(records.rows)
    for name, tree in trees.items():
        for link in tree.arbors:
            assert (name, (link,)) in asked
        for pair in combinations(tree.arbors, 2):
            assert ((name, pair) in asked) == all((name, (link,)) in whole for link in pair)
    assert not records.lost
    assert all(row.note for row in records.rows if not row.is_whole)


def test_the_page_names_what_was_not_finished_and_what_was_not_found() -> None:
    rows = [
        LeftOutRecord("clock", ["a"], 2, [0, 3, 4], [0, 2, 2], [4, 7], True, 0.25),
        LeftOutRecord("clock", ["b"], 1, [0, 5], [0, 5], None, True, 1.5),
        LeftOutRecord("clock", ["c"], 3, [0, 0], [0, 0], None, False, None, "not within 60 s"),
        LeftOutRecord("clock", ["a", "b"], 3, [], [], None, False, None, "more than 4 GB"),
    ]
    tree = TreeRecord("clock", "x", ["a", "b", "c"], 8, ["hour"], ["crank"], [8, 96])
    text = "\n".join(page(LeftOutRecords("Trains", [tree], rows, [NotAskedRecord("worm", "it has worm wheels")])))
    assert "| clock | 3 | 8 | 1 | 6 | 4 | 2 | 1 | 0 | 0 | 7 |" in text
    assert "| a | 3 with 1 | 4 with 2 | 2 | 4 to 7 | 250 ms |" in text
    assert "| b | 5 with 1 | 5 with 1 | 5 | - | 1.5 s |" in text
    assert "| c | none with 1 | ? with 3 | - | - | not within 60 s |" in text
    assert "| a, b | - | ? with 3 | - | - | more than 4 GB |" in text
    assert "From x on; pointers: hour; 8 to 96 teeth. Not in the tree: crank." in text
    assert "| worm | it has worm wheels |" in text
    said = " ".join(text.split())
    assert "There are 6 such questions. 4 were asked and 2 finished" in said
    assert "found in 1 of the finished ones; not: clock without b; 0 have too many" in said
    assert "1 have explanations with fewer wheels than were lost" in said
