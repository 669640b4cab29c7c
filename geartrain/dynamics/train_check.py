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


def find_build_findings(train: TrainMechanics) -> tuple[BuildFinding, ...]:
    """Return all findings on parts that cannot be built or whose design is inadvisable (docs/buildability.md)."""
    declared = train.declaration
    # only tooth forms need numpy; other declarations are checked without it
    if not any(map(declared.form_of, declared.gears)) or find_spec("numpy") is None:
        return tuple(check_build(declared, train.tree, train.circuits))
    from geartrain.dynamics.cut_teeth import find_inconsistent_wheels
    from geartrain.dynamics.gear_meshes import find_outlines

    def outlines() -> Mapping[str, PairOutline]:
        try:
            return find_outlines(train.teeth)
        except GearTrainError:  # teeth that cannot be built are reported by another rule
            return {}

    return (*check_build(declared, train.tree, train.circuits, outlines), *find_inconsistent_wheels(train))
