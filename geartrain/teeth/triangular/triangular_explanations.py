"""Why triangular teeth do not turn, in words, and what would let them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geartrain.teeth.triangular.clearance_window import ClearanceWindow
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission


OTHER_SHAPES = (
    "use more teeth, a ratio nearer to 1, or another half_angle",
    "use `radii: pitch_true` (teeth of equal depth do not suit a ring), more teeth, or another half_angle",
)


def explain_clearance(law: TriangularTransmission, window: ClearanceWindow | None) -> tuple[str, str]:
    """Why a pair does not turn, and what would let it: the window of clearance, and which end was passed."""
    if window is None:
        return "", "use more teeth or a smaller half_angle"
    excess, jam, run = law.sizes.excess, window.jam_factor, window.run_factor
    if not window:
        return (
            f"up to a clearance factor of {jam:.6g} there is {window.jam_kind}, and from "
            f"{run:.6g} on {window.run_kind}: no clearance works",
            OTHER_SHAPES[bool(law.sizes.ring)],
        )
    factor = window.factor(excess)
    end = "below" if factor < min(jam, run) else "above"
    return (
        f"the clearance factor {factor:.6g} is {end} the window of this pair, {jam:.6g} "
        f"({window.jam_kind}) to {run:.6g} ({window.run_kind})",
        f"give a clearance between the two, or `window: 0.5`, which is {window.factor(window.at(0.5)):.6g}",
    )


def explain_friction_lock(law: TriangularTransmission) -> tuple[str, str, str]:
    """What, why, and what to do, where friction locks."""
    return (
        f"a friction of {law.friction:g} locks these teeth",
        "before the line of centres the driver pushes the driven apex against its own sliding: friction times the "
        f"tangent of the flank's lean reaches 1 at {law.locking_friction:.6g}",
        f"give a friction below {law.locking_friction:.4g}, or let the other wheel drive",
    )
