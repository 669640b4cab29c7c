"""Comma-separated values: the one place where rows become the text of a CSV."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable

from geartrain.errors import printable

_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?(/\d+)?")
_FORMULA = ("=", "@", "+", "-", "\t", "\r", "\n")


def csv_line(cells: Iterable[object]) -> str:
    """One row without its end: quoted where that is needed, None as nothing, floats with all their digits.

    A text that a spreadsheet would take for a formula gets an apostrophe in front; numbers and fractions that are
    written as text do not. Control characters are written out, so that a row is always one line of a file.

    >>> csv_line(["a,b", "=1+1", "-254/19", -0.5, None])
    '"a,b",\\'=1+1,-254/19,-0.5,'
    """
    return csv_lines([cells])[0]


def csv_lines(rows: Iterable[Iterable[object]]) -> list[str]:
    """Several rows, each as `csv_line` has it."""
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows([_cell(cell) for cell in row] for row in rows)
    return out.getvalue().split("\n")[:-1]


def csv_text(header: Iterable[object], rows: Iterable[Iterable[object]]) -> str:
    """A whole table, each row ended by a line feed."""
    return "\n".join((csv_line(header), *csv_lines(rows), ""))


def _cell(cell: object) -> object:
    if cell is None:
        return ""
    if not isinstance(cell, str):
        return cell
    text = printable(cell).replace("\n", "\\n").replace("\t", "\\t")
    return f"'{text}" if cell.startswith(_FORMULA) and not _NUMBER.fullmatch(cell) else text
