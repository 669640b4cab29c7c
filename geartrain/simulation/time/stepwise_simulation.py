"""Simulation of a train that is advanced on request, with a drive and loads that may change between calls."""

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
    compliant_teeth,
    empty_equations,
    empty_record,
    start_state,
    step_rules,
)
from geartrain.simulation.steps.time_steps import run_steps

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.simulation.contacts.train_model import TrainModel

_EARLY = 1e-6  # relative to a step: a time this little before the end of a step counts as its end


class Simulation(Shown):
    """Simulation that a caller advances step by step, for coupling to other programs. The drive and the loads may be
    changed between steps.

    The time step is constant and does not depend on the requested times. Between two steps the angles are extrapolated
    linearly. The motion therefore does not depend on the times at which a caller reads the angles.

    Attributes
    ----------
    time : float
        Simulated time [s].
    step : float
        Time step [s].
    drive_link, drive_kind : str
        Link at which power enters, and kind of the drive: "rate", "torque", "spring" or "hand".
    drive : float
        Control value of the drive: the speed of that link or of the hand [rad/s], or the torque [N m].
    loads : dict of str to float
        Load torques on links, as declared or set [N m].
    restitution : dict of str to float
        Coefficient of restitution of each pair, pin and escapement.
    torque : float
        Mean torque of the drive over the last advance, positive in the sense of rotation of its link [N m].
    torques, apart, impact_energy : dict of str to float
        Results of each pair, pin and escapement over the last advance: mean torque on the driven side [N m], fraction
        of the time without contact, and energy lost in impacts [J].
    unsolved : int
        Number of steps without a consistent set of contacts.

    See Also
    --------
    geartrain.GearTrain.simulation : Returns such an object.
    geartrain.GearTrain.dynamics : Simulates a whole run, with its energy balance.

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
        if not 0 < step < inf:
            what, why = f"a time step of {step:g} s is out of range", "the time step must be positive and finite"
            raise QuestionError(Problem(what, why, "pass a finite step above 0, such as step=1e-4"))
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
            # all prescribed speeds keep their ratios to the speed of the drive
            model = replace(model, given={at: speed * self._share for at, speed in model.given.items()})
        self.restitution = {pair.name: pair.restitution for pair in model.pairs}
        self.restitution |= {stop.name: stop.restitution for stop in model.stops}
        self._model = model
        self._system = model.system(step)
        if self.drive_kind == "hand":
            self._system.spring_rate[0] = self.drive
        self._state = start_state(model, self._system)
        self._names = list(self.restitution)
        self._room = empty_equations(model)
        self._rigid = compliant_teeth(len(model.pairs), None)
        self._run = run_steps.chosen(fast)
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
        """Return a new simulation of the same train that starts at time 0.

        Parameters
        ----------
        step, restitution, drive, loads
            New values of the attributes; by default the present values. A new driving speed applies from time 0.

        Returns
        -------
        Simulation
            New simulation, which shares the tables of transmission functions.

        Raises
        ------
        QuestionError
            If the time step is not positive, or a coefficient of restitution is not from 0 to 1.
        """
        step = self.step if step is None else step
        bounces = {**self.restitution, **(restitution or {})}
        if outside := [each for each in bounces.values() if not 0 <= each <= 1]:
            what = f"a restitution of {outside[0]:g} is out of range"
            why = "a coefficient of restitution is from 0 to 1"
            raise QuestionError(Problem(what, why, "pass a value from 0 to 1, such as 0.3"))
        drive = self.drive if drive is None else drive
        given = self.loads if loads is None else loads
        return Simulation(self._of, self._outputs, step, self._fast, bounces, drive, given)

    @property
    def _share(self) -> float:
        """Ratio of the present speed of the drive to its declared speed; 0 if the declared speed is 0."""
        own = self._of.case.drive.value
        return self.drive / own if own else 0.0

    @property
    def angles(self) -> dict[str, float]:
        """Angle of each output, including its initial angle [rad], keyed by output."""
        start = self._of.problem.angles
        return self._by_output(self._turned() + np.array([start.get(link, 0.0) for link in self._of.index]))

    @property
    def speeds(self) -> dict[str, float]:
        """Angular speed of each output [rad/s], keyed by output."""
        return self._by_output(self._of.speeds @ self._state.speed)

    @property
    def angle(self) -> float:
        """Angle through which the link at the power input has turned since the start [rad]."""
        return float(self._turned()[self._of.index[self.drive_link]])

    def _turned(self) -> Floats:
        """Return the angle turned by each link since time 0 [rad], extrapolated within the present time step."""
        # the requested time may be within a step that is not computed yet
        late = self.time - float(self._state.clock[1]) * self.step
        return self._of.speeds @ (self._state.angle + late * self._state.speed)

    @property
    def speed(self) -> float:
        """Angular speed of the link at the power input [rad/s]."""
        return float(self._of.speeds[self._of.index[self.drive_link]] @ self._state.speed)

    @property
    def output_links(self) -> tuple[str, ...]:
        """Names of the links of the recorded outputs, without duplicates."""
        return tuple(dict.fromkeys(link for _, link, _ in self._outputs))

    def _by_output(self, links: Floats) -> dict[str, float]:
        index = self._of.index
        return {
            name: float(links[index[link]] - self._of.sense(link, base) * links[index[base]])
            for name, link, base in self._outputs
        }

    def set_drive(self, value: float) -> None:
        """Set the control value of the drive: a speed or a torque, which applies from the present time.

        The line of a weight continues to press on bearings with its declared force.

        Parameters
        ----------
        value : float
            Speed of the link at which power enters, or of the hand [rad/s]; or torque on that link [N m].

        Raises
        ------
        QuestionError
            If a spring drives the train.
        """
        if value == self.drive:
            return
        if self.drive_kind == "spring":
            why = "the drive is a spring, whose torque follows from its deflection"
            raise QuestionError(Problem("the drive cannot be set", why, "declare a `drive` other than a spring"))
        before, self.drive = self.drive, value
        if self.drive_kind == "hand":
            self._system.spring_rate[0] = value
            # the rest angle of the hand must be continuous in time
            self._system.spring_rest[0] += (before - value) * self._state.clock[0]
        elif self.drive_kind == "torque":
            self._set_torques()

    def set_load(self, link: str, torque: float) -> None:
        """Set the load torque on a link, which applies from the present time.

        Parameters
        ----------
        link : str
            Name of the link.
        torque : float
            Torque on the link, positive in the sense of its positive speed [N m].

        Raises
        ------
        QuestionError
            If the link does not exist.
        """
        if link not in self._of.index:
            what = f"the train has no link '{link}'"
            raise QuestionError(Problem(what, "a load acts on a declared link", suggest(link, self._of.index)))
        if torque != self.loads.get(link, 0.0):
            self.loads[link] = torque
            self._set_torques()

    def _set_torques(self) -> None:
        drive = self.drive if self.drive_kind == "torque" else 0.0
        self._torque[:] = self._of.torque_of(self.loads, drive)
        self._system.torque[:] = self._torque

    def advance(self, seconds: float) -> None:
        """Advance the simulation by a given duration.

        Parameters
        ----------
        seconds : float
            Duration, 0 or more [s]. All time steps that end within it are computed.

        Raises
        ------
        QuestionError
            If the duration is negative or not finite.
        """
        if not 0 <= seconds < inf:
            what = f"a duration of {seconds:g} s is out of range"
            why = "a duration must be finite and not negative"
            raise QuestionError(Problem(what, why, "give a finite duration of 0 or more"))
        self.time += seconds
        # the number of steps depends only on the time, not on the calls
        steps = floor(self.time / self.step + _EARLY) - int(self._state.clock[1])
        if steps <= 0:
            return
        record = empty_record(len(self._torque), len(self._names), samples=1, impacts=0)
        first = self._apply_new_speed()
        if first:
            self._run_steps(record, 1, steps)
            self._system.torque[:] = self._torque
        self._run_steps(record, steps - first, steps)
        self._read(record, steps)

    def _apply_new_speed(self) -> int:
        """Set the prescribed coordinate speeds to the speed of the drive. Return 1 if a speed changes, or 0 if none
        does.

        After a change, the torque in the next time step compensates the sudden change of momentum.
        """
        if self.drive_kind != "rate":
            return 0
        jump = np.zeros(len(self._torque))
        for at, value in self._of.model.given.items():
            jump[at] = value * self._share - self._state.speed[at]
        if not jump.any():
            return 0
        self._state.speed[:] += jump
        # the kernel takes the new speeds as those before the step; the torque compensates the difference of momentum
        self._system.torque[:] = self._torque - self._system.mass @ jump / self.step
        return 1

    def _run_steps(self, record: RunRecord, steps: int, stride: int) -> None:
        """Compute `steps` time steps, and add their impulses to a single sample in `record`."""
        ahead = max(steps, 1) * self.step + float(self._state.clock[0])
        # a stride beyond the steps keeps the sample open
        rules = step_rules(self._model, self._state, StepPlan(self.step, 0, steps, stride + 1), ahead)
        given = self._system, self._model.transmissions, self._state, self._room, record, rules, self._rigid
        self._run(*given, steps, True)
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
            self.torque = float(way * drive[self._of.coordinates.index(self.drive_link)])
        elif self.drive_kind == "torque":
            self.torque = way * self.drive
        else:
            case, rate = self._of.case.drive, float(self._system.spring_rate[0])
            # rest angle of the spring at the present time
            rest = float(self._system.spring_rest[0]) + rate * float(self._state.clock[0])
            self.torque = way * case.stiffness * (rest - self.angle)
