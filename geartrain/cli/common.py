"""Arguments, exit codes and output functions that the commands share."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.errors import GearTrainError, Problem, QuestionError, printable

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.report.document import Document
    from geartrain.scene.palette import ThemeName

# 130 = 128 + SIGINT, as shells report a process that this signal ended
GOOD, VERDICT, NOT_USABLE, INTERRUPTED = 0, 1, 2, 130
PICTURES = (".svg", ".png", ".pdf")

File = Annotated[str, typer.Argument(help="A YAML declaration, or the name of a shipped train.", metavar="FILE")]
Files = Annotated[list[str], typer.Argument(help="YAML declarations, or names of shipped trains.", metavar="FILE")]
Out = Annotated[
    Path | None,
    typer.Option(
        "--output-file",
        "-o",
        metavar="FILE",
        help="Write to FILE in the format of its suffix; - or -.SUFFIX writes to standard output.",
    ),
]
Force = Annotated[bool, typer.Option("--force", help="Overwrite existing files.")]
Json = Annotated[bool, typer.Option("--json", help="Print the result as JSON.")]
Fast = Annotated[
    bool | None,
    typer.Option("--fast/--no-fast", help="Compile inner loops with numba; default: only in long runs."),
]
StateName = Annotated[str | None, typer.Option("--state", help="State to analyse; default: all states.")]
FirstState = Annotated[str | None, typer.Option("--state", help="State to analyse; default: the first.")]
Names = list[str] | None
Without = Annotated[
    Names,
    typer.Option(
        "--without", help="Omit a redundant gear pair, so that the wheels of a closed loop can turn; may be repeated."
    ),
]
Cutting = Annotated[
    Names,
    typer.Option(
        "--cutting",
        metavar="KIND=SIZE",
        help="Replace a declared cutting error: KIND=SIZE or NAME.KIND=SIZE, such as 'tip=3 %'; may be repeated.",
    ),
]
Seed = Annotated[int, typer.Option("--seed", min=0, help="Random seed.")]


def load_all(files: list[str]) -> list[GearTrain]:
    """Load all trains. If files cannot be read, raise one `GearTrainError` that lists the problems in every file."""
    from geartrain.analysis.gear_train import load

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


def is_sound(train: GearTrain, state: str | None) -> bool:
    """Return True if the speeds of a state (by default the first) meet all expectations and the teeth can turn."""
    return bool(train.solve(train.declaration.state_or_first(state))) and not train.mechanics.faults


def exit_code(sound: bool, to: Sink) -> int:
    """Return 0 if trains have no failures (`sound`), else 1; in that case, print a note if a file was written."""
    if not sound and to.path is not None:
        tell("a train is not determined, or not as expected: `geartrain check` lists why (exit code 1)")
    return GOOD if sound else VERDICT


def chosen_states(train: GearTrain, state: str | None) -> tuple[str | None, ...]:
    """Return only the given state, or, if it is None, all states with determined speeds; print notes on the others."""
    if state is not None:
        return (state,)
    for case in train.kinematics.cases.values():
        for problem in case.problems:
            tell(f"note: state '{case.state}' is omitted: {problem}")
    return train.kinematics.usable_states


def option_error(place: str, what: str, fix: str, why: str = "") -> QuestionError:
    """Return an error with the option `place` as location, the problem `what`, its cause `why` and the remedy `fix`."""
    return QuestionError(Problem(what, why, fix, place))


def tell(text: str) -> None:
    """Print a line on standard error, such as a note or the name of a written file."""
    typer.echo(printable(text), err=True)


def complain(error: GearTrainError) -> None:
    """Print every problem that an error contains on standard error."""
    for problem in error.problems:
        tell(f"error: {problem}")


@dataclass(frozen=True)
class Sink:
    """Destination of a result: a file, or standard output."""

    path: Path | None = None
    """Path of the file; None for standard output."""
    force: bool = False
    """True to overwrite an existing file."""
    plain: bool = False
    """True if the user wrote `-` for standard output, which then receives the content of the file."""
    form: str = ""
    """Suffix that sets the format of standard output, such as `.csv` in `-.csv`; empty if the user gave no suffix."""
    theme: ThemeName = "light"
    """Colour theme of a picture: light, dark or print."""

    @property
    def suffix(self) -> str:
        """Suffix of the file or of standard output, in lower case; an empty string if there is no suffix."""
        return self.path.suffix.lower() if self.path is not None else self.form

    def write(self, data: bytes, said: str = "") -> None:
        """Write a result to standard output or atomically to the file; then print `wrote FILE` and the text `said`."""
        if self.path is None:
            # text printed so far must precede the bytes
            sys.stdout.flush()
            sys.stdout.buffer.write(data)
            sys.stdout.buffer.flush()
            return
        from geartrain.numerics.files import write_bytes

        write_bytes(self.path, data, self.force)
        tell(f"wrote {self.path}{said}")


STANDARD = Sink()


def is_standard(out: Path) -> bool:
    """Return True if a path denotes standard output: `-`, or `-` with a suffix such as `-.csv`."""
    return out.parent == Path() and out.stem == "-"


def sink(out: Path | None, force: bool, allowed: Collection[str] = (), option: str = "-o") -> Sink:
    """Return the destination of a result, after checking that it can be written.

    allowed   allowed suffixes; all suffixes are allowed if empty

    Raises `GearTrainError` if the file cannot be written, or if packages that an HTML page needs are not installed.
    """
    if out is None:
        return STANDARD
    if is_standard(out):
        if option != "-o":
            why = "standard output is reserved for the result of the command"
            raise option_error(option, f"{option} cannot write to standard output", "give a file name", why)
        return Sink(plain=True, form=suffix_of(out, allowed, option))
    from geartrain.numerics.files import destination

    # checked before the computation, which may take long
    if suffix_of(out, allowed, option) == ".html" and ".html" in allowed:
        from geartrain.report.html_page import check_pages

        check_pages()
    destination(out, force)
    return Sink(out, force)


def picture_sink(out: Path | None, force: bool, theme: ThemeName, option: str = "--plot") -> Sink:
    """Return the destination and theme of a picture. Raise `GearTrainError` if the picture cannot be written there."""
    return replace(sink(out, force, PICTURES, option), theme=theme)


def check_distinct_outputs(*sinks: Sink) -> None:
    """Raise `GearTrainError` if two results of one command would be written to the same file."""
    taken: set[Path] = set()
    for each in sinks:
        if each.path is None:
            continue
        from geartrain.numerics.files import destination

        real = destination(each.path, each.force)
        if real in taken:
            what, why = "two results are written to the same file", "the second would overwrite the first"
            raise option_error(str(each.path), what, "give two different files", why)
        taken.add(real)


def emit(text: str, out: Sink = STANDARD) -> None:
    """Write text atomically to the file of a destination, or to standard output. Control characters are escaped."""
    text = printable(text)
    text = text if text.endswith("\n") else text + "\n"
    if out.path is None:
        typer.echo(text, nl=False)
    else:
        out.write(text.encode("utf-8"))


def show(documents: Sequence[Document], out: Sink, suffix: str | None = None) -> None:
    """Write documents to an HTML or Markdown file, or print them at the terminal's width (80 columns in a pipe)."""
    from geartrain.report.text import to_markdown, to_terminal, to_text

    if (out.suffix if suffix is None else suffix) == ".html":
        from geartrain.report.html_page import to_html

        emit(to_html(documents), out)
    # `-o -` requests the content of a file, so it is Markdown on a terminal too
    elif out == STANDARD and sys.stdout.isatty():
        from rich.console import Console

        # without highlighting: rich would colour every number
        to_terminal(documents, Console(highlight=False))
    elif out == STANDARD:
        emit(to_text(documents))
    else:
        emit(to_markdown(documents), out)


def give(out: Sink, json: bool, data: Callable[[], Any], documents: Callable[[], Sequence[Document]]) -> None:
    """Write a result as JSON if --json or the suffix requests it, else as documents. The other form is not computed."""
    if json or out.suffix == ".json":
        emit(as_json(data()), out)
    else:
        show(documents(), out)


def draw(figure: Any, out: Sink) -> None:
    """Write a figure atomically to a file. The default format is .svg."""
    from geartrain.drawing import render

    out.write(render(figure, out.suffix or ".svg", theme=out.theme))


def suffix_of(out: Path | None, allowed: Iterable[str], option: str = "-o") -> str:
    """Return the suffix of an output file, or "" if it has none; raise `QuestionError` if it is not allowed."""
    suffix = out.suffix.lower() if out else ""
    if suffix and allowed and suffix not in allowed:
        raise option_error(option, f"'{suffix}' is not an output format of this option", f"use {', '.join(allowed)}")
    return suffix


def file_name(text: str, ending: str) -> Path:
    """Return a file name: `text`, in which hyphens replace unsuitable characters, followed by `ending`."""
    # at most 120 characters: file systems limit names to 255 bytes
    stem = re.sub(r"[^\w.+-]+", "-", text).strip("-.")[:120]
    return Path(f"{stem or 'train'}{ending}")


def as_json(data: Any) -> str:
    """Return results as a JSON string, in which control characters are escaped."""
    from geartrain.numerics.results import plain

    data = plain(data)
    # JSON has no NaN and no infinity: `plain` data must not contain them
    text = json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False)
    # ASCII output escapes also the control characters beyond ASCII
    return text if printable(text) == text else json.dumps(data, indent=2, allow_nan=False)


def table_text(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return rows that have the same keys as CSV text with a header line; an empty string if `rows` is empty."""
    from geartrain.numerics.files import csv_text

    return csv_text(list(rows[0]), [list(row.values()) for row in rows]).rstrip("\n") if rows else ""
