"""Kernels: functions of numbers and arrays in plain Python that can be compiled, once and for all processes to come.

A kernel is written with `@kernel` and called like any function; it then runs as Python. `compiled` is the same function
as machine code by numba, an optional library (the extra `fast`), which keeps it on disk: beside the package, or where
that cannot be written in the user's cache or `NUMBA_CACHE_DIR`. numba is imported when a kernel is first compiled or
loaded, never before.

A kernel may call other kernels by their names, and functions of `math`; what it calls is part of what the file on disk
is known by, so that a change anywhere in it is compiled anew. Rounding is that of Python: no sums are reordered and no
products fused. A division by zero gives an infinity, as in numpy, where Python's floats would raise. Arguments should
keep their types, C-contiguous and writable arrays, for each new type is compiled anew.

Compilation takes seconds: `telling` calls a function when it begins, and Ctrl-C ends it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import cached_property, update_wrapper
from hashlib import sha256
from importlib import import_module
from importlib.util import find_spec
from threading import current_thread, main_thread
from types import CodeType, FunctionType, ModuleType
from typing import Any, Generic, ParamSpec, TypeVar, cast

from geartrain.errors import MissingExtraError

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


P = ParamSpec("P")
R = TypeVar("R")

_PAYS = 5.0  # s of work: less is done before numba is imported and kernels are loaded, which takes some half a second
_PLAIN = (bool, int, float, str, bytes, tuple, type(None))  # values of globals that are compiled into a kernel


class Kernel(Generic[P, R]):
    """A function in plain Python, and the same compiled; made by `kernel`."""

    def __init__(self, function: Callable[P, R]) -> None:
        update_wrapper(self, function)
        self._function = cast(FunctionType, function)

    def __call__(self, *arguments: P.args, **named: P.kwargs) -> R:
        """The function as Python runs it."""
        return cast(R, self._function(*arguments, **named))

    @cached_property
    def compiled(self) -> Callable[P, R]:
        """The function compiled, or loaded from disk when it is first called. Raises `MissingExtraError`."""
        return self._made()

    @cached_property
    def _called(self) -> Callable[P, R]:
        """The function compiled for other kernels alone, which takes less time."""
        return self._made(no_cpython_wrapper=True)

    def _made(self, **options: bool) -> Callable[P, R]:
        numba = _numba()
        # a twin whose names of kernels stand for compiled ones; its own name holds all that it is compiled from
        twin = self._twin({name: each._called for name, each in self._named.items() if isinstance(each, Kernel)})
        twin.__qualname__ = f"{self._function.__qualname__}_{self.digest}{'_'.join(['', *options])}"
        made = numba.njit(twin, error_model="numpy", nogil=True, no_cfunc_wrapper=True, **options)
        with suppress(RuntimeError):  # where neither the package's folder nor a cache of the user's can be written
            made.enable_caching()
        made.compile = compilation()(made.compile)  # what numba calls to compile or load it for some types
        return cast("Callable[P, R]", made)

    def chosen(self, fast: bool) -> Callable[P, R]:
        """The function compiled if it is to be fast, or as Python runs it."""
        return self.compiled if fast else self

    def replaced(self, **kernels: Kernel[..., Any]) -> Kernel[P, R]:
        """The same function with other kernels for some of those that it calls, by name; not through others."""
        return Kernel(cast("Callable[P, R]", self._twin(kernels)))

    def _twin(self, names: Mapping[str, object]) -> FunctionType:
        """The function with other things for some of the names of its module."""
        own = self._function
        twin = FunctionType(own.__code__, {**own.__globals__, **names}, own.__name__, own.__defaults__)
        twin.__annotations__ = own.__annotations__
        return twin

    @property
    def _named(self) -> dict[str, Any]:
        """What the names of the function stand for in its module."""
        known = self._function.__globals__
        return {name: known[name] for name in _names(self._function.__code__) if name in known}

    @cached_property
    def digest(self) -> str:
        """Of all that the function is compiled from: its code, constants of its module, kernels it calls.

        Also of the named tuples that its module knows: what is kept on disk holds them as types, and cannot be read
        where one has gone.
        """
        function = self._function
        found = sha256(f"{function.__module__} {function.__annotations__} {_text(function.__code__)}".encode())
        for each in function.__globals__.values():
            if isinstance(each, type) and issubclass(each, tuple) and each is not tuple:
                found.update(f"{each.__module__} {each.__qualname__} {each.__annotations__}".encode())
        for name, each in sorted(self._named.items()):
            if isinstance(each, Kernel):
                found.update(f"{name} {each.digest}".encode())
            elif isinstance(each, _PLAIN):
                found.update(f"{name} {each!r}".encode())
        return found.hexdigest()[:16]


def kernel(function: Callable[P, R]) -> Kernel[P, R]:
    """A function of numbers and arrays as one that can be compiled: a decorator."""
    return Kernel(function)


def is_fast(fast: bool | None, seconds: float) -> bool:
    """Whether kernels are compiled for work that takes Python and numpy some seconds.

    fast   as the user asks; None compiles if numba is there and the work large enough to pay for loading it

    Raises `MissingExtraError` where numba is asked for and is not installed.
    """
    if fast is None:
        return seconds >= _PAYS and find_spec("numba") is not None and usable()
    if fast:
        _numba()
    return fast


def usable() -> bool:
    """Whether numba is installed and can be imported."""
    try:
        _numba()
    except MissingExtraError:
        return False
    return True


def _numba() -> ModuleType:
    try:
        return import_module("numba")
    except ImportError as error:  # or one that does not know this Python or numpy yet
        raise MissingExtraError("numba", "fast", "compiling kernels") from error


def _names(code: CodeType) -> set[str]:
    inner = (each for each in code.co_consts if isinstance(each, CodeType))
    return set(code.co_names).union(*map(_names, inner))


def _text(code: CodeType) -> str:
    constants = [_text(each) if isinstance(each, CodeType) else repr(each) for each in code.co_consts]
    return f"{code.co_code.hex()} {code.co_names} {code.co_varnames} {constants}"
