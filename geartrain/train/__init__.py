"""The declaration of a train: frozen models, and the checks that need nothing but the declaration itself."""

from __future__ import annotations

from geartrain.train.cutting import AngleError, Cutting, Fitting, LengthError
from geartrain.train.declaration import Case, Train
from geartrain.train.explain import declare, suggest
from geartrain.train.mechanism import Axis, GearPair, Link, Revolute, Source, Teeth, Wheel
from geartrain.train.questions import Dial, Expect, Output, Published, Target, Unit, View
from geartrain.train.running import Clutch, Erratum, Remove, State

__all__ = [
    "AngleError",
    "Axis",
    "Case",
    "Clutch",
    "Cutting",
    "Dial",
    "Erratum",
    "Expect",
    "Fitting",
    "GearPair",
    "LengthError",
    "Link",
    "Output",
    "Published",
    "Remove",
    "Revolute",
    "Source",
    "State",
    "Target",
    "Teeth",
    "Train",
    "Unit",
    "View",
    "Wheel",
    "declare",
    "suggest",
]
