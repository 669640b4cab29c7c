"""Conjugate teeth at a centre distance they were not made for: their law, from the contact of their outlines.

The flanks are those of the design, each continued straight beneath its last designed contact; tips end where the design
ends them. Only spur teeth have a centre distance.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
from geartrain.teeth.contact.gear_outline import GearOutline, ToothFlanks
from geartrain.teeth.contact.outline_curve import OutlineCurve
from geartrain.teeth.outline_transmission import OutlineGears, OutlineTransmission

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact

_STRAIGHT = 0.5  # modules of root beneath a flank, and not beyond a third of the way to the axle


class OffDesignTransmission(OutlineTransmission):
    """The law of a pair whose axles are `distance` modules apart; the rest as in `ConjugateTransmission`."""

    def __init__(
        self, pair: ConjugatePair, distance: float, friction: float = 0.0, driver: int = 1, direction: int = 1
    ) -> None:
        self.pair, self.path = pair, pair.path
        super().__init__(_gears(pair, distance), friction, driver, direction)

    @property
    def reversed(self) -> OffDesignTransmission:
        """The law with the other wheel driving."""
        return OffDesignTransmission(self.pair, self.distance, self.friction, 3 - self.driver, self.direction)

    def turned_back(self) -> OffDesignTransmission:
        """The law of the other flanks; angles keep their sense and decrease."""
        return OffDesignTransmission(self.pair, self.distance, self.friction, self.driver, -self.direction)


@lru_cache(maxsize=64)
def _gears(pair: ConjugatePair, distance: float) -> OutlineGears:
    """Made once, so that what is found of it is."""
    return OutlineGears(*outlines(pair), distance, sum(pair.halves), pair.play, pair.faults)


@lru_cache(maxsize=64)
def outlines(pair: ConjugatePair) -> tuple[GearOutline, GearOutline]:
    """Both wheels of a spur pair, in modules."""
    pitch = pair.path.pitch
    return _outline(pair, 1, int(pitch.z1), pitch.R1), _outline(pair, 2, int(pitch.z2), pitch.R2)


def _outline(pair: ConjugatePair, gear: int, z: int, R: float) -> GearOutline:
    """One wheel: the side that its driver, or its driven wheel, touches, and its mirror image."""
    half = pair.halves[gear - 1] / abs(R)
    turn = np.exp(-1j * half)

    def flank(X: Floats) -> Floats:
        points = _body(pair.path, gear, X)
        place = (points[:, 0] + 1j * points[:, 1]) * turn
        return np.stack([place.real, place.imag], axis=1)

    foot, tip = pair.path.ends(gear)
    cuts = sorted({0.0, foot, tip, *_joints(pair.path)}, reverse=foot > tip)
    curves = [OutlineCurve(flank, a, b) for a, b in pairwise(cuts)]
    return GearOutline((ToothFlanks.symmetric((_straight(flank, foot, tip), *curves)),), z, ring=R < 0)


def _body(path: PathOfContact, gear: int, X: Floats) -> Floats:
    """Points of a flank from the wheel's axle: x towards the space that the tooth leads into, y outwards."""
    points = path.flank(gear, X)
    if gear == 1:
        return np.asarray(points + np.array([0.0, path.pitch.R1]))
    R = path.pitch.R2
    return np.stack([-points[:, 0], abs(R) - points[:, 1] * np.sign(R)], axis=1)


def _joints(path: PathOfContact) -> list[float]:
    """X at the ends of the pieces of a path."""
    ends = ((-1.0, path.approach), (1.0, path.recess))
    return [sign * float(side.travel(np.array(d))) for sign, side in ends for d in side.joints]


def _straight(flank: object, foot: float, tip: float) -> OutlineCurve:
    """The root: straight on from the foot of a flank."""
    assert callable(flank)
    # near enough for the tangent, far enough that the difference is not rounding
    start, near = flank(np.array([foot, foot + 1e-4 * (tip - foot)]))
    way = start - near
    length = min(_STRAIGHT, float(np.hypot(*start)) / 3)
    end = start + way / np.hypot(*way) * length
    return OutlineCurve(lambda t: end + t[:, None] * (start - end))
