"""Checks whether a train can be built, based on its declaration and on the declared tooth forms."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError
from geartrain.kinematics.buildability.build_check import check_build

if TYPE_CHECKING:
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.kinematics.buildability import BuildFinding
    from geartrain.kinematics.buildability.pitch_distances import PairOutline
    from geartrain.train import Train


def find_build_findings(train: TrainMechanics) -> tuple[BuildFinding, ...]:
    """Return all findings on parts that cannot be built, and on parts whose design is inadvisable
    (docs/buildability.md).
    """
    cuts = _cuts_teeth(train.declaration)
    found = tuple(check_build(train.declaration, train.tree, train.circuits, lambda: _outlines(train) if cuts else {}))
    if not cuts:
        return found
    from geartrain.dynamics.cut_teeth import find_inconsistent_wheels

    return (*found, *find_inconsistent_wheels(train))


def _cuts_teeth(declared: Train) -> bool:
    """Return True if a gear pair has a declared tooth form and numpy is installed."""
    # only tooth forms need numpy; other declarations are checked without it
    return any(map(declared.form_of, declared.gears)) and find_spec("numpy") is not None


def _outlines(train: TrainMechanics) -> Mapping[str, PairOutline]:
    from geartrain.dynamics.gear_meshes import find_outlines

    try:
        return find_outlines(train.teeth)
    except GearTrainError:  # teeth that cannot be built are reported by another rule
        return {}
