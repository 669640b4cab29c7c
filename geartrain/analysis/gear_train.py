"""A train that answers: the whole corridor on one page, each part made only when asked for."""

from __future__ import annotations

import html
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from geartrain.errors import Problem, QuestionError, check_choice, suggest
from geartrain.kinematics.answer import Answer
from geartrain.kinematics.circuits import Axes, Circuit, Tree, close_joints, find_circuits, find_tree
from geartrain.kinematics.speed_problem import Method, SpeedProblem
from geartrain.kinematics.speeds import Mobility, find_mobility
from geartrain.kinematics.tooth_sensitivity import Sensitivity
from geartrain.kinematics.willis_system import WillisSystem
from geartrain.train import StateCase, Train, declare

if TYPE_CHECKING:
    from geartrain.dynamics.driven_meshes import DrivenWays
    from geartrain.dynamics.gear_meshes import PinMesh
    from geartrain.dynamics.motion import Motion, MotionProblem, ToothImpact
    from geartrain.dynamics.torques import DrivenWay, LoadCase, PowerFlow, Torques
    from geartrain.kinematics.graph import Graph
    from geartrain.kinematics.gridlock import Gridlock
    from geartrain.kinematics.phasing import MeshPhasing
    from geartrain.kinematics.speeds import FloatSpeeds
    from geartrain.teeth.gear_mesh import GearMesh, MeshDriver


class GearTrain:
    """A declared train that answers questions. Parts are made once, when first asked for.

    >>> train = GearTrain.declare({"links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 60}}},
    ...     "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    ...     "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1}})
    >>> train.solve()["b"]
    Fraction(-1, 3)
    """

    def __init__(self, declaration: Train) -> None:
        self.declaration = declaration
        self._settings: dict[str | None, LoadCase | None] = {}
        self._drivers: dict[tuple[str | None, tuple[str, ...]], Mapping[str, MeshDriver]] = {}

    @classmethod
    def declare(cls, data: Mapping[str, Any]) -> GearTrain:
        """A train from plain data, with the keys of the YAML declaration. Raises `DeclarationError`.

        Unlike `geartrain.load`, it finds circuits and cases no sooner than they are asked for.
        """
        if "extends" in data:
            from geartrain.train.declaration_files import read_declaration

            return cls(read_declaration(data))
        return cls(declare(data))

    @property
    def name(self) -> str:
        """The declared name."""
        return self.declaration.name

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the declared states; empty for a train that has only one way to run."""
        return tuple(self.declaration.states)

    @cached_property
    def graph(self) -> Graph:
        """The networkx graph; edges carry the declared objects."""
        from geartrain.kinematics.graph import build_graph

        return build_graph(self.declaration)

    @cached_property
    def tree(self) -> Tree:
        """The turning pairs as a tree rooted at the frame."""
        return find_tree(self.declaration)

    @cached_property
    def circuits(self) -> tuple[Circuit, ...]:
        """One fundamental circuit per gear pair and coupling."""
        return find_circuits(self.declaration, self.tree)

    @cached_property
    def cases(self) -> Mapping[str | None, StateCase]:
        """What is prescribed in each state, or once for None, with rigid connections joint by joint."""
        declared = self.declaration.cases
        return {case.state: case for case in close_joints(self.declaration, self.tree, declared)}

    @cached_property
    def _axes(self) -> Axes:
        return Axes(self.declaration, self.tree)

    @cached_property
    def signs(self) -> Mapping[str, int]:
        """-1 for links whose axis points against the reference direction of its parallels."""
        return self._axes.link_signs

    @cached_property
    def bookkeeping(self) -> frozenset[str]:
        """Links whose speed is a sum over non-parallel joints, and no rotation."""
        return self._axes.joint_sums

    def is_rotation(self, of: str, base: str) -> bool:
        """True if the axes between two links are parallel: the speed of one seen from the other is then a rotation."""
        return not self.bookkeeping or self._axes.is_rotation(of, base)

    @cached_property
    def _speeds(self) -> SpeedProblem:
        return SpeedProblem(self.declaration, self.circuits, self.signs, self.is_rotation)

    @cached_property
    def mobility(self) -> Mobility:
        """Degrees of freedom by count and by exact rank, with redundant and locking loops."""
        return find_mobility(self._speeds.whole.reduced, len(self.declaration.revolutes))

    @cached_property
    def gridlock(self) -> Gridlock:
        """Why meshes lock the train or a part of it, and the least set of them to disengage; cheap where none does."""
        from geartrain.kinematics.gridlock import find_gridlock

        return find_gridlock(self._speeds.whole, self.mobility)

    @cached_property
    def is_placed(self) -> bool:
        """True if it can be asked whether teeth meet: axes have positions or directions, and pairs close loops."""
        return self.declaration.has_placed_axes and bool(self.mobility.redundant or self.mobility.locked)

    @cached_property
    def closure(self) -> MeshPhasing:
        """Whether the teeth of every loop meet, where positions of axes are declared, and angles to put wheels in."""
        from geartrain.kinematics.phasing import find_phasing

        plays = {mesh.name: mesh.play for mesh in self._teeth}
        return find_phasing(self.declaration, self.tree, self.circuits, plays)

    @cached_property
    def remarks(self) -> tuple[Problem, ...]:
        """What a fitter would remark on a sound declaration: notes, never errors."""
        from geartrain.kinematics.lint import lint_train

        return tuple(lint_train(self.declaration, self.tree, self.circuits))

    @cached_property
    def _teeth(self) -> tuple[GearMesh, ...]:
        """The gear pairs with real teeth, whoever drives them."""
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
        from geartrain.teeth.gear_mesh import find_faults

        return tuple(fault for ways in self.driven_ways.values() for fault in find_faults([way for way, _ in ways]))

    def meshes_in(self, state: str | None = None) -> tuple[GearMesh, ...]:
        """The gear pairs with real teeth as they are driven in one state."""
        if not self._teeth:
            return ()
        drivers = self.drivers(state)
        return tuple(mesh.driven_by(drivers[mesh.name]) for mesh in self._teeth)

    def drivers(self, state: str | None = None, without: Sequence[str] = ()) -> Mapping[str, MeshDriver]:
        """Who drives each pair and coupling in one state: declared, or by the flow of power in its carrier's frame.

        without   pairs left out
        """
        from geartrain.dynamics.torques import find_drivers

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

    def torques(self, state: str | None = None) -> Torques:
        """Torques on links and pairs, and the flow of power, under the loads of one state."""
        from geartrain.dynamics.torques import find_torques, torques_unknown

        setting = self._setting(state)
        return torques_unknown(state) if setting is None else find_torques(setting)

    def driven(self, load: str, source: str, state: str | None = None) -> Torques:
        """Torques while a unit of power leaves at `load`, driven from `source`: efficiency, or self-locking."""
        from geartrain.dynamics.torques import drive, torques_unknown

        for link in (load, source):
            check_choice("link", link, tuple(self.declaration.links))
        setting = self._setting(state)
        return torques_unknown(state) if setting is None else drive(setting, load, source)

    def drive_both_ways(self, state: str | None = None) -> list[DrivenWay]:
        """The train driven from its input, and from its output, a unit of power leaving at the other.

        Empty where it is not plain which link is the output.
        """
        from geartrain.dynamics.torques import DrivenWay, input_and_output

        case = self.declaration.case(state if state is not None or not self.states else self.states[0])
        found = input_and_output(self.declaration, case)
        ways = [] if found is None else [found, found[::-1]]
        return [DrivenWay(self.driven(load, source, state), source, load) for source, load in ways]

    def power_flow(self, found: Torques) -> PowerFlow:
        """The streams of power under some torques of this train."""
        from geartrain.dynamics.torques import find_power_flow

        return find_power_flow(self.declaration, self.tree, self.signs, found)

    def motion(
        self,
        state: str | None = None,
        outputs: Sequence[str] = (),
        without: Sequence[str] = (),
        tolerance: float | None = None,
    ) -> Motion:
        """The motion of some outputs or links, by default of all outputs, with real teeth and pins.

        without     pairs left out, so that real teeth do not contradict each other around a loop
        tolerance   read laws from tables of this accuracy (in pitches), several times faster
        """
        from geartrain.dynamics.motion import Motion

        case = self._case(state)
        names = outputs or tuple(case.outputs) or tuple(self.declaration.links)
        wanted = {name: self._speeds.single_output(case, name)[1] for name in names}
        return Motion(self._moving(case, without), wanted, tolerance)

    def impacts(self, state: str | None = None) -> Mapping[str, ToothImpact]:
        """What collisions of triangular teeth cost, by pair; empty unless inertias and a rate are declared."""
        declared, case = self.declaration, self._case(state)
        inertias = {name: link.inertia.si for name, link in declared.links.items() if link.inertia is not None}
        if not inertias or declared.rate is None or declared.rate.unit is None or not self._teeth:
            return {}
        from geartrain.dynamics.motion import Motion, find_impacts

        moving = self._moving(case, ())
        return {} if moving.contradictions() else find_impacts(Motion(moving, {}), inertias, declared.rate.si)

    def _moving(self, case: StateCase, without: Sequence[str]) -> MotionProblem:
        from geartrain.dynamics.motion import build_motion_problem

        solution = self._speeds.solution(case)
        if not solution.verdict or not any(case.inputs.values()):
            what = f"'{self.name}' does not move"
            raise QuestionError(Problem(what, solution.verdict.text, "drive it from an input"))
        circuits, drivers = self._circuits_without(without), self.drivers(case.state, without)
        return build_motion_problem(
            self.declaration, case, circuits, self.signs, solution.speeds, self._teeth, self.pins, drivers
        )

    def _circuits_without(self, names: Sequence[str]) -> tuple[Circuit, ...]:
        known = [circuit.id for circuit in self.circuits]
        for name in (name for name in names if name not in known):
            what = f"'{self.name}' has no pair '{name}'"
            raise QuestionError(Problem(what, "it is not declared", suggest(name, known)))
        return tuple(circuit for circuit in self.circuits if circuit.id not in names)

    def _setting(self, state: str | None) -> LoadCase | None:
        """What torques need to know of one state, solved once; None where its speeds are not determined."""
        if state not in self._settings:
            self._settings[state] = self._make_setting(self._case(state))
        return self._settings[state]

    def _make_setting(self, case: StateCase) -> LoadCase | None:
        from geartrain.dynamics.torques import LoadCase, speed_forms

        solution = self._speeds.solution(case)
        if solution.verdict.kind not in ("determined", "free"):
            return None
        forms = speed_forms(self.equations(case.state)) if solution.verdict.kind == "free" else {}
        return LoadCase(
            self.declaration, self.tree, self.circuits, self.signs, case, solution.speeds, self._teeth, self.pins, forms
        )

    def equations(self, state: str | None = None) -> WillisSystem:
        """The labelled Willis system of one state."""
        return self._speeds.equations(self._case(state))

    def solve(self, state: str | None = None, output: str | None = None, method: Method = "auto") -> Answer:
        """Speeds and judged outputs in one state.

        output   an output or a link: only the circuits that drive it are solved
        method   "exact", "floats", or "auto": exact unless the coupled system is too dense for it; speeds in
                 radians beside others in turns are rounded to floats in any case
        """
        return self._speeds.answer(self._case(state), output, method)

    def answers(self) -> Iterator[Answer]:
        """The answer of every state, in the order declared."""
        return (self.solve(state) for state in (self.states or (None,)))

    def sensitivity(self, answer: Answer) -> Iterator[Sensitivity]:
        """What one tooth fewer or more on each uncertain wheel does to each output of an answer."""
        return self._speeds.sensitivity(self._case(answer.state), answer)

    def floats(
        self,
        state: str | None = None,
        inputs: Mapping[str, Sequence[float]] | None = None,
        condition_of: Sequence[str] = (),
    ) -> FloatSpeeds:
        """Float64 speeds through a sparse LU, with error estimates; many input speeds at once share one factorisation.

        inputs        link -> speeds, one a case, in place of the declared ones
        condition_of  links whose component-wise condition number is wanted
        """
        return self._speeds.floats(self._case(state), inputs, condition_of)

    def _case(self, state: str | None) -> StateCase:
        return self.cases[self.declaration.single_state(state)]

    def _repr_html_(self) -> str:
        declared = self.declaration
        title = f"<p><b>{html.escape(declared.name)}</b> {html.escape(declared.title)}</p>"
        return title + "".join(answer._repr_html_() for answer in self.answers())
