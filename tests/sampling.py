"""Which cases of a long list run every time."""

from __future__ import annotations

from collections.abc import Container, Iterable
from typing import Any

import pytest

_FEW = 300


def first_few(number: int, cases: Iterable[Any]) -> list[Any]:
    """Parameters of a test: the first `number` of the cases; the others only run with `--slow`."""
    return [pytest.param(case, marks=[pytest.mark.slow] if at >= number else []) for at, case in enumerate(cases)]


def all_but(dear: Container[Any], cases: Iterable[Any]) -> list[Any]:
    """Parameters of a test: the cases; the dear ones, which take seconds each, only run with `--slow`."""
    return [pytest.param(case, marks=[pytest.mark.slow] if case in dear else []) for case in cases]


def seeds_of(config: pytest.Config, first: str, number: str) -> range:
    """Seeds of random samples from an option on, as many as another option says: 300, or 1000 with `--slow`.

    With `--slow --rest` only those after the first 300, which ran before.
    """
    start, slow = config.getoption(first), config.getoption("--slow")
    stop = start + (config.getoption(number) or (1000 if slow else _FEW))
    ran = _FEW if slow and config.getoption("--rest") else 0
    return range(min(start + ran, stop), stop)
