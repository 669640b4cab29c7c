"""`geartrain init`: a declaration to begin with."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from geartrain.cli.common import Force, Out, emit, sink, tell
from geartrain.errors import check_choice

TEMPLATES = Path(__file__).resolve().parent / "templates"


def run(
    kind: Annotated[
        str, typer.Argument(help="planetary, differential, gearbox, reducer, clock or orrery.", metavar="KIND")
    ],
    out: Out = None,
    force: Force = False,
) -> None:
    """Write a small declaration with comments that runs as it is: KIND.yaml here, or where -o says."""
    kinds = sorted(path.stem for path in TEMPLATES.glob("*.yaml"))
    check_choice("template", kind, kinds)
    path = Path(f"{kind}.yaml") if out is None else out
    to = sink(path, force)
    emit((TEMPLATES / f"{kind}.yaml").read_text(encoding="utf-8").removesuffix("\n"), to)
    if to.path is not None:
        tell(f"next: geartrain check {path}; geartrain report {path}; geartrain view {path} -o {path.stem}.html")
