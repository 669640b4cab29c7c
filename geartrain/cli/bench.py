"""`geartrain bench`: error against run time."""

from __future__ import annotations

from typing import Annotated

import typer

from geartrain.cli.common import Json, Out, as_json, emit

app = typer.Typer(help="Measure error against run time, as ratios within one run.", no_args_is_help=True)


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
) -> None:
    """Time and true error of every way to speeds over size: exact, walking, sparse LU by ordering, refined."""
    from rich.console import Console
    from rich.progress import Progress

    from geartrain import bench

    families = family or list(bench.FAMILIES)
    if unknown := [name for name in families if name not in bench.FAMILIES]:
        raise typer.BadParameter(f"'{unknown[0]}' is no family; use {', '.join(bench.FAMILIES)}", param_hint="--family")
    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("kinematics", total=bench.count_steps(most, least, families))
        results = bench.kinematics(
            most, lambda step: progress.update(task, advance=1, description=step), least, families
        )
    emit(as_json(results.to_dict()) if json else results.to_markdown(), out)


@app.command()
def mesh(
    quick: Annotated[bool, typer.Option("--quick", help="Two pairs and fewer angles.")] = False,
    json: Json = False,
    out: Out = None,
) -> None:
    """Time and true error of every way to the law of triangular teeth: direct, tabulated, sampled, scanned."""
    from rich.console import Console
    from rich.progress import Progress

    from geartrain import bench

    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("mesh", total=bench.count_mesh_steps(quick))
        results = bench.mesh(quick, lambda step: progress.update(task, advance=1, description=step))
    emit(as_json(results.to_dict()) if json else results.to_markdown(), out)


@app.command()
def motion(
    quick: Annotated[bool, typer.Option("--quick", help="Two trains and at most 20 000 positions.")] = False,
    positions: Annotated[int, typer.Option("--positions", min=1000, help="Positions of each train.")] = 1_000_000,
    json: Json = False,
    out: Out = None,
) -> None:
    """Time and error of every way to the motion of whole trains: direct, tabulated, superposed, estimated, marched."""
    from rich.console import Console
    from rich.progress import Progress

    from geartrain import bench

    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("motion", total=bench.count_motion_steps(quick))
        results = bench.motion(quick, positions, lambda step: progress.update(task, advance=1, description=step))
    emit(as_json(results.to_dict()) if json else results.to_markdown(), out)


@app.command()
def sphere(
    quick: Annotated[bool, typer.Option("--quick", help="Graphs of up to 32 gears, and few loops.")] = False,
    json: Json = False,
    out: Out = None,
) -> None:
    """Residual against steps and time of gears on a sphere: circles, axes moved, loops by fractions and by floats."""
    from rich.console import Console
    from rich.progress import Progress

    from geartrain import bench

    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("sphere", total=bench.count_sphere_steps(quick))
        results = bench.sphere(quick, lambda step: progress.update(task, advance=1, description=step))
    emit(as_json(results.to_dict()) if json else results.to_markdown(), out)


@app.command()
def shapes(
    quick: Annotated[bool, typer.Option("--quick", help="Few settings, and few extreme pairs.")] = False,
    json: Json = False,
    out: Out = None,
) -> None:
    """Time and true error of every way to optimal tooth shapes: marched, collocated, in closed form, searched."""
    from rich.console import Console
    from rich.progress import Progress

    from geartrain import bench

    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("shapes", total=bench.count_shape_steps(quick))
        results = bench.shapes(quick, lambda step: progress.update(task, advance=1, description=step))
    emit(as_json(results.to_dict()) if json else results.to_markdown(), out)


@app.command()
def teeth(
    quick: Annotated[bool, typer.Option("--quick", help="Few and small questions.")] = False,
    json: Json = False,
    out: Out = None,
) -> None:
    """Best error and time of ways to tooth numbers: factored, by stage, sorted products, in a train, every set."""
    from rich.console import Console
    from rich.progress import Progress

    from geartrain import bench

    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("teeth", total=bench.count_teeth_steps(quick))
        results = bench.teeth(quick, lambda step: progress.update(task, advance=1, description=step))
    emit(as_json(results.to_dict()) if json else results.to_markdown(), out)
