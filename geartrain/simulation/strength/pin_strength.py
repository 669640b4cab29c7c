"""Strength of lobes on pins and of pins in holes, and bending of the pins (docs/strength.md, section 11)."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.numerics.quantity import millimetres
from geartrain.simulation.strength.contact_pressure import Elasticity, elasticity_factor, hertz_pressure
from geartrain.simulation.strength.strength_results import PinContact

if TYPE_CHECKING:
    from geartrain.teeth.couplings.pins import PinsInHoles
    from geartrain.teeth.cycloidal_disc import CycloidalDisc
    from geartrain.train import Material


_PHASES = 256  # positions in a pitch
_MPA, _MM = 1e6, 1e3


@dataclass(frozen=True)
class PinnedDisc:
    """Disc of a cycloidal reducer that is loaded by the forces of pins."""

    wheel: str
    """Name of the disc."""
    materials: tuple[tuple[str, Material], tuple[str, Material]]
    """Materials of the disc and of the pins, each preceded by its name."""
    width: float
    """Width of contact [mm]."""
    torque: float
    """Torque on the disc [N m]."""

    @property
    def factor(self) -> float:
        """Elasticity factor ZE [sqrt(MPa)]."""
        return elasticity_factor(*(Elasticity.of(material) for _, material in self.materials))

    def lobes(self, pair: str, disc: CycloidalDisc, module: float) -> PinContact:
        """Return the contact of the disc's lobes with the pins of the ring. `module` is in mm."""
        load = lobe_load(disc)
        force = load.force * abs(self.torque) * _MM / (disc.lobes / 2 * module)
        return self._contact(pair, disc.pins, force, load.curvature / module)

    def holes(self, coupling: PinsInHoles) -> PinContact | None:
        """Return the contact of the disc's holes with the pins of a flange, or None if their sizes are not declared."""
        if coupling.pin_radius is None or coupling.offset is None or coupling.pin_diameter is None:
            return None
        circle, offset, pin = (
            float(millimetres(each)) for each in (coupling.pin_radius, coupling.offset, coupling.pin_diameter)
        )
        # the pin with the largest share at the worst phase
        force = hole_share(coupling.pins) * abs(self.torque) * _MM / circle
        bent = held_pin_stress(force, self.width, pin)
        return self._contact(coupling.name, coupling.pins, force, 2 / pin - 2 / (pin + 2 * offset), bent)

    def _contact(
        self, name: str, pins: int, force: float, curvature: float, pin_stress: float | None = None
    ) -> PinContact:
        (own, material), (_, of_pins) = self.materials
        strength = [None if each.strength is None else each.strength.si / _MPA for each in (material, of_pins)]
        # yielding begins in the weaker material, because both have the same pressure
        weaker = min((each for each in strength if each is not None), default=None)
        pressure = hertz_pressure(self.factor, force, self.width, curvature)
        return PinContact(
            name, self.wheel, own, pins, self.width, force, 1 / curvature, pressure, weaker, pin_stress, strength[1]
        )


class PinLoad(NamedTuple):
    """Force on the pin with the maximum pressure, and sum of the curvatures of pin and lobe, both normalised as
    described in `lobe_load`.
    """

    force: float
    curvature: float


def lobe_load(disc: CycloidalDisc) -> PinLoad:
    """Return the load of the pin at which the contact pressure is highest.

    The force is divided by the tangential force at the disc's pitch circle. The curvature [1/module] is the sum of the
    curvatures of the pin and of the lobe, equation (28) of docs/strength.md.

    >>> from geartrain.teeth.cycloidal_disc import CycloidalDisc
    >>> load = lobe_load(CycloidalDisc(11, 25 / 3, 1.0))
    >>> round(load.force, 3), round(load.curvature, 3)
    (0.326, 1.821)
    """
    phase = np.linspace(0, 2 * pi / disc.pins, _PHASES, endpoint=False)
    # pressure depends on the product of force and curvature
    force, curvature = disc.loads(phase), 1 / disc.pin + disc.curvature(disc.angles(phase))
    at = np.unravel_index(int((force * curvature).argmax()), force.shape)
    return PinLoad(float(force[at]), float(curvature[at]))


def hole_share(pins: int) -> float:
    """Return the maximum force on one of the pins in holes times the radius of the pin circle, divided by the torque of
    all pins, equation (29) of docs/strength.md.

    All contact forces have the same direction, from the centre of a pin to the centre of its hole. Only the pins on one
    side of the circle carry the load.

    >>> round(hole_share(6), 6), round(hole_share(12), 6)
    (0.666667, 0.333333)
    """
    # starting where the first pin has the longest lever arm
    turn = pi / 2 + 2 * pi * np.arange(pins)[:, None] / pins + np.linspace(0, 2 * pi / pins, _PHASES)
    arms = np.maximum(np.sin(turn), 0.0)
    return float((arms / (arms**2).sum(axis=0)).max())


def held_pin_stress(force: float, length: float, diameter: float) -> float:
    """Return the von Mises stress of a cantilever pin [MPa] under a force [N] distributed over its length [mm],
    equation (30) of docs/strength.md.

    At the root of a pin of length l and diameter d, the moment M = F l/2 causes the bending stress 32 M/(pi d^3), and
    the force F causes the mean shear stress over the section.

    >>> round(held_pin_stress(100.0, 4.0, 4.0), 3)
    34.687
    """
    bent, sheared = 16 * force * length / (pi * diameter**3), 4 * force / (pi * diameter**2)
    return sqrt(bent**2 + 3 * sheared**2)
