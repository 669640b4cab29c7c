"""Outputs of a train: targets, expected speeds, published values, units, and dials with their scales."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import atan2, pi
from typing import Annotated, Any, ClassVar, Literal

from pydantic import AfterValidator, BeforeValidator, Field, ValidationInfo, model_validator

from geartrain.errors import suggest
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.exact import nearest_float
from geartrain.numerics.plain_values import Boolean, whole_number
from geartrain.numerics.quantity import (
    Amount,
    Figure,
    MeasuredLength,
    RelativeError,
    Span,
    above_zero,
    bad,
    checked,
    millimetres,
    scale,
)
from geartrain.train.fields import AlsoShort, Declared, Id, exactly_one, short_for

# ------------------------------------------------------------------------------------------------------ printed periods

_NAMES = {"years": "y", "year": "y", "days": "d", "day": "d", "hours": "h", "hour": "h"}
_YEAR = "y"
_UNITS = (_YEAR, "d", "h", "min", "s")  # descending
_PART = re.compile(r"(\d+(?:\.\d*)?|\.\d+)\s*([a-z]+)\s*", re.ASCII)
_YEARS = 365, 366  # range of all astronomical and calendar years [d]
_EXTRA_DIGITS = 2  # of a computed period, more than the source prints


@dataclass(frozen=True, slots=True)
class PrintedPeriod(Figure):
    """Time as printed in a source. `value` [s] is the time without its years, which are a separate field."""

    years: Fraction
    """Number of years in the printed time; 0 if it has none."""
    units: tuple[str, ...]
    """Units of the printed parts (y, d, h, min, s), in descending order."""
    decimals: int
    """Number of decimal places of the last part."""

    @property
    def above_zero(self) -> bool:
        """True if the time is greater than 0."""
        return self.value > 0 or self.years > 0

    @classmethod
    def parse(cls, raw: object) -> PrintedPeriod:
        """Parse a printed time whose units are in descending order."""
        if isinstance(raw, PrintedPeriod):
            return raw
        text = str(raw).strip()
        parts = [(number, _NAMES.get(unit, unit)) for number, unit in _PART.findall(text[:100])]
        units = tuple(unit for _, unit in parts)
        ordered = units == tuple(unit for unit in _UNITS if unit in units)
        whole = all(number.isdigit() for number, _ in parts[:-1])
        if not parts or _PART.sub("", text) or not ordered or not whole:
            fix = "write a time such as 27.32 d, 24 h 50 min 28.4 s or 29 y 157 d; units: " + ", ".join(_UNITS)
            raise bad("period", f"'{text[:40]}' is not a period", fix)
        sizes = {unit: Fraction(number) for number, unit in parts}
        years = sizes.pop(_YEAR, Fraction(0))
        seconds = sum((size * scale(unit)[1] for unit, size in sizes.items()), Fraction(0))
        decimals = len(parts[-1][0].partition(".")[2])
        last = Fraction(0) if units == (_YEAR,) else scale(units[-1])[1]
        return cls(seconds, last / 10**decimals / 2, text, years, units, decimals)

    def in_seconds(self, year: Fraction | None) -> Figure:
        """Return the time [s], with half a unit of its last digit as accuracy. A year has `year` seconds."""
        length = year or Fraction(0)
        half = length / 10**self.decimals / 2 if self.units == (_YEAR,) else self.half
        return Figure(self.value + self.years * length, half, self.text)

    def text_of(self, seconds: Fraction, year: Fraction | None) -> str:
        """Return the time `seconds` [s] as text in the units of this time, with more digits than this time has."""
        decimals = max(self.decimals + _EXTRA_DIGITS, 3)
        sizes = [(unit, (year or Fraction(1)) if unit == _YEAR else scale(unit)[1]) for unit in self.units]
        last = sizes[-1][1]
        rest = round(seconds / last, decimals) * last  # rounded first, so that no part reaches the unit above it
        words = []
        for unit, size in sizes[:-1]:
            count, rest = divmod(rest, size)
            words.append(f"{count} {unit}")
        return " ".join(
            [*words, f"{nearest_float(rest / last):.{decimals}f}".rstrip("0").rstrip(".") + f" {sizes[-1][0]}"]
        )


def is_printed_period(raw: object) -> bool:
    """Return True if a value is text such as "29.53 d" that `PrintedPeriod` can parse."""
    try:
        return isinstance(raw, str) and bool(PrintedPeriod.parse(raw))
    except ValueError:
        return False


def year_seconds(unit: Fraction | None) -> Fraction | None:
    """Return the given unit of time [s] if it is a year; None for other units."""
    return unit if unit is not None and _YEARS[0] <= unit / 86400 <= _YEARS[1] else None


# --------------------------------------------------------------------------------------------------------------- scales

_SIGNS = "Aries Taurus Gemini Cancer Leo Virgo Libra Scorpio Sagittarius Capricorn Aquarius Pisces"
_MONTHS = "Thoth Phaophi Hathyr Choiak Tybi Mecheir Phamenoth Pharmuthi Pachon Payni Epeiph Mesore"
NAMED_SCALES: Mapping[str, tuple[str, tuple[tuple[str, int], ...]]] = {
    "zodiac": ("degree", tuple((name, 30) for name in _SIGNS.split())),
    "egyptian_months": ("day", (*((name, 30) for name in _MONTHS.split()), ("Epagomenal", 5))),
}
"""Predefined scales by name: the name of one division, and each label with the number of divisions that it spans."""

_MOST = 10**6


def _read_whole(raw: object) -> int:
    """Read an integer from 1 to 10^6."""
    text, number = str(raw), whole_number(raw, 1, _MOST)
    if number is not None:
        return number
    shown = text if len(text) <= 30 else f"{text[:27]}..."
    fix = f"write `names: {text}`" if text in NAMED_SCALES else f"give a whole number from 1 to {_MOST:,}"
    raise bad("dial", f"{shown} is not a valid number of divisions or turns", fix)


Whole = Annotated[int, BeforeValidator(_read_whole)]


class DialName(Declared):
    """Label of one or more consecutive divisions of a dial. In a declaration, a single string instead of a mapping is
    the label.
    """

    SHORT: ClassVar = {"type": ["string", "number", "null"]}

    name: str = Field("", description="Engraved label; empty for divisions without a label")
    span: Whole | None = Field(None, description="Number of divisions of the label; default equal for all labels")


class DialNumerals(Declared):
    """Numerals at the lines between the divisions of a dial. The last numeral is at the zero mark. In a declaration, a
    single string instead of a mapping is their style.
    """

    SHORT: ClassVar = {"enum": ["roman", "arabic"]}

    style: Literal["roman", "arabic"] = Field("arabic", description="Style of the numerals")
    every: Whole | None = Field(
        None, description="Number of divisions between numerals; default the smallest that fits"
    )
    to: Whole | None = Field(
        None,
        description="Highest numeral before they start again, such as 12 on a dial of 24 hours; default all divisions",
    )


class Graduation(Declared):
    """Divisions of a scale with labels and numerals: common fields of a dial and of the ring around it."""

    divisions: Whole = Field(
        1, description="Number of divisions along all turns; default the sum of the spans of its names"
    )
    cell: str = Field("", description="Name of one division; default from a named scale, otherwise cell")
    names: Annotated[
        tuple[Annotated[DialName, short_for("name")], ...],
        AlsoShort({"enum": [*NAMED_SCALES]}),
    ] = Field((), description="Labels of divisions: a named scale, a list for equal parts, or a list of `{name, span}`")
    numerals: Annotated[DialNumerals, short_for("style")] | None = Field(
        None, description="Numerals at the lines: roman, arabic, or `{style, every, to}`; default counted from 0"
    )
    glyphs: Annotated[dict[Whole, str], AfterValidator(FrozenDict)] = Field(
        {}, validate_default=True, description="Engraved texts of single divisions, by their number from 1"
    )
    cell_names: tuple[str, ...] = Field((), description="Names of single divisions, which repeat, such as months")
    doubled: tuple[Whole, ...] = Field(
        (), description="Numbers of divisions that have the same cell name as the division before, as leap months"
    )
    inscriptions: Annotated[dict[str, str], AfterValidator(FrozenDict)] = Field(
        {}, validate_default=True, description="Engraved texts of names, such as Greek ones; default the name itself"
    )

    @model_validator(mode="before")
    @classmethod
    def _expand_scale(cls, raw: Any) -> Any:
        """Replace the name of a predefined scale by its labels; if `divisions` is not given, add up their lengths."""
        if not isinstance(raw, dict) or not raw.get("names"):
            return raw
        names, own = raw["names"], dict(raw)
        if isinstance(names, str):
            if names not in NAMED_SCALES:
                otherwise = f"use one of {', '.join(NAMED_SCALES)}, or a list of names"
                fix = suggest(names, NAMED_SCALES, otherwise=otherwise)
                raise bad("dial", f"the scale '{names}' is unknown", fix)
            cell, parts = NAMED_SCALES[names]
            own.setdefault("divisions", sum(span for _, span in parts))
            # a division is a degree or a day only if the scale keeps its number of divisions
            if str(own["divisions"]) == str(sum(span for _, span in parts)):
                own.setdefault("cell", cell)
            own["names"] = [
                {"name": name, "span": span} for name, span in _distribute_names(names, parts, own["divisions"])
            ]
        elif isinstance(names, list | tuple):
            spans = [each.get("span") if isinstance(each, dict) else None for each in names]
            # raw data are not validated yet: only spans written as digits can be added
            whole = [int(str(span)) for span in spans if str(span).isascii() and str(span).isdigit()]
            own.setdefault("divisions", sum(whole) if len(whole) == len(spans) else len(spans))
        return own

    @model_validator(mode="after")
    def _check_spans(self) -> Graduation:
        spans = [each.span for each in self.names]
        given = [span for span in spans if span is not None]
        if given and len(given) < len(spans):
            missing = next(each.name for each in self.names if each.span is None)
            fix = "give a span to every name, or to none"
            raise bad("dial", f"'{missing}' has no span, but other names have one", fix)
        if given and (off := sum(given) - self.divisions):
            excess = f"{abs(off)} too {'many' if off > 0 else 'few'} for {self.divisions} divisions"
            fix = "make the spans add up to `divisions`, or omit `divisions`"
            raise bad("dial", f"the spans of its names add up to {sum(given)}, {excess}", fix)
        for cell in (*self.glyphs, *self.doubled):
            if cell > self.divisions:
                what = f"cell {cell} is beyond the {self.divisions} divisions"
                raise bad("dial", what, f"give a number from 1 to {self.divisions}")
        known = {*self.cell_names, *(each.name for each in self.names)}
        for name in self.inscriptions:
            if name not in known:
                fix = suggest(name, sorted(known), otherwise="write one of the names of the dial")
                raise bad("dial", f"the dial has no name '{name}'", fix)
        return self

    @property
    def cells(self) -> tuple[str, ...]:
        """Name of every division, obtained by repeating `cell_names`; empty without such names."""
        found, count = list[str](), len(self.cell_names)
        for cell in range(1, self.divisions + 1 if count else 1):
            before = sum(each <= cell for each in self.doubled)
            found.append(self.cell_names[(cell - 1 - before) % count])
        return tuple(found)

    @property
    def parts(self) -> tuple[tuple[str, Fraction, Fraction], ...]:
        """Label, start and length of each labelled part of the scale. Start and length are exact, in divisions."""
        found, first = [], Fraction(0)
        for each in self.names:
            span = Fraction(self.divisions, len(self.names)) if each.span is None else Fraction(each.span)
            found.append((each.name, first, span))
            first += span
        return tuple(found)


def _distribute_names(name: str, parts: tuple[tuple[str, int], ...], divisions: object) -> list[tuple[str, int]]:
    """Return the labels of a scale, each with its number of divisions if the scale has `divisions` divisions."""
    total, count = sum(span for _, span in parts), _read_whole(divisions)
    shares = [(part, Fraction(span * count, total)) for part, span in parts]
    if any(share.denominator > 1 for _, share in shares):
        what = f"{count} divisions cannot be distributed over the scale {name}"
        raise bad("dial", what, f"give `divisions: {total}`, or omit `divisions`")
    return [(part, int(share)) for part, share in shares]


class DialRing(Graduation):
    """Second scale around the scale of a dial, read by the same pointers."""


INNER = 0.55
"""Radius of the inner end of a spiral scale divided by the radius of its outer end."""
RING = 0.17
"""Width of a scale that surrounds another scale, divided by the radius of the dial."""
DEPTH = 0.26
"""Radial depth of the engraving of a circular scale, divided by the radius of the dial."""

Place = tuple[MeasuredLength, MeasuredLength]
"""Position of a point on a face, right and up as seen by its reader, relative to the origin of axis positions."""


class FacePlate(Declared):
    """Rectangular plate on which the dials of the front or of the back are engraved."""

    width: Annotated[MeasuredLength, above_zero("give a width such as 180 mm")] = Field(description="Width")
    height: Annotated[MeasuredLength, above_zero("give a height such as 330 mm")] = Field(description="Height")
    centre: Place | None = Field(
        None, description="Centre as seen by the reader, to the right and upwards from the origin; default the origin"
    )
    source: Id | None = Field(None, description="Key of the source in `sources`")
    note: str | None = Field(None, description="Remark for readers, such as which sizes are assumed")


class Dial(Graduation):
    """Dial: a scale on which a pointer is read. It is fixed to the link relative to which its output turns."""

    SHORT: ClassVar = {"type": "null"}

    face: Literal["front", "back"] | None = Field(None, description="Side from which the dial is read, front or back")
    centre: Place | None = Field(
        None,
        description="Centre as seen by the reader, to the right and upwards from the origin of the axis positions; it "
        "determines the axis of the pointers; default computed",
    )
    diameter: Annotated[MeasuredLength, above_zero("give a diameter such as 150 mm")] | None = Field(
        None, description="Diameter of the whole engraving; default computed"
    )
    source: Id | None = Field(None, description="Key of the source of `centre` and `diameter` in `sources`")
    turns: Whole = Field(1, description="Number of turns of a spiral scale")
    counted: Literal["clockwise", "counter-clockwise"] = Field(
        "clockwise", description="Sense in which the divisions are counted, as seen by the reader"
    )
    around: DialRing | None = Field(None, description="Second scale around this one, read by the same pointers")
    look: Literal["scale", "ball"] = Field(
        "scale",
        description="Appearance: a scale with a pointer, or a half-black ball that shows the Moon's phase",
    )
    note: str | None = Field(None, description="Remark for readers")

    @property
    def circle(self) -> tuple[float, float, float] | None:
        """Centre (right, up) and radius of the dial on its face [mm]; None if one of these values is not declared."""
        if self.centre is None or self.diameter is None:
            return None
        x, y = (float(millimetres(each)) for each in self.centre)
        return x, y, float(millimetres(self.diameter)) / 2

    @property
    def clear(self) -> float:
        """Radius of the circle inside which the dial has no engraving, divided by the radius of the dial."""
        outer = 1.0 if self.around is None else 1.0 - RING
        if self.turns > 1:
            return outer * (INNER - (1 - INNER) / self.turns)
        return outer - DEPTH

    def reach(self, right: float, up: float) -> float:
        """Return the radius of the engraving in the direction (right, up), divided by the radius of the dial."""
        if self.turns == 1 or self.around is not None:
            return 1.0
        turn = atan2(right if self.counted == "clockwise" else -right, up) / (2 * pi) % 1
        return 1 - (1 - INNER) / self.turns * (1 - turn if turn else 0)


_BEHIND = ("back", "rear", "behind")  # words for the far side; other dials face the front


def looks_away(face: str | None, seen_from: str | None) -> bool:
    """Return True if a face of the train cannot be seen from the side `seen_from`; False if no face is declared."""
    return face is not None and (face in _BEHIND) != (seen_from in _BEHIND)


_RETROGRADE = "above 0, with `sense: retrograde` for retrograde motion"
_TURNS = checked(lambda given: given.value > 0, "{text} turns is not a number above 0", f"give a number {_RETROGRADE}")
_TOLERANCE = checked(
    lambda given: given.value >= 0,
    "a tolerance of {text} is negative",
    "give the magnitude of the permitted error, 0 or more",
)


_CALENDAR_PERIOD = re.compile(r"\s*([\d./]+)\s*(year|yr|y|month)s?\s*", re.ASCII)


def _check_calendar_unit(raw: object) -> object:
    """Return a period unchanged; raise `PydanticCustomError` with the fix to use a target for years and months."""
    if found := _CALENDAR_PERIOD.fullmatch(str(raw)[:100]):
        name = "month_synodic_J2000" if found[2] == "month" else "year_tropical_J2000"
        fix = f"write `{{name: {name}, turns: 1/{found[1]}}}` or another name of `geartrain periods`, or a time in days"
        raise bad("unit", f"'{raw}' has an unknown unit", fix, "years and months have several lengths")
    return raw


class Target(Declared):
    """Target of an output: a name from the shipped table, a period or a speed. In a declaration, a single string
    instead of a mapping is its name.

    A `speed` has a sign. A name or a period specifies only a magnitude, which outputs with either sense of rotation can
    satisfy unless `sense` is given.
    """

    SHORT: ClassVar = {"type": "string"}

    name: str | None = Field(None, description="Name of an astronomical period; `geartrain periods` lists them")
    period: (
        Annotated[Span, BeforeValidator(_check_calendar_unit), above_zero(f"give a period {_RETROGRADE}", "a period")]
        | None
    ) = Field(None, description="Time or length of `turns` turns, above 0")
    speed: Amount | None = Field(
        None,
        description="Speed in the train's unit with its sign, or the travel of a sliding link such as `1.25 mm`; "
        "a speed of 0 is compared by the difference",
    )
    sense: Literal["direct", "retrograde"] | None = Field(
        None, description="Sense of rotation of a name or period: direct (positive speed) or retrograde; default either"
    )
    turns: Annotated[Figure, _TURNS] = Field(
        Figure.parse(1), description="Turns of the pointer in the period (5 for a Metonic spiral); above 0"
    )
    tolerance: Annotated[RelativeError, _TOLERANCE] | None = Field(
        None,
        description="Maximum relative error, such as 20 ppm or 5 s/d, above which `geartrain check` fails; for a speed "
        "of 0 the maximum difference, as a number in the train's unit; default the error is only reported",
    )
    source: str | None = Field(None, description="Key of the source in `sources`")
    note: str | None = Field(None, description="Remark for readers")

    @model_validator(mode="after")
    def _check_keys(self) -> Target:
        exactly_one(self, "a target", ("name", "period", "speed"))
        tolerance = self.tolerance
        if self.sense is not None and self.speed is not None:
            fix = "omit `sense`, and write a retrograde speed with a minus sign"
            raise bad("target", f"the speed {self.speed} and `sense` are both given", fix, "a speed has a sign")
        if tolerance and tolerance.unit is not None and self.speed is not None and not self.speed.value:
            fix = "give the maximum difference as a number in the train's unit"
            raise bad("target", f"a relative tolerance of {tolerance} is 0 for a speed of 0", fix)
        return self


class Expect(Declared):
    """Required mean speed of an output, exact or within a tolerance. In a declaration, a single number instead of a
    mapping is the value.
    """

    SHORT: ClassVar = {"type": ["number", "string"]}

    value: Amount = Field(
        description="Expected speed in the train's unit, or travel of a sliding link with its unit; integers and "
        "fractions are exact, decimals are compared to half a unit of their last digit"
    )
    tolerance: Annotated[Amount, _TOLERANCE] | None = Field(
        None, description="Maximum difference, in the unit of the value; default half a unit of its last digit"
    )

    def holds(self, speed: Any) -> bool:
        """Return True if a speed [the train's unit of speed] agrees with the expected value within the tolerance."""
        return self.value.holds(speed, self.tolerance.value if self.tolerance else None)


def _read_printed(raw: object, info: ValidationInfo) -> object:
    """Read a published value or its tolerance, as a time if the validated field `as` in `info` is a period."""
    # `as_` is missing if it is not valid, which is reported
    if info.data.get("as_", "period" if is_printed_period(raw) else None) == "period":
        return PrintedPeriod.parse(raw)
    if is_printed_period(raw):
        raise bad("published", f"'{raw}' is a time, not a number", "add `as: period`")
    return raw


class Published(Declared):
    """Published value of an output, as printed in a source; `geartrain check` compares it with the calculated value.

    See Also
    --------
    Output : its field `published`
    """

    # validated first, because it decides how the value is read
    as_: Literal["speed", "input/output", "output/input", "period"] = Field(
        "speed", alias="as", description="Quantity that is printed; ratios need exactly one non-zero input"
    )
    value: Annotated[Amount, BeforeValidator(_read_printed)] = Field(
        description="Value as printed; the computed value must match all its digits. For a period a time, such as "
        "27.32 d, 24 h 50 min 28.4 s or 29 y 157 d, where y is the train's unit"
    )
    magnitude: Boolean = Field(
        False, description="True to compare a ratio or a speed by its magnitude, because the source prints no sign"
    )
    sense: Literal["direct", "retrograde"] | None = Field(
        None, description="Sense of rotation of a period: direct (positive speed) or retrograde; default either"
    )
    turns: Annotated[Figure, _TURNS] = Field(
        Figure.parse(1), description="Number of turns of the output in the printed period; above 0"
    )
    tolerance: Annotated[Amount, BeforeValidator(_read_printed), _TOLERANCE] | None = Field(
        None,
        description="Maximum difference, in the unit of the value; for a period a time; "
        "default half a unit of its last digit",
    )
    place: str | None = Field(None, description="Page or table of the source")
    source: str | None = Field(None, description="Key of the source in `sources`")

    @property
    def unsigned(self) -> bool:
        """True if only the magnitude of the value is compared."""
        return self.magnitude or (self.as_ == "period" and self.sense is None)

    @model_validator(mode="after")
    def _check_value(self) -> Published:
        # a printed 0.0 is rounded, and permits a small ratio
        exact = self.value.half is None and (self.tolerance is None or not self.tolerance.value)
        if self.as_ == "input/output" and not self.value.value and exact:
            what = "an input/output ratio of 0 would mean that the input is at rest"
            why = "a ratio describes an input that turns"
            raise bad("published", what, "write `{value: 0, as: output/input}` for an output at rest", why)
        period = self.as_ == "period"
        if period and not (isinstance(self.value, PrintedPeriod) and self.value.above_zero):
            fix, why = "write `{value: 0, as: speed}` for a link at rest", "a period is the time of one turn"
            raise bad("published", f"a period of {self.value} is not above 0", fix, why)
        if self.magnitude and (period or self.value.value < 0):
            what = "a period is a magnitude" if period else f"{self.value} with `magnitude: true` is negative"
            fix = "remove `magnitude`; `sense` gives a period a sign" if period else "remove the minus sign"
            raise bad("published", what, fix)
        if not period and (self.sense is not None or "turns" in self.model_fields_set):
            fix = "remove them, or write `as: period`"
            raise bad("published", f"`sense` and `turns` belong to a period, not to a value `as: {self.as_}`", fix)
        return self


def _check_at_epoch(raw: object) -> str:
    from geartrain.train.sky import read_sky_angle

    try:
        read_sky_angle(str(raw))
    except ValueError as error:
        raise bad("at_epoch", *error.args) from None
    return str(raw)


class Output(Declared):
    """Output of the train: the speed of a link, absolute or relative to another link.

    Examples
    --------
    >>> output = Output(of="planet", relative_to="carrier", expect="-20/21")
    >>> output.expect.value.value
    Fraction(-20, 21)
    """

    SHORT: ClassVar = {"type": "null"}

    of: Id | None = Field(None, description="Link that turns; default the name of the output")
    relative_to: Id | None = Field(None, description="Link to which the speed is relative; default the frame")
    expect: Annotated[Expect, short_for("value")] | None = Field(None, description="Required speed in the train's unit")
    published: Published | None = Field(None, description="Value printed in a source, which the output must match")
    targets: tuple[Annotated[Target, short_for("name")], ...] = Field(
        (), description="Periods or speeds with which the output is compared"
    )
    dial: Id | None = Field(None, description="Name of the dial on which the output is read")
    hand: Literal["needle", "hour", "minute", "seconds", "sphere", "bead", "ecliptic", "figure", "wheel"] = Field(
        "needle",
        description="Shape of the hand: a slender needle, a spade (hour), a long leaf (minute), a thin hand with a "
        "counterpoise (seconds), a sphere on an arm, a bead on a ring of its own (bead), or the eccentric ring of an "
        "astrolabe (ecliptic); without a dial, a pointing figure on the link, or a road wheel (wheel)",
    )
    at_epoch: Annotated[str, BeforeValidator(_check_at_epoch)] | None = Field(
        None,
        description="Angle at the `epoch` of the train, without the anomalies of its pins: a sum of mean angles of the "
        "sky and constants, such as `sun`, `moon - sun`, `mars_anomaly + 180 deg` or `33.1 deg`; read along the scale "
        "of the dial, without one in the sense of the output. Names: `sun`, `moon`, `moon_node`, `moon_perigee`, "
        "`mercury` to `saturn`, and `moon_anomaly`, `mercury_anomaly` to `saturn_anomaly`. The page draws the train "
        "in these positions; an output on a zodiac without such an angle is not set to the sky",
    )
    note: str | None = Field(None, description="Remark for readers")

    @property
    def is_pointer(self) -> bool:
        """True if the output has a dial, a target or a published value."""
        return bool(self.dial or self.published or self.targets)

    def links(self, name: str, frame: str) -> tuple[str, str]:
        """Return the link whose motion is the output, and the link relative to which it is measured.

        Parameters
        ----------
        name : str
            Name of the output; it is also the name of the link if `of` is not declared.
        frame : str
            Link that is the frame of the train.
        """
        return self.of or name, self.relative_to or frame


class SpeedUnit(Declared):
    """Unit of all speeds: a speed of 1 is one turn per declared time, length or period."""

    per: str = Field(
        description="A time (`12 h`, `7 d`), a length (`18 ft`), or the name of a period that `geartrain periods` lists"
    )


class View(Declared):
    """View of the train: the side from which it is seen, and the positive sense of rotation."""

    from_: str | None = Field(None, alias="from", description="Side from which the train is viewed, front or back")
    positive: Literal["clockwise", "counter-clockwise"] = Field(
        "counter-clockwise", description="Sense of rotation of a positive speed"
    )


class TourStep(Declared):
    """Step of the tour on a train's page: a part at which the camera is directed, and a text about the part."""

    look_at: Id = Field(
        description="Name of an output, link, wheel, dial or coupling; if several parts "
        "have this name, the first of these kinds"
    )
    text: str = Field(description="Text for visitors")
