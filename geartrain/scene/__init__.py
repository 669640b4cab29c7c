"""A scene: all that a picture of a train needs, worked out beforehand, as plain data."""

from __future__ import annotations

from geartrain.scene.making import make_scene
from geartrain.scene.result import (
    Body,
    Coupling,
    DialFace,
    Movement,
    Pair,
    Pointer,
    Profile,
    Scene,
    Source,
    Step,
    Wheel,
)

__all__ = [
    "Body",
    "Coupling",
    "DialFace",
    "Movement",
    "Pair",
    "Pointer",
    "Profile",
    "Scene",
    "Source",
    "Step",
    "Wheel",
    "make_scene",
]
