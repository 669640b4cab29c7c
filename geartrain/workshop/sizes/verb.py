"""`geartrain optimise`: the sizes of triangular teeth with which a train loses or errs least at an output."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from geartrain.cli.common import (
    GOOD,
    VERDICT,
    File,
    FirstState,
    Force,
    Json,
    Out,
    Sink,
    check_distinct_outputs,
    draw,
    emit,
    give,
    picture_sink,
    sink,
)
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import Theme
from geartrain.workshop.sizes.pair_verb import read_free, read_limits

_YAML = (".yaml", ".yml")


def run(
    file: File,
    output: Annotated[str, typer.Option("--output", help="The output or link at which the train is judged.")],
    best: Annotated[
        str, typer.Option("--best", help="loss, error, impact or jam: what is to be least; of jam the margin greatest.")
    ] = "loss",
    free: Annotated[
        list[str] | None,
        typer.Option(
            "--free",
            help="NAME or NAME=LOW:HIGH of radii, window, half_angle (one for pairs that share wheels); default radii.",
        ),
    ] = None,
    within: Annotated[
        list[str] | None,
        typer.Option("--within", help="NAME=LIMIT of each pair: loss, error, impact, jam, window_width, play."),
    ] = None,
    state: FirstState = None,
    plot: Annotated[Path | None, typer.Option("--plot", help="Draw what each pair gains to this file.")] = None,
    json: Json = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Sizes of triangular teeth, pair by pair and together, with which a train is best; -o x.yaml: as a declaration."""
    from geartrain.analysis.gear_train import load
    from geartrain.workshop.sizes.tooth_sizes_report import describe_train_sizes
    from geartrain.workshop.sizes.train_size_search import find_train_sizes

    to = sink(out, force, (".md", ".html", ".json", *_YAML))
    picture = picture_sink(plot, force, theme)
    check_distinct_outputs(to, picture)
    ranges, limits = read_free(free or ()), read_limits(within or ())
    train = load(file)
    with progress("optimise", 10 * len(train.declaration.gears), patience=2) as bar:
        found = find_train_sizes(train, output, best, ranges, limits, state, bar.advance)
    if plot is not None:
        from geartrain.workshop.sizes.tooth_sizes_plot import train_sizes_figure

        draw(train_sizes_figure(found), picture)
    if to.suffix in _YAML:
        _declare(found.declaration, file, to)
        to = Sink()
    give(to, json, lambda: found, lambda: [describe_train_sizes(found)])
    raise typer.Exit(GOOD if all(pair.outlines.turns for pair in found.pairs) else VERDICT)


def _declare(declaration: Mapping[str, Any], file: str, to: Sink) -> None:
    """The train that extends the one given: by name where it is shipped, else from where it is written."""
    from geartrain.train.yaml_nodes import as_yaml

    parent = file
    if to.path is not None and Path(file).exists():
        parent = os.path.relpath(file, to.path.parent).replace(os.sep, "/")
    emit(as_yaml({**declaration, "extends": parent}), to)
