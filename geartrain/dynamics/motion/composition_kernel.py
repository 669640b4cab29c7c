"""The composition of docs/motion.md, equations (2) to (4), as one kernel over the solved order of a train.

What `ErrorComposition` does with arrays of all positions, one law after the other, is done here for two thousand
positions at a time, whose angles and errors never leave the processor's cache.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.composition_arrays import ComposedSources, CompositionArrays, CompositionOrder
from geartrain.numerics.error_free import SPLITTER
from geartrain.numerics.kernels import kernel
from geartrain.teeth.transmission_kernel import law_along

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

BLOCK = 2048  # positions: so many that what is done once a block does not count, and their angles stay in a cache


@kernel
def compose(
    arrays: CompositionArrays,
    turns: Floats,
    plain: float,
    error: Floats,
    rate: Floats,
    behind: Ints,
) -> None:
    """Errors (rad) and rates of the outputs, (outputs, n), where the input has made so many turns.

    plain    cycles per turn up to which a plain product tells where in its period a driver stands
    behind   of each source: at how many positions its driver turns against its mean, filled in
    """
    order, sources, laws, rows, most = arrays
    held = np.zeros((2, rows, BLOCK))
    angle, turning = np.zeros((most, BLOCK)), np.zeros((most, BLOCK))
    delta, slope = np.zeros((most, BLOCK)), np.zeros((most, BLOCK))
    scratch, cell = np.zeros(BLOCK), np.zeros(BLOCK, dtype=np.int32)
    behind[:] = 0
    for begin in range(0, len(turns), BLOCK):
        size = min(BLOCK, len(turns) - begin)
        here = turns[begin : begin + size]
        for step in range(len(order.own_start) - 1):
            _carry(order, step, size, held)
            first, last = order.sources[step], order.sources[step + 1]
            for source in range(first, last):
                S, w = angle[source - first, :size], turning[source - first, :size]
                _phase(sources, source, laws.period[source], plain, here, S)
                _turn(sources, source, size, held, S, w)
            for source in range(first, last):
                e, v = delta[source - first, :size], slope[source - first, :size]
                law_along(laws, source, angle[source - first, :size], e, v, scratch[:size], cell[:size])
                _sign(sources, source, turning[source - first, :size], e, v)
                behind[source] += _count_negative(turning[source - first, :size])
            _spread(order, step, size, delta, slope, held)
        _read(order, begin, size, held, error, rate)


@kernel
def _carry(order: CompositionOrder, step: int, size: int, held: Floats) -> None:
    """Links of a step, as far as they follow links known before."""
    first, last = order.known_start[step], order.known_start[step + 1]
    at = order.from_known_start[step]
    for row in order.own[order.own_start[step] : order.own_start[step + 1]]:
        for kind in range(2):
            into = held[kind, row, :size]
            if first == last:
                into[:] = 0.0
            for known in range(first, last):
                factor, other = order.from_known[at + known - first], held[kind, order.known[known], :size]
                if known == first:
                    for position in range(size):
                        into[position] = factor * other[position]
                else:
                    for position in range(size):
                        into[position] += factor * other[position]
        at += last - first


@kernel
def _phase(
    sources: ComposedSources,
    source: int,
    period: float,
    plain: float,
    turns: Floats,
    S: Floats,
) -> None:
    """Forward angle (rad) of a driver on average, whole periods taken off: `InputPhase.cycles`."""
    factor, start = sources.factor[source], sources.start[source]
    if factor <= plain:
        for at in range(len(turns)):
            S[at] = turns[at] * factor * period + start
        return
    high, low, rest = sources.high[source], sources.low[source], sources.rest[source]
    for at in range(len(turns)):
        turned = turns[at]
        product = turned * factor
        # Dekker's product of two floats, as `error_free.split` and `InputPhase.cycles` have it
        wide = SPLITTER * turned
        left = wide - (wide - turned)
        right = turned - left
        lost = (((left * high - product) + left * low) + right * high) + right * low
        lost += turned * rest
        S[at] = ((product - np.floor(product)) + lost) * period + start


@kernel
def _turn(sources: ComposedSources, source: int, size: int, held: Floats, S: Floats, w: Floats) -> None:
    """What errors of links add to the angle and speed of a driver."""
    w[:] = sources.mean[source]
    for end in range(2):
        row, sign = sources.row[source, end], sources.sign[source, end]
        if row >= 0:
            error, rate = held[0, row, :size], held[1, row, :size]
            for at in range(size):
                S[at] += sign * error[at]
                w[at] += sign * rate[at]


@kernel
def _sign(sources: ComposedSources, source: int, w: Floats, error: Floats, slope: Floats) -> None:
    """Errors and rates of a driven side from its law's error and speed."""
    sense, ratio, gain = sources.sense[source], sources.ratio[source], sources.gain[source]
    for at in range(len(w)):
        error[at] *= sense
        slope[at] = sense * (slope[at] - ratio) * w[at]
        w[at] += gain * slope[at]


@kernel
def _count_negative(speed: Floats) -> int:
    """How many speeds are negative."""
    found = 0
    for each in speed:
        found += each < 0.0
    return found


@kernel
def _spread(order: CompositionOrder, step: int, size: int, delta: Floats, slope: Floats, held: Floats) -> None:
    """What a step's pairs add to its links."""
    count = order.sources[step + 1] - order.sources[step]
    at = order.from_sources_start[step]
    for row in order.own[order.own_start[step] : order.own_start[step + 1]]:
        error, rate = held[0, row, :size], held[1, row, :size]
        for source in range(count):
            factor, e, v = order.from_sources[at + source], delta[source, :size], slope[source, :size]
            for position in range(size):
                error[position] += factor * e[position]
                rate[position] += factor * v[position]
        at += count


@kernel
def _read(order: CompositionOrder, begin: int, size: int, held: Floats, error: Floats, rate: Floats) -> None:
    """The outputs, from the links of which they are differences."""
    for output in range(len(order.offset)):
        e, v = error[output, begin : begin + size], rate[output, begin : begin + size]
        e[:] = order.offset[output]
        v[:] = 0.0
        for at in range(order.seen_start[output], order.seen_start[output + 1]):
            row, sign = order.seen[at], order.seen_sign[at]
            for position in range(size):
                e[position] += sign * held[0, row, position]
                v[position] += sign * held[1, row, position]
