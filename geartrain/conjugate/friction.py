"""Friction of one contact, exact in its coefficient, spur and bevel, rings too.

The contact pushes with N along the normal n and rubs with mu N across it, against the sliding, whose sense turns at the
pitch point. Over N and the pitch-line speed, the power that enters at gear i, or leaves there, is the force times the
speed of that gear's body at the contact:

    gear 1: cos psi + s mu (S' sin psi + A S),   gear 2: cos psi + s mu (S' sin psi - B S),

s = sign d where gear 1 drives and -sign d where gear 2 does. The difference is mu (A + B) |S|, friction times sliding.
A contact line of a bevel pair has these ratios at every distance from the apex, so they are exact there as well.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

import numpy as np

from geartrain.conjugate.measures import greatest

if TYPE_CHECKING:
    from geartrain.conjugate.path import Contact, Path
    from geartrain.conjugate.pitch import Floats, Pitch


def powers(pitch: Pitch, contact: Contact, friction: float, driver: int = 1) -> tuple[Floats, Floats]:
    """Power in and power out of a contact over normal force and pitch-line speed; `driver` 1 or 2."""
    rising, S = pitch.S_slope(contact.d) * contact.sin_psi, pitch.S(contact.d)
    rub = np.sign(contact.d) * (friction if driver == 1 else -friction)
    first = contact.cos_psi + rub * (rising + pitch.A * S)
    second = contact.cos_psi + rub * (rising - pitch.B * S)
    return (first, second) if driver == 1 else (second, first)


def efficiency(pitch: Pitch, contact: Contact, friction: float, driver: int = 1) -> Floats:
    """Power out over power in; NaN where friction lets nothing out: the contact locks."""
    into, out = powers(pitch, contact, friction, driver)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(out > 0, out / into, np.nan)


def locking_friction(path: Path, driver: int = 1) -> float:
    """The least friction at which some contact of the path locks; infinite where none does.

    Contacts lock in the driver's approach only, where the driven side's tooth is rubbed towards the line of centres.
    """
    pitch = path.pitch

    def lean(contact: Contact) -> Floats:
        power = powers(pitch, contact, 1.0, driver)[1] - contact.cos_psi
        found: Floats = -power / contact.cos_psi
        return found

    steepest = greatest(path, lean)
    return 1 / steepest if steepest > 0 else inf
