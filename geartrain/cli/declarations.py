"""Commands on files: `geartrain init`, `format`, `list` and `periods`.

They write a template, convert declarations to short or long form, and list the shipped trains and the table of periods.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from geartrain.cli.common import GOOD, NOT_USABLE, VERDICT, Force, Out, Sink, complain, emit, option_error, sink, tell
from geartrain.errors import GearTrainError, check_choice
from geartrain.wings import wing

TEMPLATES = Path(__file__).resolve().parent / "templates"


def write_template(
    kind: Annotated[
        str | None,
        typer.Argument(help="Template: planetary, differential, gearbox, reducer, clock or orrery.", metavar="KIND"),
    ] = None,
    unit: Annotated[
        Path | None,
        typer.Option("--from", help="Read a gear unit from this REXS file (.rexsj, .rexs or .rexsz) instead."),
    ] = None,
    out: Out = None,
    force: Force = False,
) -> None:
    """Write a small commented declaration that runs without changes, to KIND.yaml in the current folder or to the file
    of -o. With --from, write the declaration of the gear unit in a REXS file, such as gearbox.rexsj.

    Example: `geartrain init planetary -o first.yaml`.
    """
    if (kind is None) == (unit is None):
        what = "neither KIND nor --from is given" if kind is None else "KIND and --from are both given"
        raise option_error("init", what, "give KIND, such as planetary, or --from FILE", "a declaration has one origin")
    # a file in the current folder, so that the printed commands can be pasted
    path = Path(f"{kind or (unit and unit.stem)}.yaml") if out is None else out
    to = sink(path, force)
    if unit is not None:
        text, notes = wing("workshop.rexs.unit_import").declaration_of(unit)
        for note in notes:
            tell(f"note: {note}")
    else:
        check_choice("template", kind or "", sorted(path.stem for path in TEMPLATES.glob("*.yaml")))
        text = (TEMPLATES / f"{kind}.yaml").read_text(encoding="utf-8")
    # `emit` appends the final line feed
    emit(text.removesuffix("\n"), to)
    if to.path is not None:
        tell(f"next: geartrain check {path}; geartrain report {path}; geartrain view {path} -o {path.stem}.html")


def write_style(
    files: Annotated[list[str], typer.Argument(help="YAML declarations to rewrite.", metavar="FILE")],
    long: Annotated[bool, typer.Option("--long", help="Write all entries in long form.")] = False,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; exit with code 1 if a file would change.")
    ] = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Format declarations, with turning pairs grouped by axis and gear pairs as `a ~ b`, or with all entries in long
    form; comments are kept.

    The meaning of the declaration does not change, which is checked before a file is written. Other lines are not
    changed.

    Example: `geartrain format --check train.yaml`.
    """
    if out is not None and check:
        raise option_error("-o", "-o and --check are given together", "omit one of them", "--check writes no file")
    if out is not None and len(files) > 1:
        raise option_error("-o", f"{len(files)} files are given", "give one FILE, or omit -o", "-o writes one file")
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
    tell(f"{'would rewrite' if check else 'rewrote'} {file}: {lines[0]} lines before, {lines[1]} after")
    return VERDICT if check else GOOD


def list_trains(
    evidence: Annotated[
        bool, typer.Option("--evidence", help="List evidence files shipped for `reconstruct`.")
    ] = False,
) -> None:
    """List the shipped trains with their titles.

    Example: `geartrain list --evidence`.
    """
    from geartrain.train.declaration_files import read_declaration, read_evidence, shipped, shipped_evidence

    files, read = (shipped_evidence(), read_evidence) if evidence else (shipped(), read_declaration)
    width = max((len(name) for name in files), default=0)
    emit("\n".join(f"{name:<{width}}  {read(path).title}" for name, path in files.items()))


def list_periods(
    word: Annotated[str, typer.Argument(help="List only names that contain this word.", metavar="WORD")] = "",
) -> None:
    """List the shipped table of astronomical periods, speeds and counts.

    Example: `geartrain periods saros`.
    """
    from geartrain.train.periods import period_table, suggested_period

    units = {"period": "d", "speed": "turns per year", "count": ""}
    rows = [row for row in period_table().values() if word in row.name]
    if not rows:
        why = "only the names in the shipped table are searched"
        raise option_error("", f"no name contains '{word}'", suggested_period(word), why)
    width = max(len(row.name) for row in rows)
    emit("\n".join(f"{row.name:<{width}}  {float(row.value):.12g} {units[row.kind]}  ({row.source})" for row in rows))
