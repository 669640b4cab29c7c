"""Access to the optional packages ("wings") of geartrain, which its core imports only by name.

The core of geartrain (declaration, kinematics, dynamics, tooth forms, scenes, reports) imports no wing. Commands that
use a wing import it at run time with the function `wing`.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from geartrain.errors import GearTrainError, Problem

WINGS = ("search", "workshop", "simulation")
"""Packages of geartrain that can be omitted from an installation."""


def has_wing(name: str) -> bool:
    """Return True if an optional package, or the package of a module such as "simulation.time", is installed."""
    # `find_spec` does not import the package
    return find_spec(f"geartrain.{name.partition('.')[0]}") is not None


def wing(name: str) -> Any:
    """Import the module `geartrain.NAME`, where NAME is an optional package or a module in it, such as
    "simulation.time.time_run".

    Raises
    ------
    GearTrainError
        If this installation has no such package.
    """
    package = name.partition(".")[0]
    if not has_wing(name):
        what = f"the optional package geartrain.{package} is not installed"
        raise GearTrainError(
            Problem(what, "this feature needs it", "reinstall geartrain, because this copy is incomplete")
        )
    return import_module(f"geartrain.{name}")


@dataclass(frozen=True)
class WingResult:
    """Annotation of a field that contains the result of an optional package: `Annotated[Any, WingResult("simulation",
    "TimeRun")]`.
    """

    wing: str
    """Name of the optional package, or of a module in it."""
    name: str
    """Name of the result's class."""

    def kind(self) -> type | None:
        """Import and return the class of the result; None if the optional package is not installed."""
        return getattr(wing(self.wing), self.name) if has_wing(self.wing) else None
