"""All that is asked when counts are in doubt: which wheels, which outputs are known, what must hold for it to turn."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod

from geartrain.errors import Problem, QuestionError, suggest
from geartrain.kinematics.formulas import Formula, find_formulas
from geartrain.search.join.product_lists import Domains
from geartrain.search.join.wheel_monomials import IntervalConstraint
from geartrain.search.posterior.observations import (
    LIKELIHOOD_KINDS,
    LikelihoodKind,
    ObservedOutput,
    observations_of,
)
from geartrain.search.posterior.priors import ToothCountPrior
from geartrain.search.train.output_requirements import find_output_requirements, find_turning_conditions
from geartrain.train import Train


@dataclass(frozen=True, slots=True)
class InferenceProblem:
    """Wheels in doubt and what is known of the outputs.

    name        of the train
    doubts      wheel -> its counts and their weights, in the order declared
    witnesses   outputs of which something is known and that a wheel in doubt moves
    outputs     every output that a wheel in doubt moves -> its function
    conditions  what must hold for the train to turn: loops that close, links driven in one way
    remarks     what the reader should know
    soft        False: a combination fits or it does not; True: it agrees less and less, exp(-misfit / 2), up
                to `observations.FAR` tolerances
    """

    name: str
    doubts: Mapping[str, ToothCountPrior]
    witnesses: tuple[ObservedOutput, ...]
    outputs: Mapping[str, Formula]
    conditions: tuple[IntervalConstraint, ...]
    remarks: tuple[str, ...] = ()
    soft: bool = False

    @property
    def domains(self) -> Domains:
        """Wheel -> its counts, ascending."""
        return {wheel: doubt.counts for wheel, doubt in self.doubts.items()}

    @property
    def moved(self) -> dict[str, ToothCountPrior]:
        """The doubts that matter to a witness, or to whether the train turns, in the order declared."""
        functions = [witness.formula for witness in self.witnesses] + [one.function for one in self.conditions]
        wheels = {wheel for function in functions for wheel in function.wheels}
        return {wheel: doubt for wheel, doubt in self.doubts.items() if wheel in wheels}

    @property
    def combinations(self) -> int:
        """Combinations of counts there are."""
        return prod(len(doubt.counts) for doubt in self.doubts.values())

    @property
    def total(self) -> int:
        """The sum of the weights of all combinations, as whole numbers."""
        return prod(doubt.total for doubt in self.doubts.values())

    def weight(self, teeth: Mapping[str, int]) -> int:
        """The prior weight of some wheels' counts; of all wheels, the prior probability is this over `total`."""
        return prod(self.doubts[wheel].weight(count) for wheel, count in teeth.items())


def build_inference_problem(
    train: Train,
    doubts: Sequence[ToothCountPrior],
    state: str | None = None,
    *,
    outputs: Sequence[str] = (),
    tolerance: Fraction | None = None,
    against: LikelihoodKind = "all",
    scale: Fraction = Fraction(1),
    soft: bool = False,
) -> InferenceProblem:
    """The question of a train in one state, or in all its states at once.

    outputs     those that count as evidence and are shown; all without any
    tolerance   relative, for targets that have none of their own
    against     which claims count: "targets", "figures" (`expect` and `published`), or "all"
    scale       multiplies every tolerance

    Raises `QuestionError` for states and outputs the train does not have, for asked outputs of which nothing is
    known, where nothing is known of any output that moves, and for trains that never turn.
    """
    _check(train, state, against, tolerance, scale)
    states: Sequence[str | None] = tuple(train.states) or (None,) if state is None else (state,)
    domains = {doubt.wheel: doubt.counts for doubt in doubts}
    found = [(one, find_formulas(train, one, domains)) for one in states]
    _check_outputs(train, states, outputs)
    witnesses: list[ObservedOutput] = []
    moved: set[str] = set()
    known: set[str] = set()
    shown: dict[str, Formula] = {}
    conditions: dict[IntervalConstraint, None] = {}
    remarks: list[str] = []
    for one, formulas in found:
        prefix = f"{one}: " if len(states) > 1 else ""
        conditions |= dict.fromkeys(find_turning_conditions(train, formulas))
        here = {name: f for name, f in formulas.outputs.items() if f.wheels and (not outputs or name in outputs)}
        moved |= here.keys()
        shown |= {prefix + name: formula for name, formula in here.items()}
        for asking in find_output_requirements(train, train.case(one), formulas.outputs, tolerance):
            if outputs and asking.name not in outputs:
                continue
            formula = formulas.outputs[asking.name]
            witness = ObservedOutput(prefix + asking.name, formula, observations_of(asking.demands, against, scale))
            if witness.claims and formula.wheels:
                witnesses.append(witness)
                known.add(asking.name)
            else:
                remarks += _remarks(witness)
        remarks += [f"the inputs do not determine '{prefix}{name}'" for name in formulas.undetermined]
    _check_known(moved, known, outputs)
    by_wheel = {doubt.wheel: doubt for doubt in doubts}
    return InferenceProblem(train.name, by_wheel, tuple(witnesses), shown, tuple(conditions), tuple(remarks), soft)


def _remarks(witness: ObservedOutput) -> Iterator[str]:
    """On an output that is no evidence: no wheel in doubt moves it, or no tolerance is stated."""
    if not witness.claims:
        yield f"'{witness.name}' is not judged: nothing with a tolerance is asked of it"
    elif not witness.fits(witness.formula.constant):
        yield f"no wheel in doubt moves '{witness.name}', and it is not as asked: {witness.text}"


def _check(
    train: Train, state: str | None, against: LikelihoodKind, tolerance: Fraction | None, scale: Fraction
) -> None:
    train.check_state(state)
    if against not in LIKELIHOOD_KINDS:
        raise QuestionError(
            Problem(f"there are no claims called '{against}'", "others are", suggest(against, LIKELIHOOD_KINDS))
        )
    if tolerance is not None and tolerance < 0:
        raise QuestionError(Problem(f"a tolerance of {tolerance}", "it is a distance", "give 0 or more"))
    if scale < 0:
        raise QuestionError(Problem(f"tolerances times {scale}", "a tolerance is a distance", "give 0 or more"))


def _check_outputs(train: Train, states: Sequence[str | None], outputs: Sequence[str]) -> None:
    known = dict.fromkeys(name for one in states for name in train.case(one).outputs)
    for name in outputs:
        if name not in known:
            fix = suggest(name, known) if known else "declare it under `outputs`"
            raise QuestionError(Problem(f"'{train.name}' has no output '{name}'", "it is not declared", fix))


def _check_known(moved: Collection[str], known: Collection[str], outputs: Sequence[str]) -> None:
    """moved, known: outputs that a wheel in doubt moves, and those of them of which something is known."""
    for name in outputs:
        if name not in moved:
            why = "no wheel in doubt moves it"
            raise QuestionError(Problem(f"output '{name}' tells nothing of the counts", why, "leave it out"))
        if name not in known:
            raise _nothing_known(f"nothing is known of output '{name}'")
    if not known:
        raise _nothing_known("nothing is known of any output that the wheels in doubt move")


def _nothing_known(what: str) -> QuestionError:
    fix = "declare `targets` with a `tolerance`, or an `expect`; or give --tolerance for targets that have none"
    return QuestionError(Problem(what, "counts can only be weighed against something with a tolerance", fix))
