"""The search of reconstructions against plain growth of concrete trees, on small questions of all kinds."""

from __future__ import annotations

import pytest
from concrete_trees import concrete, explanations, random_problem

from geartrain.errors import QuestionError
from geartrain.synthesis.reconstruction.reconstruction_search import find_reconstructions


@pytest.mark.parametrize("first", range(0, 400, 20))
def test_small_questions_have_the_answers_of_plain_growth(first: int) -> None:
    for seed in range(first, first + 20):
        problem = random_problem(seed, idlers=True)
        try:
            found = find_reconstructions(problem, listed=20_000)
        except QuestionError:
            continue  # not taken up yet, and said so
        right = explanations(problem)
        assert found.complete
        assert [tuple(count.to_dict().values()) for count in found.counts] == [each.counts for each in right], seed
        trees = [(one.added, concrete(one.arbor)) for one in found.candidates]
        assert len(set(trees)) == len(trees)
        assert set(trees) == {(each.counts.added, tree) for each in right for tree in each.mechanisms}
        assert sum(one.weight for one in found.candidates) == pytest.approx(1 if trees else 0)
