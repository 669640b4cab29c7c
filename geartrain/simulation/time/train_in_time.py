"""Entry points of the time-domain simulation: comparison of two runs with time steps h and h/2, step-by-step
simulation, and vibration modes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil, inf, tau
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np

from geartrain.dynamics.motion.motion_problem import find_motion_problem
from geartrain.dynamics.torques.bearing_loads import BearingLoads
from geartrain.errors import Problem, QuestionError, check_choice, check_numbers, check_whole_numbers
from geartrain.numerics.kernels import is_fast
from geartrain.numerics.labelled_array import labelled_array
from geartrain.numerics.results import Result, Tabular
from geartrain.simulation.contacts.bearing_forces import BearingForces
from geartrain.simulation.contacts.compliant_train import CompliantTrain
from geartrain.simulation.contacts.link_inertia import find_link_inertias
from geartrain.simulation.contacts.time_case import find_time_case
from geartrain.simulation.contacts.train_model import TrainModel
from geartrain.simulation.steps.simulation import StepPlan, simulate
from geartrain.simulation.time.run_figures import RunFigures
from geartrain.simulation.time.time_run import TimeRun

if TYPE_CHECKING:
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.labelled_array import LabelledArray
    from geartrain.simulation.time.stepwise_simulation import Simulation

PER_TOOTH = 200
"""Number of time steps in the shortest tooth-passing period, in the run with the longer steps."""
PER_SWING = 40
"""Number of time steps in the period of the fastest vibration mode of compliant teeth."""
_UNEVEN = 1.00618  # steps that meet a kink at every tooth would be evaluated on either side of it due to rounding
_FEWEST = 200  # minimum steps per revolution of the driving link
_FEWEST_TOUCHING = 1000  # the same with contacts: a pin's speed may change much within a small angle
_PER_BEAT = 1000  # steps between two beats of an escapement
_PER_FALL = 16  # steps of the motion between two stops of an escapement; a train at rest is not stepped
_MOST_FALLING = 300_000_000  # maximum number of steps of a run that are shortened for that
_SAMPLES = 12  # samples in the shortest tooth-passing period
_A_BEAT = 50  # samples between two beats of an escapement
_MOST_SAMPLES = 40_000
_FEWEST_SAMPLES = 500  # minimum samples of a run: the skipped part must be a whole number of samples
_MOST_STEPS = 2_000_000_000
_MOST_BLOCKS = 20  # maximum number of batches of whole revolutions
_MASSLESS = 1e-6  # factor of all inertias: a train this light is quasi-static
_SLOW = 7e-5  # time of one step of one contact in plain Python [s]


@dataclass(frozen=True)
class DrivenTrain:
    """Train with its drive for time-domain simulation. Equal planets are combined into one."""

    train: TrainMechanics
    state: str | None = None
    rate: str | float | None = None
    """Speed of the first input that turns, as text with a unit or as a number in rad/s; None for the declared drive."""
    restitution: float | None = None
    """Coefficient of restitution of every impact; None for the declared values."""
    outputs: Sequence[str] = ()
    """Names of the outputs or links to record; by default all outputs, or all links of a train without outputs."""
    without: Sequence[str] = ()
    """Names of pairs to omit from the simulation."""

    def study(
        self,
        model: Literal["rigid", "compliant"],
        turns: float,
        skip: float,
        *,
        steps: int | None = None,
        samples: int | None = None,
        fast: bool | None = None,
    ) -> TimeStudy:
        """Return two runs over `turns` revolutions of the driving link, as described in `GearTrain.dynamics`."""
        check_numbers(turns=turns, skip=skip, restitution=self.restitution)
        check_whole_numbers(steps=steps, samples=samples)
        check_choice("model", model, ("rigid", "compliant"))
        return TimeStudy(*self._model(model == "compliant"), turns, skip, steps, samples, fast)

    def simulation(self, step: float | None, fast: bool | None) -> Simulation:
        """Return a simulation of the train that starts at time 0, as described in `GearTrain.simulation`."""
        from geartrain.simulation.time.stepwise_simulation import Simulation

        check_numbers(step=step, restitution=self.restitution)
        found, seen = self._model()
        step = TimeStudy(found, seen, 1).plan(2).step if step is None else step
        return Simulation(found, seen, step, fast=is_fast(fast, inf))

    def _model(self, yields: bool = False) -> tuple[TrainModel, list[tuple[str, str, str]]]:
        """Return the contact model of the train, and the name, link and reference link of each recorded output.
        `yields` is True for compliant teeth, False for rigid teeth.
        """
        seen = self.train.planets_as_one.kinematics.seen_links(self.state, self.outputs)
        rate = radians_per_second(self.rate)
        found = model_in_time(self.train, self.state, self.without, rate, self.restitution, yields)
        return found, [(name, *links) for name, links in seen.items()]


def model_in_time(
    train: TrainMechanics,
    state: str | None,
    without: Sequence[str],
    rate: float | None,
    restitution: float | None,
    yields: bool = False,
    scale: float | None = None,
) -> TrainModel:
    """Return the contact model of a train. The arguments `rate` [rad/s] and `restitution` replace the declared values.

    yields  True for compliant teeth, False for rigid teeth
    scale   input speed that is assumed if none is declared, for results that do not depend on it [rad/s]
    """
    # vibration modes, for which no rate is needed, do not depend on friction
    rubs = scale is None and any(part.friction_radius for part in train.declaration.links.values())
    setting = train.unfolded.load_case(state) if rubs else None
    train = train.planets_as_one
    declared, case = train.declaration, train.kinematics.case(state)
    problem = find_motion_problem(train, state, without)
    if case.one_way:
        names = ", ".join(each.name for each in case.one_way)
        what = f"the simulation in time does not include the one-way clutches {names}"
        why = "a one-way clutch engages and disengages during the motion"
        fix = "disable them with `free` in a state, or declare clutches that lock in both directions"
        raise QuestionError(Problem(what, why, fix, declared.place("clutches")))
    if rate is not None:
        # a given rate is positive; the sense follows from the declared inputs
        rate *= problem.way
    inertia = {each.link: each.value for each in find_link_inertias(train, state, with_inputs=True) if each.value}
    found = find_time_case(declared, case, problem, train.tree, inertia, rate, restitution, scale)
    forces = None if setting is None else BearingForces(declared, problem, found.drive, BearingLoads(setting))
    if yields:
        return CompliantTrain(declared, problem, found, train.tree, case.state, forces, restitution)
    return TrainModel(declared, problem, found, train.tree, case.state, forces)


def find_vibration_modes(
    train: TrainMechanics, state: str | None = None, *, without: Sequence[str] = ()
) -> VibrationModes:
    """Return natural frequencies and vibration modes of a train with compliant teeth in contact (docs/dynamics.md).

    Parameters
    ----------
    train : TrainMechanics
        Mechanics of the train, from `GearTrain.mechanics`.
    state : str, optional
        Name of a declared state; None only for a train that has no states.
    without : sequence of str
        Names of pairs to ignore.

    Returns
    -------
    VibrationModes
        Natural frequencies, damping ratios and mode shapes.

    Raises
    ------
    QuestionError
        If the train does not move, a link that can move by itself has no inertia, the stiffness of a pair is not
        known, or the train cannot vibrate.

    Examples
    --------
    A disc with J = 1e-6 kg m2 vibrates on teeth with k = 20 N m/rad at the frequency sqrt(k/J) / (2 pi):

    >>> import geartrain
    >>> wheels = {"links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 30},
    ...     "inertia": "1e-6 kg m2"}}, "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"],
    ...     "axis": "B"}], "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1}, "stiffness": "20 N m/rad"}
    >>> train = geartrain.GearTrain.declare(wheels)
    >>> find_vibration_modes(train.mechanics).frequencies.round(3).tolist()
    [711.763]
    """
    found = model_in_time(train, state, without, None, None, yields=True, scale=1.0)
    assert isinstance(found, CompliantTrain)
    squares, modes = found.vibration
    speeds = np.sqrt(squares)
    # damping ratio of each mode, neglecting coupling of modes by damping
    losses = np.einsum("im,ij,jm->m", modes, found.matrices[1], modes)
    damping = np.divide(losses, 2 * speeds, out=np.zeros_like(speeds), where=speeds > 0)
    shapes = found.speeds[:, found.free] @ modes
    for column in shapes.T:
        # the largest angle becomes +1, which fixes scale and sign
        column /= column[np.argmax(np.abs(column))]
    shapes += 0.0  # turns -0.0 into 0.0
    frequencies = speeds / tau
    frequencies.flags.writeable = damping.flags.writeable = False
    return VibrationModes(
        found.train.name,
        frequencies,
        damping,
        labelled_array(shapes, link=found.problem.system.links, mode=[str(at + 1) for at in range(len(speeds))]),
        {pair.name: float(k) for pair, k in zip(found.model.pairs, found.yields.stiffness, strict=True)},
        found.notes,
        found.assumed,
    )


def radians_per_second(rate: str | float | None) -> float | None:
    """Return an input speed converted to rad/s, or None if no speed is given.

    Raises `QuestionError` if the speed is not positive.
    """
    from pydantic_core import PydanticCustomError

    from geartrain.numerics.quantity import Quantity

    if isinstance(rate, str):
        try:
            rate = Quantity.parse(rate, "speed", plain=True).si
        except PydanticCustomError as error:
            why = "a rate is a number with a unit"
            raise QuestionError(Problem(f"rate: {error.message()}", why, "for example, write '1 turn/s'")) from None
    check_numbers(rate=rate)
    if rate is not None and not 0 < rate < inf:
        why = "a rate is positive, because the sense of rotation follows from the declared inputs"
        what = f"a rate of {rate:g} rad/s is out of range"
        raise QuestionError(Problem(what, why, "give a rate above 0, or change the sign of the inputs"))
    return rate


# --------------------------------------------------------------------------------------------------- modes of vibration


@dataclass(frozen=True)
class VibrationModes(Tabular, Result):
    """Vibration modes of a train with its flanks in contact, at mean speed ratios.

    The mode shapes phi and angular frequencies w are solutions of K phi = w^2 M phi, with the stiffness matrix K and
    the mass matrix M.
    """

    MEANINGS: ClassVar = {
        "mode": "Number of the mode, in the order of frequencies.",
        "frequency": "Natural frequency of the mode [Hz].",
        "* angle": "Angle of the link, normalised to a maximum of 1 in each mode.",
    }

    train: str
    """Name of the train."""
    frequencies: Floats
    """Natural frequencies in ascending order [Hz]; 0 for modes in which the whole train rotates freely. Shape
    (mode,).
    """
    damping: Floats
    """Damping ratio of each mode; 0 for modes of 0 Hz. Shape (mode,)."""
    shapes: LabelledArray
    """Mode shapes: angle amplitudes of the links, normalised to a maximum of 1 in each mode. Shape (link, mode)."""
    stiffness: dict[str, float]
    """Torsional stiffness of each pair about the axis of its driven side [N m/rad]."""
    notes: tuple[str, ...]
    """Descriptions of the effects that the analysis neglects."""
    assumed: tuple[str, ...]
    """Descriptions of the estimates that were used for undeclared quantities."""

    def _summary(self) -> str:
        shown = ", ".join(f"{each:.4g}" for each in self.frequencies[:4])
        return f"{self.train}: {len(self.frequencies)} modes, {shown}{' ...' * (len(self.frequencies) > 4)} Hz"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with a row for each mode: number, frequency, damping ratio, angles of links."""
        angles = zip(self.shapes.labels[0], self.shapes.values.tolist(), strict=True)
        return {
            "mode": [*range(1, len(self.frequencies) + 1)],
            "frequency": self.frequencies.tolist(),
            "damping": self.damping.tolist(),
            **{f"{link} angle": row for link, row in angles},
        }


@dataclass(frozen=True)
class TimeStudy:
    """Time-domain simulation of a train by two runs, the second with half the time step of the first."""

    of: TrainModel
    outputs: Sequence[tuple[str, str, str]]
    turns: float
    """Number of revolutions of the driving link in the evaluated part of a run."""
    skip: float = 1.0
    """Number of revolutions of the driving link before the evaluated part of a run."""
    steps: int | None = None
    """Number of steps per revolution of the driving link in the run with the longer time step; None to derive it from
    the tooth-passing periods.
    """
    samples: int | None = None
    """Number of samples of the whole run; None to choose a number that is suitable for spectra."""
    fast: bool | None = None
    """True to compile the kernels, False to run them in Python; None to choose according to the amount of work."""

    def __post_init__(self) -> None:
        if not self.turns > 0 or not self.skip >= 0:
            what = f"turns = {self.turns:g} or skip = {self.skip:g} is out of range"
            why = "turns must be above 0, and skip 0 or more"
            raise QuestionError(Problem(what, why, "for example, pass turns=10, skip=1"))
        if self.steps is not None and self.steps < 1:
            what = f"{self.steps} steps per revolution are too few"
            why = "at least 1 step per revolution is required"
            raise QuestionError(Problem(what, why, "for example, pass steps=200"))
        if self.per_turn * (self.turns + self.skip) > _MOST_STEPS:
            what = f"the run would take {self.per_turn * (self.turns + self.skip):.3g} steps"
            why = f"the maximum is {_MOST_STEPS:.0e} steps, which take days"
            raise QuestionError(Problem(what, why, "give fewer turns or steps"))

    @cached_property
    def busiest(self) -> float:
        """Maximum number of tooth-passing periods of a pair per revolution of the driving link, 1 or more."""
        return max([1.0, *(float(source.cycles) for source in self.of.sources.values())])

    @cached_property
    def per_turn(self) -> int:
        """Number of steps per revolution of the driving link in the run with the longer time step."""
        if self.steps is not None:
            return self.steps
        fewest = _FEWEST_TOUCHING if self.of.model.pairs else _FEWEST
        found = max(fewest, ceil(PER_TOOTH * self.busiest * _UNEVEN))
        # a released escape wheel moves much faster than on average
        # the fastest mode must be resolved even if it is not excited by teeth
        swing = ceil(PER_SWING * self.of.fastest / abs(self.of.case.rate))
        found = max([found, swing, *(ceil(_PER_BEAT * each) for each in self.beats)])
        # a multiple, so that samples still coincide with beats
        falls = (_PER_FALL * tau / abs(self.of.case.rate) / each / found for each in self.of.model.fall_times)
        most = int(_MOST_FALLING / found / (self.turns + self.skip))
        return found * max(1, min(most, ceil(max(falls, default=1.0))))

    @property
    def beats(self) -> list[float]:
        """Number of beats of each escapement per revolution of the driving link."""
        return [tau / abs(self.of.case.rate) / beat for _, beat in self.of.case.escapements.values()]

    def plan(self, finer: int) -> StepPlan:
        """Return the number and length of the time steps of one run. `finer` is the number of parts, 1 or 2, into which
        each time step h of the study is divided.
        """
        # the finer run has exactly twice the steps
        steps, skip = (round(each * self.per_turn) * finer for each in (self.turns, self.skip))
        often = max([_SAMPLES * self.busiest, *(_A_BEAT * each for each in self.beats)])
        samples = self.samples or min(_MOST_SAMPLES, max(_FEWEST_SAMPLES, ceil(often * (self.turns + self.skip))))
        stride = max(1, (steps + skip) // finer // max(samples, 2)) * finer
        # counting begins at a sample
        skip -= skip % stride
        # a block ends at a sample, so it may differ from whole revolutions by at most one sample
        block = round(ceil(self.turns / _MOST_BLOCKS) * self.per_turn * finer / stride) * stride
        return StepPlan(tau / abs(self.of.case.rate) / self.per_turn / finer, skip, steps, stride, block)

    @property
    def is_fast(self) -> bool:
        """True if the kernels are compiled for both runs."""
        steps = sum(plan.skip + plan.steps for plan in (self.plan(1), self.plan(2)))
        return is_fast(self.fast, steps * max(len(self.of.model.pairs), 1) * _SLOW)

    def run(self, on_done: Callable[[float], object] = lambda _: None) -> TimeRun:
        """Return the results of the two simulated runs.

        on_done   function that is called with the fraction of the total work since its last call; if it returns True,
                  the result covers the completed part of the first run, without a comparison

        Raises `KeyboardInterrupt` if `on_done` returns True before the evaluated part begins.
        """
        plans = self.plan(1), self.plan(2)
        whole = sum(plan.skip + plan.steps for plan in plans)
        fast, peaks = self.is_fast, self.static_peaks()

        def run(plan: StepPlan) -> RunFigures:
            done = simulate(self.of.model, plan, fast, lambda steps: on_done(steps / whole), self.of.yields)
            return RunFigures(self.of, self.outputs, done, peaks)

        first = run(plans[0])
        if not first.plan.steps:
            raise KeyboardInterrupt
        if first.plan.steps == plans[0].steps:
            second = run(plans[1])
            if second.plan.steps == plans[1].steps:
                return second.result(first)
        return first.result(None)

    def static_peaks(self) -> Sequence[float | None]:
        """Return the maximum quasi-static torque of each pair with compliant teeth [N m]; None if the teeth are rigid,
        or if no speed is prescribed, because the train would accelerate without limit.

        The torques are computed in a separate run with rigid teeth and almost no inertia.
        """
        model = self.of.model
        if self.of.yields is None or self.of.case.drive.kind != "rate":
            return [None] * len(model.pairs)
        steps = max(_FEWEST, ceil(PER_TOOTH * self.busiest))
        plan = StepPlan(tau / abs(self.of.case.rate) / steps, round(self.skip * steps), round(self.turns * steps), 1)
        # nearly without inertia a rigid train is quasi-static
        run = simulate(replace(model, mass=_MASSLESS * model.mass), plan, self.is_fast)
        return [float(each) for each in np.abs(run.forces[plan.skip :]).max(axis=0, initial=0.0)]
