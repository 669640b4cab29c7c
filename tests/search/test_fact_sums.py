"""Sums over all trains of random questions, against the same over concrete trees one by one: equal as fractions."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from fractions import Fraction

import pytest
from concrete_trees import (
    ADDED,
    concrete,
    declared,
    explanations,
    meshes,
    nodes,
    package_arbor,
    plain_prior,
    random_problem,
    with_rings,
)
from sampling import all_but, first_few

from geartrain.search.reconstruct import (
    ReconstructionAnswer,
    ReconstructionProblem,
    evidence_question,
    explained_facts,
    find_reconstructions,
    read_evidence,
)

Told = dict[tuple[str, str], dict[str, tuple[Fraction, int]]]


def questions(first: int, rings: bool) -> list[ReconstructionProblem]:
    plain = [random_problem(seed, idlers=True) for seed in range(first, first + 60)]
    return [with_rings(problem, seed) for seed, problem in enumerate(plain, first)] if rings else plain


def said(problem: ReconstructionProblem, summed: bool) -> Told:
    """What is said of all trains, by sums over topologies or train by train."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(explained_facts, "MOST_SUMMED", 10**9 if summed else 0)
        found = explained_facts.find_facts(declared(problem), problem, find_reconstructions(problem, listed=20_000))
    facts = [*found.marginals, *(one.fact for one in found.next_facts)]
    return {(one.kind, one.subject): {a.answer: (a.share, a.solutions) for a in one.answers} for one in facts}


@pytest.mark.parametrize("rings", [False, True])
@pytest.mark.parametrize("first", first_few(1, [100, 160]))
def test_sums_are_those_over_all_trains(first: int, rings: bool) -> None:
    answered = 0
    for problem in questions(first, rings):
        found, expected = said(problem, summed=True), said(problem, summed=False)
        assert found.keys() == expected.keys()
        for key, answers in expected.items():
            assert found[key].keys() == answers.keys()
            for answer, (share, number) in answers.items():
                assert found[key][answer] == (pytest.approx(share, rel=1e-12), number)
        answered += bool(found)
    assert answered > (10 if rings else 40)


@pytest.mark.parametrize("first", all_but({220}, [220, 250]))
def test_sums_are_those_over_concrete_trees(first: int) -> None:
    """Meshes of survivors and counts that are needed, weighed by the table of the page."""
    for seed in range(first, first + 30):
        problem = random_problem(seed, idlers=True)
        found = said(problem, summed=True)
        trees = [tree for one in explanations(problem) for tree in one.solutions]
        weights = [plain_prior(tree, problem) for tree in trees]
        direct: dict[tuple[str, str], Fraction] = defaultdict(Fraction)
        for tree, weight in zip(trees, weights, strict=True):
            assert concrete(package_arbor(tree)) == tree
            for driving, driven in meshes(tree):
                if driving[0] and driven[0]:
                    direct["mesh", f"{driving[0]} > {driven[0]}"] += weight / sum(weights)
            added = {node[1][1] for node in nodes(tree) if node[1] and node[1][0] == ADDED}
            added |= {wheel[1] for node in nodes(tree) for wheel, _ in node[3] if wheel[0] == ADDED}
            for teeth in added:
                direct["needed", str(teeth)] += weight / sum(weights)
        survivors = {wheel.name for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels}
        told = {
            key: answers["yes"][0]
            for key, answers in found.items()
            if key[0] == "needed" or (key[0] == "mesh" and set(key[1].split(" > ")) <= survivors)
        }
        assert told == direct


@pytest.mark.parametrize(("most", "told"), [(10**6, 4), (3, 1)])
def test_facts_are_told_of_all_trains_unless_they_are_too_many(
    most: int, told: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One of the four trains of the back is listed."""
    evidence = read_evidence("back-train")
    problem = evidence_question(evidence).problem
    found = find_reconstructions(problem)
    monkeypatch.setattr(explained_facts, "MOST_SUMMED", most)
    findings = explained_facts.find_facts(evidence, problem, replace(found, candidates=found.candidates[:1]))
    assert findings.of_all == (told == 4)
    assert {one.trains for one in findings.marginals} == {told}
    assert (findings.listed, len(findings.family)) == (1, 1)
    report = ReconstructionAnswer("back", problem, found.counts, True, (), (), findings=findings)
    said = "computed over all trains." if told == 4 else "Shares are relative to them."
    assert sum(line.endswith(said) for line in str(report).splitlines()) == 1
