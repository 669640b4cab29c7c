"""Results of feasibility trials: probability of each outcome with its causes, crank torque, curve of accuracies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.numerics.confidence_intervals import IntervalEstimate, ProbabilityEstimate, percentile_of
from geartrain.numerics.results import Key, Pictured, Result
from geartrain.workshop.monte_carlo.friction_trials import friction_spreads
from geartrain.workshop.monte_carlo.monte_carlo_result import PartialTrials
from geartrain.workshop.monte_carlo.trial_block import CLASH, DISENGAGED

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.workshop.feasibility.feasibility_plan import FeasibilityPlan
    from geartrain.workshop.monte_carlo.trial_results import TrialResults

OUTCOMES = ("cannot be cut", "jams", "too stiff", "breaks", "turns")
"""Outcomes of a trial, in the order in which they are examined; exactly one of them applies."""


class OutcomeCause(NamedTuple):
    """Gear pair, tooth or arbor that causes an outcome, and the probability that it does.

    See Also
    --------
    FeasibilityResult : Result that contains it.
    """

    outcome: str
    """Name of the outcome."""
    part: str
    """Gear pair that cannot be cut or jams, or the part with the highest stress in proportion to its strength."""
    share: ProbabilityEstimate
    """Probability of the outcome with this cause. Several pairs may jam in one trial."""


class AccuracyStep(NamedTuple):
    """Probability that the train turns at one accuracy of the cutting.

    See Also
    --------
    FeasibilityResult : Result that contains it.
    """

    accuracy: float
    """Standard deviation of the pitch deviation of all wheels [deg]."""
    turns: ProbabilityEstimate
    """Probability that the train turns."""


class ForcedBreakage(NamedTuple):
    """Probability that the hand breaks a tooth of a train that jams, if it applies its maximum torque.

    See Also
    --------
    FeasibilityResult : Result that contains it.
    """

    torque: ProbabilityEstimate
    """The pair that jams transmits only the torque of the hand: a lower bound."""
    wedge: ProbabilityEstimate
    """Both flanks of the pair that jams are squeezed, with equal ratios: docs/cut-by-hand.md, equation (5)."""


class CrankTorque(NamedTuple):
    """Percentiles of the torque at the crank over all trials in which friction does not lock the train [N m].

    See Also
    --------
    FeasibilityResult : Result that contains it.
    """

    low: IntervalEstimate
    """5th percentile with its 95 % confidence interval."""
    median: IntervalEstimate
    """Median with its 95 % confidence interval."""
    high: IntervalEstimate
    """95th percentile with its 95 % confidence interval."""


@dataclass(frozen=True)
class FeasibilityResult(Pictured, Result):
    """Outcomes of the feasibility trials of a train.

    See Also
    --------
    run_feasibility : Run the trials.
    """

    PAGE = "workshop.feasibility.feasibility_report:describe_feasibility"
    FIGURE = "feasibility_figure"
    DRAWN_IN = "workshop"

    KEYS = (
        Key("train", "trials.plan.name"),
        Key("seed", "trials.seed"),
        Key("trials", "trials.done"),
        "conditions",
        "outcomes",
        *("rough", "loose", "forced", "causes", "crank_torque"),
        Key("outputs", "trials.pointers"),
        "curve",
        "neglected",
        "partial",
    )

    plan: FeasibilityPlan
    """Input data of the trials."""
    trials: TrialResults
    """Trials of the cutting: events of the pairs, and pointer errors."""
    outcome: Ints
    """Index in `OUTCOMES` of the outcome of each trial, shape (trials,)."""
    torque: Floats | None
    """Torque at the crank in each trial, shape (trials,) [N m]; infinite if friction locks the train; None without
    loads.
    """
    hand: Floats | None
    """Maximum torque of the hand or drive in each trial, shape (trials,) [N m]; None if it is not declared."""
    forced_counts: tuple[int, ...]
    """Numbers of jamming trials with a broken tooth, as in `forced`."""
    causes: tuple[OutcomeCause, ...]
    """Pairs and parts that cause each outcome, most frequent first."""
    curve: tuple[AccuracyStep, ...] = ()
    """Probability that the train turns at each requested accuracy."""

    def _summary(self) -> str:
        return ", ".join(f"{name} {100 * each.value:.3g} %" for name, each in self.outcomes.items() if each.count)

    @cached_property
    def outcomes(self) -> Mapping[str, ProbabilityEstimate]:
        """Probability of each outcome; the probabilities sum to 1."""
        counts = np.bincount(self.outcome, minlength=len(OUTCOMES)).tolist()
        return {name: ProbabilityEstimate(n, self.trials.done) for name, n in zip(OUTCOMES, counts, strict=True)}

    @property
    def rough(self) -> ProbabilityEstimate:
        """Probability that tips of teeth clash (rough running), of the trials in which the train turns."""
        return self._marked(CLASH)

    @property
    def loose(self) -> ProbabilityEstimate:
        """Probability that a pair loses contact, of the trials in which the train turns."""
        return self._marked(DISENGAGED)

    def _marked(self, mark: int) -> ProbabilityEstimate:
        turning = self.outcome == OUTCOMES.index("turns")
        marked = ((self.trials.marks & mark) != 0).any(axis=1) & turning
        return ProbabilityEstimate(int(np.count_nonzero(marked)), int(np.count_nonzero(turning)))

    @property
    def forced(self) -> ForcedBreakage | None:
        """Probability that a forced train breaks, of the trials in which it jams; None without strengths or a hand."""
        if self.hand is None or not self.plan.parts:
            return None
        jams = self.outcomes["jams"].count
        return ForcedBreakage(*(ProbabilityEstimate(count, jams) for count in self.forced_counts))

    @property
    def crank_torque(self) -> CrankTorque | None:
        """Median and 90 % range of the torque at the crank; None without loads."""
        known = np.sort(self.torque[np.isfinite(self.torque)]) if self.torque is not None else np.zeros(0)
        return CrankTorque(*(percentile_of(known, each) for each in (5.0, 50.0, 95.0))) if known.size else None

    def accuracy_for(self, probability: float = 0.5) -> float | None:
        """Return the accuracy at which the train turns with a given probability, by linear interpolation of the curve.

        Parameters
        ----------
        probability : float
            Probability that the train turns, 0 to 1.

        Returns
        -------
        float or None
            Standard deviation of the pitch deviation [deg]; None if the curve does not cross the probability.
        """
        for near, far in zip(self.curve, self.curve[1:], strict=False):
            above, below = near.turns.value, far.turns.value
            if above >= probability > below:
                return near.accuracy + (far.accuracy - near.accuracy) * (above - probability) / (above - below)
        return None

    @property
    def conditions(self) -> str:
        """Conditions of the probabilities in one sentence: clearance, friction, filing, and what is drawn how often."""
        return ", ".join(self._conditions())

    def _conditions(self) -> Iterator[str]:
        pairs, declared = self.plan.cutting.pairs, self.plan.declared
        backlash = [pair.backlash for pair in pairs]
        yield f"backlash of {min(backlash):.3g} to {max(backlash):.3g} pitches"
        factors = [1 + sizes.excess for pair in pairs if (sizes := getattr(pair, "sizes", None)) is not None]
        if factors:
            yield f"clearance factors of {min(factors):.4g} to {max(factors):.4g}"
        spreads = friction_spreads(declared)
        drawn = "; ".join(f"{name} {each}" for name, each in spreads.items())
        yield (
            f"friction: {drawn}" if drawn else "no friction" if declared.friction is None else "friction without spread"
        )
        yield "filed to fit" if self.plan.cutting.files else "no filing"
        if spreads or any(part.spread for part in self.plan.parts):
            yield f"spreads drawn once per {'part' if self.plan.per_part else 'workshop'}"

    @property
    def neglected(self) -> tuple[str, ...]:
        """Outcomes that are not examined, because their data are not declared."""
        return tuple(self._neglected())

    def _neglected(self) -> Iterator[str]:
        if self.torque is None:
            yield "crank torque and stresses: declare `loads` or `bearing` friction with a unit"
        elif not self.plan.parts:
            yield "breakage: declare `material`, `module` and `face_width`"
        if self.hand is None:
            yield "stiffness against the hand: declare `drive: {hand: {torque: 300 N mm}}`"

    @property
    def partial(self) -> PartialTrials | None:
        """Numbers of completed and requested trials if the run was interrupted; None for a complete run."""
        return None if self.trials.complete else PartialTrials(self.trials.done, self.trials.wanted)
