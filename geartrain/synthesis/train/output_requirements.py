"""What a train asks of its outputs, as exact intervals of their speeds, and how far a speed is off."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.formulas.output_formulas import Formulas
from geartrain.kinematics.judged_outputs import RatioGoal, error_against, goal_of
from geartrain.numerics.decimal_text import decimal
from geartrain.numerics.quantity import Figure
from geartrain.synthesis.join.wheel_monomials import Function, Interval, IntervalConstraint, is_within
from geartrain.synthesis.train.train_findings import ReachedSpeed
from geartrain.train import Output, Published, StateCase, Train

_ANYTHING_ELSE = (None, Fraction(0)), (Fraction(0), None)


@dataclass(frozen=True, slots=True)
class SpeedRequirement:
    """One requirement on the speed of an output.

    label      in words, such as "period 583.92 d" or "expect 2/7"
    wanted     the speed asked for, in the train's unit; positive where only the magnitude counts
    signed     False: only the magnitude counts
    allowed    the speeds that are in order, closed and apart; None: all
    graded     True if the output's error is counted from it
    approached True if no tolerance is stated: the nearer the better
    target     True for what the sky does, False for what is expected or printed
    """

    label: str
    wanted: Fraction
    signed: bool
    allowed: tuple[Interval, ...] | None
    graded: bool
    approached: bool = False
    target: bool = False

    @classmethod
    def of(cls, goal: RatioGoal, share: Fraction | None) -> SpeedRequirement:
        """What a target demands, within a share of it or as near as may be."""
        said = "" if share is None else f" within {decimal(share, 3)}"
        demand = cls(goal.words + said, goal.speed, goal.signed, None, True, True, True)
        if share is None:
            return demand.loosened()
        return replace(demand, allowed=demand.within(share), approached=False)

    def loosened(self) -> SpeedRequirement:
        """The same, to be come near to: with nothing required of a speed but its sense."""
        allowed: tuple[Interval, ...] | None = None
        if self.signed and self.wanted:
            allowed = ((Fraction(0), None),) if self.wanted > 0 else ((None, Fraction(0)),)
        return replace(self, allowed=allowed, approached=True)

    def error(self, speed: Fraction) -> Fraction:
        """Relative error; the speed itself where 0 is wanted."""
        return Fraction(error_against(speed, self.wanted, self.signed))

    def within(self, share: Fraction | None) -> tuple[Interval, ...] | None:
        """The allowed speeds, for a graded demand no further off than a share of what is wanted."""
        if share is None or not self.graded:
            return self.allowed
        size = abs(self.wanted) or Fraction(1)
        near = (_around(self.wanted, share * size),) if self.signed else _magnitudes(self.wanted, share)
        return near if self.allowed is None else meet(near, self.allowed)

    def met(self, speed: Fraction) -> bool:
        """True if a speed is in order."""
        return self.allowed is None or is_within(speed, self.allowed)


def _around(middle: Fraction, half: Fraction) -> Interval:
    return middle - half, middle + half


def _magnitudes(wanted: Fraction, share: Fraction) -> tuple[Interval, ...]:
    """Speeds of either sense whose magnitude is within a share of the wanted one."""
    return of_either_sense(wanted * (1 - share), wanted * (1 + share))


def of_either_sense(least: Fraction, most: Fraction) -> tuple[Interval, ...]:
    """Speeds whose magnitude lies between two numbers."""
    return ((-most, most),) if least <= 0 else ((-most, -least), (least, most))


def meet(left: Sequence[Interval], right: Sequence[Interval]) -> tuple[Interval, ...]:
    """What two unions of intervals have in common."""
    found = []
    for a, b in left:
        for c, d in right:
            low = a if c is None else c if a is None else max(a, c)
            high = b if d is None else d if b is None else min(b, d)
            if low is None or high is None or low <= high:
                found.append((low, high))
    return tuple(sorted(set(found), key=lambda interval: (interval[0] is not None, interval[0] or 0)))


@dataclass(frozen=True, slots=True)
class OutputRequirement:
    """An output with all its requirements.

    name      of the output; "state: output" where several states are asked at once
    function  its speed, of the free wheels
    demands   all hold at once; one at least
    """

    name: str
    function: Function
    demands: tuple[SpeedRequirement, ...]

    @property
    def approached(self) -> bool:
        """True if a target without a tolerance is to be approached."""
        return any(demand.approached for demand in self.demands)

    @property
    def exact(self) -> bool:
        """True if one exact speed is asked for, so that no solution has an error."""
        common = self.asked(None)
        return common is not None and all(low == high for low, high in common.intervals)

    @property
    def text(self) -> str:
        """The demands in words."""
        return f"{self.name}: {', '.join(demand.label for demand in self.demands)}"

    def asked(self, share: Fraction | None, strict: bool = False) -> IntervalConstraint | None:
        """The demand on the function, with graded demands no further off than `share`; None if all is allowed."""
        common: tuple[Interval, ...] = ((None, None),)
        for demand in self.demands:
            near = demand.within(share)
            common = common if near is None else meet(common, near)
        return None if common == ((None, None),) else IntervalConstraint(self.text, self.function, common, strict)

    def reached(self, speed: Fraction) -> ReachedSpeed:
        """How the output stands at a speed: by the graded demand it misses by most."""
        graded = [demand for demand in self.demands if demand.graded] or self.demands
        worst = max(graded, key=lambda demand: abs(demand.error(speed)))
        met = all(demand.met(speed) for demand in self.demands)
        return ReachedSpeed(speed, worst.label, worst.error(speed), met)


def find_turning_conditions(train: Train, formulas: Formulas) -> Iterator[IntervalConstraint]:
    """What must hold for a train to turn: loops that close, links driven in one way.

    Raises `QuestionError` where it does not whatever the counts.
    """
    for condition in formulas.conditions:
        if not condition.wheels:
            what = f"'{train.name}' does not turn, whatever counts are chosen"
            raise QuestionError(Problem(what, condition.label, "`geartrain solve` shows what holds it"))
        yield IntervalConstraint(condition.label, condition, ((Fraction(0), Fraction(0)),))
    for exclusion in formulas.exclusions:
        yield IntervalConstraint(exclusion.label, exclusion, _ANYTHING_ELSE, strict=True)


def find_output_requirements(
    train: Train, case: StateCase, functions: Mapping[str, Function], tolerance: Fraction | None
) -> list[OutputRequirement]:
    """The outputs of a case that have a function and of which something is asked."""
    moving = [speed for speed in case.inputs.values() if speed]
    found = []
    for name, function in functions.items():
        output = case.outputs[name]
        demands = tuple(_demands(train, output, moving[0] if len(moving) == 1 else None, tolerance))
        if demands:
            found.append(OutputRequirement(name, function, demands))
    return found


def _demands(
    train: Train, output: Output, drive: Fraction | None, tolerance: Fraction | None
) -> Iterator[SpeedRequirement]:
    asked = [target for target in output.targets if target.tolerance is not None]
    figures = output.expect is not None or output.published is not None
    if not asked and output.targets and (tolerance is not None or not figures):
        asked = [output.targets[0]]
    if output.expect is not None:
        value = output.expect.value
        allowed = _around(value.value, _half(value, output.expect.tolerance))
        yield SpeedRequirement(f"expect {value}", value.value, True, (allowed,), not asked)
    if output.published is not None:
        yield from _printed(output.published, drive, not asked)
    for target in asked:
        yield SpeedRequirement.of(
            goal_of(train, target), tolerance if target.tolerance is None else target.tolerance.base
        )


def _half(value: Figure, tolerance: Figure | None) -> Fraction:
    return abs(tolerance.value) if tolerance is not None else value.half or Fraction(0)


def _printed(published: Published, drive: Fraction | None, graded: bool) -> Iterator[SpeedRequirement]:
    """A figure as printed, as speeds; ratios need the speed of the one input, and hold for none without it."""
    label = f"published {published.value} {published.as_}"
    half = _half(published.value, published.tolerance)
    low, high = published.value.value - half, published.value.value + half
    if published.as_ == "speed":
        yield SpeedRequirement(label, published.value.value, True, ((low, high),), graded)
    elif drive is None:
        yield SpeedRequirement(label, Fraction(1), True, (), False)
    elif published.as_ == "output/input":
        ends = sorted((low * drive, high * drive))
        yield SpeedRequirement(label, published.value.value * drive, True, ((ends[0], ends[1]),), graded)
    else:
        wanted = drive / published.value.value if published.value.value else Fraction(0)
        allowed = tuple(_inverse(low, high, drive))
        yield SpeedRequirement(label, wanted, True, allowed, graded and bool(wanted))


def _inverse(low: Fraction, high: Fraction, drive: Fraction) -> Iterator[Interval]:
    """The speeds for which drive over speed lies between two numbers."""
    if low > 0 or high < 0:
        ends = sorted((drive / low, drive / high))
        yield ends[0], ends[1]
        return
    rays = [drive / end for end in (low, high) if end]
    yield from ((None, ray) if ray < 0 else (ray, None) for ray in sorted(rays))
