"""One labelled row of a Willis system."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple


class WillisEquation(NamedTuple):
    """One row of a Willis system: the sum of coefficient times speed over `terms` equals `right`.

    See Also
    --------
    WillisSystem : all rows of a train
    """

    label: str
    """Id of the pair, or the prescription, such as `input sun`."""
    kind: str
    """Kind of row: frame, input, fixed, lock, gear, pin_and_slot, pin_follower, pins_in_holes or parallel."""
    terms: tuple[tuple[str, int], ...]
    """Links with their non-zero coefficients."""
    right: Fraction = Fraction(0)
    """Right-hand side [unit of the train]."""
