"""Tooth forms by name, imported only when a declaration or a command names them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

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
    "table": "GivenError",
}
"""Class name of each tooth form, keyed by the name of the form, which is also the name of its module."""


_GROUP, _PREFIX = "geartrain.wings", "tooth_form."


@cache
def added_forms() -> Mapping[str, EntryPoint]:
    """Return the tooth forms of other distributions, keyed by name. They are the entry points `tooth_form.NAME` in
    `geartrain.wings`.

    Entry points are read only if a name is not in `TOOTH_FORMS` or if all names are listed, because a scan of the
    installed distributions takes longer than most commands.
    """
    from importlib.metadata import entry_points

    found = (each for each in entry_points(group=_GROUP) if each.name.startswith(_PREFIX))
    names = {each.name.removeprefix(_PREFIX): each for each in found}
    return {name: each for name, each in names.items() if name not in TOOTH_FORMS}


def form_names(name: object = None) -> tuple[str, ...]:
    """Return the names of all tooth forms. Names of other distributions are omitted if `name` is in `TOOTH_FORMS`."""
    # a declaration may give any value as a name, also one without a hash
    known = tuple(TOOTH_FORMS)
    return known if name in known else (*known, *added_forms())


def tooth_form(name: str) -> type[ToothForm]:
    """Import the tooth form with the given name, one of `form_names`, and return its class."""
    if name not in TOOTH_FORMS:
        found: type[ToothForm] = added_forms()[name].load()
        return found
    form: type[ToothForm] = getattr(import_module(f"geartrain.teeth.{name}"), TOOTH_FORMS[name])
    return form


def tooth_forms() -> dict[str, type[ToothForm]]:
    """Import all tooth forms and return their classes, keyed by name of the form."""
    return {name: tooth_form(name) for name in form_names()}
