"""What `geartrain export` says of shipped trains: ready to cut or not, backlash of the outlines, seconds."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from time import process_time

import geartrain
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.workshop import export_files
from geartrain.workshop.export.file_set import KINDS, installed
from geartrain.workshop.export.proof import prove_train
from studies.records import StudyRecords

TRAINS = (
    *("longcase-clock-cycloidal", "longcase-clock-bs978", "watch-going-train", "lantern-mill"),
    *("price-1974", "voulgaris-2024-a", "freeth-2008", "freeth-2021"),
    *("planetary-24-18-60", "ravigneaux-set", "wolfrom-175", "nrel-grc-750"),
    *("bevel-differential", "humpage", "south-pointing-chariot", "cycloidal-reducer", "rv-reducer", "strain-wave"),
)


@dataclass(frozen=True, slots=True)
class ExportRecord:
    """The export of one train.

    obstacles  number of findings that prevent cutting, `first` the first of them
    meshes     pairs whose outlines were turned against each other, `backlash` their minimum (mm along the pitch circle)
    seconds    processor time of the whole command
    """

    train: str
    obstacles: int
    first: str
    meshes: int
    backlash: float | None
    parts: int
    seconds: float


@dataclass(frozen=True)
class ExportRecords(StudyRecords):
    """All trains."""

    trains: Sequence[ExportRecord]


def ready_to_cut() -> ExportRecords:
    """Export all trains without further options."""
    return ExportRecords("Ready to cut, or not", [_exported(name) for name in TRAINS])


def _exported(name: str) -> ExportRecord:
    start = process_time()
    train = geartrain.load(name)
    work = SolidModel(train, ManufacturingSizes(), train.declaration.state_or_first(None))
    proof = prove_train(work)
    kinds, _ = installed(list(KINDS))
    for each in export_files(work, kinds, None, proof):
        each.make()
    seconds = process_time() - start
    print(f"{name}: {proof.verdict}, {seconds:.1f} s", file=sys.stderr, flush=True)
    obstacles = [each.problem.text for each in proof.findings if each.is_error]
    return ExportRecord(
        name,
        len(obstacles),
        obstacles[0] if obstacles else "",
        len(proof.meshes),
        min((mesh.minimum for mesh in proof.meshes), default=None),
        len(work.parts),
        round(seconds, 1),
    )
