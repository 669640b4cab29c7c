"""How much a reconstruction asks, what it is expected to cost, and how it is refused."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import pytest
from commands import ended
from concrete_trees import exact_dial, sure_arbor

from geartrain import GearTrainError
from geartrain.search.reconstruct import (
    Additions,
    ReconstructionProblem,
    evidence_question,
    find_reconstructions,
    path_lists,
    read_evidence,
    search_tasks,
)
from geartrain.search.reconstruct.reconstruction_problem import RequestedQuestion
from geartrain.search.reconstruct.search_tasks import TopologyTask, done_shares, expect_cost, rough, topology_tasks

TOY = ReconstructionProblem(
    sure_arbor("in", i=20),
    (sure_arbor("a", a1=30, a2=15),),
    (exact_dial("p", Fraction(-1, 2)), exact_dial("q", Fraction(1, 3))),
    Additions(3, 10, 45),
)


def doubtful() -> ReconstructionProblem:
    return evidence_question(read_evidence("back-train-doubt")).problem


def test_what_is_requested_is_counted() -> None:
    """2 x 5 x 19 x 13 x 2 x 3 readings."""
    assert RequestedQuestion.of(doubtful()) == RequestedQuestion(6, 10, 14820, 2, 2, (12, 225))
    assert str(RequestedQuestion.of(doubtful())) == (
        "6 arbors with 10 wheels and 14820 combinations of their counts; 2 dials; "
        "at most 2 added wheels of 12 to 225 teeth"
    )
    assert str(RequestedQuestion(1, 1, 1, 1, 0, (1, 1))) == "1 arbor with 1 wheel; 1 dial; no added wheels"


def test_paths_are_those_found_by_hand() -> None:
    """-1/2 is 20 > 40."""
    lone = ReconstructionProblem(
        sure_arbor("in", i=20), (), (exact_dial("p", Fraction(-1, 2)),), Additions(1, 10, 45), idlers=True
    )
    assert expect_cost(lone).paths == {"p": 1}
    assert expect_cost(lone).seconds == (0, 0)


def test_the_time_is_that_of_a_part_times_their_number(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every part begins with 2 s, and all of them share 640 s of work."""
    requested: list[TopologyTask] = []

    def timed(task: TopologyTask) -> float:
        requested.append(task)
        return 2 + (640 / task.parts if task.part < task.parts else 0)  # three in 4096 are half a second

    monkeypatch.setattr(search_tasks, "timed_part", timed)
    found = expect_cost(TOY)
    assert found.seconds[:3] == (0, 0, 0)
    assert found.seconds[3] == pytest.approx(642)
    assert {task.added for task in requested} == {3}
    assert found.parts == 4096
    shares = done_shares(TOY, found)
    assert (len(shares), shares[0], shares[-1]) == (len(topology_tasks(TOY)) + 1, 0, 1)
    assert all(one < other for one, other in pairwise(shares))
    assert shares[3] < 0.01  # up to two added wheels takes next to nothing


@pytest.mark.parametrize("idlers", [False, True])
def test_an_absurd_number_of_added_wheels_is_refused_before_anything_is_timed(
    idlers: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """1000 wheels of 36 counts: 36^1000 = 10^1556 choices; 10^40 are those of 25 wheels."""
    monkeypatch.setattr(search_tasks, "timed_part", lambda *_: pytest.fail("timed"))
    with pytest.raises(GearTrainError) as caught:
        expect_cost(replace(TOY, additions=Additions(1000, 10, 45), idlers=idlers))
    (problem,) = caught.value.problems
    assert "up to 1000 added wheels of 10 to 45 teeth have 1e1556 choices" in problem.what
    assert "at most 25 wheels: `-k 25`" in problem.fix


def test_a_search_that_would_not_end_is_refused_by_how_its_time_grows(monkeypatch: pytest.MonkeyPatch) -> None:
    """640 s with 3 added wheels and ten times as long with each more: 6.4e16 s, 2e9 years, with 17."""

    def timed(task: TopologyTask) -> float:
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
    assert "1e2330 choices" in done.stderr


def test_a_search_that_was_expected_finds_the_same() -> None:
    before = find_reconstructions(TOY).counts
    expect_cost(TOY)
    assert find_reconstructions(TOY).counts == before


def test_rough_times() -> None:
    assert [rough(seconds) for seconds in (0, 0.9, 1, 27.4, 196, 86400)] == [0, 0, 1, 30, 200, 90000]


def test_what_is_too_wide_is_refused_with_what_is_requested(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(path_lists, "_MOST_PATHS", 1000)
    with pytest.raises(GearTrainError) as caught:
        find_reconstructions(doubtful())
    (problem,) = caught.value.problems
    assert problem.what == "more than 1000 paths to 'metonic' would have to be examined"
    assert problem.why == f"the problem has {RequestedQuestion.of(doubtful())}"
    for way in ("`-k 1`", "e3 has 19, e4 has 13, m1 has 5", "leave out arbors"):
        assert way in problem.fix
