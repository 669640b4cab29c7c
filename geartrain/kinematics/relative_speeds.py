"""The speed of one link seen from another: the only place where two speeds of a train are subtracted."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import TypeVar

from geartrain.numerics.long_float import LongFloat

Speed = TypeVar("Speed", Fraction, Fraction | float | LongFloat)


def axis_sense(of: str, base: str, signs: Mapping[str, int]) -> int:
    """1, or -1 where the axes of two links point against each other.

    signs   -1 for links whose axis points against the reference direction of its parallels
    """
    return signs.get(of, 1) * signs.get(base, 1)


def relative_speed(
    of: str, base: str, speed_of: Callable[[str], Speed | None], signs: Mapping[str, int]
) -> Speed | None:
    """w_of - s w_base: a link's speed seen from another, about the first one's axis; None where one is not known.

    speed_of   each link's speed about its own axis, of any one kind of number; None where it is not determined
    signs      -1 for links whose axis points against the reference direction of its parallels: s is their product
    """
    own, other = speed_of(of), speed_of(base)
    return None if own is None or other is None else own - other * axis_sense(of, base, signs)
