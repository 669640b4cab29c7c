"""How far hand-cut wheels are off: fixed errors, distributions, tables measured tooth by tooth.

A plain number or a percentage is a fraction of the nominal: a placement of the wheel's own pitch, an aperture of the
tooth's aperture, a length of the depth of the tooth.
"""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field, GetJsonSchemaHandler, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Angle, Dimension, Quantity
from geartrain.train.fields import Declared, also, short_for

AngleOff = Annotated[Quantity, Dimension("angle or fraction", plain=True)]
LengthOff = Annotated[Quantity, Dimension("length or fraction", plain=True)]


class _Off(Declared):
    """A fixed error, or one drawn anew for each tooth, wheel or pair; a bare value is fixed."""

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
    """How far an angle is off."""

    value: AngleOff | None = Field(None, description="A fixed error")
    normal: AngleOff | None = Field(None, description="Standard deviation of a normal distribution about 0")
    uniform: AngleOff | None = Field(None, description="Greatest error, all up to it equally likely")


class LengthError(_Off):
    """How far a length is off."""

    value: LengthOff | None = Field(None, description="A fixed error")
    normal: LengthOff | None = Field(None, description="Standard deviation of a normal distribution about 0")
    uniform: LengthOff | None = Field(None, description="Greatest error, all up to it equally likely")


class MeasuredTeeth(Declared):
    """Errors measured on a real wheel, one for each tooth in the order of its turning."""

    placement: tuple[AngleOff, ...] | None = Field(
        None, fail_fast=True, description="How far each tooth is ahead of its place"
    )
    tip: tuple[LengthOff, ...] | None = Field(
        None, fail_fast=True, description="How far each tip stands out beyond its radius"
    )
    aperture: tuple[AngleOff, ...] | None = Field(
        None, fail_fast=True, description="How much wider each tooth's aperture is"
    )

    @property
    def columns(self) -> dict[str, tuple[Quantity, ...]]:
        """What is given, by name."""
        names = ("placement", "tip", "aperture")
        return {name: column for name in names if (column := getattr(self, name)) is not None}


class WheelManufacture(Declared):
    """How far the teeth of a wheel are off; what is not given is cut true.

    See Also
    --------
    Wheel : holds it as `cutting`
    Train : holds that of all other wheels
    """

    placement: Annotated[AngleError, short_for("value")] | None = Field(
        None, description="Of each tooth from its place about the axle; positive is ahead, the way the wheel turns"
    )
    eccentricity: Annotated[LengthError, short_for("value")] | None = Field(
        None, description="Distance of the axle from the middle of the teeth"
    )
    eccentric_at: Angle | None = Field(
        None,
        description="Where the middle of the teeth lies from the axle, from the first tooth; positive is ahead, the "
        "way the wheel turns, as of placement; default anywhere",
    )
    tip: Annotated[LengthError, short_for("value")] | None = Field(None, description="Of each tip along its radius")
    aperture: Annotated[AngleError, short_for("value")] | None = Field(None, description="Of each tooth's aperture")
    measured: MeasuredTeeth | None = Field(None, description="Tables of a real wheel, tooth by tooth")
    source: str | None = Field(None, description="Key of the source")
    note: str | None = Field(None, description="A remark for the reader")


class Filing(Declared):
    """A pair is filed to fit: the flank that stands out farthest where it jams is filed until the couple passes.

    See Also
    --------
    PairMounting : holds it as `filing`
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
    """How far the axes of a gear pair are off; what is not given is fitted true.

    See Also
    --------
    GearPair : holds it as `fitting`
    Train : holds that of all other pairs
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
