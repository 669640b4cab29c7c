"""How near a front couple and a back couple come to holding the driven wheel fast: the play between the two.

With the driver's front tooth at x and its back tooth `delta` before it, the play is f(x) + f'(delta - x) and what the
driven teeth add: f of the leading flank, f' of the mirrored couple. Both are the lesser of two smooth functions,
convex for ordinary teeth, so that the least play is that of one of four sums of smooth functions, or at an end of the
common reach.

The play of even wheels, and a bound on how often errors of place use it up.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from math import erfc, floor, gcd, inf, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.triangular.tooth_pair import APPROACH, RECESS
from geartrain.workshop.cutting.cut_wheel import CutGearPair, CutToothPairs

if TYPE_CHECKING:
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes


PHASES = ((RECESS, RECESS), (RECESS, APPROACH), (APPROACH, RECESS), (APPROACH, APPROACH))
_MOST_STEPS = 30  # bisections alone would leave 1e-9 of the reach
_NEAR = 1e-6  # of the common reach: a step this short leaves nothing but rounding in the value


@dataclass(frozen=True, slots=True)
class BacklashCandidate:
    """A front couple and the back couple n before it, each in one phase, and where they come nearest in even wheels."""

    n: int
    phases: tuple[str, str]
    offset: float
    """Of x there from half of n pitches (rad)."""
    backlash: float
    """There (rad of the driven wheel)."""


def common(front: CutToothPairs, back: CutToothPairs, delta: Any) -> tuple[Any, Any]:
    """The alpha_1 of the front tooth between which both couples are in reach; empty where low is above high."""
    return np.maximum(-front.reach, delta - back.reach), np.minimum(front.reach, delta + back.reach)


def minimum_backlash_sum(
    front: CutToothPairs, back: CutToothPairs, delta: Any, phases: tuple[str, str]
) -> tuple[Any, Any]:
    """Least sum of the two contacts, each in one phase, within the common reach, and where; inf where there is none.

    Newton's method safeguarded by bisection, from half way; the last step is taken in the value, by a parabola.
    """
    low, high = common(front, back, delta)
    minimum, most = low, high
    near = _NEAR * (most - minimum)
    with np.errstate(all="ignore"):
        # nan and inf of couples that are never in reach together are set aside at the end
        x = np.clip(delta / 2, low, high)
        for _ in range(_MOST_STEPS):
            slope, bend = _slopes(front, back, delta, phases, x)
            low, high = np.where(slope < 0, x, low), np.where(slope > 0, x, high)
            step = x - slope / bend
            # a step out of the bracket, or none where the bend is 0 or NaN, is a bisection: so every element converges
            step = np.where((step >= low) & (step <= high), step, low + (high - low) / 2)
            done = not (np.abs(step - x) > np.where(minimum < most, near, inf)).any()
            x = step
            if done:
                break
        slope, bend = _slopes(front, back, delta, phases, x)
        value = front.angle(phases[0], x, np) + back.angle(phases[1], delta - x, np)
        step = np.where(bend > 0, slope / bend, inf)
        value = value - np.where(np.abs(step) < near, slope * step / 2, 0.0)  # at an end of the reach it is no bottom
        return np.where(minimum < most, value, inf), x


def _slopes(front: CutToothPairs, back: CutToothPairs, delta: Any, phases: tuple[str, str], x: Any) -> tuple[Any, Any]:
    slope = front.speed(phases[0], x, np) - back.speed(phases[1], delta - x, np)
    return slope, front.slope(phases[0], x, np) + back.slope(phases[1], delta - x, np)


def minimum_sum(front: CutToothPairs, back: CutToothPairs, delta: Any) -> Any:
    """The least of f(x) + f'(delta - x) over the common reach (rad); inf where there is none."""
    low, high = common(front, back, delta)
    with np.errstate(all="ignore"):
        values = [minimum_backlash_sum(front, back, delta, phases)[0] for phases in PHASES]
        ends = [np.where(low < high, front.contact(x) + back.contact(delta - x), inf) for x in (low, high)]
        return np.fmin.reduce(np.broadcast_arrays(*values, *ends))


def even_tooth_pair(sizes: TriangularSizes) -> CutToothPairs:
    """The one couple of wheels without errors."""
    return CutToothPairs.of(sizes, (0.0, 0.0), (0.0, 0.0), 0.0)


@lru_cache(maxsize=1024)
def backlash_candidates(sizes: TriangularSizes, most: int) -> tuple[BacklashCandidate, ...]:
    """Every way in which teeth of even wheels come near to jamming, up to `most` couples apart; the nearest first."""
    tooth_pair = even_tooth_pair(sizes)
    found = []
    for n, phases in product(range(-most, most + 1), PHASES):
        delta = n * sizes.p1
        if abs(delta) < 2 * float(tooth_pair.reach):
            value, x = minimum_backlash_sum(tooth_pair, tooth_pair, np.array(delta), phases)
            found.append(BacklashCandidate(n, phases, float(x) - delta / 2, float(value) + (1 - n) * sizes.p2))
        elif phases == PHASES[-1 if n > 0 else 0]:
            # only errors bring both into reach: then tips meet tips
            tips = -2 * float(np.sign(n) * tooth_pair.exit_angle)
            found.append(BacklashCandidate(n, phases, 0.0, tips + (1 - n) * sizes.p2))
    return tuple(sorted(found, key=lambda each: each.backlash))


def farthest(pair: CutGearPair) -> int:
    """How many couples apart two can be that are both in reach; -1 where none ever is."""
    if pair.widest <= 0:
        return -1
    return floor((2 * pair.widest + 2 * float(np.abs(pair.first.place).max())) / pair.sizes.p1)


def steepest(tooth_pair: CutToothPairs) -> float:
    """The greatest speed ratio of a couple, where its tips meet as it comes in; 0 where it never does."""
    if not tooth_pair.reach > 0:
        return 0.0
    with np.errstate(all="ignore"):
        tau = float(tooth_pair.approach_speed(tooth_pair.reach, np))
    return tau if 0 < tau < inf else inf


def nominal_backlash(sizes: TriangularSizes) -> float:
    """The least play of wheels without errors, in pitches of the driven wheel; below 0 they jam."""
    from geartrain.teeth.triangular.clearance_window import TriangularContact

    return TriangularContact(sizes).backlash / sizes.p2


def jamming_bound(sizes: TriangularSizes, sigma: float) -> float:
    """A bound on the probability that flanks jam anywhere in a cycle: 2 lcm(z1, z2) Q(j / (2 sigma)), at most 1.

    Teeth of both wheels are independently out of place by a normal error of `sigma` of their own pitch; Q is the
    normal tail and j the least play in pitches. Four teeth take part in a jam, each moving the driven wheel by about
    its own error, so the play has the deviation 2 sigma; every couple counts twice, for the space before and behind it.
    """
    if not 0 <= sigma < inf:
        raise RangeError(
            Problem(f"{sigma:g} is no standard deviation", "it is a number of pitches", "give 0 or more, and finite")
        )
    backlash = nominal_backlash(sizes)
    if backlash < 0:
        return 1.0
    if sigma == 0:
        return 0.0
    tooth_pairs = sizes.z1 * sizes.z2 // gcd(sizes.z1, sizes.z2)
    # Q(x) = erfc(x / sqrt 2) / 2 keeps its digits in the tail, where 1 - Phi(x) has none
    return min(1.0, 2 * tooth_pairs * erfc(backlash / (2 * sigma) / sqrt(2)) / 2)
