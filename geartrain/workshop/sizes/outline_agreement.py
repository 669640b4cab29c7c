"""A design of triangular teeth judged by the contact of its drawn outlines, which knows nothing of their law."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, sin
from typing import TYPE_CHECKING

from geartrain.numerics.results import Result
from geartrain.teeth.contact.outline_transmission import OutlineGears, OutlineTransmission
from geartrain.workshop.sizes.size_design import ToothSizes, impact_of

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.contact import GearOutline
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes


_NOTHING = 1e-12  # figures below it are 0 but for rounding
_CELLS, _NODES = 24, 4  # of each smooth stretch of the outlines' law, and the nodes of Gauss in each


@dataclass(frozen=True)
class OutlineAgreement(Result):
    """What the contact of two drawn outlines says of a design, beside what its law says.

    Attributes
    ----------
    loss, error, impact, play : tuple of float
        By the law, and by the outlines; in the units of `ToothSizes`.
    turns : bool
        The outlines turn without a jam and without losing contact.

    See Also
    --------
    find_tooth_sizes : confirms its answer so.
    """

    KEYS = ("turns", "loss", "error", "impact", "play", "difference")

    loss: tuple[float, float]
    error: tuple[float, float]
    impact: tuple[float, float]
    play: tuple[float, float]
    turns: bool

    @property
    def difference(self) -> float:
        """The greatest of the `differences`."""
        return max(self.differences.values())

    @property
    def differences(self) -> Mapping[str, float]:
        """By figure, the difference of the two over the greater of them."""
        pairs = {"loss": self.loss, "error": self.error, "impact": self.impact, "play": self.play}
        return {name: abs(a - b) / max(abs(a), abs(b), _NOTHING) for name, (a, b) in pairs.items()}


def outline_law(sizes: TriangularSizes, friction: float) -> OutlineTransmission:
    """The law of the drawn outlines of a pair, its first wheel driving."""
    first = _outline(sizes.z1, sizes.R1, sizes.beta1, sizes.flanks[0], sizes.ring == 1)
    second = _outline(sizes.z2, sizes.R2, sizes.beta2, sizes.flanks[1], sizes.ring == 2)
    # teeth drawn about their middles: the driven angle is counted from there, and nothing is added to the play
    return OutlineTransmission(OutlineGears(first, second, sizes.D, 0.0, 0.0), friction)


def confirm_by_outlines(design: ToothSizes) -> OutlineAgreement:
    """Whether the outlines of a design that turns do what its law says."""
    law = outline_law(design.sizes, design.friction)
    low, high = law.error_range()
    return OutlineAgreement(
        (design.loss, 1 - _mean_efficiency(law)),
        (design.error, high - low),
        (design.impact, impact_of(law)),
        (design.play, law.verdict.play),
        bool(law.verdict),
    )


def _mean_efficiency(law: OutlineTransmission) -> float:
    """Mean over the driver's angle, in cells so small that the corner at the line of centres is in one of many."""
    import numpy as np

    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    breaks = law.table.breaks
    low, high = breaks[:-1, None], breaks[1:, None]
    edges = low + (high - low) * np.linspace(0, 1, _CELLS + 1)
    middle, half = (edges[:, 1:] + edges[:, :-1]) / 2, np.diff(edges) / 2
    found = law.efficiency((middle[..., None] + half[..., None] * nodes).ravel())
    return float(found @ (half[..., None] * weights).ravel()) / float(breaks[-1] - breaks[0])


def _outline(z: int, R: float, beta: float, length: float, ring: bool) -> GearOutline:
    """A wheel of teeth with straight flanks from tips at R, inwards or, of a ring, outwards."""
    import numpy as np

    from geartrain.teeth.contact import GearOutline, OutlineCurve, ToothFlanks

    def points(s: Floats) -> Floats:
        return np.stack([s * sin(beta), R + (s if ring else -s) * cos(beta)], axis=1)

    return GearOutline((ToothFlanks.symmetric((OutlineCurve(points, 0.0, length),)),), z, ring=ring)
