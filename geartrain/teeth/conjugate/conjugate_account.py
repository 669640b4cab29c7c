"""What is told of a pair with conjugate teeth: arcs and contact ratio of the design, error, play, efficiency."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, Any

from geartrain.teeth.pair_account import (
    AccountTable,
    PairAccount,
    efficiency_data,
    efficiency_text,
    error_text,
    motion_data,
)

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_mesh import ConjugateMesh
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission
    from geartrain.teeth.conjugate.off_design import OffDesignTransmission

_WORDS = (
    "Conjugate teeth keep the ratio of tooth counts at every instant where their axes are as far apart as they are "
    "made for, involutes at any distance; others have an error there. Arcs of the driver's approach and recess, "
    "and contact ratio, in pitches, as designed; error and play in degrees of the driven wheel; mean efficiency "
    "at constant driver torque, exact in friction, as the pair is driven and driven back, teeth in contact sharing "
    "the load equally."
)
_HEADER = (
    *("pair", "drives", "teeth", "arcs", "contact ratio"),
    *("error p-p (deg)", "play (deg)", "efficiency", "driven back", "verdict"),
)


def conjugate_account(mesh: ConjugateMesh) -> PairAccount:
    """One row, and the data."""
    return PairAccount(_WORDS, (AccountTable(_HEADER, _row(mesh), wide=True),), conjugate_data(mesh))


def _row(mesh: ConjugateMesh) -> tuple[str, ...]:
    law, p = mesh.law, mesh.law.path.pitch.p
    arcs = " + ".join(f"{round(arc / p, 9):.4g}" for arc in driver_arcs(law))
    known = mesh.friction is not None and mesh.verdict
    ways = [efficiency_text(way) if known else "-" for way in (law, mesh.reversed)]
    return (
        mesh.name,
        f"{mesh.driver} -> {mesh.driven}",
        mesh.tooth_form.words,
        arcs,
        f"{law.path.contact_ratio:.5g}",
        error_text(law, mesh.rigid or bool(mesh.verdict)),
        f"{degrees(mesh.verdict.play):.4g}",
        *ways,
        mesh.verdict.kind,
    )


def driver_arcs(law: ConjugateTransmission | OffDesignTransmission) -> tuple[float, float]:
    """The driver's approach and recess (X)."""
    approach, recess = law.path.arcs
    return (approach, recess) if law.driver == 1 else (recess, approach)


def conjugate_data(mesh: ConjugateMesh) -> dict[str, Any]:
    """One pair as plain data, with the keys of other teeth where they mean the same; angles in rad."""
    law, path = mesh.law, mesh.law.path
    pitch, verdict = path.pitch, mesh.verdict
    teeth = [pitch.z1, pitch.z2] if law.driver == 1 else [pitch.z2, pitch.z1]
    first = verdict.faults[0] if verdict.faults else None
    return {
        "teeth": teeth,
        "verdict": {
            **verdict.to_dict(),
            "why": first.why if first else "",
            "fix": first.fix if first else "",
        },
        "gears": list(mesh.gears),
        "note": mesh.note,
        "play": verdict.play,
        "arcs": [arc / pitch.p for arc in driver_arcs(law)],
        "contact_ratio": path.contact_ratio,
        "pressure_angle": float(path.at(0.0).psi),
        "shaft_angle": pitch.R1 + pitch.R2 if pitch.bevel else None,
        **motion_data(law, mesh.rigid or bool(verdict)),
        "efficiency": efficiency_data(law) if verdict else None,
    }
