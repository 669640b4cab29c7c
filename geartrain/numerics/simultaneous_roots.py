"""Roots of many functions at once, each kept inside its own bracket.

Chandrupatla's method ends at neighbouring floats however the functions bend; false position takes fewer evaluations
where they are smooth and values at the ends are known, and ends where a step is short enough.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Indices

    Value = Callable[[NDArray[np.int64], Floats], Floats]

_MOST_STEPS = 100  # halving alone needs some 55 where the root is not near 0
_PATIENCE = 4  # steps without half the bracket: halve it


def roots_by_chandrupatla(value: Value, low: Floats, high: Floats) -> Floats:
    """Chandrupatla's method: where each of m functions changes its sign between `low` and `high`, (m,) each.

    value   of functions (indices) at arguments: value(which, x), of one shape

    T. R. Chandrupatla, Advances in Engineering Software 28 (1997) 145-149. Ends to rounding.
    """
    a, b = high.copy(), low.copy()
    every = np.arange(len(low))
    at_a, at_b = value(every, a), value(every, b)
    c, at_c = a.copy(), at_a.copy()
    part, found, open_ = np.full(len(low), 0.5), low.copy(), np.ones(len(low), bool)
    for _ in range(_MOST_STEPS):
        i = np.flatnonzero(open_)
        if not len(i):
            break
        x = a[i] + part[i] * (b[i] - a[i])
        here = value(i, x)
        same = np.sign(here) == np.sign(at_a[i])
        c[i], at_c[i] = np.where(same, a[i], b[i]), np.where(same, at_a[i], at_b[i])
        b[i], at_b[i] = np.where(same, b[i], a[i]), np.where(same, at_b[i], at_a[i])
        a[i], at_a[i] = x, here
        best = np.where(np.abs(at_a[i]) < np.abs(at_b[i]), a[i], b[i])
        found[i] = best
        width = np.abs(b[i] - a[i])
        least = 2 * np.spacing(np.abs(best)) + 1e-300  # at a root of 0, too, the width must come below something
        part[i] = _next(a[i], b[i], c[i], at_a[i], at_b[i], at_c[i], least / np.maximum(width, least))
        open_[i] = (width > 2 * least) & (here != 0)
    return found


def _next(a: Floats, b: Floats, c: Floats, at_a: Floats, at_b: Floats, at_c: Floats, least: Floats) -> Floats:
    """The share of the bracket to go next: by inverse quadratic interpolation where it is safe, else half."""
    with np.errstate(all="ignore"):
        xi, phi = (a - b) / (c - b), (at_a - at_b) / (at_c - at_b)
        # Chandrupatla's condition: the inverse quadratic is monotonic between the three points
        safe = (phi * phi < xi) & ((1 - phi) ** 2 < 1 - xi)
        share = at_a / (at_b - at_a) * at_c / (at_b - at_c)
        share += (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
    share = np.where(safe & np.isfinite(share), share, 0.5)
    # a step that no longer moves a float would be lost; nor may the two limits cross
    return np.clip(share, np.minimum(least, 0.5), np.maximum(1 - least, 0.5))


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
