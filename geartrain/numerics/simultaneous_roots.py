"""Roots of many functions at once, each kept inside its own bracket.

False position in the variant of Anderson and Bjorck takes few evaluations where functions are smooth and the values at
both ends are known.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices

_MOST_STEPS = 100  # halving alone needs some 55 where the root is not near 0
_PATIENCE = 4  # steps without half the bracket: halve it


def roots_by_false_position(
    value: Callable[[Floats, Indices], Floats],
    low: Floats,
    high: Floats,
    at_low: Floats,
    at_high: Floats,
    fine: float = 1e-15,
) -> Floats:
    """False position: where each function changes its sign between low and high; steps end below `fine`.

    value(x, which)   the functions numbered `which` at x
    Anderson's and Bjorck's variant, from the values at both ends; where one is stuck, halving. A bracket without a
    change of sign gives its end with the lesser value.
    """
    found = np.where(np.abs(at_low) < np.abs(at_high), low, high)
    which = np.flatnonzero(np.sign(at_low) * np.sign(at_high) < 0)
    a, b, f, g = low[which], high[which], at_low[which], at_high[which]
    width, stuck = np.abs(b - a), np.zeros(len(which), int)
    for _ in range(_MOST_STEPS):
        if not len(which):
            break
        with np.errstate(invalid="ignore", divide="ignore"):  # f = g: nan is not inside, and the bracket is halved
            x = b - g * (b - a) / (g - f)
        inside = (x - a) * (x - b) < 0
        x = np.where(inside & (stuck < _PATIENCE), x, a + (b - a) / 2)
        at = value(x, which)
        step = np.abs(x - b)
        crossed = np.sign(at) != np.sign(g)
        with np.errstate(invalid="ignore", divide="ignore"):
            share = 1 - at / g
        # an end that stays has its value lessened (Anderson and Bjorck), so that the next step goes past the root
        f = np.where(crossed, g, f * np.where(share > 0, share, 0.5))
        a = np.where(crossed, b, a)
        b, g = x, at
        found[which] = x
        now = np.abs(b - a)
        shrunk = now < width / 2
        width, stuck = np.where(shrunk, now, width), np.where(shrunk | (stuck >= _PATIENCE), 0, stuck + 1)
        left = (at != 0) & (step > fine) & (now > fine)
        which, a, b, f, g, width, stuck = (each[left] for each in (which, a, b, f, g, width, stuck))
    return found
