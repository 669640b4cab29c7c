"""Monte Carlo trials of friction: torque over several turns with friction coefficients drawn from their distributions.

A coefficient declared by the train is drawn once per trial for all pairs, or on request separately for each pair. A
coefficient declared by a pair or a coupling is drawn separately. Negative values are set to 0. The ratio of `static` to
`sliding` does not change.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib.metadata import version
from math import sqrt
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.confidence_intervals import (
    IntervalEstimate,
    ProbabilityEstimate,
    deviation_of,
    mean_of,
    percentiles_of,
)
from geartrain.numerics.quantity import Figure, Quantity
from geartrain.numerics.results import Result
from geartrain.numerics.work import Execution
from geartrain.report.document import Document, Section, Table
from geartrain.teeth.contact_coefficients import CoulombFriction
from geartrain.workshop.monte_carlo.monte_carlo_report import number_text, share_text
from geartrain.workshop.monte_carlo.trial_block import BLOCK, FRICTION, PIVOT, RADIUS, RandomStreams
from geartrain.workshop.monte_carlo.trial_run import check_trials

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.coupling import Coupling
    from geartrain.train import GearPair, Train
    from geartrain.train.mechanism import BearingFriction


FIGURES = ("mean", "maximum", "starting", "efficiency")
_TRAIN = "train"
"""Name under which the friction coefficient of the train itself is listed."""

_TASKS = 32  # minimum number of tasks, so that all processes have work until nearly the end
_MOST = 8  # trials of a task: its fixed cost is then smaller than the cost of its trials


# --------------------------------------------------------------------------------------------------------- coefficients


class FrictionSpread(NamedTuple):
    """Normal or uniform distribution of a friction coefficient."""

    sliding: float
    """Declared coefficient of sliding friction, which is the mean of a normal distribution [1]."""
    deviation: float
    """Standard deviation of the coefficient of sliding friction [1]."""
    range: tuple[float, float] | None = None
    """Minimum and maximum of a uniform distribution of the coefficient [1]; None for a normal distribution."""

    def __str__(self) -> str:
        """Return a description of the distribution as text."""
        if self.range is None:
            return f"{self.sliding:g} ± {self.deviation:g}"
        return f"{self.range[0]:g} to {self.range[1]:g} (uniform)"


@dataclass(frozen=True)
class FrictionPlan:
    """Plan of trials with random friction coefficients: the train, and the input positions of each trial.

    Raises `QuestionError` if no friction coefficient of the train has a distribution.

    See Also
    --------
    try_frictions : Run the trials.

    Examples
    --------
    >>> from geartrain import load
    >>> plan = FrictionPlan(load('''
    ... extends: moon-triangular
    ... loads: {moon: -1 N mm}
    ... friction: {sliding: 0.2, deviation: 0.05}
    ... ''').declaration, turns=1)
    >>> plan.spreads
    {'train': FrictionSpread(sliding=0.2, deviation=0.05, range=None)}
    """

    declared: Train
    """Train as declared, without random changes."""
    turns: float
    """Number of turns of the input in a run, above 0."""
    samples: int = 20_000
    """Number of positions of the input in a run, 2 or more."""
    state: str | None = None
    """Name of the state; None for a train without states."""
    of: str | None = None
    """Name of the link whose torque is computed; None for the crank."""

    def __post_init__(self) -> None:
        if not self.spreads:
            why = "each trial draws friction coefficients from declared distributions"
            fix = "declare `friction: {sliding: 0.15, deviation: 0.05}` for the train, a pair or a coupling"
            what = f"'{self.declared.name}' declares no random friction coefficient"
            raise QuestionError(Problem(what, why, fix))

    @property
    def spreads(self) -> Mapping[str, FrictionSpread]:
        """Distributions of the random friction coefficients, keyed by pair, coupling or "train"."""
        return friction_spreads(self.declared)

    def question(self, trials: int, seed: int) -> dict[str, Any]:
        """Return all data on which the results depend. A journal identifies the run by these data.

        Parameters
        ----------
        trials, seed : int
            Number of trials, and random seed.
        """
        made = {"geartrain": version("geartrain"), "numpy": version("numpy")}
        requested = {"state": self.state, "turns": self.turns, "samples": self.samples, "of": self.of}
        train = self.declared.model_dump(mode="json", exclude_defaults=True)
        return {**made, "train": train, **requested, "trials": trials, "seed": seed}


def friction_spreads(declared: Train) -> dict[str, FrictionSpread]:
    """Return the distributions of random friction coefficients, keyed by pair, coupling, "train" or bearing."""
    found = {name: _spread(friction) for name, _, friction in _random_frictions(declared)}
    for name, link in declared.links.items():
        bearing = link.bearing
        if bearing is not None and bearing.coefficient is not None and (bearing.range or bearing.radii):
            low, high = (float(end.value) for end in bearing.range or (bearing.coefficient, bearing.coefficient))
            spread = FrictionSpread(float(bearing.coefficient.value), (high - low) / sqrt(12), (low, high))
            found[f"bearing of {name}"] = spread
    return found


def draw_friction(declared: Train, seed: int, trial: int, per_part: bool = False) -> Train:
    """Return the train with the random friction coefficients of the trial with the index `trial` in a run with `seed`.

    per_part   True if the coefficient that the train declares is drawn separately for each pair
    """
    streams = RandomStreams(seed, trial // BLOCK)
    drawn = {
        name: _with_coefficient(friction, streams.rng(item, FRICTION), trial % BLOCK)
        for name, item, friction in _random_frictions(declared, per_part)
    }
    links = {
        name: link.model_copy(update={"bearing": _drawn_bearing(link.bearing, streams, item, trial % BLOCK, per_part)})
        for item, (name, link) in enumerate(declared.links.items(), 1)
        if link.bearing is not None
    }
    gears = [gear.model_copy(update=_friction_update(gear.name, drawn)) for gear in declared.gears]
    couplings = [joint.model_copy(update=_friction_update(joint.name, drawn)) for joint in declared.couplings]
    parts = {"gears": gears, "couplings": couplings, "links": {**declared.links, **links}}
    return declared.model_copy(update={**_friction_update(_TRAIN, drawn), **parts})


def _drawn_bearing(
    bearing: BearingFriction, streams: RandomStreams, item: int, row: int, per_part: bool
) -> BearingFriction:
    """Return a bearing with the random friction coefficient and the random radius of one trial.

    row        index of the trial among the 256 trials of its block
    item       number of the random stream of the bearing
    per_part   True if a value that several bearings share is random for each bearing
    """

    def between(low: float, high: float, kind: int) -> str:
        shared = not per_part and ("coefficient" if kind == PIVOT else "radius") in bearing.shared
        return repr(float(streams.rng(0 if shared else item, kind).uniform(low, high, BLOCK)[row]))

    update: dict[str, Any] = {}
    if bearing.range is not None:
        low, high = bearing.range
        update |= {"coefficient": Figure.parse(between(float(low.value), float(high.value), PIVOT)), "range": None}
    if bearing.radii is not None:
        length = f"{between(bearing.radii[0].si, bearing.radii[1].si, RADIUS)} m"
        update |= {"radius": Quantity.parse(length, "length", plain=False), "radii": None}
    return bearing.model_copy(update=update)


def _friction_update(name: str, drawn: Mapping[str, CoulombFriction]) -> dict[str, CoulombFriction]:
    return {"friction": drawn[name]} if name in drawn else {}


def _random_frictions(declared: Train, per_part: bool = False) -> Iterator[tuple[str, int, CoulombFriction]]:
    """Yield name, number of the random stream, and friction of each part that declares random friction.

    The parts are the train (number 0), its pairs and its couplings, which are numbered in the order of the declaration.

    per_part   True if a pair without declared friction is also listed, with the friction of the train
    """
    parts: list[tuple[str, Train | GearPair | Coupling]] = [(_TRAIN, declared)]
    parts += [(gear.name, gear) for gear in declared.gears]
    parts += [(coupling.name, coupling) for coupling in declared.couplings]
    of_pairs = declared.friction if per_part else None
    for item, (name, part) in enumerate(parts):
        friction = getattr(part, "friction", None) or (of_pairs if 0 < item <= len(declared.gears) else None)
        if isinstance(friction, CoulombFriction) and friction.is_random:
            yield name, item, friction


def _spread(friction: CoulombFriction) -> FrictionSpread:
    sliding = float(friction.sliding.value)
    if friction.range is not None:
        low, high = (float(end.value) for end in friction.range)
        return FrictionSpread(sliding, (high - low) / sqrt(12), (low, high))
    assert friction.deviation is not None
    return FrictionSpread(sliding, float(friction.deviation.value))


def _with_coefficient(friction: CoulombFriction, rng: np.random.Generator, row: int) -> CoulombFriction:
    """Return the friction with a random coefficient, at least 0; `row` is the index of the trial in its block."""
    spread = _spread(friction)
    # a whole block is drawn, so that a trial does not depend on the trials computed with it
    if spread.range is not None:
        sliding = float(rng.uniform(*spread.range, BLOCK)[row])
    else:
        sliding = max(spread.sliding + float(rng.standard_normal(BLOCK)[row]) * spread.deviation, 0.0)
    update: dict[str, Any] = {"sliding": Figure.parse(repr(sliding)), "deviation": None, "range": None}
    if friction.static is not None and spread.sliding:  # static friction is scaled by the same factor
        update["static"] = Figure.parse(repr(sliding * float(friction.static.value) / spread.sliding))
    return friction.model_copy(update=update)


# --------------------------------------------------------------------------------------------------------------- trials


@dataclass(frozen=True)
class TrialFigure(Result):
    """Distribution of one computed quantity over the trials."""

    KEYS = ("mean", "deviation", "percentiles")

    values: Floats
    """Values of the quantity in the order of the trials, without the trials in which it is undefined."""

    @property
    def mean(self) -> IntervalEstimate:
        """Mean of the quantity, with its 95 % confidence interval."""
        return mean_of(self.values)

    @property
    def deviation(self) -> IntervalEstimate:
        """Standard deviation of the quantity, with its 95 % confidence interval."""
        return deviation_of(self.values)

    @property
    def percentiles(self) -> Mapping[float, IntervalEstimate]:
        """Percentiles of the quantity with 95 % confidence intervals, keyed by percentage. The two outermost
        percentiles enclose 95 % of the values.
        """
        return percentiles_of(self.values)


@dataclass(frozen=True)
class FrictionTrials(Result):
    """Results of trials with random friction coefficients: torque and efficiency over a given number of turns."""

    PAGE = "workshop.monte_carlo.friction_trials:trials_document"

    KEYS = ("link", "wanted", "done", "seed", "spreads", *FIGURES, "locks")

    link: str
    """Name of the link to which the torque refers."""
    wanted: int
    """Number of requested trials."""
    done: int
    """Number of completed trials."""
    seed: int
    """Random seed of the trials."""
    spreads: Mapping[str, FrictionSpread]
    """Distributions of the friction coefficients, keyed by the pair or coupling that declares them, or by "train"."""
    mean: TrialFigure
    """Distribution of the mean torque over the turns of a trial [N m, or the unit of the loads], among trials in which
    the train turns.
    """
    maximum: TrialFigure
    """Distribution of the maximum torque over the turns of a trial [N m, or the unit of the loads], among trials in
    which the train turns.
    """
    starting: TrialFigure
    """Distribution of the starting torque [N m, or the unit of the loads], among trials in which the train turns."""
    efficiency: TrialFigure
    """Distribution of the efficiency, output energy divided by input energy [1], among trials in which it is
    defined.
    """
    locks: ProbabilityEstimate
    """Probability that friction locks the train at one or more of the positions."""

    def _summary(self) -> str:
        cut = "" if self.done == self.wanted else f" of {self.wanted}"
        return f"{self.done}{cut} trials, seed {self.seed}: mean torque at {self.link} {number_text(self.mean.mean, 5)}"

    @property
    def complete(self) -> bool:
        """True if all requested trials are completed."""
        return self.done == self.wanted


def try_frictions(plan: FrictionPlan, trials: int, seed: int = 1, means: Execution | None = None) -> FrictionTrials:
    """Compute the torque over a run in trials with random friction coefficients.

    The result is the same for any number of workers, and for a run that was interrupted and resumed. After an interrupt
    (Ctrl-C), the completed trials are returned.

    Parameters
    ----------
    plan : FrictionPlan
        Train and run of the trials.
    trials : int
        Number of trials, 1 to 10^9.
    seed : int
        Random seed.
    means : Execution, optional
        Executor, journal and progress function; by default this process without journal and progress function.

    Returns
    -------
    FrictionTrials
        Mean, maximum and starting torque and efficiency, with their confidence intervals.

    Raises
    ------
    QuestionError
        If the number of trials is out of range, or if the torque cannot be determined.

    Examples
    --------
    A pin at a radius of 10 mm in a slot with an offset of 8 mm: the mean torque is 10 (1 + 0.7 f) (docs/torques.md,
    equation 18), so it varies by 7 times the spread of f.

    >>> from geartrain import load
    >>> plan = FrictionPlan(load('''
    ... links: {frame: {}, a: {}, b: {}}
    ... revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
    ... couplings:
    ...   - {kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm,
    ...      friction: {sliding: 0.3, deviation: 0.05}}
    ... inputs: {a: 1}
    ... loads: {b: -10 N m}
    ... ''').declaration, turns=1, samples=100)
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
    # locked trials have no values
    columns = [np.array([value for value in column if value is not None]) for column in zip(*found, strict=True)]
    figures = dict(zip(FIGURES, map(TrialFigure, columns), strict=True))
    locks = ProbabilityEstimate(sum(row[0] is None for row in found), len(found))
    link = plan.of or GearTrain(plan.declared).torques(plan.state).requested[0]
    return FrictionTrials(link, trials, len(found), seed, plan.spreads, **figures, locks=locks)


def work_frictions(plan: FrictionPlan, seed: int, task: Sequence[int]) -> list[list[float | None]]:
    """Return mean, maximum and starting torque, and efficiency, of trials in range(*task); None if undefined."""
    rows = []
    for trial in range(*task):
        drawn = GearTrain(draw_friction(plan.declared, seed, trial))
        found = drawn.torques(plan.state, turns=plan.turns, samples=plan.samples, of=plan.of)
        if found.turns is None:
            what = "the torque cannot be determined"
            fix = "declare `loads: {LINK: -1 N m}`, or the `bearing` friction of a link"
            raise QuestionError(Problem(what, found.verdict.text, fix))
        rows.append([found.mean, found.maximum_torque, found.starting_torque, found.efficiency])
    return rows


# -------------------------------------------------------------------------------------------------------------- as text


def trials_document(found: FrictionTrials) -> Document:
    """Return the report on trials with random friction coefficients."""
    return Document("Torques", (), tuple(trial_sections(found)))


def trial_sections(found: FrictionTrials) -> Iterator[Section]:
    """Yield the report sections that describe the distribution of torques due to uncertain friction."""
    lines = [f"{found.done} trials, seed {found.seed}; estimates with their 95 % confidence intervals."]
    if not found.complete:
        lines.insert(0, f"PARTIAL: stopped after {found.done} of {found.wanted} trials.")
    drawn = ", ".join(f"{name} {each}" for name, each in found.spreads.items())
    lines.append(f"Drawn from normal or uniform distributions, negative values set to 0: {drawn}.")
    if found.locks.count:
        lines.append(f"The train locks in {share_text(found.locks)} of the trials. These are not included below.")
    rows = []
    for name in FIGURES:
        figure: TrialFigure = getattr(found, name)
        if len(figure.values):
            ends = (f"{figure.percentiles[percent].value:.5g}" for percent in (2.5, 97.5))
            label = f"mean torque at {found.link}" if name == "mean" else name
            rows.append((label, number_text(figure.mean, 5), number_text(figure.deviation), *ends))
    table = Table(("over all trials", "mean", "standard deviation", "2.5 %", "97.5 %"), rows)
    yield Section("Trials of friction", lines, (table,))
