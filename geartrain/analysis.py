"""A train that answers: the whole corridor on one page, each part made only when asked for."""

from __future__ import annotations

import html
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

from geartrain.circuits import Circuit, Tree, bookkeeping_links, find_circuits, find_tree, link_signs
from geartrain.components import Reduced, find_components, prune, reduce
from geartrain.errors import Problem, QuestionError, Verdict
from geartrain.exact import TooDenseError, decimal
from geartrain.outputs import Number, OutputResult, Sensitivity, judge_outputs, number, sensitivity
from geartrain.speeds import Mobility, Solution, exact_verdict, find_mobility, solve
from geartrain.system import System, assemble
from geartrain.train import Case, Train, declare, suggest

if TYPE_CHECKING:
    from geartrain.graph import Graph
    from geartrain.speeds import FloatSpeeds

Method = Literal["auto", "exact", "floats"]


@dataclass(frozen=True, slots=True)
class Answer:
    """What a train does in one state.

    speeds   link -> speed in the train's unit: exact Fractions, or floats where `method` says so
    outputs  the declared outputs, judged
    method   "exact" or "floats"
    work     circuits that were solved
    """

    train: str
    state: str | None
    unit: str
    verdict: Verdict
    speeds: Mapping[str, Number]
    outputs: Mapping[str, OutputResult]
    ratios: Mapping[str, Mapping[str, Number]]
    method: str
    work: int

    def __getitem__(self, name: str) -> Number:
        """The speed of an output, or of a link."""
        result = self.outputs.get(name)
        speed = result.speed if result is not None else self.speeds.get(name)
        if speed is None:
            raise KeyError(f"'{name}' is no determined output or link of '{self.train}'")
        return speed

    @property
    def failures(self) -> tuple[OutputResult, ...]:
        """Outputs whose `expect` or `published` figure does not hold."""
        return tuple(result for result in self.outputs.values() if not result.holds)

    def __bool__(self) -> bool:
        """True if determined and every expectation holds."""
        return bool(self.verdict) and not self.failures

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; the keys are stable (docs/json.md)."""
        return {
            "state": self.state,
            "verdict": self.verdict.to_dict(),
            "method": self.method,
            "speeds": {link: number(speed) for link, speed in self.speeds.items()},
            "outputs": {name: result.to_dict() for name, result in self.outputs.items()},
        }

    def _repr_html_(self) -> str:
        shown = {name: result.speed for name, result in self.outputs.items()} or dict(self.speeds)
        rows = "".join(
            f"<tr><td>{html.escape(name)}</td><td>{speed}</td><td>{_shown(speed)}</td></tr>"
            for name, speed in shown.items()
        )
        head = f"<tr><th>output</th><th>exact</th><th>{html.escape(self.unit) or 'speed'}</th></tr>"
        return f"<p>{html.escape(self.train)}: {html.escape(str(self.verdict))}</p><table>{head}{rows}</table>"


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

    @classmethod
    def declare(cls, data: Mapping[str, Any]) -> GearTrain:
        """A train from plain data, with the keys of the YAML declaration. Raises `DeclarationError`."""
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
        from geartrain.graph import build_graph

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
    def signs(self) -> Mapping[str, int]:
        """-1 for links whose axis points against the reference direction of its parallels."""
        return link_signs(self.declaration, self.tree)

    @cached_property
    def bookkeeping(self) -> frozenset[str]:
        """Links whose speed is a sum over non-parallel joints, and no rotation."""
        return bookkeeping_links(self.declaration, self.tree)

    @cached_property
    def mobility(self) -> Mobility:
        """Degrees of freedom by count and by exact rank, with redundant and locking loops."""
        return find_mobility(self._reduced, len(self.declaration.revolutes))

    def equations(self, state: str | None = None) -> System:
        """The labelled Willis system of one state."""
        case = self._case(state)
        return assemble(tuple(self.declaration.links), self.declaration.frame, self.circuits, case, self.signs)

    def solve(self, state: str | None = None, output: str | None = None, method: Method = "auto") -> Answer:
        """Speeds and judged outputs in one state.

        output   an output or a link: only the circuits that drive it are solved
        method   "exact", "floats", or "auto": exact unless the coupled system is too dense for it
        """
        case = self._case(state)
        reduced, wanted = self._reduced, None
        if output is not None:
            case, wanted = self._only(case, output)
            reduced = self._reduce(prune(self.circuits, self._kept(case, wanted)))
        if method == "floats":
            return self._answer_in_floats(reduced, case, wanted)
        try:
            solution = solve(reduced, case, self.signs, None if method == "exact" else _budget())
        except TooDenseError:
            return self._answer_in_floats(reduced, case, wanted)
        return self._answer(case, solution, wanted)

    def answers(self) -> Iterator[Answer]:
        """The answer of every state, in the order declared."""
        return (self.solve(state) for state in (self.states or (None,)))

    def sensitivity(self, answer: Answer) -> Iterator[Sensitivity]:
        """What one tooth fewer or more on each uncertain wheel does to each output of an answer."""
        case = self._case(answer.state)

        def solve_with(circuits: Sequence[Circuit]) -> Any:
            return solve(self._reduce(circuits), case, self.signs).speeds.get

        return sensitivity(self.declaration, list(answer.outputs.values()), solve_with, self.circuits, self.signs)

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
        from geartrain.speeds import solve_floats

        return solve_floats(self.equations(state), self._redundant(self._reduced), inputs, condition_of)

    @cached_property
    def _reduced(self) -> Reduced:
        return self._reduce(self.circuits)

    def _reduce(self, circuits: Sequence[Circuit]) -> Reduced:
        declared = self.declaration
        first = [
            *declared.inputs,
            *(link for state in declared.states.values() for link in state.inputs or ()),
        ]
        return reduce(find_components(tuple(declared.links), declared.frame, circuits, first))

    @staticmethod
    def _redundant(reduced: Reduced) -> list[str]:
        return [reduced.components.circuits[circuit].id for circuit in reduced.components.closing]

    def _case(self, state: str | None) -> Case:
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
        return self.declaration.case(state)

    def _only(self, case: Case, output: str) -> tuple[Case, tuple[str, ...]]:
        """The case with one output, and the links that output is made of."""
        declared = case.outputs.get(output)
        if declared is None and output not in self.declaration.links:
            known = dict.fromkeys([*case.outputs, *self.declaration.links])
            raise QuestionError(
                Problem(f"'{self.name}' has no output or link '{output}'", "it is not declared", suggest(output, known))
            )
        outputs = {output: declared} if declared else {}
        links = (declared.of or output, declared.relative_to or self.declaration.frame) if declared else (output,)
        return Case(case.state, case.inputs, case.fixed, case.locks, outputs, case.loc), links

    def _kept(self, case: Case, wanted: Sequence[str]) -> set[str]:
        held = {link for lock in case.locks for link in lock}
        return {self.declaration.frame, *wanted, *case.inputs, *case.fixed, *held}

    def _answer(self, case: Case, solution: Solution, wanted: Sequence[str] | None) -> Answer:
        verdict, speeds = solution.verdict, solution.speeds
        if wanted is not None:
            speeds = {link: speeds[link] for link in wanted if link in speeds}
            if verdict.kind == "free" and all(link in speeds for link in wanted):
                moving = " and ".join(link for link in wanted if link != self.declaration.frame)
                verdict = Verdict("determined", f"the speed of {moving} follows from {', '.join(case.inputs)}")
        return self._judged(case, verdict, speeds, solution.ratios, "exact", solution.work)

    def _answer_in_floats(self, reduced: Reduced, case: Case, wanted: Sequence[str] | None) -> Answer:
        from geartrain.speeds import solve_floats

        verdict = exact_verdict(reduced, case, self.signs)
        work = len(reduced.components.circuits)
        if not verdict:
            return self._judged(case, verdict, {}, {}, "floats", work)
        links = reduced.components.links
        if wanted is not None:  # the pruned circuits say nothing of the links they moved
            meshing = {link for c in reduced.components.circuits for link in (c.i, c.j, c.carrier)}
            links = tuple(link for link in links if link in meshing | self._kept(case, wanted))
        system = assemble(links, self.declaration.frame, reduced.components.circuits, case, self.signs)
        result = solve_floats(system, self._redundant(reduced))
        kept = links if wanted is None else wanted
        values = dict(zip(links, result.speeds.values[:, 0].tolist(), strict=True))
        return self._judged(case, verdict, {link: values[link] for link in kept}, {}, "floats", work)

    def _judged(
        self,
        case: Case,
        verdict: Verdict,
        speeds: Mapping[str, Number],
        ratios: Mapping[str, Mapping[str, Number]],
        method: str,
        work: int,
    ) -> Answer:
        results = judge_outputs(self.declaration, self.tree, case, speeds.get, self.bookkeeping, self.signs)
        outputs = {result.name: result for result in results}
        return Answer(self.name, case.state, self.declaration.unit_name, verdict, speeds, outputs, ratios, method, work)

    def _repr_html_(self) -> str:
        declared = self.declaration
        title = f"<p><b>{html.escape(declared.name)}</b> {html.escape(declared.title)}</p>"
        return title + "".join(answer._repr_html_() for answer in self.answers())


def _shown(speed: Number | None) -> str:
    return "" if speed is None else decimal(speed) if isinstance(speed, Fraction) else f"{speed:.10g}"


def _budget() -> int:
    from geartrain.speeds import EXACT_BUDGET

    return EXACT_BUDGET
