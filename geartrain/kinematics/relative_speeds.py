"""The speed of one link seen from another, exact or float, about the axis of the first."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, overload

if TYPE_CHECKING:
    from geartrain.kinematics.judged_outputs import SpeedValue


def axis_sense(of: str, base: str, signs: Mapping[str, int]) -> int:
    """1, or -1 where the axes of two links point against each other.

    signs   -1 for links whose axis points against the reference direction of its parallels
    """
    return signs.get(of, 1) * signs.get(base, 1)


@overload
def relative_speed(of: str, base: str, speed_of: Callable[[str], Fraction], signs: Mapping[str, int]) -> Fraction: ...


@overload
def relative_speed(
    of: str, base: str, speed_of: Callable[[str], Fraction | None], signs: Mapping[str, int]
) -> Fraction | None: ...


@overload
def relative_speed(
    of: str, base: str, speed_of: Callable[[str], SpeedValue | None], signs: Mapping[str, int]
) -> SpeedValue | None: ...


def relative_speed(
    of: str, base: str, speed_of: Callable[[str], SpeedValue | None], signs: Mapping[str, int]
) -> SpeedValue | None:
    """w_of - s w_base: a link's speed seen from another, about the first one's axis; None where one is not known.

    speed_of   each link's speed about its own axis; None where it is not determined
    signs      -1 for links whose axis points against the reference direction of its parallels: s is their product
    """
    own, other = speed_of(of), speed_of(base)
    if own is None or other is None:
        return None
    return own - other * axis_sense(of, base, signs) if other else own  # mostly seen from what stands still
