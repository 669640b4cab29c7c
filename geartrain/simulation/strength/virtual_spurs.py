"""Spur wheels that stand for others, and the contact of crossed wheels at a point.

Tredgold's spur wheels stand for straight bevels; those across the teeth for helical wheels on crossed axes and worms,
whose teeth touch at a point.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import cos, sin
from typing import TYPE_CHECKING

from geartrain.dynamics.wheel_teeth import CHORD
from geartrain.errors import GearTrainError
from geartrain.simulation.strength.contact_pressure import (
    YIELD_AT_POINT,
    CrossedWheels,
    Elasticity,
    elasticity_factor,
)
from geartrain.simulation.strength.iso_6336 import ToothSide
from geartrain.simulation.strength.strength_results import FlankStrength, PointContact, WheelForce
from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.outlines.tooth_requirement import CLEARANCE, ToothRequirement

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.involute import Involute
    from geartrain.teeth.outlines.wheel_requirement import CutTooth
    from geartrain.train import Material


_MM = 1e3
_FLATTEST = 0.01  # cosine of a cone that still rolls on a spur wheel, not on a rack
_WIDEST = 1 / 3  # of the cone's length: what makers allow
_SPREAD = 2.0  # of its lever: how wide a force at a point is spread where it bends
_MPA = 1e6
_WORDS = {
    "base": "a tip reaches below the base of the mate, where there is no flank: give the smaller wheel more teeth",
    "width": "a wheel is so narrow that contact leaves it at the side",
}


@dataclass(frozen=True)
class ConeMiddle:
    """Pitch cones of a pair, seen in the middle of its teeth: docs/strength.md (23). Lengths in one unit."""

    cones: PitchSurfaces
    """Of gears 1 and 2."""
    module: float
    """At the large ends; `width` of the teeth, from there towards the apex."""
    width: float

    @property
    def reach(self) -> float:
        """Length of both cones, from the apex to the large ends."""
        return self.module * self.cones.z1 / 2 / sin(self.cones.R1)

    @property
    def shrunk(self) -> float:
        """Lengths in the middle over those at the large ends."""
        return 1 - self.width / 2 / self.reach

    def cone(self, gear: int) -> float:
        """Half-angle of one of them (rad)."""
        return abs(self.cones.axle_of(gear))

    def radius(self, gear: int) -> float:
        """Of the pitch circle in the middle."""
        return self.shrunk * self.module * self.cones.teeth_of(gear) / 2


@dataclass(frozen=True)
class VirtualSpurs:
    """The spur pair whose teeth are those of a bevel pair in the middle of their width; modules are those there."""

    middle: ConeMiddle
    form: ConjugateToothForm

    @classmethod
    def of(cls, mesh: GearMesh, module: float, width: float) -> VirtualSpurs | None:
        """Of a pair with this module at the large ends, and this width; None of axes that do not meet."""
        form = mesh.tooth_form
        if mesh.path is None or not mesh.path.pitch.bevel or not isinstance(form, ConjugateToothForm):
            return None
        return cls(ConeMiddle(mesh.path.pitch, module, width), form)

    @property
    def why_not(self) -> str:
        """Why there is none, or nothing."""
        if self.middle.shrunk <= 1 / 2:
            return "its teeth are wider than its cones are long"
        if min(cos(self.middle.cone(gear)) for gear in (1, 2)) < _FLATTEST:
            return "the cone of one wheel is flat or hollow, and no spur wheel stands for that"
        return ""

    @property
    def is_wide(self) -> bool:
        """Wider than makers make them."""
        return self.middle.width > _WIDEST * self.middle.reach

    def count(self, gear: int) -> float:
        """Teeth of one of them, which need not be whole."""
        return self.middle.cones.teeth_of(gear) / cos(self.middle.cone(gear))

    @cached_property
    def wheels(self) -> WheelPair:
        """Both, at the large end, where lengths are declared."""
        return WheelPair(self.count(1), self.count(2), module=self.middle.module)

    @cached_property
    def pair(self) -> ConjugatePair:
        """With its path of contact. Raises `GearTrainError` where the form gives none."""
        return self.form.pair(self.wheels)

    def teeth(self, gear: int) -> CutTooth:
        """Of one of them."""
        free = self.form.bottom_clearance(self.wheels, gear)
        clearance = CLEARANCE if free is None else max(free, 0.0)
        return ToothRequirement(self.pair, gear, CHORD, clearance, self.form.lantern_pins(self.wheels)).cut([])


@dataclass(frozen=True)
class NormalSpurs:
    """The spur pair whose teeth are those of crossed helical wheels seen along them: docs/strength.md (27)."""

    crossed: CrossedWheels
    form: Involute

    @cached_property
    def _pair(self) -> ConjugatePair | None:
        counts = self.crossed.normal_count(0), self.crossed.normal_count(1)
        try:
            return self.form.pair(WheelPair(*counts, module=self.crossed.module / _MM))
        except GearTrainError:
            return None

    def root_stress(self, at: int, force: float) -> float | None:
        """Bending at the root of a tooth [MPa] that bears a force [N] across itself at its tip; None without teeth.

        The force spreads over twice its lever, but no farther than the tooth is long.
        """
        if self._pair is None:
            return None
        form, module = self.form, self.crossed.module
        free = form.bottom_clearance(WheelPair(self._pair.path.pitch.z1, self._pair.path.pitch.z2), at + 1)
        clearance = CLEARANCE if free is None else max(free, 0.0)
        try:
            tooth = ToothRequirement(self._pair, at + 1, CHORD, clearance).cut([])
        except GearTrainError:
            return None
        side = ToothSide.of(tooth.tooth)
        arm = self.crossed.normal_count(at) / 2 * cos(self.crossed.pressure_angle)
        load = side.load_at(tooth.tip, arm)
        section = side.weakest_section(load)
        width = min(self.crossed.tooth_length(at), _SPREAD * (load.apex - section.x) * module)
        return section.stress(force * arm * module, width, module)


@dataclass(frozen=True)
class SkewPair:
    """A pair with the forces on both wheels, as the pair names them."""

    wheels: CrossedWheels
    """Their shapes; `forces`, what they bear from each other."""
    forces: tuple[WheelForce, WheelForce]
    materials: tuple[tuple[str, Material], tuple[str, Material]]
    """Names, and what they stand for."""
    is_worm: bool
    """One is a worm."""
    form: Involute
    """Of their teeth, seen along them."""

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
