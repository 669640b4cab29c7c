"""Triangular teeth of a gear pair, their window of clearance, and why they do not turn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.teeth.gear_mesh import GearMesh

if TYPE_CHECKING:
    from geartrain.teeth.triangular.clearance_window import ClearanceWindow, TriangularVerdict
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission


@dataclass(frozen=True)
class TriangularMesh(GearMesh):
    """A gear pair with triangular teeth."""

    law: TriangularTransmission

    @cached_property
    def reversed(self) -> TriangularTransmission:
        """The law with the other wheel driving."""
        from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

        return TriangularTransmission(self.law.sizes.swapped(), self.law.friction, self.law.direction)

    @property
    def verdict(self) -> TriangularVerdict:
        """Whether these teeth can turn."""
        return self.law.verdict

    @cached_property
    def window(self) -> ClearanceWindow | None:
        """Clearances at which they can; None where there are no such teeth."""
        from geartrain.teeth.triangular.clearance_window import find_window

        sizes = self.law.sizes
        return find_window(sizes) if sizes.has_valleys else None

    def _faults(self) -> Iterator[Problem]:
        if not self.verdict:
            yield Problem(self.verdict.text, *explain_clearance(self.law, self.window))
        elif self.law.friction >= self.law.locking_friction:
            yield Problem(*explain_friction_lock(self.law))


def explain_clearance(law: TriangularTransmission, window: ClearanceWindow | None) -> tuple[str, str]:
    """Why a pair does not turn, and what would let it: the window of clearance, and which end was passed."""
    if window is None:
        return "", "use more teeth or a smaller half_angle"
    excess = law.sizes.excess
    if not window:
        return (
            f"up to a clearance factor of {1 + window.jam:.6g} there is {window.jam_kind}, and from "
            f"{1 + window.run:.6g} on {window.run_kind}: no clearance works",
            "use more teeth, a ratio nearer to 1, or another half_angle",
        )
    end = "below" if excess < window.jam else "above"
    return (
        f"the clearance factor {1 + excess:.6g} is {end} the window of this pair, {1 + window.jam:.6g} "
        f"({window.jam_kind}) to {1 + window.run:.6g} ({window.run_kind})",
        f"give a clearance between the two, or `window: 0.5`, which is {1 + window.at(0.5):.6g}",
    )


def explain_friction_lock(law: TriangularTransmission) -> tuple[str, str, str]:
    """What, why, and what to do, where friction locks."""
    return (
        f"a friction of {law.friction:g} locks these teeth",
        "before the line of centres the driver pushes the driven apex against its own sliding: friction times the "
        f"tangent of the flank's lean reaches 1 at {law.locking_friction:.6g}",
        f"give a friction below {law.locking_friction:.4g}, or let the other wheel drive",
    )
