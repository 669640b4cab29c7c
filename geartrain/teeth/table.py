"""Pairs with a measured or prescribed transmission error instead of the shape of their teeth."""

from __future__ import annotations

from itertools import count
from math import lcm, pi
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, cast
from weakref import WeakValueDictionary

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, GetJsonSchemaHandler, model_validator
from pydantic.json_schema import SkipJsonSchema
from pydantic_core import core_schema

from geartrain.numerics.quantity import (
    Angle,
    Dimension,
    Figure,
    Quantity,
    Share,
    bad,
    below_right_angle,
    checked,
    not_below_zero,
)
from geartrain.teeth.contact_coefficients import DeclaredEfficiency
from geartrain.teeth.tooth_form import (
    ShaftAngle,
    ToothForm,
    TwoAngles,
    TwoLengths,
    check_one_of,
    in_modules,
    number_of_wheel,
    refused,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geartrain.numerics.periodic_function import PeriodicFunction, PeriodicTable
    from geartrain.teeth.given_transmission import Efficiencies, GivenMesh, GivenTransmission, TransmissionProtocol
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.teeth.transmission import TransmissionFunction

_NEAR = 0.5  # of the mean driven angle: a larger error at the end of a period is probably a total angle

Period = Literal["driver_pitch", "driver_turn", "driven_turn", "cycle"]
Interpolation = Literal["pchip", "cubic", "linear"]
Position = Annotated[Quantity, Dimension("angle", plain=True)]


class PeriodicPoints(BaseModel):
    """Base class of periodic quantities of a gear pair that are given by points."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    over: Period = Field(
        "driver_pitch",
        description="Period of the values: a pitch or a revolution of the driver, a revolution of the driven wheel, or "
        "the cycle after which the same teeth meet",
    )
    interpolation: Interpolation = Field(
        "pchip",
        description="Curve through the points: `pchip` (monotonic between neighbouring points), `cubic` (periodic "
        "spline) or `linear`",
    )

    def period(self, counts: tuple[int, int]) -> float:
        """Return the period [rad of the driver]. `counts` are the tooth counts of driver and driven wheel."""
        z1, z2 = counts
        pitches = {"driver_pitch": 1, "driver_turn": z1, "driven_turn": z2, "cycle": lcm(z1, z2)}[self.over]
        return 2 * pi * pitches / z1

    def table(self, points: Sequence[tuple[Quantity, float]], counts: tuple[int, int]) -> PeriodicTable:
        """Return the periodic function that passes through points. Each point consists of a position and a value. A
        position with a unit is an angle of the driver; a position without a unit is a fraction of the period.

        Raises `GearTrainError` if the last point does not agree with the first one, or if the points do not define a
        function.
        """
        from geartrain.numerics.periodic_function import PeriodicTable, check_points

        period = self.period(counts)
        shares = [float(at.value) if at.unit is None else at.si / period for at, _ in points]
        values = [value for _, value in points]
        if len(points) > 1 and abs(shares[-1] - 1) < 1e-12:
            self._check_closed(values, counts)
            shares, values = shares[:-1], values[:-1]
        check_points(shares, values, 1.0, self.interpolation)
        return PeriodicTable([share * period for share in shares], values, period, self.interpolation)

    def _check_closed(self, values: Sequence[float], counts: tuple[int, int]) -> None:
        """Raise `GearTrainError` if the last of `values` is at the end of the period and differs from the first."""
        gap, turned = values[-1] - values[0], self.period(counts) * counts[0] / counts[1]
        if abs(gap) <= 1e-12 * max(map(abs, values)):
            return
        what = f"the last point, at the end of the period, differs from the first one by {gap:.6g}"
        why = f"the mean ratio would differ from {counts[0]}/{counts[1]} by {gap / self.period(counts):.6g}"
        fix = "remove the drift of the measurement, and give the end of the period the value of its start, or omit it"
        if abs(gap - turned) < _NEAR * turned:
            fix = "give the transmission error: the driven angle minus the driver angle times the ratio"
        raise refused(what, why, fix)


def _with_phase(term: object) -> object:
    return [*term, "0"] if isinstance(term, list | tuple) and len(term) == 2 else term


Harmonic = Annotated[
    tuple[Figure, Angle, Angle], BeforeValidator(_with_phase), Field(json_schema_extra={"minItems": 2})
]


class ErrorContribution(PeriodicPoints):
    """Periodic transmission error of a gear pair as declared by points or harmonics."""

    points: tuple[tuple[Position, Angle], ...] | None = Field(
        None,
        description="Points [angle, error]: angle of the driver from 0, or fraction of the period; error of the driven "
        "wheel, positive ahead. The end of the period is its start",
    )
    harmonics: tuple[Harmonic, ...] | None = Field(
        None,
        description="Harmonics [n, amplitude, phase] of the period: amplitude sin(n x + phase), where x is 360 deg "
        "after one period",
    )

    @model_validator(mode="after")
    def _has_one_kind(self) -> ErrorContribution:
        if (self.points is None) == (self.harmonics is None):
            what = "an error has " + ("neither points nor harmonics" if self.points is None else "points and harmonics")
            raise bad("error", what, "give `points` or `harmonics`; a list of errors adds several of them")
        return self

    def function(self, counts: tuple[int, int]) -> PeriodicFunction:
        """Return the transmission error [rad of the driven wheel] as a function of the driver angle [rad]. `counts` are
        the tooth counts of driver and driven wheel.
        """
        from geartrain.numerics.periodic_function import HarmonicSeries

        if self.points is not None:
            return self.table([(at, error.si) for at, error in self.points], counts)
        terms = [(float(n.value), amplitude.si, phase.si) for n, amplitude, phase in self.harmonics or ()]
        return HarmonicSeries(terms, self.period(counts))


_POSITIVE = not_below_zero("give 0 or more")
_POSSIBLE = checked(
    lambda given: 0 < given.base <= 1,
    "an efficiency of {text} is out of range",
    "give an efficiency above 0 and at most 1, such as 0.96 or 96 %",
)


class EfficiencyTable(PeriodicPoints):
    """Declared efficiency of a gear pair over a period. It is the same for both driving wheels."""

    points: tuple[tuple[Position, Annotated[Share, _POSSIBLE]], ...] = Field(
        description="Points [angle, efficiency]: angle of the driver from 0, or fraction of the period"
    )

    def function(self, counts: tuple[int, int]) -> PeriodicFunction:
        """Return the efficiency as a periodic function of the driver angle [rad]."""
        return self.table([(at, float(efficiency.base)) for at, efficiency in self.points], counts)


class LiveFunction:
    """Transmission function written in Python, as part of a tooth form. In plain data it is represented by its name,
    which can be read only while the Python object exists.
    """

    _living: ClassVar[WeakValueDictionary[str, LiveFunction]] = WeakValueDictionary()
    _numbers = count(1)

    def __init__(self, function: TransmissionProtocol) -> None:
        self.function = function
        self.name = f"{type(function).__name__} object {next(self._numbers)}"
        self._living[self.name] = self

    def __repr__(self) -> str:
        return self.name

    @classmethod
    def read(cls, raw: object) -> LiveFunction:
        """Return the transmission function `raw`, which is a Python object or, in plain data, the name of one."""
        from geartrain.teeth.given_transmission import TransmissionProtocol

        found = cls._living.get(raw, raw) if isinstance(raw, str) else raw
        if isinstance(found, LiveFunction | TransmissionProtocol):
            return found if isinstance(found, LiveFunction) else cls(found)
        what = f"'{str(raw)[:60]}' is not a transmission function of this Python session"
        fix = "attach an object with `ratio`, `period`, `error` and `speed` by `GearTrain.with_tooth_form`"
        raise bad("function", what, fix)

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> core_schema.CoreSchema:
        as_name = core_schema.plain_serializer_function_ser_schema(str)
        return core_schema.no_info_plain_validator_function(cls.read, serialization=as_name)


def _listed(raw: object) -> object:
    return [raw] if isinstance(raw, dict | ErrorContribution) else raw


class _OneOrSeveral:
    # pydantic 2.11 cannot resolve the schema of `json_schema_input_type` here
    def __get_pydantic_json_schema__(self, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        made = handler(schema)
        return {"anyOf": [made["items"], made]}


class GivenError(ToothForm):
    """Given transmission error of a gear pair, from a measurement or a calculation, instead of the shape of its teeth.

    All given errors are added. They are functions of the angle of the wheel `driver`. If the other wheel drives, its
    transmission function is the inverse function.

    See Also
    --------
    geartrain.GearTrain.with_tooth_form : also accepts a transmission function written in Python.

    Examples
    --------
    A pinion of 20 teeth, whose centre is 0.2 modules off its axis, drives a wheel of 60 teeth.

    >>> from math import degrees
    >>> runout = GivenError(form="table", eccentricity=["0.2", "0"])
    >>> round(degrees(runout.transmission(20, 60).error(0.0)), 10)
    0.1363551848
    """

    has_shape: ClassVar[bool] = False
    own_play: ClassVar[tuple[str, ...]] = ("backlash",)

    form: Literal["table"] = Field(description="Name of the tooth form")
    driver: Annotated[Literal[1, 2], BeforeValidator(number_of_wheel)] = Field(
        1, description="Wheel to whose angle the errors refer, the first or second of the pair"
    )
    error: Annotated[tuple[ErrorContribution, ...], BeforeValidator(_listed), _OneOrSeveral()] | None = Field(
        None, description="Transmission error over a period, or a list of errors that are added; default no error"
    )
    eccentricity: TwoLengths = Field(
        "0",
        validate_default=True,
        description="Distance of the centre of involute teeth from the axis of their wheel, half of the radial runout "
        "Fr; in modules or with a unit, one value, or a list of two (first, second wheel)",
    )
    eccentricity_angle: TwoAngles = Field(
        "0",
        validate_default=True,
        description="Direction of the centre at angle 0, from the direction of the driven wheel's axis, in the sense "
        "in which the driver turns",
    )
    pressure_angle: Annotated[Angle, below_right_angle("for example, 20 deg")] = Field(
        "20 deg", validate_default=True, description="Pressure angle of eccentric involute teeth"
    )
    efficiency: DeclaredEfficiency | None = Field(
        None, description="Efficiency, above 0 and at most 1, or `{forward, backward}`: first or second wheel driving"
    )
    efficiency_table: EfficiencyTable | None = Field(
        None, description="Efficiency over a period, instead of `efficiency`"
    )
    backlash: Annotated[Angle, _POSITIVE] = Field(
        "0", validate_default=True, description="Angle by which the driven wheel is ahead while the driver turns back"
    )
    function: SkipJsonSchema[LiveFunction | None] = Field(
        None, repr=False, description="Transmission function defined in Python, set by `GearTrain.with_tooth_form`"
    )

    @model_validator(mode="after")
    def _check_values(self) -> GivenError:
        check_one_of(self, "efficiency", "efficiency", "efficiency_table")
        for each in (self.efficiency.forward, self.efficiency.backward) if self.efficiency is not None else ():
            cast(Any, _POSSIBLE.func)(each)
        for each in self.eccentricity:
            cast(Any, _POSITIVE.func)(each)
        return self

    @property
    def words(self) -> str:
        """Name of the form as it appears in sentences."""
        return "tabulated" if self.function is None else "user-defined"

    @property
    def has_lengths(self) -> bool:
        """True if an eccentricity is declared with a unit."""
        return any(each.unit is not None for each in self.eccentricity)

    def thinned(self, backlash: Quantity) -> GivenError:
        """Return the form unchanged, because its own backlash is an angle and the given backlash does not apply."""
        del backlash
        return self

    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> GivenMesh:
        """Return the mesh of a gear pair with its first wheel driving."""
        from geartrain.teeth.given_transmission import given_mesh

        del shaft_angle
        offsets = [in_modules(each, wheels.module, "eccentricity") for each in self.eccentricity]
        ring = wheels.ring
        if any(offsets) and (ring == self.driver or any(kind not in ("spur", "helical") for kind in wheels.kinds)):
            what = "the runout of this pair is not modelled"
            why = "the equations apply to parallel axes, and to a ring only as the driven wheel"
            raise refused(what, why, "set `driver` to the wheel that is not a ring, or give the error by points")
        return given_mesh(wheels, self, self._transmission(wheels.counts, offsets, bool(ring)))

    def transmission(self, z1: int, z2: int, driver: int = 1) -> TransmissionFunction:
        """Return the transmission function of an external pair; eccentricities are in modules.

        Parameters
        ----------
        z1, z2 : int
            Numbers of teeth of the first and of the second wheel.
        driver : {1, 2}
            Number of the driving wheel.

        Returns
        -------
        TransmissionFunction
            Transmission function with this driver.
        """
        found = self._transmission((z1, z2), [in_modules(each, None, "eccentricity") for each in self.eccentricity])
        return found if found.driver == driver else found.reversed

    def _transmission(
        self, counts: tuple[int, int], offsets: Sequence[float], internal: bool = False
    ) -> GivenTransmission:
        from geartrain.numerics.periodic_function import PeriodicSum
        from geartrain.teeth.eccentric_wheels import EccentricWheels
        from geartrain.teeth.given_transmission import GivenTransmission, checked_function

        first, second = (0, 1) if self.driver == 1 else (1, 0)
        own = counts[first], counts[second]
        parts = [each.function(own) for each in self.error or ()]
        if any(offsets):
            angles = [each.si for each in self.eccentricity_angle]
            apart, at = (offsets[first], offsets[second]), (angles[first], angles[second])
            parts.append(EccentricWheels(own, apart, at, self.pressure_angle.si, internal).error())
        if self.function is not None:
            parts.append(checked_function(self.function.function, own))
        efficiencies = self._efficiencies(own)
        # every period is a whole number of pitches
        lengths = [each.period for each in (*parts, *filter(None, efficiencies or ())) if hasattr(each, "period")]
        period = 2 * pi * lcm(*(round(length * own[0] / (2 * pi)) for length in lengths)) / own[0]
        function = PeriodicSum(parts, period)
        return GivenTransmission(function, counts, self.driver, self.backlash.si, efficiencies, self.driver)

    def _efficiencies(self, counts: tuple[int, int]) -> Efficiencies | None:
        """Return the efficiencies for the case that the declared wheel `driver` drives and for the case that its mate
        drives; None without losses.
        """
        from geartrain.numerics.periodic_function import HarmonicSeries
        from geartrain.teeth.given_transmission import checked_efficiency

        if self.efficiency_table is not None:
            each = self.efficiency_table.function(counts)
            return each, each
        if self.efficiency is not None:
            pitch, both = 2 * pi / counts[0], (self.efficiency.forward, self.efficiency.backward)
            first, second = (HarmonicSeries((), pitch, float(value.base)) for value in both)
            return (first, second) if self.driver == 1 else (second, first)
        return None if self.function is None else checked_efficiency(self.function.function)
