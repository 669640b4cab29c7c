"""Cut teeth, their pair and its ways of jamming as kernels read them, and what lies between couples."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from geartrain.numerics.kernels import kernel
from geartrain.uncertainty.manufacturing_errors.couple_kernel import CutCouple

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


class ToothArrays(NamedTuple):
    """The teeth of one wheel, (trials, z) each: places (rad), heights of tips, and flanks.

    lead, trail   sine and cosine of the half angles of both flanks, (trials, z, 2)
    flatter       by how much both are flatter than without errors (rad), (trials, z, 2)
    """

    place: Floats
    tip: Floats
    lead: Floats
    trail: Floats
    flatter: Floats


class CutPairSizes(NamedTuple):
    """A pair as designed, and the couples of its cycle; `side` is -1 for an internal pair.

    The radius of a ring and the centre distance of an internal pair are negative.
    """

    z1: int
    z2: int
    couples: int
    R1: float
    R2: float
    D: float
    delta: float
    p1: float
    p2: float
    side: int


class JamCandidates(NamedTuple):
    """Ways of jamming of even wheels, the nearest first: front couples, and back couples `n` before them.

    phase1, phase2   of the front and the back couple: 1 in approach, 0 in recess
    offset, play     where they come nearest, from half of n pitches, and the play there (rad)
    slopes           (ways, 2, 6): by how much errors of front and back couple change it, to first order: heights of
                     driver's and driven tip, flatter flanks of both, centre distance, driver's angle
    """

    n: Ints
    phase1: Ints
    phase2: Ints
    offset: Floats
    play: Floats
    slopes: Floats


@kernel
def couple_of(row: Floats) -> CutCouple:
    return CutCouple(row[0], row[1], row[2], row[3], row[4], row[5], row[6], row[7], row[8], row[9], row[10])


@kernel
def ahead_of(sizes: CutPairSizes, n: int, k: int, driver: Floats) -> float:
    """How far the driver's tooth of couple k is behind that n couples before (rad)."""
    found: float = n * sizes.p1 + (driver[k % sizes.z1] - driver[(k - n) % sizes.z1])
    return found


@kernel
def apart_of(sizes: CutPairSizes, n: int, k: int, driven: Floats) -> float:
    """How far the driven tooth of couple k is behind that n couples before (rad)."""
    found: float = n * sizes.p2 + (driven[k % sizes.z2] - driven[(k - n) % sizes.z2])
    return found


@kernel
def stop_of(sizes: CutPairSizes, n: int, k: int, driven: Floats) -> float:
    """What the driven teeth add to the play of couple k and the back couple n before."""
    found: float = (1 - n) * sizes.p2 + (driven[(k - n + 1) % sizes.z2] - driven[k % sizes.z2])
    return found
