"""Gear pairs of a train with conjugate teeth, as a table and as plain data."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, isfinite, isnan, nan
from typing import TYPE_CHECKING, Any

from geartrain.report.document import Table

if TYPE_CHECKING:
    from geartrain.meshes import ConjugateMesh
    from geartrain.teeth.conjugate import ConjugateLaw
    from geartrain.teeth.misplaced import MisplacedLaw
    from geartrain.teeth.triangular.law import TriangularLaw

    Shaped = ConjugateLaw | MisplacedLaw

WORDS = (
    "Conjugate teeth keep the ratio of tooth counts at every instant where their axes are as far apart as they are "
    "made for, involutes at any distance; others have an error there. Arcs of the driver's approach and recess, "
    "and contact ratio, in pitches, as designed; error and play in degrees of the driven wheel; mean efficiency "
    "at constant driver torque, exact in friction, as the pair is driven and driven back, teeth in contact sharing "
    "the load equally."
)


def conjugate_table(meshes: Sequence[ConjugateMesh]) -> Table:
    """One row a pair."""
    figures = ("arcs", "contact ratio", "error p-p (deg)", "play (deg)", "efficiency", "driven back")
    return Table(("pair", "drives", "teeth", *figures, "verdict"), [_row(mesh) for mesh in meshes], wide=True)


def _row(mesh: ConjugateMesh) -> tuple[str, ...]:
    law, p = mesh.law, mesh.law.path.pitch.p
    arcs = " + ".join(f"{round(arc / p, 9):.4g}" for arc in driver_arcs(law))
    known = mesh.friction is not None and mesh.verdict
    low, high = law.error_range() if mesh.rigid or mesh.verdict else (nan, nan)
    ways = [_efficiency(way) if known else "-" for way in (law, mesh.reversed)]
    return (
        mesh.name,
        f"{mesh.driver} -> {mesh.driven}",
        mesh.form.replace("_", " "),
        arcs,
        f"{law.path.contact_ratio:.5g}",
        "-" if isnan(low) else f"{degrees(high - low):.6g}",
        f"{degrees(mesh.verdict.play):.4g}",
        *ways,
        mesh.verdict.kind,
    )


def _efficiency(law: Shaped) -> str:
    return "locks" if law.friction >= law.locking_friction else f"{law.efficiency_mean():.6f}"


def driver_arcs(law: Shaped) -> tuple[float, float]:
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
        "gears": list(mesh.wheels),
        "note": mesh.note,
        "play": verdict.play,
        "arcs": [arc / pitch.p for arc in driver_arcs(law)],
        "contact_ratio": path.contact_ratio,
        "pressure_angle": float(path.at(0.0).psi),
        "shaft_angle": pitch.R1 + pitch.R2 if pitch.bevel else None,
        **_law_data(law, mesh.rigid or bool(verdict)),
        "efficiency": efficiency_data(law) if verdict else None,
    }


def _law_data(law: Shaped, runs: bool) -> dict[str, Any]:
    if not runs:
        return {"speed_ratio": None, "transmission_error": None}
    least, most = law.speed_range()
    low, high = law.error_range()
    lag, rms = law.error_moments()
    return {
        "speed_ratio": {"mean": float(law.ratio), "exact": str(law.ratio), "min": least, "max": most},
        "transmission_error": {"peak_to_peak": high - low, "rms": rms, "mean": lag},
    }


def efficiency_data(law: TriangularLaw | Shaped) -> dict[str, float | None]:
    """Friction and what it costs; null where it locks."""
    locks = law.friction >= law.locking_friction
    return {
        "friction": law.friction,
        "mean": None if locks else law.efficiency_mean(),
        "at_constant_load": None if locks else law.efficiency_at_constant_load(),
        "min": None if locks else law.efficiency_least(),
        "locks_at": law.locking_friction if isfinite(law.locking_friction) else None,
    }
