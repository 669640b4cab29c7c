"""Torque over a turn where friction is known by its spread only: trials with coefficients drawn anew.

A coefficient that is declared once is one in every trial: what the train declares holds for all of its pairs alike,
what a pair or coupling declares is its own. Normal; what falls below 0 counts as 0; `static` keeps its ratio.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from importlib.metadata import version
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.confidence_intervals import (
    IntervalEstimate,
    ProbabilityEstimate,
    deviation_of,
    mean_of,
    percentiles_of,
)
from geartrain.numerics.quantity import Figure
from geartrain.numerics.results import Result, Shown
from geartrain.numerics.work import Execution
from geartrain.report.document import Document, Section, Table
from geartrain.teeth.contact_coefficients import CoulombFriction
from geartrain.workshop.monte_carlo.monte_carlo_report import number_text, share_text
from geartrain.workshop.monte_carlo.random_streams import BLOCK, FRICTION, RandomStreams
from geartrain.workshop.monte_carlo.trial_run import check_trials

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics.turn.torque_cycle import CycleFigures
    from geartrain.dynamics.turn.train_turn import FrictionStudy
    from geartrain.numerics.arrays import Floats
    from geartrain.train import Train


FIGURES = ("mean", "maximum", "starting", "efficiency")
_TRAIN = "train"
"""What the train itself declares is called."""

_TASKS = 32  # so many where trials are few, so that all processes have work until nearly the end
_MOST = 8  # trials of a task: what is computed once for each task then costs less than they do


# ----------------------------------------------------------------------------------------------------- the coefficients


class FrictionSpread(NamedTuple):
    """A coefficient of friction with its standard deviation.

    See Also
    --------
    FrictionTrials.spreads : where these stand.
    """

    sliding: float
    """Mean of the coefficient."""
    deviation: float
    """Standard deviation of the coefficient."""


@dataclass(frozen=True)
class FrictionPlan(Shown):
    """A train whose friction has a spread, and the run that is asked of it.

    See Also
    --------
    find_friction_plan : gives it.
    """

    declared: Train
    """The train as declared."""
    state: str | None
    """The state; None only of a train that has none."""
    turns: float
    """Turns of the input in the run."""
    samples: int
    """Positions of the run."""
    of: str | None = None
    """The link whose torque is asked for; None for the crank."""

    def _summary(self) -> str:
        return f"{self.declared.name}: {self.turns:g} turns, {self.samples} positions"

    @property
    def spreads(self) -> Mapping[str, FrictionSpread]:
        """What is drawn, by who declares it."""
        return {name: _spread(friction) for name, _, friction in _declarers(self.declared) if _drawn(friction)}

    @cached_property
    def _nominal(self) -> GearTrain:
        from geartrain.analysis.gear_train import GearTrain

        return GearTrain(self.declared)

    @cached_property
    def study(self) -> FrictionStudy | None:
        """What trials have in common, as long as the same side drives each pair; None where they have nothing."""
        from geartrain.dynamics.turn.train_turn import study_friction

        return study_friction(self._nominal.mechanics, self.turns, self.samples, self.state, self.of)

    def follow(self, drawn: Train) -> CycleFigures:
        """Figures of the run of one trial.

        Parameters
        ----------
        drawn : Train
            The train with the coefficients of the trial.

        Raises
        ------
        QuestionError
            Where the torque is not known at all.
        """
        from geartrain.analysis.gear_train import GearTrain
        from geartrain.dynamics.turn.torque_cycle import CycleFigures

        train, parts, study = GearTrain(drawn), (*drawn.gears, *drawn.couplings), self.study
        if study is not None and (
            study.certain or train.mechanics.drivers(self.state) == self._nominal.mechanics.drivers(self.state)
        ):
            frictions = {part.name: friction for part in parts if (friction := drawn.friction_of(part)) is not None}
            figures = study.figures(frictions)
            if not study.certain or figures.mean is not None:  # where it locks other sides may drive
                return figures
        found = train.torques(self.state, turns=self.turns, samples=self.samples, of=self.of)
        if found.turns is None:
            raise QuestionError(Problem("there is no torque to try", found.verdict.text, "declare loads or bearings"))
        return CycleFigures(found.mean, found.maximum_torque, found.starting_torque, found.efficiency)

    def __getstate__(self) -> dict[str, Any]:
        """Without what trials have in common, which each process works out for itself."""
        return {name: value for name, value in self.__dict__.items() if name not in ("study", "_nominal")}

    def question(self, trials: int, seed: int) -> dict[str, Any]:
        """What a journal knows a run by: everything on which its results depend.

        Parameters
        ----------
        trials, seed : int
            How many are asked for, and what they are drawn by.
        """
        made = {"geartrain": version("geartrain"), "numpy": version("numpy")}
        requested = {"state": self.state, "turns": self.turns, "samples": self.samples, "of": self.of}
        train = self.declared.model_dump(mode="json", exclude_defaults=True)
        return {**made, "train": train, **requested, "trials": trials, "seed": seed}


def find_friction_plan(
    train: GearTrain, turns: float, samples: int = 20_000, state: str | None = None, of: str | None = None
) -> FrictionPlan:
    """What trials of friction need: a train that declares spreads of it, and the run to follow.

    Parameters
    ----------
    train : GearTrain
        The train.
    turns : float
        Turns of the input, above 0.
    samples : int
        Positions of a run, 2 or more.
    state : str, optional
        A declared state; None only of a train that has none.
    of : str, optional
        The link whose torque is asked for, by default the crank.

    Returns
    -------
    FrictionPlan
        What `try_frictions` follows.

    Raises
    ------
    QuestionError
        Where no friction has a spread.

    Examples
    --------
    >>> from geartrain import load
    >>> plan = find_friction_plan(load('''
    ... extends: moon-triangular
    ... loads: {moon: -1 N mm}
    ... friction: {sliding: 0.2, deviation: 0.05}
    ... '''), turns=1)
    >>> plan.spreads
    {'train': FrictionSpread(sliding=0.2, deviation=0.05)}
    """
    plan = FrictionPlan(train.declaration, state, turns, samples, of)
    if not plan.spreads:
        why = "trials draw coefficients of friction from the spread that is declared of them"
        fix = "write `friction: {sliding: 0.15, deviation: 0.05}` at the train, a pair or a coupling"
        raise QuestionError(Problem(f"'{train.name}' declares no spread of friction", why, fix))
    return plan


def draw_friction(declared: Train, seed: int, trial: int) -> Train:
    """A train with the coefficients of one trial."""
    streams = RandomStreams(seed, trial // BLOCK)
    drawn: dict[str, CoulombFriction] = {}
    for name, item, friction in _declarers(declared):
        if _drawn(friction):
            unit = float(streams.rng(item, FRICTION).standard_normal(BLOCK)[trial % BLOCK])
            drawn[name] = _with_coefficient(friction, unit)
    gears = [gear.model_copy(update=_own(gear.name, drawn)) for gear in declared.gears]
    couplings = [joint.model_copy(update=_own(joint.name, drawn)) for joint in declared.couplings]
    return declared.model_copy(update={**_own(_TRAIN, drawn), "gears": gears, "couplings": couplings})


def _own(name: str, drawn: Mapping[str, CoulombFriction]) -> dict[str, CoulombFriction]:
    return {"friction": drawn[name]} if name in drawn else {}


def _declarers(declared: Train) -> Iterator[tuple[str, int, Any]]:
    """Who declares a friction: a name, a number of its own among them, and what is declared."""
    parts = [(_TRAIN, declared), *((part.name, part) for part in (*declared.gears, *declared.couplings))]
    for item, (name, part) in enumerate(parts):
        yield name, item, part.friction


def _drawn(friction: Any) -> bool:
    return isinstance(friction, CoulombFriction) and friction.deviation is not None and bool(friction.deviation.value)


def _spread(friction: CoulombFriction) -> FrictionSpread:
    assert friction.deviation is not None
    return FrictionSpread(float(friction.sliding.value), float(friction.deviation.value))


def _with_coefficient(friction: CoulombFriction, unit: float) -> CoulombFriction:
    """The friction `unit` deviations off."""
    spread = _spread(friction)
    sliding = max(spread.sliding + unit * spread.deviation, 0.0)
    update: dict[str, Any] = {"sliding": Figure.parse(repr(sliding)), "deviation": None}
    if friction.static is not None and spread.sliding:
        update["static"] = Figure.parse(repr(sliding * float(friction.static.value) / spread.sliding))
    return friction.model_copy(update=update)


# ----------------------------------------------------------------------------------------------------------- the trials


@dataclass(frozen=True)
class TrialFigure(Result):
    """One figure over trials.

    See Also
    --------
    FrictionTrials : holds them.
    """

    KEYS = ("mean", "deviation", "percentiles")

    values: Floats
    """Of the trials in which there is one, in their order."""

    @property
    def mean(self) -> IntervalEstimate:
        """Mean, with its 95 % interval."""
        return mean_of(self.values)

    @property
    def deviation(self) -> IntervalEstimate:
        """Standard deviation, with its 95 % interval."""
        return deviation_of(self.values)

    @property
    def percentiles(self) -> Mapping[float, IntervalEstimate]:
        """Percentiles, each with its 95 % interval; 95 % of the trials lie between the outer two."""
        return percentiles_of(self.values)


@dataclass(frozen=True)
class FrictionTrials(Result):
    """Torque over a turn in many trials of its friction.

    See Also
    --------
    try_frictions : gives it.
    """

    PAGE = "workshop.monte_carlo.friction_trials:trials_document"

    KEYS = ("link", "wanted", "done", "seed", "spreads", *FIGURES, "locks")

    link: str
    """The link whose torque it is."""
    wanted: int
    """Number of trials requested."""
    done: int
    """Number of trials computed."""
    seed: int
    """Of all that was drawn."""
    spreads: Mapping[str, FrictionSpread]
    """By `train` and by pair or coupling, what was drawn."""
    mean: TrialFigure
    """Mean torque of the trials that have one [N m, or plain]."""
    maximum: TrialFigure
    """Greatest torque of the trials that have one [N m, or plain]."""
    starting: TrialFigure
    """Starting torque of the trials that have one [N m, or plain]."""
    efficiency: TrialFigure
    """Energy out over energy in."""
    locks: ProbabilityEstimate
    """How often the train locks somewhere in the run."""

    def _summary(self) -> str:
        cut = "" if self.done == self.wanted else f" of {self.wanted}"
        return f"{self.done}{cut} trials, seed {self.seed}: mean torque at {self.link} {number_text(self.mean.mean, 5)}"

    @property
    def complete(self) -> bool:
        """True if all trials that were asked for are done."""
        return self.done == self.wanted


def try_frictions(plan: FrictionPlan, trials: int, seed: int = 1, means: Execution | None = None) -> FrictionTrials:
    """Torque over a turn, so many times, each with frictions of its own.

    The same for any number of workers, however often it was interrupted and taken up. Interrupted (Ctrl-C), it returns
    the trials that are done.

    Parameters
    ----------
    plan : FrictionPlan
        The train and the run.
    trials : int
        1 to 10^9.
    seed : int
        The same seed draws the same frictions.
    means : Execution, optional
        Executor, journal of finished trials, progress report; by default this process, and none of the others.

    Returns
    -------
    FrictionTrials
        Mean, greatest and starting torque and efficiency with their intervals.

    Raises
    ------
    QuestionError
        For a number of trials that tells nothing, or where the torque is not known at all.

    Examples
    --------
    A pin at 10 mm in a slot 8 mm off: the mean torque is 10 (1 + 0.7 f) (docs/torques.md, equation 18), and so varies
    by 7 times what f does.

    >>> from geartrain import load
    >>> from geartrain.workshop.monte_carlo.friction_trials import find_friction_plan
    >>> plan = find_friction_plan(load('''
    ... links: {frame: {}, a: {}, b: {}}
    ... revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
    ... couplings:
    ...   - {kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm,
    ...      friction: {sliding: 0.3, deviation: 0.05}}
    ... inputs: {a: 1}
    ... loads: {b: -10 N m}
    ... '''), turns=1, samples=100)
    >>> found = try_frictions(plan, trials=20)
    >>> 11.7 < found.mean.mean.value < 12.5 and found.locks.count == 0
    True
    """
    check_trials(trials)
    size = min(_MOST, -(-trials // _TASKS))
    tasks = [[start, min(start + size, trials)] for start in range(0, trials, size)]
    found: list[list[float | None]] = []
    try:
        for rows in (means or Execution()).run(partial(work_frictions, plan, seed), tasks):
            found += rows
    except KeyboardInterrupt:
        if not found:
            raise
    columns = [np.array([value for value in column if value is not None]) for column in zip(*found, strict=True)]
    figures = dict(zip(FIGURES, map(TrialFigure, columns), strict=True))
    locked = sum(row[0] is None for row in found)
    return FrictionTrials(
        _link(plan), trials, len(found), seed, plan.spreads, **figures, locks=ProbabilityEstimate(locked, len(found))
    )


def work_frictions(plan: FrictionPlan, seed: int, task: Sequence[int]) -> list[list[float | None]]:
    """Some trials as plain data: the figures of each, None where the train locks."""
    return [list(plan.follow(draw_friction(plan.declared, seed, trial))) for trial in range(*task)]


def _link(plan: FrictionPlan) -> str:
    """The link whose torque is told; nothing of the run is followed for it."""
    from geartrain.analysis.gear_train import GearTrain

    return plan.of or GearTrain(plan.declared).torques(plan.state).requested[0]


# -------------------------------------------------------------------------------------------------------------- as text


def trials_document(found: FrictionTrials) -> Document:
    """Return the trials as a document."""
    return Document("Torques", (), tuple(trial_sections(found)))


def trial_sections(found: FrictionTrials) -> Iterator[Section]:
    """What of the torque over the run is sure, given what is of friction."""
    lines = [f"{found.done} trials, seed {found.seed}; estimates with the interval that holds with 95 %."]
    if not found.complete:
        lines.insert(0, f"PARTIAL: stopped after {found.done} of {found.wanted} trials.")
    drawn = ", ".join(f"{name} {each.sliding:g} ± {each.deviation:g}" for name, each in found.spreads.items())
    lines.append(f"Drawn from normal distributions, what falls below 0 as 0: {drawn}.")
    if found.locks.count:
        lines.append(f"The train locks in {share_text(found.locks)} of the trials, which have no mean torque.")
    yield Section("Trials of friction", lines, (_figures(found),))


def _figures(found: FrictionTrials) -> Table:
    told = {
        f"mean torque at {found.link}": found.mean,
        "maximum": found.maximum,
        "starting": found.starting,
        "efficiency": found.efficiency,
    }
    rows = [_row(name, figure) for name, figure in told.items() if len(figure.values)]
    return Table(("over the trials", "mean", "deviation", "95 % lie between", "and"), rows)


def _row(name: str, figure: TrialFigure) -> tuple[str, ...]:
    percentiles = figure.percentiles
    low, high = min(percentiles), max(percentiles)
    ends = f"{percentiles[low].value:.5g}", f"{percentiles[high].value:.5g}"
    return (name, number_text(figure.mean, 5), number_text(figure.deviation), *ends)
