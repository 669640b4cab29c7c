"""Whether the search comes to a train: to all that plain growth finds, to no other, to none if it loses something."""

from __future__ import annotations

from dataclasses import replace
from itertools import islice

import pytest
from concrete_trees import exact_dial, explanations, package_arbor, random_problem, sure_arbor, with_rings
from sampling import all_but
from studies.followed_train import is_reached

from geartrain.search.reconstruct import Additions, ReconstructionProblem

# a drives an added arbor (30, 18), whose wheel of 18 drives b and an added arbor with a pointer of its own
QUESTION = ReconstructionProblem(
    sure_arbor("a", a1=20),
    (sure_arbor("b", b1=24),),
    (exact_dial("p", "1/2", place="b"), exact_dial("q", "1/3", place="new")),
    Additions(3, 10, 40),
)
ENDS = (("", ("", 36), ("q",), ()), ("b", ("b1", 24), ("p",), ()))
TRAIN = package_arbor(("a", (), (), ((("a1", 20), (("", ("", 30), (), ((("", 18), ENDS),)),)),)))


@pytest.mark.parametrize("seed", all_but({13}, range(24)))
def test_it_comes_to_all_that_plain_growth_finds_and_to_no_other(seed: int) -> None:
    problem = with_rings(random_problem(seed, idlers=True), seed)
    found = {tree for each in explanations(problem) for tree in each.solutions}
    assert all(is_reached(package_arbor(tree), problem) for tree in islice(found, 12))
    free = replace(problem, use="some", meshes=frozenset(), apart=frozenset(), coaxial=frozenset())
    others = {tree for each in explanations(free) for tree in each.solutions} - found
    assert not any(is_reached(package_arbor(tree), problem) for tree in islice(others, 12))


def test_it_comes_to_a_train_that_parts_at_an_added_wheel() -> None:
    assert is_reached(TRAIN, QUESTION)
    assert not is_reached(TRAIN, replace(QUESTION, additions=Additions(2, 10, 40)))
    assert not is_reached(TRAIN, replace(QUESTION, additions=Additions(3, 10, 35)))
