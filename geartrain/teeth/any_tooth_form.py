"""Tooth forms by name, imported only when a declaration or a command names them."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geartrain.teeth.tooth_form import ToothForm

TOOTH_FORMS = {
    "ideal": "Ideal",
    "involute": "Involute",
    "cycloidal": "Cycloidal",
    "lantern": "Lantern",
    "uniform_stress": "UniformStress",
    "uniform_temperature": "UniformTemperature",
    "least_friction": "LeastFriction",
    "triangular": "Triangular",
    "circular_arc": "CircularArc",
    "pin_ring": "PinRing",
    "table": "Table",
}
"""Class name of each tooth form by its name in declarations, which is also the name of its module."""


def tooth_form(name: str) -> type[ToothForm]:
    """Import a tooth form by its name, a key of `TOOTH_FORMS`, and return its class."""
    form: type[ToothForm] = getattr(import_module(f"geartrain.teeth.{name}"), TOOTH_FORMS[name])
    return form


def tooth_forms() -> dict[str, type[ToothForm]]:
    """Import all tooth forms and return their classes by name."""
    return {name: tooth_form(name) for name in TOOTH_FORMS}
