"""What `geartrain montecarlo --plot` and `geartrain posterior --plot` draw."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import Sink, draw, picture_sink
from geartrain.scene.palette import ThemeName

if TYPE_CHECKING:
    from geartrain.search import ToothCountPosterior
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult

Plot = Annotated[Path | None, typer.Option("--plot", help="Draw to this file (.svg, .png or .pdf).")]
Picture = Annotated[
    str, typer.Option("--picture", help="What --plot draws: errors, course, convergence, sobol, pairs or map.")
]


def check_plot(plot: Path | None, force: bool, theme: ThemeName, picture: str = "errors") -> Sink:
    """Where a picture goes; one that there is not, or that may not be written, is refused before the work."""
    if plot is not None:
        from geartrain.workshop.monte_carlo.monte_carlo_plots import PICTURES as ALL

        if picture not in ALL:
            raise typer.BadParameter(f"'{picture}' is no picture; use {', '.join(ALL)}", param_hint="--picture")
    return picture_sink(plot, force, theme)


def draw_findings(findings: MonteCarloResult, picture: str, to: Sink) -> None:
    """One picture of trials to a file."""
    from geartrain.workshop import monte_carlo_figure

    draw(monte_carlo_figure(findings, picture), to)


def draw_counts(
    found: ToothCountPosterior, again: Callable[[Mapping[str, Sequence[int]]], ToothCountPosterior], to: Sink
) -> None:
    """Counts of the wheels of which the outputs tell most, each and two by two, to a file.

    again   sweeps the same train for the same evidence, with some wheels held to the counts given
    """
    from geartrain.search import counts_figure
    from geartrain.search.posterior.inference import joint_posterior, most_informative_wheels

    wheels = most_informative_wheels(found)
    draw(counts_figure(found, joint_posterior(found, wheels, again)), to)
