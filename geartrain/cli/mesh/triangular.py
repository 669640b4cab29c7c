"""`geartrain mesh triangular`: contact, transmission function, impacts and losses of a pair with triangular teeth.

With `--vary`, the result is a table over one or two parameters.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import (
    GOOD,
    VERDICT,
    Force,
    Json,
    Out,
    Sink,
    as_json,
    check_distinct_outputs,
    draw,
    emit,
    give,
    picture_sink,
    sink,
    tell,
)
from geartrain.cli.long_runs import progress
from geartrain.cli.mesh.form_options import (
    FINE,
    Bore,
    FormOptions,
    Friction,
    Internal,
    Profile,
    Rate,
    Tolerance,
    WheelNumber,
    form_command,
    option_name,
    pair_in_mesh,
    profile_sink,
    read_form,
    read_pair_friction,
    two_wheels,
    write_profile,
)
from geartrain.cli.option_values import Theme, at_option, quantity
from geartrain.errors import GearTrainError
from geartrain.teeth.triangular.triangular_form import FEWEST, Triangular
from geartrain.wings import wing

if TYPE_CHECKING:
    from geartrain.dynamics.motion.pair_impacts import PairOperation
    from geartrain.teeth.tooth_form import ToothForm
    from geartrain.teeth.triangular.parameter_sweep import ParameterSweep
    from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

VARIED = (
    *(name for name in Triangular.model_fields if name not in ("form", *Triangular.in_time)),
    "friction",
    "z1",
    "z2",
)
"""Parameters that can be varied: numbers of the form's declaration, friction and tooth counts."""
_KEPT = ("half_angle", "radii")
"""Options of the form that keep their values when a clearance is varied."""
_PAIR = ("friction", "z1", "z2")


@dataclass(frozen=True)
class TriangularOptions:
    """A pair as described by options, any of which can be varied."""

    teeth: tuple[int, int]
    own: FormOptions
    """Options of the form, by the names of its fields."""
    module: float | None
    """Module [m]; None if not given."""
    friction: str
    driver: int
    backwards: bool
    rate: str | None = None
    internal: bool = False

    def mesh(self, **varied: str) -> TriangularMesh:
        """Create the pair in mesh, with some options replaced by varied values."""
        from geartrain.teeth.triangular.triangular_mesh import TriangularMesh

        # tooth counts in a sweep are floats
        z1, z2 = (round(float(varied.get(name, z))) for name, z in zip(("z1", "z2"), self.teeth, strict=True))
        rub = read_pair_friction(varied.get("friction", self.friction))
        wheels = two_wheels((z1, z2), rub.coefficient, self.module, self.internal)
        form = self.form({name: value for name, value in varied.items() if name not in _PAIR})
        try:
            mesh = pair_in_mesh(form, wheels, None, self.driver)
        except GearTrainError as error:
            clearances = (name for name in self.own if name not in _KEPT and self.own[name] is not None)
            given = next(clearances, "clearance_factor")
            raise at_option(error, "--teeth" if min(z1, z2) < FEWEST else option_name(given)) from None
        assert isinstance(mesh, TriangularMesh)
        mesh = rub.of(mesh, self.rate)
        return replace(mesh, transmission=mesh.transmission.reversed_motion()) if self.backwards else mesh

    def form(self, varied: Mapping[str, str]) -> ToothForm:
        """Create the tooth form with some options replaced; a varied clearance replaces all given clearances."""
        # only one of the options for the clearance can be given
        fixed = _KEPT if set(varied) - {*_KEPT} else tuple(self.own)
        return read_form(Triangular, {name: self.own[name] for name in fixed} | dict(varied), "--radii")


def sweep(pair: TriangularOptions, vary: list[str], picture: Sink, json: bool, to: Sink) -> None:
    """Run a parameter sweep and write it as a table and as a picture."""
    from geartrain.numerics.files import csv_text
    from geartrain.teeth.triangular.parameter_sweep import sweep as run_sweep

    ranges, units = _ranges(vary)
    read_pair_friction(pair.friction).number("--vary")

    def make(**values: float) -> TriangularTransmission:
        return pair.mesh(**{name: f"{value!r}{units[name]}" for name, value in values.items()}).transmission

    # a unit or option that is invalid at every point is reported before the sweep begins
    pair.form({name: f"{values[0]!r}{units[name]}" for name, values in ranges.items() if name not in _PAIR})
    count = 1
    for values in ranges.values():
        count *= len(values)
    with progress("sweep", count) as bar:
        found = run_sweep(make, ranges, bar.advance)
    if json or to.suffix == ".json":
        emit(as_json([dict(zip(found.header, _plain(row), strict=True)) for row in found.rows()]), to)
    else:
        emit(csv_text(found.header, map(_plain, found.rows())).rstrip("\n"), to)
    if len(ranges) == 1:
        _report_changes(make, next(iter(ranges)), found, units)
    if picture.path is not None:
        from geartrain.drawing.parameter_sweep_plot import parameter_name, sweep_figure

        z1, z2 = ("varied" if name in ranges else str(z) for name, z in zip(("z1", "z2"), pair.teeth, strict=True))
        varied = " and ".join(map(parameter_name, ranges))
        title = f"triangular teeth, {z1} and {z2}, wheel {pair.driver} drives: {varied} varied"
        draw(sweep_figure(found.parameters, found.columns, found.labels, title, units), picture)


def _ranges(vary: list[str]) -> tuple[dict[str, list[float]], dict[str, str]]:
    """Parse the values of each varied parameter, and the unit in which they were given."""
    if len(vary) > 2:
        raise typer.BadParameter("at most two parameters can be varied", param_hint="--vary")
    ranges: dict[str, list[float]] = {}
    units: dict[str, str] = {}
    for text in vary:
        name, _, rest = text.partition("=")
        name = name.strip().replace("-", "_")
        parts = [part.strip() for part in rest.split(":")]
        if name not in VARIED:
            raise typer.BadParameter(f"'{name}' cannot be varied; use {', '.join(VARIED)}", param_hint="--vary")
        if len(parts) != 3 or not parts[2].isdigit() or int(parts[2]) < 2:
            raise typer.BadParameter(f"'{text}' is not NAME=FIRST:LAST:COUNT, COUNT 2 or more", param_hint="--vary")
        first, unit = _number(parts[0])
        last, other = _number(parts[1])
        units[name] = other or unit
        steps = int(parts[2]) - 1
        ranges[name] = [first + (last - first) * step / steps for step in range(steps + 1)]
    return ranges, units


def _number(text: str) -> tuple[float, str]:
    """Parse a number and the unit that follows it."""
    import math
    import re

    match = re.fullmatch(r"([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*([A-Za-z°].*)?", text)
    try:
        value = float(match[1]) if match else math.nan
    except ValueError:
        value = math.nan
    if match is None or not math.isfinite(value):
        raise typer.BadParameter(f"'{text}' is not a number", param_hint="--vary")
    return value, match[2] or ""


def _plain(row: tuple[object, ...]) -> list[object]:
    """Replace NaN by None in a row."""
    return [None if value != value else value for value in row]


def _report_changes(make: Any, name: str, found: ParameterSweep, units: dict[str, str]) -> None:
    from geartrain.teeth.triangular.parameter_sweep import best, changes

    for change in changes(make, name, found) if name not in ("z1", "z2") else ():
        tell(f"{name} {change.value:.10g}{units[name]}: {change.before} -> {change.after}")
    top = best(make, name, found) if name not in ("z1", "z2", "friction") else None
    if top is not None:
        tell(f"{name} {top[0]:.8g}{units[name]}: maximum mean efficiency, {top[1]:.8f}")


def _run(
    teeth: Annotated[tuple[int, int], typer.Option("--teeth", help="Teeth of the first and the second wheel.")],
    internal: Internal = False,
    module: Annotated[
        str | None, typer.Option("--module", help="Module (pitch diameter over tooth count), such as 2mm.")
    ] = None,
    friction: Friction = "0",
    driver: Annotated[int, typer.Option("--driver", min=1, max=2, help="Number of the driving wheel, 1 or 2.")] = 1,
    backwards: Annotated[
        bool, typer.Option("--backwards", help="Turn the driver backwards, on the back flanks.")
    ] = False,
    inertia: Annotated[
        str | None,
        typer.Option("--inertia", help="Moment of inertia on the axis of the driven wheel, such as '1 kg mm2'."),
    ] = None,
    rate: Rate = None,
    load: Annotated[
        str | None, typer.Option("--load", help="Load torque on the driven wheel, such as '1 N mm'.")
    ] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option("--vary", help=f"Vary one or two parameters, NAME=FIRST:LAST:COUNT of {', '.join(VARIED)}."),
    ] = None,
    best: Annotated[
        str | None,
        typer.Option(
            "--best",
            help="Minimise loss, error or impact, or maximise the jam margin (jam); one or two, separated by a comma.",
        ),
    ] = None,
    free: Annotated[
        list[str] | None,
        typer.Option(
            "--free",
            help="With --best: free parameter NAME or NAME=LOW:HIGH: radii, window, half_angle; default radii.",
        ),
    ] = None,
    within: Annotated[
        list[str] | None,
        typer.Option(
            "--within", help="With --best: limit NAME=LIMIT of loss, error, impact, jam, window_width, backlash, stops."
        ),
    ] = None,
    set_: Annotated[
        list[str] | None,
        typer.Option(
            "--set", help="With --within stops=5%: wheel errors KIND=SIZE as in montecarlo: 'pitch_deviation=1 %'."
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot", help="Plot the transmission function, the sweep, or the designs of --best to this file."
        ),
    ] = None,
    teeth_plot: Annotated[Path | None, typer.Option("--teeth-plot", help="Draw the wheels in contact.")] = None,
    at: Annotated[
        str | None, typer.Option("--at", help="With --teeth-plot: angle alpha_1 at which the wheels are drawn.")
    ] = None,
    profile: Profile = None,
    wheel: WheelNumber = 1,
    bore: Bore = None,
    tolerance: Tolerance = FINE,
    json: Json = False,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
    **own: Any,
) -> None:
    from geartrain.report.pair_page import collect_pair, describe_pair

    to = sink(out, force, (".csv", ".json") if vary else (".md", ".html", ".json"))
    picture = picture_sink(plot, force, theme)
    drawing = picture_sink(teeth_plot, force, theme, "--teeth-plot")
    outlined = profile_sink(profile, force)
    check_distinct_outputs(to, outlined, picture, drawing)
    size = None if module is None else quantity("--module", module, "length", minimum="above 0")
    if best is not None or free or within or set_:
        sizes = wing("workshop.sizes.verb")
        question = sizes.SizeQuestion(best, tuple(free or ()), tuple(within or ()), tuple(set_ or ()))
        question.check({"--vary": vary, "--teeth-plot": teeth_plot, "--profile": profile})
        coefficient = read_pair_friction(friction).number("--best")
        question.answer(sizes.read_start(teeth, own, coefficient, driver, internal), to, picture, json)
    pair = TriangularOptions(teeth, own, size, friction, driver, backwards, rate, internal)
    if vary:
        _check_one_pair({"--teeth-plot": teeth_plot, "--profile": profile})
        sweep(pair, vary, picture, json, to)
        return
    mesh = pair.mesh()
    operation = _operation(inertia, rate, load)
    outlines = write_profile(mesh, wheel, {"bore": bore, "tolerance": tolerance}, outlined)
    give(to, json, lambda: collect_pair(mesh, outlines, operation), lambda: [describe_pair(mesh, outlines, operation)])
    if plot is not None:
        from geartrain.drawing import triangular_figure
        from geartrain.teeth.rubbed_transmission import pair_friction

        draw(triangular_figure(mesh.transmission, pair_friction(mesh.wheels)), picture)
    if teeth_plot is not None:
        from geartrain.drawing import teeth_figure

        angle = None if at is None else quantity("--at", at, "angle")
        draw(teeth_figure(mesh.transmission, angle), drawing)
    raise typer.Exit(GOOD if not mesh.faults else VERDICT)


def _check_one_pair(files: Mapping[str, Path | None]) -> None:
    for option, path in files.items():
        if path is not None:
            raise typer.BadParameter("only one pair can be drawn: omit --vary", param_hint=option)


def _operation(inertia: str | None, rate: str | None, load: str | None) -> PairOperation:
    from geartrain.dynamics.motion.pair_impacts import PairOperation
    from geartrain.numerics.quantity import RADIANS_PER_TURN

    return PairOperation(
        None if inertia is None else quantity("--inertia", inertia, "inertia", minimum="above 0"),
        None if rate is None else quantity("--rate", rate, "speed", minimum="above 0") / RADIANS_PER_TURN,
        None if load is None else quantity("--load", load, "torque", minimum="0"),
    )


run = form_command(
    Triangular,
    _run,
    "Compute contact, transmission function, impacts and losses of a pair with triangular teeth, or a sweep as CSV.",
    {"half_angle": "30deg"},
)
