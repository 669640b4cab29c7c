"""Numbers and quantities that lie on one side of 0, as types of declared fields; how teeth in mesh yield."""

from __future__ import annotations

from math import pi
from typing import Annotated

from pydantic import AfterValidator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Figure, MeshDamping, MeshStiffness, Quantity


def above_zero(fix: str) -> AfterValidator:
    """A number or quantity is above 0."""

    def check(given: Figure | Quantity) -> Figure | Quantity:
        if given.value <= 0:
            raise PydanticCustomError("bound", "{text} is not above 0", {"text": given.text, "fix": fix})
        return given

    return AfterValidator(check)


def below_right_angle(fix: str) -> AfterValidator:
    """An angle is less than 90 degrees."""

    def check(given: Quantity) -> Quantity:
        if given.si >= pi / 2:
            raise PydanticCustomError("bound", "{text} is no less than 90 deg", {"text": given.text, "fix": fix})
        return given

    return AfterValidator(check)


def not_below_zero(fix: str) -> AfterValidator:
    """A number or quantity is 0 or more."""

    def check(given: Figure | Quantity) -> Figure | Quantity:
        if given.value < 0:
            raise PydanticCustomError("bound", "{text} is below 0", {"text": given.text, "fix": fix})
        return given

    return AfterValidator(check)


PairStiffness = Annotated[MeshStiffness, above_zero("teeth yield: give for example 20 N/um")]
"""Torque on the driven wheel for each radian, or force along the line of action for each length."""

PairDamping = Annotated[MeshDamping, not_below_zero("it takes energy: give 0 or more")]
"""The same by speed."""
