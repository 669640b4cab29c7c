"""Helical wheels in mesh: whether their teeth go together, and which way one drives the other."""

from __future__ import annotations

from math import degrees, pi, remainder

from geartrain.errors import GearTrainError, Problem
from geartrain.train import Wheel

_SAME = 1e-6  # rad: angles as near as this are equal, for they are rounded as written


def check_parallel(first: Wheel, second: Wheel) -> None:
    """Raises `GearTrainError` for wheels on parallel axes whose teeth do not lean alike.

    Seen from without, teeth that touch lie along each other: hands are opposite, but the same in a ring. A hand that is
    not declared is the one that fits.
    """
    angles = tuple(0.0 if wheel.helix_angle is None else wheel.helix_angle.si for wheel in (first, second))
    if abs(angles[0] - angles[1]) > _SAME:
        told = " and ".join(f"{degrees(angle):.6g}" for angle in angles)
        what = f"teeth that lean by {told} deg on parallel axes"
        fix = "give both wheels the same `helix_angle`, or `axes` that cross"
        raise GearTrainError(Problem(what, "they would touch at their corners only", fix))
    ring = first.internal or second.internal
    if first.hand and second.hand and (first.hand == second.hand) != ring:
        what = f"a {first.hand} hand in mesh with a {second.hand} hand"
        why = "teeth of a ring and its wheel lean the same way" if ring else "on parallel axes teeth lean opposite ways"
        raise GearTrainError(Problem(what, why, f"make one of them {'right' if first.hand == 'left' else 'left'}"))


def crossed_sense(wheels: tuple[Wheel, Wheel], angle: float, side: int) -> tuple[int, str]:
    """1 where two helical wheels on skew axes turn against each other as spur wheels do, else -1; and a note.

    With the helix angles b of both (right hands above 0) and the angle S from the first axis to the second about the
    way from the second to the first, teeth lie along each other where b1 + b2 = S, or S and half a turn; then
    z1 w1 = -z2 w2, or z2 w2 ((12a), (12b) of docs/theory.md).

    Parameters
    ----------
    wheels : tuple of Wheel
    angle : float
        Between the directions of the axes (rad), 0 to pi.
    side : int
        1 where it turns about the way from the second axis to the first, -1 against it, 0 where that is not known.

    Raises
    ------
    GearTrainError
        If the teeth do not lie along each other.
    """
    lean = wheels[0].helix + wheels[1].helix
    fits = [
        (sense, way)
        for way in ((side,) if side else (1, -1))
        for sense, turned in ((1, 0.0), (-1, pi))
        if abs(remainder(lean - way * angle - turned, 2 * pi)) <= _SAME
    ]
    if not fits:
        raise GearTrainError(_not_along(wheels, angle, side))
    if len({sense for sense, _ in fits}) == 1:
        return fits[0][0], ""
    note = "sense by convention (as if the second axis passed over the first): positions of the axes do not fix it"
    return fits[0][0], note


def crossed_helix_angles(wheels: tuple[Wheel, Wheel], angle: float, side: int) -> tuple[float, float] | None:
    """Helix angles (rad) of two wheels on skew axes, right hands above 0; None where none is declared.

    The helix angle of a worm and the shaft angle fix that of its wheel by (12a), which may declare it too. A worm
    without one leaves both unknown. `angle` and `side` as of `crossed_sense`.

    Raises
    ------
    GearTrainError
        If a worm's wheel declares another angle or hand than its worm needs.
    """
    kinds = [wheel.kind for wheel in wheels]
    if "worm" not in kinds:
        return None if all(wheel.helix_angle is None for wheel in wheels) else (wheels[0].helix, wheels[1].helix)
    at = kinds.index("worm")
    worm, wheel = wheels[at], wheels[1 - at]
    if worm.helix_angle is None:
        return None
    leans = [remainder(way * angle - worm.helix, pi) for way in ((side,) if side else (1, -1))]
    if wheel.helix_angle is not None:
        declared = {wheel.helix} if wheel.hand else {wheel.helix, -wheel.helix}
        leans = [lean for lean in leans if any(abs(lean - each) <= _SAME for each in declared)]
    if not leans:
        raise GearTrainError(_not_along(wheels, angle, side))
    return (leans[0], worm.helix) if at else (worm.helix, leans[0])


def _not_along(wheels: tuple[Wheel, Wheel], angle: float, side: int) -> Problem:
    hands = [f"{degrees(abs(wheel.helix)):.6g} deg {wheel.hand or 'right'}" for wheel in wheels]
    over = " about the way from the second to the first" if side else ""
    return Problem(
        f"teeth of {hands[0]} and {hands[1]} do not lie along each other",
        f"axes that cross at {degrees(angle) * (side or 1):.6g} deg{over} ask for helix angles with that sum, right "
        "hands counted above 0",
        "change a `helix_angle` or a `hand`, or the axes",
    )
