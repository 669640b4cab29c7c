"""What the benchmark of meshes measures, and its tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.bench.record import Record, Records

DIRECT, SCANNED, TABULATED = "direct", "scan of all couples", "tabulated"


@dataclass(frozen=True, slots=True)
class MeshRecord(Record):
    """A record whose `links` counts the couples of teeth within reach, with what was asked for and at how many angles.

    The error is in pitches of the driven wheel for the quantity "error", relative to the mean ratio for "speed".
    """

    quantity: str = ""
    angles: int = 0


@dataclass(frozen=True, slots=True)
class MeshRecords(Records):
    """All measurements of one run: a table a pair, times as ratios to the direct formula."""

    rows: Sequence[MeshRecord]

    def to_markdown(self) -> str:
        """One table for each pair and quantity."""
        lines = [f"# {self.title}", ""]
        for family, links in dict.fromkeys((row.family, row.links) for row in self.rows):
            lines += [f"## {family}, {links} couples in reach", ""]
            group = [row for row in self.rows if row.family == family]
            for quantity in dict.fromkeys(row.quantity for row in group):
                lines += _table(quantity, [row for row in group if row.quantity == quantity])
        return "\n".join(lines)


def _table(quantity: str, rows: list[MeshRecord]) -> list[str]:
    base = next((row.seconds for row in rows if row.method == DIRECT and row.seconds), None)
    each = any(row.angles for row in rows)
    head = f"| {quantity} | {'angles/s' if each else 'time'} | time over direct | memory | true error | |"
    lines = [head, "|---|---|---|---|---|---|"]
    for row in rows:
        ratio = f"{row.seconds / base:.3g}" if row.seconds and base else "-"
        memory = "-" if row.megabytes is None else f"{row.megabytes:.0f} MB"
        error = "-" if row.error is None else f"{row.error:.1e}"
        lines.append(f"| {row.method} | {_cost(row)} | {ratio} | {memory} | {error} | {row.note} |")
    return [*lines, ""]


def _cost(row: MeshRecord) -> str:
    if row.seconds is None:
        return "-"
    return f"{row.angles / row.seconds:.2g}" if row.angles else f"{row.seconds * 1e3:.3g} ms"
