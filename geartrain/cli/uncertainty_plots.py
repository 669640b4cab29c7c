"""What `geartrain montecarlo --plot` and `geartrain posterior --plot` draw."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import PICTURES, Sink, draw, sink

if TYPE_CHECKING:
    from geartrain.numerics.work import Execution
    from geartrain.uncertainty import ToothCountPosterior
    from geartrain.uncertainty.monte_carlo.monte_carlo_result import MonteCarloResult

Plot = Annotated[Path | None, typer.Option("--plot", help="Draw to this file (.svg, .png or .pdf).")]
Picture = Annotated[
    str, typer.Option("--picture", help="What --plot draws: errors, course, convergence, sobol, pairs or map.")
]
_SHARES = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)  # of windows, where no sweep of clearance is asked
_SCALES = (0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0)  # of the errors declared


def check_plot(plot: Path | None, force: bool, picture: str = "errors") -> Sink:
    """Where a picture goes; one that there is not, or that may not be written, is refused before the work."""
    if plot is not None:
        from geartrain.drawing.monte_carlo_plots import PICTURES as ALL

        if picture not in ALL:
            raise typer.BadParameter(f"'{picture}' is no picture; use {', '.join(ALL)}", param_hint="--picture")
    return sink(plot, force, PICTURES, "--plot")


def with_map(
    findings: MonteCarloResult, picture: str, clearances: Sequence[float], means: Execution
) -> MonteCarloResult:
    """The findings with what a map needs, where one is to be drawn: other clearances, and errors of other sizes."""
    if picture != "map":
        return findings
    from geartrain.uncertainty import jamming_map

    of = findings.trials
    return replace(findings, cleared=jamming_map(of.plan, clearances or _SHARES, _SCALES, of.wanted, of.seed, means))


def draw_findings(findings: MonteCarloResult, picture: str, to: Sink) -> None:
    """One picture of trials to a file."""
    from geartrain.drawing import monte_carlo_figure

    draw(monte_carlo_figure(findings, picture), to)


def draw_counts(
    found: ToothCountPosterior, again: Callable[[Mapping[str, Sequence[int]]], ToothCountPosterior], to: Sink
) -> None:
    """Counts of the wheels of which the outputs tell most, each and two by two, to a file.

    again   sweeps the same train for the same evidence, with some wheels held to the counts given
    """
    from geartrain.drawing import counts_figure
    from geartrain.uncertainty.posterior.pairwise_posterior import joint_posterior, most_informative_wheels

    wheels = most_informative_wheels(found)
    draw(counts_figure(found, joint_posterior(found, wheels, again)), to)
