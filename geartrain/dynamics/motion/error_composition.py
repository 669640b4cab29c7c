"""Motion with real teeth and pins: every pair's error carried to every link, and back into the angles of the pairs.

Equations (2) to (4) of docs/motion.md. Each error depends on the angle at which its own driver stands, which the errors
of other pairs have moved. In the solved order those come before it, and one pass composes the laws exactly; where pairs
depend on each other their errors are found together (5).
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
from geartrain.numerics.results import short_repr
from geartrain.numerics.rounding_bounds import split

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_propagation import ErrorPropagation, PropagationBlock
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.transmission import TransmissionFunction


_CHUNK = 32768  # most positions worked on at once
_NUMBERS = 1 << 23  # most angles kept at once: longer trains take shorter chunks
PLAIN = 1  # period up to which a plain product tells where in it the driver stands, to rounding


@dataclass(frozen=True)
class PairErrorSource:
    """One pair that ripples."""

    id: str
    transmission: TransmissionFunction
    """Of its driver's forward angle."""
    pair: int
    """Its index in the spread."""
    driver_sense: int
    """1 or -1 where the driver's axis points against its parallels; `carrier_sense` likewise."""
    carrier_sense: int
    cycles: Fraction
    """Periods of the law per turn of the input, on average and exactly; not negative."""
    phase: float
    """The driver's forward angle (rad) at turn 0."""
    forward: int
    """1, or -1 where the driver turns backwards on average."""
    sense: int
    """Of the driven side's mean relative motion, 1 or -1."""
    set_back: float = 0.0
    """How far the driver is ahead of its mean angle at turn 0 (rad): its teeth are counted from there."""

    @property
    def start(self) -> float:
        """Forward angle (rad) of the driver at turn 0, without the errors of links."""
        return self.phase - self.set_back

    @property
    def mean(self) -> float:
        """Mean forward speed of the driver over the input's."""
        return float(self.cycles) * self.transmission.period / (2 * np.pi)


def common_period(sources: Sequence[PairErrorSource]) -> Fraction | None:
    """Turns of the input after which all sources stand as at the start; None where none turns."""
    cycles = [source.cycles for source in sources if source.cycles]
    if not cycles:
        return None
    # the least common multiple of the periods 1 / cycles, which are in lowest terms
    return Fraction(lcm(*(each.denominator for each in cycles)), gcd(*(each.numerator for each in cycles)))


class CompositionStep(NamedTuple):
    """A part of the spread in which something ripples, over lively links only; `sources` by index."""

    part: PropagationBlock
    links: tuple[int, ...]
    known: tuple[int, ...]
    from_known: Floats
    sources: tuple[int, ...]
    from_sources: Floats
    coupled: bool


class SeenLink(NamedTuple):
    """A link and the link it is seen from, by index; `sense` is -1 where their axes point against each other."""

    of: int
    base: int
    sense: int = 1

    def difference(self, values: Floats) -> float:
        """The value of the one seen from the other, from values of all links about their own axes."""
        return float(values[self.of] - self.sense * values[self.base])


class ErrorSamples(NamedTuple):
    """Errors of outputs at some positions of the input.

    See Also
    --------
    Motion.at : what gives these.
    """

    turns: Floats
    """Turns of the input. Shape (n,)."""
    error: Floats
    """Angle of each output less its mean motion [rad]. Shape (outputs, n)."""
    rate: Floats
    """Speed of each output less its mean, over the input's. Shape (outputs, n)."""
    reversing_drivers: frozenset[str] = frozenset()
    """Pairs whose driver turns against its mean at one of these positions: their flanks change there, and the law,
    which is that of the flanks in front, does not follow the play."""

    def __repr__(self) -> str:
        return short_repr(self)


@dataclass
class ErrorComposition:
    """Sources in a train, and the outputs that are asked for."""

    spread: ErrorPropagation
    sources: tuple[PairErrorSource, ...]
    outputs: tuple[SeenLink, ...]
    offsets: tuple[float, ...] = ()
    """What each output is ahead of what its teeth and pins add to it, at every position (rad): teeth that keep their
    ratio add their play alone, and pointers are set; none by default."""

    @cached_property
    def steps(self) -> tuple[CompositionStep, ...]:
        """The solved order, without the links that no error reaches, and those that no output depends on."""
        wanted = {link for seen in self.outputs for link in (seen.of, seen.base)}
        kept = []
        for step in reversed(self._lively):
            if wanted.intersection(step.links):
                wanted.update(step.known, *(self._ends(source) for source in step.sources))
                kept.append(step)
        return tuple(reversed(kept))

    @cached_property
    def _lively(self) -> tuple[CompositionStep, ...]:
        """The solved order without the links that no error reaches."""
        of_pair = {source.pair: at for at, source in enumerate(self.sources)}
        lively: set[int] = set()
        steps = []
        for part in self.spread.parts:
            pairs = [at for at, pair in enumerate(part.pairs) if pair in of_pair]
            known = [at for at, link in enumerate(part.known) if link in lively]
            if not pairs and not known:
                continue
            sources = tuple(of_pair[part.pairs[at]] for at in pairs)
            inside = set(part.links)
            coupled = any(inside.intersection(self._ends(source)) for source in sources)
            lively.update(part.links)
            steps.append(
                CompositionStep(
                    part,
                    part.links,
                    tuple(part.known[at] for at in known),
                    part.from_known[:, known],
                    sources,
                    part.from_pairs[:, pairs],
                    coupled,
                )
            )
        return tuple(steps)

    @cached_property
    def used(self) -> tuple[PairErrorSource, ...]:
        """The sources that reach an output, or an angle that one depends on."""
        return tuple(self.sources[at] for step in self.steps for at in step.sources)

    def driver_shift(self, source: PairErrorSource, error: Floats) -> float:
        """What errors of links (rad, by index) add to the forward angle of a source's driver."""
        return float(sum(sign * error[link] for link, sign in self.turned_by(source)))

    def driver_angle(self, source: PairErrorSource, phase: InputPhase, error: Mapping[int, Floats]) -> Floats:
        """Forward angle (rad) of a source's driver, from errors of links about their own axes, by index (rad)."""
        S = phase.cycles(source.cycles) * source.transmission.period + source.start
        for link, sign in self.turned_by(source):
            S += sign * error[link]
        return S

    def turned_by(self, source: PairErrorSource) -> tuple[tuple[int, int], tuple[int, int]]:
        """The links whose errors turn a source's driver, itself and its carrier, each with its sign: equation (3)."""
        joint = self.spread.joints[source.pair]
        return (
            (joint.driver, source.forward * source.driver_sense),
            (joint.carrier, -source.forward * source.carrier_sense),
        )

    def _ends(self, source: int) -> tuple[int, int]:
        joint = self.spread.joints[self.sources[source].pair]
        return joint.driver, joint.carrier

    @cached_property
    def place(self) -> dict[int, int]:
        """The row in which a link stands until it is read for the last time; then another takes the row."""
        last: dict[int, int] = {}
        for at, step in enumerate(self.steps):
            last.update(dict.fromkeys((*step.known, *(end for s in step.sources for end in self._ends(s))), at))
        for seen in self.outputs:
            last.update(dict.fromkeys((seen.of, seen.base), len(self.steps)))
        place: dict[int, int] = {}
        free: list[int] = []
        count = 0
        for at, step in enumerate(self.steps):
            for link in step.links:
                if not free:
                    free.append(count)
                    count += 1
                place[link] = free.pop()
            read = {*step.links, *step.known, *(end for s in step.sources for end in self._ends(s))}
            free += [place[link] for link in read if link in place and last.get(link, at) == at]
        return place

    @cached_property
    def rows(self) -> int:
        """How many links are kept at once."""
        return max(self.place.values(), default=-1) + 1

    @cached_property
    def chunk(self) -> int:
        """Positions worked on at once: memory is bounded however long the train."""
        # errors and rates of the links, and of coupled pairs a Jacobian at each position
        widest = max((len(step.sources) ** 2 for step in self.steps if step.coupled), default=0)
        return max(64, min(_CHUNK, _NUMBERS // (2 * (self.rows + widest) + 1)))

    def at(self, turns: Floats) -> ErrorSamples:
        """Errors and rates of the outputs where the input has made some turns, at most a chunk of them."""
        angle = InputPhase(turns)
        error = np.empty((self.rows, len(turns)))
        rate = np.empty_like(error)
        reversing_drivers = frozenset(pair for step in self.steps for pair in self._take(step, angle, error, rate))
        found = [np.zeros((len(self.outputs), len(turns))) for _ in range(2)]
        for at, seen in enumerate(self.outputs):
            for link, sign in ((seen.of, 1), (seen.base, -seen.sense)):
                if link in self.place:
                    found[0][at] += sign * error[self.place[link]]
                    found[1][at] += sign * rate[self.place[link]]
        for at, offset in enumerate(self.offsets):
            found[0][at] += offset
        return ErrorSamples(turns, found[0], found[1], reversing_drivers)

    def _take(self, step: CompositionStep, angle: InputPhase, error: Floats, rate: Floats) -> Iterator[str]:
        """Fill in the links of a step; yields its pairs whose driver turns against its mean."""
        known = [self.place[link] for link in step.known]
        first = self.place[step.links[0]]
        own = slice(first, first + 1) if len(step.links) == 1 else [self.place[link] for link in step.links]
        error[own] = step.from_known @ error[known] if known else 0.0
        rate[own] = step.from_known @ rate[known] if known else 0.0
        if not step.sources:
            return
        # angles of the drivers and their speeds, without what the step's own pairs add
        where = [self._driver_angle(source, angle, error, rate) for source in step.sources]
        sources = [self.sources[source] for source in step.sources]
        if step.coupled:
            delta, slope, turning = solve_coupled_errors(
                self._coupled(step), np.stack([S for S, _ in where]), [w for _, w in where]
            )
        else:
            parts = [source.transmission.error_and_speed(S) for source, (S, _) in zip(sources, where, strict=True)]
            turning = [w for _, w in where]
            own_pairs = list(zip(sources, parts, turning, strict=True))
            delta = np.stack([s.sense * e for s, (e, _), _ in own_pairs])
            slope = np.stack([s.sense * (tau - float(s.transmission.ratio)) * w for s, (_, tau), w in own_pairs])
        error[own] += step.from_sources @ delta
        rate[own] += step.from_sources @ slope
        yield from (source.id for source, speed in zip(sources, turning, strict=True) if np.min(speed) < 0)

    def _driver_angle(self, at: int, angle: InputPhase, error: Floats, rate: Floats) -> tuple[Floats, Floats | float]:
        """Forward angle (rad) and speed of a source's driver; links of its own step count as they stand."""
        source = self.sources[at]
        S = angle.cycles(source.cycles) * source.transmission.period
        if source.start:
            S += source.start
        turning: Floats | float = source.mean
        for link, sign in self.turned_by(source):
            place = self.place.get(link)
            if place is not None:
                S += sign * error[place]
                turning = turning + sign * rate[place]
        return S, turning

    def gain(self, step: CompositionStep) -> Floats:
        """What each driver of a step gains from the errors of the step's own pairs, (sources, sources)."""
        inside = {link: at for at, link in enumerate(step.links)}
        gain = np.zeros((len(step.sources), len(step.sources)))
        for row, at in enumerate(step.sources):
            for link, sign in self.turned_by(self.sources[at]):
                if link in inside:
                    gain[row] += sign * step.from_sources[inside[link]]
        return gain

    def _coupled(self, step: CompositionStep) -> CoupledErrors:
        sources = [self.sources[at] for at in step.sources]
        return CoupledErrors(
            tuple(source.id for source in sources),
            tuple(source.transmission for source in sources),
            np.array([float(source.sense) for source in sources]),
            self.gain(step),
        )


class InputPhase:
    """Positions of the input, in turns, and the fraction of a law's period at which they find it."""

    def __init__(self, turns: Floats) -> None:
        self.turns = turns
        self.most = float(np.max(np.abs(turns), initial=0.0))

    @cached_property
    def _halves(self) -> tuple[Floats, Floats]:
        return split(self.turns)

    def cycles(self, ratio: Fraction) -> Floats:
        """turns times an exact ratio, by Dekker's product, whole periods taken off where there are many.

        Right to the rounding of a period at any length: after 1e12 turns the teeth still stand where they should.
        """
        factor = float(ratio)
        product: Floats = self.turns * factor
        if factor * self.most <= PLAIN:
            return product
        # Dekker's product: what rounding took from it is found exactly
        high, low = split(factor)
        left, right = self._halves
        # largest first: in this order no sum rounds
        lost = left * high - product
        lost += left * low
        lost += right * high
        lost += right * low
        if rest := float(ratio - Fraction(factor)):
            lost += self.turns * rest
        # exact; before the remainder is added, which many periods would swallow
        product -= np.floor(product)
        product += lost
        return product
