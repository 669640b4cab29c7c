"""Roots of many functions at once, each in its own bracket."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Value = Callable[[NDArray[np.int64], Floats], Floats]

_MOST_STEPS = 100


def roots_by_chandrupatla(value: Value, low: Floats, high: Floats) -> Floats:
    """Where each of m functions changes its sign between `low` and `high`, (m,) each: Chandrupatla's method.

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
        least = 2 * np.spacing(np.abs(best)) + 1e-300
        part[i] = _next(a[i], b[i], c[i], at_a[i], at_b[i], at_c[i], least / np.maximum(width, least))
        open_[i] = (width > 2 * least) & (here != 0)
    return found


def _next(a: Floats, b: Floats, c: Floats, at_a: Floats, at_b: Floats, at_c: Floats, least: Floats) -> Floats:
    """The share of the bracket to go next: by inverse quadratic interpolation where it is safe, else half."""
    with np.errstate(all="ignore"):
        xi, phi = (a - b) / (c - b), (at_a - at_b) / (at_c - at_b)
        safe = (phi * phi < xi) & ((1 - phi) ** 2 < 1 - xi)
        share = at_a / (at_b - at_a) * at_c / (at_b - at_c)
        share += (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
    share = np.where(safe & np.isfinite(share), share, 0.5)
    return np.clip(share, np.minimum(least, 0.5), np.maximum(1 - least, 0.5))
