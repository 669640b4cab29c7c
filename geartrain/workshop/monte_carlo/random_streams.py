"""Errors drawn from streams of their own: they depend on the wheel's number, the block and the seed alone.

So a trial is the same in any process and whatever else is computed; errors twice as great are the same errors
doubled; and another clearance is met by the same wheels.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.workshop.cutting.cut_wheel import CutWheel
from geartrain.workshop.cutting.displaced_pair import DisplacedWheel

if TYPE_CHECKING:
    from collections.abc import Callable

    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.workshop.cutting.declared_errors import ErrorSpecification, WheelErrors


BLOCK = 256
"""Trials that are drawn together; results depend on it, so it never changes."""

PITCH_ERROR, ECCENTRICITY, TOWARDS, TIP, FLANK_ANGLE_ERROR, CENTRE_DISTANCE_ERROR, BEARING_CLEARANCE, POSITION = range(
    8
)
FRICTION = 8
NUMBER = {
    "pitch_deviation": PITCH_ERROR,
    "eccentricity": ECCENTRICITY,
    "tip": TIP,
    "aperture_deviation": FLANK_ANGLE_ERROR,
    "centre": CENTRE_DISTANCE_ERROR,
    "bearing": BEARING_CLEARANCE,
}


def _never(item: int, kind: int) -> bool:
    del item, kind
    return False


@dataclass(frozen=True, slots=True)
class RandomStreams:
    """The random numbers of one block of trials."""

    seed: int
    block: int
    other: Callable[[int, int], bool] = field(default=_never)
    """Says of which items and kinds a second, independent set is drawn: for sensitivities."""

    def rng(self, item: int, kind: int) -> np.random.Generator:
        """The stream of one kind of error of one wheel, pair or position."""
        key = (self.block, item, kind, int(self.other(item, kind)))
        # PCG64 by name: what numpy takes by default may change, and trials must not
        return np.random.Generator(np.random.PCG64(np.random.SeedSequence(self.seed, spawn_key=key)))

    def errors(self, item: int, kind: str, off: ErrorSpecification, shape: tuple[int, ...]) -> Floats:
        """Errors as fractions, one for each trial (and tooth)."""
        if off.way == "value":
            return np.full(shape, off.size)
        rng = self.rng(item, NUMBER[kind])
        unit = rng.standard_normal(shape) if off.way == "normal" else rng.uniform(-1.0, 1.0, shape)
        return off.size * unit


def draw_wheel(
    wheel: WheelErrors, item: int, streams: RandomStreams, rows: slice
) -> tuple[CutWheel | DisplacedWheel, Bools]:
    """Some rows of a block of wheels, arrays (trials, z) where drawn, and whether each can be cut (trials,).

    Triangular ones have the tip radius 1, rings -1. Those that cannot be cut are handed back even, so that nothing
    downstream meets teeth without tips.
    """
    # always a whole block, then some rows of it: a trial is the same with whichever others it is worked out
    shape, trials = (BLOCK, wheel.z), rows.stop - rows.start
    zero = np.zeros(wheel.z)

    def drawn(kind: str) -> Floats:
        found = zero + np.asarray(wheel.tables[kind]) if kind in wheel.tables else zero
        return found + streams.errors(item, kind, wheel.errors[kind], shape)[rows] if kind in wheel.errors else found

    # declared errors are ahead and wider; a wheel's arrays are behind and flatter
    place, tip = -wheel.pitch * drawn("pitch_deviation"), wheel.depth * drawn("tip")
    flank = wheel.half_angle * drawn("aperture_deviation")
    eccentric = _eccentric(wheel, item, streams, rows) if "eccentricity" in wheel.errors else None
    if wheel.displaced is not None:
        return _displaced(place, tip, flank, eccentric, trials)
    cut = CutWheel(-1.0 if wheel.ring else 1.0, wheel.half_angle, place, tip, flank, flank)
    if eccentric is not None:
        cut = cut.moved(*eccentric)
    good = np.broadcast_to(cut.cuttable.all(axis=-1), (trials,))
    if good.all():
        return cut, good
    kept = [np.where(good[:, None], each, 0.0) for each in (cut.place, cut.tip, cut.leading, cut.trailing)]
    return CutWheel(cut.radius, wheel.half_angle, *kept), good


def _displaced(
    place: Floats, tip: Floats, flank: Floats, eccentric: tuple[Floats, Floats] | None, trials: int
) -> tuple[DisplacedWheel, Bools]:
    zero = np.zeros(place.shape[-1])
    e, towards = (0.0, 0.0) if eccentric is None else eccentric
    found = DisplacedWheel(place, tip, flank, flank, zero, zero, e, towards)
    good = np.broadcast_to(found.cuttable.all(axis=-1), (trials,))
    return (found if good.all() else replace(found, place=np.where(good[:, None], place, 0.0))), good


def _eccentric(wheel: WheelErrors, item: int, streams: RandomStreams, rows: slice) -> tuple[Floats, Floats]:
    e = wheel.depth * streams.errors(item, "eccentricity", wheel.errors["eccentricity"], (BLOCK,))[rows]
    if wheel.towards is not None:
        return e, np.full(len(e), wheel.towards)
    return e, streams.rng(item, TOWARDS).uniform(0.0, 2 * pi, BLOCK)[rows]


def fitted(wheel: CutWheel, radius: float, half_angle: float, mirrored: bool) -> CutWheel:
    """A wheel of radius 1, or a ring of -1, in the sizes of a pair, and as the pair sees it turn."""
    found = CutWheel(radius, half_angle, wheel.place, abs(radius) * wheel.tip, wheel.leading, wheel.trailing)
    return found.mirrored() if mirrored else found
