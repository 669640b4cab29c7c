"""Results of an error budget: causes of each pointer's error in degrees and in days, and causes that have no data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from geartrain.numerics.results import Key, Pictured, Result, Tabular

if TYPE_CHECKING:
    from geartrain.kinematics.judged_outputs import SpeedValue

CauseName = Literal["ratio", "theory", "teeth", "lost motion", "cutting"]
Declared = Literal["whole", "part", "not declared"]
CAUSES: tuple[CauseName, ...] = ("ratio", "theory", "teeth", "lost motion", "cutting")
MEASURES: Mapping[CauseName, str] = {
    "ratio": "drift over the span",
    "theory": "peak to peak",
    "teeth": "peak to peak",
    "lost motion": "maximum",
    "cutting": "central 95 % range",
}
"""Mapping from each cause to a description of what its size in degrees measures."""


@dataclass(frozen=True, slots=True)
class BudgetCause(Result):
    """Contribution of one cause to the error of a pointer."""

    KEYS = ("name", "measure", "declared", "degrees", "rms", "days", "interval", "note")

    name: CauseName
    """Name of the cause."""
    declared: Declared
    """Completeness of the declared data for this cause: "whole", "part" or "not declared"."""
    degrees: float | None = None
    """Size of this contribution as defined by `measure` [deg]; None if it is unknown."""
    rms: float | None = None
    """Root mean square of the contribution [deg]. For the causes "ratio" and "cutting", the mean is
    subtracted first.
    """
    days: float | None = None
    """Time in which the pointer turns through `degrees` at its mean speed [d].

    The value is None if the pointer does not turn, or if no unit of time is declared.
    """
    interval: tuple[float, float] | None = None
    """95 % confidence interval of `degrees` [deg]; None if the value is not a statistical estimate."""
    note: str = ""
    """Note on the origin of the error, or on missing data."""

    @classmethod
    def unknown(cls, name: CauseName, note: str) -> BudgetCause:
        """Return a contribution of unknown size; `note` is the reason why the size is unknown."""
        return cls(name, "not declared", note=note)

    @property
    def measure(self) -> str:
        """Description of what `degrees` measures, from `MEASURES`."""
        return MEASURES[self.name]


@dataclass(frozen=True, slots=True)
class RatioDrift(Result):
    """Drift of a pointer relative to a target, due to the error of its mean speed. It is positive if the pointer is too
    fast.
    """

    target: str
    """Description of the target relative to which the drift is measured."""
    ppm: float | None
    """Relative error of the pointer's mean speed [parts per million]; None if the target speed is 0."""
    degrees_per_turn: float | None
    """Drift per turn at the target speed [deg]; None if the target speed is 0."""
    degrees_per_year: float | None
    """Drift in 365.25 days [deg]; None if the train's unit is not a unit of time."""
    degrees_per_century: float | None
    """Drift in 36525 days [deg]; None if the train's unit is not a unit of time."""
    degrees_over_span: float | None
    """Drift over the time span of the budget [deg]; None if the train's unit is not a unit of time."""


@dataclass(frozen=True, slots=True)
class PointerBudget(Result):
    """Error budget of one pointer, which lists the contribution of each cause to its error.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.workshop import find_budget
    >>> moon = find_budget(geartrain.load("freeth-2008"))["moon"]
    >>> [(cause.name, round(cause.degrees, 2)) for cause in moon.ranked]
    [('ratio', 1.0), ('theory', 0.76)]
    >>> [cause.name for cause in moon.undeclared]
    ['teeth', 'lost motion', 'cutting']
    """

    KEYS = (
        *("name", "of", "relative_to", "speed", "degrees_per_day", Key("causes"), "ranking", "total", "drifts"),
        *("overtaken_after_years", "pairs"),
    )

    name: str
    """Name of the output."""
    of: str
    """Name of the link that turns with the pointer."""
    relative_to: str
    """Name of the link relative to which the pointer is read."""
    speed: SpeedValue | None
    """Mean speed of the pointer relative to the link `relative_to`, in the train's unit of speed."""
    degrees_per_day: float | None
    """Magnitude of the mean speed [deg/d]; None if the train's unit is not a unit of time."""
    causes: tuple[BudgetCause, ...]
    """Contributions of the five causes of error, in the order of `CAUSES`."""
    drifts: tuple[RatioDrift, ...] = ()
    """Drift relative to each target. The size of the cause "ratio" is the magnitude of the first drift over the time
    span.
    """
    pairs: Mapping[str, float] | None = None
    """Peak-to-peak pointer error due to the teeth of each pair [deg], in descending order; None if it is unknown."""

    def __getitem__(self, cause: CauseName) -> BudgetCause:
        return self.causes[CAUSES.index(cause)]

    @property
    def ranked(self) -> tuple[BudgetCause, ...]:
        """Causes whose contribution is known, in descending order of contribution."""
        known = [cause for cause in self.causes if cause.degrees is not None]
        return tuple(sorted(known, key=lambda cause: -(cause.degrees or 0.0)))

    @property
    def ranking(self) -> tuple[str, ...]:
        """Names of the causes whose contribution is known, in descending order of contribution."""
        return tuple(cause.name for cause in self.ranked)

    @property
    def undeclared(self) -> tuple[BudgetCause, ...]:
        """Causes whose contribution is unknown."""
        return tuple(cause for cause in self.causes if cause.degrees is None)

    @property
    def total(self) -> float:
        """Sum of the magnitudes of all known contributions [deg]."""
        return sum(cause.degrees or 0.0 for cause in self.ranked)

    @property
    def overtaken_after_years(self) -> float | None:
        """Time after which the drift equals the largest other contribution [Julian years]; None if the drift is unknown
        or 0, or if no other contribution is known.
        """
        others = [cause.degrees or 0.0 for cause in self.ranked if cause.name != "ratio"]
        # the first target counts, as for the ratio itself
        yearly = self.drifts[0].degrees_per_year if self.drifts else None
        # a drift of 0 never reaches another cause
        return max(others) / abs(yearly) if others and yearly else None


@dataclass(frozen=True, slots=True)
class TrainBudget(Tabular, Pictured, Result):
    """Error budgets of a train's pointers in one state.

    See Also
    --------
    find_budget : Compute the budget.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.workshop import find_budget
    >>> budget = find_budget(geartrain.load("freeth-2008"))
    >>> budget.not_declared["cutting"], len(budget.pointers)
    (9, 10)
    """

    MEANINGS: ClassVar = {
        "pointer": "Output.",
        "cause": "Cause of the error.",
        "degrees": "Error of the pointer from this cause [deg].",
        "rms": "Root mean square of the error [deg].",
        "days": "Time in which the pointer turns through the error [d].",
    }

    PAGE = "workshop.budget.budget_report:describe_budget"

    FIGURE = "workshop.budget.budget_report:budget_figure"

    KEYS = (
        *("name", "state", "span_days", "turns", "samples", Key("input", "driving_link"), "pointers"),
        *("reversing_drivers", "not_declared"),
    )

    name: str
    """Name of the gear train."""
    state: str | None
    """Name of the state; None for a train without states."""
    span_days: float
    """Time span over which drifts are evaluated [d]."""
    turns: float
    """Number of turns of the input over which transmission errors and lost motion are evaluated."""
    samples: int
    """Number of positions of the input at which transmission errors are evaluated."""
    driving_link: str
    """Name of the driving link."""
    pointers: tuple[PointerBudget, ...]
    """Budget of each requested output."""
    reversing_drivers: tuple[str, ...] = ()
    """Names of pairs whose driver temporarily reverses. The effect of the reversal is not included in their lost
    motion.
    """
    shown: tuple[str, ...] = ()
    """Names of the pointers in the plot: the requested outputs, or the outputs with a dial."""

    def _summary(self) -> str:
        totals = (f"{each.name} {each.total:.3g} deg" for each in self.pointers[:3] if each.total is not None)
        more = f", {len(self.pointers) - 3} more" if len(self.pointers) > 3 else ""
        state = "" if self.state is None else f" state {self.state}"
        return f"{self.name}{state}: pointer errors {', '.join(totals) or 'not known'}{more}"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table that has a row for each cause of each pointer: names of pointer and cause, size and rms
        value of the error [deg], and the error as a time [d]; unknown values are None.
        """
        rows = [(pointer.name, cause) for pointer in self.pointers for cause in pointer.causes]
        return {
            "pointer": [name for name, _ in rows],
            "cause": [cause.name for _, cause in rows],
            "degrees": [cause.degrees for _, cause in rows],
            "rms": [cause.rms for _, cause in rows],
            "days": [cause.days for _, cause in rows],
        }

    def __getitem__(self, pointer: str) -> PointerBudget:
        return next(each for each in self.pointers if each.name == pointer)

    @property
    def not_declared(self) -> Mapping[str, int]:
        """Number of pointers for which the size of a cause is unknown, keyed by cause."""
        return {cause: sum(each[cause].degrees is None for each in self.pointers) for cause in CAUSES}
