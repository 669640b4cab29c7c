"""Universal joints, non-circular wheels, and couplings by a table or harmonics: variable ratios with an exact mean.

The driven angle q depends on the angle S of the driver relative to the carrier, in the reference direction of their
axes. `phase` is added to S. Losses follow from a declared `efficiency`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import degrees, pi, sqrt, tan
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from pydantic import AfterValidator, BeforeValidator, ConfigDict, Field, field_validator, model_validator

from geartrain.errors import RangeError
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.quantity import (
    Angle,
    Figure,
    Length,
    Quantity,
    above_zero,
    bad,
    below_right_angle,
    not_below_zero,
)
from geartrain.teeth.coupling import Coupling

if TYPE_CHECKING:
    from geartrain.numerics.periodic_function import Interpolation, PeriodicFunction
    from geartrain.teeth.couplings.series_transmission import SeriesTransmission
    from geartrain.teeth.couplings.table_transmission import TableTransmission

_INTERPOLATIONS: Mapping[str, Interpolation] = {"smooth": "cubic", "straight": "linear", "steps": "steps"}
_FEWEST, _MOST = 4, 10_000  # points of a smooth table
_MOST_LOBES = _MOST_ORDER = 100


JointAngle = Annotated[
    Angle,
    not_below_zero("give an angle from 0 to below 90 deg"),
    below_right_angle("give an angle below 90 deg: a joint at 90 deg does not turn"),
]
Lobes = Annotated[int, Field(ge=1, le=_MOST_LOBES)]


class _VaryingPair(Coupling):
    """Coupling of two links with a variable speed ratio."""

    pair: tuple[str, str] = Field(description="Driving link and driven link")
    phase: Angle | None = Field(None, description="Angle of the driver at the start; default 0")

    @property
    def start(self) -> float:
        """Angle of the driver at the beginning of the motion [rad]."""
        return 0.0 if self.phase is None else self.phase.si

    @property
    def remark(self) -> str:
        """Text that gives the range of the deviation from uniform motion."""
        if self.transmission is None:
            return "has an unknown angle"
        low, high = self.transmission.error_range()
        return f"swings by {degrees(high - low):.3g} deg"


class UniversalJoint(_VaryingPair):
    """Universal joint (Cardan's or Hooke's joint): tan q = tan S / cos(beta), where beta is the angle between the
    shafts, S the angle of the driver and q the angle of the driven shaft.

    S is measured from the plane of both shafts to the fork of the driver. The mean ratio is 1.
    """

    OBLIQUE = HOLDS = True
    UNKNOWN = "backlash"
    NEGLECTED = "side loads of joints", "forces and bending moments on the shafts of a joint are not computed"

    kind: Literal["universal_joint"] = Field(description="Universal joint: mean ratio 1, periods of half a turn")
    angle: JointAngle | None = Field(None, description="Angle between the shafts; default from `axes`")
    phase: Angle | None = Field(
        None, description="Angle of the driver's fork from the plane of both shafts at the start; default 0"
    )

    def on_axes(self, angle: float) -> Self:
        """Return a copy with the angle between its axes [rad], or the joint itself if its angle is declared."""
        if self.angle is not None:
            return self
        shown = f"{degrees(angle):.6g} deg"
        return self.model_copy(update={"angle": Quantity(Fraction(degrees(angle)), "deg", shown)})

    @property
    def periods_per_turn(self) -> Fraction:
        """Number of periods of the transmission function in one revolution of the driver, which is 2."""
        return Fraction(2)

    @property
    def transmission(self) -> SeriesTransmission | None:
        """Transmission function of the joint; None if the angle of the joint is not known."""
        if self.angle is None:
            return None
        from geartrain.teeth.couplings.series_transmission import SeriesTransmission

        rho = tan(self.angle.si / 2) ** 2
        return SeriesTransmission(Fraction(1), 1.0, 2, rho, phase=self.start)

    @property
    def formula(self) -> str:
        """Closed-form formula for the driven angle q."""
        return f"tan q = tan S / cos({self.angle.text if self.angle else 'beta'})"


class _LobedPair(_VaryingPair):
    """Two non-circular wheels in external mesh, whose pitch curves consist of equal lobes."""

    UNKNOWN = "teeth, friction and backlash"

    lobes: tuple[Lobes, Lobes] = Field((1, 1), description="Numbers of lobes of the driver and of the driven wheel")

    @property
    def mean(self) -> Fraction:
        """Mean ratio: minus the number of lobes of the driver divided by the number of lobes of the driven wheel."""
        return -Fraction(*self.lobes)

    @property
    def periods_per_turn(self) -> Fraction:
        """Number of periods of the transmission function in one revolution of the driver: its number of lobes."""
        return Fraction(self.lobes[0])


class EllipticalPair(_LobedPair):
    """Two elliptical or lobed wheels in external mesh, which turn about foci of their pitch curves.

    The driver has the pitch curve r = p / (1 + e cos(n1 theta)), where e is the eccentricity, n1 the number of lobes,
    and theta is measured from a short radius. Its mate has n2 lobes and is conjugate to it. If the numbers of lobes are
    equal, the wheels are equal. At S = 0, a long radius of the driver is on the line of centres.
    """

    kind: Literal["elliptical"] = Field(
        description="Elliptical or lobed wheels that turn about their foci: the mean ratio "
        "is negative, with the ratio of the numbers of lobes as its magnitude"
    )
    eccentricity: Figure = Field(description="Eccentricity e of the driver's pitch curve, 0 to below 1")
    centre_distance: Annotated[Length, above_zero("give a length such as 60 mm")] | None = Field(
        None, description="Distance between the axes, which determines the size of the wheels"
    )
    phase: Angle | None = Field(
        None,
        description="Angle of the driver at the start, measured from the position with a "
        "maximum radius on the line of centres; "
        "default 0",
    )

    @field_validator("eccentricity")
    @classmethod
    def _closes(cls, eccentricity: Figure) -> Figure:
        if not 0 <= eccentricity.value < 1:
            what = f"with an eccentricity of {eccentricity.text} the pitch curve does not close"
            raise bad("law", what, "give a value from 0 (a circle) to less than 1")
        return eccentricity

    @property
    def _root(self) -> float:
        """Square root of 1 - (1 - e^2)(1 - 1/m^2) in the formula for `distance`, with eccentricity e and ratio m."""
        e, m = float(self.eccentricity.value), self.lobes[0] / self.lobes[1]
        return sqrt(1 - (1 - e**2) * (1 - 1 / m**2))

    @property
    def distance(self) -> float:
        """Distance between the axes divided by the semi-latus rectum p of the driver's pitch curve."""
        return (1 + self._root) / (1 - float(self.eccentricity.value) ** 2)

    @property
    def transmission(self) -> SeriesTransmission:
        """Transmission function, a series with rho = e (m + 1)/(m s + 1), where e is the eccentricity, m the absolute
        value of the mean ratio, and s the square root in `distance`.
        """
        from geartrain.teeth.couplings.series_transmission import SeriesTransmission

        m = self.lobes[0] / self.lobes[1]
        rho = float(self.eccentricity.value) * (m + 1) / (m * self._root + 1)
        return SeriesTransmission(-self.mean, 2 / self.lobes[1], self.lobes[0], rho, phase=self.start)

    @property
    def formula(self) -> str:
        """Closed-form formula for the driven angle q."""
        rho = self.transmission.rho
        S, q = ({1: f"{of} / 2", 2: of}.get(n, f"{n} {of} / 2") for n, of in zip(self.lobes, "Sq", strict=True))
        return f"tan({q}) = {(1 + rho) / (1 - rho):.6g} tan({S})"


class PitchCurvePair(_LobedPair):
    """Two non-circular wheels in external mesh: the driver has a given pitch curve, and its mate is conjugate to it.

    The radii at equal angles over one lobe of the driver, starting at S = 0, are joined by a periodic cubic spline. The
    centre distance C follows from the condition that the pitch curve of the mate is closed: the mean of r/(C - r) is
    the mean ratio.
    """

    kind: Literal["pitch_curve"] = Field(
        description="Non-circular wheels given by the radii of the driver: the mean ratio "
        "is negative, with the ratio of the numbers of lobes as its magnitude"
    )
    radii: tuple[Length, ...] = Field(
        description="Radii of the driver's pitch curve at equal angles over one lobe, 4 or more; the first is not "
        "repeated at the end"
    )
    phase: Angle | None = Field(
        None,
        description="Angle of the driver at the start, measured from the position with the "
        "first radius on the line of centres; "
        "default 0",
    )

    @model_validator(mode="after")
    def _has_a_mate(self) -> PitchCurvePair:
        _check_points(self.radii, "radii", _FEWEST)
        if len({radius.unit is None for radius in self.radii}) > 1:
            raise bad("law", "some radii have a unit, others do not", "give all radii with a unit, or all without one")
        if min(radius.base for radius in self.radii) <= 0:
            raise bad("law", "a radius of the pitch curve is not above 0", "give radii above 0")
        try:
            _ = self.distance
        except RangeError as error:
            raise bad("law", f"{error.problems[0].what}: {error.problems[0].why}", error.problems[0].fix) from None
        return self

    @property
    def distance(self) -> float:
        """Distance between the axes [m], or in the unit of the radii if these are given without a unit."""
        from geartrain.teeth.couplings.pitch_curves import mate_distance

        return mate_distance(self._values, float(-self.mean))

    @property
    def _values(self) -> tuple[float, ...]:
        return tuple(radius.si for radius in self.radii)

    @property
    def transmission(self) -> TableTransmission:
        """Transmission function by quadrature of r/(C - r), with the driver's radius r and the axis distance C."""
        from geartrain.teeth.couplings.pitch_curves import mate_deviation
        from geartrain.teeth.couplings.table_transmission import TableTransmission

        deviation, _ = mate_deviation(self._values, self.distance, 2 * pi / self.lobes[0])
        return TableTransmission(-self.mean, deviation, self.start)

    @property
    def formula(self) -> str:
        """Closed-form formula for the speed ratio dq/dS."""
        return f"dq/dS = r / (C - r), C = {self.distance:.6g}{'' if self.radii[0].unit is None else ' m'}"


def _amplitude(raw: Any) -> Any:
    return raw if isinstance(raw, Sequence) and not isinstance(raw, str) else (raw, "0 deg")


Harmonic = Annotated[tuple[Figure, Angle], BeforeValidator(_amplitude)]


class TabledLaw(_VaryingPair):
    """Coupling with the driven angle q = mean S + unit d(S), where S is the angle of the driver, the mean ratio and the
    unit are declared, and the function d is given by harmonics or by a table.

    A mean ratio of 0 describes a cam with an oscillating arm.
    """

    NEEDS_DISTANCE = False
    UNKNOWN = "profile and backlash"
    NEGLECTED = "friction of followers", "the profiles of a cam and its follower are not known"

    model_config = ConfigDict(populate_by_name=True)

    kind: Literal["law"] = Field(description="Driven angle given by a mean ratio and a periodic deviation")
    mean_ratio: Figure = Field(
        alias="mean", description="Exact mean speed of the driven link divided by that of the driver"
    )
    unit: Angle = Field(description="Angle of the driven link for a deviation of 1")
    harmonics: Annotated[dict[int, Harmonic], AfterValidator(FrozenDict)] | None = Field(
        None,
        description="Deviation given by harmonics: order k in `per` turns -> amplitude A, or [A, angle], for a term "
        "A sin(k S + angle)",
    )
    table: tuple[Figure, ...] | None = Field(
        None, description="Deviation given at equal angles of the driver over `per` turns; the first is not repeated"
    )
    per: Annotated[Figure, above_zero("give the turns of the driver in one period, such as 1")] = Field(
        Figure.parse(1), description="Turns of the driver in one period of the deviation"
    )
    between: Literal["smooth", "straight", "steps"] = Field(
        "smooth",
        description="Interpolation between the points of a table: cubic spline, straight lines, or constant values",
    )
    phase: Angle | None = Field(
        None, description="Phase of the deviation at the start, as an angle of the driver; default 0"
    )

    @model_validator(mode="after")
    def _has_one_form(self) -> TabledLaw:
        if (self.harmonics is None) == (self.table is None):
            found = "both" if self.table is not None else "neither"
            raise bad("law", f"a law needs `harmonics` or `table`; found: {found}", "give one of them")
        if self.table is not None:
            _check_points(self.table, "table", _FEWEST if self.between == "smooth" else 2)
        elif not self.harmonics or min(self.harmonics) < 1 or max(self.harmonics) > _MOST_ORDER:
            what = "the orders of harmonics are not all from 1 to 100"
            raise bad("law", what, "give orders of 1 or more; a constant is `phase`, or the `angle` of the link")
        return self

    @property
    def mean(self) -> Fraction:
        """Exact mean speed ratio."""
        return self.mean_ratio.value

    @property
    def periods_per_turn(self) -> Fraction:
        """Number of periods of the transmission function in one revolution of the driver."""
        return 1 / self.per.value

    @property
    def transmission(self) -> TableTransmission:
        """Transmission function; angles of the driven side are positive in its mean sense of rotation."""
        from geartrain.numerics.periodic_function import HarmonicSeries, PeriodicTable
        from geartrain.teeth.couplings.table_transmission import TableTransmission

        scale = self.unit.si * (-1 if self.mean < 0 else 1)
        period = 2 * pi * float(self.per.value)
        deviation: PeriodicFunction
        if self.table is not None:
            values = [scale * float(each.value) for each in self.table]
            steps = [at * period / len(values) for at in range(len(values))]
            deviation = PeriodicTable(steps, values, period, _INTERPOLATIONS[self.between])
        else:
            terms = [(k, scale * float(size.value), angle.si) for k, (size, angle) in (self.harmonics or {}).items()]
            deviation = HarmonicSeries(terms, period)
        return TableTransmission(abs(self.mean), deviation, self.start)

    @property
    def formula(self) -> str:
        """Closed-form formula for the driven angle q."""
        mean = f"{fraction_text(self.mean)} S + " if self.mean else ""
        turn = "S" if self.per.value == 1 else f"S/{self.per.text}"
        if self.harmonics is None:
            return f"q = {mean}{self.unit.text} x table of {len(self.table or ())} points, {self.between}"
        terms = [
            f"{size.text} sin({'' if k == 1 else f'{k} '}{turn}{f' + {angle.text}' if angle.value else ''})"
            for k, (size, angle) in self.harmonics.items()
        ]
        return f"q = {mean}{self.unit.text} x ({' + '.join(terms)})".replace("+ -", "- ")


def _check_points(points: Sequence[Any], name: str, fewest: int) -> None:
    if not fewest <= len(points) <= _MOST:
        what = f"`{name}` has {len(points)} values"
        raise bad("law", what, f"give {fewest} to {_MOST} values at equal angles")
    bases = [point.value if isinstance(point, Figure) else point.base for point in points]
    if len(points) > fewest and bases[0] == bases[-1] and len(set(bases)) > 1:
        what = f"the first value of `{name}` is repeated at the end"
        raise bad("law", what, "omit the last value: the values are periodic")
