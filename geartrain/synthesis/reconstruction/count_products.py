"""How many choices of tooth counts have a wanted quotient of products: by lists of products and their multiples.

With drivers y and driven wheels x, prod y / prod x = num / den in lowest terms holds exactly where prod y = num m and
prod x = den m for a whole m. So the number of choices is the sum over m of P(num m) R(den m), where P(n) is the number
of choices of drivers with the product n, and R that of driven wheels.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from math import prod

import numpy as np
from numpy.typing import NDArray

Counts = tuple[int, ...]
"""The counts that a wheel may have, rising."""


@lru_cache(maxsize=64)
def product_tally(wheels: tuple[Counts, ...]) -> NDArray[np.int64]:
    """Number of choices with the product n at index n, for wheels sorted as they come."""
    if not wheels:
        return np.array([0, 1], dtype=np.int64)
    before = product_tally(wheels[:-1])
    found = np.zeros((len(before) - 1) * wheels[-1][-1] + 1, dtype=np.int64)
    for count in wheels[-1]:
        found[: (len(before) - 1) * count + 1 : count] += before
    return found


@lru_cache(maxsize=1 << 18)
def count_choices(ratio: Fraction, drivers: tuple[Counts, ...], driven: tuple[Counts, ...]) -> int:
    """How many choices of counts have prod(drivers) / prod(driven) = ratio, a positive one; wheels are told apart."""
    top, bottom = prod(each[-1] for each in drivers), prod(each[-1] for each in driven)
    last = min(top // ratio.numerator, bottom // ratio.denominator)
    if not last:
        return 0
    if not drivers and not driven:
        return 1
    above = product_tally(drivers)[ratio.numerator :: ratio.numerator][:last]
    below = product_tally(driven)[ratio.denominator :: ratio.denominator][:last]
    return int(above @ below)


def list_choices(ratio: Fraction, drivers: tuple[Counts, ...], driven: tuple[Counts, ...]) -> Iterator[Counts]:
    """The choices themselves: counts of the drivers, then of the driven wheels."""
    if not count_choices(ratio, drivers, driven):
        return
    if drivers:
        for count in drivers[0]:
            for rest in list_choices(ratio / count, drivers[1:], driven):
                yield (count, *rest)
    elif driven:
        for count in driven[0]:
            for rest in list_choices(ratio * count, drivers, driven[1:]):
                yield (count, *rest)
    else:
        yield ()
