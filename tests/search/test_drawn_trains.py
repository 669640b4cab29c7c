"""Trains drawn from the sums come as often as each other, and every train of a topology comes."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import pytest
from concrete_trees import Node, concrete, explanations, random_problem, with_rings
from sampling import first_few

from geartrain.search.reconstruct import draw_candidates, evidence_question, find_reconstructions, read_evidence

DRAWS = 60
"""For each train, on average."""


@pytest.mark.parametrize("rings", first_few(1, [True, False]))
def test_each_train_of_a_topology_is_drawn_as_often(rings: bool) -> None:
    tried = 0
    for seed in range(300, 340):
        plain = random_problem(seed, idlers=True)
        problem = with_rings(plain, seed) if rings else plain
        grown = {tree for found in explanations(problem) for tree in found.solutions}
        whole = find_reconstructions(problem, listed=0)
        everything: set[Node] = set()
        for each in whole.topologies[:20]:
            if each.solutions > 12:
                continue
            one = replace(whole, topologies=(each,))
            drawn = draw_candidates(one, problem, DRAWS * each.solutions, seed)
            found = Counter(concrete(train.arbor) for train in drawn)
            assert len(found) == each.solutions
            assert set(found) <= grown
            # eight standard deviations of a binomial
            assert all(abs(number - DRAWS) < 8 * DRAWS**0.5 for number in found.values())
            assert not everything & set(found)
            everything |= set(found)
            tried += each.solutions > 1
    assert tried > (3 if rings else 10)


@pytest.mark.slow
def test_trains_of_different_weights_are_drawn_by_them() -> None:
    problem = evidence_question(read_evidence("isfahan-without-pivot"), 3).problem
    found = find_reconstructions(problem, listed=10_000)
    drawn = draw_candidates(found, problem, DRAWS * 100, 2)
    assert drawn == draw_candidates(found, problem, DRAWS * 100, 2)
    listed = {one.arbor: one for one in found.candidates}
    assert sum(one.weight for one in listed.values()) == pytest.approx(1)
    assert all(listed[one.arbor] == one for one in drawn)
    for added in {one.added for one in listed.values()}:
        share = sum(one.weight for one in listed.values() if one.added == added)
        number = sum(one.added == added for one in drawn)
        assert abs(number - share * len(drawn)) < 6 * (share * (1 - share) * len(drawn)) ** 0.5 + 1
