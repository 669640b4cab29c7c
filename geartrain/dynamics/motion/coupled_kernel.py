"""Pairs that depend on each other: Newton's method of `coupled_errors` as a kernel."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.composition_arrays import ComposedSources
from geartrain.dynamics.motion.coupled_errors import FORGIVEN, MOST_STEPS, SETTLED
from geartrain.numerics.gauss_kernel import solve_in_place
from geartrain.numerics.kernels import kernel
from geartrain.teeth.transmission_kernel import law_along

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.transmission_kernel import TransmissionTables

FOLLOWED, NO_FIT, DEAD_CENTRE = 0, 1, 2  # what became of pairs that depend on each other
_SHORTEST = 1e-9  # of a step: halved so often, it is one no more


@kernel
def couple_errors(
    laws: TransmissionTables,
    sources: ComposedSources,
    first: int,
    gain: Floats,
    base: Floats,
    turning: Floats,
    delta: Floats,
    slope: Floats,
) -> int:
    """Errors and rates of some pairs from the angles and speeds of their drivers without these errors: (pairs, n) all.

    first     number of the first of the pairs
    gain      (pairs, pairs): rad of a driver's angle per rad of a pair's driven error
    turning   on return with what the pairs add to each other's drivers

    Returns `FOLLOWED`, or why there are none.
    """
    if not _settle(laws, sources, first, gain, base, delta, slope):
        return NO_FIT
    count = len(gain)
    matrix, lean, rate = np.zeros((count, count)), np.zeros(count), np.zeros(count)
    for at in range(base.shape[1]):
        for row in range(count):
            lean[row] = slope[row, at]
            rate[row] = lean[row] * turning[row, at]
        # 1 for ideal teeth: not positive any more means past a dead centre
        if not solve_coupled(matrix, lean, gain, rate) > 0:
            return DEAD_CENTRE
        for row in range(count):
            slope[row, at] = rate[row]
            for other in range(count):
                turning[row, at] += gain[row, other] * rate[other]
    return FOLLOWED


@kernel
def _settle(
    laws: TransmissionTables,
    sources: ComposedSources,
    first: int,
    gain: Floats,
    base: Floats,
    now: Floats,
    lean: Floats,
) -> bool:
    """Newton's method with halved steps: errors into `now`, slopes of their laws into `lean`; False if it fails.

    All positions take a step together, so that each law is asked at many angles at once.
    """
    count, size = base.shape
    tolerance = SETTLED * (1.0 + _greatest(base) + count * _greatest(gain))
    trial, error, tilt = np.zeros((count, size)), np.zeros((count, size)), np.zeros((count, size))
    active, step = np.arange(size), np.zeros((count, size))
    length, least = np.zeros(size), np.zeros(size)
    length[:], least[:] = 1.0, np.inf
    matrix, residual, slope = np.zeros((count, count)), np.zeros(count), np.zeros(count)
    _ask(laws, sources, first, gain, base, active, trial, now, tilt)
    for _ in range(MOST_STEPS):
        # at first the step is 0 and `least` infinite: the first trial is the start itself
        for k in range(len(active)):
            at = active[k]
            for row in range(count):
                trial[row, k] = now[row, at] - length[at] * step[row, at]
        _ask(laws, sources, first, gain, base, active, trial, error, tilt)
        left = 0
        for k in range(len(active)):
            at, found = active[k], 0.0
            for row in range(count):
                residual[row] = trial[row, k] - error[row, k]
                found = max(found, abs(residual[row]))
            if found < least[at]:
                length[at], least[at] = 1.0, found
                for row in range(count):
                    now[row, at], lean[row, at] = trial[row, k], tilt[row, k]
                if found <= tolerance:
                    continue
                for row in range(count):
                    slope[row] = tilt[row, k]
                if solve_coupled(matrix, slope, gain, residual) == 0:  # at a dead centre, which no step leaves
                    residual[:] = 0.0
                for row in range(count):
                    step[row, at] = residual[row]
            elif length[at] < _SHORTEST and least[at] <= FORGIVEN:
                continue  # rounding, or the last of a corner
            else:
                length[at] /= 2
            active[left] = at
            left += 1
        active = active[:left]
        if left == 0:
            return True
    worst = 0.0
    for k in range(len(active)):
        worst = max(worst, least[active[k]])
    return worst <= FORGIVEN


@kernel
def _greatest(values: Floats) -> float:
    """Greatest magnitude in a matrix."""
    found = 0.0
    for row in range(values.shape[0]):
        for column in range(values.shape[1]):
            found = max(found, abs(values[row, column]))
    return found


@kernel
def _ask(
    laws: TransmissionTables,
    sources: ComposedSources,
    first: int,
    gain: Floats,
    base: Floats,
    active: Ints,
    added: Floats,
    error: Floats,
    slope: Floats,
) -> None:
    """What the laws say at active positions where errors `added` are those of the pairs: driven errors and slopes."""
    count, size = len(gain), len(active)
    S, e, v, u, cell = np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size, dtype=np.int32)
    for row in range(count):
        for k in range(size):
            S[k] = base[row, active[k]]
        for other in range(count):
            factor = gain[row, other]
            for k in range(size):
                S[k] += factor * added[other, k]
        law_along(laws, first + row, S, e, v, u, cell)
        sense, ratio = sources.sense[first + row], sources.ratio[first + row]
        for k in range(size):
            error[row, k] = sense * e[k]
            slope[row, k] = sense * (v[k] - ratio)


@kernel
def solve_coupled(matrix: Floats, slope: Floats, gain: Floats, right: Floats) -> float:
    """Solve J = I - slope gain of equation (5) for `right`, in place, by Gauss; returns its determinant."""
    size = len(right)
    determinant: float = 1.0
    if size == 1:  # the usual number around a differential
        determinant -= slope[0] * gain[0, 0]
        if determinant != 0:
            right[0] /= determinant
        return determinant
    for row in range(size):
        for column in range(size):
            matrix[row, column] = -slope[row] * gain[row, column]
        matrix[row, row] += 1.0
    return solve_in_place(matrix, right)
