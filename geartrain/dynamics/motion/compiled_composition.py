"""Composition of transmission errors by a compiled kernel: equal to 1e-12 rad, about ten times as fast.

This module contains the arrays that the kernel reads, the kernel, and the composition that calls it. `ErrorComposition`
evaluates equations (2) to (4) of docs/motion.md with arrays of all positions, one transmission function after the
other. The kernel evaluates blocks of about two thousand positions, whose angles and errors stay in the processor's
cache. A pair that moves its own driver has the error delta = sigma error(S + g delta), equation (5) for one pair.
Without dead centres, delta is a periodic function of S, which is tabulated like any transmission function.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import PLAIN, ErrorSamples
from geartrain.dynamics.motion.error_propagation import CoupledErrors, solve_coupled_errors
from geartrain.numerics.kernels import kernel
from geartrain.numerics.rounding_bounds import SPLITTER, split
from geartrain.teeth.transmission import TransmissionFunction
from geartrain.teeth.transmission_table import join_transmission_tables, make_transmission_table, transmission_along

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import CompositionStep, ErrorComposition
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.transmission_table import TransmissionTable, TransmissionTables


BLOCK = 2048  # positions: enough to amortise the overhead of a block, few enough for the processor's cache


@dataclass(frozen=True)
class FedBackTransmission:
    """Transmission function of a pair whose error moves its own driver: by `gain` times the error of its driven side.

    `sense` is the sense of the driven side, 1 or -1.
    """

    transmission: TransmissionFunction
    sense: int
    gain: float

    @property
    def ratio(self) -> Fraction:
        """Mean ratio of the transmission function."""
        return self.transmission.ratio

    @property
    def period(self) -> float:
        """Period of the transmission function [rad]."""
        return self.transmission.period

    @cached_property
    def has_no_dead_centre(self) -> bool:
        """True if the driven side never stops and reverses because of the feedback."""
        ratio = float(self.transmission.ratio)
        return all(1 - self.sense * (tau - ratio) * self.gain > 0 for tau in self.transmission.speed_range())

    def kinks(self) -> list[float]:
        """Return the nominal driver angles [rad] at the kinks of the transmission function."""
        kinks = np.array(self.transmission.kinks(), dtype=float)
        found: list[float] = (kinks - self.gain * self.sense * self.transmission.error(kinks)).tolist()
        return found

    def error(self, S: Floats) -> Floats:
        """Return the transmission error [rad] at nominal driver angles S [rad]."""
        return self._solved(S)[0]

    def speed(self, S: Floats) -> Floats:
        """Return the speed of the driven side divided by the speed of the driver, including feedback."""
        return self._solved(S)[1]

    def _solved(self, S: Floats) -> tuple[Floats, Floats]:
        pair = CoupledErrors(("",), (self.transmission,), np.array([float(self.sense)]), np.array([[self.gain]]))
        delta, rate, _ = solve_coupled_errors(pair, S.reshape(1, -1), [1.0])
        return self.sense * delta.reshape(S.shape), self.sense * rate.reshape(S.shape) + float(self.ratio)


class CompositionOrder(NamedTuple):
    """Order of solution as flat arrays, step by step.

    Ranges begin at `..._start`.
    """

    own_start: Ints
    own: Ints
    """Rows of the links that each step computes."""
    known_start: Ints
    known: Ints
    """Rows of the links on which the links of each step depend. The coefficients are `from_known`, shape (own, known),
    flattened.
    """
    from_known_start: Ints
    from_known: Floats
    sources: Ints
    """Index of the first source of each step, and one past the last source.

    The coefficients are `from_sources`, shape (own, sources), flattened.
    """
    from_sources_start: Ints
    from_sources: Floats
    seen_start: Ints
    seen: Ints
    """Rows of the links whose signed sum is the error of an output, for each output."""
    seen_sign: Floats
    offset: Floats
    """Constant added to the error of each output [rad]."""


class ComposedSources(NamedTuple):
    """Error sources in the order of the steps. A source and its transmission function have the same index."""

    factor: Floats
    """Periods of the transmission function per revolution of the input, rounded to float64."""
    high: Floats
    """High half of `factor` in Dekker's split, with at most 26 bits."""
    low: Floats
    """Low half of `factor` in Dekker's split."""
    rest: Floats
    """Exact number of periods minus `factor`."""
    start: Floats
    """Forward angle of the driver at position 0 of the input [rad]."""
    mean: Floats
    """Mean speed of the driver divided by the input speed."""
    row: Ints
    """Rows of driver and carrier, shape (sources, 2); -1 for links without error."""
    sign: Floats
    """Signs with which the errors of driver and carrier move the driver, shape (sources, 2)."""
    sense: Floats
    """Sense of the driven side's mean motion relative to the carrier, 1 or -1."""
    ratio: Floats
    """Mean ratio of the transmission function."""
    gain: Floats
    """Change of the source's driver angle per unit of its own error, if it has a `FedBackTransmission`, else 0."""


class CompositionArrays(NamedTuple):
    """Input of the kernel. `rows` links are stored at once, and a step has at most `most` sources."""

    order: CompositionOrder
    sources: ComposedSources
    transmissions: TransmissionTables
    rows: int
    most: int


def make_composition_arrays(composition: ErrorComposition) -> CompositionArrays | None:
    """Return the arrays of a composition; None if a transmission function has no table, or if pairs are coupled."""
    transmissions: list[TransmissionTable | None] = []
    gains: list[float] = []
    for step in composition.steps:
        # coupled pairs need Newton's method, which the kernel has not
        if step.coupled and len(step.sources) > 1:
            return None
        own = _fed_back(composition, step) if step.coupled else None
        if step.coupled and own is None:
            return None
        gains += [0.0 if own is None else float(composition.gain(step)[0, 0])] * len(step.sources)
        transmissions += (
            [own] if own else [make_transmission_table(composition.sources[at].transmission) for at in step.sources]
        )
    tables = [transmission for transmission in transmissions if transmission is not None]
    if len(tables) < len(transmissions):
        return None
    most = max((len(step.sources) for step in composition.steps), default=0)
    return CompositionArrays(
        _order(composition),
        _sources(composition, gains),
        join_transmission_tables(tables),
        len(composition.place),
        most,
    )


def _fed_back(composition: ErrorComposition, step: CompositionStep) -> TransmissionTable | None:
    """Return the table of a pair that moves its own driver; None if it has no table or may reach a dead centre."""
    (source,) = (composition.sources[at] for at in step.sources)
    transmission = FedBackTransmission(source.transmission, source.sense, float(composition.gain(step)[0, 0]))
    changing = type(source.transmission).picked is not TransmissionFunction.picked
    return make_transmission_table(transmission) if transmission.has_no_dead_centre and not changing else None


def _order(composition: ErrorComposition) -> CompositionOrder:
    steps, place = composition.steps, composition.place
    own = _ranges([[place[link] for link in step.links] for step in steps])
    known = _ranges([[place[link] for link in step.known] for step in steps])
    from_known = _matrices([step.from_known for step in steps])
    from_sources = _matrices([step.from_sources for step in steps])
    # an output is its link minus its reference link; links without error have no row
    seen = [
        [(place[link], sign) for link, sign in ((each.of, 1), (each.base, -each.sense)) if link in place]
        for each in composition.outputs
    ]
    return CompositionOrder(
        *own,
        *known,
        *from_known,
        _starts(len(step.sources) for step in steps),
        *from_sources,
        *_ranges([[row for row, _ in each] for each in seen]),
        np.array([float(sign) for each in seen for _, sign in each]),
        np.array(composition.offsets or (0.0,) * len(composition.outputs)),
    )


def _sources(composition: ErrorComposition, gains: Sequence[float]) -> ComposedSources:
    used, place = composition.used, composition.place
    factor = np.array([float(source.cycles) for source in used])
    ends = [composition.turned_by(source) for source in used]
    return ComposedSources(
        factor,
        *split(factor),
        # rounding error of the factor, for Dekker's product
        np.array([float(source.cycles - Fraction(float(source.cycles))) for source in used]),
        np.array([source.start for source in used]),
        np.array([source.mean for source in used]),
        np.array([[place.get(link, -1) for link, _ in each] for each in ends], dtype=np.int64).reshape(-1, 2),
        np.array([[float(sign) for _, sign in each] for each in ends]).reshape(-1, 2),
        np.array([float(source.sense) for source in used]),
        np.array([float(source.transmission.ratio) for source in used]),
        np.array(gains, dtype=float),
    )


def _starts(counts: Iterable[int]) -> Ints:
    return np.cumsum([0, *counts], dtype=np.int64)


def _ranges(lists: Sequence[Sequence[int]]) -> tuple[Ints, Ints]:
    flat = [each for part in lists for each in part]
    return _starts(len(part) for part in lists), np.array(flat, dtype=np.int64)


def _matrices(matrices: Sequence[Floats]) -> tuple[Ints, Floats]:
    return _starts(each.size for each in matrices), np.concatenate([np.zeros(0), *(each.ravel() for each in matrices)])


@kernel
def compose(
    arrays: CompositionArrays,
    turns: Floats,
    plain: float,
    error: Floats,
    rate: Floats,
    behind: Ints,
) -> None:
    """Compute errors [rad] and rates [1] of the outputs, shape (outputs, n), at positions of the input [revolutions],
    in place.

    plain    periods per revolution up to which a product in float64 gives the phase of a driver to rounding
    behind   result: number of positions at which the driver of each source turns against its mean motion
    """
    order, sources, transmissions, rows, most = arrays
    held = np.zeros((2, rows, BLOCK))
    angle, turning = np.zeros((most, BLOCK)), np.zeros((most, BLOCK))
    delta, slope = np.zeros((most, BLOCK)), np.zeros((most, BLOCK))
    scratch, cell = np.zeros(BLOCK), np.zeros(BLOCK, dtype=np.int32)
    behind[:] = 0
    # blocks fit in the processor's cache
    for begin in range(0, len(turns), BLOCK):
        size = min(BLOCK, len(turns) - begin)
        here = turns[begin : begin + size]
        for step in range(len(order.own_start) - 1):
            _carry(order, step, size, held)
            first, last = order.sources[step], order.sources[step + 1]
            # angle and speed of each driver, from its mean motion and the errors of links
            for source in range(first, last):
                S, w = angle[source - first, :size], turning[source - first, :size]
                _phase(sources, source, transmissions.period[source], plain, here, S)
                _turn(sources, source, size, held, S, w)
            for source in range(first, last):
                e, v = delta[source - first, :size], slope[source - first, :size]
                # error and slope of each transmission function at this angle
                transmission_along(
                    transmissions, source, angle[source - first, :size], e, v, scratch[:size], cell[:size]
                )
                _sign(sources, source, turning[source - first, :size], e, v)
                behind[source] += _count_negative(turning[source - first, :size])
            _spread(order, step, size, delta, slope, held)
        _read(order, begin, size, held, error, rate)


@kernel
def _carry(order: CompositionOrder, step: int, size: int, held: Floats) -> None:
    """Add to the links of a step the errors and rates of the known links on which they depend."""
    first, last = order.known_start[step], order.known_start[step + 1]
    at = order.from_known_start[step]
    for row in order.own[order.own_start[step] : order.own_start[step + 1]]:
        for kind in range(2):
            into = held[kind, row, :size]
            if first == last:
                into[:] = 0.0
            for known in range(first, last):
                factor, other = order.from_known[at + known - first], held[kind, order.known[known], :size]
                # the first term overwrites the row, which an earlier link may have used
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
    """Compute the mean forward angle of a driver [rad], modulo whole periods, as `InputPhase.cycles` does."""
    factor, start = sources.factor[source], sources.start[source]
    if factor <= plain:
        for at in range(len(turns)):
            S[at] = turns[at] * factor * period + start
        return
    high, low, rest = sources.high[source], sources.low[source], sources.rest[source]
    for at in range(len(turns)):
        turned = turns[at]
        product = turned * factor
        # Dekker's product of two floats, as in `rounding_bounds.split` and `InputPhase.cycles`
        wide = SPLITTER * turned
        left = wide - (wide - turned)
        right = turned - left
        lost = (((left * high - product) + left * low) + right * high) + right * low
        lost += turned * rest
        S[at] = ((product - np.floor(product)) + lost) * period + start


@kernel
def _turn(sources: ComposedSources, source: int, size: int, held: Floats, S: Floats, w: Floats) -> None:
    """Add the errors of driver and carrier to the driver's angle, and their rates to its speed, in place."""
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
    """Convert error and speed of a transmission function to error and rate of the driven side, in place."""
    sense, ratio, gain = sources.sense[source], sources.ratio[source], sources.gain[source]
    for at in range(len(w)):
        error[at] *= sense
        slope[at] = sense * (slope[at] - ratio) * w[at]
        w[at] += gain * slope[at]


@kernel
def _count_negative(speed: Floats) -> int:
    found = 0
    for each in speed:
        found += each < 0.0
    return found


@kernel
def _spread(order: CompositionOrder, step: int, size: int, delta: Floats, slope: Floats, held: Floats) -> None:
    """Add the errors of a step's pairs to its links, in place."""
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
    """Compute errors and rates of the outputs as signed sums over links."""
    for output in range(len(order.offset)):
        e, v = error[output, begin : begin + size], rate[output, begin : begin + size]
        e[:] = order.offset[output]
        v[:] = 0.0
        for at in range(order.seen_start[output], order.seen_start[output + 1]):
            row, sign = order.seen[at], order.seen_sign[at]
            for position in range(size):
                e[position] += sign * held[0, row, position]
                v[position] += sign * held[1, row, position]


@dataclass(frozen=True)
class CompiledComposition:
    """Composition by the compiled kernel, with all transmission functions in tables and without coupled pairs.

    Coupled pairs are evaluated with numpy. A kernel for their Newton's method was 4 to 7 times faster in the
    composition (`planetary-24-18-60-triangular`, `pennestri-2002-teeth`), compared with 9 to 27 times for other trains,
    but no faster in complete runs. Without compilation it was 13 to 20 times slower than numpy.
    """

    composition: ErrorComposition
    arrays: CompositionArrays
    fast: bool = True

    @property
    def chunk(self) -> int:
        """Maximum number of positions evaluated at once."""
        return self.composition.chunk

    def at(self, turns: Floats) -> ErrorSamples:
        """Return errors [rad] and rates [1] of the outputs at positions of the input [revolutions]."""
        turns = np.array(turns, dtype=float)
        farthest = max(float(np.max(turns, initial=0.0)), -float(np.min(turns, initial=0.0)))
        outputs, used = len(self.composition.outputs), self.composition.used
        error, rate = np.empty((outputs, len(turns))), np.empty((outputs, len(turns)))
        behind = np.zeros(len(used), dtype=np.int64)
        # within one period a plain product is accurate enough
        plain = PLAIN / farthest if farthest else np.inf
        compose.chosen(self.fast)(self.arrays, turns, plain, error, rate, behind)
        back = frozenset(source.id for source, positions in zip(used, behind, strict=True) if positions)
        return ErrorSamples(turns, error, rate, back)


def compiled_composition(composition: ErrorComposition) -> CompiledComposition | None:
    """Return the compiled form of a composition; None if a transmission function has no table, or if pairs are
    coupled.
    """
    arrays = make_composition_arrays(composition)
    return None if arrays is None else CompiledComposition(composition, arrays)
