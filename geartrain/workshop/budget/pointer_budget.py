"""The causes of a pointer's error as a result: each in degrees and in days, ranked, or named as not declared."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from geartrain.numerics.results import Key, Pictured, Result, Tabular

if TYPE_CHECKING:
    from geartrain.kinematics.judged_outputs import SpeedValue
    from geartrain.workshop.budget.crank_load import CrankLoad
    from geartrain.workshop.monte_carlo.clearance_study import ClearanceCase

CauseName = Literal["ratio", "theory", "teeth", "lost motion", "cutting"]
Declared = Literal["whole", "part", "not declared"]
CAUSES: tuple[CauseName, ...] = ("ratio", "theory", "teeth", "lost motion", "cutting")
MEASURES: Mapping[CauseName, str] = {
    "ratio": "drift over the span",
    "theory": "peak to peak",
    "teeth": "peak to peak",
    "lost motion": "maximum",
    "cutting": "range that holds 95 %",
}
"""What the degrees of each cause are."""


@dataclass(frozen=True, slots=True)
class BudgetCause(Result):
    """One cause of a pointer's error.

    See Also
    --------
    PointerBudget : holds them
    """

    KEYS = ("name", "measure", "declared", "degrees", "rms", "days", "interval", "note")

    name: CauseName
    """What it comes from."""
    declared: Declared
    """Whether the train says all that must be known for it."""
    degrees: float | None = None
    """Its size as `measure` says [deg]; None where it is not declared."""
    rms: float | None = None
    """Root mean square [deg]: of a drift and of cutting about the mean, of lost motion itself."""
    days: float | None = None
    """The time in which the pointer, at its mean speed, turns so far; None where it stands or no time is declared."""
    interval: tuple[float, float] | None = None
    """Of `degrees`, with 95 % confidence [deg]; None for what is no estimate."""
    note: str = ""
    """What it is made of, or what is not declared."""

    @classmethod
    def unknown(cls, name: CauseName, note: str) -> BudgetCause:
        """A cause of which nothing is declared.

        Parameters
        ----------
        name : str
            What it comes from.
        note : str
            What is not declared.
        """
        return cls(name, "not declared", note=note)

    def in_days(self, degrees_per_day: float | None) -> BudgetCause:
        """The cause with its size as a time.

        Parameters
        ----------
        degrees_per_day : float or None
            How fast the pointer turns; None where it stands or no time is declared.
        """
        if self.degrees is None or not degrees_per_day:
            return self
        return replace(self, days=self.degrees / degrees_per_day)

    @property
    def measure(self) -> str:
        """What `degrees` is: a drift over the span, peak to peak, the greatest, or the range that holds 95 %."""
        return MEASURES[self.name]


@dataclass(frozen=True, slots=True)
class RatioDrift(Result):
    """What the mean speed of a pointer is off, against one of its targets; positive is fast.

    See Also
    --------
    PointerBudget : holds them
    """

    target: str
    """In words."""
    ppm: float | None
    """Parts per million of the target's speed; None where 0 is wanted."""
    degrees_per_turn: float | None
    """Gained in a turn of the pointer [deg]."""
    degrees_per_year: float | None
    """Angle gained in 365.25 days [deg]; None where the train's unit is not a time."""
    degrees_per_century: float | None
    """Angle gained in 36525 days [deg]; None where the train's unit is not a time."""
    degrees_over_span: float | None
    """Gained over the span of the budget [deg]."""


@dataclass(frozen=True, slots=True)
class PointerBudget(Result):
    """The causes of one pointer's error.

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
    """Of the output."""
    of: str
    """The link that turns."""
    relative_to: str
    """The link against which it is read."""
    speed: SpeedValue | None
    """Mean speed of the one seen from the other [the train's unit]."""
    degrees_per_day: float | None
    """The same without sign; None where the train's unit is no time."""
    causes: tuple[BudgetCause, ...]
    """All five, in the order of `CAUSES`."""
    drifts: tuple[RatioDrift, ...] = ()
    """Against every target; the first is the one that counts."""
    pairs: Mapping[str, float] | None = None
    """What the ripple of each pair's teeth alone gives at the pointer, peak to peak [deg], the greatest first."""

    def __getitem__(self, cause: CauseName) -> BudgetCause:
        return self.causes[CAUSES.index(cause)]

    @property
    def ranked(self) -> tuple[BudgetCause, ...]:
        """The causes whose size is known, the greatest first."""
        known = [cause for cause in self.causes if cause.degrees is not None]
        return tuple(sorted(known, key=lambda cause: -(cause.degrees or 0.0)))

    @property
    def ranking(self) -> tuple[str, ...]:
        """Names of the causes whose size is known, the greatest first."""
        return tuple(cause.name for cause in self.ranked)

    @property
    def undeclared(self) -> tuple[BudgetCause, ...]:
        """The causes of which nothing is known."""
        return tuple(cause for cause in self.causes if cause.degrees is None)

    @property
    def total(self) -> float:
        """Sum of all sizes that are known, the worst that can come together [deg]."""
        return sum(cause.degrees or 0.0 for cause in self.ranked)

    @property
    def overtaken_after_years(self) -> float | None:
        """Julian years after which the ratio's drift is as great as the greatest other cause; None where it is not."""
        others = [cause.degrees or 0.0 for cause in self.ranked if cause.name != "ratio"]
        yearly = self.drifts[0].degrees_per_year if self.drifts else None
        return max(others) / abs(yearly) if others and yearly else None


@dataclass(frozen=True, slots=True)
class TrainBudget(Tabular, Pictured, Result):
    """The budgets of a train's pointers in one state, with the crank and the jams of its wheels.

    See Also
    --------
    find_budget : gives it

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
        "days": "The error as time [d].",
    }

    PAGE = "workshop.budget.budget_report:describe_budget"

    FIGURE = "budget_figure"
    DRAWN_IN = "workshop"

    KEYS = (
        *("name", "state", "span_days", "turns", "samples", Key("input", "driving_link"), "pointers", "crank"),
        *("jams", "jams_note", "reversing_drivers", "not_declared"),
    )

    name: str
    """Of the train."""
    state: str | None
    """As it was named."""
    span_days: float
    """Over which ratios drift [d]."""
    turns: float
    """Turns of the input over which teeth and lost motion are followed."""
    samples: int
    """Number of positions of the input."""
    driving_link: str
    """The link whose turns these are."""
    pointers: tuple[PointerBudget, ...]
    """One for each output that was asked for."""
    crank: CrankLoad
    """Torque and efficiency."""
    jams: tuple[ClearanceCase, ...] = ()
    """How often wheels cut by hand jam, over clearance; empty where no cutting is declared."""
    jams_note: str = ""
    """How, or why not."""
    reversing_drivers: tuple[str, ...] = ()
    """Pairs whose driver turns against its mean at times; the play is not followed there."""

    def _summary(self) -> str:
        totals = (f"{each.name} {each.total:.3g} deg" for each in self.pointers[:3] if each.total is not None)
        more = f", {len(self.pointers) - 3} more" if len(self.pointers) > 3 else ""
        state = "" if self.state is None else f" state {self.state}"
        return f"{self.name}{state}: pointer errors {', '.join(totals) or 'not known'}{more}"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each cause of each pointer: greatest and rms error [deg], and in days; None where not known."""
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
        """By cause, of how many pointers it is not declared."""
        return {cause: sum(each[cause].degrees is None for each in self.pointers) for cause in CAUSES}
