"""A pair of triangular teeth as options describe it.

`geartrain mesh triangular --vary`: a table over one parameter or two.

`geartrain mesh triangular`: contact, law, collisions and losses of a pair, or a sweep.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import (
    GOOD,
    PICTURES,
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
    sink,
    tell,
)
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import at_option, quantity
from geartrain.cli.option_values import friction as _friction
from geartrain.cli.option_values import quantity as _quantity
from geartrain.errors import GearTrainError, Problem

if TYPE_CHECKING:
    from geartrain.teeth import Triangular
    from geartrain.teeth.triangular.parameter_sweep import ParameterSweep
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission


VARIED = ("half_angle", "clearance", "excess", "window", "backlash", "centre_distance", "friction", "z1", "z2")
FORM = VARIED[:-3]


class TriangularOptions:
    """The options that describe a pair; any of them can be varied."""

    def __init__(
        self,
        teeth: tuple[int, int],
        half_angle: str,
        given: dict[str, str | None],
        radii: str,
        module: str | None,
        friction: str,
        driver: int,
        direction: int,
    ) -> None:
        self.teeth, self.half_angle, self.radii, self.friction = teeth, half_angle, radii, friction
        self.given = {name: value for name, value in given.items() if value is not None}
        self.module, self.driver, self.direction = module, driver, direction

    def law(self, **varied: str | float) -> TriangularTransmission:
        """The law with some options replaced by what is varied."""
        z1, z2 = (varied.pop(name, z) for name, z in zip(("z1", "z2"), self.teeth, strict=True))
        friction = _friction(str(varied.pop("friction", self.friction)))
        z1, z2 = round(float(z1)), round(float(z2))
        size = None if self.module is None else quantity("--module", self.module, "length", least="above 0")
        distance = None if size is None else size * (z1 + z2) / 2
        try:
            return self.form(**varied).law(z1, z2, friction, self.driver, self.direction, distance)
        except GearTrainError as error:
            raise at_option(
                error, "--teeth" if min(z1, z2) < 3 else "--" + next(iter(self.given), "clearance")
            ) from None

    def check(self, ranges: dict[str, list[float]], units: dict[str, str]) -> None:
        """Complain of a unit or an option that no point of a sweep can have."""
        self.form(**{name: f"{values[0]!r}{units[name]}" for name, values in ranges.items() if name in FORM})

    def form(self, **varied: str | float) -> Triangular:
        """The tooth form with some options replaced."""
        from pydantic import ValidationError

        from geartrain.teeth import Triangular

        half_angle = str(varied.pop("half_angle", self.half_angle))
        clearances = {name: str(value) for name, value in varied.items()} if varied else self.given
        data: dict[str, Any] = {
            "form": "triangular",
            "half_angle": [part.strip() for part in half_angle.split(",")] if "," in half_angle else half_angle,
            "radii": [part.strip() for part in self.radii.split(",")] if "," in self.radii else self.radii,
            **clearances,
        }
        try:
            return Triangular.model_validate(data)
        except ValidationError as error:
            # one half angle given for both wheels would be complained of twice
            raise GearTrainError(dict.fromkeys(map(_problem, error.errors(include_url=False)))) from None


def _problem(item: Any) -> Problem:
    context = item.get("ctx") or {}
    name = str(item["loc"][0]) if item["loc"] else item["type"] if item["type"] in VARIED else "radii"
    what = item["msg"] if "fix" in context else f"'{item['input']}' does not fit here"
    fix = str(context.get("fix") or "see geartrain mesh triangular --help")
    return Problem(what, "", fix, f"--{name.replace('_', '-')}")


def sweep(pair: TriangularOptions, vary: list[str], picture: Sink, json: bool, to: Sink) -> None:
    """The table of a sweep, as text and as a picture."""
    from geartrain.numerics.files import csv_text
    from geartrain.teeth.triangular.parameter_sweep import sweep as run_sweep

    ranges, units = _ranges(vary)

    def make(**values: float) -> TriangularTransmission:
        return pair.law(**{name: f"{value!r}{units[name]}" for name, value in values.items()})

    pair.check(ranges, units)
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
        _tell_changes(make, next(iter(ranges)), found, units)
    if picture.path is not None:
        from geartrain.drawing import sweep_figure

        draw(sweep_figure(found.parameters, found.columns, found.labels), picture)


def _ranges(vary: list[str]) -> tuple[dict[str, list[float]], dict[str, str]]:
    """The values of each varied parameter, and the unit they were given in."""
    if len(vary) > 2:
        raise typer.BadParameter("vary one parameter or two", param_hint="--vary")
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
    """A number and the unit behind it."""
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
    """NaN becomes nothing."""
    return [None if value != value else value for value in row]


def _tell_changes(make: Any, name: str, found: ParameterSweep, units: dict[str, str]) -> None:
    from geartrain.teeth.triangular.parameter_sweep import best, changes

    for change in changes(make, name, found) if name not in ("z1", "z2") else ():
        tell(f"{name} {change.value:.10g}{units[name]}: {change.before} -> {change.after}")
    top = best(make, name, found) if name not in ("z1", "z2", "friction") else None
    if top is not None:
        tell(f"{name} {top[0]:.8g}{units[name]}: greatest mean efficiency, {top[1]:.8f}")


def run(
    teeth: Annotated[tuple[int, int], typer.Option("--teeth", help="Teeth of the first and the second wheel.")],
    half_angle: Annotated[
        str, typer.Option("--half-angle", help="Half the aperture of a tooth, with its unit; two with a comma.")
    ] = "30deg",
    clearance: Annotated[str | None, typer.Option("--clearance", help="Clearance factor, above 1.")] = None,
    excess: Annotated[str | None, typer.Option("--excess", help="Clearance factor less 1.")] = None,
    window: Annotated[
        str | None, typer.Option("--window", help="Place in the pair's own window: 0 jams, 1 loses contact.")
    ] = None,
    backlash: Annotated[str | None, typer.Option("--backlash", help="Least play on the pitch circle.")] = None,
    centre_distance: Annotated[str | None, typer.Option("--centre-distance", help="Distance of the axes.")] = None,
    radii: Annotated[
        str, typer.Option("--radii", help="equal_depth, pitch_true, or two outer radii with a comma.")
    ] = "equal_depth",
    module: Annotated[
        str | None, typer.Option("--module", help="Pitch diameter over tooth count, which gives the wheels a size.")
    ] = None,
    friction: Annotated[str, typer.Option("--friction", help="Coefficient of friction.")] = "0",
    driver: Annotated[int, typer.Option("--driver", min=1, max=2, help="Which wheel drives, 1 or 2.")] = 1,
    backwards: Annotated[bool, typer.Option("--backwards", help="Turn backwards, on the back flanks.")] = False,
    inertia: Annotated[
        str | None, typer.Option("--inertia", help="Moment of inertia of all that turns with the driven wheel.")
    ] = None,
    rate: Annotated[str | None, typer.Option("--rate", help="Speed of the driver, such as '1 turn/s'.")] = None,
    load: Annotated[str | None, typer.Option("--load", help="Torque that resists the driven wheel.")] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option("--vary", help=f"NAME=FIRST:LAST:COUNT, once or twice; NAME is one of {', '.join(VARIED)}."),
    ] = None,
    plot: Annotated[Path | None, typer.Option("--plot", help="Draw the law, or the sweep, to this file.")] = None,
    teeth_plot: Annotated[Path | None, typer.Option("--teeth-plot", help="Draw the wheels in contact.")] = None,
    at: Annotated[str | None, typer.Option("--at", help="alpha_1 at which the wheels are drawn.")] = None,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Contact, law, collisions and losses of a pair with triangular teeth, or a sweep over its parameters as CSV."""
    given = {
        "clearance": clearance,
        "excess": excess,
        "window": window,
        "backlash": backlash,
        "centre_distance": centre_distance,
    }
    to = sink(out, force, (".csv", ".json") if vary else (".md", ".html", ".json"))
    picture = sink(plot, force, PICTURES, "--plot")
    drawing = sink(teeth_plot, force, PICTURES, "--teeth-plot")
    check_distinct_outputs(to, picture, drawing)
    pair = TriangularOptions(teeth, half_angle, given, radii, module, friction, driver, -1 if backwards else 1)
    if vary:
        if teeth_plot is not None:
            raise typer.BadParameter(
                "one pair is drawn, and a sweep has many: leave --vary out", param_hint="--teeth-plot"
            )
        sweep(pair, vary, picture, json, to)
        return
    law = pair.law()
    _page(pair, law, (inertia, rate, load), json, to)
    if plot is not None:
        from geartrain.drawing import law_figure

        draw(law_figure(law), picture)
    if teeth_plot is not None:
        from geartrain.drawing import teeth_figure

        angle = None if at is None else _quantity("--at", at, "angle")
        draw(teeth_figure(law, angle), drawing)
    raise typer.Exit(GOOD if law.verdict and law.friction < law.locking_friction else VERDICT)


def _page(
    pair: TriangularOptions,
    law: TriangularTransmission,
    run: tuple[str | None, str | None, str | None],
    json: bool,
    to: Sink,
) -> None:
    from geartrain.dynamics.motion.pair_impacts import PairOperation
    from geartrain.numerics.units import RADIANS_PER_TURN
    from geartrain.report.gear_pairs import mesh_data
    from geartrain.report.pair_page import mesh_document
    from geartrain.teeth.triangular.clearance_window import find_window

    inertia, rate, load = run
    operation = PairOperation(
        None if inertia is None else _quantity("--inertia", inertia, "inertia", least="above 0"),
        None if rate is None else _quantity("--rate", rate, "speed", least="above 0") / RADIANS_PER_TURN,
        None if load is None else _quantity("--load", load, "torque", least="0"),
    )
    found = find_window(law.sizes) if law.sizes.has_valleys else None
    give(to, json, lambda: mesh_data(law, found, operation), lambda: [mesh_document(law, found, operation)])
