"""Command `geartrain teeth ratio RATIO`: search for gear pairs in series with a given ratio."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from geartrain.cli.common import Force, Json, Out
from geartrain.cli.long_runs import Resume, RunOptions, Workers, close_journal, long_run
from geartrain.search.teeth_verb import (
    ANY_COUNT,
    NEGATIVE_NUMBERS,
    Best,
    Different,
    Hunting,
    Per,
    Pick,
    Pinions,
    Range,
    Ratio,
    SearchAnswer,
    Tolerance,
    Wheels,
    check_number,
    read_tolerance,
)

context_settings = NEGATIVE_NUMBERS


def run(
    context: typer.Context,
    ratio: Ratio,
    stages: Annotated[int, typer.Option("--stages", min=1, max=5, help="Number of gear pairs in series.")] = 2,
    counts: Range = ANY_COUNT,
    wheels: Wheels = None,
    pinions: Pinions = None,
    tolerance: Tolerance = None,
    best: Best = 20,
    by: Annotated[
        str,
        typer.Option(
            "--sort",
            help="Sort the solutions by error, total (sum of tooth counts), largest (largest tooth count), distinct "
            "(number of different tooth counts), hunting (number of stages with coprime counts) or centres (number of "
            "different centre distances).",
        ),
    ] = "error",
    per: Per = None,
    internal: Annotated[
        int, typer.Option("--internal", min=0, help="Number of internal gear pairs, which keep the sense of rotation.")
    ] = 0,
    hunting: Hunting = False,
    reverted: Annotated[
        bool, typer.Option("--reverted", help="Require a reverted train: all gear pairs have the same centre distance.")
    ] = False,
    different: Different = False,
    maximum_total: Annotated[
        int | None, typer.Option("--max-total", min=2, help="Maximum sum of all tooth counts.")
    ] = None,
    pick: Pick = 1,
    workers: Workers = None,
    resume: Resume = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Find gear pairs in series with a given ratio, count all solutions within the tolerance, and list solutions that
    are proved to be the best.

    Example: `geartrain teeth ratio 235/19 --stages 2 --tolerance 1e-4`.
    """
    from geartrain.search.ratio.stage_problem import StageConstraints
    from geartrain.search.ratio.stage_search import find_stages, stages_to_train
    from geartrain.search.target_ratio import read_ratio
    from geartrain.search.tooth_count_ranges import read_counts

    answer = SearchAnswer.of(json, out, force, pick)
    wanted = read_ratio(check_number(context, ratio), per)
    larger, smaller = (read_counts(text or counts) for text in (wheels, pinions))
    most_error = read_tolerance(tolerance)
    fit: dict[str, Any] = {
        "internal": internal,
        "hunting": hunting,
        "reverted": reverted,
        "different": different,
        "maximum_total": maximum_total,
    }
    question = {
        "ratio": str(wanted.value),
        "stages": stages,
        "wheels": str(larger),
        "pinions": str(smaller),
        "tolerance": str(most_error),
        "best": best,
        "by": by,
        "fit": fit,
    }
    with long_run("teeth", question, out, RunOptions(workers, resume)) as given:
        found = find_stages(
            wanted,
            stages,
            larger,
            smaller,
            tolerance=most_error,
            best=best,
            by=by,
            fit=StageConstraints(**fit),
            executor=given.executor,
            journal=given.journal,
            tell=given.tell,
        )
        close_journal(given.journal, cut=not found.complete)
    answer.give(found, lambda at: stages_to_train(found[at], found.fit.internal))
