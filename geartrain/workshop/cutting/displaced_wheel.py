"""A wheel with conjugate teeth cut by hand: each flank where it stands, relative to an even wheel.

Teeth are numbered as they pass the line of centres while the wheel turns forward, as those of `CutWheel`. Lengths are
modules, on cones angles (rad) on the unit sphere.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats

_OF_TEETH = ("place", "tip", "leading", "trailing", "leading_low", "trailing_low")


@dataclass(frozen=True, slots=True)
class DisplacedWheel:
    """Arrays (..., z), leading axes trials; `e` and `towards` one for each trial.

    place                       how far behind its even place a tooth stands (rad)
    tip                         how far a tip stands out
    leading, trailing           by how much the flanks are flatter, turned about their pitch points (rad)
    leading_low, trailing_low   how far the flanks are lowered along their normals
    e, towards                  where the middle of the teeth lies from the axle: how far, and in which direction (rad),
                                counted from the first tooth against the way the wheel turns, as teeth are
    """

    place: Floats
    tip: Floats
    leading: Floats
    trailing: Floats
    leading_low: Floats
    trailing_low: Floats
    e: Any = 0.0
    towards: Any = 0.0

    @classmethod
    def even(cls, z: int) -> DisplacedWheel:
        """A wheel without errors."""
        return cls(*(np.zeros(z) for _ in _OF_TEETH))

    @property
    def z(self) -> int:
        """Tooth number."""
        return int(self.place.shape[-1])

    @property
    def trials(self) -> tuple[int, ...]:
        """Shape of the leading axes: () for one wheel."""
        shapes = (getattr(self, name).shape[:-1] for name in _OF_TEETH)
        return np.broadcast_shapes(*shapes, np.shape(self.e), np.shape(self.towards))

    @property
    def tips(self) -> Floats:
        """How far tips stand out, those of an eccentric wheel with it."""
        if not np.any(self.e):
            return self.tip
        angle = np.arange(self.z) * (2 * pi / self.z) - np.asarray(self.towards)[..., None]
        found: Floats = self.tip + np.asarray(self.e)[..., None] * np.cos(angle)
        return found

    def flanks(self, trailing: bool) -> tuple[Floats, Floats]:
        """How much flatter one side of the teeth is, and how far lower."""
        return (self.trailing, self.trailing_low) if trailing else (self.leading, self.leading_low)

    @property
    def cuttable(self) -> Bools:
        """For each tooth, whether the next stands behind it."""
        found: Bools = np.roll(self.place, -1, -1) - self.place > -2 * pi / self.z
        return found

    def taken(self, part: slice | NDArray[np.int64]) -> DisplacedWheel:
        """Some wheels out of many; an array that all share stays."""
        teeth = {name: getattr(self, name) for name in _OF_TEETH}
        some = {name: each[part] if each.ndim > 1 else each for name, each in teeth.items()}
        e, towards = (each[part] if np.ndim(each) else each for each in (self.e, self.towards))
        return DisplacedWheel(**some, e=e, towards=towards)

    def mirrored(self, first: int = 0) -> DisplacedWheel:
        """The wheel seen from behind, turning the other way; tooth i is tooth `first` - i as it was."""
        order = (first - np.arange(self.z)) % self.z
        return DisplacedWheel(
            -self.place[..., order],
            self.tip[..., order],
            self.trailing[..., order],
            self.leading[..., order],
            self.trailing_low[..., order],
            self.leading_low[..., order],
            self.e,
            first * (2 * pi / self.z) - np.asarray(self.towards),
        )

    def filed(self, leading: Floats, trailing: Floats) -> DisplacedWheel:
        """The wheel with its flanks lowered further."""
        return replace(self, leading_low=self.leading_low + leading, trailing_low=self.trailing_low + trailing)
