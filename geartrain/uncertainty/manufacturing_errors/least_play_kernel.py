"""The least play of a trial of cut teeth with every error, over all couples of the cycle, as a kernel."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from geartrain.numerics.kernels import kernel
from geartrain.uncertainty.manufacturing_errors.least_sum_kernel import least_contact_sum, phase
from geartrain.uncertainty.manufacturing_errors.verdict_arrays import (
    CutPairSizes,
    JamCandidates,
    ToothArrays,
    ahead_of,
    couple_of,
    stop_of,
)

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

COARSE, FINE = 0.08, 0.005  # of a driven pitch: more than a play to first order, and a stepped one, are above it


@kernel
def least_play(
    sizes: CutPairSizes,
    jams: JamCandidates,
    one: ToothArrays,
    two: ToothArrays,
    shift: float,
    trial: int,
    front: Floats,
    back: Floats,
    work: tuple[Floats, Floats, Floats],
    every: bool,
) -> float:
    """Least play over the cycle.

    every   whether all couples are asked exactly: where errors are great, or teeth lose each other, no estimate holds

    Told to first order for all couples, by a step of Newton's method for those that come near the least, exactly for
    those that come near it then; what is seen of each tells how far the estimate before may be above it.
    """
    driver, driven, of_driver, of_driven, stepped = one.place[trial], two.place[trial], work[0], work[1], work[2]
    coarse, fine, least, before = COARSE * sizes.p2, FINE * sizes.p2, inf, 0.0
    if every:
        coarse, fine = inf, inf
    greatest = _greatest_errors(one, two, trial)
    # once more where estimates were seen to be farther off than was taken for granted
    while before < coarse:
        before = coarse
        for way in range(len(jams.n)):
            if every and jams.n[way] in jams.n[:way]:  # the exact play is that of all ways between the same couples
                continue
            if _bound(jams, way, shift, greatest) > least + coarse:
                continue
            first = _first_order(sizes, jams, way, one, two, shift, trial, of_driver, of_driven)
            if first > least + coarse:
                continue
            n, nearest = jams.n[way], -1
            bar = least + coarse
            for k in range(sizes.couples):
                stepped[k] = inf
                linear = of_driver[k % sizes.z1] + of_driven[k % sizes.z2]
                if linear <= bar:
                    stepped[k] = _step(sizes, jams, way, k, driver, front, back) + stop_of(sizes, n, k, driven)
                    if stepped[k] < inf:
                        coarse = max(coarse, 2 * (linear - stepped[k]))
                        bar = min(bar, stepped[k] + coarse)
                        if nearest < 0 or stepped[k] < stepped[nearest]:
                            nearest = k
            if nearest < 0:
                continue
            # that one first: its exact value rules most others out
            for at in range(-1, sizes.couples):
                k = nearest if at < 0 else at
                if stepped[k] <= least + fine and stepped[k] < inf:
                    delta, other = ahead_of(sizes, n, k, driver), (k - n) % sizes.couples
                    exact = least_contact_sum(couple_of(front[k]), couple_of(back[other]), delta)
                    exact += stop_of(sizes, n, k, driven)
                    least = min(least, exact)
                    fine = max(fine, 2 * (stepped[k] - exact))
                    stepped[k] = inf
    return least


@kernel
def _greatest_errors(one: ToothArrays, two: ToothArrays, trial: int) -> tuple[float, float, float, float, float, float]:
    """Greatest errors of a trial: heights and flanks of both wheels, differences of places."""
    return (
        _greatest(one.tip[trial]),
        _greatest(two.tip[trial]),
        _greatest(one.flatter[trial, :, 0]) + _greatest(one.flatter[trial, :, 1]),
        _greatest(two.flatter[trial, :, 0]) + _greatest(two.flatter[trial, :, 1]),
        2 * _greatest(one.place[trial]),
        2 * _greatest(two.place[trial]),
    )


@kernel
def _greatest(values: Floats) -> float:
    found = 0.0
    for value in values:
        found = max(found, abs(value))
    return found


@kernel
def _bound(
    jams: JamCandidates, way: int, shift: float, greatest: tuple[float, float, float, float, float, float]
) -> float:
    """The play of a way of jamming to first order is at least so much, whichever teeth it is between."""
    ahead, behind = jams.slopes[way, 0], jams.slopes[way, 1]
    found: float = jams.play[way] + (ahead[4] + behind[4]) * shift
    for at in range(4):
        found -= (abs(ahead[at]) + abs(behind[at])) * greatest[at]
    found -= abs(ahead[5] + behind[5]) / 2 * greatest[4] + greatest[5]
    return found


@kernel
def _first_order(
    sizes: CutPairSizes,
    jams: JamCandidates,
    way: int,
    one: ToothArrays,
    two: ToothArrays,
    shift: float,
    trial: int,
    of_driver: Floats,
    of_driven: Floats,
) -> float:
    """The play of a way of jamming as the sum of a term of the driver's tooth and one of the driven; at least so much.

    Terms by the teeth of the front couple.
    """
    n, ahead, behind = jams.n[way], jams.slopes[way, 0], jams.slopes[way, 1]
    turned = (ahead[5] + behind[5]) / 2
    even = jams.play[way] + (ahead[4] + behind[4]) * shift
    least = inf
    for i in range(sizes.z1):
        b = (i - n) % sizes.z1
        of_driver[i] = (
            even
            + ahead[0] * one.tip[trial, i]
            + ahead[2] * one.flatter[trial, i, 0]
            + behind[0] * one.tip[trial, b]
            + behind[2] * one.flatter[trial, b, 1]
            + turned * (one.place[trial, i] - one.place[trial, b])
        )
        least = min(least, of_driver[i])
    other = inf
    for j in range(sizes.z2):
        b = (j - n + 1) % sizes.z2
        of_driven[j] = (
            ahead[1] * two.tip[trial, j]
            + ahead[3] * two.flatter[trial, j, 1]
            + behind[1] * two.tip[trial, b]
            + behind[3] * two.flatter[trial, b, 0]
            + (two.place[trial, b] - two.place[trial, j])
        )
        other = min(other, of_driven[j])
    return least + other


@kernel
def _step(
    sizes: CutPairSizes, jams: JamCandidates, way: int, k: int, driver: Floats, front: Floats, back: Floats
) -> float:
    """The least of two contacts as a parabola tells it that is laid where even wheels have theirs."""
    n = jams.n[way]
    other = (k - n) % sizes.couples
    delta = ahead_of(sizes, n, k, driver)
    low = max(-front[k, 9], delta - back[other, 9])
    high = min(front[k, 9], delta + back[other, 9])
    if not low < high:
        return inf
    x = min(max(delta / 2 + jams.offset[way], low), high)
    ahead = phase(couple_of(front[k]), jams.phase1[way], x)
    behind = phase(couple_of(back[other]), jams.phase2[way], delta - x)
    slope, bend = ahead[1] - behind[1], ahead[2] + behind[2]
    value: float = ahead[0] + behind[0]
    # no farther than to the ends of the common reach
    room = (low - x if slope > 0 else high - x) * slope
    if bend > 0:
        room = max(room, -slope * slope / (2 * bend))
    value += room
    return value
