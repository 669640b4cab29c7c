"""The time in which numba compiles a kernel or loads one from disk: who is told of it, and how Ctrl-C ends it."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import import_module
from threading import current_thread, main_thread
from typing import Any

_told: list[Callable[[], None]] = []  # called when a kernel is compiled; each once


@contextmanager
def telling(say: Callable[[], None]) -> Iterator[None]:
    """Call `say` before the first kernel that is compiled within, if any is: not for those loaded from disk."""
    _told.append(say)
    try:
        yield
    finally:
        if say in _told:
            _told.remove(say)


@contextmanager
def compilation() -> Iterator[None]:
    """Around all that numba does before a kernel runs.

    Ctrl-C ends it. Python drops an interrupt that comes while a compiler calls back into Python, or while an object is
    disposed of, and complains; here it is kept in silence, and raised as soon as the kernel is made.
    """
    with _hearing(), _interruptible():
        yield


@contextmanager
def _hearing() -> Iterator[None]:
    """Tell those who want to know when numba really compiles."""
    if not _told:
        yield
        return
    event = import_module("numba.core.event")
    event.Listener.register(_Listener)
    with event.install_listener("numba:compile", _Listener()):
        yield


class _Listener:
    """What numba notifies when it begins and ends to compile a function."""

    def notify(self, event: Any) -> None:
        """Pass the word on, once."""
        while _told:
            _told.pop(0)()


@contextmanager
def _interruptible() -> Iterator[None]:
    """Raise an interrupt within that Python could not raise where it came."""
    if current_thread() is not main_thread():  # interrupts come to the main thread alone
        yield
        return
    before, dropped = sys.unraisablehook, False

    def note(told: sys.UnraisableHookArgs) -> None:
        nonlocal dropped
        if issubclass(told.exc_type, KeyboardInterrupt):
            dropped = True
        else:
            before(told)

    sys.unraisablehook = note
    try:
        yield
    finally:
        sys.unraisablehook = before
    if dropped:
        raise KeyboardInterrupt
