"""A pair whose chance of a jam is a finite sum."""

from __future__ import annotations

from math import comb

import numpy as np
from numpy.typing import NDArray

from geartrain.bench.uncertainty_pairs import sized
from geartrain.uncertainty.manufacturing_errors import CutWheel, nominal_backlash
from geartrain.uncertainty.manufacturing_errors.cut_pair import CutGearPair

SHARE = 0.88
"""The play over the greatest difference of two driven places."""


def chance_of_jam(z: int, share: float) -> float:
    """Chance that, of z independent uniform numbers on 0..1 in a circle, one exceeds the one before by `share`.

    With a share of 1/2 or more two such steps never follow each other, and steps that do not are independent, each
    of chance q = (1 - share)^2 / 2. So the chance that there is none is the sum of (-q)^k over the ways to choose k
    steps of the circle that do not touch, z / (z - k) (z - k choose k) of them.
    """
    if not 0.5 <= share <= 1 or z < 3:
        raise ValueError("steps are rare only for a share from 1/2 to 1, in a circle of 3 or more")
    q = (1 - share) ** 2 / 2
    return -sum(z * comb(z - k, k) // (z - k) * (-q) ** k for k in range(1, z // 2 + 1))


def uneven_driven(places: NDArray[np.float64]) -> CutGearPair:
    """64 even teeth drive 38 whose places, -1 to 1, use up the play when two neighbours differ by 2 `SHARE`.

    A driven tooth that is late against the one before it by more than the least play jams; errors as small as these
    let nothing else jam.
    """
    sizes = sized(64, 38, 0.01)
    half = nominal_backlash(sizes) * sizes.p2 / (2 * SHARE)
    driven = CutWheel.driven_of(sizes).placed(half * places)
    return CutGearPair(sizes, CutWheel.driver_of(sizes), driven)
