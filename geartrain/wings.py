"""Access to wings: packages of large capabilities, which the core of geartrain knows only by name.

The core of geartrain (declaration, kinematics, dynamics, tooth forms, scenes, reports) imports no wing. Where one of
its commands offers what a wing adds, it asks `wing` for the public names of that wing, when they are needed.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from geartrain.errors import GearTrainError, Problem

WINGS = ("search", "workshop", "simulation")
"""Packages of geartrain that can be left out of an installation."""


def has_wing(name: str) -> bool:
    """True if the wing `name` is installed."""
    return find_spec(f"geartrain.{name}") is not None


def wing(name: str) -> Any:
    """The package `geartrain.NAME`, or a module of it such as "simulation.time.time_run".

    Raises
    ------
    GearTrainError
        If this installation has no such package.
    """
    package = name.partition(".")[0]
    if not has_wing(package):
        what = f"this needs the package geartrain.{package}"
        raise GearTrainError(Problem(what, "this installation of geartrain lacks it", "install the whole of geartrain"))
    return import_module(f"geartrain.{name}")


@dataclass(frozen=True)
class WingResult:
    """Annotation of a field that holds a result of a wing: `Annotated[Any, WingResult("simulation", "TimeRun")]`."""

    wing: str
    """Name of the wing."""
    name: str
    """Public name of the class of the result in that wing."""

    def kind(self) -> type | None:
        """The class; None if the wing is not installed."""
        return getattr(wing(self.wing), self.name) if has_wing(self.wing) else None
