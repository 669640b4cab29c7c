"""Compiled kernel for the composition of transmission errors, which agrees with `ErrorComposition` to 1e-12 rad.

This module contains the arrays that the kernel reads, the kernel, and the composition that calls it. `ErrorComposition`
evaluates equations (2) to (4) of docs/motion.md with arrays of all positions, one transmission function after the
other. The kernel evaluates blocks of about two thousand positions, whose angles and errors stay in the processor's
cache. A pair whose error turns its own driver has the error delta = sigma error(S + g delta), equation (5) for one
pair, with the nominal driver angle S, the sense sigma of the driven side and the gain g. Without dead centres, delta is
a periodic function of S, which is tabulated like any transmission function.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import PLAIN, REST, ErrorSamples
from geartrain.dynamics.motion.error_propagation import CoupledErrors, solve_coupled_errors
from geartrain.numerics.kernels import kernel
from geartrain.numerics.rounding_bounds import SPLITTER, split
from geartrain.teeth.transmission import TransmissionFunction
from geartrain.teeth.transmission_table import join_transmission_tables, make_transmission_table, transmission_along

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import ErrorComposition, PairErrorSource
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.transmission_table import TransmissionTable, TransmissionTables


BLOCK = 2048  # positions: enough to amortise the overhead of a block, few enough for the processor's cache


@dataclass(frozen=True)
class FedBackTransmission:
    """Transmission function of a pair whose error turns its own driver, by `gain` times the error of the driven side.

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
        # det J > 0 for a single pair, equation (5) of docs/motion.md
        return all(1 - self.sense * (tau - ratio) * self.gain > 0 for tau in self.transmission.speed_range())

    def kinks(self) -> list[float]:
        """Return the nominal driver angles [rad] at the kinks of the transmission function."""
        kinks = np.array(self.transmission.kinks(), dtype=float)
        # a kink is at a fixed total angle S + gain delta of the driver
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
        delta, rate, _ = solve_coupled_errors(pair, S.reshape(1, -1), np.ones((1, S.size)))
        return self.sense * delta.reshape(S.shape), self.sense * rate.reshape(S.shape) + float(self.ratio)


class SourceRows(NamedTuple):
    """Sparse matrix in compressed row format with one column for each error source; the entries of row m begin at
    `start[m]`.
    """

    start: Ints
    of: Ints
    c: Floats


class ComposedSources(NamedTuple):
    """Error sources (pairs with variable error) in the order of solution. A source and its transmission function have
    the same index.
    """

    factor: Floats
    """Periods of the transmission function per revolution of the input, rounded to float64."""
    high: Floats
    """High half of `factor` in Dekker's split, with at most 26 bits."""
    low: Floats
    """Low half of `factor` in Dekker's split: `factor` minus `high`."""
    rest: Floats
    """Exact number of periods per revolution of the input minus `factor`."""
    start: Floats
    """Forward angle of the driver at position 0 of the input [rad]."""
    mean: Floats
    """Mean speed of the driver divided by the input speed."""
    sense: Floats
    """Sense of the driven side's mean motion relative to the carrier, 1 or -1."""
    ratio: Floats
    """Mean ratio of the transmission function."""
    gain: Floats
    """Change of the source's driver angle per unit of its own error [rad/rad]; 0 unless it has a `FedBackTransmission`.
    """


class CompositionArrays(NamedTuple):
    """Arrays from which the compiled kernel computes the errors of the outputs."""

    drivers: SourceRows
    """Derivative of the driver angle of each error source with respect to the error of each earlier source [rad/rad].
    """
    outputs: SourceRows
    """Error of each output per unit of the error of each source [rad/rad]."""
    offset: Floats
    """Constant added to the error of each output [rad]."""
    sources: ComposedSources
    transmissions: TransmissionTables


def make_composition_arrays(composition: ErrorComposition) -> CompositionArrays | None:
    """Return the kernel's arrays for an error composition; None if a transmission function has no table, or if errors
    of pairs are coupled.
    """
    tables: list[TransmissionTable] = []
    for step in composition.steps:
        # coupled pairs need Newton's method, which the kernel does not contain
        if len(step.sources) > 1:
            return None
        source, gain = composition.sources[step.sources[0]], float(step.own[0, 0])
        table = _fed_back(source, gain) if step.coupled else make_transmission_table(source.transmission)
        if table is None:
            return None
        tables.append(table)
    steps, used = composition.steps, [step.sources[0] for step in composition.steps]
    place = {at: number for number, at in enumerate(used)}
    return CompositionArrays(
        _sparse([dict(zip((place[at] for at in step.known), step.from_known[0], strict=True)) for step in steps]),
        _sparse([dict(enumerate(row)) for row in composition.weights[:, used]]),
        np.array(composition.offsets or (0.0,) * len(composition.outputs)),
        _sources(composition, [float(step.own[0, 0]) for step in steps]),
        join_transmission_tables(tables),
    )


def _fed_back(source: PairErrorSource, gain: float) -> TransmissionTable | None:
    """Return the table of the transmission function of a pair whose error turns its own driver; None if it has no table
    or may reach a dead centre.
    """
    transmission = FedBackTransmission(source.transmission, source.sense, gain)
    # a function that differs from position to position is not one table
    changing = type(source.transmission).picked is not TransmissionFunction.picked
    return make_transmission_table(transmission) if transmission.has_no_dead_centre and not changing else None


def _sources(composition: ErrorComposition, gains: Sequence[float]) -> ComposedSources:
    used = composition.used
    factor = np.array([float(source.cycles) for source in used])
    return ComposedSources(
        factor,
        *split(factor),
        # rounding error of the factor, for Dekker's product
        np.array([float(source.cycles - Fraction(float(source.cycles))) for source in used]),
        np.array([source.start for source in used]),
        np.array([source.mean for source in used]),
        np.array([float(source.sense) for source in used]),
        np.array([float(source.transmission.ratio) for source in used]),
        np.array(gains, dtype=float),
    )


def _sparse(rows: Sequence[Mapping[int, float]]) -> SourceRows:
    kept = [{of: c for of, c in row.items() if c} for row in rows]
    return SourceRows(
        np.cumsum([0, *map(len, kept)], dtype=np.int64),
        np.array([of for row in kept for of in row], dtype=np.int64),
        np.array([c for row in kept for c in row.values()], dtype=np.float64),
    )


@kernel
def compose(
    arrays: CompositionArrays,
    turns: Floats,
    plain: float,
    error: Floats,
    rate: Floats,
    behind: Ints,
) -> None:
    """Compute errors [rad] and rates (speed deviations divided by the input speed) [1] of the outputs at positions of
    the input [revolutions], in place; both results have the shape (outputs, n).

    plain    periods per revolution up to which a product in float64 gives the phase of a driver to rounding
    behind   result: number of positions at which the driver of each source turns against its mean motion
    """
    drivers, outputs, offset, sources, transmissions = arrays
    count = len(sources.factor)
    delta, slope = np.zeros((count, BLOCK)), np.zeros((count, BLOCK))
    angle, turning = np.zeros(BLOCK), np.zeros(BLOCK)
    scratch, cell = np.zeros(BLOCK), np.zeros(BLOCK, dtype=np.int32)
    behind[:] = 0
    # blocks fit in the processor's cache
    for begin in range(0, len(turns), BLOCK):
        size = min(BLOCK, len(turns) - begin)
        S, w = angle[:size], turning[:size]
        for source in range(count):
            # angle and speed of the driver, from its mean motion and the errors of earlier pairs
            _phase(sources, source, transmissions.period[source], plain, turns[begin : begin + size], S)
            w[:] = sources.mean[source]
            _add(drivers, source, delta, S)
            _add(drivers, source, slope, w)
            # error and slope of the transmission function at this angle
            e, v = delta[source, :size], slope[source, :size]
            transmission_along(transmissions, source, S, e, v, scratch[:size], cell[:size])
            _sign(sources, source, w, e, v)
            behind[source] += _count_below(w, -REST * sources.mean[source])
        for output in range(len(offset)):
            error[output, begin : begin + size] = offset[output]
            rate[output, begin : begin + size] = 0.0
            _add(outputs, output, delta, error[output, begin : begin + size])
            _add(outputs, output, slope, rate[output, begin : begin + size])


@kernel
def _add(rows: SourceRows, m: int, values: Floats, into: Floats) -> None:
    """Add the product of row m of a sparse matrix and the values of the sources to an array, in place."""
    for x in range(rows.start[m], rows.start[m + 1]):
        factor, value = rows.c[x], values[rows.of[x]]
        for at in range(len(into)):
            into[at] += factor * value[at]


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
def _sign(sources: ComposedSources, source: int, w: Floats, error: Floats, slope: Floats) -> None:
    """Convert error and speed of a transmission function to error and rate of the driven side, in place."""
    sense, ratio, gain = sources.sense[source], sources.ratio[source], sources.gain[source]
    for at in range(len(w)):
        error[at] *= sense
        slope[at] = sense * (slope[at] - ratio) * w[at]
        w[at] += gain * slope[at]


@kernel
def _count_below(speed: Floats, bound: float) -> int:
    found = 0
    for each in speed:
        found += each < bound
    return found


@dataclass(frozen=True)
class CompiledComposition:
    """Error composition by the compiled kernel. All transmission functions are in tables, and no pairs are coupled.

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
        rate /= np.array([[seen.scale] for seen in self.composition.outputs])
        back = frozenset(source.id for source, positions in zip(used, behind, strict=True) if positions)
        return ErrorSamples(turns, error, rate, back)


def compiled_composition(composition: ErrorComposition) -> CompiledComposition | None:
    """Return the compiled form of an error composition; None if pairs are coupled or a transmission function has no
    table.
    """
    arrays = make_composition_arrays(composition)
    return None if arrays is None else CompiledComposition(composition, arrays)
