"""Every trial as a row of a file: what it did to each pair, and how far each pointer strayed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.files import ColumnTable, LongTable, csv_line, csv_lines

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.uncertainty.monte_carlo.trial_plan import TrialPlan
    from geartrain.uncertainty.monte_carlo.trial_run import TrialRecord

SUFFIXES = (".parquet", ".csv")
_EVENTS = "sum of 1 jam, 2 clash, 4 standstill, 8 disengaged, 16 wheels cannot be cut"


@dataclass(frozen=True)
class TrialTable:
    """Every trial, block by block, into a file.

    path     a .parquet or .csv
    force    an existing file is written over
    replay   the run was interrupted: its file is written anew from the journal
    """

    plan: TrialPlan
    path: Path
    force: bool = False
    replay: bool = False

    @contextmanager
    def open(self) -> Iterator[Callable[[TrialRecord], None]]:
        """What takes every block."""
        plan = self.plan
        if self.path.suffix.lower() == ".parquet":
            about = {"train": plan.name, "events": _EVENTS}
            with ColumnTable(self.path, about, self.force, replay=self.replay) as columns:
                yield lambda rows: columns.write(dict(zip(_names(plan), _columns(plan, rows), strict=True)))
        else:
            with LongTable(self.path, csv_line(_names(plan)), force=self.force, replay=self.replay) as table:
                yield lambda rows: table.write(
                    csv_lines(zip(*(column.tolist() for column in _columns(plan, rows)), strict=True))
                )


def _names(plan: TrialPlan) -> list[str]:
    return [
        "trial",
        "turns",
        *(f"{name} error (deg)" for name in plan.outputs),
        *(f"{pair.name} {what}" for pair in plan.pairs for what in ("play (pitches)", "events")),
        *(f"{pair.name} {what}" for pair in plan.pairs if pair.stroke for what in ("strokes", "teeth filed")),
    ]


def _columns(plan: TrialPlan, rows: TrialRecord) -> list[Floats]:
    """The columns of one block, as `_names` names them."""
    values = [rows.first + np.arange(len(rows.turns)), rows.turns, *np.degrees(rows.errors.T)]
    for at in range(len(plan.pairs)):
        values += [rows.play[:, at], rows.marks[:, at]]
    for at, pair in enumerate(plan.pairs):
        if pair.stroke:
            values += [rows.filing[:, 2 * at].astype(np.int64), rows.filing[:, 2 * at + 1].astype(np.int64)]
    return values
