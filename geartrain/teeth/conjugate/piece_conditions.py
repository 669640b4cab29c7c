"""When a ray and one slow piece are the side of least loss: the conditions of docs/shapes.md, section 15."""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

    Weight = Callable[[Floats], Floats]

_CHECKED, _SLACK = 400, 1e-6  # points at which the conditions are looked at, and their rounding


def pull(pitch: PitchSurfaces, sine_of: Callable[[Floats], Floats], d: Floats, end: float, loss: Weight) -> Floats:
    """The integrand: what a higher path would lose at d less what it would win there in arc."""
    S, sine = pitch.S(d), sine_of(d)
    cosine = np.sqrt(1 - sine**2)
    last = np.array(end)
    won = float(loss(last)) / sqrt(1 - float(sine_of(last)) ** 2)
    found: Floats = sine / (S * cosine) * (2 * loss(d) / cosine**3 - won / cosine**2)
    return found


def check_pieces(
    pitch: PitchSurfaces, sine_of: Callable[[Floats], Floats], end: float, first: float, weight: Weight
) -> None:
    """Raise `RangeError` where a ray and one slow piece are not the best, by the conditions of docs/shapes.md, 15."""
    d = np.linspace(0.0, end, _CHECKED)
    if (np.diff(weight(d)) < 0).any():
        raise other_shape("there its contacts lose less the faster they slide")
    d = np.linspace(first, end, _CHECKED)
    each = pull(pitch, sine_of, d, end, weight)
    below = np.cumsum((each[1:] + each[:-1]) / 2)
    if below.max() > _SLACK * np.abs(each).sum():
        raise other_shape("a path that rises again before its end would lose less")


def other_shape(why: str) -> RangeError:
    """What is said of a law under which two pieces are not the side of least loss."""
    return RangeError(
        Problem(
            "under this law of friction teeth of least loss have other pieces than a constant pressure angle and a "
            "slowest contact",
            why,
            "ask for another pitch_line_speed, a law that falls less steeply, or a smaller pressure angle",
        )
    )
