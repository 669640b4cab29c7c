"""Parameter sweep of `geartrain mesh --form triangular --vary`, and parser of inertia, speed and load."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, Any

from geartrain.cli.common import Sink, as_json, draw, emit, option_error, tell
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import quantity
from geartrain.cli.pair_options import PAIR, PairRequest, parameters_of, read_pair_friction
from geartrain.errors import suggest
from geartrain.teeth.triangular.triangular_form import Triangular

if TYPE_CHECKING:
    from geartrain.dynamics.motion.pair_impacts import PairOperation
    from geartrain.teeth.triangular.parameter_sweep import ParameterSweep
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

VARIED = (*parameters_of(Triangular), *PAIR)
"""Quantities that can be varied: parameters of the tooth form, friction and tooth counts."""


def read_operation(inertia: str | None, rate: str | None, load: str | None) -> PairOperation:
    """Parse the inertia and load of the driven wheel and the speed of the driving wheel."""
    from geartrain.dynamics.motion.pair_impacts import PairOperation
    from geartrain.numerics.quantity import RADIANS_PER_TURN

    return PairOperation(
        None if inertia is None else quantity("--inertia", inertia, "inertia", minimum="above 0"),
        None if rate is None else quantity("--rate", rate, "speed", minimum="above 0") / RADIANS_PER_TURN,
        None if load is None else quantity("--load", load, "torque", minimum="0"),
    )


def sweep(pair: PairRequest, vary: list[str], picture: Sink, json: bool, to: Sink) -> None:
    """Run a parameter sweep; write its results as a table and, if a file is named, as a picture."""
    from geartrain.numerics.files import csv_text
    from geartrain.teeth.triangular.parameter_sweep import sweep as run_sweep
    from geartrain.teeth.triangular.triangular_mesh import TriangularMesh

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
    """Parse the values of each varied parameter, and the unit in which they were given."""
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
    """Parse a number and the unit that follows it."""
    import math
    import re

    match = re.fullmatch(r"([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*([A-Za-z°].*)?", text)
    try:
        value = float(match[1]) if match else math.nan
    except ValueError:
        value = math.nan
    if match is None or not math.isfinite(value):
        raise option_error(
            "--vary", f"'{text}' is not a number", "write a number such as 1.01, or a quantity such as 30deg"
        )
    return value, match[2] or ""


def _plain(row: tuple[object, ...]) -> list[object]:
    """Replace NaN by None in a row of the results table."""
    # only NaN differs from itself
    return [None if value != value else value for value in row]


def _report_changes(make: Any, name: str, found: ParameterSweep, units: dict[str, str]) -> None:
    from geartrain.teeth.triangular.parameter_sweep import best, changes

    for change in changes(make, name, found) if name not in ("z1", "z2") else ():
        tell(f"{name} {change.value:.10g}{units[name]}: {change.before} -> {change.after}")
    top = best(make, name, found) if name not in ("z1", "z2", "friction") else None
    if top is not None:
        tell(f"{name} {top[0]:.8g}{units[name]}: maximum mean efficiency, {top[1]:.8f}")
