"""Kernels: plain Python that numba compiles, where it is installed and there is work enough; Ctrl-C meanwhile."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from ctypes import CFUNCTYPE
from math import sin
from pathlib import Path
from typing import Any, NamedTuple

import numba
import pytest

from geartrain.errors import MissingExtraError
from geartrain.numerics.kernels import compilation, is_fast, kernel, telling

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
from geartrain.numerics.kernels import Kernel, compilation, is_fast, kernel, telling
assert kernel(abs)(-2) == 2 and not is_fast(None, 0.1)
print([name for name in sys.modules if name.partition(".")[0] in ("numba", "llvmlite", "numpy")])
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def _line(x: float) -> float:
    return 2.0 * x + 1.0


@pytest.fixture
def new(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[], Any[[float], float]]]:
    """One kernel, as processes come to it one after the other, which have never compiled it at first."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    return lambda: kernel(_line)


interrupted = CFUNCTYPE(None)(lambda: signal.raise_signal(signal.SIGINT))
"""What a compiler calls back while Ctrl-C is pressed: Python drops the interrupt and complains."""


def test_compiling_is_told_once_and_not_where_a_kernel_is_loaded(new: Callable[[], Any[[float], float]]) -> None:
    said: list[str] = []
    with telling(lambda: said.append("first")):
        assert new().compiled(1.0) == 3.0
    assert said == ["first"]
    with telling(lambda: said.append("loaded")):
        assert new().compiled(2.0) == 5.0
    assert said == ["first"]


def test_nobody_is_told_who_did_not_stay(new: Callable[[], Any[[float], float]]) -> None:
    said: list[str] = []
    with telling(lambda: said.append("gone")):
        pass
    assert new().compiled(1.0) == 3.0
    assert said == []


def test_an_interrupt_that_python_drops_ends_compiling_without_a_word(
    new: Callable[[], Any[[float], float]], capfd: pytest.CaptureFixture[str]
) -> None:
    hook = sys.unraisablehook
    with telling(interrupted), pytest.raises(KeyboardInterrupt):
        new().compiled(1.0)
    assert sys.unraisablehook is hook
    assert capfd.readouterr() == ("", "")
    assert new().compiled(1.0) == 3.0


def test_an_interrupt_is_raised_after_what_it_came_in() -> None:
    done: list[str] = []

    @compilation()
    def make() -> None:
        interrupted()
        done.append("the rest")

    with pytest.raises(KeyboardInterrupt):
        make()
    assert done == ["the rest"]


def test_what_else_python_cannot_raise_is_complained_of_as_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[type[BaseException]] = []
    monkeypatch.setattr(sys, "unraisablehook", lambda of: told.append(of.exc_type))
    with compilation():
        CFUNCTYPE(None)(lambda: int("none"))()
    assert told == [ValueError]
