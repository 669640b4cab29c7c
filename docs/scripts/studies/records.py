"""Records of a study: to JSON and back, as tables, with numbers written alike everywhere."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any, Self, get_args, get_type_hints

Columns = Mapping[str, Callable[[Any], str]]
"""Heading of a column -> the text of a record in it."""


@dataclass(frozen=True)
class StudyRecords:
    """All measurements of one run on one machine.

    A study makes a subclass whose further fields are sequences of one kind of record each; None stands in a record
    for what could not be had.
    """

    title: str

    @classmethod
    def kinds(cls) -> dict[str, type]:
        """Field -> the kind of its records."""
        hints = get_type_hints(cls)
        return {field.name: get_args(hints[field.name])[0] for field in fields(cls) if field.name != "title"}

    @classmethod
    def sorted_by_kind(cls, title: str, rows: Iterable[Any]) -> Self:
        """Records of several kinds, each in its field."""
        found = list(rows)
        return cls(title, *([row for row in found if isinstance(row, kind)] for kind in cls.kinds().values()))

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return asdict(self)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Self:
        """What `to_dict` gave."""
        return cls(data["title"], *([kind(**row) for row in data[name]] for name, kind in cls.kinds().items()))

    def to_markdown(self) -> str:
        """All tables."""
        return "\n".join([f"# {self.title}", "", *self.tables()])

    def tables(self) -> list[str]:
        """Lines of headings and tables, of which a study says what is in them."""
        raise NotImplementedError


def table(columns: Columns, rows: Iterable[Any]) -> list[str]:
    """Lines of a Markdown table, and an empty one."""
    lines = [f"| {' | '.join(columns)} |", "|---" * len(columns) + "|"]
    lines += [f"| {' | '.join(cell(row) for cell in columns.values())} |" for row in rows]
    return [*lines, ""]


def distinct(values: Iterable[Any]) -> list[Any]:
    """Each value once, in the order of the first."""
    return list(dict.fromkeys(values))


def seconds_text(value: float | None) -> str:
    """A time in three digits with a unit from ns to min; a dash where there is none."""
    if value is None:
        return "-"
    scales = ((60.0, "min"), (1.0, "s"), (1e-3, "ms"), (1e-6, "us"))
    scale, unit = next(((scale, unit) for scale, unit in scales if value >= scale), (1e-9, "ns"))
    return f"{value / scale:.3g} {unit}"


def error_text(value: float | None) -> str:
    """An error in two digits; 0 where it is that, a dash where there is none."""
    return "-" if value is None else "0" if value == 0 else f"{value:.1e}"


def number_text(value: float | None, form: str, unit: str = "") -> str:
    """A number in a form, or a dash."""
    return "-" if value is None else f"{value:{form}}{unit}"


def ratio_text(value: float | None, base: float | None) -> str:
    """How many times `base` a value is."""
    return f"{value / base:.3g}" if value and base else "-"
