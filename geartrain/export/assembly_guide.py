"""The README of an exported folder: its files, its parts with masses and fits, their assembly, and what is missing."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees
from typing import TYPE_CHECKING

from geartrain.errors import Problem, printable
from geartrain.export.parts_list import ListedPart, parts_list
from geartrain.export.proof.verdict_text import proof_lines, verdict_lines
from geartrain.scene.parts.arbor_columns import SHAKE, AxisBearing, AxisColumn

if TYPE_CHECKING:
    from geartrain.dynamics.train_teeth import PairPlay
    from geartrain.export.proof import TrainProof
    from geartrain.scene.parts.frame_plates import FramePlates
    from geartrain.scene.solids.solid_assembly import SolidModel


UNPROVED = (
    "**Not proved**: nothing was turned, for shapely and manifold3d are missing: `pip install 'geartrain[proof]'`."
)
"""What stands first in a README where nothing can be proved."""


def readme(
    work: SolidModel,
    files: Sequence[tuple[str, str]],
    missing: Sequence[Problem],
    parts: bool,
    proof: TrainProof | None = None,
) -> str:
    """Whether the parts are ready to cut, what the files are, how the parts go together, and what could not be made.

    files     paths, and what each shows
    missing   what could not be made
    parts     whether some of the files show parts
    proof     None where nothing was proved
    """
    declared = work.train.declaration
    lines = [f"# {_cell(declared.name)}", "", *([_cell(declared.title), ""] if declared.title else [])]
    if proof is not None:
        lines += verdict_lines(proof, _cell)
    elif parts:
        lines += [UNPROVED, ""]
    lines += ["Lengths are in mm, drawings 1:1. Of their layers CUT is cut, PITCH guides, ENGRAVE is letters.", ""]
    lines += ["| file | what it is |", "| --- | --- |"]
    lines += [f"| {path} | {_cell(title)} |" for path, title in files]
    if proof is not None:
        lines += proof_lines(proof, _cell)
    if parts:
        lines += [*_plays(work), *_parts(parts_list(work))]
        if work.frame is not None:
            lines += ["", "## Fits", "", *_fits(work), "", "## Putting it together", "", *_steps(work, work.frame)]
    told = set() if proof is None else {found.problem for found in proof.findings}
    if left := [each for each in missing if each not in told]:
        lines += ["", "## What could not be made", ""]
        lines += [f"- {_cell(each.text)}" for each in left]
    return "\n".join([*lines, ""])


def _plays(work: SolidModel) -> list[str]:
    """The play of every pair whose wheels are cut, as a list."""
    found = [f"- {_cell(each.pair)}: {each.length:.4g} mm, {_cell(_angles(each))}" for each in work.blanks.plays]
    return ["", "## Play of the teeth as cut, along the pitch circles", "", *found] if found else []


def _angles(play: PairPlay) -> str:
    """The play as angles of both wheels; or that they jam where they stand."""
    turned = ", ".join(
        f"{degrees(angle):.4g}° of {wheel}" for wheel, angle in zip(play.wheels, play.angles, strict=True)
    )
    return f"{turned}; the pair jams" if play.length < 0 else turned


def _parts(rows: Sequence[ListedPart]) -> Iterator[str]:
    yield from ("", "## Parts", "", "| part | count | kind | material | mm | g each | fits |")
    yield "| --- | ---: | --- | --- | --- | ---: | --- |"
    for row in rows:
        cells = ", ".join(row.names), str(row.count), row.kind, row.material, row.size, f"{row.mass:.4g}", row.fits
        yield f"| {' | '.join(map(_cell, cells))} |"
    yield ""
    yield f"Together {sum(row.count * row.mass for row in rows):.4g} g, by the densities of handbooks."


def _fits(work: SolidModel) -> Iterator[str]:
    process = work.process
    yield f"Process: {process.name}. The hole of what turns is {process.running:g} mm wider than it; wheels on arbors"
    yield f"are {process.joint} (hole {process.press:+g} mm). An arbor between plates has {SHAKE:g} mm of end shake."
    kerf = f"outlines are compensated for a kerf of {process.kerf:g} mm" if process.kerf else "outlines are true size"
    yield f"In drawings {kerf}. The numbers are usual ones: cut a test piece first."


def _steps(work: SolidModel, frame: FramePlates) -> Iterator[str]:
    """In the order of heights: arbors and their wheels, the back plate with studs, all arbors, the front plate."""
    number = 0

    def step(text: str) -> str:
        nonlocal number
        number += 1
        return f"{number}. {_cell(text)}"

    low, high = (next(side for side, faces in frame.sides.items() if faces == each) for each in _order(frame))
    for column in frame.plan.all_columns:
        for text in _column_steps(work, column):
            yield step(text)
    for plate in frame.plan.turning:
        yield step(
            f"Fix '{plate.disc.name}' to '{plate.disc.link}'" + (", pins through the ring" if plate.ring else "")
        )
    yield step(f"Press the pillars, and the posts of rings, into the {low} plate")
    studs = [column.axis for column in frame.plan.columns if column.bearing is AxisBearing.BACK_STUD]
    if studs:
        yield step(f"Put the pipes on the studs of {', '.join(studs)} and press the studs into the {low} plate")
    through = sorted(
        (column for column in frame.plan.columns if not column.is_stud and column.members),
        key=lambda column: min((disc.low for each in column.members for disc in each.discs), default=0.0),
    )
    if through:
        names = ", ".join(f"{each.axis} (pivot {each.pivot:g})" for each in through)
        yield step(f"Stand the arbors in the {low} plate, lowest wheels first: {names}")
    outer = [column.axis for column in frame.plan.columns if column.bearing is AxisBearing.FRONT_STUD]
    if outer:
        yield step(f"Put the pipes on the studs of {', '.join(outer)} and press the studs into the {high} plate")
    yield step(
        f"Lead all upper pivots into the {high} plate, press it on the pillars, and try the end shake of each arbor"
    )
    yield step("Turn it by the lead through a whole turn of the slowest wheel before it is oiled")


def _order(frame: FramePlates) -> tuple[tuple[float, float], tuple[float, float]]:
    return frame.plan.places.back, frame.plan.places.front


def _column_steps(work: SolidModel, column: AxisColumn) -> Iterator[str]:
    """Which wheels go on which arbor or pipe, and which pipes over which."""
    cut = set() if work.frame is None else work.frame.plan.cut
    for member in column.members:
        wheels = [disc.name for disc in sorted(member.discs, key=lambda disc: disc.low) if disc.name not in cut]
        what = "pipe" if member.inner else "arbor"
        if wheels:
            order = ", from below in this order" if len(wheels) > 1 else ""
            yield f"Fix {', '.join(wheels)} on the {what} of '{member.link}'{order}"
    pipes = [member.link for member in column.members if member.inner]
    if pipes and not column.is_stud:
        yield f"On axis {column.axis} slide on the pipes, innermost first: {', '.join(pipes)}"


def _cell(text: str) -> str:
    return printable(text.replace("|", "\\|").replace("\n", " ").replace("<", "&lt;"))
