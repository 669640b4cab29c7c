"""The true motion of Moon and Sun by Kepler: M = E - e sin E, tan(nu/2) = sqrt((1 + e)/(1 - e)) tan(E/2).

Nothing else moves them here: the Sun's pull on the Moon (evection, variation, annual equation: 1.3, 0.7 and 0.2
degrees) and the planets' on both are left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

Body = Literal["moon", "sun"]

_STEPS = 40  # far more than Newton's method takes for any ellipse


@dataclass(frozen=True, slots=True)
class TrueMotion:
    """What is shipped of a body's orbit.

    eccentricity   of its ellipse, today
    period         from a star or the equinox back to it, to a hundredth (d): a pointer's target must be near it
    words          by which an output or link of it is known
    source         of the eccentricity
    """

    eccentricity: float
    period: float
    words: frozenset[str]
    source: str


TRUE_MOTIONS: dict[Body, TrueMotion] = {
    "moon": TrueMotion(0.0549, 27.3217, frozenset({"moon"}), "NASA planetary fact sheets (general knowledge)"),
    "sun": TrueMotion(0.0167, 365.2422, frozenset({"sun"}), "NASA planetary fact sheets (general knowledge)"),
}


def equation_of_centre(M: Floats, e: float) -> Floats:
    """True less mean anomaly (rad) at mean anomalies M (rad), eccentricity 0 <= e < 1: Kepler's equation by Newton.

    Right to rounding; E starts at M + e sin M, from where the method converges for the small e of these orbits.
    """
    E = M + e * np.sin(M)
    for _ in range(_STEPS):
        step = (E - e * np.sin(E) - M) / (1 - e * np.cos(E))
        E = E - step
        if np.max(np.abs(step), initial=0.0) < 1e-15:
            break
    # nu - E as one atan2: no half angles, no jumps between turns
    beta = e / (1 + np.sqrt(1 - e * e))
    found: Floats = 2 * np.arctan2(beta * np.sin(E), 1 - beta * np.cos(E)) + (E - M)
    return found
