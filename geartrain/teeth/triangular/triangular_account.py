"""What is told of a pair with triangular teeth: its clearance and window, its law, its collisions."""

from __future__ import annotations

from math import degrees, isfinite
from typing import TYPE_CHECKING, Any

from geartrain.teeth.pair_account import AccountTable, PairAccount, efficiency_data
from geartrain.teeth.triangular.triangular_explanations import explain_clearance

if TYPE_CHECKING:
    from geartrain.teeth.triangular.clearance_window import ClearanceWindow
    from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

_WORDS = (
    "Triangular teeth, each pair in its carrier's frame. Speed ratio over its mean, transmission error of the driven "
    "wheel, mean sliding efficiency at constant driver torque, relative leaps of normal velocity."
)
_PLACE = ("pair", "drives", "clearance", "window", "verdict")
_LAW = ("pair", "tau/mean", "error p-p (deg)", "efficiency", "jumps")


def triangular_account(mesh: TriangularMesh) -> PairAccount:
    """A row on its clearance and one on its law, and the data."""
    tables = AccountTable(_PLACE, _place_row(mesh)), AccountTable(_LAW, _law_row(mesh))
    return PairAccount(_WORDS, tables, triangular_data(mesh.law, mesh.window))


def _place_row(mesh: TriangularMesh) -> tuple[str, ...]:
    law, window = mesh.law, mesh.window
    where = (
        "-" if window is None else f"{1 + window.jam:.5f} {window.jam_kind} .. {1 + window.run:.5f} {window.run_kind}"
    )
    return (mesh.name, f"{mesh.driver} -> {mesh.driven}", f"{1 + law.sizes.excess:.6g}", where, law.verdict.kind)


def _law_row(mesh: TriangularMesh) -> tuple[str, ...]:
    law = mesh.law
    if not law.intervals:
        return (mesh.name, "-", "-", "-", "-")
    least, most = law.speed_range()
    low, high = law.error_range()
    mean = float(law.ratio)
    efficiency = "-" if mesh.friction is None else f"{law.efficiency_mean():.6f}"
    jumps = ", ".join(f"{jump.value:.4f}" for jump in law.jumps)
    return (mesh.name, f"{least / mean:.5f}..{most / mean:.5f}", f"{degrees(high - low):.6g}", efficiency, jumps)


def triangular_data(
    law: TriangularTransmission, window: ClearanceWindow | None, impacts: dict[str, Any] | None = None
) -> dict[str, Any]:
    """One pair as plain data with stable keys; angles in rad."""
    found, sizes = law.verdict, law.sizes
    why, fix = ("", "") if found else explain_clearance(law, window)
    data: dict[str, Any] = {
        "teeth": [sizes.z1, sizes.z2],
        "verdict": {"kind": found.kind, "text": found.text, "why": why, "fix": fix},
        "clearance": 1 + sizes.excess,
        "window": None if window is None else window_data(window),
        "sizes": {
            "radii": [sizes.R1, sizes.R2],
            "half_angles": [sizes.beta1, sizes.beta2],
            "depths": list(sizes.depths),
            "centre_distance": sizes.D,
            "reach": sizes.reach1,
            "matching": sizes.matching if isfinite(sizes.matching) else None,
        },
    }
    if not law.intervals:
        return data | {
            "play": None,
            "speed_ratio": None,
            "transmission_error": None,
            "efficiency": None,
            "intervals": [],
            "jumps": [],
            "impacts": None,
        }
    return data | _law_data(law) | {"impacts": impacts}


def window_data(window: ClearanceWindow) -> dict[str, Any]:
    """Clearance factors between which a pair turns."""
    return {
        "jam": 1 + window.jam,
        "jam_kind": window.jam_kind,
        "run": 1 + window.run,
        "run_kind": window.run_kind,
        "reach": 1 + window.reach,
        "works": bool(window),
    }


def _law_data(law: TriangularTransmission) -> dict[str, Any]:
    least, most = law.speed_range()
    low, high = law.error_range()
    lag, rms = law.error_moments()
    return {
        "play": law.verdict.play,
        "speed_ratio": {"mean": float(law.ratio), "exact": str(law.ratio), "min": least, "max": most},
        "transmission_error": {"peak_to_peak": high - low, "rms": rms, "mean": lag},
        "efficiency": efficiency_data(law),
        "intervals": [{"phase": i.phase, "start": i.start, "end": i.end} for i in law.intervals],
        "jumps": [
            {"kind": j.kind, "alpha1": j.alpha1, "before": j.before, "after": j.after, "value": j.value}
            for j in law.jumps
        ],
    }
