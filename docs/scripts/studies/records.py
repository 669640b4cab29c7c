"""Records of a study: written to docs/data/, read from there, and numbers as text."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any, Self, get_args, get_type_hints

DATA = Path(__file__).resolve().parents[2] / "data"
Columns = Mapping[str, Callable[[Any], str]]
"""Heading of a column -> the text of a record in it."""


class Record(dict[str, Any]):
    """An object of a data file; its keys are attributes too."""

    def __getattr__(self, name: str) -> Any:
        return self[name]


@dataclass(frozen=True)
class StudyRecords:
    """All measurements of one run on one machine.

    A study defines a subclass whose further fields are sequences of one kind of record each. None in a record marks a
    value that could not be measured.
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

    @classmethod
    def read(cls, name: str) -> Self:
        """The records of docs/data/NAME.json."""
        kept = read(name)
        return cls(kept.title, *([kind(**row) for row in kept[key]] for key, kind in cls.kinds().items()))

    def text(self) -> str:
        """JSON with one record a line."""
        found = {field.name: getattr(self, field.name) for field in fields(self)}
        parts = [f'"title": {json.dumps(found.pop("title"))}']
        for name, rows in found.items():
            lines = ",\n".join(json.dumps(asdict(row), ensure_ascii=False, allow_nan=False) for row in rows)
            parts.append(f'"{name}": [\n{lines}\n]')
        return "{" + ",\n".join(parts) + "}\n"


def read(name: str) -> Record:
    """The object in docs/data/NAME.json."""
    found: Record = json.loads((DATA / f"{name}.json").read_text(encoding="utf-8"), object_hook=Record)
    return found


def table(columns: Columns, rows: Iterable[Any]) -> list[str]:
    """Lines of a Markdown table, and an empty one."""
    lines = [f"| {' | '.join(columns)} |", "|---" * len(columns) + "|"]
    lines += [f"| {' | '.join(cell(row) for cell in columns.values())} |" for row in rows]
    return [*lines, ""]


def seconds_text(value: float | None) -> str:
    """Time with two digits and a unit from ns to min; a dash for None."""
    if value is None:
        return "-"
    scales = ((60.0, "min"), (1.0, "s"), (1e-3, "ms"), (1e-6, "us"))
    scale, unit = next(((scale, unit) for scale, unit in scales if value >= scale), (1e-9, "ns"))
    return f"{number(value / scale)} {unit}"


def error_text(value: float | None) -> str:
    """Error with two digits; 0 if it is exactly 0, a dash for None."""
    return "-" if value is None else "0" if value == 0 else f"{value:.1e}"


def number(value: float, form: str = ".2g") -> str:
    """Two digits; without a power of ten from 10 to 1,000,000."""
    return f"{float(f'{value:.2g}'):,.0f}" if 9.5 <= value < 1e6 else f"{value:{form}}"


def span(values: Iterable[float], write: Callable[[float], str] = number) -> str:
    """Minimum to maximum, or one number if both have the same text."""
    found = list(values)
    minimum, maximum = write(min(found)), write(max(found))
    return minimum if minimum == maximum else f"{minimum} to {maximum}"
