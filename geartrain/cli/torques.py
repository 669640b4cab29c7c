"""`geartrain torques`: torques, power flow, losses, self-locking."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import (
    GOOD,
    INTERRUPTED,
    VERDICT,
    File,
    Force,
    Json,
    Out,
    Seed,
    Sink,
    StateName,
    check_distinct_outputs,
    chosen_states,
    draw,
    emit,
    give,
    option_error,
    picture_sink,
    sink,
    tell,
)
from geartrain.cli.long_runs import Resume, RunOptions, Workers, close_journal, long_run, progress
from geartrain.cli.option_values import MOST_COUNT, Theme
from geartrain.cli.option_values import turns as read_turns
from geartrain.errors import GearTrainError, Problem
from geartrain.wings import wing

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import TorqueCycle, Torques


def run(
    file: File,
    state: StateName = None,
    json: Json = False,
    turns: Annotated[
        str | None,
        typer.Option(
            "--turns",
            help="Revolutions of the driving link over which torque is computed, or 'period' for one common period.",
        ),
    ] = None,
    samples: Annotated[
        int,
        typer.Option(
            "--samples", min=2, max=MOST_COUNT, help="Number of input positions, in addition to kinks and jumps."
        ),
    ] = 20_000,
    link: Annotated[
        str | None, typer.Option("--of", help="With --turns: link whose torque is computed; default: the crank.")
    ] = None,
    trials: Annotated[
        int | None,
        typer.Option(
            "--trials",
            help="With --turns: number of trials with random friction, drawn with the declared standard deviation.",
        ),
    ] = None,
    seed: Seed = 1,
    workers: Workers = None,
    resume: Resume = False,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot",
            help="Draw the power flow of one state to this file, or with --turns the torque over these revolutions.",
        ),
    ] = None,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Compute the torques of links and pairs, power flow, losses, efficiency and crank torque under the declared loads.

    With --turns and -o x.csv, write the torque at every position.

    Example: `geartrain torques norton-compound --plot power.svg`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.report.torque_report import collect_torque_report, describe_torques

    to = sink(out, force, (".md", ".html", ".json", ".csv"))
    picture = picture_sink(plot, force, theme)
    check_distinct_outputs(to, picture)
    tabled = to.suffix == ".csv"
    if turns is None and (tabled or link is not None or trials is not None):
        which = "-o" if tabled else "--of" if link is not None else "--trials"
        raise option_error(which, "the number of revolutions is missing", "give --turns too")
    if resume and trials is None:
        raise option_error(
            "--resume", "the number of trials is missing", "give --trials too", "only trials can be resumed"
        )
    train = load(file)
    states = chosen_states(train, state)
    found = [train.torques(name) for name in states]
    over_turn = None if turns is None else _over_turn(train, found, turns, samples, link)
    # a state without loads is not a failure
    sound = all(each.verdict or each.verdict.kind == "unloaded" for each in found)
    if over_turn is not None:
        sound = bool(over_turn.verdict)
    tried = None
    if trials is not None and over_turn is not None and over_turn.turns is not None:
        wing("workshop.monte_carlo.trial_run").check_trials(trials)
        plan = wing("workshop").FrictionPlan(train.declaration, over_turn.span, samples, over_turn.state, link)
        tried = _friction_trials(plan, trials, seed, out, RunOptions(workers, resume))
    if plot is not None:
        _draw(train, found, over_turn, picture)
    if tabled and over_turn is not None:
        emit(_table(over_turn), to)
    else:
        report = collect_torque_report(train, found, over_turn, tried)
        give(to, json, lambda: report, lambda: [describe_torques(report)])
    if tried is not None and not tried.complete:
        raise typer.Exit(INTERRUPTED)
    raise typer.Exit(GOOD if sound else VERDICT)


def _over_turn(train: GearTrain, found: Sequence[Torques], turns: str, samples: int, link: str | None) -> TorqueCycle:
    """Return the torque over `turns` revolutions of the input in the only state with loads in `found`."""
    state = _loaded_state(train, found, "--turns").state
    if turns == "period":
        from geartrain.dynamics.turn.train_turn import find_torque_period

        period = find_torque_period(train.mechanics, state, link)
        if period is None:
            fix, why = "give a number of revolutions", "the torque is constant, or cannot be determined"
            raise option_error("--turns", "the torque has no period", fix, why)
        span = float(period)
    else:
        span = float(read_turns("--turns", turns))
    with progress("torques over the turns", patience=2.0) as bar:
        return train.torques(state, turns=span, samples=samples, of=link, on_done=bar.advance)


def _friction_trials(plan: Any, trials: int, seed: int, out: Path | None, options: RunOptions) -> Any:
    """Compute the torques over the revolutions of a plan in trials with random friction coefficients."""
    with long_run("torques", plan.question(trials, seed), out, options) as given:
        found = wing("workshop").try_frictions(plan, trials, seed, given)
        close_journal(given.journal, cut=not found.complete)
    if not found.complete:
        tell(f"stopped after {found.done} of {found.wanted} trials; the results are for these trials")
    return found


def _loaded_state(train: GearTrain, found: Sequence[Torques], option: str) -> Torques:
    """Return the torques of the only state with loads in `found`; raise `QuestionError` if none or several have any."""
    loaded = [each for each in found if each.verdict.kind != "unloaded"] if len(found) > 1 else list(found)
    if not loaded:
        raise option_error(option, "no state has loads", "declare `loads`", "torques follow from loads")
    if len(loaded) > 1:
        names = ", ".join(train.states)
        done = {"--plot": "drawn", "--turns": "simulated"}[option]
        raise option_error(
            option, "several states have loads", f"give --state with one of {names}", f"only one state can be {done}"
        )
    return loaded[0]


def _table(found: TorqueCycle) -> str:
    """Return CSV text with the torque, the breakaway torque, and the loss of each part at every evaluated position of
    the input.
    """
    from geartrain.numerics.files import csv_text

    if found.turns is None or found.torque is None or found.standing is None or found.losses is None:
        raise GearTrainError(
            Problem(
                "the torque cannot be computed, so no file is written",
                found.verdict.text,
                "declare loads that the input can drive",
            )
        )
    columns = [found.turns, found.torque, found.standing, *found.losses.values]
    header = ["turns", f"torque_{found.link}", "starting", *(f"lost_{name}" for name in found.losses.labels[0])]
    return csv_text(header, zip(*(column.tolist() for column in columns), strict=True)).rstrip("\n")


def _draw(train: GearTrain, found: Sequence[Torques], over_turn: TorqueCycle | None, picture: Sink) -> None:
    """Draw the torque over a run, or the power flow if no run is given (`over_turn` is None)."""
    from geartrain.drawing.output_error_plots import torque_cycle_figure
    from geartrain.drawing.power_sankey import power_figure
    from geartrain.dynamics.torques.power_flow import watts_per_unit
    from geartrain.dynamics.torques.train_torques import drive_both_ways
    from geartrain.report.torque_report import summary_text, turns_text

    torques = _loaded_state(train, found, "--plot")
    name = train.name if torques.state is None else f"{train.name}, state {torques.state}"
    if over_turn is not None:
        draw(torque_cycle_figure(over_turn, f"{name}: torque over {turns_text(over_turn.span)}"), picture)
        return
    watts = watts_per_unit(train.declaration, train.declaration.case(torques.state))
    if torques.verdict.kind == "unloaded" and (ways := drive_both_ways(train.mechanics, torques.state)):
        torques, source, load = ways[0]
        name, watts = f"{name}, while a unit of power leaves at '{load}', driven from '{source}'", None
    draw(power_figure(torques, f"{name}: {summary_text(torques)}", watts), picture)
