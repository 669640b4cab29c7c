"""One labelled equation of a Willis system."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple


class WillisEquation(NamedTuple):
    """Equation of a Willis system: the sum of coefficient times speed over `terms` is equal to `right`.

    See Also
    --------
    WillisSystem : all rows of a train
    """

    label: str
    """Name of the pair, or of the prescribed speed, such as `input sun`."""
    kind: str
    """Kind of the equation: frame, input, fixed, lock, gear, pin_and_slot, pin_follower, pins_in_holes or parallel."""
    terms: tuple[tuple[str, int], ...]
    """Pairs of a link and its non-zero coefficient."""
    right: Fraction = Fraction(0)
    """Right-hand side of the equation [unit of the train]."""
