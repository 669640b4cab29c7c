"""Combined results of all studies on the trials of one train, with the assumptions of the trials."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from geartrain.numerics.confidence_intervals import CONFIDENCE
from geartrain.numerics.results import Key, Pictured, Result, Tabular, group
from geartrain.numerics.work import Execution
from geartrain.workshop.monte_carlo.clearance_study import jamming_map
from geartrain.workshop.monte_carlo.sobol_indices import find_sobol_indices
from geartrain.workshop.monte_carlo.trial_block import BLOCK
from geartrain.workshop.monte_carlo.trial_results import TrialResults
from geartrain.workshop.monte_carlo.trial_run import run_course

if TYPE_CHECKING:
    from geartrain.workshop.monte_carlo.clearance_study import ClearanceCase
    from geartrain.workshop.monte_carlo.sobol_indices import SobolIndices
    from geartrain.workshop.monte_carlo.trial_results import PointerErrorCourse, TrialResults


ErrorSizes = dict[str, dict[str, dict[str, float]]]


class PartialTrials(NamedTuple):
    """Numbers of completed and requested trials of an interrupted run."""

    done: int
    """Number of completed trials."""
    of: int
    """Number of requested trials."""


@dataclass(frozen=True, slots=True)
class MonteCarloResult(Tabular, Pictured, Result):
    """Results of Monte Carlo trials of one train, with optional studies of clearances, revolutions and sensitivity.

    See Also
    --------
    run_trials : Run the trials that this result contains.
    """

    PAGE = "workshop.monte_carlo.monte_carlo_report:describe_monte_carlo"

    FIGURE = "workshop.monte_carlo.monte_carlo_plots:monte_carlo_figure"

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
    """Results of the trials, from `run_trials`."""
    cleared: Sequence[ClearanceCase] = ()
    """Event probabilities at other clearance factors, from `jamming_map`."""
    courses: Sequence[PointerErrorCourse] = ()
    """Pointer errors of each studied output over one revolution, from `run_course`."""
    indices: Sequence[SobolIndices] = ()
    """Sobol indices of pointer errors, from `find_sobol_indices`."""

    def _summary(self) -> str:
        return self.trials._summary()

    def _meaning(self, column: str) -> str:
        return self.trials._meaning(column)

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with one row for each trial, as in `TrialResults.columns`."""
        return self.trials.columns

    @property
    def assumptions(self) -> tuple[str, ...]:
        """Assumptions of the trials; each is one sentence."""
        return tuple(self._assumptions())

    def _assumptions(self) -> Iterator[str]:
        plan = self.trials.plan
        yield (
            "The errors of teeth are independent of each other, and so are the errors of wheels. A wheel has the same "
            "errors in all its pairs. Each trial cuts all wheels anew."
        )
        if stepped := [wheel.name for wheel in plan.wheels if "stepping" in wheel.errors]:
            yield f"Exception: dividers set off each tooth of {', '.join(stepped)} from the last; their errors add up."
        if measured := [wheel.name for wheel in plan.wheels if wheel.tables]:
            yield f"Exception: {', '.join(measured)} has its measured teeth in every trial."
        yield (
            "Friction keeps the driven wheel in contact. In a jam, teeth block it on both sides at once. In a clash, a "
            "tooth enters the mesh against a tip; turning the driven wheel by hand within its backlash may free it."
        )
        if any("bearing" in pair.fitting for pair in plan.pairs):
            yield (
                "Bearing clearance lets the axes move from tooth to tooth. The worst case is taken: jams are found at "
                "the smallest centre distance, all other events at the smallest and at the largest."
            )
        if any(wheel.displaced is not None for wheel in plan.wheels):
            yield (
                "Flanks of teeth that are not triangular are displaced at the point of contact. This is valid to first "
                "order in the errors. Contact at tips is included, interference of tips with roots is not."
            )
        if plan.files:
            yield (
                "Pairs are filed to fit: if a pair jams, its most protruding flank is filed until the pair passes. "
                "Probabilities of jams and errors are for the filed wheels. Each pair is filed separately."
            )
        uncut = self.trials.train.uncut
        if uncut:
            yield (
                f"{uncut} trials contain a wheel that cannot be cut, because two of its teeth merge. They are excluded "
                "from all probabilities."
            )
        yield (
            "The error of a pointer is its deviation from the position given by a constant ratio, minus the mean error "
            "of perfect teeth, because pointers are set with it. The transmission functions of pairs and pins are "
            "composed exactly."
        )

    @property
    def block(self) -> int:
        """Number of trials that share one stream of random numbers."""
        return BLOCK

    @property
    def confidence(self) -> float:
        """Confidence level of all confidence intervals in the result."""
        return CONFIDENCE

    @property
    def wheel_errors(self) -> ErrorSizes:
        """Sizes of the cutting errors by wheel, kind and distribution, as fractions of pitch, half angle or depth."""
        return _sizes({wheel.name: wheel.errors for wheel in self.trials.plan.wheels})

    @property
    def pair_errors(self) -> ErrorSizes:
        """Sizes of the mounting errors, keyed by pair, kind and distribution, as fractions of the tooth depth."""
        return _sizes({pair.name: pair.fitting for pair in self.trials.plan.pairs})

    @property
    def partial(self) -> PartialTrials | None:
        """Numbers of completed and requested trials if the run was interrupted; None if all trials were completed."""
        return None if self.trials.complete else PartialTrials(self.trials.done, self.trials.wanted)


def _sizes(errors: Mapping[str, Mapping[str, Any]]) -> ErrorSizes:
    return {name: {kind: {off.way: off.size} for kind, off in each.items()} for name, each in errors.items() if each}


# -------------------------------------------------------------------------------------------------------------- studies


_FEW = 4  # outputs whose course and indices are computed: each costs as much as the trials
_POSITIONS, _COURSES = 120, 128  # positions over one turn, and trials of a course
_SHARES = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)  # fractions of clearance windows, if no clearances are given
_SCALES = (0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0)  # factors of the declared errors


def study_trials(
    trials: TrialResults, means: Execution, clearances: Sequence[float], courses: bool, sobol: bool
) -> MonteCarloResult:
    """Return the trials together with further studies of the same plan.

    clearances   clearance factors at which the trials are repeated; empty for none
    courses      True to compute the errors of the first outputs over one turn
    sobol        True to compute the Sobol indices of the first outputs
    """
    plan, seed, count = trials.plan, trials.seed, trials.wanted
    few = range(min(_FEW, len(plan.outputs)))
    by: tuple[Literal["wheel", "kind"], ...] = ("wheel", "kind")
    return MonteCarloResult(
        trials,
        jamming_map(plan, clearances, trials=count, seed=seed, means=means) if clearances else (),
        [run_course(plan, at, _POSITIONS, seed, _COURSES) for at in few] if courses else (),
        [find_sobol_indices(plan, at, each, count, seed, means) for at in few for each in by] if sobol else (),
    )


def with_jamming_map(found: MonteCarloResult, means: Execution, clearances: Sequence[float]) -> MonteCarloResult:
    """Return the result with trials repeated at several clearance factors and scale factors of the errors."""
    of, clearances = found.trials, clearances or _SHARES
    return replace(found, cleared=jamming_map(of.plan, clearances, _SCALES, of.wanted, of.seed, means))
