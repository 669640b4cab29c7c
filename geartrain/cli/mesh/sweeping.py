"""`geartrain mesh triangular --vary`: a table over one parameter or two."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import typer

from geartrain.cli.common import Sink, as_json, draw, emit, tell
from geartrain.cli.mesh.pair import VARIED, Pair

if TYPE_CHECKING:
    from geartrain.teeth.triangular.law import TriangularLaw
    from geartrain.teeth.triangular.sweep import Sweep


def sweep(pair: Pair, vary: list[str], picture: Sink, json: bool, to: Sink) -> None:
    """The table of a sweep, as text and as a picture."""
    from rich.console import Console
    from rich.progress import Progress

    from geartrain.files import csv_text
    from geartrain.teeth.triangular.sweep import sweep as run_sweep

    ranges, units = _ranges(vary)

    def make(**values: float) -> TriangularLaw:
        return pair.law(**{name: f"{value!r}{units[name]}" for name, value in values.items()})

    pair.check(ranges, units)
    count = 1
    for values in ranges.values():
        count *= len(values)
    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("sweep", total=count)
        found = run_sweep(make, ranges, lambda: progress.update(task, advance=1))
    if json or to.suffix == ".json":
        emit(as_json([dict(zip(found.header, _plain(row), strict=True)) for row in found.rows()]), to)
    else:
        emit(csv_text(found.header, map(_plain, found.rows())).rstrip("\n"), to)
    if len(ranges) == 1:
        _tell_changes(make, next(iter(ranges)), found, units)
    if picture.path is not None:
        from geartrain.plot import sweep_figure

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


def _tell_changes(make: Any, name: str, found: Sweep, units: dict[str, str]) -> None:
    from geartrain.teeth.triangular.sweep import best, changes

    for change in changes(make, name, found) if name not in ("z1", "z2") else ():
        tell(f"{name} {change.value:.10g}{units[name]}: {change.before} -> {change.after}")
    top = best(make, name, found) if name not in ("z1", "z2", "friction") else None
    if top is not None:
        tell(f"{name} {top[0]:.8g}{units[name]}: greatest mean efficiency, {top[1]:.8f}")
