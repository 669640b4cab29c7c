"""`geartrain format`: turning pairs and gear pairs in short forms, or in long ones."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from geartrain.cli.common import GOOD, NOT_USABLE, VERDICT, Force, Out, Sink, complain, emit, sink, tell
from geartrain.errors import GearTrainError


def run(
    files: Annotated[list[str], typer.Argument(help="YAML declarations, which are rewritten.", metavar="FILE")],
    long: Annotated[bool, typer.Option("--long", help="Write long forms.")] = False,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; exit with 1 if something would change.")
    ] = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Write turning pairs by axis and gear pairs as `a ~ b`, or all of them long; comments stay with their entries.

    What is declared stays the same, which is checked before a file is written. Other lines are left as they are.
    """
    if out is not None and (len(files) > 1 or check):
        raise typer.BadParameter("-o is for one file, which is then left as it is", param_hint="-o")
    to = None if out is None else sink(out, force)
    worst = GOOD
    for file in files:
        worst = max(worst, _format(Path(file), long, check, to))
    raise typer.Exit(worst)


def _format(file: Path, long: bool, check: bool, to: Sink | None) -> int:
    from geartrain.numerics.files import write_text
    from geartrain.train.declaration_files import formatted

    try:
        text, new = formatted(file, long)
        if to is not None:
            emit(new.removesuffix("\n"), to)
            return GOOD
        if new == text:
            tell(f"{file}: nothing to change")
            return GOOD
        if not check:
            write_text(file, new, force=True)
    except GearTrainError as error:
        complain(error)
        return NOT_USABLE
    lines = len(text.splitlines()), len(new.splitlines())
    tell(f"{'would rewrite' if check else 'rewrote'} {file}: {lines[0]} lines, {lines[1]} now")
    return VERDICT if check else GOOD
