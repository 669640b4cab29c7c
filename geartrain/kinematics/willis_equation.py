"""One labelled row of a Willis system."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple


class WillisEquation(NamedTuple):
    """One row of a Willis system: the sum of coefficient times speed over `terms` equals `right`.

    Attributes
    ----------
    label : str
        The pair's id, or what is prescribed: `input sun`.
    kind : str
        frame, input, fixed or lock, or the circuit's: gear, pin_and_slot, pin_follower, pins_in_holes, parallel.
    terms : tuple of (str, int)
        Links with their coefficients, none of them 0.
    right : Fraction
        The right-hand side [the train's unit].

    See Also
    --------
    WillisSystem : holds all rows of a train
    """

    label: str
    kind: str
    terms: tuple[tuple[str, int], ...]
    right: Fraction = Fraction(0)
