"""Lobes on their pins, and pins in their holes, under the torque of a train."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.numerics.quantity import millimetres
from geartrain.simulation.strength.contact_results import PinContact
from geartrain.simulation.strength.formulas.contact_pressure import Elasticity, elasticity_factor, hertz_pressure
from geartrain.simulation.strength.formulas.pin_contact import held_pin_stress, hole_share, lobe_load

if TYPE_CHECKING:
    from geartrain.teeth.cycloidal_disc import CycloidalDisc
    from geartrain.teeth.pin_coupling import PinsInHoles
    from geartrain.train import Material

_MPA, _MM = 1e6, 1e3


@dataclass(frozen=True)
class PinnedDisc:
    """A disc and what pins press it with.

    wheel      its name
    materials  names of its own and of the pins', and what they stand for
    width      along which they touch (mm)
    torque     [N m]
    """

    wheel: str
    materials: tuple[tuple[str, Material], tuple[str, Material]]
    width: float
    torque: float

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
