"""The search of whole trees against plain growth of concrete trees, and its parts against plain loops."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from concrete_trees import concrete, explanations, random_problem

from geartrain.synthesis.reconstruction import reconstruction_search
from geartrain.synthesis.reconstruction.added_structures import PlacedSet
from geartrain.synthesis.reconstruction.evidence_question import evidence_question
from geartrain.synthesis.reconstruction.prime_shares import NO_STATE, PrimeShares, packed_powers
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.reconstruction_search import find_reconstructions
from geartrain.synthesis.reconstruction.train_rows import alike_rows
from geartrain.synthesis.reconstruction.whole_tree_questions import are_whole_trees_asked
from geartrain.train.declaration_files import read_evidence


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
        assert are_whole_trees_asked(problem) == (2 * len(problem.meshes) <= len(problem.arbors))
        answered += has_the_answers_of_plain_growth(problem, seed) > 0
    assert answered > 5


def test_no_answer_depends_on_keys(monkeypatch: pytest.MonkeyPatch) -> None:
    """With one word for all primes nearly all numbers have keys of others."""
    monkeypatch.setattr(QuotientKeys, "_word", lambda *_: 1)
    for seed in range(2000, 2020):
        has_the_answers_of_plain_growth(exact_problem(seed), seed)


def test_no_answer_depends_on_how_many_trains_are_grown_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    module = "geartrain.synthesis.reconstruction"
    monkeypatch.setattr(f"{module}.whole_trees._PIECE", 3)
    monkeypatch.setattr(f"{module}.shared_readings._ALIKE", 0)
    for seed in range(2020, 2040):
        has_the_answers_of_plain_growth(exact_problem(seed), seed)


def test_sums_are_those_of_what_is_listed(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = replace(evidence_question(read_evidence("back-train")).problem)
    problem = replace(problem, additions=replace(problem.additions, wheels=3))
    listed = find_reconstructions(problem).counts
    monkeypatch.setattr(reconstruction_search, "_TOLD_APART", 3)
    summed = find_reconstructions(problem, listed=0).counts
    assert [each.mechanisms for each in summed] == [each.mechanisms for each in listed] == [0, 0, 4, 60]
    assert [each.classes for each in summed] == [0, 0, 2, None]  # 4 trains are 2 choices of counts in either order


def test_primes_are_shared_out_as_in_plain_loops() -> None:
    chance = random.Random(7)
    for _ in range(30):
        added = tuple(sorted(PlacedSet(chance.randint(1, 7), chance.random() < 0.5) for _ in range(4)))
        shares = PrimeShares(added, 3)
        primes = [[chance.randint(-1, 1) for _ in range(3)] for _ in range(2)]
        state = np.array([PrimeShares.start])
        for powers in primes:
            state = shares.after(state, np.array([packed_powers(powers)]))
        assert (state[0] != NO_STATE) == _can_be_shared(added, primes), (added, primes)


def _can_be_shared(added: tuple[PlacedSet, ...], primes: list[list[int]]) -> bool:
    """Whether each wheel can be given one of the primes or none."""
    for given in product(range(len(primes) + 1), repeat=len(added)):
        held = [
            [
                sum(
                    (1 if wheel.drives else -1) * (wheel.dials >> dial & 1)
                    for wheel, own in zip(added, given, strict=True)
                    if own == at
                )
                for dial in range(3)
            ]
            for at in range(len(primes))
        ]
        if held == primes:
            return True
    return False


def test_rows_that_are_mixed_to_one_word_are_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    columns = [np.array([1, 2, 1, 3]), np.array([5, 5, 5, 6])]
    monkeypatch.setattr("geartrain.synthesis.reconstruction.train_rows._ODD", np.uint64(0))
    first, which = alike_rows(columns)
    assert [[int(column[one]) for column in columns] for one in np.array(first)[which]] == [
        [1, 5],
        [2, 5],
        [1, 5],
        [3, 6],
    ]
