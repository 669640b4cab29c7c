"""Kernels: numerical functions in plain Python that numba (extra `fast`) can compile and cache on disk.

A function decorated with `@kernel` runs as Python, and its attribute `compiled` as machine code. A kernel may call
other kernels by name, whose code is part of the cache key, and functions of `math`. Rounding is as in Python, but a
division by zero returns an infinity. Every new type of argument requires a compilation of several seconds.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import cached_property, update_wrapper
from hashlib import sha256
from importlib import import_module
from threading import current_thread, main_thread
from types import CodeType, FunctionType, ModuleType
from typing import Any, Generic, ParamSpec, TypeVar, cast

from geartrain.errors import MissingExtraError

_listeners: list[Callable[[], None]] = []  # functions called once when a kernel is compiled


@contextmanager
def telling(say: Callable[[], None]) -> Iterator[None]:
    """Call the function `say` when numba first compiles a kernel in this context, which takes seconds."""
    _listeners.append(say)
    try:
        yield
    finally:
        if say in _listeners:
            _listeners.remove(say)


@contextmanager
def compilation() -> Iterator[None]:
    """Return a context in which Ctrl+C interrupts numba's compilation of kernels.

    Python drops an interrupt while a compiler calls back into it; here it is recorded, and raised after compilation.
    """
    with ExitStack() as opened:
        if _listeners:
            event = import_module("numba.core.event")
            event.Listener.register(_Listener)
            opened.enter_context(event.install_listener("numba:compile", _Listener()))
        opened.enter_context(_interruptible())
        yield


class _Listener:
    """Listener that reports the first compilation of a kernel by numba to the functions in `_listeners`."""

    def notify(self, event: Any) -> None:
        while _listeners:
            _listeners.pop(0)()


@contextmanager
def _interruptible() -> Iterator[None]:
    """Raise `KeyboardInterrupt` at the end of the context if Python ignored an interrupt within it."""
    if current_thread() is not main_thread():  # interrupts are delivered to the main thread only
        yield
        return
    before, dropped = sys.unraisablehook, False

    def note(ignored: sys.UnraisableHookArgs) -> None:
        nonlocal dropped
        if issubclass(ignored.exc_type, KeyboardInterrupt):
            dropped = True
        else:
            before(ignored)

    sys.unraisablehook = note
    try:
        yield
    finally:
        sys.unraisablehook = before
    if dropped:
        raise KeyboardInterrupt


P = ParamSpec("P")
R = TypeVar("R")

_PAYS = 5.0  # s of work above which kernels pay off: importing numba and loading kernels takes about 0.5 s
_PLAIN = (bool, int, float, str, bytes, tuple, type(None))  # types of global constants that are compiled into a kernel


class Kernel(Generic[P, R]):
    """Function in plain Python together with its compiled form, created by the decorator `kernel`."""

    def __init__(self, function: Callable[P, R]) -> None:
        update_wrapper(self, function)
        self._function = cast(FunctionType, function)

    def __call__(self, *arguments: P.args, **named: P.kwargs) -> R:
        """Call the original Python function, which is not compiled."""
        return cast(R, self._function(*arguments, **named))

    @cached_property
    def compiled(self) -> Callable[P, R]:
        """Compiled function, loaded from disk if possible. Raises `MissingExtraError` if numba is not installed."""
        return self._made()

    @cached_property
    def _called(self) -> Callable[P, R]:
        """Compiled function for calls from other kernels only. Without a wrapper for Python, it is compiled faster."""
        return self._made(no_cpython_wrapper=True)

    def _made(self, **options: bool) -> Callable[P, R]:
        numba, own = _numba(), self._function
        # a copy that calls compiled kernels; the hash in its name makes numba's cache key depend on all of its sources
        called = {name: each._called for name, each in self._named.items() if isinstance(each, Kernel)}
        twin = FunctionType(own.__code__, {**own.__globals__, **called}, own.__name__, own.__defaults__)
        twin.__annotations__ = own.__annotations__
        twin.__qualname__ = f"{own.__qualname__}_{self.digest}{'_'.join(['', *options])}"
        made = numba.njit(twin, error_model="numpy", nogil=True, no_cfunc_wrapper=True, **options)
        with suppress(RuntimeError):  # neither the package's folder nor the user's cache is writable
            made.enable_caching()
        made.compile = compilation()(made.compile)  # called by numba to compile or load the kernel for some types
        return cast("Callable[P, R]", made)

    def chosen(self, fast: bool) -> Callable[P, R]:
        """Return the compiled function if `fast` is True, else the function in plain Python."""
        return self.compiled if fast else self

    @property
    def _named(self) -> dict[str, Any]:
        """Objects that the function uses as global variables, keyed by name."""
        known = self._function.__globals__
        return {name: known[name] for name in _names(self._function.__code__) if name in known}

    @cached_property
    def digest(self) -> str:
        """Hash of the function's code, and of the constants, named tuples and kernels of its module that it uses."""
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
    """Mark a function of numbers and arrays as compilable (decorator)."""
    return Kernel(function)


def is_fast(fast: bool | None, seconds: float) -> bool:
    """Return True if kernels are to be compiled for work that takes `seconds` in Python and numpy.

    fast   choice of the user; None to compile if numba is installed and the work is long enough to justify loading
           numba

    Raises `MissingExtraError` if `fast` is true and numba is not installed.
    """
    wanted = seconds >= _PAYS if fast is None else fast
    if wanted:
        try:
            _numba()
        except MissingExtraError:
            if fast:
                raise
            return False
    return wanted


def _numba() -> ModuleType:
    try:
        return import_module("numba")
    except ImportError as error:  # also raised by a version that does not support this Python or numpy
        raise MissingExtraError("numba", "fast", "compiling kernels") from error


def _names(code: CodeType) -> set[str]:
    inner = (each for each in code.co_consts if isinstance(each, CodeType))
    return set(code.co_names).union(*map(_names, inner))


def _text(code: CodeType) -> str:
    constants = [_text(each) if isinstance(each, CodeType) else repr(each) for each in code.co_consts]
    return f"{code.co_code.hex()} {code.co_names} {code.co_varnames} {constants}"
