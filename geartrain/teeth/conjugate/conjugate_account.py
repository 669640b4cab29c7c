"""What is told of a pair with conjugate teeth: arcs and contact ratio of the design, error, play, efficiency."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, pi, tan
from typing import TYPE_CHECKING

from geartrain.teeth.pair_account import AccountTable, PairAccount, PairFigures, motion_figures

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_mesh import ConjugateMesh
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission
    from geartrain.teeth.conjugate.off_design import OffDesignTransmission
    from geartrain.teeth.meshing_wheels import MeshingWheels

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


@dataclass(frozen=True)
class ConjugateFigures(PairFigures):
    """Figures of a pair with conjugate teeth, with those of its path of contact as designed.

    arcs             of the driver's approach and recess (pitches)
    pressure_angle   at the pitch point (rad)
    shaft_angle      between the axes (rad); None where they are parallel
    helix_angle      of helical wheels (rad); None of straight teeth
    overlap_ratio    pitches by which helical teeth lead along their width; None where that is not known
    """

    KEYS = (
        *PairFigures.KEYS,
        "arcs",
        "contact_ratio",
        "pressure_angle",
        "shaft_angle",
        "helix_angle",
        "overlap_ratio",
    )

    arcs: tuple[float, float]
    contact_ratio: float
    pressure_angle: float
    shaft_angle: float | None
    helix_angle: float | None = None
    overlap_ratio: float | None = None


def conjugate_account(mesh: ConjugateMesh) -> PairAccount:
    """One row, and the figures."""
    figures = conjugate_figures(mesh)
    return PairAccount(_WORDS, (AccountTable(_HEADER, _row(mesh, figures), wide=True),), figures)


def conjugate_figures(mesh: ConjugateMesh) -> ConjugateFigures:
    """Of a pair as it is driven; involutes keep their motion where they cannot run."""
    law, path = mesh.law, mesh.law.path
    pitch, runs = path.pitch, bool(mesh.verdict)
    approach, recess = driver_arcs(law)
    return ConjugateFigures(
        mesh.counts,
        mesh.verdict,
        *motion_figures(law, mesh.rigid or runs),
        mesh.efficiency(mesh.driver) if runs else None,
        arcs=(approach / pitch.p, recess / pitch.p),
        contact_ratio=path.contact_ratio,
        pressure_angle=float(path.at(0.0).psi),
        shaft_angle=pitch.R1 + pitch.R2 if pitch.bevel else None,
        helix_angle=abs(mesh.wheels.helix[0]) or None,
        overlap_ratio=_overlap_ratio(mesh.wheels),
    )


def _overlap_ratio(wheels: MeshingWheels) -> float | None:
    """Width times tan helix over the transverse pitch."""
    if not wheels.helix[0] or wheels.width is None or wheels.module is None:
        return None
    return wheels.width * tan(abs(wheels.helix[0])) / (pi * wheels.module)


def _row(mesh: ConjugateMesh, figures: ConjugateFigures) -> tuple[str, ...]:
    return (
        mesh.name,
        f"{mesh.driver} -> {mesh.driven}",
        mesh.tooth_form.words,
        " + ".join(f"{round(arc, 9):.4g}" for arc in figures.arcs),
        f"{figures.contact_ratio:.5g}",
        figures.error_text,
        f"{degrees(mesh.verdict.play):.4g}",
        *mesh.efficiency_texts,
        mesh.verdict.kind,
    )


def driver_arcs(law: ConjugateTransmission | OffDesignTransmission) -> tuple[float, float]:
    """The driver's approach and recess (X)."""
    approach, recess = law.path.arcs
    return (approach, recess) if law.driver == 1 else (recess, approach)
