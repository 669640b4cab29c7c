"""`geartrain view`: one HTML file in which the train turns."""

from __future__ import annotations

import os
import re
import sys
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, File, StateName, load_all, plural
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.analysis import GearTrain
    from geartrain.scene import Scene

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
    from geartrain.viewer import page

    trains = load_all([file] if other is None else [file, other])
    path = out or Path(f"{'-'.join(_file_name(train.declaration.name) for train in trains)}.html")
    _check_path(path)
    _ask(path, force)
    scenes = [scene for train in trains for scene in _scenes(train, state, first=other is not None)]
    text = page(scenes, compare=other is not None, teeth=teeth)
    write_text(path, text)
    size = len(text.encode("utf-8"))
    typer.echo(f"wrote {path}: {plural(len(scenes), 'scene')}, {size / 1000:,.0f} kB", err=True)
    if open_it and not webbrowser.open(path.resolve().as_uri()):
        typer.echo("no browser could be started here; open the file by hand", err=True)
    raise typer.Exit(GOOD if all(scene.verdict.get("kind") == "determined" for scene in scenes) else VERDICT)


def _scenes(train: GearTrain, state: str | None, first: bool) -> list[Scene]:
    """One scene a state; for a comparison that of the first only, if none is named."""
    from geartrain.scene import make_scene

    names: list[str | None] = list(train.declaration.states) or [None]
    if state is not None or first:
        names = [state if state is not None else names[0]]
    return [make_scene(train, name) for name in names]


def _file_name(name: str) -> str:
    """A train's name as that of a file: whatever a folder could trip over becomes a dash."""
    return re.sub(r"[^\w.+-]+", "-", name).strip("-.")[:100] or "train"


def _check_path(path: Path) -> None:
    wrong = _wrong(path)
    if wrong is not None:
        raise QuestionError(wrong)


def _wrong(path: Path) -> Problem | None:
    place = str(path)
    if os.path.isdir(path):  # Path's own would stumble over names that are too long
        return Problem("the page cannot be written", "there is a folder of that name", "name a file in it", place)
    if path.suffix.lower() not in (".html", ".htm"):
        why = f"'{path.suffix}' is no suffix of a page" if path.suffix else "its name has no suffix"
        return Problem("the page cannot be written", why, "let it end in .html", place)
    if not os.path.isdir(path.parent):
        return Problem("the page cannot be written", "its folder is not there", "make the folder first", place)
    return None


def _ask(path: Path, force: bool) -> None:
    """Nothing is written over unasked."""
    if force or not os.path.lexists(path):
        return
    asked = sys.stdin.isatty() and sys.stderr.isatty()
    if asked and typer.confirm(f"{path} is there already. Write over it?", err=True):
        return
    why = "and it shall stay" if asked else "and nobody is there to be asked"
    raise QuestionError(
        Problem("the page is not written", f"the file is there already, {why}", "use --force", str(path))
    )
