"""Base classes of results: plain data for JSON, tables and figures.

`Result` writes each key once, as a field's name or in the `KEYS` of a class. Exact numbers become text with every
digit, arrays and tuples lists, results objects; None stays None. `Tabular` results have columns: a pandas DataFrame,
a numpy record array, a table of HTML. `Pictured` results name the function that draws them, which is imported when it
is called."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from fractions import Fraction
from functools import cache
from html import escape
from importlib import import_module
from inspect import get_annotations
from itertools import islice, pairwise
from math import isfinite
from operator import attrgetter
from typing import Any, ClassVar

from geartrain.errors import MissingExtraError
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.long_float import LongFloat

_SHOWN = 20


class Tabular:
    """What has rows of one kind.

    Notebooks show its first rows.
    """

    __slots__ = ()

    @property
    @abstractmethod
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of one length by name: numbers as floats, exact ones as text beside them, None where nothing is."""

    def to_frame(self) -> Any:
        """The table as a pandas DataFrame; `attrs["meanings"]` explains the columns that are fields, with units.

        Raises
        ------
        MissingExtraError
            Without pandas, which the extra `tables` brings.
        """
        try:
            import pandas
        except ImportError:
            raise MissingExtraError("pandas", "tables", "a table of its kind") from None
        frame = pandas.DataFrame(dict(self.columns))
        frame.attrs["meanings"] = _meanings(type(self), frame.columns)
        return frame

    def to_records(self) -> Any:
        """The table as a numpy record array, `records["link"]` a column; numbers that are not there are NaN."""
        import numpy as np

        columns = {name: np.array(_without_gaps(values)) for name, values in self.columns.items()}
        kinds = [(name, column.dtype) for name, column in columns.items()]
        return np.rec.fromarrays(list(columns.values()), dtype=kinds)

    def _repr_html_(self) -> str:
        columns = self.columns
        titles = {name: f' title="{escape(text)}"' for name, text in _meanings(type(self), columns).items()}
        head = "".join(f"<th{titles.get(name, '')}>{escape(name)}</th>" for name in columns)
        rows = ("".join(f"<td>{_cell(value)}</td>" for value in row) for row in zip(*columns.values(), strict=True))
        body = "".join(f"<tr>{row}</tr>" for row in islice(rows, _SHOWN))
        more = len(next(iter(columns.values()), ())) - _SHOWN
        return f"<table><tr>{head}</tr>{body}</table>" + (f"<p>{more:,} more</p>" if more > 0 else "")


def _meanings(kind: type, columns: Iterable[str]) -> dict[str, str]:
    """Of the columns that are fields of a result, their docstrings."""
    docs = field_docs(kind)
    return {name: docs[name] for name in columns if name in docs}


def _without_gaps(values: Sequence[Any]) -> Sequence[Any]:
    """NaN for None among numbers, nothing for None among texts."""
    if not any(value is None for value in values):
        return values
    texts = any(isinstance(value, str) for value in values)
    return [("" if texts else float("nan")) if value is None else value for value in values]


def _cell(value: object) -> str:
    if value is None:
        return ""
    return escape(value) if isinstance(value, str) else f"{value:.10g}" if isinstance(value, float) else str(value)


def picture_maker(room: str, name: str) -> Callable[..., Any]:
    """A function that draws or describes, by its name, for a method that hands itself to it.

    Rooms that draw stand above those that calculate. A result reaches up to them here alone, by name, and when it is
    asked to show itself: nothing that draws is imported before.

    room   where it is, by the name below `geartrain`
    name   of the function or class, public there
    """
    found: Callable[..., Any] = getattr(import_module(f"geartrain.{room}"), name)
    return found


class Pictured:
    """A result with a picture of its own: the function `FIGURE` of the package `DRAWN_IN` makes it."""

    __slots__ = ()

    FIGURE: ClassVar[str]
    DRAWN_IN: ClassVar[str] = "drawing"

    def plot(self, *how: Any) -> Any:
        """The result as a figure of matplotlib, which notebooks show.

        Parameters
        ----------
        *how
            What the function that draws such results takes after the result itself.

        Returns
        -------
        matplotlib.figure.Figure
            For `geartrain.drawing.render`, or to be drawn on.

        Raises
        ------
        MissingExtraError
            Without matplotlib, which the extra `plot` brings.
        """
        return picture_maker(self.DRAWN_IN, self.FIGURE)(self, *how)


@dataclass(frozen=True, slots=True)
class Key:
    """A key of a result's plain data that is more than the attribute of that name."""

    name: str
    """In the data; "" puts the keys of a part in among those of the whole."""
    of: str = ""
    """The attribute, `part.attribute` for one of a part, "." the object itself; by default that called `name`."""
    to: Callable[[Any], Any] | None = None
    """What is made of each number or object in it, at any depth; the kind of that is in its return annotation."""
    keys: tuple[str | Key, ...] = ()
    """The keys of each object in it, where they are not those of its class."""

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


# -------------------------------------------------------------------------------------------------- meanings of fields


@cache
def field_docs(kind: type) -> Mapping[str, str]:
    """The docstrings below the fields of a class and of its bases, by field, on one line each.

    Python discards these docstrings, so they are read from the source; a unit stands in brackets: `Angle [rad].`
    """
    found: dict[str, str] = {}
    for base in reversed(kind.__mro__):
        if get_annotations(base):
            found |= _docs_of_classes(base.__module__).get(base.__qualname__, {})
    return found


@cache
def _docs_of_classes(module: str) -> Mapping[str, Mapping[str, str]]:
    """By qualified name of a class in a module, the docstrings of its fields."""
    import ast
    import inspect
    import sys

    found: dict[str, Mapping[str, str]] = {}
    todo: list[tuple[str, ast.AST]] = [("", ast.parse(inspect.getsource(sys.modules[module])))]
    while todo:
        prefix, node = todo.pop()
        for part in ast.iter_child_nodes(node):
            if isinstance(part, ast.ClassDef):
                found[prefix + part.name] = dict(_docs_in(part.body))
                todo.append((f"{prefix}{part.name}.", part))
    return found


def _docs_in(body: Sequence[Any]) -> Iterator[tuple[str, str]]:
    import ast

    for field, doc in pairwise(body):
        match field, doc:
            case ast.AnnAssign(target=ast.Name(name)), ast.Expr(value=ast.Constant(str(text))):
                yield name, " ".join(text.split())
