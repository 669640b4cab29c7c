"""`geartrain view`: one HTML file in which the train turns."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import (
    GOOD,
    STANDARD_NAME,
    VERDICT,
    File,
    Force,
    StateName,
    file_name,
    is_sound,
    load_all,
    plural,
    sink,
    tell,
)
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geartrain.analysis.gear_train import GearTrain

Other = Annotated[str | None, typer.Argument(help="Another train, to stand beside the first.", metavar="[FILE2]")]
Page = Annotated[
    Path | None,
    typer.Option("--output-file", "-o", help="The page; default NAME.html in this folder; - is standard output."),
]


def run(
    file: File,
    other: Other = None,
    out: Page = None,
    state: StateName = None,
    open_it: Annotated[bool, typer.Option("--open", help="Show it in the browser.")] = False,
    force: Force = False,
    teeth: Annotated[bool, typer.Option("--teeth/--no-teeth", help="Draw the teeth, or plain discs.")] = True,
) -> None:
    """A page in which the train turns: one file, no server, no network; two trains stand side by side."""
    from geartrain.scene import make_scene
    from geartrain.viewer import page

    trains = load_all([file] if other is None else [file, other])
    path = out or file_name("-".join(train.name for train in trains), ".html")
    _check_suffix(path)
    to = sink(path, force)
    shown = [(train, each) for train in trains for each in _states(train, state, first=other is not None)]
    scenes = [make_scene(train, each) for train, each in shown]
    text = page(scenes, compare=other is not None, teeth=teeth)
    data = text.encode("utf-8")
    to.write(data, f": {plural(len(scenes), 'scene')}, {len(data) / 1000:,.0f} kB")
    if open_it and to.path is not None and not webbrowser.open(path.resolve().as_uri()):
        tell("no browser could be started here; open the file by hand")
    raise typer.Exit(GOOD if all(is_sound(train, each) for train, each in shown) else VERDICT)


def _states(train: GearTrain, state: str | None, first: bool) -> Sequence[str | None]:
    """The states that are shown: the one that is named, else all; for a comparison the first only."""
    if state is not None:
        return (state,)
    names = train.states or (None,)
    return names[:1] if first else names


def _check_suffix(path: Path) -> None:
    """Raises `QuestionError` where a browser would not know the file for a page."""
    if path == STANDARD_NAME or path.suffix.lower() in (".html", ".htm") or path.is_dir():
        return
    why = f"'{path.suffix}' is no suffix of a page" if path.suffix else "its name has no suffix"
    raise QuestionError(Problem("the page cannot be written", why, "let it end in .html", str(path)))
