"""Selection of the cases of a long list that run every time."""

from __future__ import annotations

from collections.abc import Container, Iterable
from typing import Any

import pytest
from hypothesis import settings


def first_few(number: int, cases: Iterable[Any]) -> list[Any]:
    """Return test parameters: the first `number` cases; the other cases run only with `--slow`."""
    return [pytest.param(case, marks=[pytest.mark.slow] if at >= number else []) for at, case in enumerate(cases)]


def all_but(dear: Container[Any], cases: Iterable[Any]) -> list[Any]:
    """Return test parameters: all cases; those that take seconds each run only with `--slow`."""
    return [pytest.param(case, marks=[pytest.mark.slow] if case in dear else []) for case in cases]


def few_or_many(few: int, many: int) -> int:
    """Return a number of random samples: the larger number with `--slow` (conftest.py)."""
    return many if settings().max_examples >= 60 else few
