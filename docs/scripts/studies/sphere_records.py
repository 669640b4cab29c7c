"""What the study of gears on a sphere measured, and its tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.spherical.graph_set import Aim
from studies.records import StudyRecords

TARGET = 1e-11
"""Residual of the radii (rad) to which both ways to them are timed."""
TOLERANCE = 1e-9
"""Pitches by which a float loop may miss and still counts as closed, unless a caller says otherwise."""


@dataclass(frozen=True, slots=True)
class PackRecord:
    """The circles of one graph.

    steps       seconds and largest residual (rad) after each Newton step for the radii; the first with its preparation
    seconds     of the whole packing: radii, places, centre and polish
    residual    largest error of a tangency or right angle that the packing states (rad)
    judged      the same in 40 digits, from axes and half-angles (rad)
    overlaps    pairs of gears whose circles overlap
    sweeps      of the fixed point until its residual is below `TARGET`, or patience ends
    swept       seconds of these, `left` their residual (rad)
    trace       sweeps and residuals (rad) of the fixed point on its way
    """

    family: str
    gears: int
    meshes: int
    steps: Sequence[tuple[float, float]]
    seconds: float
    residual: float
    judged: float
    overlaps: int
    sweeps: int
    swept: float
    left: float
    trace: Sequence[tuple[int, float]]

    @property
    def counted(self) -> Sequence[tuple[float, float]]:
        """The Newton steps up to the first with a residual below `TARGET`."""
        last = next((at for at, (_, residual) in enumerate(self.steps) if residual < TARGET), len(self.steps) - 1)
        return self.steps[: last + 1]

    @property
    def newton(self) -> float:
        """Seconds of the Newton steps down to `TARGET`."""
        return sum(seconds for seconds, _ in self.counted)

    @property
    def ratio(self) -> float:
        """Seconds of the fixed point over those of Newton's method, to the same residual."""
        return self.swept / self.newton


@dataclass(frozen=True, slots=True)
class FitRecord:
    """Axes moved from a packing until whole teeth fit.

    minimum      teeth of the smallest gear, `most` those of the largest
    steps      of the fit
    residual   ln(greatest pitch / least pitch) for the aim "pitch", largest residue of a loop (pitches) for "phases"
    moved      the farthest that an axis moved (deg)
    """

    family: str
    gears: int
    aim: Aim
    minimum: int
    most: int
    steps: int
    residual: float
    exact: bool
    moved: float


@dataclass(frozen=True, slots=True)
class ClosureRecord:
    """Loops with tooth numbers from 10^power up to 10^(power + 1), by one method.

    error     largest difference of a residue from the truth (pitches)
    wrong     verdicts that are wrong at `TOLERANCE`
    seconds   for one loop
    """

    family: str
    method: str
    power: int
    loops: int
    error: float
    wrong: int
    seconds: float


@dataclass(frozen=True)
class SphereRecords(StudyRecords):
    """All measurements of one run on one machine."""

    packings: Sequence[PackRecord]
    fits: Sequence[FitRecord]
    closures: Sequence[ClosureRecord]
