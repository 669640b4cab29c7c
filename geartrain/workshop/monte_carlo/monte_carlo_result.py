"""Everything that can be asked of the trials of one train, its result, and what is assumed in it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import degrees
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from geartrain.numerics.confidence_intervals import CONFIDENCE
from geartrain.numerics.results import Key, Pictured, Result, Tabular, group
from geartrain.numerics.work import Execution
from geartrain.workshop.monte_carlo.clearance_study import jamming_map, run_clearances
from geartrain.workshop.monte_carlo.random_streams import BLOCK
from geartrain.workshop.monte_carlo.sobol_indices import find_sobol_indices
from geartrain.workshop.monte_carlo.trial_results import TrialResults
from geartrain.workshop.monte_carlo.trial_run import run_course

if TYPE_CHECKING:
    from geartrain.workshop.monte_carlo.clearance_study import ClearanceCase
    from geartrain.workshop.monte_carlo.sobol_indices import SobolIndices
    from geartrain.workshop.monte_carlo.trial_results import PointerErrorCourse, TrialResults


ErrorSizes = dict[str, dict[str, dict[str, float]]]


class PartialTrials(NamedTuple):
    """Trials that were done, of how many."""

    done: int
    """Trials computed."""
    of: int
    """Trials requested."""


@dataclass(frozen=True, slots=True)
class MonteCarloResult(Tabular, Pictured, Result):
    """Trials, and what else was asked of one train: what reports and pictures are made from.

    See Also
    --------
    run_trials : gives what it must hold
    """

    PAGE = "workshop.monte_carlo.monte_carlo_report:describe_monte_carlo"

    FIGURE = "monte_carlo_figure"
    DRAWN_IN = "workshop"

    KEYS = (
        Key("train", "trials.plan.name"),
        Key("seed", "trials.seed"),
        Key("trials", "trials.done"),
        "block",
        "confidence",
        "assumptions",
        group("errors", Key("wheels", "wheel_errors"), Key("pairs", "pair_errors")),
        Key("any_pair", "trials.train"),
        Key("pairs", "trials.pairs"),
        Key("filing", "trials.filings"),
        Key("outputs", "trials.pointers"),
        group("convergence", Key("jam", "trials.jams"), Key("stops", "trials.stops")),
        "partial",
        Key("clearances", "cleared"),
        "courses",
        "indices",
    )

    trials: TrialResults
    """As `run_trials` gives them."""
    cleared: Sequence[ClearanceCase] = ()
    """At other clearances, from `jamming_map`."""
    courses: Sequence[PointerErrorCourse] = ()
    """Along a turn, from `run_course`."""
    indices: Sequence[SobolIndices] = ()
    """From `find_sobol_indices`."""

    def _summary(self) -> str:
        return self.trials._summary()

    def _meaning(self, column: str) -> str:
        return self.trials._meaning(column)

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each trial, as of the trials."""
        return self.trials.columns

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What is taken for granted, in sentences."""
        return tuple(self._assumptions())

    def _assumptions(self) -> Iterator[str]:
        plan = self.trials.plan
        yield (
            "Teeth are independent of each other, and so are wheels; a wheel is one and the same in all its pairs. "
            "Each trial cuts all wheels anew."
        )
        yield (
            "The driven wheel drags and so stays in contact. A jam holds it fast from both sides, whatever it does; a "
            "clash is a tooth that comes in against a tip, which a hand that leads it may pass."
        )
        if any("bearing" in pair.fitting for pair in plan.pairs):
            yield (
                "Bearings move from tooth to tooth: jams are judged with the axes at their nearest, the rest at their "
                "farthest too, which is the worst that can be."
            )
        if any(wheel.displaced is not None for wheel in plan.wheels):
            yield (
                "Flanks of teeth that are not triangular are displaced where they touch, right to first order in their "
                "errors; tips that touch beyond the flanks are counted, roots in the way of tips are not."
            )
        if plan.files:
            yield (
                "Pairs are filed to fit: where a pair jams, the flank that stands out farthest takes strokes until it "
                "passes, and shares of jams and errors are those of the filed wheels. Each pair is filed by itself."
            )
        uncut = self.trials.train.uncut
        if uncut:
            yield (
                f"{uncut} trials hold a wheel that cannot be cut, two of its teeth falling into one: they are left "
                "out of all shares."
            )
        yield (
            "A pointer's error is its distance from where teeth that keep their ratio would have it; the mean lag of "
            "even teeth, with which pointers are set, is taken off. Laws of pairs and pins are composed exactly."
        )

    @property
    def block(self) -> int:
        """Trials that are drawn from one stream of random numbers."""
        return BLOCK

    @property
    def confidence(self) -> float:
        """Of all intervals."""
        return CONFIDENCE

    @property
    def wheel_errors(self) -> ErrorSizes:
        """Sizes of errors by wheel, kind and way: fractions of pitch, half angle and depth."""
        return _sizes({wheel.name: wheel.errors for wheel in self.trials.plan.wheels})

    @property
    def pair_errors(self) -> ErrorSizes:
        """Sizes of errors of fitting by pair, kind and way."""
        return _sizes({pair.name: pair.fitting for pair in self.trials.plan.pairs})

    @property
    def partial(self) -> PartialTrials | None:
        """What was done of a run that was interrupted."""
        return None if self.trials.complete else PartialTrials(self.trials.done, self.trials.wanted)

    def pointer_convergence(self, at: int) -> list[tuple[int, float, float, float]]:
        """Trials, and the standard deviation of an output with its interval [deg].

        Parameters
        ----------
        at : int
            The number of the output, from 0.
        """
        rows = self.trials.pointer_convergence(at)
        return [(n, degrees(each.value), degrees(each.low), degrees(each.high)) for n, each in rows]


def _sizes(errors: Mapping[str, Mapping[str, Any]]) -> ErrorSizes:
    return {name: {kind: {off.way: off.size} for kind, off in each.items()} for name, each in errors.items() if each}


# -------------------------------------------------------------------------------------------------------------- studies


_FEW = 4  # outputs whose course and indices are worked out at a time
_POSITIONS, _COURSES = 120, 128  # along a turn, and trials that take them
_SHARES = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)  # of windows, where no clearances are given
_SCALES = (0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0)  # of the errors declared


@dataclass(frozen=True)
class TrialStudies:
    """What is asked beside the trials themselves."""

    clearances: Sequence[float] = ()
    """Factors, or shares of windows, at which the train is judged again."""
    courses: bool = False
    """Whether the first outputs are followed along a turn."""
    sobol: bool = False
    """Whether their Sobol indices are found, by wheel and by kind."""

    def of(self, trials: TrialResults, means: Execution) -> MonteCarloResult:
        """The trials with all that is asked beside them."""
        plan, seed, count = trials.plan, trials.seed, trials.wanted
        few = range(min(_FEW, len(plan.outputs)))
        by: tuple[Literal["wheel", "kind"], ...] = ("wheel", "kind")
        return MonteCarloResult(
            trials,
            run_clearances(plan, self.clearances, count, seed, means) if self.clearances else (),
            [run_course(plan, at, _POSITIONS, seed, _COURSES) for at in few] if self.courses else (),
            [find_sobol_indices(plan, at, each, count, seed, means) for at in few for each in by] if self.sobol else (),
        )

    def mapped(self, findings: MonteCarloResult, means: Execution) -> MonteCarloResult:
        """The findings with what a map of jams needs: the clearances, or others, and errors of other sizes."""
        of = findings.trials
        clearances = self.clearances or _SHARES
        return replace(findings, cleared=jamming_map(of.plan, clearances, _SCALES, of.wanted, of.seed, means))
