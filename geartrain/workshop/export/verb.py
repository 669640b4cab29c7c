"""Command `geartrain export`: write files for manufacturing and for other programs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from geartrain.cli.common import (
    GOOD,
    INTERRUPTED,
    VERDICT,
    File,
    FirstState,
    Force,
    Sink,
    Without,
    is_sound,
    sink,
    tell,
)
from geartrain.cli.long_runs import progress
from geartrain.cli.option_values import input_rate, quantity
from geartrain.cli.option_values import restitution as read_restitution
from geartrain.cli.option_values import turns as read_turns
from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.exact import plural
from geartrain.wings import wing

if TYPE_CHECKING:
    from geartrain.scene import ManufacturingSizes, SolidModel
    from geartrain.workshop.export.proof import TrainProof

_PATIENCE = 2.0  # seconds before a progress bar is shown
_SHOWN = 8  # maximum number of notices on the terminal; all are in the README
Size = str | None


def run(
    file: File,
    to: Annotated[Path | None, typer.Option("--to", help="Write all files to this folder.")] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--output-file",
            "-o",
            help="Write one file: .glb, .stl, .step, .graphml, .dot, .rexsj, .rexs, .urdf, .xml (MJCF) or .fmu.",
        ),
    ] = None,
    kinds: Annotated[
        str | None,
        typer.Option(
            "--as",
            help="Kinds of files for --to, separated by commas: svg, dxf, stl, glb, step, graphml, dot, rexs, csv.",
        ),
    ] = None,
    wheel: Annotated[
        str | None, typer.Option("--wheel", help="Write only this wheel with -o, as .svg, .dxf or .stl.")
    ] = None,
    state: FirstState = None,
    module: Annotated[
        Size,
        typer.Option(
            "--module",
            help="Module (pitch diameter divided by tooth count) of a train without declared sizes, such as 1mm.",
        ),
    ] = None,
    thickness: Annotated[Size, typer.Option("--thickness", help="Thickness of wheels and plates, such as 2mm.")] = None,
    bore: Annotated[
        Size, typer.Option("--bore", help="Diameter of all arbors, such as 3mm; 0mm omits arbors, plates and bores.")
    ] = None,
    backlash: Annotated[
        Size,
        typer.Option(
            "--backlash",
            help="Backlash at the pitch circles of every pair without a declared backlash, such as 0.05mm.",
        ),
    ] = None,
    process: Annotated[
        str | None,
        typer.Option(
            "--process", help="Manufacturing process: laser, cnc, fdm or hand; it sets kerf, fits and backlash."
        ),
    ] = None,
    spokes: Annotated[
        int | None, typer.Option("--spokes", help="Number of spokes (crossings) of every wheel that is large enough.")
    ] = None,
    sheet: Annotated[
        str | None,
        typer.Option("--sheet", help="With --to: lay out all flat parts on sheets of this size, such as 300x200mm."),
    ] = None,
    turns: Annotated[
        str | None, typer.Option("--turns", help="Revolutions of the driving link in the animation of the GLB.")
    ] = None,
    rate: Annotated[
        str | None,
        typer.Option(
            "--rate",
            help="Input speed of the FMU, in turns per second or with a unit such as '30 rpm'; "
            "default: the declared speed.",
        ),
    ] = None,
    restitution: Annotated[
        str | None,
        typer.Option(
            "--restitution",
            help="Coefficient of restitution of every impact in the FMU, 0 to 1; default: the declared value, or 0.",
        ),
    ] = None,
    step: Annotated[
        Size,
        typer.Option(
            "--time-step",
            help="Time step of the FMU, such as 0.0001s; the default depends on the tooth mesh frequency.",
        ),
    ] = None,
    without: Without = None,
    force: Force = False,
) -> None:
    """Export a train: wheels and plates to cut, the assembly as solids, the graph, REXS, an FMU and tables.

    The exit code is 1 if the parts of a folder are not ready to cut.

    Example: `geartrain export planetary --to parts --module 2mm`.
    """
    from geartrain.analysis.gear_train import load
    from geartrain.scene import SolidModel

    if (to is None) == (out is None):
        what = "no output file or folder is given" if to is None else "--to and -o are both given"
        why = "an export writes either a folder of files or a single file"
        raise GearTrainError(Problem(what, why, "give --to FOLDER for all files, or -o FILE for one", "export"))
    of_time = {"--rate": rate, "--restitution": restitution, "--time-step": step, "--without": without or None}
    of_solids: dict[str, object] = {"--wheel": wheel, "--module": module, "--thickness": thickness, "--bore": bore}
    of_solids |= {"--backlash": backlash, "--process": process, "--spokes": spokes, "--sheet": sheet, "--turns": turns}
    if out is not None and out.suffix.lower() == ".fmu":
        _refuse(
            of_solids, "does not apply to an .fmu", "an FMU contains the motion of a train, not its parts", "omit it"
        )
        _unit(file, state, of_time, sink(out, force))
        return
    why = "only an FMU contains the motion in time"
    _refuse(of_time, "applies only to an .fmu", why, "give -o FILE.fmu, or omit it")
    train = load(file)
    if out is not None:
        why = "only a folder has drawings of all parts, which are laid out on sheets"
        _refuse({"--sheet": sheet}, "applies only to a folder", why, "give --to FOLDER instead of -o")
    lengths = {"module": module, "thickness": thickness, "bore": bore, "backlash": backlash}
    work = SolidModel(train, _sizes(lengths, process, spokes, sheet), train.declaration.state_or_first(state))
    shown = None if turns is None else read_turns("--turns", turns)
    ready = True
    if out is not None:
        _write_one(work, out, wheel, shown, force)
    else:
        assert to is not None
        ready = _write_folder(work, to, kinds, wheel, shown, force)
    raise typer.Exit(GOOD if ready and is_sound(work.sized, state) else VERDICT)


def _refuse(given: Mapping[str, object], what: str, why: str, fix: str) -> None:
    """Raise `GearTrainError` if any given option does not apply to the requested file."""
    for option, value in given.items():
        if value is not None:
            raise GearTrainError(Problem(f"{option} {what}", why, fix, option))


def _unit(file: str, state: str | None, of_time: Mapping[str, Any], to: Sink) -> None:
    """Write a functional mock-up unit (FMU) for co-simulation, and end the command."""
    from geartrain.analysis.gear_train import load

    simulation = wing("simulation")

    rate, restitution, step, without = of_time.values()
    train = load(file)
    case = simulation.CoSimulationCase(
        train.declaration.state_or_first(state),
        None if rate is None else input_rate(rate),
        None if step is None else quantity("--time-step", step, "time", minimum="above 0"),
        None if restitution is None else read_restitution(restitution),
        tuple(without or ()),
    )
    to.write(simulation.fmu_file(train, case))
    raise typer.Exit(GOOD if is_sound(train, state) else VERDICT)


def _sizes(given: Mapping[str, Size], process: str | None, spokes: int | None, sheet: str | None) -> ManufacturingSizes:
    from geartrain.scene import ManufacturingSizes

    # lengths are read in m, but sizes of parts are in mm
    sizes = {
        name: None if text is None else 1000 * quantity(f"--{name}", text, "length") for name, text in given.items()
    }
    return ManufacturingSizes(**sizes, process=process, arms=spokes, sheet=None if sheet is None else _sheet(sheet))


def _sheet(text: str) -> tuple[float, float]:
    """Parse the width and height of a sheet [mm] from text such as 300x200mm."""
    sides = text.lower().replace("×", "x").split("x")
    unit = sides[-1].strip().lstrip("0123456789.+-/ e")
    if len(sides) != 2 or not unit:
        what = f"'{text}' is not the size of a sheet"
        raise GearTrainError(
            Problem(what, "a sheet size is WIDTHxHEIGHT with a unit", "for example, 300x200mm", "--sheet")
        )
    # a unit after the last side only applies to both sides
    width, height = (side if side.strip().endswith(unit) else side + unit for side in sides)
    return 1000 * quantity("--sheet", width, "length"), 1000 * quantity("--sheet", height, "length")


def _write_one(work: SolidModel, out: Path, wheel: str | None, turns: Fraction | None, force: bool) -> None:
    from geartrain.workshop.export.file_set import WHEEL_SUFFIXES, kind_of, simplifications, train_file, wheel_file

    suffix = out.suffix.lower()
    if wheel is not None and suffix not in WHEEL_SUFFIXES:
        fix = f"use {', '.join(WHEEL_SUFFIXES)}"
        raise GearTrainError(
            Problem(f"a wheel cannot be written as '{suffix or out.name}'", "the suffix selects the format", fix, "-o")
        )
    kind = "" if wheel is not None else kind_of(out.name)
    to = sink(out, force)
    to.write(wheel_file(work, wheel, suffix) if wheel is not None else train_file(work, kind, turns))
    for problem in simplifications(work, kind):
        tell(f"note: {problem}")


def _write_folder(
    work: SolidModel, to: Path, kinds: str | None, wheel: str | None, turns: Fraction | None, force: bool
) -> bool:
    """Write all files of an export. Return False if its parts are proved not to be ready to cut, True otherwise."""
    from geartrain.numerics.files import check_folder, write_folder
    from geartrain.workshop.export.assembly_guide import unproved
    from geartrain.workshop.export.file_set import KINDS, export_files, installed, notices, parts_requested

    if wheel is not None:
        what = "--wheel applies only to one file"
        raise GearTrainError(
            Problem(what, "--to writes all wheels to a folder", "give -o FILE instead of --to", "--wheel")
        )
    wanted = [kind.strip().lower() for kind in kinds.split(",")] if kinds is not None else list(KINDS)
    missing: list[Problem] = []
    if kinds is None:
        wanted, missing = installed(wanted)
    proof = _proof(work) if parts_requested(wanted) else None
    files = export_files(work, wanted, turns, proof)
    check_folder(to, [each.path for each in files], force)
    try:
        count = write_folder(to, _with_progress(((each.path, each.make()) for each in files), len(files)), force)
    except KeyboardInterrupt:
        tell(f"stopped; no files were written to {to}")
        raise typer.Exit(INTERRUPTED) from None
    problems = [*missing, *notices(work, wanted)]
    for problem in problems[:_SHOWN]:
        tell(f"note: {problem}")
    if len(problems) > _SHOWN:
        tell(f"note: {len(problems) - _SHOWN} more notes are in README.md")
    tell(f"wrote {plural(count, 'file')} to {to}")
    if parts_requested(wanted):
        tell(unproved().replace("*", "").replace("`", "") if proof is None else proof.verdict)
    return proof is None or proof.is_ready


def _proof(work: SolidModel) -> TrainProof | None:
    """Return the proof of the train, computed with a progress bar, or None if its libraries are not installed."""
    from geartrain.workshop.export.proof import proof_is_installed, proof_steps, prove_train

    if not proof_is_installed():
        return None
    with progress("proof", proof_steps(work), _PATIENCE) as bar:
        return prove_train(work, bar.advance)


def _with_progress(files: Iterable[tuple[str, bytes]], count: int) -> Iterator[tuple[str, bytes]]:
    """Yield the given files unchanged, and show a progress bar if writing them takes long."""
    with progress("export", count, _PATIENCE) as bar:
        for each in files:
            yield each
            bar.advance()
