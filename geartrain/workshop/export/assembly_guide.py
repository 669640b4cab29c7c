"""The README of an exported folder: its files, its parts with masses and fits, their assembly, and what is missing."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import degrees
from typing import TYPE_CHECKING

from geartrain.errors import Problem, install_command, printable
from geartrain.kinematics.buildability import BuildFinding
from geartrain.numerics.markdown_text import markdown_text
from geartrain.scene.parts.arbor_columns import SHAKE
from geartrain.workshop.export.assembly_pictures import picture_path
from geartrain.workshop.export.assembly_steps import assembly_steps
from geartrain.workshop.export.parts_list import ListedPart, parts_list
from geartrain.workshop.export.proof.cut_outlines import TOLERANCE
from geartrain.workshop.export.proof.mesh_proof import ALLOWED, MeshProof
from geartrain.workshop.export.proof.train_proof import TrainProof
from geartrain.workshop.export.proof.turned_pair import NOTHING

if TYPE_CHECKING:
    from geartrain.dynamics.train_teeth import PairPlay
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.workshop.export.proof import TrainProof


def unproved() -> str:
    """The first sentence of a README where nothing can be proved."""
    return f"**Not proved**: nothing was turned, for shapely and manifold3d are missing: `{install_command('proof')}`."


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
        lines += [unproved(), ""]
    lines += ["Lengths are in mm, drawings 1:1. Of their layers CUT is cut, PITCH guides, ENGRAVE is letters.", ""]
    lines += ["| file | what it is |", "| --- | --- |"]
    pictures = any(path == picture_path(1) for path, _ in files)
    lines += [f"| {path} | {_cell(title)} |" for path, title in files if not path.startswith("assembly/")]
    if pictures:
        lines.append("| assembly/ | a picture of each step of putting it together |")
    if proof is not None:
        lines += proof_lines(proof, _cell)
    if parts:
        lines += [*_plays(work), *_parts(parts_list(work))]
        if work.frame is not None:
            lines += ["", "## Fits", "", *_fits(work), "", "## Putting it together", "", *_steps(work, pictures)]
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


def _steps(work: SolidModel, pictures: bool) -> Iterator[str]:
    for number, step in enumerate(assembly_steps(work), 1):
        picture = f" ([picture]({picture_path(number)}))" if pictures and step.parts and step.shown else ""
        yield f"{number}. {_cell(step.text)}{picture}"


def _cell(text: str) -> str:
    return printable(markdown_text(text).replace("|", "\\|").replace("\n", " "))


# ---------------------------------------------------------------------------------------------------------------- proof

_GROUPS = "In the way:", "Not among the files, to be made by hand:", "Noted:"
_BY_HAND = "W3", "S1"  # notes that a wheel has no drawing, or an axis no bearing
_HEADER = "| mesh | play declared | least play | overlap mm2 | contact ratio | clearance | tip width | verdict |"


def verdict_lines(proof: TrainProof, cell: Callable[[str], str]) -> list[str]:
    """The verdict and what is in the way; `cell` makes a text safe in Markdown."""
    lines = [f"**{'Ready to cut.' if proof.is_ready else 'Not ready to cut.'}**", ""]
    groups: dict[str, list[BuildFinding]] = {}
    for found in proof.findings:
        groups.setdefault(_group(found), []).append(found)
    for title in _GROUPS:
        lines += [title, "", *_items(groups[title], cell), ""] if title in groups else []
    return lines


def _group(found: BuildFinding) -> str:
    """Which of the lists a finding stands in."""
    return _GROUPS[0 if found.is_error else 1 if found.rule in _BY_HAND else 2]


def _items(findings: list[BuildFinding], cell: Callable[[str], str]) -> list[str]:
    return [f"- {cell(found.text)}" for found in findings]


def proof_lines(proof: TrainProof, cell: Callable[[str], str]) -> list[str]:
    """What was measured, and how."""
    lines = ["", "## Proved on the outlines as written", ""]
    lines += [
        f"The drawings were read back, arcs as chords within {TOLERANCE:g} mm, and the wheels of every mesh turned",
        f"through a pitch. An overlap above {NOTHING:g} mm2 counts, and play may be {ALLOWED:g} mm less than declared.",
        "Lengths are in mm.",
        "",
        _HEADER,
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |",
        *(_row(mesh, cell) for mesh in proof.meshes),
    ]
    if proof.links:
        lines += ["", "While the input is held, the teeth let each link turn by:", ""]
        lines += ["| link | degrees |", "| --- | ---: |"]
        lines += [f"| {cell(each.link)} | {_turn(each.play)} |" for each in proof.links]
    return lines


def _row(mesh: MeshProof, cell: Callable[[str], str]) -> str:
    ratio = "-" if mesh.contact_ratio is None else f"{mesh.contact_ratio:.3f}"
    errors = [found.rule for found in mesh.findings if found.is_error]
    words = " ".join(errors) if errors else "turns"
    values = (cell(mesh.pair), f"{mesh.declared:.4f}", f"{mesh.least:.4f}", f"{mesh.overlap:.2g}", ratio)
    return f"| {' | '.join(values)} | {mesh.clearance:.3f} | {mesh.tip_width:.3f} | {words} |"


def _turn(play: float | None) -> str:
    return "free" if play is None else f"{degrees(max(play, 0.0)):.3g}"
