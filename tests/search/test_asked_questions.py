"""How much a reconstruction asks, and how it is refused."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from commands import ended
from concrete_trees import exact_dial, sure_arbor

from geartrain import GearTrainError
from geartrain.search.reconstruct import (
    Additions,
    PriorFactors,
    ReconstructionProblem,
    evidence_question,
    find_reconstructions,
    read_evidence,
)

TOY = ReconstructionProblem(
    sure_arbor("in", i=20),
    (sure_arbor("a", a1=30, a2=15),),
    (exact_dial("p", Fraction(-1, 2)), exact_dial("q", Fraction(1, 3))),
    Additions(3, 10, 45),
)


def doubtful() -> ReconstructionProblem:
    return evidence_question(read_evidence("back-train-doubt")).problem


@pytest.mark.parametrize("idlers", [False, True])
def test_an_absurd_number_of_added_wheels_is_refused_before_the_search(
    idlers: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """1000 wheels of 36 counts: 36^1000 = 10^1556 choices; 10^24 are those of 15 wheels."""
    monkeypatch.setattr("geartrain.search.reconstruct.search_tasks._counted", lambda *_: pytest.fail("searched"))
    with pytest.raises(GearTrainError) as caught:
        find_reconstructions(replace(TOY, additions=Additions(1000, 10, 45), idlers=idlers))
    (problem,) = caught.value.problems
    assert "up to 1000 added wheels of 10 to 45 teeth have 1e1556 combinations" in problem.what
    assert "at most 15 wheels: `-k 15`" in problem.fix


def test_more_added_wheels_than_a_search_stores_are_refused() -> None:
    with pytest.raises(GearTrainError, match="supports up to 100 added wheels"):
        find_reconstructions(replace(TOY, additions=Additions(101, 20, 20)))


def test_the_command_says_the_size_first_and_refuses_the_absurd() -> None:
    done = ended("reconstruct", "moon-c-e", "-k", "1000", "--count")
    assert done.returncode == 2
    assert "problem: 3 arbors with 4 wheels; 1 dial; at most 1000 added wheels" in done.stderr
    assert "1e2330 combinations" in done.stderr


def test_what_is_too_wide_is_refused_with_what_is_requested(monkeypatch: pytest.MonkeyPatch) -> None:
    # a problem of its own, because path lists of another test with the same problem are kept
    problem = replace(doubtful(), factors=PriorFactors(wheel=Fraction(7)))
    monkeypatch.setattr("geartrain.search.reconstruct.path_lists._MOST_PATHS", 1000)
    with pytest.raises(GearTrainError) as caught:
        find_reconstructions(problem)
    (refusal,) = caught.value.problems
    assert refusal.what == "more than 1000 paths to 'metonic' would have to be examined"
    # 2 x 5 x 19 x 13 x 2 x 3 readings
    assert refusal.why == (
        "the problem has 6 arbors with 10 wheels and 14820 combinations of their counts; 2 dials; "
        "at most 2 added wheels of 12 to 225 teeth"
    )
    for way in ("`-k 1`", "e3 has 19, e4 has 13, m1 has 5", "omit arbors"):
        assert way in refusal.fix
