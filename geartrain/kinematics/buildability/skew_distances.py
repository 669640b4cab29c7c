"""Whether axes that pass each other stand as far apart as the helical wheels or the worm between them ask."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import cos
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding
from geartrain.kinematics.buildability.pitch_distances import PitchDistances
from geartrain.kinematics.buildability.pitch_pairs import SLACK, PitchPair
from geartrain.kinematics.circuits import Axes
from geartrain.kinematics.circuits.shaft_angles import passing_distance

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Tree
    from geartrain.train import Train

_EQUAL = 1e-6  # of the distance: positions are rounded as they are written


def check_skew(train: Train, tree: Tree, pairs: Sequence[PitchPair], sizes: PitchDistances) -> Iterator[BuildFinding]:
    """Rule K4: the common perpendicular of two axes is both pitch radii long, m z/(2 cos(helix)) each."""
    axes = Axes(train, tree)
    for pair in pairs:
        if pair.parallel or any(wheel.helix_angle is None for wheel in pair.declared):
            continue
        module, offset = sizes.module(pair.wheels[0]), passing_distance(axes, pair.axes)
        if module is None or not offset:
            continue
        radii = [float(module) * (wheel.count or 0) / 2 / cos(wheel.helix) for wheel in pair.declared]
        off = 1000 * offset - sum(radii)
        if abs(off) > _EQUAL * sum(radii):
            yield _misplaced(pair, radii, off, module)


def _misplaced(pair: PitchPair, radii: Sequence[float], off: float, module: Fraction) -> BuildFinding:
    first, second = pair.axes
    sides = " and ".join(f"'{wheel}' {radius:.6g}" for wheel, radius in zip(pair.wheels, radii, strict=True))
    what = (
        f"pair '{pair.name}': axes '{first}' and '{second}' pass each other at {sum(radii) + off:.6g} mm, "
        f"and the pair needs {sum(radii):.6g} mm"
    )
    why = f"the pitch radii are {sides} mm, and touch on the common perpendicular"
    fix = f"move an axis by {abs(off):.6g} mm, or change a module, a tooth count or the helix angles"
    return BuildFinding("K4", "note" if abs(off) <= SLACK * module else "error", Problem(what, why, fix, pair.place))
