"""Base classes of results: display at the prompt and in notebooks, plain data for JSON, tables and figures.

In plain data exact numbers are strings with all digits, arrays and tuples are lists, and results are objects.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
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

_SHOWN = 20  # rows of a table that are printed


class Shown:
    """Result whose `repr` is one line, and whose `str` is the text that its command prints.

    Notebooks display the tables of its HTML page. The `repr` contains only values that are already computed.
    """

    __slots__ = ()

    PAGE: ClassVar[str] = ""
    """Name `package.module:function` of the function that describes the result as a document; "" without a page."""
    TEXT: ClassVar[str] = ""
    """Name of the function that returns the text that the command prints; "" if the command prints the document as
    text.
    """

    def __init_subclass__(cls, **options: Any) -> None:
        """Make each subclass keep the inherited `__repr__`, which the decorator `dataclass` would otherwise replace."""
        super().__init_subclass__(**options)
        if "__repr__" not in vars(cls):
            cls.__repr__ = cls.__repr__  # type: ignore[method-assign]

    def _summary(self) -> str:
        """Return the main results on one line, using only values that are already computed."""
        return fields_summary(self)

    def __repr__(self) -> str:
        return summary_line(type(self).__name__, self._summary())

    def __dir__(self) -> list[str]:
        """List the attributes of the result without class constants in capital letters, which are internal."""
        return [name for name in super().__dir__() if not name.isupper()]

    def __str__(self) -> str:
        """Return the text that the command prints for the result, or `repr` if it has no command."""
        found = _described(self, self.TEXT or self.PAGE)
        if found is None:
            return repr(self)
        return found if isinstance(found, str) else _text_of(found)

    def _repr_html_(self) -> str:
        """Return the HTML page of the result, or its text if jinja2 (extra `report`) is not installed."""
        page = _described(self, self.PAGE)
        if page is not None:
            try:
                html: str = imported_function("report.html_page", "to_fragment")([page])
                return html
            except MissingExtraError:
                pass
        return f"<pre>{escape(str(self))}</pre>"


def _described(result: object, name: str) -> Any:
    """Return the result of calling the function `package.module:function` with an object; None for an empty name."""
    if not name:
        return None
    module, _, function = name.partition(":")
    return imported_function(module, function)(result)


def _text_of(document: Any) -> str:
    text: str = imported_function("report.text", "to_text")([document])
    return printable(text)


_LONGEST_LINE = 160
"""Maximum number of characters of the summary line of a result."""
_LONGEST_VALUE = 40
"""Maximum number of characters of one value in a summary."""


def summary_line(name: str, summary: str) -> str:
    """Return `<name summary>` on one line; the summary is shortened to at most 160 characters.

    >>> summary_line("Answer", "worm: determined")
    '<Answer worm: determined>'
    """
    text = " ".join(printable(summary).split())
    if len(text) > _LONGEST_LINE:
        text = text[: _LONGEST_LINE - 4].rstrip(" ,;") + " ..."
    return f"<{name} {text}>" if text else f"<{name}>"


def fields_summary(result: Any) -> str:
    """Return public fields as `name=value`: numbers with 6 digits, containers by their length, and no None."""
    own = [each.name for each in fields(result)] if is_dataclass(result) else ()
    return values_summary(result, getattr(result, "_fields", own))


def values_summary(result: Any, names: Iterable[str]) -> str:
    """Return the named attributes as `name=value`, without attributes that are None."""
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
    """Return the summary line of a named tuple. Named tuples use this function, because they cannot inherit it."""
    return summary_line(type(result).__name__, fields_summary(result))


def brief(value: object) -> str | None:
    """Return a value as short text; None for a value that a summary omits.

    >>> brief(Fraction(2, 7)), brief(0.12345678), brief(["a", "b", "c", "d", "e"]), brief("two words")
    ('2/7', '0.123457', '5 items', "'two words'")
    """
    if value is None or callable(value) or hasattr(value, "_made"):  # a mapping that is created when it is read
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
    except OverflowError:  # more items than `len` can return
        return None
    # short tuples of numbers and names are shown, other containers by their length only
    if isinstance(values, tuple) and len(values) <= 4 and not hasattr(values, "_fields"):
        parts = [brief(each) for each in values]
        text = f"({', '.join(part or '-' for part in parts)})"
        kinds = str | int | float | Fraction
        if len(text) <= _LONGEST_VALUE and all(isinstance(each, kinds) or hasattr(each, "_brief") for each in values):
            return text
    return f"{len(values)} item{'s' if len(values) > 1 else ''}"


class Tabular(Shown):
    """Result with columns, which can be exported as a table and whose first rows a notebook displays."""

    __slots__ = ()

    MEANINGS: ClassVar[Mapping[str, str]] = {}
    """Meaning of each column that is not a field, with its unit in brackets; `*` in a name matches any text."""

    ROW: ClassVar[str] = ""
    """Name of the class, in the module of the result, whose fields are the columns of the table."""
    ROWS: ClassVar[str] = ""
    """Name of the function that returns the rows as dictionaries by column; "" for a class with own `columns`."""

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns by name: floats, and exact numbers as strings in separate columns; None where a value is missing."""
        rows = _described(self, self.ROWS) or ()
        return {name: [row[name] for row in rows] for name in (rows[0] if rows else ())}

    @property
    def meanings(self) -> Mapping[str, str]:
        """Meaning of each column, with its unit in brackets."""
        return {name: text for name in self.columns if (text := self._meaning(name))}

    def _meaning(self, column: str) -> str:
        """Return the meaning of one column; "" if it is unknown."""
        own: Any = type(self)
        row = getattr(modules[own.__module__], self.ROW or own.__name__)
        # a column of the row class has precedence over a field of the result with the same name
        known = {**field_docs(own), **field_docs(row), **self.MEANINGS}
        exact = known.get(column) or _property_doc(getattr(row, column, None))
        return exact or next((text for name, text in known.items() if fnmatchcase(column, name)), "")

    def to_frame(self) -> Any:
        """Return the table as a pandas DataFrame.

        `attrs["meanings"]` contains the meaning of each column, and `attrs["units"]` the unit of each column that has
        one.

        Raises
        ------
        MissingExtraError
            If pandas (extra `tables`) is not installed.
        """
        try:
            import pandas
        except ImportError:
            raise MissingExtraError("pandas", "tables", "a DataFrame") from None
        frame = pandas.DataFrame(dict(self.columns))
        meanings = self.meanings
        frame.attrs["meanings"] = dict(meanings)
        frame.attrs["units"] = {name: unit for name in meanings if (unit := _unit(meanings[name]))}
        return frame

    def to_records(self) -> Any:
        """Return the table as a numpy record array, in which `records["link"]` is a column; missing numbers are NaN."""
        import numpy as np

        columns = {}
        for name, values in self.columns.items():
            gap = "" if any(isinstance(value, str) for value in values) else float("nan")
            columns[name] = np.array([gap if value is None else value for value in values])
        kinds = [(name, column.dtype) for name, column in columns.items()]
        return np.rec.fromarrays(list(columns.values()), dtype=kinds)

    def __str__(self) -> str:
        """Return the text that the command prints for the result, or its first rows as a table if it has no command."""
        found = _described(self, self.TEXT or self.PAGE)
        if found is None:
            table = imported_function("report.document", "table_document")(self.columns, _SHOWN)
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
    """Return the first paragraph of the docstring of a class member that is a property; "" for other members."""
    maker = member if isinstance(member, property) else getattr(member, "func", None)
    return " ".join((getattr(maker, "__doc__", None) or "").split("\n\n")[0].split())


def _unit(meaning: str) -> str:
    """Return the unit in square brackets in the description of a column; "" if it has no unit."""
    found = search(r"\[([^\]]+)\]", meaning)
    return found[1] if found else ""


def _cell(value: object) -> str:
    if value is None:
        return ""
    return escape(value) if isinstance(value, str) else f"{value:.10g}" if isinstance(value, float) else str(value)


def imported_function(module: str, name: str) -> Callable[..., Any]:
    """Import the function or class `name` of a module of `geartrain` that must not be imported at the top of a file.

    Drawing modules import computing modules, but not the reverse; results call them only when they are displayed.
    """
    found: Callable[..., Any] = getattr(import_module(f"geartrain.{module}"), name)
    return found


class Pictured:
    """Result with a picture, drawn by the function that `FIGURE` names as `package.module:function`."""

    __slots__ = ()

    FIGURE: ClassVar[str]

    def plot(self, *how: Any) -> Any:
        """Plot the result as a matplotlib figure, which notebooks show.

        Parameters
        ----------
        *how
            Further arguments of the function that draws such results.

        Returns
        -------
        matplotlib.figure.Figure
            Figure, which `geartrain.drawing.render` converts to a file.

        Raises
        ------
        MissingExtraError
            If matplotlib (extra `plot`) is not installed.
        """
        return imported_function(*self.FIGURE.split(":"))(self, *how)


@dataclass(frozen=True, slots=True)
class Key:
    """Key in the plain data of a result whose name differs from the attribute or whose value is converted."""

    name: str
    """Name of the key in the data; "" to merge the keys of a part into the keys of the result."""
    of: str = ""
    """Path of the attribute: `part.attribute` for an attribute of a part, "." for the result; by default `name`."""
    to: Callable[[Any], Any] | None = None
    """Function that converts each number or object of the attribute; its return annotation is the type in the data."""
    keys: tuple[str | Key, ...] = ()
    """Keys of each object in the attribute, if they differ from the keys of the object's class."""

    @property
    def path(self) -> str:
        """Path of the attribute; "" for the result itself."""
        return "" if self.of == _ITSELF else self.of or self.name


_ITSELF = "."


def group(name: str, *keys: str | Key) -> Key:
    """Return a key of a result's plain data whose value is an object that contains further keys of this result."""
    return Key(name, _ITSELF, keys=keys)


class Result(Shown):
    """Result that can be converted to plain data for JSON: the keys in `KEYS`, or all its fields."""

    __slots__ = ()
    KEYS: ClassVar[tuple[str | Key, ...]] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain data for JSON; the keys are stable (docs/json.md)."""
        return _plain_data(self)


@dataclass(frozen=True, slots=True)
class TrainResult(Result):
    """Result for one train, stored with the declaration of the train, which its text and its tables require."""

    _declaration: Any = field(default=None, kw_only=True, repr=False, compare=False)

    @property
    def _named(self) -> str:
        """Names of the train and of the state, as far as they are known."""
        name = "" if self._declaration is None else self._declaration.name
        state = getattr(self, "state", None)
        return name if state is None else f"{name} state {state}".strip()


def plain(value: Any, to: Callable[[Any], Any] | None = None, keys: tuple[str | Key, ...] = ()) -> Any:
    """Return a value as plain data for JSON.

    `to` and `keys` have the same meaning as in `Key`, and apply to all objects in the value except mappings, lists and
    None.

    >>> plain({"ratio": Fraction(254, 19), "teeth": (20, 30)})
    {'ratio': '254/19', 'teeth': [20, 30]}
    """
    if value is None:
        return None
    if hasattr(value, "_asdict"):  # a named tuple
        return _plain_data(value, keys) if keys else plain(value._asdict(), to)
    if isinstance(value, Mapping):
        return {str(key): plain(each, to, keys) for key, each in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [plain(each, to, keys) for each in value]
    if hasattr(value, "tolist"):  # an array, or one of its numbers
        return plain(value.tolist(), to)
    if to is not None:
        return to(value)
    if keys:
        return _plain_data(value, keys)
    if isinstance(value, str | bool | int | float):
        return value
    if isinstance(value, Fraction):
        return fraction_text(value)
    if hasattr(value, "model_dump"):  # a part of a declaration
        return value.model_dump(mode="json")
    return value.to_dict() if hasattr(value, "to_dict") else _plain_data(value)


def finite(value: float) -> float | None:
    """Return a finite number, or None for infinity and NaN, which JSON cannot represent."""
    return value if isfinite(value) else None


def _plain_data(result: Any, keys: tuple[str | Key, ...] = ()) -> dict[str, Any]:
    kind: Any = type(result)
    found: dict[str, Any] = {}
    for key in whole(keys) if keys else keys_of(kind):
        value = plain(attrgetter(key.path)(result) if key.path else result, key.to, key.keys)
        if key.name:
            found[key.name] = value
        else:
            # a key without a name merges the keys of a part; a part that is None has none
            found |= value or {}
    return found


@cache
def keys_of(kind: Any) -> tuple[Key, ...]:
    """Return the keys of a class's plain data in order. Raises `TypeError` for a class without keys."""
    named: tuple[str | Key, ...] = getattr(kind, "KEYS", ())
    if not named and is_dataclass(kind):
        named = tuple(each.name for each in fields(kind) if not each.name.startswith("_"))
    if not named:
        raise TypeError(f"{kind.__name__} has no plain data: it is not a dataclass and has no KEYS")
    return whole(named)


def whole(keys: tuple[str | Key, ...]) -> tuple[Key, ...]:
    """Return a tuple of `Key` objects, in which each string is replaced by the key of the attribute with this name."""
    return tuple(each if isinstance(each, Key) else Key(each) for each in keys)


# -------------------------------------------------------------------------------------------------- meanings of fields


@cache
def field_docs(kind: type) -> Mapping[str, str]:
    """Return the docstrings of the fields of a class and its bases, by field, each on one line."""
    found: dict[str, str] = {}
    # base classes first, so that a class overrides their docstrings
    for base in reversed(kind.__mro__):
        if get_annotations(base):
            found |= _docs_of_classes(base.__module__).get(base.__qualname__, {})
    return found


@cache
def _docs_of_classes(module: str) -> Mapping[str, Mapping[str, str]]:
    import ast
    import inspect

    found: dict[str, dict[str, str]] = {}
    todo: list[tuple[str, ast.AST]] = [("", ast.parse(inspect.getsource(modules[module])))]
    while todo:
        prefix, node = todo.pop()
        for part in ast.iter_child_nodes(node):
            if isinstance(part, ast.ClassDef):
                docs = found[prefix + part.name] = {}
                for statement in pairwise(part.body):
                    match statement:
                        case ast.AnnAssign(target=ast.Name(name)), ast.Expr(value=ast.Constant(str(text))):
                            docs[name] = " ".join(text.split())
                todo.append((f"{prefix}{part.name}.", part))
    return found
