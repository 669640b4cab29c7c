"""Triangular teeth of antiquity: the parameters a pair declares."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

from geartrain.quantity import Angle, Figure, Length

_CLEARANCES = ("clearance", "excess", "backlash", "centre_distance", "window")


def _one_per_wheel(raw: object) -> object:
    return raw if isinstance(raw, list | tuple) else (raw, raw)


class Triangular(BaseModel):
    """Triangular teeth: straight flanks that meet in a point."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    form: Literal["triangular"] = Field(description="The name of this form")
    half_angle: Annotated[tuple[Angle, Angle], BeforeValidator(_one_per_wheel)] = Field(
        description="Half the aperture of a tooth, between 0 and 90 deg; a list of two gives one for each wheel"
    )
    clearance: Figure | None = Field(None, description="Centre distance over the sum of the outer radii, above 1")
    excess: Figure | None = Field(None, description="Clearance factor less 1, above 0")
    backlash: Length | None = Field(None, description="Play at the pitch circle")
    centre_distance: Length | None = Field(None, description="Distance of the two axes")
    window: Figure | None = Field(
        None, description="Where between jamming (0) and losing contact (1) the centre distance lies"
    )
    radii: Literal["equal_depth", "pitch_true"] | tuple[Length, Length] = Field(
        "equal_depth",
        description="How the outer radii follow from the tooth numbers, or the two radii themselves",
    )

    @model_validator(mode="after")
    def _parameters_make_sense(self) -> Triangular:
        for angle in self.half_angle:
            turns = angle.si / 6.283185307179586
            if not 0 < turns < 0.25:
                raise PydanticCustomError(
                    "half_angle",
                    "half_angle {angle} is outside 0 to 90 deg",
                    {
                        "angle": angle.text,
                        "fix": "a triangular tooth has a half aperture between 0 and 90 deg",
                    },
                )
        given = [name for name in _CLEARANCES if getattr(self, name) is not None]
        if len(given) != 1:
            raise PydanticCustomError(
                "clearance",
                "the clearance is given {count} times",
                {"count": len(given), "fix": f"give exactly one of: {', '.join(_CLEARANCES)}"},
            )
        return self
