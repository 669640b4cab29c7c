"""`geartrain sphere`: mobility, closure and sizes of gears on polyhedra and graphs."""

from __future__ import annotations

from math import sin
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
    check_distinct_outputs,
    draw,
    emit,
    give,
    option_error,
    picture_sink,
    sink,
)
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import Theme, decimal

if TYPE_CHECKING:
    from geartrain.spherical import Configuration, GraphSet
    from geartrain.spherical.polyhedron_gears import SurveyRow

_YAML = (".yaml", ".yml")
_FILES = (".txt", ".csv", ".dat")


def run(
    solid: Annotated[
        str | None, typer.Argument(help="Name of a solid, or a file with one vertex per line.", metavar="SOLID")
    ] = None,
    gears: Annotated[
        str,
        typer.Option(
            "--gears",
            help="Positions of the gears: faces, vertices, faces+vertices, faces+edges or faces+vertices+edges.",
        ),
    ] = "faces",
    teeth: Annotated[
        str | None,
        typer.Option(
            "--teeth",
            help="Tooth count of each kind of gear, such as 5=20,3=12 (20 teeth for gears on pentagonal faces, "
            "12 for gears on triangular faces).",
        ),
    ] = None,
    drop: Annotated[
        list[str] | None, typer.Option("--drop", help="Kind of gear, single gear or mesh to omit; may be repeated.")
    ] = None,
    exact: Annotated[bool, typer.Option("--exact", help="Move the axes until all pitches are equal.")] = False,
    graph: Annotated[
        Path | None,
        typer.Option("--graph", help="File with the meshes of a set of gears, one mesh per line as two gear names."),
    ] = None,
    aim: Annotated[
        str,
        typer.Option(
            "--aim",
            help="With --graph: condition to satisfy exactly, equal pitches (pitch) or closure of all loops (phases).",
        ),
    ] = "pitch",
    minimum: Annotated[int, typer.Option("--min-teeth", help="With --graph: tooth count of the smallest gear.")] = 12,
    radius: Annotated[
        str, typer.Option("--radius", help="Radius of the sphere, or KIND=RADIUS: pitch radius of one kind of gear.")
    ] = "1",
    suggest: Annotated[
        int,
        typer.Option(
            "--suggest", help="List the best sets of tooth counts, with at most this number of teeth per gear."
        ),
    ] = 0,
    best: Annotated[
        int, typer.Option("--best", min=1, max=100_000, help="With --suggest: number of sets to list.")
    ] = 20,
    survey: Annotated[
        bool, typer.Option("--survey", help="Print a table of 19 solids with gears on all faces.")
    ] = False,
    json: Json = False,
    plot: Annotated[Path | None, typer.Option("--plot", help="Draw the sphere and its gears to this file.")] = None,
    theme: Theme = "light",
    out: Out = None,
    force: Force = False,
) -> None:
    """Determine mobility, gridlock, tooth closure and sizes of gears on a sphere; -o x.yaml writes a declaration.

    Example: `geartrain sphere icosidodecahedron --teeth 5=20,3=12`.
    """
    from geartrain.report.spherical_report import describe_sphere
    from geartrain.spherical.gear_sphere import GearSphere

    to = sink(out, force, (".md", ".html", ".json", *_YAML))
    picture = picture_sink(plot, force, theme)
    check_distinct_outputs(to, picture)
    # a list of results has no single sphere
    if (survey or suggest) and to.suffix in _YAML:
        raise option_error("-o", "a list of results cannot be written as a train", "use .md, .html or .json")
    if (survey or suggest) and picture.path is not None:
        raise option_error("--plot", "a list of results cannot be drawn", "omit --plot, or --suggest and --survey")
    if survey:
        _survey(json, to)
        return
    if solid is None and graph is None:
        raise option_error("SOLID", "no gears are given", "give a solid, --graph or --survey")
    if solid is not None and graph is not None:
        what, why = "a solid and --graph are given", "both set the positions of the gears"
        raise option_error("SOLID", what, "omit one of them", why)
    made = _graph(graph, aim, minimum) if graph else None
    configuration = made.configuration if made else _solid(solid or "", gears, teeth, drop or [], exact)
    if suggest:
        _suggest(configuration, suggest, best, json, to)
        return
    found = GearSphere(configuration, _sphere_radius(configuration, radius), made)
    if to.suffix in _YAML:
        from geartrain.spherical import to_train
        from geartrain.train.yaml_nodes import as_yaml

        emit(as_yaml(to_train(configuration)), to)
    else:
        give(to, json, lambda: found, lambda: [describe_sphere(found)])
    if plot is not None:
        from geartrain.drawing import sphere_figure

        draw(sphere_figure(*found.pose()), picture)
    raise typer.Exit(GOOD if found.moves and (found.closure is None or found.closure) else VERDICT)


def _survey(json: bool, to: Sink) -> None:
    from geartrain.report.spherical_report import describe_survey
    from geartrain.spherical.polyhedron_gears import SURVEYED
    from geartrain.spherical.polyhedron_gears import survey as survey_solids

    rows: list[SurveyRow] = []
    with progress("survey", len(SURVEYED)) as bar:
        for name in SURVEYED:
            # one solid at a time, so that the bar can advance
            rows += survey_solids((name,))
            bar.advance()
    give(to, json, lambda: rows, lambda: [describe_survey(rows)])


def _suggest(configuration: Configuration, most: int, best: int, json: bool, to: Sink) -> None:
    from geartrain.report.spherical_report import describe_suggestions
    from geartrain.spherical.tooth_count_search import suggest_tooth_counts

    found = suggest_tooth_counts(configuration, most, best)
    give(to, json, lambda: found, lambda: [describe_suggestions(found)])
    raise typer.Exit(GOOD if len(found) else VERDICT)


def _solid(solid: str, gears: Any, teeth: str | None, drop: list[str], exact: bool) -> Configuration:
    from geartrain.spherical import from_polyhedron

    shape: Any = solid
    if solid.endswith(_FILES):
        from geartrain.numerics.files import read_points

        shape = read_points(Path(solid))
    return from_polyhedron(shape, gears, teeth=_teeth(teeth), drop=drop, exact=exact)


def _graph(file: Path, aim: Any, minimum: int) -> GraphSet:
    from geartrain.numerics.files import read_edges
    from geartrain.spherical import from_graph

    return from_graph(read_edges(file), minimum, aim)


def _teeth(text: str | None) -> dict[str, int] | int | None:
    """Parse one tooth count for all gears, or one for each kind of gear, such as `5=20,3=12`; None without a text."""
    if text is None:
        return None
    try:
        if "=" not in text:
            return int(text)
        pairs = (part.partition("=") for part in text.split(","))
        return {kind.strip(): int(count) for kind, _, count in pairs}
    except ValueError:
        raise option_error("--teeth", f"'{text}' is not a list of tooth counts", "write 20, or 5=20,3=12") from None


def _sphere_radius(configuration: Configuration, text: str) -> float:
    """Parse the radius of the sphere, or derive it from KIND=RADIUS, the pitch radius of one kind of gear."""
    from geartrain.spherical.gear_sizes import size_gears

    kind, wheel, number = text.rpartition("=")
    value = decimal("--radius", number, "radius", "1.25", low=1e-30)
    if not wheel:
        return value
    if kind not in configuration.kinds:
        kinds = ", ".join(dict.fromkeys(configuration.kinds))
        raise option_error("--radius", f"'{kind}' is not a kind of gear", f"use {kinds}")
    # a pitch radius determines the sphere through the pitch cone angle of its kind
    cones = size_gears(configuration).outer
    # the pitch circle of half-angle rho has the radius R sin rho
    return value / sin(float(cones[configuration.kinds.index(kind)]))
