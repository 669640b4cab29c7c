"""Confidence intervals of means over one long run, whose values depend on those before: batch means."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

FEWEST = 5
"""Batches from which on an interval is given."""
_CONFIDENCE = 0.95
_CORRELATED = 0.9  # lag-1 correlation that is counted at most: beyond it the batches are too short for any interval


def batch_half_width(means: Floats) -> float | None:
    """Half the 95 % interval of a mean, from means over equal consecutive batches; None of too few batches.

    Student's t with n - 1 degrees of freedom, widened by sqrt((1 + r)/(1 - r)) for the lag-1 correlation r of the
    batches, whose estimate is 1/n too low on average (Law and Kelton, Simulation Modeling and Analysis, section 9.5).

    Parameters
    ----------
    means : array of float, (n,)
        One mean a batch.
    """
    from scipy.special import stdtrit

    n = len(means)
    if n < FEWEST:
        return None
    off = means - means.mean()
    squares = float(off @ off)
    if not squares:
        return 0.0
    lag = min(max(float(off[1:] @ off[:-1]) / squares + 1 / n, 0.0), _CORRELATED)
    wide = float(stdtrit(n - 1, (1 + _CONFIDENCE) / 2)) * sqrt(squares / (n - 1) / n)
    return wide * sqrt((1 + lag) / (1 - lag))
