"""`geartrain list`: the shipped trains."""

from __future__ import annotations

from geartrain.cli.common import emit


def run() -> None:
    """List the shipped trains with their titles."""
    from geartrain.analysis.loader import load
    from geartrain.train.declaration_files import shipped

    width = max((len(name) for name in shipped()), default=0)
    lines = [f"{name:<{width}}  {load(path).declaration.title}" for name, path in shipped().items()]
    emit("\n".join(lines))
