"""A train in time that goes on as far as it is asked to, and whose drive and loads may change on the way."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import floor, inf
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError, suggest
from geartrain.numerics.results import Shown
from geartrain.simulation.steps.contact_solution import IMPACT_ENERGY, TIME_APART, UNSOLVED, RunRecord
from geartrain.simulation.steps.simulation import (
    StepPlan,
    check_convergence,
    empty_equations,
    empty_record,
    start_state,
    step_rules,
)
from geartrain.simulation.steps.time_steps import run_steps

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.simulation.contacts.train_model import TrainModel

_EARLY = 1e-6  # of a step: a time that is so little before the end of one counts as that


class Simulation(Shown):
    """A train that moves in time while others look on, and act on it.

    Steps have one length throughout, whatever times are asked for: between two of them angles go on evenly, so that the
    course does not depend on where it is looked at.

    Attributes
    ----------
    time : float
        How far it has come [s].
    step : float
        Length of a step [s].
    drive_link, drive_kind : str
        Where power enters, and how: "rate", "torque", "spring" or "hand".
    drive : float
        What drives: the speed of that link, or of the hand [rad/s]; the torque [N m].
    loads : dict of str to float
        Torques on links that are declared or were given [N m].
    restitution : dict of str to float
        By pair, pin and escapement.
    torque : float
        Of the drive, the way its link turns; mean of the last advance [N m].
    torques, apart, impact_energy : dict of str to float
        By pair, pin and escapement, over the last advance: mean torque on the driven side [N m], share of time in which
        no flank touches, energy that blows took [J].
    unsolved : int
        Steps in which no consistent set of contacts was found.

    See Also
    --------
    geartrain.GearTrain.simulation : makes it.
    geartrain.GearTrain.dynamics : a whole run, with its account.

    Examples
    --------
    >>> import geartrain
    >>> moon = geartrain.load("moon-triangular-inertia").simulation(rate="1 turn/s", step=1e-3)
    >>> moon.advance(0.1)
    >>> round(moon.time, 3), sorted(moon.angles)
    (0.1, ['moon', 'sun'])
    >>> moon.set_drive(0.0)
    """

    def __init__(
        self,
        of: TrainModel,
        outputs: Sequence[tuple[str, str, str]],
        step: float,
        fast: bool = False,
        restitution: Mapping[str, float] | None = None,
        drive: float | None = None,
        loads: Mapping[str, float] | None = None,
    ) -> None:
        self._of, self._outputs, self._fast = of, tuple(outputs), fast
        self.step = step
        self.drive_link, self.drive_kind = of.case.drive.link, of.case.drive.kind
        self.drive = of.case.drive.value if drive is None else drive
        self.loads = dict(of.case.load if loads is None else loads)
        model = of.model
        if restitution is not None:
            pairs = tuple(replace(each, restitution=restitution[each.name]) for each in model.pairs)
            stops = tuple(replace(each, restitution=restitution[each.name]) for each in model.stops)
            model = replace(model, pairs=pairs, stops=stops)
        if self.drive_kind == "rate":
            model = replace(model, given={at: speed * self._share for at, speed in model.given.items()})
        self.restitution = {pair.name: pair.restitution for pair in model.pairs}
        self.restitution |= {stop.name: stop.restitution for stop in model.stops}
        self._model = model
        self._system = model.system(step)
        if self.drive_kind == "hand":
            self._system.spring_rate[0] = self.drive
        self._state = start_state(model, self._system)
        self._names = list(self.restitution)
        self._room = empty_equations(len(model.torque), len(model.pairs), len(model.stops), len(self._system.near))
        self._run = run_steps.chosen(fast)
        self._place = np.argsort(model.order.coordinates)
        self._torque = np.array(self._system.torque)
        self.time = 0.0
        self.torque = 0.0
        self.torques, self.apart, self.impact_energy = (dict.fromkeys(self._names, 0.0) for _ in range(3))
        self.unsolved = 0
        self._set_torques()

    def _summary(self) -> str:
        return f"at {self.time:.6g} s, step {self.step:.4g} s, {self.drive_kind} {self.drive:.4g} at {self.drive_link}"

    def anew(
        self,
        *,
        step: float | None = None,
        restitution: Mapping[str, float] | None = None,
        drive: float | None = None,
        loads: Mapping[str, float] | None = None,
    ) -> Simulation:
        """The same train at time 0 once more.

        Parameters
        ----------
        step, restitution, drive, loads
            As the attributes; by default those it has now. A speed that drives is one from the start.

        Returns
        -------
        Simulation
            Another one, that shares what was found about teeth.

        Raises
        ------
        QuestionError
            If a step is no length, or a restitution none.
        """
        step = self.step if step is None else step
        bounces = {**self.restitution, **(restitution or {})}
        if not 0 < step < inf or not all(0 <= each <= 1 for each in bounces.values()):
            what = f"steps of {step:g} s, restitution {', '.join(f'{each:g}' for each in set(bounces.values()))}"
            raise QuestionError(Problem(what, "", "give a length above 0, and restitution from 0 to 1"))
        drive = self.drive if drive is None else drive
        given = self.loads if loads is None else loads
        return Simulation(self._of, self._outputs, step, self._fast, bounces, drive, given)

    @property
    def _share(self) -> float:
        """Speed of the drive over the declared one."""
        own = self._of.case.drive.value
        return self.drive / own if own else 0.0

    @property
    def angles(self) -> dict[str, float]:
        """Angles of outputs [rad], by name; those of the train's start among them."""
        late = self.time - float(self._state.clock[1]) * self.step
        turned = self._of.speeds @ (self._state.angle + late * self._state.speed)[self._place]
        start = self._of.problem.angles
        return self._seen(turned + np.array([start.get(link, 0.0) for link in self._of.index]))

    @property
    def speeds(self) -> dict[str, float]:
        """Speeds of outputs [rad/s], by name."""
        return self._seen(self._of.speeds @ self._state.speed[self._place])

    @property
    def angle(self) -> float:
        """Angle of the link where power enters, since the start [rad]."""
        late = self.time - float(self._state.clock[1]) * self.step
        row = self._of.speeds[self._of.index[self.drive_link]]
        return float(row @ (self._state.angle + late * self._state.speed)[self._place])

    @property
    def speed(self) -> float:
        """Speed of the link where power enters [rad/s]."""
        return float(self._of.speeds[self._of.index[self.drive_link]] @ self._state.speed[self._place])

    @property
    def output_links(self) -> tuple[str, ...]:
        """The links whose angles the outputs are."""
        return tuple(dict.fromkeys(link for _, link, _ in self._outputs))

    def _seen(self, links: Floats) -> dict[str, float]:
        index = self._of.index
        return {
            name: float(links[index[link]] - self._of.sense(link, base) * links[index[base]])
            for name, link, base in self._outputs
        }

    def set_drive(self, value: float) -> None:
        """Drive otherwise from now on.

        Parameters
        ----------
        value : float
            The speed of the link where power enters, or of the hand [rad/s]; or the torque there [N m].

        Raises
        ------
        QuestionError
            If a spring drives: it gives what it has.
        """
        if value == self.drive:
            return
        if self.drive_kind == "spring":
            raise QuestionError(Problem("a spring is not steered", "it gives what it has", "declare another drive"))
        before, self.drive = self.drive, value
        if self.drive_kind == "hand":
            self._system.spring_rate[0] = value
            self._system.spring_rest[0] += (before - value) * self._state.clock[0]
        elif self.drive_kind == "torque":
            self._set_torques()

    def set_load(self, link: str, torque: float) -> None:
        """Load a link otherwise from now on.

        Parameters
        ----------
        link : str
            A link.
        torque : float
            On it, in the sense of its positive speed [N m].

        Raises
        ------
        QuestionError
            If there is no such link.
        """
        if link not in self._of.index:
            raise QuestionError(Problem(f"there is no link '{link}'", "", suggest(link, self._of.index)))
        if torque != self.loads.get(link, 0.0):
            self.loads[link] = torque
            self._set_torques()

    def _set_torques(self) -> None:
        drive = self.drive if self.drive_kind == "torque" else 0.0
        self._torque[:] = self._of.torque_of(self.loads, drive)[list(self._model.order.coordinates)]
        self._system.torque[:] = self._torque

    def advance(self, seconds: float) -> None:
        """Go on.

        Parameters
        ----------
        seconds : float
            For so long, 0 or more; steps that end within are done [s].

        Raises
        ------
        QuestionError
            If time would go back.
        """
        if not 0 <= seconds < inf:
            raise QuestionError(Problem(f"{seconds:g} s to go on", "time goes on", "give 0 or more"))
        self.time += seconds
        steps = floor(self.time / self.step + _EARLY) - int(self._state.clock[1])
        if steps <= 0:
            return
        record = empty_record(len(self._torque), len(self._names), samples=1, impacts=0)
        first = self._jolt()
        if first:
            self._go(record, 1, steps)
            self._system.torque[:] = self._torque
        self._go(record, steps - first, steps)
        self._read(record, steps)

    def _jolt(self) -> int:
        """Bring prescribed coordinates to a new speed: 1 if so, and then momentum of the first step is mended."""
        if self.drive_kind != "rate":
            return 0
        jump = np.zeros(len(self._torque))
        for at, value in self._of.model.given.items():
            jump[self._place[at]] = value * self._share - self._state.speed[self._place[at]]
        if not jump.any():
            return 0
        self._state.speed[:] += jump
        # the kernel takes the speeds it finds for those before the step, which had less momentum
        self._system.torque[:] = self._torque - self._system.mass @ jump / self.step
        return 1

    def _go(self, record: RunRecord, steps: int, stride: int) -> None:
        """Some steps; a sample that is never full keeps the sums of all impulses."""
        ahead = max(steps, 1) * self.step + float(self._state.clock[0])
        rules = step_rules(self._model, self._state, StepPlan(self.step, 0, steps, stride + 1), ahead)
        self._run(self._system, self._model.transmissions, self._state, self._room, record, rules, steps, True)
        check_convergence(self._state, record, self.step)

    def _read(self, record: RunRecord, steps: int) -> None:
        time = steps * self.step
        forces, drive = record.forces[0] / time, record.drive[0] / time
        self.torques = dict(zip(self._names, forces.tolist(), strict=True))
        self.apart = dict(zip(self._names, (record.counts[:, TIME_APART] / steps).tolist(), strict=True))
        self.impact_energy = dict(zip(self._names, record.counts[:, IMPACT_ENERGY].tolist(), strict=True))
        self.unsolved += int(record.numbers[UNSOLVED])
        way = -1.0 if self._of.typical(self.drive_link) < 0 else 1.0
        if self.drive_kind == "rate":
            self.torque = float(way * drive[self._place[self._of.coordinates.index(self.drive_link)]])
        elif self.drive_kind == "torque":
            self.torque = way * self.drive
        else:
            case, rate = self._of.case.drive, float(self._system.spring_rate[0])
            rest = float(self._system.spring_rest[0]) + rate * float(self._state.clock[0])
            self.torque = way * case.stiffness * (rest - self.angle)
