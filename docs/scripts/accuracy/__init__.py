"""The pages of accuracy: figures and a picture of each, read from docs/data/; the text is NAME.md in this folder.

speeds    speeds, tooth numbers, reconstruction, gears on a sphere: docs/accuracy.md
teeth     transmission functions, tooth shapes, motion, dynamics: docs/mesh-accuracy.md
trials    Monte Carlo, extreme cases, ready to cut: docs/uncertainty-accuracy.md
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from studies.records import number, seconds_text, table


class Comparison(NamedTuple):
    """A case by geartrain and by an alternative: errors as text, seconds of both."""

    case: str
    error: str
    seconds: float
    other: str
    other_error: str
    other_seconds: float | None


def comparisons(rows: Iterable[Comparison]) -> str:
    """A table of cases; times of alternatives as ratios to geartrain's in the same run."""
    columns = {
        "case": lambda row: row.case,
        "error of geartrain": lambda row: row.error,
        "time of geartrain": lambda row: seconds_text(row.seconds),
        "alternative": lambda row: row.other,
        "error of alternative": lambda row: row.other_error,
        "time ratio": lambda row: "-" if row.other_seconds is None else number(row.other_seconds / row.seconds),
    }
    return "\n".join(table(columns, rows)).strip()
