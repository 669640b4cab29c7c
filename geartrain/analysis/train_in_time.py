"""The third part of a train that answers: its motion in time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf, tau
from typing import TYPE_CHECKING, Literal

from geartrain.analysis.train_dynamics import TrainDynamics
from geartrain.analysis.train_kinematics import of_planets_as_one
from geartrain.errors import Problem, QuestionError, check_choice, check_numbers, check_whole_numbers

if TYPE_CHECKING:
    from geartrain.dynamics.contacts.train_model import TrainModel
    from geartrain.dynamics.time.stepped_separation import SteppedSeparation
    from geartrain.dynamics.time.stepwise_simulation import Simulation
    from geartrain.dynamics.time.time_run import TimeRun
    from geartrain.dynamics.time.vibration_modes import VibrationModes
    from geartrain.train import StateCase


def _radians_a_second(rate: str | float | None) -> float | None:
    """A rate as it was asked for; None stays None."""
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


class TrainInTime(TrainDynamics):
    """What `GearTrain` knows of motion in time."""

    @of_planets_as_one
    def dynamics(
        self,
        rate: str | float | None = None,
        turns: float = 10.0,
        state: str | None = None,
        *,
        skip: float = 1.0,
        steps: int | None = None,
        restitution: float | None = None,
        outputs: Sequence[str] = (),
        without: Sequence[str] = (),
        samples: int | None = None,
        fast: bool | None = None,
        on_done: Callable[[float], object] = lambda _: None,
        model: Literal["rigid", "compliant"] = "rigid",
    ) -> TimeRun:
        """Motion in time: inertia, play, impacts, drag and friction (docs/dynamics.md).

        Rigid teeth by nonsmooth time stepping; teeth that yield by their stiffness and damping, with peaks of torque
        and dynamic factors in place of impulses.

        Two runs are made, of steps h and h/2; what differs between them is marked, and all else is of the second.

        Parameters
        ----------
        rate : str or float, optional
            Speed of the first input that turns, the way it is declared to, as text such as "1 turn/s" or a number
            [rad/s]; by default the declared drive.
        turns : float
            Turns of that input that are counted, in its mean motion.
        state : str, optional
            A declared state; None only of a train that has none.
        skip : float
            Turns before, which are not counted.
        steps : int, optional
            Steps of the first run in a turn; by default 200 in the shortest period of a pair.
        restitution : float, optional
            Of all impacts, in place of what is declared.
        outputs : sequence of str
            Outputs or links; by default all outputs, and all links of a train without any.
        without : sequence of str
            Pairs left out, so that real teeth do not contradict each other around a loop.
        samples : int, optional
            Samples that are kept; by default 12 in the shortest period of a pair, 40000 at most.
        fast : bool, optional
            Whether kernels are compiled, by the extra `fast`; by default if the run is long and numba is installed.
        on_done : callable
            Called with the share of the work that each stretch adds [0 to 1]. Where it returns True, no more is done,
            and what was found in the first run is told.
        model : {"rigid", "compliant"}
            Whether teeth yield; then each pair that is not to keep its ratio needs a `stiffness`.

        Returns
        -------
        TimeRun
            Angles, speeds, torques, shares of time apart, impacts, energy.

        Raises
        ------
        QuestionError
            If the train does not move, nothing says how fast, a link that can move by itself has no inertia, or nothing
            says how stiff teeth are that are to yield.
        GearTrainError
            If redundant loops have teeth that cannot turn together, or friction locks teeth.
        """
        from geartrain.dynamics.time.time_study import TimeStudy

        check_numbers(turns=turns, skip=skip, restitution=restitution)
        check_whole_numbers(steps=steps, samples=samples)
        check_choice("model", model, ("rigid", "compliant"))
        case = self._case(state)
        seen = self._seen_in_time(case, outputs)
        speed = _radians_a_second(rate)
        found = self._in_time(case, without, speed, restitution, model == "compliant")
        return TimeStudy(found, seen, turns, skip, steps, samples, fast).run(on_done)

    @of_planets_as_one
    def simulation(
        self,
        rate: str | float | None = None,
        state: str | None = None,
        *,
        step: float | None = None,
        restitution: float | None = None,
        outputs: Sequence[str] = (),
        without: Sequence[str] = (),
        fast: bool | None = False,
    ) -> Simulation:
        """A train that moves in time step by step, and may be steered on the way; the steps are those of `dynamics`.

        Parameters
        ----------
        rate, state, restitution, outputs, without
            As of `dynamics`; teeth are rigid.
        step : float, optional
            Length of a step [s]; by default that of the finer run of `dynamics`.
        fast : bool, optional
            Whether kernels are compiled, by the extra `fast`; None: if numba is installed.

        Returns
        -------
        Simulation
            At time 0.

        Raises
        ------
        QuestionError
            As from `dynamics`.
        GearTrainError
            As from `dynamics`.
        """
        from geartrain.dynamics.time.stepwise_simulation import Simulation
        from geartrain.dynamics.time.time_study import TimeStudy
        from geartrain.numerics.kernels import is_fast

        check_numbers(step=step, restitution=restitution)
        if step is not None and not 0 < step < inf:
            raise QuestionError(Problem(f"steps of {step:g} s", "time goes on", "give a length above 0"))
        case = self._case(state)
        seen = self._seen_in_time(case, outputs)
        speed = _radians_a_second(rate)
        found = self._in_time(case, without, speed, restitution, yields=False)
        return Simulation(found, seen, step or TimeStudy(found, seen, 1).plan(2).step, fast=is_fast(fast, inf))

    def _seen_in_time(self, case: StateCase, outputs: Sequence[str]) -> list[tuple[str, str, str]]:
        """What is looked at: its name, the link, and the link from which it is seen."""
        names = outputs or tuple(case.outputs) or tuple(self.declaration.links)
        return [(name, *self._speeds.single_output(case, name)[1]) for name in names]

    @of_planets_as_one
    def stepped_separation(
        self,
        state: str | None = None,
        turns: float = 10.0,
        *,
        steps: int | None = None,
        without: Sequence[str] = (),
        fast: bool | None = None,
        on_done: Callable[[float], object] = lambda _: None,
    ) -> SteppedSeparation:
        """At what rate of the input stepping first parts teeth, beside what `separation_rates` says of as many turns.

        Parameters
        ----------
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
        """
        from geartrain.dynamics.contacts.time_case import PowerInput
        from geartrain.dynamics.inertia.inertial_loads import loads_with_drive
        from geartrain.dynamics.time.stepped_separation import FINE_TABLES, find_stepped_separation
        from geartrain.dynamics.time.time_study import TimeStudy

        check_numbers(turns=turns)
        check_whole_numbers(steps=steps)
        case = self._case(state)
        predicted = self.separation_rates(state, without, turns).rate

        found = self._in_time(case, without, tau * (predicted or 1.0), 0.0, False)
        own = found.case
        # as in the condition: a torque that drives at another link pulls there while the input turns evenly
        load = loads_with_drive(dict(own.load), self.declaration, case, found.problem.speeds)
        drive = own.drive if load == own.load else PowerInput(found.problem.lead, "rate", rate=own.rate)
        found = replace(found, case=replace(own, load=load, drive=drive), tolerance=FINE_TABLES)
        return find_stepped_separation(TimeStudy(found, (), turns, 0.0, steps, fast=fast), predicted, on_done)

    @of_planets_as_one
    def vibration_modes(self, state: str | None = None, *, without: Sequence[str] = ()) -> VibrationModes:
        """Eigenfrequencies and modes of the train about contact, teeth yielding by their stiffness (docs/dynamics.md).

        Parameters
        ----------
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
        """
        from geartrain.dynamics.contacts.yielding_train import YieldingTrain
        from geartrain.dynamics.time.vibration_modes import find_modes

        case = self._case(state)
        found = self._in_time(case, without, None, None, True, scale=1.0)
        assert isinstance(found, YieldingTrain)
        return find_modes(found)

    def _in_time(
        self,
        case: StateCase,
        without: Sequence[str],
        rate: float | None,
        restitution: float | None,
        yields: bool,
        scale: float | None = None,
    ) -> TrainModel:
        """The train as a model of contacts; `rate` (rad/s) and `restitution` in place of what is declared.

        scale   rate (rad/s) where none is declared, for answers that do not depend on it
        """
        from geartrain.dynamics.contacts.time_case import find_time_case
        from geartrain.dynamics.contacts.train_model import TrainModel
        from geartrain.dynamics.contacts.yielding_train import YieldingTrain
        from geartrain.dynamics.inertia.link_inertia import find_link_inertias

        problem = self._moving(case, without)
        if rate is not None:
            rate *= problem.way
        heavy = find_link_inertias(self, case, with_inputs=True)
        inertia = {each.link: each.value for each in heavy if each.value}
        found = find_time_case(self.declaration, case, problem, self.tree, inertia, rate, restitution, scale)
        if yields:
            return YieldingTrain(self.declaration, problem, found, self.tree, case.state, restitution=restitution)
        return TrainModel(self.declaration, problem, found, self.tree, case.state)
