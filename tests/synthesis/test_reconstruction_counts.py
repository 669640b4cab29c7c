"""Counts of reconstructions against those of two programs in another language, written from the rules alone.

One looks for trees whose added wheels are unknowns, one grows concrete trees; `reconstruction_counts.json` holds what
they found: by number of added wheels from 0 on, mechanisms, bags and ratio classes. The historic questions among them
have the counts that were known before.
"""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from geartrain.synthesis.reconstruction.reconstruction_problem import (
    NEW,
    Additions,
    ReconstructionProblem,
    SearchedDial,
    SurvivingArbor,
    SurvivingWheel,
)
from geartrain.synthesis.reconstruction.reconstruction_search import find_reconstructions

QUESTIONS = json.loads((Path(__file__).parent / "reconstruction_counts.json").read_text(encoding="utf-8"))


def asked(question: dict[str, Any]) -> ReconstructionProblem:
    ((name, wheels),) = question["input"].items()
    least, greatest = question["added"]
    wheels_added = len(question["counts"]) - 1
    return ReconstructionProblem(
        input=_arbor(name, wheels),
        arbors=tuple(_arbor(*each) for each in question["arbors"].items()),
        dials=tuple(map(_dial, question["dials"])),
        additions=Additions(wheels_added, least, greatest, question.get("most_arbors"), question.get("on", "any")),
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
    if "least" in given:
        least, greatest = Fraction(given["least"]), Fraction(given["greatest"])
    else:
        least = greatest = Fraction(given["speed"]) if signed else abs(Fraction(given["speed"]))
    place = given.get("place")
    return SearchedDial(given["name"], least, greatest, signed, NEW if place == "new" else place)


@pytest.mark.parametrize("question", QUESTIONS, ids=lambda question: question["name"].replace(" ", "-"))
def test_counts_are_those_of_other_programs(question: dict[str, Any]) -> None:
    found = find_reconstructions(asked(question), listed=0)
    assert found.complete
    assert [[each.mechanisms, each.bags, each.classes] for each in found.counts] == question["counts"]
