"""What the study of gears on a sphere measured, and its tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from geartrain.spherical.graph_set import Aim
from studies.records import StudyRecords

TARGET = 1e-11
"""Residual of the radii (rad) to which both ways to them are timed."""
TOLERANCE = 1e-9
"""Pitches by which a float loop may miss and still counts as closed, unless a caller says otherwise."""
_QUADRATIC = (0.1, 1e-11)  # rad: residuals between which the steps are near their limit and above rounding


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

    @property
    def squares(self) -> list[float]:
        """residual after a step / (residual before it)^2 (1/rad), of the steps near the solution and above rounding."""
        near, minimum = _QUADRATIC
        left = [residual for _, residual in self.steps]
        return [b / a**2 for a, b in pairwise(left) if a < near and b > minimum]


@dataclass(frozen=True, slots=True)
class FitRecord:
    """Axes moved from a packing until whole teeth fit.

    minimum      teeth of the smallest gear, `most` those of the largest
    steps      of the fit, and `seconds` of it; `whole` of everything from the graph to the sizes; `sizing` of sizes
    residual   ln(greatest pitch / least pitch) for the aim "pitch", largest residue of a loop (pitches) for "phases"
    moved      the farthest that an axis moved (deg)
    track      residual (rad for "pitch", pitches for "phases") that each step tells of
    """

    family: str
    gears: int
    aim: Aim
    minimum: int
    most: int
    steps: int
    seconds: float
    whole: float
    sizing: float
    residual: float
    exact: bool
    moved: float
    track: Sequence[float] = ()

    @property
    def strayed(self) -> bool:
        """True if the steps came within 1e-9 of a solution, and then went farther than 1e-3 from it."""
        near = next((at for at, residual in enumerate(self.track) if residual < 1e-9), len(self.track))
        return any(residual > 1e-3 for residual in self.track[near:])


@dataclass(frozen=True, slots=True)
class ClosureRecord:
    """Loops with tooth numbers from 10^power up to 10^(power + 1), by one method.

    error     largest difference of a residue from the truth (pitches)
    bound     what the method itself forecasts for it (pitches); None where it forecasts nothing
    wrong     verdicts that are wrong at `TOLERANCE`
    best      those that are wrong at half the least residue a loop can have, the best tolerance there is
    own       wrong verdicts when judged by `bound`, and `unclear` ones
    seconds   for one loop
    """

    family: str
    method: str
    power: int
    loops: int
    error: float
    wrong: int
    best: int
    seconds: float
    bound: float | None = None
    own: int = 0
    unclear: int = 0


@dataclass(frozen=True)
class SphereRecords(StudyRecords):
    """All measurements of one run on one machine."""

    packings: Sequence[PackRecord]
    fits: Sequence[FitRecord]
    closures: Sequence[ClosureRecord]


def growth(gears: Sequence[int], seconds: Sequence[float], minimum: int = 90) -> float:
    """The exponent p of seconds ~ gears^p, by least squares of logarithms over `minimum` gears and more."""
    n, s = np.log(np.array([gears, seconds], dtype=float))
    kept = np.array(gears) >= minimum
    return float(np.polyfit(n[kept], s[kept], 1)[0])
