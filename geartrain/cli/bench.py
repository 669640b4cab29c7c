"""`geartrain bench`: error against run time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Protocol

import typer

from geartrain.cli.common import Force, Json, Out, Sink, as_json, emit, sink


class BenchmarkTables(Protocol):
    """What a benchmark measured."""

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""

    def to_markdown(self) -> str:
        """Tables."""


app = typer.Typer(
    add_completion=False, help="Measure error against run time, as ratios within one run.", no_args_is_help=True
)


@app.callback()
def _group() -> None:
    pass


@app.command()
def kinematics(
    most: Annotated[int, typer.Option("--most", help="Largest number of links.")] = 100_000,
    least: Annotated[int, typer.Option("--least", help="Smallest number of links; 0 adds two shipped trains.")] = 0,
    family: Annotated[list[str] | None, typer.Option("--family", help="Only this family; may be repeated.")] = None,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Time and true error of every way to speeds over size: exact, walking, sparse LU by ordering, refined."""
    from rich.console import Console
    from rich.progress import Progress

    from geartrain import bench

    to = sink(out, force)
    families = family or list(bench.FAMILIES)
    if unknown := [name for name in families if name not in bench.FAMILIES]:
        raise typer.BadParameter(f"'{unknown[0]}' is no family; use {', '.join(bench.FAMILIES)}", param_hint="--family")
    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("kinematics", total=bench.count_steps(most, least, families))
        results = bench.kinematics(
            most, lambda step: progress.update(task, advance=1, description=step), least, families
        )
    emit(as_json(results.to_dict()) if json else results.to_markdown(), to)


@app.command()
def mesh(
    quick: Annotated[bool, typer.Option("--quick", help="Two pairs and fewer angles.")] = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Time and true error of every way to the law of triangular teeth: direct, tabulated, sampled, scanned."""
    from geartrain import bench

    _measure("mesh", bench.count_mesh_steps(quick), lambda tell: bench.mesh(quick, tell), json, sink(out, force))


@app.command()
def motion(
    quick: Annotated[bool, typer.Option("--quick", help="Two trains and at most 20 000 positions.")] = False,
    positions: Annotated[int, typer.Option("--positions", min=1000, help="Positions of each train.")] = 1_000_000,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Time and error of every way to the motion of whole trains: direct, tabulated, superposed, estimated, marched."""
    from geartrain import bench

    _measure(
        "motion",
        bench.count_motion_steps(quick),
        lambda tell: bench.motion(quick, positions, tell),
        json,
        sink(out, force),
    )


@app.command()
def sphere(
    quick: Annotated[bool, typer.Option("--quick", help="Graphs of up to 32 gears, and few loops.")] = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Residual against steps and time of gears on a sphere: circles, axes moved, loops by fractions and by floats."""
    from geartrain import bench

    _measure("sphere", bench.count_sphere_steps(quick), lambda tell: bench.sphere(quick, tell), json, sink(out, force))


@app.command()
def shapes(
    quick: Annotated[bool, typer.Option("--quick", help="Few settings, and few extreme pairs.")] = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Time and true error of every way to optimal tooth shapes: marched, collocated, in closed form, searched."""
    from geartrain import bench

    _measure("shapes", bench.count_shape_steps(quick), lambda tell: bench.shapes(quick, tell), json, sink(out, force))


@app.command()
def teeth(
    quick: Annotated[bool, typer.Option("--quick", help="Few and small questions.")] = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Best error and time of ways to tooth numbers: factored, by stage, sorted products, in a train, every set."""
    from geartrain import bench

    _measure("teeth", bench.count_teeth_steps(quick), lambda tell: bench.teeth(quick, tell), json, sink(out, force))


@app.command()
def uncertainty(
    quick: Annotated[bool, typer.Option("--quick", help="Few trials, and one round.")] = False,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Trials a second and errors of estimates: counts in doubt, wheels cut by hand, against plain loops and truths."""
    from geartrain import bench

    steps = bench.count_uncertainty_steps(quick)
    _measure("uncertainty", steps, lambda tell: bench.uncertainty(quick, tell), json, sink(out, force))


def _measure(
    name: str, steps: int, run: Callable[[Callable[[str], None]], BenchmarkTables], json: bool, to: Sink
) -> None:
    """Run a benchmark under a progress bar, and print what it measured."""
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(name, total=steps)
        results = run(lambda step: progress.update(task, advance=1, description=step))
    emit(as_json(results.to_dict()) if json else results.to_markdown(), to)
