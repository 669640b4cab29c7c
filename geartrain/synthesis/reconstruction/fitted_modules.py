"""One module for wheels in mesh, from what was measured on each of them, so that a candidate can be built and drawn."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from geartrain.synthesis.reconstruction.named_train import NamedArbor
from geartrain.synthesis.reconstruction.surviving_geometry import SurvivingGeometry


def fit_modules(train: NamedArbor, geometry: SurvivingGeometry) -> dict[str, float | None]:
    """The module (mm) to be declared of every measured wheel but those whose measured module stands.

    Wheels that mesh share one module: the first that was measured gets the geometric mean of what was, and None stands
    for its mates, which follow from it. None stands for all of them where the places of two axes in mesh decide.
    """
    mates = _meshing(train)
    placed = {
        mates[wheel.name]
        for arbor, wheel, driven in train.meshes()
        if arbor.name in geometry.places and driven.name in geometry.places
    }
    measured: dict[str, dict[str, float]] = {}
    for wheel in (wheel for arbor in train.arbors() for wheel in arbor.wheels()):
        module = geometry.module_of((None if wheel.added else wheel.name, wheel.teeth))
        if module is not None:
            measured.setdefault(mates[wheel.name], {})[wheel.name] = math.log(module)
    found: dict[str, float | None] = {}
    for group, logs in measured.items():
        if group not in placed and len(logs) == 1 and geometry.measured[next(iter(logs))].is_module:
            continue
        found |= dict.fromkeys(logs)
        if group not in placed:
            found[next(iter(logs))] = math.exp(sum(logs.values()) / len(logs))
    return found


def with_module(declared: Mapping[str, Any], measured: str, module: float | None) -> dict[str, Any]:
    """A declared wheel with the module that it is to have, and a note of what was measured where that differs.

    measured   what the evidence says of it, such as "module 0.455 mm"
    module     in mm; None where it follows from others
    """
    text = "" if module is None else f"{module:.4g} mm"
    found = {key: value for key, value in declared.items() if key != "module"} | ({"module": text} if text else {})
    if measured == f"module {text}":
        return found
    said = f"measured {measured}"
    return found | {"note": f"{declared['note']}; {said}" if declared.get("note") else said}


def _meshing(train: NamedArbor) -> dict[str, str]:
    """Of every wheel the first of those that share its module."""
    first: dict[str, str] = {}
    for _, wheel, arbor in train.meshes():
        assert arbor.driven is not None
        first[arbor.driven.name] = first.setdefault(wheel.name, wheel.name)
    return first
