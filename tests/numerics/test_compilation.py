"""What is told of the time in which kernels are compiled, and that Ctrl-C ends it wherever it comes."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator
from ctypes import CFUNCTYPE
from pathlib import Path

import numba
import pytest

from geartrain.numerics.kernels import Kernel, compilation, kernel, telling


def _line(x: float) -> float:
    return 2.0 * x + 1.0


@pytest.fixture
def new(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[], Kernel[[float], float]]]:
    """One kernel, as processes come to it one after the other, which have never compiled it at first."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    return lambda: kernel(_line)


interrupted = CFUNCTYPE(None)(lambda: signal.raise_signal(signal.SIGINT))
"""What a compiler calls back while Ctrl-C is pressed: Python drops the interrupt and complains."""


def test_compiling_is_told_once_and_not_where_a_kernel_is_loaded(new: Callable[[], Kernel[[float], float]]) -> None:
    said: list[str] = []
    with telling(lambda: said.append("first")):
        assert new().compiled(1.0) == 3.0
    assert said == ["first"]
    with telling(lambda: said.append("loaded")):
        assert new().compiled(2.0) == 5.0
    assert said == ["first"]


def test_nobody_is_told_who_did_not_stay(new: Callable[[], Kernel[[float], float]]) -> None:
    said: list[str] = []
    with telling(lambda: said.append("gone")):
        pass
    assert new().compiled(1.0) == 3.0
    assert said == []


def test_an_interrupt_that_python_drops_ends_compiling_without_a_word(
    new: Callable[[], Kernel[[float], float]], capfd: pytest.CaptureFixture[str]
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
