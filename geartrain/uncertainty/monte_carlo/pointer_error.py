"""What many trials say: how often pairs jam, and how far pointers stray."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import degrees, nan, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.uncertainty.confidence_intervals import (
    PERCENTILES,
    IntervalEstimate,
    ProbabilityEstimate,
    deviation_of,
    mean_of,
    percentile_of,
)
from geartrain.uncertainty.monte_carlo.trial_block import CLASH, DISENGAGED, JAM, LOST, STANDSTILL, STOPS, UNCUT

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.uncertainty.monte_carlo.trial_plan import TrialPlan

    Marks = NDArray[np.uint8]

FEWEST = 30
"""Trials that must run for a pointer to be judged by them alone."""
EVENTS = {"jam": JAM, "clash": CLASH, "stops": STOPS, "standstill": STANDSTILL, "disengaged": DISENGAGED}


@dataclass(frozen=True, slots=True)
class PairEventRates:
    """How often one pair, or any pair of the train, does what over its full cycle of teeth.

    events   jam, clash, stops (jam or clash), standstill, disengaged: of the trials whose wheels can be cut
    uncut    trials that hold a wheel that cannot be cut
    play     nominal play of even wheels in pitches of the driven wheel; NaN for the train
    bound    bound on the probability of a jam by placement alone; NaN where other errors take part
    """

    name: str
    events: Mapping[str, ProbabilityEstimate]
    uncut: int
    play: float = nan
    bound: float = nan

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        known = {key: value if value == value else None for key, value in (("play", self.play), ("bound", self.bound))}
        events = {name: share.to_dict() for name, share in self.events.items()}
        return {"pair": self.name, "uncut": self.uncut, **known, **events}


@dataclass(frozen=True, slots=True)
class PointerErrorStatistics:
    """How far one output is from where even teeth would have it on average, at random positions of the input.

    errors    (rad) of the trials in which no pair that moves it jams or is lost, in their order
    all       (rad) of all trials, as the pushing flanks alone would have it; none where nothing touches
    stopped   trials left out of `errors`
    first     rms of what superposition to first order is off (rad), and of the errors there
    shares    of the variance by pair, from superposition: they sum to 1
    """

    name: str
    errors: Floats
    all: Floats
    stopped: int
    first: tuple[float, float]
    shares: Mapping[str, float]

    @property
    def kept(self) -> Floats:
        """The trials to look at: those that run, or all where too few do."""
        return self.all if self.of_all else self.errors

    @property
    def of_all(self) -> bool:
        """True if so few trials run that all are looked at, as the pushing flanks alone would have them."""
        return len(self.errors) < FEWEST

    @property
    def mean(self) -> IntervalEstimate:
        """Mean (rad)."""
        return mean_of(self.kept)

    @property
    def deviation(self) -> IntervalEstimate:
        """Standard deviation (rad)."""
        return deviation_of(self.kept)

    @property
    def percentiles(self) -> dict[float, IntervalEstimate]:
        """Percentiles (rad)."""
        ordered = np.sort(self.kept)
        return {percent: percentile_of(ordered, percent) for percent in PERCENTILES}

    @property
    def greatest(self) -> float:
        """Greatest error either way that was seen (rad)."""
        return float(np.abs(self.kept).max(initial=0.0))

    def beyond(self, angle: float) -> ProbabilityEstimate:
        """How often the error exceeds an angle (rad), either way."""
        return ProbabilityEstimate(int(np.count_nonzero(np.abs(self.kept) > angle)), len(self.kept))

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; angles in degrees."""

        def in_degrees(figure: IntervalEstimate) -> list[float | None]:
            return IntervalEstimate(*(degrees(each) for each in (figure.value, figure.low, figure.high))).to_dict()

        return {
            "output": self.name,
            "trials": len(self.errors),
            "stopped": self.stopped,
            "of_all": self.of_all,
            "mean_deg": in_degrees(self.mean),
            "deviation_deg": in_degrees(self.deviation),
            "percentiles_deg": {str(percent): in_degrees(each) for percent, each in self.percentiles.items()},
            "greatest_deg": degrees(self.greatest),
            "deviation_of_all_deg": in_degrees(deviation_of(self.all)),
            "first_order": {"off_deg": degrees(self.first[0]), "rms_deg": degrees(self.first[1])},
            "variance_shares": dict(self.shares),
        }


@dataclass(frozen=True, slots=True)
class PointerErrorCourse:
    """Errors of one output along one turn of it: `turns` of the input (n,), errors (rad) by trial (trials, n)."""

    name: str
    turns: Floats
    errors: Floats

    @property
    def greatest(self) -> Floats:
        """Greatest error of each trial along the turn, either way (rad)."""
        found: Floats = np.abs(self.errors).max(axis=1)
        return found

    def bands(self) -> Floats:
        """Least, 2.5, 25, 50, 75, 97.5 % and greatest at each position (rad), (7, n)."""
        found: Floats = np.quantile(self.errors, (0, 0.025, 0.25, 0.5, 0.75, 0.975, 1), axis=0)
        return found

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; angles in degrees."""
        ordered = np.sort(np.degrees(self.greatest))
        return {
            "output": self.name,
            "trials": len(self.errors),
            "turns": self.turns.tolist(),
            "bands_deg": np.degrees(self.bands()).tolist(),
            "greatest_deg": {str(percent): percentile_of(ordered, percent).to_dict() for percent in PERCENTILES},
        }


@dataclass(frozen=True)
class TrialResults:
    """All trials that were done, in their order.

    marks    what each pair does (trials, pairs), a sum of the marks of `block`
    turns    where the input stands in each (trials,)
    errors   of each output (rad), (trials, outputs); infinite where nothing touches
    first    by output: sums of squares of what superposition is off, and of the errors there, and of how many trials
    sums     by output: the sums over trials that variance shares are made of
    """

    plan: TrialPlan
    seed: int
    wanted: int
    marks: Marks
    turns: Floats
    errors: Floats
    first: Sequence[tuple[float, float, int]]
    sums: Sequence[Mapping[str, tuple[float, ...]]]
    bounds: Mapping[str, float] = field(default_factory=dict)
    courses: Sequence[PointerErrorCourse] = ()

    @property
    def done(self) -> int:
        """Trials done: fewer than wanted in a run that was interrupted."""
        return len(self.turns)

    @property
    def complete(self) -> bool:
        """True if no trial is missing."""
        return self.done == self.wanted

    @cached_property
    def pairs(self) -> tuple[PairEventRates, ...]:
        """Each pair."""
        from geartrain.uncertainty.manufacturing_errors import nominal_backlash

        return tuple(
            _tally(pair.name, self.marks[:, at], nominal_backlash(pair.sizes), self.bounds.get(pair.name, nan))
            for at, pair in enumerate(self.plan.pairs)
        )

    @cached_property
    def train(self) -> PairEventRates:
        """Any pair of the train."""
        bound = min(1.0, sum(self.bounds.values())) if len(self.bounds) == len(self.plan.pairs) else nan
        return _tally("the train", np.bitwise_or.reduce(self.marks, axis=1), nan, bound)

    @cached_property
    def pointers(self) -> tuple[PointerErrorStatistics, ...]:
        """Each output."""
        return tuple(self._pointer(at) for at in range(len(self.plan.outputs)))

    def pointer(self, name: str) -> PointerErrorStatistics:
        """One output."""
        return self.pointers[self.plan.outputs.index(name)]

    def _pointer(self, at: int) -> PointerErrorStatistics:
        errors = self.errors[:, at]
        runs = turning_trials(self.marks, self.plan.reach[at]) & np.isfinite(errors)
        off, size, count = self.first[at]
        first = (sqrt(off / count), sqrt(size / count)) if count else (nan, nan)
        return PointerErrorStatistics(
            self.plan.outputs[at],
            errors[runs],
            errors[np.isfinite(errors)],
            int(np.count_nonzero(~runs)),
            first,
            _shares(self.sums[at]),
        )

    def convergence(self, event: str = "jam") -> list[tuple[int, ProbabilityEstimate]]:
        """The share of trials in which any pair does this, after 1/16, 1/8, ... and all of them."""
        mark, whole = EVENTS[event], np.bitwise_or.reduce(self.marks, axis=1)
        counts = sorted({max(1, self.done >> half) for half in range(5)}) if self.done else []
        return [(count, _share(whole[:count], mark)) for count in counts]

    def pointer_convergence(self, at: int) -> list[tuple[int, IntervalEstimate]]:
        """The standard deviation of an output (rad) after 1/16, 1/8, ... and all trials that run."""
        kept = self.pointers[at].kept
        counts = sorted({len(kept) >> half for half in range(5)} - {0})
        return [(count, deviation_of(kept[:count])) for count in counts]


def turning_trials(marks: Marks, pairs: Sequence[int]) -> Bools:
    """The trials in which none of some pairs jams, is lost or cannot be cut (trials,); a clash may be led past."""
    runs: Bools = np.all((marks[:, list(pairs)] & LOST) == 0, axis=1)
    return runs


def _share(marks: Marks, mark: int) -> ProbabilityEstimate:
    cut = marks[(marks & UNCUT) == 0]
    return ProbabilityEstimate(int(np.count_nonzero(cut & mark)), len(cut))


def _tally(name: str, marks: Marks, play: float, bound: float) -> PairEventRates:
    events = {event: _share(marks, mark) for event, mark in EVENTS.items()}
    return PairEventRates(name, events, int(np.count_nonzero(marks & UNCUT)), play, bound)


def _shares(sums: Mapping[str, tuple[float, ...]]) -> dict[str, float]:
    """Covariance of each pair's part with the whole, over the variance of the whole."""
    found = {}
    for name, (count, part, whole, product) in sums.items():
        found[name] = product - part * whole / count if count else 0.0
    total = sum(found.values())
    return {name: each / total for name, each in found.items()} if total else {}
