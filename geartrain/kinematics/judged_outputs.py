"""Comparison of outputs with expected, published and astronomical values, and the effect of one tooth more or fewer."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal, NamedTuple, Required, TypedDict

from geartrain.kinematics.circuits import Circuit
from geartrain.numerics.exact import as_float, decimal, fraction_text, pi_text, touches_pi
from geartrain.numerics.quantity import Figure
from geartrain.numerics.results import Key, Result
from geartrain.train import Output, StateCase, Train
from geartrain.train.outputs import PrintedPeriod, Target, year_seconds
from geartrain.train.periods import period_table

DAYS_PER_CENTURY = 36525  # days in a Julian century
SECONDS_PER_DAY = 86400
SECONDS_PER_YEAR = 31556952  # 365.2425 d, the mean year of the Gregorian calendar
SpeedValue = Fraction | float
Relative = Callable[[str, str], SpeedValue | None]
"""Function that returns the speed of one link relative to another, about the axis of the first link; None if the speed
is undetermined.
"""


@dataclass(frozen=True, slots=True)
class RatioGoal:
    """Speed that is required by a declared target of an output, with its sign or only as a magnitude."""

    label: str
    """Description of the required speed without its sense of rotation."""
    speed: Fraction
    """Required speed [the train's unit of speed]; it is positive if only the magnitude is compared."""
    signed: bool
    """True if the sign of the speed is compared, False if only its magnitude is compared."""
    sense: str = ""
    """Declared sense of rotation of the required speed: "direct", "retrograde" or empty."""

    @property
    def words(self) -> str:
        """Description of the required speed with its sense of rotation."""
        return f"{self.label} {self.sense}".rstrip() if self.signed else f"{self.label} in either sense"


def error_against(speed: SpeedValue, wanted: Fraction, signed: bool) -> SpeedValue:
    """Return the relative error speed / wanted - 1, of magnitudes unless `signed`; the speed if `wanted` is 0."""
    own = speed if signed else magnitude(speed)
    return own / wanted - 1 if wanted else own


@dataclass(frozen=True, slots=True)
class TargetResult(Result):
    """Comparison of an output with one target. A positive error means that the output is faster than the target."""

    KEYS = (
        Key("target", "label"),
        Key("speed", to=as_float),
        "compared",
        "ppm",
        "days_per_century",
        "seconds_per_day",
        "seconds_per_year",
        "days_to_one_day",
        "degrees_per_unit",
        "met",
    )

    goal: RatioGoal
    """Required speed [the train's unit of speed], and whether its sign is compared."""
    error: SpeedValue
    """Relative error [1]: speed of the output divided by the target, minus 1. Magnitudes are compared if the target has
    no sign. If the target is 0, the value is the speed of the output.
    """
    days_per_century: float | None
    """Time that the pointer gains on the target [d per 36525 d]. None if the unit of speeds does not contain a unit of
    time, if the target is 0, or if the value exceeds the range of float64.
    """
    degrees_per_unit: float | None
    """Angle that the pointer gains on the target during one `unit` of the declaration, such as a year [deg]; None if
    the value exceeds the range of float64.
    """
    met: bool | None
    """True if `error` is within the declared tolerance; None if no tolerance is declared."""

    @property
    def label(self) -> str:
        """Description of the target."""
        return self.goal.label

    @property
    def speed(self) -> Fraction:
        """Required speed [the train's unit of speed]; it is positive if only the magnitude is compared."""
        return self.goal.speed

    @property
    def compared(self) -> Literal["speed", "magnitude", "difference"]:
        """Kind of comparison: "speed" with its sign, "magnitude" of the speed, or "difference" from a target of 0."""
        return ("speed" if self.goal.signed else "magnitude") if self.speed else "difference"

    @property
    def ppm(self) -> float | None:
        """Relative error [ppm]; None if the target is 0, or if the value exceeds the range of float64."""
        return as_plain_product(self.error, 10**6) if self.speed else None

    @property
    def seconds_per_day(self) -> float | None:
        """Time that a clock gains on the target [s/d]; None if `days_per_century` is None."""
        return None if self.days_per_century is None else as_plain_product(self.error, SECONDS_PER_DAY)

    @property
    def seconds_per_year(self) -> float | None:
        """Time that a clock gains on the target [s per 365.2425 d]; None if `days_per_century` is None."""
        return None if self.days_per_century is None else as_plain_product(self.error, SECONDS_PER_YEAR)

    @property
    def days_to_one_day(self) -> float | None:
        """Time after which the error is one day [d]; None if the error is 0, or if `days_per_century` is None."""
        return abs(1 / self.days_per_century) * DAYS_PER_CENTURY if self.days_per_century else None


class SpeedFigures(TypedDict, total=False):
    """Speed in the form of the JSON output: exact fraction as text, nearest float, and errors of float solutions."""

    exact: Required[str | None]
    """Exact speed as a string such as "2/7" or "36 π"; None if the speed was computed in floats, contains π in another
    way, or is not determined.
    """
    value: Required[float | None]
    """Float64 number nearest to the speed; None if the speed is beyond the range of float64 or is not determined."""
    unit: str
    """Unit of the travel of a sliding link, `mm`, per `unit` of the declaration or per turn; omitted for turning links.
    """
    decimal: str
    """Speed as a decimal number with twelve digits, given only if the speed is beyond the range of float64."""
    estimate: float | None
    """Estimated absolute error of a speed that was computed in floats [the train's unit of speed]."""
    true_error: float | None
    """True error of a speed that was computed in floats [the train's unit of speed]; None if the exact speed is not
    known.
    """
    tolerance: float
    """Tolerance of a speed that depends on a coupling with an approximate `ratio` [the train's unit of speed]."""
    condition: float | None
    """Component-wise condition number of a speed that was computed in floats [1]; None for a link at rest, omitted in
    trains of more than 400 links.
    """


class JudgedExpectation(NamedTuple):
    """Declared `expect` of an output, and the result of comparing it with the speed."""

    value: str
    """Expected value as declared."""
    holds: bool | None
    """True if the speed equals the expected value within its tolerance; False if it differs or is not determined."""


@dataclass(frozen=True, slots=True)
class JudgedFigure(Result):
    """Declared `published` value of an output, the calculated value, and the result of comparing the two values."""

    KEYS = ("value", Key("as", "form"), "place", "found", "holds")

    value: str
    """Value as printed in the source."""
    form: Literal["speed", "input/output", "output/input", "period"]
    """Quantity that the source prints: "speed", "output/input", "input/output" or "period"."""
    place: str | None
    """Location in the source at which the value is printed; None if it is not declared."""
    found: SpeedValue | None
    """The same quantity as calculated for this train; a period is in seconds. None if it is not determined."""
    holds: bool | None
    """True if the published and the calculated value agree in all printed digits, or within the declared tolerance;
    False if they differ, or if the quantity is not determined.
    """


@dataclass(frozen=True, slots=True)
class OutputResult(Result):
    """Speed of one output, and its comparison with the declared expectations."""

    KEYS = (
        Key("", "figures"),
        "of",
        "relative_to",
        Key("output/input", "ratio"),
        Key("period_s", "period", as_float),
        "expect",
        "published",
        "targets",
    )

    name: str
    """Name of the output."""
    output: Output
    """Declaration of the output."""
    of: str
    """Link whose speed is the output."""
    relative_to: str
    """Link relative to which the speed is measured."""
    speed: SpeedValue | None
    """Speed of `of` relative to `relative_to`, about the axis of `of` [the train's unit of speed]; a Fraction, or a
    float if it was computed in floats. None if it is undetermined.
    """
    ratio: SpeedValue | None
    """Speed of the output divided by the speed of the input; None unless exactly one input has a non-zero speed."""
    expect_holds: bool | None
    """True if the speed agrees with the declared `expect`; False if it differs or is not determined; None if no
    `expect` is declared.
    """
    targets: tuple[TargetResult, ...]
    """Comparisons with the declared targets; empty if the speed is not determined."""
    bookkeeping: bool
    """True if `speed` is a sum of joint speeds about non-parallel axes, which is not the speed of a rotation."""
    unit_seconds: Fraction | None
    """Time of one turn at a speed of 1 [s]; None if the train has no unit of time."""
    tolerance: Fraction = Fraction(0)
    """Tolerance of the speed due to couplings with an approximate `ratio` [the train's unit of speed]; 0 if it is
    exact.
    """

    slides: bool = False
    """True if the link slides and `speed` is its travel [mm per `unit` of the declaration; mm per turn if no `unit` is
    declared].
    """

    @property
    def period(self) -> SpeedValue | None:
        """Time of one turn [s]; None if the link is at rest or slides, or if its speed or the time unit is unknown."""
        if self.slides or not self.unit_seconds or not self.speed:
            return None
        return self.unit_seconds / magnitude(self.speed)

    @property
    def found(self) -> SpeedValue | None:
        """Value that is compared with the `published` value; None if it is undefined, or if no value is published.

        A period is in seconds; it is negative if the output turns in the sense opposite to the declared `sense`.
        """
        published, speed, ratio, unit = self.output.published, self.speed, self.ratio, self.unit_seconds
        if published is None:
            return None
        backwards = False
        if published.as_ == "period":
            found = published.turns.value * unit / speed if speed and unit else None
            backwards = published.sense == "retrograde"
        else:
            found = {"speed": speed, "output/input": ratio, "input/output": 1 / ratio if ratio else None}[published.as_]
        if found is None:
            return None
        return magnitude(found) if published.unsigned else -found if backwards else found

    @property
    def found_text(self) -> str | None:
        """Value compared with a published period, as text in the units of the source; None without such a period."""
        figure = self.output.published
        if figure is None or self.found is None or not isinstance(figure.value, PrintedPeriod):
            return None
        text = figure.value.text_of(abs(Fraction(self.found)), year_seconds(self.unit_seconds))
        return text if self.found > 0 else f"{text} in the opposite sense"

    @property
    def published_holds(self) -> bool | None:
        """True if the output agrees with the declared `published` value; False if it differs or is not determined; None
        if no value is published.
        """
        return self._holds_published(sign=1)

    @property
    def figures(self) -> SpeedFigures:
        """Speed of the output in the form of the JSON output."""
        plain = speed_figures(self.speed, self.slides)
        return plain | {"tolerance": float(self.tolerance)} if self.tolerance else plain

    @property
    def expect(self) -> JudgedExpectation | None:
        """Declared `expect` with the result of its comparison; None if no `expect` is declared."""
        expect = self.output.expect
        return None if expect is None else JudgedExpectation(str(expect.value), self.expect_holds)

    @property
    def published(self) -> JudgedFigure | None:
        """Published value with the result of its comparison; None if no value is published."""
        figure = self.output.published
        if figure is None:
            return None
        return JudgedFigure(str(figure.value), figure.as_, figure.place, self.found, self.published_holds)

    @property
    def holds(self) -> bool:
        """False if the output differs from an `expect` or `published` value, or is outside the tolerance of a target;
        True if not.
        """
        judged = (self.expect_holds, self.published_holds, *(target.met for target in self.targets))
        # None means that nothing was declared or compared, which is not a failure
        return False not in judged

    @property
    def differs_in_sign(self) -> bool:
        """True if the output violates `expect` or `published`, and would satisfy both with the opposite sign."""
        if self.speed is None or (self.expect_holds is not False and self.published_holds is not False):
            return False
        expected = self.expect_holds is not False or _expect_holds(self.output, -self.speed)
        return bool(expected and (self.published_holds is not False or self._holds_published(sign=-1)))

    def _holds_published(self, sign: int) -> bool | None:
        """Return True if the output, multiplied by `sign` (1 or -1), agrees with the published value, False if it
        differs, and None if no value is published.
        """
        published, value = self.output.published, self.found
        if published is None:
            return None
        if value is None:
            return False
        unit, tolerance = self.unit_seconds, published.tolerance
        bound = None if tolerance is None else in_plain_units(tolerance, unit).value
        return in_plain_units(published.value, unit).holds(sign * Fraction(value), bound)


def as_plain_product(value: SpeedValue, times: int) -> float | None:
    """Return the product of `value` and `times` as a float; None if `value` is beyond the range of float64."""
    size = as_float(value)
    return None if size is None else size * times


def magnitude(value: SpeedValue) -> SpeedValue:
    """Return the absolute value of a speed or error, of the same type."""
    return value if value >= 0 else -value


def speed_figures(speed: SpeedValue | None, slides: bool = False) -> SpeedFigures:
    """Return a speed in the form of the JSON output. If it is beyond the range of float64, `value` is None and
    `decimal` is given. `slides` is True if the speed is a travel in mm.
    """
    if not isinstance(speed, Fraction):
        return {"exact": None, "value": speed}
    value = as_float(speed)
    text: str | None = fraction_text(speed)
    if touches_pi(speed):
        text = pi_text(speed)
        text = None if text.startswith("≈") else text
    plain: SpeedFigures = {"exact": text, "value": value}
    if slides:
        plain["unit"] = "mm"
    if value is None:
        plain["decimal"] = decimal(speed)
    return plain


def judge_outputs(
    train: Train, case: StateCase, relative: Relative, is_rotation: Callable[[str, str], bool]
) -> Iterator[OutputResult]:
    """Yield the comparison of every output of a state with its declared expectations.

    relative      function that returns the speed of one link relative to another, about the axis of the first link
    is_rotation   function that returns whether all axes between two links are parallel
    """
    moving = [speed for speed in case.inputs.values() if speed]
    # a ratio to the input is defined only for a single moving input
    drive = moving[0] if len(moving) == 1 else None
    for name, output in case.outputs.items():
        of, base = output.links(name, train.frame)
        speed = relative(of, base)
        ratio = None if speed is None or drive is None else speed if drive == 1 else speed / drive
        yield OutputResult(
            name,
            output,
            of,
            base,
            speed,
            ratio,
            _expect_holds(output, speed),
            tuple(_compare_with_target(train, target, speed) for target in output.targets if speed is not None),
            not is_rotation(of, base),
            unit_seconds(train),
            slides=of in train.sliding,
        )


def _expect_holds(output: Output, speed: SpeedValue | None) -> bool | None:
    """Return True if the speed agrees with the declared `expect`, False if it differs or is undetermined, and None if
    no `expect` is declared.
    """
    expect = output.expect
    if expect is None or speed is None:
        return None if expect is None else False
    exact = Fraction(speed)
    # floats are compared with an exact expectation to nine digits, well above their rounding errors
    slack = Fraction(1, 10**9) * max(Fraction(1), abs(exact))
    return (not isinstance(speed, Fraction) and abs(exact - expect.value.value) <= slack) or expect.holds(exact)


def unit_seconds(train: Train) -> Fraction | None:
    """Return the time [s] of one turn at a speed of 1 [the train's unit of speed]; None if the train has no unit of
    time.
    """
    return 1 / train.unit_speed if train.unit_speed else None


def in_plain_units(printed: Figure, unit: Fraction | None) -> Figure:
    """Return a published value or tolerance in the unit of `OutputResult.found`, with periods in seconds. `unit` is the
    time [s] of one turn at a speed of 1, which defines the year of the source.
    """
    return printed.in_seconds(year_seconds(unit)) if isinstance(printed, PrintedPeriod) else printed


def goal_of(train: Train, target: Target) -> RatioGoal:
    """Return the speed that a target requires [the train's unit of speed], and whether its sign is compared."""
    turns = target.turns.value
    if target.speed is not None:
        return RatioGoal(f"speed {target.speed}", target.speed.value * turns, True)
    if target.period is not None:
        label, speed = f"period {target.period}", turns * (train.unit_base or Fraction(1)) / target.period.base
    else:
        row, days = period_table()[target.name or ""], train.unit_days or Fraction(1)
        label = row.name if turns == 1 else f"{turns} turns in {row.name}"
        # rows of the period table are periods in days, or speeds
        speed = turns * (days / row.value if row.kind == "period" else abs(row.value))
    if target.sense is None:
        return RatioGoal(label, speed, False)
    return RatioGoal(label, -speed if target.sense == "retrograde" else speed, True, target.sense)


def _compare_with_target(train: Train, target: Target, speed: SpeedValue) -> TargetResult:
    goal = goal_of(train, target)
    error = error_against(speed, goal.speed, goal.signed)
    tolerance = target.tolerance.base if target.tolerance else None
    ahead = (speed if goal.signed else magnitude(speed)) - goal.speed
    return TargetResult(
        goal,
        error,
        as_plain_product(error, DAYS_PER_CENTURY) if train.unit_days is not None and goal.speed else None,
        # a faster retrograde output has a smaller (more negative) speed; a gain is positive in both senses
        as_plain_product(-ahead if goal.speed < 0 else ahead, 360),
        None if tolerance is None else magnitude(error) <= tolerance,
    )


@dataclass(frozen=True, slots=True)
class Sensitivity(Result):
    """Exact change of the speed of an output if an uncertain wheel has one tooth fewer or one tooth more.

    Examples
    --------
    With 63 teeth instead of 64, the speed of the Moon pointer decreases by 1/64:

    >>> import geartrain
    >>> train = geartrain.load("freeth-2008-doubt")
    >>> found = next(train.kinematics.sensitivity(train.solve()))
    >>> found.wheel, found.output, found.less, found.less == -1e6 / found.teeth
    ('b2', 'moon', -15625.0, True)
    """

    KEYS = ("wheel", "teeth", "output", Key("one_fewer_ppm", "less"), Key("one_more_ppm", "more"))

    wheel: str
    """Wheel with an uncertain tooth count."""
    teeth: int
    """Tooth count that the train uses for the wheel."""
    allowed: tuple[int, ...]
    """Tooth counts that the evidence allows for the wheel."""
    output: str
    """Name of the output."""
    less: float | None
    """Relative change of the output's speed if the wheel has one tooth fewer [ppm]; None if the train then cannot turn,
    or if the output is at rest.
    """
    more: float | None
    """Relative change of the output's speed if the wheel has one tooth more [ppm]; None if the train then cannot turn,
    or if the output is at rest.
    """


def sensitivity(
    train: Train,
    outputs: Sequence[OutputResult],
    solve_with: Callable[[Sequence[Circuit]], Relative],
    circuits: Sequence[Circuit],
) -> Iterator[Sensitivity]:
    """Yield the relative change of the speed of each affected output [ppm] if an uncertain wheel has one tooth fewer or
    one tooth more.

    solve_with   function that solves the train with the given circuits, and returns a function of two links that
                 returns the speed of the first link relative to the second
    """
    for name, wheel in train.uncertain_wheels():
        teeth = wheel.count
        if teeth is None or not any(name in circuit.wheels for circuit in circuits):
            continue
        changed = {
            step: solve_with([circuit.with_counts({name: teeth + step}) for circuit in circuits])
            for step in (-1, 1)
            if teeth + step > 0
        }
        for result in outputs:
            shift = {step: _relative_change(result, relative) for step, relative in changed.items()}
            # outputs that the wheel does not affect are omitted
            if any(value != 0 for value in shift.values()):
                allowed = wheel.uncertainty.allowed if wheel.uncertainty else ()
                yield Sensitivity(name, teeth, allowed, result.name, shift.get(-1), shift.get(1))


def _relative_change(result: OutputResult, relative: Relative) -> float | None:
    speed = relative(result.of, result.relative_to)
    if speed is None or result.speed is None:
        return None
    if speed == result.speed:
        return 0.0
    # exact if the answer is exact: in floats cancellation would leave few digits
    return as_plain_product(speed / result.speed - 1, 10**6) if result.speed else None
