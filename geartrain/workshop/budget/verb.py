"""Command `geartrain budget`: list the causes of each pointer's error, in degrees and in days."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import (
    Cutting,
    File,
    FirstState,
    Force,
    Json,
    Names,
    Out,
    Seed,
    Without,
    check_distinct_outputs,
    draw,
    give,
    option_error,
    picture_sink,
    sink,
)
from geartrain.cli.long_runs import RunOptions, Workers, progress
from geartrain.cli.option_values import MOST_COUNT, Theme, quantity
from geartrain.cli.option_values import turns as read_turns

if TYPE_CHECKING:
    from geartrain.workshop.budget.motion_causes import Body


def run(
    file: File,
    output: Annotated[Names, typer.Option("--of", help="Output to report; may be repeated.")] = None,
    state: FirstState = None,
    without: Without = None,
    span: Annotated[
        str,
        typer.Option(
            "--span", help="Time over which ratio errors accumulate: '6940 d', or a name from `geartrain periods`."
        ),
    ] = "saros_223_synodic_modern",
    turns: Annotated[
        str, typer.Option("--turns", help="Revolutions of the driving link over which tooth errors are evaluated.")
    ] = "20",
    samples: Annotated[
        int,
        typer.Option(
            "--samples", min=2, max=MOST_COUNT, help="Number of input positions over the revolutions given by --turns."
        ),
    ] = 20_000,
    cutting: Cutting = None,
    trials: Annotated[
        int, typer.Option("--trials", min=1, max=MOST_COUNT, help="Number of Monte Carlo trials of cutting errors.")
    ] = 256,
    seed: Seed = 1,
    workers: Workers = None,
    body: Annotated[
        Names,
        typer.Option(
            "--body",
            help="Celestial body whose true motion an output shows, if the name of the output does not indicate it: "
            "OUTPUT=moon, sun or none.",
        ),
    ] = None,
    plot: Annotated[Path | None, typer.Option("--plot", help="Write a plot of the ranked causes to this file.")] = None,
    json: Json = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """List the causes of each pointer's error, in degrees and days: ratio, theory, teeth, lost motion, cutting errors.

    Example: `geartrain budget freeth-2021 --of moon`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.numerics.work import Execution
    from geartrain.workshop.budget.budget_report import describe_budget
    from geartrain.workshop.budget.train_budget import STAGES, BudgetQuestion, find_budget

    to = sink(out, force, (".md", ".html", ".json"))
    picture = picture_sink(plot, force, theme)
    check_distinct_outputs(to, picture)
    question = BudgetQuestion(
        tuple(output or ()),
        tuple(without or ()),
        _days(span),
        float(read_turns("--turns", turns)),
        samples,
        tuple(cutting or ()),
        trials,
        seed,
        bodies=_bodies(body or ()),
    )
    train = load(file)
    with RunOptions(workers).executor("budget") as executor, progress("budget", STAGES) as bar:
        means = Execution(executor)
        found = find_budget(train, question, train.declaration.state_or_first(state), means, bar.advance)
    if plot is not None:
        from geartrain.workshop.budget.budget_report import budget_figure

        draw(budget_figure(found), picture)
    give(to, json, lambda: found, lambda: [describe_budget(found)])


def _days(text: str) -> float:
    """Convert a duration, or the name of a period listed by `geartrain periods`, to days."""
    from geartrain.train.periods import period_table

    row = period_table().get(text.strip())
    if row is not None and row.kind == "period":
        return float(row.value)
    # times are read in seconds
    return quantity("--span", text, "time", minimum="above 0") / 86400


def _bodies(texts: list[str] | tuple[()]) -> Mapping[str, Body | None]:
    """Return a mapping from output to celestial body, parsed from texts such as `moon=moon`, `b=sun` or `date=none`."""
    known: dict[str, Body | None] = {"moon": "moon", "sun": "sun", "none": None}
    found: dict[str, Body | None] = {}
    for text in texts:
        name, equals, body = text.rpartition("=")
        if not equals or body not in known:
            fix = "write it as OUTPUT=moon, OUTPUT=sun or OUTPUT=none"
            raise option_error("--body", f"'{text}' is not an output with a body", fix)
        found[name] = known[body]
    return found
