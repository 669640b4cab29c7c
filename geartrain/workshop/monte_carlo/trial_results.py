"""Results of Monte Carlo trials: event probabilities of pairs, and pointer errors at random positions and in a turn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import degrees, isnan, nan, sqrt
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, TypedDict, cast

import numpy as np

from geartrain.dynamics.motion.superposition import Superposition
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
"""Minimum number of trials in which the output turns. If there are fewer, the pointer statistics are computed from all
trials.
"""

EVENTS = {"jam": JAM, "clash": CLASH, "stops": STOPS, "dwell": DWELL, "disengaged": DISENGAGED}


@dataclass(frozen=True)
class TrialResults(Tabular):
    """Results of all completed Monte Carlo trials, in the order of the trials.

    See Also
    --------
    run_trials : Run the trials.
    """

    PAGE = "workshop.monte_carlo.monte_carlo_report:trials_document"
    MEANINGS: ClassVar = {
        "trial": "Number of the trial, from 0.",
        "turns": "Position of the input [turn].",
        "* error (deg)": "Pointer error of the output [deg].",
        "* events": "Bit mask: 1 jam, 2 clash, 4 dwell, 8 disengaged, 16 not cuttable.",
    }

    plan: TrialPlan
    """Input data of the trials."""
    seed: int
    """Random seed of the trials."""
    wanted: int
    """Number of requested trials. It is larger than `done` if the run was interrupted."""
    marks: Marks
    """Bit mask of the events in each pair, shape (trials, pairs): 1 jam, 2 clash, 4 dwell, 8 disengaged, 16 not
    cuttable.
    """
    turns: Floats
    """Position of the input in each trial, shape (trials,) [turn]."""
    errors: Floats
    """Pointer error of each output, shape (trials, outputs) [rad]; infinite if no teeth touch."""
    linear: Floats
    """Pointer errors by first-order superposition in the first n trials (n <= 1024) [rad], shape (n, outputs)."""
    lags: Floats
    """Transmission error of each pair, relative to its mean transmission error without cutting errors, shape (trials,
    pairs) [rad of the driven wheel].
    """
    filing: Floats
    """Numbers of file strokes and of filed teeth of each pair in alternate columns, shape (trials, 2 * pairs)."""

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with one row for each trial: position of the input [turn], pointer errors [deg] and event
        flags of each pair.

        The flags are a bit mask: 1 jam, 2 clash, 4 dwell, 8 disengaged, 16 not cuttable.
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
        """Number of completed trials. It is smaller than `wanted` if the run was interrupted."""
        return len(self.turns)

    @property
    def complete(self) -> bool:
        """True if all requested trials are completed."""
        return self.done == self.wanted

    @cached_property
    def bounds(self) -> Mapping[str, float]:
        """Upper bound of the jam probability, 0 to 1, of each pair whose only errors are normally distributed pitch
        deviations.
        """
        found = {pair.name: self.plan.jamming_bound(pair) for pair in self.plan.pairs}
        return {name: bound for name, bound in found.items() if not isnan(bound)}

    @cached_property
    def pairs(self) -> tuple[PairEventRates, ...]:
        """Event probabilities of each pair: jam, clash, dwell and loss of contact."""
        return tuple(
            _tally(pair.name, self.marks[:, at], pair.backlash, self.bounds.get(pair.name, nan))
            for at, pair in enumerate(self.plan.pairs)
        )

    @cached_property
    def train(self) -> PairEventRates:
        """Event probabilities of the train. An event occurs in a trial if it occurs in at least one pair."""
        # the probability of any jam is at most the sum of the probabilities (Boole's inequality)
        bound = min(1.0, sum(self.bounds.values())) if len(self.bounds) == len(self.plan.pairs) else nan
        return _tally("the train", np.bitwise_or.reduce(self.marks, axis=1), nan, bound)

    @cached_property
    def filings(self) -> tuple[FilingStatistics, ...]:
        """Filing statistics of each pair that is filed to fit, and of the train; empty if no pair is filed."""
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
        """Statistics of the pointer error of each output."""
        return tuple(self._pointer(at) for at in range(len(self.plan.outputs)))

    def pointer(self, name: str) -> PointerErrorStatistics:
        """Return the statistics of the pointer error of one output.

        Parameters
        ----------
        name : str
            Name of the output.
        """
        return self.pointers[self.plan.outputs.index(name)]

    def _pointer(self, at: int) -> PointerErrorStatistics:
        errors = self.errors[:, at]
        runs = turning_trials(self.marks, self.plan.reach[at]) & np.isfinite(errors)
        return PointerErrorStatistics(
            self.plan.outputs[at],
            errors[runs],
            errors[np.isfinite(errors)],
            int(np.count_nonzero(~runs)),
            self._first_order(at),
            self._shares(at, runs),
        )

    def _first_order(self, at: int) -> FirstOrderError:
        with np.errstate(invalid="ignore"):
            # inf - inf in trials in which no teeth touch
            exact, off = self.errors[: len(self.linear), at], self.linear[:, at] - self.errors[: len(self.linear), at]
        good = np.isfinite(off)
        if not good.any():
            return FirstOrderError(nan, nan)
        return FirstOrderError(*(sqrt(np.mean(each[good] ** 2)) for each in (off, exact)))

    def _shares(self, at: int, runs: Bools) -> dict[str, float]:
        """Return the share of each pair in the variance of one output's error, keyed by pair; the shares sum to 1.

        at     index of the output
        runs   mask of the trials to be used
        """
        superposition = Superposition(self.plan.composition)
        numbers = {pair.name: number for number, pair in enumerate(self.plan.pairs)}
        parts = {
            source.id: source.sense * response * self.lags[runs, numbers[source.id]]
            for source, response in zip(superposition.sources, superposition.response[at], strict=True)
            if source.id in numbers and response
        }
        whole = sum(parts.values(), np.zeros(np.count_nonzero(runs)))
        total = float(np.var(whole)) if len(whole) else 0.0
        # covariance of each contribution with the total error, because pairs with a common wheel are correlated
        return {name: float(np.mean(part * (whole - whole.mean()))) / total for name, part in parts.items() if total}

    @property
    def jams(self) -> list[ConvergenceStep]:
        """Probability that at least one pair jams, estimated from increasing numbers of trials."""
        return [ConvergenceStep(*each) for each in self.convergence("jam")]

    @property
    def stops(self) -> list[ConvergenceStep]:
        """Probability that at least one pair jams or clashes, estimated from increasing numbers of trials."""
        return [ConvergenceStep(*each) for each in self.convergence("stops")]

    def convergence(self, event: str = "jam") -> list[tuple[int, ProbabilityEstimate]]:
        """Return the probability of an event in at least one pair, from the first 1/16, 1/8, 1/4, 1/2 and all trials.

        Parameters
        ----------
        event : str
            Name of the event: jam, clash, stops, dwell or disengaged.
        """
        mark, whole = EVENTS[event], np.bitwise_or.reduce(self.marks, axis=1)
        # successive halving, because intervals narrow with the square root of the number of trials
        counts = sorted({max(1, self.done >> half) for half in range(5)}) if self.done else []
        return [(count, _share(whole[:count], mark)) for count in counts]

    def pointer_convergence(self, at: int) -> list[tuple[int, IntervalEstimate]]:
        """Return the standard deviation of a pointer error [rad], from the first 1/16, 1/8, 1/4, 1/2 and all trials.

        Parameters
        ----------
        at : int
            Index of the output, from 0.
        """
        kept = self.pointers[at].kept
        counts = sorted({len(kept) >> half for half in range(5)} - {0})
        return [(count, deviation_of(kept[:count])) for count in counts]


def turning_trials(marks: Marks, pairs: Sequence[int]) -> Bools:
    """Return a mask of trials in which none of the given pairs jams, disengages or has a wheel that cannot be cut."""
    runs: Bools = np.all((marks[:, list(pairs)] & LOST) == 0, axis=1)
    return runs


def _share(marks: Marks, mark: int) -> ProbabilityEstimate:
    cut = marks[(marks & UNCUT) == 0]  # trials with wheels that cannot be cut do not count
    return ProbabilityEstimate(int(np.count_nonzero(cut & mark)), len(cut))


def _tally(name: str, marks: Marks, backlash: float, bound: float) -> PairEventRates:
    events = {event: _share(marks, mark) for event, mark in EVENTS.items()}
    return PairEventRates(name, events, int(np.count_nonzero(marks & UNCUT)), backlash, bound)


# ---------------------------------------------------------------------------------------------------------------- pairs


class EventRates(TypedDict):
    """Mapping from event (jam, clash, dwell, loss of contact) to its probability during a full meshing cycle."""

    jam: ProbabilityEstimate
    clash: ProbabilityEstimate
    stops: ProbabilityEstimate
    dwell: ProbabilityEstimate
    disengaged: ProbabilityEstimate


@dataclass(frozen=True, slots=True)
class PairEventRates(Result):
    """Event probabilities of one pair, or of the whole train, during a full meshing cycle."""

    KEYS = (Key("pair", "name"), "uncut", Key("backlash", to=finite), Key("bound", to=finite), Key("", "rates"))

    name: str
    """Name of the pair, or "the train"."""
    events: Mapping[str, ProbabilityEstimate]
    """Probability of each event (jam, clash, stops, dwell, disengaged) in trials with cuttable wheels; stops means jam
    or clash.
    """
    uncut: int
    """Number of trials with at least one wheel that cannot be cut."""
    backlash: float = nan
    """Backlash of the pair with wheels without errors [pitch of the driven wheel]; NaN for the train."""
    bound: float = nan
    """Upper bound of the jam probability due to pitch deviations, 0 to 1; NaN if the pair has other errors."""

    @property
    def rates(self) -> EventRates:
        """Event probabilities, keyed by the name of the event."""
        return cast("EventRates", self.events)


@dataclass(frozen=True, slots=True)
class FilingStatistics(Result):
    """Amount of filing that one pair, or the whole train, needs to turn without a jam."""

    KEYS = (Key("pair", "name"), "filed", "strokes", "teeth", "most", Key("jams_after", "jams"))

    name: str
    """Name of the pair, or "the train"."""
    filed: ProbabilityEstimate
    """Probability that filing is needed, that is, of a jam before filing."""
    strokes: IntervalEstimate
    """Mean number of file strokes per trial."""
    teeth: IntervalEstimate
    """Mean number of filed teeth per trial."""
    most: int
    """Maximum number of file strokes in one trial."""
    jams: ProbabilityEstimate
    """Probability of a jam after filing. A pair may still jam if a flank was filed to its limit."""


@dataclass(frozen=True)
class ConvergenceStep:
    """Probability estimated from the first trials of a run, used to show its convergence."""

    KEYS = ("trials", Key("", "share"))

    trials: int
    """Number of trials used, beginning with the first trial."""
    share: ProbabilityEstimate
    """Probability estimated from the first `trials` trials."""


# ------------------------------------------------------------------------------------------------------------- pointers


class FirstOrderError(NamedTuple):
    """Accuracy of a first-order calculation, in which the transmission errors of all pairs are added."""

    off: float
    """Root mean square of the error of first-order superposition [rad]."""
    rms: float
    """Root mean square of the exact pointer error [rad]."""


@dataclass(frozen=True, slots=True)
class PointerErrorStatistics(Result):
    """Statistics of the pointer error of one output at random positions of the input.

    The pointer error is the deviation from the mean position that the pointer would have with perfect teeth.
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
    """Name of the output."""
    errors: Floats
    """Pointer errors in the trials in which no pair that moves the output jams or disengages [rad], in the order of the
    trials.
    """
    all: Floats
    """Pointer errors of all trials in which teeth touch [rad]. If a pair jams, the error is computed with its drive
    flanks in contact.
    """
    stopped: int
    """Number of trials excluded from `errors`."""
    first: FirstOrderError
    """Root mean square of the error of first-order superposition, and root mean square of the pointer error [rad]."""
    shares: Mapping[str, float]
    """Share of each pair in the variance of the pointer error, by first-order superposition. The shares sum to 1; empty
    if the variance is 0.
    """

    @property
    def runs(self) -> int:
        """Number of trials in which the output can turn."""
        return len(self.errors)

    @property
    def kept(self) -> Floats:
        """Pointer errors used for the statistics [rad], from the trials in which the output can turn (`errors`) or, if
        these are fewer than 30, from all trials in which teeth touch (`all`).
        """
        return self.all if self.of_all else self.errors  # few trials give no useful statistics

    @property
    def of_all(self) -> bool:
        """True if the output can turn in fewer than 30 trials. The statistics then include the other trials, too."""
        return len(self.errors) < FEWEST

    @property
    def mean(self) -> IntervalEstimate:
        """Mean pointer error with its confidence interval [rad]."""
        return mean_of(self.kept)

    @property
    def deviation(self) -> IntervalEstimate:
        """Standard deviation of the pointer error with its confidence interval [rad]."""
        return deviation_of(self.kept)

    @property
    def deviation_of_all(self) -> IntervalEstimate:
        """Standard deviation of the pointer error over all trials in which teeth touch [rad], with its confidence
        interval.
        """
        return deviation_of(self.all)

    @property
    def percentiles(self) -> dict[float, IntervalEstimate]:
        """Mapping from percentage to the percentile of the pointer error with its confidence interval [rad]."""
        return percentiles_of(self.kept)

    @property
    def maximum(self) -> float:
        """Maximum absolute pointer error in the trials [rad]."""
        return float(np.abs(self.kept).max(initial=0.0))

    def beyond(self, angle: float) -> ProbabilityEstimate:
        """Return the probability that the absolute pointer error exceeds `angle` [rad]."""
        return ProbabilityEstimate(int(np.count_nonzero(np.abs(self.kept) > angle)), len(self.kept))


@dataclass(frozen=True, slots=True)
class PointerErrorCourse(Result):
    """Pointer errors of one output in each trial over a revolution of the output, or of the input if the output is
    fixed.

    See Also
    --------
    run_course : Compute the errors.
    """

    KEYS = (
        Key("output", "name"),
        Key("trials", "count"),
        "turns",
        "bands_deg",
        Key("maximum_deg", "percentiles", in_degrees),
    )

    name: str
    """Name of the output."""
    turns: Floats
    """Positions of the input [turn], shape (n,)."""
    errors: Floats
    """Pointer errors by trial and position [rad], shape (trials, n)."""

    @property
    def maximum(self) -> Floats:
        """Maximum absolute pointer error of each trial over the revolution [rad]."""
        found: Floats = np.abs(self.errors).max(axis=1)
        return found

    @property
    def count(self) -> int:
        """Number of trials in which the errors were computed."""
        return len(self.errors)

    @property
    def percentiles(self) -> dict[float, IntervalEstimate]:
        """Mapping from percentage to the percentile of the maximum absolute pointer error over the trials [rad]."""
        return percentiles_of(self.maximum)

    @property
    def bands_deg(self) -> Floats:
        """Minimum, five quantiles and maximum of the pointer errors, as in `bands`, shape (7, n) [deg]."""
        found: Floats = np.degrees(self.bands())
        return found

    def bands(self) -> Floats:
        """Return the quantiles of the pointer errors over the trials, at each position of the input.

        Returns
        -------
        numpy.ndarray
            Minimum, 2.5, 25, 50, 75 and 97.5 % quantiles and maximum, shape (7, n) [rad].
        """
        found: Floats = np.quantile(self.errors, (0, 0.025, 0.25, 0.5, 0.75, 0.975, 1), axis=0)
        return found
