"""A known train in a question: it breaks a rule just where plain growth does not find it, and ranks where it does."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from concrete_trees import concrete, declared, explanations, nodes, package_arbor, plain_prior, random_problem
from sampling import all_but, few_or_many

from geartrain import GearTrainError, load
from geartrain.search.reconstruct import (
    Arbor,
    PlacedWheel,
    ReconstructionAnswer,
    ReconstructionProblem,
    ReconstructionRequest,
    SearchedDial,
    SurvivingArbor,
    candidate_train,
    evidence_question,
    read_evidence,
    reconstruct,
)
from geartrain.search.reconstruct.candidate_rules import broken_rules
from geartrain.train import Train, declare


def loosened(problem: ReconstructionProblem, part: int) -> ReconstructionProblem:
    """The question without some of its rules, so that plain growth finds trains that break them."""

    def misread(arbor: SurvivingArbor) -> SurvivingArbor:
        wheels = (replace(one, counts=(*one.counts, (one.counts[-1][0] + 1, Fraction(1)))) for one in arbor.wheels)
        return replace(arbor, wheels=tuple(wheels))

    def turned(dial: SearchedDial) -> SearchedDial:
        ends = sorted((abs(dial.minimum), abs(dial.maximum)))
        return replace(dial, minimum=ends[0] * Fraction(9, 10), maximum=ends[1], signed=False)

    if part == 0:
        free = frozenset[frozenset[str]]()
        return replace(problem, meshes=free, apart=free, coaxial=free, idlers=True)
    if part == 1:
        return replace(problem, input=misread(problem.input), arbors=tuple(map(misread, problem.arbors)))
    if part == 2:
        return replace(problem, dials=tuple(map(turned, problem.dials)), use="some")
    limits = replace(problem.additions, arbors=None, on="any", minimum=problem.additions.minimum - 1)
    return replace(problem, dials=tuple(replace(dial, place=None) for dial in problem.dials), additions=limits)


@pytest.mark.parametrize("seeds", [range(700, 720), pytest.param(range(720, 760), marks=pytest.mark.slow)])
@pytest.mark.parametrize("part", all_but({1}, range(4)))
def test_a_candidate_breaks_no_rule_just_where_plain_growth_finds_it(part: int, seeds: range) -> None:
    kept = broken = 0
    rules = set[str]()
    for seed in seeds:
        problem = random_problem(seed, idlers=True)
        right = {tree for found in explanations(problem) for tree in found.solutions}
        for found in explanations(loosened(problem, part)):
            for tree in sorted(found.solutions)[: few_or_many(100, 300)]:
                rank = broken_rules(package_arbor(tree), problem)
                assert (not rank) == (tree in right), (seed, tree, rank)
                kept, broken = kept + (not rank), broken + bool(rank)
                rules |= {one.rule for one in rank}
    assert kept > 25
    assert broken > 20
    assert (
        rules
        >= [{"seen", "apart", "idler"}, {"count"}, {"speed", "wheel", "arbor"}, {"place", "teeth", "beside"}][part]
    )


def test_a_driven_wheel_that_is_added_breaks_a_rule() -> None:
    problem = random_problem(701)
    problem = replace(problem, arbors=(SurvivingArbor("s", random_problem(701).input.wheels[:1]),), use="some")
    wheel = problem.arbors[0].wheels[0]
    dials = tuple(sorted(dial.name for dial in problem.dials))
    new = Arbor("s", PlacedWheel(None, 9), dials, ())
    tree = Arbor(problem.input.name, None, (), ((PlacedWheel(wheel.name, wheel.counts[0][0]), (new,)),))
    assert "driven" in {one.rule for one in broken_rules(tree, problem)}


# places


def test_a_place_is_that_among_all_trains_of_plain_growth() -> None:
    placed = 0
    for seed in range(760, 800):
        evidence = declared(random_problem(seed))
        problem = evidence_question(evidence).problem
        trees = [(found.counts.added, tree) for found in explanations(problem) for tree in found.solutions]
        weights = {tree: plain_prior(tree, problem) for _, tree in trees}
        known = tuple(candidate_train(evidence, package_arbor(tree), "known") for _, tree in trees[:20])
        found = reconstruct(ReconstructionRequest(evidence, counts_only=True, known=known))
        assert found.total == len(trees)
        for (added, tree), one in zip(trees, found.known, strict=False):
            place = one.place
            assert place is not None
            alike = [weights[other] for own, other in trees if own == added]
            for ranks, some in ((place.ranks, list(weights.values())), (place.ranks_alike, alike)):
                heavier = sum(weight > weights[tree] for weight in some)
                assert ranks == (heavier + 1, heavier + some.count(weights[tree]))
            assert (place.trains, place.trains_alike) == (len(trees), len(alike))
            assert place.weight == pytest.approx(float(weights[tree] / sum(weights.values())), rel=1e-12)
            assert place.dearer == max(weights.values()) / weights[tree]
            placed += 1
    assert placed > 100


# trains


PRICE = {"E4": "e3", "E3": "e4", "G2": "g1", "E2i": "e2", "four years": "metonic"}


def ranked(
    train: Train, same: Mapping[str, str] | None = None, name: str = "back-wheels-sure", **options: Any
) -> ReconstructionAnswer:
    """Answer in which the train is the known one; no other is listed."""
    request = {"wheels": 3, "counts_only": True} | options
    return reconstruct(ReconstructionRequest(read_evidence(name), known=(train,), same=same or {}, **request))


def test_prices_train_breaks_many_rules() -> None:
    (found,) = ranked(load("price-1974").declaration, PRICE).known
    assert {(one.rule, *one.subject) for one in found.broken} >= {
        ("speed", "metonic"),
        ("dial", "saros"),
        ("speed", "moon"),
        ("count", "l1"),
        ("count", "l2"),
        ("count", "m2"),
        ("arbor", "E"),
        ("arbor", "f"),
        ("arbor", "g"),
    }


def test_names_are_found_whatever_their_capitals_unless_told_otherwise() -> None:
    train = load("price-1974").declaration
    added = [ranked(train, same).known[0].wheels for same in (PRICE, None)]
    assert added == [{"B4": 32, "N": 64}, {"N": 64}], "the others survive; B4 only drives wheels with other names"
    with pytest.raises(GearTrainError, match="is not a wheel or a dial"):
        ranked(train, {"E4": "e33"})


def test_a_train_with_a_loop_is_refused() -> None:
    looped = declare(
        {
            "name": "loop",
            "links": {
                "frame": {},
                "b": {"wheels": {"b2": 64}},
                "c": {"wheels": {"c1": 38, "c2": 48}},
                "d": {"wheels": {"d1": 24}},
            },
            "revolutes": {"B": ["frame", "b"], "C": ["frame", "c"], "D": ["frame", "d"]},
            "gears": ["b2 ~ c1", "c2 ~ d1", "d1 ~ b2"],
            "inputs": {"b": 1},
        }
    )
    with pytest.raises(GearTrainError, match="close a loop"):
        ranked(looped)


def test_wheels_that_are_on_other_arbors_are_not_taken_for_those_that_survive() -> None:
    parted = declare(
        {
            "name": "parted",
            "links": {
                "frame": {},
                "b": {"wheels": {"b2": 64}},
                "c": {"wheels": {"c1": 38}},
                "x": {"wheels": {"c2": 48}},
                "d": {"wheels": {"d1": 24, "d2": 127}},
            },
            "revolutes": {"B": ["frame", "b"], "C": ["frame", "c"], "D": ["frame", "d"], "X": ["frame", "x"]},
            "gears": ["b2 ~ d1", "d2 ~ c2"],
            "inputs": {"b": 1},
        }
    )
    (known,) = ranked(parted).known
    assert known.notes == ("c2 is not fixed to the other wheels of c, and is therefore not identified with c2",)


# what singles a train out


def plain_facts(tree: tuple) -> set[tuple]:
    """Meshes of surviving wheels and drivers of surviving arbors, of a concrete tree."""
    found: set[tuple] = set()
    for name, _, _, drives in nodes(tree):
        for wheel, children in drives:
            for child in children:
                if wheel[0] and child[1][0]:
                    found.add(("pair", " and ".join(sorted((wheel[0], child[1][0]))), "yes"))
                if child[0]:
                    found.add(("driver", child[0], name or "an added arbor"))
    return found


@pytest.mark.parametrize("name", all_but({"back-wheels-sure"}, ["back-train", "back-train-doubt", "back-wheels-sure"]))
def test_what_singles_a_train_out_is_what_plain_sets_of_trains_say(name: str) -> None:
    """Counts of wheels by their names are looked up in the list."""
    evidence = read_evidence(name)
    found = reconstruct(ReconstructionRequest(evidence, best=None))
    facts = []
    for listed, one in zip(found.best, found.candidates, strict=True):
        counts = {("added", wheel, str(teeth)) for wheel, teeth in listed.wheels.items()}
        counts |= {("count", wheel, str(teeth)) for wheel, teeth in listed.doubtful.items()}
        facts.append(plain_facts(concrete(one.arbor)) | counts)
    known = tuple(candidate_train(evidence, one.arbor, "known") for one in found.candidates)
    for own, one in zip(facts, reconstruct(ReconstructionRequest(evidence, best=None, known=known)).known, strict=True):
        left = {fact: sum(fact in some for some in facts) for fact in own}
        told = {(each.kind, each.subject, each.answer): each.solutions for each in one.telling}
        assert told == {fact: trains for fact, trains in left.items() if trains < len(facts)}
        assert list(told.values()) == sorted(told.values())
