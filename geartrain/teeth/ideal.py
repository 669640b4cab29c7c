"""Ideal teeth: the ratio of tooth counts at every instant, without loss."""

from __future__ import annotations

from fractions import Fraction
from math import pi
from typing import TYPE_CHECKING, Literal

from pydantic import Field

from geartrain.teeth.tooth_form import ShaftAngle, ToothForm
from geartrain.teeth.transmission import ExactRatio

if TYPE_CHECKING:
    from geartrain.teeth.gear_mesh import MeshingWheels


class Ideal(ToothForm):
    """Teeth that transmit the exact ratio at every instant."""

    form: Literal["ideal"] = Field(description="The name of this form")

    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> None:
        """None: these teeth add nothing to the ratio."""

    def law(self, z1: int, z2: int, driver: int = 1) -> ExactRatio:
        """The law of a pair: its ratio and nothing else, both ways round. `driver` 2 lets the second wheel drive."""
        first, second = (z1, z2) if driver == 1 else (z2, z1)
        return ExactRatio(Fraction(first, second), 2 * pi / first)
