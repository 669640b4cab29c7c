"""The shipped table of astronomical periods, speeds and counts, each with its source (`periods.csv`)."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from importlib import resources
from types import MappingProxyType
from typing import Literal

from geartrain.errors import suggest


@dataclass(frozen=True, slots=True)
class Period:
    """One row: a period in days, a speed in turns per year, or a bare count.

    `value` is exact: the fraction given by the source where there is one, else the decimal as printed. `what` is what
    goes round or is counted, and of a period that serves as a unit its plain name; may be empty.
    """

    name: str
    kind: Literal["period", "speed", "count"]
    value: Fraction
    what: str
    source: str
    confidence: str


@cache
def period_table() -> Mapping[str, Period]:
    """All rows by name."""
    text = resources.files(__package__).joinpath("periods.csv").read_text(encoding="utf-8")
    rows = {}
    for row in csv.DictReader(text.splitlines()):
        value = Fraction(row["exact"] or row["value"])
        rows[row["name"]] = Period(
            row["name"],
            row["kind"],  # type: ignore[arg-type]
            value,
            row["what"],
            row["source"],
            row["confidence"],
        )
    return MappingProxyType(rows)


def suggested_period(name: str) -> str:
    """What to write instead of an unknown `name`."""
    return suggest(name, period_table(), otherwise="`geartrain periods` lists the names", wide=True)
