"""What the benchmark of gears on a sphere measured, as tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from geartrain.bench.timing import seconds_text
from geartrain.spherical.graph_set import Aim

TARGET = 1e-11
"""Residual of the radii (rad) to which both ways to them are timed."""
TOLERANCE = 1e-9
"""Pitches by which a float loop may miss and still counts as closed, unless a caller says otherwise."""
_QUADRATIC = (0.1, 1e-11)  # rad: residuals between which the steps are near their limit and above rounding


@dataclass(frozen=True, slots=True)
class PackRecord:
    """The circles of one graph.

    steps       seconds and largest residual (rad) after each Newton step for the radii
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
        near, least = _QUADRATIC
        left = [residual for _, residual in self.steps]
        return [b / a**2 for a, b in pairwise(left) if a < near and b > least]


@dataclass(frozen=True, slots=True)
class FitRecord:
    """Axes moved from a packing until whole teeth fit.

    least      teeth of the smallest gear, `most` those of the largest
    steps      of the fit, and `seconds` of these; `whole` of everything from the graph to the sizes; `sizing` of sizes
    residual   ln(greatest pitch / least pitch) for the aim "pitch", largest residue of a loop (pitches) for "phases"
    moved      the farthest that an axis moved (deg)
    track      residual (rad for "pitch", pitches for "phases") that each step tells of
    """

    family: str
    gears: int
    aim: Aim
    least: int
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


@dataclass(frozen=True, slots=True)
class SphereRecords:
    """All measurements of one run on one machine."""

    title: str
    packings: Sequence[PackRecord]
    fits: Sequence[FitRecord]
    closures: Sequence[ClosureRecord]

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return asdict(self)

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> SphereRecords:
        """What `to_dict` gave."""
        return cls(
            data["title"],
            [PackRecord(**row) for row in data["packings"]],
            [FitRecord(**row) for row in data["fits"]],
            [ClosureRecord(**row) for row in data["closures"]],
        )

    def to_markdown(self) -> str:
        """Tables of packings, their Newton steps, fits and closures."""
        lines = [f"# {self.title}", "", "## Circles", "", *_pack_table(self.packings)]
        lines += ["## Residual (rad) after each Newton step", "", *_step_table(self.packings)]
        lines += ["## Axes moved", "", *_fit_table(self.fits), "## Closure", "", *_closure_table(self.closures)]
        return "\n".join(lines)


def growth(gears: Sequence[int], seconds: Sequence[float], least: int = 90) -> float:
    """The exponent p of seconds ~ gears^p, by least squares of logarithms over `least` gears and more."""
    n, s = np.log(np.array([gears, seconds], dtype=float))
    kept = np.array(gears) >= least
    return float(np.polyfit(n[kept], s[kept], 1)[0])


def _pack_table(rows: Sequence[PackRecord]) -> list[str]:
    lines = [
        "| graph | gears | meshes | Newton steps | time | sweeps | time over Newton | whole packing | residual | "
        "in 40 digits | overlaps |",
        "|---" * 11 + "|",
    ]
    for row in rows:
        sweeps = f"{row.sweeps}" if row.left < TARGET else f"{row.sweeps}, {row.left:.0e} left"
        sort = (row.family, str(row.gears), str(row.meshes), str(len(row.counted)), seconds_text(row.newton), sweeps)
        ratio = f"{'' if row.left < TARGET else 'over '}{row.ratio:.3g}"
        ends = (ratio, seconds_text(row.seconds), f"{row.residual:.1e}", f"{row.judged:.1e}", str(row.overlaps))
        lines.append(f"| {' | '.join((*sort, *ends))} |")
    return [*lines, ""]


def _step_table(rows: Sequence[PackRecord]) -> list[str]:
    most = max(len(row.steps) for row in rows)
    lines = [f"| graph | gears | {' | '.join(str(at + 1) for at in range(most))} |", "|---" * (most + 2) + "|"]
    for row in rows:
        left = [f"{residual:.0e}" for _, residual in row.steps] + [""] * (most - len(row.steps))
        lines.append(f"| {row.family} | {row.gears} | {' | '.join(left)} |")
    return [*lines, ""]


def _fit_table(rows: Sequence[FitRecord]) -> list[str]:
    lines = [
        "| graph | gears | aim | teeth | steps | time | with packing | sizes | residual | exact | moved |",
        "|---" * 11 + "|",
    ]
    for row in rows:
        sort = (row.family, str(row.gears), row.aim, f"{row.least} to {row.most}", str(row.steps))
        times = (seconds_text(each) for each in (row.seconds, row.whole, row.sizing))
        ends = (f"{row.residual:.1e}", "yes" if row.exact else "no", f"{row.moved:.2g} deg")
        lines.append(f"| {' | '.join((*sort, *times, *ends))} |")
    return [*lines, ""]


def _closure_table(rows: Sequence[ClosureRecord]) -> list[str]:
    lines = [
        "| loops of | method | teeth | loops | error | forecast | wrong | at the best tolerance | by forecast | "
        "unclear | time a loop |",
        "|---" * 11 + "|",
    ]
    for row in rows:
        told = ("-", "-", "-") if row.bound is None else (f"{row.bound:.1e}", str(row.own), str(row.unclear))
        sort = (row.family, row.method, f"10^{row.power}", str(row.loops), f"{row.error:.1e}" if row.error else "0")
        ends = (told[0], str(row.wrong), str(row.best), *told[1:], seconds_text(row.seconds))
        lines.append(f"| {' | '.join((*sort, *ends))} |")
    return [*lines, ""]
