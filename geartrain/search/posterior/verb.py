"""Command `geartrain posterior`: probabilities of uncertain tooth counts, given the observed outputs."""

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
    Names,
    Out,
    Sink,
    StateName,
    as_json,
    check_distinct_outputs,
    draw,
    emit,
    option_error,
    picture_sink,
    show,
    sink,
    table_text,
    tell,
)
from geartrain.cli.long_runs import Resume, RunOptions, Workers, close_journal, long_run
from geartrain.cli.option_values import MOST_COUNT, Theme, at_option, read_share
from geartrain.errors import GearTrainError

if TYPE_CHECKING:
    from geartrain.search.posterior.posterior_result import ToothCountPosterior

Plot = Annotated[Path | None, typer.Option("--plot", help="Write a corner plot to this file (.svg, .png or .pdf).")]
FORMS = (".md", ".html", ".json", ".csv", ".parquet")


def run(
    file: File,
    free: Annotated[
        Names,
        typer.Option(
            "--free", help="Possible tooth counts of a wheel: WHEEL=60:64, WHEEL=60,62 or WHEEL=60; may be repeated."
        ),
    ] = None,
    output: Annotated[Names, typer.Option("--of", help="Use only this output as evidence; may be repeated.")] = None,
    state: StateName = None,
    tolerance: Annotated[
        str | None,
        typer.Option(
            "--tolerance", help="Relative tolerance of targets that declare no tolerance, such as 0.5 % or 1/446."
        ),
    ] = None,
    against: Annotated[
        str,
        typer.Option(
            "--against", help="Evidence to use: all, targets, or figures (values under expect and published)."
        ),
    ] = "all",
    scale: Annotated[str, typer.Option("--scale", help="Factor that multiplies every tolerance, such as 1/4.")] = "1",
    soft: Annotated[
        bool, typer.Option("--gaussian", help="Use a Gaussian likelihood with the tolerances as standard deviations.")
    ] = False,
    method: Annotated[
        str | None,
        typer.Option(
            "--method", help="Method: exact or sample; default: exact if it stays within --limit, else sample."
        ),
    ] = None,
    most: Annotated[
        int, typer.Option("--best", min=0, max=1_000_000, help="Number of combinations of tooth counts to list.")
    ] = 20,
    limit: Annotated[
        int,
        typer.Option(
            "--limit",
            min=1,
            max=MOST_COUNT,
            help="Maximum number of steps of the exact method; if it is exceeded, the default is to sample.",
        ),
    ] = 2_000_000,
    samples: Annotated[
        int, typer.Option("--samples", min=1, max=MOST_COUNT, help="Number of combinations in the random sample.")
    ] = 1_000_000,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Random seed of the sample.")] = 1,
    workers: Workers = None,
    resume: Resume = False,
    plot: Plot = None,
    json: Json = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Compute the probabilities of uncertain tooth counts, given the outputs; the exit code is 0 if some tooth counts
    fit, and 1 if none do.

    Example: `geartrain posterior freeth-2008-doubt --best 8`.
    """
    from geartrain.numerics.files import ColumnTable
    from geartrain.search.posterior.inference import infer_counts, joint_posterior, most_informative_wheels
    from geartrain.train.declaration_files import read_declaration

    to, drawing = sink(out, force, FORMS), picture_sink(plot, force, theme)
    check_distinct_outputs(to, drawing)
    if to.suffix == ".parquet":
        if to.path is None:
            raise option_error("-o", "a .parquet file cannot be written to standard output", "give -o x.parquet")
        ColumnTable(to.path, {}, force)  # reports a missing library before the work
    train = read_declaration(file)
    requested: dict[str, Any] = {
        "state": state,
        "free": _read_free(free or ()),
        "outputs": tuple(output or ()),
        "tolerance": None if tolerance is None else read_share(tolerance, "--tolerance"),
        "against": against,
        "scale": read_share(scale, "--scale"),
        "soft": soft,
        "method": method,
        "most": most,
        "limit": limit,
        "samples": samples,
        "seed": seed,
    }
    question = {"train": train.model_dump(mode="json"), **requested}
    with long_run("posterior", question, out, RunOptions(workers, resume)) as given:
        found = infer_counts(train, **requested, executor=given.executor, journal=given.journal, tell=given.tell)
        close_journal(given.journal, found.cut)
    if drawing.path is not None and not found.best:
        tell(f"no tooth counts fit, so {drawing.path} is not written")
    if plot is not None and found.best and not found.cut:
        from geartrain.search.posterior.corner_plot import counts_figure

        held = {**requested, "most": 1}
        pairs = joint_posterior(
            found,
            most_informative_wheels(found),
            lambda one: infer_counts(train, **{**held, "free": {**requested["free"], **one}}),
        )
        draw(counts_figure(found, pairs), drawing)
    _answer(found, json, to)


def _answer(found: ToothCountPosterior, json: bool, to: Sink) -> None:
    from geartrain.numerics.files import ColumnTable
    from geartrain.search.posterior.posterior_report import describe_posterior, posterior_rows

    if to.suffix == ".csv":
        emit(table_text(posterior_rows(found)), to)
    elif to.suffix == ".parquet":
        assert to.path is not None
        with ColumnTable(to.path, {"train": found.name, "method": found.method}, to.force) as table:
            if rows := posterior_rows(found):
                table.write({name: [row[name] for row in rows] for name in rows[0]})
                tell(f"wrote {to.path}")
            else:
                tell(f"no tooth counts fit, so {to.path} is not written")
    elif to.suffix == ".json":
        emit(as_json(found), to)
    elif not json or to.path is not None:
        show([describe_posterior(found)], to)
    if json and to.suffix != ".json":
        emit(as_json(found))
    if found.cut:
        raise typer.Exit(INTERRUPTED)
    raise typer.Exit(GOOD if found.best else VERDICT)


def _read_free(texts: Sequence[str]) -> dict[str, tuple[int, ...]]:
    """Parse options such as `m3=15:80`, `a1=45,48` and `b1=223`, and return the possible tooth counts keyed by
    wheel.
    """
    from geartrain.search.tooth_count_ranges import read_counts

    found: dict[str, tuple[int, ...]] = {}
    for text in texts:
        wheel, equals, counts = text.partition("=")
        if not equals or not wheel.strip():
            raise option_error(
                "--free", f"'{text}' is not a wheel with counts", "write it as WHEEL=60:64 or WHEEL=60,62"
            )
        try:
            listed = tuple(read_counts(counts).as_array().tolist())
        except GearTrainError as error:
            raise at_option(error, "--free") from None
        found[wheel.strip()] = found.get(wheel.strip(), ()) + listed
    return found
