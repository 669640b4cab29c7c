"""The basic efficiency of a pair as declared, by the wheel that drives."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field, GetJsonSchemaHandler, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Quantity, Share
from geartrain.train.fields import Declared, also


def _no_more_than_all(efficiency: Quantity) -> Quantity:
    if efficiency.base > 1:
        meant = f"{efficiency.text} %" if efficiency.unit is None and efficiency.base <= 100 else "0.98"
        raise PydanticCustomError(
            "efficiency",
            "an efficiency of {text} makes power out of nothing",
            {"text": efficiency.text, "fix": f"an efficiency is at most 1: write for example 0.98 or {meant}"},
        )
    return efficiency


Efficiency = Annotated[Share, AfterValidator(_no_more_than_all)]


class Efficiencies(Declared):
    """Basic efficiency of a pair, carrier held, by the wheel that drives: above 0 and at most 1, or a percentage.

    A pair may lock in one direction, which 0 or less says, but not in both.
    """

    forward: Efficiency = Field(description="With the first wheel driving, at most 1; 0 or less locks")
    backward: Efficiency = Field(description="With the second wheel driving, at most 1; 0 or less locks")

    @model_validator(mode="after")
    def _passes_power_one_way(self) -> Efficiencies:
        if self.forward.base <= 0 and self.backward.base <= 0:
            raise PydanticCustomError(
                "efficiency",
                "an efficiency of {text} lets no power through in either direction",
                {"text": self.forward.text, "fix": "an efficiency is above 0 and at most 1, such as 0.98 or 98 %"},
            )
        return self

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": ["number", "string"]}, handler(schema))


def _efficiency(raw: object) -> object:
    return raw if isinstance(raw, dict | Efficiencies) else {"forward": raw, "backward": raw}


DeclaredEfficiency = Annotated[Efficiencies, BeforeValidator(_efficiency)]
"""The same, or one number for both directions."""
