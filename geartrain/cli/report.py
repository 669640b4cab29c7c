"""`geartrain report`, a report on a train, and `geartrain compare`, a table of the outputs of several trains."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

import typer

from geartrain.cli.common import (
    Files,
    Force,
    Json,
    Out,
    as_json,
    emit,
    exit_code,
    give,
    is_sound,
    load_all,
    option_error,
    show,
    sink,
)
from geartrain.errors import GearTrainError, MissingExtraError

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.report.document import Document, Picture


def report(
    files: Files,
    out: Out = None,
    json: Json = False,
    section: Annotated[
        list[str] | None,
        typer.Option("--section", help="Print only sections whose title contains this word; may be repeated."),
    ] = None,
    everything: Annotated[
        bool, typer.Option("--all", help="Print all sections, including formulas, circuits and sources.")
    ] = False,
    view: Annotated[bool, typer.Option("--view", help="Include the animated train in the HTML page.")] = False,
    force: Force = False,
) -> None:
    """Report on trains as text (80 columns in a pipe), or as .md, .html or .json, depending on the suffix of -o.

    An .html page opens with the verdict, the outputs and the plan, and folds details, which are printed only if they
    are open. Pictures of the plan and the dials need the extra 'plot'.

    Example: `geartrain report freeth-2021 -o page.html`.
    """
    from geartrain.report.document import without_details
    from geartrain.report.train_data import collect_report
    from geartrain.report.train_report import describe_train

    to = sink(out, force, (".md", ".html", ".json"))
    if view and to.suffix != ".html":
        raise option_error(
            "--view", "the output is not an HTML page", "give -o x.html too", "only a page can contain the animation"
        )
    trains = load_all(files)
    # the exit code covers all states, also those that are not printed
    good = all(is_sound(train, state) for train in trains for state in train.states or (None,))
    if json or to.suffix == ".json":
        emit(as_json([collect_report(train) for train in trains]), to)
    elif to.suffix == ".html":
        from geartrain.report.html_page import to_html

        emit(to_html([_shared(train, view) for train in trains]), to)
    else:
        pages = [describe_train(collect_report(train)) for train in trains]
        show(pages if everything else [without_details(page, section or ()) for page in pages], to)
    raise typer.Exit(exit_code(good, to))


def _shared(train: GearTrain, view: bool) -> Document:
    from geartrain.report.train_data import collect_report
    from geartrain.report.train_report import describe_shared_page

    pictures, notes = _pictures(train)
    if not view:
        return describe_shared_page(collect_report(train), pictures, "", notes)
    from geartrain.viewer.viewer_page import train_page

    return describe_shared_page(collect_report(train), pictures, train_page(train), notes)


def _pictures(train: GearTrain) -> tuple[list[Picture], list[str]]:
    """Draw the plan and any dials; return the pictures, and a note for each picture that could not be drawn."""
    from geartrain.report.document import Picture

    drawn: list[Picture] = []
    notes: list[str] = []
    kinds: tuple[Literal["plan", "dials"], ...] = ("plan", "dials") if train.declaration.dials else ("plan",)
    for kind in kinds:
        caption = {"plan": "The plan, to scale", "dials": "The dials"}[kind]
        try:
            from geartrain.drawing import picture, render

            drawn.append(Picture(caption, render(picture(train, kind), ".svg").decode("utf-8")))
        except MissingExtraError as missing:
            return [], [f"This page has no pictures: {missing.problems[0].what}; {missing.problems[0].fix}."]
        except GearTrainError as error:
            notes.append(f"{caption} could not be drawn: {error.problems[0].what}.")
    return drawn, notes


def compare(
    files: Files,
    out: Out = None,
    json: Json = False,
    everything: Annotated[
        bool, typer.Option("--all", help="Compare all outputs, not only outputs with a dial or target.")
    ] = False,
    force: Force = False,
) -> None:
    """Compare the outputs of several trains in one table, with their errors against the targets.

    Example: `geartrain compare freeth-2006 freeth-2008`.
    """
    from geartrain.report.reconstruction_comparison import describe_comparison
    from geartrain.report.train_data import collect_report

    to = sink(out, force, (".md", ".html", ".json"))
    trains = load_all(files)
    sound = all(answer for train in trains for answer in train.answers())
    give(to, json, lambda: list(map(collect_report, trains)), lambda: [describe_comparison(trains, everything)])
    raise typer.Exit(exit_code(sound, to))
