"""A document: titled sections of paragraphs and tables, independent of how it is shown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from geartrain.exact import decimal


@dataclass(frozen=True, slots=True)
class Table:
    """Rows of text under a header. The first column names the row; `wide` tables are matrices."""

    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    wide: bool = False


@dataclass(frozen=True, slots=True)
class Section:
    """A heading with paragraphs, then tables."""

    title: str
    paragraphs: Sequence[str] = ()
    tables: Sequence[Table] = field(default_factory=tuple)


@dataclass(frozen=True, slots=True)
class Document:
    """A title, a lead, and sections."""

    title: str
    lead: Sequence[str]
    sections: Sequence[Section]


def figure(value: Fraction | float | None, digits: int = 8) -> str:
    """A number in decimal; a dash where there is none."""
    if value is None:
        return "-"
    return decimal(value, digits) if isinstance(value, Fraction) else f"{value:.{digits}g}"


def exact(value: Fraction | float | None) -> str:
    """A number as a fraction, shortened where it is very long; a tilde marks a float."""
    if value is None:
        return "undetermined"
    if not isinstance(value, Fraction):
        return f"~{value:.12g}"
    text = str(value)
    return (
        text if len(text) <= 40 else f"({len(str(abs(value.numerator)))} digits)/({len(str(value.denominator))} digits)"
    )


def one_to(ratio: Fraction | float | None) -> str:
    """A ratio output over input as `1 : n`, or `n : 1` where the output is the faster."""
    if not ratio:
        return "-"
    if not -1 < ratio < 1:
        return f"{figure(ratio, 7)} : 1"
    return f"1 : {figure(1 / ratio, 7)}"


def ppm(value: float | None) -> str:
    """Parts per million with sign."""
    return "-" if value is None else "0" if abs(value) < 1e-9 else f"{value:+.6g}"


MOST_ROWS = 120
"""Longer tables are cut, and say so; the JSON has everything."""


def cut(rows: Sequence[Sequence[str]]) -> list[Sequence[str]]:
    """The first rows of a long table, and how many more there are."""
    if len(rows) <= MOST_ROWS:
        return list(rows)
    return [*rows[:MOST_ROWS], (f"... {len(rows) - MOST_ROWS} more", *("" for _ in rows[0][1:]))]
