"""Two cut wheels on their axles: which tooth meets which, with what sizes.

Couple k joins tooth k of the driver to tooth k of the driven wheel, both counted on through all turns; after
lcm(z1, z2) couples the same teeth meet again. Its driver's leading flank pushes the driven trailing flank.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import gcd
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.uncertainty.cutting.couples import Couples
from geartrain.uncertainty.cutting.wheel import CutWheel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.meshes import Mesh
    from geartrain.teeth.triangular.law import TriangularLaw
    from geartrain.teeth.triangular.sizes import Sizes

    Floats = NDArray[np.float64]
    Bools = NDArray[np.bool_]

ROUNDING = 1e-11  # of a pitch: what is less is none


def sizes_of(pair: Sizes | TriangularLaw | Mesh) -> Sizes:
    """The sizes of a pair, of its law, or of a mesh of a train. Raises `RangeError` for teeth of another form."""
    from geartrain.teeth.triangular.law import TriangularLaw
    from geartrain.teeth.triangular.sizes import Sizes

    law = getattr(pair, "law", pair)
    if isinstance(law, TriangularLaw):
        return law.sizes
    if isinstance(law, Sizes):
        return law
    raise RangeError(
        Problem(
            f"{getattr(pair, 'label', 'this pair')} has no triangular teeth",
            "cutting errors are reckoned tooth by tooth for straight flanks that meet in a point",
            "declare `tooth_form: {form: triangular, ...}`",
        )
    )


@dataclass(frozen=True)
class CutPair:
    """Two cut wheels, the first driving, and their centre distance; `sizes` are those without errors.

    shift   by how much the centre distance is greater (as the radii): one, or one for each trial
    """

    sizes: Sizes
    first: CutWheel
    second: CutWheel
    shift: Any = 0.0

    @cached_property
    def count(self) -> int:
        """Couples in a full cycle of teeth."""
        return self.sizes.z1 * self.sizes.z2 // gcd(self.sizes.z1, self.sizes.z2)

    @cached_property
    def trials(self) -> tuple[int, ...]:
        """Shape of the trials: () for one pair."""
        return np.broadcast_shapes(self.first.trials, self.second.trials, np.shape(self.shift))

    def couples(self, k: Any, of_driven: Any = None) -> Couples:
        """Couples k, counted on through all turns; `of_driven` numbers the driven teeth where they are others."""
        i = k % self.sizes.z1
        j = (k if of_driven is None else of_driven) % self.sizes.z2
        one, two, sizes = self.first, self.second, self.sizes
        shift = self.shift if np.ndim(self.shift) == 0 else np.asarray(self.shift)[..., None]
        tips = one.tip[..., i] + two.tip[..., j]
        return Couples(
            sizes.R1 + one.tip[..., i],
            sizes.R2 + two.tip[..., j],
            sizes.beta1 + one.leading[..., i],
            sizes.beta2 + two.trailing[..., j],
            sizes.D + shift,
            sizes.delta + tips - shift,
        )

    def places(self, k: Any) -> tuple[Floats, Floats]:
        """How late the two teeth of couples k are (rad, each of its own wheel)."""
        return self.first.place[..., k % self.sizes.z1], self.second.place[..., k % self.sizes.z2]

    @cached_property
    def mirrored(self) -> CutPair:
        """The pair that turns the other way: its couple -k is the driver's tooth k ahead of the driven tooth k + 1.

        Where its first contact is U', the back flanks here are met at L(t) = -U'(-t) - p2.
        """
        return CutPair(self.sizes, self.first.mirrored(), self.second.mirrored(1), self.shift)

    @cached_property
    def widest(self) -> float:
        """No couple reaches farther (rad of the driver); -inf where none touches."""
        one, two, sizes = self.first, self.second, self.sizes
        least = float(np.min(self.shift))
        tips = float(one.tip.max()) + float(two.tip.max())
        R1, R2 = sizes.R1 + float(one.tip.min()), sizes.R2 + float(two.tip.max())
        farthest = Couples(R1, R2, sizes.beta1, sizes.beta2, sizes.D + least, sizes.delta + tips - least)
        return float(farthest.reach)

    @cached_property
    def leans(self) -> Bools:
        """For each trial, whether a flank leans beyond the perpendicular where the tips of its couple meet."""
        k = np.arange(self.count)
        both = [np.atleast_2d(each.leaning).any(axis=1) for each in (self.couples(k), self.mirrored.couples(k))]
        found: Bools = np.broadcast_to(both[0] | both[1], self.trials or (1,)).copy()
        return found

    def checked(self) -> CutPair:
        """The pair itself. Raises `RangeError` where a flank leans beyond the perpendicular where tips meet."""
        if self.leans.any():
            raise RangeError(
                Problem(
                    "a flank leans beyond the perpendicular where tips meet",
                    "few, deep or blunt teeth do so; which of their couples touches first is then no longer known "
                    "tooth by tooth",
                    "use more teeth, a smaller half_angle or a greater centre distance",
                )
            )
        return self
