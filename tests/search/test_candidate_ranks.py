"""Ranks of candidates are intervals where some weigh the same, among all that are counted."""

from __future__ import annotations

from collections import Counter

import pytest
from concrete_trees import concrete, explanations, plain_prior, random_problem, sections
from sampling import all_but

from geartrain.search.reconstruct import ExplanationCount, RankedTrain, ReconstructionAnswer, find_reconstructions


@pytest.mark.parametrize("seed", all_but({92}, range(60, 100)))
def test_ranks_are_those_among_all_trains(seed: int) -> None:
    problem = random_problem(seed, idlers=True)
    weights = {tree: plain_prior(tree, problem) for found in explanations(problem) for tree in found.solutions}
    alike = Counter(weights.values())
    for one in find_reconstructions(problem, listed=1).candidates:
        own = weights[concrete(one.arbor)]
        heavier = sum(number for weight, number in alike.items() if weight > own)
        assert one.ranks == (heavier + 1, heavier + alike[own])


def test_a_page_shows_intervals_and_what_is_not_counted() -> None:
    problem = random_problem(60)
    counts = (ExplanationCount(0, 3, 2, 1), ExplanationCount(1, 999_999, None, None))
    best = tuple(
        RankedTrain(rank, ranks, 0, 0.25, {}, {}, ("a > b",)) for rank, ranks in ((1, (1, 1)), (2, (2, 3)), (3, (2, 3)))
    )
    page = sections(ReconstructionAnswer("some", problem, counts, True, (), best))
    assert page["Counts"].tables[0].rows[1] == ("1", "999999", "not counted", "not counted")
    assert [row[0] for row in page["Most probable trains"].tables[0].rows] == ["1", "2 (2-3)", "3 (2-3)"]
