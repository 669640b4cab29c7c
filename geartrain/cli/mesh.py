"""`geartrain mesh`: verdict, motion and losses of a single pair of wheels, and outlines of its wheels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from inspect import signature
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from geartrain.cli.common import (
    GOOD,
    VERDICT,
    Force,
    Json,
    Names,
    Out,
    Sink,
    check_distinct_outputs,
    draw,
    give,
    option_error,
    picture_sink,
    show,
    sink,
)
from geartrain.cli.option_values import Theme, quantity, read_quantity
from geartrain.cli.pair_options import (
    BLANK,
    COUNTS,
    PairRequest,
    at_parameter,
    describe_parameters,
    parameters_of,
    read_assignments,
    read_helix,
    read_module,
    read_shaft_angle,
    read_wheels,
    write_profile,
)
from geartrain.cli.triangular_pair import read_operation, sweep
from geartrain.errors import GearTrainError, check_choice
from geartrain.report.pair_page import collect_pair, describe_pair
from geartrain.teeth.any_tooth_form import TOOTH_FORMS, form_names, tooth_form
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
from geartrain.wings import wing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from geartrain.scene.palette import ThemeName
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.tooth_form import ToothForm

FORMS = tuple(name for name in TOOTH_FORMS if name != "ideal")
DEFAULT = "involute"
_TRIANGULAR = ("backwards", "inertia", "load", "vary", "objective", "free", "within", "cutting", "at")
"""Options of `geartrain mesh` that apply only to triangular teeth."""
_COMPARED = (
    *("z1", "z2", "form", "parameter", "compare", "internal", "shaft_angle"),
    *("plot", "json", "theme", "out", "force"),
)
"""Options of `geartrain mesh` that apply to a comparison of tooth forms."""
_teeth = partial(typer.Option, rich_help_panel="Triangular teeth")
_outline = partial(typer.Option, rich_help_panel="Outline of one wheel")
_output = partial(typer.Option, rich_help_panel="Output")


def run(
    context: typer.Context,
    z1: Annotated[int | None, typer.Argument(help="Tooth count of the first wheel.", metavar="Z1")] = None,
    z2: Annotated[int | None, typer.Argument(help="Tooth count of the second wheel.", metavar="Z2")] = None,
    form: Annotated[
        Names, typer.Option("--form", help=f"Tooth form: {', '.join(FORMS)}; may be repeated with --compare.")
    ] = None,
    parameter: Annotated[
        Names,
        typer.Option(
            "-p",
            "--parameter",
            metavar="KEY=VALUE",
            help="Parameter of the tooth form, such as pressure_angle=25deg; may be repeated. --keys lists them.",
        ),
    ] = None,
    keys: Annotated[bool, typer.Option("--keys", help="List the parameters of the tooth form and exit.")] = False,
    compare: Annotated[
        bool,
        typer.Option(
            "--compare",
            help="Compare losses and stresses of several tooth forms (default: six forms) with the 20 degree involute. "
            "-p then accepts only arcs and pressure_angle.",
        ),
    ] = False,
    internal: Annotated[bool, typer.Option("--internal", help="Make the second wheel a ring gear.")] = False,
    shaft_angle: Annotated[
        str | None, typer.Option("--shaft-angle", help="Make bevel wheels with this shaft angle, such as 90deg.")
    ] = None,
    helix: Annotated[
        str | None, typer.Option("--helix", help="Helix angle, such as 20deg; all modules are then normal modules.")
    ] = None,
    module: Annotated[
        str | None, typer.Option("--module", help="Module (pitch diameter divided by tooth count), such as 2mm.")
    ] = None,
    friction: Annotated[
        str,
        typer.Option(
            "--friction",
            help="Coefficient of friction, or a friction law: buckingham, dokos, "
            "'stribeck,static=0.2,...' or 'table,...'.",
        ),
    ] = "0",
    driver: Annotated[int, typer.Option("--driver", min=1, max=2, help="Number of the driving wheel, 1 or 2.")] = 1,
    rate: Annotated[str | None, typer.Option("--rate", help="Speed of the driving wheel, such as '1 turn/s'.")] = None,
    backwards: Annotated[
        bool, _teeth("--backwards", help="Turn the driving wheel backwards, with contact on the coast flanks.")
    ] = False,
    inertia: Annotated[
        str | None, _teeth("--inertia", help="Moment of inertia of the driven wheel, such as '1 kg mm2'.")
    ] = None,
    load: Annotated[str | None, _teeth("--load", help="Load torque on the driven wheel, such as '1 N mm'.")] = None,
    vary: Annotated[
        Names,
        _teeth(
            "--vary",
            metavar="NAME=FIRST:LAST:COUNT",
            help="Tabulate results for a range of friction, z1, z2 or a key listed by --keys; may be given twice.",
        ),
    ] = None,
    objective: Annotated[
        str | None,
        _teeth(
            "--objective",
            help="Find sizes that minimise loss, error or impact, or maximise the jam margin (jam); give one "
            "objective, or two separated by a comma.",
        ),
    ] = None,
    free: Annotated[
        Names,
        _teeth(
            "--free",
            metavar="NAME[=LOW:HIGH]",
            help="With --objective: parameter to vary: radii (ratio of radii over ratio of tooth counts), window "
            "(position in the clearance window, 0 to 1) or half_angle; may be repeated; default: radii.",
        ),
    ] = None,
    within: Annotated[
        Names,
        _teeth(
            "--within",
            metavar="NAME=LIMIT",
            help="With --objective: limit on loss, error, impact, jam, window_width, backlash or stops; "
            "may be repeated.",
        ),
    ] = None,
    cutting: Annotated[
        Names,
        _teeth(
            "--cutting",
            metavar="KIND=SIZE",
            help="With --within stops=5%: cutting error, given as in montecarlo, such as 'pitch_deviation=1 %'.",
        ),
    ] = None,
    profile: Annotated[
        Path | None,
        _outline(
            "--profile", metavar="FILE", help="Write the outline of a whole wheel to scale, as .svg, .dxf or .csv."
        ),
    ] = None,
    wheel: Annotated[int, _outline("--wheel", min=1, max=2, help="Number of the wheel to write, 1 or 2.")] = 1,
    blank: Annotated[
        Names,
        _outline(
            "--blank",
            metavar="KEY=LENGTH",
            help="Size of the wheel: bore, tolerance (of chords; default: 0.001mm), clearance (bottom clearance), "
            "fillet or rim; may be repeated.",
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        _output(
            "--plot",
            metavar="FILE",
            help="Plot flanks, path of contact and losses; for forms without a path of contact, transmission "
            "function and efficiency; with --vary or --objective, the sweep or the designs.",
        ),
    ] = None,
    at: Annotated[
        str | None,
        _output(
            "--at",
            metavar="ANGLE",
            help="With --plot: draw triangular wheels in contact, with the driving tooth at this angle from the line "
            "of centres.",
        ),
    ] = None,
    json: Json = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Analyse a single pair of wheels over one pitch: verdict, motion, losses, stresses and outlines.

    Example: `geartrain mesh 24 36 --form cycloidal -p rolling_fraction=0.4 --friction 0.1`.
    """
    to = sink(out, force, (".csv", ".json") if vary else (".md", ".html", ".json"))
    if compare and not keys:
        _refuse(context, {*_COMPARED}, "a comparison")
        _compare(_counts(z1, z2), form, parameter or (), (internal, shaft_angle), (to, plot, theme, force), json)
    name, *others = form or [DEFAULT]
    check_choice("tooth form", name, FORMS if name in FORMS else [each for each in form_names() if each != "ideal"])
    model = tooth_form(name)
    if keys:
        show([describe_parameters(name, model)], to)
        return
    if others:
        raise option_error("--form", "several tooth forms are given", "give one --form, or add --compare")
    _refuse(context, _applicable(name, model), f"{name} teeth")
    hint = f"`geartrain mesh --form {name} --keys` lists the parameters of {name} teeth"
    angle = read_shaft_angle(internal, shaft_angle)
    pair = PairRequest(
        model,
        _counts(z1, z2),
        read_assignments(parameter or (), [*parameters_of(model)], "-p", hint),
        read_module(module),
        friction,
        driver,
        rate,
        internal,
        angle,
        read_helix(helix, angle),
    )
    sizes = read_assignments(blank or (), BLANK if model.conjugate else BLANK[:2], "--blank")
    from geartrain.drawing.flat_files import OUTLINES

    picture, outlined = picture_sink(plot, force, theme), sink(profile, force, OUTLINES, "--profile")
    check_distinct_outputs(to, outlined, picture)
    if objective is not None or free or within or cutting:
        question = wing("workshop.sizes.verb")
        question = question.SizeQuestion(objective, tuple(free or ()), tuple(within or ()), tuple(cutting or ()))
        question.check({"--vary": vary, "--at": at, "--profile": profile})
        question.answer(pair, to, picture, json)
    if vary:
        for option, given in {"--at": at, "--profile": profile}.items():
            if given is not None:
                raise option_error(
                    option,
                    f"{option} and --vary are given together",
                    f"omit {option} or --vary",
                    f"--vary evaluates several pairs, but {option} applies to a single pair",
                )
        sweep(pair, vary, picture, json, to)
        return
    mesh, operation = pair.mesh(), None
    if isinstance(mesh, TriangularMesh):
        operation = read_operation(inertia, rate, load)
        mesh = replace(mesh, transmission=mesh.transmission.reversed_motion()) if backwards else mesh
    outlines = write_profile(mesh, wheel, sizes, outlined)
    give(to, json, lambda: collect_pair(mesh, outlines, operation), lambda: [describe_pair(mesh, outlines, operation)])
    if plot is not None:
        draw(_figure(mesh, at), picture)
    raise typer.Exit(GOOD if not mesh.faults else VERDICT)


def _counts(z1: int | None, z2: int | None) -> tuple[int, int]:
    if z1 is None or z2 is None:
        raise option_error(COUNTS, "the tooth counts are missing", "give two tooth counts, such as 24 36")
    return z1, z2


def _applicable(name: str, model: type[ToothForm]) -> set[str]:
    """Return the names of the options that apply to a tooth form."""
    triangular = name == "triangular"
    left_out = set() if triangular else {*_TRIANGULAR}
    left_out |= set() if model.conjugate else {"shaft_angle"}
    left_out |= set() if model.conjugate or triangular else {"internal"}
    left_out |= set() if name == "involute" else {"helix"}
    return {*signature(run).parameters} - left_out


def _refuse(context: typer.Context, applicable: set[str], what: str) -> None:
    """Raise `QuestionError` if an option on the command line does not apply."""
    for option in context.command.params:
        source = context.get_parameter_source(option.name or "")
        # defaults of options that do not apply are not errors
        if option.name not in applicable and source is not None and source.name == "COMMANDLINE":
            name = option.opts[0]
            raise option_error(name, f"this option does not apply to {what}", f"omit {name}")


def _figure(mesh: GearMesh, at: str | None) -> Figure:
    """Plot flanks, path of contact and losses. If the pair has no path of contact, plot its transmission function and
    efficiency.

    With `at`, draw triangular teeth at that driver angle.
    """
    from geartrain.drawing import shapes_figure, teeth_figure, transmission_figure, triangular_figure
    from geartrain.teeth.rubbed_transmission import pair_friction

    if isinstance(mesh, TriangularMesh):
        if at is not None:
            return teeth_figure(mesh.transmission, quantity("--at", at, "angle"))
        return triangular_figure(mesh.transmission, pair_friction(mesh.wheels))
    if mesh.path is not None:
        return shapes_figure({mesh.form: mesh.path})
    driver, driven = mesh.counts
    return transmission_figure(mesh.losses, f"{mesh.tooth_form.words} teeth, {driver} drives {driven}")


# ----------------------------------------------------------------------------------------------------------- comparison


def _compare(
    teeth: tuple[int, int],
    forms: Sequence[str] | None,
    parameters: Sequence[str],
    axes: tuple[bool, str | None],
    files: tuple[Sink, Path | None, ThemeName, bool],
    json: bool,
) -> NoReturn:
    """Compare the loss, stress, heat, flash temperature and tooth depth of several tooth forms with those of the 20
    degree involute, then exit.

    All forms have the same pair and the same arcs of approach and recess.
    """
    from geartrain.report.conjugate_pair_page import describe_form_comparison
    from geartrain.teeth.form_comparison import USUAL, compare_forms

    to, plot, theme, force = files
    picture = picture_sink(plot, force, theme)
    check_distinct_outputs(to, picture)
    own = read_assignments(parameters, ("arcs", "pressure_angle"), "-p")
    wheels = read_wheels(teeth, *axes)
    angle = own.get("pressure_angle")
    try:
        found = compare_forms(
            wheels,
            list(dict.fromkeys(forms or USUAL)),
            _arcs(own.get("arcs", "0.5,0.5")),
            None if angle is None else read_quantity("-p pressure_angle", angle, "angle"),
        )
    except GearTrainError as error:
        raise at_parameter(error, "--form") from None
    give(to, json, lambda: found, lambda: [describe_form_comparison(found)])
    if plot is not None:
        from geartrain.drawing import shapes_figure

        draw(shapes_figure({form.name: form.path for form in found.forms if form.path and form.runs}), picture)
    raise typer.Exit(GOOD if all(form.runs for form in found.forms) else VERDICT)


def _arcs(text: str) -> tuple[float, float]:
    """Parse the arcs of approach and recess [pitch]; a single number sets both."""
    from geartrain.teeth.form_comparison import arcs_error

    parts = text.split(",")
    try:
        first, second = float(parts[0]), float(parts[-1])
    except ValueError:
        raise arcs_error(text) from None
    if len(parts) > 2:
        raise arcs_error(text)
    return first, second
