"""Where the input stands as a pair passes a corner of its law: between these positions all errors are smooth.

A law says at which angles of its driver it has corners. The driver of pair m stands at S_m(x), equation (3) of
docs/motion.md, which the errors of pairs before it have moved; so each S_m(x) = corner + a whole number of periods is
solved for x. Between the ends of a narrow step S_m grows from one value to another, which tells how many corners it
passes; each is found by false position. Where a driver turns back the step is cut at the place where it turns.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorComposition, InputPhase, SeenLink
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import short_repr
from geartrain.numerics.roots import roots_by_false_position
from geartrain.teeth.transmission_table import folded_kinks

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import PairErrorSource
    from geartrain.numerics.arrays import Floats, Indices

MOST_KINKS = 20_000_000
"""More corners are not listed at once."""

_STEPS = 4  # a period of the fastest law: so narrow a step is monotonic, or its driver turns slowly at an end
_FEWEST = 16  # steps of a run
_SLOW = 0.25  # of the mean speed: a driver so slow may turn back within the step
_PARTS = 16  # of a step in which a driver may turn back
_HALVINGS = 40  # of a step, to find where its driver turns
_FINE = 1e-14  # of a step: what a corner's place is off by
_SAME = 1e-9  # of a period: two corners so near are one found twice, from either side
_NEAR = 1e-11  # of a period beyond a step, in which its corners are sought too: rounding must lose none at its end


class KinkPositions(NamedTuple):
    """Where the input stands as pairs pass corners of their laws, in ascending order.

    See Also
    --------
    Motion.kink_positions : what gives these.
    """

    turns: Floats
    """Turns of the input. Shape (n,)."""
    pair: Indices
    """Which pair is at a corner there, as an index into `pairs`. Shape (n,)."""
    pairs: tuple[str, ...]
    """Names of pairs and couplings."""

    def __repr__(self) -> str:
        return short_repr(self)

    def names(self) -> list[str]:
        """The pair at each position, by name."""
        return [self.pairs[at] for at in self.pair]


class InputSteps(NamedTuple):
    """Steps of the input: turns at their starts and ends, (n,) each."""

    low: Floats
    high: Floats


@dataclass(frozen=True)
class PairKinks:
    """The corners of one law, and its driver's angle by turns of the input.

    kinks    rad, within one period, each once
    """

    source: PairErrorSource
    drivers: ErrorComposition

    @cached_property
    def kinks(self) -> Floats:
        """Driver's angles (rad) at which the law has a corner, within a period, each once."""
        period = self.source.transmission.period
        found = folded_kinks(self.source.transmission)
        # one at 0 may be told again, by rounding, just before the period ends
        apart = np.diff(found, append=found[:1] + period) > _NEAR * period
        return np.asarray(found[apart]) if apart.any() else found[:1]

    def shift(self, turns: Floats) -> tuple[Floats, Floats]:
        """What errors add to the driver's forward angle (rad), and its speed over the input's."""
        if not len(turns):
            return np.zeros(0), np.zeros(0)
        size = self.drivers.chunk
        parts = [self.drivers.at(turns[start : start + size]) for start in range(0, len(turns), size)]
        error, rate = (
            np.concatenate([part.error[0] for part in parts]),
            np.concatenate([part.rate[0] for part in parts]),
        )
        way = self.source.forward * self.source.driver_sense
        return way * error, self.source.mean + way * rate

    def between(self, steps: InputSteps) -> Floats:
        """Turns of the input at which the law is at a corner, within some steps, and which: (2, n), in any order.

        A corner at the end of a step may stand twice.
        """
        if not len(self.kinks) or not len(steps.low):
            return np.zeros((2, 0))
        (low, speed_low), (high, speed_high) = self.shift(steps.low), self.shift(steps.high)
        if (np.minimum(speed_low, speed_high) < _SLOW * self.source.mean).any():
            steps = self._cut_where_it_turns(steps, np.minimum(speed_low, speed_high))
            low, high = self.shift(steps.low)[0], self.shift(steps.high)[0]
        return self._crossings(steps, low, high)

    def _cut_where_it_turns(self, steps: InputSteps, slowest: Floats) -> InputSteps:
        """The same steps, those in which the driver may turn back in parts, cut where it turns."""
        slow = slowest < _SLOW * self.source.mean
        ends = steps.low[slow, None] + (steps.high - steps.low)[slow, None] * (np.arange(_PARTS + 1) / _PARTS)
        ends[:, -1] = steps.high[slow]
        ahead = self.shift(ends.ravel())[1].reshape(ends.shape) >= 0
        turning = ahead[:, 1:] != ahead[:, :-1]
        low, high, first = ends[:, :-1][turning], ends[:, 1:][turning], ahead[:, :-1][turning]
        for _ in range(_HALVINGS if len(low) else 0):
            middle = (low + high) / 2
            before = (self.shift(middle)[1] >= 0) == first
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        return InputSteps(
            np.concatenate([steps.low[~slow], ends[:, :-1].ravel(), high]),
            np.concatenate([steps.high[~slow], np.where(turning, _filled(turning, low, ends), ends[:, 1:]).ravel(),
                            ends[:, 1:][turning]]),
        )  # fmt: skip

    def _crossings(self, steps: InputSteps, low: Floats, high: Floats) -> Floats:
        """As `between`, in steps in which the driver turns one way, from its shifts at their ends (rad)."""
        period, cycles = self.source.transmission.period, self.source.cycles
        width = steps.high - steps.low
        phase = np.mod(InputPhase(steps.low).cycles(cycles) * period + self.source.start + low, period)
        travel = float(cycles) * period * width + (high - low)
        minimum, most = np.minimum(0, travel) - _NEAR * period, np.maximum(0, travel) + _NEAR * period
        first = np.ceil((phase[:, None] + minimum[:, None] - self.kinks) / period)
        count = np.floor((phase[:, None] + most[:, None] - self.kinks) / period) - first + 1
        # an angle that is not known, where no teeth touch, passes none
        count = np.where(np.isfinite(count), np.maximum(count, 0), 0).astype(np.intp)
        step, kink = (np.repeat(each, count.ravel()) for each in np.indices(count.shape).reshape(2, -1))
        nth = np.arange(len(step)) - np.repeat(np.cumsum(count) - count.ravel(), count.ravel())
        level = self.kinks[kink] + (first[step, kink] + nth) * period - phase[step]

        def beyond(share: Floats, which: Indices) -> Floats:
            at = step[which]
            moved = self.shift(steps.low[at] + share * width[at])[0] - low[at]
            return np.asarray(float(cycles) * period * width[at] * share + moved - level[which])

        ends = np.zeros(len(step)), np.ones(len(step))
        share = roots_by_false_position(beyond, *ends, -level, travel[step] - level, _FINE)
        return np.stack([steps.low[step] + share * width[step], kink])

    def once(self, found: Floats) -> Floats:
        """Turns in order from what `between` gave, a corner that was found from either side of a place only once."""
        turns, kink = found[:, np.lexsort(found)]
        same = _SAME / float(self.source.cycles) if self.source.cycles else 0.0
        again = (np.diff(turns, prepend=-np.inf) <= same) & (np.diff(kink, prepend=-1) == 0)
        return np.sort(turns[~again])


def _filled(chosen: Floats, values: Floats, ends: Floats) -> Floats:
    """`values` where they were chosen from, in the shape of the steps between `ends`."""
    found = ends[:, 1:].copy()
    found[chosen] = values
    return found


class KinkSearch:
    """Corners of all pairs that an output of a composition depends on."""

    def __init__(self, composition: ErrorComposition) -> None:
        self.composition = composition

    @cached_property
    def pairs(self) -> tuple[PairKinks, ...]:
        """The pairs with their drivers' angles."""
        joints = self.composition.spread.joints
        found = []
        for source in self.composition.used:
            joint = joints[source.pair]
            seen = SeenLink(joint.driver, joint.carrier, source.driver_sense * source.carrier_sense)
            drivers = ErrorComposition(self.composition.spread, self.composition.sources, (seen,))
            found.append(PairKinks(source, drivers))
        return tuple(found)

    @cached_property
    def rate(self) -> float:
        """Corners passed a turn of the input, on average."""
        return sum(float(pair.source.cycles) * len(pair.kinks) for pair in self.pairs)

    @cached_property
    def step(self) -> float:
        """Turns of the input that are narrow for every law; infinite where nothing ripples."""
        fastest = max((float(pair.source.cycles) for pair in self.pairs), default=0.0)
        return 1 / (_STEPS * fastest) if fastest else np.inf

    def steps(self, start: float, end: float) -> Iterator[InputSteps]:
        """A stretch of the input in narrow steps, some of them at a time."""
        number = max(_FEWEST, int(np.ceil((end - start) / self.step)))
        size = self.composition.chunk
        for first in range(0, number, size):
            at = np.arange(first, min(first + size, number) + 1)
            ends = start + (end - start) * (at / number)
            ends[at == number] = end
            yield InputSteps(ends[:-1], ends[1:])

    def between(self, steps: InputSteps) -> KinkPositions:
        """The corners within some narrow steps."""
        return self._joined([[pair.between(steps)] for pair in self.pairs])

    def over(self, start: float, end: float) -> KinkPositions:
        """The corners from one position of the input to a greater one, both included."""
        if (expected := self.rate * (end - start)) > MOST_KINKS:
            what = f"from {start:g} to {end:g} turns pairs pass some {expected:.2g} corners of their laws"
            why = f"at most {MOST_KINKS:g} are listed"
            raise QuestionError(Problem(what, why, "ask for fewer turns at a time"))
        found: list[list[Floats]] = [[] for _ in self.pairs]
        for steps in self.steps(start, end):
            for pair, parts in zip(self.pairs, found, strict=True):
                parts.append(pair.between(steps))
        return self._joined(found)

    def _joined(self, found: list[list[Floats]]) -> KinkPositions:
        """What was found of each pair, in parts, in one order."""
        each = [pair.once(np.concatenate(parts, axis=1)) for pair, parts in zip(self.pairs, found, strict=True)]
        turns = np.concatenate(each or [np.zeros(0)])
        pair = np.repeat(np.arange(len(each)), [len(part) for part in each])
        order = np.argsort(turns, kind="stable")
        return KinkPositions(turns[order], pair[order], tuple(pair.source.id for pair in self.pairs))
