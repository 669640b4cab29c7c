"""Helical wheels on axes that cross, and worms with their wheels, under their torque: their teeth touch at a point."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import sin
from typing import TYPE_CHECKING

from geartrain.simulation.strength.contact_results import FlankStrength, PointContact, WheelForce
from geartrain.simulation.strength.formulas.contact_pressure import Elasticity, elasticity_factor
from geartrain.simulation.strength.formulas.point_contact import YIELD_AT_POINT, CrossedWheels
from geartrain.simulation.strength.virtual_spurs import NormalSpurs

if TYPE_CHECKING:
    from geartrain.teeth.involute import Involute
    from geartrain.train import Material

_MPA = 1e6
_WORDS = {
    "base": "a tip reaches below the base of the mate, where there is no flank: give the smaller wheel more teeth",
    "width": "a wheel is so narrow that contact leaves it at the side",
}


@dataclass(frozen=True)
class SkewPair:
    """A pair with the forces on both wheels, as the pair names them.

    wheels      their shapes; `forces`, what they bear from each other
    materials   names, and what they stand for
    is_worm     one is a worm
    form        of their teeth, seen along them
    """

    wheels: CrossedWheels
    forces: tuple[WheelForce, WheelForce]
    materials: tuple[tuple[str, Material], tuple[str, Material]]
    is_worm: bool
    form: Involute

    def contact(self) -> PointContact:
        """All figures."""
        # what pushes the wheels apart is a part of the force across their flanks, whatever the friction
        normal = max(abs(each.radial or 0.0) for each in self.forces) / sin(self.wheels.pressure_angle)
        elasticities = (
            Elasticity(each.youngs_modulus.si / _MPA, float(each.poisson.value)) for _, each in self.materials
        )
        factor = elasticity_factor(*elasticities)
        worst = self.wheels.worst(normal, factor)
        return PointContact(
            self.forces[0].pair,
            self.wheels.contact_ratio,
            normal,
            self.wheels.ellipse(0.0, normal, factor).pressure,
            *worst,
            tuple(self._flank(at, worst.pressure, normal) for at in (0, 1)),
            tuple(self._notes()),
        )

    def _flank(self, at: int, pressure: float, normal: float) -> FlankStrength:
        name, material = self.materials[at]
        wheel, strength = self.forces[at].wheel, material.strength
        bent = self._spurs.root_stress(at, normal)
        if strength is None:
            return FlankStrength(wheel, name, None, None, None, bent)
        bears = strength.si / _MPA
        return FlankStrength(wheel, name, bears, float(material.spread.value), YIELD_AT_POINT * bears / pressure, bent)

    @cached_property
    def _spurs(self) -> NormalSpurs:
        return NormalSpurs(self.wheels, self.form)

    def _notes(self) -> Iterator[str]:
        if self.is_worm:
            yield "its wheel is taken for a helical one, not hollowed out for the worm, which touches along a line"
        if self.wheels.contact_ratio < 1:
            yield "its contact ratio is below 1: one couple leaves before the next has come"
        if any(self._spurs.root_stress(at, 1.0) is None for at in (0, 1)):
            yield "no spur wheels of as many teeth as stand across its teeth can be cut, and their bending is left out"
        yield from (_WORDS[why] for why in sorted(self.wheels.bounded_by) if why in _WORDS)
