"""`geartrain check`: validate declarations and verify every expectation."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import GOOD, NOT_USABLE, VERDICT, Files, complain, emit
from geartrain.errors import GearTrainError


def run(
    files: Files,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing for trains that pass.")] = False,
) -> None:
    """Validate trains and verify each `expect`, `published` and `tolerance`; exit with the highest exit code of all
    trains.

    Example: `geartrain check freeth-2021 train.yaml`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.report.soundness import find_soundness

    worst = GOOD
    for file in files:
        try:
            found = find_soundness(load(file), file)
        except GearTrainError as error:
            complain(error)
            worst = NOT_USABLE
            continue
        for line in found.lines(quiet):
            emit(line)
        worst = max(worst, GOOD if found else VERDICT)
    raise typer.Exit(worst)
