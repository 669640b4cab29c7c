"""A scene: all that a picture of a train needs, worked out beforehand, as plain data."""

from __future__ import annotations

from geartrain.scene.construction import make_scene
from geartrain.scene.elements import (
    DialFace,
    ErrorSource,
    ErrorStep,
    Movement,
    Pointer,
    Scene,
    SceneBody,
    SceneCoupling,
    ScenePair,
    SceneWheel,
    ToothProfile,
)

__all__ = [
    "DialFace",
    "ErrorSource",
    "ErrorStep",
    "Movement",
    "Pointer",
    "Scene",
    "SceneBody",
    "SceneCoupling",
    "ScenePair",
    "SceneWheel",
    "ToothProfile",
    "make_scene",
]
