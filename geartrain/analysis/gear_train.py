"""A train that answers: the whole corridor on one page, each part made only when asked for."""

from __future__ import annotations

import html
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from math import isfinite
from typing import TYPE_CHECKING, Any, Literal, get_args

from geartrain.errors import DeclarationError, Problem, QuestionError, RangeError, suggest
from geartrain.kinematics.answer import Answer, SpeedAccuracy
from geartrain.kinematics.circuits import (
    Circuit,
    Tree,
    are_parallel,
    close_joints,
    find_circuits,
    find_tree,
    joint_sum_links,
    link_signs,
)
from geartrain.kinematics.components import ReducedSystem, SolvedPart, relevant_circuits
from geartrain.kinematics.judged_outputs import (
    Relative,
    Sensitivity,
    SpeedValue,
    judge_outputs,
    relative_speed,
    sensitivity,
)
from geartrain.kinematics.speeds import EXACT_BUDGET, Mobility, Solution, exact_verdict, find_mobility, solve
from geartrain.kinematics.verdict import Verdict
from geartrain.kinematics.willis_system import WillisSystem, assemble_willis_system
from geartrain.numerics.exact import TooDenseError, as_float
from geartrain.numerics.long_float import rounded, scaled
from geartrain.train import GearPair, StateCase, Train, declare

if TYPE_CHECKING:
    from geartrain.dynamics.gear_meshes import PinMesh
    from geartrain.dynamics.motion import Motion, MotionProblem, ToothImpact
    from geartrain.dynamics.torques import DrivenWay, LoadCase, PowerFlow, Torques
    from geartrain.kinematics.graph import Graph
    from geartrain.kinematics.gridlock import Gridlock
    from geartrain.kinematics.phasing import MeshPhasing
    from geartrain.kinematics.speeds import FloatSpeeds
    from geartrain.teeth.gear_mesh import GearMesh, MeshDriver

Method = Literal["auto", "exact", "floats"]
_UNIT_ROUNDOFF = 2.0**-53


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

        Data that say `extends` are for `geartrain.load`, which knows where the parents are.
        """
        for key in ("extends", "remove"):
            if key in data:
                why = "the train it changes is looked up where files are"
                raise DeclarationError(Problem(f"`{key}` is not read here", why, "use `geartrain.load(data)`", key))
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
    def signs(self) -> Mapping[str, int]:
        """-1 for links whose axis points against the reference direction of its parallels."""
        return link_signs(self.declaration, self.tree)

    @cached_property
    def bookkeeping(self) -> frozenset[str]:
        """Links whose speed is a sum over non-parallel joints, and no rotation."""
        return joint_sum_links(self.declaration, self.tree)

    def is_rotation(self, of: str, base: str) -> bool:
        """True if the axes between two links are parallel: the speed of one seen from the other is then a rotation."""
        if not self.bookkeeping:
            return True
        return are_parallel(self.declaration, self.tree, of, base)

    @cached_property
    def mobility(self) -> Mobility:
        """Degrees of freedom by count and by exact rank, with redundant and locking loops."""
        return find_mobility(self._whole.reduced, len(self.declaration.revolutes))

    @cached_property
    def gridlock(self) -> Gridlock:
        """Why meshes lock the train or a part of it, and the least set of them to disengage; cheap where none does."""
        from geartrain.kinematics.gridlock import find_gridlock

        return find_gridlock(self._whole, self.mobility)

    @cached_property
    def is_placed(self) -> bool:
        """True if it can be asked whether teeth meet: axes have positions or directions, and pairs close loops."""
        axes = self.declaration.axes.values()
        placed = any(axis.position is not None or "direction" in axis.model_fields_set for axis in axes)
        return placed and bool(self.mobility.redundant or self.mobility.locked)

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

        return find_meshes(self.declaration, self._shaft_angle)

    @cached_property
    def meshes(self) -> tuple[GearMesh, ...]:
        """The gear pairs with real teeth, each with its law; empty, and free of cost, where none declares a form.

        Each is driven as in the first state that tells who drives it; `meshes_in` has those of another.
        """
        return tuple(next((way for way, _ in ways if way.who.known), ways[0][0]) for ways in self.driven_ways.values())

    @cached_property
    def driven_ways(self) -> Mapping[str, Sequence[tuple[GearMesh, tuple[str, ...]]]]:
        """By pair with real teeth, the ways it is driven, each with the names of its states; open ones count both."""
        found: dict[str, list[tuple[GearMesh, tuple[str, ...]]]] = {mesh.name: [] for mesh in self._teeth}
        for state in self.states or (None,):
            for mesh in self.meshes_in(state):
                for way in mesh.ways:
                    _count(found[mesh.name], way, state)
        return found

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
        from geartrain.dynamics.torques import find_drivers, find_torques, undetermined_drivers

        state = self._case(state).state
        key = state, tuple(without)
        if key not in self._drivers:
            circuits, setting = self._circuits_without(without), self._setting(state)
            if setting is None:
                why = "the speeds of the train are not determined"
                self._drivers[key] = undetermined_drivers(self.declaration, circuits, why)
            else:
                setting = replace(setting, circuits=circuits)
                loaded = find_torques(setting) if self.declaration.is_loaded(state) else None
                self._drivers[key] = find_drivers(setting, loaded)
        return self._drivers[key]

    def _shaft_angle(self, gear: GearPair) -> float | None:
        from geartrain.kinematics.circuits.shaft_angles import shaft_angle

        return shaft_angle(self.declaration, self.tree, self._circuit_of[gear.name])

    @cached_property
    def _circuit_of(self) -> Mapping[str, Circuit]:
        return {circuit.id: circuit for circuit in self.circuits}

    @cached_property
    def pins(self) -> tuple[PinMesh, ...]:
        """The pins in slots whose dimensions are declared, each with its law."""
        from geartrain.dynamics.gear_meshes import find_pins

        return find_pins(self.declaration)

    def torques(self, state: str | None = None) -> Torques:
        """Torques on links and pairs, and the flow of power, under the loads of one state."""
        from geartrain.dynamics.torques import Torques, TorqueVerdict, find_torques

        setting = self._setting(state)
        if setting is None:
            return Torques(state, TorqueVerdict("still", "the speeds of this state are not determined"))
        return find_torques(setting)

    def driven(self, load: str, source: str, state: str | None = None) -> Torques:
        """Torques while a unit of power leaves at `load`, driven from `source`: efficiency, or self-locking."""
        from geartrain.dynamics.torques import Torques, TorqueVerdict, drive

        for link in (load, source):
            _check_choice("link", link, tuple(self.declaration.links))
        setting = self._setting(state)
        if setting is None:
            return Torques(state, TorqueVerdict("still", "the speeds of this state are not determined"))
        return drive(setting, load, source)

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
        wanted = {}
        for name in names:
            _, links = self._only(case, name)
            wanted[name] = (links[0], links[1] if len(links) > 1 else self.declaration.frame)
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

        declared, solution = self.declaration, solve(self._whole, case, self.signs, None)
        verdict, speeds = solution.verdict, solution.speeds
        if not verdict or not any(case.inputs.values()):
            raise QuestionError(Problem(f"'{self.name}' does not move", verdict.text, "drive it from an input"))
        circuits, drivers = self._circuits_without(without), self.drivers(case.state, without)
        return build_motion_problem(declared, case, circuits, self.signs, speeds, self._teeth, self.pins, drivers)

    def _circuits_without(self, names: Sequence[str]) -> tuple[Circuit, ...]:
        known = [circuit.id for circuit in self.circuits]
        for name in names:
            if name not in known:
                what = Problem(f"'{self.name}' has no pair '{name}'", "it is not declared", suggest(name, known))
                raise QuestionError(what)
        return tuple(circuit for circuit in self.circuits if circuit.id not in names)

    def _setting(self, state: str | None) -> LoadCase | None:
        """What torques need to know of one state, solved once; None where its speeds are not determined."""
        if state not in self._settings:
            self._settings[state] = self._make_setting(self._case(state))
        return self._settings[state]

    def _make_setting(self, case: StateCase) -> LoadCase | None:
        from geartrain.dynamics.torques import LoadCase, speed_forms

        solution = solve(self._whole, case, self.signs, None)
        if solution.verdict.kind not in ("determined", "free"):
            return None
        forms = speed_forms(self.equations(case.state)) if solution.verdict.kind == "free" else {}
        return LoadCase(
            self.declaration, self.tree, self.circuits, self.signs, case, solution.speeds, self._teeth, self.pins, forms
        )

    def equations(self, state: str | None = None) -> WillisSystem:
        """The labelled Willis system of one state."""
        case = self._case(state)
        return assemble_willis_system(
            tuple(self.declaration.links), self.declaration.frame, self.circuits, case, self.signs
        )

    def solve(self, state: str | None = None, output: str | None = None, method: Method = "auto") -> Answer:
        """Speeds and judged outputs in one state.

        output   an output or a link: only the circuits that drive it are solved
        method   "exact", "floats", or "auto": exact unless the coupled system is too dense for it; speeds in
                 radians beside others in turns are rounded to floats in any case
        """
        case, wanted = self._case(state), None
        part = self._whole
        if output is not None:
            case, wanted = self._only(case, output)
            part = self._pruned(case, wanted)
        _check_choice("method", method, get_args(Method))
        if method == "floats":
            return self._answer_in_floats(part, case, wanted)
        try:
            solution = solve(part, case, self.signs, None if method == "exact" else EXACT_BUDGET)
        except TooDenseError:
            return self._answer_in_floats(part, case, wanted)
        if not case.exact:  # radians beside turns are no fractions, and none are shown
            return self._rounded(part, case, wanted, solution)
        verdict, speeds = solution.verdict, solution.speeds
        return self._judged(case, verdict, speeds, solution.relative, wanted, len(part.circuits), solution.ratios)

    def answers(self) -> Iterator[Answer]:
        """The answer of every state, in the order declared."""
        return (self.solve(state) for state in (self.states or (None,)))

    def sensitivity(self, answer: Answer) -> Iterator[Sensitivity]:
        """What one tooth fewer or more on each uncertain wheel does to each output of an answer."""
        case = self._case(answer.state)

        def solve_with(circuits: Sequence[Circuit]) -> Any:
            return solve(self._part(circuits, tuple(self.declaration.links)), case, self.signs).relative

        return sensitivity(self.declaration, list(answer.outputs.values()), solve_with, self.circuits)

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
        from geartrain.kinematics.speeds import solve_floats

        system = self.equations(state)
        if inputs is not None:
            _check_cases(inputs, tuple(self._case(state).inputs))
        for link in condition_of:
            _check_choice("link", link, system.links)
        return solve_floats(system, self._redundant(self._whole.reduced), inputs, condition_of)

    @cached_property
    def _whole(self) -> SolvedPart:
        return self._part(self.circuits, tuple(self.declaration.links))

    def _part(self, circuits: Sequence[Circuit], links: tuple[str, ...]) -> SolvedPart:
        declared = self.declaration
        first = (*declared.inputs, *(link for state in declared.states.values() for link in state.inputs or ()))
        return SolvedPart(links, declared.frame, circuits, first)

    def _narrowed(self, case: StateCase, verdict: Verdict, known: bool, wanted: Sequence[str]) -> Verdict:
        """The verdict on one output: it may be determined, or held still, in a train that is free.

        known   whether the output's speed is determined
        """
        if not known:
            return verdict
        if not any(case.inputs.values()) and (whole := self._verdict(case)).kind == "locked":
            return whole  # nothing is driven, and nothing could be
        follows = f"follows from {', '.join(case.inputs)}" if case.inputs else "is 0, for it is held"
        seen = f"{wanted[0]} seen from {wanted[1]}" if wanted[1] != self.declaration.frame else wanted[0]
        return Verdict("determined", f"the speed of {seen} {follows}", loops=verdict.loops)

    def _verdict(self, case: StateCase) -> Verdict:
        """The verdict on the whole train."""
        try:
            return solve(self._whole, case, self.signs).verdict
        except TooDenseError:
            return exact_verdict(self._whole.reduced, case, self.signs)

    def _pruned(self, case: StateCase, wanted: Sequence[str]) -> SolvedPart:
        """The part of the train that can matter to some links."""
        held = {link for lock in case.locks for link in lock}
        kept = {self.declaration.frame, *wanted, *case.inputs, *case.fixed, *held}
        circuits = relevant_circuits(self.circuits, kept)
        kept.update(link for circuit in circuits for link in (circuit.i, circuit.j, circuit.carrier))
        return self._part(circuits, tuple(link for link in self.declaration.links if link in kept))

    @staticmethod
    def _redundant(reduced: ReducedSystem) -> list[str]:
        return [reduced.components.circuits[circuit].id for circuit in reduced.components.closing]

    def _case(self, state: str | None) -> StateCase:
        known = self.states
        if state is None and len(known) > 1:
            raise QuestionError(
                Problem(
                    f"'{self.name}' has states",
                    "speeds differ between them",
                    f"name one of: {', '.join(known)}",
                )
            )
        if state is None and known:
            state = known[0]
        if state is not None and state not in known:
            fix = suggest(state, known) if known else "leave the state out"
            raise QuestionError(Problem(f"'{self.name}' has no state '{state}'", "it is not declared", fix))
        return self.cases[state]

    def _only(self, case: StateCase, output: str) -> tuple[StateCase, tuple[str, str]]:
        """The case with one output, and the links that output is made of."""
        declared = case.outputs.get(output)
        if declared is None and output not in self.declaration.links:
            known = dict.fromkeys([*case.outputs, *self.declaration.links])
            raise QuestionError(
                Problem(f"'{self.name}' has no output or link '{output}'", "it is not declared", suggest(output, known))
            )
        outputs = {output: declared} if declared else {}
        frame = self.declaration.frame
        links = (declared.of or output, declared.relative_to or frame) if declared else (output, frame)
        return replace(case, outputs=outputs), links

    def _answer_in_floats(self, part: SolvedPart, case: StateCase, wanted: tuple[str, str] | None) -> Answer:
        """Floats with their estimate, and with their true error where the exact answer is cheap."""
        from geartrain.kinematics.speeds import solve_floats

        truth: Mapping[str, Fraction] = {}
        try:
            solution = solve(part, case, self.signs)
        except TooDenseError:
            verdict = exact_verdict(part.reduced, case, self.signs)
            still = verdict.kind == "locked" and not any(case.inputs.values())
            solution = Solution(verdict, dict.fromkeys(part.links, Fraction(0)) if still else {}, {}, self.signs)
        else:
            truth = solution.speeds
        if not solution.verdict:  # no square system to factorise
            return self._rounded(part, case, wanted, solution)
        system = assemble_willis_system(part.links, part.frame, part.circuits, case, self.signs)
        found = solve_floats(system, self._redundant(part.reduced))
        powers = found.exponents.values[:, 0].tolist()
        speeds = dict(zip(part.links, map(scaled, found.speeds.values[:, 0].tolist(), powers), strict=True))
        estimates = dict(zip(part.links, map(scaled, found.estimate.values[:, 0].tolist(), powers), strict=True))
        accuracy = {
            link: SpeedAccuracy(estimates[link], rounded(abs(Fraction(speed) - truth[link])) if link in truth else None)
            for link, speed in speeds.items()
        }

        def relative(of: str, base: str) -> SpeedValue | None:
            return relative_speed(of, base, speeds.get, self.signs)

        return self._judged(case, solution.verdict, speeds, relative, wanted, len(part.circuits), None, accuracy)

    def _rounded(self, part: SolvedPart, case: StateCase, wanted: tuple[str, str] | None, solution: Solution) -> Answer:
        """Exact speeds as floats."""

        def relative(of: str, base: str) -> float | None:
            speed = solution.relative(of, base)
            return None if speed is None else _nearest(speed)

        floats = {link: _nearest(speed) for link, speed in solution.speeds.items()}
        accuracy = {link: SpeedAccuracy(abs(speed) * _UNIT_ROUNDOFF, None) for link, speed in floats.items()}
        return self._judged(case, solution.verdict, floats, relative, wanted, len(part.circuits), None, accuracy)

    def _judged(
        self,
        case: StateCase,
        verdict: Verdict,
        speeds: Mapping[str, SpeedValue],
        relative: Relative,
        wanted: tuple[str, str] | None,
        work: int,
        ratios: Mapping[str, Mapping[str, Fraction]] | None,
        accuracy: Mapping[str, SpeedAccuracy] | None = None,
    ) -> Answer:
        """The answer with its outputs judged, cut down to the links in `wanted`; no `ratios` means floats."""
        declared = self.declaration
        if wanted is not None:
            verdict = self._narrowed(case, verdict, relative(*wanted) is not None, wanted)
            shown = wanted if case.outputs else wanted[:1]
            speeds = {link: speeds[link] for link in shown if link in speeds}
            accuracy = {link: accuracy[link] for link in shown if link in accuracy} if accuracy else None
        results = judge_outputs(declared, case, relative, self.is_rotation)
        return Answer(
            self.name,
            case.state,
            declared.place(*case.loc),
            declared.unit_name,
            verdict,
            speeds,
            {result.name: result for result in results},
            ratios or {},
            "floats" if ratios is None else "exact",
            accuracy or {},
            work,
        )

    def _repr_html_(self) -> str:
        declared = self.declaration
        title = f"<p><b>{html.escape(declared.name)}</b> {html.escape(declared.title)}</p>"
        return title + "".join(answer._repr_html_() for answer in self.answers())


def _nearest(speed: Fraction) -> float:
    """The nearest float; `RangeError` where there is none."""
    value = as_float(speed)
    if value is None:
        why = "its ratio would come out as 0 or infinity"
        raise RangeError(Problem("a speed leaves the range of float64", why, "use the exact method, and no radians"))
    return value


def _check_choice(kind: str, name: str, known: Sequence[str]) -> None:
    """Raise `QuestionError` for a name that is none of those known."""
    if name not in known:
        raise QuestionError(Problem(f"there is no {kind} '{name}'", "it is not known here", suggest(name, known)))


def _check_cases(inputs: Mapping[str, Sequence[float]], declared: Sequence[str]) -> None:
    """Raise `QuestionError` unless each input, and no other link, has one finite speed a case."""
    for link in inputs:
        _check_choice("input", link, declared)
    for link in declared:
        if link not in inputs:
            why = "every input of the state needs its speeds"
            raise QuestionError(Problem(f"input '{link}' is missing", why, f"give speeds of '{link}' too"))
    if len({len(speeds) for speeds in inputs.values()}) > 1:
        why = "there is one speed a case for each input"
        raise QuestionError(Problem("the inputs have unequal numbers of cases", why, "give each as many"))
    for link, speeds in inputs.items():
        if not all(map(isfinite, speeds)):
            raise QuestionError(Problem(f"a speed of '{link}' is not finite", "nothing follows from it", "mend it"))


def _count(ways: list[tuple[GearMesh, tuple[str, ...]]], mesh: GearMesh, state: str | None) -> None:
    """Count a state for one way in which a pair is driven; a way that is certain somewhere is so in the list."""
    own = () if state is None else (state,)
    for at, (known, states) in enumerate(ways):
        if known.driver == mesh.driver:
            ways[at] = (known if known.who.known else mesh), states + own
            return
    ways.append((mesh, own))
