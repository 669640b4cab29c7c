"""The options that a tooth form's fields give its command."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from inspect import Parameter, Signature
from typing import Annotated, Any

import typer

from geartrain.cli.mesh.conjugate_options import own_options


def own_parameters(form: str) -> list[Parameter]:
    """A form's own options, their text left to the form."""
    return [
        Parameter(
            name,
            Parameter.POSITIONAL_OR_KEYWORD,
            default=None,
            annotation=Annotated[kind | None, typer.Option(f"--{name.replace('_', '-')}", help=text)],
        )
        for name, (kind, text) in own_options(form).items()
    ]


def signed(run: Callable[..., Any], parameters: Sequence[Parameter]) -> None:
    """Give a function the parameters that a command line reads it by."""
    run.__signature__ = Signature(list(parameters))  # type: ignore[attr-defined]
    run.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
