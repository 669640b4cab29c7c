"""Meshes that were seen: questions in which most are, against plain growth of concrete trees."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import replace

import pytest
from concrete_trees import concrete, explanations, meshes, random_problem, with_rings

from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem
from geartrain.search.reconstruct.reconstruction_search import find_reconstructions


def seen(problem: ReconstructionProblem, seed: int) -> ReconstructionProblem | None:
    """The question with the meshes of survivors that one of its explanations has; None where there are none."""
    chance = random.Random(seed)
    trees = [tree for each in explanations(problem) for tree in sorted(each.mechanisms)]
    if not trees:
        return None
    pairs = {frozenset((one[0], other[0])) for one, other in meshes(chance.choice(trees))}
    known = frozenset(pair for pair in pairs if "" not in pair)
    some = frozenset(pair for pair in known if chance.random() < 0.9)
    return replace(problem, meshes=some, apart=frozenset()) if some else None


def plain(seed: int) -> ReconstructionProblem:
    return random_problem(seed, wheels=1)


def with_idlers(seed: int) -> ReconstructionProblem:
    return random_problem(seed, wheels=1, idlers=True)


def ringed(seed: int) -> ReconstructionProblem:
    return with_rings(random_problem(seed, wheels=1), seed)


@pytest.mark.parametrize(
    ("kind", "least"), [(plain, 40), pytest.param(with_idlers, 40, marks=pytest.mark.slow), (ringed, 10)]
)
def test_questions_of_which_meshes_were_seen_have_the_answers_of_plain_growth(
    kind: Callable[[int], ReconstructionProblem], least: int
) -> None:
    asked = 0
    for seed in range(4000, 4250):
        problem = seen(kind(seed), seed)
        if problem is None:
            continue
        asked += 2 * len(problem.meshes) > len(problem.arbors)
        found = find_reconstructions(problem, listed=20_000)
        right = explanations(problem)
        assert [tuple(count.to_dict().values()) for count in found.counts] == [each.counts for each in right], seed
        trees = {(one.added, concrete(one.arbor)) for one in found.candidates}
        assert trees == {(each.counts.added, tree) for each in right for tree in each.mechanisms}, seed
    assert asked > least
