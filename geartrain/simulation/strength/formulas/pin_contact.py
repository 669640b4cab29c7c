"""Pressure of round pins on lobes and in holes, and bending of pins: docs/strength.md, section 11."""

from __future__ import annotations

from math import pi, sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from geartrain.teeth.cycloidal_disc import CycloidalDisc

_PHASES = 256  # of a pitch


class PinLoad(NamedTuple):
    """Where pressure is greatest: the force there, and the sum of both curvatures."""

    force: float
    curvature: float


def lobe_load(disc: CycloidalDisc) -> PinLoad:
    """The pin that is pressed most: its force over that on the disc's pitch circle, both curvatures over 1/module.

    A lobe is round with the radius of the curve of centres less that of the pin, a hollow with the sum of both (28).

    >>> from geartrain.teeth.cycloidal_disc import CycloidalDisc
    >>> load = lobe_load(CycloidalDisc(11, 25 / 3, 1.0))
    >>> round(load.force, 3), round(load.curvature, 3)
    (0.326, 1.821)
    """
    phase = np.linspace(0, 2 * pi / disc.pins, _PHASES, endpoint=False)
    force, curvature = disc.loads(phase), 1 / disc.pin + disc.curvature(disc.angles(phase))
    at = np.unravel_index(int((force * curvature).argmax()), force.shape)
    return PinLoad(float(force[at]), float(curvature[at]))


def hole_share(pins: int) -> float:
    """Greatest force on one of some pins in holes, times the radius of their circle, over their torque: (29).

    A pin presses along the line from its own middle to that of its hole, the same for all; those on one side bear.

    >>> round(hole_share(6), 6), round(hole_share(12), 6)
    (0.666667, 0.333333)
    """
    # from where the first pin has the longest arm
    turn = pi / 2 + 2 * pi * np.arange(pins)[:, None] / pins + np.linspace(0, 2 * pi / pins, _PHASES)
    arms = np.maximum(np.sin(turn), 0.0)
    return float((arms / (arms**2).sum(axis=0)).max())


def held_pin_stress(force: float, length: float, diameter: float) -> float:
    """Stress [MPa] of a pin held at one end under a force [N] spread over its length [mm], by v. Mises: (30).

    At its foot the moment F l/2 bends it, 32 M/(pi d^3), and F shears it, F over its section.

    >>> round(held_pin_stress(100.0, 4.0, 4.0), 3)
    34.687
    """
    bent, sheared = 16 * force * length / (pi * diameter**3), 4 * force / (pi * diameter**2)
    return sqrt(bent**2 + 3 * sheared**2)
