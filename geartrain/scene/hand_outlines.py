"""Hands as makers make them: outlines along their length, and how far they reach on a dial."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class HandOutline:
    """A hand along x from its axis, its tip at 1.

    reach      its length over the radius of the scale on which it is read
    stations   (x, half its width there) from the tail to the tip, over its length
    """

    reach: float
    stations: tuple[tuple[float, float], ...]


HANDS: Mapping[str, HandOutline] = {
    # slender, with a point like that of a lance
    "needle": HandOutline(
        0.97, ((-0.16, 0.024), (-0.12, 0.0272), (0.0, 0.0176), (0.86, 0.012), (0.88, 0.024), (1.0, 0.001))
    ),
    # a spade, short and broad
    "hour": HandOutline(
        0.74,
        (
            *((-0.17, 0.02), (-0.14, 0.045), (-0.09, 0.05), (-0.03, 0.034), (0.3, 0.022), (0.54, 0.024), (0.57, 0.042)),
            *(
                (0.6, 0.03),
                (0.64, 0.07),
                (0.69, 0.1),
                (0.74, 0.105),
                (0.79, 0.09),
                (0.85, 0.045),
                (0.9, 0.022),
                (1.0, 0.003),
            ),
        ),
    ),
    # long, with a leaf before its point
    "minute": HandOutline(
        0.95,
        (
            *(
                (-0.17, 0.012),
                (-0.14, 0.026),
                (-0.1, 0.028),
                (-0.03, 0.02),
                (0.25, 0.013),
                (0.66, 0.012),
                (0.68, 0.022),
            ),
            *((0.7, 0.014), (0.74, 0.034), (0.79, 0.042), (0.84, 0.034), (0.9, 0.014), (1.0, 0.002)),
        ),
    ),
    # thin, with a counterpoise behind its axis
    "seconds": HandOutline(
        0.92,
        (
            *(
                (-0.4, 0.008),
                (-0.39, 0.03),
                (-0.36, 0.048),
                (-0.32, 0.055),
                (-0.28, 0.048),
                (-0.25, 0.03),
                (-0.23, 0.012),
            ),
            *((0.0, 0.011), (0.9, 0.006), (1.0, 0.002)),
        ),
    ),
}
"""By the word of a declaration."""
