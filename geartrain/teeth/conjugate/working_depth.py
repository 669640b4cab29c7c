"""The working depth of two sides, and the heat that gives teeth of uniform temperature a wanted one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import nan
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.roots import root
from geartrain.teeth.conjugate.path_costs import height

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.path_side import PathSide
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

_STEP, _STEPS = 1.25, 40  # growth of the bracket, and how often it may grow: by 1.25^40 = 7500


def working_depth(pitch: PitchSurfaces, sides: Sequence[PathSide]) -> float:
    """Heights of the last contacts over the pitch line, summed (modules; rad)."""
    return sum(height(pitch, side) for side in sides)


def to_depth(depth: Callable[[float], float], wanted: float, start: float, most: float) -> float:
    """The gamma = (A + B) / heat whose `depth`, which grows with it, is as wanted; looked for around `start`.

    most   a depth that no heat gives, such as the arcs summed: a contact rises by less than it travels

    Raises `GearTrainError` where no heat gives that depth.
    """

    def off(gamma: float) -> float:
        try:
            return depth(gamma) - wanted
        except GearTrainError:
            return nan  # too steep to be reached, or too hot for the contact to move

    low = high = start
    at_low = at_high = off(start) if wanted < most else nan
    for _ in range(_STEPS if wanted < most else 0):
        if at_low < 0 < at_high or at_low == 0:
            break
        # upwards while even the hottest is too low; NaN, which cannot be reached, and too deep both lead downwards
        if not at_high >= 0 and at_high == at_high:
            low, at_low, high = high, at_high, high * _STEP
            at_high = off(high)
        else:
            high, at_high, low = low, at_low, low / _STEP
            at_low = off(low)
    if not (at_low <= 0 <= at_high):
        what = f"no heat gives these teeth a working depth of {wanted:.6g}"
        if at_low > 0:
            raise GearTrainError(
                Problem(what, "even the hottest are deeper", "ask for more depth or shorter arcs, or give the heat")
            )
        raise GearTrainError(
            Problem(
                what,
                "their pressure angle would reach a right angle, or their contact stand still, before",
                "ask for another depth, shorter arcs or more teeth, or give the heat",
            )
        )
    return root(off, low, high, at_low, at_high)
