"""What the benchmark of tooth shapes measured, as tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class WorkRecord:
    """One way to the last contact of one shape, at one setting.

    setting   tolerance, nodes, cells, or distance of the start over the arc
    error     of the distance of the last contact, relative; infinite where the way fails
    seconds   for one solution
    """

    problem: str
    method: str
    setting: float
    error: float
    seconds: float


@dataclass(frozen=True, slots=True)
class ExtremeRecord:
    """One extreme pair by one way: errors and seconds as in `WorkRecord`; `nodes` where there are any."""

    case: str
    method: str
    error: float
    seconds: float
    nodes: int = 0


@dataclass(frozen=True, slots=True)
class InwardRecord:
    """Integrated from the last contact towards the pitch point.

    distance   from the pitch point, over that of the last contact
    error      of the pressure angle there (rad)
    exponent   with which an error grows towards the pitch point by theory: distance^exponent
    """

    problem: str
    distance: float
    error: float
    exponent: float


@dataclass(frozen=True, slots=True)
class ShapeRecords:
    """All measurements of one run on one machine."""

    title: str
    work: Sequence[WorkRecord]
    extremes: Sequence[ExtremeRecord]
    inward: Sequence[InwardRecord]

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; an infinite error is None."""
        data = asdict(self)
        for row in (*data["work"], *data["extremes"], *data["inward"]):
            row["error"] = None if row["error"] == float("inf") else row["error"]
        return data

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> ShapeRecords:
        """What `to_dict` gave."""

        def rows(name: str) -> list[dict[str, Any]]:
            return [{**row, "error": float("inf") if row["error"] is None else row["error"]} for row in data[name]]

        return cls(
            data["title"],
            [WorkRecord(**row) for row in rows("work")],
            [ExtremeRecord(**row) for row in rows("extremes")],
            [InwardRecord(**row) for row in rows("inward")],
        )

    def to_markdown(self) -> str:
        """Tables of work, extreme pairs, and integration inwards."""
        lines = [f"# {self.title}", "", "## Work", "", "| problem | way | setting | error | time |", "|---" * 5 + "|"]
        lines += [
            f"| {row.problem} | {row.method} | {row.setting:.3g} | {_error(row.error)} | {_seconds(row.seconds)} |"
            for row in self.work
        ]
        lines += ["", "## Extreme pairs", "", "| pair | way | nodes | error | time |", "|---" * 5 + "|"]
        lines += [
            f"| {row.case} | {row.method} | {row.nodes or ''} | {_error(row.error)} | {_seconds(row.seconds)} |"
            for row in self.extremes
        ]
        lines += ["", "## Inwards", "", "| problem | distance | error (rad) | exponent |", "|---" * 4 + "|"]
        lines += [
            f"| {row.problem} | {row.distance:.0e} | {_error(row.error)} | {row.exponent:.3f} |" for row in self.inward
        ]
        return "\n".join([*lines, ""])


def quickest(rows: Sequence[WorkRecord], accuracy: float) -> WorkRecord | None:
    """The row of least time among those with an error of at most `accuracy`."""
    good = [row for row in rows if row.error <= accuracy]
    return min(good, key=lambda row: row.seconds, default=None)


def _error(value: float) -> str:
    return "fails" if value == float("inf") else f"{value:.1e}"


def _seconds(value: float) -> str:
    return f"{1e3 * value:.3g} ms"
