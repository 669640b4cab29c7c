"""How much a reconstruction asks, what it is expected to cost, and how it is refused."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from commands import ended
from concrete_trees import declared, exact_dial, sure_arbor

from geartrain import GearTrainError
from geartrain.search.reconstruct import (
    Additions,
    ReconstructionProblem,
    ReconstructionRequest,
    evidence_question,
    find_reconstructions,
    path_lists,
    read_evidence,
    reconstruct,
    search_tasks,
)

TOY = ReconstructionProblem(
    sure_arbor("in", i=20),
    (sure_arbor("a", a1=30, a2=15),),
    (exact_dial("p", Fraction(-1, 2)), exact_dial("q", Fraction(1, 3))),
    Additions(3, 10, 45),
)


def expect_cost(problem: ReconstructionProblem) -> Any:
    """What the search is expected to cost before it begins."""
    return reconstruct(ReconstructionRequest(declared(problem), counts_only=True)).expected


def doubtful() -> ReconstructionProblem:
    return evidence_question(read_evidence("back-train-doubt")).problem


def test_paths_are_those_found_by_hand() -> None:
    """-1/2 is 20 > 40."""
    lone = ReconstructionProblem(
        sure_arbor("in", i=20), (), (exact_dial("p", Fraction(-1, 2)),), Additions(1, 10, 45), idlers=True
    )
    found = expect_cost(lone)
    assert (found.paths, found.seconds) == ({"p": 1}, (0, 0))


def test_the_time_is_that_of_a_part_times_their_number(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every part begins with 2 s, and all of them share 640 s of work."""
    requested: list[Any] = []

    def timed(task: Any) -> float:
        requested.append(task)
        return 2 + (640 / task.parts if task.part < task.parts else 0)  # three in 4096 are half a second

    monkeypatch.setattr(search_tasks, "timed_part", timed)
    found = expect_cost(TOY)
    assert found.seconds[:3] == (0, 0, 0)
    assert found.seconds[3] == pytest.approx(642)
    assert {task.added for task in requested} == {3}
    assert found.parts == 4096


@pytest.mark.parametrize("idlers", [False, True])
def test_an_absurd_number_of_added_wheels_is_refused_before_anything_is_timed(
    idlers: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """1000 wheels of 36 counts: 36^1000 = 10^1556 choices; 10^40 are those of 25 wheels."""
    monkeypatch.setattr(search_tasks, "timed_part", lambda *_: pytest.fail("timed"))
    with pytest.raises(GearTrainError) as caught:
        expect_cost(replace(TOY, additions=Additions(1000, 10, 45), idlers=idlers))
    (problem,) = caught.value.problems
    assert "up to 1000 added wheels of 10 to 45 teeth have 1e1556 combinations" in problem.what
    assert "at most 25 wheels: `-k 25`" in problem.fix


def test_more_added_wheels_than_a_search_stores_are_refused() -> None:
    with pytest.raises(GearTrainError, match="supports up to 100 added wheels"):
        expect_cost(replace(TOY, additions=Additions(101, 20, 20)))


def test_a_search_that_would_not_end_is_refused_by_how_its_time_grows(monkeypatch: pytest.MonkeyPatch) -> None:
    """640 s with 3 added wheels and ten times as long with each more: 6.4e16 s, 2e9 years, with 17."""

    def timed(task: Any) -> float:
        assert task.added <= 4, "what follows is not timed"
        return 2 + (640 * 10 ** (task.added - 3) / task.parts if task.part < task.parts else 0)

    monkeypatch.setattr(search_tasks, "timed_part", timed)
    with pytest.raises(GearTrainError) as caught:
        expect_cost(replace(TOY, additions=Additions(17, 10, 45)))
    (problem,) = caught.value.problems
    assert "about 1e9 years" in problem.what
    assert "each further wheel takes 10 times as long" in problem.why
    assert "at most 9 wheels, with -k" in problem.fix  # 6.4e8 s; 6.4e9 s are two hundred years


def test_the_command_says_the_size_first_and_refuses_the_absurd() -> None:
    done = ended("reconstruct", "moon-c-e", "-k", "1000", "--count")
    assert done.returncode == 2
    assert "problem: 3 arbors with 4 wheels; 1 dial; at most 1000 added wheels" in done.stderr
    assert "1e2330 combinations" in done.stderr


def test_what_is_too_wide_is_refused_with_what_is_requested(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(path_lists, "_MOST_PATHS", 1000)
    with pytest.raises(GearTrainError) as caught:
        find_reconstructions(doubtful())
    (problem,) = caught.value.problems
    assert problem.what == "more than 1000 paths to 'metonic' would have to be examined"
    # 2 x 5 x 19 x 13 x 2 x 3 readings
    assert problem.why == (
        "the problem has 6 arbors with 10 wheels and 14820 combinations of their counts; 2 dials; "
        "at most 2 added wheels of 12 to 225 teeth"
    )
    for way in ("`-k 1`", "e3 has 19, e4 has 13, m1 has 5", "omit arbors"):
        assert way in problem.fix
