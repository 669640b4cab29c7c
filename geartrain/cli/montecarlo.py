"""`geartrain montecarlo`: a train cut by hand, many times over: how often it jams, how far its pointers stray."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import (
    INTERRUPTED,
    STANDARD,
    File,
    Force,
    Json,
    Out,
    Sink,
    StateName,
    check_distinct_outputs,
    give,
    read_share,
    sink,
    tell,
)
from geartrain.cli.long_runs import Resume, RunOptions, Scheduler, SingleWorker, close_journal, long_run
from geartrain.cli.uncertainty_plots import Picture, Plot, check_plot, draw_findings, with_map

if TYPE_CHECKING:
    from geartrain.numerics.work import Execution
    from geartrain.uncertainty import TrialPlan, TrialResults
    from geartrain.uncertainty.monte_carlo.monte_carlo_result import MonteCarloResult
    from geartrain.uncertainty.monte_carlo.trial_run import TrialRecord

Names = list[str] | None
TABLES = (".parquet", ".csv")
_FEW = 4  # outputs whose course and indices are worked out at a time
_COURSE = (120, 128)  # positions along a turn, and trials that take them


def run(
    file: File,
    trials: Annotated[int, typer.Option("--trials", help="How many times the train is cut.")] = 1000,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of all that is drawn.")] = 1,
    set_: Annotated[
        Names, typer.Option("--set", help="KIND=SIZE or NAME.KIND=SIZE in place of what is declared: 'tip=3 %'.")
    ] = None,
    output: Annotated[Names, typer.Option("--output", help="Output or link; may be repeated.")] = None,
    state: StateName = None,
    without: Annotated[Names, typer.Option("--without", help="Leave out a pair, to open a loop of real teeth.")] = None,
    clearance: Annotated[
        str | None, typer.Option("--clearance", help="Sweep: factors 1.005:1.04:8, or shares of windows 0.1:0.9:9.")
    ] = None,
    sobol: Annotated[bool, typer.Option("--sobol", help="Sobol indices by wheel and by kind of error.")] = False,
    tolerance: Annotated[
        str | None, typer.Option("--tolerance", help="Greatest error for --jam: a kind of error, or 'all'.")
    ] = None,
    jam: Annotated[str, typer.Option("--jam", help="The chance of a jam that --tolerance allows.")] = "1%",
    workers: SingleWorker = None,
    scheduler: Scheduler = None,
    resume: Resume = False,
    plot: Plot = None,
    picture: Picture = "errors",
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """How often a train cut by hand jams, and how far its pointers stray; to a .parquet or .csv, every trial."""
    from geartrain.analysis.loader import load
    from geartrain.uncertainty import find_trial_plan, read_error_overrides
    from geartrain.uncertainty.monte_carlo.clearance_study import read_clearances
    from geartrain.uncertainty.monte_carlo.monte_carlo_result import MonteCarloResult
    from geartrain.uncertainty.monte_carlo.trial_run import check_trials, journal_key

    to = sink(out, force, (".md", ".html", ".json", *TABLES))
    check_trials(trials)
    drawing = check_plot(plot, force, picture)
    check_distinct_outputs(to, drawing)
    sweep = read_clearances(clearance) if clearance else []
    chance = float(read_share(jam, "--jam"))
    plan = find_trial_plan(load(file), read_error_overrides(set_ or ()), output or (), state, without or ())
    _check_extras(sobol)
    options = RunOptions.alone(workers, scheduler, resume)
    table = _Table(plan, to, resume) if to.suffix in TABLES else None
    findings = drawn = None
    with long_run("montecarlo", journal_key(plan, seed, trials), out, options) as given:
        found = _trials(plan, trials, seed, given, table)
        if found.complete:
            later = replace(given, journal=None)  # the journal is of the trials alone
            findings = _studied(found, bool(output), sweep, sobol, tolerance, chance, later)
            drawn = with_map(findings, picture, sweep, later) if plot is not None else None
            close_journal(given.journal, cut=False)
        else:
            tell(f"stopped after {found.done} of {trials} trials; the figures are of those")
            if given.journal is not None:
                tell(f"what is done is in {given.journal.path}: give the same command with --resume")
    _answer(findings or MonteCarloResult(found), json or to.suffix == ".json", STANDARD if to.suffix in TABLES else to)
    if to.suffix in TABLES and found.complete:
        tell(f"wrote {out}")
    if drawn is not None and plot is not None:
        draw_findings(drawn, picture, drawing)
    if findings is None:
        raise typer.Exit(INTERRUPTED)


def _check_extras(sobol: bool) -> None:
    """Say that an extra is missing before the work, not after."""
    from importlib.util import find_spec

    from geartrain.errors import MissingExtraError

    if sobol and find_spec("SALib") is None:
        raise MissingExtraError("SALib", "errors", "Sobol indices")


def _answer(findings: MonteCarloResult, json: bool, to: Sink) -> None:
    from geartrain.report.monte_carlo_report import describe_monte_carlo

    give(to, json, lambda: findings, lambda: [describe_monte_carlo(findings)])


class _StoppedError(Exception):
    """The user interrupts."""


def _trials(plan: TrialPlan, trials: int, seed: int, given: Execution, table: _Table | None) -> TrialResults:
    """The trials, kept in the journal, and handed on to a table block by block."""
    from geartrain.uncertainty import run_trials

    with suppress(_StoppedError), nullcontext() if table is None else table.open() as take:
        found = run_trials(plan, trials, seed, given, take)
        if not found.complete:
            raise _StoppedError  # so that the table stays partial
    return found


def _studied(
    trials: TrialResults,
    named: bool,
    sweep: list[float],
    sobol: bool,
    tolerance: str | None,
    chance: float,
    means: Execution,
) -> MonteCarloResult:
    """The trials with all that is asked beside them; courses only of outputs that were named."""
    from geartrain.uncertainty import find_sobol_indices, find_tolerance, run_course
    from geartrain.uncertainty.monte_carlo.clearance_study import run_clearances
    from geartrain.uncertainty.monte_carlo.monte_carlo_result import MonteCarloResult

    plan, seed, count = trials.plan, trials.seed, trials.wanted
    few = range(min(_FEW, len(plan.outputs)))
    kind = "" if tolerance == "all" else tolerance
    return MonteCarloResult(
        trials,
        run_clearances(plan, sweep, count, seed, means) if sweep else (),
        [run_course(plan, at, _COURSE[0], seed, _COURSE[1]) for at in few] if named else (),
        [find_sobol_indices(plan, at, by, count, seed, means) for at in few for by in ("wheel", "kind")]
        if sobol
        else (),
        find_tolerance(plan, kind, chance, count, seed, means=means) if kind is not None else None,
    )


@dataclass(frozen=True)
class _Table:
    """Every trial, block by block, into a file; an interrupted one is written anew from the journal."""

    plan: TrialPlan
    to: Sink
    resume: bool

    @contextmanager
    def open(self) -> Iterator[Callable[[TrialRecord], None]]:
        """What takes every block."""
        from geartrain.numerics.files import ColumnTable, LongTable, csv_line

        plan, path = self.plan, self.to.path
        assert path is not None
        if self.to.suffix == ".parquet":
            with ColumnTable(path, _about(plan), self.to.force, replay=self.resume) as columns:
                yield lambda rows: columns.write(_columns(plan, rows))
        else:
            with LongTable(path, csv_line(_names(plan)), force=self.to.force, replay=self.resume) as table:
                yield lambda rows: table.write(_lines(plan, rows))


def _about(plan: TrialPlan) -> dict[str, str]:
    return {"train": plan.name, "events": "sum of 1 jam, 2 clash, 4 standstill, 8 disengaged, 16 wheels cannot be cut"}


def _names(plan: TrialPlan) -> list[str]:
    return [
        "trial",
        "turns",
        *(f"{name} error (deg)" for name in plan.outputs),
        *(f"{pair.name} {what}" for pair in plan.pairs for what in ("play (pitches)", "events")),
    ]


def _columns(plan: TrialPlan, rows: TrialRecord) -> dict[str, Any]:
    import numpy as np

    values = [rows.first + np.arange(len(rows.turns)), rows.turns, *np.degrees(rows.errors.T)]
    for at in range(len(plan.pairs)):
        values += [rows.play[:, at], rows.marks[:, at]]
    return dict(zip(_names(plan), values, strict=True))


def _lines(plan: TrialPlan, rows: TrialRecord) -> list[str]:
    from geartrain.numerics.files import csv_lines

    columns = _columns(plan, rows).values()
    return csv_lines(zip(*(column.tolist() for column in columns), strict=True))
