"""Base classes of results: what the prompt and notebooks show, plain data for JSON, tables and figures.

`Shown` results have a `repr` of one line, print the text of the command that computes them, and are tables in a
notebook. `Result` writes each key once, as a field's name or in the `KEYS` of a class. Exact numbers become text with
every digit, arrays and tuples lists, results objects; None stays None. `Tabular` results have columns: a pandas
DataFrame, a numpy record array, a table of HTML. `Pictured` results name the function that draws them, which is
imported when it is called."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass
from fnmatch import fnmatchcase
from fractions import Fraction
from functools import cache
from html import escape
from importlib import import_module
from inspect import get_annotations
from itertools import islice, pairwise
from math import isfinite
from operator import attrgetter
from re import search
from sys import modules
from typing import Any, ClassVar

from geartrain.errors import MissingExtraError, printable
from geartrain.numerics.exact import abridged_text, fraction_text
from geartrain.numerics.long_float import LongFloat

_SHOWN = 20


class Shown:
    """A result that Python shows as its command does: `repr` is one line, `print` gives the text of the command.

    Notebooks show the tables of its HTML page. Nothing is computed for the line.
    """

    __slots__ = ()

    PAGE: ClassVar[str] = ""
    """The function that describes the result as a document, `package.module:function`; it returns None for a result
    that it cannot describe. "" where no command prints such a result."""
    TEXT: ClassVar[str] = ""
    """The function that returns the text of the command, where it is not that of the document."""

    def __init_subclass__(cls, **options: Any) -> None:
        """Keep the inherited `__repr__` of a class, in place of which `dataclass` would write its own."""
        super().__init_subclass__(**options)
        if "__repr__" not in vars(cls):
            cls.__repr__ = cls.__repr__  # type: ignore[method-assign]

    def _summary(self) -> str:
        """The main figures in one line, of what is already computed."""
        return fields_summary(self)

    def __repr__(self) -> str:
        return summary_line(type(self).__name__, self._summary())

    def __dir__(self) -> list[str]:
        """The members without the constants of the class, which are for the package."""
        return [name for name in super().__dir__() if not name.isupper()]

    def __str__(self) -> str:
        """The text that the command prints for the result; the line of `repr` where there is no command."""
        found = _described(self, self.TEXT or self.PAGE)
        if found is None:
            return repr(self)
        return found if isinstance(found, str) else _text_of(found)

    def _repr_html_(self) -> str:
        """The result on its HTML page; its text where jinja2, the extra `report`, is not installed."""
        page = _described(self, self.PAGE)
        if page is not None:
            try:
                html: str = picture_maker("report.html_page", "to_fragment")([page])
                return html
            except MissingExtraError:
                pass
        return f"<pre>{escape(str(self))}</pre>"


def _described(result: object, name: str) -> Any:
    """What the function `package.module:function` returns for a result; None without a name."""
    if not name:
        return None
    module, _, function = name.partition(":")
    return picture_maker(module, function)(result)


def _text_of(document: Any) -> str:
    text: str = picture_maker("report.text", "to_text")([document])
    return printable(text)


_LONGEST_LINE = 160
"""Characters of a summary."""
_LONGEST_VALUE = 40
"""Characters of one value in it."""


def summary_line(name: str, summary: str) -> str:
    """Return `<name summary>` on one line of at most about 180 characters.

    >>> summary_line("Answer", "worm: determined")
    '<Answer worm: determined>'
    """
    text = " ".join(printable(summary).split())
    if len(text) > _LONGEST_LINE:
        text = text[: _LONGEST_LINE - 4].rstrip(" ,;") + " ..."
    return f"<{name} {text}>" if text else f"<{name}>"


def fields_summary(result: Any) -> str:
    """Return the public fields of a dataclass or named tuple that hold a value, each as `name=value`.

    Numbers have 6 digits; of containers only the length is shown, of mappings that are not made yet nothing.
    """
    own = [each.name for each in fields(result)] if is_dataclass(result) else ()
    return values_summary(result, getattr(result, "_fields", own))


def values_summary(result: Any, names: Iterable[str]) -> str:
    """Return some attributes that hold a value, each as `name=value`."""
    found: list[str] = []
    length = 0
    for name in names:
        if name.startswith("_"):
            continue
        text = brief(getattr(result, name))
        if text is None:
            continue
        found.append(f"{name}={text}")
        length += len(found[-1]) + 2
        if length > _LONGEST_LINE:
            break
    return ", ".join(found)


def short_repr(result: Any) -> str:
    """Return the line of a named tuple, which has no base class to inherit it from."""
    return summary_line(type(result).__name__, fields_summary(result))


def brief(value: object) -> str | None:
    """Return a value in a few characters; None for what a summary leaves out.

    >>> brief(Fraction(2, 7)), brief(0.12345678), brief(["a", "b", "c", "d", "e"]), brief("two words")
    ('2/7', '0.123457', '5 items', "'two words'")
    """
    if value is None or callable(value) or hasattr(value, "_made"):  # a mapping that is made when it is read
        return None
    if isinstance(value, bool | int):
        return str(value)
    if isinstance(value, str):
        text = value if len(value) <= _LONGEST_VALUE else value[: _LONGEST_VALUE - 4] + " ..."
        return text if text.isidentifier() else repr(text)
    if isinstance(value, Fraction):
        text = abridged_text(value)
        return text if len(text) <= _LONGEST_VALUE else f"{float(value):.6g}"
    if isinstance(value, float):
        return f"{value:.6g}"
    if hasattr(value, "_brief"):
        return str(value._brief())
    shape = getattr(value, "shape", None)
    if shape is not None:
        return f"{value:.6g}" if shape == () and hasattr(value, "__float__") else f"array{shape}"
    if isinstance(value, Mapping | Sequence | set | frozenset):
        return _brief_items(value)
    return None


def _brief_items(values: Mapping[Any, Any] | Sequence[Any] | set[Any] | frozenset[Any]) -> str | None:
    try:
        if not len(values):
            return None
    except OverflowError:  # more items than an index can count
        return None
    if isinstance(values, tuple) and len(values) <= 4 and not hasattr(values, "_fields"):
        parts = [brief(each) for each in values]
        text = f"({', '.join(part or '-' for part in parts)})"
        kinds = str | int | float | Fraction
        if len(text) <= _LONGEST_VALUE and all(isinstance(each, kinds) or hasattr(each, "_brief") for each in values):
            return text
    return f"{len(values)} item{'s' if len(values) > 1 else ''}"


class Tabular(Shown):
    """A result with rows of one kind.

    Notebooks show its first rows, where it has no page of its own.
    """

    __slots__ = ()

    MEANINGS: ClassVar[Mapping[str, str]] = {}
    """Meaning of each column that is not a field, with its unit in brackets; `*` in a name stands for any text."""

    ROW: ClassVar[str] = ""
    """The class in the module of the result whose fields are columns."""
    ROWS: ClassVar[str] = ""
    """The function that returns the rows, each as a dictionary by column; "" for a class with columns of its own."""

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of one length by name: numbers as floats, exact ones as text beside them, None where nothing is."""
        rows = _described(self, self.ROWS) or ()
        return {name: [row[name] for row in rows] for name in (rows[0] if rows else ())}

    @property
    def meanings(self) -> Mapping[str, str]:
        """Meaning of each column, with its unit in brackets."""
        return {name: text for name in self.columns if (text := self._meaning(name))}

    def _meaning(self, column: str) -> str:
        """The meaning of one column; "" where none is known."""
        own: Any = type(self)
        row = getattr(modules[own.__module__], self.ROW or own.__name__)
        known = {**field_docs(own), **field_docs(row), **self.MEANINGS}
        exact = known.get(column) or _property_doc(getattr(row, column, None))
        return exact or next((text for name, text in known.items() if fnmatchcase(column, name)), "")

    def to_frame(self) -> Any:
        """Return the table as a pandas DataFrame.

        `attrs["meanings"]` has the meaning of each column, `attrs["units"]` the unit of each column that has one.

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
        meanings = self.meanings
        frame.attrs["meanings"] = dict(meanings)
        frame.attrs["units"] = {name: unit for name in meanings if (unit := _unit(meanings[name]))}
        return frame

    def to_records(self) -> Any:
        """The table as a numpy record array, `records["link"]` a column; numbers that are not there are NaN."""
        import numpy as np

        columns = {name: np.array(_without_gaps(values)) for name, values in self.columns.items()}
        kinds = [(name, column.dtype) for name, column in columns.items()]
        return np.rec.fromarrays(list(columns.values()), dtype=kinds)

    def __str__(self) -> str:
        """The text that the command prints for the result; without a command, its first rows as a table."""
        found = _described(self, self.TEXT or self.PAGE)
        if found is None:
            table = picture_maker("report.document", "table_document")(self.columns, _SHOWN)
            return f"{self!r}\n{_text_of(table)}"
        return found if isinstance(found, str) else _text_of(found)

    def _repr_html_(self) -> str:
        if self.PAGE:
            return super()._repr_html_()
        columns, meanings = self.columns, self.meanings
        titles = {name: f' title="{escape(text)}"' for name, text in meanings.items()}
        head = "".join(f"<th{titles.get(name, '')}>{escape(name)}</th>" for name in columns)
        rows = ("".join(f"<td>{_cell(value)}</td>" for value in row) for row in zip(*columns.values(), strict=True))
        body = "".join(f"<tr>{row}</tr>" for row in islice(rows, _SHOWN))
        more = len(next(iter(columns.values()), ())) - _SHOWN
        return f"<table><tr>{head}</tr>{body}</table>" + (f"<p>{more:,} more</p>" if more > 0 else "")


def _property_doc(member: object) -> str:
    """The first paragraph of a property's docstring; "" for what is not a property."""
    maker = member if isinstance(member, property) else getattr(member, "func", None)
    return " ".join((getattr(maker, "__doc__", None) or "").split("\n\n")[0].split())


def _unit(meaning: str) -> str:
    """The unit in the brackets of a meaning; "" without one."""
    found = search(r"\[([^\]]+)\]", meaning)
    return found[1] if found else ""


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


class Result(Shown):
    """A result that is plain data for JSON: what `KEYS` names, or all its fields."""

    __slots__ = ()
    KEYS: ClassVar[tuple[str | Key, ...]] = ()

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; the keys are stable (docs/json.md)."""
        return _told(self)


@dataclass(frozen=True, slots=True)
class TrainResult(Result):
    """A result of a train, which keeps the declaration of the train: its text and its tables need it."""

    _declaration: Any = field(default=None, kw_only=True, repr=False, compare=False)

    @property
    def _named(self) -> str:
        """The name of the train with the state, as far as they are known."""
        name = "" if self._declaration is None else self._declaration.name
        state = getattr(self, "state", None)
        return name if state is None else f"{name} state {state}".strip()


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
        named = tuple(each.name for each in fields(kind) if not each.name.startswith("_"))
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

    for statement, doc in pairwise(body):
        match statement, doc:
            case ast.AnnAssign(target=ast.Name(name)), ast.Expr(value=ast.Constant(str(text))):
                yield name, " ".join(text.split())
