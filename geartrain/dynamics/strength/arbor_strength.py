"""An arbor between two bearings under the forces of its meshes: bending, torsion, pressure on its pivots."""

from __future__ import annotations

from math import pi, sqrt
from typing import TYPE_CHECKING

from geartrain.dynamics.strength.strength_results import ArborStrength

if TYPE_CHECKING:
    from geartrain.train import ArborSizes, Material


def bending_stress(moment: float, diameter: float) -> float:
    """Of a round bar [MPa]: 32 M/(pi d^3), M in N mm and d in mm."""
    return 32 * moment / (pi * diameter**3)


def torsional_stress(torque: float, diameter: float) -> float:
    """Of a round bar [MPa]: 16 T/(pi d^3)."""
    return 16 * torque / (pi * diameter**3)


def arbor_strength(link: str, arbor: ArborSizes, material: Material, force: float, torque: float) -> ArborStrength:
    """Of an arbor under a force [N] in the middle of its span and a torque [N mm]: docs/strength.md (16), (17).

    Where the wheels stand is not known without a layout: the middle bends most, and a pivot bears at most the whole.
    """
    diameter, span = arbor.diameter.si * 1e3, arbor.span.si * 1e3
    pivot = diameter if arbor.pivot is None else arbor.pivot.si * 1e3
    length = pivot if arbor.pivot_length is None else arbor.pivot_length.si * 1e3
    bending, torsion = bending_stress(force * span / 4, diameter), torsional_stress(torque, diameter)
    strength = None if material.strength is None else material.strength.si / 1e6
    return ArborStrength(
        link,
        arbor.material,
        force,
        bending,
        torsion,
        sqrt(bending**2 + 3 * torsion**2),
        force / (pivot * length),
        strength,
    )
