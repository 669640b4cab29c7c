"""No declaration, however spoilt, raises anything but our own error, and what is answered can be written down."""

from __future__ import annotations

import json
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import pytest
import yaml
from mutants import mutant

from geartrain import GearTrain, GearTrainError, load
from geartrain.report.train_data import collect_report

KEPT = (354, 368, 1589, 8277)
"""Seeds that once raised something else."""


@pytest.fixture
def mutants(request: pytest.FixtureRequest) -> Iterable[int]:
    first = request.config.getoption("--first-mutant")
    return (*KEPT, *range(first, first + request.config.getoption("--mutants")))


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
    assert all(problem.what for problem in train.remarks)
    assert len(train.equations(train.states[0] if train.states else None).equations) >= len(train.circuits)
    json.dumps(collect_report(train).to_dict(), allow_nan=False)


def answers(seed: int) -> str:
    """What comes of a mutant: nothing said of a sound one, or what was refused."""
    data: dict[str, Any] = mutant(seed)
    try:
        ask(load(data))
    except GearTrainError as error:
        for problem in error.problems:
            assert problem.what
            assert problem.fix, f"a problem says what to do: {problem}"
        return error.problems[0].what
    return ""


def test_no_spoilt_declaration_raises_anything_but_our_own_error(mutants: Iterable[int]) -> None:
    refused = 0
    for seed in mutants:
        try:
            refused += bool(answers(seed))
        except Exception as error:
            pytest.fail(f"mutant {seed} raised {type(error).__name__}: {error}")
    assert refused, "a fuzzer that spoils nothing finds nothing"


def test_a_mutant_written_as_text_is_read_as_its_data_are(mutants: Iterable[int]) -> None:
    for seed in list(mutants)[:100]:
        data = mutant(seed)
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
