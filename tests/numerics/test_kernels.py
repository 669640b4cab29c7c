"""Kernels: plain Python that numba compiles, where it is installed and there is work enough."""

from __future__ import annotations

import subprocess
import sys
from math import sin
from typing import NamedTuple

import pytest

from geartrain.errors import MissingExtraError
from geartrain.numerics.kernels import is_fast, kernel

SCALE = 3.0


@kernel
def wave(x: float) -> float:
    """A function that another calls."""
    return SCALE * sin(x)


@kernel
def series(n: int) -> float:
    """A sum over waves."""
    found = 0.0
    for at in range(n):
        found += wave(0.1 * at) / (at + 1)
    return found


@kernel
def quotient(a: float, b: float) -> float:
    """A division."""
    return a / b


def test_a_kernel_is_an_ordinary_function_of_python() -> None:
    assert (series.__name__, series.__doc__) == ("series", "A sum over waves.")
    assert series(3) == 0.0 + 3.0 * sin(0.1) / 2 + 3.0 * sin(0.1 * 2) / 3
    assert series.chosen(fast=False) is series


def test_a_compiled_kernel_gives_the_same_float_and_calls_kernels_compiled_too() -> None:
    assert series.chosen(fast=True)(1000) == series(1000)


def test_a_compiled_division_by_zero_is_infinite() -> None:
    assert quotient.compiled(1.0, 0.0) == float("inf")


@kernel
def flat(x: float) -> float:
    """Another function that one can call."""
    return 1.0


def test_what_is_kept_on_disk_is_known_by_all_that_it_is_compiled_from(monkeypatch: pytest.MonkeyPatch) -> None:
    known = wave._function.__globals__
    assert kernel(series._function).digest == series.digest
    before = wave.digest, series.digest
    monkeypatch.setitem(known, "SCALE", 4.0)
    assert kernel(wave._function).digest != before[0]
    monkeypatch.setitem(known, "wave", flat)
    assert kernel(series._function).digest != before[1]


class Pair(NamedTuple):
    """What a kernel may take."""

    first: float


class Triple(NamedTuple):
    """What it may take instead."""

    first: float
    second: float


def test_what_is_kept_on_disk_is_known_by_the_named_tuples_of_the_module_too(monkeypatch: pytest.MonkeyPatch) -> None:
    before = kernel(flat._function).digest
    monkeypatch.setitem(flat._function.__globals__, "Pair", Triple)
    assert kernel(flat._function).digest != before


def test_little_work_is_left_to_python_and_much_is_compiled_unless_one_says_otherwise() -> None:
    assert not is_fast(None, seconds=0.1)
    assert is_fast(None, seconds=100.0)
    assert is_fast(True, seconds=0.1)
    assert not is_fast(False, seconds=100.0)


def test_without_numba_the_package_works_and_names_the_extra_to_those_who_ask(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "numba", None)
    assert not is_fast(None, seconds=100.0)
    with pytest.raises(MissingExtraError, match=r"pip install 'numba>=0\.61'"):
        is_fast(True, seconds=100.0)


def test_kernels_are_written_and_called_without_numba() -> None:
    program = """
import sys
from geartrain.numerics.kernels import is_fast, kernel
assert kernel(abs)(-2) == 2 and not is_fast(None, 0.1)
print([name for name in sys.modules if name.partition(".")[0] in ("numba", "llvmlite", "numpy")])
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
