"""Bracketed roots of smooth functions, one by one and vectorised.

`roots_by_false_position` uses the Anderson-Bjorck variant of false position, which keeps each root inside its bracket.
It requires few evaluations if the functions are smooth and their values at both ends are known.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import isfinite, ulp
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices

_MOST_SIMULTANEOUS_STEPS = 100  # bisection only needs about 55 unless the root is near 0
_PATIENCE = 4  # steps without halving the bracket after which it is bisected


def roots_by_false_position(
    value: Callable[[Floats, Indices], Floats],
    low: Floats,
    high: Floats,
    at_low: Floats,
    at_high: Floats,
    fine: float = 1e-15,
) -> Floats:
    """Return, for each of n functions, a root between `low` and `high`, found by the Anderson-Bjorck method.

    value(x, which)   function that returns, at x, the values of the functions with the indices `which`
    at_low, at_high   values of the functions at `low` and `high`
    fine              width of a bracket of a root, or length of a step, at which the iteration stops

    An iteration that stalls is continued by bisection. For a bracket without a change of sign, the end at which the
    function has the smaller absolute value is returned.
    """
    import numpy as np  # scalar root finders do not need numpy

    found = np.where(np.abs(at_low) < np.abs(at_high), low, high)
    which = np.flatnonzero(np.sign(at_low) * np.sign(at_high) < 0)
    a, b, f, g = low[which], high[which], at_low[which], at_high[which]
    width, stuck = np.abs(b - a), np.zeros(len(which), int)
    for _ in range(_MOST_SIMULTANEOUS_STEPS):
        if not len(which):
            break
        with np.errstate(invalid="ignore", divide="ignore"):  # f = g: NaN is not inside, and the bracket is bisected
            x = b - g * (b - a) / (g - f)
        inside = (x - a) * (x - b) < 0
        x = np.where(inside & (stuck < _PATIENCE), x, a + (b - a) / 2)
        at = value(x, which)
        step = np.abs(x - b)
        crossed = np.sign(at) != np.sign(g)
        with np.errstate(invalid="ignore", divide="ignore"):
            share = 1 - at / g
        # the value at an end that stays is reduced (Anderson and Bjorck), so that the next step passes the root
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


Function = Callable[[float], float]
_MOST_STEPS = 200  # bisection only needs about 60 unless the root is near 0
_DEEPEST = 40  # bisections of a bracket whose slope keeps changing sign


def bracketed_root(value: Function, low: float, high: float) -> float:
    """Return the root of `value` between `low` and `high`, at which it changes sign, by Chandrupatla's method."""
    return root(value, low, high, value(low), value(high))


def sign_changes(
    value: Function, bounds: Callable[[float, float], tuple[float, float]], low: float, high: float, depth: int = 0
) -> Iterator[tuple[float, float]]:
    """Yield brackets that contain one root each, by bisection with bounds on the slope.

    `bounds(a, b)` returns the minimum and maximum slope. A bracket in which the slope has one sign contains at most one
    root; other brackets are bisected. At a double root without a change of sign, no bracket is returned.
    """
    at_low, at_high = value(low), value(high)
    minimum, maximum = bounds(low, high)
    crosses = (at_low < 0) != (at_high < 0)
    if minimum >= 0 or maximum <= 0:
        if crosses:
            yield low, high
        return
    # bounds on the function between its end values from the bounds on its slope (Piyavskii)
    width, spread = high - low, maximum - minimum
    below = at_low + minimum * (at_low - at_high + maximum * width) / spread
    above = at_low + maximum * (at_high - at_low - minimum * width) / spread
    if not crosses and (below > 0 or above < 0):
        return
    middle = low + width / 2
    if depth == _DEEPEST or not low < middle < high:
        if crosses:
            yield low, high
        return
    yield from sign_changes(value, bounds, low, middle, depth + 1)
    yield from sign_changes(value, bounds, middle, high, depth + 1)


def root(value: Function, low: float, high: float, at_low: float, at_high: float) -> float:
    """Return the root of a continuous function between `low` and `high` by Chandrupatla's method, without derivatives.

    A step is found by inverse quadratic interpolation if its condition is satisfied, else by bisection. T. R.
    Chandrupatla, Advances in Engineering Software 28 (1997) 145-149.
    """
    if at_low == 0 or at_high == 0:
        return low if at_low == 0 else high
    a, b, at_a, at_b = low, high, at_low, at_high
    share = 0.5
    for _ in range(_MOST_STEPS):
        x = a + share * (b - a)
        here = value(x)
        if (here > 0) == (at_a > 0):
            c, at_c = a, at_a
        else:
            c, at_c, b, at_b = b, at_b, a, at_a
        a, at_a = x, here
        nearest = a if abs(at_a) < abs(at_b) else b
        # minimum fraction of the bracket that changes a float: a smaller step would be lost to rounding
        narrow = 2 * ulp(nearest) / abs(b - c) if b != c else 1.0
        if here == 0 or narrow > 0.5:
            return nearest
        share = _quadratic_share(a, b, c, at_a, at_b, at_c)
        share = min(max(share, narrow), 1 - narrow)
    return a


def _quadratic_share(a: float, b: float, c: float, at_a: float, at_b: float, at_c: float) -> float:
    """Return the root of x as a quadratic of the values at a, b and c, as a fraction of b - a; 1/2 if unreliable."""
    if not all(map(isfinite, (at_a, at_b, at_c))) or at_b == at_c or at_a in (at_b, at_c):
        return 0.5
    xi, phi = (a - b) / (c - b), (at_a - at_b) / (at_c - at_b)
    if not 0 <= xi <= 1 or not 1 - (1 - xi) ** 0.5 < phi < xi**0.5:
        return 0.5  # the inverse quadratic is not monotonic between the points (Chandrupatla's condition)
    first = at_a / (at_b - at_a) * at_c / (at_b - at_c)
    return first + (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
