"""Results as plain data, which JSON can hold: each key is written once, as a field's name or in the `KEYS` of a class.

Exact numbers become text with every digit, arrays and tuples lists, results objects; what is None stays None.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from fractions import Fraction
from functools import cache
from math import isfinite
from operator import attrgetter
from typing import Any, ClassVar

from geartrain.numerics.decimal_text import fraction_text
from geartrain.numerics.long_float import LongFloat


@dataclass(frozen=True, slots=True)
class Key:
    """A key of a result's plain data that is more than the attribute of that name.

    name   in the data; "" puts the keys of a part in among those of the whole
    of     the attribute, `part.attribute` for one of a part, "." the object itself; by default that called `name`
    to     what is made of each number or object in it, at any depth; the kind of that is in its return annotation
    keys   the keys of each object in it, where they are not those of its class
    """

    name: str
    of: str = ""
    to: Callable[[Any], Any] | None = None
    keys: tuple[str | Key, ...] = ()

    @property
    def path(self) -> str:
        """The attribute that is told; "" for the result itself."""
        return "" if self.of == _ITSELF else self.of or self.name


_ITSELF = "."


def group(name: str, *keys: str | Key) -> Key:
    """Keys of a result that stand in an object of their own."""
    return Key(name, _ITSELF, keys=keys)


class Result:
    """An answer that can tell itself as plain data: what `KEYS` names, or all its fields."""

    __slots__ = ()
    KEYS: ClassVar[tuple[str | Key, ...]] = ()

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; the keys are stable (docs/json.md)."""
        return _told(self)


def plain(value: Any, to: Callable[[Any], Any] | None = None, keys: tuple[str | Key, ...] = ()) -> Any:
    """What JSON can hold of a value; `to` and `keys`, as in `Key`, are for whatever in it is no mapping, list or None.

    >>> plain({"ratio": Fraction(254, 19), "teeth": (20, 30)})
    {'ratio': '254/19', 'teeth': [20, 30]}
    """
    if value is None:
        return None
    if hasattr(value, "_asdict"):  # a named tuple
        return _told(value, keys) if keys else plain(value._asdict(), to)
    if isinstance(value, Mapping):
        return {str(key): plain(each, to, keys) for key, each in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [plain(each, to, keys) for each in value]
    if hasattr(value, "tolist"):  # an array, or one of its numbers
        return plain(value.tolist(), to)
    if to is not None:
        return to(value)
    if keys:
        return _told(value, keys)
    if isinstance(value, str | bool | int | float):
        return value
    if isinstance(value, Fraction):
        return fraction_text(value)
    if isinstance(value, LongFloat):
        return None  # float64 has no such number
    if hasattr(value, "model_dump"):  # a part of a declaration
        return value.model_dump(mode="json")
    return value.to_dict() if hasattr(value, "to_dict") else _told(value)


def finite(value: float) -> float | None:
    """None for what is infinite or undetermined: JSON has neither."""
    return value if isfinite(value) else None


def _told(result: Any, keys: tuple[str | Key, ...] = ()) -> dict[str, Any]:
    kind: Any = type(result)
    found: dict[str, Any] = {}
    for key in whole(keys) if keys else keys_of(kind):
        value = plain(attrgetter(key.path)(result) if key.path else result, key.to, key.keys)
        if key.name:
            found[key.name] = value
        else:
            found |= value or {}
    return found


@cache
def keys_of(kind: Any) -> tuple[Key, ...]:
    """The keys of a class's plain data, in order. Raises `TypeError` for a class that has none."""
    named: tuple[str | Key, ...] = getattr(kind, "KEYS", ())
    if not named and is_dataclass(kind):
        named = tuple(field.name for field in fields(kind))
    if not named:
        raise TypeError(f"{kind.__name__} has no plain data: it is no dataclass, and has no KEYS")
    return whole(named)


def whole(keys: tuple[str | Key, ...]) -> tuple[Key, ...]:
    """Keys, where a name stands for the attribute of that name."""
    return tuple(each if isinstance(each, Key) else Key(each) for each in keys)
