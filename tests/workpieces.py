"""Solid models of shipped trains, made once for all tests that only read them, and their written outlines."""

from __future__ import annotations

import csv
from functools import cache
from io import StringIO
from typing import Any

import shipped

from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.workshop import export_files
from geartrain.workshop.export.assembly_guide import assembly_steps
from geartrain.workshop.export.proof.mesh_proof import paired_wheels, prove_mesh, read_wheels
from geartrain.workshop.export.proof.turned_pair import cut_lines


@cache
def workpiece(name: str, state: str | None = None, **making: Any) -> SolidModel:
    """Return the solid model of a shipped train in a state, by default the first."""
    train = shipped.train(name)
    model = SolidModel(train, ManufacturingSizes(**making), train.declaration.state_or_first(state))
    vars(model)["_laid"] = shipped.layout(name)  # as the model itself would lay out the train, for each of its sizes
    return model


def part_rows(work: SolidModel) -> dict[str, dict[str, str]]:
    """Return the rows of the list of parts by the name of each part."""
    (file,) = (each for each in export_files(work, ["svg"]) if each.path == "parts.csv")
    return {name: row for row in csv.DictReader(StringIO(file.make().decode())) for name in row["part"].split(", ")}


def steps(work: SolidModel) -> list[Any]:
    """Return the steps of assembly, each with its parts and its text."""
    return list(assembly_steps(work))


def outlines(svg: str, tolerance: float = 1e-5) -> list[list[tuple[float, float]]]:
    """Return the closed lines of a drawing to cut [mm], with arcs as chords."""
    return cut_lines(svg, tolerance)


def written_pairs(work: SolidModel) -> dict[str, Any]:
    """Return the pairs whose wheels are cut: stated backlash, wheels, and the written outlines to turn."""
    return dict(paired_wheels(work, read_wheels(work)))


def proofs(work: SolidModel) -> dict[str, Any]:
    """Return the proof of each pair whose wheels are placed where they mesh, by turning the written outlines."""
    return {pair: prove_mesh(*each) for pair, each in written_pairs(work).items() if pair not in work.layout.apart}
