"""`--profile` of `geartrain mesh`: the outline of a whole wheel of a pair, to scale, whatever the form of its teeth."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import Sink, emit, sink
from geartrain.cli.option_values import quantity
from geartrain.errors import GearTrainError, Problem

if TYPE_CHECKING:
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.outlines.wheel_outline import BlankSizes, WheelOutline

Profile = Annotated[
    Path | None, typer.Option("--profile", help="Write the outline of a whole wheel, to scale: .svg, .dxf, .csv.")
]
WheelNumber = Annotated[int, typer.Option("--wheel", min=1, max=2, help="With --profile: which wheel, 1 or 2.")]
Bore = Annotated[str | None, typer.Option("--bore", help="With --profile: diameter of the hole.")]
Tolerance = Annotated[str, typer.Option("--tolerance", help="With --profile: how far chords may leave a flank.")]
FINE = "0.001mm"
"""The tolerance where none is given."""


def profile_sink(profile: Path | None, force: bool) -> Sink:
    """Where an outline goes; what cannot be written is refused before the work. Raises `GearTrainError`."""
    from geartrain.drawing.flat_files import OUTLINES

    to = sink(profile, force, option="--profile")
    if to.path is not None and to.suffix not in OUTLINES:
        what = f"'{to.suffix}' is no form of outline"
        raise GearTrainError(Problem(what, "", f"use {', '.join(OUTLINES)}", "--profile"))
    return to


def write_profile(mesh: GearMesh, wheel: int, blank: Mapping[str, str | None], to: Sink) -> list[WheelOutline]:
    """The outline of a wheel, written; none where no file is named. `blank` has its sizes as options give them."""
    if to.path is None:
        return []
    from geartrain.drawing import outline_text

    made = mesh.wheel_outline(wheel, _blank_sizes(mesh.wheels.module, blank))
    emit(outline_text(made, to.suffix), to)
    return [made]


def _blank_sizes(module: float | None, sizes: Mapping[str, str | None]) -> BlankSizes:
    """Sizes in mm, the module in m."""
    from geartrain.teeth.outlines.wheel_outline import BlankSizes

    if module is None:
        why = "an outline is to scale, and nothing gives these wheels a size"
        raise GearTrainError(Problem("there is no module", why, "give for example --module 2mm", "--module"))
    given = {name: 1000 * quantity(f"--{name}", text, "length") for name, text in sizes.items() if text is not None}
    return BlankSizes(1000 * module, **given)
