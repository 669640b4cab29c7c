"""Minimum backlash between a front and a back tooth pair, which limit the driven wheel from both sides.

With the driver's front tooth at x and its back tooth `delta` before it, the backlash is f(x) + f'(delta - x) plus terms
of the driven teeth. Here f belongs to the leading flank and f' to the mirrored tooth pair. Both are the minimum of two
smooth functions, which are convex for ordinary teeth. The minimum backlash is therefore the minimum of four sums of
smooth functions, or is at an end of the common reach.

The module also gives the backlash of perfect wheels, and a bound on the probability that pitch deviations consume it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import erfc, floor, gcd, inf, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.teeth.triangular.tooth_pair import APPROACH, RECESS
from geartrain.workshop.cutting.cut_wheel import CutGearPair, CutToothPairs

if TYPE_CHECKING:
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes


PHASES = ((RECESS, RECESS), (RECESS, APPROACH), (APPROACH, RECESS), (APPROACH, APPROACH))
_MOST_STEPS = 30  # pure bisection would reach 1e-9 of the common reach
SLACK = 0.05  # driven pitches: initial bound of estimated minus exact backlash, enlarged if it proves too small
_NEAR = 1e-6  # of the common reach: after such a step the error of the value, quadratic in the step, is rounding


@dataclass(frozen=True, slots=True)
class BacklashCandidate:
    """Front tooth pair and the back pair n before it, in one phase each, at the minimum backlash of perfect wheels."""

    n: int
    phases: tuple[str, str]
    offset: float
    """Angle alpha_1 at the minimum minus half of n pitches [rad]."""
    backlash: float
    """Backlash at the minimum [rad of the driven wheel]."""


def common(front: CutToothPairs, back: CutToothPairs, delta: Any) -> tuple[Any, Any]:
    """Return the range of alpha_1 of the front tooth in which both pairs can touch [rad]; empty if low > high."""
    return np.maximum(-front.reach, delta - back.reach), np.minimum(front.reach, delta + back.reach)


def minimum_backlash_sum(
    front: CutToothPairs, back: CutToothPairs, delta: Any, phases: tuple[str, str]
) -> tuple[Any, Any]:
    """Return the minimum sum of two contacts, each in one phase, and its position [rad]; inf if both cannot touch at
    once.

    The algorithm is Newton's method safeguarded by bisection, starting at half the reach. The last step improves the
    value only, by a parabola.
    """
    low, high = common(front, back, delta)
    minimum, most = low, high
    near = _NEAR * (most - minimum)
    with np.errstate(all="ignore"):
        # NaN and inf of tooth pairs that are never in reach together are discarded at the end
        x = np.clip(delta / 2, low, high)
        for _ in range(_MOST_STEPS):
            slope, bend = _slopes(front, back, delta, phases, x)
            low, high = np.where(slope < 0, x, low), np.where(slope > 0, x, high)
            step = x - slope / bend
            # a step that leaves the bracket or is NaN is replaced by a bisection, so every element converges
            step = np.where((step >= low) & (step <= high), step, low + (high - low) / 2)
            done = not (np.abs(step - x) > np.where(minimum < most, near, inf)).any()
            x = step
            if done:
                break
        slope, bend = _slopes(front, back, delta, phases, x)
        value = front.angle(phases[0], x, np) + back.angle(phases[1], delta - x, np)
        step = np.where(bend > 0, slope / bend, inf)
        # an end of the reach is not a stationary point: there the step is long, and no correction applies
        value = value - np.where(np.abs(step) < near, slope * step / 2, 0.0)
        return np.where(minimum < most, value, inf), x


def _slopes(front: CutToothPairs, back: CutToothPairs, delta: Any, phases: tuple[str, str], x: Any) -> tuple[Any, Any]:
    slope = front.speed(phases[0], x, np) - back.speed(phases[1], delta - x, np)
    return slope, front.slope(phases[0], x, np) + back.slope(phases[1], delta - x, np)


def minimum_sum(front: CutToothPairs, back: CutToothPairs, delta: Any) -> Any:
    """Return the minimum of f(x) + f'(delta - x) while both tooth pairs can touch [rad]; inf if they never do."""
    low, high = common(front, back, delta)
    with np.errstate(all="ignore"):
        values = [minimum_backlash_sum(front, back, delta, phases)[0] for phases in PHASES]
        ends = [np.where(low < high, front.contact(x) + back.contact(delta - x), inf) for x in (low, high)]
        return np.fmin.reduce(np.broadcast_arrays(*values, *ends))


def even_tooth_pair(sizes: TriangularSizes) -> CutToothPairs:
    """Return the tooth pair of wheels without errors."""
    return CutToothPairs.of(sizes, (0.0, 0.0), (0.0, 0.0), 0.0)


@lru_cache(maxsize=1024)
def backlash_candidates(sizes: TriangularSizes, most: int) -> tuple[BacklashCandidate, ...]:
    """Return the minima of backlash of perfect wheels for all distances n up to `most` tooth pairs.

    For each n, these are the phases whose minimum is within `SLACK` of the smallest.
    """
    tooth_pair = even_tooth_pair(sizes)
    candidates = []
    for n in range(-most, most + 1):
        delta, found = n * sizes.p1, []
        if abs(delta) < 2 * float(tooth_pair.reach):
            for phases in PHASES:
                value, x = minimum_backlash_sum(tooth_pair, tooth_pair, np.array(delta), phases)
                found.append(BacklashCandidate(n, phases, float(x) - delta / 2, float(value) + (1 - n) * sizes.p2))
        else:
            # in reach together only with errors: then tips meet tips
            tips = -2 * float(np.sign(n) * tooth_pair.exit_angle)
            found.append(BacklashCandidate(n, PHASES[-1 if n > 0 else 0], 0.0, tips + (1 - n) * sizes.p2))
        limit = min(each.backlash for each in found) + SLACK * sizes.p2
        candidates += sorted((each for each in found if each.backlash <= limit), key=lambda each: each.backlash)
    return tuple(candidates)


def farthest(pair: CutGearPair) -> int:
    """Return the maximum number of pitches between tooth pairs that can touch at once; -1 if no pair can touch."""
    if pair.widest <= 0:
        return -1
    return floor((2 * pair.widest + 2 * float(np.abs(pair.first.place).max())) / pair.sizes.p1)


def steepest(tooth_pair: CutToothPairs) -> float:
    """Return the maximum speed ratio of a tooth pair, where tips meet at entry; 0 without contact, inf if undefined."""
    if not tooth_pair.reach > 0:
        return 0.0
    with np.errstate(all="ignore"):
        tau = float(tooth_pair.speed(APPROACH, tooth_pair.reach, np))
    return tau if 0 < tau < inf else inf


def nominal_backlash(sizes: TriangularSizes) -> float:
    """Return the minimum backlash of wheels without errors [pitch of the driven wheel]; negative if they jam."""
    from geartrain.teeth.triangular.clearance_window import TriangularContact

    return TriangularContact(sizes).backlash / sizes.p2


def jamming_bound(sizes: TriangularSizes, sigma: float) -> float:
    """Return an upper bound of the probability of a jam in a cycle: 2 lcm(z1, z2) Q(j / (2 sigma)), at most 1.

    The teeth of both wheels have independent normal pitch deviations of `sigma` pitches. Q is the normal tail
    probability and j the minimum backlash in pitches. Four teeth take part in a jam, and each moves the driven wheel by
    about its own deviation, so the backlash has the deviation 2 sigma. Every tooth pair counts twice, for the spaces
    before and behind it.
    """
    backlash = nominal_backlash(sizes)
    if backlash < 0:
        return 1.0
    if sigma == 0:
        return 0.0
    tooth_pairs = sizes.z1 * sizes.z2 // gcd(sizes.z1, sizes.z2)
    # Q(x) = erfc(x / sqrt 2) / 2 keeps its digits in the tail, where 1 - Phi(x) has none
    return min(1.0, 2 * tooth_pairs * erfc(backlash / (2 * sigma) / sqrt(2)) / 2)
