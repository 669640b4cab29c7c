"""`geartrain bench`: error against run time on the user's own train."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, File, Force, Json, Out, StateName, chosen_states, give, sink
from geartrain.cli.long_runs import ProgressBar, progress

if TYPE_CHECKING:
    from geartrain.analysis import GearTrain, MethodAccuracy
    from geartrain.analysis.accuracy import Measurement
    from geartrain.analysis.method_accuracy import Stage


def run(
    file: File,
    state: StateName = None,
    positions: Annotated[
        int, typer.Option("--positions", min=2, max=1_000_000, help="Positions of laws and of the motion.")
    ] = 10_000,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Measure error against run time on a train: speeds, variants, laws of pairs, motion, torques, optimisation."""
    from geartrain.analysis import find_accuracy
    from geartrain.analysis.gear_train import load
    from geartrain.analysis.method_accuracy import OPTIMISATION, SPEEDS
    from geartrain.report.accuracy_report import AccuracyReport, describe_accuracy

    to = sink(out, force, (".md", ".html", ".json"))
    train = load(file)
    states = chosen_states(train, state)
    with progress("bench", patience=2) as bar:
        more: dict[Stage, Measurement] = {OPTIMISATION: partial(_measure_optimisation, bar)}
        measured = tuple(find_accuracy(train, name, positions, more) for name in states)
    found = AccuracyReport(train.name, train.declaration.title, measured)
    give(to, json, lambda: found, lambda: [describe_accuracy(found)])
    raise typer.Exit(VERDICT if any(SPEEDS in each.left_out for each in measured) else GOOD)


def _measure_optimisation(bar: ProgressBar, train: GearTrain, state: str | None) -> Iterator[MethodAccuracy]:
    """How teeth are best sized; nothing of it is loaded for a train without tooth forms."""
    from geartrain.analysis.method_accuracy import AbsentStageError

    if not train.mechanics.meshes_in(state):
        raise AbsentStageError("no pair has triangular teeth of free sizes")
    from geartrain.synthesis.tooth_sizes.search_accuracy import measure_optimisation

    return measure_optimisation(train, state, bar.advance)
