"""Lobes on their pins and pins in their holes, round pins and their bending: docs/strength.md, section 11."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.numerics.quantity import millimetres
from geartrain.simulation.strength.contact_pressure import Elasticity, elasticity_factor, hertz_pressure
from geartrain.simulation.strength.strength_results import PinContact

if TYPE_CHECKING:
    from geartrain.teeth.cycloidal_disc import CycloidalDisc
    from geartrain.teeth.pin_coupling import PinsInHoles
    from geartrain.train import Material


_PHASES = 256  # of a pitch
_MPA, _MM = 1e6, 1e3


@dataclass(frozen=True)
class PinnedDisc:
    """A disc and what pins press it with."""

    wheel: str
    """Its name."""
    materials: tuple[tuple[str, Material], tuple[str, Material]]
    """Names of its own and of the pins', and what they stand for."""
    width: float
    """Along which they touch (mm)."""
    torque: float
    """[N m]."""

    @property
    def factor(self) -> float:
        """ZE."""
        both = (Elasticity(each.youngs_modulus.si / _MPA, float(each.poisson.value)) for _, each in self.materials)
        return elasticity_factor(*both)

    def lobes(self, pair: str, disc: CycloidalDisc, module: float) -> PinContact:
        """Its lobes on the pins of a ring, `module` in mm."""
        load = lobe_load(disc)
        force = load.force * abs(self.torque) * _MM / (disc.lobes / 2 * module)
        return self._contact(pair, disc.pins, force, load.curvature / module)

    def holes(self, coupling: PinsInHoles) -> PinContact | None:
        """Its holes on pins of a flange; None where sizes are not declared."""
        if coupling.pin_radius is None or coupling.offset is None or coupling.pin_diameter is None:
            return None
        circle, offset, pin = (
            float(millimetres(each)) for each in (coupling.pin_radius, coupling.offset, coupling.pin_diameter)
        )
        force = hole_share(coupling.pins) * abs(self.torque) * _MM / circle
        bent = held_pin_stress(force, self.width, pin)
        return self._contact(coupling.name, coupling.pins, force, 2 / pin - 2 / (pin + 2 * offset), bent)

    def _contact(
        self, name: str, pins: int, force: float, curvature: float, pin_stress: float | None = None
    ) -> PinContact:
        (own, material), (_, of_pins) = self.materials
        strength = [None if each.strength is None else each.strength.si / _MPA for each in (material, of_pins)]
        weaker = min((each for each in strength if each is not None), default=None)
        pressure = hertz_pressure(self.factor, force, self.width, curvature)
        return PinContact(
            name, self.wheel, own, pins, self.width, force, 1 / curvature, pressure, weaker, pin_stress, strength[1]
        )


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
