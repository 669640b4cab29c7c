"""Manufacture of wheels: their materials, and the errors of cutting and mounting.

A train can use the materials of a shipped table and materials that it declares itself. Errors are fixed values, random
values with a distribution, or measurements of each tooth. A percentage, or a number without a unit, is a fraction of a
nominal value: of the pitch for a pitch deviation, of the aperture (angle between the two flanks of a tooth) for an
aperture deviation, and of the tooth depth for a length.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, model_validator

from geartrain.numerics.quantity import (
    Angle,
    Density,
    Dimension,
    Figure,
    MeasuredLength,
    Pressure,
    Quantity,
    above_zero,
    bad,
    checked,
    not_below_zero,
)
from geartrain.train.fields import Declared, exactly_one, short_for

_VICKERS = 9.80665e6  # Pa per HV: 1 HV is 1 kgf/mm2


_POISSON = checked(
    lambda given: 0 <= given.value < 0.5,
    "Poisson's ratio {text} is out of range",
    "give a number from 0 to less than 0.5, about 0.3 for metals",
)
_SPREAD = checked(
    lambda given: 0 <= given.value < 1,
    "a spread of {text} is out of range",
    "give a fraction from 0 to less than 1, such as 0.3 for 30 % to either side",
)
_STRENGTH = "give a pressure such as 200 MPa"


class Material(Declared):
    """Properties of a material for strength calculations.

    See Also
    --------
    Train : its field `materials`, by name

    Examples
    --------
    >>> steel = material_table()["steel"]
    >>> steel.youngs_modulus.text, round(steel.hardness_pressure / 1e6)
    ('206 GPa', 1863)
    """

    youngs_modulus: Annotated[Pressure, above_zero("give a pressure such as 100 GPa")] = Field(
        description="Young's modulus"
    )
    poisson: Annotated[Figure, _POISSON] = Field(Figure.parse("0.3"), description="Poisson's ratio, 0 to less than 0.5")
    strength: Annotated[Pressure, above_zero(_STRENGTH)] | None = Field(
        None,
        description="Strength: 0.2 % proof stress of metals, tensile strength of materials that do not "
        "yield; without safety factor",
    )
    hardness: Annotated[Figure, above_zero("give a Vickers hardness (HV) such as 120")] | None = Field(
        None, description="Vickers hardness (HV), for wear calculations"
    )
    density: Annotated[Density, above_zero("give a density such as 8.5 g/cm3")] | None = Field(
        None, description="Density; the `density` of a wheel takes precedence"
    )
    spread: Annotated[Figure, _SPREAD] = Field(
        Figure.parse("0.3"),
        description="Relative uncertainty of the strength to either side, 0 to less than 1; in Monte Carlo runs "
        "`strength` is the median of a lognormal distribution, and `spread` the standard deviation of its logarithm",
    )
    what: str = Field("", description="Description of the material")
    source: str = Field("", description="Source of the values")

    @property
    def hardness_pressure(self) -> float | None:
        """Vickers hardness as a pressure [Pa]: force divided by the area of the indentation; None if not declared."""
        return None if self.hardness is None else float(self.hardness.value) * _VICKERS


FaceWidth = Annotated[MeasuredLength, above_zero("give a length such as 3 mm")]


class ArborSizes(Declared):
    """Dimensions and material of the arbor of a link between its two bearings."""

    diameter: FaceWidth = Field(description="Diameter of the arbor between its shoulders")
    span: FaceWidth = Field(description="Distance between the centres of the bearings")
    pivot: FaceWidth | None = Field(None, description="Diameter of its pivots; default `diameter`")
    pivot_length: FaceWidth | None = Field(
        None, description="Length of a pivot in its hole; default the pivot's diameter"
    )
    material: str = Field("steel", description="Name of the material, in the table or in `materials`")


@cache
def material_table() -> Mapping[str, Material]:
    """Return the materials of the shipped table by name; a declared material of the same name takes precedence."""
    text = files("geartrain.train").joinpath("materials.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(text.splitlines())
    return {row.pop("name"): Material.model_validate(row) for row in rows}


FEWEST_ANGLES = 4
"""Minimum number of measured teeth: three determine mean and eccentricity, and one more leaves a residual."""

AngleOff = Annotated[Quantity, Dimension("angle or fraction", plain=True)]
LengthOff = Annotated[Quantity, Dimension("length or fraction", plain=True)]


class _DeclaredError(Declared):
    """Manufacturing error, either fixed or drawn at random for each tooth, wheel or pair. A single value instead of a
    mapping is a fixed error.
    """

    @model_validator(mode="after")
    def _has_one_key(self) -> _DeclaredError:
        # a fixed error may be negative, the width of a distribution may not
        for key in ("normal", "uniform"):
            width: Quantity | None = getattr(self, key)
            if width is not None and width.value < 0:
                fix = "give the width of the distribution, 0 or more"
                raise bad("error", f"{key}: {width.text} is negative", fix)
        return exactly_one(self, "an error", ("value", "normal", "uniform"), "key")


class AngleError(_DeclaredError):
    """Error of an angle, either fixed or random. A single value instead of a mapping is a fixed error. A number without
    a unit is a fraction of the nominal value.
    """

    SHORT: ClassVar = {"type": ["number", "string"], "format": "angle or fraction"}

    value: AngleOff | None = Field(None, description="Fixed error")
    normal: AngleOff | None = Field(None, description="Standard deviation of a normal distribution about 0")
    uniform: AngleOff | None = Field(None, description="Maximum magnitude of a uniform distribution about 0")


class LengthError(_DeclaredError):
    """Error of a length, either fixed or random. A single value instead of a mapping is a fixed error. A number without
    a unit is a fraction of the tooth depth.
    """

    SHORT: ClassVar = {"type": ["number", "string"], "format": "length or fraction"}

    value: LengthOff | None = Field(None, description="Fixed error")
    normal: LengthOff | None = Field(None, description="Standard deviation of a normal distribution about 0")
    uniform: LengthOff | None = Field(None, description="Maximum magnitude of a uniform distribution about 0")


class MeasuredTeeth(Declared):
    """Measurements of the teeth of a real wheel, one value for each tooth in the order of rotation."""

    pitch_deviation: tuple[AngleOff, ...] | None = Field(
        None,
        fail_fast=True,
        description="Pitch deviation of each tooth; positive if it is ahead of its nominal position",
    )
    tip: tuple[LengthOff, ...] | None = Field(
        None, fail_fast=True, description="Deviation of each tip radius; positive if it is too large"
    )
    aperture_deviation: tuple[AngleOff, ...] | None = Field(
        None, fail_fast=True, description="Deviation of the aperture angle of each tooth; positive if it is too wide"
    )
    angles: tuple[Angle | None, ...] | None = Field(
        None,
        fail_fast=True,
        description="Direction of each tooth seen from the axis of rotation, increasing from each tooth to the next; "
        "null for a missing tooth",
    )
    csv: str | None = Field(
        None,
        description="CSV file with the angles, one row for each tooth and an empty cell for a missing tooth; relative "
        "to the file of the declaration. A number without a unit is in degrees",
    )
    column: str = Field("angle", description="Header of the column of `csv` that contains the angles")
    missing: Annotated[int, Field(ge=0)] = Field(
        0, description="Number of missing teeth after the last one in `angles`"
    )
    error: Annotated[Angle, not_below_zero("give 0 or more, such as 0.05 deg")] | None = Field(
        None, description="Standard deviation of the measurement error of an angle; default 0"
    )
    use: Literal["table", "eccentric", "law"] = Field(
        "table",
        description="Use of `angles`: as pitch deviations of this wheel (table); as a fitted eccentricity and the "
        "remaining pitch deviations of this wheel (eccentric); or as the distribution from which other wheels of the "
        "same maker are drawn (law)",
    )

    @model_validator(mode="before")
    @classmethod
    def _with_angles_of_file(cls, raw: Any) -> Any:
        if not isinstance(raw, dict) or raw.get("csv") is None:
            return raw
        if raw.get("angles") is not None:
            what, why = "the angles are declared twice", "both `angles` and `csv` are given"
            raise bad("measured", what, "remove one of them", why)
        rest = {key: value for key, value in raw.items() if key not in ("csv", "column")}
        return {**rest, "angles": _read_angles(Path(str(raw["csv"])), str(raw.get("column", "angle")))}

    @model_validator(mode="after")
    def _describes_pitches_once(self) -> MeasuredTeeth:
        if self.angles is None:
            return self
        if self.pitch_deviation is not None:
            what, why = "the pitches are declared twice", "both `pitch_deviation` and angles are given"
            raise bad("measured", what, "remove one of them", why)
        if (count := len(self.angles) - self.angles.count(None)) < FEWEST_ANGLES:
            why = f"an eccentricity and a standard deviation are estimated from at least {FEWEST_ANGLES} teeth"
            raise bad("measured", f"only {count} angles were measured", "measure more teeth", why)
        return self

    @property
    def columns(self) -> dict[str, tuple[Quantity, ...]]:
        """Measured values by name of the quantity; quantities that were not measured are omitted."""
        names = ("pitch_deviation", "tip", "aperture_deviation")
        return {name: column for name in names if (column := getattr(self, name)) is not None}


def _read_angles(path: Path, column: str) -> list[str | None]:
    """Read the angles of teeth from one column of a CSV file with a header. Lines that begin with # are comments.

    An empty cell becomes None. A number without a unit is in degrees. Raises `PydanticCustomError` for invalid files.
    """
    try:
        if not path.is_file():
            raise OSError("it is not a file")
        text = path.read_text(encoding="utf-8-sig")
        rows = list(csv.reader(line for line in text.splitlines() if not line.startswith("#")))
    except (OSError, ValueError, csv.Error) as error:
        fix = "give the path of a CSV file, relative to the file of the declaration"
        raise bad("csv", f"the table '{path}' cannot be read", fix, str(error)) from None
    header = [cell.strip() for cell in rows[0]] if rows else []
    if column not in header:
        what, why = f"the table '{path}' has no column '{column}'", f"its first row is '{','.join(header)}'"
        raise bad("csv", what, f"name one of its columns, such as `column: {(header or ['angle'])[0]}`", why)
    while not rows[-1]:
        rows.pop()
    at = header.index(column)
    # a blank line is a missing tooth, because a table of one column has no other way to write an empty cell
    cells = [row[at].strip() if at < len(row) else "" for row in rows[1:]]
    return [(f"{cell} deg" if cell[-1] in "0123456789." else cell) if cell else None for cell in cells]


class WheelManufacture(Declared):
    """Manufacturing errors of the teeth of a wheel. Undeclared errors are 0."""

    pitch_deviation: Annotated[AngleError, short_for("value")] | None = Field(
        None,
        description="Pitch deviation of each tooth from its nominal position about the axis; positive in the direction "
        "of rotation",
    )
    stepping: Annotated[AngleError, short_for("normal")] | None = Field(
        None,
        description="Error of each step of dividers that set off each tooth from the previous one, normal or uniform; "
        "the errors of the steps add up, and the gap left by the last step is divided evenly",
    )
    eccentricity: Annotated[LengthError, short_for("value")] | None = Field(
        None, description="Distance of the axis of rotation from the centre of the teeth"
    )
    eccentricity_angle: Angle | None = Field(
        None,
        description="Direction from the axis to the centre of the teeth, measured from the first tooth, positive in "
        "the direction of rotation; default random",
    )
    tip: Annotated[LengthError, short_for("value")] | None = Field(None, description="Deviation of each tip radius")
    aperture_deviation: Annotated[AngleError, short_for("value")] | None = Field(
        None, description="Deviation of the aperture angle of each tooth"
    )
    measured: MeasuredTeeth | None = Field(None, description="Deviations measured on a real wheel, tooth by tooth")
    source: str | None = Field(None, description="Key of the source in `sources`")
    note: str | None = Field(None, description="Remark for readers")

    @model_validator(mode="after")
    def _is_consistent(self) -> WheelManufacture:
        if self.stepping is not None and self.stepping.value is not None:
            why = "the even division of the gap removes an error that all steps share"
            fix = f"give a standard deviation, such as `stepping: {{normal: {self.stepping.value}}}`"
            raise bad("stepping", "`stepping` is a fixed error", fix, why)
        doubled = [key for key in ("pitch_deviation", "stepping", "eccentricity") if getattr(self, key) is not None]
        if doubled and self.measured is not None and self.measured.angles is not None:
            what, why = f"`{doubled[0]}` is counted twice", "the measured angles contain it already"
            raise bad("measured", what, f"remove `{doubled[0]}`, or remove `measured`", why)
        return self


class Filing(Declared):
    """Fitting of a pair by filing: where the pair jams, the most protruding flank is filed until the teeth pass."""

    stroke: Annotated[
        LengthOff,
        above_zero("give a length above 0, such as 0.02 mm, or a fraction of the tooth depth", "a stroke"),
    ] = Field(
        description="Thickness that one stroke of the file removes from a flank, as a length or a fraction of the depth"
    )


class PairMounting(Declared):
    """Mounting errors of the axes of a gear pair. Undeclared errors are 0."""

    centre: Annotated[LengthError, short_for("value")] | None = Field(
        None, description="Error of the centre distance; positive if the axes are too far apart"
    )
    bearing: Annotated[LengthError, short_for("value")] | None = Field(
        None,
        description="Bearing clearance: the centre distance varies by up to this length to either side, from tooth to "
        "tooth",
    )
    filing: Filing | None = Field(
        None,
        description="Fitting by filing: the pair is turned through its cycle, and jamming teeth are filed until they "
        "pass; default none",
    )
    source: str | None = Field(None, description="Key of the source in `sources`")
    note: str | None = Field(None, description="Remark for readers")
