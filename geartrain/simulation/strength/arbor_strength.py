"""An arbor between two bearings under the forces of its meshes: bending, torsion, pressure on pivots and shoulders."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import hypot, pi, sqrt
from typing import TYPE_CHECKING

from geartrain.simulation.strength.strength_results import ArborStrength

if TYPE_CHECKING:
    from geartrain.simulation.strength.contact_results import WheelForce
    from geartrain.train import ArborSizes, Material


def bending_stress(moment: float, diameter: float) -> float:
    """Of a round bar [MPa]: 32 M/(pi d^3), M in N mm and d in mm."""
    return 32 * moment / (pi * diameter**3)


def torsional_stress(torque: float, diameter: float) -> float:
    """Of a round bar [MPa]: 16 T/(pi d^3)."""
    return 16 * torque / (pi * diameter**3)


def greatest_moment(force: float, couple: float, span: float) -> float:
    """Of a bar between two bearings [N mm] under forces and couples, wherever they stand: docs/strength.md (26).

    A force across at x L bends by F L x (1 - x) there, a couple by at most M max(x, 1 - x).

    >>> greatest_moment(10.0, 0.0, 40.0), greatest_moment(0.0, 50.0, 40.0)
    (100.0, 50.0)
    """
    if couple >= force * span:
        return couple
    return (force * span + couple) ** 2 / (4 * force * span)


@dataclass(frozen=True, slots=True)
class ArborLoad:
    """What the wheels of an arbor bear, as bounds: as if all that pulls across pulled one way.

    across   all forces across it [N]
    along    most of what pushes one way along it [N]; `thrust`, what is left for its shoulders
    couple   of the forces along, at their radii [N mm]; `torque` [N mm]
    """

    across: float
    along: float
    thrust: float
    couple: float
    torque: float

    @classmethod
    def of(cls, forces: Iterable[WheelForce], steepest: Mapping[str, float]) -> ArborLoad:
        """Of wheels on one arbor.

        steepest   by pair: the force of one couple that bears all, where that is known [N]
        """
        own = list(forces)
        axial = [each.axial for each in own]
        return cls(
            sum(max(hypot(each.tangential, each.radial or 0.0), steepest.get(each.pair, 0.0)) for each in own),
            max(sum(part for part in axial if part > 0), -sum(part for part in axial if part < 0)),
            abs(sum(axial)),
            sum(abs(each.axial) * each.radius for each in own),
            max((abs(each.torque) * 1e3 for each in own), default=0.0),
        )


def arbor_strength(link: str, arbor: ArborSizes, material: Material, load: ArborLoad) -> ArborStrength:
    """Of an arbor between two bearings, wherever its wheels stand: docs/strength.md (16), (17) and (26)."""
    diameter, span = arbor.diameter.si * 1e3, arbor.span.si * 1e3
    pivot = diameter if arbor.pivot is None else arbor.pivot.si * 1e3
    length = pivot if arbor.pivot_length is None else arbor.pivot_length.si * 1e3
    bending = bending_stress(greatest_moment(load.across, load.couple, span), diameter)
    bending += 4 * load.along / (pi * diameter**2)
    torsion = torsional_stress(load.torque, diameter)
    strength = None if material.strength is None else material.strength.si / 1e6
    shoulder = pi / 4 * (diameter**2 - pivot**2)
    return ArborStrength(
        link,
        arbor.material,
        load.across,
        load.thrust,
        bending,
        torsion,
        sqrt(bending**2 + 3 * torsion**2),
        (load.across + load.couple / span) / (pivot * length),
        load.thrust / shoulder if shoulder > 0 else None,
        strength,
    )
