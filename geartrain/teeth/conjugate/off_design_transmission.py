"""Conjugate teeth at a centre distance other than their design distance.

The transmission function follows from the contact of both outlines. These are the flanks of the design, each continued
straight beneath its last designed contact.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.contact.gear_outline import GearOutline, OutlineCurve, ToothFlanks
from geartrain.teeth.contact.outline_transmission import OutlineGears, OutlineTransmission

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair

_STRAIGHT = 0.5  # modules of root beneath a flank, at most a third of its radius


class OffDesignTransmission(OutlineTransmission):
    """Transmission function of a conjugate pair at a centre distance other than its design distance.

    Parameters
    ----------
    pair : ConjugatePair
        Pair at its design distance.
    distance : float
        Centre distance [module].
    friction, driver, direction
        As in `ConjugateTransmission`.

    See Also
    --------
    geartrain.teeth.Involute : Like every conjugate form, it has a method `transmission` that returns such a function.
    """

    def __init__(
        self, pair: ConjugatePair, distance: float, friction: float = 0.0, driver: int = 1, direction: int = 1
    ) -> None:
        self.pair, self.path = pair, pair.path
        super().__init__(_outline_gears(pair, distance), friction, driver, direction)

    def _driven(self, driver: int, direction: int) -> OffDesignTransmission:
        return OffDesignTransmission(self.pair, self.distance, self.friction, driver, direction)


@lru_cache(maxsize=64)
def _outline_gears(pair: ConjugatePair, distance: float) -> OutlineGears:
    """Return the outlines of a pair at a centre distance [module], cached together with their contact."""
    return OutlineGears(*pair_outlines(pair), distance, sum(pair.halves), pair.backlash, pair.faults)


@lru_cache(maxsize=64)
def pair_outlines(pair: ConjugatePair) -> tuple[GearOutline, GearOutline]:
    """Return the outlines of both wheels of a spur pair, for `geartrain.teeth.contact`.

    Parameters
    ----------
    pair : ConjugatePair
        Pair at its design distance.

    Returns
    -------
    tuple of GearOutline
        Outlines of gear 1 and gear 2, lengths in modules. Below the active flanks the roots are straight.

    Examples
    --------
    Two involute wheels run without transmission error at a distance larger than the design distance of 30 modules.

    >>> import numpy as np
    >>> from geartrain.teeth import Involute
    >>> from geartrain.teeth.conjugate import WheelPair
    >>> from geartrain.teeth.contact import solve
    >>> wheels = pair_outlines(Involute(form="involute").pair(WheelPair(24, 36)))
    >>> found = solve(*wheels, 30.2, np.linspace(0.0, 0.2, 5))
    >>> bool(np.ptp(found.front.speed) < 1e-9)
    True
    """
    pitch = pair.path.pitch
    return _outline(pair, 1, int(pitch.z1), pitch.R1), _outline(pair, 2, int(pitch.z2), pitch.R2)


def _outline(pair: ConjugatePair, gear: int, z: int, R: float) -> GearOutline:
    turn = np.exp(-1j * pair.halves[gear - 1] / abs(R))

    def flank(X: Floats) -> Floats:
        x, y = pair.path.flank(gear, X).T
        # in the frame of the wheel, x points towards the tooth space ahead and y outwards
        place = (x + 1j * (y + R) if gear == 1 else -x + 1j * (abs(R) - y * np.sign(R))) * turn
        return np.stack([place.real, place.imag], axis=1)

    foot, tip = pair.path.ends(gear)
    # the root is straight: the tangent at the lower end of the active flank, from a difference that exceeds rounding
    start, near = flank(np.array([foot, foot + 1e-4 * (tip - foot)]))
    way = start - near
    end = start + way / np.hypot(*way) * min(_STRAIGHT, float(np.hypot(*start)) / 3)
    root = OutlineCurve(lambda t: end + t[:, None] * (start - end))
    cuts = sorted({0.0, foot, tip, *pair.path.joints}, reverse=foot > tip)
    curves = [OutlineCurve(flank, a, b) for a, b in pairwise(cuts)]
    return GearOutline((ToothFlanks.symmetric((root, *curves)),), z, ring=R < 0)
