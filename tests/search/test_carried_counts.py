"""Counts of the front of the Antikythera mechanism against those of a program in another language.

It was written from the rules alone: it lists the shapes of trees, gathers those of one system of equations, and solves
each by loops over products. `carried_counts.json` holds what it found, by number of added wheels from 0 on.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from geartrain.search.reconstruct import evidence_question, find_reconstructions, read_evidence
from geartrain.train import declare

QUESTIONS = json.loads((Path(__file__).parent / "carried_counts.json").read_text(encoding="utf-8"))


def _parameter(question: dict[str, Any]) -> Any:
    name = "-".join(map(str, [*question["dials"], *question["added"], len(question["counts"]) - 1]))
    return pytest.param(question, id=name, marks=[pytest.mark.long] if question.get("slow") else [])


@pytest.mark.parametrize("question", [*map(_parameter, QUESTIONS)])
def test_counts_are_those_of_another_program(question: dict[str, Any]) -> None:
    requested = read_evidence("front-planets").model_dump(mode="json", exclude_unset=True, by_alias=True)
    requested["outputs"] = {dial: requested["outputs"][dial] for dial in question["dials"]}
    if "venus" not in question["dials"]:
        del requested["links"]["r1"], requested["revolutes"]
    requested["reconstruct"]["add"] = {"wheels": len(question["counts"]) - 1, "teeth": question["added"]}
    found = find_reconstructions(evidence_question(declare(requested)).problem, listed=0)
    assert found.complete
    assert [each.solutions for each in found.counts] == question["counts"]
