"""The second half of a train that answers: real teeth and pins, who drives whom, torques and motion."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, overload

from geartrain.analysis.train_kinematics import TrainKinematics
from geartrain.errors import Problem, QuestionError, check_choice
from geartrain.train import StateCase, Train

if TYPE_CHECKING:
    from geartrain.dynamics import DrivenWay, Motion, PowerFlow, ToothImpact, TorqueCycle, Torques
    from geartrain.dynamics.driven_meshes import DrivenWays
    from geartrain.dynamics.gear_meshes import PinMesh
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshDriver


class TrainDynamics(TrainKinematics):
    """What `GearTrain` knows of teeth, torques and motion. Parts are made once, when first asked for."""

    def __init__(self, declaration: Train) -> None:
        super().__init__(declaration)
        self._settings: dict[str | None, LoadCase | None] = {}
        self._drivers: dict[tuple[str | None, tuple[str, ...]], Mapping[str, MeshDriver]] = {}

    @cached_property
    def _teeth(self) -> tuple[GearMesh, ...]:
        """The gear pairs with real teeth, whichever side drives."""
        from geartrain.dynamics.gear_meshes import find_meshes
        from geartrain.kinematics.circuits.shaft_angles import shaft_angle

        train, circuits = self.declaration, {circuit.id: circuit for circuit in self.circuits}
        return find_meshes(train, lambda gear: shaft_angle(train, self.tree, circuits[gear.name]))

    @cached_property
    def meshes(self) -> tuple[GearMesh, ...]:
        """The gear pairs with real teeth, each with its law; empty, and free of cost, where none declares a form.

        Each is driven as in the first state that tells who drives it; `meshes_in` has those of another.
        """
        from geartrain.dynamics.driven_meshes import likeliest_ways

        return likeliest_ways(self.driven_ways)

    @cached_property
    def driven_ways(self) -> DrivenWays:
        """By pair with real teeth, the ways it is driven, each with the names of its states; open ones count both."""
        from geartrain.dynamics.driven_meshes import find_driven_ways

        return find_driven_ways(self._teeth, ((state, self.meshes_in(state)) for state in self.states or (None,)))

    @cached_property
    def faults(self) -> tuple[Problem, ...]:
        """Everything that keeps real teeth from turning, whichever of its wheels drives a pair in some state."""
        from geartrain.teeth.mesh_faults import find_faults

        return tuple(fault for ways in self.driven_ways.values() for fault in find_faults([way for way, _ in ways]))

    def meshes_in(self, state: str | None = None) -> tuple[GearMesh, ...]:
        """The gear pairs with real teeth as they are driven in one state.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        """
        if not self._teeth:
            return ()
        drivers = self.drivers(state)
        driven = tuple(mesh.driven_by(drivers[mesh.name]) for mesh in self._teeth)
        if all(mesh.wheels.friction_law is None for mesh in driven):
            return driven
        from geartrain.dynamics.pair_speeds import at_own_speeds

        return at_own_speeds(driven, self._setting(self._case(state).state))

    def drivers(self, state: str | None = None, without: Sequence[str] = ()) -> Mapping[str, MeshDriver]:
        """Who drives each pair and coupling in one state: declared, or by the flow of power in its carrier's frame.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        without : sequence of str
            Pairs left out.
        """
        from geartrain.dynamics.torques.drivers import find_drivers

        state = self._case(state).state
        key = state, tuple(without)
        if key not in self._drivers:
            circuits = self._circuits_without(without)
            self._drivers[key] = find_drivers(self.declaration, circuits, self._setting(state))
        return self._drivers[key]

    @cached_property
    def pins(self) -> tuple[PinMesh, ...]:
        """The pins in slots whose dimensions are declared, each with its law."""
        from geartrain.dynamics.gear_meshes import find_pins

        return find_pins(self.declaration)

    @overload
    def torques(self, state: str | None = None) -> Torques: ...

    @overload
    def torques(
        self,
        state: str | None = None,
        *,
        turns: float,
        samples: int = ...,
        of: str | None = None,
        on_done: Callable[[int], object] | None = None,
    ) -> TorqueCycle: ...

    def torques(
        self,
        state: str | None = None,
        *,
        turns: float | None = None,
        samples: int = 20_000,
        of: str | None = None,
        on_done: Callable[[int], object] | None = None,
    ) -> Torques | TorqueCycle:
        """Torques on links and pairs, and the flow of power, under the loads of one state: means, or over a turn.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        turns : float, optional
            Turns of the input, above 0: the torque at every position of so many turns, with the ratio and the friction
            that real teeth, pins and bearings have there. Without it exact torques at mean speeds.
        samples : int
            Positions of such a run, 2 or more; corners and jumps come on top.
        of : str, optional
            The link whose torque is asked for over a turn, by default the crank or input.
        on_done : callable, optional
            Called with the number of positions that have been worked out since.

        Returns
        -------
        Torques or TorqueCycle
            With a verdict: self-locking, or loads that do not balance, are no error.

        Raises
        ------
        QuestionError
            If the train does not move, or turns or link are none to be asked for.
        """
        setting = self._setting(state)
        if turns is not None:
            return self._torque_cycle(state, setting, turns, samples, of, on_done)
        from geartrain.dynamics.torques.torque_analysis import find_torques, torques_unknown

        return torques_unknown(state) if setting is None else find_torques(setting)

    def _torque_cycle(
        self,
        state: str | None,
        setting: LoadCase | None,
        turns: float,
        samples: int,
        of: str | None,
        on_done: Callable[[int], object] | None,
    ) -> TorqueCycle:
        from geartrain.dynamics import Motion, TorqueCycle, TorqueVerdict
        from geartrain.dynamics.turn.turn_analysis import find_torque_cycle

        links = tuple(self.declaration.links)
        if of is not None:
            check_choice("link", of, links)
        if setting is None:
            return TorqueCycle(state, TorqueVerdict("still", "the speeds of this state are not determined"), of or "")
        moving = self._moving(self._case(state), ())
        motion = Motion(moving, {link: (link, self.declaration.frame) for link in moving.system.links})
        return find_torque_cycle(setting, motion, turns, samples, of, on_done)

    def driven(self, load: str, source: str, state: str | None = None) -> Torques:
        """Torques while a unit of power leaves at one link, driven from another: efficiency, or self-locking.

        Parameters
        ----------
        load, source : str
            Two links: where the power leaves, and where it enters.
        state : str, optional
            A declared state; None only of a train that has none.
        """
        from geartrain.dynamics.torques.torque_analysis import drive, torques_unknown

        for link in (load, source):
            check_choice("link", link, tuple(self.declaration.links))
        setting = self._setting(state)
        return torques_unknown(state) if setting is None else drive(setting, load, source)

    def drive_both_ways(self, state: str | None = None) -> list[DrivenWay]:
        """The train driven from its input, and from its output, a unit of power leaving at the other.

        Parameters
        ----------
        state : str, optional
            A declared state, by default the first.

        Returns
        -------
        list of DrivenWay
            Two ways; empty where it is not plain which link is the output.
        """
        from geartrain.dynamics import DrivenWay
        from geartrain.dynamics.torques.load_case import input_and_output

        case = self.declaration.case(self.state_or_first(state))
        found = input_and_output(self.declaration, case)
        ways = [] if found is None else [found, found[::-1]]
        return [DrivenWay(self.driven(load, source, state), source, load) for source, load in ways]

    def power_flow(self, found: Torques) -> PowerFlow:
        """The streams of power under some torques of this train.

        Parameters
        ----------
        found : Torques
            As `torques`, `driven` or `drive_both_ways` give them.
        """
        from geartrain.dynamics.torques.power_flow import find_power_flow

        return find_power_flow(found)

    def motion(
        self,
        state: str | None = None,
        outputs: Sequence[str] = (),
        without: Sequence[str] = (),
        tolerance: float | None = None,
        fast: bool | None = None,
    ) -> Motion:
        """The motion of some outputs or links with real teeth and pins: transmission functions, composed.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        outputs : sequence of str
            Outputs or links; by default all outputs, and all links of a train without any.
        without : sequence of str
            Pairs left out, so that real teeth do not contradict each other around a loop.
        tolerance : float, optional
            Read transmission functions from tables of this accuracy [pitch], several times faster.
        fast : bool, optional
            Whether compiled kernels follow the motion, the same to 1e-12 rad and ten times as fast; by default where
            numba is installed and there are so many positions that it pays to load it.

        Returns
        -------
        Motion
            To be asked at positions of the input.

        Raises
        ------
        QuestionError
            If the train does not move, or a pair or output is not declared.
        """
        from geartrain.dynamics import Motion

        case = self._case(state)
        names = outputs or tuple(case.outputs) or tuple(self.declaration.links)
        wanted = {name: self._speeds.single_output(case, name)[1] for name in names}
        return Motion(self._moving(case, without), wanted, tolerance, fast)

    def impacts(self, state: str | None = None) -> Mapping[str, ToothImpact]:
        """What collisions of triangular teeth cost, by pair; empty unless inertias and a rate are declared.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.

        Returns
        -------
        mapping of str to ToothImpact
            By pair (docs/motion.md, equation 7).
        """
        declared, case = self.declaration, self._case(state)
        inertias = {name: link.inertia.si for name, link in declared.links.items() if link.inertia is not None}
        if not inertias or case.rate is None or case.rate.unit is None or not self._teeth:
            return {}
        from geartrain.dynamics import Motion
        from geartrain.dynamics.motion.tooth_impacts import find_impacts

        moving = self._moving(case, ())
        return {} if moving.contradictions() else find_impacts(Motion(moving, {}), inertias, case.rate.si)

    def _moving(self, case: StateCase, without: Sequence[str]) -> MotionProblem:
        from geartrain.dynamics.motion.motion_problem import build_motion_problem

        solution = self._speeds.solution(case)
        if not solution.verdict or not any(case.inputs.values()):
            what = f"'{self.name}' does not move"
            raise QuestionError(Problem(what, solution.verdict.text, "drive it from an input"))
        circuits, drivers = self._circuits_without(without), self.drivers(case.state, without)
        return build_motion_problem(
            self.declaration, case, circuits, self.signs, solution.speeds, self._teeth, self.pins, drivers
        )

    def _setting(self, state: str | None) -> LoadCase | None:
        """What torques need to know of one state, solved once; None where its speeds are neither known nor free."""
        if state not in self._settings:
            self._settings[state] = self._make_setting(self._case(state))
        return self._settings[state]

    def _make_setting(self, case: StateCase) -> LoadCase | None:
        from geartrain.dynamics.torques.load_case import LoadCase
        from geartrain.dynamics.torques.virtual_work import speed_forms

        solution = self._speeds.solution(case)
        if solution.verdict.kind not in ("determined", "free"):
            return None
        forms = speed_forms(self.equations(case.state)) if solution.verdict.kind == "free" else {}
        return LoadCase(
            self.declaration, self.tree, self.circuits, self.signs, case, solution.speeds, self._teeth, self.pins, forms
        )
