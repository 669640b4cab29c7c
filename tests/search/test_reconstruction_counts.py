"""Counts of reconstructions against those of two programs in another language, written from the rules alone.

One looks for trees whose added wheels are unknowns, one grows concrete trees; `reconstruction_counts.json` holds what
they found: by number of added wheels from 0 on, solutions, multisets and ratio classes. The historic questions
have the counts that were known before. `carried_counts.json` holds the numbers of trains of the front of the
Antikythera mechanism, found by a third program: it lists the shapes of trees, gathers those of one system of equations,
and solves each by loops over products.
"""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from concrete_trees import explanations

from geartrain.search.reconstruct import (
    Additions,
    ReconstructionProblem,
    SearchedDial,
    SurvivingArbor,
    SurvivingWheel,
    evidence_question,
    find_reconstructions,
    read_evidence,
)
from geartrain.train import declare

LONG = {  # each some seconds
    "b byzantine",
    "back with c d e o, Metonic+Saros+Moon+Games, counts sure",
    "back with o (no c d e), Metonic+Saros+Games",
    "random 1016",
    "medium 7004",
    "back with doubts, Metonic+Saros",
    "back with doubts and c d e (sure), Metonic+Saros+Moon",
}
QUESTIONS, CARRIED = (
    json.loads((Path(__file__).parent / name).read_text(encoding="utf-8"))
    for name in ("reconstruction_counts.json", "carried_counts.json")
)


def requested(question: dict[str, Any]) -> ReconstructionProblem:
    ((name, wheels),) = question["input"].items()
    minimum, maximum = question["added"]
    wheels_added = len(question["counts"]) - 1
    return ReconstructionProblem(
        input=_arbor(name, wheels),
        arbors=tuple(_arbor(*each) for each in question["arbors"].items()),
        dials=tuple(map(_dial, question["dials"])),
        additions=Additions(wheels_added, minimum, maximum, question.get("most_arbors"), question.get("on", "any")),
        use=question.get("use", "wheels"),
        idlers=question.get("idlers", False),
    )


def _arbor(name: str, wheels: dict[str, int | list[int]]) -> SurvivingArbor:
    counts = {wheel: teeth if isinstance(teeth, list) else [teeth] for wheel, teeth in wheels.items()}
    found = (
        SurvivingWheel(wheel, tuple((count, Fraction(1, len(some))) for count in some))
        for wheel, some in counts.items()
    )
    return SurvivingArbor(name, tuple(found))


def _dial(given: dict[str, Any]) -> SearchedDial:
    signed = given.get("signed", True)
    if "minimum" in given:
        minimum, maximum = Fraction(given["minimum"]), Fraction(given["maximum"])
    else:
        minimum = maximum = Fraction(given["speed"]) if signed else abs(Fraction(given["speed"]))
    place = given.get("place")
    return SearchedDial(given["name"], minimum, maximum, signed, place)


def _parameter(question: dict[str, Any]) -> Any:
    name = question.get("name") or "-".join(map(str, [*question["dials"], *question["added"], len(question["counts"])]))
    marks = [pytest.mark.slow] * (name in LONG) + [pytest.mark.long] * question.get("slow", False)
    return pytest.param(question, id=name.replace(" ", "-"), marks=marks)


@pytest.mark.parametrize("question", [*map(_parameter, QUESTIONS)])
def test_counts_are_those_of_other_programs(question: dict[str, Any]) -> None:
    found = find_reconstructions(requested(question), listed=0)
    assert found.complete
    assert [[each.solutions, each.multisets, each.classes] for each in found.counts] == question["counts"]


@pytest.mark.parametrize("question", [*map(_parameter, QUESTIONS[:7])])
def test_plain_growth_has_the_counts_of_toys_and_of_al_biruni(question: dict[str, Any]) -> None:
    found = [list(each.counts[1:]) for each in explanations(requested(question))]
    assert found == question["counts"]


@pytest.mark.parametrize("question", [*map(_parameter, CARRIED)])
def test_counts_on_a_carrier_are_those_of_another_program(question: dict[str, Any]) -> None:
    evidence = read_evidence("front-planets").model_dump(mode="json", exclude_unset=True, by_alias=True)
    evidence["outputs"] = {dial: evidence["outputs"][dial] for dial in question["dials"]}
    if "venus" not in question["dials"]:
        del evidence["links"]["r1"], evidence["revolutes"]
    evidence["reconstruct"]["add"] = {"wheels": len(question["counts"]) - 1, "teeth": question["added"]}
    found = find_reconstructions(evidence_question(declare(evidence)).problem, listed=0)
    assert found.complete
    assert [each.solutions for each in found.counts] == question["counts"]


@pytest.mark.parametrize(
    ("evidence", "name"),
    [
        ("back-train", "e4 back"),
        ("back-train-exeligmos", "e5 exeligmos"),
        ("back-train-moon", "e6 moon"),
        ("back-train-doubt", "back with doubts, Metonic+Saros"),
        ("back-wheels-sure", "back with c d e o, Metonic+Saros+Moon+Games, counts sure"),
    ],
)
def test_shipped_evidence_asks_what_other_programs_were_requested(evidence: str, name: str) -> None:
    (question,) = (each for each in QUESTIONS if each["name"] == name)
    assert _plain(evidence_question(read_evidence(evidence)).problem) == _plain(requested(question))


def test_back_wheels_in_doubt_ask_what_other_programs_were_requested_with_the_games_beside() -> None:
    problem = evidence_question(read_evidence("back-wheels")).problem
    (games,) = (dial for dial in problem.dials if dial.place == "o")
    assert (games.name, games.minimum, games.maximum) == ("games", Fraction(1, 4), Fraction(1, 4))
    arbors = tuple(arbor for arbor in problem.arbors if arbor.name != "o")
    dials = tuple(dial for dial in problem.dials if dial != games)
    (question,) = (each for each in QUESTIONS if each["name"].startswith("back with doubts and c d e"))
    assert _plain(replace(problem, arbors=arbors, dials=dials)) == _plain(requested(question))


@pytest.mark.slow
def test_back_wheels_have_as_many_trains_with_five_added_as_another_program_found() -> None:
    problem = evidence_question(read_evidence("back-wheels-sure")).problem
    problem = replace(problem, additions=replace(problem.additions, wheels=5))
    found = find_reconstructions(problem, listed=0)
    assert [each.solutions for each in found.counts] == [0, 0, 0, 21, 3674, 879_124]


def _plain(problem: ReconstructionProblem) -> tuple[Any, ...]:
    """A question but for names of wheels, the order of its parts and how many wheels may be added."""
    wheels = {arbor.name: sorted(wheel.counts for wheel in arbor.wheels) for arbor in (problem.input, *problem.arbors)}
    facts = (problem.meshes, problem.apart, problem.coaxial)
    additions = replace(problem.additions, wheels=0)
    return wheels, {*problem.dials}, problem.input_speed, additions, problem.use, problem.idlers, facts
