"""What happens along the real path of triangular teeth: a row for each of some driver angles over one pitch."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.results import Key, Result, finite

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.friction_law import PairFriction
    from geartrain.teeth.triangular.real_path import DriveInterval
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

_USUAL = 5


@dataclass(frozen=True)
class ContactCourse(Result):
    """Contact over one pitch, in order of time, both ends of every interval among the rows.

    phases           of each row
    alpha1, alpha2   angles of the apices from the line of centres (rad)
    speed_ratio      tau
    instant_centre   O1C, from the driver's axis, in the unit of the law's lengths; NaN in a standstill, as what follows
    driver_arm, driven_arm   of the force about either axis, b1 and b2
    efficiency       tau b2/b1; NaN too where friction locks
    """

    KEYS = (
        *("phases", "alpha1", "alpha2", "speed_ratio", Key("instant_centre", to=finite)),
        *(Key(name, to=finite) for name in ("driver_arm", "driven_arm", "efficiency")),
    )

    phases: tuple[str, ...]
    alpha1: Floats
    alpha2: Floats
    speed_ratio: Floats
    instant_centre: Floats
    driver_arm: Floats
    driven_arm: Floats
    efficiency: Floats


def contact_course(
    law: TriangularTransmission, samples: int = _USUAL, friction: PairFriction | None = None
) -> ContactCourse:
    """The course of a pair, `samples` rows for each interval of its real path; none for teeth that never touch.

    friction   in place of the law's own, where it depends on speed
    """
    at = [(each, np.linspace(each.start, each.end, samples)) for each in law.intervals]
    couple = law.contact.path.couple

    def column(what: Callable[[str, Floats], Floats], held: Callable[[DriveInterval], float]) -> Floats:
        values = [what(each.phase, x) if each.held is None else np.full_like(x, held(each)) for each, x in at]
        return np.concatenate([np.empty(0), *values])

    def arm(wheel: int) -> Floats:
        return column(
            lambda phase, x: couple.moment_arms(phase, x, law.coefficient(phase, x, friction), np)[wheel], lambda _: nan
        )

    eta = column(lambda phase, x: couple.efficiency(phase, x, law.coefficient(phase, x, friction), np), lambda _: nan)
    first, second = arm(0), arm(1)
    return ContactCourse(
        tuple(each.phase for each, x in at for _ in x),
        np.concatenate([np.empty(0), *(x for _, x in at)]),
        column(lambda phase, x: couple.angle(phase, x, np), lambda each: each.held or 0.0),
        column(lambda phase, x: couple.speed(phase, x, np), lambda _: 0.0),
        column(lambda phase, x: couple.instant_centre(phase, x, np), lambda _: nan),
        first,
        second,
        np.where((first > 0) & (second > 0), eta, nan),
    )
