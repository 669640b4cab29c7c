"""Extreme trains against references of 50 digits, which are those of the tests (tests/extremes.py)."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from studies.records import StudyRecords

TESTS = Path(__file__).resolve().parents[3] / "tests"


@dataclass(frozen=True, slots=True)
class ExtremeRecord:
    """One extreme train: error against 50 digits in a unit, the bound that its test checks, time of the floats (s)."""

    name: str
    extreme: str
    unit: str
    error: float
    bound: float
    seconds: float


@dataclass(frozen=True)
class ExtremeRecords(StudyRecords):
    """All extreme trains."""

    cases: Sequence[ExtremeRecord]


def extremes() -> ExtremeRecords:
    """Measure all of them."""
    sys.path.insert(0, str(TESTS))
    rows = []
    for case in import_module("extremes").CASES:
        print(f"{case.name}: {case.extreme}", file=sys.stderr, flush=True)
        error, seconds = case.measure()
        rows.append(ExtremeRecord(case.name, case.extreme, case.of, error, case.bound, seconds))
    return ExtremeRecords("Extreme trains against 50 digits", rows)
