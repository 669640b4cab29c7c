"""Kinematics of a train: joint tree, circuits, mobility and speeds, each computed once on first access.

A state is solved in four steps. Its inputs, brakes and locks are read; the part of the train that affects the requested
links is found; the method is chosen; and the outputs are evaluated. Remarks are not errors; they describe conventions
and mean values in the answers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property
from itertools import permutations
from math import isfinite
from sys import float_info
from typing import TYPE_CHECKING, Any, Literal, final, get_args

from geartrain.errors import DeclarationError, Loc, Problem, QuestionError, RangeError, check_choice, suggest
from geartrain.kinematics.answer import Answer, SpeedAccuracy, Verdict
from geartrain.kinematics.circuits import (
    Axes,
    Circuit,
    Tree,
    check_pallets,
    close_joints,
    couplings_on_axes,
    find_circuits,
    find_tree,
)
from geartrain.kinematics.circuits.fundamental import bevels_on_one_side
from geartrain.kinematics.components import SolvedPart, relevant_circuits
from geartrain.kinematics.judged_outputs import (
    OutputResult,
    Relative,
    Sensitivity,
    SpeedValue,
    judge_outputs,
    sensitivity,
)
from geartrain.kinematics.planet_copies import check_copies, has_copies
from geartrain.kinematics.speeds import EXACT_BUDGET, Solution, exact_verdict, solve
from geartrain.kinematics.willis_system import WillisSystem, assemble_willis_system, relative_speed
from geartrain.numerics.containers import LazyMapping
from geartrain.numerics.elimination import TooDenseError
from geartrain.numerics.exact import as_float, touches_pi, with_other_pi
from geartrain.numerics.results import Shown
from geartrain.train import StateCase, Train

if TYPE_CHECKING:
    from geartrain.kinematics.gridlock.removal import Gridlock
    from geartrain.kinematics.speeds import FloatSpeeds, Mobility
    from geartrain.teeth.coupling import Coupling


_CONTINUOUS = 20  # teeth of a mate with which a wheel of two teeth may still drive continuously

Method = Literal["auto", "exact", "sparse", "floats"]
"""Method of solution; "floats" is an older name for "sparse"."""


@final
@dataclass(frozen=True, eq=False)
class TrainKinematics(Shown):
    """Kinematic analysis of a declared train. It does not depend on tooth forms."""

    declaration: Train
    """Declaration of the train."""

    # ------------------------------------------------------------------------------------------ joints and circuits

    def _summary(self) -> str:
        return self.declaration.name

    @cached_property
    def tree(self) -> Tree:
        """Turning and sliding pairs as a spanning tree rooted at the frame."""
        tree = find_tree(self.declaration)
        if has_copies(self.declaration):
            check_copies(self.declaration, tree)
        check_pallets(self.declaration, tree)
        return tree

    @cached_property
    def circuits(self) -> tuple[Circuit, ...]:
        """Fundamental circuits, one for each gear pair and coupling."""
        return find_circuits(self.declaration, self.tree)

    def circuits_without(self, names: Sequence[str]) -> tuple[Circuit, ...]:
        """Return all circuits except the circuits of the pairs whose names are given."""
        known = [circuit.id for circuit in self.circuits]
        for name in (name for name in names if name not in known):
            what = f"'{self.declaration.name}' has no pair '{name}'"
            raise QuestionError(Problem(what, "only declared pairs can be omitted", suggest(name, known)))
        return tuple(circuit for circuit in self.circuits if circuit.id not in names)

    @cached_property
    def _axes(self) -> Axes:
        return Axes(self.declaration, self.tree)

    @cached_property
    def signs(self) -> Mapping[str, int]:
        """Sign of each link's axis, by link: -1 if it points against the reference direction of the axes parallel to
        it. Links with the sign 1 are omitted.
        """
        return self._axes.link_signs

    @cached_property
    def joint_sums(self) -> frozenset[str]:
        """Links whose speed is a sum of joint speeds over non-parallel joints, not the speed of a rotation."""
        return self._axes.joint_sums

    def is_rotation(self, of: str, base: str) -> bool:
        """Return True if all axes between two links are parallel, so that their relative motion is a rotation."""
        # without sums all axes between links and the frame are parallel, so that no path is examined
        return not self.joint_sums or self._axes.is_rotation(of, base)

    # -------------------------------------------------------------------------------------------------------- states

    @cached_property
    def cases(self) -> Mapping[str | None, StateCase]:
        """Inputs, brakes and locks of each state, by name of the state (None for a train without states). A brake or
        lock across several axes is represented by locks of single joints.
        """
        declared = self.declaration.cases
        return {case.state: case for case in close_joints(self.declaration, self.tree, declared)}

    @property
    def usable_states(self) -> tuple[str | None, ...]:
        """States in which speeds can be calculated; (None,) for a train without states."""
        return tuple(state for state, case in self.cases.items() if not case.problems)

    def case(self, state: str | None = None) -> StateCase:
        """Return the inputs, brakes and locks of one state.

        state   name of a declared state; None only for a train without states
        """
        case = self.cases[self.declaration.single_state(state)]
        if case.problems:
            raise DeclarationError(case.problems)
        return case

    # ------------------------------------------------------------------------------------------- mobility and speeds

    @cached_property
    def whole(self) -> SolvedPart:
        """All links and circuits of the train. Its components and its reduced system are computed on first use."""
        return self._solved_part(self.circuits, tuple(self.declaration.links))

    @cached_property
    def mobility(self) -> Mobility:
        """Mobility by counting and by exact rank, with redundant and locking loops (section 6 of docs/theory.md)."""
        from geartrain.kinematics.speeds import find_mobility

        declared = self.declaration
        return find_mobility(self.whole.reduced, len(declared.revolutes), sliding_pairs=len(declared.slides))

    @cached_property
    def is_placed(self) -> bool:
        """True if pairs form loops, and axes have positions or directions, which the assembly condition requires."""
        return self.declaration.has_placed_axes and bool(self.mobility.redundant or self.mobility.locked)

    @cached_property
    def gridlock(self) -> Gridlock:
        """Locked parts of the train, and the meshes whose removal frees it."""
        from geartrain.kinematics.gridlock import find_gridlock

        return find_gridlock(self.whole, self.mobility)

    @cached_property
    def remarks(self) -> tuple[Problem, ...]:
        """Notes on conventions and mean values used in the results of a valid declaration; they are not errors."""
        return tuple(self._find_remarks())

    def _find_remarks(self) -> Iterator[Problem]:
        """Yield notes on senses of rotation by convention, on intermittent drives, and on non-uniform couplings."""
        train = self.declaration
        places: dict[str, Loc] = {gear.name: ("gears", at) for at, gear in enumerate(train.gears)}
        places |= {name: ("couplings", at) for at, each in enumerate(train.couplings) for name in each.row_names}
        for circuit in self.circuits:
            if circuit.note:
                yield Problem(f"'{circuit.id}': {circuit.note}", "", "", train.place(*places[circuit.id]))
        why = (
            "the mean ratio is exact; the motion is intermittent: a finger drives in steps; declare it as `kind: step`"
        )
        for at, gear in enumerate(train.gears):
            for name, mate in permutations(gear.pair):
                wheel, other = train.wheels[name][1], train.wheels[mate][1]
                few = wheel.count == 1 or (wheel.count == 2 and (other.count or 0) > _CONTINUOUS)
                # teeth of helical wheels overlap
                if few and wheel.kind == "spur" and wheel.helix_angle is None and train.form_of(gear) is None:
                    teeth = "one tooth" if wheel.count == 1 else "two teeth"
                    what = f"wheel '{name}' has {teeth}, which cannot drive continuously"
                    yield Problem(what, why, "", train.place("gears", at))
        for at, coupling in enumerate(couplings_on_axes(train, self.tree)):
            # a page in a browser has no numpy, and then only exact results
            with suppress(ModuleNotFoundError):
                if remark := coupling.remark:
                    yield Problem(f"'{coupling.name}' {remark}", "", "", train.place("couplings", at))

    def solution(self, case: StateCase) -> Solution:
        """Return the exact speeds and the verdict for one state, without a limit on the computing time.

        case   one of `cases`
        """
        return solve(self.whole, case, self.signs, None)

    def equations(self, state: str | None = None) -> WillisSystem:
        """Return the Willis equations of one state as a linear system with labelled rows and columns (docs/theory.md,
        6).

        state   a declared state; None only for a train without states
        """
        return self.case_equations(self.case(state))

    def case_equations(self, case: StateCase) -> WillisSystem:
        """Return the Willis equations for the inputs, brakes and locks in `case`, which may differ from the declared
        ones.

        case   inputs, brakes and locks in the form of `cases`: each lock blocks a single joint
        """
        return self._system(self.whole, case)

    def solve(self, state: str | None = None, output: str | None = None, method: Method = "auto") -> Answer:
        """Return the speeds and evaluated outputs in one state; see `GearTrain.solve`.

        state    name of a declared state; None only for a train without states
        output   name of an output or a link; only the circuits that can affect it are solved
        method   method of solution
        """
        wanted, part, case = None, self.whole, self.cases[self.declaration.single_state(state)]
        if output is not None:
            case, wanted = self.single_output(case, output)
            part = self._relevant_part(case, wanted)
        check_choice("method", method, get_args(Method))
        if case.problems:
            verdict = Verdict("refused", "; ".join(problem.text for problem in case.problems))
            return self._build_answer(case, verdict, {}, lambda of, base: None, wanted, 0, {})
        solution, in_floats = None, method in ("sparse", "floats")
        with suppress(TooDenseError):
            solution = solve(part, case, self.signs, None if method == "exact" else EXACT_BUDGET)
        if solution is None or in_floats:
            try:
                return self._answer_in_floats(part, case, wanted, solution)
            except RangeError:  # a speed has no correct digit in floats
                if in_floats:
                    raise
            solution = solve(part, case, self.signs, None)
        if not case.exact:  # ratios of radians to turns are irrational
            return self._rounded_answer(part, case, wanted, solution)
        verdict, speeds = solution.verdict, solution.speeds
        return self._build_answer(case, verdict, speeds, solution.relative, wanted, len(part.circuits), solution.ratios)

    def sensitivity(self, answer: Answer) -> Iterator[Sensitivity]:
        """Yield the change of each output if an uncertain wheel has one tooth fewer or one tooth more.

        answer   result of `solve`
        """
        case = self.case(answer.state)

        def solve_with(circuits: Sequence[Circuit]) -> Any:
            return self._solved_with(circuits, case)

        return sensitivity(self.declaration, list(answer.outputs.values()), solve_with, self.circuits)

    def floats(self, state: str | None = None, inputs: Mapping[str, Sequence[float]] | None = None) -> FloatSpeeds:
        """Return float64 speeds with error estimates, computed by one sparse LU factorisation for all input speeds.

        state    name of a declared state; None only for a train without states
        inputs   speeds by input link, one for each case [the train's unit of speed]; None for the declared speeds
        """
        from geartrain.kinematics.speeds import solve_floats

        system, case = self.equations(state), self.case(state)
        if inputs is not None:
            _check_inputs(inputs, tuple(case.inputs))
        return solve_floats(system, inputs)

    def single_output(self, case: StateCase, output: str) -> tuple[StateCase, tuple[str, str]]:
        """Return the case of a state restricted to a single output, the link whose speed is the output, and the link
        relative to which this speed is measured.

        case     one of `cases`
        output   name of an output or a link
        """
        train = self.declaration
        declared = case.outputs.get(output)
        if declared is None and output not in train.links:
            known = dict.fromkeys([*case.outputs, *train.links])
            raise QuestionError(
                Problem(
                    f"'{train.name}' has no output or link '{output}'",
                    "speeds are reported for declared outputs and links",
                    suggest(output, known),
                )
            )
        outputs = {output: declared} if declared else {}
        of, base = declared.links(output, train.frame) if declared else (output, train.frame)
        return replace(case, outputs=outputs), (of, self.tree.reference(of, base))

    def seen_links(self, state: str | None, names: Sequence[str] = ()) -> dict[str, tuple[str, str]]:
        """Return for each output the link whose speed the output reports, and the link relative to which this speed is
        measured.

        state   a declared state; None only for a train without states
        names   outputs or links; by default all outputs, or all links of a train without outputs
        """
        case = self.case(state)
        chosen = names or tuple(case.outputs) or tuple(self.declaration.links)
        return {name: self.single_output(case, name)[1] for name in chosen}

    # ------------------------------------------------------------------------------------------ the part that matters

    def _solved_part(self, circuits: Sequence[Circuit], links: tuple[str, ...]) -> SolvedPart:
        declared = self.declaration
        # inputs of all states, because the components are computed once for all states
        first = (*declared.inputs, *(link for state in declared.states.values() for link in state.inputs or ()))
        return SolvedPart(links, declared.frame, circuits, first)

    def _relevant_part(self, case: StateCase, wanted: Sequence[str]) -> SolvedPart:
        held = {link for lock in case.locks for link in lock}
        kept = {self.declaration.frame, *wanted, *case.inputs, *case.fixed, *held}
        circuits = relevant_circuits(self.circuits, kept)
        kept.update(link for circuit in circuits for link in (circuit.i, circuit.j, circuit.carrier, *circuit.bases))
        return self._solved_part(circuits, tuple(link for link in self.declaration.links if link in kept))

    def _system(self, part: SolvedPart, case: StateCase) -> WillisSystem:
        components = part.reduced.components
        redundant = [components.circuits[circuit].id for circuit in components.closing]
        return assemble_willis_system(part.links, part.frame, part.circuits, case, self.signs, redundant)

    # --------------------------------------------------------------------------------------------------- three methods

    def _answer_in_floats(
        self, part: SolvedPart, case: StateCase, wanted: tuple[str, str] | None, solution: Solution | None
    ) -> Answer:
        """Return the answer with float speeds, error estimates and, if the exact solution is known, true errors."""
        from geartrain.kinematics.speeds import solve_floats

        truth = solution.speeds if solution is not None else {}
        system = self._system(part, case)
        if solution is None:
            verdict = exact_verdict(part.reduced, case, self.signs)  # by elimination modulo a prime
            still = verdict.kind == "locked" and not any(case.inputs.values())
            solution = Solution(verdict, dict.fromkeys(part.links, Fraction(0)) if still else {}, {}, self.signs)
        if not solution.verdict:  # the system is not square
            return self._rounded_answer(part, case, wanted, solution)
        found = solve_floats(system)
        speeds: dict[str, SpeedValue] = dict(zip(part.links, found.speeds.values[:, 0].tolist(), strict=True))

        def accuracy() -> dict[str, SpeedAccuracy]:
            estimates = found.estimate.values[:, 0].tolist()
            return {
                link: SpeedAccuracy(
                    estimate,
                    float(abs(Fraction(speed) - truth[link])) if link in truth else None,
                    found.condition.get(link),
                )
                for (link, speed), estimate in zip(speeds.items(), estimates, strict=True)
            }

        def residual() -> dict[str, float]:
            return dict(zip(found.residual.labels[0], found.residual.values[:, 0].tolist(), strict=True))

        def relative(of: str, base: str) -> SpeedValue | None:
            return relative_speed(of, base, speeds.get, self.signs)

        lazy_accuracy, work = LazyMapping(accuracy), len(part.circuits)
        answer = self._build_answer(case, solution.verdict, speeds, relative, wanted, work, None, lazy_accuracy)
        return replace(answer, residual=LazyMapping(residual))

    def _rounded_answer(
        self, part: SolvedPart, case: StateCase, wanted: tuple[str, str] | None, solution: Solution
    ) -> Answer:
        def relative(of: str, base: str) -> float | None:
            speed = solution.relative(of, base)
            return None if speed is None else _nearest(speed)

        floats = {link: _nearest(speed) for link, speed in solution.speeds.items()}
        accuracy = {link: SpeedAccuracy(abs(speed) * float_info.epsilon / 2, None) for link, speed in floats.items()}
        return self._build_answer(case, solution.verdict, floats, relative, wanted, len(part.circuits), None, accuracy)

    def _build_answer(
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
        """Return the answer with the outputs compared with their declared expectations. It is restricted to the links
        in `wanted` unless this is None. `work` is the number of circuits whose equations were solved; `ratios` is None
        for float speeds.
        """
        declared = self.declaration
        if verdict.kind in ("locked", "contradictory"):
            # two bevel wheels on one side of a third are a likely cause of a lock or contradiction
            advice = (
                f"; '{one}' and '{other}' meet '{shared}' from the same side: give one of them `facing: -1`"
                for one, other, shared in bevels_on_one_side(declared, self.circuits, self.is_rotation)
            )
            verdict = replace(verdict, text=verdict.text + "".join(advice))
        if wanted is not None:
            verdict = self._output_verdict(case, verdict, relative(*wanted) is not None, wanted)
            # a requested link is measured relative to the frame, which need not be shown
            shown = wanted if case.outputs else wanted[:1]
            # other links were solved only as far as the output needs them
            speeds = {link: speeds[link] for link in shown if link in speeds}
            if accuracy is not None:
                every = accuracy
                accuracy = LazyMapping(lambda: {link: every[link] for link in shown if link in every})

        seen = self._seen(relative)
        deviation = self._ratio_tolerance(case, seen)

        def outputs() -> dict[str, OutputResult]:
            found = judge_outputs(declared, case, seen, self.is_rotation)
            if deviation is not None:
                found = (replace(each, tolerance=deviation(each.of, each.relative_to)) for each in found)
            return {each.name: each for each in found}

        def tolerances() -> dict[str, Fraction]:
            assert deviation is not None
            found = {link: deviation(link, declared.frame) for link in speeds}
            return {link: tolerance for link, tolerance in found.items() if tolerance}

        return Answer(
            declared.name,
            case.state,
            "" if verdict and case.expect == "determined" else declared.place(*case.loc),
            declared.unit_name,
            verdict,
            speeds,
            LazyMapping(outputs),
            ratios or {},
            "floats" if ratios is None else "exact",
            {} if accuracy is None else accuracy,
            work,
            tolerances={} if deviation is None else LazyMapping(tolerances),
            expected=case.expect,
            sliding=declared.sliding,
            contains_pi={} if ratios is None else LazyMapping(lambda: self._with_pi(case, speeds, seen)),
            one_way=case.one_way,
            notes=case.notes,
        )

    def _seen(self, relative: Relative) -> Relative:
        """Return the function `relative` of two links with the second link replaced by `Tree.reference`, relative to
        which the speed of the first link is measured.
        """
        return lambda of, base: relative(of, self.tree.reference(of, base))

    def _solved_with(self, circuits: Sequence[Circuit], case: StateCase) -> Relative:
        """Return the function for the relative speed of two links if the train has the given circuits."""
        return self._seen(solve(self._solved_part(circuits, tuple(self.declaration.links)), case, self.signs).relative)

    def _with_pi(self, case: StateCase, speeds: Mapping[str, SpeedValue], seen: Relative) -> dict[str, bool]:
        """Return, for each link and output, True if its speed changes when another rational number replaces pi. The
        result is empty if no ratio contains pi.
        """
        if not any(circuit.travels and touches_pi(circuit.ratio) for circuit in self.circuits):
            return {}
        other = [_with_ratio(each, with_other_pi(each.ratio)) if each.travels else each for each in self.circuits]
        found, frame = self._solved_with(other, case), self.declaration.frame
        changes = {link: found(link, frame) != speed for link, speed in speeds.items()}
        for name, output in case.outputs.items():
            of, base = output.links(name, frame)
            changes[name] = found(of, base) != seen(of, base)
        return changes

    def _ratio_tolerance(self, case: StateCase, relative: Relative) -> Callable[[str, str], Fraction] | None:
        """Return a function of two links that returns the sum of the changes of their relative speed if each
        approximate ratio in turn is changed by its tolerance. Return None if all ratios are exact.
        """
        approximate = [each for each in self.declaration.couplings if each.bounds is not None]
        if not approximate:
            return None

        def changed(coupling: Coupling, mean: Fraction) -> Relative:
            circuits = list(self.circuits)
            at = next(at for at, each in enumerate(circuits) if each.id == coupling.name)
            circuits[at] = _with_ratio(circuits[at], circuits[at].ratio * mean / coupling.mean)
            return self._solved_with(circuits, case)

        @cache
        def moved() -> list[list[Relative]]:
            return [[changed(each, mean) for mean in each.bounds or ()] for each in approximate]

        def deviation(of: str, base: str) -> Fraction:
            here = relative(of, base)
            if here is None:
                return Fraction(0)
            most = [max(abs(Fraction((there(of, base) or 0) - here)) for there in each) for each in moved()]
            return sum(most, Fraction(0))

        return deviation

    # -------------------------------------------------------------------------------------------- the verdict on a part

    def _output_verdict(self, case: StateCase, verdict: Verdict, known: bool, wanted: Sequence[str]) -> Verdict:
        """Return the verdict on one output, which may be determined or at rest although other links are free. `known`
        is True if the output's speed is determined.
        """
        if not known:
            return verdict
        if not any(case.inputs.values()) and (whole := self._verdict(case)).kind == "locked":
            return whole  # no input is driven, and none could be
        follows = f"follows from {', '.join(case.inputs)}" if case.inputs else "is 0, because it is fixed"
        seen = f"{wanted[0]} relative to {wanted[1]}" if wanted[1] != self.declaration.frame else wanted[0]
        return Verdict("determined", f"the speed of {seen} {follows}", loops=verdict.loops)

    def _verdict(self, case: StateCase) -> Verdict:
        try:
            return solve(self.whole, case, self.signs).verdict
        except TooDenseError:
            return exact_verdict(self.whole.reduced, case, self.signs)


def _with_ratio(circuit: Circuit, ratio: Fraction) -> Circuit:
    return circuit._replace(a=ratio.denominator, b=-ratio.numerator)


def _nearest(speed: Fraction) -> float:
    """Return the float64 nearest to a speed. Raises `RangeError` if the speed is beyond the range of float64."""
    value = as_float(speed)
    if value is None:
        why = "in float64 it would become 0 or infinite"
        fix = "use `method='exact'`, with input speeds in turns and not in radians"
        raise RangeError(Problem("a speed is outside the range of float64", why, fix))
    return value


def _check_inputs(inputs: Mapping[str, Sequence[float]], declared: Sequence[str]) -> None:
    """Raise `QuestionError` unless exactly the inputs of a state are given, each with one finite speed per case."""
    for link in inputs:
        check_choice("input", link, declared)
    for link in declared:
        if link not in inputs:
            why = "every input of the state needs speeds"
            raise QuestionError(Problem(f"input '{link}' is missing", why, f"give speeds of '{link}' too"))
    if len({len(speeds) for speeds in inputs.values()}) > 1:
        why = "every input needs one speed for each case"
        raise QuestionError(
            Problem("the inputs have unequal numbers of cases", why, "give the same number of speeds for every input")
        )
    for link, speeds in inputs.items():
        if not all(map(isfinite, speeds)):
            raise QuestionError(
                Problem(f"a speed of '{link}' is not finite", "inputs must be finite", "replace inf or nan")
            )
