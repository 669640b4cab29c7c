"""Composition of tooth and pin errors, equations (2) to (5) of docs/motion.md.

The error of a pair depends on its driver's angle, which includes the errors of other pairs. In the order of solution
these come first, so that a single pass composes the transmission functions exactly.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import gcd, lcm
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_propagation import CoupledErrors, solve_coupled_errors
from geartrain.numerics.block_triangular import find_blocks
from geartrain.numerics.results import short_repr
from geartrain.numerics.rounding_bounds import split

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_propagation import ErrorPropagation
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.transmission import TransmissionFunction


_CHUNK = 32768  # maximum number of positions evaluated at once
_NUMBERS = 1 << 23  # maximum number of stored angles: longer trains use smaller chunks
REST = 1e-9  # fraction of a driver's mean speed: slower backward motion is rounding in a dwell
PLAIN = 1  # periods up to which a plain product gives the phase of the driver to rounding


@dataclass(frozen=True)
class PairErrorSource:
    """Gear pair or coupling with a variable transmission error, which causes errors of the link angles."""

    id: str
    transmission: TransmissionFunction
    """Transmission function of the pair. Its argument is the driver's angle in its mean sense of rotation [rad]."""
    pair: int
    """Index of the pair in `ErrorPropagation.pairs`."""
    driver_sense: int
    """-1 if the driver's axis points against the reference direction of its parallel axes, 1 if it does not.

    `carrier_sense` is the corresponding sign for the axis of the carrier.
    """
    carrier_sense: int
    cycles: Fraction
    """Exact mean number of periods of the transmission function per revolution of the input; it is not negative."""
    phase: float
    """Angle of the driver in its mean sense of rotation, at position 0 of the input [rad]."""
    forward: int
    """Sign of the driver's mean speed about its axis, 1 or -1."""
    sense: int
    """Sense of the driven link's mean motion relative to the carrier, 1 or -1."""
    set_back: float = 0.0
    """Advance of the driver at position 0 due to errors of other pairs [rad], which its tooth positions include."""

    @property
    def start(self) -> float:
        """Driver angle at input position 0 without errors of other pairs, positive in the driver's mean sense [rad]."""
        return self.phase - self.set_back

    @property
    def pace(self) -> float:
        """Mean number of periods of the fastest component of the transmission function per revolution of the input."""
        return float(self.cycles) * self.transmission.waves

    @property
    def mean(self) -> float:
        """Mean speed of the driver in its mean sense of rotation, divided by the speed of the input [1]."""
        return float(self.cycles) * self.transmission.period / (2 * np.pi)


def common_period(sources: Sequence[PairErrorSource]) -> Fraction | None:
    """Return the revolutions of the input after which all sources repeat their positions; None if no driver turns."""
    cycles = [source.cycles for source in sources if source.cycles]
    if not cycles:
        return None
    # least common multiple of the periods 1 / cycles, which are in lowest terms
    return Fraction(lcm(*(each.denominator for each in cycles)), gcd(*(each.numerator for each in cycles)))


class CompositionStep(NamedTuple):
    """Group of pairs whose transmission errors depend on one another and are computed together, or a single pair."""

    sources: tuple[int, ...]
    known: tuple[int, ...]
    """Indices of the earlier sources on which the drivers of this group depend; `from_known` contains the coefficients,
    shape (sources, known).
    """
    from_known: Floats
    own: Floats
    """Change of each driver's angle per unit error of each pair of the group [rad/rad], shape (sources, sources)."""

    @property
    def coupled(self) -> bool:
        """True if errors of the pairs in the group change driver angles of pairs in the group."""
        return bool(self.own.any())


class SeenLink(NamedTuple):
    """Link whose motion is measured relative to a reference link; both are given by index. `sense` is -1 if the axes of
    the two links have opposite directions, and 1 if not. `scale` is 1 for angles [rad]. For a sliding link it is 1/(2
    pi), because the equations represent a travel of 1 mm by an angle of 2 pi.
    """

    of: int
    base: int
    sense: int = 1
    scale: float = 1.0

    def difference(self, values: Floats) -> float:
        """Return a quantity of the link minus the same quantity of its reference link. `values` contains the quantity
        for every link about the link's own axis.
        """
        return float(self.scale * (values[self.of] - self.sense * values[self.base]))


class ErrorSamples(NamedTuple):
    """Transmission errors and speed deviations of outputs at given positions of the input.

    See Also
    --------
    Motion.at : method that returns it
    """

    turns: Floats
    """Positions of the input [revolutions], shape (n,)."""
    error: Floats
    """Angle of each output minus its mean motion [rad, or mm for a link that slides], shape (outputs, n).

    The error of an output with a pin and slot includes the designed deviation from uniform motion (anomaly).
    """
    rate: Floats
    """Speed of each output minus its mean, divided by the input speed [1, or mm/turn for a link that slides], shape
    (outputs, n).
    """
    reversing_drivers: frozenset[str] = frozenset()
    """Names of pairs whose driver turns against its mean sense of rotation at one or more of these positions.

    While such a driver turns backwards, the coast flanks of its pair are in contact. This is not modelled: the
    transmission function of the drive flanks is used, without backlash.
    """

    def __repr__(self) -> str:
        return short_repr(self)


def evaluate(sampler: ErrorComposition | ErrorDifference, turns: Floats) -> ErrorSamples:
    """Return the errors of the outputs [rad] and their speed deviations divided by the input speed [1] at input
    positions `turns` [revolutions].
    """
    parts = [sampler.at(turns[start : start + sampler.chunk]) for start in range(0, len(turns), sampler.chunk)]
    error, rate = (np.concatenate([part[column] for part in parts], axis=1) for column in (1, 2))
    return ErrorSamples(turns, error, rate, frozenset().union(*(part.reversing_drivers for part in parts)))


@dataclass(frozen=True)
class ErrorDifference:
    """Difference of the output errors of two composed motions with the same outputs, at equal input positions."""

    one: ErrorComposition
    other: ErrorComposition

    @property
    def chunk(self) -> int:
        """Maximum number of positions that can be evaluated in one call."""
        return min(self.one.chunk, self.other.chunk)

    def at(self, turns: Floats) -> ErrorSamples:
        """Return the difference between the two compositions in the errors of the outputs [rad] and in their speed
        deviations divided by the input speed [1], at no more than `chunk` input positions `turns` [revolutions].
        """
        one, other = self.one.at(turns), self.other.at(turns)
        both = one.reversing_drivers | other.reversing_drivers
        return ErrorSamples(turns, one.error - other.error, one.rate - other.rate, both)


@dataclass
class ErrorComposition:
    """Computation of the errors of the outputs at any input position from the error sources of a train."""

    spread: ErrorPropagation
    sources: tuple[PairErrorSource, ...]
    outputs: tuple[SeenLink, ...]
    offsets: tuple[float, ...] = ()
    """Constant that is added to the error of each output [rad or mm]; empty if all constants are 0.

    It consists of the backlash of teeth with constant ratio and the setting of the pointers.
    """

    @cached_property
    def gains(self) -> Floats:
        """Change of each source's driver angle per unit error of each pair [rad/rad], shape (sources, pairs)."""
        rows = [sum(sign * self.spread.response[link] for link, sign in self.turned_by(each)) for each in self.sources]
        return np.array(rows).reshape(len(self.sources), len(self.spread.pairs))

    @cached_property
    def weights(self) -> Floats:
        """Change of each output per unit error of each source [rad/rad or mm/rad], shape (outputs, sources)."""
        of = [source.pair for source in self.sources]
        rows = [seen.scale * self.spread.sensitivity(*seen[:3])[of] for seen in self.outputs]
        return np.array(rows).reshape(len(self.outputs), len(self.sources))

    @cached_property
    def steps(self) -> tuple[CompositionStep, ...]:
        """Groups of the pairs on whose errors an output depends, in the order in which they are computed."""
        gains = self.gains[:, [source.pair for source in self.sources]]
        drivers = [np.flatnonzero(row).tolist() for row in gains]
        needed: set[int] = set()
        waiting = np.flatnonzero(self.weights.any(axis=0)).tolist()
        while waiting:
            if (at := waiting.pop()) not in needed:
                needed.add(at)
                waiting += drivers[at]
        # mutually dependent sources form one block, which follows the blocks that it depends on
        blocks = find_blocks([(at, *drivers[at]) if at in needed else (at,) for at in range(len(gains))])
        steps = []
        for block in blocks or ():
            own = tuple(sorted(block.columns))
            if needed.issuperset(own):
                known = tuple(sorted({each for at in own for each in drivers[at]}.difference(own)))
                steps.append(CompositionStep(own, known, gains[np.ix_(own, known)], gains[np.ix_(own, own)]))
        return tuple(steps)

    @cached_property
    def used(self) -> tuple[PairErrorSource, ...]:
        """Error sources that affect an output, directly or through the driver angle of another source."""
        return tuple(self.sources[at] for step in self.steps for at in step.sources)

    def driver_shift(self, source: PairErrorSource, error: Floats) -> float:
        """Return the change of a source's driver angle that is caused by the link errors `error` [rad], shape (links,).
        It is positive in the driver's mean sense of rotation [rad].
        """
        return float(sum(sign * error[link] for link, sign in self.turned_by(source)))

    def driver_angle(self, source: PairErrorSource, phase: InputPhase, error: Mapping[int, Floats]) -> Floats:
        """Return the angle of a source's driver in its mean sense of rotation [rad]; `error` contains the error of each
        link [rad], by index.
        """
        S = phase.cycles(source.cycles) * source.transmission.period + source.start
        for link, sign in self.turned_by(source):
            S += sign * error[link]
        return S

    def turned_by(self, source: PairErrorSource) -> tuple[tuple[int, int], tuple[int, int]]:
        """Return the index of a source's driver and the index of its carrier, each with the sign (1 or -1) with which
        the error of this link changes the driver angle, equation (3) of docs/motion.md.
        """
        joint = self.spread.joints[source.pair]
        return (
            (joint.driver, source.forward * source.driver_sense),
            (joint.carrier, -source.forward * source.carrier_sense),
        )

    @cached_property
    def chunk(self) -> int:
        """Maximum number of positions that can be evaluated in one call, which limits the memory for long trains."""
        # stored numbers: errors and rates of the sources with copies, and a Jacobian of coupled pairs at each position
        widest = max((len(step.sources) ** 2 for step in self.steps if step.coupled), default=0)
        return max(64, min(_CHUNK, _NUMBERS // (4 * (len(self.sources) + widest) + 1)))

    def at(self, turns: Floats) -> ErrorSamples:
        """Return the errors of the outputs [rad] and their speed deviations divided by the input speed [1] at no more
        than `chunk` input positions `turns` [revolutions].
        """
        phase = InputPhase(turns)
        error = np.zeros((len(self.sources), len(turns)))
        rate = np.zeros_like(error)
        reversing_drivers = frozenset(name for step in self.steps for name in self._take(step, phase, error, rate))
        found = np.zeros((2, len(self.outputs), len(turns)))
        for at, weights in enumerate(self.weights):
            # only sources with an effect, because an error is infinite where nothing touches
            of = np.flatnonzero(weights)
            found[:, at] = weights[of] @ error[of], weights[of] @ rate[of] / self.outputs[at].scale
        if self.offsets:
            found[0] += np.array(self.offsets)[:, None]
        return ErrorSamples(turns, found[0], found[1], reversing_drivers)

    def _take(self, step: CompositionStep, phase: InputPhase, error: Floats, rate: Floats) -> Iterator[str]:
        """Compute the errors and speed deviations of the pairs in one group, and store them in the rows of `error` and
        `rate`. Yield the names of the pairs whose driver turns against the sense of its mean speed.
        """
        own, known = list(step.sources), list(step.known)
        sources = [self.sources[at] for at in own]
        # driver angles and speeds, without the errors of the step's own pairs
        S, turning = step.from_known @ error[known], step.from_known @ rate[known]
        for row, source in enumerate(sources):
            S[row] += phase.cycles(source.cycles) * source.transmission.period + source.start
            turning[row] += source.mean
        if step.coupled:
            names, transmissions = tuple(each.id for each in sources), tuple(each.transmission for each in sources)
            pairs = CoupledErrors(names, transmissions, np.array([float(each.sense) for each in sources]), step.own)
            error[own], rate[own], turning = solve_coupled_errors(pairs, S, turning)
        else:
            (source,) = sources
            value, tau = source.transmission.error_and_speed(S[0])
            error[own] = source.sense * value
            rate[own] = source.sense * (tau - float(source.transmission.ratio)) * turning[0]
        yield from (
            source.id for source, speed in zip(sources, turning, strict=True) if np.min(speed) < -REST * source.mean
        )


class InputPhase:
    """Positions of the input, from which the arguments of transmission functions are computed."""

    def __init__(self, turns: Floats) -> None:
        self.turns = turns
        self.most = float(np.max(np.abs(turns), initial=0.0))

    @cached_property
    def _halves(self) -> tuple[Floats, Floats]:
        return split(self.turns)

    def cycles(self, ratio: Fraction) -> Floats:
        """Return the input positions as numbers of periods, if there are `ratio` periods per revolution. The numbers
        are taken modulo 1 if they may exceed `PLAIN`, beyond which a product of floats is too inaccurate.

        Dekker's product keeps the rounding error at the level of one period, even after 1e12 revolutions.
        """
        factor = float(ratio)
        product: Floats = self.turns * factor
        if factor * self.most <= PLAIN:
            return product
        # Dekker's product: the rounding error of the product is computed exactly
        high, low = split(factor)
        left, right = self._halves
        # in this order, largest term first, no sum is rounded
        lost = left * high - product
        lost += left * low
        lost += right * high
        lost += right * low
        if rest := float(ratio - Fraction(factor)):
            lost += self.turns * rest
        # exact; must precede the addition of the remainder, which a large product would round away
        product -= np.floor(product)
        product += lost
        return product
