"""The search of reconstructions against plain growth of concrete trees, on small questions of all kinds."""

from __future__ import annotations

import pytest
from concrete_trees import Found, concrete, explanations, meshes, random_problem, with_rings
from sampling import all_but

from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem
from geartrain.search.reconstruct.reconstruction_search import find_reconstructions


@pytest.mark.parametrize("start", all_but({0, 80, 220}, range(0, 400, 20)))
def test_small_questions_have_the_answers_of_plain_growth(start: int) -> None:
    for seed in range(start, start + 20):
        _has_the_answers_of_plain_growth(random_problem(seed, idlers=True), seed)


@pytest.mark.parametrize("start", all_but({1100, 1140, 1200}, range(1000, 1300, 20)))
def test_small_questions_with_rings_have_the_answers_of_plain_growth(start: int) -> None:
    turning = 0
    for seed in range(start, start + 20):
        problem = with_rings(random_problem(seed, idlers=True), seed)
        for found in _has_the_answers_of_plain_growth(problem, seed):
            turning += any(
                problem.rings & {name for pair in meshes(one) for name, _ in pair} for one in found.mechanisms
            )
    assert turning


def _has_the_answers_of_plain_growth(problem: ReconstructionProblem, seed: int) -> tuple[Found, ...]:
    """Hold what is found against plain growth, which is given back."""
    found = find_reconstructions(problem, listed=20_000)
    right = explanations(problem)
    assert found.complete
    assert [tuple(count.to_dict().values()) for count in found.counts] == [each.counts for each in right], seed
    trees = [(one.added, concrete(one.arbor)) for one in found.candidates]
    assert len(set(trees)) == len(trees)
    assert set(trees) == {(each.counts.added, tree) for each in right for tree in each.mechanisms}
    assert sum(one.weight for one in found.candidates) == pytest.approx(1 if trees else 0)
    return right
