"""The least sums of a term of each of two wheels, over all teeth that meet: those whose numbers leave one rest.

What wheels add is apart for each, so that over a cycle of lcm(z1, z2) couples the least sum is that of the least terms.
"""

from __future__ import annotations

from math import gcd
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


def terms_at(terms: Any, rows: Ints, n: Ints) -> Floats:
    """Terms of some trials, each of one number."""
    return np.asarray(terms)[rows, n] if np.ndim(terms) > 1 else np.asarray(terms)[n]


def _by_rest(driver: Any, driven: Any) -> list[Floats]:
    """Terms of both wheels by the rest that their numbers leave: those of one rest meet in the cycle."""
    rests = gcd(driver.shape[-1], driven.shape[-1])
    return [each.reshape(*each.shape[:-1], -1, rests) for each in (driver, driven)]


def least_sum(driver: Any, driven: Any) -> Floats:
    """The least sum of a term of the driver and one of the driven wheel that meet in the cycle."""
    one, two = _by_rest(driver, driven)
    found: Floats = (one.min(axis=-2) + two.min(axis=-2)).min(axis=-1)
    return found


def least_sum_places(driver: Any, driven: Any, count: int) -> tuple[Floats, Ints, Ints]:
    """The same, and the numbers of both terms, (trials,)."""
    one, two = _by_rest(np.atleast_2d(driver), np.atleast_2d(driven))
    rests = one.shape[-1]
    total = one.min(axis=1) + two.min(axis=1)
    rest = np.broadcast_to(total.argmin(axis=1), count)
    own, other = (np.broadcast_to(each.argmin(axis=1), (count, rests))[np.arange(count), rest] for each in (one, two))
    return np.array(np.broadcast_to(total.min(axis=1), count)), own * rests + rest, other * rests + rest
