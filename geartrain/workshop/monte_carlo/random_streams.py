"""Random errors of wheels from independent streams, each keyed by seed, block, wheel and kind of error.

A trial therefore has the same errors in any process, whatever else is computed. Errors scaled by a factor are the same
random numbers times that factor, and a study of clearances uses the same wheels at every clearance.
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass, replace
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.workshop.cutting.cut_wheel import CutWheel
from geartrain.workshop.cutting.displaced_pair import DisplacedWheel

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.workshop.cutting.declared_errors import ErrorSpecification, WheelErrors


BLOCK = 256
"""Number of trials that are drawn together. Results depend on it, so it must never change."""

NUMBER = {"pitch_deviation": 0, "eccentricity": 1, "tip": 3, "aperture_deviation": 4, "centre": 5, "bearing": 6}
"""Number of the random stream of each kind of error. Results depend on these numbers, so they must never change."""
TOWARDS, POSITION, FRICTION = 2, 7, 8
"""Numbers of the streams of the direction of an eccentricity, the position of the input, and friction."""
Streams = tuple[Container[int], Container[int]]
EVERY = range(1 << 31)
"""All numbers of wheels and pairs, or of kinds of error."""


@dataclass(frozen=True, slots=True)
class RandomStreams:
    """Random number generators of one block of trials."""

    seed: int
    block: int
    other: Streams = ((), ())
    """Items (wheels or pairs) and kinds of error drawn from the second, independent sample of Sobol indices."""

    def rng(self, item: int, kind: int) -> np.random.Generator:
        """Return the generator for one kind of error of one wheel or pair, or for the position of the input."""
        key = (self.block, item, kind, int(item in self.other[0] and kind in self.other[1]))
        # PCG64 by name: numpy's default generator may change, and results must not
        return np.random.Generator(np.random.PCG64(np.random.SeedSequence(self.seed, spawn_key=key)))

    def errors(self, item: int, kind: str, off: ErrorSpecification, shape: tuple[int, ...]) -> Floats:
        """Return random errors as fractions, in an array of shape (trials,) or (trials, teeth)."""
        if off.way == "value":
            return np.full(shape, off.size)
        rng = self.rng(item, NUMBER[kind])
        unit = rng.standard_normal(shape) if off.way == "normal" else rng.uniform(-1.0, 1.0, shape)
        return off.size * unit


def draw_wheel(
    wheel: WheelErrors, item: int, streams: RandomStreams, rows: slice
) -> tuple[CutWheel | DisplacedWheel, Bools]:
    """Return one wheel drawn in some trials of a block, and a mask of the trials in which it can be cut.

    Pitch deviations and drawn arrays have shape (trials, z), the mask (trials,). Triangular wheels have tip radius 1,
    internal ones -1. In trials in which a wheel cannot be cut, its teeth are returned without errors (displaced flanks:
    without pitch deviations), so that later code never meets teeth without tips.
    """
    # a whole block is drawn and then sliced, so that a trial does not depend on the trials computed with it
    shape, trials = (BLOCK, wheel.z), rows.stop - rows.start
    zero = np.zeros(wheel.z)

    def drawn(kind: str) -> Floats:
        found = zero + np.asarray(wheel.tables[kind]) if kind in wheel.tables else zero
        return found + streams.errors(item, kind, wheel.errors[kind], shape)[rows] if kind in wheel.errors else found

    # signs: declared errors are positive ahead and wider, the arrays of a wheel positive behind and flatter
    place = np.broadcast_to(-wheel.pitch * drawn("pitch_deviation"), (trials, wheel.z))
    tip = wheel.depth * drawn("tip")
    flank = wheel.half_angle * drawn("aperture_deviation")
    eccentric = _draw_eccentricity(wheel, item, streams, rows) if "eccentricity" in wheel.errors else None
    if wheel.displaced is not None:
        made = DisplacedWheel(place, tip, flank, flank, zero, zero, *(eccentric or (0.0, 0.0)))
        good = made.cuttable.all(axis=-1)
        return replace(made, place=np.where(good[:, None], place, 0.0)), good
    cut = CutWheel(-1.0 if wheel.ring else 1.0, wheel.half_angle, place, tip, flank, flank)
    if eccentric is not None:
        cut = cut.moved(*eccentric)
    good = cut.cuttable.all(axis=-1)
    if good.all():
        return cut, good
    # perfect teeth replace those that cannot be cut; these trials are flagged and not counted
    kept = [np.where(good[:, None], each, 0.0) for each in (cut.place, cut.tip, cut.leading, cut.trailing)]
    return CutWheel(cut.radius, wheel.half_angle, *kept), good


def _draw_eccentricity(wheel: WheelErrors, item: int, streams: RandomStreams, rows: slice) -> tuple[Floats, Floats]:
    e = wheel.depth * streams.errors(item, "eccentricity", wheel.errors["eccentricity"], (BLOCK,))[rows]
    if wheel.towards is not None:
        return e, np.full(len(e), wheel.towards)
    return e, streams.rng(item, TOWARDS).uniform(0.0, 2 * pi, BLOCK)[rows]


def fitted(wheel: CutWheel, radius: float, half_angle: float, mirrored: bool) -> CutWheel:
    """Return a wheel of tip radius 1 (internal: -1) scaled to the sizes of its pair.

    It is mirrored if it turns against the numbering of its teeth.
    """
    found = CutWheel(radius, half_angle, wheel.place, abs(radius) * wheel.tip, wheel.leading, wheel.trailing)
    return found.mirrored() if mirrored else found
