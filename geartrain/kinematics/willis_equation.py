"""One labelled row of a Willis system."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple


class WillisEquation(NamedTuple):
    """One row of a Willis system: the sum of coefficient times speed over `terms` equals `right`.

    See Also
    --------
    WillisSystem : holds all rows of a train
    """

    label: str
    """The pair's id, or what is prescribed: `input sun`."""
    kind: str
    """Frame, input, fixed or lock, or the circuit's: gear, pin_and_slot, pin_follower, pins_in_holes, parallel."""
    terms: tuple[tuple[str, int], ...]
    """Links with their coefficients, none of them 0."""
    right: Fraction = Fraction(0)
    """The right-hand side [the train's unit]."""
