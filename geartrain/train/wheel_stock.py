"""Blank of a wheel: thickness, face width and material, by default the values of the train."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.train.manufacturing import Material, material_table

if TYPE_CHECKING:
    from geartrain.numerics.quantity import Quantity
    from geartrain.train.declaration import Train
    from geartrain.train.mechanism import Wheel


def wheel_thickness(train: Train, wheel: Wheel) -> Quantity | None:
    """Return the thickness of a wheel along its axis: its declared thickness, else its face width, else the thickness
    or face width of the train; None if none of them is declared.
    """
    return wheel.thickness or wheel.face_width or train.thickness or train.face_width


def face_width(train: Train, wheel: Wheel) -> Quantity | None:
    """Return the face width of a wheel: its declared face width, else its thickness, else the face width or thickness
    of the train; None if none of them is declared.
    """
    return wheel.face_width or wheel.thickness or train.face_width or train.thickness


def material_named(train: Train, name: str) -> Material:
    """Return the material with a given name from the declaration of the train, else from the shipped table."""
    return train.materials.get(name) or material_table()[name]
