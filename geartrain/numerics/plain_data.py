"""Results as plain data, which JSON can hold: each key is written once, as a field's name or in the `KEYS` of a class.

Exact numbers become text with every digit, arrays and tuples lists, results objects; what is None stays None.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from fractions import Fraction
from functools import cache
from operator import attrgetter
from typing import Any, ClassVar

from geartrain.numerics.exact import fraction_text
from geartrain.numerics.long_float import LongFloat


@dataclass(frozen=True, slots=True)
class Key:
    """A key of a result's plain data that is more than the attribute of that name.

    name   in the data; "" puts the keys of a part in among those of the whole
    of     the attribute, `part.attribute` for one of a part; by default that called `name`
    to     what is made of each number or object in it, at any depth; the kind of that is in its return annotation
    """

    name: str
    of: str = ""
    to: Callable[[Any], Any] | None = None

    @property
    def path(self) -> str:
        """The attribute that is told."""
        return self.of or self.name


class Result:
    """An answer that can tell itself as plain data: what `KEYS` names, or all its fields."""

    __slots__ = ()
    KEYS: ClassVar[tuple[str | Key, ...]] = ()

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; the keys are stable (docs/json.md)."""
        return _told(self)


def plain(value: Any, to: Callable[[Any], Any] | None = None) -> Any:
    """What JSON can hold of a value; `to` is applied to whatever in it is no mapping, list or None.

    >>> plain({"ratio": Fraction(254, 19), "teeth": (20, 30)})
    {'ratio': '254/19', 'teeth': [20, 30]}
    """
    if value is None:
        return None
    if hasattr(value, "_asdict"):  # a named tuple
        value = value._asdict()
    if isinstance(value, Mapping):
        return {key: plain(each, to) for key, each in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [plain(each, to) for each in value]
    if hasattr(value, "tolist"):  # an array, or one of its numbers
        return plain(value.tolist(), to)
    if to is not None:
        return to(value)
    if isinstance(value, str | bool | int | float):
        return value
    if isinstance(value, Fraction):
        return fraction_text(value)
    if isinstance(value, LongFloat):
        return None  # float64 has no such number
    if hasattr(value, "model_dump"):  # a part of a declaration
        return value.model_dump(mode="json")
    return value.to_dict() if hasattr(value, "to_dict") else _told(value)


def _told(result: Any) -> dict[str, Any]:
    kind: Any = type(result)
    found: dict[str, Any] = {}
    for key, read in _readers(kind):
        value = plain(read(result), key.to)
        if key.name:
            found[key.name] = value
        else:
            found |= value or {}
    return found


@cache
def _readers(kind: Any) -> tuple[tuple[Key, Callable[[Any], Any]], ...]:
    return tuple((key, attrgetter(key.path)) for key in keys_of(kind))


def keys_of(kind: type) -> tuple[Key, ...]:
    """The keys of a class's plain data, in order. Raises `TypeError` for a class that has none."""
    named: tuple[str | Key, ...] = getattr(kind, "KEYS", ())
    if not named and is_dataclass(kind):
        named = tuple(field.name for field in fields(kind))
    if not named:
        raise TypeError(f"{kind.__name__} has no plain data: it is no dataclass, and has no KEYS")
    return tuple(each if isinstance(each, Key) else Key(each) for each in named)
