"""Questions whose dials are exact and a count is in doubt, against plain growth of concrete trees."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest
from concrete_trees import concrete, explanations, random_problem

from geartrain.search.reconstruct.quotient_keys import QuotientKeys
from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem
from geartrain.search.reconstruct.reconstruction_search import find_reconstructions


def exact_problem(seed: int) -> ReconstructionProblem:
    """A random question whose dials are exact, with a wheel more in doubt."""
    problem, chance = random_problem(seed), random.Random(seed)
    dials = tuple(replace(dial, least=_middle(dial.least, dial.greatest)) for dial in problem.dials)
    dials = tuple(replace(dial, greatest=dial.least) for dial in dials)
    if not problem.arbors:
        return replace(problem, dials=dials)
    at = chance.randrange(len(problem.arbors))
    arbor = problem.arbors[at]
    (first, *others) = arbor.wheels
    teeth = sorted({first.counts[0][0], first.counts[0][0] + 1, *(count for count, _ in first.counts)})
    doubted = replace(first, counts=tuple((count, Fraction(1, len(teeth))) for count in teeth))
    arbors = list(problem.arbors)
    arbors[at] = replace(arbor, wheels=(doubted, *others))
    return replace(problem, dials=dials, arbors=tuple(arbors))


def _middle(low: Fraction, high: Fraction) -> Fraction:
    return (low + high) / 2


def has_the_answers_of_plain_growth(problem: ReconstructionProblem, seed: int) -> int:
    """Hold what is found against plain growth; the number of trains is given back."""
    found = find_reconstructions(problem, listed=20_000)
    right = explanations(problem)
    assert [tuple(count.to_dict().values()) for count in found.counts] == [each.counts for each in right], seed
    trees = {(one.added, concrete(one.arbor)) for one in found.candidates}
    assert trees == {(each.counts.added, tree) for each in right for tree in each.mechanisms}
    return len(trees)


@pytest.mark.parametrize("first", range(2000, 2200, 20))
def test_exact_questions_have_the_answers_of_plain_growth(first: int) -> None:
    answered = 0
    for seed in range(first, first + 20):
        problem = exact_problem(seed)
        answered += has_the_answers_of_plain_growth(problem, seed) > 0
    assert answered > 5


def test_no_answer_depends_on_keys(monkeypatch: pytest.MonkeyPatch) -> None:
    """With one word for all primes nearly all numbers have keys of others."""
    monkeypatch.setattr(QuotientKeys, "_word", lambda *_: 1)
    for seed in range(2000, 2020):
        has_the_answers_of_plain_growth(exact_problem(seed), seed)


def test_no_answer_depends_on_how_many_paths_are_grown_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    module = "geartrain.search.reconstruct"
    monkeypatch.setattr(f"{module}.path_lists._PIECE", 3)
    monkeypatch.setattr(f"{module}.path_choice._PIECE", 3)
    for seed in range(2020, 2040):
        has_the_answers_of_plain_growth(exact_problem(seed), seed)
