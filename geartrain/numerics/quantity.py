"""Numbers and quantities as written by users: "254/19", "1:30", "13.3684", "9.6 mm", "30 deg", "100 rpm"."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import nan, pi
from typing import Annotated, Any, cast

from pydantic import AfterValidator, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import PydanticCustomError, core_schema

from geartrain.errors import nearest_names
from geartrain.numerics.exact import PI

TURN = "turn"
RADIANS_PER_TURN = 6.283185307179586

# unit -> (dimension, size in base units); every size is exact
UNITS: dict[str, tuple[str, Fraction]] = {
    "m": ("length", Fraction(1)),
    "cm": ("length", Fraction(1, 100)),
    "mm": ("length", Fraction(1, 1000)),
    "um": ("length", Fraction(1, 10**6)),
    "in": ("length", Fraction(254, 10**4)),
    "ft": ("length", Fraction(3048, 10**4)),
    "km": ("length", Fraction(1000)),
    "mile": ("length", Fraction(1609344, 1000)),
    "turn": ("angle", Fraction(1)),
    "deg": ("angle", Fraction(1, 360)),
    "arcmin": ("angle", Fraction(1, 21600)),
    "arcsec": ("angle", Fraction(1, 1296000)),
    "s": ("time", Fraction(1)),
    "min": ("time", Fraction(60)),
    "h": ("time", Fraction(3600)),
    "d": ("time", Fraction(86400)),
    "rpm": ("speed", Fraction(1, 60)),
    "turn/s": ("speed", Fraction(1)),
    "turn/min": ("speed", Fraction(1, 60)),
    "turn/h": ("speed", Fraction(1, 3600)),
    "turn/d": ("speed", Fraction(1, 86400)),
    "deg/s": ("speed", Fraction(1, 360)),
    "m/s": ("velocity", Fraction(1)),
    "mm/s": ("velocity", Fraction(1, 1000)),
    "mm/min": ("velocity", Fraction(1, 60000)),
    "ft/min": ("velocity", Fraction(3048, 10**4) / 60),
    "in/s": ("velocity", Fraction(254, 10**4)),
    "N": ("force", Fraction(1)),
    "kN": ("force", Fraction(1000)),
    "N m": ("torque", Fraction(1)),
    "N mm": ("torque", Fraction(1, 1000)),
    "kN m": ("torque", Fraction(1000)),
    "J": ("energy", Fraction(1)),
    "mJ": ("energy", Fraction(1, 1000)),
    "uJ": ("energy", Fraction(1, 10**6)),
    "kg m2": ("inertia", Fraction(1)),
    "kg mm2": ("inertia", Fraction(1, 10**6)),
    "g mm2": ("inertia", Fraction(1, 10**9)),
    "g cm2": ("inertia", Fraction(1, 10**7)),
    "kg": ("mass", Fraction(1)),
    "g": ("mass", Fraction(1, 1000)),
    "Pa": ("pressure", Fraction(1)),
    "MPa": ("pressure", Fraction(10**6)),
    "GPa": ("pressure", Fraction(10**9)),
    "kg/m3": ("density", Fraction(1)),
    "g/cm3": ("density", Fraction(1000)),
    "N m/rad": ("torsional stiffness", Fraction(1)),
    "N mm/rad": ("torsional stiffness", Fraction(1, 1000)),
    "N/m": ("stiffness", Fraction(1)),
    "N/mm": ("stiffness", Fraction(1000)),
    "N/um": ("stiffness", Fraction(10**6)),
    "N m s/rad": ("torsional damping", Fraction(1)),
    "N mm s/rad": ("torsional damping", Fraction(1, 1000)),
    "N s/m": ("damping", Fraction(1)),
    "N s/mm": ("damping", Fraction(1000)),
    "%": ("fraction", Fraction(1, 100)),
    "ppm": ("fraction", Fraction(1, 10**6)),
    "s/d": ("clock rate", Fraction(1, 86400)),
    "s/year": ("clock rate", 1 / (86400 * Fraction("365.2425"))),  # of the Gregorian calendar
}
# a radian is an irrational fraction of a turn: these two scales have 50 digits, so they are in a table of their own
_TURNS_PER_RADIAN = 1 / (2 * Fraction("3.14159265358979323846264338327950288419716939937511"))
IRRATIONAL: dict[str, tuple[str, Fraction]] = {
    "rad": ("angle", _TURNS_PER_RADIAN),
    "rad/s": ("speed", _TURNS_PER_RADIAN),
}
_EXACT = Fraction(0), Fraction("1e300")  # bounds of quantities that are used only in exact arithmetic
_FLOATS = Fraction(1, 10**30), Fraction(10**30)  # the tenth power of such a number is still a float
_SIZES = Fraction(1, 10**12), Fraction(10**6)  # lengths of bodies, in m or plain: sizes that can be laid out and drawn
_BOUNDS = {"length": _SIZES, "length or fraction": (_FLOATS[0], _SIZES[1])} | {
    dimension: _FLOATS
    for one, other in (("torsional stiffness", "stiffness"), ("torsional damping", "damping"))
    for dimension in ("angle", "velocity", "energy", "inertia", "mass", "density", "pressure", one, f"{one} or {other}")
}
SPELT = {
    "Nm": "N m",
    "N*m": "N m",
    "N·m": "N m",
    "Nmm": "N mm",
    "°": "deg",
    "µm": "um",
    "μm": "um",
    "µJ": "uJ",
    "μJ": "uJ",
    "feet": "ft",
    "day": "d",
    "days": "d",
    "turns": "turn",
    "rev": "turn",
    "rev/s": "turn/s",
    "rev/min": "rpm",
    "kg m^2": "kg m2",
    "g mm^2": "g mm2",
    "kg*m^2": "kg m2",
    "kg/m^3": "kg/m3",
    "g/cm^3": "g/cm3",
    "Nm/rad": "N m/rad",
    "Nmm/rad": "N mm/rad",
    "N/mm2": "MPa",
    "N/mm^2": "MPa",
    "N/µm": "N/um",
    "N/μm": "N/um",
    "Nms/rad": "N m s/rad",
    "s/day": "s/d",
    "s/y": "s/year",
    "s/yr": "s/year",
}


def bad(kind: str, what: str, fix: str, why: str = "") -> PydanticCustomError:
    """Return a validation error of the type `kind` for an invalid value, with the problem, its cause and its fix."""
    return PydanticCustomError(kind, "{what}", {"what": what, "fix": fix} | ({"why": why} if why else {}))


def check_range(part: str, value: Any, ends: tuple[Any, Any] | None) -> None:
    """Raise `PydanticCustomError` if a number or quantity is outside the range `ends` (minimum, maximum), if given."""
    if ends is None:
        return
    low, given, high = (
        nan if each is None else getattr(each, "base", each.value) for each in (ends[0], value, ends[1])
    )
    if not low <= given <= high:
        what = f"{getattr(value, 'text', 'no value')} is outside the range {ends[0].text} to {ends[1].text}"
        raise bad(part, what, "give a value in the range, and the minimum of the range first")


def scale(unit: str) -> tuple[str, Fraction]:
    """Return the dimension of a known unit, and the size of the unit in base units of this dimension."""
    return UNITS.get(unit) or IRRATIONAL[unit]


def turns_in(unit: str) -> Fraction:
    """Return the angle in a unit of angular speed [turn]: 1/360 for deg/s, 1 for rpm or for a unit without an angle."""
    angle = unit.partition("/")[0] if "/" in unit else TURN
    return scale(angle)[1]


def same_kind(first: str | None, second: str | None) -> bool:
    """Return True if both units contain radians or neither does, so that their quotient is a rational number."""
    return (first in IRRATIONAL) == (second in IRRATIONAL)


def nearest_unit(unit: str, dimension: str) -> str:
    """Return advice on an unknown unit: the most similar unit, such as `rpm` for RPM, or all units of the dimension."""
    known = units_of(dimension)
    if re.search(r"\b(year|yr|month)s?\b", unit):
        return (
            "a calendar unit has several lengths: declare it for all speeds, such as "
            "`unit: {per: year_tropical_J2000}`, and write numbers without a unit"
        )
    spelt = {name.casefold(): name for name, meant in SPELT.items() if meant in known.split(", ")}
    names = spelt | {name.casefold(): name for name in known.split(", ")}
    close = nearest_names(unit.casefold(), names)
    return f"did you mean '{names[close[0]]}'? Units are: {known}" if close else f"use one of: {known}"


def units_of(dimension: str) -> str:
    """Return all units of a dimension, or of several dimensions joined by `or`, as a string with commas."""
    known = [*UNITS.items(), *IRRATIONAL.items()]
    return ", ".join(unit for wanted in dimension.split(" or ") for unit, (kind, _) in known if kind == wanted)


def base_unit(dimension: str) -> str:
    """Return the base unit of a dimension.

    >>> base_unit("length"), base_unit("angle")
    ('m', 'turn')
    """
    return next(unit for unit, (kind, factor) in UNITS.items() if kind == dimension and factor == 1)


_MOST_DIGITS = 400  # longer numbers are typing errors or attacks, and squaring them would take minutes
_NUMBER = r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d{1,3})?"
_MOST = Fraction("1e300")  # such a number and its inverse are floats, with a margin for units
_FIGURE = re.compile(rf"^\s*({_NUMBER})\s*(?:([/:])\s*({_NUMBER}))?\s*$")
_QUANTITY = re.compile(rf"^\s*({_NUMBER}(?:\s*[/:]\s*\d+)?)\s*([^\d\s].*?)?\s*$")


@dataclass(frozen=True, slots=True)
class Figure:
    """Number and its digits as written; the digits determine its accuracy.

    Examples
    --------
    >>> published = Figure.parse("13.37")
    >>> published.value, published.half, published.holds(Fraction(254, 19))
    (Fraction(1337, 100), Fraction(1, 200), True)
    """

    value: Fraction
    """Value of the number, exactly as written."""
    half: Fraction | None
    """Half a unit of the last written decimal place; None for an integer or a fraction, which is exact."""
    text: str
    """Text of the number as written."""

    def __str__(self) -> str:
        return self.text

    def _brief(self) -> str:
        return self.text

    def holds(self, value: Fraction, tolerance: Fraction | None = None) -> bool:
        """Return True if a value agrees with this number within a tolerance, by default the accuracy of its digits.

        Parameters
        ----------
        value : Fraction
            Number to compare.
        tolerance : Fraction, optional
            Maximum difference, 0 or more; by default half a unit of the last written decimal place.
        """
        bound = tolerance if tolerance is not None else self.half or Fraction(0)
        return abs(value - self.value) <= bound if bound else bool(value == self.value)

    @classmethod
    def parse(cls, raw: object) -> Figure:
        """Parse a number and its written digits from text or a Python number.

        Parameters
        ----------
        raw : str, int, float, Fraction or Figure
            A number such as "254/19", "1:30" or "13.3684", with a magnitude of up to 1e300 and up to 400 digits.

        Raises
        ------
        ValueError
            If `raw` is not such a number.

        Examples
        --------
        >>> Figure.parse("1:30").value, Figure.parse("13.3684").half
        (Fraction(1, 30), Fraction(1, 20000))
        """
        if isinstance(raw, Figure):
            return raw
        if isinstance(raw, bool) or not isinstance(raw, str | int | float | Fraction):
            raise _not_a_number(raw)
        text = str(raw)
        match = _FIGURE.match(text) if len(text) <= _MOST_DIGITS else None
        if match is None:
            raise _not_a_number(raw)
        left, sign, right = match.groups()
        value, half = Fraction(left), None
        mantissa, _, exponent = left.lower().partition("e")
        if sign is not None:
            below = Fraction(right)
            if not below:
                raise bad("number", f"'{text}' divides by zero", "write a denominator other than 0")
            value /= below
        elif "." in mantissa or exponent:
            # an exponent moves the last decimal: 1e3 is known to half a thousand
            decimals = len(mantissa.partition(".")[2])
            half = Fraction(10) ** (int(exponent or 0) - decimals) / 2
        if value and not 1 / _MOST <= abs(value) <= _MOST:
            why = "a number must be 0, or from 1e-300 to 1e300"
            raise bad("number", f"{text} is out of range", "write a number in that range", why)
        return cls(value, half, text)

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(
            cls.parse, serialization=core_schema.plain_serializer_function_ser_schema(str)
        )

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"type": ["number", "string"], "examples": ["254/19", "1:30", 13.3684]}


@dataclass(frozen=True, slots=True)
class Amount(Figure):
    """Number as written in a declaration, or length with a unit, such as the travel of a slide. The `value` and `half`
    (half a unit of the last written digit) of a length are in mm.

    Examples
    --------
    >>> travel = Amount.parse("0.125 cm")
    >>> travel.value, travel.half, travel.unit
    (Fraction(5, 4), Fraction(1, 200), 'cm')
    """

    unit: str | None = None
    """Unit of length as written; None for a plain number."""

    @classmethod
    def parse(cls, raw: object) -> Amount:
        """Parse a number, or a length such as "1.25 mm", from text or a Python number.

        Parameters
        ----------
        raw : str, int, float, Fraction or Figure
            Number or length.

        Raises
        ------
        ValueError
            If `raw` is neither a number nor a length.
        """
        if isinstance(raw, Figure) and type(raw) is not Figure:
            return cast(Amount, raw)  # also a printed period
        match = _QUANTITY.match(raw) if isinstance(raw, str) and len(raw) <= _MOST_DIGITS else None
        unit = None if match is None or match[2] is None else SPELT.get(match[2], match[2])
        if unit is None or UNITS.get(unit, ("",))[0] != "length":
            plain = Figure.parse(raw)
            return cls(plain.value, plain.half, plain.text)
        assert match is not None
        plain, size = Figure.parse(match[1]), 1000 * scale(unit)[1]
        return cls(plain.value * size, None if plain.half is None else plain.half * size, str(raw), unit)

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"type": ["number", "string"], "examples": ["254/19", "1:30", 13.3684, "1.25 mm"]}


def _not_a_number(raw: object) -> PydanticCustomError:
    shown = repr(raw) if len(repr(raw)) <= 40 else repr(raw)[:37] + "..."
    return bad("number", f"{shown} is not a number", "write an integer, a fraction 254/19 or 1:30, or a decimal")


def checked(is_valid: Callable[[Any], bool], message: str, fix: str) -> AfterValidator:
    """Return a validator that rejects invalid numbers or quantities with a message, which can contain `{text}`."""

    def check(given: Any) -> Any:
        if not is_valid(given):
            raise bad("bound", message.format(text=given.text), fix)
        return given

    return AfterValidator(check)


_COEFFICIENT = checked(
    lambda given: given.value >= 0, "the coefficient of friction {text} is negative", "give a coefficient of 0 or more"
)
Friction = Annotated[Figure, _COEFFICIENT]


def parse_friction(raw: object) -> Figure:
    """Parse a coefficient of friction, which must not be negative."""
    return cast(Figure, cast(Any, _COEFFICIENT.func)(Figure.parse(raw)))


@dataclass(frozen=True, slots=True)
class Quantity:
    """Number with its unit as written in a declaration, which can be converted to base units and SI units.

    Use `base` in comparisons and computations, not `value`, because `base` does not depend on the written unit. The
    units are listed in `UNITS`; rad and rad/s are also allowed. A radian is an irrational fraction of a turn, rounded
    to 50 digits.

    Examples
    --------
    >>> speed = Quantity.parse("90 rpm", "speed", plain=True)
    >>> speed.value, speed.base, round(speed.si, 4)
    (Fraction(90, 1), Fraction(3, 2), 9.4248)
    """

    value: Fraction
    """Exact value, in the unit as written."""
    unit: str | None
    """Unit as written; None for a number without a unit."""
    text: str
    """Text of the quantity as written."""

    def __str__(self) -> str:
        return self.text

    def _brief(self) -> str:
        return self.text

    @property
    def dimension(self) -> str | None:
        """Dimension, such as length, angle, time, speed or torque (see `UNITS`); None for a number without a unit."""
        return None if self.unit is None else scale(self.unit)[0]

    @property
    def base(self) -> Fraction:
        """Value in base units (m, turn, s, turn/s, N m and others in `UNITS`); a plain number is unchanged."""
        return self.value if self.unit is None else self.value * scale(self.unit)[1]

    @property
    def si(self) -> float:
        """Value in SI units (m, rad, s, rad/s, N m and others); a plain number is unchanged."""
        # radians are SI units already; conversion to turns and back would round twice
        if self.unit in IRRATIONAL:
            return float(self.value)
        scale = RADIANS_PER_TURN if self.dimension in ("angle", "speed") else 1.0
        return float(self.base) * scale

    @classmethod
    def parse(cls, raw: object, dimension: str, plain: bool) -> Quantity:
        """Parse a quantity from text or a Python number.

        Parameters
        ----------
        raw : str, int, float, Fraction or Quantity
            A quantity such as "9.6 mm", "30 deg", "1400 rpm" or 0.98.
        dimension : str
            Required dimension: length, angle, time, speed, velocity, torque, energy, inertia, mass, density, pressure,
            torsional stiffness, stiffness, torsional damping, damping or fraction; "time or length" allows either of
            two.
        plain : bool
            True to allow a number without a unit; 0 is always allowed without a unit.

        Raises
        ------
        ValueError
            If `raw` is not a number, or if its unit is unknown, of another dimension, or missing.
        """
        if isinstance(raw, Quantity):
            return raw
        text = str(raw)
        match = _QUANTITY.match(text) if isinstance(raw, str) and len(text) <= _MOST_DIGITS else None
        if match is None and (number := re.match(r"[\d.]+ +(?=.*[A-Za-z])", text[:_MOST_DIGITS])):
            known = units_of(dimension)
            fix = f"for example, write '{number[0].strip()} {known.split(', ')[0]}'; units: {known}"
            raise bad("unit", f"'{text}' has an unknown unit", fix)
        if match is None or match[2] is None:
            figure = Figure.parse(raw)
            if not plain and figure.value:
                known = units_of(dimension)
                first = "mm" if dimension.startswith("length") else known.split(", ")[0]
                raise bad("unit", f"'{text}' has no unit", f"for example, write '{text} {first}'; units: {known}")
            return _in_range(cls(figure.value, None, text), dimension)
        # several blanks within a unit count as one
        unit = " ".join(match[2].split())
        # an exponent of more than three digits, which `_NUMBER` does not match, is not a unit
        if re.fullmatch(r"[eE][+-]?\d+", unit):
            raise _not_a_number(raw)
        unit = SPELT.get(unit, unit)
        if unit not in UNITS and unit not in IRRATIONAL:
            raise bad("unit", f"'{text}' has an unknown unit", nearest_unit(unit, dimension))
        quantity = cls(Figure.parse(match[1]).value, unit, text)
        if quantity.dimension not in dimension.split(" or "):
            found = _with_article(quantity.dimension or "number")
            *others, last = map(_with_article, dimension.split(" or "))
            wanted = f"{', '.join(others)} or {last}" if others else last
            what = f"'{text}' is {found}, but {wanted} is required"
            raise bad("unit", what, f"use one of: {units_of(dimension)}")
        return _in_range(quantity, dimension)


def _in_range(quantity: Quantity, dimension: str) -> Quantity:
    """Return the quantity, or raise `PydanticCustomError` if float64 cannot represent its products and squares."""
    low, high = _BOUNDS.get(dimension, _EXACT)
    if not quantity.value or low <= abs(quantity.base) <= high:
        return quantity
    noun = _with_article(quantity.dimension or dimension)
    unit = "" if quantity.unit is None else f" {base_unit(scale(quantity.unit)[0])}"
    why = f"{noun} must be from {float(low):g}{unit} to {float(high):g}{unit}"
    raise bad("number", f"{quantity.text} is out of range", f"write {noun} in that range", why)


def in_unit(speed: Quantity, unit: str) -> Fraction:
    """Return a speed in a given unit; if it is written in this unit it is unchanged, so radians remain exact."""
    return speed.value if speed.unit == unit else speed.base / scale(unit)[1]


def millimetres(length: Quantity) -> Fraction:
    """Return the exact length [mm]; a number without a unit is taken as a length in mm.

    >>> millimetres(Quantity.parse("1.5 cm", "length", plain=True))
    Fraction(15, 1)
    """
    return length.value if length.unit is None else length.base * 1000


TRAVEL_ARM = 1 / (2000 * PI)
"""Lever arm at which one turn corresponds to a travel of 1 mm [m]. A sliding link is treated as a link that turns once
per mm of its travel, with its forces at this lever arm.
"""


def as_rotation(speed: Quantity) -> Quantity:
    """Return a speed of travel as a speed of rotation with one turn per mm; other speeds are unchanged.

    >>> as_rotation(Quantity.parse("5 mm/min", "velocity", plain=False)).unit
    'turn/min'
    """
    if speed.dimension == "length":
        return Quantity(millimetres(speed), None, speed.text)
    if speed.dimension != "velocity":
        return speed
    unit = f"{TURN}/{(speed.unit or '').partition('/')[2]}"
    return Quantity(speed.base * 1000 / scale(unit)[1], unit, speed.text)


def as_torque(load: Quantity) -> Quantity:
    """Return a force on a sliding link as the torque [N m] that has the same power; return torques unchanged."""
    return Quantity(load.base * TRAVEL_ARM, "N m", load.text) if load.dimension == "force" else load


def _with_article(noun: str) -> str:
    """Return a noun with its indefinite article: `a length`, `an angle`."""
    return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"


@dataclass(frozen=True, slots=True)
class Dimension:
    """Pydantic annotation of a field whose values are quantities of one dimension, such as lengths."""

    name: str
    plain: bool = False

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(
            lambda raw: Quantity.parse(raw, self.name, self.plain),
            serialization=core_schema.plain_serializer_function_ser_schema(str),
        )

    def __get_pydantic_json_schema__(self, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        kinds = ["string", "number"] if self.plain else ["string"]
        unit = f"{_with_article(self.name).capitalize()} with its unit: {units_of(self.name)}"
        return {"type": kinds, "format": self.name, "description": unit}


Length = Annotated[Quantity, Dimension("length", plain=True)]
MeasuredLength = Annotated[Quantity, Dimension("length")]
"""Length that must have a unit."""
Angle = Annotated[Quantity, Dimension("angle")]
Time = Annotated[Quantity, Dimension("time")]
Span = Annotated[Quantity, Dimension("time or length")]
Speed = Annotated[Quantity, Dimension("speed", plain=True)]
InputSpeed = Annotated[Quantity, Dimension("speed or length or velocity", plain=True)]
"""Prescribed speed of a link: a speed of rotation, or a travel per `unit` of the declaration or per unit of time."""
Rate = Annotated[Quantity, Dimension("speed or velocity", plain=True)]
Velocity = Annotated[Quantity, Dimension("velocity")]
Torque = Annotated[Quantity, Dimension("torque", plain=True)]
Load = Annotated[Quantity, Dimension("torque or force", plain=True)]
Energy = Annotated[Quantity, Dimension("energy")]
Inertia = Annotated[Quantity, Dimension("inertia")]
Mass = Annotated[Quantity, Dimension("mass")]
Density = Annotated[Quantity, Dimension("density")]
Pressure = Annotated[Quantity, Dimension("pressure")]
TorsionalStiffness = Annotated[Quantity, Dimension("torsional stiffness")]
MeshStiffness = Annotated[Quantity, Dimension("torsional stiffness or stiffness")]
TorsionalDamping = Annotated[Quantity, Dimension("torsional damping")]
MeshDamping = Annotated[Quantity, Dimension("torsional damping or damping")]
Share = Annotated[Quantity, Dimension("fraction", plain=True)]
RelativeError = Annotated[Quantity, Dimension("fraction or clock rate", plain=True)]
"""Relative error of a speed: a number, a percentage, a value in ppm, or the rate of a clock (s/d, s/year)."""


def above_zero(fix: str, noun: str = "the value") -> AfterValidator:
    """Return a validator that requires a number or quantity greater than 0."""
    return checked(lambda given: given.value > 0, f"{noun} must be greater than 0, not {{text}}", fix)


def below_right_angle(fix: str) -> AfterValidator:
    """Return a validator that requires an angle of less than 90 degrees."""
    return checked(lambda given: given.si < pi / 2, "{text} is not less than 90 deg", fix)


def not_below_zero(fix: str) -> AfterValidator:
    """Return a validator that requires a number or quantity of 0 or more."""
    return checked(lambda given: given.value >= 0, "{text} is below 0", fix)


PairStiffness = Annotated[MeshStiffness, above_zero("give a stiffness above 0, such as 20 N/um")]
"""Stiffness of a tooth pair: torque on the driven wheel per angle, or force per displacement on the line of action."""

PairDamping = Annotated[MeshDamping, not_below_zero("give a damping of 0 or more")]
"""Damping of a tooth pair: torque on the driven wheel per angular velocity, or force per velocity of the flanks."""
