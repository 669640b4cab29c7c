"""A train and how it is driven in time: its runs, its steps one by one, its separation by steps, its modes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf, tau
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np

from geartrain.dynamics.motion.motion_problem import find_motion_problem
from geartrain.errors import Problem, QuestionError, check_choice, check_numbers, check_whole_numbers
from geartrain.numerics.labelled_array import labelled_array
from geartrain.numerics.results import Result, Tabular
from geartrain.simulation.contacts.link_inertia import find_link_inertias
from geartrain.simulation.contacts.time_case import PowerInput, find_time_case
from geartrain.simulation.contacts.train_model import TrainModel
from geartrain.simulation.contacts.yielding_train import YieldingTrain
from geartrain.simulation.time.time_study import TimeStudy

if TYPE_CHECKING:
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.labelled_array import LabelledArray
    from geartrain.simulation.time.stepped_separation import SteppedSeparation
    from geartrain.simulation.time.stepwise_simulation import Simulation


@dataclass(frozen=True)
class DrivenTrain:
    """A train, and how it is driven in time. Equal planets are taken as one."""

    train: TrainMechanics
    state: str | None = None
    rate: str | float | None = None
    """Of the first input that turns, as text or in rad/s; None for the declared drive."""
    restitution: float | None = None
    """Of all impacts, in place of what is declared."""
    outputs: Sequence[str] = ()
    """What is recorded: outputs or links; by default all outputs, and all links of a train without any."""
    without: Sequence[str] = ()
    """Pairs left out."""

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
        """Two runs over some turns: see `GearTrain.dynamics`."""
        check_numbers(turns=turns, skip=skip, restitution=self.restitution)
        check_whole_numbers(steps=steps, samples=samples)
        check_choice("model", model, ("rigid", "compliant"))
        seen, found = self._seen(), self._model(radians_per_second(self.rate), model == "compliant")
        return TimeStudy(found, seen, turns, skip, steps, samples, fast)

    def simulation(self, step: float | None, fast: bool | None) -> Simulation:
        """The train at time 0, to be moved step by step: see `GearTrain.simulation`."""
        from geartrain.numerics.kernels import is_fast
        from geartrain.simulation.time.stepwise_simulation import Simulation

        check_numbers(step=step, restitution=self.restitution)
        if step is not None and not 0 < step < inf:
            raise QuestionError(Problem(f"steps of {step:g} s", "time goes on", "give a length above 0"))
        seen, found = self._seen(), self._model(radians_per_second(self.rate))
        return Simulation(found, seen, step or TimeStudy(found, seen, 1).plan(2).step, fast=is_fast(fast, inf))

    def _seen(self) -> list[tuple[str, str, str]]:
        """What is recorded: its name, the link, and the link from which it is seen."""
        own = self.train.planets_as_one.kinematics
        return [(name, *links) for name, links in own.seen_links(self.state, self.outputs).items()]

    def _model(self, rate: float | None, yields: bool = False) -> TrainModel:
        return model_in_time(self.train, self.state, self.without, rate, self.restitution, yields)


def model_in_time(
    train: TrainMechanics,
    state: str | None,
    without: Sequence[str],
    rate: float | None,
    restitution: float | None,
    yields: bool = False,
    scale: float | None = None,
) -> TrainModel:
    """The train as a model of contacts; `rate` (rad/s) and `restitution` in place of what is declared.

    scale   rate (rad/s) where none is declared, for answers that do not depend on it
    """
    train = train.planets_as_one
    declared, case, problem = (
        train.declaration,
        train.kinematics.case(state),
        find_motion_problem(train, state, without),
    )
    if rate is not None:
        rate *= problem.way
    inertia = {each.link: each.value for each in find_link_inertias(train, state, with_inputs=True) if each.value}
    found = find_time_case(declared, case, problem, train.tree, inertia, rate, restitution, scale)
    if yields:
        return YieldingTrain(declared, problem, found, train.tree, case.state, restitution=restitution)
    return TrainModel(declared, problem, found, train.tree, case.state)


def find_vibration_modes(
    train: TrainMechanics, state: str | None = None, *, without: Sequence[str] = ()
) -> VibrationModes:
    """Eigenfrequencies and modes of the train about contact, teeth yielding by their stiffness (docs/dynamics.md).

    Parameters
    ----------
    train : TrainMechanics
        `GearTrain.mechanics`.
    state : str, optional
        A declared state; None only of a train that has none.
    without : sequence of str
        Pairs left out.

    Returns
    -------
    VibrationModes
        Frequencies, damping and shapes.

    Raises
    ------
    QuestionError
        If the train does not move, a link that can move by itself has no inertia, nothing says how stiff teeth are
        that are to yield, or nothing can swing.

    Examples
    --------
    A disc of 1e-6 kg m2 that swings on teeth of 20 N m/rad, sqrt(k/J)/2 pi:

    >>> import geartrain
    >>> wheels = {"links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 30},
    ...     "inertia": "1e-6 kg m2"}}, "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"],
    ...     "axis": "B"}], "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1}, "stiffness": "20 N m/rad"}
    >>> train = geartrain.GearTrain.declare(wheels)
    >>> find_vibration_modes(train.mechanics).frequencies.round(3).tolist()
    [711.763]
    """
    found = model_in_time(train, state, without, None, None, yields=True, scale=1.0)
    assert isinstance(found, YieldingTrain)
    return find_modes(found)


def step_to_separation(
    train: TrainMechanics,
    state: str | None = None,
    turns: float = 10.0,
    *,
    steps: int | None = None,
    without: Sequence[str] = (),
    fast: bool | None = None,
    on_done: Callable[[float], object] = lambda _: None,
) -> SteppedSeparation:
    """The rate of the input at which stepping first parts teeth, to compare with `find_separation` over as many turns.

    Parameters
    ----------
    train : TrainMechanics
        `GearTrain.mechanics`.
    state : str, optional
        A declared state; None only of a train that has none.
    turns : float
        Turns of the input from the start.
    steps : int, optional
        Steps in a turn; by default 200 in the shortest period of a pair.
    without : sequence of str
        Pairs left out.
    fast : bool, optional
        Whether kernels are compiled; by default if the run is long and numba is installed.
    on_done : callable
        Called with the share of the work that is done; where it returns True, what is known so far is given back.

    Returns
    -------
    SteppedSeparation
        The rate, with its error, by steps that are made ever shorter where pairs carry least.

    Raises
    ------
    QuestionError
        If by the condition for it teeth part at any rate or at none, or the train cannot be stepped.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load('''
    ... links: {frame: {}, a: {wheels: {p: 24}}, b: {wheels: {q: 36}, inertia: 1 kg mm2}}
    ... revolutes: {A: [frame, a], B: [frame, b]}
    ... gears: [p ~ q]
    ... tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
    ... friction: 0.1
    ... loads: {b: -1 N mm}
    ... inputs: {a: 1 rpm}
    ... ''')
    >>> found = step_to_separation(train.mechanics, turns=0.05, steps=500)
    >>> found.pair, round(found.rate, 3)
    ('p~q', 4.47)
    """
    from geartrain.simulation.contacts.inertial_contacts import loads_with_drive
    from geartrain.simulation.contacts.separation_rate import find_separation
    from geartrain.simulation.time.stepped_separation import FINE_TABLES, find_stepped_separation

    check_numbers(turns=turns)
    check_whole_numbers(steps=steps)
    train = train.planets_as_one
    predicted = find_separation(train, state, without, turns).rate
    found = model_in_time(train, state, without, tau * (predicted or 1.0), 0.0)
    own = found.case
    # as in the condition: a torque that drives at another link pulls there while the input turns evenly
    load = loads_with_drive(dict(own.load), train.declaration, train.kinematics.case(state), found.problem.speeds)
    drive = own.drive if load == own.load else PowerInput(found.problem.driving_link, "rate", rate=own.rate)
    found = replace(found, case=replace(own, load=load, drive=drive), tolerance=FINE_TABLES)
    return find_stepped_separation(TimeStudy(found, (), turns, 0.0, steps, fast=fast), predicted, on_done)


def radians_per_second(rate: str | float | None) -> float | None:
    """A rate in rad/s, as it is given; None stays None."""
    from pydantic_core import PydanticCustomError

    from geartrain.numerics.quantity import Quantity

    if isinstance(rate, str):
        try:
            rate = Quantity.parse(rate, "speed", plain=True).si
        except PydanticCustomError as error:
            raise QuestionError(Problem(f"rate: {error.message()}", "", "give one such as '1 turn/s'")) from None
    check_numbers(rate=rate)
    if rate is not None and not 0 < rate < inf:
        why = "a train turns the way its inputs are declared to"
        raise QuestionError(
            Problem(f"a rate of {rate:g} rad/s", why, "give one above 0, or declare inputs the other way")
        )
    return rate


# --------------------------------------------------------------------------------------------------- modes of vibration


@dataclass(frozen=True)
class VibrationModes(Tabular, Result):
    """How a train swings about contact: what solves K phi = w^2 M phi, speed ratios at their means.

    See Also
    --------
    geartrain.simulation.find_vibration_modes : gives these.
    """

    MEANINGS: ClassVar = {
        "mode": "Number of the mode, in the order of frequencies.",
        "frequency": "Natural frequency of the mode [Hz].",
        "* angle": "Angle of the link, the greatest of each mode 1.",
    }

    train: str
    """Its name."""
    frequencies: Floats
    """Rising [Hz]; 0 where the train turns as a whole and nothing prescribes its speed. Shape (mode,)."""
    damping: Floats
    """Ratio to the critical, of each mode by itself; 0 at 0 Hz. Shape (mode,)."""
    shapes: LabelledArray
    """Angles of links, the greatest of each mode 1. Shape (link, mode)."""
    stiffness: dict[str, float]
    """Of each pair, on its driven side [N m/rad]."""
    notes: tuple[str, ...]
    """What is left out."""
    assumed: tuple[str, ...]
    """What nothing declares and was estimated."""

    def _summary(self) -> str:
        shown = ", ".join(f"{each:.4g}" for each in self.frequencies[:4])
        return f"{self.train}: {len(self.frequencies)} modes, {shown}{' ...' * (len(self.frequencies) > 4)} Hz"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each mode: number, frequency, damping, and the angles of links."""
        angles = zip(self.shapes.labels[0], self.shapes.values.tolist(), strict=True)
        return {
            "mode": [*range(1, len(self.frequencies) + 1)],
            "frequency": self.frequencies.tolist(),
            "damping": self.damping.tolist(),
            **{f"{link} angle": row for link, row in angles},
        }


def find_modes(of: YieldingTrain) -> VibrationModes:
    """Of a train in one case."""
    squares, modes = of.vibration
    speeds = np.sqrt(squares)
    losses = np.einsum("im,ij,jm->m", modes, of.matrices[1], modes)
    damping = np.divide(losses, 2 * speeds, out=np.zeros_like(speeds), where=speeds > 0)
    shapes = of.speeds[:, of.free] @ modes
    for column in shapes.T:
        column /= column[np.argmax(np.abs(column))]
    shapes += 0.0  # no zero is negative
    names = [str(at + 1) for at in range(len(speeds))]
    stiffness = {pair.name: float(k) for pair, k in zip(of.model.pairs, of.yields.stiffness, strict=True)}
    frequencies = speeds / tau
    frequencies.flags.writeable = damping.flags.writeable = False
    links = of.problem.system.links
    return VibrationModes(
        of.train.name,
        frequencies,
        damping,
        labelled_array(shapes, link=links, mode=names),
        stiffness,
        of.notes,
        of.assumed,
    )
