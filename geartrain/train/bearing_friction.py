"""Friction torque of a link's bearing: while it turns, and at rest."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field, GetJsonSchemaHandler, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Quantity, Torque
from geartrain.train.fields import Declared, also


def _not_negative(torque: Quantity) -> Quantity:
    if torque.value < 0:
        raise PydanticCustomError(
            "bearing", "a friction torque is not negative", {"fix": "give its magnitude: it acts against the turning"}
        )
    return torque


FrictionTorque = Annotated[Torque, AfterValidator(_not_negative)]


class BearingFriction(Declared):
    """Friction of a bearing, which does not depend on load or speed. A bare torque is `sliding`.

    See Also
    --------
    Link : holds it as `bearing`

    Examples
    --------
    >>> BearingFriction(sliding="0.5 N m").at_rest.si
    0.5
    """

    sliding: FrictionTorque = Field(description="Friction torque while it turns, against its turning")
    static: FrictionTorque | None = Field(
        None, description="Torque that a start has to overcome; `sliding` or more, default `sliding`"
    )

    @model_validator(mode="after")
    def _rests_no_easier(self) -> BearingFriction:
        if self.static is None:
            return self
        if (self.static.unit is None) != (self.sliding.unit is None) and self.static.value and self.sliding.value:
            what = "sliding {sliding} and static {static} mix a plain number and a torque with a unit"
            fix = "give both with a unit, or both without"
        elif self.static.base < self.sliding.base:
            what = "a static friction torque of {static} is below the sliding one of {sliding}"
            fix = "what turns is never harder to move than what rests: give `static` as `sliding` or more"
        else:
            return self
        raise PydanticCustomError(
            "bearing", what, {"static": self.static.text, "sliding": self.sliding.text, "fix": fix}
        )

    @property
    def at_rest(self) -> Quantity:
        """`static`, or `sliding` where that is not given."""
        return self.sliding if self.static is None else self.static

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": ["string", "number"]}, handler(schema))


def _sliding(raw: object) -> object:
    if isinstance(raw, dict | BearingFriction):
        return raw
    return {"sliding": _not_negative(Quantity.parse(raw, "torque", plain=True))}


DeclaredBearing = Annotated[BearingFriction, BeforeValidator(_sliding)]
"""The same, or a bare torque."""
