"""`geartrain list`: the shipped trains, or the shipped evidence."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import emit


def run(
    evidence: Annotated[
        bool, typer.Option("--evidence", help="The evidence of trains to be found, for `reconstruct`.")
    ] = False,
) -> None:
    """List the shipped trains with their titles."""
    from geartrain.train.declaration_files import read_declaration, read_evidence, shipped, shipped_evidence

    files, read = (shipped_evidence(), read_evidence) if evidence else (shipped(), read_declaration)
    width = max((len(name) for name in files), default=0)
    emit("\n".join(f"{name:<{width}}  {read(path).title}" for name, path in files.items()))
