"""`geartrain mesh compare`: what several tooth forms cost, beside the 20 degree involute of the same pair and arcs."""

from __future__ import annotations

from math import pi, radians
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import (
    GOOD,
    PICTURES,
    VERDICT,
    Force,
    Json,
    Out,
    check_distinct_outputs,
    draw,
    give,
    sink,
)
from geartrain.cli.mesh.conjugate_options import (
    NAMES,
    ConjugateOptions,
    FormOptions,
    own_options,
    pair,
    read_form,
    read_wheels,
    unknown_form,
)
from geartrain.cli.option_values import quantity
from geartrain.errors import GearTrainError, Problem

if TYPE_CHECKING:
    from geartrain.report.tooth_form_comparison import FormComparison, MeasuredForm
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair

_BASE = 20.0  # deg
_USUAL = "involute,uniform_stress,uniform_temperature_b,least_friction,cycloidal,lantern"


def run(
    teeth: Annotated[tuple[int, int], typer.Option("--teeth", help="Teeth of the driving and the driven wheel.")],
    forms: Annotated[str, typer.Option("--forms", help=f"With commas, of {', '.join(NAMES)}.")] = _USUAL,
    pressure_angle: Annotated[
        str | None,
        typer.Option("--pressure-angle", help="Of involute, uniform_stress and least_friction; default 20, 20, 25deg."),
    ] = None,
    arcs: Annotated[str, typer.Option("--arcs", help="Approach and recess in pitches.")] = "0.5,0.5",
    bevel: Annotated[str | None, typer.Option("--bevel", help="Angle between the axes, such as 90deg.")] = None,
    internal: Annotated[bool, typer.Option("--internal", help="The second wheel is a ring.")] = False,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Draw flanks, paths of contact and costs of all forms to this file.")
    ] = None,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Loss, stress, heat, flash, depth of tooth forms as ratios to the 20 degree involute of the same pair and arcs."""
    from geartrain.report.tooth_form_comparison import compared_data, compared_document

    to, picture = sink(out, force, (".md", ".html", ".json")), sink(plot, force, PICTURES, "--plot")
    check_distinct_outputs(to, picture)
    asked = read_wheels(teeth, internal, bevel)
    found = _compared(asked, _names(forms), _arcs(arcs), _angle(pressure_angle), pressure_angle)
    give(to, json, lambda: compared_data(found), lambda: [compared_document(found)])
    if plot is not None:
        from geartrain.drawing import shapes_figure

        draw(shapes_figure({form.name: form.path for form in found.forms if form.path and form.runs}), picture)
    raise typer.Exit(GOOD if all(form.runs for form in found.forms) else VERDICT)


def _names(text: str) -> list[str]:
    names = list(dict.fromkeys(part.strip() for part in text.split(",") if part.strip()))
    if not names:
        raise GearTrainError(Problem("no form is named", "", f"use some of: {', '.join(NAMES)}", "--forms"))
    for name in names:
        if name not in NAMES:
            raise unknown_form(name)
    return names


def _arcs(text: str) -> tuple[float, float]:
    """Approach and recess in pitches."""
    parts = text.split(",")
    try:
        first, second = float(parts[0]), float(parts[-1])
    except ValueError:
        first = second = -1.0
    if len(parts) > 2 or not 0 <= min(first, second) <= max(first, second) <= 100 or first + second <= 0:
        fix = "give those of approach and recess in pitches, such as 0.5,0.5; together 1 or more"
        raise GearTrainError(Problem(f"arcs {text} are none", "", fix, "--arcs"))
    return first, second


def _angle(text: str | None) -> float | None:
    """A pressure angle that all forms can have (rad)."""
    if text is None:
        return None
    angle = quantity("--pressure-angle", text, "angle")
    if not 0 < angle < pi / 4:
        why = "at 45 deg and above teeth of uniform stress are no longer determined by it"
        fix = "give one between 0 and 45 deg; 20 deg is usual"
        raise GearTrainError(Problem(f"a pressure angle of {text} is out of range", why, fix, "--pressure-angle"))
    return angle


# ------------------------------------------------------------------------------------------------------------ the forms


def _compared(
    asked: ConjugateOptions, names: list[str], arcs: tuple[float, float], angle: float | None, text: str | None
) -> FormComparison:
    from geartrain.report.tooth_form_comparison import FormComparison

    base = _shaped("involute", _involute(asked, arcs, radians(_BASE)))
    if not base.runs:
        raise _no_base(base)
    found = []
    for name in names:
        if name == "involute":
            found.append(_shaped(name, _involute(asked, arcs, angle or radians(_BASE))))
        else:
            found.append(_made(name, asked, arcs, text))
    pins = next((form.path for form in found if form.name == "lantern" and form.runs and form.path), None)
    if pins is not None and arcs[0]:
        # the pins work on one side only: the involute with their arcs tells what is due to these
        beside = (pins.arcs[0] / pins.pitch.p, pins.arcs[1] / pins.pitch.p)
        found.append(_shaped("involute, recess only", _involute(asked, beside, angle or radians(_BASE))))
    matched = (
        f"Matched: arcs, {arcs[0]:g} pitches of approach and {arcs[1]:g} of recess"
        + ("; the pins of a lantern have all of it in recess, beyond what they cut off" if "lantern" in names else "")
        + ("; of uniform temperature also the working depth" if any("temperature" in name for name in names) else "")
        + ". Two loads: one pair of teeth bears all, or those in contact share it; first order in friction."
    )
    return FormComparison(base, tuple(found), matched)


def _no_base(base: MeasuredForm) -> GearTrainError:
    """What keeps the involute with which forms are compared from running; its pressure angle is not to choose."""
    what = "the 20 deg involute, with which forms are compared, cannot run: "
    fixes = (fault.fix.partition(", or ")[0] for fault in base.faults)
    return GearTrainError(
        Problem(what + fault.what, fault.why, f"{fix}, or give other teeth", "--arcs")
        for fault, fix in zip(base.faults, fixes, strict=True)
    )


def _involute(asked: ConjugateOptions, arcs: tuple[float, float], psi: float) -> ConjugatePair:
    """An involute pair with given arcs, one of which may be negative, whatever addenda they take."""
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.conjugate.optimal_sides import involute
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact as Contact

    pitch = asked.wheels.pitch
    real = (arcs[0] * pitch.p, arcs[1] * pitch.p)
    approach, recess = (involute(max(arc, 0.0), psi) for arc in real)
    return ConjugatePair(Contact(pitch, approach, recess, real), (pitch.p / 4, pitch.p / 4))


def _made(name: str, asked: ConjugateOptions, arcs: tuple[float, float], angle: str | None) -> MeasuredForm:
    from geartrain.report.tooth_form_comparison import MeasuredForm

    reading = name[-1] if name.startswith("uniform_temperature_") else None
    form = name[:-2] if reading else name
    given: FormOptions = {"arcs": ",".join(map(repr, arcs)), "reading": reading}
    if "pressure_angle" in own_options(form):
        given["pressure_angle"] = angle
    try:
        if form == "lantern":
            given["arcs"] = f"0,{sum(arcs) + _lost(asked)!r}"
        return _shaped(name, pair(read_form(form, given), asked))
    except GearTrainError as error:
        return MeasuredForm(name, None, None, error.problems)


def _lost(asked: ConjugateOptions) -> float:
    """What the pins of a lantern cut off the recess, in pitches."""
    found = pair(read_form("lantern", {}), asked)
    return float(max(-found.arcs[0], 0.0) / found.path.pitch.p * (1 + 1e-8))


def _shaped(name: str, found: ConjugatePair) -> MeasuredForm:
    from geartrain.report.tooth_form_comparison import MeasuredForm
    from geartrain.teeth.conjugate.path_costs import measure

    return MeasuredForm(name, found.path, None if found.faults else measure(found.path), found.faults)
