"""Mappings that cannot be changed, and a pause of the garbage collector while many small objects are made at once.

None of those can be garbage yet.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import fields
from typing import Any, NoReturn, TypeVar

K = TypeVar("K")
V = TypeVar("V")


class FrozenDict(dict[K, V]):
    """A dictionary that refuses to be changed; it compares, prints, copies and pickles as a dictionary does.

    >>> FrozenDict(a=1) | {"b": 2}
    {'a': 1, 'b': 2}
    """

    __slots__ = ()

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        """Refuse what would change the mapping, with `TypeError`."""
        raise TypeError("this mapping is frozen: make a copy with dict(...), and change that")

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return FrozenDict, (dict(self),)


class FrozenFields:
    """A frozen dataclass whose plain dictionaries are frozen too."""

    __slots__ = ()

    def __post_init__(self) -> None:
        for field in fields(self):  # type: ignore[arg-type]
            value = getattr(self, field.name)
            if type(value) is dict:
                object.__setattr__(self, field.name, FrozenDict(value))


@contextmanager
def collector_paused() -> Iterator[None]:
    """Pause the garbage collector: its passes walk all objects made so far, and linear work turns quadratic."""
    running = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if running:
            gc.enable()
