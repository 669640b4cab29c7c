"""What a wheel is cut from: thickness, width of its teeth, material; its own, else the train's."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.train.manufacturing import Material, material_table

if TYPE_CHECKING:
    from geartrain.numerics.quantity import Quantity
    from geartrain.train.declaration import Train
    from geartrain.train.mechanism import Wheel


def wheel_thickness(train: Train, wheel: Wheel) -> Quantity | None:
    """Along its axis; where it is not declared it is as thick as its teeth are wide."""
    return wheel.thickness or wheel.face_width or train.thickness or train.face_width


def face_width(train: Train, wheel: Wheel) -> Quantity | None:
    """Width of its teeth; where it is not declared they are as wide as the wheel is thick."""
    return wheel.face_width or wheel.thickness or train.face_width or train.thickness


def material_named(train: Train, name: str) -> Material:
    """Of the train's own materials, else of the table."""
    return train.materials.get(name) or material_table()[name]
