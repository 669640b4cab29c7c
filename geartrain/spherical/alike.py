"""What is alike in a set on a sphere: kinds of gear, kinds of mesh, and how near gears come that do not mesh."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, inf
from typing import TYPE_CHECKING

import numpy as np

from geartrain.spherical.cones import mesh_angles, separations
from geartrain.spherical.configuration import Configuration

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


def kinds_in_order(configuration: Configuration) -> tuple[str, ...]:
    """The kinds of gear, each once, in the order of their first gears."""
    return tuple(dict.fromkeys(configuration.kinds))


def mesh_kinds(configuration: Configuration) -> tuple[MeshKind, ...]:
    """Kinds of mesh, in the order of their gears' kinds; meshes are alike to 1e-9 rad."""
    order = {kind: at for at, kind in enumerate(kinds_in_order(configuration))}
    groups: dict[tuple[int, int, int], list[int]] = {}
    angles = mesh_angles(configuration.axes, configuration.meshes)
    for at, (i, j) in enumerate(configuration.meshes):
        a, b = sorted((order[configuration.kinds[i]], order[configuration.kinds[j]]))
        # the nearest slot or its neighbour: angles on a slot's edge must not be parted by rounding
        slot = round(float(angles[at]) * 1e9)
        key = next((found for near in (slot, slot - 1, slot + 1) if (found := (a, b, near)) in groups), (a, b, slot))
        groups.setdefault(key, []).append(at)
    names = tuple(order)
    return tuple(
        MeshKind(names[a], names[b], float(angles[found[0]]), tuple(found))
        for (a, b, _), found in sorted(groups.items())
    )


def nearest_strangers(configuration: Configuration) -> dict[tuple[str, str], float]:
    """Least angle (rad) between gears that do not mesh, for each pair of kinds, in both orders."""
    apart = strangers(configuration)
    kinds = np.array(configuration.kinds)
    found: dict[tuple[str, str], float] = {}
    for a in kinds_in_order(configuration):
        rows = apart[kinds == a].min(axis=0)
        for b in kinds_in_order(configuration):
            least = float(rows[kinds == b].min())
            if least < inf:
                found[a, b] = least
    return found


def strangers(configuration: Configuration) -> Floats:
    """Angles between all axes, inf for a gear and itself and for gears that mesh."""
    apart = separations(configuration.axes)
    np.fill_diagonal(apart, inf)
    if configuration.meshes:
        i, j = np.array(configuration.meshes).T
        apart[i, j] = apart[j, i] = inf
    return apart


@dataclass(frozen=True)
class MeshKind:
    """Meshes that are alike: the kinds of their two gears, the angle between the axes (rad), and which they are."""

    a: str
    b: str
    angle: float
    meshes: tuple[int, ...]

    def __str__(self) -> str:
        return f"{self.a}-{self.b} at {degrees(self.angle):.6f} deg"
