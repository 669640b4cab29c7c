"""Verdicts on pairs of cut teeth with every error, by their kernel."""

from __future__ import annotations

from functools import lru_cache
from math import inf, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.triangular.tooth_couple import APPROACH
from geartrain.uncertainty.manufacturing_errors.cut_pair import CutToothPairs
from geartrain.uncertainty.manufacturing_errors.least_backlash import (
    BacklashCandidate,
    backlash_candidates,
    farthest,
)
from geartrain.uncertainty.manufacturing_errors.meshing_cycle import (
    CHUNK,
    MeshingVerdicts,
    chunks,
    cycle_verdicts,
    taken,
)
from geartrain.uncertainty.manufacturing_errors.verdict_arrays import CutPairSizes, JamCandidates, ToothArrays
from geartrain.uncertainty.manufacturing_errors.verdict_kernel import judge_cycles

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes
    from geartrain.uncertainty.manufacturing_errors.cut_pair import CutGearPair
    from geartrain.uncertainty.manufacturing_errors.cut_wheel import CutWheel

_TIPS, _FLANKS, _PLACES = 0.5, 0.25, 0.2  # of a depth, of a half angle, of a pitch: most for the kernel
_FEW = 1000  # couples of all trials with greater errors, which the kernel asks one by one
_STEP = 1e-4  # of a length, of an angle: differences then leave some 1e-8


def compiled_verdicts(pair: CutGearPair, fast: bool = True) -> MeshingVerdicts:
    """The verdict on each trial: that of `cycle_verdicts`, which judges many that are too far off for the kernel."""
    trials = pair.trials[0]
    play, marks = np.full(trials, inf), np.zeros((trials, 4), dtype=bool)
    far = ~_slightly_off(pair, trials)
    # many are asked faster by numpy, some of whose work serves all trials; for a few of them that is too much
    near = np.arange(trials) if int(far.sum()) * pair.count <= _FEW else np.flatnonzero(~far)
    if len(near):
        some = taken(pair, near)
        one, two = _teeth(some.first, len(near)), _teeth(some.second, len(near))
        shift = np.array(np.broadcast_to(np.asarray(some.shift, dtype=float), len(near)))
        own, found = np.full(len(near), inf), np.zeros((len(near), 4), dtype=bool)
        judge_cycles.chosen(fast)(_sizes(pair), one, two, shift, _candidates(pair), far[near], own, found)
        play[near], marks[near] = own, found
    # where flanks lean other couples may be nearest than those that the kernel looks at
    others = np.setdiff1d(np.arange(trials), near[~marks[near, 3]])
    if len(others):
        rest = MeshingVerdicts.joined(
            [cycle_verdicts(part) for part in chunks(taken(pair, others), CHUNK // pair.count)]
        )
        play[others] = rest.play
        marks[others] = np.stack((rest.clash, rest.standstill, rest.disengaged, rest.leans), axis=1)
    clash, standstill, disengaged, leans = marks.T
    return MeshingVerdicts(play, clash, standstill, disengaged, leans)


def _slightly_off(pair: CutGearPair, trials: int) -> Bools:
    """Trials whose errors are small enough for estimates to first order."""
    wheels = pair.first, pair.second
    tips = sum((np.abs(wheel.tip).max(axis=-1) for wheel in wheels), np.abs(np.asarray(pair.shift, dtype=float)))
    flat = [np.maximum(np.abs(wheel.leading), np.abs(wheel.trailing)).max(axis=-1) for wheel in wheels]
    # of neighbours: an eccentric wheel displaces those together
    apart = [np.abs(wheel.place - np.roll(wheel.place, 1, -1)).max(axis=-1) * wheel.z / (2 * pi) for wheel in wheels]
    depth, beta = min(pair.sizes.depths), min(pair.sizes.half_angles)
    good = (tips <= _TIPS * depth) & (np.maximum(*flat) <= _FLANKS * beta) & (np.maximum(*apart) <= _PLACES)
    found: Bools = np.broadcast_to(good, (trials,))
    return found


def _teeth(wheel: CutWheel, trials: int) -> ToothArrays:
    shape = trials, wheel.z
    place, tip = (np.array(np.broadcast_to(each, shape)) for each in (wheel.place, wheel.tip))
    flatter, lead, trail = (np.empty((*shape, 2)) for _ in range(3))
    for side, (error, flank) in enumerate(((wheel.leading, lead), (wheel.trailing, trail))):
        flatter[:, :, side] = error
        beta = wheel.half_angle + flatter[:, :, side]
        np.sin(beta, out=flank[:, :, 0])
        np.cos(beta, out=flank[:, :, 1])
    return ToothArrays(place, tip, lead, trail, flatter)


def _sizes(pair: CutGearPair) -> CutPairSizes:
    at = pair.sizes
    return CutPairSizes(at.z1, at.z2, pair.count, *at.signed_radii, at.side * at.D, at.delta, at.p1, at.p2, at.side)


def _candidates(pair: CutGearPair) -> JamCandidates:
    found = backlash_candidates(pair.sizes, farthest(pair))
    slopes = [_slopes(pair.sizes, each) for each in found]
    return JamCandidates(
        np.array([each.n for each in found], dtype=np.int64),
        np.array([each.phases[0] == APPROACH for each in found], dtype=np.int64),
        np.array([each.phases[1] == APPROACH for each in found], dtype=np.int64),
        np.array([each.offset for each in found], dtype=float),
        np.array([each.play for each in found], dtype=float),
        np.array(slopes, dtype=float).reshape(-1, 2, 6),
    )


@lru_cache(maxsize=4096)
def _slopes(sizes: TriangularSizes, way: BacklashCandidate) -> Floats:
    """By how much errors of the two couples change the play of a way of jamming, by differences."""
    half = way.n * sizes.p1 / 2
    # lengths, half angles and an angle, each by what is small for it
    steps = np.array([*[_STEP * sizes.delta] * 2, *[_STEP] * 2, _STEP * sizes.delta, _STEP * sizes.reach1])
    off = np.concatenate((np.diag(steps), -np.diag(steps)))
    found = []
    with np.errstate(invalid="ignore"):  # beyond the common reach, where no couple comes near jamming
        for phase, x in zip(way.phases, (half + way.offset, half - way.offset), strict=True):
            couples = CutToothPairs.of(sizes, (off[:, 0], off[:, 1]), (off[:, 2], off[:, 3]), off[:, 4])
            y = couples.angle(phase, x + off[:, 5], np)
            found.append(np.nan_to_num((y[:6] - y[6:]) / (2 * steps)))
    return np.array(found)
