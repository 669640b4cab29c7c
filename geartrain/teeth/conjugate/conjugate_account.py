"""What is told of a pair with conjugate teeth: arcs and contact ratio of the design, error, play, efficiency."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees
from typing import TYPE_CHECKING

from geartrain.teeth.pair_account import AccountTable, PairAccount, PairFigures, motion_figures

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


@dataclass(frozen=True)
class ConjugateFigures(PairFigures):
    """Figures of a pair with conjugate teeth, with those of its path of contact as designed.

    arcs             of the driver's approach and recess (pitches)
    pressure_angle   at the pitch point (rad)
    shaft_angle      between the axes (rad); None where they are parallel
    """

    KEYS = (*PairFigures.KEYS, "arcs", "contact_ratio", "pressure_angle", "shaft_angle")

    arcs: tuple[float, float]
    contact_ratio: float
    pressure_angle: float
    shaft_angle: float | None


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
    )


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
