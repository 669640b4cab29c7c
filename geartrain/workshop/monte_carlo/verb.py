"""Command `geartrain montecarlo`: run Monte Carlo trials of a train with cutting errors."""

from __future__ import annotations

from contextlib import nullcontext, suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import (
    INTERRUPTED,
    STANDARD,
    Cutting,
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
    give,
    option_error,
    picture_sink,
    sink,
    tell,
)
from geartrain.cli.long_runs import Resume, RunOptions, Workers, close_journal, long_run
from geartrain.cli.option_values import Theme
from geartrain.errors import suggest

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager

    from geartrain.numerics.work import Execution
    from geartrain.workshop.monte_carlo.trial_plan import TrialPlan
    from geartrain.workshop.monte_carlo.trial_results import TrialResults
    from geartrain.workshop.monte_carlo.trial_run import TrialRecord

Plot = Annotated[Path | None, typer.Option("--plot", help="Write a plot to this file (.svg, .png or .pdf).")]
Picture = Annotated[
    str,
    typer.Option(
        "--picture",
        help="Content of the plot: errors, course (errors over one revolution), convergence, sobol, pairs or map.",
    ),
]


def run(
    file: File,
    trials: Annotated[int, typer.Option("--trials", help="Number of Monte Carlo trials.")] = 1000,
    seed: Seed = 1,
    set_: Cutting = None,
    output: Annotated[Names, typer.Option("--of", help="Output or link to report; may be repeated.")] = None,
    state: StateName = None,
    without: Without = None,
    vary: Annotated[
        str | None,
        typer.Option(
            "--vary",
            metavar="NAME=FIRST:LAST:COUNT",
            help="Repeat the trials at COUNT values of the clearance factor (clearance_factor=1.005:1.04:8), or of its "
            "position in the clearance window of each pair, from 0 to 1 (window=0.1:0.9:9).",
        ),
    ] = None,
    sobol: Annotated[
        bool, typer.Option("--sobol", help="Compute Sobol indices for each wheel and for each kind of error.")
    ] = False,
    workers: Workers = None,
    resume: Resume = False,
    plot: Plot = None,
    picture: Picture = "errors",
    json: Json = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Estimate how often a train with cutting errors jams, and the errors of its pointers, by Monte Carlo trials.

    With -o FILE.parquet or FILE.csv, write a table of all trials.

    Example: `geartrain montecarlo moon-triangular --cutting 'pitch_deviation=2 %'`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.workshop.cutting.declared_errors import read_error_overrides
    from geartrain.workshop.monte_carlo.clearance_study import read_sweep
    from geartrain.workshop.monte_carlo.monte_carlo_report import describe_monte_carlo
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult, study_trials, with_jamming_map
    from geartrain.workshop.monte_carlo.trial_plan import find_trial_plan
    from geartrain.workshop.monte_carlo.trial_run import SUFFIXES, check_trials, journal_key, trial_table

    to = sink(out, force, (".md", ".html", ".json", *SUFFIXES))
    check_trials(trials)
    drawing = picture_sink(plot, force, theme)
    if plot is not None:
        from geartrain.workshop.monte_carlo.monte_carlo_plots import PICTURES, monte_carlo_figure

        if picture not in PICTURES:
            raise option_error("--picture", f"'{picture}' is not a kind of picture", suggest(picture, PICTURES))
    check_distinct_outputs(to, drawing)
    sweep = read_sweep(vary) if vary else []
    plan = find_trial_plan(load(file), read_error_overrides(set_ or ()), output or (), state, without or ())
    options = RunOptions(workers, resume)
    if to.path is None and to.suffix in SUFFIXES:
        raise option_error("-o", "a table of trials cannot be written to standard output", f"give -o x{to.suffix}")
    tabled = to.path is not None and to.suffix in SUFFIXES
    table = trial_table(plan, to.path, force, resume) if to.path is not None and tabled else nullcontext()
    findings = drawn = None
    with long_run("montecarlo", journal_key(plan, seed, trials), out, options) as given:
        found = _trials(plan, trials, seed, given, table)
        if found.complete:
            later = replace(given, journal=None)  # the journal contains only the trials
            findings = study_trials(found, later, sweep, bool(output), sobol)
            if plot is not None:
                drawn = with_jamming_map(findings, later, sweep) if picture == "map" else findings
            close_journal(given.journal, cut=False)
        else:
            tell(f"stopped after {found.done} of {trials} trials; the results are for these trials")
            if given.journal is not None:
                tell(f"completed trials are in {given.journal.path}; repeat the command with --resume to continue")
    shown = findings or MonteCarloResult(found)
    give(STANDARD if tabled else to, json or to.suffix == ".json", lambda: shown, lambda: [describe_monte_carlo(shown)])
    if tabled and found.complete:
        tell(f"wrote {out}")
    if drawn is not None:
        draw(monte_carlo_figure(drawn, picture), drawing)
    if findings is None:
        raise typer.Exit(INTERRUPTED)


class _StoppedError(Exception):
    """Interruption of the trials by the user. It is raised so that the table remains marked as partial."""


def _trials(
    plan: TrialPlan,
    trials: int,
    seed: int,
    given: Execution,
    table: AbstractContextManager[Callable[[TrialRecord], None] | None],
) -> TrialResults:
    """Return the results of trials, run with a journal; `table` provides a function that writes each record or None."""
    from geartrain.workshop.monte_carlo.trial_run import run_trials

    with suppress(_StoppedError), table as take:
        found = run_trials(plan, trials, seed, given, take)
        if not found.complete:
            raise _StoppedError  # leaves the table marked as partial
    return found
