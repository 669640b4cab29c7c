"""Collisions of triangular teeth: where the speed ratio leaps as another couple takes over."""

from __future__ import annotations

from dataclasses import dataclass

from geartrain.numerics.results import Result
from geartrain.teeth.triangular.real_path import DriveInterval


@dataclass(frozen=True, slots=True)
class SpeedJump(Result):
    """A collision: tau before and after, and the relative jump 1 - before/after of Eqs. (22), (25), (26), (27).

    `kind` is the phase that begins, or "matching" where the flank of one couple falls on the other's.
    """

    KEYS = ("kind", "alpha1", "before", "after", "value")

    kind: str
    alpha1: float
    before: float
    after: float

    @property
    def value(self) -> float:
        """Relative jump of the normal velocity."""
        return 1 - self.before / self.after


def matches(last: DriveInterval, new: DriveInterval, pitch: float) -> bool:
    """True if one couple goes on from flank to flank, through the position where they match."""
    faces = last.held is None and new.held is None and last.phase != new.phase
    # both are the same root, found from either side
    return faces and abs(last.end - new.start) < 1e-9 * pitch
