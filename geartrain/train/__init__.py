"""The declaration of a train: frozen models, and the checks that need nothing but the declaration itself."""

from __future__ import annotations

from geartrain.train.declaration import StateCase, Train
from geartrain.train.manufacturing import AngleError, LengthError, PairMounting, WheelManufacture
from geartrain.train.mechanism import Axis, GearPair, Link, Revolute, Source, Teeth, Wheel
from geartrain.train.outputs import Dial, Expect, Output, Published, SpeedUnit, Target, View
from geartrain.train.states import Clutch, Erratum, Remove, State
from geartrain.train.validation import declare

__all__ = [
    "AngleError",
    "Axis",
    "Clutch",
    "Dial",
    "Erratum",
    "Expect",
    "GearPair",
    "LengthError",
    "Link",
    "Output",
    "PairMounting",
    "Published",
    "Remove",
    "Revolute",
    "Source",
    "SpeedUnit",
    "State",
    "StateCase",
    "Target",
    "Teeth",
    "Train",
    "View",
    "Wheel",
    "WheelManufacture",
    "declare",
]
