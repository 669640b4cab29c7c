"""Which cases of a long list run every time."""

from __future__ import annotations

from collections.abc import Container, Iterable
from typing import Any

import pytest
from hypothesis import settings


def first_few(number: int, cases: Iterable[Any]) -> list[Any]:
    """Parameters of a test: the first `number` of the cases; the others only run with `--slow`."""
    return [pytest.param(case, marks=[pytest.mark.slow] if at >= number else []) for at, case in enumerate(cases)]


def all_but(dear: Container[Any], cases: Iterable[Any]) -> list[Any]:
    """Parameters of a test: the cases; the dear ones, which take seconds each, only run with `--slow`."""
    return [pytest.param(case, marks=[pytest.mark.slow] if case in dear else []) for case in cases]


def few_or_many(few: int, many: int) -> int:
    """A number of random samples: the greater one with `--slow` (conftest.py)."""
    return many if settings().max_examples >= 60 else few
