"""Manufacture of wheels: their materials, and the errors of cutting and mounting by hand.

Materials are a shipped table and the materials that a train declares. Errors are fixed, drawn from a distribution, or
measured tooth by tooth. A plain number or a percentage is a fraction of the nominal value: a pitch deviation refers to
the pitch, an aperture deviation to the aperture of the tooth, and a length to the tooth depth.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import AfterValidator, Field, GetJsonSchemaHandler, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import (
    Angle,
    Density,
    Dimension,
    Figure,
    MeasuredLength,
    Pressure,
    Quantity,
    above_zero,
)
from geartrain.train.fields import Declared, also, short_for

if TYPE_CHECKING:
    pass

_VICKERS = 9.80665e6  # Pa in one HV, which is kgf/mm2


def _contracts(figure: Figure) -> Figure:
    if not 0 <= figure.value < 0.5:
        raise PydanticCustomError(
            "poisson",
            "Poisson's ratio {text} is that of no material",
            {"text": figure.text, "fix": "write a number from 0 to less than 0.5, for metals about 0.3"},
        )
    return figure


def _partly(figure: Figure) -> Figure:
    if not 0 <= figure.value < 1:
        raise PydanticCustomError(
            "spread",
            "a spread of {text} is no part of a value",
            {"text": figure.text, "fix": "write a part from 0 to less than 1: 0.3 for 30 % to either side"},
        )
    return figure


_STRENGTH = "give for example 200 MPa"


class Material(Declared):
    """Properties of a material that strength calculations need.

    See Also
    --------
    Train : has its own as `materials`, by name

    Examples
    --------
    >>> steel = material_table()["steel"]
    >>> steel.youngs_modulus.text, round(steel.hardness_pressure / 1e6)
    ('206 GPa', 1863)
    """

    youngs_modulus: Annotated[Pressure, above_zero("give for example 100 GPa")] = Field(description="Young's modulus")
    poisson: Annotated[Figure, AfterValidator(_contracts)] = Field(
        Figure.parse("0.3"), description="Poisson's ratio, 0 to less than 0.5"
    )
    strength: Annotated[Pressure, above_zero(_STRENGTH)] | None = Field(
        None,
        description="Stress at which it gives way: 0.2 % proof stress of metals, tensile strength of what does not "
        "yield; no safety is counted in it",
    )
    hardness: Annotated[Figure, above_zero("give for example 120, in HV")] | None = Field(
        None, description="Vickers hardness (HV), which wear goes by"
    )
    density: Annotated[Density, above_zero("give for example 8.5 g/cm3")] | None = Field(
        None, description="Density; `density` of a wheel goes before it"
    )
    spread: Annotated[Figure, AfterValidator(_partly)] = Field(
        Figure.parse("0.3"), description="How far the strength may be off to either side, as a part of it"
    )
    what: str = Field("", description="What is meant by the name")
    source: str = Field("", description="Where the values come from")

    @property
    def hardness_pressure(self) -> float | None:
        """Vickers hardness as a pressure [Pa]: force over the surface area of the indentation."""
        return None if self.hardness is None else float(self.hardness.value) * _VICKERS


FaceWidth = Annotated[MeasuredLength, above_zero("give a length such as 3 mm")]


class ArborSizes(Declared):
    """Dimensions and material of the arbor of a link between its two bearings.

    See Also
    --------
    Link : has it as `arbor`
    """

    diameter: FaceWidth = Field(description="Diameter between its shoulders")
    span: FaceWidth = Field(description="Length from the middle of one bearing to that of the other")
    pivot: FaceWidth | None = Field(None, description="Diameter of its pivots; default its own")
    pivot_length: FaceWidth | None = Field(None, description="Length of a pivot in its hole; default its diameter")
    material: str = Field("steel", description="Name of its material")


@cache
def material_table() -> Mapping[str, Material]:
    """Return the shipped table of materials by name. A material of the same name in a train takes precedence.

    Returns
    -------
    mapping of str to Material
        Handbook means with source and spread. They do not guarantee the strength of an individual sheet or bar.
    """
    text = files("geartrain.train").joinpath("materials.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(text.splitlines())
    return {row.pop("name"): Material.model_validate(row) for row in rows}


AngleOff = Annotated[Quantity, Dimension("angle or fraction", plain=True)]
LengthOff = Annotated[Quantity, Dimension("length or fraction", plain=True)]


class _Off(Declared):
    """A fixed error, or one that is drawn for each tooth, wheel or pair. A plain value is fixed."""

    @model_validator(mode="after")
    def _is_one_thing(self) -> _Off:
        given = [key for key in ("value", "normal", "uniform") if getattr(self, key) is not None]
        if len(given) != 1:
            raise PydanticCustomError(
                "error",
                "an error is one thing, and this gives {given}",
                {"given": " and ".join(given) or "nothing", "fix": "give exactly one of value, normal, uniform"},
            )
        for key in ("normal", "uniform"):
            width: Quantity | None = getattr(self, key)
            if width is not None and width.value < 0:
                raise PydanticCustomError(
                    "error",
                    "{key}: {text} is no width of a distribution",
                    {"key": key, "text": width.text, "fix": "write it 0 or greater"},
                )
        return self

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": ["number", "string"]}, handler(schema))


class AngleError(_Off):
    """Error of an angle, fixed or random."""

    value: AngleOff | None = Field(None, description="A fixed error")
    normal: AngleOff | None = Field(None, description="Standard deviation of a normal distribution about 0")
    uniform: AngleOff | None = Field(None, description="Greatest error, all up to it equally likely")


class LengthError(_Off):
    """Error of a length, fixed or random."""

    value: LengthOff | None = Field(None, description="A fixed error")
    normal: LengthOff | None = Field(None, description="Standard deviation of a normal distribution about 0")
    uniform: LengthOff | None = Field(None, description="Greatest error, all up to it equally likely")


class MeasuredTeeth(Declared):
    """Errors measured on a real wheel, one value for each tooth in the order of rotation."""

    pitch_deviation: tuple[AngleOff, ...] | None = Field(
        None, fail_fast=True, description="How far each tooth is ahead of its place"
    )
    tip: tuple[LengthOff, ...] | None = Field(
        None, fail_fast=True, description="How far each tip stands out beyond its radius"
    )
    aperture_deviation: tuple[AngleOff, ...] | None = Field(
        None, fail_fast=True, description="How much wider each tooth's aperture is"
    )

    @property
    def columns(self) -> dict[str, tuple[Quantity, ...]]:
        """Measured values by name, without the quantities that were not measured."""
        names = ("pitch_deviation", "tip", "aperture_deviation")
        return {name: column for name in names if (column := getattr(self, name)) is not None}


class WheelManufacture(Declared):
    """Manufacturing errors of the teeth of a wheel. Errors that are not declared are 0.

    See Also
    --------
    Wheel : has it as `cutting`
    Train : default of all other wheels
    """

    pitch_deviation: Annotated[AngleError, short_for("value")] | None = Field(
        None, description="Of each tooth from its place about the axle; positive is ahead, the way the wheel turns"
    )
    eccentricity: Annotated[LengthError, short_for("value")] | None = Field(
        None, description="Distance of the axle from the middle of the teeth"
    )
    eccentricity_angle: Angle | None = Field(
        None,
        description="Where the middle of the teeth lies from the axle, from the first tooth; positive is ahead, the "
        "way the wheel turns, as of pitch_deviation; default anywhere",
    )
    tip: Annotated[LengthError, short_for("value")] | None = Field(None, description="Of each tip along its radius")
    aperture_deviation: Annotated[AngleError, short_for("value")] | None = Field(
        None, description="Of each tooth's aperture"
    )
    measured: MeasuredTeeth | None = Field(None, description="Tables of a real wheel, tooth by tooth")
    source: str | None = Field(None, description="Key of the source")
    note: str | None = Field(None, description="A remark for the reader")


class Filing(Declared):
    """Fitting of a pair by filing: where it jams, the most protruding flank is filed until the tooth pair passes.

    See Also
    --------
    PairMounting : has it as `filing`
    """

    stroke: LengthOff = Field(
        description="What one stroke of the file takes off a flank, along its normal; a fraction of the tooth's depth"
    )

    @model_validator(mode="after")
    def _takes_something(self) -> Filing:
        if self.stroke.value <= 0:
            raise PydanticCustomError(
                "error",
                "a stroke of {text} takes nothing",
                {
                    "text": self.stroke.text,
                    "fix": "write a length above 0, such as 0.02 mm, or a fraction of the depth",
                },
            )
        return self


class PairMounting(Declared):
    """Mounting errors of the axes of a gear pair. Errors that are not declared are 0.

    See Also
    --------
    GearPair : has it as `fitting`
    Train : default of all other pairs
    """

    centre: Annotated[LengthError, short_for("value")] | None = Field(
        None, description="Of the distance of the two axes; positive is further apart"
    )
    bearing: Annotated[LengthError, short_for("value")] | None = Field(
        None, description="Play of the bearings: the distance moves by up to this, either way, from tooth to tooth"
    )
    filing: Filing | None = Field(
        None, description="The pair is turned through its cycle, and what jams is filed until it passes; default not"
    )
    source: str | None = Field(None, description="Key of the source")
    note: str | None = Field(None, description="A remark for the reader")
