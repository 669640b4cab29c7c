"""`geartrain view`: one HTML file in which the train turns."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, File, StateName, file_name, load_all, may_write, plural, sound
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geartrain.analysis import GearTrain

Other = Annotated[str | None, typer.Argument(help="Another train, to stand beside the first.", metavar="[FILE2]")]
Page = Annotated[Path | None, typer.Option("--output-file", "-o", help="The page; default NAME.html in this folder.")]


def run(
    file: File,
    other: Other = None,
    out: Page = None,
    state: StateName = None,
    open_it: Annotated[bool, typer.Option("--open", help="Show it in the browser.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Write over a file that is there.")] = False,
    teeth: Annotated[bool, typer.Option("--teeth/--no-teeth", help="Draw the teeth, or plain discs.")] = True,
) -> None:
    """A page in which the train turns: one file, no server, no network; two trains stand side by side."""
    from geartrain.files import write_text
    from geartrain.scene import make_scene
    from geartrain.viewer import page

    trains = load_all([file] if other is None else [file, other])
    path = out or file_name("-".join(train.name for train in trains), ".html")
    _check_suffix(path)
    may_write(path, force)
    shown = [(train, each) for train in trains for each in _states(train, state, first=other is not None)]
    scenes = [make_scene(train, each) for train, each in shown]
    text = page(scenes, compare=other is not None, teeth=teeth)
    write_text(path, text)
    size = len(text.encode("utf-8"))
    typer.echo(f"wrote {path}: {plural(len(scenes), 'scene')}, {size / 1000:,.0f} kB", err=True)
    if open_it and not webbrowser.open(path.resolve().as_uri()):
        typer.echo("no browser could be started here; open the file by hand", err=True)
    raise typer.Exit(GOOD if all(sound(train, each) for train, each in shown) else VERDICT)


def _states(train: GearTrain, state: str | None, first: bool) -> Sequence[str | None]:
    """The states that are shown: the one that is named, else all; for a comparison the first only."""
    if state is not None:
        return (state,)
    names = train.states or (None,)
    return names[:1] if first else names


def _check_suffix(path: Path) -> None:
    """Raises `QuestionError` where a browser would not know the file for a page."""
    if path.suffix.lower() in (".html", ".htm") or path.is_dir():
        return
    why = f"'{path.suffix}' is no suffix of a page" if path.suffix else "its name has no suffix"
    raise QuestionError(Problem("the page cannot be written", why, "let it end in .html", str(path)))
