"""The second part of a train that answers: real teeth and pins, who drives whom, motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from importlib.util import find_spec
from typing import TYPE_CHECKING

from geartrain.analysis.train_kinematics import TrainKinematics, of_planets_as_one
from geartrain.errors import GearTrainError, Problem, QuestionError
from geartrain.train import StateCase, Train

if TYPE_CHECKING:
    from geartrain.dynamics import LinkInertia, Motion
    from geartrain.dynamics.driven_meshes import DrivenWays
    from geartrain.dynamics.gear_meshes import PinMesh
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.kinematics.buildability import BuildFinding
    from geartrain.kinematics.buildability.pitch_pairs import PairOutline
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshDriver


class TrainMotion(TrainKinematics):
    """What `GearTrain` knows of teeth and motion. Parts are made once, when first asked for."""

    def __init__(self, declaration: Train) -> None:
        super().__init__(declaration)
        self._settings: dict[str | None, LoadCase | None] = {}
        self._drivers: dict[tuple[str | None, tuple[str, ...]], Mapping[str, MeshDriver]] = {}

    @cached_property
    def _meshes(self) -> Mapping[str, GearMesh]:
        """The gear pairs with real teeth, whichever side drives, each made when it is first read."""
        from geartrain.dynamics.gear_meshes import find_meshes
        from geartrain.kinematics.circuits.shaft_angles import shaft_angle

        # the mapping must not hold the train: the two would wait for the garbage collector
        train, tree, circuits = self.declaration, self.tree, {circuit.id: circuit for circuit in self.circuits}
        return find_meshes(train, lambda gear: shaft_angle(train, tree, circuits[gear.name]))

    @cached_property
    def _teeth(self) -> tuple[GearMesh, ...]:
        """All of them, made."""
        from geartrain.dynamics.gear_meshes import all_meshes

        return all_meshes(self._meshes)

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

        return find_driven_ways(self._teeth, ((state, self.meshes_in(state)) for state in self.usable_states))

    @cached_property
    def faults(self) -> tuple[Problem, ...]:
        """Everything that keeps real teeth from turning, whichever of its wheels drives a pair in some state."""
        from geartrain.teeth.gear_mesh import find_faults

        return tuple(fault for ways in self.driven_ways.values() for fault in find_faults([way for way, _ in ways]))

    @cached_property
    def build_findings(self) -> tuple[BuildFinding, ...]:
        """What of the train cannot be built, and what is unwise, by the declaration alone (docs/buildability.md)."""
        from geartrain.kinematics.buildability.build_check import check_build

        found = tuple(check_build(self.declaration, self.tree, self.circuits, lambda: self._outlines))
        if not self._cuts_teeth:
            return found
        from geartrain.dynamics.cut_teeth import find_odd_wheels

        return (*found, *find_odd_wheels(self))

    @property
    def _cuts_teeth(self) -> bool:
        """True where pairs declare forms, and numpy is there: a page that answers in a browser goes without."""
        return any(map(self.declaration.form_of, self.declaration.gears)) and find_spec("numpy") is not None

    @cached_property
    def _outlines(self) -> Mapping[str, PairOutline]:
        if not self._cuts_teeth:
            return {}
        from geartrain.dynamics.gear_meshes import find_outlines

        try:
            return find_outlines(self._teeth)
        except GearTrainError:  # teeth that cannot be made are reported as such
            return {}

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
            Whether compiled kernels follow the motion, the same to 1e-12 rad and about ten times as fast; by default
            where numba is installed and there are so many positions that it pays to load it. Pairs that depend on each
            other are followed without kernels.

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

    @property
    def is_heavy(self) -> bool:
        """True if some link has a moment of inertia, declared or from the density of its wheels."""
        declared = self.declaration
        wheels = (wheel.density is not None for _, wheel in declared.wheels.values())
        return declared.density is not None or any(link.inertia for link in declared.links.values()) or any(wheels)

    @of_planets_as_one
    def inertias(self, state: str | None = None, with_inputs: bool = False) -> tuple[LinkInertia, ...]:
        """The moment of inertia of every link whose motion is not prescribed, and where each is from.

        Parameters
        ----------
        state : str, optional
            A declared state; None only of a train that has none.
        with_inputs : bool
            Those of the inputs too, as where a torque or a weight drives them.

        Returns
        -------
        tuple of LinkInertia
            In the order of the declaration (docs/dynamics.md, section 1).

        Examples
        --------
        Two wheels of bronze, 2 mm thick, from the outlines of their teeth:

        >>> import geartrain
        >>> train = geartrain.load('''
        ... links: {frame: {}, a: {wheels: {p: 20}}, b: {wheels: {w: {teeth: 60, module: 1 mm}}}}
        ... revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
        ... gears: [{pair: [p, w]}]
        ... density: 8.7 g/cm3
        ... thickness: 2 mm
        ... inputs: {a: 1}
        ... ''')
        >>> [(each.link, each.source, float(f"{each.value:.3g}")) for each in train.inertias()]
        [('b', 'outlines', 2.2e-05)]
        """
        from geartrain.dynamics.inertia.link_inertia import find_link_inertias

        return find_link_inertias(self, self._case(state), with_inputs)

    def _moving(self, case: StateCase, without: Sequence[str]) -> MotionProblem:
        from geartrain.dynamics.motion.motion_problem import build_motion_problem

        solution = self._speeds.solution(case)
        if not solution.verdict or not any(case.inputs.values()):
            what = f"'{self.name}' does not move"
            raise QuestionError(Problem(what, solution.verdict.text, "drive it from an input"))
        circuits, drivers = self._circuits_without(without), self.drivers(case.state, without)
        return build_motion_problem(
            self.declaration, case, circuits, self.signs, solution.speeds, self._meshes, self.pins, drivers, self.tree
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
            self.declaration,
            self.tree,
            self.circuits,
            self.signs,
            case,
            solution.speeds,
            self._meshes,
            self.pins,
            forms,
        )
