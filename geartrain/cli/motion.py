"""`geartrain motion`: transmission errors and speeds of the outputs, from declared tooth forms and pins."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import (
    INTERRUPTED,
    STANDARD,
    File,
    Force,
    Json,
    Names,
    Out,
    Seed,
    StateName,
    Without,
    check_distinct_outputs,
    draw,
    emit,
    give,
    option_error,
    picture_sink,
    sink,
    tell,
)
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import MOST_COUNT, Theme
from geartrain.cli.option_values import turns as read_turns
from geartrain.wings import wing

if TYPE_CHECKING:
    from geartrain.dynamics import Motion, MotionRun


def run(
    file: File,
    turns: Annotated[
        str,
        typer.Option(
            "--turns",
            help="Revolutions of the driving link, negative to turn backwards, or 'period' for one common period.",
        ),
    ] = "20",
    samples: Annotated[
        int, typer.Option("--samples", min=2, max=MOST_COUNT, help="Number of input positions.")
    ] = 200_000,
    output: Annotated[Names, typer.Option("--of", help="Output or link to report; may be repeated.")] = None,
    links: Annotated[bool, typer.Option("--links", help="Report every link, not only the outputs.")] = False,
    wide: Annotated[bool, typer.Option("--wide", help="Report the contribution of each pair to every output.")] = False,
    state: StateName = None,
    without: Without = None,
    measured: Annotated[
        bool,
        typer.Option(
            "--measured", help="Use the measured teeth and fixed errors that are declared, instead of perfect teeth."
        ),
    ] = False,
    phases: Annotated[
        int, typer.Option("--phases", min=0, max=MOST_COUNT, help="Number of additional runs with random tooth phases.")
    ] = 0,
    seed: Seed = 1,
    spectrum: Annotated[
        bool, typer.Option("--spectrum", help="Add the spectral lines of each output, with exact orders and sources.")
    ] = False,
    json: Json = False,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot",
            help="Write a plot of the pointer errors, or of the motion of one output (--of), to this file.",
        ),
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Resume an interrupted run; requires its -o x.csv.")] = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Compute transmission errors and speeds of outputs from declared tooth forms and pins; -o x.csv writes every
    position.

    Example: `geartrain motion moon-triangular --of moon --turns 20`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.dynamics import MotionRun
    from geartrain.numerics.files import partial_name

    to = sink(out, force, (".md", ".html", ".json", ".csv"))
    picture = picture_sink(plot, force, theme)
    # where the results of an interrupted run are written, checked together with the others; CSV tables have their own
    cut = STANDARD if to.path is None or to.suffix == ".csv" else sink(partial_name(to.path), to.force)
    check_distinct_outputs(to, cut, picture)
    if resume and (to.suffix != ".csv" or to.path is None):
        raise option_error(
            "--resume", "the output is not a CSV file", "give -o x.csv too", "only CSV tables can be resumed"
        )
    train = load(file)
    outputs = (*(output or ()), *(train.declaration.links if links else ()))
    # an output that is also a link is reported once
    how = state, tuple(dict.fromkeys(outputs)), tuple(without or ())
    made = wing("workshop.cutting.measured_motion").measured_motion if measured else None
    motion = train.motion(*how) if made is None else made(train, *how)
    requested = MotionRun(motion, _turns(turns, motion), samples)
    if to.suffix == ".csv" and to.path is not None:
        _write_table(requested, to.path, resume, force)
    elif to.suffix == ".csv":
        for rows in _rows(requested, 0):
            emit("\n".join(rows))
    else:
        from geartrain.report.motion_report import collect_motion, describe_motion, separation_rates

        stopped = _run_analyses(requested, phases, seed, spectrum)
        # speeds of separation are known for perfect teeth only
        separation = None if stopped or measured else separation_rates(train, state, without or ())
        found = collect_motion(requested, train.name, state, separation)
        give(cut if stopped else to, json, lambda: found, lambda: [describe_motion(found, bool(wide or outputs))])
        if stopped:
            stop = f"stopped after {requested.done} of {requested.samples} positions"
            tell(f"{stop}; the results are for these positions")
            raise typer.Exit(INTERRUPTED)
    if plot is not None:
        from geartrain.drawing.output_error_plots import motion_figure

        with progress("drawing", samples) as bar:
            unit = "turn" if requested.turns == 1 else "turns"
            title = f"{train.name}: motion over {requested.turns:g} {unit} of {motion._problem.driving_link}"
            draw(motion_figure(requested, bar.advance, title), picture)


def _turns(text: str, motion: Motion) -> float:
    if text != "period":
        return float(read_turns("--turns", text))
    if motion.period is None:
        what, fix = "the speeds have no common period", "give a number of revolutions"
        raise option_error("--turns", what, fix, "all speeds are constant")
    return float(motion.period)


def _run_analyses(requested: MotionRun, phases: int, seed: int, spectrum: bool) -> bool:
    """Compute a run, its random phases and spectra; return True if Ctrl-C ended it, so that positions are missing."""
    # each analysis evaluates all positions once
    work = requested.samples * (1 + phases + spectrum)
    with progress("motion", work) as bar:
        try:
            requested.run(bar.advance)
            requested.run_random_phases(phases, seed, bar.advance)
            if spectrum:
                requested.find_spectra(bar.advance)
        except KeyboardInterrupt:
            # an interrupt before the first results ends the command
            if not requested.done:
                raise
            return True
    return False


def _write_table(requested: MotionRun, out: Path, resume: bool, force: bool) -> None:
    from geartrain.numerics.files import LongTable, csv_line

    try:
        with LongTable(out, csv_line(requested._position_columns), resume, force) as table:
            if resume and not table.rows:
                tell(f"nothing to resume: {table.partial} does not exist; starting a new run")
            if table.rows:
                requested._check_resumed(table.last(), table.rows)
            first = table.rows
            with progress("motion", requested.samples - first) as bar:
                for rows in _rows(requested, first, header=False):
                    table.write(rows)
                    bar.advance(len(rows))
    except KeyboardInterrupt:
        tell(f"stopped after {table.rows} of {requested.samples} positions; these are in {table.partial}")
        tell("repeat the command with --resume to continue")
        raise typer.Exit(INTERRUPTED) from None
    tell(f"wrote {out}")


def _rows(requested: MotionRun, first: int, header: bool = True) -> Iterator[list[str]]:
    from geartrain.numerics.files import csv_line, csv_lines

    if header:
        yield [csv_line(requested._position_columns)]
    for passage in requested.motion._stretches(requested.turns, requested.samples, first):
        yield csv_lines(zip(*(column.tolist() for column in requested._values(passage)), strict=True))
