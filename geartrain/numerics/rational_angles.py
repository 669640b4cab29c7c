"""Recognition of rational fractions of a turn, exactly for integer vectors, or from the digits of a float."""

from __future__ import annotations

import math
from fractions import Fraction

from geartrain.numerics.vectors import IntegerVector, dot

_PROBABILITY = 1e-3  # maximum probability that a random angle is taken for a fraction
_DENSITY = 3 / math.pi**2  # about this times q squared reduced fractions below 1 have a denominator up to q


def rational_angle(u: IntegerVector, v: IntegerVector, turn: float) -> Fraction | None:
    """Return the angle from the integer vector u to v if it is a rational fraction of a turn, else None [turn].

    The square of the cosine, (u.v)^2 / (u.u v.v), is rational. If the angle is a rational fraction of a turn, Niven's
    theorem requires this square to be 0, 1/4, 1/2, 3/4 or 1. The angle is therefore a multiple of 1/24 turn or
    irrational. `turn` is the angle in floats, with an error below 1/48.
    """
    along = dot(u, v)
    square = dot(u, u) * dot(v, v)
    if 4 * along * along % square:  # the square of the cosine is not a multiple of 1/4
        return None
    return Fraction(round(24 * turn) % 24, 24)


def recognised_angle(turn: float, slack: float) -> Fraction | None:
    """Return the fraction of a turn within `slack` of an angle [turn]; None if such a fraction could be a coincidence.

    Fractions with denominators up to q match a random angle with the probability 0.6 q^2 slack, which limits q. At most
    one such fraction exists, and by Legendre's theorem it is a convergent of the continued fraction of the angle.

    >>> recognised_angle(0.3333, 1e-4), recognised_angle(0.3679, 1e-4)
    (Fraction(1, 3), None)
    """
    most = math.sqrt(_PROBABILITY / (2 * _DENSITY * slack))
    before, last = (0, 1), (1, 0)
    rest = turn
    while True:
        whole = math.floor(rest)
        before, last = last, (whole * last[0] + before[0], whole * last[1] + before[1])
        if last[1] > most:
            return None
        if abs(turn - last[0] / last[1]) <= slack:
            return Fraction(last[0] % last[1], last[1])
        # the remainder is not 0 here: the convergent would be the angle to rounding, and the loop has ended above
        rest = 1 / (rest - whole)


def centred_residue(value: Fraction) -> Fraction:
    """Return the difference between a number and an integer that is in the interval (-1/2, 1/2]."""
    return value - math.ceil(value - Fraction(1, 2))
