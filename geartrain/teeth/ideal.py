"""Ideal teeth: the ratio of tooth counts at every instant, without loss."""

from __future__ import annotations

from fractions import Fraction
from math import pi
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from geartrain.teeth.transmission import ExactRatio


class Ideal(BaseModel):
    """Teeth that transmit the exact ratio at every instant."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    form: Literal["ideal"] = Field(description="The name of this form")

    def law(self, z1: int, z2: int, driver: int = 1) -> ExactRatio:
        """The law of a pair: its ratio and nothing else, both ways round. `driver` 2 lets the second wheel drive."""
        first, second = (z1, z2) if driver == 1 else (z2, z1)
        return ExactRatio(Fraction(first, second), 2 * pi / first)
