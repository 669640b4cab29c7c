"""A set of gears on a sphere: where their axes point, who meshes with whom, and of which kinds they are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Configuration:
    """Gears with axes through one point. Axes point outwards; angles about them are counterclockwise seen from outside.

    names     of the gears
    axes      unit vectors, (gears, 3)
    meshes    pairs of gears by index
    kinds     of each gear: gears of one kind are alike under the symmetries of the set, and have one tooth number
    regular   of each gear: p where its contacts stand at multiples of a p-th of a turn from each other, exactly; 0
              where their angles are only known in floats
    teeth     tooth number of each kind, as far as they are chosen
    title     for a reader
    """

    names: tuple[str, ...]
    axes: Floats
    meshes: tuple[tuple[int, int], ...]
    kinds: tuple[str, ...]
    regular: tuple[int, ...]
    teeth: Mapping[str, int] = field(default_factory=dict)
    title: str = ""

    def angle(self, i: int, j: int) -> float:
        """Angle between two axes (rad), right near 0 and pi too."""
        a, b = self.axes[i], self.axes[j]
        return float(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))

    def azimuth(self, i: int, j: int) -> float:
        """Direction from gear i to gear j about the axis of i (rad), from an arbitrary but fixed direction of i."""
        first, second = self.frame(i)
        return float(np.arctan2(self.axes[j] @ second, self.axes[j] @ first))

    def frame(self, i: int) -> tuple[Floats, Floats]:
        """Two directions across axis i that make a right-handed frame with it, pointing outwards."""
        n = self.axes[i]
        least = np.eye(3)[int(np.argmin(np.abs(n)))]
        first = np.cross(n, least)
        first /= np.linalg.norm(first)
        return first, np.cross(n, first)
