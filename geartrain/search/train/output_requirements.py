"""Requirements of a train on its output speeds as exact intervals, and the errors of output speeds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain
from math import prod

from geartrain.errors import Problem, QuestionError, RangeError, suggest
from geartrain.kinematics.formulas.output_formulas import Formulas, find_formulas
from geartrain.kinematics.judged_outputs import error_against, goal_of, in_plain_units, unit_seconds
from geartrain.numerics.exact import decimal
from geartrain.numerics.graphs import joined_groups
from geartrain.numerics.quantity import Figure
from geartrain.search.constraints.count_conditions import CountConstraint
from geartrain.search.join.product_lists import Domains
from geartrain.search.join.wheel_monomials import Function, Interval, IntervalConstraint, is_within
from geartrain.search.train.train_findings import ReachedSpeed
from geartrain.train import Output, Published, StateCase, Teeth, Train

# both sides of 0, which is excluded by `strict`
_ANYTHING_ELSE = (None, Fraction(0)), (Fraction(0), None)


@dataclass(frozen=True, slots=True)
class SpeedRequirement:
    """One requirement on the speed of an output.

    label       description, such as "period 583.92 d" or "expect 2/7"
    wanted      requested speed [the train's unit of speed]; positive if only the magnitude is required
    signed      False if only the magnitude is required
    allowed     closed disjoint intervals of admissible speeds [the train's unit of speed]; None if all are admissible
    graded      True if the error of the output is computed from this requirement
    approached  True if no tolerance is given, so that the error is minimised
    target      True for a target; False for an expected or published value
    """

    label: str
    wanted: Fraction
    signed: bool
    allowed: tuple[Interval, ...] | None
    graded: bool
    approached: bool = False
    target: bool = False

    def loosened(self) -> SpeedRequirement:
        """Return a requirement that admits all speeds with the requested sense of rotation, or all speeds if only the
        magnitude is required. The error of the speed is minimised instead.
        """
        allowed: tuple[Interval, ...] | None = None
        if self.signed and self.wanted:
            allowed = ((Fraction(0), None),) if self.wanted > 0 else ((None, Fraction(0)),)
        return replace(self, allowed=allowed, approached=True)

    def error(self, speed: Fraction) -> Fraction:
        """Return the relative error of a speed with respect to the requested speed. If the requested speed is 0, return
        the speed itself.
        """
        return Fraction(error_against(speed, self.wanted, self.signed))

    def within(self, share: Fraction | None) -> tuple[Interval, ...] | None:
        """Return the intervals of admissible speeds; None if all speeds are admissible.

        share   additional maximum relative error, used if `graded` is True; None if there is none
        """
        if share is None or not self.graded:
            return self.allowed
        # the tolerance is absolute if the requested speed is 0
        size = abs(self.wanted) or Fraction(1)
        near = (_around(self.wanted, share * size),) if self.signed else _magnitudes(self.wanted, share * size)
        return near if self.allowed is None else meet(near, self.allowed)

    def met(self, speed: Fraction) -> bool:
        """Return whether a speed is admissible."""
        return self.allowed is None or is_within(speed, self.allowed)

    @property
    def exact(self) -> bool:
        """True if exactly one speed, or one magnitude of the speed, is admissible."""
        return self.allowed is not None and all(low == high for low, high in self.allowed)

    def half(self, above: bool) -> Fraction | None:
        """Return the magnitude of the difference between the requested speed and the upper (if `above` is True) or
        lower end of the admissible interval that contains it [the train's unit of speed]; None if this end is
        unbounded, or if the requested speed is not admissible.
        """
        around = [interval for interval in self.allowed or () if is_within(self.wanted, (interval,))]
        # a magnitude has equal tolerances, even if its interval extends to negative speeds
        end = around[0][1 if above or not self.signed else 0] if around else None
        return None if end is None else abs(end - self.wanted)

    def scaled(self, factor: Fraction) -> SpeedRequirement:
        """Return the requirement with all tolerances multiplied by a factor."""
        if self.allowed is None or factor == 1:
            return self
        half = self.half(above=True)
        if not self.signed and half is not None:
            return replace(self, allowed=_magnitudes(self.wanted, factor * half))
        stretched = tuple((self._moved(low, factor), self._moved(high, factor)) for low, high in self.allowed)
        return replace(self, allowed=stretched)

    def _moved(self, end: Fraction | None, factor: Fraction) -> Fraction | None:
        return None if end is None else self.wanted + factor * (end - self.wanted)

    def misfit(self, speed: Fraction) -> Fraction:
        """Return (error / tolerance)^2. Return 0 if the tolerance is unlimited or 0."""
        value = speed if self.signed else abs(speed)
        half = self.half(value > self.wanted)
        return ((value - self.wanted) / half) ** 2 if half else Fraction(0)


def _around(middle: Fraction, half: Fraction) -> tuple[Fraction, Fraction]:
    return middle - half, middle + half


def _magnitudes(wanted: Fraction, half: Fraction) -> tuple[Interval, ...]:
    """Return the intervals of positive and negative speeds whose magnitude differs from `wanted` by at most `half`."""
    low, high = _around(wanted, half)
    return ((-high, high),) if low <= 0 else ((-high, -low), (low, high))


def meet(left: Sequence[Interval], right: Sequence[Interval]) -> tuple[Interval, ...]:
    """Return the intersection of two unions of intervals."""
    found = []
    for a, b in left:
        for c, d in right:
            # None is an unbounded end
            low = a if c is None else c if a is None else max(a, c)
            high = b if d is None else d if b is None else min(b, d)
            if low is None or high is None or low <= high:
                found.append((low, high))
    # an interval without a lower end comes first
    return tuple(sorted(set(found), key=lambda interval: (interval[0] is not None, interval[0] or 0)))


@dataclass(frozen=True, slots=True)
class OutputRequirement:
    """Output of a train: its speed as a function of tooth counts, and all requirements on this speed."""

    name: str
    """Name of the output, in the format "state: output" if several states are searched together."""
    function: Function
    """Speed of the output as a function of the tooth counts of the varied wheels."""
    demands: tuple[SpeedRequirement, ...]
    """Requirements on the speed, at least one. All of them must be satisfied."""

    @property
    def approached(self) -> bool:
        """True if a target has no tolerance, so that its error is minimised."""
        return any(demand.approached for demand in self.demands)

    @property
    def exact(self) -> bool:
        """True if every admissible interval contains a single speed, so that the error of every solution is 0."""
        common = self.requested(None)
        return common is not None and all(low == high for low, high in common.intervals)

    @property
    def text(self) -> str:
        """Name of the output, followed by descriptions of its requirements."""
        return f"{self.name}: {', '.join(demand.label for demand in self.demands)}"

    def requested(self, share: Fraction | None, strict: bool = False) -> IntervalConstraint | None:
        """Return the interval constraint on the speed of the output; None if every speed is admissible.

        share    common relative tolerance of all requirements from which an error is computed; None if there is none
        strict   True to exclude the end points of the intervals
        """
        common: tuple[Interval, ...] = ((None, None),)  # all speeds
        for demand in self.demands:
            near = demand.within(share)
            common = common if near is None else meet(common, near)
        return None if common == ((None, None),) else IntervalConstraint(self.text, self.function, common, strict)

    def reached(self, speed: Fraction) -> ReachedSpeed:
        """Return a speed with its error, which refers to the requirement with the largest absolute error, among the
        requirements from which errors are computed.
        """
        graded = [demand for demand in self.demands if demand.graded] or self.demands
        worst = max(graded, key=lambda demand: abs(demand.error(speed)))
        return ReachedSpeed(speed, worst.label, worst.error(speed), self.fits(speed))

    def scaled(self, factor: Fraction) -> OutputRequirement:
        """Return the output requirement with all tolerances multiplied by a factor."""
        return replace(self, demands=tuple(demand.scaled(factor) for demand in self.demands))

    def fits(self, speed: Fraction | None) -> bool:
        """Return whether a speed satisfies all requirements. Return False if the speed is None, that is,
        undetermined.
        """
        return speed is not None and all(demand.met(speed) for demand in self.demands)

    def misfit(self, speed: Fraction) -> Fraction:
        """Return the sum of (error / tolerance)^2 over all requirements."""
        return sum((demand.misfit(speed) for demand in self.demands), Fraction(0))


def find_turning_conditions(train: Train, formulas: Formulas) -> Iterator[IntervalConstraint]:
    """Yield the conditions for a train to turn: loops must close, inputs must be consistent, and the train must be
    neither locked nor free.

    `QuestionError` is raised if the train cannot turn with any tooth counts.
    """
    for condition in formulas.conditions:
        if not condition.wheels:
            what = f"'{train.name}' cannot turn with any tooth counts"
            raise QuestionError(
                Problem(what, condition.label, "run `geartrain solve FILE` to see what locks the train")
            )
        yield IntervalConstraint(condition.label, condition, ((Fraction(0), Fraction(0)),))
    for exclusion in formulas.exclusions:
        yield IntervalConstraint(exclusion.label, exclusion, _ANYTHING_ELSE, strict=True)


def find_output_requirements(
    train: Train, case: StateCase, functions: Mapping[str, Function], tolerance: Fraction | None
) -> list[OutputRequirement]:
    """Return the requirements of each output whose speed is given in `functions`. Outputs without requirements are
    omitted.
    """
    moving = [speed for speed in case.inputs.values() if speed]
    found = []
    for name, function in functions.items():
        output = case.outputs[name]
        if output.published is not None and "/" in output.published.as_ and len(moving) != 1:
            what = f"the published value {output.published.value} of output '{name}' cannot be compared"
            why = f"a ratio needs exactly one input that turns, and {len(moving) or 'none'} turn"
            raise QuestionError(Problem(what, why, "give the speed, `as: speed`, or let only one input turn"))
        demands = tuple(_demands(train, output, moving[0] if len(moving) == 1 else None, tolerance))
        if demands:
            found.append(OutputRequirement(name, function, demands))
    return found


def _demands(
    train: Train, output: Output, drive: Fraction | None, tolerance: Fraction | None
) -> Iterator[SpeedRequirement]:
    requested = [target for target in output.targets if target.tolerance is not None]
    figures = output.expect is not None or output.published is not None
    # a target without a tolerance is only used if nothing else is required, or if a common tolerance is given
    if not requested and output.targets and (tolerance is not None or not figures):
        requested = [output.targets[0]]
    if output.expect is not None:
        value = output.expect.value
        allowed = _around(value.value, _half(value, output.expect.tolerance))
        yield SpeedRequirement(f"expect {value}", value.value, True, (allowed,), not requested)
    if output.published is not None:
        yield _printed(train, output.published, drive, not requested)
    for target in requested:
        goal = goal_of(train, target)
        share = tolerance if target.tolerance is None else target.tolerance.base
        words = goal.words if share is None else f"{goal.words} within {decimal(share, 3)}"
        demand = SpeedRequirement(words, goal.speed, goal.signed, None, graded=True, target=True)
        yield demand.loosened() if share is None else replace(demand, allowed=demand.within(share))


def _half(value: Figure, tolerance: Figure | None) -> Fraction:
    return abs(tolerance.value) if tolerance is not None else value.half or Fraction(0)


def _printed(train: Train, published: Published, drive: Fraction | None, graded: bool) -> SpeedRequirement:
    """Return the speed requirement that corresponds to a published value.

    drive    speed of the only turning input, with which a published ratio is compared; None if there is no such input
    graded   True if the error of the output is computed from this requirement
    """
    label, unit, signed = f"published {published.value} {published.as_}", unit_seconds(train), not published.unsigned
    printed = in_plain_units(published.value, unit)
    half = _half(printed, published.tolerance and in_plain_units(published.tolerance, unit))
    if published.as_ == "period":
        scale = unit and unit * published.turns.value * (-1 if published.sense == "retrograde" else 1)
    else:
        scale = Fraction(1) if published.as_ == "speed" else drive
    assert scale is not None
    if published.as_ in ("speed", "output/input"):
        wanted, half = printed.value * scale, half * abs(scale)
        near = (_around(wanted, half),) if signed else _magnitudes(abs(wanted), half)
        return SpeedRequirement(label, wanted if signed else abs(wanted), signed, near, graded)
    wanted = scale / printed.value if printed.value else Fraction(0)
    low, high = _around(printed.value, half)
    allowed = tuple(_inverse(low if signed else max(low, Fraction(0)), high, scale))
    if not signed:
        # also the speeds with opposite sign; None is an unbounded end
        mirrored = ((None if high is None else -high, None if low is None else -low) for low, high in allowed)
        wanted, allowed = abs(wanted), (*allowed, *mirrored)
    # a ratio of 0 corresponds to no finite speed, so no error can be computed
    return SpeedRequirement(label, wanted, signed, allowed, graded and bool(wanted))


def _inverse(low: Fraction, high: Fraction, drive: Fraction) -> Iterator[Interval]:
    """Yield the intervals of all speeds v for which `low` <= `drive` / v <= `high`."""
    if low > 0 or high < 0:
        ends = sorted((drive / low, drive / high))
        yield ends[0], ends[1]
        return
    # the interval of ratios includes 0, so the speeds are unbounded
    rays = [drive / end for end in (low, high) if end]
    yield from ((None, ray) if ray < 0 else (ray, None) for ray in sorted(rays))


# The varied wheels of a train and their requirements, in connected components.


_MOST_COUNTS = 10**6  # counts of one wheel that are listed


@dataclass(frozen=True, slots=True)
class SearchPart:
    """Varied wheels that are connected by outputs or constraints, and the requirements on them."""

    domains: Domains
    """Admissible tooth counts of each wheel in ascending order, keyed by wheel in the order of declaration."""
    requirements: tuple[OutputRequirement, ...]
    """Requirements on the outputs that depend on the wheels."""
    conditions: tuple[IntervalConstraint, ...]
    """Conditions on loops and links that must be satisfied so that the train can turn."""
    rules: tuple[CountConstraint, ...]
    """Constraints on the tooth counts of the wheels."""

    @property
    def considered(self) -> int:
        """Number of all assignments of admissible tooth counts to the wheels."""
        return prod(len(counts) for counts in self.domains.values())


def find_domains(train: Train, free: str | Sequence[str]) -> dict[str, tuple[int, ...]]:
    """Return the admissible tooth counts of each varied wheel in ascending order, keyed by wheel in the order of
    declaration.

    `free` has the same meaning as in `search_train`. `QuestionError` is raised if no wheel is varied, or if a wheel
    named in `free` has no range of tooth counts.
    """
    names = None if free in ("search", "uncertain") else [free] if isinstance(free, str) else free
    for name in names or ():
        if name not in train.wheels:
            what, why = f"'{train.name}' has no wheel '{name}'", "only declared wheels can be varied"
            raise QuestionError(Problem(what, why, suggest(name, train.wheels)))
    found = {}
    for wheel, (link, declared) in train.wheels.items():
        teeth = declared.teeth if isinstance(declared.teeth, Teeth) else Teeth(value=declared.teeth)
        chosen = teeth.search is not None or free == "uncertain" if names is None else wheel in names
        # the train cannot be solved without the count of a wheel, so wheels without a count are always varied
        counts = tuple(_counts(train, wheel, link, teeth)) if chosen or teeth.value is None else ()
        if counts:
            found[wheel] = counts
        elif names is not None and chosen:
            what = f"the tooth count of wheel '{wheel}' cannot be varied"
            why = f"its count is declared as {teeth.value}, without search, range or choices"
            place = train.place("links", link, "wheels", wheel)
            raise QuestionError(Problem(what, why, "declare it as {search: [15, 80]}", place))
    if not found:
        what = f"'{train.name}' has no wheel whose tooth count is varied"
        fix = "declare `teeth: {search: [15, 80]}` for the wheels to search"
        if free == "search" and any(train.uncertain_wheels()):
            fix += ", or use --free uncertain"
        raise QuestionError(Problem(what, "no selected wheel has a range of tooth counts", fix))
    return found


def _counts(train: Train, wheel: str, link: str, teeth: Teeth) -> Iterable[int]:
    """Return the admissible tooth counts of a wheel. They are given by the first declared key among `search`, `choices`
    and `range`; the result is empty if none of these is declared.
    """
    counts = teeth.searched or sorted(set(teeth.choices or ()))
    if not counts and teeth.range is not None:
        counts = range(teeth.range[0], teeth.range[1] + 1)
    if len(counts) > _MOST_COUNTS:
        why = f"{counts[0]} to {counts[-1]} has more than {_MOST_COUNTS} counts"
        place = train.place("links", link, "wheels", wheel)
        raise RangeError(
            Problem(f"the range of wheel '{wheel}' is too wide", why, "give a narrower range, such as [15, 80]", place)
        )
    return counts


def find_parts(
    train: Train, state: str | None, domains: Domains, rules: Sequence[CountConstraint], tolerance: Fraction | None
) -> tuple[list[SearchPart], tuple[str, ...]]:
    """Return the independent parts of a train in the order of declaration, and remarks. A part is a set of varied
    wheels that are connected by outputs, loops or constraints, directly or through further varied wheels.

    Requirements of the given state are used, or of all states if `state` is None. The remarks describe outputs
    whose speeds are undetermined, and outputs that depend on no varied wheel and violate their requirements.
    """
    train.check_state(state)
    states: Sequence[str | None] = tuple(train.states) or (None,) if state is None else (state,)
    requirements: list[OutputRequirement] = []
    conditions: dict[IntervalConstraint, None] = {}
    remarks: list[str] = []
    for one in states:
        prefix = f"{one}: " if len(states) > 1 else ""
        case, formulas = train.case(one), find_formulas(train, one, domains)
        conditions |= dict.fromkeys(find_turning_conditions(train, formulas))
        for requirement in find_output_requirements(train, case, formulas.outputs, tolerance):
            requirement = replace(requirement, name=prefix + requirement.name)
            if requirement.function.wheels:
                requirements.append(requirement)
            elif (speed := requirement.function.value({})) is not None and not requirement.fits(speed):
                reached = requirement.reached(speed)
                remarks.append(
                    f"no varied wheel influences '{requirement.name}', which violates its requirement: its speed is "
                    f"{speed}, with an error of {decimal(reached.error, 3)} ({reached.label})"
                )
        remarks.extend(f"the inputs do not determine '{prefix}{name}'" for name in formulas.undetermined)
    scopes = chain(
        (one.function.wheels for one in requirements),
        (one.function.wheels for one in conditions),
        (rule.wheels for rule in rules),
    )
    found = []
    for wheels in joined_groups(domains, scopes):
        group = set(wheels)
        found.append(
            SearchPart(
                {wheel: domains[wheel] for wheel in wheels},
                tuple(one for one in requirements if not group.isdisjoint(one.function.wheels)),
                tuple(one for one in conditions if not group.isdisjoint(one.function.wheels)),
                tuple(rule for rule in rules if not group.isdisjoint(rule.wheels)),
            )
        )
    return found, tuple(remarks)
