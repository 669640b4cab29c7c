"""What is told of a pair with triangular teeth: its clearance and window, its law, its collisions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from geartrain.numerics.plain_data import Key, Result, finite
from geartrain.teeth.pair_account import AccountTable, PairAccount, PairFigures, motion_figures
from geartrain.teeth.transmission_figures import SlidingEfficiency
from geartrain.teeth.triangular.clearance_window import ClearanceWindow
from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.real_path import DriveInterval
from geartrain.teeth.triangular.speed_jump import SpeedJump
from geartrain.teeth.triangular.triangular_explanations import explain_clearance

if TYPE_CHECKING:
    from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

_WORDS = (
    "Triangular teeth, each pair in its carrier's frame. Speed ratio over its mean, transmission error of the driven "
    "wheel, mean sliding efficiency at constant driver torque, relative leaps of normal velocity."
)
_PLACE = ("pair", "drives", "clearance", "window", "verdict")
_LAW = ("pair", "tau/mean", "error p-p (deg)", "efficiency", "jumps")


_WINDOW = (
    *(Key("jam", "jam_factor"), "jam_kind", Key("run", "run_factor"), "run_kind"),
    *(Key("reach", "reach_factor"), "works"),
)
_SIZES = (
    *("radii", "half_angles", "depths", Key("centre_distance", "D")),
    *(Key("reach", "reach1"), Key("matching", to=finite)),
)


@dataclass(frozen=True)
class TriangularFigures(PairFigures):
    """Figures of a pair with triangular teeth; angles in rad.

    sizes       in m, or the plain unit of radii
    window      clearance factors between which the pair turns; None where there are no such teeth
    intervals   the real path, in order of time, one pitch of the driver
    jumps       the collisions of a pitch
    impacts     what they cost, where a run of the pair is declared; else None
    """

    KEYS = (
        *PairFigures.KEYS,
        *(Key("clearance", "sizes.clearance_factor"), Key("window", keys=_WINDOW), Key("sizes", keys=_SIZES)),
        *(Key("intervals", keys=("phase", "start", "end")), "jumps", "impacts"),
    )

    sizes: TriangularSizes
    window: ClearanceWindow | None
    intervals: tuple[DriveInterval, ...]
    jumps: tuple[SpeedJump, ...]
    impacts: Any = None


def triangular_account(mesh: TriangularMesh) -> PairAccount:
    """A row on its clearance and one on its law, and the figures."""
    figures = triangular_figures(mesh.law, mesh.window, losses=mesh.efficiency(mesh.driver))
    tables = AccountTable(_PLACE, _place_row(mesh)), AccountTable(_LAW, _law_row(mesh, figures))
    return PairAccount(_WORDS, tables, figures)


def _place_row(mesh: TriangularMesh) -> tuple[str, ...]:
    law, window = mesh.law, mesh.window
    where = (
        "-"
        if window is None
        else f"{window.jam_factor:.5f} {window.jam_kind} .. {window.run_factor:.5f} {window.run_kind}"
    )
    return (mesh.name, f"{mesh.driver} -> {mesh.driven}", f"{law.sizes.clearance_factor:.6g}", where, law.verdict.kind)


def _law_row(mesh: TriangularMesh, figures: TriangularFigures) -> tuple[str, ...]:
    speed, efficiency = figures.speed_ratio, figures.efficiency
    if speed is None or efficiency is None:
        return (mesh.name, "-", "-", "-", "-")
    least, most = speed.relative
    lost = efficiency.text if mesh.tells_losses else "-"
    jumps = ", ".join(f"{jump.value:.4f}" for jump in figures.jumps)
    return (mesh.name, f"{least:.5f}..{most:.5f}", figures.error_text, lost, jumps)


def triangular_figures(
    law: TriangularTransmission,
    window: ClearanceWindow | None,
    impacts: Result | None = None,
    losses: SlidingEfficiency | None = None,
) -> TriangularFigures:
    """Of a pair, whatever train it is in; `losses` where they are not those of the law alone."""
    found, moves = law.verdict, bool(law.intervals)
    return TriangularFigures(
        (law.sizes.z1, law.sizes.z2),
        found if found else found.explained(*explain_clearance(law, window)),
        *motion_figures(law, moves),
        (losses or SlidingEfficiency(law)) if moves else None,
        sizes=law.sizes,
        window=window,
        intervals=law.intervals,
        jumps=tuple(law.jumps) if moves else (),
        impacts=impacts,
    )
