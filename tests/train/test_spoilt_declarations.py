"""No declaration, however spoilt, raises anything but our own error, and what is answered can be written down."""

from __future__ import annotations

import json
from collections.abc import Iterable
from fractions import Fraction
from itertools import chain, islice
from typing import Any

import pytest
import yaml
from mutants import mutant
from places import DATA

from geartrain import GearTrain, GearTrainError, load
from geartrain.report import collect_report

KEPT: dict[str, dict[str, Any]] = json.loads((DATA / "spoilt_declarations.json").read_text(encoding="utf-8"))
"""Declarations that once raised something else, by the seed they came of: a seed makes others as trains are added."""


@pytest.fixture
def mutants(mutant_seeds: range) -> Iterable[tuple[str, dict[str, Any]]]:
    return chain(KEPT.items(), ((str(seed), mutant(seed)) for seed in mutant_seeds))


@pytest.fixture(autouse=True)
def short_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    """A report follows motion over 20,001 positions: what can be raised of it is raised at fewer."""
    monkeypatch.setattr("geartrain.report.motion_report._TURNS", 2.0)
    monkeypatch.setattr("geartrain.report.motion_report._POSITIONS", 201)
    monkeypatch.setattr("geartrain.dynamics.motion.extreme_search.MOST_KINKS", 100)


def ask(train: GearTrain) -> None:
    """What can be asked of a train, by library and as the JSON of its report."""
    for answer in train.answers():
        said = answer.to_dict()
        json.dumps(said, allow_nan=False)
        for output in answer.outputs.values():
            assert output.speed is None or isinstance(output.speed, Fraction | float)
        torques = train.torques(answer.state)
        json.dumps(torques.to_dict(), allow_nan=False)
        assert torques.verdict.text
    assert train.mobility.by_rank >= 0
    assert all(problem.what for problem in train.kinematics.remarks)
    assert len(train.equations(train.states[0] if train.states else None).equations) >= len(train.circuits)
    json.dumps(collect_report(train).to_dict(), allow_nan=False)


def answers(data: dict[str, Any]) -> str:
    """What comes of a mutant: nothing said of a sound one, or what was refused."""
    try:
        ask(load(data))
    except GearTrainError as error:
        for problem in error.problems:
            assert problem.what
            assert problem.fix, f"a problem says what to do: {problem}"
        return error.problems[0].what
    return ""


def test_no_spoilt_declaration_raises_anything_but_our_own_error(mutants: Iterable[tuple[str, dict[str, Any]]]) -> None:
    refused = 0
    for seed, data in mutants:
        try:
            refused += bool(answers(data))
        except Exception as error:
            pytest.fail(f"mutant {seed} raised {type(error).__name__}: {error}")
    assert refused, "a fuzzer that spoils nothing finds nothing"


def test_a_mutant_written_as_text_is_read_as_its_data_are(mutants: Iterable[tuple[str, dict[str, Any]]]) -> None:
    for seed, data in islice(mutants, 100):
        outcomes = []
        for source in (data, yaml.safe_dump(data, allow_unicode=True, sort_keys=False)):
            try:
                outcomes.append(load(source).declaration.model_dump())
            except GearTrainError as error:
                outcomes.append({"refused": len(error.problems)})
        if _plain(data):
            assert outcomes[0] == outcomes[1], seed


def _plain(data: Any) -> bool:
    """True if YAML writes the data without changing what they are: as text and mappings of text."""
    if isinstance(data, dict):
        return all(isinstance(key, str) and _plain(part) for key, part in data.items())
    if isinstance(data, list):
        return all(map(_plain, data))
    return data is None or isinstance(data, str)
