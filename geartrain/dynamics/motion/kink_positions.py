"""Positions of the input at which pairs pass kinks of their transmission functions. All errors are smooth between them.

The driver angle of a pair, equation (3) of docs/motion.md, includes the errors of earlier pairs. Its values at the ends
of a narrow step give the number of kinks in the step, and each kink is located by the method of false position.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import REST, ErrorComposition, InputPhase, SeenLink, evaluate
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import short_repr
from geartrain.numerics.roots import roots_by_false_position
from geartrain.teeth.transmission_table import folded_kinks

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import PairErrorSource
    from geartrain.numerics.arrays import Floats, Indices

MOST_KINKS = 20_000_000
"""Maximum number of kinks of transmission functions that are listed."""

_STEPS = 4  # steps per period of the fastest pair: the driver is monotonic in a step, or slow at one of its ends
_FEWEST = 16  # minimum number of steps in a run
_SLOW = 0.25  # [mean speed] a slower driver may reverse within the step
_PARTS = 16  # subdivisions of a step in which a driver may reverse
_HALVINGS = 40  # bisections of a step to locate a reversal
_FINE = 1e-14  # [steps] tolerance of a kink's position
_SAME = 1e-9  # [periods] closer kinks are the same kink found from both sides
_NEAR = 1e-11  # [periods] overlap of neighbouring steps, so that rounding loses no kink at their ends


class KinkPositions(NamedTuple):
    """Positions of the input at which pairs pass kinks of their transmission functions, in ascending order of position.

    See Also
    --------
    Motion.kink_positions : method that returns it
    """

    turns: Floats
    """Positions of the input [revolutions], shape (n,)."""
    pair: Indices
    """Index into `pairs` of the pair that passes a kink at each position, shape (n,)."""
    pairs: tuple[str, ...]
    """Names of all pairs and couplings, to which `pair` refers by index."""

    def __repr__(self) -> str:
        return short_repr(self)

    def names(self) -> list[str]:
        """Return the name of the pair that passes a kink at each position."""
        return [self.pairs[at] for at in self.pair]


class InputSteps(NamedTuple):
    """Intervals of the input position, from `low` to `high` [revolutions], both of shape (n,)."""

    low: Floats
    high: Floats


@dataclass(frozen=True)
class PairKinks:
    """Kinks in the transmission function of one pair, `source`. The only output of `drivers` is the driver of this
    pair.
    """

    source: PairErrorSource
    drivers: ErrorComposition

    @cached_property
    def kinks(self) -> Floats:
        """Driver angles within one period at which the transmission function has a kink [rad], without duplicates."""
        period = self.source.transmission.period
        found = folded_kinks(self.source.transmission)
        # a kink at 0 may be listed again just before the end of the period, due to rounding
        apart = np.diff(found, append=found[:1] + period) > _NEAR * period
        return np.asarray(found[apart]) if apart.any() else found[:1]

    def shift(self, turns: Floats) -> tuple[Floats, Floats]:
        """Return the change of the driver's angle due to errors, in its mean sense of rotation [rad], and the driver's
        speed divided by the speed of the input [1].
        """
        if not len(turns):
            return np.zeros(0), np.zeros(0)
        found, way = evaluate(self.drivers, turns), self.source.forward * self.source.driver_sense
        return way * found.error[0], self.source.mean + way * found.rate[0]

    def between(self, steps: InputSteps) -> Floats:
        """Return an array of shape (2, n): the positions within `steps` at which the driver passes a kink
        [revolutions], and the index of the kink that it passes. The columns are in any order.

        A kink at the end of an interval may be listed twice.
        """
        if not len(self.kinks) or not len(steps.low):
            return np.zeros((2, 0))
        (low, speed_low), (high, speed_high) = self.shift(steps.low), self.shift(steps.high)
        if (np.minimum(speed_low, speed_high) < _SLOW * self.source.mean).any():
            steps = self._cut_where_it_turns(steps, np.minimum(speed_low, speed_high))
            low, high = self.shift(steps.low)[0], self.shift(steps.high)[0]
        return self._crossings(steps, low, high)

    def _cut_where_it_turns(self, steps: InputSteps, slowest: Floats) -> InputSteps:
        """Return the intervals divided at the positions at which the pair's driver reverses, found by bisection.
        `slowest` is the lower speed of the driver at both ends of each interval; only slow intervals are searched.
        """
        slow = slowest < _SLOW * self.source.mean
        ends = steps.low[slow, None] + (steps.high - steps.low)[slow, None] * (np.arange(_PARTS + 1) / _PARTS)
        ends[:, -1] = steps.high[slow]  # exact, despite rounding of the sum
        ahead = self.shift(ends.ravel())[1].reshape(ends.shape) >= -REST * self.source.mean
        turning = ahead[:, 1:] != ahead[:, :-1]
        low, high, first = ends[:, :-1][turning], ends[:, 1:][turning], ahead[:, :-1][turning]
        for _ in range(_HALVINGS if len(low) else 0):
            middle = (low + high) / 2
            before = (self.shift(middle)[1] >= -REST * self.source.mean) == first
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        stops = ends[:, 1:].copy()
        stops[turning] = low
        return InputSteps(
            np.concatenate([steps.low[~slow], ends[:, :-1].ravel(), high]),
            np.concatenate([steps.high[~slow], stops.ravel(), ends[:, 1:][turning]]),
        )

    def _crossings(self, steps: InputSteps, low: Floats, high: Floats) -> Floats:
        """Return the input positions [revolutions] and the indices of the kinks in intervals without reversals. `low`
        and `high` are the errors of the driver's angle at the two ends of each interval [rad].
        """
        period, cycles = self.source.transmission.period, self.source.cycles
        width = steps.high - steps.low
        phase = np.mod(InputPhase(steps.low).cycles(cycles) * period + self.source.start + low, period)
        travel = float(cycles) * period * width + (high - low)
        minimum, most = np.minimum(0, travel) - _NEAR * period, np.maximum(0, travel) + _NEAR * period
        # levels kink + n period between the angles at both ends: the first n, and their number
        first = np.ceil((phase[:, None] + minimum[:, None] - self.kinks) / period)
        count = np.floor((phase[:, None] + most[:, None] - self.kinks) / period) - first + 1
        # the angle is undefined where no teeth touch; no kink is passed there
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

    def unique(self, found: Floats) -> Floats:
        """Return the result of `between` with the positions in ascending order and with kinks that were found twice
        merged.
        """
        turns, kink = found[:, np.lexsort(found)]
        same = _SAME / float(self.source.cycles) if self.source.cycles else 0.0
        again = (np.diff(turns, prepend=-np.inf) <= same) & (np.diff(kink, prepend=-1) == 0)
        return np.sort(turns[~again])


class KinkSearch:
    """Search for the kinks of all pairs on which an output of an error composition depends."""

    def __init__(self, composition: ErrorComposition) -> None:
        self.composition = composition

    @cached_property
    def pairs(self) -> tuple[PairKinks, ...]:
        """Kinks of each pair on which an output depends, with the motion of the pair's driver."""
        found = []
        for source in self.composition.used:
            joint = self.composition.spread.joints[source.pair]
            seen = SeenLink(joint.driver, joint.carrier, source.driver_sense * source.carrier_sense)
            # no offsets: a pointer that is set does not turn any driver
            found.append(PairKinks(source, replace(self.composition, outputs=(seen,), offsets=())))
        return tuple(found)

    @cached_property
    def rate(self) -> float:
        """Mean number of kinks per revolution of the input."""
        return sum(float(pair.source.cycles) * len(pair.kinks) for pair in self.pairs)

    @cached_property
    def step(self) -> float:
        """Maximum width of a step [revolutions], which is a quarter of the mean period of the fastest component of all
        transmission functions; infinite if every error is constant.
        """
        fastest = max((pair.source.pace for pair in self.pairs), default=0.0)
        return 1 / (_STEPS * fastest) if fastest else np.inf

    def steps(self, start: float, end: float) -> Iterator[InputSteps]:
        """Yield equal intervals between two positions of the input [revolutions], no wider than `step`, in groups that
        fit in memory.
        """
        number = max(_FEWEST, int(np.ceil((end - start) / self.step)))
        for first in range(0, number, self.composition.chunk):
            at = np.arange(first, min(first + self.composition.chunk, number) + 1)
            ends = start + (end - start) * (at / number)
            ends[at == number] = end
            yield InputSteps(ends[:-1], ends[1:])

    def between(self, steps: InputSteps) -> KinkPositions:
        """Return the kinks within the given steps of the input."""
        return self._joined([[pair.between(steps)] for pair in self.pairs])

    def over(self, start: float, end: float) -> KinkPositions:
        """Return the kinks between two positions of the input [revolutions], including kinks at both ends."""
        if (expected := self.rate * (end - start)) > MOST_KINKS:
            what = f"there are about {expected:.2g} kinks from {start:g} to {end:g} turns"
            why = f"at most {MOST_KINKS:g} kinks are listed in one call"
            raise QuestionError(Problem(what, why, "request fewer turns at a time"))
        found: list[list[Floats]] = [[] for _ in self.pairs]
        for steps in self.steps(start, end):
            for pair, parts in zip(self.pairs, found, strict=True):
                parts.append(pair.between(steps))
        return self._joined(found)

    def _joined(self, found: list[list[Floats]]) -> KinkPositions:
        each = [pair.unique(np.concatenate(parts, axis=1)) for pair, parts in zip(self.pairs, found, strict=True)]
        turns = np.concatenate(each or [np.zeros(0)])
        pair = np.repeat(np.arange(len(each)), [len(part) for part in each])
        order = np.argsort(turns, kind="stable")
        return KinkPositions(turns[order], pair[order], tuple(pair.source.id for pair in self.pairs))
