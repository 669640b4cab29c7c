"""The proof of a train as Markdown: the verdict first, what is in the way, a table by mesh, the play of every link."""

from __future__ import annotations

from collections.abc import Callable
from math import degrees

from geartrain.export.proof.cut_outlines import TOLERANCE
from geartrain.export.proof.mesh_proof import ALLOWED, MeshProof
from geartrain.export.proof.train_proof import TrainProof
from geartrain.export.proof.turned_pair import NOTHING
from geartrain.kinematics.buildability import BuildFinding

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
