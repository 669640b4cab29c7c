"""`geartrain mesh`: verdict, motion and losses of a single pair of wheels, and outlines of its wheels."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from inspect import signature
from math import isfinite, nan, prod
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import (
    GOOD,
    VERDICT,
    Force,
    Json,
    Names,
    Out,
    Sink,
    as_json,
    check_distinct_outputs,
    draw,
    emit,
    give,
    option_error,
    picture_sink,
    show,
    sink,
    tell,
)
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import Theme, quantity, read_quantity
from geartrain.cli.pair_options import (
    BLANK,
    COUNTS,
    PAIR,
    PairRequest,
    at_parameter,
    describe_parameters,
    parameters_of,
    read_assignments,
    read_helix,
    read_module,
    read_pair_friction,
    read_shaft_angle,
    read_wheels,
    write_profile,
)
from geartrain.errors import GearTrainError, check_choice, suggest
from geartrain.report.pair_page import collect_pair, describe_pair
from geartrain.teeth.any_tooth_form import TOOTH_FORMS, form_names, tooth_form
from geartrain.teeth.triangular.triangular_form import Triangular
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
from geartrain.wings import wing

if TYPE_CHECKING:
    from geartrain.dynamics.motion.pair_impacts import PairOperation
    from geartrain.teeth.form_comparison import FormComparison
    from geartrain.teeth.tooth_form import ToothForm
    from geartrain.teeth.triangular.parameter_sweep import ParameterSweep
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission


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
            "--profile",
            metavar="FILE",
            help="Write the outline of a whole wheel to scale, as .svg, .dxf or .csv, without compensation of a kerf.",
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
        counts = _counts(z1, z2)
        from geartrain.report.conjugate_pair_page import describe_form_comparison

        picture = picture_sink(plot, force, theme)
        check_distinct_outputs(to, picture)
        found = _compare(counts, internal, shaft_angle, form or (), parameter or ())
        give(to, json, lambda: found, lambda: [describe_form_comparison(found)])
        if plot is not None:
            draw(found.plot(), picture)
        raise typer.Exit(GOOD if all(each.runs for each in found.forms) else VERDICT)
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
                what, fix = f"{option} and --vary are given together", f"omit {option} or --vary"
                why = f"--vary evaluates several pairs, but {option} applies to a single pair"
                raise option_error(option, what, fix, why)
        sweep(pair, vary, picture, json, to)
        return
    mesh, operation = pair.mesh(), None
    if isinstance(mesh, TriangularMesh):
        operation = read_operation(inertia, rate, load)
        mesh = replace(mesh, transmission=mesh.transmission.reversed_motion()) if backwards else mesh
    outlines = write_profile(mesh, wheel, sizes, outlined)
    give(to, json, lambda: collect_pair(mesh, outlines, operation), lambda: [describe_pair(mesh, outlines, operation)])
    if plot is not None:
        draw(mesh.plot(*([] if at is None else [quantity("--at", at, "angle")])), picture)
    raise typer.Exit(GOOD if not mesh.faults else VERDICT)


def _counts(z1: int | None, z2: int | None) -> tuple[int, int]:
    if z1 is None or z2 is None:
        raise option_error(COUNTS, "the tooth counts are missing", "give two tooth counts, such as 24 36")
    return z1, z2


def _applicable(name: str, model: type[ToothForm]) -> set[str]:
    """Return the names of the command-line options that apply to a tooth form."""
    triangular = name == "triangular"
    left_out = set() if triangular else {*_TRIANGULAR}
    left_out |= set() if model.conjugate else {"shaft_angle"}
    left_out |= set() if model.conjugate or triangular else {"internal"}
    left_out |= set() if name == "involute" else {"helix"}
    return {*signature(run).parameters} - left_out


def _refuse(context: typer.Context, applicable: set[str], what: str) -> None:
    """Raise `QuestionError` if the command line contains an option that is not applicable."""
    for option in context.command.params:
        source = context.get_parameter_source(option.name or "")
        # defaults of options that do not apply are not errors
        if option.name not in applicable and source is not None and source.name == "COMMANDLINE":
            name = option.opts[0]
            raise option_error(name, f"this option does not apply to {what}", f"omit {name}")


# ----------------------------------------------------------------------------------------------------------- comparison


def _compare(
    teeth: tuple[int, int], internal: bool, angle: str | None, forms: Sequence[str], parameters: Sequence[str]
) -> FormComparison:
    """Compare friction losses, stresses, heating and depth of teeth of several forms with the 20 degree involute."""
    from geartrain.teeth.form_comparison import USUAL, compare_forms

    own = read_assignments(parameters, ("arcs", "pressure_angle"), "-p")
    wheels = read_wheels(teeth, internal, angle)
    pressure_angle = own.get("pressure_angle")
    try:
        return compare_forms(
            wheels,
            list(dict.fromkeys(forms or USUAL)),
            _arcs(own.get("arcs", "0.5,0.5")),
            None if pressure_angle is None else read_quantity("-p pressure_angle", pressure_angle, "angle"),
        )
    except GearTrainError as error:
        raise at_parameter(error, "--form") from None


def _arcs(text: str) -> tuple[float, float]:
    """Parse the arcs of approach and recess [pitch] from a text of one or two numbers; one number sets both arcs."""
    from geartrain.teeth.form_comparison import arcs_error

    parts = text.split(",")
    try:
        first, second = float(parts[0]), float(parts[-1])
    except ValueError:
        raise arcs_error(text) from None
    if len(parts) > 2:
        raise arcs_error(text)
    return first, second


# Parameter sweep of `geartrain mesh --form triangular --vary`, and parser of inertia, speed and load.


VARIED = (*parameters_of(Triangular), *PAIR)
"""Quantities that can be varied: parameters of the tooth form, friction and tooth counts."""


def read_operation(inertia: str | None, rate: str | None, load: str | None) -> PairOperation:
    """Parse the operating data of a pair: inertia and load of the driven wheel, and speed of the driving wheel."""
    from geartrain.dynamics.motion.pair_impacts import PairOperation
    from geartrain.numerics.quantity import RADIANS_PER_TURN

    return PairOperation(
        None if inertia is None else quantity("--inertia", inertia, "inertia", minimum="above 0"),
        None if rate is None else quantity("--rate", rate, "speed", minimum="above 0") / RADIANS_PER_TURN,
        None if load is None else quantity("--load", load, "torque", minimum="0"),
    )


def sweep(pair: PairRequest, vary: list[str], picture: Sink, json: bool, to: Sink) -> None:
    """Run a parameter sweep, and write its table and, if a file is named for a picture, the picture."""
    from geartrain.numerics.files import csv_text
    from geartrain.teeth.triangular.parameter_sweep import sweep as run_sweep

    ranges, units = _ranges(vary)
    read_pair_friction(pair.friction).number("--vary")

    def make(**values: float) -> TriangularTransmission:
        mesh = pair.mesh(**{name: f"{value!r}{units[name]}" for name, value in values.items()})
        assert isinstance(mesh, TriangularMesh)
        return mesh.transmission

    # a unit or option that is invalid at every point is reported before the sweep begins
    pair.form({name: f"{values[0]!r}{units[name]}" for name, values in ranges.items() if name not in PAIR})
    with progress("sweep", prod(map(len, ranges.values()))) as bar:
        found = run_sweep(make, ranges, bar.advance)
    if json or to.suffix == ".json":
        emit(as_json([dict(zip(found.header, _plain(row), strict=True)) for row in found.rows()]), to)
    else:
        emit(csv_text(found.header, map(_plain, found.rows())).rstrip("\n"), to)
    if len(ranges) == 1:
        # changes of the verdict are located along one parameter only
        _report_changes(make, next(iter(ranges)), found, units)
    if picture.path is not None:
        from geartrain.drawing.parameter_sweep_plot import parameter_name, sweep_figure

        z1, z2 = ("varied" if name in ranges else str(z) for name, z in zip(("z1", "z2"), pair.teeth, strict=True))
        varied = " and ".join(map(parameter_name, ranges))
        title = f"triangular teeth, {z1} and {z2}, wheel {pair.driver} drives: {varied} varied"
        draw(sweep_figure(found.parameters, found.columns, found.labels, title, units), picture)


def _ranges(vary: list[str]) -> tuple[dict[str, list[float]], dict[str, str]]:
    """Parse the ranges of one or two parameters; return the values and the unit of each parameter, keyed by name."""
    if len(vary) > 2:
        raise option_error("--vary", f"{len(vary)} parameters are given", "give --vary once or twice")
    ranges: dict[str, list[float]] = {}
    units: dict[str, str] = {}
    for text in vary:
        name, _, rest = text.partition("=")
        name = name.strip()
        parts = [part.strip() for part in rest.split(":")]
        if name not in VARIED:
            raise option_error("--vary", f"'{name}' cannot be varied", suggest(name, VARIED))
        if len(parts) != 3 or not parts[2].isdigit() or int(parts[2]) < 2:
            fix = "write it as NAME=FIRST:LAST:COUNT, with a count of 2 or more"
            raise option_error("--vary", f"'{text}' is not a range of a parameter", fix)
        first, unit = _number(parts[0])
        last, other = _number(parts[1])
        units[name] = other or unit
        steps = int(parts[2]) - 1
        ranges[name] = [first + (last - first) * step / steps for step in range(steps + 1)]
    return ranges, units


def _number(text: str) -> tuple[float, str]:
    """Return the number at the start of a text, and the unit that follows the number."""
    match = re.fullmatch(r"([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*([A-Za-z°].*)?", text)
    try:
        value = float(match[1]) if match else nan
    except ValueError:
        value = nan
    if match is None or not isfinite(value):
        fix = "write a number such as 1.01, or a quantity such as 30deg"
        raise option_error("--vary", f"'{text}' is not a number", fix)
    return value, match[2] or ""


def _plain(row: tuple[object, ...]) -> list[object]:
    """Return a row of the results table with NaN values replaced by None."""
    # only NaN differs from itself
    return [None if value != value else value for value in row]


def _report_changes(make: Any, name: str, found: ParameterSweep, units: dict[str, str]) -> None:
    from geartrain.teeth.triangular.parameter_sweep import best, changes

    for change in changes(make, name, found) if name not in ("z1", "z2") else ():
        tell(f"{name} {change.value:.10g}{units[name]}: {change.before} -> {change.after}")
    top = best(make, name, found) if name not in ("z1", "z2", "friction") else None
    if top is not None:
        tell(f"{name} {top[0]:.8g}{units[name]}: maximum mean efficiency, {top[1]:.8f}")
