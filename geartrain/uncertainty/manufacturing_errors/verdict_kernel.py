"""The verdict on pairs of cut teeth with every error, trial by trial: `MeshingCycle` as a kernel.

The same places are looked at. But a trial is judged on its own: a way of jamming that its own errors cannot bring near
is left out, and a tooth that is caught by the next one is looked at no further.
"""

from __future__ import annotations

from math import asin, inf, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.kernels import kernel
from geartrain.uncertainty.manufacturing_errors.couple_kernel import held, is_below, make_couple
from geartrain.uncertainty.manufacturing_errors.cut_pair import ROUNDING
from geartrain.uncertainty.manufacturing_errors.least_play_kernel import least_play
from geartrain.uncertainty.manufacturing_errors.verdict_arrays import (
    CutPairSizes,
    JamCandidates,
    ToothArrays,
    ahead_of,
    apart_of,
    couple_of,
)

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats

_UPRIGHT = 0.8, 0.6  # sine of a flank, and rad from it to where tips meet: below these it leans nowhere


@kernel
def judge_cycles(
    sizes: CutPairSizes,
    one: ToothArrays,
    two: ToothArrays,
    shift: Floats,
    jams: JamCandidates,
    far: Bools,
    play: Floats,
    marks: Bools,
) -> None:
    """Least play (rad of the driven wheel) of each trial, and (trials, 4): clash, standstill, disengaged, leans.

    far   trials whose errors are too great for estimates: every couple of theirs is asked exactly
    """
    count = sizes.couples
    front, back = np.zeros((count, 11)), np.zeros((count, 11))
    work = np.zeros(sizes.z1), np.zeros(sizes.z2), np.zeros(count)
    for trial in range(len(play)):
        driver, driven = one.place[trial], two.place[trial]
        whole, widest = _fill(sizes, one, two, shift[trial], trial, front, back)
        marks[trial, 3] = _leans(front, back)
        marks[trial, 2] = _gap(sizes, driver, front) or _gap(sizes, driver, back)
        least = least_play(sizes, jams, one, two, shift[trial], trial, front, back, work, far[trial] or marks[trial, 2])
        most = max(1, int(np.ceil((2 * widest + _range(driver)) / sizes.p1))) if whole else count - 2
        marks[trial, 1] = _left_standing(sizes, driver, driven, front, most)
        marks[trial, 0] = _clashes(sizes, driver, driven, front, most)
        if marks[trial, 1]:
            least = min(least, _play_at_entries(sizes, driver, driven, front, back, most))
        play[trial] = least


@kernel
def _fill(
    sizes: CutPairSizes, one: ToothArrays, two: ToothArrays, shift: float, trial: int, front: Floats, back: Floats
) -> tuple[bool, float]:
    """Constants of all front couples, and of the back couples; whether all touch, and the greatest reach."""
    whole, widest = True, 0.0
    for k in range(sizes.couples):
        i = k % sizes.z1
        for side in range(2):
            j = (k + side) % sizes.z2
            tip1, tip2 = one.tip[trial, i], two.tip[trial, j]
            flank1 = one.lead[trial, i] if side == 0 else one.trail[trial, i]
            flank2 = two.trail[trial, j] if side == 0 else two.lead[trial, j]
            couple = make_couple(
                sizes.R1 + tip1,
                sizes.R2 + tip2,
                sizes.D + sizes.side * shift,
                sizes.delta + (tip1 + tip2) - sizes.side * shift,
                (flank1[0], flank1[1]),
                (flank2[0], flank2[1]),
            )
            row = front[k] if side == 0 else back[k]
            row[0], row[1], row[2], row[3] = couple.R1, couple.R2, couple.D, couple.delta
            row[4], row[5], row[6], row[7] = couple.sin1, couple.cos1, couple.sin2, couple.cos2
            row[8], row[9], row[10] = couple.entry, couple.reach, couple.exit_angle
        whole = whole and front[k, 9] > -inf
        widest = max(widest, front[k, 9])
    return whole, widest


@kernel
def _leans(front: Floats, back: Floats) -> bool:
    """Whether a flank leans beyond the perpendicular where the tips of its couple meet."""
    for k in range(len(front)):
        for side in range(2):
            row = front[k] if side == 0 else back[k]
            side_of = -1.0 if row[2] < 0 else 1.0
            sine, turned = max(abs(row[4]), abs(row[6])), max(row[9], 0.0) - side_of * row[10]
            upright = sine < _UPRIGHT[0] and turned < _UPRIGHT[1]
            if not upright and asin(min(max(sine, -1.0), 1.0)) + turned >= pi / 2:
                return True
    return False


@kernel
def _range(values: Floats) -> float:
    low: float = values[0]
    high: float = values[0]
    for value in values:
        low, high = min(low, value), max(high, value)
    return high - low


@kernel
def _left_standing(sizes: CutPairSizes, driver: Floats, driven: Floats, front: Floats, most: int) -> bool:
    """Whether, where a couple leaves, every one behind it is still clear of its driven tooth."""
    count = sizes.couples
    for k in range(count):
        reach, limit = front[k, 9], front[k, 10] + ROUNDING * sizes.p2
        stands = reach > -inf
        step = 1
        while stands and step <= most + 1:
            n = step if step <= most else -1
            c = (k + n) % count
            x = ahead_of(sizes, n, c, driver) - reach
            if x <= front[c, 9] and is_below(couple_of(front[c]), x, limit + apart_of(sizes, n, c, driven)):
                stands = False
            step += 1
        if stands:
            return True
    return False


@kernel
def _before(sizes: CutPairSizes, n: int, k: int, reach: float, driver: Floats, driven: Floats, front: Floats) -> float:
    """alpha_2 of a driven tooth, its driver's tooth at `reach`, as the couple n before has it; inf if it does not."""
    other = (k - n) % sizes.couples
    x = reach - ahead_of(sizes, n, k, driver)
    if x <= front[other, 9] and front[other, 9] > -inf and x > -inf:
        return held(couple_of(front[other]), x) + apart_of(sizes, n, k, driven)
    return inf


@kernel
def _clashes(sizes: CutPairSizes, driver: Floats, driven: Floats, front: Floats, most: int) -> bool:
    """Whether, where a couple comes in, the driven wheel holds its driven tooth behind the tip."""
    for k in range(sizes.couples):
        reach = front[k, 9]
        tip = -front[k, 10] + ROUNDING * sizes.p2
        clear, touched, n = reach == -inf, False, 1
        while not clear and n < most + 2:
            other = (k - n) % sizes.couples
            x = reach - ahead_of(sizes, n, k, driver)
            if x <= front[other, 9] and front[other, 9] > -inf:
                touched = True
                clear = is_below(couple_of(front[other]), x, tip - apart_of(sizes, n, k, driven))
            n += 1
        if touched and not clear:
            return True
    return False


@kernel
def _play_at_entries(
    sizes: CutPairSizes, driver: Floats, driven: Floats, front: Floats, back: Floats, most: int
) -> float:
    """Least play where a couple comes in that stops the driven wheel, which may stand there."""
    least = inf
    for k in range(sizes.couples):
        if back[k, 9] > -inf:
            y = inf
            for n in range(most + 2):
                y = min(y, _before(sizes, n, k, back[k, 9], driver, driven, front))
            least = min(least, y + apart_of(sizes, 1, k + 1, driven) + back[k, 10])
    return least


@kernel
def _gap(sizes: CutPairSizes, driver: Floats, couples: Floats) -> bool:
    """Whether somewhere no couple is in reach."""
    count, cycle = sizes.couples, sizes.couples * sizes.p1
    until = -inf
    for k in range(count):
        if couples[k, 9] > -inf:
            until = max(until, k * sizes.p1 + driver[k % sizes.z1] + couples[k, 9] - cycle)
    if until == -inf:
        return True
    following = np.full(count, inf)
    nearest = inf
    for k in range(count - 1, -1, -1):
        if couples[k, 9] > -inf:
            nearest = min(nearest, k * sizes.p1 + driver[k % sizes.z1] - couples[k, 9])
        following[k] = nearest
    for k in range(count):
        if following[k] > until + ROUNDING * sizes.p1 and following[k] < inf:
            return True
        if couples[k, 9] > -inf:
            until = max(until, k * sizes.p1 + driver[k % sizes.z1] + couples[k, 9])
    return False
