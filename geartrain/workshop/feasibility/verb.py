"""Command `geartrain feasibility`: estimate the probability that a train turns, jams, is too stiff or breaks."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from geartrain.cli.common import (
    INTERRUPTED,
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
)
from geartrain.cli.long_runs import Resume, RunOptions, Workers, close_journal, long_run
from geartrain.cli.option_values import Theme
from geartrain.cli.option_values import turns as read_turns


def run(
    file: File,
    trials: Annotated[int, typer.Option("--trials", help="Number of Monte Carlo trials.")] = 512,
    seed: Seed = 1,
    cutting: Cutting = None,
    accuracy: Annotated[
        str | None,
        typer.Option(
            "--accuracy",
            metavar="FIRST:LAST:COUNT",
            help="Compute the probability that the train turns for COUNT values, from FIRST to LAST, of the standard "
            "deviation of the pitch errors in degrees, such as 0.02:0.3:6.",
        ),
    ] = None,
    per_part: Annotated[
        bool,
        typer.Option(
            "--per-part",
            help="Draw friction and strength separately for each part, instead of once per workshop. The interval of "
            "the crank torque is then about half as wide.",
        ),
    ] = False,
    turns: Annotated[
        str | None,
        typer.Option(
            "--turns", help="Use the maximum torque over this number of revolutions; default: torque at mean speeds."
        ),
    ] = None,
    output: Annotated[Names, typer.Option("--of", help="Output or link to report; may be repeated.")] = None,
    state: StateName = None,
    without: Without = None,
    workers: Workers = None,
    resume: Resume = False,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="With --accuracy: write a plot of the curve to this file.")
    ] = None,
    json: Json = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Estimate the probability that a train turns, jams, needs too much torque at the crank, or breaks, by Monte Carlo
    trials.

    The declared spreads of friction, strength and crank torque are used.

    Example: `geartrain feasibility moon-triangular --accuracy 0.02:0.3:6`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.workshop.cutting.declared_errors import read_error_overrides
    from geartrain.workshop.feasibility.feasibility_plan import find_feasibility_plan
    from geartrain.workshop.feasibility.feasibility_report import describe_feasibility
    from geartrain.workshop.feasibility.feasibility_trials import run_feasibility
    from geartrain.workshop.monte_carlo.clearance_study import read_sweep
    from geartrain.workshop.monte_carlo.trial_run import check_trials, journal_key

    to = sink(out, force, (".md", ".html", ".json"))
    check_trials(trials)
    drawing = picture_sink(plot, force, theme)
    check_distinct_outputs(to, drawing)
    if plot is not None and accuracy is None:
        raise option_error("--plot", "the curve that it shows is missing", "give --accuracy 0.02:0.3:6")
    steps = tuple(read_sweep(f"accuracy={accuracy}", "--accuracy")) if accuracy else ()
    over = None if turns is None else float(read_turns("--turns", turns))
    errors = read_error_overrides(cutting or ())
    plan = find_feasibility_plan(load(file), errors, output or (), state, without or (), over, per_part)
    train = plan.declared.model_dump(mode="json", exclude_defaults=True)
    own = {"declared": train, "state": state, "over": over, "per_part": per_part, "accuracies": steps}
    question = journal_key(plan.cutting, seed, trials, **own)
    with long_run("feasibility", question, out, RunOptions(workers, resume)) as given:
        found = run_feasibility(plan, trials, seed, steps, given)
        complete = found.trials.complete and len(found.curve) == len(steps)
        close_journal(given.journal, cut=not complete)
    give(to, json, lambda: found, lambda: [describe_feasibility(found)])
    if plot is not None and found.curve:
        from geartrain.workshop.feasibility.feasibility_report import feasibility_figure

        draw(feasibility_figure(found), drawing)
    if not complete:
        raise typer.Exit(INTERRUPTED)
