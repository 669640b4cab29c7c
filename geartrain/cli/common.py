"""What the verbs share: arguments, exit codes, where text goes."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Iterable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.errors import GearTrainError, Problem

if TYPE_CHECKING:
    from geartrain.analysis import GearTrain
    from geartrain.report import Document

GOOD, VERDICT, NOT_USABLE, INTERRUPTED = 0, 1, 2, 130
PICTURES = (".svg", ".png", ".pdf")

File = Annotated[str, typer.Argument(help="A YAML declaration, or the name of a shipped train.", metavar="FILE")]
Files = Annotated[list[str], typer.Argument(help="YAML declarations, or names of shipped trains.", metavar="FILE")]
Out = Annotated[Path | None, typer.Option("--output-file", "-o", help="Write to this file instead of the terminal.")]
Json = Annotated[bool, typer.Option("--json", help="Print plain data as JSON.")]
StateName = Annotated[str | None, typer.Option("--state", help="The state to solve; default all.")]


def load_all(files: list[str]) -> list[GearTrain]:
    """All trains, or one error that tells what is wrong with each of the files."""
    from geartrain.files import load

    trains: list[GearTrain] = []
    problems: list[Problem] = []
    for file in files:
        try:
            trains.append(load(file))
        except GearTrainError as error:
            problems += error.problems
    if problems:
        raise GearTrainError(problems)
    return trains


def sound(train: GearTrain, state: str | None) -> bool:
    """True if all is determined and as expected in a state (by default the first), and no teeth are at fault."""
    first = state if state is not None or not train.states else train.states[0]
    return bool(train.solve(first)) and not any(mesh.fault for mesh in train.meshes)


def complain(error: GearTrainError) -> None:
    """Every problem on standard error."""
    for problem in error.problems:
        typer.echo(f"error: {problem}", err=True)


def emit(text: str, out: Path | None = None) -> None:
    """Text to a file, whole or not at all, or to standard output."""
    if out is None:
        typer.echo(text)
        return
    from geartrain.files import write_text

    write_text(out, text if text.endswith("\n") else text + "\n")
    typer.echo(f"wrote {out}", err=True)


def show(documents: Sequence[Document], out: Path | None, suffix: str) -> None:
    """Documents as HTML or Markdown to a file, or on the terminal: through rich if somebody looks, else as Markdown."""
    from geartrain import report

    if suffix == ".html":
        emit(report.to_html(documents), out)
    elif out is None and sys.stdout.isatty():
        from rich.console import Console

        report.to_terminal(documents, Console(highlight=False))
    else:
        emit(report.to_markdown(documents), out)


def draw(figure: Any, path: Path, suffix: str) -> None:
    """A figure to a file, whole or not at all."""
    from geartrain.files import write_bytes
    from geartrain.plot import render

    write_bytes(path, render(figure, suffix))
    typer.echo(f"wrote {path}", err=True)


def suffix_of(out: Path | None, allowed: Iterable[str]) -> str:
    """The suffix of an output file, "" without one; others than the allowed ones are refused."""
    suffix = out.suffix.lower() if out else ""
    if suffix and suffix not in allowed:
        raise typer.BadParameter(f"'{suffix}' is no form of output here; use {', '.join(allowed)}", param_hint="-o")
    return suffix


def file_name(text: str, ending: str) -> Path:
    """A file in the current folder called after `text`, with whatever no file name should hold made a hyphen."""
    stem = re.sub(r"[^\w.+-]+", "-", text).strip("-.")[:120]
    return Path(f"{stem or 'train'}{ending}")


def may_write(path: Path, force: bool = False) -> None:
    """Make sure that a result may be written to `path`, before it is worked out.

    An existing file is asked about on a terminal, and refused elsewhere, unless `force`. Raises `GearTrainError` for
    what is no file name, for folders, and for folders that are missing or cannot be written to.
    """
    try:
        trouble = _trouble(path)
        exists = path.exists()
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or str(error)
        trouble, exists = _unnamed(path, why), False
    if trouble is not None:
        raise GearTrainError(trouble)
    if not exists or force:
        return
    if sys.stdin.isatty() and sys.stderr.isatty():
        typer.confirm(f"{path} exists; write over it?", abort=True, err=True)
        return
    raise GearTrainError(
        Problem("the file exists", "nothing is written over unasked", "give --force, or another name", str(path))
    )


def _trouble(path: Path) -> Problem | None:
    """What keeps a file from being written at `path`, its being there already aside."""
    folder, place = path.parent, str(path)
    if path.is_dir():
        return Problem("this is a folder", "a result is one file", f"name a file in it: {path / 'NAME'}", place)
    if path.name in ("", "..") or not path.name.isprintable():
        return _unnamed(path, "a file has a name of printable letters")
    if path.exists() and not path.is_file():
        return Problem("this is no ordinary file", "a result takes a file's place", "name a file", place)
    if not folder.is_dir():
        return Problem("there is no such folder", f"the file would stand in {folder}", "make the folder first", place)
    if not os.access(folder, os.W_OK | os.X_OK):
        return Problem("the folder cannot be written to", "its permissions forbid it", "name another", str(folder))
    return None


def _unnamed(path: Path, why: str) -> Problem:
    return Problem("this is no name for a file", why, "choose a shorter or plainer name", repr(str(path)))


def share(text: str, option: str) -> Fraction:
    """A plain number, a percentage or ppm, as an option gives it; exact."""
    from pydantic_core import PydanticCustomError

    from geartrain.quantity import Quantity

    try:
        found = Quantity.parse(text, "fraction", plain=True)
    except PydanticCustomError as error:
        raise typer.BadParameter(error.message(), param_hint=option) from None
    return found.base


def plural(count: int, noun: str) -> str:
    """`1 loop`, `2 loops`."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def as_json(data: Any) -> str:
    """JSON as this command prints it."""
    return json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False)
