"""The union of all tooth forms, from which a declaration selects one by `form`."""

from __future__ import annotations

from typing import Annotated, get_args

from pydantic import Field

from geartrain.teeth.circular_arc import CircularArc
from geartrain.teeth.cycloidal import Cycloidal
from geartrain.teeth.ideal import Ideal
from geartrain.teeth.involute import Involute
from geartrain.teeth.lantern import Lantern
from geartrain.teeth.least_friction import LeastFriction
from geartrain.teeth.pin_ring import PinRing
from geartrain.teeth.tooth_form import ToothForm
from geartrain.teeth.triangular import Triangular
from geartrain.teeth.uniform_stress import UniformStress
from geartrain.teeth.uniform_temperature import UniformTemperature

ConjugateForm = Involute | Cycloidal | Lantern | UniformStress | UniformTemperature | LeastFriction
"""Teeth that keep their ratio at every instant at the distance they are made for."""

AnyToothForm = Annotated[Ideal | ConjugateForm | Triangular | CircularArc | PinRing, Field(discriminator="form")]
"""Whatever a declaration may say of the teeth of a pair."""


def tooth_forms() -> dict[str, type[ToothForm]]:
    """Every form by its name, in the order of the union."""
    models: tuple[type[ToothForm], ...] = get_args(get_args(AnyToothForm)[0])
    return {get_args(model.model_fields["form"].annotation)[0]: model for model in models}


__all__ = [
    "CircularArc",
    "Cycloidal",
    "Ideal",
    "Involute",
    "Lantern",
    "LeastFriction",
    "PinRing",
    "Triangular",
    "UniformStress",
    "UniformTemperature",
]
