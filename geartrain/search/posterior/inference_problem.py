"""Inference problem of uncertain tooth counts: priors of tooth counts, observations of outputs, and conditions for the
train to turn.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import prod
from typing import Literal

from geartrain.errors import Problem, QuestionError, RangeError, suggest
from geartrain.kinematics.formulas import Formula, find_formulas
from geartrain.numerics.exact import whole_multiple
from geartrain.numerics.results import Result
from geartrain.search.join.product_lists import Domains
from geartrain.search.join.wheel_monomials import IntervalConstraint
from geartrain.search.train.output_requirements import (
    OutputRequirement,
    find_output_requirements,
    find_turning_conditions,
)
from geartrain.train import Teeth, Train
from geartrain.train.fields import MOST_TEETH

LikelihoodKind = Literal["all", "targets", "figures"]
LIKELIHOOD_KINDS: tuple[LikelihoodKind, ...] = ("all", "targets", "figures")
FAR = Fraction(5)
"""Error, in units of the tolerance, beyond which a Gaussian likelihood is set to 0. Beyond this error it would be less
than exp(-12.5).
"""
MOST_COUNTS = 10**5
"""Maximum number of possible tooth counts of one wheel."""


@dataclass(frozen=True, slots=True)
class InferenceProblem:
    """Priors of uncertain tooth counts, and observations of outputs, from which the posteriors are inferred."""

    name: str
    """Name of the train."""
    uncertainties: Mapping[str, ToothCountPrior]
    """Prior of the tooth count of each wheel, keyed by wheel in the order of declaration."""
    witnesses: tuple[OutputRequirement, ...]
    """Observed outputs whose speed depends on an uncertain tooth count."""
    outputs: Mapping[str, Formula]
    """Speed of each output that depends on an uncertain tooth count, as a function of the tooth counts."""
    conditions: tuple[IntervalConstraint, ...]
    """Conditions for the train to turn: loops must close, inputs must be consistent, and the train must be neither
    locked nor free.
    """
    remarks: tuple[str, ...] = ()
    """Remarks on observations that are not used, on observations that every combination violates, and on outputs with
    undetermined speeds.
    """
    soft: bool = False
    """True for the Gaussian likelihood exp(-misfit / 2), which is cut off at `FAR` tolerances; False for a likelihood
    that is 1 within all tolerances and 0 outside.
    """

    @property
    def domains(self) -> Domains:
        """Possible tooth counts of each wheel, in ascending order."""
        return {wheel: uncertainty.counts for wheel, uncertainty in self.uncertainties.items()}

    @property
    def moved(self) -> dict[str, ToothCountPrior]:
        """Priors of the wheels on whose tooth counts an observed output or a condition for the train to turn depends,
        keyed by wheel in the order of declaration.
        """
        functions = [witness.function for witness in self.witnesses] + [one.function for one in self.conditions]
        wheels = {wheel for function in functions for wheel in function.wheels}
        return {wheel: uncertainty for wheel, uncertainty in self.uncertainties.items() if wheel in wheels}

    @property
    def combinations(self) -> int:
        """Number of combinations of possible tooth counts."""
        return prod(len(uncertainty.counts) for uncertainty in self.uncertainties.values())

    def weight(self, teeth: Mapping[str, int]) -> int:
        """Return the integer prior weight of a combination of tooth counts, which is proportional to its prior
        probability.
        """
        return prod(self.uncertainties[wheel].weight(count) for wheel, count in teeth.items())


def build_inference_problem(
    train: Train,
    uncertainties: Sequence[ToothCountPrior],
    state: str | None = None,
    *,
    outputs: Sequence[str] = (),
    tolerance: Fraction | None = None,
    against: LikelihoodKind = "all",
    scale: Fraction = Fraction(1),
    soft: bool = False,
) -> InferenceProblem:
    """Build the inference problem of a train in one state, or in all its states together if `state` is None.

    outputs     names of the outputs that are used as evidence and reported; by default all outputs
    tolerance   relative tolerance of targets that do not declare a tolerance
    against     kinds of observations that are used: "targets", "figures" (`expect` and `published`), or "all"
    scale       factor by which every tolerance is multiplied

    `QuestionError` is raised if a state or an output is unknown, if a requested output has no known speed, if no output
    that depends on an uncertain tooth count has a known speed, or if the train cannot turn with any tooth counts.
    """
    _check(train, state, against, tolerance, scale)
    states: Sequence[str | None] = tuple(train.states) or (None,) if state is None else (state,)
    domains = {uncertainty.wheel: uncertainty.counts for uncertainty in uncertainties}
    found = [(one, find_formulas(train, one, domains)) for one in states]
    _check_outputs(train, states, outputs)
    witnesses: list[OutputRequirement] = []
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
        for requirement in find_output_requirements(train, train.case(one), formulas.outputs, tolerance):
            if outputs and requirement.name not in outputs:
                continue
            formula = formulas.outputs[requirement.name]
            # targets without a tolerance are not evidence
            claims = tuple(
                demand.scaled(scale)
                for demand in requirement.demands
                if demand.allowed is not None and not demand.approached
                if against in ("all", "targets" if demand.target else "figures")
            )
            witness = OutputRequirement(prefix + requirement.name, formula, claims)
            if witness.demands and formula.wheels:
                witnesses.append(witness)
                known.add(requirement.name)
            else:
                remarks += _remarks(witness)
        remarks += [f"the inputs do not determine '{prefix}{name}'" for name in formulas.undetermined]
    _check_known(moved, known, outputs)
    by_wheel = {uncertainty.wheel: uncertainty for uncertainty in uncertainties}
    return InferenceProblem(train.name, by_wheel, tuple(witnesses), shown, tuple(conditions), tuple(remarks), soft)


def _remarks(witness: OutputRequirement) -> Iterator[str]:
    """Yield a remark if an output has no tolerance, or if its speed depends on no uncertain tooth count and violates
    its observations.
    """
    if not witness.demands:
        yield f"'{witness.name}' is not used: none of its observations has a tolerance"
    elif not witness.fits(witness.function.value({})):
        yield f"no uncertain count affects '{witness.name}', and its speed does not satisfy {witness.text}"


def _check(
    train: Train, state: str | None, against: LikelihoodKind, tolerance: Fraction | None, scale: Fraction
) -> None:
    train.check_state(state)
    if against not in LIKELIHOOD_KINDS:
        what, why = f"'{against}' is not a kind of observation", "valid kinds are all, targets and figures"
        raise QuestionError(Problem(what, why, suggest(against, LIKELIHOOD_KINDS)))
    if tolerance is not None and tolerance < 0:
        what, why = f"the tolerance {tolerance} is negative", "a tolerance is a maximum magnitude of an error"
        raise QuestionError(Problem(what, why, "give a tolerance >= 0"))
    if scale < 0:
        what = f"the tolerance factor {scale} is negative"
        why = "tolerances are multiplied by it and cannot be negative"
        raise QuestionError(Problem(what, why, "give a factor >= 0"))


def _check_outputs(train: Train, states: Sequence[str | None], outputs: Sequence[str]) -> None:
    known = dict.fromkeys(name for one in states for name in train.case(one).outputs)
    for name in outputs:
        if name not in known:
            what, why = f"'{train.name}' has no output '{name}'", "only declared outputs can be evidence"
            raise QuestionError(Problem(what, why, suggest(name, known) if known else "declare it under `outputs`"))


def _check_known(moved: Collection[str], known: Collection[str], outputs: Sequence[str]) -> None:
    """Raise `QuestionError` if a requested output gives no information on the tooth counts.

    moved   outputs whose speed depends on an uncertain tooth count
    known   outputs among `moved` with a known speed
    """
    unknown = None if known else "no output that depends on uncertain counts has a known speed"
    for name in outputs:
        if name not in moved:
            what = f"output '{name}' does not depend on uncertain counts"
            why = "such an output gives no information on the counts"
            raise QuestionError(Problem(what, why, f"omit '{name}'"))
        if name not in known:
            unknown = f"the speed of output '{name}' is not known"
            break
    if unknown:
        why = "the likelihood of counts follows from speeds with a tolerance"
        fix = (
            "declare `targets` with a `tolerance`, or an `expect`; or give --tolerance for targets without a tolerance"
        )
        raise QuestionError(Problem(unknown, why, fix))


# ------------------------------------------------------------------ priors: the possible counts of each uncertain wheel


@dataclass(frozen=True, slots=True)
class ToothCountPrior(Result):
    """Possible tooth counts of one wheel, with their prior probabilities."""

    KEYS = ("wheel", "declared", "counts", "priors", "assumed")

    wheel: str
    """Name of the wheel."""
    counts: tuple[int, ...]
    """Distinct possible tooth counts, in ascending order."""
    weights: tuple[int, ...]
    """Positive integer weight of each tooth count. The weights have no common divisor; the prior probability is weight
    / `total`.
    """
    declared: int | None
    """Declared tooth count of the wheel; None if no tooth count is declared."""
    assumed: str
    """Source of the possible tooth counts: "requested", "search", "range" or "choices", followed by the source that the
    declaration states, if any. It ends with "weighted" if weights are declared; if they are not, the prior is uniform.
    """

    @property
    def total(self) -> int:
        """Sum of the weights of all tooth counts."""
        return sum(self.weights)

    def weight(self, count: int) -> int:
        """Return the integer weight of a possible tooth count."""
        return self.weights[self.counts.index(count)]

    @property
    def priors(self) -> tuple[Fraction, ...]:
        """Prior probability of each tooth count. The sum is 1."""
        return tuple(Fraction(weight, self.total) for weight in self.weights)


def find_priors(train: Train, free: Mapping[str, Sequence[int]] | None = None) -> tuple[ToothCountPrior, ...]:
    """Return the priors of the uncertain tooth counts, in the order of declaration.

    free   possible tooth counts of wheels, which replace the declared ones; a single tooth count makes a wheel certain

    The prior of a wheel with `range` or `choices` is given by its `weights`, and is uniform if no weights are declared;
    a wheel with `search` has a uniform prior. `QuestionError` is raised if a wheel is unknown, if tooth counts are
    invalid, if weights are not probabilities, or if no tooth count is uncertain. `RangeError` is raised if a wheel has
    too many tooth counts to list.
    """
    given = dict(free or {})
    for name in given:
        if name not in train.wheels:
            what, why = f"'{train.name}' has no wheel '{name}'", "only declared wheels have tooth counts"
            raise QuestionError(Problem(what, why, suggest(name, train.wheels)))
    found = tuple(_priors(train, given))
    if not any(len(uncertainty.counts) > 1 for uncertainty in found):
        why = "no wheel has `range` or `choices` with more than one count"
        fix = "declare `teeth: {value: 64, range: [63, 66]}`, or free a wheel: --free WHEEL=63:66"
        raise QuestionError(Problem(f"no tooth count of '{train.name}' is uncertain", why, fix))
    return found


def _priors(train: Train, given: Mapping[str, Sequence[int]]) -> Iterator[ToothCountPrior]:
    for name, (link, wheel) in train.wheels.items():
        place = train.place("links", link, "wheels", name)
        teeth = wheel.teeth if isinstance(wheel.teeth, Teeth) else Teeth(value=wheel.teeth)
        if name in given:
            counts = _checked_counts(name, given[name])
            yield ToothCountPrior(name, counts, (1,) * len(counts), teeth.value, "requested")
        elif teeth.choices is not None or teeth.range is not None:
            yield _declared(name, teeth, place)
        elif teeth.search is not None:
            _check_width(name, len(teeth.searched), place)
            counts = tuple(teeth.probabilities)
            yield ToothCountPrior(name, counts, (1,) * len(counts), teeth.value, "search")


def _checked_counts(name: str, counts: Sequence[int]) -> tuple[int, ...]:
    found = tuple(sorted(set(counts)))
    if not found:
        what = f"wheel '{name}' has no possible counts"
        why = "a range ends before it begins, or the list is empty"
        raise QuestionError(Problem(what, why, "give at least one count, or a range with the smaller count first"))
    for count in (found[0], found[-1]):
        if not 0 < count <= MOST_TEETH:
            why = "a tooth count is an integer from 1 to 10^12"
            raise QuestionError(Problem(f"{count} is not a tooth count", why, f"correct the counts of wheel '{name}'"))
    _check_width(name, len(found))
    return found


def _check_width(name: str, count: int, place: str = "") -> None:
    if count > MOST_COUNTS:
        what = f"wheel '{name}' has {count} possible counts"
        why = f"at most {MOST_COUNTS} tooth counts per wheel are allowed"
        raise RangeError(Problem(what, why, "narrow the range", place))


def _declared(name: str, teeth: Teeth, place: str) -> ToothCountPrior:
    """Return the declared prior of a wheel. Tooth counts with weight 0 are omitted."""
    # checked first, because `probabilities` lists every count of the range
    if teeth.range is not None and teeth.choices is None:
        _check_width(name, teeth.range[1] - teeth.range[0] + 1, place)
    if why := teeth.fault_of_weights:
        what = f"the weights of wheel '{name}' do not define probabilities"
        raise QuestionError(Problem(what, why, "give non-negative weights, at least one of them above 0", place))
    probabilities = teeth.probabilities
    weights = tuple(whole_multiple(probabilities.values()))
    kind = "choices" if teeth.choices is not None else "range"
    source = f" ({teeth.source})" if teeth.source else ""
    weighted = ", weighted" if teeth.weights is not None else ""
    return ToothCountPrior(name, tuple(probabilities), weights, teeth.value, f"{kind}{source}{weighted}")


# --------------------------------------------------------------------- observations: known speeds with their tolerances


def observation_constraint(witness: OutputRequirement, soft: bool, graded: bool) -> IntervalConstraint:
    """Return the interval constraint for a join that represents the observations of an output.

    If no observation has bounds, the interval is unbounded; the constraint is still needed, because the join must
    reject tooth counts for which the speed is undefined. If `soft` is True, the intervals extend to `FAR` times the
    tolerances. If `graded` is True, the join also computes the misfit of the output.
    """
    common = (witness.scaled(FAR) if soft else witness).requested(None)
    return replace(common or IntervalConstraint(witness.name, witness.function, ((None, None),)), graded=graded)
