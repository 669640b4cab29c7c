"""The options of `geartrain mesh FORM`: those that all forms have, and those that a form's fields give its command."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from inspect import Parameter, Signature
from pathlib import Path
from typing import Annotated, Any

import typer

from geartrain.cli.common import PICTURES, Sink, check_distinct_outputs, sink
from geartrain.cli.mesh.conjugate_options import own_options
from geartrain.errors import GearTrainError, Problem

Friction = Annotated[str, typer.Option("--friction", help="Coefficient of friction.")]
Driver = Annotated[int, typer.Option("--driver", min=1, max=2, help="Which wheel drives, 1 or 2.")]
Backlash = Annotated[
    str | None, typer.Option("--backlash", help="Play on the pitch circle, in modules or with a unit.")
]
Module = Annotated[str | None, typer.Option("--module", help="Pitch diameter over teeth, such as 2mm.")]
Profile = Annotated[
    Path | None, typer.Option("--profile", help="Write the outline of a whole wheel, to scale: .svg, .dxf, .csv.")
]
ProfiledWheel = Annotated[int, typer.Option("--wheel", min=1, max=2, help="With --profile: which wheel, 1 or 2.")]
Bore = Annotated[str | None, typer.Option("--bore", help="With --profile: diameter of the hole.")]


def form_command(form: str, common: Callable[..., None], run: Callable[..., None], tells: str) -> Callable[..., None]:
    """The command of a form: `common`'s options, after the first its own, handed to `run(form, own, **common)`."""

    def command(**given: Any) -> None:
        own = {name: given.pop(name) for name in own_options(form)}
        run(form, own, **given)

    first, *rest = Signature.from_callable(common, eval_str=True).parameters.values()
    signed(command, [first, *own_parameters(form), *rest])
    command.__doc__ = f"{tells} of a pair with {form.replace('_', '-')} teeth."
    return command


def pair_sinks(out: Path | None, plot: Path | None, profile: Path | None, force: bool) -> tuple[Sink, Sink, Sink]:
    """Where the page, the picture and the outline of a pair go; what cannot be written is refused before the work."""
    from geartrain.export.flat_files import OUTLINES

    to, picture = sink(out, force, (".md", ".html", ".json")), sink(plot, force, PICTURES, "--plot")
    outlined = sink(profile, force, option="--profile")
    if outlined.path is not None and outlined.suffix not in OUTLINES:
        what = f"'{outlined.suffix}' is no form of outline"
        raise GearTrainError(Problem(what, "", f"use {', '.join(OUTLINES)}", "--profile"))
    check_distinct_outputs(to, outlined, picture)
    return to, picture, outlined


def no_scale() -> GearTrainError:
    """What is said of an outline of wheels without a module."""
    why = "an outline is to scale, and nothing gives these wheels a size"
    return GearTrainError(Problem("there is no module", why, "give for example --module 2mm", "--module"))


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
