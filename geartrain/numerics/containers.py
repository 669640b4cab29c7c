"""Immutable mappings, mappings that are created on access, and a context that suspends the garbage collector."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields
from typing import Any, NoReturn, TypeVar

K = TypeVar("K")
V = TypeVar("V")


class FrozenDict(dict[K, V]):
    """Immutable dictionary that compares, prints, copies and pickles like a dictionary.

    >>> FrozenDict(a=1) | {"b": 2}
    {'a': 1, 'b': 2}
    """

    __slots__ = ()

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        """Raise `TypeError` for any attempt to modify the mapping."""
        raise TypeError("this mapping is immutable: copy it with dict(...) and change the copy")

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return FrozenDict, (dict(self),)


class LazyMapping(Mapping[K, V]):
    """Mapping that is created on first access; it compares and pickles like the dictionary that it contains.

    >>> requested = []
    >>> found = LazyMapping(lambda: requested.append("made") or {"a": 1})
    >>> requested
    []
    >>> found["a"], found == {"a": 1}, requested
    (1, True, ['made'])
    """

    __slots__ = ("_found", "_make")

    def __init__(self, make: Callable[[], Mapping[K, V]]) -> None:
        self._make: Callable[[], Mapping[K, V]] | None = make
        self._found: FrozenDict[K, V] = FrozenDict()

    def _made(self) -> FrozenDict[K, V]:
        make = self._make
        if make is not None:
            self._found = FrozenDict(make())
            self._make = None  # set after the result is stored, for other threads; releases the memory of the function
        return self._found

    def __getitem__(self, key: K) -> V:
        return self._made()[key]

    def __iter__(self) -> Iterator[K]:
        return iter(self._made())

    def __len__(self) -> int:
        return len(self._made())

    def __repr__(self) -> str:
        return repr(self._made())

    def __reduce__(self) -> tuple[Any, ...]:
        return FrozenDict, (dict(self._made()),)


class ItemwiseMapping(Mapping[K, V]):
    """Mapping with given keys, whose values are created one by one on first access.

    If `keep` is False, each value is created anew at every access, which saves memory for long numbers.

    >>> requested = []
    >>> found = ItemwiseMapping("ab", lambda key: requested.append(key) or key.upper())
    >>> "b" in found, len(found), found["a"], found["a"], requested
    (True, 2, 'A', 'A', ['a'])
    """

    __slots__ = ("_found", "_keep", "_keys", "_make")

    def __init__(self, keys: Iterable[K], make: Callable[[K], V], keep: bool = True) -> None:
        self._keys, self._make, self._keep = dict.fromkeys(keys), make, keep
        self._found: dict[K, V] = {}

    def __getitem__(self, key: K) -> V:
        if key in self._found:
            return self._found[key]
        if key not in self._keys:
            raise KeyError(key)
        value = self._make(key)
        if self._keep:
            self._found[key] = value
        return value

    def __contains__(self, key: object) -> bool:
        return key in self._keys

    def __iter__(self) -> Iterator[K]:
        return iter(self._keys)

    def __len__(self) -> int:
        return len(self._keys)

    def __reduce__(self) -> tuple[type[dict[K, V]], tuple[dict[K, V]]]:
        """Return the mapping as a plain dictionary for pickling, because local functions cannot be pickled."""
        return dict, (dict(self),)


class FrozenFields:
    """Base class of frozen dataclasses, which replaces dictionaries in their fields by immutable dictionaries."""

    __slots__ = ()

    def __post_init__(self) -> None:
        for field in fields(self):  # type: ignore[arg-type]
            value = getattr(self, field.name)
            # other mappings, such as lazy ones, are immutable already
            if type(value) is dict:
                object.__setattr__(self, field.name, FrozenDict(value))


@contextmanager
def collector_paused() -> Iterator[None]:
    """Suppress garbage collection in this context, to save time while many long-lived objects are created."""
    running = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if running:
            gc.enable()
