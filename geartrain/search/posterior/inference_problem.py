"""The question of counts in doubt: priors of wheels, observations of outputs, and conditions for the train to turn."""

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
from geartrain.search.join.wheel_monomials import Interval, IntervalConstraint, is_within
from geartrain.search.train.output_requirements import (
    SpeedRequirement,
    find_output_requirements,
    find_turning_conditions,
    meet,
    of_either_sense,
)
from geartrain.train import Teeth, Train
from geartrain.train.fields import MOST_TEETH

LikelihoodKind = Literal["all", "targets", "figures"]
LIKELIHOOD_KINDS: tuple[LikelihoodKind, ...] = ("all", "targets", "figures")
FAR = Fraction(5)
"""Where agreement is by degree: what is off by more tolerances than this is refused. It would weigh exp(-12.5)."""
MOST_COUNTS = 10**5
"""Counts of one wheel; a doubt wider than this is no evidence."""
_LINE: Interval = (None, None)


@dataclass(frozen=True, slots=True)
class InferenceProblem:
    """Wheels in doubt and what is known of the outputs."""

    name: str
    """Of the train."""
    doubts: Mapping[str, ToothCountPrior]
    """Wheel -> its counts and their weights, in the order declared."""
    witnesses: tuple[ObservedOutput, ...]
    """Outputs of which something is known and that a wheel in doubt moves."""
    outputs: Mapping[str, Formula]
    """Every output that a wheel in doubt moves -> its function."""
    conditions: tuple[IntervalConstraint, ...]
    """What must hold for the train to turn: loops that close, links driven in one way."""
    remarks: tuple[str, ...] = ()
    """What the reader should know."""
    soft: bool = False
    """False: a combination fits or it does not; True: it agrees less and less, exp(-misfit / 2), up to `FAR`
    tolerances."""

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


# --------------------------------------------------------------------------- priors: the counts of each wheel in doubt


@dataclass(frozen=True, slots=True)
class ToothCountPrior(Result):
    """The counts one wheel may have, and their prior probabilities."""

    KEYS = ("wheel", "declared", "counts", "priors", "assumed")

    wheel: str
    """Its id."""
    counts: tuple[int, ...]
    """Ascending, each once."""
    weights: tuple[int, ...]
    """In parallel to the counts: positive, without a common divisor; the prior probability is weight / `total`."""
    declared: int | None
    """The count the train declares."""
    assumed: str
    """Where the counts come from, in words; all are equally likely unless it says that they are weighted."""

    @property
    def total(self) -> int:
        """The sum of the weights."""
        return sum(self.weights)

    def weight(self, count: int) -> int:
        """The weight of one of its counts."""
        return self.weights[self.counts.index(count)]

    @property
    def priors(self) -> tuple[Fraction, ...]:
        """The chance of each count before the outputs are looked at; they sum to 1."""
        return tuple(Fraction(weight, self.total) for weight in self.weights)


def find_priors(train: Train, free: Mapping[str, Sequence[int]] | None = None) -> tuple[ToothCountPrior, ...]:
    """The priors of the wheels in doubt, in the order declared.

    free   wheel -> its counts, for wheels that are to have others than those declared; one count takes the doubt away

    A wheel with `range` or `choices` is in doubt with its `weights` (uniform where none are declared), one with
    `search` uniformly. Raises `QuestionError` for wheels the train does not have, for what is no tooth count, for
    weights that are no probabilities, and where no wheel is in doubt; `RangeError` for a doubt too wide to list.
    """
    given = dict(free or {})
    for name in given:
        if name not in train.wheels:
            fix = suggest(name, train.wheels)
            raise QuestionError(Problem(f"'{train.name}' has no wheel '{name}'", "it is not declared", fix))
    found = tuple(_all(train, given))
    if not any(len(doubt.counts) > 1 for doubt in found):
        why = "no wheel has `range` or `choices` with more than one count"
        fix = "declare `teeth: {value: 64, range: [63, 66]}`, or free a wheel: --free WHEEL=63:66"
        raise QuestionError(Problem(f"no wheel of '{train.name}' is in doubt", why, fix))
    return found


def _all(train: Train, given: Mapping[str, Sequence[int]]) -> Iterator[ToothCountPrior]:
    for name, (link, wheel) in train.wheels.items():
        place = train.place("links", link, "wheels", name)
        teeth = wheel.teeth if isinstance(wheel.teeth, Teeth) else Teeth(value=wheel.teeth)
        if name in given:
            counts = _checked(name, given[name])
            yield ToothCountPrior(name, counts, (1,) * len(counts), teeth.value, "requested")
        elif teeth.choices is not None or teeth.range is not None:
            yield _declared(name, teeth, place)
        elif teeth.search is not None:
            _check_width(name, len(teeth.searched), place)
            counts = tuple(teeth.chances)
            yield ToothCountPrior(name, counts, (1,) * len(counts), teeth.value, "search")


def _checked(name: str, counts: Sequence[int]) -> tuple[int, ...]:
    """Counts as asked for: some, and possible."""
    found = tuple(sorted(set(counts)))
    if not found:
        why = "a range ends before it begins, or nothing is listed"
        raise QuestionError(Problem(f"wheel '{name}' has no counts to choose from", why, "write the least count first"))
    for count in (found[0], found[-1]):
        if not 0 < count <= MOST_TEETH:
            fix = "a tooth count is a whole number from 1 to 10^12"
            raise QuestionError(Problem(f"{count} is not a tooth count", f"wheel '{name}' is to have it", fix))
    if len(found) > MOST_COUNTS:
        raise _too_wide(name, len(found), "")
    return found


def _check_width(name: str, count: int, place: str) -> None:
    if count > MOST_COUNTS:
        raise _too_wide(name, count, place)


def _declared(name: str, teeth: Teeth, place: str) -> ToothCountPrior:
    """A doubt as declared, with its weights; counts of weight 0 are left out."""
    if teeth.range is not None and teeth.choices is None:
        _check_width(name, teeth.range[1] - teeth.range[0] + 1, place)
    if why := teeth.fault_of_weights:
        what = f"the weights of wheel '{name}' are no chances"
        raise QuestionError(Problem(what, why, "give weights of 0 and more, one of them above 0", place))
    chances = teeth.chances
    kind = "choices" if teeth.choices is not None else "range"
    said = ", weighted" if teeth.weights is not None else ""
    source = f" ({teeth.source})" if teeth.source else ""
    return ToothCountPrior(
        name, tuple(chances), tuple(whole_multiple(chances.values())), teeth.value, f"{kind}{source}{said}"
    )


def _too_wide(name: str, count: int, place: str) -> RangeError:
    what = f"the doubt of wheel '{name}' is too wide"
    return RangeError(Problem(what, f"{count} counts, and at most {MOST_COUNTS} can be listed", "narrow it", place))


# ------------------------------------------------------------- observations: claims on speeds, each with its tolerance


@dataclass(frozen=True, slots=True)
class Observation:
    """One thing known about an output's speed."""

    label: str
    """In words, such as "speed 254/19 within 0.2 %"."""
    wanted: Fraction
    """The speed, in the train's unit; positive where only the magnitude counts."""
    signed: bool
    """False: only the magnitude counts."""
    intervals: tuple[Interval, ...]
    """Where the speed (or its magnitude) may lie, closed; None stands for no bound."""

    @property
    def is_exact(self) -> bool:
        """True if one speed is allowed and no other."""
        return all(low == high for low, high in self.intervals)

    def scaled(self, factor: Fraction) -> Observation:
        """The claim with all tolerances multiplied by a factor."""
        if factor == 1:
            return self
        stretched = tuple((self._moved(low, factor), self._moved(high, factor)) for low, high in self.intervals)
        return replace(self, intervals=stretched)

    def _moved(self, end: Fraction | None, factor: Fraction) -> Fraction | None:
        return None if end is None else self.wanted + factor * (end - self.wanted)

    def half(self, above: bool) -> Fraction | None:
        """How far the speed may lie above or below what is wanted; None for any distance."""
        own = [each for each in self.intervals if is_within(self.wanted, (each,))]
        end = own[0][1 if above else 0] if own else None
        return None if end is None else abs(end - self.wanted)

    def met(self, speed: Fraction) -> bool:
        """True if a speed is in order."""
        value = speed if self.signed else abs(speed)
        return is_within(value, self.intervals)

    def misfit(self, speed: Fraction) -> Fraction:
        """(error / tolerance)^2; 0 without a bound on that side, and for an exact claim, which is met or not."""
        value = speed if self.signed else abs(speed)
        half = self.half(value > self.wanted)
        return ((value - self.wanted) / half) ** 2 if half else Fraction(0)

    def allowed(self) -> tuple[Interval, ...]:
        """The speeds that are in order, of either sense where only the magnitude counts."""
        if self.signed:
            return self.intervals
        ((low, high),) = self.intervals
        assert low is not None, "a target has a tolerance on both sides"
        assert high is not None, "a target has a tolerance on both sides"
        return of_either_sense(low, high)


@dataclass(frozen=True, slots=True)
class ObservedOutput:
    """An output of which something is known."""

    name: str
    """Of the output; "state: output" where several states are asked at once."""
    formula: Formula
    """Its speed as a function of the wheels in doubt; of one or more of them."""
    claims: tuple[Observation, ...]
    """All hold at once; one at least."""

    @property
    def text(self) -> str:
        """The claims in words."""
        return "; ".join(claim.label for claim in self.claims)

    def fits(self, speed: Fraction | None) -> bool:
        """True if a speed meets every claim; a train that has no speed there does not."""
        return speed is not None and all(claim.met(speed) for claim in self.claims)

    def misfit(self, speed: Fraction) -> Fraction:
        """The sum over the claims of (error / tolerance)^2."""
        return sum((claim.misfit(speed) for claim in self.claims), Fraction(0))

    def requested(self, soft: bool) -> IntervalConstraint | None:
        """What must hold without doubt: every claim, where they are `soft` within `FAR` tolerances; None: nothing."""
        common: tuple[Interval, ...] = (_LINE,)
        for claim in self.claims:
            common = meet(common, (claim.scaled(FAR) if soft else claim).allowed())
        return None if common == (_LINE,) else IntervalConstraint(self.name, self.formula, common)

    def constraint(self, soft: bool, graded: bool) -> IntervalConstraint:
        """Return the constraint of this output for a join; unbounded if no claim is certain.

        Every speed in order must have a constraint. `graded`: the join also returns how well the output agrees.
        """
        return replace(self.requested(soft) or IntervalConstraint(self.name, self.formula, (_LINE,)), graded=graded)


def observations_of(
    demands: Sequence[SpeedRequirement], kind: LikelihoodKind, factor: Fraction = Fraction(1)
) -> tuple[Observation, ...]:
    """The demands on an output as claims; those on targets without a tolerance claim nothing.

    kind     "targets": without `expect` and `published`; "figures": only those; "all"
    factor   multiplies every tolerance
    """
    return tuple(claim.scaled(factor) for claim in _claims(demands, kind))


def _claims(demands: Sequence[SpeedRequirement], kind: LikelihoodKind) -> Iterator[Observation]:
    for demand in demands:
        if (
            demand.allowed is None
            or demand.approached
            or kind not in ("all", "targets" if demand.target else "figures")
        ):
            continue
        intervals = demand.allowed
        if not demand.signed:
            most = demand.allowed[-1][1]
            assert most is not None, "a target has a tolerance"
            intervals = ((2 * demand.wanted - most, most),)
        yield Observation(demand.label, demand.wanted, demand.signed, intervals)
