"""The motion of all links as a kernel, each pair on the flank that touches at a position: docs/motion.md, section 3.

What `composition_kernel` does for one law in each pair; here a pair has two, and each position its own choice of them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.composition_arrays import ComposedSources, CompositionOrder
from geartrain.dynamics.motion.coupled_errors import FORGIVEN, MOST_STEPS, SETTLED
from geartrain.dynamics.motion.coupled_kernel import solve_coupled
from geartrain.dynamics.turn.turn_arrays import TurningArrays
from geartrain.numerics.kernels import kernel
from geartrain.teeth.transmission_kernel import TransmissionTables, law_along, law_at

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats

_SHORTEST = 1e-9  # of a step: halved so often, it is one no more


class InputPositions(NamedTuple):
    """Turns of the input, the sum of two halves each; and cycles per turn up to which a plain product is exact."""

    turns: Floats
    left: Floats
    right: Floats
    plain: float


class MotionScratch(NamedTuple):
    """Rows of links with error and rate; of one step the speeds of drivers, errors, rates; of one law its angles."""

    held: Floats
    w: Floats
    delta: Floats
    slope: Floats
    S: Floats
    error: Floats
    tau: Floats
    u: Floats
    cell: NDArray[np.int32]


@kernel
def move_links(
    arrays: TurningArrays,
    positions: InputPositions,
    coasting: Bools,
    angle: Floats,
    speed: Floats,
    fine: Bools,
    scratch: MotionScratch,
) -> None:
    """Speeds of links over the input's, and forward angles (rad) of drivers by source, (links, n) and (sources, n).

    coasting   by flanked pair, (flanked, n); `fine`, made False where pairs stand at a dead centre
    """
    order, sources, laws, size = arrays.order, arrays.sources, arrays.laws, len(positions.turns)
    held, delta, slope = scratch.held, scratch.delta, scratch.slope
    for step in range(len(order.coupled)):
        _carry(order, step, size, held)
        first, last = order.sources[step], order.sources[step + 1]
        for source in range(first, last):
            S, w = angle[source, :size], scratch.w[source - first, :size]
            _phase(sources, source, laws.period[source], positions, S)
            w[:] = sources.mean[source]
            for end in range(2):
                row, sign = sources.row[source, end], sources.sign[source, end]
                if row >= 0:
                    for at in range(size):
                        S[at] += sign * held[0, row, at]
                        w[at] += sign * held[1, row, at]
        if order.coupled[step]:
            for at in range(size):
                own = slice(first, last), slice(0, last - first)
                found = _couple(
                    arrays, step, coasting[:, at], angle[own[0], at], scratch.w[own[1], at], delta[own[1], at],
                    slope[own[1], at],
                )  # fmt: skip
                fine[at] = fine[at] and found
        else:
            for source in range(first, last):
                e, v = delta[source - first, :size], slope[source - first, :size]
                _law_along(
                    laws, source, len(arrays.flank), arrays.flank[source], coasting, angle[source, :size], e, v, scratch
                )
                sense, ratio, gain = sources.sense[source], sources.ratio[source], sources.gain[source]
                for at in range(size):
                    e[at] *= sense
                    v[at] = sense * (v[at] - ratio) * scratch.w[source - first, at]
                    angle[source, at] += gain * e[at]
        start = order.from_sources_start[step]
        for row in order.own[order.own_start[step] : order.own_start[step + 1]]:
            for own_source in range(last - first):
                factor = order.from_sources[start + own_source]
                for at in range(size):
                    held[0, row, at] += factor * delta[own_source, at]
                    held[1, row, at] += factor * slope[own_source, at]
            start += last - first
    for link in range(len(arrays.mean)):
        speed[link, :size] = 0.0
        for part in range(order.seen_start[link], order.seen_start[link + 1]):
            for at in range(size):
                speed[link, at] += order.seen_sign[part] * held[1, order.seen[part], at]
        for at in range(size):
            speed[link, at] = arrays.sense[link] * (arrays.mean[link] + speed[link, at])


@kernel
def _carry(order: CompositionOrder, step: int, size: int, held: Floats) -> None:
    """Links of a step, as far as they follow links known before."""
    start = order.from_known_start[step]
    for row in order.own[order.own_start[step] : order.own_start[step + 1]]:
        for kind in range(2):
            held[kind, row, :size] = 0.0
            entry = start
            for known in order.known[order.known_start[step] : order.known_start[step + 1]]:
                factor = order.from_known[entry]
                for at in range(size):
                    held[kind, row, at] += factor * held[kind, known, at]
                entry += 1
        start += order.known_start[step + 1] - order.known_start[step]


@kernel
def _phase(sources: ComposedSources, source: int, period: float, positions: InputPositions, S: Floats) -> None:
    """Forward angles (rad) of a driver on average, whole periods taken off: `InputPhase.cycles`."""
    factor, start = sources.factor[source], sources.start[source]
    turns, left, right = positions.turns, positions.left, positions.right
    high, low, rest = sources.high[source], sources.low[source], sources.rest[source]
    plain = factor <= positions.plain
    for at in range(len(turns)):
        product = turns[at] * factor
        if not plain:
            lost = (((left[at] * high - product) + left[at] * low) + right[at] * high) + right[at] * low
            lost += turns[at] * rest
            product = (product - np.floor(product)) + lost
        S[at] = product * period + start


@kernel
def _law_along(
    laws: TransmissionTables,
    source: int,
    sources: int,
    flank: int,
    coasting: Bools,
    S: Floats,
    error: Floats,
    tau: Floats,
    scratch: MotionScratch,
) -> None:
    """Errors (rad) and speeds of a law, of either flank where it touches."""
    size, count = len(S), 0
    if flank >= 0:
        for at in range(size):
            if coasting[flank, at]:
                scratch.S[count] = S[at]
                count += 1
    if count < size:
        law_along(laws, source, S, error, tau, scratch.u[:size], scratch.cell[:size])
    if count > 0:
        e, v, u = scratch.error[:count], scratch.tau[:count], scratch.u[:count]
        law_along(laws, sources + source, scratch.S[:count], e, v, u, scratch.cell[:count])
        count = 0
        for at in range(size):
            if coasting[flank, at]:
                error[at], tau[at] = e[count], v[count]
                count += 1


@kernel
def _couple(
    arrays: TurningArrays, step: int, coasting: Bools, angle: Floats, w: Floats, delta: Floats, slope: Floats
) -> bool:
    """Sources that turn each other's drivers, at one position: Newton's method with halved steps, equation (5).

    Errors into `delta` and rates into `slope`, what they add to drivers into `angle`; False if that fails.
    """
    order, sources, laws = arrays.order, arrays.sources, arrays.laws
    first, count = order.sources[step], len(angle)
    chosen = np.zeros(count, dtype=np.int64)  # the law of the flank that touches
    for row in range(count):
        flank = arrays.flank[first + row]
        chosen[row] = first + row
        if flank >= 0 and coasting[flank]:
            chosen[row] += len(arrays.flank)
    gain = order.gain[order.gain_start[step] : order.gain_start[step + 1]].reshape(count, count)
    trial, tilt, stride, lean = np.zeros(count), np.zeros(count), np.zeros(count), np.zeros(count)
    residual, matrix = np.zeros(count), np.zeros((count, count))
    tolerance = SETTLED
    for row in range(count):
        whole = 1.0 + abs(angle[row])
        for other in range(count):
            whole += abs(gain[row, other])
        tolerance = max(tolerance, SETTLED * whole)
        found, _ = law_at(laws, chosen[row], angle[row])
        delta[row] = sources.sense[first + row] * found
    length, least, settled = 1.0, np.inf, False
    for _ in range(MOST_STEPS):
        size = 0.0
        for row in range(count):
            trial[row] = delta[row] - length * stride[row]
        for row in range(count):
            S = angle[row]
            for other in range(count):
                S += gain[row, other] * trial[other]
            found, tau = law_at(laws, chosen[row], S)
            tilt[row] = sources.sense[first + row] * (tau - sources.ratio[first + row])
            residual[row] = trial[row] - sources.sense[first + row] * found
            size = max(size, abs(residual[row]))
        if size < least:
            length, least = 1.0, size
            for row in range(count):
                delta[row], lean[row] = trial[row], tilt[row]
            settled = size <= tolerance
            if settled:
                break
            going = solve_coupled(matrix, lean, gain, residual) != 0  # at a dead centre no step leaves
            for row in range(count):
                stride[row] = residual[row] if going else 0.0
        elif length < _SHORTEST and least <= FORGIVEN:
            break  # rounding, or the last of a corner
        else:
            length /= 2
    for row in range(count):
        trial[row] = lean[row] * w[row]
    # 1 for ideal teeth: not positive any more means past a dead centre
    if not least <= FORGIVEN or not solve_coupled(matrix, lean, gain, trial) > 0:
        return False
    for row in range(count):
        slope[row] = trial[row]
        for other in range(count):
            angle[row] += gain[row, other] * delta[other]
    return True
