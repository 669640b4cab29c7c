"""The results of many trials: how often pairs jam, and how far pointers are off, at random places and along a turn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import degrees, nan, sqrt
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, TypedDict, cast

import numpy as np

from geartrain.numerics.confidence_intervals import (
    IntervalEstimate,
    ProbabilityEstimate,
    deviation_of,
    in_degrees,
    mean_of,
    percentiles_of,
)
from geartrain.numerics.results import Key, Result, Tabular, finite
from geartrain.workshop.monte_carlo.trial_block import CLASH, DISENGAGED, DWELL, JAM, LOST, STOPS, UNCUT

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.workshop.monte_carlo.trial_plan import TrialPlan

    Marks = NDArray[np.uint8]


FEWEST = 30
"""Trials that must run for a pointer to be judged by them alone."""

EVENTS = {"jam": JAM, "clash": CLASH, "stops": STOPS, "dwell": DWELL, "disengaged": DISENGAGED}


@dataclass(frozen=True)
class TrialResults(Tabular):
    """All trials that were done, in their order.

    See Also
    --------
    run_trials : gives it
    """

    PAGE = "workshop.monte_carlo.monte_carlo_report:trials_document"
    MEANINGS: ClassVar = {
        "trial": "Number of the trial, from 0.",
        "turns": "Position of the input [turn].",
        "* error (deg)": "Pointer error of the output [deg].",
        "* events": "Sum of 1 jam, 2 clash, 4 dwell, 8 disengaged, 16 not to be cut.",
    }

    plan: TrialPlan
    """What was asked, and the `seed` of its random numbers."""
    seed: int
    """Seed of all random drawing."""
    wanted: int
    """Number of trials requested: more than `done` in an interrupted run."""
    marks: Marks
    """What each pair does, (trials, pairs): a sum of 1 jam, 2 clash, 4 standstill, 8 disengaged, 16 not to be cut."""
    turns: Floats
    """Where the input stands in each trial, (trials,) [turn]."""
    errors: Floats
    """Of each output, (trials, outputs); infinite where nothing touches [rad]."""
    first: Sequence[tuple[float, float, int]]
    """By output: sums of squares of what superposition is off, and of the errors there, and of how many trials."""
    sums: Sequence[Mapping[str, tuple[float, ...]]]
    """By output: the sums over trials of which variance shares are made."""
    bounds: Mapping[str, float] = field(default_factory=dict)
    """Pair -> bound on the probability of a jam, where one is known."""
    courses: Sequence[PointerErrorCourse] = ()
    """Along a turn, where asked for."""
    filing: Floats = field(default_factory=lambda: np.zeros((0, 0)))
    """Strokes of the file, and teeth that took them, by pair, (trials, 2 pairs); empty where nothing is filed to
    fit."""

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each trial: turns of the input, errors of outputs [deg], and what it did to each pair.

        A sum of 1 jam, 2 clash, 4 standstill, 8 disengaged, 16 not to be cut.
        """
        errors = zip(self.plan.outputs, self.errors.T, strict=True)
        events = zip(self.plan.pairs, self.marks.T, strict=True)
        return {
            "trial": [*range(self.done)],
            "turns": self.turns.tolist(),
            **{f"{name} error (deg)": [degrees(each) for each in column] for name, column in errors},
            **{f"{pair.name} events": column.tolist() for pair, column in events},
        }

    def _summary(self) -> str:
        cut = "" if self.done == self.wanted else f" of {self.wanted}"
        outputs = ", ".join(self.plan.outputs[:4])
        pairs = len(self.plan.pairs)
        return f"{self.plan.name}: {self.done}{cut} trials, seed {self.seed}, {pairs} pairs, outputs {outputs}"

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
        return tuple(
            _tally(pair.name, self.marks[:, at], pair.backlash, self.bounds.get(pair.name, nan))
            for at, pair in enumerate(self.plan.pairs)
        )

    @cached_property
    def train(self) -> PairEventRates:
        """Any pair of the train."""
        bound = min(1.0, sum(self.bounds.values())) if len(self.bounds) == len(self.plan.pairs) else nan
        return _tally("the train", np.bitwise_or.reduce(self.marks, axis=1), nan, bound)

    @cached_property
    def filings(self) -> tuple[FilingStatistics, ...]:
        """Each pair that is filed to fit, and the train; none where nothing is."""
        if not self.plan.files:
            return ()
        found = [
            self._filing(pair.name, self.filing[:, 2 * at : 2 * at + 2], self.pairs[at])
            for at, pair in enumerate(self.plan.pairs)
            if pair.stroke
        ]
        whole = np.stack([self.filing[:, ::2].sum(axis=1), self.filing[:, 1::2].sum(axis=1)], axis=1)
        return (*found, self._filing("the train", whole, self.train))

    def _filing(self, name: str, work: Floats, events: PairEventRates) -> FilingStatistics:
        strokes, teeth = work.T
        filed = ProbabilityEstimate(int(np.count_nonzero(strokes)), len(strokes))
        most = int(strokes.max(initial=0.0))
        return FilingStatistics(name, filed, mean_of(strokes), mean_of(teeth), most, events.events["jam"])

    @cached_property
    def pointers(self) -> tuple[PointerErrorStatistics, ...]:
        """Each output."""
        return tuple(self._pointer(at) for at in range(len(self.plan.outputs)))

    def pointer(self, name: str) -> PointerErrorStatistics:
        """One output.

        Parameters
        ----------
        name : str
            Of the output.
        """
        return self.pointers[self.plan.outputs.index(name)]

    def _pointer(self, at: int) -> PointerErrorStatistics:
        errors = self.errors[:, at]
        runs = turning_trials(self.marks, self.plan.reach[at]) & np.isfinite(errors)
        off, size, count = self.first[at]
        first = FirstOrderError(sqrt(off / count), sqrt(size / count)) if count else FirstOrderError(nan, nan)
        return PointerErrorStatistics(
            self.plan.outputs[at],
            errors[runs],
            errors[np.isfinite(errors)],
            int(np.count_nonzero(~runs)),
            first,
            _shares(self.sums[at]),
        )

    @property
    def jams(self) -> list[ConvergenceStep]:
        """How often some pair jams, in ever more trials."""
        return [ConvergenceStep(*each) for each in self.convergence("jam")]

    @property
    def stops(self) -> list[ConvergenceStep]:
        """How often some pair jams or clashes, in ever more trials."""
        return [ConvergenceStep(*each) for each in self.convergence("stops")]

    def convergence(self, event: str = "jam") -> list[tuple[int, ProbabilityEstimate]]:
        """The share of trials in which any pair does this, after 1/16, 1/8, ... and all of them.

        Parameters
        ----------
        event : str
            Jam, clash, stops, standstill or disengaged.
        """
        mark, whole = EVENTS[event], np.bitwise_or.reduce(self.marks, axis=1)
        counts = sorted({max(1, self.done >> half) for half in range(5)}) if self.done else []
        return [(count, _share(whole[:count], mark)) for count in counts]

    def pointer_convergence(self, at: int) -> list[tuple[int, IntervalEstimate]]:
        """The standard deviation of an output after 1/16, 1/8, ... and all trials that run [rad].

        Parameters
        ----------
        at : int
            The number of the output, from 0.
        """
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


def _tally(name: str, marks: Marks, backlash: float, bound: float) -> PairEventRates:
    events = {event: _share(marks, mark) for event, mark in EVENTS.items()}
    return PairEventRates(name, events, int(np.count_nonzero(marks & UNCUT)), backlash, bound)


def _shares(sums: Mapping[str, tuple[float, ...]]) -> dict[str, float]:
    """Covariance of each pair's part with the whole, over the variance of the whole."""
    found = {}
    for name, (count, part, whole, product) in sums.items():
        found[name] = product - part * whole / count if count else 0.0
    total = sum(found.values())
    return {name: each / total for name, each in found.items()} if total else {}


# ---------------------------------------------------------------------------------------------------------------- pairs


class EventRates(TypedDict):
    """How often wheels do what beside turning."""

    jam: ProbabilityEstimate
    clash: ProbabilityEstimate
    stops: ProbabilityEstimate
    dwell: ProbabilityEstimate
    disengaged: ProbabilityEstimate


@dataclass(frozen=True, slots=True)
class PairEventRates(Result):
    """How often one pair, or any pair of the train, does what over its full cycle of teeth.

    See Also
    --------
    TrialResults : holds them
    """

    KEYS = (Key("pair", "name"), "uncut", Key("backlash", to=finite), Key("bound", to=finite), Key("", "rates"))

    name: str
    """Of the pair, or "the train"."""
    events: Mapping[str, ProbabilityEstimate]
    """Jam, clash, stops (jam or clash), standstill, disengaged -> how often, of the trials whose wheels can be cut."""
    uncut: int
    """Trials that hold a wheel that cannot be cut."""
    backlash: float = nan
    """Nominal play of even wheels [pitch of the driven wheel]; NaN for the train."""
    bound: float = nan
    """Bound on the probability of a jam by pitch errors alone; NaN where other errors take part."""

    @property
    def rates(self) -> EventRates:
        """The events, by name."""
        return cast("EventRates", self.events)


@dataclass(frozen=True, slots=True)
class FilingStatistics(Result):
    """How much one pair, or the whole train, was filed until it passed.

    See Also
    --------
    TrialResults : holds them
    """

    KEYS = (Key("pair", "name"), "filed", "strokes", "teeth", "most", Key("jams_after", "jams"))

    name: str
    """Of the pair, or "the train"."""
    filed: ProbabilityEstimate
    """How often it jams before it is filed."""
    strokes: IntervalEstimate
    """Mean number of strokes over all trials."""
    teeth: IntervalEstimate
    """Mean number of teeth filed over all trials."""
    most: int
    """Strokes of the trial that took most."""
    jams: ProbabilityEstimate
    """How often it jams after, a flank being spoilt first."""


@dataclass(frozen=True)
class ConvergenceStep:
    """A probability from the first so many trials."""

    KEYS = ("trials", Key("", "share"))

    trials: int
    """Number of trials counted, from the first on."""
    share: ProbabilityEstimate
    """The probability from these trials."""


# ------------------------------------------------------------------------------------------------------------- pointers


class FirstOrderError(NamedTuple):
    """Root mean square (rad) of what superposition to first order is off, and of the errors there."""

    off: float
    """Root mean square of the error of superposition to first order [rad]."""
    rms: float
    """Root mean square of the pointer error itself [rad]."""


@dataclass(frozen=True, slots=True)
class PointerErrorStatistics(Result):
    """How far one output is from where even teeth would have it on average, at random positions of the input.

    See Also
    --------
    TrialResults : holds them
    """

    KEYS = (
        Key("output", "name"),
        Key("trials", "runs"),
        "stopped",
        "of_all",
        Key("mean_deg", "mean", in_degrees),
        Key("deviation_deg", "deviation", in_degrees),
        Key("percentiles_deg", "percentiles", in_degrees),
        Key("maximum_deg", "maximum", degrees),
        Key("deviation_of_all_deg", "deviation_of_all", in_degrees),
        Key("first_order", "first", keys=(Key("off_deg", "off", degrees), Key("rms_deg", "rms", degrees))),
        Key("variance_shares", "shares"),
    )

    name: str
    """Of the output."""
    errors: Floats
    """Of the trials in which no pair that moves it jams or is lost, in their order [rad]."""
    all: Floats
    """Of all trials, as the pushing flanks alone would have it; none where nothing touches [rad]."""
    stopped: int
    """Trials left out of `errors`."""
    first: FirstOrderError
    """Rms of what superposition to first order is off, and of the errors there [rad]."""
    shares: Mapping[str, float]
    """Pair -> its share of the variance, from superposition; they sum to 1."""

    @property
    def runs(self) -> int:
        """Trials that run."""
        return len(self.errors)

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
    def deviation_of_all(self) -> IntervalEstimate:
        """Standard deviation in all trials, as the pushing flanks alone would have it (rad)."""
        return deviation_of(self.all)

    @property
    def percentiles(self) -> dict[float, IntervalEstimate]:
        """Percentiles (rad)."""
        return percentiles_of(self.kept)

    @property
    def maximum(self) -> float:
        """Greatest error either way that was seen (rad)."""
        return float(np.abs(self.kept).max(initial=0.0))

    def beyond(self, angle: float) -> ProbabilityEstimate:
        """How often the error exceeds an angle, either way.

        Parameters
        ----------
        angle : float
            0 or more [rad].
        """
        return ProbabilityEstimate(int(np.count_nonzero(np.abs(self.kept) > angle)), len(self.kept))


@dataclass(frozen=True, slots=True)
class PointerErrorCourse(Result):
    """Errors of one output along one turn of it, trial by trial.

    See Also
    --------
    run_course : gives it
    """

    KEYS = (
        Key("output", "name"),
        Key("trials", "count"),
        "turns",
        "bands_deg",
        Key("maximum_deg", "percentiles", in_degrees),
    )

    name: str
    """Of the output."""
    turns: Floats
    """Where the input stands, (n,) [turn]."""
    errors: Floats
    """By trial, (trials, n) [rad]."""

    @property
    def maximum(self) -> Floats:
        """Greatest error of each trial along the turn, either way (rad)."""
        found: Floats = np.abs(self.errors).max(axis=1)
        return found

    @property
    def count(self) -> int:
        """Number of trials."""
        return len(self.errors)

    @property
    def percentiles(self) -> dict[float, IntervalEstimate]:
        """Percentiles of the greatest errors (rad)."""
        return percentiles_of(self.maximum)

    @property
    def bands_deg(self) -> Floats:
        """The bands in degrees, (7, n)."""
        found: Floats = np.degrees(self.bands())
        return found

    def bands(self) -> Floats:
        """Least, 2.5, 25, 50, 75, 97.5 % and greatest at each position (rad), (7, n)."""
        found: Floats = np.quantile(self.errors, (0, 0.025, 0.25, 0.5, 0.75, 0.975, 1), axis=0)
        return found
